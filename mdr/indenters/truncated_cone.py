"""Truncated cone: a flat face of radius b with the flank f(r) = (r − b) tan θ, g(x) = x tan θ arccos(b/x) for x > b."""

import math
from dataclasses import dataclass, field

from mdr.indenters.cone import FLANK
from mdr.indenters.worn import Section, Worn, radius_of


@dataclass(frozen=True)
class TruncatedCone(Worn):
    """Worn cone: d = g(a), F_N = E* a² tan θ (φ + cos φ sin φ) with cos φ = b/a.

    Under a small load it is a flat punch: a → b and k_zc → 2E*b; at the edge of its face p is infinite, and answered
    as one rounding away.
    """

    b: float = field(metadata=radius_of("face", "Cone", 3e-4))
    theta: float = field(metadata=FLANK)

    @property
    def _made_of(self) -> Section:
        return Section(t=math.tan(self.theta))
