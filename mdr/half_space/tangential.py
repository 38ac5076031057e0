"""The tangential problem of one step: Coulomb's law with a traction vector, under a pressure that is given.

Minimises q C q/2 - q c over |q| <= b cell by cell. With c the displacement that sticking would ask for, C q - c is then
what the indenter slips over the surface, backwards: zero where |q| < b, and along q where |q| = b, which is Coulomb's
law.

Projected Newton steps: cells inside their disc move freely, cells on its rim along it, where the curvature of the rim
adds what the surplus traction would do; each step is a system that conjugate gradients solve, followed by projection
on the discs and a line search on the energy (Bertsekas, SIAM J. Control Optim. 20 (1982) 221, with discs for bounds).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mdr.half_space.normal import NotConverged
from mdr.tools.arrays import EPS, Array


def traction(
    product: Callable[[Array], Array],
    c: Array,
    bound: Array,
    start: Array,
    tolerance: float,
    most: int = 200,
    stiff: float | None = None,
) -> Array:
    """The tractions (2, n, n) that satisfy Coulomb's law, and are zero where the bound (n, n) is.

    Converged when no cell can be improved by more than tolerance times the greatest bound, in units of traction.
    Raises NotConverged after `most` Newton steps. stiff: `stiffness_of` the product, where it is known.
    """
    stiff = stiffness_of(product, c) if stiff is None else stiff
    scale = float(np.max(bound))
    if scale == 0:
        return np.zeros_like(c)
    q = _into_discs(start, bound)
    image = product(q)
    for _ in range(most):
        gradient = image - c
        off = np.hypot(*(q - _into_discs(q - stiff * gradient, bound)))
        if np.max(off) <= tolerance * scale:
            return q
        # coarsely: the step is only a direction, which the line search shortens
        close = max(1e-2, 0.1 * tolerance * scale / float(np.max(off)))
        step = _newton(product, gradient, q, bound, stiff, close)
        q, image = _searched(product, q, image, c, step, bound)
    raise NotConverged(f"friction is off by {np.max(off) / scale:.1e} of its bound after {most} steps")


def stiffness_of(product: Callable[[Array], Array], like: Array) -> float:
    """Traction on one cell per displacement of it."""
    one = np.zeros_like(like)
    one[0, like.shape[1] // 2, like.shape[2] // 2] = 1.0
    return 1 / max(float(np.max(np.abs(product(one)))), 1e-300)


def _into_discs(q: Array, bound: Array) -> Array:
    size = np.hypot(*q)
    over = size > bound
    return q * np.where(over, bound / np.where(over, size, 1.0), 1.0)


def _rim(q: Array, gradient: Array, bound: Array) -> tuple[Array, Array]:
    """Normal (2, n, n) and curvature (n, n) of the rim, for cells that stay on it; zero elsewhere."""
    size = np.hypot(*q)
    normal = np.where(size > 0, q / np.where(size > 0, size, 1.0), 0.0)
    outward = -np.sum(gradient * normal, axis=0)
    at_limit = size >= (1 - 4 * EPS) * bound  # as projected, but for the rounding of ratio, product and length
    stays = at_limit & (bound > 0) & (outward > 0)
    return np.where(stays, normal, 0.0), np.where(stays, outward / np.where(bound > 0, bound, 1.0), 0.0)


def _newton(
    product: Callable[[Array], Array], gradient: Array, q: Array, bound: Array, stiff: float, close: float
) -> Array:
    """The step along free directions: conjugate gradients on the projected system, scaled by its diagonal."""
    across, curvature = _rim(q, gradient, bound)
    inside = (bound > 0).astype(float)
    scaling = inside / (1 / stiff + curvature)

    def free(v: Array) -> Array:
        out: Array = v * inside
        along = across[0] * v[0]
        along += across[1] * v[1]
        out -= across * along
        return out

    left = -free(gradient)
    step, direction, before = np.zeros_like(left), np.zeros_like(left), np.inf
    enough = close * float(np.linalg.norm(left))
    for _ in range(1000):  # steps of conjugate gradients
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


def _searched(
    product: Callable[[Array], Array], q: Array, image: Array, c: Array, step: Array, bound: Array
) -> tuple[Array, Array]:
    """The point along the projected step where the energy has fallen enough."""
    energy = 0.5 * float(np.sum(q * image)) - float(np.sum(q * c))
    gradient = image - c
    length = 1.0
    for _ in range(30):
        new = _into_discs(q + length * step, bound)
        move = new - q
        fall = float(np.sum(gradient * move))
        new_image = product(new)
        new_energy = 0.5 * float(np.sum(new * new_image)) - float(np.sum(new * c))
        if new_energy <= energy + 1e-4 * fall or abs(fall) <= 1e-15 * abs(energy):
            return new, new_image
        length /= 2
    return new, new_image
