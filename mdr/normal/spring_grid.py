"""Where the springs stand, how deep their feet lie, how wide they are.

The accuracy is decided in the *edge band*, between the contact radii at the least and the greatest depth, where springs
touch and leave. For a slow material the band reaches out to the gap below which contact is never lost. The row is cut
at exactly these radii, and at the kinks of the shape. Each stretch between two cuts has springs of its own, however
thin it is. Each spring stands for one cell of its stretch, at the mean depth of the cell. Sums over the springs then
equal k_zc and F_N exactly at the mean depth and at both extremes of the motion.

Symbols: x position [m], gap = g(x) - u_z0 depth of a spring's foot relative to the mean depth [m], kept_gap the gap, in
du_z, below which springs never lose contact.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import leggauss

from mdr.case.depth_cycle import Cycle
from mdr.indenters.base import Indenter
from mdr.tools.arrays import EPS, Array

_NODES, _WEIGHTS = (0.5 * (leggauss(4)[0] + 1), 0.5 * leggauss(4)[1])


AS_ONE = 1 / 8  #: share of the springs that the core gets where its springs move alike
EACH_ITS_OWN = 1 / 2  #: the same where every spring of it has modes of its own, as under a shake in the plane


def cells(
    shape: Indenter, cycle: Cycle, kept_gap: float, n_springs: int, core_share: float = AS_ONE
) -> tuple[Array, Array, Array, int]:
    """x, gap, width (n_springs,) from the centre outwards, and how many of the first never lose contact."""
    if shape.least_depth > 0:
        return _complete(shape, cycle.u_z0, n_springs)
    stretches = _stretches(shape, cycle, kept_gap)
    counts = _share_out(stretches, n_springs, core_share)
    parts = [_springs_of(shape, cycle.u_z0, stretch, n) for stretch, n in zip(stretches, counts, strict=True)]
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


def _stretches(shape: Indenter, cycle: Cycle, kept_gap: float) -> list[_Stretch]:
    """The row, cut at the depths where a spring begins to lose or to gain contact, and at the kinks of the shape."""
    u_z0, du_z = cycle.u_z0, cycle.unit
    kept = du_z * kept_gap
    gaps = [gap for gap in (kept, du_z * cycle.least, 0.0, du_z * cycle.greatest) if u_z0 + gap > 0]
    radii = shape.contact_radius(u_z0 + np.array(gaps))
    marks = [(0.0, -u_z0), *zip(radii.tolist(), gaps, strict=True)]
    marks += [(x, float(shape.profile_1d(x)) - u_z0) for x in shape.kinks if x < radii[-1]]
    marks.sort()
    area = np.diff(shape.profile_area([x for x, _ in marks]))
    return [
        _Stretch(x_lo, x_hi, gap_lo, gap_hi, below, permanent=gap_hi <= kept)
        for (x_lo, gap_lo), (x_hi, gap_hi), below in zip(marks, marks[1:], area.tolist(), strict=False)
        if x_hi > x_lo
    ]


def _share_out(stretches: list[_Stretch], n_springs: int, core_share: float) -> list[int]:
    """Number of springs of each stretch: a share of all for the core, the rest equally for the band."""
    n_permanent = sum(stretch.permanent for stretch in stretches)
    n_band = len(stretches) - n_permanent
    if n_springs < 2 * len(stretches):
        raise ValueError(
            f"n_springs must be at least {2 * len(stretches)} for this shape with its kinks, got {n_springs}"
        )
    core = n_springs if n_band == 0 else max(2, int(n_springs * core_share / max(n_permanent, 1))) * n_permanent
    counts = []
    for group, total in ((True, core), (False, n_springs - core)):
        n = n_permanent if group else n_band
        counts.append(iter([total // n + (i < total % n) for i in range(n)]))
    return [next(counts[0] if stretch.permanent else counts[1]) for stretch in stretches]


def _springs_of(shape: Indenter, u_z0: float, stretch: _Stretch, n: int) -> tuple[Array, Array, Array]:
    """Centres, mean gaps and widths of the n cells of a stretch."""
    span = stretch.x_hi - stretch.x_lo
    edges = np.arange(n + 1) / n  # shares of the stretch
    if stretch.x_lo == 0 and not stretch.permanent:
        edges = edges**2  # the tip leaves: the instant of its touch counts
    part = np.diff(edges)
    share = edges[:-1, None] + part[:, None] * _NODES  # (n, 4)
    rise = _rise(shape, stretch, share, u_z0)
    gap = stretch.gap_lo + (stretch.gap_hi - stretch.gap_lo) * (rise @ _WEIGHTS)
    gap += _missing_mean(u_z0, stretch, float(part @ gap))
    return stretch.x_lo + span * (edges[:-1] + 0.5 * part), gap, 2 * span * part


def _rise(shape: Indenter, stretch: _Stretch, share: Array, u_z0: float) -> Array:
    """How far g has risen through the stretch, 0 to 1; linear where the stretch is too thin to resolve in x."""
    span = stretch.x_hi - stretch.x_lo
    height = stretch.gap_hi - stretch.gap_lo
    if height <= 0 or span < 1e-9 * stretch.x_hi or height < 1e-9 * (u_z0 + stretch.gap_hi):
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
