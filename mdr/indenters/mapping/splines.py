"""Piecewise polynomials through measured points, and the one-dimensional image of such a shape.

f(r) is a polynomial of degree 5 (3 where points are few) on each piece [r_i, r_i+1]. On the first piece its image is
one too, c r^j → κ_j c x^j. Further out

    g(x) = x ∫₀^{π/2} f'(x sin t) dt,   dg/dx = ∫₀^{π/2} (r f')'(x sin t) dt + Σ Δf'(b) b / √(x² − b²),

the sum over the kinks b passed, are summed piece by piece with Gauss's rule, exact to rounding, at a few nodes of each
piece when it is first asked for. Between the nodes a polynomial in √(x − r_i) serves, as g is not smooth at r_i.
"""

import math
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from mdr.indenters.mapping.quadrature import chebyshev_fit, double_exponential
from mdr.indenters.mapping.stable_functions import arcosh, leg
from mdr.tools.arrays import EPS, Array

Pieces = NDArray[np.intp]  #: which piece each radius lies in

DEGREE = 5
N_NODES = 16  #: of the polynomials in √(x − r_i)
MANY = np.polynomial.legendre.leggauss(14)
RULES = tuple(  #: for arcs between these widths [rad]
    (low, high, *np.polynomial.legendre.leggauss(n))
    for low, high, n in ((0.0, 0.02, 3), (0.02, 0.5, 6), (0.5, 2.0, 14))
)


def fit(x: Array, y: Array, noise: Array | float, even: bool) -> tuple[Array, Array]:
    """Ends (n + 1,) of the pieces of a spline through the points, ascending x, and their polynomials (n, degree + 1).

    Piece i is Σ_j c_ij u^j with u = (x − x_i)/(x_i+1 − x_i). ``noise`` is the standard deviation of y, by which the
    spline keeps from the points on the average, 0 interpolates; ``even`` fits them with their mirror images at −x.
    """
    from scipy.interpolate import PPoly, make_interp_spline, splrep

    noise = np.broadcast_to(noise, x.shape)
    if even:
        x, y, noise = np.concatenate([-x[:0:-1], x]), *(np.concatenate([v[:0:-1], v]) for v in (y, noise))
    unit = max(abs(x[0]), abs(x[-1]))
    k = min(DEGREE, x.size - 1 - x.size % 2)  # odd
    if noise.all() and x.size > k + 1:
        spline = PPoly.from_spline(splrep(x / unit, y / noise.max(), noise.max() / noise, k=k, s=x.size))
        spline.c *= noise.max()
    else:
        spline = PPoly.from_spline(make_interp_spline(x / unit, y, k=k))
    keep = np.flatnonzero(np.diff(spline.x) > 0)
    ends = np.append(spline.x[keep], spline.x[keep[-1] + 1])
    pieces = spline.c[::-1, keep].T
    if not even:
        return unit * ends, _moved(pieces, np.zeros(keep.size), np.diff(ends))
    both = np.unique(np.append(0, np.abs(ends)))
    both = np.append(both[:-1][np.diff(both) > 1e-12], 1.0)  # a mirror image may be a rounding away
    middle, width = (both[1:] + both[:-1]) / 2, np.diff(both)
    right = np.searchsorted(ends, middle) - 1
    left = np.searchsorted(ends, -middle) - 1
    half = _moved(pieces[right], both[:-1] - ends[right], width) + _moved(pieces[left], -both[:-1] - ends[left], -width)
    half[0, 1:k:2] = 0  # even to the last digit
    return unit * both, half / 2


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
        self.made = np.zeros(self.width.size, dtype=bool)
        self.chebyshev = np.zeros((2, self.width.size, N_NODES))  # of g/x and of the smooth part of dg/dx
        at = np.searchsorted(ends, kinks)
        self.kinks = ends[at]
        self.jumps = self.slopes[at, 0] - self.slopes[at - 1].sum(axis=1)

    def height(self, r: Array) -> Array:
        """f(r)."""
        piece = self._piece(r)
        return _horner(self.pieces, piece, (r - self.ends[piece]) / self.width[piece])

    def image(self, x: Array) -> Array:
        """g(x)."""
        piece = self._piece(x)
        first = piece == 0
        tip = _horner(self.tip[None], np.zeros_like(piece), np.where(first, x / self.width[0], 0))
        return np.asarray(np.where(first, tip, x * self._outer(0, x, piece)))

    def image_at_ends(self) -> Array:
        """g at all ends of pieces."""
        return np.asarray(self.ends * np.concatenate([[0.0], self._arcs(self.ends[1:])[0]]))

    def area(self, a: Array) -> Array:
        """∫₀^a g dx."""
        piece = self._piece(a)
        low = self.ends[piece]
        tip = self.tip / (np.arange(self.tip.size) + 1)
        share = np.where(piece == 0, a / self.width[0], 0)
        first = self.width[0] * share * _horner(tip[None], np.zeros_like(piece), share)
        nodes, weights = MANY
        t = (nodes + 1) / 2 * np.sqrt(a - low)[:, None]
        g = self.image((low[:, None] + t * t).ravel()).reshape(t.shape)
        rest = np.sqrt(a - low) * ((g * t) @ weights)
        return np.asarray(np.where(piece == 0, first, self._areas[piece] + rest))

    def pressure(self, r: Array, a: Array) -> Array:
        """p(r)/E* for 0 <= r < a."""
        r = np.maximum(r, EPS * a)
        p = self._first_pressure(r, np.minimum(a, self.ends[1]))
        for b, jump in zip(self.kinks, self.jumps, strict=True):
            on = a > b
            p[on] += jump * b * _kernel(r[on], np.full_like(r[on], b), a[on])
        rule = double_exponential(0.2)
        for low, high in pairwise(self.ends[1:]):
            on = (r < high) & (a > low)
            if on.any():
                inner = arcosh(np.maximum(low, r[on]), r[on])
                way = arcosh(np.minimum(high, a[on]), r[on]) - inner
                x = r[on, None] * np.cosh(inner[:, None] + way[:, None] * rule.from_low)
                x = np.clip(x, low, np.minimum(high, a[on])[:, None])
                piece = np.full(x.size, np.searchsorted(self.ends, low))
                rise = self._outer(1, x.ravel(), piece).reshape(x.shape)
                p[on] += way * (rise @ rule.weight)
        return np.asarray(p / np.pi)

    def _first_pressure(self, r: Array, stop: Array) -> Array:
        """∫_r^stop g'(x)/√(x² − r²) dx in the first piece: I_k = (x^(k−1) s + (k − 1) r² I_(k−2))/k for x^k."""
        p, h, s = np.zeros_like(r), self.width[0], leg(stop, r)
        integrals = [arcosh(stop, r), s / h]
        for k in range(2, self.tip.size - 1):
            integrals.append(((stop / h) ** (k - 1) * (s / h) + (k - 1) * (r / h) ** 2 * integrals[k - 2]) / k)
        for k, integral in enumerate(integrals[: self.tip.size - 1]):
            p += (k + 1) * self.tip[k + 1] / h * integral
        return np.where(r < stop, p, 0.0)

    @cached_property
    def _areas(self) -> Array:
        """∫₀^x g dx at all ends of pieces."""
        return np.concatenate([[0.0], self.ends[1:] * self._arcs(self.ends[1:])[2]])

    def _piece(self, x: Array) -> Pieces:
        return np.clip(np.searchsorted(self.ends, x, side="right") - 1, 0, self.width.size - 1)

    def _outer(self, which: int, x: Array, piece: Pieces) -> Array:
        """g/x (0) or the smooth part of dg/dx (1) in pieces that are not the first."""
        for i in np.unique(piece[piece > 0]):
            if not self.made[i]:
                self._make(int(i))
        t = 2 * np.sqrt(np.clip((x - self.ends[piece]) / self.width[piece], 0, 1)) - 1
        c = self.chebyshev[which]
        one, two = np.zeros_like(t), np.zeros_like(t)
        for j in range(N_NODES - 1, 0, -1):  # Clenshaw
            one, two = c[piece, j] + 2 * t * one - two, one
        return np.asarray(c[piece, 0] + t * one - two)

    def _make(self, i: int) -> None:
        nodes, to_coefficients = chebyshev_fit(N_NODES)
        values = self._arcs(self.ends[i] + self.width[i] * ((nodes + 1) / 2) ** 2)
        self.chebyshev[:, i] = values[:2] @ to_coefficients.T
        self.made[i] = True

    def _arcs(self, x: Array) -> Array:
        """∫₀^{π/2} of f', of (r f')' and of f sin t along r = x sin t, (3, n_x)."""
        total = np.zeros((3, x.size))
        for i in range(0, x.size, 64):
            total[:, i : i + 64] = self._some_arcs(x[i : i + 64])
        return total

    def _some_arcs(self, x: Array) -> Array:
        total = np.zeros((3, x.size))
        unit = np.ones(1)
        ends = np.minimum(self.ends[: np.searchsorted(self.ends, x.max()) + 1], x[:, None])
        angles = np.arctan2(ends, leg(x[:, None], ends))
        width = np.diff(angles, axis=1)
        for least, most, nodes, weights in RULES:
            row, piece = np.nonzero((least < width) & (width <= most))
            half = width[row, piece][:, None] / 2
            sine = np.sin(angles[row, piece][:, None] + half * (nodes + 1))
            u = (x[row, None] * sine - self.ends[piece, None]) / self.width[piece, None]
            for k, (c, factor) in enumerate(((self.slopes, unit), (self.radial, unit), (self.pieces, sine))):
                sums = (half * _horner(c, piece[:, None], u) * factor) @ weights
                total[k] += np.bincount(row, sums, x.size)
        return total


def _horner(c: Array, piece: Pieces, u: Array) -> Array:
    """Σ_j c_j u^j with the coefficients of the pieces."""
    answer = np.zeros_like(u)
    for j in range(c.shape[1] - 1, -1, -1):
        answer = answer * u + c[piece, j]
    return answer


def _kernel(r: Array, s: Array, a: Array) -> Array:
    """K(r, s) = ∫_M^a dx / √((x² − s²)(x² − r²)) with M = max(r, s): what a jump of f' at s adds to p(r).

    F(ψ, k) / M, the elliptic integral of the first kind, with k = min(r, s) / M, tan²ψ = (a² − M²) / (M² − min²).
    Infinite only at r = s; there it answers as if they differed by one rounding.
    """
    from scipy.special import ellipkinc

    large = np.maximum(np.maximum(r, s), np.finfo(float).tiny)
    small = np.minimum(np.minimum(r, s), large * (1 - EPS))
    k = small / large
    rise = np.sqrt(np.maximum(a / large - 1, 0) * (a / large + 1))
    answer: Array = ellipkinc(np.arctan2(rise, np.sqrt((1 - k) * (1 + k))), k * k) / large
    return answer
