"""Flat punch: a cylinder of radius a, whose contact does not grow with depth."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.checks import positive
from mdr.indenters.base import Array, Indenter, depth, each, radius


@dataclass(frozen=True)
class FlatPunch(Indenter):
    """A rigid cylinder; f = g = 0 within its radius, d is free, F_N = 2 E* a d."""

    a: float  #: radius [m]

    def __post_init__(self) -> None:
        object.__setattr__(self, "a", positive("a", self.a, "radius in m"))

    @property
    def max_radius(self) -> float:
        """The radius a [m]."""
        return self.a

    def profile_3d(self, r: ArrayLike) -> Any:
        """Zero up to the rim, infinite beyond [m]."""
        return each(lambda r: np.where(np.abs(r) <= self.a, 0.0, np.inf), radius(r))

    def profile_1d(self, x: ArrayLike) -> Any:
        """Zero up to the rim, infinite beyond [m]."""
        return each(lambda x: np.where(np.abs(x) <= self.a, 0.0, np.inf), radius(x, "x"))

    def contact_radius(self, d: ArrayLike) -> Any:
        """The radius a [m] at any depth d > 0 [m]."""
        return each(lambda d: np.where(d > 0, self.a, 0.0), depth(d))

    def _area(self, d: Array, a: Array) -> Array:
        return np.maximum(d, 0) * a

    def _pressure(self, r: Array, d: float, a: float) -> Array:
        """d/(pi sqrt(a² - r²)) (Boussinesq)."""
        inside = r < a
        return np.where(inside, d / (np.pi * np.sqrt(np.where(inside, (a - r) * (a + r), 1.0))), 0.0)
