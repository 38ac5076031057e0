"""The compiled steps of a contact that is moved on straight lines: the spring's step of the library, and no other.

Way, depth and force are in scaled form: depth over the unit of depth, way over mu_0 kappa times that unit, stiffness
over that of all springs. So Coulomb's law has no coefficient.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from mdr.element.cuts import MOST_PARTS, Cuts, Pulled, cut, cut_again
from mdr.spring.contact import Each, Springs, press
from mdr.spring.copies import put
from mdr.spring.law import Law
from mdr.spring.limit import Strength, give_modes, of_springs, step_over, stick_of, take_modes
from mdr.spring.motion import glassy
from mdr.spring.path import Path
from mdr.spring.row import row
from mdr.spring.times import STEP, new_tools, tools_of
from mdr.tools.arrays import SAME, Array
from mdr.tools.compiler import Complex, NoneType, overload
from mdr.tools.jit import compiled, inner
from mdr.tools.linked import LINKED

_jit = compiled(nogil=True, error_model="numpy", fastmath={"reassoc", "contract"})
_inline = inner(error_model="numpy", fastmath={"reassoc", "contract"})
_LINKED: Any = {"error_model": "numpy", "fastmath": {"reassoc", "contract"}, **LINKED}

N_HEAD = 4  #: numbers of a state before its springs: the last u, and the work; behind them is the mark of its element
NOT_FINITE, OF_ANOTHER, IMPOSSIBLE, BEYOND = 1, 2, 3, 4  #: faults of a state, and of what comes out of a step
LEAST_MOVED, MOST_MOVED = 1e-9, 1e-7  #: by which a position is moved for a tangent, in scaled form
SHARE = 1e-3  #: of the motion in a step, between these
EVEN = 3e-7  #: of the stiffness of the contact, by which the rate of the force of a spring may change on such a way
NEARER, FARTHER = 2, 4  #: looks, each at a tenth, to tell the end of the step from an event near it; and beyond one
MOST_TRIALS = 100  #: of a depth under a load
WIDER = 1e-7  #: first way to where something touches, of ways that double
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
    limit: Strength | None = None  #: of friction that falls, and modes of the springs; None of Coulomb's


def straight(s, e, z_0, way_x, way_z, contact, T, modes, arms, tools, each, cuts):
    """The springs s, e after a straight way, scaled, from the depth z_0: what they are Pulled by. e is complex in the
    plane, where a step with arms is cut into parts: by `cuts`; None, or one of no parts yet, has them found.
    """
    of = _cut if arms is not None and np.iscomplexobj(e) else _at_once
    return of(s, e, z_0, way_x, way_z, contact, T, modes, arms, tools, each, cuts)


@overload(straight, jit_options=_LINKED)
def _(s, e, z_0, way_x, way_z, contact, T, modes, arms, tools, each, cuts):
    return _at_once if isinstance(arms, NoneType) or not isinstance(e.dtype, Complex) else _cut


def _at_once(s, e, z_0, way_x, way_z, contact, T, modes, arms, tools, each, cuts):
    h = tools.times.h
    z_1, x_1 = way_z / h, way_x / h
    path = Path(z_0, z_1, 0.0, x_1, 0.0 * x_1)
    springs, limit = Springs(contact.gap, contact.w), contact.limit
    of = row(s, e, springs, limit, path, z_1, x_1, T, modes, arms, tools, None, each, None)
    return Pulled(of.end, of.normal_end, of.area, of.normal_area)


def _cut(s, e, z_0, way_x, way_z, contact, T, modes, arms, tools, each, cuts):
    z_1, x_1 = way_z / tools.times.h, way_x / tools.times.h
    if cuts is not None and cuts.n[0] > 0:
        return cut_again(s, e, z_0, z_1, x_1, contact, T, modes, arms, tools, each, cuts)
    return cut(s, e, z_0, z_1, x_1, contact, T, modes, arms, tools, each, cuts)


class Room(NamedTuple):
    """Room to work in, for n springs of 1 + J parts."""

    s: Array  #: (1 + J, n)
    e: Array  #: (1 + J, n), complex
    each: Each
    F: Array  #: (3, 3, n) forces at the end of three steps, over the stiffness of each spring


@_inline
def room_for(parts, n):
    """Room for n springs."""
    each = Each(np.empty(n), np.empty(n, np.complex128), np.empty(n))
    return Room(np.empty((parts, n)), np.empty((parts, n), np.complex128), each, np.empty((3, 3, n)))


@_inline
def some_of(row, first, end):
    """Some springs of a row, with modes of their own where friction falls."""
    gap, w, limit = row.gap[first:end], row.w[first:end], of_springs(row.limit, first, end)
    return SpringRow(gap, w, row.law, row.length_x, row.length_z, row.force_x, row.force_z, limit)


@_inline
def parts_of(n_state, n):
    """Compression or extension, and arms, of one of n springs in a state of so many numbers."""
    return (n_state - N_HEAD - 1) // (3 * n)


@_jit
def fault(state, contact, mark):
    """What is wrong with a state (n_state,) of these springs, a number; zero for nothing.

    A spring in contact is as short as the gap left to it, one that flies is shorter, and none was ever shorter than at
    the greatest depth. Without a memory of the material none flies compressed, and the extension is within the
    compression, as is the force; in stick up to a multiple, where friction falls.
    """
    n, rounding, stick = contact.gap.size, 2 * SAME, stick_of(contact.limit)
    parts = parts_of(state.size, n)
    for one in state:
        if not np.isfinite(one):
            return NOT_FINITE
    if state[-1] != mark:
        return OF_ANOTHER
    depth, fits = state[2] / contact.length_z, True
    for i in range(n):
        s, x, y = state[N_HEAD + i], state[N_HEAD + parts * n + i], state[N_HEAD + 2 * parts * n + i]
        most = 1.0 - contact.gap[i] + rounding
        fits &= (s >= max(depth - contact.gap[i], 0.0) - rounding) & (s <= most)
        if parts == 1 and contact.law.T == 0.0:
            fits &= (s <= max(depth - contact.gap[i], 0.0) + rounding) & (x * x + y * y <= (stick * s + rounding) ** 2)
    return 0 if fits else IMPOSSIBLE


@_inline
def forces(each, F):
    """Fill F (3, n) with the forces of the springs over their stiffness."""
    for i in range(each.f.size):
        F[0, i], F[1, i], F[2, i] = each.f[i].real, each.f[i].imag, each.f_z[i]


@_inline
def moved(s, e, z_0, way, contact, T, modes, arms, tools, room, cuts):
    """The springs s, e, which are left as they are, after a straight way (3,) from the depth z_0, in the room."""
    put(s, room.s)
    put(e, room.e)
    in_plane, each = complex(way[0], way[1]), room.each
    return straight(room.s, room.e, z_0, in_plane, way[2], contact, T, modes, arms, tools, each, cuts)


@_inline
def looks_ahead(s, e, z_0, way, j, d, contact, T, modes, arms, tools, room, cuts):
    """Forces after a way, which stand in room.F[0], and after ways that are d and 2 d longer along the axis j."""
    there = way.copy()
    for k in range(1, 3):
        there[j] = way[j] + k * d
        moved(s, e, z_0, there, contact, T, modes, arms, tools, room, cuts)
        forces(room.each, room.F[k])


@_inline
def bends(F, i):
    """By how much the force of spring i changes more from the second to the third look than before."""
    most = 0.0
    for k in range(3):
        most = max(most, abs(F[2, k, i] - 2.0 * F[1, k, i] + F[0, k, i]))
    return most


@_inline
def slope(F, k, i, d):
    """Derivative of force k of spring i at the first of three looks, of second order."""
    return (4.0 * F[1, k, i] - F[2, k, i] - 3.0 * F[0, k, i]) / (2.0 * d)


@_inline
def rates(K, j, d, s, e, z_0, way, contact, T, modes, arms, tools, room, alone, cuts):
    """Fill K[:, j] with the derivatives of the scaled forces by the way along the axis j, from the side of d.

    Each spring is asked for itself. One that does not go on evenly is asked again nearer by; if it never does, it
    switches here, and the derivative beyond counts: the first that a spring can have, as steps with arms may jump there
    by their error.
    """
    looks_ahead(s, e, z_0, way, j, d, contact, T, modes, arms, tools, room, cuts)
    even, stiffest = EVEN * abs(d) * (1.0 + T / tools.times.h), glassy(arms) + T / tools.times.h
    for k in range(3):
        K[k, j] = 0.0
    for i in range(contact.gap.size):
        w, done, near = contact.w[i], contact.w[i] * bends(room.F, i) <= even, d
        if done:
            for k in range(3):
                K[k, j] += w * slope(room.F, k, i, d)
            continue
        one = some_of(contact, i, i + 1)
        own_s, own_e = s[:, i : i + 1].copy(), e[:, i : i + 1].copy()
        for k in range(3):
            alone.F[0, k, 0] = room.F[0, k, i]
        for look in range(NEARER + FARTHER):
            near = d * 0.1 ** (look + 1) if look < NEARER else d * 10.0 ** (look - NEARER)
            looks_ahead(own_s, own_e, z_0, way, j, near, one, T, modes, arms, tools, alone, cuts)
            if look < NEARER:
                done = w * bends(alone.F, 0) <= even * abs(near / d)
            change, most = 0.0, stiffest * abs(near)
            for k in range(3):
                change = max(change, abs(alone.F[2, k, 0] - alone.F[1, k, 0]))
            if done or (look >= NEARER and change <= most):
                break
        part = min(1.0, most / change) if change > 0.0 else 1.0
        for k in range(3):
            beyond = part * (alone.F[2, k, 0] - alone.F[1, k, 0]) / near
            K[k, j] += w * (slope(alone.F, k, 0, near) if done else beyond)


@_jit
def steps(states, us, h, contact, mark, pull, tangents):
    """A step of length h of m contacts that stand alike: states (m, n_state), changed, to positions us (m, 3) [m].

    pull (m, 3) [N] is filled, and tangents (m, 3, 3) [N/m] too if it is not empty. Answers 0, or what is wrong with a
    state or with what comes out.
    """
    n, (T, modes, arms) = contact.gap.size, contact.law
    contact = some_of(contact, 0, n)
    tools, unit = new_tools(h, modes, arms, 0j, n), (contact.length_x, contact.length_x, contact.length_z)
    force = contact.force_x, contact.force_x, contact.force_z
    parts = parts_of(states.shape[1], n)
    room, alone, K, way = room_for(parts, n), room_for(parts, 1), np.empty((3, 3)), np.empty(3)
    s, e, cuts = (
        np.empty((parts, n)),
        np.empty((parts, n), np.complex128),
        Cuts(np.empty(MOST_PARTS), np.zeros(1, np.int64)),
    )
    new_s, new_e = np.empty_like(s), np.empty_like(e)
    for b in range(us.shape[0]):
        state, finite = states[b], True
        wrong = fault(state, contact, mark)
        if wrong != 0:
            return wrong
        for j in range(parts):
            for i in range(n):
                at = N_HEAD + j * n + i
                s[j, i], e[j, i] = state[at], complex(state[at + parts * n], state[at + 2 * parts * n])
        of_modes, z_0 = state[N_HEAD + 3 * parts * n : -1], state[2] / contact.length_z  # none but where friction falls
        take_modes(contact.limit, of_modes)
        for k in range(3):
            way[k] = us[b, k] / unit[k] - state[k] / unit[k]
        cuts.n[0] = 0
        of = moved(s, e, z_0, way, contact, T, modes, arms, tools, room, cuts)
        now, area = (of.end.real, of.end.imag, of.normal_end), (of.area.real, of.area.imag, of.normal_area)
        put(room.s, new_s)
        put(room.e, new_e)
        give_modes(contact.limit, of_modes)
        if tangents.size > 0:
            forces(room.each, room.F[0])
            far = max(abs(way[0]), abs(way[1]), abs(way[2]))
            d = MOST_MOVED * max(far, 1.0)
            if far > 0.0:  # at rest springs switch at no distance, or at a finite one
                d = min(d, max(SHARE * far, LEAST_MOVED))
            for j in range(3):
                side = way[j]
                if side == 0.0 and j < 2:  # it goes on the way of the friction
                    side = now[j]
                d_j = -d if side < 0.0 else d
                rates(K, j, d_j, s, e, z_0, way, contact, T, modes, arms, tools, room, alone, cuts)
                for k in range(3):
                    tangents[b, k, j] = force[k] * K[k, j] / unit[j]
                    finite &= np.isfinite(tangents[b, k, j])
        work = 0.0
        for k in range(3):
            pull[b, k] = force[k] * now[k]
            finite &= np.isfinite(pull[b, k])
            work += (us[b, k] - state[k]) / h * force[k] * area[k]
            state[k] = us[b, k]
        state[3] += work
        for j in range(parts):
            for i in range(n):
                at, one = N_HEAD + j * n + i, new_e[j, i]
                state[at], state[at + parts * n], state[at + 2 * parts * n] = new_s[j, i], one.real, one.imag
        for number in state:
            finite &= np.isfinite(number)
        if not finite:
            return BEYOND
    return 0


@_inline
def depth_under(load, scale, s, z, ahead, contact, T, modes, arms, tools, trial):
    """Depth at the end of a step from z at which the springs carry a load: Newton's method within a bracket.

    Begins at z + ahead. scale: of loads. With a dashpot the force jumps where a spring touches, maybe over the load.
    """
    h, low, high, x, wider = tools.times.h, -np.inf, np.inf, z + ahead, WIDER
    for _ in range(MOST_TRIALS):
        put(s, trial)
        rate = (x - z) / h
        springs, path = Springs(contact.gap, contact.w), Path(z, rate, 0.0, 0.0, 0.0)
        of = press(trial, springs, path, rate, T, modes, arms, tools, None)
        off = of.normal_end - load
        if abs(off) <= BALANCED * scale:
            break
        low, high = (low, x) if off > 0.0 else (x, high)
        if high - low <= 1e-15 * (1.0 + abs(x)):
            break
        stiff, after = of.pressed * (1.0 + T / h), x + wider
        if arms is not None:
            for j in range(arms.rho.size):
                stiff += of.pressed * arms.rho[j] * tools.times.arms[STEP, 1, j] / h
        if stiff > 0.0:
            after = x - off / stiff
            if after == x:  # met to the rounding of the depth, which a dashpot is stiff enough to show in a short step
                break
        else:  # nothing touches
            wider *= 2.0
        x = after if low < after < high else 0.5 * (low + high)
    return x


@_jit
def follow(s, e, t, x, depth, load, parts, contact, out, start, stop):
    """Follow a record from sample to sample, of the numbers start to stop; s, e (1 + J, n) are changed, and the modes
    of contact.limit.

    t, x (n_t,): instants [s], scaled way; x and e are complex in the plane. depth
    (n_t,): scaled, filled where there is a load (n_t,). parts: of an interval. out (n_t, 6): force at each sample, and
    its area over the interval that ends there. With a dashpot the force jumps where the velocity does; at a sample of
    given depth stands the mean of both sides.
    """
    T, modes, arms = contact.law
    tools, viscous = new_tools(1.0, modes, arms, 0.0 * x[0], contact.gap.size), modes is not None
    trial, s_near, e_near = np.empty_like(s), np.empty_like(s), np.empty_like(e)
    scale, rate, z = load.max() if load.size > 0 else 1.0, 0.0, depth[start]
    for k in range(start + 1, stop + 1):
        dt, x_0, z_0 = (t[k] - t[k - 1]) / parts, x[k - 1], depth[k - 1]
        h = dt if viscous else 1.0
        if h != tools.times.h:
            tools = tools_of(h, modes, arms, tools)
        if T > 0.0 and load.size == 0 and k > 1:
            put(s, s_near)
            put(e, e_near)
            soon, way = tools_of(SOON * (t[k] - t[k - 1]), modes, arms, tools), SOON * (x[k] - x_0)
            sinks = SOON * (depth[k] - z_0)
            of = straight(s_near, e_near, z, way, sinks, contact, T, modes, arms, soon, None, None)
            out[k - 1, 0] = 0.5 * (out[k - 1, 0] + of.end.real)
            out[k - 1, 1] = 0.5 * (out[k - 1, 1] + of.end.imag)
            out[k - 1, 2] = 0.5 * (out[k - 1, 2] + of.normal_end)
        out[k, 3] = out[k, 4] = out[k, 5] = 0.0
        x_1 = x_0
        for part in range(parts):
            share = (part + 1) / parts
            x_2, z_2 = x_0 + share * (x[k] - x_0), z_0 + share * (depth[k] - z_0)
            if load.size > 0:
                under = load[k - 1] + share * (load[k] - load[k - 1])
                ahead = rate * h if under > 0.0 else 0.0
                z_2 = depth_under(under, scale, s, z, ahead, contact, T, modes, arms, tools, trial)
                rate = (z_2 - z) / h
            of = straight(s, e, z, x_2 - x_1, z_2 - z, contact, T, modes, arms, tools, None, None)
            step_over(contact.limit)
            x_1, z = x_2, z_2
            out[k, 0], out[k, 1], out[k, 2] = of.end.real, of.end.imag, of.normal_end
            out[k, 3] += dt / h * of.area.real
            out[k, 4] += dt / h * of.area.imag
            out[k, 5] += dt / h * of.normal_area
        if load.size > 0:
            depth[k] = z
