"""Where the last stick ends, as a linear problem: all slips along the pull, and the depth grows.

At the instant when the depth grows fastest the contact of an elastic body changes like that of a flat punch. With
q_x = mu_0 p, and friction across the pull either fixed in its direction (the way slipped is short, so that slip across
is nothing and q_y follows) or free to turn at once (q_y = 0), rates p' and q_y' satisfy

    u_z' = d',    u_y' = 0 or q_y' = 0        in the contact,

and the surface moves along the pull at u_x'. What moves fastest is what sticks last: at max u_x'. Alone, the pressure
makes mu_0 kappa d' of it everywhere and adds 2 |beta|/pi R(r/a) d' at the trailing edge (validation/end_of_stick.py);
here friction's own doing on the pressure, and between the two directions, is included.
"""

from functools import cache

import numpy as np
from scipy.sparse.linalg import LinearOperator, gmres

from mdr.half_space.friction import MARGIN
from mdr.half_space.influence import X, Y, Z
from mdr.tools.arrays import Array
from validation.half_space.benchmarks import body


@cache
def fastest(n: int, nu: float, mu_0: float, turned: bool) -> float:
    """Greatest u_x' in a flat punch over mu_0 kappa d', so v_0 over Eq. (1) at which the last cell of n x n sticks."""
    half_space, r = body(n, nu, 2 * MARGIN)
    inside = r < 1
    count = int(np.count_nonzero(inside))

    def tractions(unknown: Array) -> Array:
        full = np.zeros((3, n, n))
        full[Z][inside] = unknown[:count]
        full[X] = mu_0 * full[Z]
        if not turned:
            full[Y][inside] = unknown[count:]
        return full

    def conditions(unknown: Array) -> Array:
        u = half_space.displacement(tractions(unknown))
        return u[Z][inside] if turned else np.concatenate([u[Z][inside], u[Y][inside]])

    size = count if turned else 2 * count
    asked = np.zeros(size)
    asked[:count] = 1.0
    found, failed = gmres(LinearOperator((size, size), matvec=conditions), asked, rtol=1e-8, restart=200, maxiter=20)
    if failed:
        raise RuntimeError(f"the rates of {n} x {n} cells are not found in {failed} iterations")
    u_x = half_space.displacement(tractions(found))[X][inside]
    return float(u_x.max()) * half_space.G_star / (half_space.E_star * mu_0)
