"""The compiled march: one spring, one step, one run. Arrays and floats only, in scaled form.

Scaled form (scaled.py makes it): time is omega t, normal lengths are divided by du_z, tangential lengths by
mu_0 kappa du_z, spring stiffnesses by their sum. Then mu_0, E* and G* are gone, Coulomb's law
|dk_x L[e]| <= mu_0 dk_z L[s] reads |L[e]| <= L[s], and the same operator L = 1 + T d/dt acts on both sides.

One spring in one step, with compression s and extension e at its start:

* Contact. s follows the indenter, z - gap, as long as that lies above the freely relaxing surface s exp(-h/T);
  this one rule holds the unilateral contact of a Kelvin spring, its release while still compressed
  (L[s] = 0) and its return to the relaxed surface. It is s(t) = sup (z - gap)(t - theta) exp(-theta/T), step by step.
* Friction. The trial step sticks: e moves with the body. Sliding forward all the time keeps L[e] = L[s], so the
  lag p = s - e decays like exp(-h/T); sliding backward, so does s + e. The new e is the trial value clipped between
  these two, which is exact whenever the mode does not change within the step.
* A change of mode within the step: the two competing rates differ by D, which changes sign. With D linear over the
  step, what the new mode adds after the change is D_1²/(|D_0| + |D_1|) h/2 (`after_change`). So the scheme knows when
  slip gave way to stick, stick to slip and contact to flight, not only between which two steps.
* First touch. A spring that touched at a fraction of the step has travelled only the rest of it; without
  this the scheme is of first order.

T = 0 is the limit exp(-h/T) = 0, where the bounds become the return mapping |e| <= s; it has a leaner loop.

The body is a linear oscillator under the force of the springs, with its motion relative to the pull
y_new = a_1 y + a_2 y_old - (b_1 S_new + b_0 S + b_m S_old), S = sum of w e; scaled.py derives the five
numbers. S_new depends on y_new, monotonically and piecewise linearly, and is solved for together with it by
Newton's method inside a bracket, halved when that does not get on, to rounding.
"""

from __future__ import annotations

import numpy as np
from numba import njit

_FAST = {"reassoc", "contract"}  # sums may vectorise; NaN and infinity keep their meaning
_jit = njit(cache=True, nogil=True, error_model="numpy", fastmath=_FAST)
_inline = njit(inline="always", error_model="numpy", fastmath=_FAST)


# --- one spring -----------------------------------------------------------------------------------


@_inline
def after_change(D_0, D_1, h, rate):
    """What the new mode adds in a step through which its lead D runs from D_0 < 0 to D_1 > 0; rate = 1/T damps it."""
    lead = max(D_1, 0.0)  # the rest of the step, after the change, is h lead/(lead + max(-D_0, 0))
    return 0.5 * h * lead * lead / (lead + max(-D_0, 0.0) + 0.5 * rate * h * lead + 1e-300)


@_inline
def bend_of(closing_0, closing_1):
    """How much the closing of a gap speeds up within a step: what turns a share of the way into a share of the time."""
    mean = abs(closing_0 + closing_1) + 1e-300
    return min(max((closing_1 - closing_0) / mean, -0.5), 0.5)


@_inline
def surge_of(du, ud_0, ud_1, h):
    """How far the body gets ahead of half its step in the second half: what it gains while its velocity grows.

    A spring that touches for the last share of a step sees the body travel share * (du + (1 - share) * surge).
    """
    most = abs(du)  # without inertia the velocity may jump, and no growth can be read off it
    return min(max(0.5 * h * (ud_1 - ud_0), -most), most)


@_inline
def elastic_spring(e, gap, z_1, du, surge, inverse_dz, bend, late):
    """One elastic spring over one step: new extension, compression, share of the step in contact, trial extension.

    late: what a spring that turned from slip to stick within the step falls behind.
    """
    s = max(z_1 - gap, 0.0)
    way = min(s * inverse_dz, 1.0)
    travelled = way * ((1.0 - bend) + bend * way)
    trial = e + travelled * ((du + surge) - travelled * surge)
    return max(min(trial, s - travelled * late), -s), s, travelled, trial


@_inline
def kelvin_spring(e, s_0, gap, z_0, z_1, zd_0, zd_1, du, surge, ud_0, ud_1, h, rate, decay):
    """One Kelvin spring over one step: new extension, compression, share of the step in contact, trial extension.

    zd, ud: velocities of indenter and body at both ends of the step. rate = 1/T, decay = exp(-h/T).
    """
    relaxed = s_0 * decay
    pressed = z_1 - gap
    ahead = s_0 - (z_0 - gap)  # height of the relaxed surface over the indenter at the start
    leaving = after_change(-(zd_0 + s_0 * rate), -(zd_1 + pressed * rate), h, rate) if ahead <= 0.0 else 0.0
    s = max(pressed + leaving, relaxed)
    rise = s - relaxed
    way = rise / (rise + ahead + 1e-300)
    travelled = way * (1.0 - bend_of(zd_0 + s_0 * rate, zd_1 + relaxed * rate) * (1.0 - way))
    trial = e * (travelled + (1.0 - travelled) * decay) + travelled * (du + (1.0 - travelled) * surge)
    lag = s_0 - e
    D_0 = zd_0 - ud_0 + lag * rate  # > 0: sticks at the start
    sticks = D_0 > 0.0
    D_1 = zd_1 - ud_1 + (max(s - trial, 0.0) if sticks else lag * decay) * rate
    turn = -1.0 if sticks else 1.0
    change = after_change(turn * D_0, turn * D_1, h, rate)
    forward = s - lag * decay
    first = min((trial if sticks else forward) - travelled * change, forward)
    return max(first, (s_0 + e) * decay - s), s, travelled, trial


# --- one step -------------------------------------------------------------------------------------


@_jit
def elastic_step(e_0, e_1, gap, w, z_0, z_1, zd_0, zd_1, du, ud_0, ud_1, h, rigid):
    """All elastic springs over one step: fills e_1 and returns sum(w e) and, unless rigid, the stiffness that stuck."""
    inverse_dz = 1.0 / (z_1 - z_0) if z_1 > z_0 else 1e300
    bend = bend_of(zd_0, zd_1)
    late = after_change(zd_0 - ud_0, zd_1 - ud_1, h, 0.0) if zd_0 < ud_0 else 0.0
    surge = surge_of(du, ud_0, ud_1, h)
    total = 0.0
    stuck = 0.0
    if rigid:
        for i in range(e_0.size):
            e_1[i] = elastic_spring(e_0[i], gap[i], z_1, du, surge, inverse_dz, bend, late)[0]
            total += w[i] * e_1[i]
        return total, stuck
    for i in range(e_0.size):
        e, _, travelled, trial = elastic_spring(e_0[i], gap[i], z_1, du, surge, inverse_dz, bend, late)
        e_1[i] = e
        total += w[i] * e
        stuck += w[i] * travelled if (e == trial or (late > 0.0 and e > 0.0)) else 0.0
    return total, stuck


@_jit
def kelvin_step(e_0, s_0, e_1, s_1, gap, w, z_0, z_1, zd_0, zd_1, du, ud_0, ud_1, h, rate, decay):
    """All Kelvin springs over one step: fills e_1 and s_1, returns sum(w e) and the stiffness that stuck."""
    surge = surge_of(du, ud_0, ud_1, h)
    total = 0.0
    stuck = 0.0
    for i in range(e_0.size):
        e, s, travelled, trial = kelvin_spring(
            e_0[i], s_0[i], gap[i], z_0, z_1, zd_0, zd_1, du, surge, ud_0, ud_1, h, rate, decay
        )
        e_1[i] = e
        s_1[i] = s
        total += w[i] * e
        stuck += w[i] * travelled if abs(e - trial) <= 1e-9 * abs(du) else 0.0
    return total, stuck


# --- one run --------------------------------------------------------------------------------------


@_jit
def settle_normal(s, gap, w, z, zd, T):
    """Put every spring into the periodic normal motion, at its start z[0]; return the mean of sum(w s) over a period.

    One period is the memory of a spring in the normal direction, so a second pass over the period is periodic.
    """
    n_z = z.size - 1
    h = 2.0 * np.pi / n_z
    decay = np.exp(-h / T) if T > 0.0 else 0.0
    rate = 1.0 / T if decay > 0.0 else 0.0
    mean = 0.0
    for i in range(s.size):
        s[i] = max(z[0] - gap[i], 0.0)
    if decay == 0.0:
        for k in range(n_z):
            total = 0.0
            for i in range(s.size):
                total += w[i] * max(z[k] - gap[i], 0.0)
            mean += total
        return mean / n_z
    for turn in range(2):
        for k in range(n_z):
            total = 0.0
            for i in range(s.size):
                _, value, _, _ = kelvin_spring(
                    0.0, s[i], gap[i], z[k], z[k + 1], zd[k], zd[k + 1], 0.0, 0.0, 0.0, 0.0, h, rate, decay
                )
                s[i] = value
                total += w[i] * s[i]
            mean += total if turn == 1 else 0.0
    return mean / n_z


@_jit
def march(e, s, history, body, gap, w, z, zd, v, T, lump_margin, n_steps, k_0, y_out, S_out, e_out, s_out):
    """March n_steps from step k_0 of the period; e, s and history are updated in place.

    e, s: (n,) extension and compression. history: (5,) y, y_old, y_older, S, S_old. body: (5,) a_1, a_2, b_1, b_0, b_m,
    all zero for a rigid pull. gap, w: (n,). z, zd: (n_z + 1,) normal motion over one period and its rate.
    v: pulling velocity. T: relaxation time.
    lump_margin: the first spring stands for others of its core as long as L[e + s] stays above this; negative
    switches the watch off. y_out, S_out: (n_steps,). e_out, s_out: (n_steps, n), or (0, n) to keep nothing.
    Returns whether the core moved as one all the way.
    """
    n_z = z.size - 1
    h = 2.0 * np.pi / n_z
    a_1, a_2, b_1, b_0, b_m = body[0], body[1], body[2], body[3], body[4]
    y_0, y_m, y_mm, S_0, S_m = history[0], history[1], history[2], history[3], history[4]
    e_0, e_1 = e, np.empty_like(e)
    s_0, s_1 = s, np.empty_like(s)
    decay = np.exp(-h / T) if T > 0.0 else 0.0
    elastic = decay == 0.0
    rate = 0.0 if elastic else 1.0 / T
    rigid = b_1 == 0.0
    as_one = True
    for j in range(n_steps):
        k = (k_0 + j) % n_z
        z_0, z_1 = z[k], z[k + 1]
        pull = 0.0 if rigid else a_1 * y_0 + a_2 * y_m - b_0 * S_0 - b_m * S_m
        y_1 = 0.0 if rigid else 3.0 * (y_0 - y_m) + y_mm
        low, high = -np.inf, np.inf
        ud_0 = v + (1.5 * y_0 - 2.0 * y_m + 0.5 * y_mm) / h
        for turn in range(80):
            du = v * h + (y_1 - y_0)
            ud_1 = v + (1.5 * y_1 - 2.0 * y_0 + 0.5 * y_m) / h
            if elastic:
                S_1, stuck = elastic_step(e_0, e_1, gap, w, z_0, z_1, zd[k], zd[k + 1], du, ud_0, ud_1, h, rigid)
            else:
                S_1, stuck = kelvin_step(
                    e_0, s_0, e_1, s_1, gap, w, z_0, z_1, zd[k], zd[k + 1], du, ud_0, ud_1, h, rate, decay
                )
            excess = y_1 - pull + b_1 * S_1
            rounding = 2e-15 * (abs(y_1) + abs(pull) + abs(b_1 * S_1))
            if abs(excess) <= rounding:
                break
            if excess > 0.0:  # the slope is at least 1, so the root is no further than the excess
                low, high = max(low, y_1 - excess), y_1
            else:
                low, high = y_1, min(high, y_1 - excess)
            y_new = y_1 - excess / (1.0 + b_1 * stuck)
            if turn > 7 or not low <= y_new <= high:
                y_new = 0.5 * (low + high)
            if abs(y_new - y_1) <= 0.1 * rounding:
                break
            y_1 = y_new
        if elastic:
            core = e_1[0] + max(z_1 - gap[0], 0.0)
        else:
            core = (e_1[0] + s_1[0] - (e_0[0] + s_0[0]) * decay) / (1.0 - decay)
        as_one = as_one and core >= lump_margin
        y_mm, y_m, y_0, S_m, S_0 = y_m, y_0, y_1, S_0, S_1
        e_0, e_1 = e_1, e_0
        s_0, s_1 = s_1, s_0
        y_out[j] = y_1
        S_out[j] = S_1
        if j < e_out.shape[0]:
            e_out[j] = e_0
            if elastic:
                for i in range(e_0.size):
                    s_out[j, i] = max(z_1 - gap[i], 0.0)
            else:
                s_out[j] = s_0
    if n_steps % 2 == 1:
        e_1[:] = e_0
        s_1[:] = s_0
    history[0], history[1], history[2], history[3], history[4] = y_0, y_m, y_mm, S_0, S_m
    return as_one


# --- looking at a run -----------------------------------------------------------------------------

FREE, STICK, SLIP, SLIP_BACK = 0, 1, 2, 3

# what `observe` adds up, in the order of its `sums`
N_SUMS = 10
(
    SUM_E,
    SUM_S,
    STICK_TIME,
    CONTACT_TIME,
    SHEAR_WORK,
    NORMAL_WORK,
    FRICTION_LOSS,
    SHEAR_VISCOUS,
    NORMAL_VISCOUS,
    LEAST_SLIP,
) = range(N_SUMS)


@_inline
def mode_and_forces(e, s, gap, z, z_dot, ux_dot, T):
    """Mode of a spring at an instant, with its tangential and normal force L[e], L[s] over its stiffness."""
    normal = s + T * z_dot
    normal = normal if s <= z - gap and normal > 0.0 else 0.0
    trial = e + T * ux_dot
    limit = normal * (1.0 - 1e-12)
    tangential = min(max(trial, -normal), normal)
    slips = SLIP if trial >= limit else (SLIP_BACK if trial <= -limit else STICK)
    return (slips if normal > 0.0 else FREE), tangential, normal


@_inline
def contact_share(s_0, s_1, gap, z_0, z_1, zd_0, zd_1, rate, decay):
    """Share of a step that a spring spends in contact, as the march has it: 1 in contact throughout, 0 in flight."""
    relaxed = s_0 * decay
    rise = max(s_1 - relaxed, 0.0)
    way = rise / (rise + max(s_0 - (z_0 - gap), 0.0) + 1e-300)
    return way * (1.0 - bend_of(zd_0 + s_0 * rate, zd_1 + relaxed * rate) * (1.0 - way))


@_jit
def observe(e, s, y, z, z_dot, gap, w, T, v, decay, h, sums, F_x, F_z, slip, mode):
    """Forces, modes and energies of a marched stretch of m steps, each energy from its own definition.

    e, s: (m + 1, n) states at the instants. y: (m + 3,) body, from two steps before the first. z, z_dot: (m + 1,).
    Adds to sums (N_SUMS,); fills F_x, F_z (m,) with the forces at the end of each step, slip (m,) with the least slip
    velocity of a spring in contact through the step, or else at the touch of those that touched in it (infinite without
    contact), and mode (m, n), or (0, n) for none.
    """
    rate = 1.0 / T if T > 0.0 else 0.0
    lost = 1.0 - decay
    slips, first_slips = np.empty(e.shape[1]), np.empty(e.shape[1])
    for k in range(e.shape[0] - 1):
        du = v * h + (y[k + 3] - y[k + 2])
        ux_dot = v + (3.0 * y[k + 3] - 4.0 * y[k + 2] + y[k + 1]) / (2.0 * h)
        ux_dot_0 = v + (3.0 * y[k + 2] - 4.0 * y[k + 1] + y[k]) / (2.0 * h)
        z_0, z_1, zd_0, zd_1 = z[k], z[k + 1], z_dot[k], z_dot[k + 1]
        surge = surge_of(du, ux_dot_0, ux_dot, h)
        growth = max(((ux_dot - zd_1) - (ux_dot_0 - zd_0)) / h, 0.0)  # of the common slip velocity
        f_x = f_z = sum_e = sum_s = stick = friction = shear_viscous = normal_viscous = shear = press = 0.0
        for i in range(e.shape[1]):
            e_0, e_1, s_0, s_1 = e[k, i], e[k + 1, i], s[k, i], s[k + 1, i]
            now, tangential, normal = mode_and_forces(e_1, s_1, gap[i], z_1, zd_1, ux_dot, T)
            f_x += w[i] * tangential
            f_z += w[i] * normal
            stick += w[i] * normal if now == STICK else 0.0
            sum_e += w[i] * (e_0 + e_1)
            sum_s += w[i] * (s_0 + s_1)
            # the step falls into a free part and a part in contact, as in the march
            touched = contact_share(s_0, s_1, gap[i], z_0, z_1, zd_0, zd_1, rate, decay)
            per_time = 1.0 / (max(touched, 1e-9) * h) if touched > 1e-9 else 0.0
            relaxed = 1.0 - (1.0 - touched) * lost
            stretched, pressed = e_1 - e_0 * relaxed, s_1 - s_0 * relaxed
            slip_rate = (touched * (du + (1.0 - touched) * surge) - stretched) * per_time
            normal_impulse = 0.5 * h * (s_0 + s_1) + T * (s_1 - s_0)
            friction += w[i] * max(normal_impulse, 0.0) * abs(slip_rate)
            free = (1.0 - touched) * lost * lost / h
            shear_viscous += w[i] * T * (stretched * stretched * per_time + e_0 * e_0 * free)
            normal_viscous += w[i] * T * (pressed * pressed * per_time + s_0 * s_0 * free)
            shear += w[i] * (0.5 * h * (e_0 + e_1) + T * (e_1 - e_0))
            press += w[i] * normal_impulse
            presses = s_1 > 0.0 and s_1 <= z_1 - gap[i]
            slips[i] = slip_rate if presses and touched > 0.999999 else np.inf
            first_slips[i] = slip_rate - 0.5 * touched * h * growth if presses and touched > 1e-6 else np.inf
        least, first = np.inf, np.inf
        for i in range(e.shape[1]):
            least = min(least, slips[i])
            first = min(first, first_slips[i])
        least = least if least < np.inf else first  # all that press slip alike, so only the first touch of all adds
        if mode.shape[0] > 0:
            for i in range(e.shape[1]):
                mode[k, i] = mode_and_forces(e[k + 1, i], s[k + 1, i], gap[i], z_1, zd_1, ux_dot, T)[0]
        F_x[k], F_z[k], slip[k] = f_x, f_z, least
        sums[SUM_E] += 0.5 * sum_e
        sums[SUM_S] += 0.5 * sum_s
        sums[STICK_TIME] += stick * h
        sums[CONTACT_TIME] += f_z * h
        sums[SHEAR_WORK] += shear * du / h
        sums[NORMAL_WORK] += press * (z_1 - z_0) / h
        sums[FRICTION_LOSS] += friction
        sums[SHEAR_VISCOUS] += shear_viscous
        sums[NORMAL_VISCOUS] += normal_viscous
        sums[LEAST_SLIP] = min(sums[LEAST_SLIP], least)
