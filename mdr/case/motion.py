"""The imposed normal motion: a depth that oscillates, Eq. (3), a periodic depth of any form, or an oscillating load.

Symbols: u_z0 mean indentation depth [m], du_z amplitude [m], omega angular frequency [rad/s], F_z0 mean load [N],
dF_z its amplitude [N], m_z mass that the load moves [kg].
"""

from __future__ import annotations

from abc import ABC
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.case.depth_cycle import Cycle
from mdr.tools.checks import count, finite, finite_array, not_negative, positive


class Motion(ABC):
    """A periodic normal motion."""

    omega: float

    @property
    def period(self) -> float:
        """2 pi/omega [s]."""
        return 2 * np.pi / self.omega


class DepthMotion(Motion):
    """A periodic motion of prescribed depth."""

    u_z0: float

    @property
    def cycle(self) -> Cycle:
        """The depth over one period."""
        raise NotImplementedError

    def u_z(self, t: ArrayLike) -> NDArray[np.float64]:
        """Depth [m] over time.

        Parameters
        ----------
        t : array_like of float
            Time [s].

        Returns
        -------
        ndarray
            Depth [m] in the shape of t.
        """
        cycle = self.cycle
        return self.u_z0 + cycle.du_z * cycle.z(self.omega * finite_array("t", t, "s"))

    def u_z_dot(self, t: ArrayLike) -> NDArray[np.float64]:
        """Rate of the depth [m/s] over time.

        Parameters
        ----------
        t : array_like of float
            Time [s].

        Returns
        -------
        ndarray
            Rate [m/s] in the shape of t.
        """
        cycle = self.cycle
        return cycle.du_z * self.omega * cycle.rate(self.omega * finite_array("t", t, "s"))


@dataclass(frozen=True)
class NormalOscillation(DepthMotion):
    """A harmonic normal motion of prescribed depth, Eq. (3): u_z(t) = u_z0 + du_z cos(omega t).

    The mean depth may be zero or negative as long as the indenter touches in part of the period:
    that is tapping, u_z0 + du_z > 0.
    """

    u_z0: float  #: mean indentation depth [m]
    du_z: float  #: amplitude [m]
    omega: float  #: angular frequency [rad/s]

    def __post_init__(self) -> None:
        object.__setattr__(self, "u_z0", finite("u_z0", self.u_z0))
        object.__setattr__(self, "du_z", positive("du_z", self.du_z, "amplitude in m"))
        object.__setattr__(self, "omega", positive("omega", self.omega, "angular frequency in rad/s"))
        if self.u_z0 + self.du_z <= 0:
            raise ValueError(
                f"u_z0 + du_z = {self.u_z0 + self.du_z:.6g} m: the indenter never touches; "
                f"raise u_z0 above -du_z = {-self.du_z:.6g} m"
            )

    @property
    def cycle(self) -> Cycle:
        """The depth over one period."""
        return Cycle.harmonic(self.u_z0, self.du_z, self.omega)


@dataclass(frozen=True)
class PeriodicMotion(DepthMotion):
    """A periodic normal motion of prescribed depth, as a Fourier series ::

        u_z(t) = u_z0 + sum over n >= 1 of cos[n-1] cos(n omega t) + sin[n-1] sin(n omega t)

    Several frequencies are harmonics of a common omega; a square-like tapping is a series of many. Amplitudes in m; a
    list left out, or shorter than the other, is filled with zeros, and zeros at the end of both are dropped.
    """

    omega: float  #: angular frequency of the period [rad/s]
    u_z0: float  #: mean indentation depth [m]
    cos: tuple[float, ...] = ()  #: amplitudes of cos(n omega t) [m], n = 1, 2, ...
    sin: tuple[float, ...] = ()  #: amplitudes of sin(n omega t) [m], n = 1, 2, ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "omega", positive("omega", self.omega, "angular frequency in rad/s"))
        object.__setattr__(self, "u_z0", finite("u_z0", self.u_z0))
        lists = [_amplitudes("cos", self.cos), _amplitudes("sin", self.sin)]
        length = max((n for values in lists for n, value in enumerate(values, start=1) if value), default=0)
        for name, values in zip(("cos", "sin"), lists, strict=True):
            object.__setattr__(self, name, (values + (0.0,) * length)[:length])
        if not length:
            raise ValueError("cos and sin are all zero: nothing oscillates; give an amplitude in m")
        deepest = self.u_z0 + self.cycle.du_z * self.cycle.greatest
        if deepest <= 0:
            raise ValueError(f"u_z = {deepest:.6g} m at its deepest: the indenter never touches; raise u_z0")

    @property
    def cycle(self) -> Cycle:
        """The depth over one period."""
        return Cycle.series(self.u_z0, self.omega, np.array(self.cos), np.array(self.sin))

    @classmethod
    def of(cls, u_z: ArrayLike, omega: float, n_harmonics: int | None = None) -> PeriodicMotion:
        """The Fourier series [m] through depths at equidistant instants of one period.

        Parameters
        ----------
        u_z : array_like of float, shape (n,)
            Depths [m], starting at t = 0.
        omega : float
            Angular frequency of the period [rad/s].
        n_harmonics : int, optional
            Keep only the first ones. None: all that n instants define, below n/2.

        Returns
        -------
        PeriodicMotion
            The motion.

        Raises
        ------
        ValueError
            For fewer than three depths.
        """
        u_z = finite_array("u_z", u_z, "m")
        if u_z.ndim != 1 or u_z.size < 3:
            raise ValueError(f"u_z must be a list of at least 3 depths over one period, got shape {u_z.shape}")
        most = (u_z.size - 1) // 2
        keep = most if n_harmonics is None else min(count("n_harmonics", n_harmonics, 1), most)
        spectrum = np.fft.rfft(u_z)[1 : keep + 1] * 2 / u_z.size
        return cls(omega, float(u_z.mean()), tuple(spectrum.real), tuple(-spectrum.imag))


@dataclass(frozen=True)
class LoadOscillation(Motion):
    """A normal load that oscillates, the drive of most experiments: F_z(t) = F_z0 + dF_z cos(omega t).

    The depth follows from the contact law, with the inertia of the mass that the load moves ::

        m_z u_z'' = F_z(t) - F_N

    Without mass the load must press at every instant, dF_z < F_z0; with one it may let go.
    """

    F_z0: float  #: mean load [N]
    dF_z: float  #: amplitude [N]
    omega: float  #: angular frequency [rad/s]
    m_z: float = 0.0  #: mass moved in the normal direction [kg]

    def __post_init__(self) -> None:
        object.__setattr__(self, "F_z0", positive("F_z0", self.F_z0, "mean load in N"))
        object.__setattr__(self, "dF_z", positive("dF_z", self.dF_z, "amplitude of the load in N"))
        object.__setattr__(self, "omega", positive("omega", self.omega, "angular frequency in rad/s"))
        object.__setattr__(self, "m_z", not_negative("m_z", self.m_z, "mass in kg"))
        if self.m_z == 0 and self.dF_z >= self.F_z0:
            raise ValueError(
                f"dF_z = {self.dF_z:.6g} N must be less than F_z0 = {self.F_z0:.6g} N where nothing has mass: the load "
                "would lift the indenter off and no contact bring it back; lower dF_z, or give m_z"
            )

    def F_z(self, t: ArrayLike) -> NDArray[np.float64]:
        """Load F_z0 + dF_z cos(omega t) [N].

        Parameters
        ----------
        t : array_like of float
            Time [s].

        Returns
        -------
        ndarray
            Load [N] in the shape of t.
        """
        return self.F_z0 + self.dF_z * np.cos(self.omega * finite_array("t", t, "s"))


def _amplitudes(name: str, values: Any) -> tuple[float, ...]:
    if isinstance(values, str) or not isinstance(values, Sequence | np.ndarray):
        raise TypeError(f"{name} must be a list of amplitudes in m, got {values!r}")
    return tuple(finite(f"{name}[{n}]", value) for n, value in enumerate(values))
