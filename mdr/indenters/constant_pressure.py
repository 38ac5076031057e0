"""Shape of constant pressure: pressed to the depth d_0 it touches the disc of radius a_0 with p = E*d_0/(2a_0).

f(r) = d_0 [1 − (2/π) E(r/a_0)], E the complete elliptic integral of modulus r/a_0; g(x) = d_0 [1 − √(1 − x²/a_0²)].
Popov, Heß, Willert, Handbook of Contact Mechanics (2019).
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import Indenter
from mdr.indenters.mapping.stable_functions import angle_less_sine, leg
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array, plain
from mdr.tools.fields import facts


@dataclass(frozen=True)
class ConstantPressure(Indenter):
    """Shape of constant pressure at the depth d_0, where its whole face touches; F_N = (π/2) E* a_0 d_0 there."""

    a_0: float = field(metadata=facts("m", "radius of the face", example=2e-3))
    d_0: float = field(metadata=facts("m", "depth at which the whole face touches", note="depth in m", example=1e-4))

    @property
    def max_radius(self) -> float:
        """The radius of the face [m]."""
        return self.a_0

    def _g(self, x: Array) -> Array:
        u = x / self.a_0
        return np.asarray(self.d_0 * u * (u / (1 + np.sqrt((1 - u) * (1 + u)))))

    def _area(self, a: Array) -> Array:
        """a_0 d_0 [sin ψ − (sin ψ cos ψ + ψ)/2] with sin ψ = a/a_0."""
        psi = np.arctan2(a, leg(self.a_0, a))
        return self.d_0 * self.a_0 * (angle_less_sine(2 * psi) / 4 - angle_less_sine(psi))

    def contact_radius(self, d: ArrayLike) -> Array:
        """Radius a = a_0 √(1 − (1 − d/d_0)²), for d <= d_0."""
        d = finite_array("d", d, "m")
        self._refuse_beyond(d)
        share = np.clip(d / self.d_0, 0, 1)
        return plain(self.a_0 * np.sqrt(share * (2 - share)))

    def _why_too_deep(self, reach: float) -> str:
        return f"goes: at d_0 = {reach:.6g} m its whole face touches, and p is constant; press less"

    def pressure_inside(self, r: Array, a: Array, d: Array) -> Array:
        """p/E* = (d_0/(π a_0)) arcsin √((a² − r²)/(a_0² − r²))."""
        return self.d_0 / (np.pi * self.a_0) * np.arctan2(leg(a, r), leg(self.a_0, a))
