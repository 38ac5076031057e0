"""Cells of the row of springs: where they stand, how deep their feet lie, how wide they are.

What sets the accuracy is the *edge band* between the radii of contact at the least and the greatest depth, where
springs touch and leave, and for a slow material the wider band out to the gap below which contact is never lost. The
row is therefore cut into panels at exactly these radii (and at the kinks of the shape), each with cells of its own
however thin it is, and each spring stands at the mean depth of its cell. Sums over the springs then equal k_zc and F_N
exactly at the mean depth and at both extremes of the motion.

Symbols: x position [m], gap = g(x) - u_z0 depth of a spring's foot relative to the mean depth [m], kept_gap the gap, in
du_z, below which springs never lose contact.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.polynomial.legendre import leggauss

from mdr.case.depth_cycle import Cycle
from mdr.indenters.base import Indenter
from mdr.tools.arrays import EPS, Array

_NODES, _WEIGHTS = (0.5 * (leggauss(4)[0] + 1), 0.5 * leggauss(4)[1])


def cells(shape: Indenter, cycle: Cycle, kept_gap: float, n_springs: int) -> tuple[Array, Array, Array, int]:
    """x, gap, width (n_springs,) from the centre outwards, and how many of the first never lose contact."""
    if shape.least_depth > 0:
        return _complete(shape, cycle.u_z0, n_springs)
    panels = _panels(shape, cycle, kept_gap)
    counts = _share_out(panels, n_springs)
    parts = [_cells(shape, cycle.u_z0, panel, n) for panel, n in zip(panels, counts, strict=True)]
    x, gap, width = (np.concatenate(part) for part in zip(*parts, strict=True))
    return x, gap, width, sum(n for panel, n in zip(panels, counts, strict=True) if panel.permanent)


def _complete(shape: Indenter, u_z0: float, n: int) -> tuple[Array, Array, Array, int]:
    """Even cells under a hollow face, which never loses contact where the method holds."""
    edges = shape.max_radius * (np.arange(n + 1) / n)
    part = np.diff(edges)
    return edges[:-1] + part / 2, np.diff(shape.profile_area(edges)) / part - u_z0, 2 * part, n


@dataclass(frozen=True)
class _Panel:
    """A stretch of the row: from x_lo to x_hi, where g rises from u_z0 + gap_lo to u_z0 + gap_hi."""

    x_lo: float
    x_hi: float
    gap_lo: float
    gap_hi: float
    permanent: bool  # in contact through the whole period


def _panels(shape: Indenter, cycle: Cycle, kept_gap: float) -> list[_Panel]:
    """The row cut at the depths where the behaviour of a spring changes, and at the kinks of the shape."""
    u_z0, du_z = cycle.u_z0, cycle.du_z
    kept = du_z * kept_gap
    gaps = [gap for gap in (kept, du_z * cycle.least, 0.0, du_z * cycle.greatest) if u_z0 + gap > 0]
    marks = [(0.0, -u_z0)] + [(float(shape.contact_radius(u_z0 + gap)), gap) for gap in gaps]
    marks += [(x, float(shape.profile_1d(x)) - u_z0) for x in shape.kinks if x < marks[-1][0]]
    marks.sort()
    return [
        _Panel(x_lo, x_hi, gap_lo, gap_hi, permanent=gap_hi <= kept)
        for (x_lo, gap_lo), (x_hi, gap_hi) in pairwise(marks)
        if x_hi > x_lo
    ]


def _share_out(panels: list[_Panel], n_springs: int) -> list[int]:
    """Springs per panel: an eighth of them to the core that never leaves, the rest evenly."""
    n_permanent = sum(panel.permanent for panel in panels)
    n_band = len(panels) - n_permanent
    if n_springs < 2 * len(panels):
        raise ValueError(f"n_springs must be at least {2 * len(panels)} for this shape with its kinks, got {n_springs}")
    core = n_springs if n_band == 0 else max(2, n_springs // (8 * max(n_permanent, 1))) * n_permanent
    counts = []
    for group, total in ((True, core), (False, n_springs - core)):
        n = n_permanent if group else n_band
        counts.append(iter([total // n + (i < total % n) for i in range(n)]))
    return [next(counts[0] if panel.permanent else counts[1]) for panel in panels]


def _cells(shape: Indenter, u_z0: float, panel: _Panel, n: int) -> tuple[Array, Array, Array]:
    """Centres, mean gaps and widths of the n cells of a panel."""
    span = panel.x_hi - panel.x_lo
    edges = np.arange(n + 1) / n  # shares of the panel
    if panel.x_lo == 0 and not panel.permanent:
        edges = edges**2  # the tip leaves: the instant of its touch counts
    part = np.diff(edges)
    share = edges[:-1, None] + part[:, None] * _NODES  # (n, 4)
    rise = _rise(shape, panel, share, u_z0)
    gap = panel.gap_lo + (panel.gap_hi - panel.gap_lo) * (rise @ _WEIGHTS)
    gap += _missing_mean(shape, u_z0, panel, float(part @ gap))
    return panel.x_lo + span * (edges[:-1] + 0.5 * part), gap, 2 * span * part


def _rise(shape: Indenter, panel: _Panel, share: Array, u_z0: float) -> Array:
    """How far g has risen through the panel, 0 to 1; linear where the panel is too thin to resolve in x."""
    span = panel.x_hi - panel.x_lo
    height = panel.gap_hi - panel.gap_lo
    if height <= 0 or span < 1e-9 * panel.x_hi or height < 1e-9 * (u_z0 + panel.gap_hi):
        return share
    g_lo, g_hi = u_z0 + panel.gap_lo, u_z0 + panel.gap_hi
    rise: Array = np.clip((shape.profile_1d(panel.x_lo + span * share) - g_lo) / (g_hi - g_lo), 0, 1)
    return rise


def _missing_mean(shape: Indenter, u_z0: float, panel: _Panel, mean: float) -> float:
    """What the quadrature missed of the mean of g over a panel, known exactly from F_N; rounding is left alone."""
    g_lo, g_hi = u_z0 + panel.gap_lo, u_z0 + panel.gap_hi
    area = panel.x_hi * g_hi - panel.x_lo * g_lo - 0.5 * (float(shape.force(g_hi, 1.0)) - float(shape.force(g_lo, 1.0)))
    missing = area / (panel.x_hi - panel.x_lo) - u_z0 - mean
    noise = 64 * EPS * panel.x_hi * abs(g_hi) / (panel.x_hi - panel.x_lo)
    return missing if abs(missing) > noise else 0.0
