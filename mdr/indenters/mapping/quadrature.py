"""Integrals and derivatives of functions that are smooth between kinks, free of any length scale.

Integrals: the double-exponential rule (Takahasi & Mori 1974). Its nodes crowd at both ends, so that a power,
a root or a logarithm at a kink, at the tip or at the contact edge costs no digits.
Derivatives: interpolation in Chebyshev points of a window that is a fixed share of the radius and never
reaches across a kink; where the window is too wide for the function, it is halved.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from mdr.tools.arrays import EPS, Array
from mdr.tools.checks import plain

Function = Callable[[Array], Array]

N_FIT = 16  #: Chebyshev points where a function is smooth: a singularity four half-widths away leaves 7.9**-16 = 4e-15
WINDOW = 0.25  #: half-width of a window over the radius; the apex, where f ~ r**n, is then four away
N_HALVINGS = 12  #: of a window, or a panel, for a function whose derivatives have no bound
CHUNK = 256  #: points mapped at once: keeps the work in cache


class Rule(NamedTuple):
    """Nodes and weights on (0, 1); ``to_high`` is 1 - ``from_low`` without its rounding."""

    from_low: Array
    to_high: Array
    weight: Array

    @property
    def coarser(self) -> Rule:
        """The rule of twice the step, to compare with."""
        return Rule(self.from_low[::2], self.to_high[::2], 2 * self.weight[::2])

    def between(self, low: Array, high: Array) -> Array:
        """Nodes between ends (...), shape (..., n), each measured from the end that it is nearer to."""
        low, high = np.asarray(low)[..., None], np.asarray(high)[..., None]
        near_low = low + (high - low) * self.from_low
        return np.asarray(np.where(self.from_low < 0.5, near_low, high - (high - low) * self.to_high))

    def integral(self, function: Function, ends: Array) -> float:
        """∫ of a function between the first and the last of the ends (n,), cut at the others."""
        return float(np.diff(ends) @ (function(self.between(ends[:-1], ends[1:])) @ self.weight))


@lru_cache
def double_exponential(step: float = 0.11) -> Rule:
    """Rule with nodes to 1e-68 of the interval at its low end, where powers begin, 1e-25 at the other."""
    t = np.arange(-4.6, 3.6, step)
    exponent = np.pi * np.sinh(t)
    from_low, to_high = 1 / (1 + np.exp(-exponent)), 1 / (1 + np.exp(exponent))
    return Rule(from_low, to_high, step * np.pi * np.cosh(t) * from_low * to_high)


def in_chunks(function: Callable[..., Array], *arrays: Array) -> Array:
    """``function`` of arrays (n,), applied to arrays of any shape in chunks."""
    flat = [np.ravel(array) for array in arrays]
    answer = np.empty(flat[0].size)
    for i in range(0, answer.size, CHUNK):
        answer[i : i + CHUNK] = function(*(array[i : i + CHUNK] for array in flat))
    return plain(answer.reshape(np.shape(arrays[0])))


@lru_cache
def chebyshev_fit(n: int) -> tuple[Array, Array]:
    """The n Chebyshev points of [-1, 1] and the matrix from values there to coefficients."""
    k = np.arange(n)
    angle = np.pi * (k + 0.5) / n
    to_coefficients = 2 / n * np.cos(np.outer(k, angle))
    to_coefficients[0] /= 2
    return np.cos(angle), to_coefficients


@lru_cache
def _fit_matrices() -> tuple[Array, ...]:
    """Chebyshev points; matrices from values there to coefficients of the function and of its derivative."""
    nodes, to_coefficients = chebyshev_fit(N_FIT)
    to_slope = np.zeros((N_FIT, N_FIT))
    to_slope[:-1] = chebyshev.chebder(to_coefficients)
    return nodes, to_coefficients, to_slope


def derivative(function: Function, s: Array, reach: Array, low: float, high: float) -> Array:
    """Derivative at ``s`` from values in [low, high] no further than ``reach`` from ``s``.

    NaN where the function is not finite around ``s``.
    """
    shape, s, reach = s.shape, s.ravel(), reach.flatten()
    best = np.full((2, s.size), np.nan)  # the derivative and its error
    best[1] = np.inf
    todo = np.arange(s.size)
    for _ in range(N_HALVINGS):
        fit, resolved = _fit(function, s[todo], reach[todo], low, high)
        better = fit[1] < best[1, todo]
        best[:, todo[better]] = fit[:, better]
        todo = todo[np.logical_not(resolved)]
        if todo.size == 0:
            break
        reach[todo] /= 2
    return np.asarray(best[0].reshape(shape))


def _fit(function: Function, s: Array, reach: Array, low: float, high: float) -> tuple[Array, Array]:
    """The derivative from one window, the error its last coefficients leave, whether that is rounding."""
    nodes, to_coefficients, to_slope = _fit_matrices()
    left, right = np.maximum(s - reach, low), np.minimum(s + reach, high)
    half = (right - left) / 2
    values = function((left + half)[:, None] + half[:, None] * nodes)
    last = np.abs(values @ to_coefficients[-2:].T).max(axis=1)
    scale = np.where(half > 0, half, 1.0)
    place = np.clip((s - left - half) / scale, -1, 1)
    basis = np.cos(np.arccos(place)[:, None] * np.arange(N_FIT))
    slope = np.sum(basis * (values @ to_slope.T), axis=1) / scale
    resolved = last <= 32 * EPS * np.abs(values).max(axis=1)
    return np.array([slope, last / scale]), resolved
