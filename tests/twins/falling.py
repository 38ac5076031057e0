"""Springs whose friction falls as they are let go, and a body that they hold, in many small steps without events.

Nothing here comes from the library. Lengths are in units in which the kinetic limit is L[s], L[x] = x + T x' +
sum_j rho_j x_j as in tiny_steps.py, time is in 1/omega; along and across the pull are the parts of a complex number.
A spring that sticks is let go where |L[e]| is above stick L[s]; one that slips has |L[e]| = L[s], in the direction of
the force that it would have in stick, until that is no longer than L[s]. Backward Euler, of first order; the body goes
by leap-frog.
"""

import math

import numpy as np
from numba import njit


@njit(error_model="numpy")
def cofs(gap, w, motion, way, v, stick, material, body, side, steps, periods):
    """COF over the kinetic one of each period, complex, from rest in the plane.

    motion, way: depth, and way of a shake, complex, over a period (steps + 1,). material: T, rho, theta. body, side:
    M, C, K along the pull and across it; an infinite K does not yield.
    """
    (T, rho, theta), h, n, J = material, 2 * math.pi / steps, gap.size, material[1].size
    s, e, slips = np.zeros((1 + J, n)), np.zeros((1 + J, n), np.complex128), np.zeros(n, np.bool_)
    y, rate = np.zeros(2), np.array([0.0 if math.isinf(body[2]) else -v, 0.0])
    touched = np.zeros(n, np.bool_)
    keep = 1 / (1 + h / theta)
    stiff, out = 1 + T / h + (rho * keep).sum(), np.zeros(periods, np.complex128)
    for period in range(periods):
        shear, press = 0j, 0.0
        for step in range(steps):
            dx, force = h * (v + complex(rate[0], rate[1])) + way[step + 1] - way[step], 0j
            for i in range(n):
                fs, fe = s[0, i], e[0, i]  # forces without a move
                for j in range(J):
                    fs, fe = fs + rho[j] * keep[j] * s[1 + j, i], fe + rho[j] * keep[j] * e[1 + j, i]
                p = max(fs + stiff * (motion[step + 1] - gap[i] - s[0, i]), 0.0)
                dz = motion[step + 1] - motion[step]
                now = 1.0 if touched[i] or p == 0 or dz <= 0 else min((p - fs) / (stiff * dz), 1.0)  # since the touch
                f = fe + stiff * now * dx  # what it is in stick
                slips[i] = abs(f) > (1.0 if slips[i] else stick) * p
                if slips[i]:
                    f *= p / abs(f)
                ds, de = (p - fs) / stiff, (f - fe) / stiff
                s[0, i], e[0, i] = s[0, i] + ds, e[0, i] + de
                for j in range(J):
                    s[1 + j, i], e[1 + j, i] = keep[j] * (s[1 + j, i] + ds), keep[j] * (e[1 + j, i] + de)
                touched[i] = p > 0
                slips[i] &= touched[i]
                force, press = force + w[i] * f, press + w[i] * p
            shear += force
            for axis, (M, C, K), pull in ((0, body, force.real), (1, side, force.imag)):
                if math.inf > K:
                    y[axis] += h * rate[axis]
                    rate[axis] = (rate[axis] * (M - 0.5 * h * C) - h * (pull + K * y[axis])) / (M + 0.5 * h * C)
        out[period] = shear / press
    return out
