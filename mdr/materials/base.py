"""What every material must answer: how stiff it makes a spring, and how it answers in time and frequency.

A rigid indenter on one deformable body has, with Young's modulus E and Poisson's ratio nu,

    1/E* = (1 - nu²)/E,    1/G* = (2 - nu)/(4 G),    G = E/(2 (1 + nu)),

and two bodies add their compliances (Popov and Heß 2015, Method of Dimensionality Reduction, ch. 3).
Their ratio kappa = E*/G* is the Mindlin ratio. The general linear material is a Kelvin branch, modulus and dashpot in
parallel, beside any number of Maxwell arms (a generalised Maxwell, or Wiechert, body); in terms of contact moduli

    E*(omega) = E* (1 + i omega tau) + sum_j E*_j i omega tau_j/(1 + i omega tau_j),

and with a constant Poisson's ratio one operator serves both directions, which is Eq. (11).

Symbols: E, G, E_star, G_star moduli [Pa], nu Poisson's ratio [-], tau, tau_j relaxation times [s],
eta shear viscosity [Pa s], omega angular frequency [rad/s], t time [s].
"""

from abc import ABC, abstractmethod
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.tools.arrays import SAME, Array
from mdr.tools.checks import finite, finite_array, plain
from mdr.tools.fields import Record, facts
from mdr.tools.secular import secular_zeros
from mdr.tools.warned import warn_outside

Arms = tuple[tuple[float, float], ...]  #: Maxwell arms, each a modulus [Pa] and a relaxation time [s]
LEAST_POISSON = 0.01  #: above 0, of a solid; of those that people use cork, at 0, is the least


def poisson_ratio_of(mindlin_ratio: float) -> float:
    """Poisson's ratio [-] of the body whose Mindlin ratio is kappa = (2 - nu)/(2 (1 - nu))."""
    return (2 * mindlin_ratio - 2) / (2 * mindlin_ratio - 1)


def poisson_ratio(name: str, value: Any, note: str = "") -> float:
    """Poisson's ratio of a stable isotropic body, -1 < nu <= 1/2."""
    nu = finite(name, value)
    if not -1 < nu <= 0.5:
        what = f"{name} must lie in -1 < nu <= 0.5 for a stable isotropic body, got {nu!r}; rubber is 0.5"
        raise ValueError(what)
    if 0 < nu < LEAST_POISSON:
        warn_outside(f"{name} = {nu:.4g} is Poisson's ratio of no solid, cork included: is it {name}, or a time in s?")
    return nu


def complex_modulus(
    omega: ArrayLike, modulus: float, tau: float, arms: Iterable[tuple[float, float]]
) -> NDArray[np.complex128]:
    """A Kelvin branch (modulus, tau) and arms (E_j, tau_j) at the frequencies omega, in their shape; any units."""
    omega = np.asarray(omega, dtype=float)
    answer = modulus * (1 + 1j * omega * tau)
    for E_j, tau_j in arms:
        answer = answer + E_j * arm(omega * tau_j)
    return np.asarray(answer)


def arm(phase: Array) -> NDArray[np.complex128]:
    """Modulus of a Maxwell arm at phase = omega tau_j, over E_j."""
    return np.asarray(1j * phase / (1 + 1j * phase))


POISSON = facts("-", "Poisson's ratio", poisson_ratio, example=0.5)


class Material(Record, ABC):
    """What every material must answer; long-time moduli are properties, the rest follows from them."""

    if TYPE_CHECKING:

        @property
        def tau(self) -> float:
            """Relaxation time of the Kelvin branch [s], 0 for none: a field or a property of the subclass."""

    @property
    @abstractmethod
    def E_star(self) -> float:
        """Long-time normal contact modulus E* [Pa]."""

    @property
    @abstractmethod
    def G_star(self) -> float:
        """Long-time tangential contact modulus G* [Pa]."""

    @property
    @abstractmethod
    def dundurs_beta(self) -> float:
        """Dundurs' beta [-], the strength of normal-tangential coupling that the springs leave out."""

    @property
    def mindlin_ratio(self) -> float:
        """kappa = E*/G* [-], the ratio of normal to tangential contact stiffness."""
        return self.E_star / self.G_star

    @property
    def contact_arms(self) -> Arms:
        """Maxwell arms as (E*_j [Pa], tau_j [s]), beside the branch of E_star and tau; none for most materials."""
        return ()

    @property
    def instantaneous_modulus(self) -> float:
        """Contact modulus E*(t -> 0) [Pa] of a sudden step: E* and all arms; infinite with a dashpot, tau > 0."""
        return self.E_star + sum(E_j for E_j, _ in self.contact_arms) if self.tau == 0 else np.inf

    def dynamic_modulus(self, omega: ArrayLike) -> NDArray[np.complex128] | complex:
        """Complex contact modulus E*(omega) [Pa].

        Parameters
        ----------
        omega : array_like of float
            Angular frequency [rad/s].

        Returns
        -------
        complex or ndarray
            E*(omega) [Pa] in the shape of omega. The real part is the storage modulus, the imaginary part the loss
            modulus.

        Notes
        -----
        The Kelvin branch, and a sum over the Maxwell arms ::

            E*(omega) = E* (1 + i omega tau) + sum_j E*_j i omega tau_j/(1 + i omega tau_j)

        Examples
        --------
        >>> import mdr
        >>> mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3).dynamic_modulus(300.0)
        (4000000+1200000j)
        """
        omega = finite_array("omega", omega, "rad/s")
        with np.errstate(over="ignore", invalid="ignore"):
            modulus = complex_modulus(omega, self.E_star, self.tau, self.contact_arms)
        if not np.isfinite(modulus).all():
            raise ValueError(f"E*(omega) is beyond the range of floats at omega = {np.max(omega):.6g} rad/s: lower it")
        return complex(modulus) if modulus.ndim == 0 else modulus

    def relaxation_modulus(self, t: ArrayLike) -> Array:
        """Contact modulus E*(t) [Pa] after a sudden step of depth.

        Parameters
        ----------
        t : array_like of float
            Time since the step [s], zero or above.

        Returns
        -------
        float or ndarray
            E*(t) [Pa]. A dashpot, tau > 0, adds an impulse E* tau at t = 0, which is left out.

        Raises
        ------
        ValueError
            For t < 0.
        """
        t = _elapsed(t)
        return plain(self.E_star + sum((E_j * np.exp(-t / tau_j) for E_j, tau_j in self.contact_arms), 0 * t))

    def creep_compliance(self, t: ArrayLike) -> Array:
        """Creep compliance [1/Pa]: depth over load of a spring of unit width after a sudden unit load.

        Parameters
        ----------
        t : array_like of float
            Time since the load [s], zero or above.

        Returns
        -------
        float or ndarray
            J(t) [1/Pa]: 1/E* after a long time. It grows without bound for a material with E_star = 0, which flows.

        Raises
        ------
        ValueError
            For t < 0.
        """
        t = _elapsed(t)
        start, rates, times = self._retardation()
        with np.errstate(divide="ignore"):
            shares = [
                rate * (t if np.isinf(theta) else -theta * np.expm1(-t / theta))
                for rate, theta in zip(rates, times, strict=True)
            ]
        return plain(start + sum(shares, 0 * t))

    def _retardation(self) -> tuple[float, Array, Array]:
        """Creep as J(t) = start + sum of rate ∫ exp(-t/theta): start, rates and retardation times theta.

        -1/theta are the zeros of E*(p), with p = -x in the place of i omega.
        """
        E_j, tau_j = np.array(self.contact_arms).reshape(-1, 2).T
        poles = 1 / tau_j  # ascending
        start = 0.0 if self.tau > 0 else 1 / self.instantaneous_modulus
        x = secular_zeros(self.E_star, self.E_star * self.tau, E_j, poles)
        slope = self.E_star * self.tau + np.sum(E_j * poles / (poles - x[:, None]) ** 2, axis=1)  # dE*/dp
        with np.errstate(divide="ignore"):
            return float(start), 1 / slope, np.where(x > 0, 1 / x, np.inf)

    def loss_tangent(self, omega: ArrayLike) -> NDArray[np.float64] | float:
        """Loss tangent [-]: loss modulus over storage modulus.

        Parameters
        ----------
        omega : array_like of float
            Angular frequency [rad/s].

        Returns
        -------
        float or ndarray
            tan delta [-]; omega tau for a Kelvin body.
        """
        modulus = np.asarray(self.dynamic_modulus(omega))
        ratio = modulus.imag / modulus.real
        return float(ratio) if ratio.ndim == 0 else ratio


class OneBody(Material):
    """A deformable body of modulus E and ratio nu under a rigid indenter."""

    E: float
    nu: float

    @property
    def E_star(self) -> float:
        """E/(1 - nu²) [Pa]."""
        return self.E / (1 - self.nu**2)

    @property
    def G_star(self) -> float:
        """4 G/(2 - nu) [Pa]."""
        return 2 * self.E / ((1 + self.nu) * (2 - self.nu))

    @property
    def mindlin_ratio(self) -> float:
        """kappa = (2 - nu)/(2 (1 - nu)) [-]."""
        return (2 - self.nu) / (2 * (1 - self.nu))

    @property
    def dundurs_beta(self) -> float:
        """(1 - 2 nu)/(2 (1 - nu)) [-]: zero for an incompressible body, 2/7 for nu = 0.3."""
        return (1 - 2 * self.nu) / (2 * (1 - self.nu))


def _elapsed(t: ArrayLike) -> Array:
    t = finite_array("t", t, "s")
    if np.any(t < 0):
        raise ValueError(f"t must not be negative, got {float(t.min())!r} s: before the step there is no answer to it")
    return t


def answers(name: str, part: object, what: str, meaning: str) -> None:
    """TypeError unless a part of a user's own answers a quantity."""
    if not hasattr(part, what):
        raise TypeError(f"{name}: {type(part).__name__} must answer {what}, {meaning}: a field or a property")


def refuse_other_materials(material: Material, omega: float) -> None:
    """TypeError or ValueError for a material of a user's own of which springs do not know all that it answers."""
    answers("material", material, "tau", "the relaxation time [s] of its Kelvin branch, 0.0 for none")
    if type(material).dynamic_modulus is Material.dynamic_modulus:
        return
    own, known = complex(material.dynamic_modulus(omega)), complex(Material.dynamic_modulus(material, omega))
    if not abs(own - known) <= SAME * abs(known):
        raise ValueError(
            f"material = {material!r} answers dynamic_modulus(omega) = {own:.6g} Pa, and its E_star, tau and "
            f"contact_arms make {known:.6g} Pa: springs know a material by these three; give it arms, as Prony.fit does"
        )
