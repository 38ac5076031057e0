"""Springs whose friction falls as they are let go, and a body that they hold, in many small steps without events.

Nothing here comes from the library. Lengths are in units in which the kinetic limit is L[s], L[x] = x + T x' +
sum_j rho_j x_j as in tiny_steps.py, time is in 1/omega. A spring that sticks is let go where |L[e]| is above
stick L[s]; one that slips has |L[e]| = L[s] until its foot would turn. Backward Euler, of first order; the body goes by
leap-frog.
"""

import math

import numpy as np
from numba import njit


@njit(error_model="numpy")
def cofs(gap, w, motion, way, v, stick, material, body, steps, periods):
    """COF over the kinetic one of each period, from rest in the plane.

    motion, way: depth, and way of a shake, over a period (steps + 1,). material: T, rho, theta. body: M, C, K;
    an infinite K does not yield.
    """
    (T, rho, theta), (M, C, K), h, n, J = material, body, 2 * math.pi / steps, gap.size, material[1].size
    s, e, slips, y, rate = np.zeros((1 + J, n)), np.zeros((1 + J, n)), np.zeros(n), 0.0, 0.0 if math.isinf(K) else -v
    touched = np.zeros(n, dtype=np.bool_)
    keep = 1 / (1 + h / theta)
    stiff, out = 1 + T / h + (rho * keep).sum(), np.zeros(periods)
    for period in range(periods):
        shear = press = 0.0
        for step in range(steps):
            dx, force = h * (v + rate) + way[step + 1] - way[step], 0.0
            for i in range(n):
                fs, fe = s[0, i], e[0, i]  # forces without a move
                for j in range(J):
                    fs, fe = fs + rho[j] * keep[j] * s[1 + j, i], fe + rho[j] * keep[j] * e[1 + j, i]
                p = max(fs + stiff * (motion[step + 1] - gap[i] - s[0, i]), 0.0)
                dz = motion[step + 1] - motion[step]
                now = 1.0 if touched[i] or p == 0 or dz <= 0 else min((p - fs) / (stiff * dz), 1.0)  # since the touch
                f = fe + stiff * now * dx  # what it is in stick
                if slips[i] * (f - slips[i] * p) <= 0:
                    slips[i] = 0.0
                if slips[i] == 0.0 and abs(f) > stick * p:
                    slips[i] = math.copysign(1.0, f)
                if slips[i] != 0.0:
                    f = slips[i] * p
                ds, de = (p - fs) / stiff, (f - fe) / stiff
                s[0, i], e[0, i] = s[0, i] + ds, e[0, i] + de
                for j in range(J):
                    s[1 + j, i], e[1 + j, i] = keep[j] * (s[1 + j, i] + ds), keep[j] * (e[1 + j, i] + de)
                touched[i] = p > 0
                slips[i] = slips[i] if touched[i] else 0.0
                force, press = force + w[i] * f, press + w[i] * p
            shear += force
            if math.inf > K:
                y += h * rate
                rate = (rate * (M - 0.5 * h * C) - h * (force + K * y)) / (M + 0.5 * h * C)
        out[period] = shear / press
    return out
