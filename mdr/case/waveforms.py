"""Named waveforms of the depth, of so many harmonics: saw, square and pulse, as motions.

The ideal ones jump, and no drive does. Harmonic n of N is therefore lowered to the share 1 - n/(N + 1) (Fejér): the
mean of the first N + 1 partial sums, which never leaves the range of the ideal waveform, so that nothing overshoots at
a jump. The amplitude is then brought to du_z. What this costs stands at each function, and is tested [waveforms].

Symbols: u_z0 mean depth [m], du_z what the depth falls by below its mean [m], omega angular frequency [rad/s].
"""

from __future__ import annotations

from typing import Any

import numpy as np

from mdr.case.depth_cycle import Cycle
from mdr.case.motion import PeriodicMotion
from mdr.tools.arrays import Array
from mdr.tools.checks import between, count, finite, positive, truth

__all__ = ["pulse", "sawtooth", "square"]


def sawtooth(u_z0: float, du_z: float, omega: float, *, n_harmonics: int, falling: bool = False) -> PeriodicMotion:
    """Depth [m] that rises slowly and drops at once, at t = 0; or jumps up there and falls slowly.

    The critical velocity of the ideal ones is 1/pi of that of a sine of the same du_z, and infinite. With 16 harmonics
    it is 0.40 and 6.3 of that, and up to 0.12 mu_0 du_z/u_z0 more friction is lost, and 0.06 less [waveforms].

    Parameters
    ----------
    u_z0 : float
        Mean depth [m].
    du_z : float
        What the depth falls by below its mean [m]: contact is kept up to u_z0.
    omega : float
        Angular frequency [rad/s].
    n_harmonics : int
        How many harmonics the drive can make.
    falling : bool
        Falls slowly and jumps up.

    Returns
    -------
    PeriodicMotion
        The motion.

    Examples
    --------
    >>> import mdr
    >>> motion = mdr.waveforms.sawtooth(20e-6, 5e-6, 300.0, n_harmonics=16, falling=True)
    >>> print((1e6 * motion.u_z([0.25 * motion.period, 0.75 * motion.period])).round(2))  # µm
    [22.99 17.01]
    """
    n = _orders(n_harmonics)
    truth("falling", falling)
    return _smoothed(u_z0, du_z, omega, sin=(1 if falling else -1) / n)


def square(u_z0: float, du_z: float, omega: float, *, n_harmonics: int) -> PeriodicMotion:
    """Depth [m] that is high for half of a period, around t = 0, and low for the other: a pulse of width 1/2.

    The critical velocity of the ideal one is infinite. With 16 harmonics it is 5.6 times that of a sine of the same
    du_z, and up to 0.14 mu_0 du_z/u_z0 less friction is lost [waveforms].

    Parameters
    ----------
    u_z0 : float
        Mean depth [m].
    du_z : float
        What the depth falls by below its mean [m]: contact is kept up to u_z0.
    omega : float
        Angular frequency [rad/s].
    n_harmonics : int
        How many harmonics the drive can make.

    Returns
    -------
    PeriodicMotion
        The motion.

    Examples
    --------
    >>> import mdr
    >>> motion = mdr.waveforms.square(20e-6, 5e-6, 300.0, n_harmonics=16)
    >>> print((1e6 * motion.u_z([0.0, 0.5 * motion.period])).round(2))  # µm
    [24.98 15.02]
    """
    return pulse(u_z0, du_z, omega, n_harmonics=n_harmonics, width=0.5)


def pulse(u_z0: float, du_z: float, omega: float, *, n_harmonics: int, width: float) -> PeriodicMotion:
    """Depth [m] that is high for a share of the period, around t = 0, and low else.

    The critical velocity of the ideal one is infinite. With 16 harmonics and a width of 1/4 it is 11 times that of a
    sine of the same du_z, and up to 0.23 mu_0 du_z/u_z0 less friction is lost [waveforms].

    Parameters
    ----------
    u_z0 : float
        Mean depth [m].
    du_z : float
        What the depth falls by below its mean [m]: contact is kept up to u_z0. It rises by du_z (1 - width)/width.
    omega : float
        Angular frequency [rad/s].
    n_harmonics : int
        How many harmonics the drive can make; less than about 1/width make no more of it than a narrow bell.
    width : float
        Share of the period [-], between 0 and 1.

    Returns
    -------
    PeriodicMotion
        The motion.

    Examples
    --------
    >>> import mdr
    >>> motion = mdr.waveforms.pulse(20e-6, 5e-6, 300.0, n_harmonics=16, width=0.25)
    >>> print((1e6 * motion.u_z([0.0, 0.5 * motion.period])).round(2))  # µm
    [34.48 15.02]
    """
    n, width = _orders(n_harmonics), between("width", width, 0, 1, "share of the period")
    return _smoothed(u_z0, du_z, omega, cos=np.sin(np.pi * n * width) / n)


def _orders(n_harmonics: Any) -> Array:
    return np.arange(1.0, count("n_harmonics", n_harmonics, 1) + 1)


def _smoothed(u_z0: Any, du_z: Any, omega: Any, cos: Array | float = 0.0, sin: Array | float = 0.0) -> PeriodicMotion:
    """The series with Fejér's factors, brought to a fall of du_z."""
    cos, sin = np.broadcast_arrays(cos, sin)
    share = 1 - np.arange(1, cos.size + 1) / (cos.size + 1)
    cycle = Cycle.series(0.0, 1.0, cos * share, sin * share)
    scale = positive("du_z", du_z, "what the depth falls by below its mean, in m") / -cycle.least
    return PeriodicMotion(omega, finite("u_z0", u_z0), tuple(scale * cycle.cos), tuple(scale * cycle.sin))
