"""Tables as CSV: columns with units that people write or instruments export, values in SI, or what is wrong.

    # sphere on rubber
    r [um], height [nm], note
    0, 0.2, tip
    1, 0.9,

The first line that is no comment names the columns, each with its unit in brackets (`csv_header`). They may stand in
any order, beside others; commas, semicolons or tabs separate them, or what a first line such as `sep=;` says. What is
wrong is told with its line, and with what to write instead.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping, Sequence
from io import StringIO
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from mdr.tools.arrays import Array
from mdr.tools.atomic_write import write_whole
from mdr.tools.csv_header import Column, Header, Place, fault
from mdr.tools.messages import short
from mdr.tools.notation import UNITS, converted, is_number, number_in, scale_of, shown
from mdr.tools.warned import warn_outside

Words = Mapping[str, str] | None  #: by columns


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
            way_out = "python3 -m pip --python .venv install -e '.[xarray]'"
            raise ImportError(f"to_dataframe needs pandas, which comes with xarray: {way_out}") from None
        return pandas.read_csv(StringIO(self.table()), keep_default_na=False, na_values=["nan"], engine="python")


class Table(NamedTuple):
    """The columns that were found."""

    source: str  #: name of the file
    values: dict[str, Array]  #: each column (n,) in the unit of the library
    lines: tuple[int, ...]  #: where each row stands in the file
    header: str = ""  #: its text
    hint: str = ""  #: to columns that the header may have under other names

    def fault(self, what: str) -> ValueError:
        """The error of this file."""
        return fault(self.source, what)

    def lacks(self, name: str, example: str) -> ValueError:
        """The error of a header that names none of several columns."""
        return self.fault(f"the header names {name}: {self.header}; write {example}{self.hint}")


def table_of(text: str, source: str, columns: Sequence[Column], *, units: Words = None, called: Words = None) -> Table:
    """The columns in a text; `units` of columns whose header has none, and what a file has `called` them."""
    names = [column.name for column in columns]
    _require_known("units", units, names)
    _require_known("columns", called, names)
    lines = _lines(text, source, columns)
    separator = _told_separator(text) or _separator(lines, source)
    rows = [cells_of(line, f"{source}: line {number}", separator) for number, line in lines]
    header = Header(rows[0], columns, units or {}, called or {})
    try:
        found = header.places()
    except ValueError as refusal:
        raise fault(source, _elsewhere(lines, header) or str(refusal)) from None
    values: dict[str, list[float]] = {one.column.name: [] for one in found}
    for (number, _), row in zip(lines[1:], rows[1:], strict=True):
        where = f"{source}: line {number}"
        if any(cell.strip() for cell in row[len(rows[0]) :]):
            what = f"has {len(row)} cells, the header {len(rows[0])}; if a comma is the decimal mark, write a point"
            raise fault(where, what)
        if number == lines[1][0] and (written := _with_units(rows[0], row)):
            raise fault(where, f"holds units: write them into the header, {', '.join(written)}, and take the line out")
        for column, place, _ in found:
            values[column.name].append(_number(row[place] if place < len(row) else "", column, where))
    scaled = {one.column.name: _scaled(values[one.column.name], one) for one in found}
    return Table(source, scaled, tuple(number for number, _ in lines[1:]), header.text, header.left(found))


def csv_text(columns: Mapping[str, Any]) -> str:
    """A header of names, and a line for each row of columns of one length; numbers read back as they were."""
    told = [(one if isinstance(one, str) else f"{one:.17g}" for one in column) for column in columns.values()]
    out = StringIO()
    csv.writer(out, lineterminator="\n").writerows([columns, *zip(*told, strict=True)])
    return out.getvalue()


def cells_of(line: str, where: str, separator: str = ",") -> list[str]:
    """The cells of one line; a quote that is left open ends with it. Raises ValueError, naming `where` it stands."""
    try:
        return next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
    except csv.Error as wrong:
        raise fault(where, str(wrong)) from None


# --- lines ---


def _lines(text: str, source: str, columns: Sequence[Column]) -> list[tuple[int, str]]:
    """The header and the rows, each with its number. A header may be the last comment before a row of numbers."""
    first = 1 + bool(_told_separator(text))
    lines = [(n, line) for n, line in enumerate(text.splitlines(), start=1) if n >= first and line.strip(" \t,;")]
    rows = [(number, line) for number, line in lines if not line.lstrip().startswith("#")]
    if rows and all(is_number(cell) for cell in re.split(r"[,;\s]+", rows[0][1].strip(" \t,;"))):
        comments = [(number, line) for number, line in lines if number < rows[0][0]]
        if not comments:
            raise fault(f"{source}: line {rows[0][0]}", f"numbers, where a header must be: {_example(columns)}")
        rows.insert(0, (comments[-1][0], comments[-1][1].lstrip(" \t#")))
    if len(rows) < 2:
        raise fault(source, f"holds no table; a header such as {_example(columns)}, and a row a measurement")
    return rows


def _example(columns: Sequence[Column]) -> str:
    """A header as it is meant."""
    return ", ".join(one.example for one in columns if one.needed)


def _told_separator(text: str) -> str:
    """What a first line such as `sep=;` of Excel says; empty without one."""
    told = re.match(r'"?sep=([^\w"\r\n])"?[,;\t]*\r?$', text, re.IGNORECASE | re.MULTILINE)
    return told[1] if told else ""


def _separator(lines: Sequence[tuple[int, str]], source: str) -> str:
    """What cuts header and first row into equally many cells; else what stands most often in the header."""

    def counts(separator: str) -> list[int]:
        return [len(cells_of(line.rstrip(" ,;\t"), f"{source}: line {n}", separator)) for n, line in lines[:2]]

    several = {one: found for one in ",;\t" if (found := counts(one))[0] > 1}
    even = [one for one, found in several.items() if found[0] == found[1]]
    return max(even or several or ",", key=lines[0][1].count)


def _elsewhere(lines: Sequence[tuple[int, str]], header: Header) -> str:
    """Where a header stands below the first line, or its units do below it; empty where neither does."""
    # a header may stand below 99 lines
    for k, (number, line) in enumerate(lines[: min(99, len(lines) - 1)]):
        separator = _separator(lines[k : k + 2], "")
        cells, below = (cells_of(one, "", separator) for one in (line, lines[k + 1][1]))
        written = _with_units(cells, below)
        for one in (cells, written) if k else (written,):
            try:
                Header(one, header.columns, header.units, header.called).places()
            except ValueError:
                continue
            above = f"line {number} looks like the header: take the lines above it out, or begin them with #"
            own = f"line {lines[k + 1][0]} holds units: write {', '.join(written)} and take it out" if written else ""
            return "; ".join(filter(None, (above if k else "", own)))
    return ""


def _with_units(cells: Sequence[str], below: Sequence[str]) -> list[str]:
    """The cells of a header with the units in the row below; empty where that is no row of units."""
    units = [one.strip(" []()") for one in below]
    known = {one for unit in UNITS for one in units if one and scale_of(one, unit) is not None}
    if not known or any(one not in known for one in units if one) or any(map(is_number, known)):
        return []
    return [f"{cell.strip()} [{unit}]" if unit else cell.strip() for cell, unit in zip(cells, units, strict=False)]


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


def _require_known(name: str, given: Words, known: Sequence[str]) -> None:
    if given is None:
        return
    if not isinstance(given, Mapping) or not all(isinstance(one, str) for pair in given.items() for one in pair):
        example = f'{{"{known[0]}": ...}}'
        raise TypeError(f"{name} must be a dict from columns to words, {example}, got {short(repr(given))}")
    if strange := [one for one in given if one not in known]:
        raise ValueError(f"{name}: {short(strange[0])} is no column; there are {', '.join(known)}")


def _number(cell: str, column: Column, where: str) -> float:
    if column.empty is not None and cell.strip().casefold() in ("", "inf", "infinity", "∞"):
        return column.empty
    try:
        return number_in(cell)
    except ValueError as wrong:
        raise fault(where, f"{wrong} (column {column.name})") from None
