"""The imposed motion in the plane, besides the pull: u_x(t) = v_0 t + x(t), u_y(t) = y(t), periodic with zero mean.

Along the pull it is called longitudinal, across it transverse. Where it acts matters once a body hangs on a spring. At
the tool, between body and indenter (a piezo; to shake the half-space is the same with the sign turned), the indenter
stands at the body's place plus x and y. At the pull, the far end of the pulling spring is shaken, and without friction
the body answers harmonic n by (k_x + i n omega c_x) H(n omega) X_n, and likewise across.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.case.motion import amplitudes_field, fill_up
from mdr.tools.arrays import SAME
from mdr.tools.checks import finite, not_negative
from mdr.tools.fields import Record, facts

__all__ = ["InPlaneMotion", "InPlaneOscillation"]

PLACES = ("tool", "pull")  #: where the motion may act
MOST_RATIO = 16  #: p and q, at most, of the ratio p/q of two frequencies
SAWTOOTH = tuple(round(8e-6 / (np.pi * n), 7) for n in range(1, 4))  #: of the example [m]


def _place(name: str, value: Any, note: str = "") -> str:
    if not isinstance(value, str):
        raise TypeError(f"{name} must be a word in quotes, got {value!r}")
    if value not in PLACES:
        raise ValueError(f'{name} must be "tool" (between body and indenter) or "pull", got {value!r}')
    return value


FREQUENCY = facts(
    "rad/s", "angular frequency of the motion in the plane", label=r"angular frequency $\omega_x$", example=314.159
)
PLACE = facts("", "where the motion acts", _place)


class Shake(Record, ABC):
    """A periodic motion in the plane: what each must answer is `omega`, `at`, `along`, `across` and `mirrored`."""

    omega: float
    at: str

    @property
    @abstractmethod
    def along(self) -> NDArray[np.complex128]:
        """X_n [m], shape (N,), of x(t) = Re of sum X_n exp(i n omega t), n = 1 ... N, along the pull."""

    @property
    @abstractmethod
    def across(self) -> NDArray[np.complex128]:
        """Y_n [m], shape (N,), of y(t) likewise, across the pull."""

    @property
    @abstractmethod
    def mirrored(self) -> Shake:
        """The motion -x(t), y(t)."""

    @property
    def is_still(self) -> bool:
        """Whether nothing moves."""
        return not (self.along.any() or self.across.any())


@dataclass(frozen=True)
class InPlaneOscillation(Shake):
    """A harmonic motion in the plane, besides the pull: x = du_x cos(omega t + phi_x), y = du_y cos(omega t + phi_y).

    The instant t = 0 is that of the normal oscillation u_z0 + du_z cos(omega t), so that phi_x and phi_y are phases
    between the two.
    """

    omega: float = field(metadata=FREQUENCY)
    du_x: float = field(
        default=0.0,
        metadata=facts(
            "m", "amplitude along the pull", not_negative, example=1e-5, label=r"longitudinal amplitude $\Delta u_x$"
        ),
    )
    phi_x: float = field(
        default=0.0, metadata=facts("rad", "its phase", finite, label=r"phase $\varphi_x$", example=1.5707963)
    )
    du_y: float = field(
        default=0.0,
        metadata=facts("m", "amplitude across the pull", not_negative, label=r"transverse amplitude $\Delta u_y$"),
    )
    phi_y: float = field(default=0.0, metadata=facts("rad", "its phase", finite, label=r"phase $\varphi_y$"))
    at: str = field(default="tool", metadata=PLACE)

    @property
    def along(self) -> NDArray[np.complex128]:
        """The one harmonic [m]."""
        return np.array([self.du_x * np.exp(1j * self.phi_x)])

    @property
    def across(self) -> NDArray[np.complex128]:
        """The one harmonic [m] of y."""
        return np.array([self.du_y * np.exp(1j * self.phi_y)])

    @property
    def mirrored(self) -> InPlaneOscillation:
        """The motion -x(t), y(t): x half a period later."""
        return replace(self, phi_x=self.phi_x + np.pi)


@dataclass(frozen=True)
class InPlaneMotion(Shake):
    """A periodic motion in the plane, besides the pull, as a Fourier series: a sawtooth drive, for one ::

        x(t) = sum over n >= 1 of x_cos[n-1] cos(n omega t) + x_sin[n-1] sin(n omega t)

    and y(t) across the pull likewise: a figure-eight has y of twice the frequency of x. Amplitudes in m; a list left
    out, or shorter than the others, is filled with zeros.
    """

    omega: float = field(metadata=FREQUENCY)
    x_cos: tuple[float, ...] = amplitudes_field("amplitudes of cos(n omega t)")
    x_sin: tuple[float, ...] = amplitudes_field("amplitudes of sin(n omega t)", example=SAWTOOTH)
    y_cos: tuple[float, ...] = amplitudes_field("amplitudes of cos(n omega t) across the pull")
    y_sin: tuple[float, ...] = amplitudes_field("amplitudes of sin(n omega t) across the pull")
    at: str = field(default="tool", metadata=PLACE)

    def __post_init__(self) -> None:
        super().__post_init__()
        fill_up(self, "x_cos", "x_sin", "y_cos", "y_sin")

    @property
    def along(self) -> NDArray[np.complex128]:
        """The harmonics [m]."""
        return np.array(self.x_cos) - 1j * np.array(self.x_sin)

    @property
    def across(self) -> NDArray[np.complex128]:
        """The harmonics [m] of y."""
        return np.array(self.y_cos) - 1j * np.array(self.y_sin)

    @property
    def mirrored(self) -> InPlaneMotion:
        """The motion -x(t), y(t)."""
        return replace(self, x_cos=tuple(-x for x in self.x_cos), x_sin=tuple(-x for x in self.x_sin))


@lru_cache(maxsize=256)
def whole_ratio(one: float, other: float) -> tuple[int, int]:
    """p, q of one/other = p/q, two frequencies whose sum is periodic. ValueError where p or q exceeds `MOST_RATIO`."""
    ratio = Fraction(one / other).limit_denominator(MOST_RATIO)
    p, q = ratio.numerator, ratio.denominator
    if not (1 <= p <= MOST_RATIO and abs(p / q * other / one - 1) <= SAME):
        raise ValueError(
            f"omega of the shake, {other:.9g} rad/s, and of the oscillation, {one:.9g} rad/s, must be in the ratio of "
            f"whole numbers up to {MOST_RATIO}: else the motion is not periodic, and has no average over a period"
        )
    return p, q


def sign_of(direction: int) -> int:
    """1 forward or -1 the other way; ValueError for anything else."""
    if isinstance(direction, bool) or direction not in (1, -1):
        raise ValueError(f"direction must be 1 (forward) or -1 (the pull the other way), got {direction!r}")
    return int(direction)


#: A table [shake] that does not name its motion is the first of these that has one of its keys while the last, the
#: usual one, has not.
UNNAMED: tuple[type[Shake], ...] = (InPlaneMotion, InPlaneOscillation)
