"""A text as tables: its lines, the separator that cuts them into cells, rows of numbers and the words above them.

Rows are the lines whose cells are mostly numbers. Rows that follow one another are one table; so are those between
which a line has numbers and words: it is a row with a fault, and nothing between two rows is passed over. Words
alone part two tables. A first line such as `sep=;` of Excel names the separator. Names and units of columns may
stand in comments.
"""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import NamedTuple

from mdr.tools.messages import short
from mdr.tools.notation import is_unit

SEPARATORS = ("\t", ";", "|", ",", " ")  #: " " is any run of blanks
SEARCHED = 1000  #: lines that tell the separator
FAR = 200  #: lines that tell of a table: rows, and words above lines such as "Rate, 1000"
_DIGITS = r"\d{1,3}(?:[.,'’]\d{3})+(?:[.,]\d+)?|\d+[.,]?\d*|[.,]\d+"  # with or without separators of thousands
_NUMBER = re.compile(rf"[+−-]?(?:{_DIGITS})(?:e[+-]?\d+)?|[+-]?inf(?:inity)?|∞|nan", re.IGNORECASE)
_KEYED = re.compile(r"[\s#%]*\w[\w ]{0,40}[:=](?P<cells>.+)")  # "# units: m N m"
_LETTER = re.compile(r"[^\W\d]|[°µμ%]")
_UNITS = re.compile(r"\bunits?\b|[\W_]units?(?![a-z])", re.IGNORECASE)  #: in the key of a line of units


class Line(NamedTuple):
    """A line that is not empty."""

    number: int  #: in the file, from 1
    text: str

    @property
    def is_comment(self) -> bool:
        """Whether it begins with #."""
        return self.text.lstrip().startswith("#")


class Names(NamedTuple):
    """Cells that may name the columns, and those that may be their units."""

    line: Line | None
    cells: list[str]
    units: list[str]

    @property
    def width(self) -> int:
        """Cells but the empty ones at their end."""
        return len(_filled(self.cells))


@dataclass
class Block:
    """A table: rows, and what stands above them."""

    separator: str
    above: list[Line]  #: words, down from the table before
    rows: list[Line] = field(default_factory=list)
    remarks: list[Line] = field(default_factory=list)  #: comments between its rows
    beyond: list[Line] = field(default_factory=list)  #: words farther up, above lines such as "Rate, 1000"
    named: Block | None = None  #: the table before whose header is its, as it has none and is as wide
    widths: Counter[int] = field(default_factory=Counter)  #: cells of its rows

    @property
    def width(self) -> int:
        """Cells of most rows."""
        return self.widths.most_common(1)[0][0]

    @property
    def is_table(self) -> bool:
        """Whether it has two columns of numbers, and is more than a line such as "Range, -1, 1"."""
        numbers = [is_like_number(cell) for cell in self.cells(self.rows[0]) if cell]
        return sum(numbers) > 1 and (numbers[0] or len(self.rows) > 2)

    @property
    def share(self) -> tuple[float, int]:
        """The share of numbers in the cells of its rows that are as wide as most, and their count."""
        cut = [cells for line in self.rows[:FAR] if len(cells := self.cells(line)) == self.width]
        numbers = [is_like_number(cell) for cells in cut for cell in cells if cell]
        return sum(numbers) / max(len(numbers), 1), sum(numbers)

    @property
    def told(self) -> str:
        """Where it stands, below which words."""
        words = [one.text.strip(" #%\t;,") for one in self.above if len(self.heads(one)) < max(self.width, 2)]
        below = f', below "{short(words[-1])}"' if words and words[-1] else ""
        return f"lines {self.rows[0].number} to {self.rows[-1].number}{below}"

    def stand_below(self, before: Block) -> None:
        """What a new table has from the one before it."""
        self.beyond = [] if before.is_table else [*before.beyond, *before.above][-FAR:]
        heads = (len(self.heads(line)) for line in self.above if _LETTER.search(line.text))
        if before.width == self.width and self.width not in heads:
            self.named = before.named or before

    def cells(self, line: Line) -> list[str]:
        """The cells of a row."""
        return cells_of(line.text, self.separator)

    def heads(self, line: Line, text: str = "") -> list[str]:
        """The cells of a line above; above rows cut by blanks as many as these have, however they are cut."""
        text = re.sub(r"^\s*[#%]+\s*", "", text or line.text).strip(" ")
        if self.separator != " ":
            return cells_of(text, self.separator)
        by_signs = [cells_of(text, one) for one in SEPARATORS[:-1]]
        by_blanks = [re.split(one, text) for one in (r"\s{2,}", r"\s+(?![\[(])")] + [cells_of(text, " ")]
        alike = (cells for cells in (*by_signs, *by_blanks) if len(cells) == self.width)
        return next(alike, max(by_signs, key=len))

    def between(self, names: Names) -> list[Line]:
        """Lines between its header and its rows that are neither comments nor the units."""
        lines = [line for line in self.above[-FAR:] if names.line and line.number > names.line.number]
        return [line for line in lines if not line.is_comment and _bare(self.heads(line)) != names.units]

    def names(self) -> Iterator[Names]:
        """What may be its header, the nearest first."""
        words = [*self.beyond, *self.above[-SEARCHED:]]
        of_units = [line for line in words if _UNITS.search(re.split(r"[:=\t;,]", line.text[:60], maxsplit=1)[0])]
        cut = [(line, self.heads(line)) for line in self.above[-8:] if _LETTER.search(line.text)]
        units = [cells if _most(is_unit, cells := _bare(heads)) else [] for _, heads in cut]
        for i in sorted(range(len(cut)), key=lambda i: (bool(units[i]), -i)):
            near = next(filter(None, [*units[i + 1 :], *units[max(i - 1, 0) : i]]), [])
            told = near or self._units_beside(cut[i][1], of_units)
            yield Names(*cut[i], [] if units[i] else told)
        for line in words:
            if (cells := self._keyed(line)) and len(cells) > 1 and line not in of_units:
                yield Names(line, cells, self._units_beside(cells, of_units))
        yield Names(None, [], self._units_beside([""] * self.width, of_units))

    def _units_beside(self, names: Sequence[str], of_units: Sequence[Line]) -> list[str]:
        """The units in the last line whose first word says that they are: it stands in the first column, or before."""
        for line in reversed(of_units):
            own, count = _bare(cells_of(line.text, self.separator)), len(_filled(names))
            behind = own[1:] if len(_filled(own)) > count else ["", *own[1:]]
            for cells in (_bare(self._keyed(line)), behind):
                if any(map(is_unit, cells)):
                    return cells
        return []

    def _keyed(self, line: Line) -> list[str]:
        """The cells behind a key, as in "# columns: a b", if they are as many as those of the rows."""
        keyed = _KEYED.fullmatch(line.text)
        cells = self.heads(line, keyed["cells"]) if keyed else []
        return cells if len(cells) == self.width else []


def lines_of(text: str, skip: int | None) -> list[Line]:
    """The lines of a text that hold more than separators, without the first `skip`."""
    first = max(skip or 0, int(separators_of(text) is not SEPARATORS))
    return [Line(n, line) for n, line in enumerate(text.splitlines(), start=1) if n > first and line.strip(" \t,;")]


def separators_of(text: str) -> Sequence[str]:
    """What a first line such as `sep=;` of Excel says; without one all that may be."""
    told = re.match(r'"?sep=([^\w"\r\n])"?[,;\t]*\r?$', text, re.IGNORECASE | re.MULTILINE)
    return told[1] if told else SEPARATORS


def blocks(lines: Iterable[Line], separator: str) -> list[Block]:
    """The tables of a text that is cut so."""
    found: list[Block] = []
    words: list[Line] = []
    for line in lines:
        cells = cells_of(line.text, separator)
        if not _is_row(cells) or line.is_comment:
            words.append(line)
            continue
        if not found or (words and _part(words, found[-1])):
            found.append(Block(separator, words, widths=Counter([len(cells)])))
            if len(found) > 1:
                found[-1].stand_below(found[-2])
        else:
            found[-1].rows += [one for one in words if not one.is_comment]
            found[-1].remarks += [one for one in words if one.is_comment]
            found[-1].widths[len(cells)] += 1
        words = []
        found[-1].rows.append(line)
    return found


def _part(words: Sequence[Line], block: Block) -> bool:
    """Whether words between two rows part them: a line without a number, or a comment that stands above the first."""
    above = {one.text for one in block.above if one.is_comment}
    return any(one.text in above if one.is_comment else not any(map(is_like_number, block.cells(one))) for one in words)


def _bare(cells: Sequence[str]) -> list[str]:
    """Cells without brackets."""
    return [cell.strip(" []()/\t\"'<>") for cell in cells]


def _filled(cells: Sequence[str]) -> Sequence[str]:
    """Cells without the empty ones at their end."""
    last = max((i for i, cell in enumerate(cells) if cell), default=-1)
    return cells[: last + 1]


def _most(are: Callable[[str], bool], cells: Sequence[str]) -> bool:
    """Whether half of the cells, or more, are so."""
    full = [cell for cell in cells if cell.strip()]
    return 0 < len(full) <= 2 * sum(map(are, full))


def _is_row(cells: Sequence[str]) -> bool:
    with suppress(ValueError):
        return bool(list(map(float, cells)))
    return _most(is_like_number, cells)


def is_like_number(cell: str) -> bool:
    """Whether it is a number in some spelling."""
    return bool(_NUMBER.fullmatch(cell.strip()))


def cells_of(line: str, separator: str) -> list[str]:
    """The cells of one line; a quote that is left open ends with it."""
    if '"' in line:
        with suppress(csv.Error):  # a cell of more letters than csv takes
            cells = next(csv.reader([line.strip()], delimiter=separator, skipinitialspace=True), [])
            return [cell for cell in cells if cell] if separator == " " else cells
    if separator == " ":
        return line.split()
    cells = line.split(separator) if line else []
    return [cell.strip() for cell in cells] if " " in line or "\t" in line or "\xa0" in line else cells


#: letters of units in the tables of letters of other countries, and what a table is called
_CODINGS = {"cp1252": "Latin-1", "shift_jis": "Shift-JIS", "gbk": "GBK"}
#: what files are that are no text, and what to do; and their first bytes
_KINDS = {
    "an Excel workbook, or another zip archive: save the sheet as CSV": (b"PK\x03\x04",),
    "an Excel workbook: save the sheet as CSV": (b"\xd0\xcf\x11\xe0",),
    "a MATLAB file: write its columns as CSV, with writematrix or numpy.savetxt": (b"MATLAB 5.0",),
    "an HDF5 or MATLAB file: write its columns as CSV, with writematrix or numpy.savetxt": (b"\x89HDF",),
    "a netCDF file: write its columns as CSV": (b"CDF\x01",),
    "a NumPy array: write it with numpy.savetxt and a header": (b"\x93NUMPY",),
    "a sound file (WAV): write its samples as CSV, and give rate=": (b"RIFF",),
    "a LabVIEW TDMS file: export it as text or CSV": (b"TDSm",),
    "a gzip archive: unpack it": (b"\x1f\x8b",),
    "a bzip2 archive: unpack it": (b"BZh",),
    "a 7-Zip archive: unpack it": (b"7z\xbc\xaf",),
    "a PDF: type its table as CSV, or ask for the data": (b"%PDF",),
    "an image: give the numbers behind it as CSV": (b"\x89PNG", b"\xff\xd8\xff", b"GIF8"),
    "an image: export its heights as CSV": (b"II*\x00", b"MM\x00*"),
    "a Parquet file: write it as CSV": (b"PAR1",),
    "a document: save it as plain text": (b"{\\rtf",),
    "a page of HTML or XML: save its sheet as CSV": (b"<html", b"<HTML", b"<?xml", b"<!DOC", b"<table"),
}


def kind_of(data: bytes) -> str:
    """What a file is that is no text, by its first bytes, and what to do; empty for a text."""
    start = data[:1000].lstrip(b"\xef\xbb\xbf \r\n")
    known = next((kind for kind, firsts in _KINDS.items() if start.startswith(firsts)), "")
    if known or b"\0" not in data or _utf_16(data):
        return known
    return f"no text, it has a zero byte at {data.index(0)}: export it as text or CSV"


def _utf_16(data: bytes) -> str:
    """Which UTF-16 it is; empty for none."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return "utf-16"
    return "utf-16-le" if len(data) > 3 and not any(data[1:200:2]) and all(data[:200:2]) else ""


def decoded(data: bytes) -> tuple[str, str]:
    """The text of a file, and what was guessed of its letters where they are neither UTF-8 nor UTF-16."""
    if coding := _utf_16(data):
        return data.decode(coding, "replace"), ""
    try:
        return data.decode("utf-8-sig"), ""
    except UnicodeDecodeError as wrong:
        first, line = wrong.start, data.count(b"\n", 0, wrong.start) + 1
    near = data[max(first - 2000, 0) : first + 2000]
    units = {coding: sum(near.decode(coding, "ignore").count(one) for one in "µμ°²Åδω·") for coding in _CODINGS}
    coding = max(units, key=units.__getitem__)
    return data.decode(coding, "replace"), f"line {line} is not UTF-8: letters are read as {_CODINGS[coding]}"
