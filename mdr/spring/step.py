"""One spring over one step of time: contact, friction and material, exact from event to event.

In the step the top of the spring moves on parabolas, z_1 t + z_2 t² down and x_1 t + x_2 t² along the pull. In scaled
form Coulomb's law reads |L[e]| <= L[s], with the compression s, the extension e and the law L of the material
(law.py). So a spring is in one of four modes, and each ends at the first zero of a function that is known:

=========  =========================  ============================  =========================================
mode       what moves                 what is left alone            it ends where
=========  =========================  ============================  =========================================
free       nothing                    s and e                       the indenter meets the surface, z - gap = s
stick      s with z, e with x         nothing                       |L[e]| comes to L[s]: slip
slip       s with z                   s - e (so that L[e] = L[s])   the slip velocity ends, x' = e': stick;
                                                                    or the pressure does, L[s] = 0: free
slip back  s with z                   s + e (L[e] = -L[s])          likewise
=========  =========================  ============================  =========================================

The step answers the new state, the area and the moment of the tangential force over the step, which are exact too. So
its only error is that of the parabolas. Elastic springs, dashpots (Kelvin) and Maxwell arms are one text: what a
material lacks is None, and compiled away.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.spring.contact_modes import FREE, SLIP, SLIP_BACK, STICK
from mdr.spring.energies import LEAST_SLIP, Nodes, account
from mdr.spring.law import phi_of
from mdr.tools.arrays import Array
from mdr.tools.jit import compiled, inner

_FAST = {"reassoc", "contract"}
# arrays are only lent to these functions: numba need not count references to them, which takes time, to compile too
LENT = {"_nrt": False}
_inner = inner(error_model="numpy", fastmath=_FAST, **LENT)
_inline = inner(forceinline=True, error_model="numpy", fastmath=_FAST, **LENT)
_call = compiled(error_model="numpy", nogil=True, fastmath=_FAST, **LENT)

TOUCHES, BEGINS = 4, 5  #: the mode is still to be found: just touched; at the begin of a step
NEVER = np.inf
MOST_EVENTS = 100  #: of a spring in one step; what comes after the last would be left out
ROUNDING = 4e-15  #: of a length, and of a time in a step
MOST_PARABOLAS = 200  #: to a zero; they double their digits once they are near


class Path(NamedTuple):
    """Motion of the top in a step: its depth z_0 + z_1 t + z_2 t², its way x_1 t + x_2 t²."""

    z_0: float
    z_1: float
    z_2: float
    x_1: float
    x_2: float


class Tools(NamedTuple):
    """What times make of arms and modes, room to work in, and what one step tells the next."""

    h: float  #: length of the step
    held: Array  #: (2, 9, J) what arms, that are held on p t + q t² for the step or a part, come to
    decay: Array  #: (2, K) exp(-mu_k t) likewise
    modes: Array  #: (K,)
    work: Array  #: (J + K,)
    more: Array  #: (4, K)
    excess: Array  #: (1 + J, 1) at the end of a step: sum of w (e - s) in stick, of -2 w s in slip back


class Ends(NamedTuple):
    """A function of time at both ends of a stretch of it: values and slopes; and bounds on its curvature in between."""

    v_0: float
    d_0: float
    v_1: float
    d_1: float
    low: float
    high: float


class Look(NamedTuple):
    """What a close look at a step fills, of n springs."""

    nodes: Nodes  #: over the whole step
    sums: Array  #: (N_SUMS,) of which it adds up
    F: Array  #: (3,) at the end of the step: forces, tangential and normal, and least slip velocity in contact
    mode: Array  #: (n,) of each spring at the end of the step
    f_x: Array  #: (n,) tangential force of each spring over its stiffness
    f_z: Array  #: (n,) normal force likewise


@_inline
def plus(f, sign, g):
    """f + sign g, of sign 1 or -1."""
    low, high = (g.low, g.high) if sign > 0.0 else (g.high, g.low)
    ends = f.v_0 + sign * g.v_0, f.d_0 + sign * g.d_0, f.v_1 + sign * g.v_1, f.d_1 + sign * g.d_1
    return Ends(ends[0], ends[1], ends[2], ends[3], f.low + sign * low, f.high + sign * high)


@_inline
def below(f, tol):
    """Whether a function is below zero as its time begins, or falls from there."""
    return f.v_0 < -tol or (f.v_0 <= tol and f.d_0 < 0.0)


@_inline
def stays(f, t, tol):
    """Whether f surely stays above -tol, where it begins; False means that it is not known.

    Convex (low >= 0): it lies above the crossing of the tangents at its ends. Concave (high <= 0): above its values at
    the ends. Else: above one of two parabolas of the curvature low, from either end.
    """
    lowest = f.v_1
    if f.low >= 0.0:
        if f.d_0 < 0.0 and f.d_1 > 0.0:
            lowest = f.v_0 + f.d_0 * (f.v_1 - f.v_0 - f.d_1 * t) / (f.d_0 - f.d_1)
    elif f.high > 0.0:
        bend = 0.5 * t * f.low
        lowest = min(lowest, max(f.v_0 + t * (f.d_0 + bend), f.v_1 - t * (f.d_1 - bend)))
    return lowest >= -tol


@_inline
def held(x, p, q, T, t):
    """L of x + p t + q t², without arms."""
    v_1, d_1 = x + t * (p + q * t) + T * (p + 2.0 * q * t), p + 2.0 * q * t + 2.0 * T * q
    return Ends(x + T * p, p + 2.0 * T * q, v_1, d_1, 2.0 * q, 2.0 * q)


@_inline
def zero_of_parabola(f, t, tol, a, b, c):
    """First time at which a + b t + c t² falls below zero; infinite for none."""
    if a <= tol and (b < 0.0 or (b == 0.0 and c < 0.0)):
        return 0.0
    inside = b * b - 4.0 * a * c
    if inside < 0.0 and c < 0.0:  # it begins below zero by a rounding, and never rises above it
        return 0.0
    if inside < 0.0 or (c >= 0.0 and (b >= 0.0 or (f.v_1 >= -tol and b * b < 4.0 * c * (a + tol)))):
        return NEVER
    root = np.sqrt(inside)
    u = (b + root) / (-2.0 * c) if b > 0.0 else 2.0 * a / (root - b)
    return min(u, t) if f.v_1 < -tol or u < t else NEVER


@_inline
def force(x, p, q, T, t):
    """Area and moment of L[x + p t + q t²] over a time, without arms."""
    area = t * (x + t * (0.5 * p + t * (1.0 / 3.0) * q))
    moment = t * t * (0.5 * x + t * ((1.0 / 3.0) * p + t * 0.25 * q))
    dx = t * (p + q * t)
    return area + T * dx, moment + T * (t * (x + dx) - area)


@compiled(forceinline=True, error_model="numpy", nogil=True, fastmath=_FAST, **LENT)
def fill(t, modes, arms, tools, k):
    """What a time t makes of arms and modes: of x_j, p and q the arm after it takes the parts held[k, 0:3], the area of
    its force over the time held[k, 3:6], and its moment held[k, 6:9].
    """
    if arms is not None:
        for j in range(arms.rho.size):
            one, of, rho = phi_of(t * arms.rate[j]), tools.held[k], arms.rho[j]
            of[0, j], of[1, j], of[2, j] = one[0], t * one[1], 2.0 * t * t * one[2]
            of[3, j], of[4, j], of[5, j] = rho * of[1, j], rho * 0.5 * of[2, j], 2.0 * rho * t * t * t * one[3]
            of[6, j] = rho * t * t * (one[1] - one[2])
            of[7, j] = rho * t * t * t * (one[2] - one[3])
            of[8, j] = 2.0 * rho * t * t * t * t * (one[3] - one[4])
    if modes is not None:
        for j in range(modes.mu.size):
            tools.decay[k, j] = np.exp(-modes.mu[j] * t)


@compiled(error_model="numpy", nogil=True, fastmath=_FAST)
def new_tools(h, modes, arms):
    """Room to work in, and what a step makes of arms and modes."""
    J = K = 0
    if arms is not None:
        J = arms.rho.size
    if modes is not None:
        K = modes.mu.size
    held, decay, mode, work = np.empty((2, 9, J)), np.empty((2, K)), np.empty(K), np.empty(J + K)
    tools = Tools(h, held, decay, mode, work, np.empty((4, K)), np.empty((1 + J, 1)))
    fill(h, modes, arms, tools, 0)
    return tools


@inner(error_model="numpy", fastmath=_FAST)
def tools_of(h, modes, arms, tools):
    """The tools of another step; the room, and the excess of the step before, are the same."""
    one = Tools(h, np.empty_like(tools.held), np.empty_like(tools.decay), *tools[3:])
    fill(h, modes, arms, one, 0)
    return one


@_inner
def zero(t, tol, a, b, c, p, q, m, n_arms, n_modes, modes, arms, tools):
    """First time in (0, t) at which a function falls below zero; infinite for none.

    a + b t + c t² + m exp(-t/T), and what n_arms arms held on p t + q t², or n_modes modes, in tools.work add. The
    curvature of each of these falls towards zero. So what is negative now bounds all that is to come, and a parabola
    lies below the function: it goes on to where that parabola is zero, until it gets no further.
    """
    work, u = tools.work, 0.0
    for _ in range(MOST_PARABOLAS):
        v, d, bend = a + u * (b + u * c), b + 2.0 * c * u, 2.0 * c
        if arms is not None:
            for j in range(n_arms):
                rho, rate = arms.rho[j], arms.rate[j]
                phi = phi_of(u * rate)
                y = work[j] * phi[0] + u * (p * phi[1] + 2.0 * q * u * phi[2])
                slope = p + 2.0 * q * u - y * rate
                v, d, bend = v + rho * y, d + rho * slope, bend + rho * min(2.0 * q - slope * rate, 0.0)
            for k in range(n_modes):
                mu = modes.mu[k]
                y = work[k] * np.exp(-mu * u)
                v, d, bend = v + y, d - mu * y, bend + min(mu * mu * y, 0.0)
        else:
            mu = modes.mu[0]
            y = m * np.exp(-mu * u)
            v, d, bend = v + y, d - mu * y, bend + min(mu * mu * y, 0.0)
        v += tol
        if v <= 0.0:
            return u
        bend = abs(min(bend, 0.0))
        root = np.sqrt(d * d + 2.0 * bend * v)
        ahead = (d + root) / bend if d > 0.0 else 2.0 * v / (root - d)
        u += ahead
        if not u < t:
            return NEVER
        if ahead <= 1e-15 * t:
            return u
    return u


@_inline
def until_held(f, x, s, e, i, of_s, of_e, p, q, t, tol, T, modes, arms, tools):
    """When L of of_s s + of_e e, which is x, held on p t + q t², falls below zero."""
    if arms is None:
        return zero_of_parabola(f, t, tol, x + T * p, p + 2.0 * T * q, q)
    J = arms.rho.size
    for j in range(J):
        tools.work[j] = of_s * s[1 + j, i] + of_e * e[1 + j, i]
    return zero(t, tol, x + T * p, p + 2.0 * T * q, q, p, q, 0.0, J, 0, modes, arms, tools)


@_inline
def until_alone(f, a, b, c, x, rates, t, tol, modes, arms, tools):
    """When a + b t + c t² and x that is left alone, or its rate, falls below zero; with arms, of tools.modes."""
    if modes is None:
        return zero_of_parabola(f, t, tol, a, b, c)
    if arms is not None:
        for k in range(modes.mu.size):
            tools.work[k] = modes.out[0, k] * tools.modes[k] * (-modes.mu[k] if rates else 1.0)
    m = x * (-modes.mu[0] if rates else 1.0)
    return zero(t, tol, a, b, c, 0.0, 0.0, m, 0, modes.mu.size, modes, arms, tools)


@_inner
def slip_velocity(mode, s, e, i, zd, xd, modes):
    """Velocity over the plane of a spring in contact, with the rates zd and xd of its top."""
    if mode == STICK:
        return 0.0
    sign, rate = -1.0 if mode == SLIP_BACK else 1.0, 0.0
    if modes is not None:
        for k in range(modes.mu.size):
            m = 0.0
            for j in range(s.shape[0]):
                m += modes.into[k, j] * (s[j, i] - sign * e[j, i])
            rate -= modes.mu[k] * modes.out[0, k] * m
    return sign * (sign * xd - zd + rate)


@_inline
def slip_within(mode, s, e, i, share, z_1, x_1, off_z, off_x, modes):
    """The same at a share of the step, by rates of the cubic that has the true ones at both ends of the step: off by
    off_z and off_x there from those of the parabolas, which are z_1 and x_1 at that share.
    """
    bend = 1.0 - 6.0 * share * (1.0 - share)
    return slip_velocity(mode, s, e, i, z_1 + bend * off_z, x_1 + bend * off_x, modes)


@_inline
def arms_ends(x, i, p, q, t, k, tools, arms):
    """What the arms of x[:, i], held on p t + q t², add to L."""
    of, rho, rate = tools.held[k], arms.rho, arms.rate
    v_0 = d_0 = v_1 = d_1 = low = high = 0.0
    p_1 = p + 2.0 * q * t
    for j in range(rho.size):
        before = x[1 + j, i]
        after = before * of[0, j] + p * of[1, j] + q * of[2, j]
        slope = p - before * rate[j]
        bend = rho[j] * (2.0 * q - slope * rate[j])  # falls towards zero
        v_0 += rho[j] * before
        d_0 += rho[j] * slope
        v_1 += rho[j] * after
        d_1 += rho[j] * (p_1 - after * rate[j])
        low += min(bend, 0.0)
        high += max(bend, 0.0)
    return Ends(v_0, d_0, v_1, d_1, low, high)


@_inline
def hold_arms(x, i, p, q, k, tools, arms):
    """Hold the arms of x[:, i] on p t + q t² for a time: their state after; area and moment of their force."""
    of = tools.held[k]
    area = moment = 0.0
    for j in range(arms.rho.size):
        before = x[1 + j, i]
        x[1 + j, i] = before * of[0, j] + p * of[1, j] + q * of[2, j]
        area += before * of[3, j] + p * of[4, j] + q * of[5, j]
        moment += before * of[6, j] + p * of[7, j] + q * of[8, j]
    return area, moment


@_inline
def into_modes(s, e, i, part, k, tools, modes):
    """The modes of s - part e of spring i, into tools.modes; what is left alone for a time, and its rate."""
    of, decay, mu, out, into = tools.modes, tools.decay, modes.mu, modes.out, modes.into
    r_0 = d_0 = x_1 = r_1 = d_1 = low = high = falls = rises = 0.0
    for m in range(mu.size):
        size = 0.0
        for j in range(s.shape[0]):
            size += into[m, j] * (s[j, i] - part * e[j, i])
        of[m] = size
        size *= out[0, m]
        bend = mu[m] * mu[m] * size
        r_0 -= mu[m] * size
        d_0 += bend
        low += min(bend, 0.0)
        high += max(bend, 0.0)
        falls += mu[m] * min(-bend, 0.0)
        rises += mu[m] * max(-bend, 0.0)
        size *= decay[k, m]
        x_1 += size
        r_1 -= mu[m] * size
        d_1 += mu[m] * mu[m] * size
    return Ends(s[0, i] - part * e[0, i], r_0, x_1, r_1, low, high), Ends(r_0, d_0, r_1, d_1, falls, rises)


@_inline
def of_modes(j, k, tools, modes):
    """Part j of a state whose modes are in tools.modes, at the end of the time that it is left alone."""
    value = 0.0
    for m in range(modes.mu.size):
        value += modes.out[j, m] * tools.modes[m] * tools.decay[k, m]
    return value


@_inline
def alone(x, rate, decay):
    """The same of a Kelvin spring, which has one mode, and of an elastic one, which has none."""
    r, bend = -rate * x, rate * rate * x
    falls, rises = rate * min(-bend, 0.0), rate * max(-bend, 0.0)
    x_1, r_1, d_1 = x * decay, r * decay, bend * decay
    return Ends(x, r, x_1, r_1, min(bend, 0.0), max(bend, 0.0)), Ends(r, bend, r_1, d_1, falls, rises)


@_call
def row(s, e, gap, w, path, T, modes, arms, tools, zd, xd, look):
    """All springs over a step. Lengths are scaled so that Coulomb's law has no coefficient.

    gap, w (n,): depth of each foot, share in the stiffness. s, e (1 + J, n), updated: row 0 is compression and
    extension, row j the stretch of arm j. zd, xd: rates of the top at the end of the step. tools: filled for the step.
    look: None or Look. Returns seven sums weighted by w: area of the tangential force over the time, its moment about
    the begin of the step, time in stick, its moment, tangential force at the end, share that sticks there, share that
    slips back. tools.excess is filled, for `as_they_are`.
    """
    h, n_x, rate, decay, excess = tools.h, s.shape[0], 0.0, tools.decay, tools.excess
    if modes is not None:
        rate = modes.mu[0]
    area, moment, stuck, when, end, sticking, back, least = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, np.inf
    for j in range(n_x):
        excess[j, 0] = 0.0
    off_z, off_x = zd - path.z_1 - 2.0 * path.z_2 * h, xd - path.x_1 - 2.0 * path.x_2 * h
    for i in range(gap.size):
        tol = ROUNDING * (1.0 + abs(gap[i]))
        z_0, z_1, z_2, x_1, x_2 = path.z_0 - gap[i], path.z_1, path.z_2, path.x_1, path.x_2
        t, done, k = h, 0.0, 0
        of_area = of_moment = sticks = middle = 0.0
        mode = FREE
        if s[0, i] <= z_0 + tol:
            s[0, i], mode = z_0, BEGINS
        for _ in range(MOST_EVENTS):
            s_0, e_0 = s[0, i], e[0, i]
            press, shear = held(s_0, z_1, z_2, T, t), held(e_0, x_1, x_2, T, t)
            if arms is not None:
                press = plus(press, 1.0, arms_ends(s, i, z_1, z_2, t, k, tools, arms))
                shear = plus(shear, 1.0, arms_ends(e, i, x_1, x_2, t, k, tools, arms))
            ahead, behind = plus(press, -1.0, shear), plus(press, 1.0, shear)
            if mode == BEGINS and below(press, tol):
                mode = FREE
            touches = mode == TOUCHES
            if mode == BEGINS or touches:
                forward, backward = below(ahead, tol), below(behind, tol)
                mode = SLIP_BACK if backward else STICK
                if forward and (ahead.v_0 <= behind.v_0 or not backward):
                    mode = SLIP
            if look is not None and touches:
                slip = slip_within(mode, s, e, i, done / h, z_1, x_1, off_z, off_x, modes)
                look.sums[LEAST_SLIP] = min(look.sums[LEAST_SLIP], slip)
            sign = -1.0 if mode == SLIP_BACK else 1.0
            # when the mode ends, and what follows
            until, second = NEVER, NEVER
            if mode == STICK:
                after, other = SLIP, SLIP_BACK
                if not stays(ahead, t, tol):
                    p, q = z_1 - x_1, z_2 - x_2
                    until = until_held(ahead, s_0 - e_0, s, e, i, 1.0, -1.0, p, q, t, tol, T, modes, arms, tools)
                if not stays(behind, t, tol):
                    p, q = z_1 + x_1, z_2 + x_2
                    second = until_held(behind, s_0 + e_0, s, e, i, 1.0, 1.0, p, q, t, tol, T, modes, arms, tools)
            else:
                part = 0.0 if mode == FREE else sign  # left alone: s in flight, s -+ e in slip
                lag, fallen = s_0 - part * e_0, 0.0
                if modes is not None:
                    fallen = decay[k, 0]
                left, left_rate = alone(lag, rate, fallen)
                if arms is not None:
                    left, left_rate = into_modes(s, e, i, part, k, tools, modes)
                if mode == FREE:
                    after, other = TOUCHES, FREE
                    apart = plus(left, -1.0, held(z_0, z_1, z_2, 0.0, t))
                    if not stays(apart, t, tol):
                        until = until_alone(apart, -z_0, -z_1, -z_2, s_0, False, t, tol, modes, arms, tools)
                else:
                    after, other = STICK, FREE
                    p, q = sign * x_1 - z_1, 2.0 * (sign * x_2 - z_2)
                    slips = plus(left_rate, 1.0, held(p, q, 0.0, 0.0, t))
                    if not stays(slips, t, tol):
                        until = until_alone(slips, p, q, 0.0, lag, True, t, tol, modes, arms, tools)
                    if not stays(press, t, tol):
                        second = until_held(press, s_0, s, e, i, 1.0, 0.0, z_1, z_2, t, tol, T, modes, arms, tools)
            if second < until:
                until, after = second, other
            ends = until < t
            if ends:
                t, k = until, 1
                fill(t, modes, arms, tools, 1)
            if look is not None and (modes is not None or mode != FREE):
                here = Path(z_0, z_1, z_2, x_1, x_2)
                account(look.sums, mode, s, e, i, w[i], here, t, look.nodes, T, modes, arms, tools)
            # the state after that time
            fallen = 0.0
            if modes is not None:
                fallen = decay[k, 0]
            if mode == FREE:
                s[0, i], e[0, i] = s_0 * fallen, e_0 * fallen
                if arms is not None:
                    for j in range(n_x):
                        s[j, i] = of_modes(j, k, tools, modes)
                    e[0, i] = e_0
                    into_modes(e, e, i, 0.0, k, tools, modes)
                    for j in range(n_x):
                        e[j, i] = of_modes(j, k, tools, modes)
            else:
                A, B = force(e_0, x_1, x_2, T, t) if mode == STICK else force(s_0, z_1, z_2, T, t)
                s[0, i] = s_0 + t * (z_1 + z_2 * t)
                e[0, i] = e_0 + t * (x_1 + x_2 * t) if mode == STICK else sign * (s[0, i] - lag * fallen)
                if arms is not None:
                    C, D = hold_arms(s, i, z_1, z_2, k, tools, arms)
                    if mode == STICK:
                        C, D = hold_arms(e, i, x_1, x_2, k, tools, arms)
                    else:
                        for j in range(n_x):
                            e[j, i] = sign * (s[j, i] - of_modes(j, k, tools, modes))
                    A, B = A + C, B + D
                sticks += t if mode == STICK else 0.0
                middle += t * (done + 0.5 * t) if mode == STICK else 0.0
                of_area += sign * A
                of_moment += sign * (done * A + B)
            if not ends:
                break
            done += t
            z_0, z_1, x_1 = z_0 + t * (z_1 + t * z_2), z_1 + 2.0 * z_2 * t, x_1 + 2.0 * x_2 * t
            if look is not None and after == FREE:
                slip = slip_within(mode, s, e, i, done / h, z_1, x_1, off_z, off_x, modes)
                look.sums[LEAST_SLIP] = min(look.sums[LEAST_SLIP], slip)
            if after == TOUCHES:  # the rounding of the touch is that of both, so that full slip stays what it is
                e[0, i] += np.sign(e[0, i]) * (z_0 - s[0, i])
                s[0, i] = z_0
            mode, t, k = after, h - done, 1
            fill(t, modes, arms, tools, 1)
        area += w[i] * of_area
        moment += w[i] * of_moment
        stuck += w[i] * sticks
        when += w[i] * middle
        normal = tangential = 0.0
        if mode != FREE:
            normal, tangential = s[0, i] + T * zd, e[0, i] + T * xd
            if arms is not None:
                for j in range(n_x - 1):
                    normal += arms.rho[j] * s[1 + j, i]
                    tangential += arms.rho[j] * e[1 + j, i]
            normal = max(normal, 0.0)
            tangential = max(min(tangential, normal), -normal) if mode == STICK else sign * normal
        if mode == STICK:
            sticking += w[i]
            for j in range(n_x):
                excess[j, 0] += w[i] * (e[j, i] - s[j, i])
        elif mode == SLIP_BACK:
            back += w[i]
            for j in range(n_x):
                excess[j, 0] -= 2.0 * w[i] * s[j, i]
        end += w[i] * tangential
        if look is not None:
            if mode != FREE:
                least = min(least, slip_velocity(mode, s, e, i, zd, xd, modes))
            look.mode[i], look.f_x[i], look.f_z[i] = mode, tangential, normal
            look.F[0] += w[i] * tangential
            look.F[1] += w[i] * normal
    if look is not None:
        look.F[2] = least
    return area, moment, stuck, when, end, sticking, back


@_call
def as_they_are(path, sticking, back, T, arms, tools, zd, xd):
    """The force over a step in which every spring keeps the mode that it had at the end of the last one, less that of
    full slip forward. A spring that sticks bears L[e] - L[s] more, one that slips back -2 L[s]. As L is linear and the
    same for all, they are together one spring, with the state tools.excess.

    sticking, back: shares of the springs, as of `row` for the last step; the others are those of `row` for this step.
    Returns area, moment and force at the end; tools.excess is used up.
    """
    h, excess, part = tools.h, tools.excess, sticking + 2.0 * back
    p, q = sticking * path.x_1 - part * path.z_1, sticking * path.x_2 - part * path.z_2
    area, moment = force(excess[0, 0], p, q, T, h)
    end = excess[0, 0] + h * (p + q * h) + T * (sticking * xd - part * zd)
    if arms is not None:
        A, B = hold_arms(excess, 0, p, q, 0, tools, arms)
        area, moment = area + A, moment + B
        for j in range(arms.rho.size):
            end += arms.rho[j] * excess[1 + j, 0]
    return area, moment, end


@_inner
def glassy(arms):
    """Modulus at once over the long-time one: one, and the moduli of the arms."""
    total = 1.0
    if arms is not None:
        for j in range(arms.rho.size):
            total += arms.rho[j]
    return total


@_inline
def lasts(presses, event, s, i, z_0, z_1, z_2, t, k, tol, instantaneous, T, modes, arms, tools):
    """Whether spring i presses or flies, as it did at the event before, and until when: infinite for the time t."""
    x, until, fallen, rate, of_force = s[0, i], NEVER, 0.0, 0.0, tol * instantaneous
    if presses:
        normal = held(x, z_1, z_2, T, t)
        if arms is not None:
            normal = plus(normal, 1.0, arms_ends(s, i, z_1, z_2, t, k, tools, arms))
        presses = event > 0 or not below(normal, of_force)
    if presses and not stays(normal, t, of_force):
        until = until_held(normal, x, s, s, i, 1.0, 0.0, z_1, z_2, t, of_force, T, modes, arms, tools)
    if not presses:
        if modes is not None:
            rate, fallen = modes.mu[0], tools.decay[k, 0]
        left, _ = alone(x, rate, fallen)
        if arms is not None:
            left, _ = into_modes(s, s, i, 0.0, k, tools, modes)
        apart = plus(left, -1.0, held(z_0, z_1, z_2, 0.0, t))
        if not stays(apart, t, tol):
            until = until_alone(apart, -z_0, -z_1, -z_2, x, False, t, tol, modes, arms, tools)
    return presses, until


@_inline
def relax(x, i, k, modes, arms, tools):
    """What x[:, i] is after a time in which nothing holds it."""
    fallen = 0.0
    if modes is not None:
        fallen = tools.decay[k, 0]
    if arms is None:
        x[0, i] *= fallen
    else:
        into_modes(x, x, i, 0.0, k, tools, modes)
        for j in range(x.shape[0]):
            x[j, i] = of_modes(j, k, tools, modes)


@_call
def press(s, gap, w, path, T, modes, arms, tools, since):
    """The normal part alone, in which friction has no part: sums of area and moment of the normal forces.

    s (1 + J, n) is updated; since (n,) is filled with the share of the step that each spring has pressed at its end,
    zero in flight.
    """
    h, instantaneous = tools.h, glassy(arms)
    all_area = all_moment = 0.0
    for i in range(gap.size):
        tol = ROUNDING * (1.0 + abs(gap[i]))
        z_0, z_1, z_2 = path.z_0 - gap[i], path.z_1, path.z_2
        t, done, k, pressed = h, 0.0, 0, 0.0
        area = moment = 0.0
        presses = s[0, i] <= z_0 + tol
        if presses:
            s[0, i] = z_0
        for event in range(MOST_EVENTS):
            presses, until = lasts(presses, event, s, i, z_0, z_1, z_2, t, k, tol, instantaneous, T, modes, arms, tools)
            ends = until < t
            if ends:
                t, k = until, 1
                fill(t, modes, arms, tools, 1)
            if presses:
                A, B = force(s[0, i], z_1, z_2, T, t)
                if arms is not None:
                    C, D = hold_arms(s, i, z_1, z_2, k, tools, arms)
                    A, B = A + C, B + D
                s[0, i] += t * (z_1 + z_2 * t)
                area, moment, pressed = area + A, moment + done * A + B, pressed + t
            else:
                pressed = 0.0
                relax(s, i, k, modes, arms, tools)
            if not ends:
                break
            done += t
            z_0, z_1, presses = z_0 + t * (z_1 + t * z_2), z_1 + 2.0 * z_2 * t, not presses
            if presses:
                s[0, i] = z_0
            t, k = h - done, 1
            fill(t, modes, arms, tools, 1)
        all_area += w[i] * area
        all_moment += w[i] * moment
        since[i] = pressed / h if h > 0.0 else 0.0
    return all_area, all_moment
