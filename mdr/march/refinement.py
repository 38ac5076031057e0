"""A run as accurate as is asked for: its companions, the bound on its error, more springs and steps until that is met.

A step is exact but for the parabolas that motion and body take in it, and a sum over Gauss nodes but for places where
the pattern of modes bends. Both errors fall by a factor of four and more where numbers are doubled, though not evenly.
So beside a run go two companions with half and with three quarters of its steps, and two more with half and with three
quarters of its springs. What they differ by bounds the error: the first by as much, the second by twice as much, so
that a companion that agrees by chance misleads no one. Where the bound is more than is asked for, steps or springs are
doubled.

A body without mass whose springs have dashpots is thrown as each of them touches, so that it needs several springs that
touch in a step. If all touch at once the error is of first order, and depends on where in a step that is: companions of
steps in no simple ratio are added.

Each run begins in the periodic state of one before it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.march.body import RESOLVED
from mdr.march.dimensionless import fast_ratio
from mdr.march.march import (
    BUDGET,
    MOST_BESIDE,
    Knobs,
    March,
    Steady,
    at_hand,
    check,
    looked_at,
    steady,
    too_coarse,
)
from mdr.march.run import SlidingRun, finish
from mdr.march.steady_state import TOLERANCE
from mdr.march.theorems import outside
from mdr.tools.progress import Ticker, time_is_over

ROUNDING = 1e-14  #: of cof/mu_0, up to which two runs have the same
MOST, MOST_KEPT = 10**6, 2e8  #: springs, or steps of a period; values of a record per array
N_SPRINGS, N_SPRINGS_SHAKEN = 32, 64  #: first choice; doubled while cof_error exceeds the accuracy asked for
N_STEPS = 64  #: the same of the steps of each period of the motion
N_STEPS_LIGHT = 128  #: the same of a body without mass
N_SPRINGS_JOLTS, N_STEPS_JOLTS = 128, 256  #: and of one on dashpots that lose contact
CUTS = 5  #: pieces of the row of springs at most, without kinks, of two springs at least (spring_grid.py)
MOST_SPRINGS, MOST_STEPS = 4096, 16384  #: that are chosen
MOST_JOLTS = 4096  #: steps of a motion whose error falls at first order only
COMPANIONS = ((0.5, 1.0), (0.75, 2.0))  #: share of steps or springs; what a difference to them counts as error
UNEVEN = (0.53, 0.61, 0.69, 0.83, 0.91)  #: shares of the steps of more companions where all springs touch at once
RINGING = 1.2  #: of the difference to a run that resolves the oscillation of the body, whose own error is small


def default_springs(case: SlidingContact) -> int:
    """Springs with which a search for the accuracy begins: half of them still serve all pieces of a kinked shape."""
    first = N_SPRINGS_JOLTS if _jolts(case) else N_SPRINGS_SHAKEN if case.is_shaken else N_SPRINGS
    return max(first, 4 * (len(case.indenter.kinks) + CUTS))


def default_steps(case: SlidingContact) -> int:
    """Steps per period with which a search for the accuracy begins: their half still resolves the oscillation of the
    body on the contact, if that can be afforded.
    """
    fast, plain = fast_ratio(case), min(N_STEPS * _oscillations(case), MOST_STEPS)
    if np.isinf(fast):
        return max(N_STEPS_JOLTS if _jolts(case) else N_STEPS_LIGHT, plain)
    return int(min(max(64 * np.ceil(2 * RESOLVED * fast * 1.01 / 64), plain), MOST_STEPS))


def _oscillations(case: SlidingContact) -> int:
    """Of the depth or of the shake in the period of the case, by the strongest harmonic."""
    motions = case.cycle.harmonics, case.shake_harmonics
    return max(1 + int(np.abs(motion).argmax()) for motion in motions if motion.size)


def _jolts(case: SlidingContact) -> bool:
    """Whether dashpots throw a body without mass, as each spring that touches presses with a jump."""
    return bool(np.isinf(fast_ratio(case)) and case.rheology.remembers and not case.keeps_contact)


class _Runs:
    """Runs of one case at one velocity with several knobs, each kept, and begun in a state that was found before."""

    def __init__(self, case: SlidingContact, v_0: float, near: Steady | None) -> None:
        self.case, self.v_0, self.near = case, v_0, near
        self.fast, self.jolts = fast_ratio(case), _jolts(case)
        self.ends: dict[Knobs, Steady] = {}
        self.ticker = Ticker("slide", parts="runs")

    def main(self, knobs: Knobs, most: int | None) -> Steady:
        """The end of a run that goes on until it settles, or for at most so many periods.

        The first one of a body begins where its coarsest companion has come to, which is found at a quarter of the
        cost.
        """
        if self.near is None and self.fast and knobs.start == "full_slip":
            coarsest = knobs.coarser(knobs.steps // 2, knobs.n_springs // 2)
            first = steady(self.case, self.v_0, coarsest, None, None, 1)
            if first.settling.solved and first.settling.settled:
                self.ends[coarsest] = self.near = first
        return self._at(knobs, None, most)

    def beside(self, main: Steady, knobs: Knobs) -> Steady:
        """The end of a companion: solved for by itself if the main run was, else of as many periods."""
        return self._at(knobs, None if main.settling.solved else main.n_periods, MOST_BESIDE)

    def _at(self, knobs: Knobs, n_periods: int | None, most: int | None) -> Steady:
        knobs = knobs._replace(record=0) if knobs.record else knobs
        if knobs not in self.ends:
            end = steady(self.case, self.v_0, knobs, n_periods, self.near, most)
            self.ends[knobs] = end
            self.ticker.what = (
                f"slide, refined for an error of {knobs.accuracy:g} mu_0, {knobs.n_springs} springs and {knobs.steps} "
                f"steps last"
            )
            self.ticker.tick()
            self.near = end if end.settling.solved and end.settling.settled else self.near
        return self.ends[knobs]


def check_size(n_springs: int, steps: int, record: int) -> None:
    """Refuse more springs, steps or periods of a record than memory holds."""
    if max(n_springs, steps) > MOST or n_springs * steps * record > MOST_KEPT:
        raise ValueError(
            f"n_springs = {n_springs}, steps_per_period = {steps}, record = {record} is more than memory "
            f"holds: at most {MOST} springs or steps, and {MOST_KEPT:g} values of a record"
        )


@dataclass(frozen=True)
class _Bounded:
    """A main run, the bound on the numerical error of its COF, over mu_0."""

    main: Steady
    error: float

    def looked_at(self, record: int) -> March:
        """The run after a close look, with so many periods kept; one beyond a theorem by more than its error is not
        called settled.
        """
        check_size(self.main.knobs.n_springs, self.main.knobs.steps, record)
        march = looked_at(replace(self.main, knobs=self.main.knobs._replace(record=record)))
        why = outside(march.cof, -1.0, self.error + march.settling.spread + TOLERANCE)
        return march.contradicted(why) if march.settling.settled and why else march

    def finished(self, record: int) -> SlidingRun:
        """The run in SI, with so many periods kept."""
        return finish(self.looked_at(record), self.error)


def within(
    case: SlidingContact, v_0: float, knobs: Knobs, free: tuple[bool, bool], near: Steady | None = None
) -> tuple[SlidingRun, Steady]:
    """A run with its companions, and its end; what was left free, springs and steps, is refined until the error is
    within knobs.accuracy. near: the end of a run at a velocity close by.
    """
    check(case, v_0)
    runs, best = _Runs(case, v_0, near), None
    knobs = _that_touch(case, knobs, free[1])
    while True:
        main = runs.main(knobs, None if best is None or case.pull.is_rigid else MOST_BESIDE)
        if not main.settling.settled:  # finer steps make a state that hardly repeats harder to find
            best = best or _Bounded(main, 0.0)
            return best.finished(knobs.record), best.main
        share, off_load = knobs.accuracy / 2, main.off_load
        if main.slips_fully and (off_load <= share or not any(free)) and (march := _clear_of_stick(runs, main)):
            return _Bounded(main, 0.0).finished(knobs.record) if knobs.record else finish(march), main
        of_steps, of_springs = _of_steps(runs, main), _of_springs(runs, main)
        if time_is_over():
            if best is None:
                why = "the time limit is over before the runs beside it, which bound cof_error, were done"
                unknown = replace(main.settling, settled=False, kind="unsettled", why=why)
                best = _Bounded(replace(main, settling=unknown), 0.0)
            return best.finished(knobs.record), best.main
        best = _Bounded(main, of_steps + of_springs)
        most_steps = MOST_JOLTS if runs.jolts else MOST_STEPS
        hidden = runs.jolts and main.slips_fully  # a jump of the force stops the body in steps that are short enough
        more_springs = free[0] and knobs.n_springs < MOST_SPRINGS and max(of_springs, off_load) > share
        more_steps = free[1] and knobs.steps < most_steps and (of_steps > share or hidden)
        met = best.error + main.settling.spread + main.missing_load <= knobs.accuracy
        awaited = not main.scaled.rigid and not main.settling.solved
        repeats = main.settling.spread <= max(knobs.accuracy, best.error) / 4  # else finer runs bound no better
        if (met and not (hidden and more_steps)) or awaited or not (more_springs or more_steps) or not repeats:
            return best.finished(knobs.record), main
        if more_springs:
            knobs = knobs._replace(n_springs=min(2 * knobs.n_springs, MOST_SPRINGS))
        if more_steps:
            knobs = knobs._replace(steps=min(2 * knobs.steps, most_steps))


def _that_touch(case: SlidingContact, knobs: Knobs, free: bool) -> Knobs:
    """The knobs, with more steps where they are free and the contact too brief for those of companions."""
    while not case.keeps_contact and not at_hand(case, knobs.coarser(knobs.steps // 2))[1].normal.mean > 0:
        if not free or knobs.steps >= MOST_STEPS:
            raise too_coarse(knobs.steps)
        knobs = knobs._replace(steps=2 * knobs.steps)
    return knobs


def _of_steps(runs: _Runs, main: Steady) -> float:
    """Bound on what the steps miss of the COF, over mu_0."""
    steps = main.knobs.steps
    at_once = runs.jolts and main.scaled.gap.size == 1
    companions = (*COMPANIONS, *((share, 2.0) for share in UNEVEN)) if at_once else COMPANIONS
    beside = [(runs.beside(main, main.knobs.coarser(int(share * steps))), weight) for share, weight in companions]
    return max(weight * _missed(main, one) for one, weight in beside) + _of_unresolved(runs, main)


def _of_springs(runs: _Runs, main: Steady) -> float:
    """Bound on what the springs miss of the COF, over mu_0, from runs of half of the steps, where that will do."""
    knobs = main.knobs if main.scaled.light else main.knobs.coarser(main.knobs.steps // 2)
    every = runs.beside(main, knobs)
    if every.scaled.gap.size == 1:  # springs that all stand alike are one
        return 0.0
    beside = [
        (runs.beside(main, knobs.coarser(n_springs=int(share * knobs.n_springs))), weight)
        for share, weight in COMPANIONS
    ]
    return max(weight * _missed(every, one) for one, weight in beside)


def _of_unresolved(runs: _Runs, main: Steady) -> float:
    """What steps miss, over mu_0, that do not resolve the oscillation of a mass on the contact but damp it, as their
    companions do: found beside steps that do. Those that are chosen do, as far as that can be afforded.
    """
    steps = int(np.ceil(1.1 * RESOLVED * runs.fast)) if main.scaled.light and main.scaled.M else 0
    if main.knobs.steps >= steps or steps > MOST_STEPS:
        return 0.0
    resolved = runs.beside(main, main.knobs.coarser(steps))
    missed = resolved.settling.spread if resolved.settling.settled else 1.0
    return missed + RINGING * abs(main.cof - resolved.cof)


def _clear_of_stick(runs: _Runs, main: Steady) -> March | None:
    """A close look at a run that slips, where no finer step would stick either, so that F_x is mu_0 F_z without error.

    It and its companion of half the steps must slip throughout, by more than a tenth of v_0 and ten times what doubling
    the steps changed. And this change must be small beside v_0 less the slip velocity, which is v_c, so that it
    converges: the velocity of a light body may jump by more with every finer step. That of one without mass and damper,
    on dashpots, has no bound at all.
    """
    scaled = main.scaled
    if scaled.T and not scaled.rigid and not scaled.M and not scaled.C:
        return None
    march, half = looked_at(main), looked_at(runs.beside(main, main.knobs.coarser(main.knobs.steps // 2)))
    least, moved = min(march.least_slip, half.least_slip), abs(march.least_slip - half.least_slip)
    return march if least > max(0.1, 10 * moved) and moved < 0.01 * (1 - least) + 1e-12 else None


def _missed(main: Steady, companion: Steady) -> float:
    """Difference of the COFs, over mu_0, and what the companion may be off its own steady state."""
    if abs(main.cof - companion.cof) <= ROUNDING:
        return 0.0
    missing = companion.settling.spread if main.settling.solved else 0.0
    if main.settling.solved and not companion.settling.settled:
        missing = max(missing, BUDGET)
    return missing + abs(main.cof - companion.cof)
