"""Fourier series of a recorded acceleration, by least squares at the instants at which it was sampled.

A periodic record is fitted by a mean, a linear drift and harmonics of one fundamental,

    a(t) = mean + drift t + Re of sum over n of A_n exp(i n omega t),

with the instants as they are, even or not. A harmonic is kept where noise alone, taken as
white, would not reach it anywhere in its spectrum, but for a probability of 1e-4. Twice integrated it is
-A_n/(n omega)².
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.case.depth_cycle import harmonic_sum
from mdr.tools.arrays import SAME, Array
from mdr.tools.checks import finite_array, instants, positive
from mdr.tools.warned import warn_outside

LEAST_PERIODS = 2.9  #: in a record: three, but for what their number is uncertain by
MOST = 100  #: harmonics that are looked at
AT_ONCE = 1024  #: samples whose powers are held
LONELY = 10.0  #: times what a hundredth of the samples exceeds: a sample so far off is hardly one of the motion
ROUNDING = 1e-14  #: mean square of a rest, over that of the record, that may be rounding

Complex = NDArray[np.complex128]
Orders = NDArray[np.intp]


class _Record(NamedTuple):
    t: Array  #: (n_t,) from the middle of the record
    a: Array  #: (n_t,) less its mean
    span: float  #: [s] with the last step

    def most(self, omega: float) -> int:
        """Harmonics below half of the sampling rate, by what the record can tell apart."""
        return min(MOST, int((self.t.size / 2 - 1) / self.periods(omega)))

    def periods(self, omega: float) -> float:
        return omega * self.span / (2 * np.pi)


class _Fit(NamedTuple):
    orders: Orders
    A: Complex  #: (n_orders,)
    columns: Array  #: factors of the columns, the drift first
    noise: Array  #: (n_orders,) |A|² that white noise passes at one frequency in n_t with the probability 1e-4


def series_of(t: ArrayLike, a: ArrayLike, frequency: float | None) -> tuple[float, Complex]:
    """Angular frequency [rad/s] of a periodic record, and its harmonics (N,) of the orders 1 to N, with t from zero.

    A harmonic is zero where noise hides it. Warns where much of the record is left out.
    """
    t, a = sampled(t, a)
    record = _Record(t - t.mean(), a - a.mean(), (t[-1] - t[0]) * t.size / (t.size - 1))
    if frequency is None:
        omega = _fundamental(record)
    else:
        omega = 2 * np.pi * positive("frequency", frequency, "in Hz")
        _require_sampled(record, omega, f"frequency = {frequency:.6g} Hz")
    fit = _kept(record, omega, _up_to(record.most(omega)))
    if not fit.orders.size:
        raise _nothing(record)
    A = _by_order(fit)
    _tell(record, omega, A, fit)
    return omega, A * np.exp(-1j * np.arange(1, A.size + 1) * omega * t.mean())


def sampled(t: ArrayLike, a: ArrayLike) -> tuple[Array, Array]:
    """Instants [s] that rise, and an acceleration [m/s²] at each."""
    t, a = instants("t", t), finite_array("a", a, "m/s²")
    if a.shape != t.shape:
        raise ValueError(f"a must have the shape {t.shape} of t, got {a.shape}")
    return t, a


def _nothing(record: _Record) -> ValueError:
    size = np.abs(record.a - np.median(record.a))
    k = int(np.argmax(size))
    way_out = "give a longer record, or its frequency"
    if size[k] > LONELY * np.sort(size)[-1 - max(3, size.size // 100)]:
        way_out = f"sample {k + 1} lies {size[k]:.4g} m/s² off the others: leave it out if it is wrong"
    return ValueError(f"a: nothing periodic stands out of the noise; {way_out}")


def _require_sampled(record: _Record, omega: float, what: str) -> None:
    """Refuse a fundamental that the record is too short or too coarse for."""
    periods, rate = record.periods(omega), record.t.size / record.span
    if periods < LEAST_PERIODS:
        raise ValueError(f"{what}: the record holds {periods:.3g} periods and must hold three or more")
    if record.most(omega) < 1:
        raise ValueError(
            f"{what} is not below half of the sampling rate, {rate / 2:.6g} Hz: it would be aliased; sample faster"
        )


def _up_to(n: int) -> Orders:
    return np.arange(1, n + 1)


# --- least squares ---


def _fitted(record: _Record, omega: float, orders: Orders, *columns: Array) -> _Fit:
    """Least squares by harmonics, a mean, a drift and more columns.

    The normal equations of exp(i n phase), n of both signs, hold sums of exp(i m phase) alone, of differences m of
    orders.
    """
    t, a = record.t, record.a
    rows = np.stack([a, t / record.span, *columns])
    n, top = np.concatenate([-orders[::-1], [0], orders]), int(orders[-1]) if orders.size else 0
    turn, power = np.exp(1j * omega * t), np.ones((top + 1, min(AT_ONCE, t.size)), dtype=complex)
    sums, seen = np.zeros(2 * top + 1, dtype=complex), np.zeros((len(rows), top + 1), dtype=complex)
    for k in range(0, t.size, AT_ONCE):
        some = power[:, : turn[k : k + AT_ONCE].size]
        for m in range(top):
            np.multiply(some[m], turn[k : k + AT_ONCE], out=some[m + 1])
        row = rows[:, k : k + AT_ONCE]
        seen += row @ some.real.T - 1j * (row @ some.imag.T)
        sums[:top] += some[:top].sum(axis=1)
        sums[top:] += some @ some[top]
    own, beside = _signed(sums, n[None, :] - n[:, None]), _signed(seen, n)
    inverse = np.linalg.inv(np.block([[own, beside[1:].T], [beside[1:].conj(), rows[1:] @ rows[1:].T]]))
    seen_a = np.concatenate([beside[0], rows[1:] @ a])
    c = inverse @ seen_a
    rest = max(float(a @ a - (seen_a.conj() @ c).real), ROUNDING * float(a @ a))
    noise = 4 * np.log(t.size / 1e-4) * rest / max(t.size - len(c), 1)
    ahead = slice(orders.size + 1, n.size)
    return _Fit(orders, 2 * c[ahead], c[n.size :].real, noise * inverse.diagonal()[ahead].real)


def _by_order(fit: _Fit) -> Complex:
    """Amplitudes of all orders up to the highest, zero of those that are not fitted."""
    A = np.zeros(fit.orders.max(initial=0), dtype=complex)
    A[fit.orders - 1] = fit.A
    return A


def _signed(table: Complex, n: NDArray[np.intp]) -> Complex:
    """Sums for orders of either sign; those of opposite orders are conjugate."""
    found = table[..., np.abs(n)]
    return np.where(n < 0, found.conj(), found)


def _kept(record: _Record, omega: float, orders: Orders) -> _Fit:
    """The fit by those of some orders that stand out of the noise."""
    found = _fitted(record, omega, orders)
    return _fitted(record, omega, orders[np.abs(found.A) ** 2 > found.noise])


# --- the fundamental ---


def _fundamental(record: _Record) -> float:
    """Angular frequency [rad/s] of the period of a record.

    The loudest line is one of its harmonics. If the loudest line of the rest is none of the same, it is p/q times it,
    and the fundamental 1/q of it, so long as the series fits better for its length (BIC).
    """
    omega, order = _tuned(record, _loudest(record), 1), 1
    score, rest = _score(record, omega)
    while (q := _divisor(record, omega, rest)) > 1 and order * q <= MOST:
        trial = _tuned(record, omega / q, order * q)
        better, rest = _score(record, trial)
        if better > score - 2 * np.log(record.t.size):  # as a harmonic counts
            break
        omega, order, score = trial, order * q, better
    _require_sampled(record, omega, f"the fundamental of a seems to be {omega / (2 * np.pi):.4g} Hz")
    return omega


def _score(record: _Record, omega: float) -> tuple[float, _Record]:
    """Bayes' information criterion of the series at a frequency, and what it leaves out."""
    fit, n = _kept(record, omega, _up_to(record.most(omega))), record.t.size
    a = record.a - harmonic_sum(_by_order(fit), omega * record.t) - fit.columns[0] * record.t / record.span
    least = max(n * float(a.var()), ROUNDING * float(record.a @ record.a))
    return n * np.log(least) + 2 * fit.orders.size * np.log(n), record._replace(a=a - a.mean())


def _divisor(record: _Record, omega: float, rest: _Record) -> int:
    """The least q for which omega/q has the loudest line of the rest among its multiples; 1 where there is none."""
    # lines nearer than 0.3 over the length of the record are one
    ratio, off = _loudest(rest) / omega, 0.3 / record.periods(omega)
    most = min(MOST, int(record.periods(omega) / LEAST_PERIODS))
    return next((q for q in range(1, most + 1) if abs(round(q * ratio) / q - ratio) < off), 1)


def _loudest(record: _Record) -> float:
    """Angular frequency of the highest line of the spectrum, to a quarter of 1/span."""
    n = record.t.size
    even = np.linspace(record.t[0], record.t[-1], n)
    x = np.interp(even, record.t, record.a)
    drift = even * float(even @ x) / float(even @ even)
    spectrum = np.abs(np.fft.rfft((x - drift) * np.hanning(n), 4 * n))
    first, end = int(4 * LEAST_PERIODS), 2 * n - 4
    if first >= end:
        raise ValueError(f"t must be a list of 8 instants or more, over three periods, got {n}")
    return 2 * np.pi * (first + int(np.argmax(spectrum[first:end]))) / (4 * record.span)


def _tuned(record: _Record, omega: float, top: int) -> float:
    """The frequency that fits best, found with more and more harmonics: a high one is ambiguous, and sharp."""
    while True:
        most = max(record.most(omega), 1)
        top = min(top, most)
        orders = _kept(record, omega, _up_to(top)).orders
        if not orders.size:
            raise _nothing(record)
        omega = _refined(record, omega, orders)
        if top >= most:
            return omega
        top *= 2


def _refined(record: _Record, omega: float, orders: Orders) -> float:
    """Gauss-Newton steps of the frequency, with all amplitudes free."""
    for _ in range(20):
        rate = 1j * _up_to(int(orders[-1])) * _by_order(_fitted(record, omega, orders))
        column = record.t / record.span * harmonic_sum(rate, omega * record.t)
        size = float(np.linalg.norm(column) / np.sqrt(column.size))
        step = _fitted(record, omega, orders, column / size).columns[1] / (size * record.span)
        omega += float(step)
        if abs(step) * record.span * orders[-1] < SAME:
            break
    return omega


def _tell(record: _Record, omega: float, A: Complex, fit: _Fit) -> None:
    """Warn of what the series leaves out, and of harmonics up to where sampling ends."""
    rest = record.a - harmonic_sum(A, omega * record.t)
    all_of_it, drift = record.a.var(), fit.columns[0] * record.t / record.span
    if rest.var() > 0.05 * all_of_it:  # what was left out is told above this share
        warn_outside(
            f"the series at {omega / (2 * np.pi):.6g} Hz leaves out {rest.var() / all_of_it:.0%} of the mean square of "
            f"a, {drift.var() / all_of_it:.0%} of it a linear drift: noise, another frequency, or a wrong one?"
        )
    if A.size == record.most(omega) < MOST:
        warn_outside(
            f"the harmonics of a stand out of its noise up to half of the sampling rate, {A.size} of them: higher ones "
            "would be aliased; sample faster, behind a low-pass filter"
        )
