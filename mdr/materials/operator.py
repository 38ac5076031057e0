"""The linear operator L of a material, in scaled form: with the long-time modulus as unit and 1/omega as that of time,

    L[x] = x + T x' + sum_j rho_j x_j,    x_j' = x' - x_j/theta_j,

T = omega tau of the Kelvin branch, rho_j = E_j/E_inf and theta_j = omega tau_j of the Maxwell arms. What a spring does
over a time is the matter of mdr/spring/law.py.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.materials.base import Material, complex_modulus

SLOWEST = 1e6  #: omega tau_j, from which on an arm is not told from one of this time: it relaxes by less in a period
FASTEST = 1e-6  #: the same, up to which arms together are one of their stiffness and viscosity
STIFFEST = 1e10  #: omega tau, from which on rounding costs the mean force of a period more than 1e-7


@dataclass(frozen=True)
class Rheology:
    """L of a material: T of the Kelvin branch, ratios rho_j and times theta_j of the arms."""

    T: float
    rho: tuple[float, ...] = ()
    theta: tuple[float, ...] = ()

    @classmethod
    def of(cls, material: Material, omega: float) -> Rheology:
        """The operator of a material with a long-time modulus, its times in units of 1/omega."""
        arms = material.contact_arms
        ratios = tuple(E_j / material.E_star for E_j, _ in arms)
        return cls(omega * material.tau, ratios, tuple(omega * tau_j for _, tau_j in arms))

    @classmethod
    def periodic(cls, material: Material, omega: float) -> Rheology:
        """The same for a periodic motion, in which all arms slower than SLOWEST are one, and all faster than FASTEST.

        In a periodic state every arm has relaxed about its mean. What a slow one relaxes within a period is of the
        order of 1/theta_j. Fast ones differ from one of their stiffness and viscosity by the square of theta_j.

        Raises ValueError for a dashpot so slow that what relaxes in a period is lost in rounding.
        """
        if not omega * material.tau <= STIFFEST:
            raise ValueError(
                f"tau = {material.tau:.6g} s is more than {STIFFEST:g}/omega: what relaxes in a period is lost in "
                f"rounding; lower it to {STIFFEST / omega:.6g} s, which a period does not tell from it"
            )
        one = cls.of(material, omega)
        arms = list(zip(one.rho, one.theta, strict=True))
        slow = sum(rho for rho, theta in arms if theta >= SLOWEST)
        fast = sum(rho for rho, theta in arms if theta <= FASTEST)
        dashpot = sum(rho * theta for rho, theta in arms if theta <= FASTEST)
        arms = [arm for arm in arms if FASTEST < arm[1] < SLOWEST]
        arms = [(slow, SLOWEST)] * (slow > 0) + arms + ([(fast, dashpot / fast)] if dashpot > 0 else [])
        return cls(one.T, tuple(rho for rho, _ in arms), tuple(theta for _, theta in arms))

    @property
    def slow(self) -> float:
        """Ratio rho of the arm, the first one, that a period does not tell from a spring; zero where there is none."""
        return self.rho[0] if self.theta and self.theta[0] == SLOWEST else 0.0

    @property
    def without_slow(self) -> Rheology:
        """The same with this arm a spring beside the long-time one, in units of the modulus of both."""
        stiff, first = 1 + self.slow, int(self.slow > 0)
        return Rheology(self.T / stiff, tuple(rho / stiff for rho in self.rho[first:]), self.theta[first:])

    @property
    def remembers(self) -> bool:
        """Whether a spring has any memory; an elastic one has none."""
        return self.T > 0 or bool(self.rho)

    def response(self, n: ArrayLike) -> NDArray[np.complex128]:
        """L of exp(i n phase), over it: the dynamic modulus over the long-time one at n omega; n of any shape."""
        return complex_modulus(n, 1.0, self.T, zip(self.rho, self.theta, strict=True))
