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
the ends of F(t), by Masing's rule. What it yields more, y, has harmonics of its own: by slip those of f |f|, with f = F
over its swing, and by the swing of its load those of the integral of F_N f'. Each changes the force by no more than
|Z_n K_n/(K_n + Z_n)| |y_n|, and their sum, with y of the size that it has under the least load, is the error. A flat
punch has nothing of it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.case.depth_cycle import at_instants, least_of
from mdr.case.domain import COULOMB, ON_SPRING, SHAKEN, Domain
from mdr.normal.load_control import static_depth
from mdr.normal.normal_force import mean_normal_force, normal_force
from mdr.tools.arrays import EXACT, Array

INSTANTS = 4096  #: of a period
CLOSE = 1e-3  #: error, over mu_0, up to which this is asked first
HOLDING = Domain((COULOMB, ON_SPRING, SHAKEN), instead="holding_band")


class Held(NamedTuple):
    """The end of what a body holds that is pulled forward, over the mean normal force [-]."""

    cof: float  #: mean F_x
    cof_y: float  #: mean F_y there
    error: float  #: bound on the error of either


def held_forward(case: SlidingContact) -> Held | None:
    """The greatest mean force, over the mean load, that a body shaken in the plane holds; None where it holds none, and
    outside of HOLDING.

    case: of known depth.
    """
    if case not in HOLDING:
        return None
    phase = 2 * np.pi * np.arange(INSTANTS) / INSTANTS
    limit = case.mu_0 * normal_force(case, phase)
    linear = _held(case, case.k_xc, limit)
    if linear is None:
        return None
    least = float(limit.min())
    secant = _secant(case, linear.swing, case.working_depth, least)
    found = _held(case, secant, limit)
    if found is None:
        return None
    load, missed = mean_normal_force(case), abs(found.most - linear.most) + _left_out(case, linear.swing, limit)
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


def _left_out(case: SlidingContact, swing: float, limit: Array) -> float:
    """Bound on the force [N] that goes with what a contact yields more, with a force that swings by this [N]."""
    least, shape, stiff = float(limit.min()), case.indenter, case.k_xc
    depth = static_depth(shape, case.material, least / case.mu_0) if least > 0 else 0.0
    softest = min(_secant(case, swing, one, least) for one in (case.working_depth, depth))
    soft = float(shape.stiffness(depth, case.material.E_star)) / case.material.mindlin_ratio
    soft = min(max(soft, softest), stiff)  # that of a contact that does not slip, under the least load
    forces = {across: case.borne(case.k_xc, across=across) for across in (False, True)}
    sized = np.hypot(*(at_instants(one, limit.size) for one in forces.values()))
    n = np.arange(1, limit.size // 4)
    change = limit - 0.5 * (limit.max() + limit.min())
    change = change / max(change.max(), EXACT * limit.max())
    modulus = np.asarray(case.material.dynamic_modulus(n * case.omega)) / case.material.E_star
    missed = 0.0
    for across, force in forces.items():
        if not force.any():
            continue
        rate = at_instants(1j * np.arange(1, force.size + 1) * force, limit.size)
        parts = at_instants(force, limit.size) * sized / sized.max(), rate * change
        slips, swings = (2 * np.abs(np.fft.rfft(part)[1 : n.size + 1]) / limit.size for part in parts)
        Z = np.asarray(case.pull.dynamic_stiffness(n * case.omega, across=across))
        K = modulus * np.clip(-(Z * modulus.conj()).real / np.abs(modulus) ** 2, softest, stiff)  # nearest to -Z
        with np.errstate(divide="ignore", invalid="ignore"):
            shared = np.where(K + Z == 0, np.inf, np.abs(Z * K / (K + Z)))
        missed += float(shared @ (slips * (1 / softest - 1 / soft) + swings / n * (1 / soft - 1 / stiff)))
    return missed


def _secant(case: SlidingContact, swing: float, depth: float, least: float) -> float:
    """Tangential stiffness [N/m] of a force that swings by this from a depth to where the limit is least [N]."""
    shape = case.indenter
    left = (least - swing) / case.mu_0
    yields = depth - (static_depth(shape, case.material, left) if left > 0 else 0.0)
    more = case.mu_0 * float(shape.force(depth, case.material.E_star)) - (least - swing)
    return more / (case.mu_0 * case.material.mindlin_ratio * yields) if yields > EXACT * depth else case.k_xc
