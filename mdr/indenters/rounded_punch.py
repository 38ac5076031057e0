"""Flat punch with a rounded edge: f(r) = (r − b)²/2R outside the flat face, g(x) = (x/R) [√(x² − b²) − b arccos(b/x)].

Popov, Heß, Willert, Handbook of Contact Mechanics (2019).
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import Indenter
from mdr.indenters.mapping.stable_functions import angle, sine_less_arc, sine_less_arc_and_cube
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array, plain
from mdr.tools.fields import facts


@dataclass(frozen=True)
class RoundedPunch(Indenter):
    """Flat punch with a rounded edge: d = g(a), F_N = E* (a³/R) [(4/3) sin φ − φ cos φ − (1/3) sin φ cos²φ].

    cos φ = b/a. Under a small load it is a flat punch: a → b and k_zc → 2E*b.
    """

    b: float = field(
        metadata=facts("m", "radius of the face", note="radius of the face in m; a Paraboloid has none", example=5e-4)
    )
    R: float = field(metadata=facts("m", "radius of curvature of the edge", example=0.02))

    @property
    def kinks(self) -> tuple[float, ...]:
        """Where the rounding begins [m]."""
        return (self.b,)

    def profile_3d(self, r: ArrayLike) -> Array:
        """f(r) = (r − b)²/2R outside the face."""
        way = np.maximum(np.abs(finite_array("r", r, "m")) - self.b, 0)
        return plain(way / self.R * way / 2)

    def profile_1d(self, x: ArrayLike) -> Array:
        """g(x) = (x²/R) (sin φ − φ cos φ) outside the face, cos φ = b/x."""
        x = np.abs(finite_array("x", x, "m"))
        return plain(x / self.R * x * sine_less_arc(angle(x, self.b)))

    def profile_area(self, a: ArrayLike) -> Array:
        """∫₀^a g dx = (a³/2R) [sin φ − φ cos φ − (1/3) sin³φ]."""
        a = np.abs(finite_array("a", a, "m"))
        return plain(a / self.R * a * a / 6 * sine_less_arc_and_cube(angle(a, self.b)))

    def _slope(self, s: Array, low: float, high: float) -> Array:
        if low < self.b:
            return np.zeros_like(s)
        x = np.hypot(s, self.b)
        return np.asarray(s / x * (2 * s - self.b * np.arctan2(s, self.b)) / self.R)
