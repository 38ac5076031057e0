"""Broyden's method (1965) for a few equations that are dear to evaluate: the inverse of their derivatives is learned
from what the last changes of the unknowns have made of the residual.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from mdr.spring.path import FAST, LENT
from mdr.tools.jit import inner

ROOM = 4  #: rows of `past` behind the matrix


@inner(error_model="numpy", fastmath=FAST, **LENT)
def correct(past, left, begins):
    """Fill past[n] with the change of the n unknowns that comes next.

    past (n + ROOM, n), updated: the inverse of the derivatives, at first the unit matrix; the last change, the residual
    before it, and room to work in. left (n,): the residual now, a tuple. begins: whether nothing is learned yet.
    """
    n = past.shape[1]
    inverse, change, before, gives, takes = past[:n], past[n], past[n + 1], past[n + 2], past[n + 3]
    if begins:
        for i in range(n):
            for j in range(n):
                inverse[i, j] = 1.0 if i == j else 0.0
    else:
        size = 0.0
        for i in range(n):
            gives[i] = takes[i] = 0.0
            for j in range(n):
                gives[i] += inverse[i, j] * (left[j] - before[j])
                takes[i] += change[j] * inverse[j, i]
            size += change[i] * gives[i]
        for i in range(n):
            for j in range(n):
                inverse[i, j] += (change[i] - gives[i]) * takes[j] / size if size != 0.0 else 0.0
    for i in range(n):
        before[i], change[i] = left[i], 0.0
        for j in range(n):
            change[i] -= inverse[i, j] * left[j]
