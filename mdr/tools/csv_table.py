"""Tables as CSV: columns with units that people write or instruments export, values in SI, or what is wrong.

    # sphere on rubber
    r [um], height [nm], note
    0, 0.2, tip
    1, 0.9,

A header names the columns, each with its unit in brackets (`csv_header`); lines above it, the separator and a row of
units are found (`csv_layout`), and a decimal comma where no number can be read otherwise. Columns may stand in any
order, beside others. Of several tables one must have them, or be chosen. What is wrong is told all at once, with the
first lines as read and what to give with the file.
"""

from __future__ import annotations

import csv
import math
import warnings
from bisect import bisect
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from io import StringIO
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.tools.arrays import Array
from mdr.tools.atomic_write import write_whole
from mdr.tools.checks import count
from mdr.tools.csv_header import Column, Header, Place, Reading, fault, repr_of
from mdr.tools.csv_layout import SEARCHED, Block, Line, Names, blocks, is_like_number, lines_of, separators_of
from mdr.tools.messages import first_of, one_line, short
from mdr.tools.notation import converted, decimal_mark, number_in, shown, with_point
from mdr.tools.progress import progress
from mdr.tools.warned import warn_outside


class Tabled:
    """Base of records that write themselves as CSV; they answer `table()`."""

    def table(self) -> str:
        """The text of the CSV file.

        Returns
        -------
        str
            What `to_csv` writes.
        """
        raise NotImplementedError

    def to_csv(self, path: str | Path) -> None:
        """Write the text of `table()`, with units in the header.

        Parameters
        ----------
        path : str or path-like
            The file.
        """
        write_whole(Path(path), self.table().encode("utf-8"))


@dataclass(eq=False)
class Table:
    """A table of a text with a header that it may have; its values once they are read."""

    source: str  #: name of the file
    text: str  #: of the file
    columns: Sequence[Column]  #: that are looked for
    reading: Reading
    block: Block
    names: Names
    above: str  #: words above
    values: dict[str, Array] = field(default_factory=dict)  #: each column (n,) in the unit of the library

    def __post_init__(self) -> None:
        block, names = self.block, self.names
        row = block.cells(block.rows[0])
        heads = [*names.cells, *[""] * (len(row) - len(names.cells))]
        self.header = Header(heads, names.units, self.columns, self.reading, self.above)
        for line in block.between(names):
            where = f"line {line.number}, {short(line.text)}, between header and rows is"
            if any(map(is_like_number, block.cells(line))):
                self.header.faults.append(f"{where} no row")
            elif any(map(str.isalnum, line.text)):
                self.header.said.append(f"{where} left out")
        cells = [(one.column, row[one.at].strip() if one.at < len(row) else "") for one in self.header.places]
        numbers = [is_like_number(cell) or (one.empty is not None and not cell) for one, cell in cells]
        #: whether all that is needed is there, with numbers below
        self.is_whole = bool(numbers) and all(numbers) and not self.header.faults

    @property
    def fits(self) -> tuple[int, ...]:
        """How well the header fits what is looked for."""
        columns, faults = len(self.header.at), len(self.header.faults)
        return self.is_whole, columns > 0 == faults, columns, -faults

    @property
    def rank(self) -> tuple[float, ...]:
        """The same, whether it is a table below its header, and whether its cells are numbers."""
        whole, sound, *counts = self.fits
        aligned = len(self.names.cells) == self.block.width
        return whole, sound, self.block.is_table, aligned, *counts, *self.block.share

    @property
    def lines(self) -> list[int]:
        """Where each row stands in the file."""
        return [row.number for row in self.block.rows]

    def fault(self, what: str) -> ValueError:
        """The error of this file."""
        return fault(self.source, what)

    def refusal(self, faults: Sequence[str], more: Sequence[Column] = ()) -> ValueError:
        """The error of its header: faults, the first lines as they were read, and what to give with the file."""
        block, header = self.block, self.names.line
        above = [line for line in block.above if header is not None and line.number >= header.number][:3]
        read = [(line, self.names.cells if line is header else block.heads(line)) for line in above]
        if header is not None and header not in above:
            read.insert(0, (header, self.names.cells))
        read += [(line, block.cells(line)) for line in block.rows[:2]]
        lines = [f"  {one_line(f'line {line.number}: ' + ' | '.join(row), 120)}" for line, row in read]
        way_out = self.header.way_out(more)
        last = [f"  to read it as it is: {one_line(way_out)}"] if way_out else []
        return ValueError("\n".join([*_first(faults, self.source), *lines, *last]))

    def lacks(self, what: str, example: str, *wanted: str) -> ValueError:
        """The error of a header that names none of several columns; a file that has them all would be read so."""
        more = [one for one in self.columns if one.name in wanted]
        return self.refusal([f"the header names {what}; write {example}{self.header.others(more)}"], more)

    def one_of(self, kinds: Sequence[Sequence[Column]], lack: str, example: str, *wanted: str) -> Sequence[Column]:
        """The only one of some kinds of columns that the file has. Refused where it has several, or `lack` says."""
        names = [[one.name for one in kind if one.name in self.values] for kind in kinds]
        if not any(names):
            raise self.lacks(lack, example, *wanted)
        _, *others = there = [*filter(None, names)]
        if others:
            without = ", ".join(f'{repr_of(name)}: ""' for kind in others for name in kind)
            both = " and ".join(kind[0] for kind in there)
            raise self.fault(f"{both}: one is read; leave one out, columns={{{without}}}")
        return kinds[names.index(there[0])]

    def again(self, columns: Sequence[Column], reading: Reading) -> dict[str, Array]:
        """The values where it is read so, in silence; none where it is refused."""
        with suppress(ValueError), warnings.catch_warnings(action="ignore"):
            return table_of(self.text, self.source, columns, reading).values
        return {}

    def require(self, good: NDArray[np.bool_], rule: str) -> None:
        """Refuse the first row that is not good."""
        if not np.all(good):
            i = int(np.argmin(good))
            row = ", ".join(f"{name} = {values[i]:.6g}" for name, values in self.values.items())
            raise self.fault(f"line {self.lines[i]}: {rule}, got {row} in SI")


def table_of(text: str, source: str, columns: Sequence[Column], reading: Reading, said: str = "") -> Table:
    """The columns in a text, and one warning of what was guessed, with what is `said` already.

    Raises ValueError with all faults, the first lines as read, and what to give with the file.
    """
    names = [column.name for column in columns]
    _require_known("units", reading.units, names, (str,))
    _require_known("columns", reading.columns, names, (str, int))
    lines = lines_of(text, None if reading.skip is None else count("skip", reading.skip, 0))
    found = _found_in(lines, partial(Table, source, text, columns, reading), separators_of(text), source)
    if not found:
        example = ", ".join(one.example for one in columns if one.needed)
        raise fault(source, f"holds no table; a header such as {example}, and a row a measurement")
    table = _chosen(found, source, reading.table)
    block, header = table.block, table.header
    if header.faults:
        raise table.refusal(header.faults)
    if (more := len(table.names.cells) - block.width) > 0 and block.separator == " ":
        header.said.append(f"rows have {block.width} cells, the header {more} more, which are taken for the last")
    values, faults = _values_of(table)
    if faults:
        raise ValueError("\n".join(_first(faults, source)))
    left = _left_out(found, table, lines) if reading.table is None else ""
    if guesses := [*filter(None, [said, *header.said, left])]:
        warn_outside(one_line(f"{source}: {'; '.join(guesses)}"))
    table.values = {one.column.name: _scaled(values[one.column.name], one) for one in header.places}
    return table


def csv_text(columns: Mapping[str, Any]) -> str:
    """A header of names, and a line for each row of columns of one length; numbers read back as they were."""
    told = [(one if isinstance(one, str) else f"{one:.17g}" for one in column) for column in columns.values()]
    out = StringIO()
    csv.writer(out, lineterminator="\n").writerows([columns, *zip(*told, strict=True)])
    return out.getvalue()


# --- tables ---

MOST_ABOVE = 10_000  #: letters above a table in which words may tell of it


def _found_in(lines: list[Line], of: Callable[..., Table], separators: Sequence[str], source: str) -> list[Table]:
    """The tables, cut by the separator with which one fits best; none where there is no row."""
    best: tuple[Any, str] | None = None
    for part in (lines[:SEARCHED], lines):
        for separator in separators:
            ranks = [one.rank for one in _with_headers(blocks(part, separator), of)]
            if ranks and (best is None or max(ranks) > best[0]):
                best = max(ranks), separator
        if best is not None and any(best[0][:3]):  # all is there, or a table
            break
    every = progress(lines, f"reading {source}", "lines")
    found = [] if best is None else _with_headers(blocks(every, best[1]), of)
    sound = [one for one in found if one.is_whole or one.block.is_table]
    return sound or sorted(found, key=lambda one: one.rank, reverse=True)[:1]


def _with_headers(found_blocks: Sequence[Block], of: Callable[..., Table]) -> list[Table]:
    """The tables, each with the best of the headers that it may have."""
    found: dict[int, Table] = {}
    above = ""
    for block in found_blocks:
        above = " ".join([above, *(line.text for line in block.above)])[-MOST_ABOVE:]
        named = found.get(id(block.named))
        tried = [of(block, names, above) for names in ([named.names] if named else block.names())]
        found[id(block)] = max(tried, key=lambda one: one.fits)
    return list(found.values())


def _chosen(found: Sequence[Table], source: str, table: int | str | None) -> Table:
    """The table that is named, or the only one that has what is needed."""
    whole = [one for one in found if one.is_whole]
    if table is None:
        taken = whole if len(whole) > 1 else [max(found, key=lambda one: one.rank)]
    elif isinstance(table, str):
        taken = [one for one in found if any(table.casefold() in line.text.casefold() for line in one.block.above)]
    else:
        taken = [found[count("table", table, 1) - 1]] if table <= len(found) else []
    if len(taken) == 1:
        return taken[0]
    numbers = [k for k, one in enumerate(found, start=1) if table is not None or one.is_whole]
    what = "holds" if table is None else f"table={repr_of(table)} names {'several' if taken else 'none'} of"
    told = "; ".join(first_of([f"table={k}, {found[k - 1].block.told}" for k in numbers]))
    refused = fault(source, f"{what} {len(numbers)} tables, choose one: {told}")
    raise ValueError(f"{refused}\n  to read it as it is: table=...")


def _left_out(found: Sequence[Table], chosen: Table, lines: Sequence[Line]) -> str:
    """Lines that are not read, though they have numbers or stand below the table."""
    place = found.index(chosen)
    said = [f"{one.block.told}, are another table and left out" for one in found[:place] if one.block.is_table]
    if remarks := chosen.block.remarks:
        more = f" and {len(remarks) - 1} more" if len(remarks) > 1 else ""
        said.append(f"line {remarks[0].number}, {short(remarks[0].text)},{more} is a comment and left out")
    if chosen.block.rows[-1].number < lines[-1].number:
        below = lines[bisect(lines, chosen.block.rows[-1])]
        said.append(f"line {below.number}, {short(below.text)}, and what follows is left out")
    return "; ".join(said)


def _first(faults: Sequence[str], source: str) -> list[str]:
    """The first faults, a line each, and how many more there are."""
    return [one_line(f"{source}: {one}") for one in first_of(faults)]


# --- values ---


def _scaled(values: Sequence[float], place: Place) -> Array:
    """The values in the unit of the library; with a warning where their size is hardly meant."""
    column = place.column
    found = converted(np.array(values), place.unit or column.unit, column.unit)
    greatest = float(np.max(np.abs(found[np.isfinite(found)]), initial=0.0))
    said = f"{column.name}, read in {place.unit}," if place.unit else column.name
    warn_of_size(said, greatest, column.likely, column.unit)
    return found


def warn_of_size(name: str, greatest: float, likely: tuple[float, float], unit: str) -> None:
    """Warn of a greatest value that is hardly meant."""
    low, high = likely
    if greatest and not low <= greatest <= high:
        limit = f"below {shown(low, unit)}" if greatest < low else f"above {shown(high, unit)}"
        warn_outside(f"{name} is at most {shown(greatest, unit)}, {limit}: is the unit right?")


def _require_known(name: str, given: Mapping[str, Any] | None, known: Sequence[str], kinds: tuple[type, ...]) -> None:
    if given is None:
        return
    if not isinstance(given, Mapping) or not all(isinstance(one, kinds) for one in given.values()):
        example = f'{{"{known[0]}": ...}}'
        what = "words, or numbers from 1" if int in kinds else "words"
        raise TypeError(f"{name} must be a dict from columns to {what}, {example}, got {short(repr(given))}")
    if strange := [one for one in given if one not in known]:
        raise ValueError(f"{name}: {short(str(strange[0]))} is no column; there are {', '.join(known)}")


def _values_of(table: Table) -> tuple[dict[str, Sequence[float]], list[str]]:
    """The numbers of each column, and what is wrong with cells and rows."""
    block, header = table.block, table.header
    heads, places = table.names.width, header.places
    numbered = all(str(header.called.get(one.column.name)).isdigit() for one in places)
    exact = block.separator == " "
    width = block.width if numbered or not heads or (exact and heads > block.width) else heads
    least, whose = min(block.width, heads or block.width), "most rows" if width == block.width else "the header"
    rows = [block.cells(line) for line in block.rows]
    comma = "; if a comma is the decimal mark, separate them by ;" if block.separator == "," else ""
    faults = [
        f"line {line.number}: has {len(row)} cells, {whose} {width}{comma if len(row) > width else ''}"
        for line, row in zip(block.rows, rows, strict=True)
        if len(row) < least or (len(row) != width and (exact or any(row[width:])))
    ]
    columns = {one.column: [row[one.at] if one.at < len(row) else "" for row in rows] for one in places}
    mark, wrong = decimal_mark(chain(*columns.values()))
    faults += [wrong] if wrong else []
    texts = {one: list(map(with_point, cells)) if mark == "," else cells for one, cells in columns.items()}
    return {one.name: _numbers(cells, one, block.rows, faults) for one, cells in texts.items()}, faults


def _numbers(cells: Sequence[str], column: Column, rows: Sequence[Line], faults: list[str]) -> Sequence[float]:
    """The numbers in the cells of a column; NaN for what is none, which is added to the faults."""
    with suppress(ValueError):
        found = list(map(float, cells))
        if np.all(np.isfinite(found)) and not any("_" in cell for cell in cells):
            return found
    return [_number(cell, column, row, faults) for cell, row in zip(cells, rows, strict=True)]


def _number(cell: str, column: Column, row: Line, faults: list[str]) -> float:
    if column.empty is not None and cell.strip().casefold() in ("", "inf", "infinity", "∞"):
        return column.empty
    try:
        return number_in(cell)
    except ValueError as wrong:
        faults.append(f"line {row.number}: {wrong} (column {column.name})")
        return math.nan
