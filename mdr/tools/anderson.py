"""Anderson's method (1965; Walker & Ni 2011): of the last few iterates the combination that changes least."""

from __future__ import annotations

import numpy as np

from mdr.tools.arrays import Array
from mdr.tools.jit import compiled


@compiled(nogil=True, error_model="numpy")
def shares(steps: Array, last: Array, rcond: float) -> Array:
    """Shares (n,) of the steps from change to change, to be taken off the last change so that least is left of it.

    steps: (n, k), oldest first, real vectors whose length measures a change; last: (k,). Taken off the last iterate
    alike, the shares make the next one. They are found by orthogonal directions, the newest step first; a step of
    which the newer ones leave less than rcond of the greatest is left out.
    """
    n, k = steps.shape
    greatest = 0.0
    for j in range(n):
        size = 0.0
        for m in range(k):
            size += steps[j, m] * steps[j, m]
        greatest = max(greatest, size)
    directions, weights = np.zeros((n, k)), np.zeros((n, n))  # direction i is the sum of weights[i] times the steps
    shared, rest = np.zeros(n), last.copy()
    for j in range(n):
        i = n - 1 - j
        direction, weight = steps[i].copy(), np.zeros(n)
        weight[i] = 1.0
        for _ in range(2):  # once more for what rounding leaves
            for other in range(i + 1, n):
                along = 0.0
                for m in range(k):
                    along += directions[other, m] * direction[m]
                for m in range(k):
                    direction[m] -= along * directions[other, m]
                for m in range(n):
                    weight[m] -= along * weights[other, m]
        left = 0.0
        for m in range(k):
            left += direction[m] * direction[m]
        if left <= rcond * rcond * greatest or left == 0.0:
            continue
        left = np.sqrt(left)
        along = 0.0
        for m in range(k):
            directions[i, m] = direction[m] / left
            along += directions[i, m] * rest[m]
        for m in range(n):
            weights[i, m] = weight[m] / left
            shared[m] += along * weights[i, m]
        for m in range(k):
            rest[m] -= along * directions[i, m]
    return shared
