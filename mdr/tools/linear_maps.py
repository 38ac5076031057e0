"""Small matrices in compiled code, which without LAPACK is compiled in a tenth of the time."""

from __future__ import annotations

import numpy as np

from mdr.tools.arrays import Array
from mdr.tools.jit import compiled

SWEEPS = 30  #: of rotations at most; three or four do for a handful of rows
SQUARINGS = 40  #: a matrix to the power of two to this: its norm tells the radius to 1e-12


@compiled(nogil=True, error_model="numpy")
def made_orthogonal(rows: Array, others: Array) -> Array:
    """Rotate rows (k, n) among each other until they are orthogonal, the longest first, and others (k, m) alike; both
    are updated. Returns their lengths (k,), which are the singular values. One-sided Jacobi rotations (Hestenes 1958).
    """
    k, n = rows.shape
    for _ in range(SWEEPS):
        turned = False
        for p in range(k - 1):
            for q in range(p + 1, k):
                of_p = of_q = both = 0.0
                for i in range(n):
                    of_p += rows[p, i] * rows[p, i]
                    of_q += rows[q, i] * rows[q, i]
                    both += rows[p, i] * rows[q, i]
                if not abs(both) > 1e-15 * np.sqrt(of_p * of_q) and of_p >= of_q:
                    continue
                # an angle of at most 45 degrees makes them orthogonal, 90 degrees more change their order
                zeta = (of_q - of_p) / (2.0 * both) if both != 0.0 else np.inf
                t = 1.0 / (abs(zeta) + np.sqrt(1.0 + zeta * zeta))
                t = -t if zeta < 0.0 else t
                c = 1.0 / np.sqrt(1.0 + t * t)
                s = c * t
                if of_p < of_q:
                    c, s = -s, c
                for i in range(n):
                    a, b = rows[p, i], rows[q, i]
                    rows[p, i], rows[q, i] = c * a - s * b, s * a + c * b
                for i in range(others.shape[1]):
                    a, b = others[p, i], others[q, i]
                    others[p, i], others[q, i] = c * a - s * b, s * a + c * b
                turned = True
        if not turned:
            break
    lengths = np.empty(k)
    for p in range(k):
        lengths[p] = np.sqrt((rows[p] * rows[p]).sum())
    return lengths


@compiled(nogil=True, error_model="numpy")
def spectral_radius(matrix: Array) -> float:
    """The greatest absolute eigenvalue of a matrix (k, k), by the norm of a high power of it (Gelfand 1941)."""
    power, logarithm, k = matrix.copy(), 0.0, len(matrix)
    for j in range(SQUARINGS):
        size = np.sqrt((power * power).sum())
        if size == 0.0:
            return 0.0
        logarithm += np.log(size) / 2.0**j
        power /= size
        square = np.zeros((k, k))
        for a in range(k):
            for b in range(k):
                for c in range(k):
                    square[a, b] += power[a, c] * power[c, b]
        power = square
    return float(np.exp(logarithm))
