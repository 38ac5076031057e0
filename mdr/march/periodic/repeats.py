"""The steady state of a contact whose friction falls as springs are let go: after how many periods it repeats itself,
or what it comes to on average where it does not.

What the other searches rest on does not hold here. Two motions may move apart, as one spring may be let go where the
other still sticks: a state of one period need not exist, and there may be several. So this marches, and looks whether a
state comes back after n periods. Springs of one contact may come back after different numbers of them, so that a
multiple is looked for too. Where none comes back the mean over a long run is the answer, and the spread of the means of
its blocks tells its statistical error.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mdr.march.dynamics.state import UNKNOWN, MarchState
from mdr.march.dynamics.stepper import Periods, Stepper, joined
from mdr.march.periodic.orbit import Orbit
from mdr.march.periodic.settling import Settling
from mdr.tools.arrays import EXACT, Array
from mdr.tools.iterate import iterate
from mdr.tools.progress import time_is_over

COMES_BACK = 64  #: periods after which a state is looked for, at most
DYING = 1e-4  #: of the friction of full slip, what dies out at most where a state has come back
FIRST, MOST = 96, 4096  #: periods between two judgements, at first, and at most where no state comes back
BLOCKS = 16  #: of the second half of a run
SIGMAS = 3.0  #: standard deviations of a mean over blocks, taken as its error
NEAR = 4.0  #: times the error of a rate on a parabola: twice what this and the greatest rate at nodes may be off
DRAWN = 8.0  #: times a pull has to have gone as far as springs can be stretched, for blocks to be alike


@dataclass(frozen=True, eq=False)
class _March:
    """A march so far."""

    states: list[MarchState]  #: the last ones, one a period
    periods: Periods  #: since the start
    back: tuple[int, float] = (0, UNKNOWN)  #: after how many periods it comes back, and how far its COF is from that
    over: bool = False


def repeated(
    stepper: Stepper, start: MarchState, pre_sliding: float, accuracy: float, most: int | None = None
) -> Orbit:
    """The state that a march ends in, and its COF; most: periods at most, where no state comes back.

    pre_sliding: periods in which the pull goes as far as springs can be stretched. accuracy: of cof/mu_0 that is asked
    for, of which a mean may take a quarter.
    """
    least = int(min(DRAWN * pre_sliding, MOST)) if np.isfinite(pre_sliding) else MOST
    most = max(most or MOST, FIRST, least)

    def go_on(at: _March) -> _March:
        states, parts, cofs = list(at.states), [at.periods], at.periods.cof
        for _ in range(max(FIRST, at.periods.cof.size // 2)):
            state, periods = stepper.advance(states[-1], 1)
            states, parts = [*states[-2 * COMES_BACK :], state], [*parts, periods]
            cofs = np.append(cofs[-COMES_BACK:], periods.cof)
            back = _comes_back(stepper, states, cofs)
            if back[0] or time_is_over():
                break
        periods = joined(parts)
        late = periods.cof.size >= least and _averaged(periods)[1] <= accuracy / 4
        return _March(states, periods, back, bool(back[0]) or late or time_is_over() or periods.cof.size >= most)

    at = iterate(go_on, lambda at: at.over, _March([start], Periods(*np.empty((3, 0)))))
    (n, spread), state, cofs = at.back, at.states[-1], at.periods.cof
    if n:
        least_slip = stepper.least_slip(stepper.last, float(cofs[-1]))
        kind = "periodic" if n == 1 else f"period-{n}"
        across = float(at.periods.cof_y[-n:].mean())
        settling = Settling(float(cofs[-n:].mean()), spread, True, kind, gain=1.0, across=across)
        return Orbit(state, settling, least_slip)
    mean, spread = _averaged(at.periods)
    why = ""
    if time_is_over() and cofs.size < most:
        why = f"the time limit is over after {cofs.size} periods"
    elif cofs.size < DRAWN * pre_sliding:
        why = f"after {cofs.size} periods springs have not been let go often enough, which takes {pre_sliding:.3g} each"
    if why:
        return Orbit(state, Settling(mean.real, UNKNOWN, False, "unsettled", why=why, across=mean.imag))
    return Orbit(state, Settling(mean.real, min(spread, UNKNOWN), True, "averaged", across=mean.imag))


def beside_jump(stepper: Stepper) -> bool:
    """Whether a rigid pull is at v_c of springs that keep contact, to within what parabolas miss of their rates: there
    friction falls by a jump, and a run may be on the wrong side of it.
    """
    (z, z_dot, v, x, x_dot), h = stepper.motion, stepper.scaled.drive.h
    way, rate = z - x.real, z_dot - x_dot.real
    missed = np.abs(np.diff(way) / h - 0.5 * (rate[1:] + rate[:-1])).max()
    return stepper.scaled.body.rigid and abs(v - float(rate.max())) < NEAR * missed


def _averaged(periods: Periods) -> tuple[complex, float]:
    """Mean of the second half, along the pull and across it, and its statistical error: no less than what its halves
    differ by, if it still moves.
    """
    cofs = periods.cof + 1j * periods.cof_y
    half = cofs[cofs.size // 2 :]
    size = half.size // BLOCKS
    if not size:
        return complex(cofs.mean()) if cofs.size else 0j, UNKNOWN
    means = half[half.size - size * BLOCKS :].reshape(BLOCKS, size).mean(axis=1)
    moved = abs(complex(means[BLOCKS // 2 :].mean() - means[: BLOCKS // 2].mean()))
    return complex(means.mean()), max(SIGMAS * float(means.std(ddof=1)) / np.sqrt(BLOCKS), moved)


def _comes_back(stepper: Stepper, states: list[MarchState], cofs: Array) -> tuple[int, float]:
    """After how many periods the last state comes back, and what is missing in the COF; (0, UNKNOWN) if it does not.

    A change that shrinks by the ratio r in as many periods leaves r/(1 - r) of it to come; the mean over them misses no
    more than the change itself.
    """
    for n in (np.flatnonzero(np.abs(cofs[-2::-1] - cofs[-1]) < DYING) + 1).tolist():
        if len(states) <= 2 * n:
            break
        last, one, two = (states[-1 - k * n] for k in range(3))
        if not np.array_equal(last.modes, one.modes):
            continue
        change, before = _apart(stepper, last, one), _apart(stepper, one, two)
        missing = change if change <= EXACT else change * before / (before - change) if change < before else UNKNOWN
        late = stepper.late(one, last, n)
        if missing + late <= stepper.tolerance:
            parts = (d for d in range(1, n + 1) if n % d == 0)  # what dies out may swing in a rhythm of its own
            apart = {d: _apart(stepper, last, states[-1 - d]) if d < n else 0.0 for d in parts}
            d = next(d for d in apart if apart[d] < DYING)
            return d, 2 * missing + late + apart[d]
    return 0, UNKNOWN


def _apart(stepper: Stepper, one: MarchState, other: MarchState) -> float:
    """How far two states are apart, as a share of the friction of full slip: of the force of springs and body."""
    scaled = stepper.scaled
    ratios = np.concatenate([[1.0], scaled.rheology.rho])
    force = float(ratios @ (np.abs(one.e - other.e) @ scaled.springs.w))
    apart = one.body - other.body
    for body, (u, rate) in ((scaled.body, apart.real), (scaled.body_across, apart.imag)):
        if not body.rigid:
            force += (body.K + 1) * abs(float(u)) + np.sqrt(body.M * (body.K + 1)) * abs(float(rate))
    return force / stepper.mean_limit
