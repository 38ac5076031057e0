"""Cone: f(r) = r tan θ, mapped to g(x) = (π/2) |x| tan θ (Sneddon 1965)."""

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import Indenter
from mdr.indenters.mapping.stable_functions import arcosh
from mdr.tools.arrays import EPS, Array
from mdr.tools.checks import between, finite_array, plain
from mdr.tools.fields import facts


def _slope_angle(name: str, value: Any, note: str = "") -> float:
    return between(name, value, 0, np.pi / 2, note)


FLANK = facts(
    "rad",
    "angle between flank and plane",
    _slope_angle,
    example=0.0127,
    note="angle between flank and plane in rad; 45 degrees are 0.785",
)


@dataclass(frozen=True)
class Cone(Indenter):
    """Cone; F_N = (2/π) E* d² / tan θ. The pressure at its tip is infinite and answered as at r = 2e-16 a."""

    theta: float = field(metadata=FLANK)

    def _f(self, r: Array) -> Array:
        return r * math.tan(self.theta)

    def _g(self, x: Array) -> Array:
        return np.pi / 2 * x * math.tan(self.theta)

    def _area(self, a: Array) -> Array:
        return np.pi / 4 * a**2 * math.tan(self.theta)

    def contact_radius(self, d: ArrayLike) -> Array:
        """Radius a = 2d / (π tan θ)."""
        return plain(np.maximum(finite_array("d", d, "m"), 0) / (np.pi / 2 * math.tan(self.theta)))

    def pressure_inside(self, r: Array, a: Array, d: Array) -> Array:
        """p/E* = (tan θ / 2) arcosh(a/r)."""
        return math.tan(self.theta) / 2 * arcosh(a, np.maximum(r, EPS * a))
