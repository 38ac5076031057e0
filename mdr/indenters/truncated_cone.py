"""Truncated cone: a flat face of radius b with the flank f(r) = (r − b) tan θ, g(x) = x tan θ arccos(b/x) for x > b.

Popov, Heß, Willert, Handbook of Contact Mechanics (2019).
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import FLANK, Indenter
from mdr.indenters.mapping.stable_functions import angle, angle_less_sine
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array, plain
from mdr.tools.fields import facts


@dataclass(frozen=True)
class TruncatedCone(Indenter):
    """Worn cone: d = g(a), F_N = E* a² tan θ (φ + cos φ sin φ) with cos φ = b/a.

    Under a small load it is a flat punch: a → b and k_zc → 2E*b; at the edge of its face p is infinite, and answered
    as one rounding away.
    """

    b: float = field(
        metadata=facts("m", "radius of the face", note="radius of the face in m; a Cone has none", example=3e-4)
    )
    theta: float = field(metadata=FLANK)

    @property
    def kinks(self) -> tuple[float, ...]:
        """The edge of the face [m]."""
        return (self.b,)

    def profile_3d(self, r: ArrayLike) -> Array:
        """f(r) = (r − b) tan θ outside the face."""
        return plain(np.maximum(np.abs(finite_array("r", r, "m")) - self.b, 0) * np.tan(self.theta))

    def profile_1d(self, x: ArrayLike) -> Array:
        """g(x) = x tan θ arccos(b/x) outside the face."""
        x = np.abs(finite_array("x", x, "m"))
        return plain(x * np.tan(self.theta) * angle(x, self.b))

    def profile_area(self, a: ArrayLike) -> Array:
        """∫₀^a g dx = (a²/2) tan θ (φ − cos φ sin φ)."""
        a = np.abs(finite_array("a", a, "m"))
        return plain(a * a / 4 * np.tan(self.theta) * angle_less_sine(2 * angle(a, self.b)))

    def _slope(self, s: Array, low: float, high: float) -> Array:
        if low < self.b:
            return np.zeros_like(s)
        x = np.hypot(s, self.b)
        return np.asarray(np.tan(self.theta) * (s / x * np.arctan2(s, self.b) + self.b / x))
