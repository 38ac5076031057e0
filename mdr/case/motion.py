"""The imposed normal motion: a depth that oscillates, Eq. (3), a periodic depth of any form, or an oscillating load.
A depth or a load that is constant stands beside a motion in the plane (in_plane.py).

Symbols: u_z0 mean indentation depth [m], du_z amplitude [m], omega angular frequency [rad/s], F_z0 mean load [N],
dF_z its amplitude [N], m_z mass that the load moves [kg].
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.case.acceleration import DERIVATIVES, series_of
from mdr.case.depth_cycle import Cycle
from mdr.indenters.base import Indenter
from mdr.materials.base import Material
from mdr.tools.checks import count, finite, finite_array, not_negative, positive
from mdr.tools.fields import Record, facts
from mdr.tools.warned import warn_outside

__all__ = ["ConstantDepth", "ConstantLoad", "LoadOscillation", "Motion", "NormalOscillation", "PeriodicMotion"]


def amplitudes(name: str, values: Any, note: str = "") -> tuple[float, ...]:
    """A list of amplitudes [m], as a tuple. TypeError or ValueError for what is none."""
    if isinstance(values, str) or not isinstance(values, Sequence | np.ndarray):
        raise TypeError(f"{name} must be a list of amplitudes in m, got {values!r}")
    return tuple(finite(f"{name}[{n}]", value) for n, value in enumerate(values))


def amplitudes_field(meaning: str, example: tuple[float, ...] | None = None) -> tuple[float, ...]:
    """The field of a list of amplitudes [m], which may be left out."""
    return field(default=(), metadata=facts("m", meaning, amplitudes, example=example))


def fill_up(record: Any, *names: str) -> int:
    """Bring lists of amplitudes of a record that is being made to one length, with zeros, and drop those at the end of
    all; returns the length.
    """
    lists = {name: getattr(record, name) for name in names}
    length = max((n for values in lists.values() for n, value in enumerate(values, start=1) if value), default=0)
    for name, values in lists.items():
        object.__setattr__(record, name, (values + (0.0,) * length)[:length])
    return length


NO_DEPTH = "amplitude of the depth in m; a depth that does not oscillate is a ConstantDepth, under a shake"
NO_LOAD = "amplitude of the load in N; a load that does not oscillate is a ConstantLoad, under a shake"
FREQUENCY = facts("rad/s", "angular frequency", label=r"angular frequency $\omega$", example=314.159)
MEAN_DEPTH = facts("m", "mean indentation depth", finite, label="mean depth $u_{z0}$", example=20e-6)


class Motion(Record, ABC):
    """A periodic normal motion: what each must answer is `omega` and `cycle`."""

    if TYPE_CHECKING:

        @property
        def omega(self) -> float:
            """Angular frequency [rad/s], zero of what is constant: a field or a property of the subclass."""

    #: the load that the depth was solved from; None where the depth itself is prescribed
    load: LoadOscillation | ConstantLoad | None = None

    @property
    @abstractmethod
    def cycle(self) -> Cycle:
        """The depth over one period."""

    @property
    def knows_depth(self) -> bool:
        """Whether `cycle` can answer. Under a load the depth follows from shape and material: see `mdr.resolved`."""
        return True

    @property
    def working_depth(self) -> float:
        """Depth [m] that the stiffness of the contact belongs to: the mean depth u_z0."""
        return self.cycle.u_z0

    @property
    def period(self) -> float:
        """2 pi/omega [s]; infinite of what is constant."""
        return 2 * np.pi / self.omega if self.omega else np.inf

    def on(self, indenter: Indenter, material: Material) -> Motion:
        """The motion of a contact of these two: itself, unless it was solved for another contact.

        Parameters
        ----------
        indenter : Indenter
            Shape of the contact.
        material : Material
            Its half-space.

        Returns
        -------
        Motion
            The motion.
        """
        return self

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
        return cycle.u_z0 + cycle.unit * cycle.z(self.omega * finite_array("t", t, "s"))

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
        return cycle.unit * self.omega * cycle.rate(self.omega * finite_array("t", t, "s"))

    def u_z_ddot(self, t: ArrayLike) -> NDArray[np.float64]:
        """Acceleration of the depth [m/s²] over time.

        Parameters
        ----------
        t : array_like of float
            Time [s].

        Returns
        -------
        ndarray
            Acceleration [m/s²] in the shape of t.
        """
        cycle = self.cycle
        return cycle.unit * self.omega**2 * cycle.bend(self.omega * finite_array("t", t, "s"))


@dataclass(frozen=True)
class NormalOscillation(Motion):
    """A harmonic normal motion of prescribed depth, Eq. (3): u_z(t) = u_z0 + du_z cos(omega t).

    The mean depth may be zero or negative as long as the indenter touches in part of the period:
    that is tapping, u_z0 + du_z > 0.
    """

    u_z0: float = field(metadata=MEAN_DEPTH)
    du_z: float = field(
        metadata=facts("m", "amplitude of the depth", note=NO_DEPTH, label=r"amplitude $\Delta u_z$", example=2e-6)
    )
    omega: float = field(metadata=FREQUENCY)

    def __post_init__(self) -> None:
        super().__post_init__()
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
class ConstantDepth(Motion):
    """A depth that does not change, u_z(t) = u_z0 > 0: the contact is shaken in the plane alone."""

    u_z0: float = field(metadata=facts("m", "indentation depth", label="depth $u_{z0}$", example=20e-6))

    #: it does not oscillate
    omega: ClassVar[float] = 0.0

    @property
    def cycle(self) -> Cycle:
        """The depth at all times."""
        return Cycle.constant(self.u_z0)


@dataclass(frozen=True)
class PeriodicMotion(Motion):
    """A periodic normal motion of prescribed depth, u_z0 + sum of cos[n-1] cos(n omega t) + sin[n-1] sin(n omega t).

    The sum is over n >= 1, a Fourier series. Several frequencies are harmonics of a common omega; a square-like tapping
    is a series of many. Amplitudes in m; a list left out, or shorter than the other, is filled with zeros, and zeros at
    the end of both are dropped.
    """

    omega: float = field(metadata=FREQUENCY)
    u_z0: float = field(metadata=MEAN_DEPTH)
    cos: tuple[float, ...] = amplitudes_field("amplitudes of cos(n omega t)", example=(2e-6, 5e-7))
    sin: tuple[float, ...] = amplitudes_field("amplitudes of sin(n omega t)", example=(0.0, 3e-7))

    def __post_init__(self) -> None:
        super().__post_init__()
        if not fill_up(self, "cos", "sin"):
            what = "cos and sin are all zero: nothing oscillates; give an amplitude in m, or take ConstantDepth"
            raise ValueError(what)
        deepest = self.u_z0 + self.cycle.unit * self.cycle.greatest
        if deepest <= 0:
            raise ValueError(f"u_z = {deepest:.6g} m at its deepest: the indenter never touches; raise u_z0")

    @property
    def cycle(self) -> Cycle:
        """The depth over one period."""
        return _series(self)

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

        Warns
        -----
        PlausibilityWarning
            For an amplitude above 1 cm, as when an acceleration is given for a depth, and for several periods.
        """
        u_z = finite_array("u_z", u_z, "m")
        if u_z.ndim != 1 or u_z.size < 3:
            raise ValueError(f"u_z must be a list of at least 3 depths over one period, got shape {u_z.shape}")
        most = (u_z.size - 1) // 2
        keep = most if n_harmonics is None else min(count("n_harmonics", n_harmonics, 1), most)
        spectrum = np.fft.rfft(u_z)[1 : keep + 1] * 2 / u_z.size
        motion, power = cls(omega, float(u_z.mean()), tuple(spectrum.real), tuple(-spectrum.imag)), abs(spectrum) ** 2
        n = 1 + int(np.argmax(power))
        # a depth repeats n times if nearly all of its mean square is in every nth harmonic
        if n > 1 and power[n - 1 :: n].sum() > 0.99 * power.sum():
            warn_outside(f"u_z repeats {n} times: give one period, and omega of that period")
        return motion._not_wide("is u_z an acceleration? PeriodicMotion.from_acceleration integrates one")

    @classmethod
    def from_acceleration(
        cls, t: ArrayLike, a: ArrayLike, *, u_z0: float, frequency: float | None = None
    ) -> PeriodicMotion:
        """The Fourier series [m] of a recorded acceleration of many periods.

        Parameters
        ----------
        t : array_like of float, shape (n_t,)
            Instants [s], rising, in even steps or not, over three periods or more.
        a : array_like of float, shape (n_t,)
            Acceleration [m/s²], positive into the half-space as the depth is. A constant part, such as gravity, and a
            linear drift do not matter.
        u_z0 : float
            Mean depth [m], which an acceleration does not tell.
        frequency : float, optional
            Fundamental [Hz], if it is known exactly. None: it is found.

        Returns
        -------
        PeriodicMotion
            The motion, on the time of the record.

        Raises
        ------
        TypeError, ValueError
            For NaN, lists of different lengths, instants that do not rise, too few periods, a frequency above half of
            the sampling rate, a record in which nothing periodic stands out of the noise.

        Warns
        -----
        PlausibilityWarning
            Where more than 5 % of the mean square of a is left out, harmonics reach half of the sampling rate, or the
            amplitude of the depth is above 1 cm, or less than an atom.

        Notes
        -----
        Least squares at the instants of the record. Of the first 100 harmonics those are kept that white noise alone
        would hardly reach (1 in 1000 records); each is divided by (i n omega)². The frequency is the one that fits
        best. What was left out is ``a - motion.u_z_ddot(t)``, with the mean of a.

        Examples
        --------
        >>> import numpy as np
        >>> import mdr
        >>> t = np.arange(0, 1, 1e-4)
        >>> phase = 2 * np.pi * 80.3 * t
        >>> a = -0.5 * np.cos(phase) + 0.1 * np.cos(3 * phase) + np.random.default_rng(1).normal(0, 0.02, t.size)
        >>> motion = mdr.PeriodicMotion.from_acceleration(t, a, u_z0=20e-6)
        >>> print(f"{motion.omega / (2 * np.pi):.2f} Hz, {len(motion.cos)} harmonics, {motion.cos[0]:.2e} m")
        80.30 Hz, 3 harmonics, 1.96e-06 m
        """
        return cls._recorded(2, t, a, u_z0, frequency)

    @classmethod
    def from_velocity(
        cls, t: ArrayLike, v: ArrayLike, *, u_z0: float, frequency: float | None = None
    ) -> PeriodicMotion:
        """The Fourier series [m] of a recorded velocity of many periods, as of a vibrometer.

        Parameters
        ----------
        t : array_like of float, shape (n_t,)
            Instants [s].
        v : array_like of float, shape (n_t,)
            Velocity [m/s], positive into the half-space.
        u_z0 : float
            Mean depth [m], which a velocity does not tell.
        frequency : float, optional
            Fundamental [Hz], if it is known exactly.

        Returns
        -------
        PeriodicMotion
            The motion, on the time of the record.

        See Also
        --------
        from_acceleration : the same of an acceleration, with what is refused and told.
        """
        return cls._recorded(1, t, v, u_z0, frequency)

    @classmethod
    def from_displacement(
        cls, t: ArrayLike, u: ArrayLike, *, u_z0: float, frequency: float | None = None
    ) -> PeriodicMotion:
        """The Fourier series [m] of a recorded displacement of many periods.

        Parameters
        ----------
        t : array_like of float, shape (n_t,)
            Instants [s].
        u : array_like of float, shape (n_t,)
            Displacement [m], positive into the half-space.
        u_z0 : float
            Mean depth [m]: that of the displacement counts from a zero of its sensor.
        frequency : float, optional
            Fundamental [Hz], if it is known exactly.

        Returns
        -------
        PeriodicMotion
            The motion, on the time of the record.

        See Also
        --------
        from_acceleration : the same of an acceleration, with what is refused and told.
        of : depths at equidistant instants of one period.
        """
        return cls._recorded(0, t, u, u_z0, frequency)

    @classmethod
    def _recorded(
        cls, order: int, t: ArrayLike, values: ArrayLike, u_z0: float, frequency: float | None
    ) -> PeriodicMotion:
        """Of the derivative of this order of the displacement: each harmonic over (i n omega)^order."""
        omega, A = series_of(t, values, frequency, order)
        swing = A / (1j * np.arange(1, A.size + 1) * omega) ** order
        name, unit = DERIVATIVES[order]
        return cls(omega, u_z0, tuple(swing.real), tuple(-swing.imag))._not_wide(f"is {name} in {unit}, and t in s?")

    def with_amplitude(self, du_z: float) -> PeriodicMotion:
        """The same waveform, larger or smaller.

        Parameters
        ----------
        du_z : float
            Half the way from the least to the greatest depth [m].

        Returns
        -------
        PeriodicMotion
            The motion about the same mean.

        Raises
        ------
        TypeError, ValueError
            For what is no length above zero.
        """
        share = positive("du_z", du_z, "amplitude in m") / self.cycle.du_z
        cos, sin = (tuple(share * one for one in each) for each in (self.cos, self.sin))
        return replace(self, cos=cos, sin=sin)

    def _not_wide(self, question: str) -> PeriodicMotion:
        """The motion; with a warning where its amplitude is hardly meant."""
        if not 1e-10 < self.cycle.du_z < 0.01:  # [m]: less than an atom, or hardly meant
            warn_outside(f"the amplitude of the depth is {self.cycle.du_z:.3g} m: {question}")
        return self


class _Load(Motion):
    """A motion whose load is given."""

    @property
    def knows_depth(self) -> bool:
        """False: the depth follows from shape and material too."""
        return False

    @property
    def cycle(self) -> Cycle:
        """Raises ValueError: the depth is asked of the resolved case."""
        raise ValueError(
            f"the depth under {self!r}, and with it cycle, working_depth, u_z_max, k_zc, k_xc, gamma_zc, gamma_xc, "
            "alpha, chi, kept_gap, unit_velocity, pace and keeps_contact, follow from shape and material too: "
            "ask mdr.resolved(case)"
        )


@dataclass(frozen=True)
class LoadOscillation(_Load):
    """A normal load that oscillates, the drive of most experiments: F_z(t) = F_z0 + dF_z cos(omega t).

    The depth follows from the contact law, with the inertia of the mass that the load moves ::

        m_z u_z'' = F_z(t) - F_N

    `mdr.resolved(case)` solves for it. Without mass the load must press at every instant, dF_z < F_z0; with one it may
    let go.
    """

    F_z0: float = field(metadata=facts("N", "mean load", label="mean load $F_{z0}$", example=0.1))
    dF_z: float = field(
        metadata=facts("N", "amplitude of the load", note=NO_LOAD, label=r"load amplitude $\Delta F_z$", example=0.01)
    )
    omega: float = field(metadata=FREQUENCY)
    m_z: float = field(default=0.0, metadata=facts("kg", "mass that the load moves", not_negative))

    def __post_init__(self) -> None:
        super().__post_init__()
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


@dataclass(frozen=True)
class ConstantLoad(_Load):
    """A normal load that does not change: the contact is shaken in the plane alone.

    `mdr.resolved(case)` knows the depth at which it rests.
    """

    F_z0: float = field(metadata=facts("N", "load", label="load $F_{z0}$", example=0.1))

    #: it does not oscillate
    omega: ClassVar[float] = 0.0


@lru_cache(maxsize=256)
def _series(motion: PeriodicMotion) -> Cycle:
    return Cycle.series(motion.u_z0, motion.omega, np.array(motion.cos), np.array(motion.sin))


#: A table [oscillation] that does not name its motion is the first of these that has one of its keys while the last,
#: the usual one, has not.
UNNAMED: tuple[type[Motion], ...] = (LoadOscillation, PeriodicMotion, NormalOscillation)
