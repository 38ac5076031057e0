"""A constant and a sum of terms, each of one time and a share >= 0, that come closest to data.

Of all such sums the closest has few times, though any is allowed (Lindsay 1995, Mixture models: theory, geometry and
applications). On a fine grid of times non-negative least squares of the relative deviation (Lawson and Hanson 1974)
show about where they are: neighbours stand for one time between them. Then the times are moved to where least is left
(Golub and Pereyra 1973, variable projection). Times lie within the data, and beyond their ends only where the data say
so: a wider range is taken where it leaves less than chance explains.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mdr.materials.base import Arms
from mdr.tools.arrays import EPS, EXACT, SAME, Array
from mdr.tools.checks import count
from mdr.tools.warned import warn_outside

A_DECADE = 10  #: times of the grid; a sum of two neighbours is one between them to 0.1 %
CHANCE = 0.0027  #: of a difference that counts: three standard deviations
DIGITS = 0.01  #: to which tests are good at best
MOST_STEPS, SETTLED = 60, 1e-6  #: steps of a search for times; share of what is left by which one must lower it


class Data(NamedTuple):
    """What a sum is to come close to."""

    term: Callable[[Array], Any]  #: times (k,) to the terms at the places of the data, (n, k), real or complex
    wanted: Any  #: (n,)
    weight: Array  #: (n,) of each, root of the number of readings whose mean it is

    def relative(self, values: Any) -> Array:
        """Values (n, ...) over those wanted, weighted, real parts above imaginary ones."""
        over = (values.T * self.weight / np.abs(self.wanted)).T
        return np.concatenate([over.real, over.imag]) if np.iscomplexobj(over) else over


class Sum(NamedTuple):
    """A constant, the shares of times, slowest first, and what is left."""

    constant: float
    shares: Array  #: (k,), above zero
    times: Array  #: (k,) [s]
    left: Array  #: weighted relative deviations of the sum from the data, (n,), or real and imaginary ones, (2n,)
    missed: Array  #: relative deviations, (n,)

    @property
    def arms(self) -> Arms:
        """The shares with their times."""
        return tuple(zip(self.shares.tolist(), self.times.tolist(), strict=True))

    @property
    def spare(self) -> int:
        """Numbers of the data beyond those that were fitted."""
        return self.left.size - 1 - 2 * self.times.size

    @property
    def rest(self) -> float:
        """Sum of the squares of what is left."""
        return float(self.left @ self.left)


def nearest(data: Data, ends: tuple[float, float], beyond: tuple[float, ...], n: int | None) -> Sum:
    """The closest sum: of n times, even in log time between the ends, or None, of the times that come closest.

    ends: of the times in the data, first and last. beyond: factors by which a wider range exceeds them.
    """
    if n is not None:
        return of_times(data, _spread(*ends[::-1], count("n_arms", n, 1)))
    best = _of_any_time(data, *ends)
    for factor in beyond:
        wider = _of_any_time(data, ends[0] / factor, ends[1] * factor)
        # a body that flows in the end, or is rigid at first, is not made of what is outside the data
        if not _is_closer(wider, best) or wider.constant == 0 < best.constant:
            break
        best = wider
    return best


def of_times(data: Data, times: Array) -> Sum:
    """The closest sum of these times."""
    from scipy.optimize import nnls

    terms = np.column_stack([np.ones(data.wanted.size), data.term(times)])
    rows, target = data.relative(terms), data.relative(data.wanted)
    norms = np.maximum(np.linalg.norm(rows, axis=0), np.finfo(float).tiny)
    found = nnls(rows / norms, target, maxiter=100 * rows.shape[1])[0]
    found = np.where(found < SAME * found.max(), 0.0, found) / norms
    on = found[1:] > 0
    missed = np.abs(terms @ found - data.wanted) / np.abs(data.wanted)
    return Sum(float(found[0]), found[1:][on], times[on], rows @ found - target, missed)


def warn_of_few(few: Sum, free: Sum) -> None:
    """Warn where more arms come closer to the data, by more than chance and by what data are good for."""
    on_average, by_free = (float(np.sqrt(np.mean(one.missed**2))) for one in (few, free))
    if on_average > DIGITS and _is_closer(free, few):
        warn_outside(
            f"so many arms miss the data by {on_average:.1%} on average, {free.times.size} of free times by "
            f"{by_free:.1%}: leave n_arms out"
        )


def _is_closer(one: Sum, other: Sum) -> bool:
    """Whether one sum leaves less than the other, by more than rounding and chance explain: Fisher's F of one term."""
    from scipy.stats import f

    if one.spare <= 0 or other.rest <= SAME**2 * other.left.size:
        return False
    return other.rest - one.rest > 2 * float(f.isf(CHANCE, 2, one.spare)) * one.rest / one.spare


def _spread(first: float, last: float, n: int) -> Array:
    """So many times, even in log time; a single one is in the middle."""
    return np.geomspace(first, last, n) if n > 1 else np.array([np.sqrt(first * last)])


def _of_any_time(data: Data, first: float, last: float) -> Sum:
    """The closest sum of times between two, of no more than the data can tell."""
    grid = _spread(last, first, 2 + int(A_DECADE * np.log10(last / first)))
    coarse = of_times(data, grid)
    at = np.flatnonzero(np.isin(grid, coarse.times))
    if not at.size or first == last:
        return coarse
    gaps = np.diff(at)  # neighbours are one, and those that are nearest where they are too many
    most = max(1, (coarse.left.size - 1) // 2)
    cuts = np.flatnonzero((gaps > 1) & (np.argsort(np.argsort(-gaps, kind="stable")) < most - 1))
    parts = np.split(np.arange(at.size), cuts + 1)
    best = _moved(data, [np.average(np.log(grid[at[part]]), weights=coarse.shares[part]) for part in parts], grid)
    while best.times.size < most:  # neighbours may have been two
        more = of_times(data, np.sort([*grid, *best.times])[::-1])
        again = _moved(data, np.log(more.times), grid) if 0 < more.times.size <= most else best
        if not _is_closer(again, best):
            break
        best = again
    return best


def _moved(data: Data, start: ArrayLike, grid: Array) -> Sum:
    """The closest sum of as many times, which begin at these in log time and stay within the grid."""
    from scipy.optimize import least_squares

    high, low = np.log(grid[[0, -1]])
    margin = SAME * (high - low)
    found = least_squares(
        lambda x: of_times(data, np.exp(x)).left,
        np.clip(start, low + margin, high - margin),  # inside the range, where a search may begin
        bounds=(low, high), xtol=EXACT, ftol=SETTLED, gtol=EPS, max_nfev=MOST_STEPS,
    )  # fmt: skip
    x = np.sort(found.x)[::-1]
    return of_times(data, np.exp(x[np.diff(x, prepend=np.inf) < -margin]))  # times that met are one
