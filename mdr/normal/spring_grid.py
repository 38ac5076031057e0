"""Where the springs stand, how deep their feet lie, how wide they are.

A sum over the springs is an integral over x. Its integrand is smooth but at places that are known from the normal
motion, the edge of the contact at its greatest depth and the place up to which springs never lose contact, at kinks of
the shape, and where the order of modes changes, which is not known beforehand: there its second derivative jumps. One
of these a run can tell: the gap from which on springs slip back (`cut`), where the first derivative jumps. Springs that
never lose contact do the same up to there but for their gap (`alike`).
The row is cut at the known places, and each stretch between two cuts, however thin, has springs of its own: the nodes
of Fejer's first rule, which are as dense at both ends as those of Gauss and do as well (Trefethen 2008), their weights
being known. What is left is of third order, of the jumps between the cuts. The mean gap of a stretch is exact. So are
k_zc and F_N at the depth of each cut, and all sums over springs that move alike, being linear in the gap.

Symbols: x position [m], gap = g(x) - u_z0 depth of a spring's foot relative to a depth u_z0, such as the mean one [m].
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.case.depth_cycle import Cycle
from mdr.indenters.base import Indenter
from mdr.tools.arrays import EPS, SAME, Array
from mdr.tools.memoise import remembered


class Depths(NamedTuple):
    """Depths [m] that a motion reaches."""

    u_z0: float  #: from which gaps count
    unit: float  #: beside which a difference of gaps is something
    kept: float  #: gap below which springs never lose contact
    greatest: float  #: gap at the greatest depth
    alike: float  #: gap below which they do the same besides, but for their gap; no more than `kept`
    cut: float = np.inf  #: gap from which on springs slip back, where that is known
    by_gap: bool = True  #: whether springs of one gap do the same wherever they stand

    @classmethod
    def of(
        cls, cycle: Cycle, kept_gap: float, cut: float = np.inf, by_gap: bool = True, ordered: bool = True
    ) -> Depths:
        """Of a periodic motion; kept_gap and cut in units of its amplitude. ordered: whether springs below both do the
        same but for their gap.
        """
        alike = min(kept_gap, cut) if by_gap and ordered else -np.inf
        kept, greatest, alike, cut = (cycle.unit * gap for gap in (kept_gap, cycle.greatest, alike, cut))
        return cls(cycle.u_z0, cycle.unit, kept, greatest, alike, cut, by_gap)


@remembered(maxsize=16)
def nodes(shape: Indenter, depths: Depths, n_springs: int) -> tuple[Array, Array, Array, int]:
    """x, gap, width (n_springs,) from the centre outwards, and how many of the first never lose contact."""
    if shape.least_depth > 0:
        return _complete(shape, depths.u_z0, n_springs)
    of = _stretches(shape, depths)
    counts = _share_out(of, n_springs, depths)
    share, part, which = _fejer_row(counts)
    span, height, u_z0 = of.x_hi - of.x_lo, of.gap_hi - of.gap_lo, depths.u_z0
    x = of.x_lo[which] + span[which] * share
    # how far g has risen through the stretch, 0 to 1; linear where the stretch is too thin to resolve in x
    thin = (height <= 0) | (span < SAME * of.x_hi) | (height < SAME * (u_z0 + of.gap_hi))
    g_lo, g_hi = u_z0 + of.gap_lo, u_z0 + of.gap_hi
    rises = np.where(thin, 1.0, g_hi - g_lo)
    rise = np.where(thin[which], share, np.clip((shape.profile_1d(x) - g_lo[which]) / rises[which], 0, 1))
    gap = of.gap_lo[which] + height[which] * rise
    # what the quadrature misses of the mean of g over a stretch, from the area below g; rounding is not corrected
    missing = of.area / span - u_z0 - np.bincount(which, part * gap, span.size)
    noise = 64 * EPS * of.x_hi * np.abs(u_z0 + of.gap_hi) / span
    gap += np.where(np.abs(missing) > noise, missing, 0.0)[which]
    width = 2 * span[which] * part
    for one in (x, gap, width):  # which are kept
        one.setflags(write=False)
    return x, gap, width, int(np.sum(counts, where=of.permanent))


def _complete(shape: Indenter, u_z0: float, n: int) -> tuple[Array, Array, Array, int]:
    """Equal cells under a hollow face. Its springs never lose contact where the method holds."""
    edges = shape.max_radius * (np.arange(n + 1) / n)
    part = np.diff(edges)
    return edges[:-1] + part / 2, np.diff(shape.profile_area(edges)) / part - u_z0, 2 * part, n


class _Stretches(NamedTuple):
    """The stretches of the row, arrays (n,): from x_lo to x_hi, where g rises from u_z0 + gap_lo to u_z0 + gap_hi."""

    x_lo: Array
    x_hi: Array
    gap_lo: Array
    gap_hi: Array
    area: Array  #: below g, from x_lo to x_hi [m²]
    permanent: NDArray[np.bool_]  #: in contact through the whole period
    alike: NDArray[np.bool_]  #: their springs do the same but for their gap


@remembered(maxsize=16)
def _stretches(shape: Indenter, depths: Depths) -> _Stretches:
    """The row, cut where springs begin to differ and to lose contact, where contact ends, and at kinks of the shape."""
    u_z0, kept, greatest = depths.u_z0, depths.kept, depths.greatest
    gaps = [gap for gap in sorted({min(depths.cut, greatest), kept, greatest}) if u_z0 + gap > 0]
    radii = shape.contact_radius(u_z0 + np.array(gaps))
    marks = [(0.0, -u_z0), *zip(radii.tolist(), gaps, strict=True)]
    marks += [(x, float(shape.profile_1d(x)) - u_z0) for x in shape.kinks if x < radii[-1]]
    x, gap = np.array(sorted(marks)).T
    area, there = np.diff(shape.profile_area(x)), np.diff(x) > 0
    cut = (one[there] for one in (x[:-1], x[1:], gap[:-1], gap[1:], area, gap[1:] <= kept, gap[1:] <= depths.alike))
    return _Stretches(*cut)


def _share_out(of: _Stretches, n_springs: int, depths: Depths) -> tuple[int, ...]:
    """Number of springs of each stretch: the same, but for those where all move alike."""
    least = 2 * of.x_lo.size
    if n_springs < least:
        raise ValueError(f"n_springs must be at least {least} for this shape with its kinks, got {n_springs}")
    level = depths.by_gap & (of.gap_hi - of.gap_lo <= SAME * depths.unit)
    # a stretch whose springs move alike gets an eighth of the springs of another
    shares = np.cumsum(np.where(level & ~level.all(), 0.0, np.where(of.alike, 1 / 8, 1.0)))
    more = np.rint((n_springs - least) * shares / shares[-1]).astype(int).tolist()
    return tuple(2 + after - before for before, after in zip([0, *more], more, strict=False))


@lru_cache(maxsize=256)
def _fejer_row(counts: tuple[int, ...]) -> tuple[Array, Array, NDArray[np.intp]]:
    """Nodes and weights on 0 to 1 of stretches of so many springs, one after the other, and whose they are."""
    share, part = (np.concatenate(one) for one in zip(*map(_fejer, counts), strict=True))
    return share, part, np.repeat(np.arange(len(counts)), counts)


def _fejer(n: int) -> tuple[Array, Array]:
    """Nodes and weights on 0 to 1, (n,): (1 - cos theta)/2 at midpoints of theta; a sum of all Chebyshev moments."""
    from scipy.fft import dct

    moments = np.zeros(n)
    moments[::2] = 1 / (1 - np.arange(0.0, n, 2) ** 2)
    return np.sin(np.pi / 2 * (np.arange(n) + 0.5) / n) ** 2, dct(moments, type=3) / n
