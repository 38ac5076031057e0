"""Anderson's method (1965; Walker & Ni 2011): of the last few iterates the combination that changes least."""

from __future__ import annotations

import numpy as np

from mdr.tools.arrays import Array
from mdr.tools.jit import compiled


@compiled(nogil=True, error_model="numpy")
def shares(steps: Array, last: Array, rcond: float) -> Array:
    """Shares (n,) of the steps from change to change, to be taken off the last change so that least is left of it.

    steps: (n, k), at least one, oldest first, real vectors whose length measures a change; last: (k,). Taken off the
    last iterate alike, the shares make the next one. They are found by orthogonal directions, the newest step first; a
    step of which the newer ones leave less than rcond of the greatest is left out.
    """
    n, k = steps.shape
    greatest = np.sqrt(np.max(np.sum(steps**2, axis=1)))
    ways, weights = np.zeros((n, k)), np.zeros((n, n))  # direction i is the sum of weights[i] times the steps
    shared, rest = np.zeros(n), last.copy()
    for i in range(n - 1, -1, -1):
        way, weight = steps[i].copy(), np.zeros(n)
        weight[i] = 1.0
        for _ in range(2):  # once more for what rounding leaves
            for other in range(i + 1, n):
                along = np.sum(ways[other] * way)
                way -= along * ways[other]
                weight -= along * weights[other]
        left = np.sqrt(np.sum(way**2))
        if left <= rcond * greatest:
            continue
        ways[i], weights[i] = way / left, weight / left
        along = np.sum(ways[i] * rest)
        shared += along * weights[i]
        rest -= along * ways[i]
    return shared
