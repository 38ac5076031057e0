"""Concave punch: a cylinder of radius a whose face is hollow, f(r) = −r²/2R, mapped to g(x) = −x²/R.

Popov, Heß, Willert, Handbook of Contact Mechanics (2019). The depth counts from the middle of the face, the rim is
a²/2R further down. The pressure is

    p(r) = E* [d − a²/R + 2r²/R] / (π √(a² − r²)),

so that the whole face touches, and the formulas hold, from d = a²/R on. Less deep only a ring touches, which has no
image in one dimension; above d = −a²/2R nothing does.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import Indenter
from mdr.indenters.mapping.stable_functions import leg
from mdr.tools.arrays import EPS, Array
from mdr.tools.checks import finite_array, plain
from mdr.tools.fields import facts


@dataclass(frozen=True)
class ConcavePunch(Indenter):
    """Punch with a hollow face, in complete contact: a given, F_N = 2E* [a d + a³/(3R)], k_zc = 2E*a for d >= a²/R.

    While it slides to one side it acts as a flat punch: all of it sticks, or all of it slips. Where it slips
    back before, slip begins in the middle, where p is least, and not at the rim. The springs do not describe this.
    """

    a: float = field(metadata=facts("m", "radius of the rim", example=1e-3))
    R: float = field(metadata=facts("m", "radius of curvature of the hollow", example=0.2))

    @property
    def max_radius(self) -> float:
        """The radius of the rim [m]."""
        return self.a

    @property
    def least_depth(self) -> float:
        """a²/R [m], from which on the middle of the face is pressed too."""
        return self.a / self.R * self.a

    def _f(self, r: Array) -> Array:
        return -r / self.R * r / 2

    def _g(self, x: Array) -> Array:
        return -x / self.R * x

    def _area(self, a: Array) -> Array:
        return -a / self.R * a * a / 3

    def contact_radius(self, d: ArrayLike) -> Array:
        """The radius of the rim for d >= a²/R, 0 for d <= −a²/2R; a ValueError between."""
        d = finite_array("d", d, "m")
        ring = (d < self.least_depth * (1 - 4 * EPS)) & (d > -self.least_depth / 2)
        if np.any(ring):
            raise ValueError(
                f"annular contact: at the depth d = {d[ring].flat[0]:.6g} m only a ring of ConcavePunch touches, its "
                f"middle from d = a²/R = {self.least_depth:.6g} m on; press deeper, the method needs a full disc"
            )
        return plain(np.where(d > 0, self.a, 0.0))

    def pressure_inside(self, r: Array, a: Array, d: Array) -> Array:
        """p/E* = [(d − a²/R) + 2r²/R] / (π √(a² − r²))."""
        spare = np.maximum(d - self.least_depth, 0)
        return (spare + 2 * (r / self.R) * r) / (np.pi * leg(a, r))
