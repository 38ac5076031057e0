"""The contact radius a with g(a) = d for any non-decreasing g, to the last digits and at any length scale."""

import numpy as np
from numpy.typing import NDArray

from mdr.indenters.mapping.quadrature import Function
from mdr.tools.arrays import EPS, Array

BoolArray = NDArray[np.bool_]


def invert(g: Function, d: Array, start: Array, end: float) -> tuple[Array, BoolArray]:
    """Radius a in (0, end] with g(a) = d for depths d > 0 (n,), from ``start`` on; and where g ends early.

    Where g is not finite it counts as higher than d; an ``a`` found at such a place is no contact radius.
    """
    with np.errstate(all="ignore"):
        return refine(g, d, *bracket(g, d, start, end))


def _above(g: Function, a: Array, d: Array) -> Array:
    y = g(a) - d
    return np.where(np.isnan(y), np.inf, y)


def bracket(g: Function, d: Array, start: Array, end: float) -> tuple[Array, ...]:
    """Bracket of at most a factor of two and g - d at its ends.

    Strides of 1, 2, 4 … octaves lead across the root, halving their logarithm leads back.
    """
    low, high, a = np.zeros_like(d), np.full_like(d, end), np.minimum(start, end)
    y_low, y_high, stride = -d, np.full_like(d, np.inf), np.ones_like(d)
    todo = np.arange(d.size)
    for _ in range(100):
        i = todo
        y, at = _above(g, a[i], d[i]), a[i]
        up = y <= 0
        low[i[up]], y_low[i[up]], high[i[~up]], y_high[i[~up]] = at[up], y[up], at[~up], y[~up]
        todo = i[(low[i] == 0) | (high[i] > 2 * low[i])]
        if todo.size == 0:
            break
        below, above, at = low[todo], high[todo], a[todo]
        out = np.clip(at * 2.0 ** np.where(below > 0, stride[todo], -stride[todo]), 5e-324, min(end, 1e308))
        closed = (below > 0) & np.isfinite(above)
        a[todo] = np.where(closed, np.sqrt(below) * np.sqrt(np.where(closed, above, 1.0)), out)
        stride[todo] = np.minimum(2 * stride[todo], 512)
    unknown = np.isinf(y_high)
    y_high[unknown] = np.maximum(_above(g, high[unknown], d[unknown]), 0)  # d is g(end) but for rounding
    return low, high, y_low, y_high


def refine(g: Function, d: Array, low: Array, high: Array, y_low: Array, y_high: Array) -> tuple[Array, BoolArray]:
    """Root between brackets by Chandrupatla's method (1997), and whether g is infinite there."""
    a, b, fa, fb = high, low, y_high, y_low
    c, fc, t = a, fa, np.full_like(a, 0.5)
    done = np.zeros(a.shape, dtype=bool)
    for _ in range(120):
        best = np.where(np.abs(fa) < np.abs(fb), a, b)
        closeness = 2 * EPS * best / np.abs(b - a)
        done = (closeness >= 0.5) | (np.minimum(np.abs(fa), np.abs(fb)) <= EPS / 2 * d) | (a == b)
        if np.all(done):
            break
        least = np.minimum(closeness, 0.5)
        t = np.where(done, 0.0, np.clip(t, least, 1 - least))
        middle, value = np.where(done, a, a + t * (b - a)), fa.copy()
        value[~done] = _above(g, middle[~done], d[~done])
        same = np.sign(value) == np.sign(fa)
        c, fc = np.where(same, a, b), np.where(same, fa, fb)
        b, fb = np.where(same, b, a), np.where(same, fb, fa)
        a, fa = middle, value
        t = _step(a, b, c, fa, fb, fc)
    return best, np.isinf(np.maximum(fa, fb)) & (np.minimum(np.abs(fa), np.abs(fb)) > EPS * d)


def _step(a: Array, b: Array, c: Array, fa: Array, fb: Array, fc: Array) -> Array:
    """Share of the bracket to go in one step: inverse quadratic interpolation where it is safe, else bisection."""
    xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
    safe = (phi**2 < xi) & ((1 - phi) ** 2 < 1 - xi)
    quadratic = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
    return np.where(safe & np.isfinite(quadratic), quadratic, 0.5)
