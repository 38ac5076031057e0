"""A depth that vibrates at random: a stationary Gaussian process, given by its spectrum.

S one-sided power density of the depth over the frequency f, so that the integral of S over f is its mean square. The
moments m_k, integrals of S (2 pi f)^k, are the mean squares of its derivatives: rms² = m_0, rms_velocity² = m_2,
rms_acceleration² = m_4.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mdr.tools.arrays import Array
from mdr.tools.checks import count, not_negative, positive
from mdr.tools.fields import Record, facts

NODES, WEIGHTS = np.polynomial.legendre.leggauss(4)  # exact for a line times f^6


def _row(name: str, values: Any, note: str = "") -> tuple[float, ...]:
    """A list of numbers, none of them negative."""
    if isinstance(values, str) or not isinstance(values, Sequence | np.ndarray):
        raise TypeError(f"{name} must be a list of numbers ({note}), got {values!r}")
    return tuple(not_negative(f"{name}[{n}]", value, note) for n, value in enumerate(values))


@dataclass(frozen=True)
class Spectrum(Record):
    """One-sided power density of a depth that vibrates at random: a table, linear in between and zero outside.

    Examples
    --------
    >>> import mdr
    >>> band = mdr.Spectrum.band(rms=1e-6, f_low=50.0, f_high=150.0)
    >>> print(f"{band.rms:.3g} m, {band.rms_velocity:.3g} m/s, {band.rms_acceleration:.3g} m/s²")
    1e-06 m, 0.000654 m/s, 0.486 m/s²
    """

    f: tuple[float, ...] = field(metadata=facts("Hz", "frequencies, rising", _row, example=(50.0, 150.0)))
    density: tuple[float, ...] = field(
        metadata=facts("m²/Hz", "power density of the depth at each", _row, example=(1e-14, 1e-14))
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.f) < 2 or len(self.density) != len(self.f):
            sizes = f"{len(self.f)} and {len(self.density)}"
            raise ValueError(f"f and density must be lists of one length, two or more, got {sizes} numbers")
        if np.any(np.diff(self.f) <= 0):
            raise ValueError(f"f must rise, got {self.f}: take a steep edge over a small step")
        if not self.moment(0) > 0:
            raise ValueError("density is zero: nothing vibrates")

    @classmethod
    def band(cls, rms: float, f_low: float, f_high: float) -> Spectrum:
        """A flat band of frequencies.

        Parameters
        ----------
        rms : float
            Root mean square of the depth about its mean [m].
        f_low, f_high : float
            Ends of the band [Hz], 0 <= f_low < f_high.

        Returns
        -------
        Spectrum
            The spectrum.

        Raises
        ------
        TypeError, ValueError
            For an rms that is not positive, and frequencies that do not rise.
        """
        rms, f_low, f_high = positive("rms", rms, "in m"), not_negative("f_low", f_low), positive("f_high", f_high)
        if f_high <= f_low:
            raise ValueError(f"f_high must be above f_low = {f_low!r} Hz, got {f_high!r} Hz")
        return cls((f_low, f_high), (rms**2 / (f_high - f_low),) * 2)

    def moment(self, k: int) -> float:
        """Moment m_k [m²/s^k], the integral of the density times (2 pi f)^k.

        Parameters
        ----------
        k : int
            Its order, from 0 to 6.

        Returns
        -------
        float
            The moment.

        Raises
        ------
        TypeError, ValueError
            For an order that is no whole number, or beyond 6.
        """
        f, density = self._nodes
        if count("k", k, 0) > 6:
            raise ValueError(f"k must be at most 6, got {k}")
        return float((density * (2 * np.pi * f) ** k).sum())

    @property
    def rms(self) -> float:
        """Root mean square of the depth about its mean [m]."""
        return float(np.sqrt(self.moment(0)))

    @property
    def rms_velocity(self) -> float:
        """Root mean square of its rate [m/s]."""
        return float(np.sqrt(self.moment(2)))

    @property
    def rms_acceleration(self) -> float:
        """Root mean square of its acceleration [m/s²]."""
        return float(np.sqrt(self.moment(4)))

    @property
    def spread(self) -> float:
        """m_2 m_6/m_4² - 1 [-]: 0 of a sine, 0.10 of the upper half of a flat band, 0.19 of all of it."""
        return self.moment(2) * self.moment(6) / self.moment(4) ** 2 - 1

    @property
    def correlation_time(self) -> float:
        """Time [s] over which it forgets: integral of the squared density over the squared integral."""
        f = np.array(self.f)
        _, density = self._nodes
        squares = density**2 / (np.diff(f)[:, None] * WEIGHTS / 2)
        return float(squares.sum() / self.moment(0) ** 2)

    def realisation(self, n_t: int, dt: float, seed: int = 0, k: int = 0) -> Array:
        """One history of the random depth [m], of mean zero, that repeats itself after n_t dt.

        A sum of cosines of the frequencies i/(n_t dt), with Gaussian amplitudes. Each has the power of the spectrum
        next to its frequency, so that the mean square over all realisations is exact.

        Parameters
        ----------
        n_t : int
            Number of samples.
        dt : float
            Time between them [s]; less than half of the shortest period.
        seed, k : int
            The same numbers give the same history; k counts realisations of a seed.

        Returns
        -------
        ndarray, shape (n_t,)
            Depth at the instants 0, dt, 2 dt, ..., less its mean.

        Raises
        ------
        TypeError, ValueError
            For what is no whole number, and for samples too far apart.
        """
        n_t, dt, seed, k = count("n_t", n_t, 2), positive("dt", dt, "in s"), count("seed", seed, 0), count("k", k, 0)
        if 2 * dt * self.f[-1] > 1 - 1 / n_t:
            raise ValueError(
                f"dt = {dt:.6g} s is too long for frequencies up to {self.f[-1]:.6g} Hz: take {n_t} closer"
            )
        edges = np.concatenate([[0.0], (np.arange(n_t // 2 + 1) + 0.5) / (n_t * dt)])
        power = np.diff(self._below(edges))
        power[0] *= 4  # of a cosine that stands still
        drawn = np.random.default_rng((seed, k)).standard_normal((power.size, 2))
        return np.fft.irfft(n_t / 2 * np.sqrt(power) * (drawn[:, 0] + 1j * drawn[:, 1]), n_t)

    def _below(self, f: Array) -> Array:
        """Mean square [m²] of what is below frequencies."""
        at, density = np.array(self.f), np.array(self.density)
        step = np.diff(at)
        whole = np.concatenate([[0.0], np.cumsum(step * (density[1:] + density[:-1]) / 2)])
        i = np.clip(np.searchsorted(at, f) - 1, 0, step.size - 1)
        x = np.clip(f, at[0], at[-1]) - at[i]
        return np.asarray(whole[i] + x * (density[i] + x * (np.diff(density) / step)[i] / 2))

    @property
    def _nodes(self) -> tuple[Array, Array]:
        """Frequencies within the steps of the table, and the density there times the weight of a sum, (n - 1, 4)."""
        f, density, share = np.array(self.f), np.array(self.density), (NODES + 1) / 2
        step = np.diff(f)[:, None]
        inside = density[:-1, None] + share * np.diff(density)[:, None]
        return f[:-1, None] + share * step, inside * step * WEIGHTS / 2
