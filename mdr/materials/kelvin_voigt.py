"""Kelvin body: a modulus in parallel with a dashpot, the element of the paper, Fig. 2."""

from __future__ import annotations

from dataclasses import dataclass, field

from mdr.materials.base import POISSON, OneBody, poisson_ratio
from mdr.tools.checks import not_negative, positive
from mdr.tools.fields import facts


@dataclass(frozen=True)
class KelvinVoigt(OneBody):
    """A Kelvin body under a rigid indenter: modulus E in parallel with a dashpot, tau = gamma/k, Eq. (11)."""

    E: float = field(metadata=facts("Pa", "long-time Young's modulus", note="Young's modulus in Pa", example=3e6))
    nu: float = field(metadata=POISSON)
    tau: float = field(
        metadata=facts(
            "s",
            "relaxation time, damping over stiffness",
            not_negative,
            label=r"relaxation time $\tau$",
            note="relaxation time in s",
            example=1e-3,
        )
    )

    @classmethod
    def from_shear(cls, *, G: float, eta: float, nu: float) -> KelvinVoigt:
        """The Kelvin body of a shear modulus and a shear viscosity: tau = eta/G [s].

        Parameters
        ----------
        G : float
            Shear modulus [Pa].
        eta : float
            Shear viscosity [Pa s].
        nu : float
            Poisson's ratio [-].

        Returns
        -------
        KelvinVoigt
            The body.

        Examples
        --------
        >>> import mdr
        >>> mdr.KelvinVoigt.from_shear(G=1e6, eta=1e3, nu=0.5)
        KelvinVoigt(E=3000000.0, nu=0.5, tau=0.001)
        """
        G, eta = positive("G", G, "shear modulus in Pa"), not_negative("eta", eta, "shear viscosity in Pa s")
        return cls(E=2 * G * (1 + poisson_ratio("nu", nu)), nu=nu, tau=eta / G)

    @classmethod
    def from_loss_tangent(cls, *, E: float, nu: float, tan_delta: float, omega: float) -> KelvinVoigt:
        """The Kelvin body of a loss tangent that was measured at one frequency: tau = tan_delta/omega [s].

        Parameters
        ----------
        E : float
            Storage modulus [Pa], Young's.
        nu : float
            Poisson's ratio [-].
        tan_delta : float
            Loss tangent [-].
        omega : float
            Angular frequency of the measurement [rad/s].

        Returns
        -------
        KelvinVoigt
            The body.

        Examples
        --------
        >>> import mdr
        >>> mdr.KelvinVoigt.from_loss_tangent(E=3e6, nu=0.5, tan_delta=0.3, omega=300.0)
        KelvinVoigt(E=3000000.0, nu=0.5, tau=0.001)
        """
        tan_delta = not_negative("tan_delta", tan_delta, "loss tangent")
        return cls(E=E, nu=nu, tau=tan_delta / positive("omega", omega, "angular frequency in rad/s"))
