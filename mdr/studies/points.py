"""Values of the points of consecutive units, with a status and a reason for each."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from enum import IntEnum
from threading import Event
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.friction.cof_curve import cof_curve
from mdr.studies.axes import without_addresses
from mdr.studies.quantities import CurveQuantity, Quantity
from mdr.studies.velocities import velocities_of
from mdr.studies.work import Work
from mdr.tools.arrays import Array
from mdr.tools.messages import one_line
from mdr.tools.progress import silent
from mdr.tools.records import ArrayRecord

#: what ends a point alone; a lack of memory, a broken disk or an unknown name end the sweep
OF_THE_POINT = (ValueError, TypeError, ArithmeticError, LookupError, AttributeError, AssertionError, RuntimeError)
SLOW = 60.0  #: seconds from which on a case, at all its velocities, is said to have taken long
LONGEST_REASON = 240  #: characters


class Status(IntEnum):
    """How the computation of a point ended."""

    DONE = 0  #: every quantity is there
    UNSETTLED = 1  #: a run did not settle; its numbers are there
    FAILED = 2  #: at least one quantity is missing, NaN
    MISSING = 3  #: not computed yet


class Ended(Exception):
    """Raised to end a sweep before its work is done."""


@dataclass(frozen=True, eq=False, repr=False)
class Part(ArrayRecord):
    """The outcome of n consecutive points."""

    values: Array  #: (n_quantities, n), NaN where there is none
    status: NDArray[np.uint8]  #: (n,), see Status
    reason: NDArray[np.int32]  #: (n,), which of the reasons
    reasons: tuple[str, ...]  #: distinct; the first is "", none
    slow: tuple[float, ...] = ()  #: seconds of each unit of work that took more than SLOW; not kept in a store


def compute(work: Work, start: int, stop: int, ended: Event | None = None) -> Part:
    """The points of units start <= unit < stop. Raises Ended soon after the event is set."""

    def watch() -> None:
        if ended is not None and ended.is_set():
            raise Ended

    seconds: list[float] = []
    parts: list[tuple[Array, NDArray[np.uint8], list[str]]] = []
    with silent(watch):
        known: _Case | None = None
        for unit in range(start, stop):
            watch()
            if known is None or unit % work.layout.blocks == 0:
                known = _Case.of(work, unit)
            begin = time.monotonic()
            parts.append(known.points(work, work.layout.velocities(unit)))
            seconds.append(time.monotonic() - begin)
    whys = [why for _, _, of_unit in parts for why in of_unit]
    reasons = {"": 0}
    codes = [reasons.setdefault(why, len(reasons)) for why in whys]
    return Part(
        values=np.concatenate([values for values, _, _ in parts], axis=1),
        status=np.concatenate([status for _, status, _ in parts]),
        reason=np.array(codes, dtype=np.int32),
        reasons=tuple(reasons),
        slow=tuple(one for one in seconds if one > SLOW),
    )


@dataclass
class _Case:
    """One case, and what is the same at all its velocities."""

    case: SlidingContact | None
    why: str  #: what keeps it from being built
    constants: dict[str, float] = field(default_factory=dict)
    failures: dict[str, str] = field(default_factory=dict)

    @classmethod
    def of(cls, work: Work, unit: int) -> _Case:
        try:
            made = cls(work.case_of(unit), "")
        except OF_THE_POINT as error:
            return cls(None, reason_of(error))
        assert made.case is not None
        for one in work.quantities:
            if isinstance(one, Quantity) and not one.per_velocity:
                try:
                    made.constants[one.name] = _number(one.of(made.case))
                except OF_THE_POINT as error:
                    made.failures[one.name] = f"{one.name}: {reason_of(error)}"
        return made

    def points(self, work: Work, part: slice) -> tuple[Array, NDArray[np.uint8], list[str]]:
        """Values (n_quantities, n), status and reason of the points at a part of the velocities."""
        points = _Points(work.quantities, part.stop - part.start)
        if self.case is None:
            points.fail(slice(None), self.why)
            return points.outcome()
        for name, value in self.constants.items():
            points.rows[name][:] = value
        for why in self.failures.values():
            points.fail(slice(None), why)
        axis = work.velocity_axis
        if axis is not None and any(one.per_velocity for one in work.quantities):
            try:
                v_0 = velocities_of(self.case, axis.path, np.asarray(axis.values)[part])
            except OF_THE_POINT as error:
                points.fail(slice(None), reason_of(error))
                return points.outcome()
            self._fill(work, v_0, points)
        return points.outcome()

    def _fill(self, work: Work, v_0: Array, points: _Points) -> None:
        """The quantities that depend on the velocity."""
        assert self.case is not None
        of_curve = [one for one in work.quantities if isinstance(one, CurveQuantity)]
        own = [one for one in work.quantities if isinstance(one, Quantity) and one.per_velocity]
        if of_curve:
            self._fill_curves(work, of_curve, v_0, points)
        for one in own:
            for j, v in enumerate(v_0.tolist()):
                try:
                    points.rows[one.name][j] = _number(one.of(self.case, v))
                except OF_THE_POINT as error:
                    points.fail(slice(j, j + 1), f"{one.name}: {reason_of(error)}")

    def _fill_curves(self, work: Work, wanted: list[CurveQuantity], v_0: Array, points: _Points) -> None:
        """All velocities together; if one of them fails, each for itself."""
        case = self.case
        assert case is not None

        def curve_at(part: slice) -> None:
            curve = cof_curve(
                case,
                v_0[part],
                n_springs=work.n_springs,
                steps_per_period=work.steps_per_period,
                accuracy=work.accuracy,
            )
            for one in wanted:
                points.rows[one.name][part] = one.of(case, curve)
            for j in np.flatnonzero(~curve.settled):
                points.unsettle(part.start + int(j), curve.why[j])

        try:
            curve_at(slice(0, v_0.size))
        except OF_THE_POINT:
            for j in range(v_0.size):
                try:
                    curve_at(slice(j, j + 1))
                except OF_THE_POINT as error:
                    points.fail(slice(j, j + 1), reason_of(error))


class _Points:
    """The points of one unit while they are filled in."""

    def __init__(self, quantities: tuple[Quantity | CurveQuantity, ...], n: int) -> None:
        self.values = np.full((len(quantities), n), np.nan)
        self.rows = {one.name: row for one, row in zip(quantities, self.values, strict=True)}
        self.status = np.full(n, Status.DONE, dtype=np.uint8)
        self.whys: list[list[str]] = [[] for _ in range(n)]

    def fail(self, part: slice, why: str) -> None:
        self.status[part] = Status.FAILED
        for whys in self.whys[part]:
            whys.append(why)

    def unsettle(self, j: int, why: str) -> None:
        self.status[j] = max(int(self.status[j]), Status.UNSETTLED)
        self.whys[j].append(why or "the run did not settle")

    def outcome(self) -> tuple[Array, NDArray[np.uint8], list[str]]:
        return self.values, self.status, [one_line("; ".join(whys), LONGEST_REASON) for whys in self.whys]


def reason_of(error: BaseException) -> str:
    """An error in one line: in its own words where these are meant for readers."""
    told = str(error) if isinstance(error, ValueError | TypeError) and str(error) else ""
    return without_addresses(one_line(told or f"{type(error).__name__}: {error}".rstrip(": "), LONGEST_REASON))


def _number(value: Any) -> float:
    """A number that a quantity returned; infinite is an answer, NaN is none."""
    number = float(value)
    if np.isnan(number):
        raise ValueError("is not a number")
    return number
