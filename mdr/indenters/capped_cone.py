"""Cone with a parabolic cap: f(r) = r²/2R for r < b = R tan θ, going over into the flank without a corner."""

import math
from dataclasses import dataclass, field

from mdr.indenters.cone import FLANK
from mdr.indenters.worn import Section, Worn, radius_of


@dataclass(frozen=True)
class CappedCone(Worn):
    """Cone with a rounded tip: d = g(a), F_N = E* (a³/R) [4/3 + φ cos φ − (4/3) sin φ + (1/3) sin φ cos²φ].

    cos φ = b/a; F_N = (4/3) E* a³/R while a <= b.
    """

    b: float = field(metadata=radius_of("cap", "Cone", 3e-4))
    theta: float = field(metadata=FLANK)

    @property
    def R(self) -> float:
        """Radius of curvature of the cap, b/tan θ [m]."""
        return self.b / math.tan(self.theta)

    @property
    def _made_of(self) -> Section:
        return Section(R_1=self.R, t=math.tan(self.theta))
