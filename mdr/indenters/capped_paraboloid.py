"""Paraboloid with a parabolic cap: radius of curvature R1 for r < b, R2 <= R1 outside.

Popov, Heß, Willert, Handbook of Contact Mechanics (2019). R1 → ∞ is the truncated paraboloid, R1 = R2 the paraboloid.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import Indenter
from mdr.indenters.mapping.stable_functions import leg, leg_short
from mdr.tools.arrays import Array
from mdr.tools.checks import FieldError, finite_array, plain
from mdr.tools.fields import facts


@dataclass(frozen=True)
class CappedParaboloid(Indenter):
    """Ball worn to a flatter cap: d = g(a), F_N = (2E*/3) [2a³/R1 − (1/R1 − 1/R2) (2a² + b²) √(a² − b²)].

    F_N = (4/3) E* a³/R1 while a <= b. At the edge of the cap p is infinite, and answered as one rounding away.
    """

    R1: float = field(metadata=facts("m", "radius of curvature of the cap", example=0.1))
    R2: float = field(metadata=facts("m", "radius of curvature around the cap", example=0.04))
    b: float = field(
        metadata=facts("m", "radius of the cap", note="radius of the cap in m; a Paraboloid has none", example=5e-4)
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.R2 > self.R1:
            raise FieldError(
                f"R2 must not exceed R1 = {self.R1:.6g} m, got {self.R2:.6g} m: outside a sharper cap the slope drops, "
                "so that a ring touches before the disc inside it (annular contact); the method needs a full disc",
                "R2",
            )

    @property
    def kinks(self) -> tuple[float, ...]:
        """The edge of the cap [m]."""
        return (self.b,)

    def profile_3d(self, r: ArrayLike) -> Array:
        """f(r) = r²/2R1 within the cap, b²/2R1 + (r² − b²)/2R2 outside."""
        r = np.abs(finite_array("r", r, "m"))
        inside = np.minimum(r, self.b)
        return plain(inside / self.R1 * inside / 2 + (r - inside) / self.R2 * ((r + self.b) / 2))

    def profile_1d(self, x: ArrayLike) -> Array:
        """g(x) = x²/R1 within the cap, (x/R1) (x − √(x² − b²)) + (x/R2) √(x² − b²) outside."""
        x = np.abs(finite_array("x", x, "m"))
        return plain(x * (leg_short(x, self.b) / self.R1 + leg(x, self.b) / self.R2))

    def profile_area(self, a: ArrayLike) -> Array:
        """∫₀^a g dx = ⅓ [(a³ − s³)/R1 + s³/R2] with s = √(a² − b²), 0 within the cap."""
        a = np.abs(finite_array("a", a, "m"))
        s = leg(a, self.b)
        return plain((leg_short(a, self.b) / self.R1 * (a * a + a * s + s * s) + s / self.R2 * s * s) / 3)

    def _slope(self, s: Array, low: float, high: float) -> Array:
        if low < self.b:
            return np.asarray(2 / self.R1 * s)
        x = np.hypot(s, self.b)
        corner = (self.R1 - self.R2) / self.R1 / self.R2
        return np.asarray((x + s / x * s) * corner + 2 * s / self.R1)
