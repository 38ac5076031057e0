"""The normal problem of one step: pressure p >= 0 where the gap is closed, no tension where it is open.

Minimises p C p/2 - p g over p >= 0 by conjugate gradients on the cells in contact (Polonsky and Keer, Wear 231 (1999)
206, here for a prescribed approach). `g` is what the surface must go down: depth less shape less what other tractions
do.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mdr.tools.arrays import Array


class NotConverged(RuntimeError):
    """A step did not converge; the run stops."""


def pressure(product: Callable[[Array], Array], g: Array, start: Array, tolerance: float, most: int = 2000) -> Array:
    """The pressure (n, n) with product(p) = g where p > 0, and product(p) >= g elsewhere.

    Converged when no residual in contact, and no overlap outside it, exceeds tolerance times the greatest g.
    Raises NotConverged after `most` iterations.
    """
    scale = float(np.max(g))
    if scale <= 0:
        return np.zeros_like(g)
    p = np.maximum(start, 0.0)
    if not p.any():
        p = np.where(g > 0, 1e-12 * scale, 0.0)
    direction, before, residual, exact = np.zeros_like(p), np.inf, product(p) - g, True
    for _ in range(most):
        contact = p > 0
        r = np.where(contact, residual, 0.0)
        wrong = np.max(np.abs(r))
        if wrong <= tolerance * scale and np.min(residual) >= -tolerance * scale:
            if exact:
                return p
            residual, exact = product(p) - g, True
            continue
        norm = float(np.sum(r * r))
        direction = np.where(contact, r + norm / before * direction, 0.0)
        before = norm
        image = product(direction)
        curvature = float(np.sum(direction * image))
        step = float(np.sum(r * direction)) / curvature if curvature > 0 else 0.0
        free = p - step * direction
        new = np.maximum(free, 0.0)
        pulled = (new == 0) & (residual < -tolerance * scale) & ~contact
        comes = bool(pulled.any()) and step > 0
        if comes:  # cells that overlap come into contact
            new[pulled] = -step * residual[pulled]
            before = np.inf
        exact = comes or bool(np.any(free < 0))
        # along a step that changes no contact the product is linear, but for rounding, which adds up
        residual = product(new) - g if exact else residual - step * image
        p = new
    raise NotConverged(f"the normal problem is off by {wrong / scale:.1e} of its depth after {most} iterations")
