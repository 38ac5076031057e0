"""Broyden's method (1965) for a few equations of which each look is dear: the matrix of derivatives is learned from
what the last changes have brought.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from mdr.spring.path import FAST, LENT
from mdr.tools.jit import inner

ROOM = 4  #: rows of `past` behind the matrix


@inner(error_model="numpy", fastmath=FAST, **LENT)
def correct(past, left, begins):
    """Fill past[n], n the number of equations, with the change to be made of the unknowns, of which so much is left.

    past (n + ROOM, n): the inverse of the matrix, at first that of unity; the last change, what was left before it, and
    room to work in; updated. left (n,): a tuple.
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
