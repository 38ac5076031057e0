"""The search for the periodic state of a contact by shooting (shooting.py): which states it begins from, in the norm of
energy of springs, system spring and mass.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mdr.march.dynamics.dimensionless import ScaledContact
from mdr.march.dynamics.state import UNKNOWN, MarchState
from mdr.march.dynamics.stepper import AT_ONCE, Periods, Stepper
from mdr.march.periodic.period_map import map_of, on_other_springs
from mdr.march.periodic.settling import LATE, Settling
from mdr.march.periodic.shooting import SOLVED_TOLERANCE, Found, Shooting, SlowMotions
from mdr.tools.progress import time_is_over

SAME_GAIN = 0.25  #: gain times h², up to which it is known at another resolution too
MEMORY, MOST = 8, 80  #: periods that Anderson's method combines, and after which it gives up
A_TIME = (3, 20)  #: how many more of both each slow time of a material gets
UNCOMBINED = 3  #: periods marched before the first combination, while springs find their modes


@dataclass(frozen=True, eq=False)
class Orbit:
    """A periodic state that was found."""

    state: MarchState  #: at the end of the period that `period` tells of
    period: Periods
    settling: Settling
    least_slip: float = 0.0  #: in that period, the way of the pull, of springs that slip all the time
    motions: SlowMotions | None = None  #: the slow ones about it, where they are known


def search(
    stepper: Stepper,
    starts: tuple[MarchState, ...],
    gain: float | None = None,
    near: bool = False,
    motions: SlowMotions | None = None,
) -> Orbit | None:
    """The periodic state that a march would end in, from the first of the starts that leads to one; None else.

    gain: bound on the distance from the periodic state, divided by the change in one period, where it is known. near:
    whether the starts are periodic states themselves, found with other steps, springs or velocity. motions: the slow
    motions about them.
    """
    n_before, of = stepper.n_periods, map_of(stepper.scaled)._replace(v=stepper.v, tolerance=stepper.tolerance)
    at_once = max(1, AT_ONCE // stepper.scaled.drive.steps)
    memory, most = (one + more * of.n_slow for one, more in zip((MEMORY, MOST), A_TIME, strict=True))
    for begin in starts:
        plain, n_trace = 0 if near else UNCOMBINED, len(stepper.room[0])
        shooting = Shooting.begun(of, begin.x, n_trace, memory, plain, most, gain, motions)
        while not (shooting.ended or time_is_over()):
            stepper.count(shooting.go_on(at_once))
        motions = shooting.motions
        if (found := shooting.found) is not None:
            orbit = _orbit(found, begin, motions)
            if found.is_close or of.n_slow or orbit.settling.settled:  # waiting for slow motions takes far longer
                return orbit
    stepper.n_periods = n_before
    return None


def _orbit(found: Found, like: MarchState, motions: SlowMotions | None) -> Orbit:
    """The periodic state that a search has come to."""
    (cof,), _, (cof_y,) = (column.tolist() for column in found.period)
    if found.spread <= SOLVED_TOLERANCE and not found.late:
        settling = Settling(cof, found.spread, True, "periodic", found.gain, across=cof_y)
    else:
        why = LATE if found.late else "a periodic state was found, but not how far it may be from the exact one"
        spread = UNKNOWN if found.late else min(found.spread, UNKNOWN)
        settling = Settling(cof, spread, False, "unsettled", found.gain, why, across=cof_y)
    return Orbit(MarchState(found.state, like.s.copy()), found.period, settling, found.least_slip, motions)


def search_from_full_slip(stepper: Stepper) -> Orbit | None:
    """The periodic state from that of full slip, on a driven resonance from that of the body as stick limits it."""
    driven = stepper.resonant()
    return search(stepper, (*(() if driven is None else (driven,)), stepper.full_slip()))


def at_other_resolution(
    state: MarchState, motions: SlowMotions | None, of: ScaledContact, on: ScaledContact
) -> tuple[MarchState, SlowMotions | None]:
    """A state of a march with other springs or steps, and the slow motions about it, on those of this one."""
    xs, springs = state.x[None], map_of(of)
    if motions is not None:
        xs = np.concatenate([xs, motions.before, motions.after])
    if springs.gap.size != on.springs.gap.size or not np.array_equal(springs.gap, on.springs.gap):
        xs = on_other_springs(xs, springs.gap, springs.order, on.springs.gap, on.ways)
    if motions is not None:
        k = len(motions.before)
        motions = SlowMotions(xs[1 : 1 + k], xs[1 + k :])
    return MarchState(xs[0], on.normal.s.copy()), motions


def gain_at_other_resolution(gain: float | None, one: ScaledContact, other: ScaledContact) -> float | None:
    """The gain of a march with other springs or steps, whose multipliers differ by h²; None where that may be much."""
    h = max(one.drive.h, other.drive.h)
    return gain / (1 - gain * h**2) if gain is not None and gain * h**2 < SAME_GAIN else None
