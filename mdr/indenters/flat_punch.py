"""Flat punch of radius a: f = g = 0 inside the rim, F_N = 2E*ad (Boussinesq 1885)."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import Indenter
from mdr.indenters.mapped import rim_pressure
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array, plain
from mdr.tools.fields import facts


@dataclass(frozen=True)
class FlatPunch(Indenter):
    """Flat-ended cylinder, touching with its whole face; both profiles end at the rim."""

    a: float = field(metadata=facts("m", "radius of the face", example=1e-3))

    @property
    def max_radius(self) -> float:
        """The radius of the punch [m]."""
        return self.a

    def _f(self, r: Array) -> Array:
        return 0 * r

    def _g(self, x: Array) -> Array:
        return 0 * x

    def _area(self, a: Array) -> Array:
        return 0 * a

    def contact_radius(self, d: ArrayLike) -> Array:
        """The radius of the punch for d > 0, else 0."""
        return plain(np.where(finite_array("d", d, "m") > 0, self.a, 0.0))

    def pressure_inside(self, r: Array, a: Array, d: Array) -> Array:
        """p/E* = d / (π √(a² − r²))."""
        return rim_pressure(r, a, d)
