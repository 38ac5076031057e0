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
from collections.abc import Mapping, Sequence
from contextlib import suppress
from io import StringIO
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.tools.arrays import Array
from mdr.tools.atomic_write import write_whole
from mdr.tools.checks import count
from mdr.tools.csv_header import Column, Header, Place, fault, repr_of
from mdr.tools.csv_layout import (
    FAR,
    SEARCHED,
    SEPARATORS,
    Block,
    Line,
    Names,
    bare,
    blocks,
    filled,
    is_like_number,
    lines_of,
    numbers_at_once,
    share_of_numbers,
    told_separator,
)
from mdr.tools.messages import MOST_TOLD, one_line, short
from mdr.tools.notation import converted, decimal_mark, number_in, shown, with_point
from mdr.tools.progress import progress
from mdr.tools.warned import warn_outside

Units = Mapping[str, str] | None  #: of columns whose header has none
Columns = Mapping[str, str | int] | None  #: name or number, from 1, of columns; "" leaves one out


class Tabled:
    """Base of records that write themselves as CSV, or as a data frame; they answer `table()`."""

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

    def to_dataframe(self) -> Any:
        """The table as a pandas.DataFrame, with units in the names of its columns; needs pandas.

        Returns
        -------
        pandas.DataFrame
            A row for each line of `table()`.
        """
        try:
            import pandas
        except ImportError:
            raise ImportError("to_dataframe needs pandas: pip install pandas") from None
        return pandas.read_csv(StringIO(self.table()), keep_default_na=False, na_values=["nan"], engine="python")


class Reading(NamedTuple):
    """What is said of a file beside its text."""

    units: Units = None
    columns: Columns = None
    skip: int | None = None  #: lines above the header; None finds it
    table: int | str | None = None  #: which table of the file, from 1, or words of a line above it; None: the only one


class Table(NamedTuple):
    """The columns that were found."""

    source: str  #: name of the file
    values: dict[str, Array]  #: each column (n,) in the unit of the library
    lines: tuple[int, ...]  #: where each row stands in the file
    header: Header
    text: str  #: of the file
    reading: Reading
    first_lines: str  #: header and first rows as they were read

    def fault(self, what: str) -> ValueError:
        """The error of this file."""
        return fault(self.source, what)

    def lacks(self, what: str, example: str, *wanted: str) -> ValueError:
        """The error of a header that names none of several columns; a file that has them all would be read so."""
        more = [one for one in self.header.columns if one.name in wanted]
        named = f"the header names {what}; write {example}{self.header.others(more)}"
        return _refusal(self.source, [named], self.first_lines, self.header, more)

    def one_of(self, kinds: Sequence[Sequence[Column]], lack: str, example: str, *wanted: str) -> Sequence[Column]:
        """The only one of some kinds of columns that the file has. Refused where it has several, or `lack` says."""
        names = [[one.name for one in kind if one.name in self.values] for kind in kinds]
        if not any(names):
            raise self.lacks(lack, example, *wanted)
        _, *others = there = [*filter(None, names)]
        if others:
            without = ", ".join(f'{repr_of(name)}: ""' for kind in others for name in kind)
            raise self.fault(f"{' and '.join(kind[0] for kind in there)}: leave one out, columns={{{without}}}")
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


class Found(NamedTuple):
    """A table with the header that fits it best."""

    block: Block
    names: Names
    header: Header
    is_whole: bool  #: whether all that is needed is there, with numbers below

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
        return whole, sound, self.block.is_table, aligned, *counts, *share_of_numbers(self.block)

    @property
    def told(self) -> str:
        """Where it stands, below which words."""
        title = self.block.title
        below = f', below "{short(title)}"' if title else ""
        return f"lines {self.block.rows[0].number} to {self.block.rows[-1].number}{below}"


def table_of(text: str, source: str, columns: Sequence[Column], reading: Reading, said: str = "") -> Table:
    """The columns in a text, and one warning of what was guessed, with what is `said` already.

    Raises ValueError with all faults, the first lines as read, and what to give with the file.
    """
    names = [column.name for column in columns]
    _require_known("units", reading.units, names, (str,))
    _require_known("columns", reading.columns, names, (str, int))
    skip = None if reading.skip is None else count("skip", reading.skip, 0)
    lines = lines_of(text, skip)
    found = _found_in(lines, told_separator(text), source, columns, reading)
    chosen = _chosen(found, source, reading.table)
    block, header = chosen.block, chosen.header
    first_lines = _as_read(chosen)
    if header.faults:
        raise _refusal(source, header.faults, first_lines, header)
    if (more := len(chosen.names.cells) - block.width) > 0 and block.separator == " ":
        header.said.append(f"rows have {block.width} cells, the header {more} more, which are taken for the last")
    values, faults = _values_of(chosen, source)
    if faults:
        raise ValueError("\n".join(_first(faults, source)))
    left = _left_out(found, chosen, lines) if reading.table is None else ""
    if guesses := [*filter(None, [said]), *header.said, *filter(None, [left])]:
        warn_outside(one_line(f"{source}: {'; '.join(guesses)}"))
    scaled = {place.column.name: _scaled(values[place.column.name], place) for place in header.places}
    return Table(source, scaled, tuple(row.number for row in block.rows), header, text, reading, first_lines)


def csv_text(columns: Mapping[str, Any]) -> str:
    """A header of names, and a line for each row of columns of one length; numbers read back as they were."""
    told = [(one if isinstance(one, str) else f"{one:.17g}" for one in column) for column in columns.values()]
    out = StringIO()
    csv.writer(out, lineterminator="\n").writerows([columns, *zip(*told, strict=True)])
    return out.getvalue()


# --- tables ---

MOST_ABOVE = 10_000  #: letters above a table in which words may tell of it


def _found_in(lines: list[Line], told: str, source: str, columns: Sequence[Column], reading: Reading) -> list[Found]:
    """The tables, cut by the separator with which one fits best."""
    best: tuple[Any, str] | None = None
    for part in (lines[:SEARCHED], lines):
        for separator in told or SEPARATORS:
            ranks = [one.rank for one in _with_headers(blocks(part, separator), columns, reading)]
            if ranks and (best is None or max(ranks) > best[0]):
                best = max(ranks), separator
        if best is not None and any(best[0][:3]):  # all is there, or a table
            break
    if best is None:
        example = ", ".join(one.example for one in columns if one.needed)
        raise fault(source, f"holds no table; a header such as {example}, and a row a measurement")
    found = _with_headers(_cut(lines, best[1], source), columns, reading)
    return [one for one in found if one.is_whole or one.block.is_table] or [max(found, key=lambda one: one.rank)]


def _cut(lines: list[Line], separator: str, source: str) -> list[Block]:
    """The tables of all lines, at once where the last one goes on to the end as it begins."""
    if len(lines) > SEARCHED and (tables := blocks(lines[:SEARCHED], separator)):
        last = tables[-1]
        rows = lines[lines.index(last.rows[0]) :]
        last.numbers = numbers_at_once(rows, separator, f"reading {source}")
        if last.numbers is not None and last.numbers.shape[1] == last.width:
            last.rows = rows
            return tables
    return blocks(progress(lines, f"reading {source}", "lines"), separator)


def _with_headers(tables: Sequence[Block], columns: Sequence[Column], reading: Reading) -> list[Found]:
    """The tables, each with the best of the headers that it may have."""
    found: dict[int, Found] = {}
    above = ""
    for block in tables:
        above = " ".join([above, *(line.text for line in block.above)])[-MOST_ABOVE:]
        row, of = block.cells(block.rows[0]), found.get(id(block.named))
        ways = [of.names] if of else block.names()
        tried = [_with_header(block, names, row, columns, reading, above) for names in ways]
        found[id(block)] = max(tried, key=lambda one: one.fits)
    return list(found.values())


def _with_header(
    block: Block, names: Names, row: Sequence[str], columns: Sequence[Column], reading: Reading, above: str
) -> Found:
    """A table with one header."""
    heads = [*names.cells, *[""] * (len(row) - len(names.cells))]
    header = Header(heads, names.units, columns, reading.units or {}, reading.columns or {}, above)
    top = math.inf if names.line is None else names.line.number
    for line in block.above[-FAR:]:
        if line.number > top and not line.is_comment and bare(block.heads(line)) != names.units:
            if any(map(is_like_number, block.cells(line))):
                header.faults.append(f"line {line.number}, {short(line.text)}, between header and rows is no row")
            elif any(map(str.isalnum, line.text)):
                header.said.append(f"line {line.number}, {short(line.text)}, between header and rows is left out")
    return Found(block, names, header, not header.faults and _holds(row, header))


def _holds(row: Sequence[str], header: Header) -> bool:
    """Whether the first row has a number for each column."""
    cells = [(place.column, row[place.at] if place.at < len(row) else "") for place in header.places]
    return bool(cells) and all(
        is_like_number(cell) or (column.empty is not None and not cell.strip()) for column, cell in cells
    )


def _chosen(found: Sequence[Found], source: str, table: int | str | None) -> Found:
    """The table that is named, or the only one that has what is needed."""
    whole = [one for one in found if one.is_whole]
    if table is None:
        if len(whole) < 2:
            return max(found, key=lambda one: one.rank)
        taken = whole
    elif isinstance(table, str):
        taken = [one for one in found if any(table.casefold() in line.text.casefold() for line in one.block.above)]
    else:
        taken = [found[count("table", table, 1) - 1]] if table <= len(found) else []
    if len(taken) == 1:
        return taken[0]
    numbers = [k for k, one in enumerate(found, start=1) if table is not None or one.is_whole]
    what = "holds" if table is None else f"table={repr_of(table)} names {'several' if taken else 'none'} of"
    all_told = "; ".join(f"table={k}, {found[k - 1].told}" for k in numbers[:MOST_TOLD])
    more = f"; and {len(numbers) - MOST_TOLD} more" if len(numbers) > MOST_TOLD else ""
    raise ValueError(
        f"{one_line(f'{source}: {what} {len(numbers)} tables, choose one: {all_told}{more}')}\n"
        f"  to read it as it is: table=..."
    )


def _left_out(found: Sequence[Found], chosen: Found, lines: Sequence[Line]) -> str:
    """Lines that are not read, though they have numbers or stand below the table."""
    place = found.index(chosen)
    said = [f"{one.told}, are another table and left out" for one in found[:place] if one.block.is_table]
    if remarks := chosen.block.remarks:
        more = f" and {len(remarks) - 1} more" if len(remarks) > 1 else ""
        said.append(f"line {remarks[0].number}, {short(remarks[0].text)},{more} is a comment and left out")
    if chosen.block.rows[-1].number < lines[-1].number:
        below = lines[bisect(lines, chosen.block.rows[-1])]
        said.append(f"line {below.number}, {short(below.text)}, and what follows is left out")
    return "; ".join(said)


def _as_read(found: Found) -> str:
    """The header, what stands below it, the first row and one more, cells between bars."""
    block, header = found.block, found.names.line
    above = [line for line in block.above if header is not None and line.number >= header.number][:3]
    cells = [(line, found.names.cells if line is header else block.heads(line)) for line in above]
    if header is not None and header not in above:
        cells.insert(0, (header, found.names.cells))
    cells += [(line, block.cells(line)) for line in block.rows[:2]]
    return "\n".join(f"  {one_line(f'line {line.number}: ' + ' | '.join(row), 120)}" for line, row in cells)


def _refusal(
    source: str, faults: Sequence[str], first_lines: str, header: Header, more: Sequence[Column] = ()
) -> ValueError:
    """The error of a header: its faults, the first lines as they were read, and what to give with the file."""
    way_out = header.way_out(more)
    last = [f"  to read it as it is: {one_line(way_out)}"] if way_out else []
    return ValueError(
        "\n".join([*_first([one_line(f"{source}: {one}") for one in faults], source), first_lines, *last])
    )


def _first(faults: Sequence[str], source: str) -> list[str]:
    """The first faults, and how many more there are."""
    more = [f"{source}: and {len(faults) - MOST_TOLD} more"] if len(faults) > MOST_TOLD else []
    return [*faults[:MOST_TOLD], *more]


# --- values ---


def _scaled(values: Sequence[float] | Array, place: Place) -> Array:
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


def _values_of(found: Found, source: str) -> tuple[dict[str, Sequence[float] | Array], list[str]]:
    """The numbers of each column, and what is wrong with cells and rows."""
    block, places = found.block, found.header.places
    heads = len(filled(found.names.cells))
    numbered = all(str(found.header.called.get(one.column.name)).isdigit() for one in places)
    exact = block.separator == " "
    width = block.width if numbered or not heads or (exact and heads > block.width) else heads
    if block.numbers is not None and width >= block.width:
        return {one.column.name: block.numbers[:, one.at] for one in places}, []
    least, whose = min(block.width, heads or block.width), "most rows" if width == block.width else "the header"
    rows = [block.cells(line) for line in block.rows]
    comma = "; if a comma is the decimal mark, separate them by ;" if block.separator == "," else ""
    faults = [
        f"{source}: line {line.number}: has {len(row)} cells, {whose} {width}{comma if len(row) > width else ''}"
        for line, row in zip(block.rows, rows, strict=True)
        if len(row) < least or (len(row) != width and (exact or any(row[width:])))
    ]
    columns = [[row[one.at] if one.at < len(row) else "" for row in rows] for one in places]
    mark, wrong = decimal_mark(chain(*columns))
    faults += [f"{source}: {wrong}"] if wrong else []
    pairs = zip(places, columns, strict=True)
    return {
        one.column.name: _numbers(cells, one.column, mark, block.rows, source, faults) for one, cells in pairs
    }, faults


def _numbers(
    cells: Sequence[str], column: Column, mark: str, rows: Sequence[Line], source: str, faults: list[str]
) -> Sequence[float]:
    """The numbers in the cells of a column; NaN for what is none, which is added to the faults."""
    if mark == ",":
        cells = list(map(with_point, cells))
    with suppress(ValueError):
        found = list(map(float, cells))
        if np.all(np.isfinite(found)) and not any("_" in cell for cell in cells):
            return found
    return [_number(cell, column, row, source, faults) for cell, row in zip(cells, rows, strict=True)]


def _number(cell: str, column: Column, row: Line, source: str, faults: list[str]) -> float:
    if column.empty is not None and cell.strip().casefold() in ("", "inf", "infinity", "∞"):
        return column.empty
    try:
        return number_in(cell)
    except ValueError as wrong:
        faults.append(one_line(f"{source}: line {row.number}: {wrong} (column {column.name})"))
        return math.nan
