"""Energies of a spring over a stretch of a step in one mode, which a close look adds up; disc.py has those of slip that
turns.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.spring.law import phi_of
from mdr.spring.path import FAST, LENT, OWN, along
from mdr.tools.arrays import Array
from mdr.tools.jit import inner

_inline = inner(forceinline=True, error_model="numpy", fastmath=FAST, **LENT)
_own = inner(error_model="numpy", fastmath=FAST, **OWN)

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


@inner(error_model="numpy", **OWN)
def nodes_of(t, modes, arms):
    """Gauss's rule over a time for energies of springs in one mode: exact for elastic ones, to rounding for others, on
    parts of the time that double in length where something decays fast.
    """
    J, K, fastest, rule = 0, 0, 0.0, OF_CUBES
    if arms is not None:
        J = arms.rate.size
        for j in range(J):  # numba takes half a second to compile the maximum of an array
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
                    of, values = nodes.phi[g], phi_of(u * arms.rate[j])
                    of[0, j], of[1, j], of[2, j] = values[0], u * values[1], 2.0 * u * u * values[2]
            if modes is not None:
                for k in range(K):
                    nodes.decay[g, k] = np.exp(-modes.mu[k] * u)
    return nodes


@_inline
def stored(x, i, arms):
    """Elastic energy of x[:, i]."""
    energy = along(x[0, i], x[0, i])
    if arms is not None:
        for j in range(arms.rho.size):
            energy += arms.rho[j] * along(x[1 + j, i], x[1 + j, i])
    return 0.5 * energy


@_inline
def lost_on(nodes, x, i, p, q, T, arms):
    """Heat of dashpot and arms of x[:, i] over a time in which it is held on p t + q t²."""
    lost = 0.0
    for g in range(nodes.u.size):
        rate = p + 2.0 * q * nodes.u[g]
        power = T * along(rate, rate)
        if arms is not None:
            for j in range(arms.rho.size):
                y = x[1 + j, i] * nodes.phi[g, 0, j] + p * nodes.phi[g, 1, j] + q * nodes.phi[g, 2, j]
                power += arms.rho[j] * arms.rate[j] * along(y, y)
        lost += nodes.weight[g] * power
    return lost


@_own
def lost_on_parabola(x, i, p, q, t, h, whole, T, modes, arms):
    """Heat of dashpot and arms of x[:, i] over a time t in which it is held on p t + q t²."""
    return lost_on(whole if t == h else nodes_of(t, modes, arms), x, i, p, q, T, arms)


@_own
def of_slipping(sums, w, sign, s, e, i, z, x, t, h, whole, T, modes, arms, more):
    """The tangential part of a stretch of slip along a line: the end of the spring follows e = sign (s - what is left
    alone). more (K,): room.
    """
    (z_1, z_2), (x_1, x_2), K, nodes = z, x, 0, whole if t == h else nodes_of(t, modes, arms)
    if modes is not None:
        K = modes.mu.size
        for k in range(K):
            more[k] = 0.0
            for j in range(s.shape[0]):
                more[k] += modes.into[k, j] * (s[j, i] - sign * e[j, i])
    lost = slipped = 0.0
    for g in range(nodes.u.size):
        u = nodes.u[g]
        s_rate, left_rate = z_1 + 2.0 * z_2 * u, 0.0
        normal = s[0, i] + u * (z_1 + z_2 * u) + T * s_rate
        if modes is not None:
            for k in range(K):
                left_rate -= modes.mu[k] * modes.out[0, k] * nodes.decay[g, k] * more[k]
        e_rate = sign * (s_rate - left_rate)
        power = T * e_rate * e_rate
        if arms is not None:
            for j in range(arms.rho.size):
                s_j = s[1 + j, i] * nodes.phi[g, 0, j] + z_1 * nodes.phi[g, 1, j] + z_2 * nodes.phi[g, 2, j]
                left = 0.0
                for k in range(K):
                    left += modes.out[1 + j, k] * nodes.decay[g, k] * more[k]
                normal += arms.rho[j] * s_j
                power += arms.rho[j] * arms.rate[j] * (s_j - left) ** 2
        lost += nodes.weight[g] * power
        slipped += nodes.weight[g] * normal * abs(x_1 + 2.0 * x_2 * u - e_rate)
    sums[SHEAR_VISCOUS] += w * lost
    sums[FRICTION_LOSS] += w * slipped
