"""Power law: f(r) = c r^n, mapped to g(x) = kappa_n c |x|^n with kappa_n = sqrt(pi) Gamma(n/2 + 1)/Gamma((n + 1)/2)."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, lgamma, pi, sqrt
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.checks import positive
from mdr.indenters.base import Array, Indenter, depth, each, radius


@dataclass(frozen=True)
class PowerLaw(Indenter):
    """f = c r^n with n > 0: n = 1 is the cone, n = 2 the paraboloid, large n tends to a punch (Popov and Heß 2015)."""

    n: float  #: exponent [-]
    c: float  #: coefficient [m^(1-n)]

    def __post_init__(self) -> None:
        object.__setattr__(self, "n", positive("n", self.n, "exponent"))
        object.__setattr__(self, "c", positive("c", self.c, "coefficient in m^(1-n)"))

    @property
    def stretch(self) -> float:
        """kappa_n [-], the factor of g over f."""
        return sqrt(pi) * exp(lgamma(self.n / 2 + 1) - lgamma((self.n + 1) / 2))

    def profile_3d(self, r: ArrayLike) -> Any:
        """c r^n [m]."""
        return each(lambda r: self.c * np.abs(r) ** self.n, radius(r))

    def profile_1d(self, x: ArrayLike) -> Any:
        """kappa_n c |x|^n [m]."""
        return each(lambda x: self.stretch * self.c * np.abs(x) ** self.n, radius(x, "x"))

    def contact_radius(self, d: ArrayLike) -> Any:
        """(d/(kappa_n c))^(1/n) [m]."""
        return each(lambda d: (np.maximum(d, 0) / (self.stretch * self.c)) ** (1 / self.n), depth(d))

    def _area(self, d: Array, a: Array) -> Array:
        return self.n / (self.n + 1) * np.maximum(d, 0) * a

    def _slope_1d(self, x: Array, low: float = 0.0, high: float = np.inf) -> Array:
        return self.n * self.stretch * self.c * x ** (self.n - 1)
