"""What pulls the indenter in the plane, and how it yields to an oscillating force.

RigidPull moves the body at v_0. SpringPull drags a mass m through a spring k_x and, in parallel to it, an
optional damper c_x, whose far end moves at v_0; with y = u_x - v_0 t the body obeys

    m y'' + c_x y' + k_x y = -F_x,

Eq. (8) with a damper. An oscillating force F exp(i omega t) moves it by -F H(omega), with the receptance
H = 1/(k_x - m omega² + i omega c_x). The rigid pull is H = 0.

Across the pull the body is guided, or hangs on a spring k_y and a damper c_y of its own.

Symbols: k_x, k_y stiffness [N/m], m mass [kg], c_x, c_y damping [N s/m], omega angular frequency [rad/s].
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.tools.checks import finite_array, not_negative, positive_or_none
from mdr.tools.fields import Record, facts

__all__ = ["Pull", "RigidPull", "SpringPull"]

STIFFNESS = "stiffness in N/m; for a rigid pull use RigidPull()"  #: what a refused one is told


class Pull(Record, ABC):
    """What every pull must answer: the linear oscillator that it makes of the body."""

    @property
    @abstractmethod
    def coefficients(self) -> tuple[float, float, float]:
        """m [kg], c_x [N s/m] and k_x [N/m] of m y'' + c_x y' + k_x y = -F_x; k_x is infinite where nothing yields."""

    @property
    def across(self) -> tuple[float, float, float]:
        """m [kg], c_y [N s/m] and k_y [N/m] of the same across the pull; k_y is infinite where the body is guided."""
        return 0.0, 0.0, np.inf

    @property
    def is_rigid(self) -> bool:
        """Whether the body moves as it is pulled, whatever the force."""
        return bool(np.isinf(self.coefficients[2]))

    @property
    def omega_0(self) -> float:
        """Natural frequency of the free body sqrt(k_x/m) [rad/s]; infinite for m = 0."""
        m, _, k_x = self.coefficients
        return float(np.sqrt(k_x / m)) if m > 0 else np.inf

    @property
    def damping_ratio(self) -> float:
        """c_x/(2 sqrt(k_x m)) [-]; infinite for a damped body without mass, 0 without damper."""
        m, c_x, k_x = self.coefficients
        if c_x == 0:
            return 0.0
        return float(c_x / (2 * np.sqrt(k_x * m))) if m > 0 else np.inf

    def receptance(self, omega: ArrayLike, *, across: bool = False) -> NDArray[np.complex128] | complex:
        """Receptance H(omega) [m/N]: displacement over an oscillating force.

        Parameters
        ----------
        omega : array_like of float
            Angular frequency [rad/s].
        across : bool
            Whether the force acts across the pull.

        Returns
        -------
        complex or ndarray
            H [m/N] in the shape of omega; infinite on an undamped resonance.
        """
        omega = finite_array("omega", omega, "rad/s")
        if np.isinf((self.across if across else self.coefficients)[2]):
            return 0j if omega.ndim == 0 else np.zeros(omega.shape, dtype=complex)
        Z = self.dynamic_stiffness(omega, across=across)
        with np.errstate(divide="ignore", invalid="ignore"):
            H = np.where(Z == 0, complex(np.inf), 1 / Z)
        return complex(H) if H.ndim == 0 else H

    def dynamic_stiffness(self, omega: ArrayLike, *, across: bool = False) -> NDArray[np.complex128]:
        """Z(omega) = k - m omega² + i omega c [N/m] of a body that yields: 1/H, an oscillating force over displacement.

        Parameters
        ----------
        omega : array_like of float
            Angular frequency [rad/s].
        across : bool
            Whether the force acts across the pull.

        Returns
        -------
        ndarray
            Z [N/m] in the shape of omega.
        """
        omega = np.asarray(omega)
        m, c, k = self.across if across else self.coefficients
        return np.asarray(k - m * omega**2 + 1j * omega * c)


@dataclass(frozen=True)
class RigidPull(Pull):
    """The body moves at v_0 whatever the force: k_x -> infinity, the case of Eq. (1)."""

    @property
    def coefficients(self) -> tuple[float, float, float]:
        """No mass, no damper, a spring that does not yield."""
        return 0.0, 0.0, np.inf


@dataclass(frozen=True)
class SpringPull(Pull):
    """A mass pulled through a spring, Fig. 2 of the paper; m = 0 is a quasi-static body."""

    k_x: float = field(
        metadata=facts(
            "N/m", "stiffness of the system spring", label="system stiffness $k_x$", note=STIFFNESS, example=2e4
        )
    )
    m: float = field(
        default=0.0,
        metadata=facts("kg", "sliding mass", not_negative, label="mass $m$", note="mass in kg", example=0.1),
    )
    c_x: float = field(
        default=0.0,
        metadata=facts("N s/m", "damping of the system", not_negative, label="system damping $c_x$", example=4.0),
    )
    k_y: float | None = field(
        default=None,
        metadata=facts(
            "N/m", "stiffness across the pull; none guides the body", positive_or_none, label="stiffness $k_y$"
        ),
    )
    c_y: float | None = field(
        default=None, metadata=facts("N s/m", "damping across the pull", positive_or_none, label="damping $c_y$")
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.c_y and self.k_y is None:
            raise ValueError(
                f"c_y = {self.c_y:g} N s/m damps a motion across the pull, and without k_y the body is guided and has "
                "none: give k_y, or leave c_y out"
            )

    @property
    def coefficients(self) -> tuple[float, float, float]:
        """m [kg], c_x [N s/m], k_x [N/m]."""
        return self.m, self.c_x, self.k_x

    @property
    def across(self) -> tuple[float, float, float]:
        """m [kg], c_y [N s/m], k_y [N/m]."""
        return (0.0, 0.0, np.inf) if self.k_y is None else (self.m, self.c_y or 0.0, self.k_y)
