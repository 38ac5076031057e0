"""Coulomb friction in the plane, as disc.py, on a straight path by a return map: for steps of any length beside the
times of arms and dashpot.

A spring that would stick has the trial force g. Where g is longer than R = L[s], it slips with the velocity that brings
its force to the length R in the direction of g, after the time that the map is made for. The extension is straight in
two parts of the time, by the implicit Runge-Kutta method of two stages that is stiffly accurate (Alexander 1977), of
second order; arms and dashpot go with it exactly. So the work is that of this path: what is lost in it is R times the
slip, and what arms and dashpot lose. What relaxes fast beside the time is at its limit, and no event is looked for.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

import numpy as np

from mdr.spring.contact import Friction, one_row
from mdr.spring.contact_modes import SLIP, STICK
from mdr.spring.motion import end_force, held_force, hold
from mdr.spring.path import FAST, LENT, size_of
from mdr.spring.times import PART, fill
from mdr.tools.jit import inner

_inline = inner(forceinline=True, error_model="numpy", fastmath=FAST, **LENT)
_lent = inner(error_model="numpy", fastmath=FAST, **LENT)

LAST = 1.0 - 1.0 / np.sqrt(2.0)  #: part of the time of the second stage, and of the first up to where it is met
TO_NODE, TO_TURN = 2, 4  #: rows of Times, beside those of the step and of a part: to LAST of them, and to what is left


@_inline
def fill_stages(t, k, arms, times):
    """Fill the rows of Times that the two stages of a time t need, k as of `fill`."""
    fill(LAST * t, None, arms, times, TO_NODE + k)
    fill((1.0 - LAST) * t, None, arms, times, TO_TURN + k)


@_inline
def slip_back(g, R, soft):
    """Velocity of slip that takes a trial force g, a vector, back to its disc R; soft: force over this velocity."""
    size = size_of(g)
    return g * ((size - max(R, 0.0)) / (size * soft)) if size > max(R, 0.0) else 0.0j


@_inline
def rub_returned(s, e, i, w, pressing, T, modes, arms, tools, look):
    """Friction of spring i over a stretch of contact, as rub_line of line.py; top and surface on straight paths."""
    (z, _), (x, _), t, k, begun, _, _ = pressing
    if k == PART:
        fill_stages(t, k, arms, tools.times)
    u, node, turn = LAST * t, TO_NODE + k, TO_TURN + k
    soft, still = u + T, 0.0j
    if arms is not None:
        for j in range(arms.rho.size):
            soft += arms.rho[j] * tools.times.arms[node, 1, j]
    R = held_force(s, i, z, 0.0, u, node, T, tools, arms).v_1
    pressed, pressed_moment = hold(s, i, z, 0.0, t, k, T, tools, arms)
    slip = slip_back(held_force(e, i, x, still, u, node, T, tools, arms).v_1, R, soft)
    area, moment = hold(e, i, x - slip, still, t - u, turn, T, tools, arms)
    g = held_force(e, i, x, still, u, node, T, tools, arms).v_1
    slip = slip_back(g, end_force(s, i, z, T, arms), soft)
    late, late_moment = hold(e, i, x - slip, still, u, node, T, tools, arms)
    mode, n, vel = STICK, 0.0j, size_of(slip)
    stuck = t if vel == 0.0 else 0.0
    if vel > 0.0:
        mode, n = SLIP, g * (1.0 / size_of(g))
    moment += begun * area + (begun + t - u) * late + late_moment
    return Friction(mode, n, vel, area + late, moment, stuck, 0.5 * t * stuck, pressed, begun * pressed + pressed_moment)


@_lent
def returned(s, e, springs, path, T, modes, arms, tools, each):
    """A row of springs on a straight path: their Answer; s, e (1 + J, n), updated. tools: with stages of their step."""
    zd, xd = path.z_1, path.x_1
    return one_row(rub_returned, None, s, e, springs, path, zd, xd, T, modes, arms, tools, None, each, None)
