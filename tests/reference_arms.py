"""Springs of any linear rheology from the page, in plain NumPy and tiny steps: an independent twin of the march.

One spring, normal s and tangential e, Maxwell arms q_j and p_j, in scaled form (phase, du_z, mu_0 kappa du_z):

    L[s] = s + T s' + sum rho_j q_j,    q_j' = s' - q_j/theta_j,

contact while L[s] >= 0 with s = z - gap, free L[s] = 0; |L[e]| <= L[s], stick e' = u'. Backward Euler, first order, so
that two step sizes extrapolate. Nothing is shared with mdr.
"""

import numpy as np


def mean_forces(z, gap, v, T, rho, theta, n, n_periods):
    """Mean L[e] and L[s] of springs (n_gap,) over the last of n_periods of n steps, under a rigid pull at v."""
    gap, rho, theta = np.asarray(gap, float), np.asarray(rho, float)[:, None], np.asarray(theta, float)[:, None]
    d = 2 * np.pi / n
    fade = 1 / (1 + d / theta)
    stiffness = 1 + T / d + np.sum(rho * fade)  # change of L over change of s in one step
    s = np.maximum(z(0.0) - gap, 0)
    e = s.copy()
    q, p = np.zeros((2, rho.size, gap.size))
    sums = np.zeros((2, gap.size))
    for k in range(n * n_periods):
        standing = s + np.sum(rho * fade * q, axis=0)  # L[s] if s does not move
        free = s - standing / stiffness
        s_new = np.maximum(z((k + 1) * d) - gap, free)
        normal = standing + stiffness * (s_new - s)
        q, s = fade * (q + (s_new - s)), s_new
        standing = e + np.sum(rho * fade * p, axis=0)
        tangential = np.clip(standing + stiffness * v * d, -normal, normal)
        step = (tangential - standing) / stiffness
        p, e = fade * (p + step), e + step
        if k >= n * (n_periods - 1):
            sums += tangential, normal
    return sums / n


def cof(z, gap, w, v, T, rho, theta, n, n_periods):
    """COF over mu_0 of an array with weights w, extrapolated from n/2 and n steps a period."""
    values = []
    for steps in (n // 2, n):
        shear, normal = mean_forces(z, gap, v, T, rho, theta, steps, n_periods)
        values.append(float(w @ shear) / float(w @ normal))
    return 2 * values[1] - values[0]
