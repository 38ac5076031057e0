"""Friction in the plane, as disc.py, on a straight path by a return map: for steps of any length beside the
times of arms and dashpot.

A spring that would stick has the trial force g. Where g is longer than R = L[q], it slips with the velocity that brings
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

LAST = 1.0 - 1.0 / np.sqrt(2.0)  #: part of a time in which its second stage acts, and up to which the first is met
STAGES = 2  #: first of the rows of Times for a piece of the step, and of a part of it; three each
PIECE, NODE, TURN = 0, 1, 2  #: these: for all of a piece, up to LAST of it, and up to where the second stage begins


@_inline
def fill_stages(t, k, arms, times):
    """Fill the rows of Times for a piece of the time t, k as of `fill`."""
    piece, at = t / times.pieces, STAGES + 3 * k
    fill(piece, None, arms, times, at + PIECE)
    fill(LAST * piece, None, arms, times, at + NODE)
    fill((1.0 - LAST) * piece, None, arms, times, at + TURN)


@_inline
def slip_back(g, R, soft):
    """Velocity of slip that takes a trial force g, a vector, back to its disc R; soft: force over this velocity."""
    size = size_of(g)
    return g * ((size - max(R, 0.0)) / (size * soft)) if size > max(R, 0.0) else 0.0j


@_inline
def rub_returned(q, e, limit, i, w, pressing, T, modes, arms, tools, look):
    """Friction of spring i over a stretch of contact, as rub_line of line.py, in `tools.times.pieces`; top and surface
    are on straight paths.
    """
    (z, _), (x, _), t, k, begun, _, _ = pressing
    if k == PART:
        fill_stages(t, k, arms, tools.times)
    piece, at = t / tools.times.pieces, STAGES + 3 * k
    u, now, straight = LAST * piece, begun, 0.0j
    soft = u + T
    if arms is not None:
        for j in range(arms.rho.size):
            soft += arms.rho[j] * tools.times.arms[at + NODE, 1, j]
    area, moment, stuck, stuck_moment, borne, borne_moment = 0.0j, 0.0j, 0.0, 0.0, 0.0, 0.0
    mode, n, vel = STICK, 0.0j, 0.0
    for _ in range(tools.times.pieces):
        R = held_force(q, i, z, 0.0, u, at + NODE, T, tools, arms).v_1
        A, B = hold(q, i, z, 0.0, piece, at + PIECE, T, tools, arms)
        borne, borne_moment = borne + A, borne_moment + now * A + B
        slip = slip_back(held_force(e, i, x, straight, u, at + NODE, T, tools, arms).v_1, R, soft)
        early, lever = hold(e, i, x - slip, straight, piece - u, at + TURN, T, tools, arms)
        moment += now * early + lever
        g = held_force(e, i, x, straight, u, at + NODE, T, tools, arms).v_1
        slip = slip_back(g, end_force(q, i, z, T, arms), soft)
        late, lever = hold(e, i, x - slip, straight, u, at + NODE, T, tools, arms)
        area, moment, vel = area + early + late, moment + (now + piece - u) * late + lever, size_of(slip)
        mode, n = STICK, 0.0j
        if vel > 0.0:
            mode, n = SLIP, g * (1.0 / size_of(g))
        else:
            stuck, stuck_moment = stuck + piece, stuck_moment + piece * (now + 0.5 * piece)
        now += piece
    return Friction(mode, n, vel, area, moment, stuck, stuck_moment, (borne, borne_moment))


@_lent
def returned(s, e, springs, path, T, modes, arms, tools, each):
    """A row of springs on a straight path: their Answer; s, e (1 + J, n), updated. tools: with stages of their step."""
    zd, xd = path.z_1, path.x_1
    return one_row(rub_returned, None, s, e, springs, None, path, (zd, xd), T, modes, arms, tools, None, each, None)
