"""Hyperboloid: f(r) = h (√(1 + r²/c²) − 1), mapped to g(x) = (h x/c) arctan(x/c).

Popov, Heß, Willert, Handbook of Contact Mechanics (2019). A rounded cone: its tip has the radius of curvature c²/h,
its flank the slope h/c.
"""

from dataclasses import dataclass, field

import numpy as np

from mdr.indenters.base import Indenter
from mdr.indenters.mapping.stable_functions import conic_area
from mdr.tools.arrays import Array
from mdr.tools.fields import facts


@dataclass(frozen=True)
class Hyperboloid(Indenter):
    """Hyperboloid of revolution: d = g(a), F_N = E* (h/c) [(a² − c²) arctan(a/c) + ac]."""

    h: float = field(metadata=facts("m", "half-axis along the axis of revolution", example=2e-5))
    c: float = field(metadata=facts("m", "half-axis across", example=1e-3))

    def _f(self, r: Array) -> Array:
        u = r / self.c
        return np.asarray(self.h * u * (u / (1 + np.hypot(1, u))))

    def _g(self, x: Array) -> Array:
        u = x / self.c
        return np.asarray(self.h * u * np.arctan(u))

    def _area(self, a: Array) -> Array:
        """(h c/2) [(1 + u²) arctan u − u] with u = a/c."""
        u = a / self.c
        return -self.h / 2 * self.c * conic_area(u, -u * u, np.arctan(u))
