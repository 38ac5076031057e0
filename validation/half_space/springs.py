"""The springs of the Method of Dimensionality Reduction in the very steps of the half-space: like with like.

Implicit, of first order in the step, in plain NumPy; shares nothing with the library's march.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mdr.tools.arrays import Array


def forces(
    profile: Callable[[Array], Array],
    radius: float,
    depth: Array,
    way: Array,
    dt: float,
    mu_0: float,
    kappa: float,
    tau: float = 0.0,
    n_springs: int = 4000,
) -> tuple[Array, Array]:
    """F_x and F_z over E* at the instants of depth and way (n_steps + 1,), from full slip at the first one.

    profile(x) is the one-dimensional g, of a contact that never grows beyond `radius`.
    """
    width = radius / n_springs
    x = width * (np.arange(n_springs) + 0.5)
    g, theta, limit = profile(x), tau / dt, mu_0 * kappa
    s = np.maximum(depth[0] - g, 0.0)
    e = limit * s
    F_x, F_z = [limit * 2 * np.sum(s * width) / kappa], [2 * np.sum(s * width)]
    for i in range(1, len(depth)):
        touching = (1 + theta) * (depth[i] - g) - theta * s
        f_z = np.maximum(touching, 0.0)
        f_x = np.clip(e + (1 + theta) * (way[i] - way[i - 1]), -limit * f_z, limit * f_z)
        s, e = (f_z + theta * s) / (1 + theta), (f_x + theta * e) / (1 + theta)
        F_x.append(2 * np.sum(f_x * width) / kappa)
        F_z.append(2 * np.sum(f_z * width))
    return np.array(F_x), np.array(F_z)
