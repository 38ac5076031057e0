"""Where the table stands in a text: lines above it, a header, a row of units, rows of numbers, and what cuts cells.

Nothing of it needs to be said: rows are the lines whose cells are mostly numbers, alike in count; the header and a row
of units stand right above them. A first line such as `sep=;` of Excel names the separator. A header may be a comment.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import NamedTuple

from mdr.tools.notation import is_unit

SEPARATORS = ("\t", ";", "|", ",", " ")  #: " " is any run of blanks
SEARCHED = 300  #: lines in which a header is looked for
_DIGITS = r"\d{1,3}(?:[.,'’]\d{3})+(?:[.,]\d+)?|\d+[.,]?\d*|[.,]\d+"  # with or without separators of thousands
_NUMBER = re.compile(rf"[+−-]?(?:{_DIGITS})(?:e[+-]?\d+)?|[+-]?inf(?:inity)?|∞|nan", re.IGNORECASE)


class Line(NamedTuple):
    """A line that is not empty."""

    number: int  #: in the file, from 1
    text: str

    @property
    def is_comment(self) -> bool:
        """Whether it begins with #."""
        return self.text.lstrip().startswith("#")


class Layout(NamedTuple):
    """A way to read the text."""

    separator: str
    heads: list[str]  #: cells of the header, none where there is no header
    below: list[str]  #: cells of a row of units, none where there is no such row
    lines: list[Line]  #: from the header, or the first row, on
    first: int  #: place of the first row among these

    @property
    def rows(self) -> list[Line]:
        """The lines below the header."""
        return [line for line in self.lines[self.first :] if not line.is_comment]

    def cells(self, line: Line) -> list[str]:
        """The cells of a row."""
        return cells_of(line.text, self.separator)


def lines_of(text: str, skip: int | None) -> list[Line]:
    """The lines of a text that hold more than separators, without the first `skip`."""
    first = max(skip or 0, int(bool(told_separator(text))))
    return [Line(n, line) for n, line in enumerate(text.splitlines(), start=1) if n > first and line.strip(" \t,;")]


def told_separator(text: str) -> str:
    """What a first line such as `sep=;` of Excel says; empty without one."""
    told = re.match(r'"?sep=([^\w"\r\n])"?[,;\t]*\r?$', text, re.IGNORECASE | re.MULTILINE)
    return told[1] if told else ""


def layouts(lines: Sequence[Line], told: str, skip: int | None) -> Iterator[Layout]:
    """The ways to read the lines in which something stands above a row of numbers, as a header does."""
    for separator in told or SEPARATORS:
        cut = [cells_of(line.text, separator) for line in lines[: SEARCHED + 3]]
        for i in range(len(cut) if skip is None else 1):
            # a row of units, and one of remarks, may stand between
            ends = [j for j in range(i + 1, min(i + 4, len(cut))) if is_row(cut[j]) and not lines[j].is_comment]
            if ends and not is_row(cut[i]):
                yield _layout(lines, separator, i, ends[0])


def likely(lines: Sequence[Line], told: str) -> Iterator[tuple[Layout, tuple[float, int]]]:
    """For each separator the longest run of alike rows, with what stands above; the share and the count of numbers."""
    for separator in told or SEPARATORS:
        cut = [[] if one.is_comment else cells_of(one.text, separator) for one in lines[:SEARCHED]]
        best, place = (0.0, 0), 0
        for start in (i for i, cells in enumerate(cut) if is_row(cells) and not (i and _alike(cut[i - 1], cells))):
            end = next((j for j in range(start + 1, len(cut)) if not _alike(cut[start], cut[j])), len(cut))
            numbers = [is_like_number(cell) for cells in cut[start:end] for cell in cells if cell]
            best, place = max((best, place), ((sum(numbers) / len(numbers), sum(numbers)), start))
        if best[1]:
            yield _below(lines, separator, place), best


def _below(lines: Sequence[Line], separator: str, start: int) -> Layout:
    """The way to read of which the first row is known: a header, or a header and a row of units, stands above it."""
    above = [i for i in range(max(start - 2, 0), start) if not is_row(cells_of(lines[i].text, separator))]
    width = len(cells_of(lines[start].text, separator))
    if len(above) == 2 and not any(map(is_unit, _units(lines[above[1]], separator, width))):
        above = above[1:]
    return _layout(lines, separator, above[0] if above and above[-1] == start - 1 else start, start)


def _layout(lines: Sequence[Line], separator: str, header: int, first: int) -> Layout:
    """The way to read that has its header and its first row there."""
    width = len(cells_of(lines[first].text, separator))
    heads = _heads(lines[header], separator, width) if header < first else []
    between = [_units(line, separator, width) for line in lines[header + 1 : first]]
    whole = [cells for cells in between if separator != " " or len(cells) == width]
    below: list[str] = next((cells for cells in whole if any(map(is_unit, cells))), [])
    return Layout(separator, heads, below, list(lines[header:]), first - header)


def _heads(line: Line, separator: str, width: int) -> list[str]:
    """The cells of a header; above rows cut by blanks as many as these have, however they are cut, or one."""
    text = line.text.lstrip(" #%")
    if separator != " ":
        return cells_of(text, separator)
    cuts = [cells_of(text, one) for one in SEPARATORS[:-1]]
    cuts += [re.split(one, text.strip()) for one in (r"\s{2,}", r"\s+(?![\[(])", r"\s+")]
    cuts += [text.partition(":")[2].split()]  # columns: a b
    return next((cells for cells in cuts if len(cells) == width), [text.strip()])


def _units(line: Line, separator: str, width: int) -> list[str]:
    """The cells of a row of units, without brackets."""
    return [cell.strip(" []()") for cell in _heads(line, separator, width)]


def is_row(cells: Sequence[str]) -> bool:
    """Whether half of the cells, or more, are numbers."""
    full = [cell for cell in cells if cell.strip()]
    return 0 < len(full) <= 2 * sum(map(is_like_number, full))


def is_like_number(cell: str) -> bool:
    """Whether it is a number in some spelling."""
    return bool(_NUMBER.fullmatch(cell.strip()))


def _alike(cells: Sequence[str], others: Sequence[str]) -> bool:
    return len(cells) == len(others) and is_row(cells) and is_row(others)


def cells_of(line: str, separator: str) -> list[str]:
    """The cells of one line; a quote that is left open ends with it."""
    if separator == " ":
        return line.split()
    if '"' in line:
        with suppress(csv.Error):  # a cell of more letters than csv takes
            return next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
    return [cell.strip() for cell in line.split(separator)] if line else []


def decoded(data: bytes) -> tuple[str, str]:
    """The text of a file, and what was guessed of its letters: UTF-8, UTF-16, or else Latin-1."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", "replace"), ""
    try:
        return data.decode("utf-8-sig"), ""
    except UnicodeDecodeError as wrong:
        line = data.count(b"\n", 0, wrong.start) + 1
        return data.decode("cp1252", "replace"), f"line {line} is not UTF-8: letters are read as Latin-1"
