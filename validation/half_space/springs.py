"""The springs of the Method of Dimensionality Reduction in the very steps of the half-space: like with like.

Implicit, of first order in the step, in plain NumPy; shares nothing with the library's march.
"""

from collections.abc import Callable

import numpy as np

import mdr
from mdr.half_space.friction import Friction, Settings, path
from mdr.tools.arrays import Array


def of_springs(case: mdr.SlidingContact, v_0: float, settings: Settings) -> Friction:
    """Friction of independent springs in the very steps of `in_three_dimensions`, over all periods."""
    depth, (x, _), dt = path(case, v_0, settings)
    depth = np.append(np.tile(depth[:-1], settings.cycles), depth[-1])
    x = np.append(0.0, np.cumsum(np.tile(np.diff(x), settings.cycles)))
    material = case.material
    indenter, radius = case.indenter, float(case.indenter.contact_radius(depth.max()))
    of_material = case.mu_0, material.mindlin_ratio, material.tau
    F_x, F_z = forces(indenter.profile_1d, radius, depth, x, dt, *of_material)
    F = material.E_star * np.stack([F_x, 0 * F_x, F_z], axis=-1)[1:]
    return Friction.over(F.reshape(settings.cycles, settings.steps, 3))


def forces(
    profile: Callable[[Array], Array],
    radius: float,
    depth: Array,
    x: Array,
    dt: float,
    mu_0: float,
    kappa: float,
    tau: float = 0.0,
    n_springs: int = 4000,
) -> tuple[Array, Array]:
    """F_x and F_z over E* at the instants of depth and x (n_steps + 1,), from full slip at the first one.

    profile is the one-dimensional g, of a contact that never grows beyond `radius`.
    """
    width = radius / n_springs
    g, theta, limit = profile(width * (np.arange(n_springs) + 0.5)), tau / dt, mu_0 * kappa
    s = np.maximum(depth[0] - g, 0.0)
    e = limit * s
    F_x, F_z = [limit * 2 * np.sum(s * width) / kappa], [2 * np.sum(s * width)]
    for i in range(1, len(depth)):
        touching = (1 + theta) * (depth[i] - g) - theta * s
        f_z = np.maximum(touching, 0.0)
        f_x = np.clip(e + (1 + theta) * (x[i] - x[i - 1]), -limit * f_z, limit * f_z)
        s, e = (f_z + theta * s) / (1 + theta), (f_x + theta * e) / (1 + theta)
        F_x.append(2 * np.sum(f_x * width) / kappa)
        F_z.append(2 * np.sum(f_z * width))
    return np.array(F_x), np.array(F_z)
