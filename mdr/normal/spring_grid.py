"""Where the springs stand, how deep their feet lie, how wide they are.

A sum over the springs is an integral over x. Its integrand is smooth but at places that are known from the normal
motion, the edge of the contact at its greatest depth and the place up to which springs never lose contact, at kinks of
the shape, and where the order of modes changes, which is not known beforehand: there its second derivative jumps. One
of these a run can tell: under a body that swings back, those springs slip back that are pressed least of all that never
lose contact; the others do the same but for their gap (`alike`).
The row is cut at the known places, and each stretch between two cuts, however thin, has springs of its own: the nodes
of Fejer's first rule, which are as dense at both ends as those of Gauss and do as well (Trefethen 2008), their weights
being known. What is left is of third order, of the jumps between the cuts. The mean gap of a stretch is exact. So are
k_zc and F_N at the depth of each cut, and all sums over springs that move alike, being linear in the gap.

Symbols: x position [m], gap = g(x) - u_z0 depth of a spring's foot relative to a depth u_z0, such as the mean one [m].
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

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

    @classmethod
    def of(cls, cycle: Cycle, kept_gap: float, alike: float = np.inf) -> Depths:
        """Of a periodic motion; kept_gap and alike in units of its amplitude."""
        kept, greatest, alike = (cycle.unit * gap for gap in (kept_gap, cycle.greatest, min(kept_gap, alike)))
        return cls(cycle.u_z0, cycle.unit, kept, greatest, alike)


@remembered(maxsize=16)
def nodes(shape: Indenter, depths: Depths, n_springs: int) -> tuple[Array, Array, Array, int]:
    """x, gap, width (n_springs,) from the centre outwards, and how many of the first never lose contact."""
    if shape.least_depth > 0:
        return _complete(shape, depths.u_z0, n_springs)
    stretches = _stretches(shape, depths)
    counts = _share_out(stretches, n_springs, depths.unit)
    parts = [_springs_of(shape, depths.u_z0, stretch, n) for stretch, n in zip(stretches, counts, strict=True)]
    x, gap, width = (np.concatenate(part) for part in zip(*parts, strict=True))
    return x, gap, width, sum(n for stretch, n in zip(stretches, counts, strict=True) if stretch.permanent)


def _complete(shape: Indenter, u_z0: float, n: int) -> tuple[Array, Array, Array, int]:
    """Equal cells under a hollow face. Its springs never lose contact where the method holds."""
    edges = shape.max_radius * (np.arange(n + 1) / n)
    part = np.diff(edges)
    return edges[:-1] + part / 2, np.diff(shape.profile_area(edges)) / part - u_z0, 2 * part, n


@dataclass(frozen=True)
class _Stretch:
    """A stretch of the row: from x_lo to x_hi, where g rises from u_z0 + gap_lo to u_z0 + gap_hi."""

    x_lo: float
    x_hi: float
    gap_lo: float
    gap_hi: float
    area: float  # below g, from x_lo to x_hi [m²]
    permanent: bool  # in contact through the whole period
    alike: bool  # its springs do the same but for their gap


@remembered(maxsize=16)
def _stretches(shape: Indenter, depths: Depths) -> list[_Stretch]:
    """The row, cut where springs begin to differ and to lose contact, where contact ends, and at kinks of the shape."""
    u_z0, kept, alike = depths.u_z0, depths.kept, depths.alike
    gaps = [gap for gap in (*([alike] if alike < kept else []), kept, depths.greatest) if u_z0 + gap > 0]
    radii = shape.contact_radius(u_z0 + np.array(gaps))
    marks = [(0.0, -u_z0), *zip(radii.tolist(), gaps, strict=True)]
    marks += [(x, float(shape.profile_1d(x)) - u_z0) for x in shape.kinks if x < radii[-1]]
    marks.sort()
    area = np.diff(shape.profile_area([x for x, _ in marks]))
    return [
        _Stretch(x_lo, x_hi, gap_lo, gap_hi, below, permanent=gap_hi <= kept, alike=gap_hi <= alike)
        for (x_lo, gap_lo), (x_hi, gap_hi), below in zip(marks, marks[1:], area.tolist(), strict=False)
        if x_hi > x_lo
    ]


def _share_out(stretches: list[_Stretch], n_springs: int, unit: float) -> list[int]:
    """Number of springs of each stretch: the same, but for those where all move alike."""
    least = 2 * len(stretches)
    if n_springs < least:
        raise ValueError(f"n_springs must be at least {least} for this shape with its kinks, got {n_springs}")
    level = np.array([stretch.gap_hi - stretch.gap_lo <= SAME * unit for stretch in stretches])
    as_one = [stretch.alike for stretch in stretches]
    # a stretch whose springs move alike gets an eighth of the springs of another
    shares = np.cumsum(np.where(level & ~level.all(), 0.0, np.where(as_one, 1 / 8, 1.0)))
    more = np.rint((n_springs - least) * shares / shares[-1])
    return (2 + np.diff(more, prepend=0).astype(int)).tolist()  # type: ignore[no-any-return]


def _springs_of(shape: Indenter, u_z0: float, stretch: _Stretch, n: int) -> tuple[Array, Array, Array]:
    """Places, gaps and widths of the n springs of a stretch."""
    span = stretch.x_hi - stretch.x_lo
    share, part = _fejer(n)
    gap = stretch.gap_lo + (stretch.gap_hi - stretch.gap_lo) * _rise(shape, stretch, share, u_z0)
    gap += _missing_mean(u_z0, stretch, float(part @ gap))
    return stretch.x_lo + span * share, gap, 2 * span * part


@lru_cache(maxsize=256)
def _fejer(n: int) -> tuple[Array, Array]:
    """Nodes and weights on 0 to 1, (n,): (1 - cos theta)/2 at midpoints of theta; a sum of all Chebyshev moments."""
    from scipy.fft import dct

    moments = np.zeros(n)
    moments[::2] = 1 / (1 - np.arange(0.0, n, 2) ** 2)
    return np.sin(np.pi / 2 * (np.arange(n) + 0.5) / n) ** 2, dct(moments, type=3) / n


def _rise(shape: Indenter, stretch: _Stretch, share: Array, u_z0: float) -> Array:
    """How far g has risen through the stretch, 0 to 1; linear where the stretch is too thin to resolve in x."""
    span = stretch.x_hi - stretch.x_lo
    height = stretch.gap_hi - stretch.gap_lo
    if height <= 0 or span < SAME * stretch.x_hi or height < SAME * (u_z0 + stretch.gap_hi):
        return share
    g_lo, g_hi = u_z0 + stretch.gap_lo, u_z0 + stretch.gap_hi
    rise: Array = np.clip((shape.profile_1d(stretch.x_lo + span * share) - g_lo) / (g_hi - g_lo), 0, 1)
    return rise


def _missing_mean(u_z0: float, stretch: _Stretch, mean: float) -> float:
    """Error of the quadrature in the mean of g over a stretch, from the area below g; rounding is not corrected."""
    span = stretch.x_hi - stretch.x_lo
    missing = stretch.area / span - u_z0 - mean
    noise = 64 * EPS * stretch.x_hi * abs(u_z0 + stretch.gap_hi) / span
    return missing if abs(missing) > noise else 0.0
