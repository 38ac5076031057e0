"""Displacement from a recorded acceleration or velocity that need not be periodic: integrated above a high-pass."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from mdr.case.acceleration import DERIVATIVES, sampled
from mdr.tools.arrays import SAME, Array
from mdr.tools.checks import positive
from mdr.tools.warned import warn_outside

ORDER = 4  #: of the Butterworth filter


def displacement_of(t: ArrayLike, a: ArrayLike, *, high_pass: float, order: int = 2) -> Array:
    """Displacement [m] of a recorded acceleration or velocity, of frequencies above a high-pass.

    Of a record that need not be periodic. Slower motion cannot be told from the drift of a sensor. Of a periodic one
    `PeriodicMotion.from_acceleration` and `from_velocity` know more.

    Parameters
    ----------
    t : array_like of float, shape (n_t,)
        Instants [s], rising in equal steps.
    a : array_like of float, shape (n_t,)
        Acceleration [m/s²], or what `order` says.
    high_pass : float
        Frequency [Hz] at which the filter halves the displacement.
    order : int
        How often it is integrated: 2, an acceleration; 1, a velocity [m/s]; 0, a displacement [m], that is filtered
        alone.

    Returns
    -------
    ndarray
        Displacement [m], shape (n_t,), about zero.

    Raises
    ------
    TypeError, ValueError
        For NaN, lists of different lengths, uneven instants, a high-pass whose period is longer than the record or
        that is above half of the sampling rate.

    Warns
    -----
    PlausibilityWarning
        Where more of a lies within a decade below the high-pass than above it.

    Notes
    -----
    The filter is a Butterworth high-pass of fourth order, run forwards and backwards, so that no phase is shifted: it
    multiplies the displacement at the frequency f by 1/(1 + (high_pass/f)⁸). Filter and integration are done on the
    spectrum. What moved before the record and after it is not known. Of all that could have, that is taken which leaves
    the least displacement in the mean square. Within 1/high_pass of the ends the result is uncertain all the same: that
    of a steady tone f by up to 5 high_pass/f of its amplitude, and by a tenth of that further inside.

    Examples
    --------
    >>> import numpy as np
    >>> import mdr
    >>> t = np.linspace(0, 2, 4001)
    >>> a = -2e-6 * (2 * np.pi * 100) ** 2 * np.sin(2 * np.pi * 100 * t) + 0.1 * t  # 2 um at 100 Hz, and drift
    >>> print(f"{np.ptp(mdr.displacement_of(t, a, high_pass=10)[1000:3000]):.3g} m")
    4e-06 m
    """
    if order not in (0, 1, 2):
        raise ValueError(f"order must be 2 of an acceleration, 1 of a velocity or 0 of a displacement, got {order!r}")
    t, a = sampled(t, a, order)
    name = DERIVATIVES[order][0]
    high_pass, step = positive("high_pass", high_pass, "in Hz"), (t[-1] - t[0]) / (t.size - 1)
    off = np.abs(t - t[0] - step * np.arange(t.size)) / step
    if off.max() > 0.1:  # instants may be off a grid by this share of a step
        raise ValueError(
            f"t must rise in equal steps, but sample {np.argmax(off)} is off by {off.max():.2g} steps: interpolate "
            f"{name}"
        )
    low, high = 1 / (step * t.size), 0.5 / step
    if not low <= high_pass < high:
        raise ValueError(
            f"high_pass must lie between {low:.4g} Hz, one over the record, and {high:.4g} Hz, half of the sampling "
            f"rate, got {high_pass:.6g}"
        )
    # after 8/high_pass the response of the filter is below 1e-8
    n = t.size + int(8.0 / (high_pass * step)) + 1
    x = np.fft.rfftfreq(n, step) / high_pass
    gain = x ** (2 * ORDER - order) / (1 + x ** (2 * ORDER)) / (2j * np.pi * high_pass) ** order
    spectrum = np.fft.rfft(a - a.mean(), n)
    # a Hann window, which leaves 3/8 of a steady power, and the straight line take drift off; slower still is drift
    line, below = np.polynomial.Polynomial.fit(t, a, 1), (x > 0.1) & (x < 1)
    power = 8 / 3 * np.abs(np.fft.rfft((a - line(t)) * np.hanning(t.size), n)) ** 2
    if power[below].sum() > np.sum(np.abs(spectrum[x >= 1]) ** 2):
        loudest = x[below][np.argmax(power[below])] * high_pass
        warn_outside(f"most of {name} lies below the high-pass, at {loudest:.4g} Hz, and is left out: lower high_pass")
    u = np.fft.irfft(gain * spectrum, n)[: t.size]
    outside = _from_outside(2 * np.pi * high_pass * step * np.arange(t.size))
    return np.asarray(u - outside @ np.linalg.lstsq(outside, u, rcond=None)[0])


def _from_outside(phase: Array) -> Array:
    """What any acceleration before and after the record moves in it, (n_t, 2 ORDER): decays from either end.

    They are the poles of the filter, 1 + s^8 = 0, those of the left half plane from the first sample on, and the same
    backwards from the last.
    """
    poles = np.exp(1j * np.pi * (np.arange(ORDER // 2) + 0.5 + ORDER / 2) / ORDER)
    decays = np.exp(np.outer(phase, poles))
    columns = np.hstack([decays.real, decays.imag])
    return np.hstack([columns, columns[::-1]])


def inner_part(t: Array, high_pass: float) -> slice:
    """The samples of a record but for its ends, within 1/high_pass, where the displacement above it is uncertain.

    ValueError where they leave too little.
    """
    ends, long = 1 / high_pass, float(t[-1] - t[0])
    least = 2.25 / long  # 0.25/high_pass must be left between the ends
    if high_pass < least * (1 - SAME):
        raise ValueError(
            f"high_pass = {high_pass:.6g} Hz leaves the displacement uncertain for {ends:.4g} s at either end of the "
            f"record of {long:.4g} s: give {least:.3g} Hz or more, or a longer record"
        )
    first, end = np.searchsorted(t, [t[0] + ends * (1 - SAME), t[-1] - ends * (1 - SAME)])
    return slice(int(first), int(end))
