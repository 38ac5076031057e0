"""Shapes whose centre is flat or rounded out to a radius b: a tip that was worn, or made so.

Within b the radius of curvature is R_1, infinite for a flat face. Outside, the flank has the slope t of a cone and the
radius of curvature R_2 of a paraboloid, as ∂f/∂r = t + r/R_2. With s = √(x² − b²) and φ = arccos(b/x), both 0 for
x < b,

    f(r) = r²/2R_1 within b, and outside b²/2R_1 + (r − b) t + (r² − b²)/2R_2,
    g(x) = x [(x − s)/R_1 + φ t + s/R_2],
    ∫₀^a g dx = (a³ − s³)/3R_1 + (a²/2) (φ − sin φ cos φ) t + s³/3R_2.

Popov, Heß, Willert, Handbook of Contact Mechanics (2019).
"""

from abc import abstractmethod
from typing import NamedTuple

import numpy as np

from mdr.indenters.base import Indenter
from mdr.indenters.mapping.stable_functions import angle, angle_less_sine, leg, leg_short
from mdr.tools.arrays import Array
from mdr.tools.fields import Facts, facts


def radius_of(what: str, without: str, example: float) -> dict[str, Facts]:
    """Metadata of a radius b of a face or a cap, and the shape that has none."""
    meaning = f"radius of the {what}"
    return facts("m", meaning, note=f"{meaning} in m; a {without} has none", example=example)


class Section(NamedTuple):
    """What such a shape is made of."""

    R_1: float = np.inf  #: radius of curvature of the centre [m]; infinite for a flat face
    t: float = 0.0  #: slope of the flank [-]
    R_2: float = np.inf  #: radius of curvature of the flank [m]


class Worn(Indenter):
    """A shape of which the first ``b`` of the radius is a flat face or a cap."""

    b: float

    @property
    @abstractmethod
    def _made_of(self) -> Section:
        """Cap and flank."""

    @property
    def kinks(self) -> tuple[float, ...]:
        """The edge of the centre [m]."""
        return (self.b,)

    def _f(self, r: Array) -> Array:
        (R_1, t, R_2), inside = self._made_of, np.minimum(r, self.b)
        return inside / R_1 * inside / 2 + (r - inside) * t + (r - inside) / R_2 * ((r + self.b) / 2)

    def _g(self, x: Array) -> Array:
        R_1, t, R_2 = self._made_of
        return x * (leg_short(x, self.b) / R_1 + angle(x, self.b) * t + leg(x, self.b) / R_2)

    def _area(self, a: Array) -> Array:
        (R_1, t, R_2), s = self._made_of, leg(a, self.b)
        cone = a * a / 4 * angle_less_sine(2 * angle(a, self.b)) * t
        return (leg_short(a, self.b) / R_1 * (a * a + a * s + s * s) + s / R_2 * s * s) / 3 + cone

    def _slope(self, s: Array, low: float, high: float) -> Array:
        R_1, t, R_2 = self._made_of
        if low < self.b:
            return 2 / R_1 * s
        x = np.hypot(s, self.b)
        cap = self.b / (x + s)
        flank = (s / x * np.arctan2(s, self.b) + self.b / x) * t + (x + s / x * s) / R_2
        return flank - cap * (self.b / x) * (self.b / R_1) * cap
