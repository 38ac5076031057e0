"""Contacts that are known in closed form, computed in three dimensions: what the judge has to get right first.

All on a half-space of E* = 1 and cells over a square around a contact of radius a = 1. The edge of a flat punch runs
through cells: its radius on the grid is that of a disc of the same area.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

import mdr
from mdr.half_space.friction import BELOW, MARGIN
from mdr.half_space.influence import HalfSpace, X, Y, Z
from mdr.half_space.normal import pressure
from mdr.half_space.steps import Contact, Step
from mdr.half_space.tangential import traction
from mdr.tools.arrays import Array


def body(n: int, nu: float, side: float) -> tuple[HalfSpace, Array]:
    """n x n cells over a square of this side of a body with E* = 1, and the distance (n, n) from its middle."""
    h = side / n
    places = (np.arange(n) - (n - 1) / 2) * h
    half_space = HalfSpace(n, h, 1.0, 2 * (1 - nu) / (2 - nu), (1 - 2 * nu) / (2 * (1 - nu)))
    return half_space, np.hypot(places[:, None], places[None, :])


def radius_of(cells: Array, h: float) -> float:
    """Radius of the disc that is as large as these cells together."""
    return float(np.sqrt(np.count_nonzero(cells) / np.pi)) * h


# --- the normal problem ---


@cache
def hertz(n: int) -> float:
    """Force of a paraboloid over that of Hertz, 4/3 E* a d, without friction."""
    half_space, r = body(n, 0.5, 2 * MARGIN)
    p = pressure(lambda p: half_space.displacement(p[None], (Z,), (Z,))[0], 1 - r**2 / 2, np.zeros((n, n)), 1e-10)
    return float(p.sum()) * half_space.h**2 / (4 / 3)  # d = a²/R = 1


@cache
def punch(n: int, nu: float) -> tuple[float, float]:
    """Force of a flat punch without friction over 2 E* a d, and of one that is bonded over the former."""
    half_space, r = body(n, nu, 2.0)
    inside = r < 1
    asked = np.zeros((3, n, n))
    asked[Z] = inside
    smooth = conjugate_gradients(lambda t: half_space.displacement(t, (Z,), (Z,)) * inside, asked[Z:])[0].sum()
    bonded = conjugate_gradients(lambda t: half_space.displacement(t) * inside, asked)[Z].sum()
    return float(smooth) * half_space.h**2 / (2 * radius_of(inside, half_space.h)), float(bonded / smooth)


def conjugate_gradients(product: Callable[[Array], Array], asked: Array) -> Array:
    """x with product(x) = asked."""
    x, r = np.zeros_like(asked), asked.copy()
    direction, norm = r, np.sum(r * r)
    while norm > 1e-20 * np.sum(asked * asked):
        image = product(direction)
        along = norm / np.sum(direction * image)
        x, r = x + along * direction, r - along * image
        new = np.sum(r * r)
        direction, norm = r + new / norm * direction, new
    return x


# --- friction ---


@dataclass(frozen=True)
class PartialSlip:
    """A paraboloid pressed first and pulled then by a share of what full slip takes, without coupling."""

    force: float  #: F_x over mu_0 F_z
    closed_form: float  #: the same of Cattaneo (1938) and Mindlin (1949), 1 - (1 - share)^(3/2)
    stick: float  #: radius of stick over that of contact, of equal areas; the closed form is sqrt(1 - share)
    traction: float  #: greatest deviation of q_x from theirs, over mu_0 p_0, within 0.9 a
    transverse: float  #: greatest q_y, which theirs leaves out, over mu_0 p_0


@cache
def cattaneo_mindlin(n: int, nu: float, share: float, mu_0: float = 0.3) -> PartialSlip:
    """The paraboloid at a tangential way of `share` mu_0 kappa d."""
    half_space, r = body(n, nu, 2 * MARGIN)
    p = pressure(lambda p: half_space.displacement(p[None], (Z,), (Z,))[0], 1 - r**2 / 2, np.zeros((n, n)), 1e-10)
    asked = np.zeros((2, n, n))
    asked[X] = share * mu_0 * half_space.E_star / half_space.G_star
    q = traction(lambda q: half_space.displacement(q, (X, Y), (X, Y)), asked, mu_0 * p, np.zeros_like(asked), 1e-9)
    p_0, c = 2 / np.pi, np.sqrt(1 - share)
    known = mu_0 * p_0 * (np.sqrt(np.maximum(1 - r**2, 0)) - c * np.sqrt(np.maximum(1 - (r / c) ** 2, 0)))
    size, touching = np.hypot(*q), p > 0
    sticks = touching & (size < BELOW * mu_0 * p)
    return PartialSlip(
        force=float(q[X].sum() / (mu_0 * p.sum())),
        closed_form=1 - (1 - share) ** 1.5,
        stick=radius_of(sticks, half_space.h) / radius_of(touching, half_space.h),
        traction=float(np.max(np.abs(q[X] - known)[r < 0.9])) / (mu_0 * p_0),
        transverse=float(np.max(np.abs(q[Y]))) / (mu_0 * p_0),
    )


@cache
def spence(n: int, nu: float, mu_0: float, steps: int = 0) -> float:
    """Radius of stick over that of contact under a normal load: flat punch, or with `steps` a paraboloid."""
    half_space, r = body(n, nu, 2 * MARGIN if steps else 2.0)
    shape = r**2 / 2 if steps else np.where(r < 1, 0.0, 1e3)
    contact = Contact(half_space, shape, mdr.Coulomb(mu_0))
    step = Step(np.zeros((3, n, n)), np.zeros((3, n, n)), np.zeros((2, n, n)))
    for depth in np.linspace(0, 1, (steps or 1) + 1)[1:]:
        step = contact.step(step, float(depth), np.zeros(2), 1.0)
    size, touching = np.hypot(*step.tractions[:2]), step.pressure > 0
    sticks = touching & (size < BELOW * mu_0 * step.pressure)
    return radius_of(sticks, half_space.h) / radius_of(touching, half_space.h)
