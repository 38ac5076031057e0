"""Displacement from a recorded acceleration that need not be periodic: integrated twice, above a high-pass."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from mdr.case.acceleration import sampled
from mdr.tools.arrays import Array
from mdr.tools.checks import FieldError, positive

UNEVEN = 0.1  #: of a step, which sampled instants may be off a grid
ORDER = 4  #: of the Butterworth filter
REACH = 8.0  #: times 1/high_pass, after which the response of the filter is below 1e-8


def displacement_of(t: ArrayLike, a: ArrayLike, *, high_pass: float) -> Array:
    """Displacement [m] of a recorded acceleration, of frequencies above a high-pass.

    Of a record that need not be periodic. Slower motion cannot be told from the drift of an accelerometer. Of a
    periodic one `PeriodicMotion.from_acceleration` knows more.

    Parameters
    ----------
    t : array_like of float, shape (n_t,)
        Instants [s], rising in equal steps.
    a : array_like of float, shape (n_t,)
        Acceleration [m/s²].
    high_pass : float
        Frequency [Hz] at which the filter halves the displacement.

    Returns
    -------
    ndarray
        Displacement [m], shape (n_t,), about zero.

    Raises
    ------
    TypeError, ValueError
        For NaN, lists of different lengths, uneven instants, a high-pass whose period is longer than the record or
        that is above half of the sampling rate.

    Notes
    -----
    The filter is a Butterworth high-pass of fourth order, run forwards and backwards, so that no phase is shifted: it
    multiplies the displacement at the frequency f by 1/(1 + (high_pass/f)⁸). Filter and integration are done on the
    spectrum. The record counts as zero before and after: within about 1/high_pass of its ends the result is uncertain.

    Examples
    --------
    >>> import numpy as np
    >>> import mdr
    >>> t = np.linspace(0, 2, 4001)
    >>> a = -2e-6 * (2 * np.pi * 100) ** 2 * np.sin(2 * np.pi * 100 * t) + 0.1 * t  # 2 um at 100 Hz, and drift
    >>> print(f"{np.ptp(mdr.displacement_of(t, a, high_pass=10)[1000:3000]):.3g} m")
    4e-06 m
    """
    t, a = sampled(t, a)
    high_pass, step = positive("high_pass", high_pass, "in Hz"), (t[-1] - t[0]) / (t.size - 1)
    off = np.abs(t - t[0] - step * np.arange(t.size)) / step
    if off.max() > UNEVEN:
        raise FieldError(
            f"t must rise in equal steps, but sample {np.argmax(off)} is off by {off.max():.2g} steps: interpolate a",
            "t",
        )
    low, high = 1 / (step * t.size), 0.5 / step
    if not low <= high_pass < high:
        raise FieldError(
            f"high_pass must lie between {low:.4g} Hz, one over the record, and {high:.4g} Hz, half of the sampling "
            f"rate, got {high_pass:.6g}",
            "high_pass",
        )
    n = t.size + int(REACH / (high_pass * step)) + 1
    x = np.fft.rfftfreq(n, step) / high_pass
    gain = -(x ** (2 * ORDER - 2)) / (1 + x ** (2 * ORDER)) / (2 * np.pi * high_pass) ** 2
    return np.asarray(np.fft.irfft(gain * np.fft.rfft(a - a.mean(), n), n)[: t.size])
