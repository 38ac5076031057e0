"""Elastic bodies: one under a rigid indenter, or two in contact, whose compliances add."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from mdr.materials.base import POISSON, Material, OneBody, poisson_ratio
from mdr.tools.checks import positive
from mdr.tools.fields import facts


@dataclass(frozen=True)
class Elastic(OneBody):
    """An elastic body under a rigid indenter."""

    E: float = field(metadata=facts("Pa", "Young's modulus", example=3e6))
    nu: float = field(metadata=POISSON)

    #: relaxation time [s] of an elastic body
    tau: ClassVar[float] = 0.0

    @classmethod
    def from_shear(cls, *, G: float, nu: float) -> Elastic:
        """The elastic body of a shear modulus: E = 2 G (1 + nu) [Pa].

        Parameters
        ----------
        G : float
            Shear modulus [Pa].
        nu : float
            Poisson's ratio [-].

        Returns
        -------
        Elastic
            The body.
        """
        return cls(E=2 * positive("G", G, "shear modulus in Pa") * (1 + poisson_ratio("nu", nu)), nu=nu)


@dataclass(frozen=True)
class ElasticPair(Material):
    """Two elastic bodies in contact; their compliances add."""

    E_1: float = field(metadata=facts("Pa", "Young's modulus of the first body", example=3e6))
    nu_1: float = field(metadata=facts("-", "Poisson's ratio of the first body", poisson_ratio, example=0.5))
    E_2: float = field(metadata=facts("Pa", "Young's modulus of the second body", example=210e9))
    nu_2: float = field(metadata=facts("-", "Poisson's ratio of the second body", poisson_ratio, example=0.3))

    #: relaxation time [s] of elastic bodies
    tau: ClassVar[float] = 0.0

    @property
    def _bodies(self) -> tuple[Elastic, Elastic]:
        return Elastic(self.E_1, self.nu_1), Elastic(self.E_2, self.nu_2)

    @property
    def E_star(self) -> float:
        """1/E* = (1 - nu_1²)/E_1 + (1 - nu_2²)/E_2 [Pa]."""
        one, two = self._bodies
        return 1 / (1 / one.E_star + 1 / two.E_star)

    @property
    def G_star(self) -> float:
        """1/G* = (2 - nu_1)/(4 G_1) + (2 - nu_2)/(4 G_2) [Pa]."""
        one, two = self._bodies
        return 1 / (1 / one.G_star + 1 / two.G_star)

    @property
    def dundurs_beta(self) -> float:
        """[(1-2 nu_1)/G_1 - (1-2 nu_2)/G_2] / [2 (1-nu_1)/G_1 + 2 (1-nu_2)/G_2] [-]; zero for like materials."""
        G_1, G_2 = self.E_1 / (2 * (1 + self.nu_1)), self.E_2 / (2 * (1 + self.nu_2))
        mismatch = (1 - 2 * self.nu_1) / G_1 - (1 - 2 * self.nu_2) / G_2
        return mismatch / (2 * (1 - self.nu_1) / G_1 + 2 * (1 - self.nu_2) / G_2)
