"""A study, finished or not: values with named axes, units, and the status of every point.

Its frame is the study without its values: axes, quantities, and the case, version and identity it was made of.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from io import BytesIO
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.files.case_files import written
from mdr.files.toml_text import CaseFileError
from mdr.plots.studies import DrawnStudy
from mdr.studies.axes import Axis, without_addresses
from mdr.studies.formats import packed
from mdr.studies.points import Points
from mdr.studies.work import Layout, Work
from mdr.tools import version
from mdr.tools.arrays import Array
from mdr.tools.atomic_write import write_whole
from mdr.tools.csv_table import Tabled, csv_text
from mdr.tools.messages import most_frequent, offer, short
from mdr.tools.records import ArrayRecord
from mdr.tools.status import Status
from mdr.tools.summary import Printed


@dataclass(frozen=True)
class Column:
    """Name, unit and meaning of one quantity."""

    name: str
    unit: str  #: "-" for a pure number
    meaning: str


@dataclass(frozen=True)
class Frame:
    """A study without its values."""

    grid: tuple[Axis, ...]  #: in the order of the arrays' axes
    columns: tuple[Column, ...]
    case: str  #: what the axes vary, as the text of a case file where one can carry it
    version: str  #: of mdr
    identity: str  #: SHA-256 of the specification; "" where it has none
    selected: tuple[tuple[str, str], ...]  #: paths and values that `Study.select` has fixed

    @property
    def shape(self) -> tuple[int, ...]:
        """How many values each axis has."""
        return tuple(len(axis) for axis in self.grid)


@dataclass(frozen=True, eq=False, repr=False)
class Study(Printed, Tabled, DrawnStudy, ArrayRecord, Frame):
    """A grid of cases: `study["cof"]` is an array whose axes follow the order of `study.axes`.

    A point that failed is NaN where it failed, says FAILED in `status`, and why in `why`; a run that did not settle
    keeps its numbers. Printing it tells how many there are of either.
    """

    values: Array  #: of shape ``(n_quantities, *shape)``, NaN where there is none
    status: NDArray[np.uint8]  #: of shape ``(*shape,)``, see `Status`: 0 done, 1 unsettled, 2 failed, 3 missing
    reason: NDArray[np.int32]  #: of shape ``(*shape,)``, which of the reasons
    reasons: tuple[str, ...] = ("",)  #: distinct, in the order of the points; the first is "", none

    def __getitem__(self, name: str) -> Array:
        """The values of a quantity, in its unit."""
        if name not in self.quantities:
            raise KeyError(f"the study has no quantity {name!r}; {offer(str(name), self.quantities)}")
        values: Array = self.values[self.quantities.index(name)]
        return values

    @property
    def quantities(self) -> tuple[str, ...]:
        """Names of the quantities."""
        return tuple(column.name for column in self.columns)

    @property
    def axes(self) -> dict[str, Array | tuple[Any, ...]]:
        """The values of every axis by its path, in the order of the arrays' axes."""
        return {axis.path: axis.values for axis in self.grid}

    @property
    def units(self) -> dict[str, str]:
        """Units of axes and quantities, "-" for a pure number, "" where there is none."""
        units = {axis.path: axis.unit for axis in self.grid}
        return units | {column.name: column.unit for column in self.columns}

    @property
    def why(self) -> NDArray[np.object_]:
        """Why a point failed or did not settle, "" where there is nothing to say; of shape ``(*shape,)``."""
        return np.array(self.reasons, dtype=object)[self.reason]

    @property
    def complete(self) -> bool:
        """Whether every point was computed, however it ended."""
        return not bool(np.any(self.status == Status.MISSING))

    def count(self, status: Status) -> int:
        """Number of points that ended in one way.

        Parameters
        ----------
        status : Status
            DONE, UNSETTLED, FAILED or MISSING.

        Returns
        -------
        int
            How many.
        """
        return int(np.count_nonzero(self.status == status))

    def select(self, values: Mapping[str, Any]) -> Study:
        """The part of the study at given values of some of its axes.

        Parameters
        ----------
        values : mapping of str to object
            One value for each path, {path: value}. Each must be a value of its axis.

        Returns
        -------
        Study
            Without these axes.

        Raises
        ------
        KeyError
            For a path that is no axis.
        ValueError
            For a value that is not there.
        """
        if not isinstance(values, Mapping):
            raise TypeError(f"values must map paths to values, got {short(repr(values))}")
        if unknown := [path for path in values if path not in self.axes]:
            raise KeyError(f"{unknown[0]!r} is no axis of the study; there are {', '.join(self.axes)}")
        fixed = {axis.path: axis.index(values[axis.path]) for axis in self.grid if axis.path in values}
        where = tuple(fixed.get(axis.path, slice(None)) for axis in self.grid)
        told = tuple((axis.path, axis.told(fixed[axis.path])) for axis in self.grid if axis.path in fixed)
        grid = tuple(axis for axis in self.grid if axis.path not in fixed)
        frame = Frame(grid, self.columns, self.case, self.version, self.identity, self.selected + told)
        return study_of(frame, self.values[(slice(None), *where)], self.status[where], self.why[where])

    def to_netcdf(self, path: str | PathLike[str]) -> None:
        """Write NetCDF (classic, 64-bit offsets), with labelled axes, units, status and reasons.

        Parameters
        ----------
        path : str or path-like
            The file.
        """
        write_whole(Path(path), packed(self))

    def table(self) -> str:
        """The study as CSV, one row for each point, with units in the header; numbers have all their digits.

        Returns
        -------
        str
            What `to_csv` writes.
        """
        places = np.indices(self.shape).reshape(len(self.grid), self.status.size)
        columns = {(axis.path, axis.unit): map(axis.told, at) for axis, at in zip(self.grid, places, strict=True)}
        for column, values in zip(self.columns, self.values, strict=True):
            columns[column.name, column.unit] = map(repr, values.ravel().tolist())
        headed = {f"{name} [{unit}]" if unit else name: values for (name, unit), values in columns.items()}
        ends = (Status(status).name.lower() for status in self.status.ravel().tolist())
        return csv_text({**headed, "status": ends, "why": np.ravel(self.why).tolist()})

    def to_xarray(self) -> Any:
        """The study as an xarray.Dataset, as xarray opens the NetCDF file; needs the extra `xarray`.

        Returns
        -------
        xarray.Dataset
            Quantities with labelled axes and units.
        """
        try:
            import xarray
        except ImportError:
            raise ImportError("to_xarray needs xarray: pip install xarray") from None
        return xarray.load_dataset(BytesIO(packed(self)), engine="scipy")

    def __repr__(self) -> str:
        n = self.status.size
        names = ", ".join(f"{column.name} [{column.unit}]" for column in self.columns)
        size = " x ".join(map(str, self.shape)) or "1"
        lines = [f"Study of {n} points ({size}): {names}"]
        lines += [f"  {axis.path}{f' [{axis.unit}]' if axis.unit else ''}: {axis.summary}" for axis in self.grid]
        lines += [f"  at {path} = {value}" for path, value in self.selected]
        counts = [f"{self.count(status)} {status.name.lower()}" for status in Status if self.count(status)]
        return "\n".join(
            [*lines, f"  {', '.join(counts)}", *(f"    {one}" for one in most_frequent(np.ravel(self.why).tolist()))]
        )


def frame_of(work: Work, identity: str) -> Frame:
    """The frame of the study that this work makes."""
    columns = tuple(Column(one.name, one.unit, one.meaning) for one in work.quantities)
    return Frame(work.axes, columns, _text(work.case, work.held), version.__version__, identity, ())


def tree_of(frame: Frame) -> dict[str, Any]:
    """All but the numbers of its axes, for JSON."""
    labels = {axis.path: list(axis.labels) for axis in frame.grid if not axis.is_numeric}
    columns = [asdict(column) for column in frame.columns]
    return {"labels": labels, "columns": columns, "case": frame.case, "version": frame.version}


def frame_in(head: Mapping[str, Any]) -> Frame:
    """The frame in the head of a store, with labels for records."""
    tree, known = head["frame"], head["specification"]
    values = {**known["axes"], **tree["labels"]}
    grid = tuple(Axis.known(path, values[path]) for path in known["order of axes"])
    columns = tuple(Column(**column) for column in tree["columns"])
    return Frame(grid, columns, tree["case"], tree["version"], head["identity"], ())


def study_of_points(frame: Frame, layout: Layout, points: Points) -> Study:
    """The study of all points in the order of the work."""
    return study_of(frame, *(layout.in_place(each) for each in (points.values, points.status, points.why)))


def study_of(frame: Frame, values: Array, status: NDArray[np.uint8], why: Any) -> Study:
    """A study of these arrays in the order of its axes, with its reasons in the order of its points."""
    why = np.asarray(why, dtype=object)
    codes = {reason: code for code, reason in enumerate(dict.fromkeys(["", *why.flat]))}
    reason = np.array([codes[one] for one in why.flat], dtype=np.int32).reshape(why.shape)
    values, status = np.array(values, order="C"), np.array(status, dtype=np.uint8, order="C")
    return Study(**vars(frame), values=values, status=status, reason=reason, reasons=tuple(codes))


def _text(case: SlidingContact, held: Mapping[str, Any]) -> str:
    try:
        return written(case, held)
    except CaseFileError:
        return without_addresses(repr(case))
