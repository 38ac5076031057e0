"""Tables as CSV: columns with units that people write or instruments export, values in SI, or what is wrong.

    # sphere on rubber
    r [um], height [nm], note
    0, 0.2, tip
    1, 0.9,

A header names the columns, each with its unit in brackets (`csv_header`); lines above it, the separator and a row of
units are found (`csv_layout`), and a decimal comma where no number can be read otherwise. Columns may stand in any
order, beside others. What is wrong is told all at once, with the first lines as read and what to give with the file.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping, Sequence
from io import StringIO
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from mdr.tools.arrays import Array
from mdr.tools.atomic_write import write_whole
from mdr.tools.checks import count
from mdr.tools.csv_header import Column, Header, Place, fault
from mdr.tools.csv_layout import Layout, Line, is_like_number, layouts, likely, lines_of, told_separator
from mdr.tools.messages import MOST_TOLD, one_line, short
from mdr.tools.notation import converted, decimal_mark, number_in, shown, with_point
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
    first_lines: str  #: header and first rows as they were read

    def fault(self, what: str) -> ValueError:
        """The error of this file."""
        return fault(self.source, what)

    def lacks(self, what: str, example: str, *wanted: str) -> ValueError:
        """The error of a header that names none of several columns; a file that has them all would be read so."""
        more = [one for one in self.header.columns if one.name in wanted]
        return _refusal(self.source, [f"the header names {what}; write {example}"], self.first_lines, self.header, more)


def table_of(text: str, source: str, columns: Sequence[Column], reading: Reading, said: str = "") -> Table:
    """The columns in a text, and one warning of what was guessed, with what is `said` already.

    Raises ValueError with all faults, the first lines as read, and what to give with the file.
    """
    names = [column.name for column in columns]
    _require_known("units", reading.units, names, (str,))
    _require_known("columns", reading.columns, names, (str, int))
    skip = None if reading.skip is None else count("skip", reading.skip, 0)
    layout, header = _layout_of(text, source, columns, reading._replace(skip=skip))
    first_lines = _as_read(layout)
    if header.faults:
        raise _refusal(source, header.faults, first_lines, header)
    rows, left_out = _without_footer(layout)
    cells, faults = _cells_of(rows, layout, header, source)
    mark, wrong = decimal_mark([cell for one in cells.values() for cell in one])
    faults = [*faults, *([f"{source}: {wrong}"] if wrong else [])]
    values = {}
    for place in header.places:
        values[place.column.name] = _numbers(cells[place.column.name], place.column, mark, rows, source, faults)
    if faults:
        raise ValueError("\n".join(_first(faults, source)))
    if guesses := [*filter(None, [said]), *header.said, *filter(None, [left_out])]:
        warn_outside(one_line(f"{source}: {'; '.join(guesses)}"))
    scaled = {place.column.name: _scaled(values[place.column.name], place) for place in header.places}
    return Table(source, scaled, tuple(row.number for row in rows), header, text, first_lines)


def csv_text(columns: Mapping[str, Any]) -> str:
    """A header of names, and a line for each row of columns of one length; numbers read back as they were."""
    told = [(one if isinstance(one, str) else f"{one:.17g}" for one in column) for column in columns.values()]
    out = StringIO()
    csv.writer(out, lineterminator="\n").writerows([columns, *zip(*told, strict=True)])
    return out.getvalue()


# --- lines ---


def _layout_of(text: str, source: str, columns: Sequence[Column], reading: Reading) -> tuple[Layout, Header]:
    """Where the table stands: where a header names what is needed, above numbers; else where most numbers are."""
    lines, told, called = lines_of(text, reading.skip), told_separator(text), reading.columns or {}

    def header_of(layout: Layout) -> Header:
        width = max(len(layout.heads), *(len(layout.cells(row)) for row in layout.rows[:1]))
        heads = [*layout.heads, *[""] * (width - len(layout.heads))]
        return Header(heads, layout.below, columns, reading.units or {}, called)

    numbered = bool(called) and all(str(one).isdigit() for one in called.values())
    if not numbered:
        for layout in layouts(lines, told, reading.skip):
            header = header_of(layout)
            if not header.faults and not header.said and _holds(layout, header):
                return layout, header
    found = [(layout, header_of(layout), score) for layout, score in likely(lines, told)]
    if not found:
        example = ", ".join(one.example for one in columns if one.needed)
        raise fault(source, f"holds no table; a header such as {example}, and a row a measurement")
    layout, header, _ = max(found, key=lambda one: (len(one[1].at), -len(one[1].faults), one[2]))
    if numbered and len(layout.heads) < len(layout.cells(layout.rows[0])):
        layout = layout._replace(heads=[], below=[], lines=layout.lines[layout.first :], first=0)
    return layout, header_of(layout)


def _holds(layout: Layout, header: Header) -> bool:
    """Whether the first row has a number for each column."""
    row = layout.cells(layout.rows[0])
    cells = [(place.column, row[place.at] if place.at < len(row) else "") for place in header.places]
    return bool(cells) and all(
        is_like_number(cell) or (column.empty is not None and not cell.strip()) for column, cell in cells
    )


def _without_footer(layout: Layout) -> tuple[list[Line], str]:
    """The rows without what stands below them, and what was left out."""
    rows = layout.rows
    end = next(
        (k for k in range(len(rows), 0, -1) if any(is_like_number(cell) for cell in layout.cells(rows[k - 1]))), 0
    )
    words = f"line {rows[end].number}, {short(rows[end].text)}, and what follows is left out" if end < len(rows) else ""
    return rows[:end], words


def _as_read(layout: Layout) -> str:
    """The lines down to the first row and one more, cells between bars."""
    above = layout.lines[: layout.first]
    cells = [(line, layout.heads if line is above[0] else layout.cells(line)) for line in above]
    cells += [(line, layout.cells(line)) for line in layout.rows[:2]]
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


def _cells_of(
    rows: Sequence[Line], layout: Layout, header: Header, source: str
) -> tuple[dict[str, list[str]], list[str]]:
    """The cells of each column, and what is wrong with rows that are too long."""
    found: dict[str, list[str]] = {place.column.name: [] for place in header.places}
    faults, width = [], len(layout.heads) or math.inf
    for line in rows:
        row = layout.cells(line)
        if len(row) > width and any(cell.strip() for cell in row[len(layout.heads) :]):
            what = f"has {len(row)} cells, the header {width}; if a comma is the decimal mark, separate them by ;"
            faults.append(f"{source}: line {line.number}: {what}")
        for place in header.places:
            found[place.column.name].append(row[place.at] if place.at < len(row) else "")
    return found, faults


def _numbers(
    cells: Sequence[str], column: Column, mark: str, rows: Sequence[Line], source: str, faults: list[str]
) -> list[float]:
    """The numbers in the cells of a column; NaN for what is none, which is added to the faults."""
    found = []
    for cell, row in zip(cells, rows, strict=True):
        if column.empty is not None and cell.casefold() in ("", "inf", "infinity", "∞"):
            found.append(column.empty)
            continue
        try:
            found.append(number_in(with_point(cell) if mark == "," else cell))
        except ValueError as wrong:
            found.append(math.nan)
            faults.append(one_line(f"{source}: line {row.number}: {wrong} (column {column.name})"))
    return found
