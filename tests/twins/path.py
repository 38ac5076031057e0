"""A contact whose springs are followed in small explicit steps: the twin of paths in the plane, in plain NumPy.

A step tries to stick, and where Coulomb's law forbids it takes the force back to the limit, along itself; a spring that
has not slipped may have a force up to `stick` times that. Its error is of first order in the step. Springs stand in
equal cells of x.
"""

import numpy as np


def followed(gap, t, u, mu_kappa, parts, T=0.0, rho=(), theta=(), stick=1.0):
    """Forces (rows, 3) and their areas (rows, 3) of springs at gaps (n,), mean over the springs, on a path u (rows, 3).

    In units of depth: F_z over the stiffness of all springs, F_x and F_y over mu_0 times that. The material is a
    dashpot of the time T, and arms of moduli rho over that of the spring, times theta.
    """
    rho, theta = np.array(rho, float)[:, None], np.array(theta, float)[:, None]
    way, depth = (u[:, 0] + 1j * u[:, 1]) / mu_kappa, u[:, 2]
    s, e = np.maximum(depth[0] - gap, 0), np.zeros(gap.size, complex)
    s_j, e_j = np.zeros((len(rho), gap.size)), np.zeros((len(rho), gap.size), complex)
    slips, touched, last = np.zeros(gap.size, bool), s > 0, np.zeros(gap.size, complex)
    forces, areas, now = [(0.0, 0.0, s.mean())], [(0.0, 0.0, 0.0)], np.array([0.0, 0.0, s.mean()])
    for k in range(1, len(t)):
        dt, x, area = (t[k] - t[k - 1]) / parts, (way[k] - way[k - 1]) / parts, np.zeros(3)
        decay = np.exp(-dt / theta)
        G = 1 + rho.sum() + T / dt
        for part in range(1, parts + 1):
            z = depth[k - 1] + part / parts * (depth[k] - depth[k - 1]) - gap
            f = s + (rho * s_j * decay).sum(axis=0)
            press = np.maximum(z - (s - f / G), 0) * G  # the force that takes it to the indenter
            ds, touches = (press - f) / G, ~touched & (press > 0) & (stick > 1)
            touched = press > 0
            s, s_j = s + ds, s_j * decay + ds
            f = e + x + (rho * (e_j + x) * decay).sum(axis=0) + T / dt * x
            size, on = np.abs(f), f * last.conj()
            slips &= (on.real > 0) | (np.abs(on.imag) > 1e-9 * np.abs(on))  # one that turns back on a line stops
            slips = size > np.where(slips, 1 + 1e-12, stick) * press  # but for rounding, as it rests
            slips &= ~touches  # when in the step is not known
            slip = f / np.where(size > 0, size, 1.0) * np.where(slips, size - press, 0.0) / G
            slips &= touched
            e, e_j = e + x - slip, (e_j + x) * decay - slip
            f = last = f - G * slip
            before, now = now, np.array([f.real.mean(), f.imag.mean(), press.mean()])
            area += (now + before) / 2 * dt
        forces.append(now)
        areas.append(area)
    return np.array(forces), np.array(areas)
