"""The normal problem of one step: pressure p >= 0 where the gap is closed, no tension where it is open.

Minimises p C p/2 - p g over p >= 0. `g` is what the surface must go down: depth less shape less what other tractions
do.

Both problems of a step, this one and the tangential one, are quadratic with a bound in each cell. Projected Newton
steps solve them: what is at its bound and is pushed against it stays there, everything else moves freely; each step is
a system that conjugate gradients solve, followed by projection on the bounds and a line search on the energy
(Bertsekas, SIAM J. Control Optim. 20 (1982) 221).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mdr.tools.arrays import Array

Product = Callable[[Array], Array]  #: the displacement under tractions


class NotConverged(RuntimeError):
    """A step did not converge; the run stops."""


def pressure(product: Product, g: Array, start: Array, tolerance: float, most: int = 200) -> Array:
    """The pressure (n, n) with product(p) = g where p > 0, and product(p) >= g elsewhere.

    Converged when no residual in contact, and no overlap outside it, exceeds tolerance times the greatest g.
    Raises NotConverged after `most` Newton steps.
    """
    scale = float(np.max(g))
    if scale <= 0:
        return np.zeros_like(g)
    p, g = np.maximum(start, 0.0), np.maximum(g, -scale)  # pressure moves the surface down: none where g < 0
    image = product(p)
    for _ in range(most):
        residual = image - g
        wrong = float(np.max(np.where(p > 0, np.abs(residual), -residual)))
        if wrong <= tolerance * scale:
            return p
        moves = ((p > 0) | (residual < 0)).astype(float)
        step = conjugate_gradients(
            product, residual, lambda v, moves=moves: v * moves, close=coarse(wrong, tolerance * scale)
        )
        p, image = searched(product, p, image, g, step, lambda free: np.maximum(free, 0.0))
    raise NotConverged(f"the normal problem is off by {wrong / scale:.1e} of its depth after {most} steps")


def coarse(off: float, wanted: float) -> float:
    """How closely a step is solved for: it is only a direction, which the line search shortens."""
    return max(1e-2, 0.1 * wanted / off)


def conjugate_gradients(
    product: Product, gradient: Array, free: Product, curvature: Array | float = 0.0, scaling: Array | float = 1.0,
    close: float = 1e-2,
) -> Array:  # fmt: skip
    """The step along `free` directions that takes off a share 1 - close of the gradient.

    curvature: that bounds add to the product; scaling: about the inverse of its diagonal.
    """
    left = -free(gradient)
    step, direction, before = np.zeros_like(left), np.zeros_like(left), np.inf
    enough = close * float(np.linalg.norm(left))
    for _ in range(1000):
        if np.linalg.norm(left) <= enough:
            break
        scaled = scaling * left
        norm = float(np.vdot(left, scaled))
        direction = scaled + norm / before * direction
        before = norm
        image = free(product(direction)) + curvature * direction
        along = norm / float(np.vdot(direction, image))
        step += along * direction
        left -= along * image
    return step


def searched(product: Product, q: Array, image: Array, c: Array, step: Array, project: Product) -> tuple[Array, Array]:
    """The point along the projected step where the energy has fallen enough, and its image."""
    energy = 0.5 * float(np.sum(q * image)) - float(np.sum(q * c))
    gradient, length = image - c, 1.0
    for _ in range(30):
        new = project(q + length * step)
        move = new - q
        fall = float(np.sum(gradient * move))
        new_image = product(new)
        new_energy = 0.5 * float(np.sum(new * new_image)) - float(np.sum(new * c))
        if new_energy <= energy + 1e-4 * fall or abs(fall) <= 1e-15 * abs(energy):
            break
        length /= 2
    return new, new_image
