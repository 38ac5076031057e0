"""Where along the row the order of modes changes: the gap from which on springs slip back.

There the friction of a spring has a kink in its gap, and its derivatives jump: a row without a cut at this place misses
friction by second order in the number of springs, derivatives of friction by first order.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mdr.march.periodic.steady import MarchEnd
from mdr.spring.contact import Springs
from mdr.spring.contact_modes import SLIP_BACK, STICK
from mdr.tools.arrays import Array

NEARER = 8.0, 64.0  #: times as near as springs stand, trial springs in two passes to the place that was found before


def cut_of(end: MarchEnd, on_trial: bool = True) -> float:
    """Gap [amplitudes] from which on springs slip back, as a periodic state shows. inf: no spring slips back, or not
    implemented for this case, such as for friction that falls. -inf: all springs slip back.

    Springs slip back under a body that swings back. One that never loses contact and does not slip back has the force
    f = L[s] - D, where D >= 0 is what it lacks to slip forward. D is the same for all of these, and their L[s] differ
    by a constant. So the last that does not slip back has a gap that exceeds that of the deepest by the least
    (f + L[s])/2 of a period. Where all of these stay, and under a shake, the place is found by springs on trial, if
    asked: a row has springs beyond it anyway.
    """
    scaled, stepper = end.scaled, end.stepper
    as_one = scaled.springs.gap.size == 1 or (scaled.body.rigid and not scaled.drive.is_shaken)
    if as_one or scaled.n_axes == 2 or scaled.slow.rho or scaled.limit.falls or not scaled.limit.gap_tells:
        return np.inf  # where friction falls, a spring that is let go forgets what it lacked
    if not scaled.drive.is_shaken:
        deepest = int(np.argmin(scaled.springs.gap))
        gap = float(scaled.springs.gap[deepest])
        _, f, f_z = stepper.of_springs(end.orbit.state, Springs(*(of[[deepest]] for of in scaled.springs)), 1)
        reach = gap + 0.5 * float((f + f_z).min())
        if reach <= end.case.kept_gap - scaled.drive.h**2 / 4:  # what nodes may miss of the least value
            return reach if reach > gap else -np.inf
    return _on_trial(end) if on_trial else np.inf


def _on_trial(end: MarchEnd) -> float:
    """The same, where what springs bear less than their limit backwards comes to zero as the gap grows.

    inf as well where springs first slip back at the instant at which they leave: there is no kink.
    """
    row, order = end.scaled.springs, end.scaled.order
    least, slips = _spare(end, row)
    gaps, least, slips = row.gap[order], least[order], slips[order]
    if slips[0] or not slips.any():
        return -np.inf if slips[0] else np.inf
    first, found = int(slips.argmax()), np.inf
    low, high = float(gaps[first - 1]), float(gaps[first])
    before = slice(max(first - 3, 0), first - 1)  # the last may slip back within a step
    gaps, least = gaps[before], least[before]
    for nearer in NEARER:
        if gaps.size < 2 or not np.inf > least[0] > least[1]:
            break
        found = min(max(float(gaps[1] + least[1] * (gaps[1] - gaps[0]) / (least[0] - least[1])), low), high)
        gaps = found - (high - low) / nearer * np.array([2.0, 1.0])
        least, _ = _spare(end, Springs(gaps, np.ones(2)))
    return found


def _spare(end: MarchEnd, springs: Springs) -> tuple[Array, NDArray[np.bool_]]:
    """What springs (n,) bear less than their limit backwards, at the instant in stick at which this is least: infinite
    where there is none; and whether they slip back.
    """
    mode, f, f_z = end.stepper.of_springs(end.orbit.state, springs)
    spare, sticks = f + f_z, mode == STICK
    before, after = np.roll(spare, 1, axis=0), np.roll(spare, -1, axis=0)
    within = sticks & np.roll(sticks, 1, axis=0) & np.roll(sticks, -1, axis=0)
    bend = before - 2 * spare + after
    is_least = within & (spare <= before) & (spare <= after) & (bend > 0)
    vertex = spare - (after - before) ** 2 / (8 * np.where(is_least, bend, 1.0))  # of the parabola through three steps
    least = np.where(is_least, vertex, np.inf).min(axis=0)
    return least, (mode == SLIP_BACK).any(axis=0) | (least <= 0)  # some slip back within a step alone
