"""Piecewise polynomials through measured points, and the one-dimensional image of such a shape.

f(r) is a polynomial of degree 5 (3 where points are few) on each piece [r_i, r_i+1]. On the first piece its image is
one too, c r^j → κ_j c x^j. Further out

    g(x) = x ∫₀^{π/2} f'(x sin t) dt,   dg/dx = ∫₀^{π/2} (r f')'(x sin t) dt + Σ Δf'(b) b / √(x² − b²),

the sum over the kinks b passed, are summed with Gauss's rule, exact to rounding, at a few nodes of each piece when it
is first asked for. Pieces far from x go into the sum together (`arc_sums`). Between the nodes a polynomial in
√(x − r_i) serves, as g is not smooth at r_i.
"""

import math
from functools import cached_property
from typing import Any

import numpy as np
from numpy.polynomial.polynomial import polyval

from mdr.indenters.mapping.arc_sums import ArcSums, Numbers
from mdr.indenters.mapping.quadrature import N_FIT, chebyshev_fit
from mdr.indenters.mapping.shape_check import Left
from mdr.indenters.mapping.stable_functions import GAUSS, leg
from mdr.tools.arrays import EXACT, Array
from mdr.tools.progress import progress

DEGREE = 5  #: of a spline, four times continuously differentiable
AT_ONCE = 2048  #: radii whose sums are taken at once
RULES = tuple(  #: for arcs between these widths [rad]
    (low, high, *np.polynomial.legendre.leggauss(n))
    for low, high, n in ((0.0, 0.02, 7), (0.02, 0.5, 14), (0.5, 2.0, 24))
)


def spline(x: Array, y: Array, noise: float) -> Any:
    """A spline through the points, ascending x, of odd degree; for `noise` above 0, their standard deviation, one that
    keeps from them by it on the average.
    """
    from scipy.interpolate import BSpline, make_interp_spline, splrep

    k = min(DEGREE, x.size - 1 - x.size % 2)
    if not noise or x.size <= k + 1:
        return make_interp_spline(x, y, k=k)
    (t, c, k), *_ = splrep(x, y / noise, k=k, s=x.size, full_output=1)  # whoever asks looks at its shape
    return BSpline(t, c * noise, k)


def fit(x: Array, y: Array, noise: float, even: bool) -> tuple[Array, Array, Left]:
    """Ends (n + 1,) of the pieces of a spline through the points, their polynomials (n, degree + 1), and what is left.

    Piece i is Σ_j c_ij u^j with u = (x − x_i)/(x_i+1 − x_i); ``even`` fits the points with their mirror images at −x.
    """
    from scipy.interpolate import PPoly

    if even:
        x, y = np.concatenate([-x[:0:-1], x]), np.concatenate([y[:0:-1], y])
    unit = max(abs(x[0]), abs(x[-1]))
    curve = spline(x / unit, y, noise)
    norm, spare = float(np.linalg.norm(curve(x / unit) - y)), x.size - (curve.t.size - curve.k - 1)
    missed = Left(norm / np.sqrt(2), (x.size + 1) // 2, spare / 2) if even else Left(norm, x.size, spare)
    whole = PPoly.from_spline(curve)
    keep = np.flatnonzero(np.diff(whole.x) > 0)
    ends = np.append(whole.x[keep], whole.x[keep[-1] + 1])
    pieces = whole.c[::-1, keep].T
    if not even:
        return unit * ends, _moved(pieces, np.zeros(keep.size), np.diff(ends)), missed
    both = np.unique(np.append(0, np.abs(ends)))
    both = np.append(both[:-1][np.diff(both) > EXACT], 1.0)  # a mirror image may be a rounding away
    middle, width = (both[1:] + both[:-1]) / 2, np.diff(both)
    right = np.searchsorted(ends, middle) - 1
    left = np.searchsorted(ends, -middle) - 1
    half = _moved(pieces[right], both[:-1] - ends[right], width) + _moved(pieces[left], -both[:-1] - ends[left], -width)
    half[0, 1 : pieces.shape[1] - 1 : 2] = 0  # even to the last digit
    return unit * both, half / 2, missed


def _moved(c: Array, start: Array, width: Array) -> Array:
    """Coefficients in u of Σ_j c_j (start + width u)^j, row by row."""
    moved = np.zeros_like(c)
    for j in range(c.shape[1]):
        for i in range(j + 1):
            moved[:, i] += math.comb(j, i) * c[:, j] * start ** (j - i) * width**i
    return moved


class SplineImage:
    """The shape of these pieces from r = 0 on, f(0) = 0, and its image; arrays (n,) of radii >= 0."""

    def __init__(self, ends: Array, pieces: Array, kinks: tuple[float, ...]) -> None:
        self.ends, self.pieces = ends, pieces
        self.width = np.diff(ends)
        powers = np.arange(pieces.shape[1])
        self.slopes = (pieces * powers)[:, 1:] / self.width[:, None]  # f'
        curved = np.zeros_like(self.slopes)  # r f'' = (r_i + h u)/h d/du f'
        curved[:, :-1] = (self.slopes * powers[:-1])[:, 1:] * (ends[:-1] / self.width)[:, None]
        self.radial = self.slopes * powers[1:] + curved  # (r f')'
        kappa = np.array([math.sqrt(math.pi) * math.gamma(j / 2 + 1) / math.gamma((j + 1) / 2) for j in powers])
        self.tip = pieces[0] * kappa  # of g, in u
        self.tip_slopes = (self.tip * powers)[1:] / self.width[0]
        self.made = np.zeros(self.width.size, dtype=bool)
        self.chebyshev = np.zeros((2, self.width.size, N_FIT))  # of g/x and of the smooth part of dg/dx
        at = np.searchsorted(ends, kinks)
        self.kinks = ends[at]
        self.jumps = self.slopes[at, 0] - self.slopes[at - 1].sum(axis=1)

    def height(self, r: Array) -> Array:
        """f(r)."""
        piece = self._piece(r)
        return _values(self.pieces, piece, (r - self.ends[piece]) / self.width[piece])

    def image(self, x: Array) -> Array:
        """g(x)."""
        piece = self._piece(x)
        tip = polyval(self._in_first(x, piece), self.tip)
        return np.asarray(np.where(piece == 0, tip, x * self._outer(0, x, piece)))

    def contacts(self, x: Array) -> tuple[Array, Array]:
        """g and F_N/E* at contact radii x > 0, by sums at each of them."""
        mean, _, area = x * self._arcs(x)
        return mean, 2 * (mean * x - area)

    def area(self, a: Array) -> Array:
        """∫₀^a g dx."""
        piece = self._piece(a)
        low = self.ends[piece]
        tip = self.tip / (np.arange(self.tip.size) + 1)
        share = self._in_first(a, piece)
        first = self.width[0] * share * polyval(share, tip)
        nodes, weights = GAUSS
        t = (nodes + 1) / 2 * np.sqrt(a - low)[:, None]
        g = self.image((low[:, None] + t * t).ravel()).reshape(t.shape)
        rest = np.sqrt(a - low) * ((g * t) @ weights)
        return np.asarray(np.where(piece == 0, first, self._areas[piece] + rest))

    def slope(self, s: Array, low: float) -> Array:
        """dg/ds at x² = low² + s². A jump of f' at b adds b/√(x² − b²) to dg/dx, which s takes the infinity from."""
        x = np.minimum(np.hypot(s, low), self.ends[-1])
        piece = self._piece(x)
        share = s / x if low > 0 else np.ones_like(s)
        tip = polyval(self._in_first(x, piece), self.tip_slopes)
        rise = share * np.where(piece == 0, tip, self._outer(1, x, piece))
        for b, jump in zip(self.kinks, self.jumps, strict=True):
            if b <= low:
                rise += jump * b * (1 / x if b == low else share / leg(x, b))
        return rise

    @cached_property
    def _areas(self) -> Array:
        """∫₀^x g dx at all ends of pieces."""
        return np.concatenate([[0.0], self.ends[1:] * self._arcs(self.ends[1:])[2]])

    def _piece(self, x: Array) -> Numbers:
        """Which piece each radius lies in."""
        return np.clip(np.searchsorted(self.ends, x, side="right") - 1, 0, self.width.size - 1)

    def _in_first(self, x: Array, piece: Numbers) -> Array:
        """u of the x in the first piece, 0 for others."""
        return np.where(piece == 0, x / self.width[0], 0.0)

    def _outer(self, which: int, x: Array, piece: Numbers) -> Array:
        """g/x (0) or the smooth part of dg/dx (1) in pieces that are not the first."""
        asked = np.unique(piece[piece > 0])
        if not self.made[asked].all():
            self._make(asked[~self.made[asked]])
        t = 2 * np.sqrt(np.clip((x - self.ends[piece]) / self.width[piece], 0, 1)) - 1
        c = self.chebyshev[which]
        one, two = np.zeros_like(t), np.zeros_like(t)
        for j in range(N_FIT - 1, 0, -1):  # Clenshaw
            one, two = c[piece, j] + 2 * t * one - two, one
        return np.asarray(c[piece, 0] + t * one - two)

    def _make(self, pieces: Numbers) -> None:
        """The polynomials of some pieces."""
        nodes, to_coefficients = chebyshev_fit(N_FIT)
        x = self.ends[pieces, None] + self.width[pieces, None] * ((nodes + 1) / 2) ** 2
        values = self._arcs(x.ravel())[:2].reshape(2, *x.shape)
        self.chebyshev[:, pieces] = values @ to_coefficients.T
        self.made[pieces] = True

    @cached_property
    def _sums(self) -> ArcSums:
        r_f = np.pad(self.pieces * self.ends[:-1, None], ((0, 0), (0, 1)))
        r_f[:, 1:] += self.pieces * self.width[:, None]
        slopes, radial = (np.pad(one, ((0, 0), (0, 2))) for one in (self.slopes, self.radial))
        return ArcSums(self.ends, np.stack([slopes, radial, r_f]))

    def _arcs(self, x: Array) -> Array:
        """∫₀^{π/2} of f', of (r f')' and of f sin t along r = x sin t, (3, n_x)."""
        total, starts = np.empty((3, x.size)), range(0, x.size, AT_ONCE)
        _ = self._sums  # made before the time of a part is taken
        for i in progress(starts, "image of the profile", "parts") if len(starts) > 1 else starts:
            total[:, i : i + AT_ONCE] = self._some_arcs(x[i : i + AT_ONCE])
        return total

    def _some_arcs(self, x: Array) -> Array:
        total, row, piece = self._sums.far(x)
        total[2] /= x
        unit, far = np.ones(1), x[row]
        begin, end = (np.arctan2(r, leg(far, r)) for r in (self.ends[piece], np.minimum(self.ends[piece + 1], far)))
        width = end - begin
        for least, most, nodes, weights in RULES:
            on = (least < width) & (width <= most)
            i, half = piece[on, None], width[on, None] / 2
            sine = np.sin(begin[on, None] + half * (nodes + 1))
            u = (far[on, None] * sine - self.ends[i]) / self.width[i]
            for k, (c, factor) in enumerate(((self.slopes, unit), (self.radial, unit), (self.pieces, sine))):
                total[k] += np.bincount(row[on], (half * _values(c, i, u) * factor) @ weights, x.size)
        return total


def _values(c: Array, piece: Numbers, u: Array) -> Array:
    """Σ_j c_j u^j with the coefficients of the pieces."""
    return np.asarray(polyval(u, np.moveaxis(c[piece], -1, 0), tensor=False))
