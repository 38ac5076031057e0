"""What pulls the indenter in the plane, and how it yields to an oscillating force.

RigidPull moves the body at v_0. SpringPull drags a mass m through a spring k_x and, in parallel to it, an
optional damper c_x, whose far end moves at v_0; with y = u_x - v_0 t the body obeys

    m y'' + c_x y' + k_x y = -F_x,

Eq. (8) with a damper. An oscillating force F exp(i omega t) moves it by -F H(omega), with the receptance
H = 1/(k_x - m omega² + i omega c_x). The rigid pull is H = 0.

Symbols: k_x stiffness [N/m], m mass [kg], c_x damping [N s/m], omega angular frequency [rad/s].
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.tools.checks import finite_array, not_negative, positive


class Pull(ABC):
    """What every pull must answer: how far it yields to an oscillating force."""

    @abstractmethod
    def receptance(self, omega: ArrayLike) -> NDArray[np.complex128] | complex:
        """Receptance H(omega) [m/N]: displacement over an oscillating force.

        Parameters
        ----------
        omega : array_like of float
            Angular frequency [rad/s].

        Returns
        -------
        complex or ndarray
            H [m/N] in the shape of omega; infinite on an undamped resonance.
        """


@dataclass(frozen=True)
class RigidPull(Pull):
    """The body moves at v_0 whatever the force: k_x -> infinity, the case of Eq. (1)."""

    def receptance(self, omega: ArrayLike) -> NDArray[np.complex128] | complex:
        """Zero: nothing yields."""
        omega = finite_array("omega", omega, "rad/s")
        return 0j if omega.ndim == 0 else np.zeros(omega.shape, dtype=complex)


@dataclass(frozen=True)
class SpringPull(Pull):
    """A mass pulled through a spring, Fig. 2 of the paper; m = 0 is a quasi-static body."""

    k_x: float  #: stiffness of the system spring [N/m]
    m: float = 0.0  #: sliding mass [kg]
    c_x: float = 0.0  #: damper in parallel to the spring [N s/m]

    def __post_init__(self) -> None:
        way_out = "for a rigid pull use RigidPull()"
        object.__setattr__(self, "k_x", positive("k_x", self.k_x, f"stiffness in N/m; {way_out}"))
        object.__setattr__(self, "m", not_negative("m", self.m, "mass in kg"))
        object.__setattr__(self, "c_x", not_negative("c_x", self.c_x, "damping in N s/m"))

    def receptance(self, omega: ArrayLike) -> NDArray[np.complex128] | complex:
        """1/(k_x - m omega² + i omega c_x) [m/N]."""
        omega = finite_array("omega", omega, "rad/s")
        dynamic_stiffness = self.k_x - self.m * omega**2 + 1j * omega * self.c_x
        with np.errstate(divide="ignore", invalid="ignore"):
            H = np.where(dynamic_stiffness == 0, complex(np.inf), 1 / dynamic_stiffness)
        return complex(H) if H.ndim == 0 else H

    @property
    def omega_0(self) -> float:
        """Natural frequency of the free body sqrt(k_x/m) [rad/s]; infinite for m = 0."""
        return float(np.sqrt(self.k_x / self.m)) if self.m > 0 else np.inf

    @property
    def damping_ratio(self) -> float:
        """c_x/(2 sqrt(k_x m)) [-]; infinite for a damped body without mass, 0 without damper."""
        if self.c_x == 0:
            return 0.0
        return float(self.c_x / (2 * np.sqrt(self.k_x * self.m))) if self.m > 0 else np.inf
