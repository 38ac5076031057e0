"""Sphere: f(r) = R − √(R² − r²), mapped to g(x) = (x/2) ln((R + x)/(R − x)) (Segedin 1957).

Popov, Heß, Willert, Handbook of Contact Mechanics (2019). The paraboloid is its limit a ≪ R.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters import ellipsoid
from mdr.indenters.base import Indenter
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array
from mdr.tools.fields import facts


@dataclass(frozen=True)
class Sphere(Indenter):
    """Ball of radius R: d = g(a), F_N = (E*/2) [(R² + a²) ln((R + a)/(R − a)) − 2aR].

    Its contact grows to the equator, a = R, at infinite depth only: g is finite for ``|x| < R``.
    """

    R: float = field(metadata=facts("m", "radius of the ball", example=0.05))

    @property
    def max_radius(self) -> float:
        """The last number below R [m]."""
        return float(np.nextafter(self.R, 0))

    def profile_3d(self, r: ArrayLike) -> Array:
        """f(r) = R − √(R² − r²), up to the equator."""
        return ellipsoid.height(self, finite_array("r", r, "m"), self.R, self.R)

    def profile_1d(self, x: ArrayLike) -> Array:
        """``g(x) = x artanh(x/R), |x| < R``."""
        return ellipsoid.image(self, finite_array("x", x, "m"), self.R, self.R)

    def profile_area(self, a: ArrayLike) -> Array:
        """∫₀^a g dx = ½ [aR − (R² − a²) artanh(a/R)]."""
        return ellipsoid.area(self, finite_array("a", a, "m"), self.R, self.R)

    def _slope(self, s: Array, low: float, high: float) -> Array:
        return ellipsoid.slope(s, self.R, self.R)

    def _why_too_deep(self, reach: float) -> str:
        return ellipsoid.past_equator(self.R, reach)
