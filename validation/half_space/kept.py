"""Rows of dataclasses kept as CSV, one file a table, with what made them in its head, and read again."""

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar, get_args, get_type_hints

from mdr.tools.provenance import commented, versions

FOLDER = Path(__file__).with_name("tables")
R = TypeVar("R")


def write(name: str, rows: Sequence[Any], made: str) -> Path:
    """Keep rows as FOLDER/name.csv; the fields of their points are columns, and so are their own."""
    FOLDER.mkdir(exist_ok=True)
    path = FOLDER / f"{name}.csv"
    with path.open("w", newline="", encoding="utf-8") as file:
        file.write(commented(made, versions()))
        table = csv.writer(file, lineterminator="\n")
        _, of_point, own = _columns(type(rows[0]))
        table.writerow([*of_point, *own])
        for row in rows:
            values = [*(getattr(row.point, name) for name in of_point), *(getattr(row, name) for name in own)]
            table.writerow([f"{value:.7g}" if isinstance(value, float) else value for value in values])
    return path


def read(name: str, kind: type[R]) -> list[R]:
    """The rows of FOLDER/name.csv."""
    point, of_point, own = _columns(kind)
    with (FOLDER / f"{name}.csv").open(newline="", encoding="utf-8") as file:
        table = csv.DictReader(line for line in file if not line.startswith("#"))
        return [kind(point(**_some(of_point, values)), **_some(own, values)) for values in table]


def _columns(kind: Any) -> tuple[Any, dict[str, Any], dict[str, Any]]:
    """The class of the points of rows, the types of its fields by their names, and those of the rows' own."""
    own = get_type_hints(kind)
    point = own.pop("point")
    return point, get_type_hints(point), own


def _some(columns: Mapping[str, Any], values: Mapping[str, str]) -> dict[str, Any]:
    return {name: _parsed(kind, values[name]) for name, kind in columns.items()}


def _parsed(kind: Any, text: str) -> Any:
    """A value as it was written."""
    if kind is bool:
        return text == "True"
    if get_args(kind):  # float | None
        return _parsed(get_args(kind)[0], text) if text else None
    return kind(text)
