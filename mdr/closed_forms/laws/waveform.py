"""Laws of the waveform of a normal oscillation: the friction it takes from a flat punch, and the best ones.

Symbols: x phase over 2 pi, w(x) waveform of period 1, mean 0 and least value -1, so that u_z = u_z0 (1 + alpha w) with
alpha = A_z/u_z0 and A_z the fall of the depth below its mean; beta = 2 pi v_0/(mu_0 kappa omega A_z). After M. Popov,
Front. Mech. Eng. 6 (2020) 69, Eqs. (20), (30), (33) to (37). An elastic spring under a rigid pull is extended by the
least of what it was compressed by at any time before plus the pull since (docs/theory.md), so that the lost friction is

    Psi(beta) = mean of w(x) - mean of min over y >= 0 of [w(x - y) + beta y].
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.case.motion import Motion
from mdr.tools.arrays import EPS, Array
from mdr.tools.checks import count, finite_array, not_negative, plain

TOLERANCE = 1e-11  #: of a parabola in the place of a piece, over A_z; Psi is off by at most 4 times as much
FIRST = 100  #: pieces of a period, of five samples each, before the first is halved
NARROWEST = 4e-15  #: piece of a period that is a jump if it is still no parabola


def waveform_loss(w: Motion | Callable[[Array], ArrayLike] | ArrayLike, beta: ArrayLike) -> Any:
    """Friction Psi [-] that a normal oscillation of any waveform takes from a flat punch: mu/mu_0 = 1 - alpha Psi.

    Elastic, rigid pull, contact kept (A_z <= u_z0). Psi is 1 at rest, falls, is convex, and is 0 from the steepest
    slope of w on (`waveform_critical`). Other shapes lose as much to first order in alpha, times
    k_zc u_z0/(mean of F_N) [waveforms].

    Parameters
    ----------
    w : Motion, callable or array_like of float, shape (n,)
        The waveform, of any scale: it is brought to mean 0 and least value -1. A callable takes an array of phases over
        2 pi, in [0, 1), and answers in its shape; it may jump and bend, but no part that matters should be shorter than
        1/400. An array holds equidistant samples of one period, from phase 0, joined by straight lines: of a smooth
        waveform or of a jump give a callable. A motion is one of known depth, such as those of `mdr.waveforms`.
    beta : float or array_like of float
        Velocity 2 pi v_0/(mu_0 kappa omega A_z) [-], zero or above; A_z [m] the fall of the depth below its mean.

    Returns
    -------
    float or ndarray
        Psi [-], in the shape of beta, within 1e-10.

    Raises
    ------
    ValueError
        For a waveform that is constant, not finite or too rough, and a negative beta.
    TypeError
        For what is no waveform.

    Examples
    --------
    >>> print(round(mdr.laws.waveform_loss(lambda x: np.cos(2 * np.pi * x), 1.0), 5))
    0.64207
    >>> mdr.laws.waveform_loss(lambda x: x < 0.5, [0.5, 8.0]).round(4)  # on half of the period, off the other
    array([0.9375, 0.25  ])
    """
    row, known = _row(w), finite_array("beta", beta)
    not_negative("beta", float(known.min(initial=0.0)), "velocity")
    return plain(np.reshape([_lost(row, one) for one in known.ravel()], known.shape))


def waveform_critical(w: Motion | Callable[[Array], ArrayLike] | ArrayLike) -> float:
    """Critical velocity beta_c [-] of a waveform, its steepest slope: beyond it friction is full.

    v_c = mu_0 kappa (omega/2 pi) A_z beta_c, for any shape as long as contact is kept and the pull rigid: Eq. (20) of
    M. Popov (2020), Eq. (1) for the sine, beta_c = 2 pi [waveforms].

    Parameters
    ----------
    w : Motion, callable or array_like of float, shape (n,)
        The waveform, as in `waveform_loss`.

    Returns
    -------
    float
        beta_c [-], within 1e-7 of it; infinite where the depth jumps up.

    Examples
    --------
    >>> print(round(mdr.laws.waveform_critical(lambda x: x), 6))  # a rising saw
    2.0
    >>> mdr.laws.waveform_critical(lambda x: -x)  # a falling one
    inf
    """
    _, width, values = _row(w)
    rise = values[:, -1] - values[:, 0]
    if max(rise[width < NARROWEST].max(initial=0.0), values[0, 0] - values[-1, -1]) > 2 * TOLERANCE:
        return np.inf
    wide = width > min(1e-6, 0.5 * width.max())  # slopes on shorter pieces are rounding
    return float(np.max(np.diff(values[wide]) / (0.25 * width[wide, None])))


def steepest_waveform(n_harmonics: int) -> tuple[float, Array, Array]:
    """Gain in v_c [-] of the steepest waveform of N harmonics that keeps contact, and its Fourier series.

    A depth that is never negative is a square, u_z/u_z0 = abs(h)² with h = sum of h_k exp(i k phase), k = 0 ... N
    (Fejér and Riesz). Its slope at phase 0 is the Hermitian form of the matrix i (k - l), of rank 2, and its mean that
    of the unit matrix. So the steepest slope is the greatest eigenvalue::

        gain = (N + 1) sqrt(N (N + 2)/12)

    over the sine of the same period, and gain/N over the sine of the greatest frequency N omega. Any shape, rigid pull;
    elastic, or a contact that has closed again when it is steepest [waveforms].

    Parameters
    ----------
    n_harmonics : int
        N, 1 or above.

    Returns
    -------
    gain : float
        v_c over that of u_z0 [1 + cos(omega t)] [-].
    cos, sin : ndarray, shape (N,)
        u_z/u_z0 = 1 + sum of cos[n-1] cos(n omega t) + sin[n-1] sin(n omega t) [-]; steepest at t = 0.

    Examples
    --------
    >>> gain, cos, sin = mdr.laws.steepest_waveform(3)
    >>> print(round(gain, 3), sin.round(3))
    4.472 [0.671 0.894 0.671]
    """
    N = _harmonics(n_harmonics)
    C = 2 * _products(_steepest(N))
    return (N + 1) * np.sqrt(N * (N + 2) / 12), C.real, -C.imag


def best_waveform(n_harmonics: int, beta: float) -> tuple[float, Array, Array]:
    """Greatest Psi [-] of N harmonics at one velocity, contact kept, and the Fourier series that has it.

    Psi is a convex function of the waveform. So its maximum is an extreme one among the depths that are never negative:
    u_z touches zero N times a period, u_z ~ product of 1 - cos(phase - phase_j). Over these N phases the maximum is
    searched, from several starts. For beta -> 0 it is the sine of N omega, where that takes nothing a pulse. A
    search may miss a better one [waveforms].

    Parameters
    ----------
    n_harmonics : int
        N, 1 or above.
    beta : float
        2 pi v_0/(mu_0 kappa omega u_z0) [-], zero or above.

    Returns
    -------
    loss : float
        Psi [-], so that a flat punch has mu/mu_0 = 1 - Psi.
    cos, sin : ndarray, shape (N,)
        u_z/u_z0 = 1 + sum of cos[n-1] cos(n omega t) + sin[n-1] sin(n omega t) [-].

    Examples
    --------
    >>> loss, cos, sin = mdr.laws.best_waveform(2, 2 * np.pi)  # where the sine takes nothing
    >>> print(round(loss, 3))
    0.248
    """
    from scipy.optimize import minimize

    N, beta = _harmonics(n_harmonics), not_negative("beta", beta, "velocity")
    phase = 2 * np.pi * np.arange(512) / 512

    def kept(zeros: Array) -> float:
        return -float(waveform_loss(np.prod(1 - np.cos(phase[:, None] - np.r_[0.0, zeros]), axis=1), beta))

    rng, equal = np.random.default_rng(1), 2 * np.pi * np.arange(1, N) / N
    steep = np.sort(np.angle(np.roots(_steepest(N)[::-1])))  # where the steepest depth is zero
    starts = [
        steep[1:] - steep[0],
        equal,
        *(share * equal for share in (0.3, 0.6, 0.9)),
        *rng.uniform(0, 2 * np.pi, (4, N - 1)),  # four random starts
    ]
    knobs = {"xatol": 1e-5, "fatol": 1e-9, "maxfev": 300 * N}
    found = [minimize(kept, start, method="Nelder-Mead", options=knobs) for start in starts if N > 1]
    zeros = np.r_[0.0, min(found, key=lambda one: float(one.fun)).x if found else equal]
    h = np.poly(np.exp(1j * zeros))[::-1]
    C = 2 * _products(h / np.linalg.norm(h))
    loss = waveform_loss(lambda x: np.real(np.exp(2j * np.pi * np.multiply.outer(x, np.arange(1, N + 1))) @ C), beta)
    return float(loss), C.real, -C.imag


def _harmonics(n: int) -> int:
    """A number of harmonics."""
    n = count("n_harmonics", n, 1)
    if n > 1000:
        raise ValueError(f"n_harmonics must be at most 1000, got {n}")
    return n


def _steepest(N: int) -> NDArray[np.complex128]:
    """The series h whose square is the steepest depth."""
    k = np.arange(N + 1) - 0.5 * N
    return np.asarray(1 / np.sqrt(2 * (N + 1)) - 1j * k / (np.sqrt(2) * np.linalg.norm(k)))


def _products(h: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Coefficients of exp(i n phase), n = 1 ... N, of abs(sum of h_k exp(i k phase))²."""
    return np.array([h[n:] @ h[:-n].conj() for n in range(1, h.size)])


# --- a waveform as a row of parabolas, and what a spring loses on it ---


class _Row(NamedTuple):
    """Pieces of a period: where they begin, how long they are, five samples of each (n, 5), scaled."""

    low: Array
    width: Array
    values: Array

    @property
    def parabola(self) -> Array:
        """Coefficients of 1, t and t² through begin, middle and end, t from 0 to 1; (3, n)."""
        begin, _, middle, _, end = self.values.T
        return np.array([begin, 4 * middle - 3 * begin - end, 2 * (begin + end) - 4 * middle])


def _row(w: Any) -> _Row:
    """The waveform in pieces, brought to mean 0 and least value -1."""
    if isinstance(w, Motion):
        cycle = w.cycle
        row = _refined(lambda x: cycle.z(2 * np.pi * x))
    elif callable(w):
        row = _refined(w)
    else:
        row = _joined(finite_array("w", w))
    a, p, q = row.parabola
    turn = np.clip(_over(-p, 2 * q), 0, 1)
    mean, least = row.width @ (a + p / 2 + q / 3), min((a + (p + q * turn) * turn).min(), row.values.min())
    if not mean - least > 1e-12 * np.abs(row.values).max():
        raise ValueError("w must oscillate: it is constant over the period")
    return row._replace(values=(row.values - mean) / (mean - least))


def _joined(samples: Array) -> _Row:
    """Straight lines between samples."""
    if samples.ndim != 1 or samples.size < 2:
        raise ValueError(f"w must be a list of at least 2 samples of one period, got shape {samples.shape}")
    rise = np.roll(samples, -1) - samples
    n = samples.size
    return _Row(np.arange(n) / n, np.full(n, 1 / n), samples[:, None] + rise[:, None] * np.linspace(0, 1, 5))


def _refined(w: Callable[[Array], ArrayLike]) -> _Row:
    """Parabolas, as short as needed; a jump becomes a straight line of the narrowest width."""
    low, width, done = np.arange(FIRST) / FIRST, np.full(FIRST, 1 / FIRST), []
    depth = 0.0
    while low.size:
        values = _asked(w, low[:, None] + width[:, None] * np.linspace(0, 1, 5))
        depth = depth or float(values.mean() - values.min())
        off = values[:, 1::2] - values[:, ::2] @ np.array([[3, -1], [6, 6], [-1, 3]]) / 8
        jump = width < NARROWEST
        good = (np.abs(off).max(axis=1) <= max(TOLERANCE * depth, 4 * EPS * np.abs(values).max())) | jump
        values[jump] = values[jump, :1] + np.outer(values[jump, -1] - values[jump, 0], np.linspace(0, 1, 5))
        done.append(np.column_stack([low, width, values])[good])
        low, width = low[~good], 0.5 * width[~good]
        low, width = np.concatenate([low, low + width]), np.tile(width, 2)
        if low.size + sum(map(len, done)) > 2**20:
            raise ValueError("w is too rough: it is no parabola on a millionth of the period; give samples of it")
    rows = np.concatenate(done)
    rows = rows[np.argsort(rows[:, 0])]
    return _Row(rows[:, 0], rows[:, 1], rows[:, 2:])


def _asked(w: Callable[[Array], ArrayLike], x: Array) -> Array:
    """Values of the callable; the end of the period is seen from before."""
    values = np.asarray(w(np.minimum(x, np.nextafter(1.0, 0.0))))
    if values.shape != x.shape:
        raise TypeError(f"w must answer in the shape of its phases, {x.shape}, got {values.shape}")
    return finite_array("w", values.astype(float) if values.dtype.kind == "b" else values).copy()


def _lost(row: _Row, beta: float) -> float:
    """Mean of A less its least value so far, A = w - beta x: each parabola in two halves on which A rises or falls."""
    a, p, q = row.parabola
    A, P = a - beta * row.low, p - beta * row.width
    turn = np.clip(_over(-P, 2 * q), 0, 1)
    begin = np.stack([A, A + (P + q * turn) * turn], axis=1).ravel()
    slope = np.stack([P, P + 2 * q * turn], axis=1).ravel()
    length = np.stack([turn, 1 - turn], axis=1).ravel()
    bend = np.repeat(q, 2)
    end = begin + (slope + bend * length) * length
    lowest = np.minimum(begin, end)
    before = np.minimum(np.minimum.accumulate(np.r_[np.inf, lowest[:-1]]), lowest.min() + beta)  # a period ago
    least = np.minimum(before, begin)
    excess = begin - least
    ends = _over(2 * excess, np.sqrt(np.maximum(slope**2 - 4 * bend * excess, 0)) - slope)  # where A has fallen to it
    c = np.where((end < begin) & (least > end), np.minimum(ends, length), length)
    return float(np.repeat(row.width, 2) @ (c * (excess + c * (slope / 2 + bend * c / 3))))


def _over(a: Array, b: Array) -> Array:
    """a/b, and 0 where b is 0."""
    return np.divide(a, b, out=np.zeros_like(a), where=b != 0)
