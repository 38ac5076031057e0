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
from numpy.typing import NDArray
from scipy.sparse.linalg import LinearOperator, cg

from mdr.half_space.normal import NotConverged
from mdr.tools.arrays import EPS, Array

#: to which part of what is left a Newton step is solved: the step is only a direction, which the line search shortens
CLOSE = 1e-2


def traction(
    product: Callable[[Array], Array], c: Array, bound: Array, start: Array, tolerance: float, most: int = 200
) -> Array:
    """The tractions (2, n, n) that satisfy Coulomb's law, and are zero where the bound (n, n) is.

    Converged when no cell can be improved by more than tolerance times the greatest bound, in units of traction.
    Raises NotConverged after `most` Newton steps.
    """
    stiff = 1 / max(float(np.max(np.abs(product(_delta(c))))), 1e-300)  # traction per displacement of one cell
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
        rim, curvature, normal = _rim(q, gradient, bound)
        step = _newton(product, gradient, rim, curvature, normal, bound > 0, stiff)
        q, image = _searched(product, q, image, c, step, bound)
    raise NotConverged(f"friction is off by {np.max(off) / scale:.1e} of its bound after {most} steps")


def _delta(c: Array) -> Array:
    one = np.zeros_like(c)
    one[0, c.shape[1] // 2, c.shape[2] // 2] = 1.0
    return one


def _into_discs(q: Array, bound: Array) -> Array:
    size = np.hypot(*q)
    over = size > bound
    return q * np.where(over, bound / np.where(over, size, 1.0), 1.0)


def _rim(q: Array, gradient: Array, bound: Array) -> tuple[NDArray[np.bool_], Array, Array]:
    """Which cells stay on their rim, the curvature that the rim gives them, and its normals."""
    size = np.hypot(*q)
    normal = np.where(size > 0, q / np.where(size > 0, size, 1.0), 0.0)
    outward = -np.sum(gradient * normal, axis=0)
    at_limit = size >= (1 - 4 * EPS) * bound  # as projected, but for the rounding of ratio, product and length
    rim = at_limit & (bound > 0) & (outward > 0)
    return rim, np.where(rim, outward / np.where(bound > 0, bound, 1.0), 0.0), normal


def _newton(
    product: Callable[[Array], Array],
    gradient: Array,
    rim: NDArray[np.bool_],
    curvature: Array,
    normal: Array,
    alive: NDArray[np.bool_],
    stiff: float,
) -> Array:
    """The step along free directions: conjugate gradients on the projected system, scaled by its diagonal."""

    def free(v: Array) -> Array:
        out = v - np.where(rim, np.sum(v * normal, axis=0), 0.0) * normal
        return np.where(alive, out, 0.0)

    def system(v: Array) -> Array:
        direction = v.reshape(gradient.shape)
        return np.ravel(free(product(direction)) + curvature * direction)

    def scaled(v: Array) -> Array:
        return np.ravel(v.reshape(gradient.shape) / (1 / stiff + curvature))

    size = (gradient.size, gradient.size)
    matrix, diagonal = (LinearOperator(size, matvec=apply, dtype=float) for apply in (system, scaled))
    step: Array = cg(matrix, -np.ravel(free(gradient)), rtol=CLOSE, M=diagonal)[0]
    return step.reshape(gradient.shape)


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
