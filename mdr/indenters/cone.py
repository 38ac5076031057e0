"""Cone: f(r) = r tan θ, mapped to g(x) = (π/2) |x| tan θ (Sneddon 1965)."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import FLANK, Indenter
from mdr.tools.arrays import EPS, Array
from mdr.tools.checks import finite_array, plain


@dataclass(frozen=True)
class Cone(Indenter):
    """Cone; F_N = (2/π) E* d² / tan θ. The pressure at its tip is infinite and answered as at r = 2e-16 a."""

    theta: float = field(metadata=FLANK)

    def profile_3d(self, r: ArrayLike) -> Array:
        """f(r) = r tan θ."""
        return plain(np.abs(finite_array("r", r, "m")) * np.tan(self.theta))

    def profile_1d(self, x: ArrayLike) -> Array:
        """``g(x) = (π/2) |x| tan θ``."""
        return plain(np.pi / 2 * np.abs(finite_array("x", x, "m")) * np.tan(self.theta))

    def contact_radius(self, d: ArrayLike) -> Array:
        """Radius a = 2d / (π tan θ)."""
        return plain(np.maximum(finite_array("d", d, "m"), 0) / (np.pi / 2 * np.tan(self.theta)))

    def profile_area(self, a: ArrayLike) -> Array:
        """∫₀^a g dx = (π/4) a² tan θ."""
        return plain(np.pi / 4 * finite_array("a", a, "m") ** 2 * np.tan(self.theta))

    def pressure_inside(self, r: Array, a: Array, d: Array) -> Array:
        """p/E* = (tan θ / 2) arcosh(a/r)."""
        over = a / np.maximum(r, EPS * a) - 1  # arcosh(1 + over), exact also at the edge
        return plain(np.tan(self.theta) / 2 * np.log1p(over + np.sqrt(over) * np.sqrt(over + 2)))
