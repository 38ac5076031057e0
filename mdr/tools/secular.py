"""Zeros of a sum of poles, each found on its own, so that poles of many decades do not disturb one another."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mdr.tools.arrays import Array


def secular_zeros(constant: float, slope: float, weights: Array, poles: Array) -> Array:
    """Zeros x >= 0 of constant - slope x + sum weights x/(x - poles), ascending, of weights and ascending poles > 0.

    One lies between any two poles, one between zero and the first pole (at zero without a constant), and one beyond the
    last pole where there is a slope.
    """
    if not poles.size:
        return np.array([constant / slope] if slope > 0 else [])

    def value(log_x: float) -> float:
        x = np.exp(log_x)
        return float(constant - slope * x + np.sum(weights * x / (x - poles)))

    ends = [-np.inf, *np.log(poles), np.inf]
    first = 1 if constant == 0 else 0
    last = len(ends) - (1 if slope > 0 else 2)
    return np.array([0.0] * first + [np.exp(_zero_between(value, *ends[k : k + 2])) for k in range(first, last)])


def _zero_between(function: Callable[[float], float], low: float, high: float) -> float:
    """Zero of a function that falls from +infinity at `low` to -infinity at `high`; the ends may be infinite."""
    from scipy.optimize import brentq

    above, below = _place_near_pole(function, low, high, 1.0), _place_near_pole(function, high, low, -1.0)
    if not function(above) > 0 > function(below):  # closer to a pole than numbers tell: its weight is next to nothing
        return below if function(above) > 0 else above
    return float(brentq(function, above, below, xtol=1e-15, rtol=1e-15, maxiter=500))


def _place_near_pole(function: Callable[[float], float], end: float, other: float, sign: float) -> float:
    """A place between two ends, so close to the first that the function has the sign that it has there."""
    finite = np.isfinite(end)
    anchor = end if finite else (other if np.isfinite(other) else 0.0)
    step = 1e-3 * (abs(other - end) if np.isfinite(other) else 1.0) if finite else 1.0
    for _ in range(200):
        place = anchor + sign * step if finite else anchor - sign * step
        if sign * function(place) > 0 or place == end:
            break
        step *= 0.1 if finite else 2.0
    return place
