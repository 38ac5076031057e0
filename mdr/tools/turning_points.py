"""Turning points of a noisy signal, as rainflow counting takes them: reversals that are larger than the noise."""

from __future__ import annotations

import numpy as np

from mdr.tools.arrays import Array


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
