"""Kelvin body: a modulus in parallel with a dashpot, the element of the paper, Fig. 2."""

from __future__ import annotations

from dataclasses import dataclass

from mdr.materials.base import OneBody, poisson_ratio
from mdr.tools.checks import not_negative, positive


@dataclass(frozen=True)
class KelvinVoigt(OneBody):
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
