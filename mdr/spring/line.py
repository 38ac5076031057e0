"""Friction along a line, of a q that is known (limit.py; mu_0 is in the unit of e), over a stretch of contact, exact
from event to event.

=========  ===========  =======================  =====================================
mode       what moves   what is left alone       it ends where
=========  ===========  =======================  =====================================
stick      e with x     nothing                  |L[e]| comes to stick L[q]: slip
slip       e with q     q - e (so L[e] = L[q])   the slip velocity x' - e' is zero: stick
slip back  e with -q    q + e (L[e] = -L[q])     likewise
=========  ===========  =======================  =====================================

Where friction falls, stick is above 1, and a spring that is let go (`let_go`) has its force fall to L[q] at once.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

import numpy as np

from mdr.spring.contact import MOST_EVENTS, Friction
from mdr.spring.contact_modes import SLIP, SLIP_BACK, STICK
from mdr.spring.energies import (
    FRICTION_LOSS,
    LEAST_SLIP,
    SHEAR_VISCOUS,
    STICK_IMPULSE,
    lost_on_parabola,
    of_slipping,
    stored,
)
from mdr.spring.limit import stick_of
from mdr.spring.motion import alone, held_force, hold, into_modes, of_modes, until_alone, until_held
from mdr.spring.path import FAST, LENT, NEVER, below, on_parabola, plus, stays, times
from mdr.spring.times import PART, fill
from mdr.tools.jit import inner

_inner = inner(error_model="numpy", fastmath=FAST, **LENT)
_inline = inner(forceinline=True, error_model="numpy", fastmath=FAST, **LENT)

BEGINS = -1  #: the mode is still to be found


@_inner
def slip_velocity(mode, q, e, i, share, z_1, x_1, rate_miss, modes):
    """Velocity of the foot over the plane: zero in stick, positive in slip, negative in slip back.

    share: time from the start of the step, over h. z_1, x_1: rates of the parabolas then. The true path is a cubic: its
    rates differ from theirs by rate_miss at the start and the end of the step, in between by
    rate_miss (1 - 6 share (1 - share)), so that both are at the same places at both ends.
    """
    if mode == STICK:
        return 0.0
    sign, rate, bend = -1.0 if mode == SLIP_BACK else 1.0, 0.0, 1.0 - 6.0 * share * (1.0 - share)
    if modes is not None:
        for k in range(modes.mu.size):
            m = 0.0
            for j in range(q.shape[0]):
                m += modes.into[k, j] * (q[j, i] - sign * e[j, i])
            rate -= modes.mu[k] * modes.out[0, k] * m
    return sign * (sign * (x_1 + bend * rate_miss[1]) - (z_1 + bend * rate_miss[0]) + rate)


@_inline
def mode_at_begin(ahead, behind, tol):
    """The mode in which a stretch of contact begins; ahead, behind: margins to slip and to slip back."""
    forward, backward = below(ahead, tol), below(behind, tol)
    if forward and (ahead.v_0 <= behind.v_0 or not backward):
        return SLIP
    return SLIP_BACK if backward else STICK


@_inline
def going_on(was, most, shear, tol):
    """The mode `was` of a spring if it is that of slip, and slip goes on in it; else stick."""
    mode = mode_at_begin(plus(most, -1.0, shear), plus(most, 1.0, shear), tol)
    return mode if mode == was else STICK


@_inline
def let_go(mode, q, e, i, w, z_1, x_1, modes, arms, tools, look):
    """The mode of a spring whose static limit is passed. Its force falls to L[q] at once: without dashpot by a jump of
    its end, whose energy is heat of friction; with one as it begins to slip. It sticks again where friction in slip
    does not let its end slip that way.
    """
    sign, before = -1.0 if mode == SLIP_BACK else 1.0, stored(e, i, arms)
    if arms is not None:
        into_modes(q, e, i, sign, PART, tools, modes)
        for j in range(q.shape[0]):
            left = 0.0
            for m in range(modes.mu.size):
                left += modes.out[j, m] * tools.room.modes[m]
            e[j, i] = sign * (q[j, i] - left)
    elif modes is None:
        e[0, i] = sign * q[0, i]
    if look is not None:
        look.sums[FRICTION_LOSS] += w * (before - stored(e, i, arms))
    return mode if sign * slip_velocity(mode, q, e, i, 0.0, z_1, x_1, (0.0, 0.0 * x_1), modes) > 0.0 else STICK


@_inline
def until_slip(margins, stick, q, e, i, z, x, u, tol, T, modes, arms, tools):
    """Time at which a spring that sticks slips, infinite if it does not, and the mode that follows."""
    (ahead, behind), until, after = margins, NEVER, SLIP
    if not stays(ahead, u, tol):
        p, p_2, left = stick * z[0] - x[0], stick * z[1] - x[1], stick * q[0, i] - e[0, i]
        until = until_held(ahead, left, q, e, i, stick, -1.0, p, p_2, u, tol, T, modes, arms, tools)
    if not stays(behind, u, tol):
        p, p_2, left = stick * z[0] + x[0], stick * z[1] + x[1], stick * q[0, i] + e[0, i]
        back = until_held(behind, left, q, e, i, stick, 1.0, p, p_2, u, tol, T, modes, arms, tools)
        until, after = (back, SLIP_BACK) if back < until else (until, after)
    return until, after


@_inline
def until_stick(sign, q, e, i, z, x, u, k, tol, modes, arms, tools):
    """Time at which a spring that slips in the direction `sign` sticks, infinite if it does not."""
    lag, rate, fallen = q[0, i] - sign * e[0, i], 0.0, 0.0
    if arms is not None:
        _, left_rate = into_modes(q, e, i, sign, k, tools, modes)
    else:
        if modes is not None:
            rate, fallen = modes.mu[0], tools.times.decay[k, 0]
        _, left_rate = alone(lag, rate, fallen)
    p, p_2 = sign * x[0] - z[0], 2.0 * (sign * x[1] - z[1])
    slips = plus(left_rate, 1.0, on_parabola(p, p_2, 0.0, 0.0, u))
    if stays(slips, u, tol):
        return NEVER
    return until_alone(slips, p, p_2, 0.0, lag, np.bool_(True), u, tol, modes, arms, tools)


@_inline
def slip_on(sign, lag, q, e, i, k, modes, arms, tools):
    """Extension at the end of a time of slip, after q: q - sign e is left alone."""
    if arms is not None:
        for j in range(q.shape[0]):
            e[j, i] = sign * (q[j, i] - of_modes(j, k, tools.room.modes, tools.times, modes))
    else:
        fallen = 0.0
        if modes is not None:
            fallen = tools.times.decay[k, 0]
        e[0, i] = sign * (q[0, i] - lag * fallen)


@_inline
def rub_line(q, e, limit, i, w, pressing, T, modes, arms, tools, look):
    """Friction of spring i over a stretch of contact, `pressing`; q and e are updated. look: None or Look."""
    z, x, t, k, begun, tol, rate_miss = pressing
    h, gone, mode, stick = tools.times.h, 0.0, BEGINS, stick_of(limit)
    area = moment = stuck = stuck_moment = borne = borne_moment = 0.0
    for _ in range(MOST_EVENTS):
        u, (z_1, z_2), (x_1, x_2) = t - gone, (z[0] + 2.0 * z[1] * gone, z[1]), (x[0] + 2.0 * x[1] * gone, x[1])
        most = held_force(q, i, z_1, z_2, u, k, T, tools, arms)
        shear = held_force(e, i, x_1, x_2, u, k, T, tools, arms)
        ahead, behind = plus(times(stick, most), -1.0, shear), plus(times(stick, most), 1.0, shear)
        if mode == BEGINS and limit is not None and stick > 1.0 and begun == 0.0:
            mode = going_on(limit.was[i], most, shear, tol)
            mode = BEGINS if mode == STICK else mode
        if mode == BEGINS:  # a spring that has just touched sticks up to the static limit
            mode = mode_at_begin(ahead, behind, tol)
            if limit is not None and stick > 1.0 and mode != STICK:
                mode = let_go(mode, q, e, i, w, z_1, x_1, modes, arms, tools, look)
            if look is not None and begun > 0.0:
                vel = slip_velocity(mode, q, e, i, begun / h, z_1, x_1, rate_miss, modes)
                look.sums[LEAST_SLIP] = min(look.sums[LEAST_SLIP], vel)
        # when the mode ends, and what follows
        after, sign = STICK, -1.0 if mode == SLIP_BACK else 1.0
        lag, parabolas = q[0, i] - sign * e[0, i], ((z_1, z_2), (x_1, x_2))
        if mode == STICK:
            until, after = until_slip((ahead, behind), stick, q, e, i, *parabolas, u, tol, T, modes, arms, tools)
        else:
            until = until_stick(sign, q, e, i, *parabolas, u, k, tol, modes, arms, tools)
        ends = until < u
        if ends:
            u, k = until, PART
            fill(u, modes, arms, tools.times, PART)
        if look is not None:
            if mode == STICK:
                lost = lost_on_parabola(e, i, x_1, x_2, u, h, look.nodes, T, modes, arms)
                look.sums[SHEAR_VISCOUS] += w * lost
            else:
                of_slipping(look.sums, w, sign, q, e, i, *parabolas, u, h, look.nodes, T, modes, arms, tools.room.work)
        # the state after that time
        A, B = hold(q, i, z_1, z_2, u, k, T, tools, arms)
        borne, borne_moment = borne + A, borne_moment + (begun + gone) * A + B
        if mode == STICK:
            if look is not None:
                look.sums[STICK_IMPULSE] += w * A
            A, B = hold(e, i, x_1, x_2, u, k, T, tools, arms)
            stuck, stuck_moment = stuck + u, stuck_moment + u * (begun + gone + 0.5 * u)
        else:
            slip_on(sign, lag, q, e, i, k, modes, arms, tools)
        area, moment = area + sign * A, moment + sign * ((begun + gone) * A + B)
        if not ends:
            break
        if limit is not None and stick > 1.0 and after != STICK:
            rates = z_1 + 2.0 * z_2 * u, x_1 + 2.0 * x_2 * u
            after = let_go(after, q, e, i, w, *rates, modes, arms, tools, look)
        gone, mode, k = gone + u, after, PART
        fill(t - gone, modes, arms, tools.times, PART)
    vel = 0.0
    if look is not None:
        z_end, x_end = z[0] + 2.0 * z[1] * t, x[0] + 2.0 * x[1] * t
        vel = slip_velocity(mode, q, e, i, (begun + t) / h, z_end, x_end, rate_miss, modes)
    n = -1.0 if mode == SLIP_BACK else 1.0
    return Friction(mode, n, vel, area, moment, stuck, stuck_moment, (borne, borne_moment))
