"""Cone: f(r) = r tan(theta), mapped to g(x) = (pi/2) |x| tan(theta)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.checks import between
from mdr.indenters.base import Array, Indenter, depth, each, radius


@dataclass(frozen=True)
class Cone(Indenter):
    """A cone; F_N = 2 E* d²/(pi tan(theta)) (Sneddon 1965)."""

    theta: float  #: angle between flank and plane [rad]; the theory is one of small slopes

    def __post_init__(self) -> None:
        angle = between("theta", self.theta, 0, np.pi / 2, "angle between flank and plane in rad")
        object.__setattr__(self, "theta", angle)

    def profile_3d(self, r: ArrayLike) -> Any:
        """r tan(theta) [m]."""
        return each(lambda r: np.abs(r) * np.tan(self.theta), radius(r))

    def profile_1d(self, x: ArrayLike) -> Any:
        """(pi/2) |x| tan(theta) [m]."""
        return each(lambda x: np.pi / 2 * np.abs(x) * np.tan(self.theta), radius(x, "x"))

    def contact_radius(self, d: ArrayLike) -> Any:
        """2 d/(pi tan(theta)) [m]."""
        return each(lambda d: 2 * np.maximum(d, 0) / (np.pi * np.tan(self.theta)), depth(d))

    def _area(self, d: Array, a: Array) -> Array:
        return 0.5 * np.maximum(d, 0) * a

    def _pressure(self, r: Array, d: float, a: float) -> Array:
        """(tan(theta)/2) arcosh(a/r) (Sneddon 1965); unbounded at the apex, where it is given at 1e-300 m."""
        inside = r < a
        ratio = np.where(inside, a / np.maximum(r, 1e-300), 1.0)
        return np.where(inside, 0.5 * np.tan(self.theta) * np.arccosh(np.maximum(ratio, 1.0)), 0.0)
