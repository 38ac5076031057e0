"""Kelvin body: a modulus in parallel with a dashpot, the element of the paper, Fig. 2."""

from __future__ import annotations

from dataclasses import dataclass, field

from mdr.materials.base import POISSON, OneBody, poisson_ratio
from mdr.tools.checks import not_negative, positive
from mdr.tools.fields import facts


@dataclass(frozen=True)
class KelvinVoigt(OneBody):
    """A Kelvin body under a rigid indenter: modulus E in parallel with a dashpot, tau = gamma/k, Eq. (11)."""

    E: float = field(metadata=facts("Pa", "long-time Young's modulus", note="Young's modulus in Pa"))
    nu: float = field(metadata=POISSON)
    tau: float = field(
        metadata=facts(
            "s", "relaxation time gamma/k", not_negative, label=r"relaxation time $\tau$", note="relaxation time in s"
        )
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
