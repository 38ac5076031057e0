"""Paraboloid with a parabolic cap: radius of curvature R1 for r < b, R2 <= R1 outside.

R1 → ∞ is the truncated paraboloid, R1 = R2 the paraboloid.
"""

from dataclasses import dataclass, field

from mdr.indenters.worn import Section, Worn, radius_of
from mdr.tools.fields import facts


@dataclass(frozen=True)
class CappedParaboloid(Worn):
    """Ball worn to a flatter cap: d = g(a), F_N = (2E*/3) [2a³/R1 − (1/R1 − 1/R2) (2a² + b²) √(a² − b²)].

    F_N = (4/3) E* a³/R1 while a <= b. At the edge of the cap p is infinite, and answered as one rounding away.
    """

    R1: float = field(metadata=facts("m", "radius of curvature of the cap", example=0.1))
    R2: float = field(metadata=facts("m", "radius of curvature around the cap", example=0.04))
    b: float = field(metadata=radius_of("cap", "Paraboloid", 5e-4))

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.R2 > self.R1:
            raise ValueError(
                f"R2 must not exceed R1 = {self.R1:.6g} m, got {self.R2:.6g} m: outside a sharper cap the slope drops, "
                "so that a ring touches before the disc inside it (annular contact); the method needs a full disc"
            )

    @property
    def _made_of(self) -> Section:
        return Section(R_1=self.R1, R_2=self.R2)
