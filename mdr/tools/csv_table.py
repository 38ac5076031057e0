"""Tables as CSV: columns with units that people write or instruments export, values in SI, or what is wrong.

    # sphere on rubber
    r [um], height [nm], note
    0, 0.2, tip
    1, 0.9,

The first line that is no comment names the columns, each with its unit in brackets. They may stand in any order, beside
others; commas, semicolons or tabs separate them. What is wrong is told with its line, and with what to write instead.
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
from mdr.tools.messages import one_line, short
from mdr.tools.notation import in_unit, is_number, listed, number_in, scale_of

_HEAD = re.compile(r"(?P<name>.*?)\s*(?:[\[(](?P<unit>[^\])\[(]*)[\])]|\s*/\s*(?P<other>\S.*))?")


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
        Path(path).write_text(self.table(), encoding="utf-8")

    def to_dataframe(self) -> Any:
        """The table as a pandas.DataFrame, with units in the names of its columns; needs pandas.

        Returns
        -------
        pandas.DataFrame
            A row for each line of `table()`.
        """
        return data_frame(self.table())


def data_frame(text: str) -> Any:
    """A CSV text with a header as a pandas.DataFrame. Raises ImportError with a command where pandas is missing."""
    try:
        import pandas
    except ImportError:
        way_out = "python3 -m pip --python .venv install -e '.[xarray]'"
        raise ImportError(f"to_dataframe needs pandas, which comes with xarray: {way_out}") from None
    return pandas.read_csv(StringIO(text), keep_default_na=False, na_values=["nan"], engine="python")


class Column(NamedTuple):
    """A column that is looked for."""

    name: str  #: in the library
    names: tuple[str, ...] = ()  #: other names that a header may give it; case, spaces and underscores do not matter
    unit: str = "-"  #: of the library, a key of `UNITS`
    needed: bool = True
    bare: bool = False  #: whether a header without a unit means that of the library
    empty: float | None = None  #: what an empty cell, or inf, stands for; None refuses them


class Table(NamedTuple):
    """The columns that were found."""

    source: str  #: name of the file
    values: dict[str, Array]  #: each column (n,) in the unit of the library
    lines: tuple[int, ...]  #: where each row stands in the file

    def fault(self, what: str) -> ValueError:
        """The error of this file."""
        return fault(self.source, what)


def table_of(
    text: str,
    source: str,
    columns: Sequence[Column],
    *,
    units: Mapping[str, str] | None = None,
    called: Mapping[str, str] | None = None,
) -> Table:
    """The columns in a text; `units` of columns whose header has none, and what a file has `called` them."""
    names = [column.name for column in columns]
    _require_known("units", units, names)
    _require_known("columns", called, names)
    lines = _lines(text, source, columns)
    separator = max(",;\t", key=lines[0][1].count)
    rows = [cells_of(line, f"{source}: line {number}", separator) for number, line in lines]
    found = _places(source, rows[0], columns, units or {}, called or {})
    values: dict[str, list[float]] = {column.name: [] for column, _, _ in found}
    for (number, _), row in zip(lines[1:], rows[1:], strict=True):
        where = f"{source}: line {number}"
        if any(cell.strip() for cell in row[len(rows[0]) :]):
            what = f"has {len(row)} cells, the header {len(rows[0])}; if a comma is the decimal mark, write a point"
            raise fault(where, what)
        for column, place, _ in found:
            values[column.name].append(_number(row[place] if place < len(row) else "", column, where))
    scaled = {column.name: in_unit(np.array(values[column.name]), scale) for column, _, scale in found}
    return Table(source, scaled, tuple(number for number, _ in lines[1:]))


def csv_text(columns: Mapping[str, Any]) -> str:
    """A header of names, and a line for each row of columns of one length; numbers read back as they were."""
    told = [[one if isinstance(one, str) else f"{one:.17g}" for one in column] for column in columns.values()]
    lines = [",".join(row) for row in zip(*told, strict=True)]
    return "\n".join([",".join(columns), *lines]) + "\n"


def cells_of(line: str, where: str, separator: str = ",") -> list[str]:
    """The cells of one line; a quote that is left open ends with it. Raises ValueError, naming `where` it stands."""
    try:
        return next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
    except csv.Error as wrong:
        raise fault(where, str(wrong)) from None


def fault(where: str, what: str) -> ValueError:
    """The error of one line, whatever the file holds."""
    return ValueError(one_line(f"{where}: {what}"))


# --- lines ---


def _lines(text: str, source: str, columns: Sequence[Column]) -> list[tuple[int, str]]:
    """The header and the rows, each with its number. A header may be the last comment before a row of numbers."""
    lines = [(number, line) for number, line in enumerate(text.splitlines(), start=1) if line.strip(" \t,;")]
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
    units = {"m": "um", "m/s": "mm/s", "rad/s": "Hz", "Pa": "MPa"}
    return ", ".join(
        one.name + (f" [{units.get(one.unit, one.unit)}]" if one.unit != "-" else "") for one in columns if one.needed
    )


# --- the header ---


def _places(
    source: str, cells: list[str], columns: Sequence[Column], units: Mapping[str, str], called: Mapping[str, str]
) -> list[tuple[Column, int, float]]:
    """Each column that is there, where it stands, and its unit in that of the library."""
    heads, found = [_split(cell.strip()) for cell in cells], []
    text = short(", ".join(cell.strip() for cell in cells), 120)
    for column in columns:
        own = called.get(column.name)
        wanted = {_plain(one) for one in ((own,) if own else (column.name, *column.names))}
        places = [i for i, (name, _, whole) in enumerate(heads) if {_plain(name), _plain(whole)} & wanted]
        if len(places) > 1:
            raise fault(source, f"the header names {column.name} twice: {text}")
        if places:
            name, unit, _ = heads[places[0]]
            written = unit if _plain(name) in wanted else ""
            found.append((column, places[0], _scale(source, column, written, units.get(column.name))))
        elif column.needed or own:
            way_out = "columns= must name one of these" if own else f"write {_example(columns)}"
            if len(cells) == 1 and not own:
                way_out = f"columns are separated by commas, semicolons or tabs; {way_out}"
            raise fault(source, f"the header names no {own or column.name}: {text}; {way_out}")
    return found


def _scale(source: str, column: Column, written: str, given: str | None) -> float:
    """The unit in the header, or the one given beside the file, in that of the library."""
    name, unit = column.name, column.unit
    what, scales = "", {one: scale_of(one, unit) for one in (written, given) if one is not None}
    if given is not None and scales[given] is None:
        what = f"units: {name} = {short(repr(given))} is none of {listed(unit)}"
    elif written and scales[written] is None and unit == "-":
        what = f"{name} is a pure number, got the unit {short(written)!r}"
    elif written and scales[written] is None:
        what = f"the unit {short(written)!r} of {name} is none of {listed(unit)}: {_example([column])}"
    elif written and given is not None and scales[written] != scales[given]:
        what = f"the header gives {name} in {written}, units= in {given}; give one"
    elif not (written or given or column.bare or unit == "-"):
        what = f"{name} needs a unit in its header, one of {listed(unit)}: {_example([column])}"
    if what:
        raise fault(source, what)
    return scales.get(written or given or "") or 1.0  # of a bare column


def _split(head: str) -> tuple[str, str, str]:
    """Name, unit and whole of a head: "r [um]", "r (um)" or "r / um"."""
    found = _HEAD.fullmatch(head)
    if found is None:
        return head, "", head
    return found["name"], (found["unit"] or found["other"] or "").strip(" ()"), head


def _plain(name: str) -> str:
    """A name without what does not matter in it."""
    same = {"′": "'", "″": "''", "´": "'", '"': "''", "’": "'", "_": "", " ": "", "-": "", "µ": "μ"}
    return "".join(same.get(letter, letter) for letter in name.casefold())


def _require_known(name: str, given: Mapping[str, str] | None, known: Sequence[str]) -> None:
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
