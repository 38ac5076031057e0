"""The state of springs and body between two periods, at phase 0 of the normal motion, as one vector."""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.march.dynamics.body import N_BODY
from mdr.spring.limit import NO_MODES
from mdr.spring.path import FAST
from mdr.tools.arrays import Array
from mdr.tools.jit import compiled

UNKNOWN = 2.0  #: error of a cof/mu_0 of which nothing is known: it lies between -1 and 1


class MarchState:
    """Springs and body between two periods.

    All that friction can change stands in one vector, of which the named parts are views: real along a line, complex
    in the plane.
    """

    __slots__ = ("body", "e", "modes", "s", "x")

    def __init__(self, x: Array, s: Array) -> None:
        #: (n_x,) extensions and the body, real parts and imaginary ones in turn; and modes
        self.x = x
        moved = (s.size + N_BODY) * (1 if x.size < 2 * (s.size + N_BODY) else 2)
        vector: NDArray[Any] = x[:moved] if moved == s.size + N_BODY else x[:moved].view(complex)
        self.s = s  #: (1 + J, n) compressions, and their arms
        self.e: NDArray[Any] = vector[: s.size].reshape(s.shape)  #: (1 + J, n) extensions and arms
        self.body = vector[s.size : s.size + N_BODY]  #: (N_BODY,) see body.py
        self.modes = x[moved:]  #: (n,) of the springs where friction falls, else none (limit.py)

    @classmethod
    def of(cls, e: NDArray[Any], s: Array, body: NDArray[Any], modes: Array = NO_MODES) -> MarchState:
        """The state of these parts, copied."""
        return cls(np.concatenate([e.ravel().view(float), body.view(float), modes]), s.copy())

    def copy(self) -> MarchState:
        """A state that can be marched on without a change of this one."""
        return MarchState(self.x.copy(), self.s.copy())


@compiled(nogil=True, error_model="numpy", fastmath=FAST)
def within_friction(x, s, most):
    """Bring the extensions of a state vector into the cone of friction, most (n,), which combinations may leave."""
    n_axes = x.size // (s.size + N_BODY)
    for i in range(s.shape[1]):
        square = 0.0
        for axis in range(n_axes):
            square += x[n_axes * i + axis] ** 2
        if square > most[i] * most[i]:
            for axis in range(n_axes):
                x[n_axes * i + axis] *= most[i] / np.sqrt(square)


@compiled(nogil=True, error_model="numpy", fastmath=FAST)
def on_other_springs(xs, gap, order, on, n_axes):
    """State vectors (k, n_x) of springs with these gaps (n,), and the order of rising ones, on springs with the gaps
    `on` (m,): linear between those, and beyond as the first or the last; where all are one gap, as the last.
    """
    k, n, m = len(xs), gap.size, on.size
    parts = (xs.shape[1] // n_axes - N_BODY) // n
    out = np.empty((k, n_axes * (parts * m + N_BODY)))
    for j in range(k):
        for i in range(n_axes * N_BODY):
            out[j, n_axes * parts * m + i] = xs[j, n_axes * parts * n + i]
    for i in range(m):
        first, last = 0, n - 1
        while last - first > 1:
            middle = (first + last) // 2
            if gap[order[middle]] <= on[i]:
                first = middle
            else:
                last = middle
        a, b = order[first], order[last]
        apart = gap[b] - gap[a]
        share = min(max((on[i] - gap[a]) / apart, 0.0), 1.0) if apart > 0.0 else 1.0
        for j in range(k):
            for part in range(parts):
                for axis in range(n_axes):
                    before, after = xs[j, n_axes * (part * n + a) + axis], xs[j, n_axes * (part * n + b) + axis]
                    out[j, n_axes * (part * m + i) + axis] = before + share * (after - before)
    return out
