"""A row of springs over one step of time. Each presses or flies; friction is a function that is handed in.

The indenter carries the springs: the top of each moves with it, its foot touches the plane. In a step the top moves on
parabolas, z_1 t + z_2 t² down and x_1 t + x_2 t² in the plane. With the compression s, the extension e and the law L of
the material (law.py) a spring

* *presses*: s goes with the top, until its force L[s] comes to zero;
* *flies*: s and e recover without force, L[s] = L[e] = 0, until the indenter meets the surface again, z - gap = s.

All is scaled: normal lengths by some unit, tangential ones by mu_0 kappa times it, forces by the long-time stiffness,
so that Coulomb's law is |L[e]| <= L[s].

While it presses, friction changes e. `rub` (line.py, disc.py) computes this over a stretch of contact, under the limit
of a state q (limit.py); None leaves it out.
What happens is exact from event to event along a line, so that the only error of a step there is that of the parabolas;
slip that turns (dragged.py) and a strength (limit.py) are met to some order in the step. Elastic springs, dashpots
(Kelvin) and Maxwell arms are one text: what a material lacks is None, and compiled away.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.spring.contact_modes import FREE, SLIP_BACK, STICK
from mdr.spring.energies import (
    CONTACT_IMPULSE,
    FRICTION_LOSS,
    LEAST_SLIP,
    NORMAL_VISCOUS,
    NORMAL_WORK,
    SHEAR_VISCOUS,
    Nodes,
    lost_on_parabola,
    stored,
)
from mdr.spring.limit import Pressing, at_limit, keep_mode, limit_at, normal_part, stick_of
from mdr.spring.motion import alone, end_force, glassy, held_force, hold, into_modes, relax, until_alone, until_held
from mdr.spring.path import (
    FAST,
    LENT,
    NEVER,
    ROUNDING,
    along,
    below,
    on_parabola,
    plus,
    size_of,
    stays,
)
from mdr.spring.times import PART, STEP, fill
from mdr.tools.arrays import Array
from mdr.tools.jit import inner

_inline = inner(forceinline=True, error_model="numpy", fastmath=FAST, **LENT)
_lent = inner(error_model="numpy", fastmath=FAST, **LENT)

MOST_EVENTS = 100  #: of a spring in one step or stretch of contact; what comes after the last would be left out


class Springs(NamedTuple):
    """A row of springs."""

    gap: Array  #: (n,) motion z of the indenter at which each foot meets the surface
    w: Array  #: (n,) share of each spring in the stiffness


class Answer(NamedTuple):
    """Answer of a row of springs to a step: sums over the springs, each weighted by its share of the stiffness.

    The area of a force is its integral over the time, an impulse, and its moment the integral of f t, with t from the
    start of the step. Tangential ones are numbers along a line, vectors in the plane.
    """

    area: complex  #: integral of the tangential force over the step
    moment: complex  #: its moment in time
    end: complex  #: the force at the end
    stuck: float  #: time in stick, averaged over the springs
    stuck_moment: float  #: integral of t over it
    sticking: float  #: share of the stiffness that sticks at the end
    back: float  #: share that slips back there
    normal_area: float  #: of the normal force
    normal_moment: float
    normal_end: float
    pressed: float  #: share that bears a normal force at the end


class Friction(NamedTuple):
    """Friction over a stretch of contact."""

    mode: int  #: at its end
    n: complex  #: direction of the tangential force there, a unit vector or ±1, where the spring slips
    vel: float  #: slip velocity there, where it is asked for
    area: complex  #: integral of the tangential force over the stretch
    moment: complex  #: its moment in time, from the start of the step
    stuck: float  #: time in stick
    stuck_moment: float  #: integral of t over it
    borne: tuple[float, float]  #: area and moment of L[q]; for the row, of the normal force


class Each(NamedTuple):
    """State of each of n springs at the end of a step; filled only on request."""

    pressed_for: Array  #: (n,) share of the step for which it has pressed since it last touched; zero in flight
    f: Array  #: (n,) tangential force over its stiffness
    f_z: Array  #: (n,) normal force likewise


class Look(NamedTuple):
    """Detailed output of a step of n springs; filled only on request."""

    nodes: Nodes  #: over the whole step
    sums: Array  #: (N_SUMS,) totals that the step adds to
    F: Array  #: (4,) at the end: force along, normal force, least (signed) slip velocity in contact, force across
    mode: Array  #: (n,) of each spring at the end of the step
    f: Array  #: (n,) its tangential force over its stiffness: numbers along a line, vectors in the plane
    f_z: Array  #: (n,) its normal force likewise


@_inline
def lasts(presses, event, s, i, z, t, k, tol, G, T, modes, arms, tools):
    """Contact of spring i over a time t: whether it presses from now on, and the time to where it is let go, or
    touches; infinite where neither happens. At the start of a step one that touches may have to be let go at once;
    later the event before has decided that. z: of the parabola of the depth to which it is pressed.
    """
    x, (z_0, z_1, z_2), until, fallen, rate, of_force = s[0, i], z, NEVER, 0.0, 0.0, tol * G
    if presses:
        normal = held_force(s, i, z_1, z_2, t, k, T, tools, arms)
        presses = event > 0 or not below(normal, of_force)
    if presses and not stays(normal, t, of_force):
        until = until_held(normal, x, s, s, i, 1.0, 0.0, z_1, z_2, t, of_force, T, modes, arms, tools)
    if not presses:
        if arms is not None:
            left, _ = into_modes(s, s, i, 0.0, k, tools, modes)
        else:
            if modes is not None:
                rate, fallen = modes.mu[0], tools.times.decay[k, 0]
            left, _ = alone(x, rate, fallen)
        apart = plus(left, -1.0, on_parabola(z_0, z_1, z_2, 0.0, t))
        if not stays(apart, t, tol):
            until = until_alone(apart, -z_0, -z_1, -z_2, x, np.bool_(False), t, tol, modes, arms, tools)
    return presses, until


@_inline
def direction(a):
    """Unit vector of a vector, or sign of a number; zero of zero."""
    size = size_of(a)
    return a / size if size > 0.0 else 0.0 * a


@_inline
def within(f, R):
    """A force, no longer than R."""
    return f * (R / size_of(f)) if along(f, f) > R * R else f


@_inline
def pressed_on(rub, limit, s, e, i, w, pressing, T, modes, arms, tools, look):
    """A stretch of contact of spring i: its Friction, by `rub`, and its normal part; s and e are updated."""
    (z_1, z_2), t, begun = pressing.z, pressing.t, pressing.begun
    if rub is None:
        area, moment = hold(s, i, z_1, z_2, t, pressing.k, T, tools, arms)
        nothing = 0.0 * pressing.x[0]
        return Friction(STICK, nothing, 0.0, nothing, nothing, 0.0, 0.0, (area, begun * area + moment))
    if look is not None:
        lost = lost_on_parabola(s, i, z_1, z_2, t, tools.times.h, look.nodes, T, modes, arms)
        look.sums[NORMAL_VISCOUS] += w * lost
    q, of_q, beside = at_limit(limit, s, e, i, pressing, T, arms, tools)
    of = rub(q, e, limit, i, w, of_q, T, modes, arms, tools, look)
    area, moment = normal_part(limit, of.borne, beside)
    if look is not None:
        look.sums[CONTACT_IMPULSE] += w * of.borne[0]
        look.sums[NORMAL_WORK] += w * ((z_1 - 2.0 * z_2 * begun) * area + 2.0 * z_2 * moment)
    return Friction(of.mode, of.n, of.vel, of.area, of.moment, of.stuck, of.stuck_moment, (area, moment))


@_inline
def fly(s, e, i, w, k, modes, arms, tools, look):
    """Leave spring i alone for a time."""
    before = 0.0, 0.0
    if look is not None and modes is not None:
        before = stored(s, i, arms), stored(e, i, arms)
    if look is not None and modes is None:  # a shear strength may let it go with a force: it springs back
        look.sums[FRICTION_LOSS] += w * stored(e, i, arms)
    relax(s, i, k, modes, arms, tools.room.modes, tools.times)
    if e is not None:
        relax(e, i, k, modes, arms, tools.room.vectors, tools.times)
    if look is not None and modes is not None:
        look.sums[NORMAL_VISCOUS] += w * (before[0] - stored(s, i, arms))
        look.sums[SHEAR_VISCOUS] += w * (before[1] - stored(e, i, arms))


@_inline
def at_end(rub, limit, s, e, i, mode, n, rates, h, T, arms):
    """Normal force and friction of spring i at the end of a step, in this mode; n: direction of its slip."""
    R, f = 0.0, 0.0 * n
    if mode != FREE:
        R = max(end_force(s, i, rates[0], T, arms), 0.0)
        if rub is not None:
            most = limit_at(limit, i, R, h)
            held = end_force(e, i, rates[1], T, arms)
            f = within(held, stick_of(limit) * most) if mode == STICK else n * most
    return R, f


@_inline
def one_row(rub, made, s, e, springs, limit, path, rates, T, modes, arms, tools, lumped, each, look):
    """Springs over a step; s and e (1 + J, n) are updated: row 0 the spring, the others its arms. An Answer comes out.

    rub: function of the friction over a stretch of contact, rub_line or rub_disc; or None, as e, for the normal part
    alone. made (n,): not zero for springs that were stepped already; or None. rates: those of the top at the end. T,
    modes, arms: of the law (law.py). The others as of row.py. What is None is compiled away.
    """
    gap, w, h, G = springs.gap, springs.w, tools.times.h, glassy(arms)
    area = moment = end = nothing = 0.0 * path.x_1  # a number or a vector
    stuck = stuck_moment = sticking = back = 0.0
    normal_area = normal_moment = normal_end = pressed = 0.0
    if look is not None:
        look.F[2] = np.inf
    rate_miss = (rates[0] - path.z_1 - 2.0 * path.z_2 * h, rates[1] - path.x_1 - 2.0 * path.x_2 * h)
    for i in range(gap.size):
        if made is not None and made[i] != 0.0:
            continue
        tol = ROUNDING * (1.0 + abs(gap[i]))
        z_0, z_1, t, done, k, pressed_for, mode = path.z_0 - gap[i], path.z_1, h, 0.0, STEP, 0.0, FREE
        n, vel = nothing, 0.0
        presses = s[0, i] <= z_0 + tol
        if presses:
            s[0, i] = z_0
        for event in range(MOST_EVENTS):
            z = z_0, z_1, path.z_2
            presses, until = lasts(presses, event, s, i, z, t, k, tol, G, T, modes, arms, tools)
            ends = until < t
            if ends:
                t, k = until, PART
                fill(t, modes, arms, tools.times, PART)
            if not presses:
                mode, pressed_for = FREE, 0.0
                fly(s, e, i, w[i], k, modes, arms, tools, look)
            elif t > ROUNDING * h:
                x = path.x_1 + 2.0 * path.x_2 * done, path.x_2
                pressing = Pressing((z_1, path.z_2), x, t, k, done, tol, rate_miss)
                of = pressed_on(rub, limit, s, e, i, w[i], pressing, T, modes, arms, tools, look)
                mode, n, vel, pressed_for = of.mode, of.n, of.vel, pressed_for + t
                area, moment = area + w[i] * of.area, moment + w[i] * of.moment
                stuck, stuck_moment = stuck + w[i] * of.stuck, stuck_moment + w[i] * of.stuck_moment
                normal_area, normal_moment = normal_area + w[i] * of.borne[0], normal_moment + w[i] * of.borne[1]
            if not ends:
                break
            if look is not None and presses and t > ROUNDING * h:
                look.sums[LEAST_SLIP] = min(look.sums[LEAST_SLIP], vel)
            done += t
            z_0, z_1, presses = z_0 + t * (z_1 + t * path.z_2), z_1 + 2.0 * path.z_2 * t, not presses
            if presses:
                if e is not None:  # corrected as s is, so that a spring at its limit stays there
                    e[0, i] += direction(e[0, i]) * (z_0 - s[0, i])
                s[0, i] = z_0
            t, k = h - done, PART
            fill(t, modes, arms, tools.times, PART)
        keep_mode(limit, i, mode)
        R, f = at_end(rub, limit, s, e, i, mode, n, rates, h, T, arms)
        if mode != FREE:
            end, normal_end, pressed = end + w[i] * f, normal_end + w[i] * R, pressed + (w[i] if R > 0.0 else 0.0)
            sticking, back = sticking + (w[i] if mode == STICK else 0.0), back + (w[i] if mode == SLIP_BACK else 0.0)
            if lumped is not None:
                for j in range(s.shape[0]):
                    left = e[j, i] - s[j, i] if mode == STICK else -2.0 * s[j, i] if mode == SLIP_BACK else 0.0
                    lumped[j, 0] += w[i] * left
        if each is not None:
            each.pressed_for[i], each.f[i], each.f_z[i] = pressed_for / h if h > 0.0 else 0.0, f, R
        if look is not None:
            if mode != FREE:
                look.F[2] = min(look.F[2], vel)
            look.mode[i], look.f[i], look.f_z[i] = mode, f, R
    if look is not None:
        look.F[0], look.F[1], look.F[3] = end.real, normal_end, end.imag
    return Answer(
        area, moment, end, stuck, stuck_moment, sticking, back, normal_area, normal_moment, normal_end, pressed
    )


@_lent
def press(s, springs, path, zd, T, modes, arms, tools, each):
    """The normal part of `row` (row.py) alone; s is updated."""
    return one_row(None, None, s, None, springs, None, path, (zd, 0.0), T, modes, arms, tools, None, each, None)
