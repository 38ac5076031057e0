"""Truncated paraboloid: a flat face of radius b in f(r) = (r² − b²)/2R, mapped to g(x) = (x/R) √(x² − b²) for x > b."""

from dataclasses import dataclass, field

from mdr.indenters.worn import Section, Worn, radius_of
from mdr.tools.fields import facts


@dataclass(frozen=True)
class TruncatedParaboloid(Worn):
    """Worn ball: a² = b²/2 + √(b⁴/4 + R²d²), F_N = (2E*/3R) (2a² + b²) √(a² − b²).

    Under a small load it is a flat punch: a → b and k_zc → 2E*b; at the edge of its face p is infinite, and answered
    as one rounding away.
    """

    b: float = field(metadata=radius_of("face", "Paraboloid", 5e-4))
    R: float = field(metadata=facts("m", "radius of curvature", example=0.04))

    @property
    def _made_of(self) -> Section:
        return Section(R_2=self.R)
