"""Curves of noisy readings: turning points as rainflow counting takes them, stand-stills, and their order."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mdr.tools.arrays import EXACT, Array

SLOW_RISE = 0.25  #: share of a rate, below which a rise stands still; as the root of time it slows to a third
FEW = 2  #: readings, of which none is left out
TINY = float(np.finfo(float).tiny)


def reach_of_noise(x: Array) -> float:
    """Range that white noise takes in as many samples: by the second differences of a signal that changes slowly."""
    if x.size < 3:
        return 0.0
    deviation = 1.483 / np.sqrt(6) * float(np.median(np.abs(np.diff(x, 2))))
    return float(2 * np.sqrt(2 * np.log(x.size)) * deviation)


def turning_points(x: Array, least: float) -> list[int]:
    """Samples at which a signal begins, turns by more than `least`, and ends; of equal ones the first."""
    low = high = 0
    rises, turns = None, [0]
    for i, value in enumerate(x.tolist()):
        low, high = (i if value < x[low] else low), (i if value > x[high] else high)
        if rises is not False and value < x[high] - least:
            turns += [high] if rises else []
            rises, low = False, i
        elif rises is not True and value > x[low] + least:
            turns += [low] if rises is False else []
            rises, high = True, i
    return [*turns, x.size - 1]


def before_it_stands(x: Array, is_high: NDArray[np.bool_]) -> int:
    """How many readings of a rise there are before it all but stands still; where it may, is_high."""
    steps = np.abs(np.diff(x))
    start, noise = 0, reach_of_noise(x) + float(np.min(steps[steps > 0], initial=np.inf))  # and of rounding
    while (n := x.size - start) > FEW:
        ahead = x[start:] - np.linspace(x[start], x[-1], n)
        k = start + int(np.argmax(ahead))  # where it slows most
        if ahead[k - start] <= noise or x.size - k <= FEW:
            break
        if is_high[k] and (x[-1] - x[k]) / (x.size - 1 - k) < SLOW_RISE * (x[k] - x[start]) / (k - start):
            return k + 1
        start = k
    return int(x.size)


def in_order(d: Array, F: Array) -> tuple[Array, Array]:
    """Pairs in the order of d: as they are, sorted, or with d smoothed over the readings.

    Where d truly shakes F follows it; where only what reads it is noisy, F lies nearer to a line over the smoothed d.
    """
    as_read, smooth = (_sorted(one, F) for one in (d, _smoothed(d)))
    return smooth if _scatter(*smooth) < (1 - d.size**-0.5) * _scatter(*as_read) else as_read


def _smoothed(d: Array) -> Array:
    """Depths on a line or a spline over the number of the reading, of as many pieces as tell more than noise (BIC)."""
    from scipy.interpolate import make_lsq_spline

    n, best = np.linspace(0, 1, d.size), (np.inf, d)
    for degree, pieces in ((1, 1), *((3, 2**k) for k in range(int(np.log2(max(d.size / 8, 1)))))):
        knots = np.concatenate([[0.0] * degree, np.linspace(0, 1, pieces + 1), [1.0] * degree])
        smooth = np.asarray(make_lsq_spline(n, d, knots, degree)(n)) if d.size > 2 * degree else d
        rest = max(float(np.var(d - smooth)), EXACT * float(np.var(d)), TINY)
        score = d.size * np.log(rest) + (degree + pieces) * np.log(d.size)
        best = min(best, (score, smooth), key=lambda one: one[0])
    return best[1]


def _sorted(d: Array, F: Array) -> tuple[Array, Array]:
    """Pairs in the order of depth; at one depth the mean of the forces."""
    there, which, counts = np.unique(d, return_inverse=True, return_counts=True)
    return there, np.bincount(which, F) / counts


def _scatter(d: Array, F: Array) -> float:
    """Mean square of forces off the straight line between the two beside them."""
    share = (d[1:-1] - d[:-2]) / (d[2:] - d[:-2])
    return float(np.mean((F[1:-1] - F[:-2] - share * (F[2:] - F[:-2])) ** 2)) if d.size > 2 else 0.0
