"""Values of the points of consecutive units, with a status and a reason for each."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from threading import Event
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.friction.cof_curve import cof_at
from mdr.studies.axes import without_addresses
from mdr.studies.quantities import CurveQuantity
from mdr.studies.work import Work
from mdr.tools.arrays import Array
from mdr.tools.messages import one_line
from mdr.tools.progress import silent, unless
from mdr.tools.status import Status

#: what ends a point alone; a lack of memory, a broken disk or an unknown name end the sweep
OF_THE_POINT = (ValueError, TypeError, ArithmeticError, LookupError, AttributeError, AssertionError, RuntimeError)


@dataclass
class Points:
    """Values of n points, how each ended, and why."""

    values: Array  #: (n_quantities, n), NaN where there is none
    status: NDArray[np.uint8]  #: (n,), see Status
    why: NDArray[np.object_]  #: (n,), "" where there is nothing to say

    @classmethod
    def blank(cls, n_quantities: int, n: int, status: Status) -> Points:
        """Points without values that all ended in one way."""
        return cls(np.full((n_quantities, n), np.nan), np.full(n, status, np.uint8), np.full(n, "", object))

    def __getitem__(self, part: slice) -> Points:
        """Some of the points; what is written there is written here."""
        return Points(self.values[:, part], self.status[part], self.why[part])

    def put(self, other: Points) -> None:
        """Take over other points, or one point for all."""
        self.values[:], self.status[:], self.why[:] = other.values, other.status, other.why

    def end(self, status: Status, why: str) -> None:
        """Say how they ended; a worse end stands."""
        self.status[:] = np.maximum(self.status, status)
        self.why[:] = [one_line(f"{known}; {why}" if known else why) for known in self.why]

    @contextmanager
    def failing(self, name: str = "") -> Iterator[None]:
        """What is done inside fails these points alone, with the quantity's name ahead of the reason."""
        try:
            yield
        except OF_THE_POINT as error:
            self.end(Status.FAILED, f"{name}: {reason_of(error)}" if name else reason_of(error))


def compute(work: Work, units: range, ended: Event | None = None) -> Points:
    """The points of some units. Raises Ended soon after the event is set."""
    layout, watch = work.layout, unless(ended or Event())
    where = layout.points(units)
    found = Points.blank(len(work.quantities), where.stop - where.start, Status.DONE)
    case, known, n = None, found, 0
    with silent(watch):
        for unit in units:
            watch()
            velocities = layout.velocities(unit)
            if unit == units.start or velocities.start == 0:
                case, known = _known(work, unit)
            points = found[n : n + velocities.stop - velocities.start]
            n += points.status.size
            points.put(known)
            if case is not None and work.moves:
                _fill(work, case, unit, points)
    return found


def _known(work: Work, unit: int) -> tuple[SlidingContact | None, Points]:
    """The case of a unit, None where it cannot be built, and what is the same at all its velocities."""
    case, known = None, Points.blank(len(work.quantities), 1, Status.DONE)
    with known.failing():
        case = work.case_of(unit)
        for row, one in enumerate(work.quantities):
            if not one.per_velocity:
                with known.failing(one.name):
                    known.values[row] = _number(one.of(case))
    return case, known


def _fill(work: Work, case: SlidingContact, unit: int, points: Points) -> None:
    """The quantities that depend on the velocity: of curves at all of them together; if one fails, at each."""
    moving = [(row, one) for row, one in enumerate(work.quantities) if one.per_velocity]
    if not moving:
        return
    with points.failing():
        v_0 = work.v_0_of(unit, case)
        each = [(v_0[j : j + 1], points[j : j + 1]) for j in range(v_0.size)]
        try:
            _fill_curves(work, case, v_0, points)
        except OF_THE_POINT:
            for v, point in each:
                with point.failing():
                    _fill_curves(work, case, v, point)
        for row, one in moving:
            if not isinstance(one, CurveQuantity):
                for v, point in each:
                    with point.failing(one.name):
                        point.values[row] = _number(one.of(case, v.item()))


def _fill_curves(work: Work, case: SlidingContact, v_0: Array, points: Points) -> None:
    wanted = [(row, one) for row, one in enumerate(work.quantities) if isinstance(one, CurveQuantity)]
    if not wanted:
        return
    curve = cof_at(case, v_0, closely=any(one.closely for _, one in wanted), **work.knobs)
    for row, one in wanted:
        points.values[row] = one.of(case, curve)
    for j in np.flatnonzero(~curve.settled).tolist():
        points[j : j + 1].end(Status.UNSETTLED, curve.why[j] or "the run did not settle")


def reason_of(error: BaseException) -> str:
    """An error in one line: in its own words where these are meant for readers."""
    told = str(error) if isinstance(error, ValueError | TypeError) and str(error) else ""
    return without_addresses(one_line(told or f"{type(error).__name__}: {error}".rstrip(": ")))


def _number(value: Any) -> float:
    """A number that a quantity returned; infinite is an answer, NaN is none."""
    number = float(value)
    if np.isnan(number):
        raise ValueError("is not a number")
    return number
