"""What holds a body at rest that is shaken in the plane: the force that its contact bears while it sticks.

Of a stuck body, the contact and what pulls share the force of the shake, harmonic by harmonic,

    F_n = K_n P_n/(K_n + Z_n),   K_n = k_xc E*(n omega)/E*,   Z_n = k_x - m (n omega)² + i n omega c_x,

with P_n = (k_x + i n omega c_x) X_n where the far end of the pull is shaken, and Z_n X_n where the tool is. A contact
that is stiff beside Z_n bears all of P_n. The body creeps where a mean force Q loads all springs to their limit once in
a period. With depth and way over mu_0 kappa in one unit, limit less extension of a spring that never slips back is
z - u less its least value in the period, that of one that touched at t_1 is z - u less its value there, and that of
one that slipped back is no more: at the instant t* at which z - u is least, all that press are at their limit, and
friction is full. As it is never more than that, mu_0 F_N(t) - F(t) is least at t*, and

    Q = min over t of [mu_0 F_N(t) - F(t)],

whatever the shape. Shaken across as well, forces are vectors, and Q must lie in the disc of radius mu_0 F_N(t) about
-F(t) at every instant. On a dashpot springs come to their limits one after the other, and Q is a little more.

A curved contact yields more than k_xc tells, as its edge slips and moves: for k_xc stands its secant stiffness between
the ends of F(t), by Masing's rule, under the least load. What it yields more has higher harmonics too, up to the third
in the main, and with the greatest Z_n of these it bounds what is left out. A flat punch has nothing of it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.case.depth_cycle import at_instants, least_of
from mdr.normal.load_control import static_depth
from mdr.normal.normal_force import mean_normal_force, normal_force
from mdr.tools.arrays import EXACT, Array

INSTANTS = 4096  #: of a period
CLOSE = 1e-3  #: error, over mu_0, up to which this is asked first
HIGHEST = 3  #: harmonic, over that of what moves, of what a curved contact yields more


class Held(NamedTuple):
    """The end of what a body holds that is pulled forward, over the mean normal force [-]."""

    cof: float  #: mean F_x
    cof_y: float  #: mean F_y there
    error: float  #: bound on the error of either


def held_forward(case: SlidingContact) -> Held | None:
    """The greatest mean force, over the mean load, that a body shaken in the plane holds; None where it holds none, and
    where something else than Coulomb's friction of a body on a spring is asked about.

    case: of known depth.
    """
    if case.pull.is_rigid or not case.is_shaken or case.tau_0:
        return None
    phase = 2 * np.pi * np.arange(INSTANTS) / INSTANTS
    limit = case.mu_0 * normal_force(case, phase)
    linear = _held(case, case.k_xc, limit)
    if linear is None:
        return None
    secant = _secant(case, linear.swing, float(limit.min()))
    found = _held(case, secant, limit)
    if found is None:
        return None
    load, more = mean_normal_force(case), linear.swing * abs(1 / secant - 1 / case.k_xc)
    highest = HIGHEST * max(case.cycle.harmonics.size, case.shake_harmonics.size, case.harmonics_across.size)
    stiffest = np.abs(case.pull.dynamic_stiffness(case.omega * np.arange(1, highest + 1))).max()
    missed = abs(found.most - linear.most) + float(stiffest) * more
    return Held(found.most / load, found.aside / load, missed / load + EXACT * case.mu_0)


class _Held(NamedTuple):
    most: float  #: greatest mean force that is held [N]
    aside: float  #: mean force across there [N]
    swing: float  #: half the way of the force that the shake adds [N]


def _held(case: SlidingContact, k_xc: float, limit: Array) -> _Held | None:
    """What a contact of this stiffness holds whose friction has this limit [N]; None where it holds nothing."""
    along, across = (case.borne(k_xc, across=one) for one in (False, True))
    if not (np.isfinite(along).all() and np.isfinite(across).all()):
        return None
    f_x, f_y = at_instants(along, limit.size), at_instants(across, limit.size)
    swing = float(np.hypot(np.ptp(f_x), np.ptp(f_y))) / 2
    if not across.any():
        most, least = least_of(limit - f_x), -least_of(limit + f_x)
        return _Held(most, 0.0, swing) if least < most else None
    (most, aside), (least, _) = _furthest(f_x, f_y, limit), _furthest(-f_x, f_y, limit)
    return _Held(most, aside, swing) if -least < most else None


def _furthest(f_x: Array, f_y: Array, limit: Array) -> tuple[float, float]:
    """Greatest x in all discs of these radii about (-f_x, -f_y), and y there; minus infinity where they share none."""
    from scipy.optimize import minimize_scalar

    low, high = float(np.max(-f_y - limit)), float(np.min(limit - f_y))
    if low > high:
        return -np.inf, 0.0

    def short(y: float) -> float:  # convex
        return -least_of(np.sqrt(np.maximum(limit**2 - (y + f_y) ** 2, 0.0)) - f_x)

    y = float(minimize_scalar(short, bounds=(low, high), options={"xatol": 1e-9 * float(limit.max())}).x)
    return -short(y), y


def _secant(case: SlidingContact, swing: float, least: float) -> float:
    """Tangential stiffness [N/m] between the ends of a force that swings by this [N], where the limit is least [N]."""
    depth, shape = case.working_depth, case.indenter
    left = (least - swing) / case.mu_0
    yields = depth - (static_depth(shape, case.material, left) if left > 0 else 0.0)
    more = case.mu_0 * float(shape.force(depth, case.material.E_star)) - (least - swing)
    return more / (case.mu_0 * case.material.mindlin_ratio * yields) if yields > EXACT * depth else case.k_xc
