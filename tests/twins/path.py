"""A contact whose springs are followed in small explicit steps: the twin of paths in the plane, in plain NumPy.

A step tries to stick, and where Coulomb's law forbids it takes the force back to the limit, along itself. Its error is
of first order in the step. Springs stand in equal cells of x.
"""

import numpy as np


def followed(gap, t, u, mu_kappa, parts, T=0.0, rho=(), theta=()):
    """Forces (rows, 3) and their areas (rows, 3) of springs at gaps (n,), mean over the springs, on a path u (rows, 3).

    In units of depth: F_z over the stiffness of all springs, F_x and F_y over mu_0 times that. The material is a
    dashpot of the time T, and arms of moduli rho over that of the spring, times theta.
    """
    rho, theta = np.array(rho, float)[:, None], np.array(theta, float)[:, None]
    way, depth = (u[:, 0] + 1j * u[:, 1]) / mu_kappa, u[:, 2]
    s, e = np.maximum(depth[0] - gap, 0), np.zeros(gap.size, complex)
    s_j, e_j = np.zeros((len(rho), gap.size)), np.zeros((len(rho), gap.size), complex)
    forces, areas, now = [(0.0, 0.0, s.mean())], [(0.0, 0.0, 0.0)], np.array([0.0, 0.0, s.mean()])
    for k in range(1, len(t)):
        dt, x, area = (t[k] - t[k - 1]) / parts, (way[k] - way[k - 1]) / parts, np.zeros(3)
        decay = np.exp(-dt / theta)
        G = 1 + rho.sum() + T / dt
        for part in range(1, parts + 1):
            z = depth[k - 1] + part / parts * (depth[k] - depth[k - 1]) - gap
            f = s + (rho * s_j * decay).sum(axis=0)
            press = np.maximum(z - (s - f / G), 0) * G  # the force that takes it to the indenter
            ds = (press - f) / G
            s, s_j = s + ds, s_j * decay + ds
            f = e + x + (rho * (e_j + x) * decay).sum(axis=0) + T / dt * x
            size = np.abs(f)
            slip = f / np.where(size > 0, size, 1.0) * np.maximum(size - press, 0) / G
            e, e_j = e + x - slip, (e_j + x) * decay - slip
            f = f - G * slip
            before, now = now, np.array([f.real.mean(), f.imag.mean(), press.mean()])
            area += (now + before) / 2 * dt
        forces.append(now)
        areas.append(area)
    return np.array(forces), np.array(areas)
