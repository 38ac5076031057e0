"""Fourier series of a recorded displacement, velocity or acceleration, by least squares at the instants of its samples.

A periodic record is fitted by a mean, a linear drift and harmonics of one fundamental,

    a(t) = mean + drift t + Re of sum over n of A_n exp(i n omega t),

with the instants as they are, even or not. A harmonic is kept where noise alone, taken as
white, would not reach it anywhere in its spectrum, but for a probability of 1e-4. Integrated once it is
A_n/(i n omega). The sums over the samples take one pass for all harmonics (`_sums`).
"""

from __future__ import annotations

from itertools import count
from math import factorial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.tools.arrays import EPS, SAME, Array
from mdr.tools.checks import finite_array, instants, positive
from mdr.tools.progress import Ticker
from mdr.tools.warned import warn_outside

#: symbol and unit of a displacement and its derivatives
DERIVATIVES = (("u", "m"), ("v", "m/s"), ("a", "m/s²"))
LEAST_PERIODS = 2.9  #: in a record: three, but for what their number is uncertain by
MOST_HARMONICS = 100  #: harmonics that are looked at
BINS = 2**12  #: of a period, about whose middles sums of samples are Taylor series
AT_ONCE = 2**15  #: samples of one pass that are held
STEPS = 100  #: of the frequency; some ten are needed
NEAR = 0.1  #: [rad] at the ends of the record: a step of the frequency after which more harmonics know it better
LONELY = 10.0  #: times what a hundredth of the samples exceeds: a sample so far off is hardly one of the motion
ROUNDING = 1e-14  #: mean square of a rest, over that of the record, that may be rounding

Complex = NDArray[np.complex128]
Orders = NDArray[np.intp]


class _Record(NamedTuple):
    name: str  #: of the quantity
    unit: str
    t: Array  #: (n_t,) from the middle of the record
    a: Array  #: (n_t,) less its mean
    span: float  #: [s] with the last step
    passes: Ticker
    rounded: float = (
        0.0  #: mean square, at most, of what samples lack that are rounded, as a period of their own may show
    )

    def most(self, omega: float) -> int:
        """Harmonics below half of the sampling rate, by what the record can tell apart."""
        return min(MOST_HARMONICS, int((self.t.size / 2 - 1) / self.periods(omega)))

    def periods(self, omega: float) -> float:
        return omega * self.span / (2 * np.pi)


class _Sums(NamedTuple):
    """Sums over the samples at one frequency, by orders m from zero, of x = t/span."""

    own: Complex  #: (3, 2 N + 1) of x^k exp(i m omega t), k = 0, 1, 2
    seen: Complex  #: (2, N + 1) of a x^k exp(-i m omega t)
    square: float  #: of a²
    n: int  #: how many samples


class _Fit(NamedTuple):
    orders: Orders
    A: Complex  #: (n_orders,)
    drift: float  #: over the span
    step: float  #: of the frequency, times the span, where it is free
    noise: Array  #: (n_orders,) |A|² that white noise passes at one frequency in n_t with the probability 1e-4


def series_of(t: ArrayLike, a: ArrayLike, frequency: float | None, order: int = 2) -> tuple[float, Complex]:
    """Angular frequency [rad/s] of a periodic record, and its harmonics (N,) of the orders 1 to N, with t from zero.

    order: of the derivative of a displacement that was recorded. A harmonic is zero where noise hides it. Warns where
    much of the record is left out.
    """
    name, unit = DERIVATIVES[order]
    t, a = sampled(t, a, order)
    span = (t[-1] - t[0]) * t.size / (t.size - 1)
    ticker, rounded = Ticker(f"frequency of {name}", parts="passes"), np.diff(np.unique(a)).min(initial=np.inf) ** 2 / 4
    record = _Record(name, unit, t - t.mean(), a - a.mean(), span, ticker, float(rounded))
    if frequency is None:
        omega = _fundamental(record)
    else:
        omega = 2 * np.pi * positive("frequency", frequency, "in Hz")
        _require_sampled(record, omega, f"frequency = {frequency:.6g} Hz")
    fit = _kept(_sums(record, omega, record.most(omega)))
    if not fit.orders.size:
        raise _nothing(record)
    _tell(record, omega, fit)
    A = _by_order(fit.orders, fit.A)
    return omega, A * np.exp(-1j * np.arange(1, A.size + 1) * omega * t.mean())


def sampled(t: ArrayLike, a: ArrayLike, order: int = 2) -> tuple[Array, Array]:
    """Instants [s] that rise, and what was recorded at each."""
    name, unit = DERIVATIVES[order]
    t, a = instants("t", t), finite_array(name, a, unit)
    if a.shape != t.shape:
        raise ValueError(f"{name} must have the shape {t.shape} of t, got {a.shape}")
    return t, a


def _nothing(record: _Record) -> ValueError:
    size = np.abs(record.a - np.median(record.a))
    k = int(np.argmax(size))
    way_out = "give a longer record, or its frequency"
    if size[k] > LONELY * np.sort(size)[-1 - max(3, size.size // 100)]:
        way_out = f"sample {k + 1} lies {size[k]:.4g} {record.unit} off the others: leave it out if it is wrong"
    return ValueError(f"{record.name}: nothing periodic stands out of the noise; {way_out}")


def _require_sampled(record: _Record, omega: float, what: str) -> None:
    """Refuse a fundamental that the record is too short or too coarse for."""
    periods, rate = record.periods(omega), record.t.size / record.span
    if periods < LEAST_PERIODS:
        raise ValueError(f"{what}: the record holds {periods:.3g} periods and must hold three or more")
    if record.most(omega) < 1:
        raise ValueError(
            f"{what} is not below half of the sampling rate, {rate / 2:.6g} Hz: it would be aliased; sample faster"
        )


# --- sums over the samples ---


def _sums(record: _Record, omega: float, top: int) -> _Sums:
    """What least squares by the harmonics up to an order need: one pass over the samples.

    A sample at the phase p + x, near the middle p of a bin, is exp(i m p) times a Taylor series in m x. Sums of the
    powers of x in each bin are counted, and their discrete Fourier transforms are the sums of all orders.
    """
    reach, x = _reach(2 * top), record.t / record.span
    binned = np.zeros((reach, 5, BINS))
    for k in range(0, record.t.size, AT_ONCE):
        at, off = _places(omega * record.t[k : k + AT_ONCE])
        slow, a = x[k : k + AT_ONCE], record.a[k : k + AT_ONCE]
        rows = np.stack([np.ones(at.size), slow, slow**2, a, a * slow])
        for power in binned:
            for total, row in zip(power, rows, strict=True):
                total += np.bincount(at, row, BINS)
            rows *= off
    record.passes.tick()
    m = np.arange(2 * top + 1)
    turned = np.fft.rfft(binned)[:, :, : m.size]  # of exp(-i m p)
    summed = sum(turned[j] * (-1j * m) ** j / factorial(j) for j in range(reach))
    return _Sums(summed[:3].conj(), summed[3:, : top + 1], float(record.a @ record.a), record.t.size)


def _at_samples(A: Complex, phase: Array) -> Array:
    """Re of sum A_n exp(i n phase), n = 1 ... N, at phases of any number, by the same bins."""
    n, reach, found = np.arange(A.size + 1), _reach(A.size), np.zeros(phase.size)
    spectra = np.array([BINS / 2 * (1j * n) ** j / factorial(j) for j in range(reach)]) * np.append(0, A)
    slopes = np.fft.irfft(spectra, BINS)
    for k in range(0, phase.size, AT_ONCE):
        at, off = _places(phase[k : k + AT_ONCE])
        some = found[k : k + AT_ONCE]
        for slope in slopes[::-1]:
            some *= off
            some += slope[at]
    return found


def _places(phase: Array) -> tuple[Orders, Array]:
    """The bin of each phase, and how far it is off its middle."""
    turns = phase * (BINS / (2 * np.pi))
    near = np.rint(turns)
    return near.astype(np.intp) % BINS, (turns - near) * (2 * np.pi / BINS)


def _reach(top: int) -> int:
    """Terms of Taylor's series that an order needs in half a bin."""
    return next(j for j in count(1) if (top * np.pi / BINS) ** j < EPS / 8 * factorial(j))


# --- least squares ---


def _fitted(sums: _Sums, orders: Orders, A: Complex | None = None) -> _Fit:
    """Least squares by harmonics, a mean and a drift; and by a step of the frequency, where amplitudes A are known.

    Each column is a sum of exp(i m phase) or x exp(i m phase), m of both signs: the drift is x, and the change with
    the frequency is x times the sum of i n A_n exp(i n phase). The normal equations hold sums of differences of orders.
    """
    n = np.concatenate([-orders[::-1], [0], orders])
    slow = np.zeros((n.size, 1 if A is None else 2), dtype=complex)
    slow[orders.size, 0], size = 1.0, 1.0
    if A is not None:
        rate = 1j * orders * A
        size = float(np.linalg.norm(rate))
        slow[:, 1] = np.concatenate([rate[::-1].conj(), [0], rate]) / (2 * size)
    own, seen = _signed(sums.own, n[None, :] - n[:, None]), _signed(sums.seen, n)
    beside = own[1] @ slow
    inverse = np.linalg.inv(np.block([[own[0], beside], [beside.conj().T, slow.conj().T @ own[2] @ slow]]))
    seen_a = np.concatenate([seen[0], slow.conj().T @ seen[1]])
    c = inverse @ seen_a
    rest = max(sums.square - float((seen_a.conj() @ c).real), ROUNDING * sums.square)
    noise = 4 * np.log(sums.n / 1e-4) * rest / max(sums.n - len(c), 1)
    ahead = slice(orders.size + 1, n.size)
    step = 0.0 if A is None else float(c[-1].real) / size
    return _Fit(orders, 2 * c[ahead], float(c[n.size].real), step, noise * inverse.diagonal()[ahead].real)


def _by_order(orders: Orders, A: Complex) -> Complex:
    """Amplitudes of all orders up to the highest, zero of those that are not fitted."""
    found = np.zeros(orders.max(initial=0), dtype=complex)
    found[orders - 1] = A
    return found


def _signed(table: Complex, n: Orders) -> Complex:
    """Sums for orders of either sign; those of opposite orders are conjugate."""
    found = table[..., np.abs(n)]
    return np.where(n < 0, found.conj(), found)


def _kept(sums: _Sums) -> _Fit:
    """The fit by those of all orders that stand out of the noise."""
    found = _fitted(sums, np.arange(1, sums.seen.shape[1]))
    return _fitted(sums, found.orders[np.abs(found.A) ** 2 > found.noise])


# --- the fundamental ---


def _fundamental(record: _Record) -> float:
    """Angular frequency [rad/s] of the period of a record.

    The loudest line is one of its harmonics. If the loudest line of the rest is none of the same, it is p/q times it,
    and the fundamental 1/q of it, so long as the series fits better for its length (BIC).
    """
    omega, order = _tuned(record, _loudest(record), 1), 1
    score, rest = _score(record, omega)
    while (q := _divisor(record, omega, rest)) > 1 and order * q <= MOST_HARMONICS:
        trial = _tuned(record, omega / q, order * q)
        better, rest = _score(record, trial)
        if better > score - 2 * np.log(record.t.size):  # as a harmonic counts
            break
        omega, order, score = trial, order * q, better
    _require_sampled(record, omega, f"the fundamental of {record.name} seems to be {omega / (2 * np.pi):.4g} Hz")
    return omega


def _score(record: _Record, omega: float) -> tuple[float, _Record]:
    """Bayes' information criterion of the series at a frequency, and what it leaves out."""
    fit, n = _kept(_sums(record, omega, record.most(omega))), record.t.size
    a = _rest(record, omega, fit) - fit.drift * record.t / record.span
    least = max(n * float(a.var()), n * record.rounded, ROUNDING * float(record.a @ record.a))
    return n * np.log(least) + 2 * fit.orders.size * np.log(n), record._replace(a=a - a.mean())


def _rest(record: _Record, omega: float, fit: _Fit) -> Array:
    """The record less its harmonics."""
    return record.a - _at_samples(_by_order(fit.orders, fit.A), omega * record.t)


def _divisor(record: _Record, omega: float, rest: _Record) -> int:
    """The least q for which omega/q has the loudest line of the rest among its multiples; 1 where there is none."""
    # lines nearer than 0.3 over the length of the record are one
    ratio, off = _loudest(rest) / omega, 0.3 / record.periods(omega)
    most = min(MOST_HARMONICS, int(record.periods(omega) / LEAST_PERIODS))
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
    """The frequency that fits best, with more and more harmonics: a high one is ambiguous, and sharp.

    Gauss-Newton steps of the frequency, with all amplitudes free.
    """
    orders = np.zeros(0, dtype=np.intp)
    for _ in range(STEPS):
        most = max(record.most(omega), 1)
        top = min(top, most)
        sums = _sums(record, omega, top)
        orders = orders if orders.size else _kept(sums).orders
        if not orders.size:
            raise _nothing(record)
        step = _fitted(sums, orders, _fitted(sums, orders).A).step
        omega += step / record.span
        turned = abs(step) * int(orders[-1])
        if turned < (SAME if top >= most else NEAR):
            if top >= most:
                break
            top, orders = 2 * top, orders[:0]
    return omega


def _tell(record: _Record, omega: float, fit: _Fit) -> None:
    """Warn of what the series leaves out, and of harmonics up to where sampling ends."""
    rest = _rest(record, omega, fit)
    all_of_it, drift = record.a.var(), fit.drift * record.t / record.span
    if rest.var() > 0.05 * all_of_it:  # what was left out is told above this share
        warn_outside(
            f"the series at {omega / (2 * np.pi):.6g} Hz leaves out {rest.var() / all_of_it:.0%} of the mean square of "
            f"{record.name}, {drift.var() / all_of_it:.0%} of it a linear drift: noise, another frequency, or a wrong "
            "one?"
        )
    if fit.orders[-1] == record.most(omega) < MOST_HARMONICS:
        warn_outside(
            f"the harmonics of {record.name} stand out of its noise up to half of the sampling rate, "
            f"{fit.orders[-1]} of them: higher ones would be aliased; sample faster, behind a low-pass filter"
        )
