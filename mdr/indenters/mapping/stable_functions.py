"""Elementary functions of two lengths that lose no digits by cancellation; the closed forms are built of them.

Every shape with a flat or capped centre of radius b has an image in s = √(x² − b²) and φ = arccos(b/x). Taken
from their definitions these, and the small differences that areas are made of, lose all digits at x → b or
x ≪ R. The arguments are lengths (or an angle), never their squares: no magnitude over- or underflows.
"""

import numpy as np
from numpy.typing import ArrayLike

from mdr.tools.arrays import Array

GAUSS = np.polynomial.legendre.leggauss(14)  #: for a quarter turn of waves no shorter than a third of a turn


def leg(x: ArrayLike, b: ArrayLike) -> Array:
    """√(x² − b²), the length s from a kink at b; 0 for x <= b."""
    return np.asarray(np.sqrt(np.maximum(np.subtract(x, b), 0)) * np.sqrt(np.add(x, b)), dtype=np.float64)


def leg_short(x: ArrayLike, b: float) -> Array:
    """x − √(x² − b²), by which the leg is shorter than x; x itself for x <= b."""
    outside = np.maximum(x, b)
    return np.where(np.less(x, b), x, b * (b / (outside + leg(outside, b))))


def angle(x: ArrayLike, b: float) -> Array:
    """φ = arccos(b/x) for x > b, else 0."""
    return np.asarray(np.arctan2(leg(x, b), b), dtype=np.float64)


def arcosh(x: ArrayLike, y: Array) -> Array:
    """Arcosh(x/y), exact also for x close to y; 0 for x < y."""
    over = np.maximum(np.subtract(x, y), 0) / y
    return np.asarray(np.log1p(over + np.sqrt(over) * np.sqrt(over + 2)))


def artanh(x: ArrayLike, c: float) -> Array:
    """Artanh(x/c) for 0 <= x < c."""
    x = np.asarray(x)
    return np.asarray(np.log1p(2 * (x / (c - x))) / 2)


def angle_less_sine(y: ArrayLike) -> Array:
    """y − sin y for 0 <= y <= π."""
    y = np.asarray(y, dtype=np.float64)
    w, series = y * y, np.ones_like(y)
    for k in range(20, 2, -2):  # to y**20/21! below 1
        series = 1 - w / (k * (k + 1)) * series
    return np.asarray(np.where(y < 1, y * (w / 6) * series, y - np.sin(y)))


def sine_less_arc(y: ArrayLike) -> Array:
    """Sin y − y cos y for 0 <= y <= π/2."""
    y = np.asarray(y, dtype=np.float64)
    return np.asarray(2 * y * np.sin(y / 2) ** 2 - angle_less_sine(y))


def sine_less_arc_and_cube(y: ArrayLike) -> Array:
    """3 (sin y − y cos y) − sin³y = 3 ∫₀^y (cos t − cos y)² cos t dt for 0 <= y <= π/2.

    The integrand is positive and Gauss's rule exact to rounding; for small y it is (2/5) y⁵.
    """
    y = np.asarray(y, dtype=np.float64)[..., None]
    nodes, weights = GAUSS
    t = y * (nodes + 1) / 2
    rise = 2 * np.sin((y + t) / 2) * np.sin((y - t) / 2)
    return np.asarray(3 / 2 * y[..., 0] * (rise * rise * np.cos(t) @ weights))


def conic_area(u: ArrayLike, w: ArrayLike, angle: ArrayLike) -> Array:
    """u − (1 − w) A, w = u² and A = artanh u for an ellipse, w = −u² and A = arctan u for a hyperbola (times −1).

    For small u it is ±u³ Σ 2 w^j / ((2j + 1)(2j + 3)).
    """
    u, w = np.asarray(u, dtype=np.float64), np.asarray(w, dtype=np.float64)
    small = np.clip(w, -0.25, 0.25)
    series = np.zeros_like(u)
    for j in reversed(range(30)):  # terms of a series in w, |w| <= 1/4: 0.25**30 = 9e-19
        series = 2 / ((2 * j + 1) * (2 * j + 3)) + small * series
    return np.where(np.abs(w) < 0.25, u * w * series, u - (1 - w) * angle)
