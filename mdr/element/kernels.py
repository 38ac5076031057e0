"""The compiled steps of a contact that is moved on straight lines: the spring's step of the library, and no other.

Way, depth and force are in scaled form: depth over the unit of depth, way over mu_0 kappa times that unit, stiffness
over that of all springs. So Coulomb's law has no coefficient. The normal part has no friction in it; it is done by
`press` beside the step, which also answers the area of the normal force.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.spring.law import Law
from mdr.spring.step import Path, new_tools, press, row, tools_of
from mdr.spring.turning import row_turning
from mdr.tools.arrays import Array
from mdr.tools.jit import compiled, inner

_jit = compiled(nogil=True, error_model="numpy", fastmath={"reassoc", "contract"})
_inline = inner(error_model="numpy", fastmath={"reassoc", "contract"})

N_HEAD = 4  #: numbers of a state before its springs: the last u, and the work
LEAST, MOST = 1e-7, 1e-5  #: by which a position is moved for a tangent, in scaled form
SHARE = 1e-3  #: of the motion in a step, between these
MOST_TRIALS = 100  #: of a depth under a load
BALANCED = 1e-13  #: share of the greatest load to which a load is met
SOON = 1e-6  #: of an interval, after which the force is looked at that a dashpot has at its start


class SpringRow(NamedTuple):
    """A row of n springs, and its units."""

    gap: Array  #: (n,) g over the unit of depth
    w: Array  #: (n,) share in the stiffness
    law: Law  #: its times in s
    length_x: float  #: mu_0 kappa times the unit of depth [m]
    length_z: float  #: unit of depth [m]
    force_x: float  #: of all springs stretched by length_x [N]
    force_z: float  #: [N]


class Straight(NamedTuple):
    """What a straight piece of motion leaves, in scaled form."""

    F_x: float  #: at its end
    F_y: float
    F_z: float
    area_x: float  #: over its time
    area_y: float
    area_z: float


@_inline
def carried(s, w, since, rate, T, arms):
    """Normal force of the springs at the end of a step, and the sum of the stiffnesses of those that carry it.

    since (n,): positive where a spring presses.
    """
    F_z = pressed = 0.0
    for i in range(w.size):
        normal = s[0, i] + T * rate
        if arms is not None:
            for j in range(arms.rho.size):
                normal += arms.rho[j] * s[1 + j, i]
        presses = since[i] > 0.0 and normal > 0.0
        F_z += w[i] * normal if presses else 0.0
        pressed += w[i] if presses else 0.0
    return F_z, pressed


@_inline
def straight(s, e, u, v, across, contact, T, modes, arms, tools, trial, since):
    """The springs s, e after a straight line from the scaled position u to v (3,); trial, since: room to work in.

    across: None for springs e (1 + J, n) that move along x alone.
    """
    h = tools.h
    path = Path(u[2], (v[2] - u[2]) / h, 0.0, (v[0] - u[0]) / h, 0.0)
    trial[:] = s
    area_z, _ = press(trial, contact.gap, contact.w, path, T, modes, arms, tools, since)
    if across is None:
        z_1, x_1 = path.z_1, path.x_1
        area, _, _, _, end, _, _ = row(s, e, contact.gap, contact.w, path, T, modes, arms, tools, z_1, x_1, None)
        ends, areas = (end, 0.0), (area, 0.0)
    else:
        of = row_turning(s, e, contact.gap, contact.w, path, (v[1] - u[1]) / h, 0.0, T, modes, arms, tools, None)
        ends, areas = (of.end_x, of.end_y), (of.area_x, of.area_y)
    F_z, _ = carried(s, contact.w, since, path.z_1, T, arms)
    return Straight(ends[0], ends[1], F_z, areas[0], areas[1], area_z)


@_jit
def steps(states, us, h, contact, forces, tangents):
    """A step of length h of m contacts that stand alike: states (m, n_state), changed, to positions us (m, 3) [m].

    forces (m, 3) [N] is filled, and tangents (m, 3, 3) [N/m] too if it is not empty.
    """
    n, (T, modes, arms) = contact.gap.size, contact.law
    tools, unit = new_tools(h, modes, arms), np.array([contact.length_x, contact.length_x, contact.length_z])
    force = np.array([contact.force_x, contact.force_x, contact.force_z])
    parts = (states.shape[1] - N_HEAD) // (3 * n)
    trial, since, before = np.empty((parts, n)), np.empty(n), np.empty(states.shape[1] - N_HEAD)
    ahead, near = np.empty(before.size), np.empty((2, 3))
    for b in range(us.shape[0]):
        springs = states[b, N_HEAD:]
        u, v = states[b, :3] / unit, us[b] / unit
        if tangents.size > 0:
            before[:] = springs
        s, e = springs[: parts * n].reshape(parts, n), springs[parts * n :].reshape(2 * parts, n)
        of = straight(s, e, u, v, unit, contact, T, modes, arms, tools, trial, since)
        now = np.array([of.F_x, of.F_y, of.F_z])
        forces[b], moved = force * now, (us[b] - states[b, :3]) / h
        area = np.array([of.area_x, of.area_y, of.area_z])
        states[b, 3] += (moved * force * area).sum()
        states[b, :3] = us[b]
        if tangents.size > 0:
            d = min(max(SHARE * np.abs(v - u).max(), LEAST), MOST)
            for j in range(3):
                side = v[j] - u[j]
                if side == 0.0 and j < 2:  # it goes on the way of the friction
                    side = now[j]
                side = -d if side < 0.0 else d
                for k in range(2):
                    ahead[:] = before
                    s, e = ahead[: parts * n].reshape(parts, n), ahead[parts * n :].reshape(2 * parts, n)
                    v[j] = us[b, j] / unit[j] + (k + 1) * side
                    of = straight(s, e, u, v, unit, contact, T, modes, arms, tools, trial, since)
                    near[k, 0], near[k, 1], near[k, 2] = of.F_x, of.F_y, of.F_z
                v[j] = us[b, j] / unit[j]
                tangents[b, :, j] = force * (4.0 * near[0] - near[1] - 3.0 * now) / (2.0 * side * unit[j])


@_inline
def depth_under(load, scale, s, z, ahead, contact, T, modes, arms, tools, trial, since):
    """Depth at the end of a step from z at which the springs carry a load: Newton's method within a bracket.

    Begins at z + ahead. scale: of loads. With a dashpot the force jumps where a spring touches, maybe over the load.
    """
    h, low, high, x, wider = tools.h, -np.inf, np.inf, z + ahead, LEAST
    for _ in range(MOST_TRIALS):
        trial[:] = s
        rate = (x - z) / h
        press(trial, contact.gap, contact.w, Path(z, rate, 0.0, 0.0, 0.0), T, modes, arms, tools, since)
        F_z, pressed = carried(trial, contact.w, since, rate, T, arms)
        off = F_z - load
        if abs(off) <= BALANCED * scale:
            break
        low, high = (low, x) if off > 0.0 else (x, high)
        if high - low <= 1e-15 * (1.0 + abs(x)):
            break
        stiff, after = pressed * (1.0 + T / h), x + wider
        if arms is not None:
            for j in range(arms.rho.size):
                stiff += pressed * arms.rho[j] * tools.held[0, 1, j] / h
        if stiff > 0.0:
            after = x - off / stiff
        else:  # nothing touches
            wider *= 2.0
        x = after if low < after < high else 0.5 * (low + high)
    return x


@_jit
def follow(s, e, u, t, x, y, depth, load, parts, contact, out, start, stop):
    """Follow a record from sample to sample, of the numbers start to stop; s (1 + J, n), e and u (3,), the scaled
    position, are changed.

    t, x (n_t,): instants [s], scaled way. y: the way across, or None for springs e (1 + J, n) with the step along one
    line. depth (n_t,): scaled, filled where there is a load (n_t,). parts: of an interval. out (n_t, 6): of Straight,
    the areas over the interval that ends there. With a dashpot the force jumps where the velocity does; at a sample of
    given depth stands the mean of both sides.
    """
    T, modes, arms = contact.law
    tools, viscous = new_tools(1.0, modes, arms), modes is not None
    trial, since, v = np.empty_like(s), np.empty(s.shape[1]), np.empty(3)
    scale, rate = load.max() if load.size > 0 else 1.0, 0.0
    s_near, e_near = np.empty_like(s), np.empty_like(e)
    for k in range(start + 1, stop + 1):
        dt = (t[k] - t[k - 1]) / parts
        h = dt if viscous else 1.0
        if h != tools.h:
            tools = tools_of(h, modes, arms, tools)
        if T > 0.0 and load.size == 0 and k > 1:
            s_near[:], e_near[:] = s, e
            v[0], v[2] = u[0] + SOON * (x[k] - x[k - 1]), u[2] + SOON * (depth[k] - depth[k - 1])
            soon = tools_of(SOON * (t[k] - t[k - 1]), modes, arms, tools)
            if y is not None:
                v[1] = u[1] + SOON * (y[k] - y[k - 1])
            of = straight(s_near, e_near, u, v, y, contact, T, modes, arms, soon, trial, since)
            out[k - 1, 0] = 0.5 * (out[k - 1, 0] + of.F_x)
            out[k - 1, 1] = 0.5 * (out[k - 1, 1] + of.F_y)
            out[k - 1, 2] = 0.5 * (out[k - 1, 2] + of.F_z)
        out[k, 3] = out[k, 4] = out[k, 5] = 0.0
        for part in range(parts):
            share = (part + 1) / parts
            v[0] = x[k - 1] + share * (x[k] - x[k - 1])
            if y is not None:
                v[1] = y[k - 1] + share * (y[k] - y[k - 1])
            if load.size > 0:
                under = load[k - 1] + share * (load[k] - load[k - 1])
                ahead = rate * h if under > 0.0 else 0.0
                v[2] = depth_under(under, scale, s, u[2], ahead, contact, T, modes, arms, tools, trial, since)
                rate = (v[2] - u[2]) / h
            else:
                v[2] = depth[k - 1] + share * (depth[k] - depth[k - 1])
            of = straight(s, e, u, v, y, contact, T, modes, arms, tools, trial, since)
            u[0], u[1], u[2] = v[0], v[1], v[2]
            out[k, 0], out[k, 1], out[k, 2] = of.F_x, of.F_y, of.F_z
            out[k, 3] += dt / h * of.area_x
            out[k, 4] += dt / h * of.area_y
            out[k, 5] += dt / h * of.area_z
        if load.size > 0:
            depth[k] = u[2]
