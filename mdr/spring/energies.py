"""Energies of a spring over a stretch of a step in one mode, by a rule over its time: what a close look adds up."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.spring.contact_modes import FREE, SLIP_BACK, STICK
from mdr.spring.law import phi_of
from mdr.tools.arrays import Array
from mdr.tools.jit import compiled, inner

# the sums, in this order; of the slip velocity the least of springs that touch or leave
N_SUMS = 9
(
    STICK_IMPULSE,
    CONTACT_IMPULSE,
    SHEAR_WORK,
    SHAKE_WORK,
    NORMAL_WORK,
    FRICTION_LOSS,
    SHEAR_VISCOUS,
    NORMAL_VISCOUS,
    LEAST_SLIP,
) = range(N_SUMS)


def gauss(n: int) -> Array:
    """Nodes and weights (n, 2) of Gauss's rule on 0 to 1."""
    x, w = np.polynomial.legendre.leggauss(n)
    return np.column_stack([0.5 + 0.5 * x, 0.5 * w])


OF_CUBES = gauss(2)  #: exact for what elastic or sticking springs do, which is cubic in time
OF_SLOW_DECAYS = gauss(4)  #: to 1e-9 for energies of decays, over half of their time
OF_DECAYS = gauss(8)  #: to rounding, on parts of the time that double in length, the first half a decay time


class Nodes(NamedTuple):
    """A rule of N nodes over a time, and what that makes of arms and modes up to each of them."""

    u: Array  #: (N,) times
    weight: Array  #: (N,)
    phi: Array  #: (N, 3, J) phi_0, u phi_1 and 2 u² phi_2 of u/theta_j
    decay: Array  #: (N, K) exp(-mu_k u)


@compiled(error_model="numpy", nogil=True)
def nodes_of(t, modes, arms):
    """Gauss's rule over a time for energies of springs in one mode: exact for elastic ones, to rounding for others, on
    parts of the time that double in length where something decays fast.
    """
    J, K, fastest, rule = 0, 0, 0.0, OF_CUBES
    if arms is not None:
        J = arms.rate.size
        for j in range(J):
            fastest = max(fastest, arms.rate[j])
    if modes is not None:
        K = modes.mu.size
        for k in range(K):
            fastest = max(fastest, modes.mu[k])
        rule = OF_SLOW_DECAYS if fastest * t <= 0.5 else OF_DECAYS
    n, per = 1, rule.shape[0]
    while fastest * t * 0.5 ** (n - 1) > 0.5 and n < 60:
        n += 1
    nodes = Nodes(np.empty(n * per), np.empty(n * per), np.empty((n * per, 3, J)), np.empty((n * per, K)))
    for part in range(n):
        start = 0.0 if part == 0 else t * 0.5 ** (n - part)
        length = t * 0.5 ** (n - 1 - part) - start
        for m in range(per):
            g, u = part * per + m, start + length * rule[m, 0]
            nodes.u[g], nodes.weight[g] = u, length * rule[m, 1]
            if arms is not None:
                for j in range(J):
                    values = phi_of(u * arms.rate[j])
                    nodes.phi[g, 0, j], nodes.phi[g, 1, j], nodes.phi[g, 2, j] = (
                        values[0],
                        u * values[1],
                        2.0 * u * u * values[2],
                    )
            if modes is not None:
                for k in range(K):
                    nodes.decay[g, k] = np.exp(-modes.mu[k] * u)
    return nodes


@inner(error_model="numpy", fastmath={"reassoc", "contract"})
def account(sums, mode, s, e, i, w, path, t, whole, T, modes, arms, tools):
    """Energies of a stretch of a step in one mode, each from its own definition, by a rule over its time t.

    whole: the rule over a whole step.
    """
    J, K, nodes = 0, 0, whole if t == tools.h else nodes_of(t, modes, arms)
    sign = -1.0 if mode == SLIP_BACK else 1.0
    z_1, z_2, x_1, x_2 = path.z_1, path.z_2, path.x_1, path.x_2
    if modes is not None and mode != STICK:
        K = modes.mu.size
        for k in range(K):
            press = lag = 0.0
            for j in range(s.shape[0]):
                press += modes.into[k, j] * s[j, i]
                lag += modes.into[k, j] * (e[j, i] if mode == FREE else s[j, i] - sign * e[j, i])
            tools.more[0, k], tools.more[1, k] = press, lag
    if arms is not None:
        J = arms.rho.size
    pressed = slipped = worked = shear_lost = normal_lost = 0.0
    for g in range(nodes.u.size):
        u, weight = nodes.u[g], nodes.weight[g]
        s_rate, x_rate = z_1 + 2.0 * z_2 * u, x_1 + 2.0 * x_2 * u
        e_rate, lag_rate, press_rate = x_rate, 0.0, 0.0
        normal = s[0, i] + u * (z_1 + z_2 * u) + T * s_rate
        if modes is not None and mode != STICK:
            for k in range(K):
                rate = modes.mu[k] * modes.out[0, k] * nodes.decay[g, k]
                press_rate -= rate * tools.more[0, k]
                lag_rate -= rate * tools.more[1, k]
        if mode == FREE:
            s_rate, e_rate = press_rate, lag_rate
        elif mode != STICK:
            e_rate = sign * (s_rate - lag_rate)
        shear, pressure = T * e_rate * e_rate, T * s_rate * s_rate
        if arms is not None:
            for j in range(J):
                s_j = s[1 + j, i] * nodes.phi[g, 0, j] + z_1 * nodes.phi[g, 1, j] + z_2 * nodes.phi[g, 2, j]
                normal += arms.rho[j] * s_j
                if mode == STICK:
                    e_j = e[1 + j, i] * nodes.phi[g, 0, j] + x_1 * nodes.phi[g, 1, j] + x_2 * nodes.phi[g, 2, j]
                else:
                    of_lag = of_press = 0.0
                    for k in range(K):
                        part = modes.out[1 + j, k] * nodes.decay[g, k]
                        of_press += part * tools.more[0, k]
                        of_lag += part * tools.more[1, k]
                    s_j, e_j = (of_press, of_lag) if mode == FREE else (s_j, sign * (s_j - of_lag))
                shear += arms.rho[j] * arms.rate[j] * e_j * e_j
                pressure += arms.rho[j] * arms.rate[j] * s_j * s_j
        shear_lost += weight * shear
        normal_lost += weight * pressure
        pressed += weight * normal
        slipped += weight * normal * abs(x_rate - e_rate)
        worked += weight * normal * s_rate
    sums[SHEAR_VISCOUS] += w * shear_lost
    sums[NORMAL_VISCOUS] += w * normal_lost
    if mode != FREE:
        sums[CONTACT_IMPULSE] += w * pressed
        sums[NORMAL_WORK] += w * worked
        sums[STICK_IMPULSE] += w * pressed if mode == STICK else 0.0
        sums[FRICTION_LOSS] += w * slipped if mode != STICK else 0.0


@inner(error_model="numpy", fastmath={"reassoc", "contract"})
def lost_on_parabola(x, i, p, q, t, T, arms):
    """What dashpot and arms of x[:, i] turn into heat over a time in which it is held on p t + q t²."""
    lost = T * t * (p * p + 2.0 * p * q * t + 4.0 / 3.0 * q * q * t * t)
    if arms is not None:
        for j in range(arms.rho.size):
            for g in range(OF_DECAYS.shape[0]):
                u = t * OF_DECAYS[g, 0]
                zero, one, two, _, _ = phi_of(u * arms.rate[j])
                y = x[1 + j, i] * zero + u * (p * one + 2.0 * q * u * two)
                lost += t * OF_DECAYS[g, 1] * arms.rho[j] * arms.rate[j] * y * y
    return lost
