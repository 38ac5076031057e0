"""A study without its values: axes, quantities, and the case, version and identity it was made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.files.case_files import written
from mdr.files.toml_text import CaseFileError
from mdr.studies.axes import Axis, without_addresses
from mdr.studies.quantities import CurveQuantity, Quantity
from mdr.studies.work import Work
from mdr.tools import version


@dataclass(frozen=True)
class Column:
    """Name, unit and meaning of one quantity."""

    name: str
    unit: str  #: "-" for a pure number
    meaning: str

    @classmethod
    def of(cls, quantity: Quantity | CurveQuantity) -> Column:
        """The column of a quantity."""
        return cls(quantity.name, quantity.unit, quantity.meaning)


@dataclass(frozen=True)
class Frame:
    """A study without its values."""

    grid: tuple[Axis, ...]  #: in the order of the arrays' axes
    columns: tuple[Column, ...]
    case: str  #: what the axes vary, as the text of a case file where one can carry it
    version: str  #: of mdr
    identity: str  #: SHA-256 of the specification; "" where it has none
    selected: tuple[tuple[str, str], ...] = ()  #: paths and values that `Study.select` has fixed

    @property
    def shape(self) -> tuple[int, ...]:
        """How many values each axis has."""
        return tuple(len(axis) for axis in self.grid)

    @classmethod
    def of(cls, work: Work, identity: str) -> Frame:
        """The frame of the study that this work makes."""
        columns = tuple(Column.of(one) for one in work.quantities)
        return cls(work.axes, columns, _text(work.case, work.held), version.__version__, identity)

    def tree(self) -> dict[str, Any]:
        """All but the numbers of its axes, for JSON."""
        labels = {axis.path: list(axis.labels) for axis in self.grid if not axis.is_numeric}
        columns = [asdict(column) for column in self.columns]
        return {"labels": labels, "columns": columns, "case": self.case, "version": self.version}

    @classmethod
    def from_head(cls, head: Mapping[str, Any]) -> Frame:
        """The frame in the head of a store, with labels for records."""
        tree, numbers = head["frame"], head["specification"]["axes"]
        grid = tuple(_axis(path, tree["labels"].get(path), numbers) for path in head["specification"]["order of axes"])
        columns = tuple(Column(**column) for column in tree["columns"])
        return cls(grid, columns, tree["case"], tree["version"], head["identity"])


def _axis(path: str, labels: list[str] | None, numbers: Mapping[str, Any]) -> Axis:
    if labels is not None:
        return Axis(path, tuple(labels), tuple(labels))
    return Axis(path, np.array(numbers[path], dtype=float))


def _text(case: SlidingContact, held: Mapping[str, float]) -> str:
    try:
        return written(case, held)
    except CaseFileError:
        return without_addresses(repr(case))
