"""A spring that is held on a parabola, or left alone, by the law of its material (law.py): its state and its
force over a time, and when a function of them comes to zero.

A state x[:, i] is a compression or an extension and its arms: numbers, or vectors of the plane.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

import numpy as np

from mdr.spring.law import phi_of
from mdr.spring.path import FAST, LENT, NEVER, Ends, area_on_parabola, on_parabola, plus, zero_of_parabola
from mdr.tools.jit import inner

_inner = inner(error_model="numpy", fastmath=FAST, **LENT)
_inline = inner(forceinline=True, error_model="numpy", fastmath=FAST, **LENT)

MOST_PARABOLAS = 200  #: to a zero; they double their digits once they are near


@_inner
def glassy(arms):
    """Modulus at once over the long-time one: one, and the moduli of the arms."""
    total = 1.0
    if arms is not None:
        for j in range(arms.rho.size):
            total += arms.rho[j]
    return total


@_inline
def end_force(x, i, rate, T, arms):
    """L of x[:, i], which moves at this rate."""
    f = x[0, i] + T * rate
    if arms is not None:
        for j in range(arms.rho.size):
            f += arms.rho[j] * x[1 + j, i]
    return f


# --- held on p t + q t² ---


@_inline
def arms_ends(x, i, p, q, t, k, tools, arms):
    """Part of the arms of x[:, i] in its force."""
    of, rho, rate = tools.times.arms[k], arms.rho, arms.rate
    v_0 = d_0 = v_1 = d_1 = 0.0 * p
    low = high = 0.0
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
        low += min(bend.real, 0.0)
        high += max(bend.real, 0.0)
    return Ends(v_0, d_0, v_1, d_1, low, high)


@_inline
def held_force(x, i, p, q, t, k, T, tools, arms):
    """The force of x[:, i] for a time t."""
    f = on_parabola(x[0, i], p, q, T, t)
    if arms is not None:
        f = plus(f, 1.0, arms_ends(x, i, p, q, t, k, tools, arms))
    return f


@_inline
def hold(x, i, p, q, t, k, T, tools, arms):
    """Hold x[:, i] for a time t: area and moment of its force."""
    area, moment = area_on_parabola(x[0, i], p, q, T, t)
    x[0, i] += t * (p + q * t)
    if arms is not None:
        of = tools.times.arms[k]
        for j in range(arms.rho.size):
            before = x[1 + j, i]
            x[1 + j, i] = before * of[0, j] + p * of[1, j] + q * of[2, j]
            area += before * of[3, j] + p * of[4, j] + q * of[5, j]
            moment += before * of[6, j] + p * of[7, j] + q * of[8, j]
    return area, moment


# --- left alone ---


@_inline
def into_modes(s, e, i, part, k, tools, modes):
    """The modes of s - part e of spring i, into tools.room.modes; what is left alone for a time, and its rate."""
    of, decay, mu, out, into = tools.room.modes, tools.times.decay, modes.mu, modes.out, modes.into
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
def alone(x, rate, decay):
    """A spring without arms that is left alone, and its rate: a Kelvin one, or an elastic one, of no rate and decay."""
    r, bend = -rate * x, rate * rate * x
    falls, rises = rate * min(-bend, 0.0), rate * max(-bend, 0.0)
    x_1, r_1, d_1 = x * decay, r * decay, bend * decay
    return Ends(x, r, x_1, r_1, min(bend, 0.0), max(bend, 0.0)), Ends(r, bend, r_1, d_1, falls, rises)


@_inline
def of_modes(j, k, of, times, modes):
    """Part j of a state with the modes `of`, at the end of the time that it is left alone."""
    value = 0.0 * of[0]
    for m in range(modes.mu.size):
        value += modes.out[j, m] * of[m] * times.decay[k, m]
    return value


@_inline
def relax(x, i, k, modes, arms, of, times):
    """Leave x[:, i] alone for a time. of (K,): room, of the type of x."""
    if arms is not None:
        for m in range(modes.mu.size):
            of[m] = 0.0
            for j in range(x.shape[0]):
                of[m] += modes.into[m, j] * x[j, i]
        for j in range(x.shape[0]):
            x[j, i] = of_modes(j, k, of, times, modes)
    elif modes is not None:
        x[0, i] *= times.decay[k, 0]
    else:
        x[0, i] = 0.0


# --- until a function of time is zero ---


@_inner
def zero(t, tol, a, b, c, p, q, m, n_arms, n_modes, modes, arms, tools):
    """First time in (0, t) at which a function falls below zero; infinite for none.

    a + b t + c t² + m exp(-t/T), and what n_arms arms held on p t + q t², or n_modes modes, in tools.room.work add. The
    curvature of each of these falls towards zero. So what is negative now bounds all that is to come, and a parabola
    lies below the function: it goes on to where that parabola is zero, until it gets no further.
    """
    work, u = tools.room.work, 0.0
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
    """Time at which L of of_s s + of_e e, which is x, held on p t + q t², falls below zero."""
    if arms is None:
        return zero_of_parabola(f, t, tol, x + T * p, p + 2.0 * T * q, q)
    J = arms.rho.size
    for j in range(J):
        tools.room.work[j] = of_s * s[1 + j, i] + of_e * e[1 + j, i]
    return zero(t, tol, x + T * p, p + 2.0 * T * q, q, p, q, 0.0, J, np.int64(0), modes, arms, tools)


@_inline
def until_alone(f, a, b, c, x, rates, t, tol, modes, arms, tools):
    """Time at which a + b t + c t² and x that is left alone, or its rate, falls below zero; with arms, of
    tools.room.modes.
    """
    if modes is None:
        return zero_of_parabola(f, t, tol, a, b, c)
    if arms is not None:
        for k in range(modes.mu.size):
            tools.room.work[k] = modes.out[0, k] * tools.room.modes[k] * (-modes.mu[k] if rates else 1.0)
    m = x * (-modes.mu[0] if rates else 1.0)
    return zero(t, tol, a, b, c, 0.0, 0.0, m, np.int64(0), modes.mu.size, modes, arms, tools)
