"""The half-space: how stiff and how slow a material makes each spring.

A rigid indenter on one deformable body has, with Young's modulus E and Poisson's ratio nu,

    1/E* = (1 - nu²)/E,    1/G* = (2 - nu)/(4 G),    G = E/(2 (1 + nu)),

and two bodies add their compliances (Popov and Heß 2015, Method of Dimensionality Reduction, ch. 3).
Their ratio kappa = E*/G* is the Mindlin ratio. A Kelvin body answers with stiffness and dashpot in
parallel; one relaxation time tau = gamma/k serves both directions, which is Eq. (11) and holds for a
constant Poisson's ratio.

Symbols: E, G, E_star, G_star moduli [Pa], nu Poisson's ratio [-], tau relaxation time [s],
eta shear viscosity [Pa s], omega angular frequency [rad/s].
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.checks import finite, finite_array, not_negative, positive


def poisson_ratio(name: str, value: float) -> float:
    """Poisson's ratio of a stable isotropic body, -1 < nu <= 1/2."""
    nu = finite(name, value)
    if not -1 < nu <= 0.5:
        raise ValueError(f"{name} must lie in -1 < nu <= 0.5 for a stable isotropic body, got {nu!r}; rubber is 0.5")
    return nu


class Material(ABC):
    """What every material must answer; long-time moduli are properties, the rest follows from them."""

    tau: float

    def _set(self, **checked: float) -> None:
        for name, value in checked.items():
            object.__setattr__(self, name, value)

    @property
    @abstractmethod
    def E_star(self) -> float:
        """Long-time normal contact modulus E* [Pa]."""

    @property
    @abstractmethod
    def G_star(self) -> float:
        """Long-time tangential contact modulus G* [Pa]."""

    @property
    @abstractmethod
    def dundurs_beta(self) -> float:
        """Dundurs' beta [-], the strength of normal-tangential coupling that the springs leave out."""

    @property
    def mindlin_ratio(self) -> float:
        """kappa = E*/G* [-], the ratio of normal to tangential contact stiffness."""
        return self.E_star / self.G_star

    def dynamic_modulus(self, omega: ArrayLike) -> NDArray[np.complex128] | complex:
        """Complex contact modulus E*(omega) = E* (1 + i omega tau) [Pa], in the shape of omega [rad/s]."""
        omega = finite_array("omega", omega, "rad/s")
        modulus = self.E_star * (1 + 1j * omega * self.tau)
        return complex(modulus) if modulus.ndim == 0 else np.asarray(modulus)

    def loss_tangent(self, omega: ArrayLike) -> NDArray[np.float64] | float:
        """Loss over storage modulus at omega [rad/s]; omega tau for a Kelvin body."""
        modulus = np.asarray(self.dynamic_modulus(omega))
        ratio = modulus.imag / modulus.real
        return float(ratio) if ratio.ndim == 0 else ratio


class _OneBody(Material):
    """A deformable body of modulus E and ratio nu under a rigid indenter."""

    E: float
    nu: float

    @property
    def E_star(self) -> float:
        """E/(1 - nu²) [Pa]."""
        return self.E / (1 - self.nu**2)

    @property
    def G_star(self) -> float:
        """4 G/(2 - nu) [Pa]."""
        return 2 * self.E / ((1 + self.nu) * (2 - self.nu))

    @property
    def mindlin_ratio(self) -> float:
        """kappa = (2 - nu)/(2 (1 - nu)) [-]."""
        return (2 - self.nu) / (2 * (1 - self.nu))

    @property
    def dundurs_beta(self) -> float:
        """(1 - 2 nu)/(2 (1 - nu)) [-]: zero for an incompressible body, 2/7 for nu = 0.3."""
        return (1 - 2 * self.nu) / (2 * (1 - self.nu))


@dataclass(frozen=True)
class Elastic(_OneBody):
    """An elastic body under a rigid indenter."""

    E: float  #: Young's modulus [Pa]
    nu: float  #: Poisson's ratio [-]

    def __post_init__(self) -> None:
        self._set(E=positive("E", self.E, "Young's modulus in Pa"), nu=poisson_ratio("nu", self.nu))

    @property
    def tau(self) -> float:  # type: ignore[override]
        """Relaxation time [s] of an elastic body: zero."""
        return 0.0

    @classmethod
    def from_shear(cls, *, G: float, nu: float) -> Elastic:
        """The body of shear modulus G [Pa]: E = 2 G (1 + nu)."""
        return cls(E=2 * positive("G", G, "shear modulus in Pa") * (1 + poisson_ratio("nu", nu)), nu=nu)


@dataclass(frozen=True)
class KelvinVoigt(_OneBody):
    """A Kelvin body under a rigid indenter: modulus E in parallel with a dashpot, tau = gamma/k, Eq. (11)."""

    E: float  #: long-time Young's modulus [Pa]
    nu: float  #: Poisson's ratio [-], constant
    tau: float  #: relaxation time gamma/k [s]

    def __post_init__(self) -> None:
        self._set(
            E=positive("E", self.E, "Young's modulus in Pa"),
            nu=poisson_ratio("nu", self.nu),
            tau=not_negative("tau", self.tau, "relaxation time in s"),
        )

    @classmethod
    def from_shear(cls, *, G: float, eta: float, nu: float) -> KelvinVoigt:
        """The body of shear modulus G [Pa] and shear viscosity eta [Pa s]: tau = eta/G."""
        G, eta = positive("G", G, "shear modulus in Pa"), not_negative("eta", eta, "shear viscosity in Pa s")
        return cls(E=2 * G * (1 + poisson_ratio("nu", nu)), nu=nu, tau=eta / G)

    @classmethod
    def from_loss_tangent(cls, *, E: float, nu: float, tan_delta: float, omega: float) -> KelvinVoigt:
        """The body of storage modulus E [Pa] and loss tangent tan_delta at omega [rad/s]: tau = tan_delta/omega."""
        tan_delta = not_negative("tan_delta", tan_delta, "loss tangent")
        return cls(E=E, nu=nu, tau=tan_delta / positive("omega", omega, "angular frequency in rad/s"))


@dataclass(frozen=True)
class ElasticPair(Material):
    """Two elastic bodies in contact; their compliances add."""

    E_1: float  #: Young's modulus of the first body [Pa]
    nu_1: float  #: its Poisson's ratio [-]
    E_2: float  #: Young's modulus of the second body [Pa]
    nu_2: float  #: its Poisson's ratio [-]

    def __post_init__(self) -> None:
        for field in fields(self):
            value: Any = getattr(self, field.name)
            ratio = field.name.startswith("nu")
            self._set(
                **{
                    field.name: poisson_ratio(field.name, value)
                    if ratio
                    else positive(field.name, value, "Young's modulus in Pa")
                }
            )

    @property
    def tau(self) -> float:  # type: ignore[override]
        """Relaxation time [s] of elastic bodies: zero."""
        return 0.0

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
