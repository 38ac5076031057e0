"""An axisymmetric half-space of nu = 0 without coupling, on annuli: friction is a vector, and no cell knows the axes.

A traction then moves the surface along itself only, and one that depends on the distance from the axis alone moves it
so. A contact that is pulled and shaken across needs one vector for each annulus: it is the contact of independent
springs, but with Coulomb's law in every point of the surface in the place of every spring. In units of E*, of the
contact radius and of the depth; displacements along the surface over mu_0 kappa.

The displacement of a uniformly loaded disc is Boussinesq's, by complete elliptic integrals; an annulus is the
difference of two discs.
"""

from functools import cache
from typing import NamedTuple

import numpy as np
from scipy.special import ellipe, ellipk

from mdr.half_space.tangential import traction
from mdr.indenters.base import Indenter
from mdr.tools.arrays import Array

FINE = 1e-9  #: of the greatest bound, to which tractions are found


class Annuli(NamedTuple):
    """n annuli of one width over a disc of radius 1."""

    r: Array  #: (n,) middles
    area: Array  #: (n,)
    moved: Array  #: (n, n) displacement of the first by traction 1 on the second, made reciprocal (Betti)


class Found(NamedTuple):
    """The last period of a contact."""

    cof: complex  #: mean force over mu_0 F_z, along the pull and (imaginary) across
    settling: float  #: what further periods would change
    tractions: Array  #: (2, n, 1) at its end, times the root of the area, from which another run may begin


@cache
def annuli(n: int) -> Annuli:
    """n of them."""
    edges = np.linspace(0, 1, n + 1)
    r = 0.5 * (edges[1:] + edges[:-1])
    area, moved = np.pi * np.diff(edges**2), np.diff([disc(r, R) for R in edges], axis=0).T
    root = np.sqrt(area)
    mutual = root[:, None] * moved / root
    return Annuli(r, area, 0.5 * (mutual + mutual.T) / root[:, None] * root)


def disc(r: Array, R: float) -> Array:
    """The displacement (n,) at the radii r by a traction 1 on the disc of radius R; modulus 1."""
    if R == 0:
        return np.zeros_like(r)
    m = np.minimum(r / R, R / r) ** 2
    return 4 / np.pi * np.where(r < R, R * ellipe(m), r * (ellipe(m) - (1 - m) * ellipk(m)))


def pressure(indenter: Indenter, radius: float, depth: float, n: int) -> Array:
    """Pressure (n,) on the annuli under a shape that touches over a disc of this radius."""
    rings = annuli(n)
    return np.asarray(np.linalg.solve(rings.moved, 1 - indenter.profile_3d(radius * rings.r) / depth))


def friction(p: Array, way: Array, cycles: int, settled: float, start: Array | None = None) -> Found:
    """Friction under the pressure p (n,) while the indenter goes this way (2, steps + 1) in each period.

    From `start` or full slip on, until further periods would change less than `settled`. Steps have two stages, as in
    mdr/half_space/steps.py, and are of second order.
    """
    rings = annuli(p.size)
    root = np.sqrt(rings.area)
    matrix = root[:, None] * rings.moved / root
    bound = (root * p)[:, None]

    def product(q: Array) -> Array:
        return np.asarray(matrix @ q[:, :, 0].T).T[:, :, None]

    def solved(asked: Array, start: Array) -> Array:
        return traction(product, asked, bound, start, FINE, stiff=1 / matrix.diagonal().max())

    q = np.stack([bound, 0 * bound]) if start is None else start
    last, change, settling = complex(np.inf), np.inf, np.inf
    moves = np.diff(way, axis=1).T[:, :, None, None] * root[:, None]
    for _ in range(cycles):
        total = np.zeros(2)
        for move in moves:
            here = product(q)
            middle = solved(here + move / 2, q)
            end = solved(2 * product(middle) - here, 2 * middle - q)
            total += root @ (q + 4 * middle + end)[:, :, 0].T / 6
            q = end
        mean = complex(*total) / (len(moves) * float(root @ bound[:, 0]))
        before, change, last = change, abs(mean - last), mean
        settling = change / max(1 - change / before, 0.1)  # of a geometric series
        if change and settling <= settled:
            break
    return Found(mean, settling, q)
