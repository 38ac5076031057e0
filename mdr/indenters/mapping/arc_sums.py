"""∫ h(r)/√(x² − r²) dr over r < x for piecewise polynomials h of many pieces, at many x, in n log n.

Pieces are grouped by twos, fours, eights … of leaves. Over a group that is at least its own width away from x the root
is smooth: its polynomial through N_NODES Chebyshev points is good to 5.8**-22 = 1e-17, and the group then is as many
weights at these points. The pieces near to x are left to whom they concern.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.indenters.mapping.quadrature import chebyshev_fit
from mdr.indenters.mapping.stable_functions import GAUSS
from mdr.tools.arrays import Array

N_NODES = 22  #: Gauss's 14 points are exact up to degree 27: of a node's polynomial, 21, times h, 6
LEAF = 4  #: pieces of the smallest groups

Numbers = NDArray[np.intp]  #: of radii, of groups or of pieces


class Level(NamedTuple):
    """Groups of one size, (n_groups,) from the axis outwards; of the lowest level, the pieces."""

    low: Array  #: where each begins [m]
    high: Array
    nodes: Array  #: (n_groups, n_nodes) [m]
    weights: Array  #: of each h at these, (n_h, n_groups, n_nodes)
    parts: int = 0  #: groups of the level below in each


class ArcSums:
    """The sums for functions h, whose polynomials (n_h, n, degree + 1) count u = 0 … 1 between ``ends`` (n + 1,)."""

    def __init__(self, ends: Array, h: Array) -> None:
        nodes, weights = GAUSS
        u, width = (nodes + 1) / 2, np.diff(ends)[:, None]
        values = h @ u ** np.arange(h.shape[2])[:, None] * (width * weights / 2)
        pieces = Level(ends[:-1], ends[1:], ends[:-1, None] + width * u, values)
        self.levels = [pieces, _grouped(pieces, LEAF)]
        while self.levels[-1].low.size > 1:
            self.levels.append(_grouped(self.levels[-1], 2))

    def far(self, x: Array) -> tuple[Array, Numbers, Numbers]:
        """What is far from each x (n_x,), (n_h, n_x), and the pieces that are near: numbers of x, and of pieces."""
        total = np.zeros((self.levels[0].weights.shape[0], x.size))
        row = np.arange(x.size)
        group = np.zeros_like(row)
        for below, level in reversed(list(pairwise(self.levels))):
            low, high = level.low[group], level.high[group]
            away = x[row] - high >= high - low
            on, of = row[away], group[away]
            r = level.nodes[of]
            root = 1 / (np.sqrt(x[on, None] - r) * np.sqrt(x[on, None] + r))
            for sums, weights in zip(total, level.weights, strict=True):
                sums += np.bincount(on, np.einsum("ij,ij->i", weights[of], root), x.size)
            row, group = _within(row[~away], group[~away], level.parts, below.low, x)
        return total, row, group


def _grouped(below: Level, parts: int) -> Level:
    """Groups of so many groups of the level below each; the last may have fewer."""
    first = np.arange(0, below.low.size, parts)
    low, high = below.low[first], np.maximum.reduceat(below.high, first)
    of = np.arange(below.low.size) // parts
    sums = np.einsum("kig,igm->kim", below.weights, _shares(below.nodes, low[of], high[of]))
    nodes = low[:, None] + (high - low)[:, None] * (chebyshev_fit(N_NODES)[0] + 1) / 2
    return Level(low, high, nodes, np.add.reduceat(sums, first, axis=1), parts)


def _shares(r: Array, low: Array, high: Array) -> Array:
    """Lagrange's polynomials of the nodes between low and high (n,) at places r (n, m): (n, m, N_NODES)."""
    t = np.clip(2 * (r - low[:, None]) / (high - low)[:, None] - 1, -1, 1)
    return np.cos(np.arccos(t)[:, :, None] * np.arange(N_NODES)) @ chebyshev_fit(N_NODES)[1]


def _within(row: Numbers, group: Numbers, n: int, begins: Array, x: Array) -> tuple[Numbers, Numbers]:
    """The n parts of each group that begin before x, where ``begins`` says where each part does."""
    part = (n * group[:, None] + np.arange(n)).ravel()
    row = np.repeat(row, n)
    kept = part < begins.size
    kept[kept] = begins[part[kept]] < x[row[kept]]
    return row[kept], part[kept]
