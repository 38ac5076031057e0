"""Ellipsoid of revolution: f(r) = R (1 − √(1 − k²r²)), mapped to g(x) = x k R artanh(k|x|).

Popov, Heß, Willert, Handbook of Contact Mechanics (2019). k = 1/R is the sphere; the radius of curvature at the
tip is 1/(k²R).
"""

from abc import abstractmethod
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import Indenter
from mdr.indenters.mapping.stable_functions import artanh, conic_area
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array, plain, positive
from mdr.tools.fields import facts


class Spheroid(Indenter):
    """A shape that ends at an equator, which its contact reaches at infinite depth only."""

    @property
    @abstractmethod
    def _half_axes(self) -> tuple[float, float]:
        """That along the axis of revolution and that across, the radius of the equator [m]."""

    @property
    def max_radius(self) -> float:
        """The last number below the radius of the equator [m]."""
        return float(np.nextafter(self._half_axes[1], 0))

    def profile_3d(self, r: ArrayLike) -> Array:
        """f(r), up to the equator."""
        (R, c), r = self._half_axes, np.abs(finite_array("r", r, "m"))
        if np.any(r > c):
            raise ValueError(
                f"{type(self).__name__} ends at its equator r = {c:.6g} m, got {np.max(r):.6g} m: stay within it"
            )
        u = r / c
        return plain(R * u / (1 + np.sqrt((1 - u) * (1 + u))) * u)

    def _g(self, x: Array) -> Array:
        R, c = self._half_axes
        return R * (x / c) * artanh(x, c)

    def _area(self, a: Array) -> Array:
        (R, c), u = self._half_axes, a / self._half_axes[1]
        return R / 2 * c * conic_area(u, u * u, artanh(a, c))

    def _within(self, r: Array) -> Array:
        r = np.abs(r)
        if np.any(r > self.max_radius):
            raise ValueError(
                f"{type(self).__name__} is touched within its equator only, x < {self._half_axes[1]:.6g} m, where g "
                f"becomes infinite; got {np.max(r):.6g} m: stay within it"
            )
        return r

    def _why_too_deep(self, reach: float) -> str:
        equator = f"its contact is the equator, {self._half_axes[1]:.6g} m, but for a rounding"
        return f"can be pressed: at {reach:.6g} m {equator}; press less"


def _invertible(name: str, value: Any, note: str = "") -> float:
    k = positive(name, value, note)
    if not 0 < 1 / k < np.inf:
        raise ValueError(f"{name} = {k!r} 1/m: its inverse, the half-axis across, is beyond the range of floats")
    return k


@dataclass(frozen=True)
class Ellipsoid(Spheroid):
    """Ellipsoid of half-axes R and 1/k: d = g(a), F_N = E* (R/k) [(1 + k²a²) artanh(ka) − ka].

    Its contact grows to the equator, a = 1/k, at infinite depth only: g is finite for ``|x| < 1/k``.
    """

    R: float = field(metadata=facts("m", "half-axis along the axis of revolution", example=0.05))
    k: float = field(metadata=facts("1/m", "inverse of the half-axis across", _invertible, example=20.0))

    @property
    def _half_axes(self) -> tuple[float, float]:
        return self.R, 1 / self.k
