"""Paraboloid: f(r) = r²/(2R), mapped to g(x) = x²/R; the Hertzian contact."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.checks import positive
from mdr.indenters.base import Array, Indenter, depth, each, radius


@dataclass(frozen=True)
class Paraboloid(Indenter):
    """A paraboloid of radius of curvature R; F_N = (4/3) E* sqrt(R) d^(3/2) (Hertz 1882)."""

    R: float  #: radius of curvature at the apex [m]

    def __post_init__(self) -> None:
        object.__setattr__(self, "R", positive("R", self.R, "radius of curvature in m"))

    def profile_3d(self, r: ArrayLike) -> Any:
        """r²/(2R) [m]."""
        return each(lambda r: r * (r / (2 * self.R)), radius(r))

    def profile_1d(self, x: ArrayLike) -> Any:
        """x²/R [m]."""
        return each(lambda x: x * (x / self.R), radius(x, "x"))

    def contact_radius(self, d: ArrayLike) -> Any:
        """sqrt(R d) [m]."""
        return each(lambda d: np.sqrt(self.R) * np.sqrt(np.maximum(d, 0)), depth(d))

    def _area(self, d: Array, a: Array) -> Array:
        return 2 / 3 * np.maximum(d, 0) * a

    def _pressure(self, r: Array, d: float, a: float) -> Array:
        """(2/pi) sqrt(a² - r²)/R (Hertz 1882)."""
        return 2 / np.pi * np.sqrt(np.maximum((a - r) * (a + r), 0)) / self.R
