"""A run as accurate as is asked for: its companions, the bound on its error, more springs and steps until that is met.

Beside a run go companions: with half the steps and with three quarters or two thirds of them (for two of them may
agree by chance), and two of few steps with all springs and with half of them. The scheme is of second order, so the
difference to half the steps is three times the error, that to three quarters 7/9 of it and that to two thirds 5/4. The
first, or 14/9 of the error by the other if that is more, bounds the error of the COF, together with springs and spread
of the windows. Where the three numbers of steps confirm the order, the COF is extrapolated, and what the two estimates
differ by bounds what is left; not under a shake in the plane, where kinks are so many that three may agree by chance.
Springs are extrapolated likewise: where half of them differ by more than is asked for, three quarters of them tell
whether the error is of second order in the size of a cell; if it is not, the springs are doubled.

Refined steps grow by a half and by a third in turn, 256, 384, 512, 768 ..., so that the two runs before are companions
of the next. Where dashpots touch a body that no mass holds, its velocity jumps, and the error falls at first order and
erratically: there steps double, and companions of steps in no simple ratio are added.

A search begins with half of the springs and of the steps. Each run begins in the periodic state of the one before.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.march.dimensionless import RESOLVED, fast_ratio
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
    touches,
)
from mdr.march.run import SlidingRun, finish
from mdr.march.steady_state import TOLERANCE
from mdr.march.theorems import outside
from mdr.tools.memoise import remembered
from mdr.tools.progress import Ticker, time_is_over

ROUNDING = 1e-14  #: of cof/mu_0, up to which two runs have the same
MOST, MOST_KEPT = 10**6, 2e8  #: springs, or steps of a period; values of a record per array
LIGHT = 4.0  #: omega_1/omega from which on a body rings within the period
N_SPRINGS, _STEPS = 96, 256  # first choice; refined while cof_error exceeds the accuracy asked for
_STEPS_OF_JOLTS = 1024  # the same for a body without mass on dashpots, whose error falls at first order
CUTS = 5  #: pieces of the row of springs at most, without kinks, of two springs at least (spring_grid.py)
MOST_SPRINGS = 4096  #: that are chosen
MOST_STEPS = 16384  #: of a period, that are chosen
LEFT = 0.05  #: share of what is extrapolated that counts as error
FIRST = (0.5, 0.75, 0.25)  #: of the steps, of runs whose periodic state the main one may begin in
CONFIRMED = 0.2  #: share by which two estimates of what the steps miss, of second order, may differ, over 2 - ratio
APART = 3.0  #: times their difference that counts as error, times 2 - ratio
KINK = 0.015  #: of a mean over a period, times h², that a jump of the rate between two nodes can hide
BEND, BEND_OF_DASHPOT = 0.05, 0.15  #: the same, times h³, of a change of mode whose instant and path the march knows
KINK_OF_SPRINGS = 0.03  #: the same, over n_springs², of a change of mode between two springs
PHASES = 1024  #: of a period, to find its greatest depth
OF_DEPARTURE = 2.0  #: steps while a spring on slow dashpots lets go
MARGIN = 1.5  #: on differences of companions of an erratic error
RINGING = 1.2  #: of the difference to a run that resolves the oscillation of the body, whose own error is small
MOST_UNEVEN = 4096  #: of such a motion, whose error falls at first order only
SPRINGS_OF_A_SHAKE = (0.5, 0.7, 0.83)  #: of the springs, of companions where modes change anywhere among them
UNEVEN = (0.53, 0.61, 0.69, 0.83, 0.91)  #: of the steps, of companions of motions that jump as dashpots touch


def default_springs(case: SlidingContact) -> int:
    """Springs with which a search for the accuracy begins: half of them still serve all pieces of a kinked shape."""
    return max(N_SPRINGS, 4 * (len(case.indenter.kinks) + CUTS))


def default_steps(case: SlidingContact) -> int:
    """Steps per period with which a search for the accuracy begins: they resolve the oscillation of the body on the
    contact, if that can be afforded, and more where a body without mass jolts as dashpots touch.
    """
    fast, plain = fast_ratio(case), max(min(_STEPS * _oscillations(case), MOST_STEPS), _steps_of_departure(case))
    if np.isinf(fast):
        return max(_STEPS_OF_JOLTS, plain) if case.rheology.remembers and not case.keeps_contact else plain
    return plain if fast * 2 * RESOLVED < plain else int(min(2 * RESOLVED * np.ceil(fast), MOST_STEPS))


def _oscillations(case: SlidingContact) -> int:
    """Of the depth or of the shake in the period of the case, by the strongest harmonic."""
    motions = case.cycle.harmonics, case.shake_harmonics
    return max(1 + int(np.abs(motion).argmax()) for motion in motions if motion.size)


@remembered(maxsize=8)
def _steps_of_departure(case: SlidingContact) -> int:
    """Steps per period that resolve how springs on slow dashpots let go of the indenter; 0 where none does.

    Past its greatest depth d a spring of relaxation time T (omega tau) presses only for the phase d/(T |z''|). In steps
    that are longer, stick, slip and flight follow each other within one, and any number of such steps may agree.
    """
    T = case.rheology.T
    if T <= 1 or case.keeps_contact:
        return 0
    z, z_dot = case.cycle.over_a_period(PHASES)
    crest = int(np.argmax(z[:-1]))
    bend = (z_dot[crest - 1 if crest else -2] - z_dot[crest + 1]) * PHASES / (4 * np.pi)
    phase = (z[crest] + case.cycle.u_z0 / case.cycle.unit) / (T * max(bend, 1e-300))
    steps = 2 * np.pi * OF_DEPARTURE / max(phase, 1e-9)
    return int(min(64 * np.ceil(steps / 64), MOST_STEPS))


class _Runs:
    """Runs of one case at one velocity with several knobs, each kept, and begun in a state that was found before."""

    def __init__(self, case: SlidingContact, v_0: float, near: Steady | None) -> None:
        self.case, self.v_0, self.near = case, v_0, near
        self.fast = fast_ratio(case)
        self.jolts = bool(np.isinf(self.fast) and case.rheology.remembers)  # dashpots throw a body without mass
        self.ends: dict[Knobs, Steady] = {}
        self.unconfirmed: dict[tuple[str, int], float] = {}  # what was extrapolated to without the order confirmed
        self.ticker = Ticker("slide", parts="runs")

    def first(self, knobs: Knobs) -> Steady | None:
        """The end of a run that may go before the main one; None where its periodic state would have to be awaited, or
        is found too roughly.
        """
        if knobs.start != "full_slip" or not (self.case.keeps_contact or touches(self.case, knobs)):
            return None
        end = self._at(knobs, None, None if self.case.pull.is_rigid else 0)
        return end if end is not None and end.settling.settled else None

    def main(self, knobs: Knobs, most: int | None) -> Steady:
        """The end of a run that goes on until it settles, or for at most so many periods."""
        return self._there(knobs, None, most)

    def beside(self, main: Steady, knobs: Knobs) -> Steady:
        """The end of a companion: solved for by itself if the main run was, else of as many periods."""
        return self._there(knobs, None if main.settling.solved else main.n_periods, MOST_BESIDE)

    def guarded(self, of: str, end: Steady, found: tuple[float, float]) -> tuple[float, float]:
        """What is missing and the bound on its error (`extrapolated`), with what coarser ones extrapolated to that did
        not confirm the order: finer ones may agree by chance. of: "steps" or "springs".
        """
        (missing, bound), key = found, (of, end.knobs.n_springs if of == "steps" else end.knobs.steps)
        before = self.unconfirmed.get(key, end.cof + missing)
        if np.isinf(bound):
            self.unconfirmed[key] = end.cof + missing
        else:
            self.unconfirmed.pop(key, None)
        return missing, bound + abs(end.cof + missing - before)

    def _there(self, knobs: Knobs, n_periods: int | None, most: int | None) -> Steady:
        end = self._at(knobs, n_periods, most)
        assert end is not None
        return end

    def _at(self, knobs: Knobs, n_periods: int | None, most: int | None) -> Steady | None:
        knobs = knobs._replace(record=0) if knobs.record else knobs
        if knobs not in self.ends:
            end = steady(self.case, self.v_0, knobs, n_periods, self.near, most)
            if end is None:
                return None
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
    """A main run, the bound on the numerical error of its COF, over mu_0, and what steps and springs miss of it."""

    main: Steady
    error: float
    missing: float = 0.0

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
        return finish(self.looked_at(record), self.error, self.missing)


def within(
    case: SlidingContact, v_0: float, knobs: Knobs, free: tuple[bool, bool], near: Steady | None = None
) -> tuple[SlidingRun, Steady]:
    """A run with its companions, and its end; what was left free, springs and steps, is refined until the error is
    within knobs.accuracy. near: the end of a run at a velocity close by.

    How many springs it takes hardly depends on the steps, and is found with half of the first ones; but where single
    springs throw the body as they touch.
    """
    check(case, v_0)
    runs, knobs, coarser = _Runs(case, v_0, near), that_touch(case, knobs, free[1]), None
    few_steps, between = knobs.steps if runs.jolts else knobs.steps // 2, 3 * knobs.steps // 4
    alike = at_hand(case, knobs)[1].gap.size == 1
    few = knobs.n_springs // 2 if free[0] and not alike else knobs.n_springs
    first = next(filter(None, (runs.first(knobs.coarser(int(share * knobs.steps), few)) for share in FIRST)), None)
    if first is not None and not first.slips_fully and free[0] and not runs.jolts:
        knobs = _enough_springs(runs, first, knobs, few_steps)
    while True:
        main = runs.main(knobs, None if coarser is None or case.pull.is_rigid else MOST_BESIDE)
        if not main.settling.settled:
            # finer steps make a state that hardly repeats harder to find
            best = coarser or _Bounded(main, 0.0)
            return best.finished(knobs.record), best.main
        half = runs.beside(main, knobs.coarser(knobs.steps // 2))
        unresolved = _of_unresolved(runs, main)
        carried = main.off_load <= knobs.accuracy / 2 or not any(free)
        if main.slips_fully and carried and unresolved == 0:
            march = looked_at(main)
            if _clear_of_stick(march, looked_at(half)):
                return _Bounded(main, 0.0).finished(knobs.record) if knobs.record else finish(march), main
        most = runs.beside(main, knobs.coarser(between))
        uneven = main.scaled.light and main.scaled.remembers and not case.keeps_contact
        of_springs, error_springs = _of_springs(runs, main, knobs, knobs.steps if runs.jolts else few_steps, free[0])
        of_steps, error_steps = _of_steps(runs, main, half, most, UNEVEN if uneven else (), free[1])
        error_steps += unresolved
        if time_is_over():
            if coarser is None:
                why = "the time limit is over before the runs beside it, which bound cof_error, were done"
                unknown = replace(main.settling, settled=False, kind="unsettled", why=why)
                coarser = _Bounded(replace(main, settling=unknown), 0.0)
            return coarser.finished(knobs.record), coarser.main
        missing = of_springs + of_steps
        bounded, share = _Bounded(main, error_springs + error_steps, missing), knobs.accuracy / 2
        most_steps = MOST_UNEVEN if uneven else MOST_STEPS
        finer = min(2 * knobs.steps if uneven else 2 * between, most_steps)
        may_refine = free[0] and knobs.n_springs < MOST_SPRINGS, free[1] and knobs.steps < most_steps
        off_load = main.off_load > share
        more_springs = may_refine[0] and (error_springs > share or off_load)
        more_steps = may_refine[1] and (error_steps > share or off_load)
        met = bounded.error + main.settling.spread + main.missing_load <= knobs.accuracy
        awaited = not main.scaled.rigid and not main.settling.solved
        repeats = main.settling.spread <= max(knobs.accuracy, bounded.error) / 4  # else finer runs bound no better
        if met or awaited or not (more_springs or more_steps) or not repeats:
            march = bounded.looked_at(knobs.record)
            if march.sees_contact or not may_refine[1]:
                return finish(march, bounded.error, missing), main
            more_springs, more_steps = False, True
        coarser = bounded
        if more_springs:
            knobs = knobs._replace(n_springs=min(2 * knobs.n_springs, MOST_SPRINGS))
        if more_steps:
            between = knobs.steps if finer == 2 * between and not uneven else 3 * finer // 4
            knobs = knobs._replace(steps=finer)


def _enough_springs(runs: _Runs, first: Steady, knobs: Knobs, few_steps: int) -> Knobs:
    """The knobs with so many springs as the accuracy takes, as long as their runs settle, so closely that more springs
    may help, and there is time.
    """
    while knobs.n_springs < MOST_SPRINGS and not time_is_over():
        settling = runs.beside(first, knobs.coarser(few_steps)).settling
        if not settling.settled:
            break
        error = _of_springs(runs, first, knobs, few_steps, extrapolate=True)[1]
        if error <= knobs.accuracy / 2 or settling.spread > max(knobs.accuracy, error) / 4:
            break
        knobs = knobs._replace(n_springs=min(2 * knobs.n_springs, MOST_SPRINGS))
    return knobs


def _of_springs(runs: _Runs, main: Steady, knobs: Knobs, few_steps: int, extrapolate: bool) -> tuple[float, float]:
    """What the springs miss of the COF, over mu_0, and the bound on the error of that, from runs of few steps with all
    springs, with half of them and, where that is not enough, with three quarters; zero and the bound on the whole where
    the order is not confirmed.

    Under a shake the modes change at places within a cell, and a place near the edge of one is missed by as much with
    half of the cells; further companions in no simple ratio tell.
    """
    every = runs.beside(main, knobs.coarser(few_steps))
    if every.scaled.gap.size == 1:  # springs that all stand alike are one
        return 0.0, 0.0
    shaken = main.scaled.is_shaken

    def with_fewer(share: float) -> Steady:
        return runs.beside(main, knobs.coarser(few_steps, int(share * knobs.n_springs)))

    shares, half = SPRINGS_OF_A_SHAKE if shaken else (), with_fewer(0.5)
    regular = not (shaken or runs.jolts or (main.scaled.T and _erratic(runs, main)))
    hidden = KINK_OF_SPRINGS / knobs.n_springs**2 * _deficit(every)
    plain = max(_missed(every, one) for one in (half, *map(with_fewer, shares))) + hidden + _of_held_springs(every)
    unsure = 0.0
    if main.settling.solved and every is not main:
        unsure = max(every.settling.spread, 0.0 if every.settling.settled else BUDGET)
    if extrapolate and regular and half.settling.settled and plain > knobs.accuracy / 2:
        most = with_fewer(0.75)
        ratio = every.knobs.n_springs / most.knobs.n_springs
        missing, bound = runs.guarded("springs", every, extrapolated(every.cof, half.cof, most.cof, ratio))
        bound += hidden + every.settling.spread + half.settling.spread + most.settling.spread
        if most.settling.settled and bound < plain:
            return missing, bound + unsure
    return 0.0, plain + unsure


def _of_held_springs(every: Steady) -> float:
    """What a cell misses, over mu_0, in which springs that a shake lets rest border on such as slip in every period.

    At rest the mean extension bends there by as much as the compression, which costs an eighth of the height of the
    cell; a pull rounds this off over the way of a period.
    """
    scaled = every.scaled
    if not scaled.is_shaken or scaled.gap.size == 1:
        return 0.0
    height = np.abs(np.diff(scaled.gap))
    rounded = height / (height + 2 * np.pi * every.stepper.v + 1e-300)
    return float(np.max(scaled.w[1:] * height * rounded)) / 8 / every.mean_F_z


def _of_steps(
    runs: _Runs, main: Steady, half: Steady, most: Steady, uneven: tuple[float, ...], extrapolate: bool
) -> tuple[float, float]:
    """What the steps miss of the COF, over mu_0, and the bound on the error of that; zero and the bound on the whole
    where the order of the scheme is not confirmed.

    half, most: companions with half of the steps and with more. uneven: shares of the steps of further ones.
    """
    steps, hidden = main.knobs.steps, _hidden_by_steps(main, half)
    margin = MARGIN if _erratic(runs, main) else 1.0
    lost = (steps / most.knobs.steps) ** 2 - 1  # what `most` misses more than main, over what main misses
    plain = (max(_missed(main, half), 14 / 9 * _missed(main, most) / lost) + hidden) * margin
    others = [runs.beside(main, main.knobs.coarser(int(share * steps))) for share in uneven]
    plain = max(plain, *(2 * (_missed(main, other) + hidden) for other in others)) if others else plain
    regular = not main.scaled.light and margin == 1 and not main.scaled.is_shaken  # whose kinks agree by chance
    if extrapolate and regular and half.settling.settled and most.settling.settled:
        ratio = steps / most.knobs.steps
        missing, bound = runs.guarded("steps", main, extrapolated(main.cof, half.cof, most.cof, ratio))
        bound += 2 * hidden + main.settling.spread + half.settling.spread + most.settling.spread
        if bound < plain:
            return missing, bound + _of_fast_relaxation(main)
    return 0.0, plain + _of_fast_relaxation(main)


def extrapolated(cof: float, half: float, most: float, ratio: float) -> tuple[float, float]:
    """What a value misses to steps of no length by those with half of the steps and with 1/ratio of them, ratio < 2,
    and the bound on the error of that; infinite where the three do not confirm an error of second order.

    Of an error of first order the two estimates differ by (2 - ratio)/3 of the greater. Both limits follow this.
    """
    two = (cof - half) / 3, (cof - most) / (ratio**2 - 1)
    apart, size = abs(two[0] - two[1]), max(abs(two[0]), abs(two[1]))
    confirmed = apart < CONFIRMED * (2 - ratio) * size
    return 0.5 * (two[0] + two[1]), APART / (2 - ratio) * apart + LEFT * size if confirmed else np.inf


def that_touch(case: SlidingContact, knobs: Knobs, free: bool) -> Knobs:
    """The knobs, with more steps where they are free and the contact too brief for them or for their companions."""
    if case.keeps_contact:
        return knobs
    while not all(touches(case, knobs.coarser(n)) for n in (knobs.steps, knobs.steps // 2, 3 * knobs.steps // 4)):
        if not free or knobs.steps >= MOST_STEPS:
            raise too_coarse(knobs.steps)
        knobs = knobs._replace(steps=min(2 * knobs.steps, MOST_STEPS))
    return knobs


def _clear_of_stick(main: March, half: March) -> bool:
    """Whether no finer step would stick either, so that F_x is mu_0 F_z without error.

    Both runs must slip throughout, by more than a tenth of v_0 and ten times what doubling the steps changed. And this
    change must be small beside v_0 less the slip velocity, which is v_c, so that it converges: the velocity of a light
    body may jump by more with every finer step. That of one without mass and damper, on dashpots, has no bound at all.
    """
    if main.end.scaled.T and not main.end.scaled.rigid and not main.end.scaled.M and not main.end.scaled.C:
        return False
    least, moved = min(main.least_slip, half.least_slip), abs(main.least_slip - half.least_slip)
    return least > max(0.1, 10 * moved) and moved < 0.01 * (1 - least) + 1e-12


def _of_unresolved(runs: _Runs, main: Steady) -> float:
    """What steps miss, over mu_0, as their companions do, that resolve neither the oscillation of a mass on the
    contact, but damp it, nor how springs on slow dashpots let go: found beside steps that do. Those that are chosen do,
    as far as that can be afforded.
    """
    steps = int(np.ceil(1.1 * RESOLVED * runs.fast)) if main.scaled.light and main.scaled.M else 0
    steps = max(steps if steps <= MOST_STEPS else 0, _steps_of_departure(runs.case))
    if main.knobs.steps >= steps:
        return 0.0
    resolved = runs.beside(main, main.knobs.coarser(steps))
    missed = resolved.settling.spread if resolved.settling.settled else 1.0
    return missed + RINGING * abs(main.cof - resolved.cof)


def _erratic(runs: _Runs, main: Steady) -> bool:
    """Whether the error is less regular than the differences of companions tell, so that they get a margin.

    A light body rings on the contact through stick and slip, and where the nodes meet its oscillation makes the error
    of a step erratic; of ten random bodies with omega_1 from 4 to 40 omega, two exceeded the plain differences, by 2
    and 3 % (tests/table_of_errors.py). On dashpots a motion of several harmonics has many kinks, of which companions
    may miss the same.
    """
    return LIGHT < runs.fast < np.inf or bool(main.scaled.T and runs.case.cycle.has_several_harmonics)


def _of_fast_relaxation(main: Steady) -> float:
    """What a change of mode in the core misses where the lag relaxes within a step, over mu_0.

    It is of second order but irregular, so that companions may agree by chance. Measured against the closed form of a
    rigid pull (T from 1e-4 to 0.3, all shapes and speeds), it stays below h² x/3(2 + x), x = h/T, per spring that keeps
    contact; a quarter of that for arrays that lose it.
    """
    T, h = main.scaled.T, main.scaled.h
    if T == 0:
        return 0.0
    core = float(main.scaled.w[: main.scaled.n_core].sum())
    swing = 1.0 + float(np.abs(main.scaled.x_dot).max())  # of the modes' rates, which a shake adds to
    return swing * max(core, 0.25) * h**2 / 3 * h / (2 * T + h) / main.mean_F_z


def _missed(main: Steady, companion: Steady) -> float:
    """Difference of the COFs, over mu_0, and what the companion may be off its own steady state."""
    if abs(main.cof - companion.cof) <= ROUNDING:
        return 0.0
    missing = companion.settling.spread if main.settling.solved else 0.0
    if main.settling.solved and not companion.settling.settled:
        missing = max(missing, BUDGET)
    return missing + abs(main.cof - companion.cof)


def _hidden_by_steps(main: Steady, companion: Steady) -> float:
    """What changes of mode between two nodes can hide of the COF, over mu_0.

    The march knows the path between the nodes but for its third order in the step. Where the body is light, and where
    springs that remember touch, it is left with a kink of size [e'], which costs a mean up to [e'] h²/8 of one step.
    """
    if abs(main.cof - companion.cof) <= ROUNDING:
        return 0.0
    scaled, h = main.scaled, main.scaled.h
    bend = BEND_OF_DASHPOT if scaled.T else BEND
    loses = scaled.remembers and scaled.n_core < scaled.gap.size
    return (KINK * h**2 if scaled.light or loses else bend * h**3) * _deficit(main)


def _deficit(main: Steady) -> float:
    """A measure of the changes of mode in a period, over the mean force.

    Near v_c, with psi ~ (1 - v)² the deficit of one spring, the jump of e' falls only like psi^(1/4); so what is
    allowed for a change follows this, not the deficit.
    """
    psi = min(max(1 - main.cof, 0.0) * main.mean_F_z, 1.0)
    return float(psi**0.25) / main.mean_F_z
