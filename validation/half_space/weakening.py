"""Friction that falls with slip, on a half-space of nu = 0, or on springs that know nothing of each other.

A point sticks up to mu_s p. Let go, it slips forward or back at a share of p that falls from mu_s to mu_k on a line
over the slip distance d_c (slip weakening), or at once where d_c is zero. Once it sticks, it bears mu_s p again.

Pressure and traction leave each other alone, and a traction that depends on the distance from the axis alone moves the
surface along itself, so (annuli.py); square cells, which know no axis, say whether slip keeps to it. Quasi-static and
implicit, of first order in the step. In each step first those points slip that must with the coefficient that they
have. Where a coefficient falls by that, tractions are found again, until none does. Slip of one point only makes others
slip more, so that the order does not matter.

In units of the depth u_z0, of E* and of the greatest radius of contact; tractions over mu_k; displacements along the
surface, d_c among them, over mu_k kappa u_z0.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from mdr.half_space.influence import HalfSpace, Z
from mdr.tools.arrays import Array
from validation.cases import DEPTH, SHAPES
from validation.half_space.annuli import annuli

TURNS = 20_000  #: of slip and coefficients in a step, at most
FINE = 1e-6  #: of d_c, to which slip is found
REST = -1.0  #: in the place of what a point has slipped: it sticks
Stick = float | Array  #: mu_s/mu_k, of all points or of each (n,)


class Points(NamedTuple):
    """What touches, and what bears the forces."""

    gap: Array  #: (n,) before anything touches, over u_z0; the first ones touch first
    weight: Array  #: (n,) of a traction in the force
    moved: Array  #: (n, n) displacement of the first by traction 1 on the second


class Friction(NamedTuple):
    """The last period."""

    share: float  #: mean friction over mu_k times mean normal force
    settling: float  #: change of this over the last period
    unbalanced: float  #: work of the pull less what is lost, over the work


def half_space(shape: str, alpha: float, n: int) -> Points:
    """n annuli of one width over the greatest contact of a shape of `validation.cases`."""
    indenter, rings = SHAPES[shape], annuli(n)
    radius = float(indenter.contact_radius(DEPTH * (1 + alpha)))
    return Points(indenter.profile_3d(radius * rings.r) / DEPTH, rings.area, rings.moved)


def square_cells(shape: str, alpha: float, n: int) -> Points:
    """Those of n x n cells that the greatest contact of a shape touches, or nearly."""
    indenter, solid = SHAPES[shape], HalfSpace(n, 2.12 / n, 1.0, 1.0)
    r = solid.radii.ravel()
    order = np.argsort(r, kind="stable")[: np.count_nonzero(r < 1 + solid.h / 2)]
    apart = [np.subtract.outer(one, one) + n - 1 for one in np.divmod(order, n)]
    radius = float(indenter.contact_radius(DEPTH * (1 + alpha)))
    gap = indenter.profile_3d(radius * r[order]) / DEPTH
    return Points(gap, np.ones(order.size), solid.coefficients(Z, Z)[apart[0], apart[1]])


def springs(shape: str, alpha: float, n: int) -> Points:
    """n springs of one width, at one side of the row."""
    indenter, x = SHAPES[shape], (np.arange(n) + 0.5) / n
    radius = float(indenter.contact_radius(DEPTH * (1 + alpha)))
    return Points(indenter.profile_1d(radius * x) / DEPTH, np.ones(n), np.eye(n))


def friction(
    points: Points, alpha: float, v: float, stick: Stick, d_c: float = 0.0, steps: int = 200, periods: int = 3
) -> Friction:
    """Friction at v, over Eq. (1) with mu_k, under a harmonic depth; from full slip on. stick: mu_s/mu_k."""
    pressures = _pressures(points, 1 - alpha * np.cos(2 * np.pi * np.arange(1, steps + 1) / steps))
    way = 2 * np.pi * v * alpha / steps
    marched = march(points, np.tile(pressures, (periods, 1)), way, stick, d_c, pressures[-1])
    q, slip = (np.array(one) for one in zip(*marched, strict=True))
    shares = (q @ points.weight).reshape(periods, steps).mean(axis=1) / (pressures @ points.weight).mean()
    mean = 0.5 * (q[-steps:] + q[-steps - 1 : -1])
    work, lost = way * (mean @ points.weight).sum(), ((mean * slip[-steps:]) @ points.weight).sum()
    return Friction(float(shares[-1]), float(abs(shares[-1] - shares[-2])), float(abs(work - lost) / work))


def breakaway(points: Points, stick: float, d_c: float = 0.0, steps: int = 400) -> float:
    """Greatest friction over that of slip, without vibration, while the contact is slowly pulled from rest."""
    pressures = np.tile(_pressures(points, np.ones(1)), (steps, 1))
    way = 2 * (stick + d_c) / steps
    marched = march(points, pressures, way, stick, d_c, np.zeros(points.gap.size))
    return float(max(points.weight @ q for q, _ in marched) / (points.weight @ pressures[0]))


def march(
    points: Points, pressures: Array, way: float, stick: Stick, d_c: float, q: Array
) -> Iterator[tuple[Array, Array]]:
    """Tractions (n,) at the ends of steps under these pressures (steps, n), and the slip in them; `way` each.

    From tractions q on: those that are not zero are at the bound of full slip.
    """
    moved, stick = points.moved, np.broadcast_to(stick, q.shape)
    slipped, u = np.where(q == 0, REST, np.inf), moved @ q  # slipped: since it was let go
    for p in pressures:
        m, here, before, q = np.count_nonzero(p), u, q, np.zeros_like(q)
        q[:m], slip = _step(moved[:m, :m], here[:m] + way, p[:m], before[:m], slipped[:m], stick[:m], d_c)
        slipped[:m] = np.where(slip == 0, REST, np.maximum(slipped[:m], 0.0) + np.abs(slip))
        slipped[m:], u = REST, moved @ q
        yield q, way - (u - here)


def _step(
    moved: Array, asked: Array, p: Array, q: Array, slipped: Array, stick: Array, d_c: float
) -> tuple[Array, Array]:
    """Tractions (m,) at the end of a step, and slip in it, zero of what sticks; asked: displacement without slip."""
    rests, slip = slipped < 0, np.zeros_like(q)
    for _ in range(TURNS):
        so_far = np.maximum(slipped, 0.0) + np.abs(slip)
        falls = np.clip(1 - so_far / d_c, 0.0, 1.0) if d_c else np.zeros_like(q)
        q, new = _coulomb(moved, asked, np.where(rests, stick, 1 + (stick - 1) * falls) * p, q, slip)
        go, change = rests & (new != 0), np.abs(new - slip).max()
        rests, slip = rests & ~go, new
        if not go.any() and (not d_c or change <= FINE * d_c):
            return q, slip
    raise RuntimeError(f"slip still changes by {change:.1e} after {TURNS} turns: take more steps")


def _coulomb(moved: Array, asked: Array, bound: Array, q: Array, slip: Array) -> tuple[Array, Array]:
    """Tractions (m,) with |q| <= bound, and slip, forward at the bound and back at its opposite (active sets)."""
    stiff = 1 / moved.diagonal()
    for _ in range(TURNS):
        tried = q + stiff * slip
        sticks = np.abs(tried) <= bound
        q = np.copysign(bound, tried)
        q[sticks] = np.linalg.solve(moved[np.ix_(sticks, sticks)], (asked - moved[:, ~sticks] @ q[~sticks])[sticks])
        slip = np.where(sticks, 0.0, asked - moved @ q)
        if np.all(np.abs(q[sticks]) <= bound[sticks]) and np.all(slip * q >= 0):
            return q, slip
    raise RuntimeError(f"stick and slip are not found in {TURNS} turns: take more steps")


def _pressures(points: Points, depths: Array) -> Array:
    """Pressures (depths, n): above zero on as many of the first points as can be."""
    found = np.zeros((depths.size, points.gap.size))
    for p, depth in zip(found, depths, strict=True):
        for m in range(np.count_nonzero(points.gap < depth), 0, -1):
            pressed = np.linalg.solve(points.moved[:m, :m], depth - points.gap[:m])
            if pressed.min() > 0:
                p[:m] = pressed
                break
    return found
