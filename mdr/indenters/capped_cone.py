"""Cone with a parabolic cap: f(r) = r²/2R for r < b = R tan θ, going over into the flank without a corner.

Popov, Heß, Willert, Handbook of Contact Mechanics (2019).
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import FLANK, Indenter
from mdr.indenters.mapping.stable_functions import angle, leg, leg_short
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array, plain
from mdr.tools.fields import facts


@dataclass(frozen=True)
class CappedCone(Indenter):
    """Cone with a rounded tip: d = g(a), F_N = E* (a³/R) [4/3 + φ cos φ − (4/3) sin φ + (1/3) sin φ cos²φ].

    cos φ = b/a; F_N = (4/3) E* a³/R while a <= b.
    """

    b: float = field(
        metadata=facts("m", "radius of the cap", note="radius of the cap in m; a Cone has none", example=3e-4)
    )
    theta: float = field(metadata=FLANK)

    @property
    def R(self) -> float:
        """Radius of curvature of the cap, b/tan θ [m]."""
        return float(self.b / np.tan(self.theta))

    @property
    def kinks(self) -> tuple[float, ...]:
        """Where cap and flank meet [m]."""
        return (self.b,)

    def profile_3d(self, r: ArrayLike) -> Array:
        """f(r) = r²/2R within the cap, (r − b/2) tan θ outside."""
        r = np.abs(finite_array("r", r, "m"))
        inside = np.minimum(r, self.b)
        return plain(np.tan(self.theta) * (inside / self.b * inside / 2 + (r - inside)))

    def profile_1d(self, x: ArrayLike) -> Array:
        """g(x) = x²/R within the cap, (x/R) (x − √(x² − b²)) + x tan θ arccos(b/x) outside."""
        x = np.abs(finite_array("x", x, "m"))
        return plain(x * np.tan(self.theta) * (leg_short(x, self.b) / self.b + angle(x, self.b)))

    def profile_area(self, a: ArrayLike) -> Array:
        """∫₀^a g dx = a³/3R within the cap, (a³/6R) [2 − 3 sin φ + sin³φ + 3φ cos φ] outside."""
        a = np.abs(finite_array("a", a, "m"))
        short = leg_short(a, self.b)
        inner = short / self.b * short * (2 * a + leg(a, self.b))  # a³ (2 − 3 sin φ + sin³φ)/b
        return plain(np.tan(self.theta) * (inner + 3 * a * a * angle(a, self.b)) / 6)

    def _slope(self, s: Array, low: float, high: float) -> Array:
        if low < self.b:
            return np.asarray(2 / self.b * s * np.tan(self.theta))
        x = np.hypot(s, self.b)
        cap = self.b / (x + s)
        return np.asarray(s / x * np.tan(self.theta) * (2 * cap + np.arctan2(s, self.b)))
