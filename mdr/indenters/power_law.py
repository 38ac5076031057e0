"""Power law: f(r) = c rⁿ, mapped to g(x) = κ_n c |x|ⁿ with κ_n = √π Γ(n/2 + 1) / Γ((n + 1)/2).

Popov & Heß (2015). n = 1 is the cone (c = tan θ), n = 2 the paraboloid (c = 1/(2R)), n → ∞ the flat punch.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from mdr.indenters.base import Indenter
from mdr.indenters.mapping.quadrature import double_exponential
from mdr.indenters.mapping.stable_functions import arcosh
from mdr.tools.arrays import EPS, Array
from mdr.tools.checks import finite_array, plain
from mdr.tools.fields import facts


@dataclass(frozen=True)
class PowerLaw(Indenter):
    """f(r) = c rⁿ with any n > 0; for n <= 1 p is infinite at the tip and answered as at r = 2e-16 a."""

    n: float = field(metadata=facts("-", "exponent of the profile", example=4.0))
    c: float = field(metadata=facts("m^(1-n)", "coefficient of the profile", example=7.5e6))

    @property
    def kappa_n(self) -> float:
        """κ_n = g/f: 1, π/2, 2, 3π/4, 8/3 … for n = 0, 1, 2, 3, 4."""
        if self.n < 300:
            return math.sqrt(math.pi) * math.gamma(self.n / 2 + 1) / math.gamma((self.n + 1) / 2)
        return math.sqrt(math.pi) * math.exp(math.lgamma(self.n / 2 + 1) - math.lgamma((self.n + 1) / 2))

    def _f(self, r: Array) -> Array:
        return self.c * r**self.n

    def _g(self, x: Array) -> Array:
        return self.kappa_n * self.c * x**self.n

    def _area(self, a: Array) -> Array:
        """a g(a) / (n + 1)."""
        return a * self._g(a) / (self.n + 1)

    def contact_radius(self, d: ArrayLike) -> Array:
        """Radius a = (d / (κ_n c))^{1/n}."""
        d = np.maximum(finite_array("d", d, "m"), 0)
        return plain((d / (self.kappa_n * self.c)) ** (1 / self.n))

    def pressure_inside(self, r: Array, a: Array, d: Array) -> Array:
        """p/E* = (n d / (π a)) ∫₀^U (ϱ cosh u)^(n-1) du with ϱ = r/a and cosh U = 1/ϱ."""
        share = np.maximum(r / a, EPS)[:, None]
        rule, U = double_exponential(), arcosh(1.0, share)
        integral = np.sum(U * rule.weight * (share * np.cosh(U * rule.from_low)) ** (self.n - 1), axis=1)
        return np.asarray(self.n / np.pi * (d / a) * integral)
