"""A run as accurate as is asked for: its companions, the bound on its error, more springs and steps until that is met.

A step is exact but for the parabolas that motion and body take in it, and a sum over the nodes of Fejer's rule but for
places along the row where stick turns to slip. Both errors are of second order or better in the numbers of steps and
springs, though they do not fall evenly, as events come at any place in a step. So four coarser runs, companions, go
beside a run: (1) half of the steps; (2) half of the steps and springs; (3) three quarters of both; (4) three eighths of
both. Each has one step more in each oscillation, so that no two divide it at the same instants: what an event just
behind a common instant does would be missed by all alike. Where the run shows that springs begin to slip back at a
place of the row, (2) to (4) have a cut there: rows of which no spring stands beyond it would agree. Run minus (1) tells
the error of the steps, (1) minus (2) that of the springs, which counts one and a half times; at second order each is
three times the true error. The bound is their sum; where the limit is met to a lower order both count one and a half
times more. Two runs may agree by chance, so that it is never less than 3 |run - (3)|, 2.3 times the error at second
order, nor less than 3/8 |(2) - (4)|, as errors fall at most eightfold where both numbers are doubled; nor, in the
plane, less than a tenth of what is asked for. Added is what no companion shows. Where all this is more than is asked
for, steps or springs are doubled, as these companions tell, until a run would be too dear. Once, in the place of more
springs, the row is cut where the run shows that they begin to slip back.

Where friction falls steps have to resolve the body. Where half of them do not, the companions have four times as many:
run minus (1) is then three quarters of the error at second order, and counts four times.

Where a run has found its periodic state, the next one begins its search there.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.march.dynamics.body import RESOLVED
from mdr.march.dynamics.dimensionless import fast_ratio, stopping_rate
from mdr.march.periodic.order import cut_of
from mdr.march.periodic.repeats import beside_jump
from mdr.march.periodic.shooting import FULL
from mdr.march.periodic.steady import (
    BUDGET,
    MOST_BESIDE,
    MarchEnd,
    Resolution,
    accuracy_of,
    at_hand,
    check,
    steady,
    too_coarse,
)
from mdr.tools.companions import Companion, bound
from mdr.tools.progress import Ticker, time_is_over

MOST_ASKED, MOST_KEPT = 10**6, 2e8  #: springs, or steps of a period; values of a record per array
N_SPRINGS, N_STEPS = 32, 64  #: first choice for a plain contact: with it most have an error below 1e-5
MOST_PIECES = 5  #: of the row of a shape without kinks, each of at least two springs (spring_grid.py)
MOST_SPRINGS, MOST_STEPS = 4096, 16384  #: that are chosen
MOST_CHOSEN = 2**22  #: springs times steps, of which a run takes seconds: errors of first order would go on for minutes
UNEVENLY = 1.5  #: times what springs may miss: between 128 and 256 of them an error was seen to fall by a fifth only
BY_CHANCE = 3.0  #: times the difference to a run with three quarters of steps and springs: what the bound is at least
AGREED = 0.1  #: of the accuracy: least bound in the plane, where runs were seen to agree by chance (with arms)
MOST_GAINED = 8.0  #: by which errors of third order fall where numbers are doubled
FINER = 4  #: times the steps of companions where coarser ones do not resolve the body, and what they tell of its error
UNRESOLVED = 2.0  #: times the difference to a run whose steps resolve more, as that may miss as much again


def default_springs(case: SlidingContact) -> int:
    """Springs with which a search for the accuracy begins: half of them still serve all pieces of a kinked shape."""
    return max(N_SPRINGS * _harder(case)[0], 4 * (len(case.indenter.kinks) + MOST_PIECES))


def default_steps(case: SlidingContact) -> int:
    """Steps per period with which a search for the accuracy begins: their half still resolves the oscillation of the
    body on the contact, if that can be afforded. In the plane three eighths of them resolve how dashpots stop it too:
    a body that is stopped within a step is solved for together with its springs, which fails where friction turns, or
    falls.
    """
    plain, rate = N_STEPS * _harder(case)[1] * _one_each(case), fast_ratio(case)
    resolved = 0 if np.isinf(rate) else _rounded(2.02 * RESOLVED * rate)
    stop = stopping_rate(case) if case.moves_across or case.friction.stick > 1 else 0.0
    stopped = _rounded(2.02 * np.pi * 8 / 3 * stop) if 2 * np.pi * stop <= MOST_STEPS else 0
    return min(max(plain, resolved, stopped), MOST_STEPS)


def _rounded(steps: float) -> int:
    return N_STEPS * int(np.ceil(steps / N_STEPS))


def _harder(case: SlidingContact) -> tuple[int, int]:
    """Factors on the springs and steps of a plain contact, with which a search begins."""
    if _jolts(case):
        return 4, 4
    if case.is_shaken:  # springs slip both ways, and those that do so little are few
        return 4, 1
    return (1, 2) if np.isinf(fast_ratio(case)) else (1, 1)


def oscillations(case: SlidingContact) -> float:
    """Frequency over omega that a parabola has to resolve: cube root of the third derivative of depth or shake over the
    motion itself.
    """
    motions = [
        np.abs(motion) for motion in (case.cycle.harmonics, case.shake_harmonics, case.harmonics_across) if motion.any()
    ]
    return max(float((a @ np.arange(1.0, a.size + 1) ** 3 / a.sum()) ** (1 / 3)) for a in motions)


def _jolts(case: SlidingContact) -> bool:
    """Whether dashpots throw a body without mass, as each spring that touches presses with a jump."""
    return bool(np.isinf(fast_ratio(case)) and case.rheology.remembers and not case.keeps_contact)


class _Runs:
    """Runs of one case at one velocity, each kept, and begun in a state that was found before."""

    def __init__(self, case: SlidingContact, v_0: float, near: MarchEnd | None) -> None:
        self.case, self.v_0, self.near = case, v_0, near
        self.fast = fast_ratio(case)
        self.searched = not case.pull.is_rigid or case.rheology.remembers or case.moves_across
        self.ends: dict[Resolution, MarchEnd] = {}
        self.ticker = Ticker("slide", parts="runs")

    def main(self, resolution: Resolution, most: int | None) -> MarchEnd:
        """The end of a run that goes on until it settles, or for at most so many periods.

        Where the periodic state has to be searched for, it begins in that of the companion of half the steps and
        springs, which is found, with its gain, at a quarter of the cost.
        """
        known = self.near is not None and self.near.v_0 == self.v_0
        if not known and self.searched and self.case.friction.stick == 1 and resolution.start == "full_slip":
            half = companions(self.case, resolution).half
            first = steady(self.case, self.v_0, half, None, self.near, 1)
            if first.settling.solved and first.settling.settled:
                self.ends[half] = self.near = first
        return self._at(resolution, None, most)

    def beside(self, main: MarchEnd, resolution: Resolution) -> MarchEnd:
        """The end of a companion: solved for by itself if the main run was, else of as many periods."""
        awaited = not main.settling.solved and self.case.friction.stick == 1
        return self._at(resolution, main.n_periods if awaited else None, MOST_BESIDE)

    def half(self, main: MarchEnd) -> MarchEnd:
        """The companion with half of the steps and springs."""
        return self.beside(main, companions(self.case, main.resolution).half)

    def _at(self, resolution: Resolution, n_periods: int | None, most: int | None) -> MarchEnd:
        if resolution not in self.ends:
            end = steady(self.case, self.v_0, resolution, n_periods, self.near, most)
            self.ends[resolution] = end
            self.ticker.what = (
                f"slide, refined for an error of {resolution.accuracy:g} mu_0, {resolution.n_springs} springs and "
                f"{resolution.steps} steps last"
            )
            self.ticker.tick()
            self.near = end if end.settling.solved and end.settling.settled else self.near
        return self.ends[resolution]


class Companions(NamedTuple):
    """The resolutions of the runs beside a run, (1) to (4) above."""

    steps: Resolution  #: half of its steps
    half: Resolution  #: half of its springs too
    more: Resolution  #: three quarters of both
    less: Resolution  #: three quarters of half of both


def companions(case: SlidingContact, resolution: Resolution, cut: float | None = None) -> Companions:
    """Those beside a run. cut: gap at which the rows of fewer springs are cut, if not that of the run."""
    shares = (4, 8), (4, 4), (6, 6), (3, 3)  # eighths of steps and springs
    n_t, n = resolution.steps, resolution.n_springs
    fewer = resolution if cut is None else resolution._replace(cut=cut)
    rows, more = (resolution, fewer, fewer, fewer), _one_each(case)
    if case.friction.stick > 1 and at_hand(case, resolution.of_size(n_t // 2 + more))[1].light:
        n_t *= FINER
    return Companions(*(row.of_size(k * n_t // 8 + more, m * n // 8) for row, (k, m) in zip(rows, shares, strict=True)))


def _one_each(case: SlidingContact) -> int:
    """Steps of a period that are one in each oscillation."""
    return int(np.ceil(oscillations(case) - 1e-9))


def resolution_of(
    case: SlidingContact,
    n_springs: int | None,
    steps_per_period: int | None,
    accuracy: float = BUDGET,
    start: str = "full_slip",
    lump: bool = True,
    record: int = 0,
) -> Resolution:
    """The resolution that a run begins with: springs and steps as asked for, or chosen and to be refined."""
    n, n_t = n_springs or default_springs(case), steps_per_period or default_steps(case)
    check_size(n, n_t, record)
    return Resolution(n, n_t, start, lump, record, accuracy_of(accuracy), (n_springs is None, steps_per_period is None))


def check_size(n_springs: int, steps: int, record: int) -> None:
    """Refuse more springs, steps or periods of a record than memory holds."""
    if max(n_springs, steps) > MOST_ASKED or n_springs * steps * record > MOST_KEPT:
        raise ValueError(
            f"n_springs = {n_springs}, steps_per_period = {steps}, record = {record} is more than memory "
            f"holds: at most {MOST_ASKED} springs or steps, and {MOST_KEPT:g} values of a record"
        )


def within(case: SlidingContact, v_0: float, resolution: Resolution, near: MarchEnd | None = None) -> MarchEnd:
    """The end of a run with its companions; springs and steps that are free are refined until the error is within
    resolution.accuracy. near: the end of a run at a velocity close by.
    """
    check(case, v_0)
    record = resolution.record
    end = _refined(_Runs(case, v_0, near), _that_touch(case, resolution._replace(record=0)))
    check_size(end.resolution.n_springs, end.resolution.steps, record)
    return replace(end, resolution=end.resolution._replace(record=record))


def _refined(runs: _Runs, resolution: Resolution) -> MarchEnd:
    """The finest run that has settled; if none has, the first."""
    finest: MarchEnd | None = None
    while True:
        rigid = runs.case.pull.is_rigid
        main = runs.main(resolution, None if finest is None or rigid else MOST_BESIDE)
        if not main.settling.settled:  # finer steps make a state that hardly repeats harder to find
            return finest or replace(main, error=0.0)
        jumps = runs.case.friction.stick > 1 and beside_jump(main.stepper)
        if jumps and resolution.free[1] and resolution.steps < MOST_STEPS:
            resolution = resolution._replace(steps=2 * resolution.steps)
            continue
        share = resolution.accuracy / 2
        may_be_clear = main.slips_fully and (main.load_error <= share or not any(resolution.free))
        if may_be_clear and not jumps and (clear := _clear_of_stick(runs, main)) is not None:
            return clear
        missed = _missed_by(runs, main)
        error = missed.bound + _of_unresolved(runs, main) + (runs.case.friction.stick - 1 if jumps else 0.0)
        if time_is_over():
            why = "the time limit is over before the runs beside it, which bound cof_error, were done"
            return finest or replace(main.unsettled(why), error=0.0)
        finest = replace(main, error=error)
        met = error + main.settling.spread + main.hidden_error <= resolution.accuracy
        awaited = not main.scaled.body.rigid and not main.settling.solved
        repeats = main.settling.spread <= max(resolution.accuracy, error) / 4  # else finer runs bound no better
        finer = resolution if met or awaited or not repeats else _finer(main, missed)
        if finer.n_springs > resolution.n_springs and (cut := _to_be_cut(main, on_trial=True)) is not None:
            finer = resolution._replace(cut=cut)
        if finer == resolution:
            return finest
        resolution = finer


def _to_be_cut(main: MarchEnd, on_trial: bool = False) -> float | None:
    """Gap at which the row of a run is to be cut; None where it is, or nothing asks for it, or where the companion of
    fewest springs would not have two for each piece of it.
    """
    fewest = max(3 * main.resolution.n_springs // 8, 16)
    if main.resolution.cut < np.inf or fewest < 2 * (len(main.case.indenter.kinks) + 3):
        return None
    cut = cut_of(main, on_trial)
    return cut if cut < np.inf else None


def _finer(main: MarchEnd, missed: Missed) -> Resolution:
    """Twice the steps or springs, or both, of which too much is missed; the same where that cannot be afforded."""
    free, share = main.resolution.free, main.resolution.accuracy / 2
    of_steps, of_springs = missed.steps.apart, max(missed.springs.apart, main.load_error)
    both = max(of_steps, of_springs) <= share  # the error is that of the other companion
    n_springs, steps = main.resolution.n_springs, main.resolution.steps
    if free[0] and (both or of_springs > share):
        n_springs = max(n_springs, min(2 * n_springs, MOST_SPRINGS))
    if free[1] and (both or of_steps > share):
        steps = max(steps, min(2 * steps, MOST_STEPS))
    now = main.resolution
    worse = (n_springs, now.steps) if of_springs > of_steps else (now.n_springs, steps)
    for n, n_t in ((n_springs, steps), worse):
        if n * n_t <= MOST_CHOSEN or not all(free):
            return now._replace(n_springs=n, steps=n_t)
    return now


def _that_touch(case: SlidingContact, resolution: Resolution) -> Resolution:
    """The resolution, with more steps where they are free and the contact too brief for those of companions."""
    while not (
        case.keeps_contact or all(at_hand(case, one)[1].normal.mean > 0 for one in companions(case, resolution))
    ):
        if not resolution.free[1] or resolution.steps >= MOST_STEPS:
            raise too_coarse(resolution.steps)
        resolution = resolution._replace(steps=2 * resolution.steps)
    return resolution


class Missed(NamedTuple):
    """Errors of the COF of a run, over mu_0, as its companions tell them."""

    steps: Companion
    springs: Companion
    by_chance: tuple[Companion, ...]  #: both together, by other pairs of runs

    @property
    def bound(self) -> float:
        """Bound on the error of cof/mu_0."""
        return bound(self.steps, self.springs, others=self.by_chance)


def _missed_by(runs: _Runs, main: MarchEnd) -> Missed:
    """Errors of a run, as its companions tell them."""
    beside, as_one = companions(runs.case, main.resolution, _to_be_cut(main)), main.scaled.springs.gap.size == 1
    if as_one:  # all springs of a punch: (1) and (2) would be one run, and are of different steps instead
        beside = beside._replace(
            steps=beside.half, half=beside.half.of_size(beside.half.steps + 2 * _one_each(runs.case))
        )
    steps, half, more = (runs.beside(main, one) for one in (beside.steps, beside.half, beside.more))
    by_chance = [Companion(_apart(main, more), BY_CHANCE), Companion(_apart(main, half))]
    _, less = at_hand(runs.case, beside.less)
    if less.body.light == half.scaled.body.light:  # else a body moves by another scheme there
        by_chance += [Companion(_apart(half, runs.beside(half, beside.less)), BY_CHANCE / MOST_GAINED)]
    if runs.case.moves_across:
        by_chance += [Companion(0.0, least=AGREED * main.resolution.accuracy)]
    of_steps = 1.0 if main.scaled.limit.order == 2 else UNEVENLY
    by_steps = of_steps * (1.0 if steps.resolution.steps < main.resolution.steps else FINER)
    by_springs = Companion(0.0 if as_one else _apart(steps, half), of_steps * UNEVENLY)
    return Missed(Companion(_apart(main, steps), by_steps), by_springs, tuple(by_chance))


def _of_unresolved(runs: _Runs, main: MarchEnd) -> float:
    """Step error that all companion runs share, over mu_0, so that their differences do not show it: of the oscillation
    of a mass on the contact, which too few steps damp, or of how dashpots throw a body without mass (`_jolts`). It is
    found beside a run whose steps resolve the oscillation, or that has four times the steps. Zero where the run has
    these itself, and, with a mass, where they would be more than MOST_STEPS.
    """
    steps = int(np.ceil(1.1 * RESOLVED * runs.fast)) if main.scaled.body.light and main.scaled.body.M else 0
    if _jolts(runs.case):
        steps = min(4 * main.resolution.steps, MOST_STEPS)
    if main.resolution.steps >= steps or steps > MOST_STEPS:
        return 0.0
    resolved = runs.beside(main, main.resolution.of_size(steps))
    missed = resolved.settling.spread if resolved.settling.settled else 1.0
    return missed + UNRESOLVED * abs(main.cof - resolved.cof)


def _clear_of_stick(runs: _Runs, main: MarchEnd) -> MarchEnd | None:
    """The run, if it slips fully and finer steps would too. Its COF is then exact.

    The least slip velocity (MarchEnd.least_slip), of it and of its companion of half the size, must be more than a
    tenth, and than ten times their difference. And this difference must be small beside one less the slip velocity, so
    that it converges: the velocity of a light body may jump by more with every finer step. That of one without mass and
    damper, on dashpots, has no bound at all. None of a run that does not pass.
    """
    scaled = main.scaled
    if scaled.law.T and not scaled.body.rigid and not scaled.body.M and not scaled.body.C:
        return None
    of_main, of_half = main.least_slip, runs.half(main).least_slip
    least, moved = min(of_main, of_half), abs(of_main - of_half)
    if not (least > max(0.1, 10 * moved) and moved < 0.01 * (1 - least) + 1e-12):
        return None
    return replace(main, error=0.0)


def _apart(main: MarchEnd, companion: MarchEnd) -> float:
    """Difference of the COFs, over mu_0, and what the companion may be off its own steady state; zero where they
    agree to rounding.
    """
    apart = float(np.hypot(main.cof - companion.cof, main.settling.across - companion.settling.across))
    if apart <= FULL:
        return 0.0
    missing = companion.settling.spread if main.settling.solved else 0.0
    if (main.settling.solved or main.settling.kind == "averaged") and not companion.settling.settled:
        missing = max(missing, BUDGET)
    return missing + apart
