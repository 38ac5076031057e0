"""Sphere: f(r) = R − √(R² − r²), mapped to g(x) = (x/2) ln((R + x)/(R − x)) (Segedin 1957).

Popov, Heß, Willert, Handbook of Contact Mechanics (2019). The paraboloid is its limit a ≪ R.
"""

from dataclasses import dataclass, field

from mdr.indenters.ellipsoid import Spheroid
from mdr.tools.fields import facts


@dataclass(frozen=True)
class Sphere(Spheroid):
    """Ball of radius R: d = g(a), F_N = (E*/2) [(R² + a²) ln((R + a)/(R − a)) − 2aR].

    Its contact grows to the equator, a = R, at infinite depth only: g is finite for ``|x| < R``.
    """

    R: float = field(metadata=facts("m", "radius of the ball", example=0.05))

    @property
    def _half_axes(self) -> tuple[float, float]:
        return self.R, self.R
