"""Functions of time over a stretch of a step: the parabolas on which the top of a spring moves, and what follows from
them. They are numbers, or vectors of the plane, which are complex.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.tools.jit import inner

FAST = {"reassoc", "contract"}
FAST_IN_PLANE = FAST | {"arcp", "nsz"}  # what is divided by the length of a vector shares its reciprocal
# arrays are only lent to these functions: numba need not count references to them, which takes time, to compile too
LENT = {"_nrt": False}
OWN = {"_nrt": True}  # of functions that make arrays; lent ones may call them, but get none of those
_inline = inner(forceinline=True, error_model="numpy", fastmath=FAST, **LENT)

NEVER = np.inf
ROUNDING = 4e-15  #: of a length, and of a time in a step


class Path(NamedTuple):
    """Motion of the top in a step: its depth z_0 + z_1 t + z_2 t², its displacement x_1 t + x_2 t² in the plane."""

    z_0: float
    z_1: float
    z_2: float
    x_1: complex  #: a number where all moves along one line
    x_2: complex


class Ends(NamedTuple):
    """A function of time at both ends of a stretch: values and slopes; and, of a number, bounds on its curvature."""

    v_0: complex
    d_0: complex
    v_1: complex
    d_1: complex
    low: float
    high: float


class Cubic(NamedTuple):
    """a + b t + c t² + d t³, a number or a vector."""

    a: complex
    b: complex
    c: complex
    d: complex


@_inline
def plus(f, sign, g):
    """f + sign g, of sign 1 or -1."""
    low, high = (g.low, g.high) if sign > 0.0 else (g.high, g.low)
    ends = f.v_0 + sign * g.v_0, f.d_0 + sign * g.d_0, f.v_1 + sign * g.v_1, f.d_1 + sign * g.d_1
    return Ends(ends[0], ends[1], ends[2], ends[3], f.low + sign * low, f.high + sign * high)


@_inline
def times(factor, f):
    """A multiple, not negative, of a function."""
    return Ends(factor * f.v_0, factor * f.d_0, factor * f.v_1, factor * f.d_1, factor * f.low, factor * f.high)


@_inline
def below(f, tol):
    """True for a function below zero as its time begins, or at zero and falling."""
    return f.v_0 < -tol or (f.v_0 <= tol and f.d_0 < 0.0)


@_inline
def stays(f, t, tol):
    """True if f, which begins above -tol, surely stays there; False means that it is not known.

    Convex (low >= 0): it lies above the crossing of the tangents at its ends. Concave (high <= 0): above its values at
    the ends. Else: above the higher of two parabolas of the curvature low, from either end.
    """
    lowest = f.v_1
    if f.low >= 0.0:
        if f.d_0 < 0.0 and f.d_1 > 0.0:
            lowest = f.v_0 + f.d_0 * (f.v_1 - f.v_0 - f.d_1 * t) / (f.d_0 - f.d_1)
    elif f.high > 0.0:
        bend = 0.5 * t * f.low
        lowest = min(lowest, max(f.v_0 + t * (f.d_0 + bend), f.v_1 - t * (f.d_1 - bend)))
    return lowest >= -tol


@_inline
def on_parabola(x, p, q, T, t):
    """Ends of L[x + p t + q t²], without arms."""
    v_1, d_1 = x + t * (p + q * t) + T * (p + 2.0 * q * t), p + 2.0 * q * t + 2.0 * T * q
    return Ends(x + T * p, p + 2.0 * T * q, v_1, d_1, 2.0 * q.real, 2.0 * q.real)


@_inline
def zero_of_parabola(f, t, tol, a, b, c):
    """First time up to t at which a + b t + c t², with the Ends f, falls below zero; infinite for none, or for a dip
    of less than tol between its ends.
    """
    if a <= tol and (b < 0.0 or (b == 0.0 and c < 0.0)):
        return 0.0
    inside = b * b - 4.0 * a * c
    if inside < 0.0 and c < 0.0:  # it begins below zero by a rounding, and never rises above it
        return 0.0
    if inside < 0.0 or (c >= 0.0 and (b >= 0.0 or (f.v_1 >= -tol and b * b < 4.0 * c * (a + tol)))):
        return NEVER
    root = np.sqrt(inside)
    u = (b + root) / (-2.0 * c) if b > 0.0 else 2.0 * a / (root - b)
    return min(u, t) if f.v_1 < -tol or u < t else NEVER


@_inline
def area_on_parabola(x, p, q, T, t):
    """Area and moment of L[x + p t + q t²] over a time, without arms."""
    area = t * (x + t * (0.5 * p + t * (1.0 / 3.0) * q))
    moment = t * t * (0.5 * x + t * ((1.0 / 3.0) * p + t * 0.25 * q))
    dx = t * (p + q * t)
    return area + T * dx, moment + T * (t * (x + dx) - area)


@_inline
def cubic(f, t):
    """The cubic with the values and slopes of the Ends f, a time t apart."""
    mean = (f.v_1 - f.v_0) * (1.0 / t)
    c = (3.0 * mean - 2.0 * f.d_0 - f.d_1) * (1.0 / t)
    return Cubic(f.v_0, f.d_0, c, (f.d_0 + f.d_1 - 2.0 * mean) * (1.0 / (t * t)))


@_inline
def at(f, t):
    """Value of a cubic."""
    return f.a + t * (f.b + t * (f.c + t * f.d))


@_inline
def slope(f, t):
    """Slope of a cubic."""
    return f.b + t * (2.0 * f.c + 3.0 * t * f.d)


@_inline
def multiple(factor, f):
    """A multiple of a cubic."""
    return Cubic(factor * f.a, factor * f.b, factor * f.c, factor * f.d)


@_inline
def cubic_later(f, t):
    """A cubic, its time counted from t on."""
    return Cubic(at(f, t), slope(f, t), f.c + 3.0 * f.d * t, f.d)


@_inline
def size_of(a):
    """Length of a vector; the library's `abs` guards against overflow, and takes several times as long."""
    return np.sqrt(a.real * a.real + a.imag * a.imag)


@_inline
def along(a, b):
    """Scalar product of two vectors."""
    return a.real * b.real + a.imag * b.imag
