"""Paraboloid: f(r) = r²/(2R), mapped to g(x) = x²/R (Hertz 1882)."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import Indenter
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array, plain
from mdr.tools.fields import facts


@dataclass(frozen=True)
class Paraboloid(Indenter):
    """Paraboloid, the tip of any ball: a² = Rd, F_N = (4/3) E* √R d^{3/2}."""

    R: float = field(metadata=facts("m", "radius of curvature", example=0.05))

    def _f(self, r: Array) -> Array:
        return r / self.R * r / 2

    def _g(self, x: Array) -> Array:
        return x / self.R * x

    def _area(self, a: Array) -> Array:
        return a / self.R * a * a / 3

    def contact_radius(self, d: ArrayLike) -> Array:
        """Radius a = √(Rd)."""
        return plain(np.sqrt(self.R) * np.sqrt(np.maximum(finite_array("d", d, "m"), 0)))

    def pressure_inside(self, r: Array, a: Array, d: Array) -> Array:
        """p/E* = (2/(πR)) √(a² − r²)."""
        share = r / a
        return 2 / np.pi * (a / self.R) * np.sqrt((1 - share) * (1 + share))
