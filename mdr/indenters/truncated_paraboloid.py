"""Truncated paraboloid: a flat face of radius b with f(r) = (r² − b²)/2R around it, g(x) = (x/R) √(x² − b²) for x > b.

Popov, Heß, Willert, Handbook of Contact Mechanics (2019).
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import Indenter
from mdr.indenters.mapping.stable_functions import leg
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array, plain
from mdr.tools.fields import facts


@dataclass(frozen=True)
class TruncatedParaboloid(Indenter):
    """Worn ball: d = g(a), F_N = (2E*/3R) (2a² + b²) √(a² − b²).

    Under a small load it is a flat punch: a → b and k_zc → 2E*b; at the edge of its face p is infinite, and answered
    as one rounding away.
    """

    b: float = field(
        metadata=facts("m", "radius of the face", note="radius of the face in m; a Paraboloid has none", example=5e-4)
    )
    R: float = field(metadata=facts("m", "radius of curvature", example=0.04))

    @property
    def kinks(self) -> tuple[float, ...]:
        """The edge of the face [m]."""
        return (self.b,)

    def profile_3d(self, r: ArrayLike) -> Array:
        """f(r) = (r² − b²)/2R outside the face."""
        r = np.abs(finite_array("r", r, "m"))
        return plain(np.maximum(r - self.b, 0) / self.R * ((r + self.b) / 2))

    def profile_1d(self, x: ArrayLike) -> Array:
        """g(x) = (x/R) √(x² − b²) outside the face."""
        x = np.abs(finite_array("x", x, "m"))
        return plain(x / self.R * leg(x, self.b))

    def contact_radius(self, d: ArrayLike) -> Array:
        """Radius a² = b²/2 + √(b⁴/4 + R²d²) for d > 0."""
        d = finite_array("d", d, "m")
        sphere = np.sqrt(self.R) * np.sqrt(np.maximum(d, 0))
        unit = np.maximum(sphere, self.b)
        face = (self.b / unit) ** 2 / 2
        a = np.maximum(unit * np.sqrt(face + np.hypot(face, (sphere / unit) ** 2)), self.b)
        return plain(np.where(d > 0, a, 0.0))

    def profile_area(self, a: ArrayLike) -> Array:
        """∫₀^a g dx = (a² − b²)^{3/2} / 3R."""
        s = leg(np.abs(finite_array("a", a, "m")), self.b)
        return plain(s / self.R * s * s / 3)

    def _slope(self, s: Array, low: float, high: float) -> Array:
        if low < self.b:
            return np.zeros_like(s)
        x = np.hypot(s, self.b)
        return np.asarray((x + s / x * s) / self.R)
