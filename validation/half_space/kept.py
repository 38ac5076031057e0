"""Rows of dataclasses kept as CSV, one file a table, with what made them in its head, and read again."""

import csv
from collections.abc import Sequence
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any, TypeVar, get_args, get_type_hints

from mdr.tools.provenance import commented, versions

FOLDER = Path(__file__).with_name("tables")
R = TypeVar("R")


def write(name: str, rows: Sequence[Any], made: str) -> Path:
    """Keep rows as FOLDER/name.csv; a field that is a dataclass is spread over columns of its own."""
    FOLDER.mkdir(exist_ok=True)
    path = FOLDER / f"{name}.csv"
    with path.open("w", newline="", encoding="utf-8") as file:
        file.write(commented(made, versions()))
        table = csv.writer(file, lineterminator="\n")
        table.writerow(_spread(type(rows[0])))
        for row in rows:
            table.writerow([f"{value:.7g}" if isinstance(value, float) else value for value in _values(row)])
    return path


def read(name: str, kind: type[R]) -> list[R]:
    """The rows of FOLDER/name.csv."""
    with (FOLDER / f"{name}.csv").open(newline="", encoding="utf-8") as file:
        table = csv.DictReader(line for line in file if not line.startswith("#"))
        return [_row(kind, values) for values in table]


def _spread(kind: Any) -> list[str]:
    """Names of the columns."""
    hints = get_type_hints(kind)
    return [
        name
        for field in fields(kind)
        for name in (_spread(hints[field.name]) if is_dataclass(hints[field.name]) else [field.name])
    ]


def _values(row: Any) -> list[Any]:
    own = [getattr(row, field.name) for field in fields(row)]
    return [value for one in own for value in (_values(one) if is_dataclass(one) else [one])]


def _row(kind: Any, values: dict[str, str]) -> Any:
    hints = get_type_hints(kind)
    own = ((hints[field.name], field.name) for field in fields(kind))
    return kind(*(_row(of, values) if is_dataclass(of) else _parsed(of, values[name]) for of, name in own))


def _parsed(kind: Any, text: str) -> Any:
    """A value as it was written."""
    if kind is bool:
        return text == "True"
    if get_args(kind):  # float | None
        return _parsed(get_args(kind)[0], text) if text else None
    return kind(text)
