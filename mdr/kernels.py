"""The compiled march: one spring, one step, one run. Arrays and floats only, in scaled form.

Scaled form (sliding.py makes it): time is omega t, normal lengths are divided by du_z, tangential lengths by
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
y_new = a_1 y + a_2 y_old - (b_1 S_new + b_0 S + b_m S_old), S = sum of w e; sliding.py derives the five
numbers. S_new depends on y_new, monotonically and piecewise linearly, and is solved for together with it by
Newton's method inside a bracket, to rounding.
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
    lead = max(D_1, 0.0)
    rest = h * lead / (lead + max(-D_0, 0.0) + 1e-300)  # of the step, after the change
    return 0.5 * lead * rest / (1.0 + 0.5 * rate * rest)


@_inline
def bend_of(closing_0, closing_1):
    """How much the closing of a gap speeds up within a step: what turns a share of the way into a share of the time."""
    mean = abs(closing_0 + closing_1) + 1e-300
    return min(max((closing_1 - closing_0) / mean, -0.5), 0.5)


@_inline
def elastic_spring(e, gap, z_1, du, inverse_dz, bend, late):
    """One elastic spring over one step: new extension, compression, share of the step in contact, trial extension.

    late: what a spring that turned from slip to stick within the step falls behind.
    """
    s = max(z_1 - gap, 0.0)
    way = min(s * inverse_dz, 1.0)
    travelled = way * (1.0 - bend * (1.0 - way))
    trial = e + travelled * du
    return max(min(trial, s - travelled * late), -s), s, travelled, trial


@_inline
def kelvin_spring(e, s_0, gap, z_0, z_1, zd_0, zd_1, du, ud_0, ud_1, h, rate, decay):
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
    trial = e * (travelled + (1.0 - travelled) * decay) + travelled * du
    lag = s_0 - e
    D_0 = zd_0 - ud_0 + lag * rate  # > 0: sticks at the start
    sticks = D_0 > 0.0
    D_1 = zd_1 - ud_1 + (max(s - trial, 0.0) if sticks else lag * decay) * rate
    change = after_change(-D_0, -D_1, h, rate) if sticks else after_change(D_0, D_1, h, rate)
    forward = s - lag * decay
    first = min((trial if sticks else forward) - travelled * change, forward)
    return max(first, (s_0 + e) * decay - s), s, travelled, trial


# --- one step -------------------------------------------------------------------------------------


@_jit
def elastic_step(e_0, e_1, gap, w, z_0, z_1, zd_0, zd_1, du, ud_0, ud_1, h):
    """All elastic springs over one step: fills e_1 and returns sum(w e) and the stiffness that stuck."""
    inverse_dz = 1.0 / (z_1 - z_0) if z_1 > z_0 else 1e300
    bend = bend_of(zd_0, zd_1)
    late = after_change(zd_0 - ud_0, zd_1 - ud_1, h, 0.0) if zd_0 < ud_0 else 0.0
    total = 0.0
    stuck = 0.0
    for i in range(e_0.size):
        e, _, travelled, trial = elastic_spring(e_0[i], gap[i], z_1, du, inverse_dz, bend, late)
        e_1[i] = e
        total += w[i] * e
        stuck += w[i] * travelled if (e == trial or (late > 0.0 and e > 0.0)) else 0.0
    return total, stuck


@_jit
def kelvin_step(e_0, s_0, e_1, s_1, gap, w, z_0, z_1, zd_0, zd_1, du, ud_0, ud_1, h, rate, decay):
    """All Kelvin springs over one step: fills e_1 and s_1, returns sum(w e) and the stiffness that stuck."""
    total = 0.0
    stuck = 0.0
    for i in range(e_0.size):
        e, s, travelled, trial = kelvin_spring(
            e_0[i], s_0[i], gap[i], z_0, z_1, zd_0, zd_1, du, ud_0, ud_1, h, rate, decay
        )
        e_1[i] = e
        s_1[i] = s
        total += w[i] * e
        stuck += w[i] * travelled if e >= trial - 1e-9 * abs(du) else 0.0
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
    mean = 0.0
    for i in range(s.size):
        value = max(z[0] - gap[i], 0.0)
        for turn in range(2):
            for k in range(n_z):
                if decay > 0.0:
                    value = kelvin_spring(
                        0.0, value, gap[i], z[k], z[k + 1], zd[k], zd[k + 1], 0.0, 0.0, 0.0, h, 1.0 / T, decay
                    )[1]
                else:
                    value = max(z[k + 1] - gap[i], 0.0)
                mean += w[i] * value if turn == 1 else 0.0
        s[i] = value
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
        for _ in range(60):
            du = v * h + (y_1 - y_0)
            ud_0, ud_1 = v + 0.5 * (y_1 - y_m) / h, v + (1.5 * y_1 - 2.0 * y_0 + 0.5 * y_m) / h
            if elastic:
                S_1, stuck = elastic_step(e_0, e_1, gap, w, z_0, z_1, zd[k], zd[k + 1], du, ud_0, ud_1, h)
            else:
                S_1, stuck = kelvin_step(
                    e_0, s_0, e_1, s_1, gap, w, z_0, z_1, zd[k], zd[k + 1], du, ud_0, ud_1, h, rate, decay
                )
            excess = y_1 - pull + b_1 * S_1
            if abs(excess) <= 4e-16 * (abs(y_1) + abs(pull) + abs(b_1 * S_1)):
                break
            if excess > 0.0:
                high = y_1
            else:
                low = y_1
            y_new = y_1 - excess / (1.0 + b_1 * stuck)
            if not low < y_new < high:
                y_new = 0.5 * (low + high)
            if y_new == y_1 or not low < y_new < high:
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
    if s > z - gap or normal <= 0.0:
        return FREE, 0.0, 0.0
    trial = e + T * ux_dot
    if trial >= normal * (1.0 - 1e-12):
        return SLIP, normal, normal
    if trial <= -normal * (1.0 - 1e-12):
        return SLIP_BACK, -normal, normal
    return STICK, trial, normal


@_jit
def observe(e, s, y, z, z_dot, gap, w, T, v, decay, h, sums, F_x, F_z, slip, mode):
    """Forces, modes and energies of a marched stretch of m steps, each energy from its own definition.

    e, s: (m + 1, n) states at the instants. y: (m + 3,) body, from two steps before the first. z, z_dot: (m + 1,).
    Adds to sums (N_SUMS,); fills F_x, F_z (m,) with the forces at the end of each step, slip (m,) with the least slip
    velocity of a spring in contact, at its touch where it touched within the step (infinite when none is in contact),
    and mode (m, n), or (0, n) for none.
    """
    rate = 1.0 / T if T > 0.0 else 0.0
    for k in range(e.shape[0] - 1):
        du = v * h + (y[k + 3] - y[k + 2])
        ux_dot = v + (3.0 * y[k + 3] - 4.0 * y[k + 2] + y[k + 1]) / (2.0 * h)
        ux_dot_0 = v + (3.0 * y[k + 2] - 4.0 * y[k + 1] + y[k]) / (2.0 * h)
        growth = ((ux_dot - z_dot[k + 1]) - (ux_dot_0 - z_dot[k])) / h  # of the common slip velocity
        dz = z[k + 1] - z[k]
        slip[k] = np.inf
        F_x[k] = 0.0
        F_z[k] = 0.0
        for i in range(e.shape[1]):
            e_0, e_1, s_0, s_1 = e[k, i], e[k + 1, i], s[k, i], s[k + 1, i]
            now, tangential, normal = mode_and_forces(e_1, s_1, gap[i], z[k + 1], z_dot[k + 1], ux_dot, T)
            F_x[k] += w[i] * tangential
            F_z[k] += w[i] * normal
            if mode.shape[0] > 0:
                mode[k, i] = now
            sums[STICK_TIME] += w[i] * normal * h if now == STICK else 0.0
            sums[CONTACT_TIME] += w[i] * normal * h
            sums[SUM_E] += 0.5 * w[i] * (e_0 + e_1)
            sums[SUM_S] += 0.5 * w[i] * (s_0 + s_1)
            # the step falls into a free part and a part in contact, as in the march
            rise = max(s_1 - s_0 * decay, 0.0)
            ahead = max(s_0 - (z[k] - gap[i]), 0.0)
            touched = rise / (rise + ahead) if rise > 0.0 else 0.0
            touched *= 1.0 - bend_of(z_dot[k] + s_0 * rate, z_dot[k + 1] + s_0 * decay * rate) * (1.0 - touched)
            if touched == 0.0 and ahead == 0.0:
                touched = 1.0 if s_1 > 0.0 else 0.0
            relaxed = 1.0 - (1.0 - touched) * (1.0 - decay)
            normal_impulse = 0.5 * h * (s_0 + s_1) + T * (s_1 - s_0)
            shear_impulse = 0.5 * h * (e_0 + e_1) + T * (e_1 - e_0)
            if touched > 0.0:
                slipped = touched * du - (e_1 - e_0 * relaxed)
                slip_rate = slipped / (touched * h)
                sums[FRICTION_LOSS] += w[i] * max(normal_impulse, 0.0) * abs(slip_rate)
                sums[SHEAR_VISCOUS] += w[i] * T * (e_1 - e_0 * relaxed) ** 2 / (touched * h)
                sums[NORMAL_VISCOUS] += w[i] * T * (s_1 - s_0 * relaxed) ** 2 / (touched * h)
                if touched > 1e-3 and s_1 == z[k + 1] - gap[i] and s_1 > 0.0:
                    at_touch = slip_rate - 0.5 * touched * h * max(growth, 0.0) if touched < 0.999999 else slip_rate
                    slip[k] = min(slip[k], at_touch)
            if touched < 1.0:
                sums[SHEAR_VISCOUS] += w[i] * T * (e_0 * (1.0 - relaxed)) ** 2 / ((1.0 - touched) * h)
                sums[NORMAL_VISCOUS] += w[i] * T * (s_0 * (1.0 - relaxed)) ** 2 / ((1.0 - touched) * h)
            sums[SHEAR_WORK] += w[i] * shear_impulse * du / h
            sums[NORMAL_WORK] += w[i] * normal_impulse * dz / h
        sums[LEAST_SLIP] = min(sums[LEAST_SLIP], slip[k])
