"""Values of the points of consecutive units, with a status and a reason for each."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from enum import IntEnum
from threading import Event
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.closed_forms.critical_velocity import critical_velocity
from mdr.friction.cof_curve import cof_curve
from mdr.studies.axes import without_addresses
from mdr.studies.quantities import CurveQuantity, Quantity
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
    parts: list[_Points] = []
    with silent(watch):
        case: _Case | None = None
        for unit in range(start, stop):
            watch()
            begin = time.monotonic()
            if case is None or unit % work.layout.blocks == 0:
                case = _Case.of(work, unit)
            parts.append(case.points(work.layout.velocities(unit)))
            seconds.append(time.monotonic() - begin)
    reasons = {"": 0}
    whys = [one_line("; ".join(of_point), LONGEST_REASON) for points in parts for of_point in points.whys]
    codes = [reasons.setdefault(why, len(reasons)) for why in whys]
    return Part(
        values=np.concatenate([points.values for points in parts], axis=1),
        status=np.concatenate([points.status for points in parts]),
        reason=np.array(codes, dtype=np.int32),
        reasons=tuple(reasons),
        slow=tuple(one for one in seconds if one > SLOW),
    )


def velocities_of(case: SlidingContact, path: str, values: Array) -> Array:
    """Pulling velocities [m/s] of an axis "v_0" or "v_0/v_c" for this very case."""
    if path == "v_0":
        return values
    v_c = critical_velocity(case)
    if not 0 < v_c < np.inf:
        what = "zero" if v_c == 0 else "infinite, as on an undamped resonance"
        raise ValueError(f"v_0/v_c: the critical velocity of this case is {what}, so that its multiples say nothing")
    return values * v_c


class _Points:
    """The points of one unit while they are filled in."""

    def __init__(self, quantities: tuple[Quantity | CurveQuantity, ...], n: int) -> None:
        self.values = np.full((len(quantities), n), np.nan)
        self.rows = {one.name: row for one, row in zip(quantities, self.values, strict=True)}
        self.status = np.full(n, Status.DONE, dtype=np.uint8)
        self.whys: list[list[str]] = [[] for _ in range(n)]

    def end(self, part: slice, status: Status, why: str) -> None:
        """Say how points ended; a worse end stands."""
        self.status[part] = np.maximum(self.status[part], status)
        for whys in self.whys[part]:
            whys.append(why)

    def failing(self, part: slice, name: str = "") -> AbstractContextManager[None]:
        """What is done inside fails these points alone, with the quantity's name ahead of the reason."""
        return _caught(lambda why: self.end(part, Status.FAILED, why), name)


@dataclass
class _Case:
    """One case, and what is the same at all its velocities."""

    work: Work
    case: SlidingContact | None = None  #: None where it cannot be built
    constants: dict[str, float] = field(default_factory=dict)
    whys: list[str] = field(default_factory=list)  #: what keeps it, or one of these, from being there

    @classmethod
    def of(cls, work: Work, unit: int) -> _Case:
        made = cls(work)
        with _caught(made.whys.append):
            made.case = case = work.case_of(unit)
            for one in work.quantities:
                if isinstance(one, Quantity) and not one.per_velocity:
                    with _caught(made.whys.append, one.name):
                        made.constants[one.name] = _number(one.of(case))
        return made

    def points(self, part: slice) -> _Points:
        """The points at a part of the velocities."""
        points = _Points(self.work.quantities, part.stop - part.start)
        for why in self.whys:
            points.end(slice(None), Status.FAILED, why)
        for name, value in self.constants.items():
            points.rows[name][:] = value
        axis = self.work.velocity_axis
        if self.case is not None and axis is not None and any(one.per_velocity for one in self.work.quantities):
            with points.failing(slice(None)):
                v_0 = velocities_of(self.case, axis.path, np.asarray(axis.values)[part])
                self._fill(self.case, v_0, points)
        return points

    def _fill(self, case: SlidingContact, v_0: Array, points: _Points) -> None:
        """The quantities that depend on the velocity: of curves at all of them together; if one fails, at each."""
        try:
            self._fill_curves(case, v_0, slice(0, v_0.size), points)
        except OF_THE_POINT:
            for j in range(v_0.size):
                with points.failing(slice(j, j + 1)):
                    self._fill_curves(case, v_0, slice(j, j + 1), points)
        for one in self.work.quantities:
            if isinstance(one, Quantity) and one.per_velocity:
                for j, v in enumerate(v_0.tolist()):
                    with points.failing(slice(j, j + 1), one.name):
                        points.rows[one.name][j] = _number(one.of(case, v))

    def _fill_curves(self, case: SlidingContact, v_0: Array, part: slice, points: _Points) -> None:
        wanted = [one for one in self.work.quantities if isinstance(one, CurveQuantity)]
        if not wanted:
            return
        knobs = {name: getattr(self.work, name) for name in ("n_springs", "steps_per_period", "accuracy")}
        curve = cof_curve(case, v_0[part], **knobs)
        for one in wanted:
            points.rows[one.name][part] = one.of(case, curve)
        for j in np.flatnonzero(~curve.settled).tolist():
            own = slice(part.start + j, part.start + j + 1)
            points.end(own, Status.UNSETTLED, curve.why[j] or "the run did not settle")


@contextmanager
def _caught(tell: Callable[[str], None], name: str = "") -> Iterator[None]:
    """An error that ends a point alone is told, with a name ahead of it, and goes no further."""
    try:
        yield
    except OF_THE_POINT as error:
        tell(f"{name}: {reason_of(error)}" if name else reason_of(error))


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
