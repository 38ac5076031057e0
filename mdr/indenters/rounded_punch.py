"""Flat punch with a rounded edge: f(r) = (r − b)²/2R outside the flat face, g(x) = (x/R) [√(x² − b²) − b arccos(b/x)].

Popov, Heß, Willert, Handbook of Contact Mechanics (2019).
"""

from dataclasses import dataclass, field

import numpy as np

from mdr.indenters.base import Indenter
from mdr.indenters.mapping.stable_functions import angle, sine_less_arc, sine_less_arc_and_cube
from mdr.indenters.worn import radius_of
from mdr.tools.arrays import Array
from mdr.tools.fields import facts


@dataclass(frozen=True)
class RoundedPunch(Indenter):
    """Flat punch with a rounded edge: d = g(a), F_N = E* (a³/R) [(4/3) sin φ − φ cos φ − (1/3) sin φ cos²φ].

    cos φ = b/a. Under a small load it is a flat punch: a → b and k_zc → 2E*b.
    """

    b: float = field(metadata=radius_of("face", "Paraboloid", 5e-4))
    R: float = field(metadata=facts("m", "radius of curvature of the edge", example=0.02))

    @property
    def kinks(self) -> tuple[float, ...]:
        """Where the rounding begins [m]."""
        return (self.b,)

    def _f(self, r: Array) -> Array:
        beyond = np.maximum(r - self.b, 0)
        return beyond / self.R * beyond / 2

    def _g(self, x: Array) -> Array:
        """(x²/R) (sin φ − φ cos φ) outside the face, cos φ = b/x."""
        return x / self.R * x * sine_less_arc(angle(x, self.b))

    def _area(self, a: Array) -> Array:
        """(a³/2R) [sin φ − φ cos φ − (1/3) sin³φ]."""
        return a / self.R * a * a / 6 * sine_less_arc_and_cube(angle(a, self.b))

    def _slope(self, s: Array, low: float, high: float) -> Array:
        if low < self.b:
            return np.zeros_like(s)
        x = np.hypot(s, self.b)
        return s / x * (2 * s - self.b * np.arctan2(s, self.b)) / self.R
