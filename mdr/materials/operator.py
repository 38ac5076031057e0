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

SLOWEST = 1e10  #: omega tau, from which on rounding costs the mean force of a period more than 1e-7


@dataclass(frozen=True)
class Rheology:
    """L of a material: T of the Kelvin branch, ratios rho_j and times theta_j of the arms."""

    T: float
    rho: tuple[float, ...] = ()
    theta: tuple[float, ...] = ()

    @classmethod
    def of(cls, material: Material, omega: float) -> Rheology:
        """The operator of a material with a long-time modulus, its times in units of 1/omega.

        Raises ValueError for a time so long that what relaxes in a period is lost in rounding.
        """
        arms = material.contact_arms
        name, slowest = max([("tau", material.tau), *(("tau_j", tau_j) for _, tau_j in arms)], key=lambda one: one[1])
        if not omega * slowest <= SLOWEST:
            raise ValueError(
                f"{name} = {slowest:.6g} s is more than {SLOWEST:g}/omega: what relaxes in a period is lost in "
                f"rounding; lower it to {SLOWEST / omega:.6g} s, which a period does not tell from it"
            )
        ratios = tuple(E_j / material.E_star for E_j, _ in arms)
        return cls(omega * material.tau, ratios, tuple(omega * tau_j for _, tau_j in arms))

    @property
    def remembers(self) -> bool:
        """Whether a spring has any memory; an elastic one has none."""
        return self.T > 0 or bool(self.rho)

    def response(self, n: ArrayLike) -> NDArray[np.complex128]:
        """L of exp(i n phase), over it: the dynamic modulus over the long-time one at n omega; n of any shape."""
        return complex_modulus(n, 1.0, self.T, zip(self.rho, self.theta, strict=True))
