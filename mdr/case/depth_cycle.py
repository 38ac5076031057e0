"""One period of depth, whatever imposes it: mean, swing, extremes, and z(phase) in a unit of length.

    u_z(t) = u_z0 + unit z(omega t),    z(phase) = sum over n of c_n cos(n phase) + s_n sin(n phase).

The unit is the amplitude du_z, half the way between the extremes, so that a harmonic motion is c_1 = 1; of a constant
depth, z = 0, it is the depth. What a spring that keeps contact feels is a sum of harmonics too, each with the response
of the material, and its least force tells which springs keep contact.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from mdr.tools.arrays import EPS, Array
from mdr.tools.records import ArrayRecord


def lost_in_digits(largest: Array | float, deepest: float) -> Array | float:
    """Error of friction over mu_0 that no method avoids: the rounding of the largest of the lengths whose differences
    are followed, over the greatest depth, to which they all but cancel in a contact of an instant.
    """
    return 2 * EPS * largest / deepest if deepest > 0 else 0.0


@dataclass(frozen=True, eq=False, repr=False)
class Cycle(ArrayRecord):
    """A periodic depth; harmonics of shape (N,), of orders 1 to N."""

    u_z0: float  #: mean depth [m]
    unit: float  #: half the way from the least to the greatest depth [m]; u_z0 where it is constant
    omega: float  #: angular frequency of the period [rad/s]
    cos: Array  #: c_n, over the unit
    sin: Array  #: s_n, over the unit
    least: float  #: least z
    greatest: float  #: greatest z
    missing: float = 0.0  #: of the balance of forces that the depth was solved from, over the mean load

    @classmethod
    @lru_cache(maxsize=64)
    def harmonic(cls, u_z0: float, du_z: float, omega: float) -> Cycle:
        """u_z0 + du_z cos(omega t)."""
        return cls(u_z0, du_z, omega, np.ones(1), np.zeros(1), -1.0, 1.0)

    @classmethod
    def constant(cls, u_z0: float) -> Cycle:
        """u_z0 > 0 at all times."""
        return cls(u_z0, u_z0, 0.0, np.zeros(1), np.zeros(1), 0.0, 0.0)

    @classmethod
    def series(cls, u_z0: float, omega: float, cos: Array, sin: Array) -> Cycle:
        """A Fourier series with coefficients in m."""
        amplitude = cos - 1j * sin
        low, high = -peak(-amplitude), peak(amplitude)
        du_z = 0.5 * (high - low)
        if du_z == 0:
            return cls(u_z0, 0.0, omega, np.zeros_like(cos), np.zeros_like(sin), 0.0, 0.0)
        return cls(u_z0, du_z, omega, cos / du_z, sin / du_z, low / du_z, high / du_z)

    def repeated(self, n: int, omega: float) -> Cycle:
        """The same depth over a period n times as long, whose angular frequency is omega."""
        if n == 1 and omega == self.omega:
            return self
        cos, sin = np.zeros((2, n * self.cos.size))
        cos[n - 1 :: n], sin[n - 1 :: n] = self.cos, self.sin
        return replace(self, omega=omega, cos=cos, sin=sin)

    @property
    def lost_in_digits(self) -> float:
        """Error of friction over mu_0 that the digits of mean and amplitude leave."""
        deepest = self.u_z0 + self.unit * self.greatest
        return float(lost_in_digits(max(-self.u_z0, deepest), deepest))

    @property
    def du_z(self) -> float:
        """Amplitude [m]: half the way from the least to the greatest depth."""
        return self.unit * 0.5 * (self.greatest - self.least)

    @property
    def is_harmonic(self) -> bool:
        """Whether it is cos(phase) alone."""
        return self.cos.size == 1 and self.cos[0] == 1 and self.sin[0] == 0

    @property
    def harmonics(self) -> NDArray[np.complex128]:
        """C_n with z = Re of sum C_n exp(i n phase), n = 1 ... N."""
        return np.asarray(self.cos - 1j * self.sin)

    def z(self, phase: Array) -> Array:
        """Depth less its mean, over the unit, at phases of any shape."""
        return harmonic_sum(self.harmonics, phase)

    def rate(self, phase: Array) -> Array:
        """dz/dphase."""
        return harmonic_sum(1j * np.arange(1, self.cos.size + 1) * self.harmonics, phase)

    def bend(self, phase: Array) -> Array:
        """d²z/dphase²."""
        return harmonic_sum(-(np.arange(1, self.cos.size + 1) ** 2) * self.harmonics, phase)

    def over_a_period(self, steps: int) -> tuple[Array, Array]:
        """z and its rate at equidistant phases, both ends included: (steps + 1,), not to be written to."""
        return _over_a_period(self.harmonics.tobytes(), steps)

    def kept_gap(self, response: Callable[[Array], NDArray[np.complex128]]) -> float:
        """Gap, in units from the mean depth, of the shallowest spring that never leaves: its least force is zero.

        response: of the material to harmonics n (N,), over its long-time modulus.
        """
        return -peak(-self.harmonics * response(np.arange(1.0, self.cos.size + 1)))


@lru_cache(maxsize=64)
def _over_a_period(numbers: bytes, steps: int) -> tuple[Array, Array]:
    harmonics = np.frombuffer(numbers, dtype=complex)
    n = np.arange(1, harmonics.size + 1)
    z, rate = (at_instants(C_n, steps) for C_n in (harmonics, 1j * n * harmonics))
    return np.append(z, z[0]), np.append(rate, rate[0])


def harmonic_sum(harmonics: NDArray[np.complex128], phase: Array) -> Array:
    """Re of sum C_n exp(i n phase), n = 1 ... N, at phases of any shape."""
    phase = np.asarray(phase, dtype=float)
    total = np.zeros(phase.shape)
    for n in np.flatnonzero(harmonics):
        turn = (n + 1) * phase
        total += harmonics[n].real * np.cos(turn) - harmonics[n].imag * np.sin(turn)
    return total


def at_instants(harmonics: NDArray[np.complex128], n_t: int) -> Array:
    """The same at n_t equidistant phases of a period, from 0."""
    if harmonics.size < 32:
        return harmonic_sum(harmonics, 2 * np.pi * np.arange(n_t) / n_t)
    spectrum = np.zeros(n_t, dtype=complex)
    np.add.at(spectrum, np.arange(1, harmonics.size + 1) % n_t, harmonics)  # of orders that agree at all instants
    return np.asarray(n_t * np.fft.ifft(spectrum).real)


def turns(harmonics: NDArray[np.complex128], highest: bool = False) -> Array:
    """Phases in [0, 2 pi) at which it is greatest or least among its neighbours, ascending; or those alone of which one
    is the highest of all.
    """
    used = np.flatnonzero(harmonics)
    n, C = used + 1, harmonics[used]
    if n.size < 2:
        return np.sort(np.mod((np.pi * np.arange(2 * n.sum()) - np.angle(C)) / n, 2 * np.pi)) if n.size else np.zeros(0)
    # 64 instants per period of the highest harmonic, between which an extreme is found
    count = int(2 ** np.ceil(np.log2(max(64 * n[-1], 256))))
    spectrum = np.zeros((2, count // 2 + 1), dtype=complex)
    spectrum[:, n] = C * count / 2, 1j * n * C * count / 2
    values, slopes = np.fft.irfft(spectrum, count)
    falls = slopes < 0
    low = np.flatnonzero(falls != np.roll(falls, -1))
    if highest:  # half an instant away a maximum is higher by no more than step² max |z''|/8
        tops = low[~falls[low]]
        near = np.maximum(values[tops], values[(tops + 1) % count])
        low = tops[near >= near.max() - (np.pi / count) ** 2 / 2 * (n**2 @ np.abs(C))]
    side = np.where(falls[low], 1, -1)

    def slope(phase: Array) -> tuple[Array, Array]:
        turn = C * n * np.exp(1j * np.multiply.outer(phase, n))
        return -side * turn.imag.sum(axis=-1), -side * (n * turn.real).sum(axis=-1)

    return np.sort(np.mod(roots(slope, 2 * np.pi * low / count, 2 * np.pi * (low + 1) / count), 2 * np.pi))


def roots(
    f: Callable[[Array], tuple[Array, Array]],
    low: Array | float,
    high: Array | float,
    x: Array | None = None,
    near: float = 2e-16,
) -> Array:
    """Where functions rise through zero between low and high, by Newton's method kept within a bracket, element by
    element. f answers values and slopes; x: a first guess; near: last step, of a phase.
    """
    low, high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    x = np.asarray(0.5 * (low + high)) if x is None else x
    for _ in range(100):
        value, slope = f(x)
        low, high = np.where(value < 0, x, low), np.where(value < 0, high, x)
        with np.errstate(all="ignore"):
            better = x - value / slope
        better = np.where((better >= low) & (better <= high), better, 0.5 * (low + high))
        step, x = np.abs(better - x), better
        if np.all(step <= near * (1 + np.abs(x))):
            break
    return x


def peak(harmonics: NDArray[np.complex128]) -> float:
    """Greatest value of Re of sum C_n exp(i n phase), n = 1 ... N, over the period."""
    return _peak(np.asarray(harmonics, dtype=complex).tobytes())


@lru_cache(maxsize=256)
def _peak(numbers: bytes) -> float:
    harmonics = np.frombuffer(numbers, dtype=complex)
    return float(harmonic_sum(harmonics, turns(harmonics, highest=True)).max()) if harmonics.any() else 0.0


def least_of(values: Array) -> float:
    """Minimum over a period of equidistant values, by the parabola through the least one and its neighbours."""
    k = int(np.argmin(values))
    before, least, after = values[k - 1], values[k], values[(k + 1) % values.size]
    bend = before - 2 * least + after
    return float(least - (after - before) ** 2 / (8 * bend) if bend > 0 else least)


def stick_limit(mu_0: float, du_z: float, omega: float, mindlin_ratio: float) -> float:
    """Greatest rate [m/s] of the deflection at which a pressed spring slips, mu_0 kappa omega du_z: Eq. (1)."""
    return mu_0 * mindlin_ratio * omega * du_z
