"""Ellipsoid of revolution: f(r) = R (1 − √(1 − k²r²)), mapped to g(x) = x k R artanh(k|x|).

Popov, Heß, Willert, Handbook of Contact Mechanics (2019). k = 1/R is the sphere; the radius of curvature at the
tip is 1/(k²R). In the functions below R is the half-axis along the axis of revolution and c = 1/k the one across.
"""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import Indenter
from mdr.indenters.mapping.stable_functions import artanh, conic_area
from mdr.tools.arrays import Array
from mdr.tools.checks import FieldError, finite_array, plain, positive
from mdr.tools.fields import facts


def _invertible(name: str, value: Any, note: str = "") -> float:
    k = positive(name, value, note)
    if not 0 < 1 / k < np.inf:
        raise FieldError(f"{name} = {k!r} 1/m: its inverse, the half-axis across, is beyond the range of floats", name)
    return k


@dataclass(frozen=True)
class Ellipsoid(Indenter):
    """Ellipsoid of half-axes R and 1/k: d = g(a), F_N = E* (R/k) [(1 + k²a²) artanh(ka) − ka].

    Its contact grows to the equator, a = 1/k, at infinite depth only: g is finite for ``|x| < 1/k``.
    """

    R: float = field(metadata=facts("m", "half-axis along the axis of revolution", example=0.05))
    k: float = field(metadata=facts("1/m", "inverse of the half-axis across", _invertible, example=20.0))

    @property
    def max_radius(self) -> float:
        """The last number below 1/k [m]."""
        return float(np.nextafter(1 / self.k, 0))

    def profile_3d(self, r: ArrayLike) -> Array:
        """f(r) = R (1 − √(1 − k²r²)), up to the equator."""
        return height(self, finite_array("r", r, "m"), self.R, 1 / self.k)

    def profile_1d(self, x: ArrayLike) -> Array:
        """``g(x) = x k R artanh(kx), |x| < 1/k``."""
        return image(self, finite_array("x", x, "m"), self.R, 1 / self.k)

    def profile_area(self, a: ArrayLike) -> Array:
        """∫₀^a g dx = (R/2k) [ka − (1 − k²a²) artanh(ka)]."""
        return area(self, finite_array("a", a, "m"), self.R, 1 / self.k)

    def _slope(self, s: Array, low: float, high: float) -> Array:
        return slope(s, self.R, 1 / self.k)

    def _why_too_deep(self, reach: float) -> str:
        return past_equator(1 / self.k, reach)


def height(shape: Indenter, r: Array, R: float, c: float) -> Array:
    """f(r) for |r| <= c."""
    if np.any(np.abs(r) > c):
        raise ValueError(
            f"{type(shape).__name__} ends at its equator r = {c:.6g} m, got {np.max(np.abs(r)):.6g} m: stay within it"
        )
    u = np.abs(r) / c
    return plain(R * u / (1 + np.sqrt((1 - u) * (1 + u))) * u)


def image(shape: Indenter, x: Array, R: float, c: float) -> Array:
    """g(x) for |x| < c."""
    x = _inside(shape, x, c)
    return plain(R * (x / c) * artanh(x, c))


def area(shape: Indenter, a: Array, R: float, c: float) -> Array:
    """∫₀^a g dx."""
    a = _inside(shape, a, c)
    u = a / c
    return plain(R / 2 * c * conic_area(u, u * u, artanh(a, c)))


def slope(x: Array, R: float, c: float) -> Array:
    """dg/dx."""
    return np.asarray(R / c * (artanh(x, c) + x / (c - x) * (c / (c + x))))


def past_equator(c: float, reach: float) -> str:
    """How a message goes on about too great a depth."""
    return f"can be pressed: at {reach:.6g} m its contact is the equator, {c:.6g} m, but for a rounding; press less"


def _inside(shape: Indenter, x: Array, c: float) -> Array:
    """|x|, refused from the equator on."""
    x = np.abs(x)
    if np.any(x > shape.max_radius):
        raise ValueError(
            f"{type(shape).__name__} is touched within its equator only, x < {c:.6g} m, where g becomes infinite; "
            f"got {np.max(x):.6g} m: stay within it"
        )
    return x
