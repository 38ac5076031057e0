"""The state of springs and body between two periods, at phase 0 of the normal motion, as one vector; and what two
states, and the trace of a period between them, tell.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.march.dynamics.body import N_BODY
from mdr.march.dynamics.kernel import N_WAYS, OF_STEP, row_of
from mdr.spring.contact import within
from mdr.spring.path import FAST
from mdr.tools.arrays import Array
from mdr.tools.jit import compiled

#: what is told of a period: COF along the pull and across it, over mu_0; swing of the body; the least velocity, the way
#: of the pull, at which springs would slip that all do so all the time
COF, COF_Y, SWING, LEAST_SLIP, TOLD = range(5)
UNKNOWN = 2.0  #: error of a cof/mu_0 of which nothing is known: it lies between -1 and 1

_jit = compiled(nogil=True, error_model="numpy", fastmath=FAST)


class MarchState:
    """Springs and body between two periods.

    All that friction can change stands in one vector, of which the named parts are views: real along a line, complex
    in the plane.
    """

    __slots__ = ("body", "e", "s", "x")

    def __init__(self, x: Array, s: Array) -> None:
        self.x = x  #: (n_x,) extensions, then the body; real parts and imaginary ones in turn
        vector: NDArray[Any] = x if x.size == s.size + N_BODY else x.view(complex)
        self.s = s  #: (1 + J, n) compressions, and their arms
        self.e: NDArray[Any] = vector[: s.size].reshape(s.shape)  #: (1 + J, n) extensions and arms
        self.body = vector[s.size :]  #: (N_BODY,) see body.py

    @classmethod
    def of(cls, e: NDArray[Any], s: Array, body: NDArray[Any]) -> MarchState:
        """The state of these parts, copied."""
        return cls(np.concatenate([e.ravel(), body]).view(float), s.copy())

    def copy(self) -> MarchState:
        """A state that can be marched on without a change of this one."""
        return MarchState(self.x.copy(), self.s.copy())

    def with_vector(self, x: Array) -> MarchState:
        """The state that a vector stands for; a copy."""
        return MarchState(x.copy(), self.s.copy())


@_jit
def within_friction(x, s):
    """Bring the extensions of a state vector into the cone of friction: combinations of states may leave it."""
    ways = x.size // (s.size + N_BODY)
    for i in range(s.shape[1]):
        if ways == 1:
            x[i] = within(x[i], s[0, i])
        else:
            one = within(complex(x[2 * i], x[2 * i + 1]), s[0, i])
            x[2 * i], x[2 * i + 1] = one.real, one.imag


@_jit
def tell(block, trace, mean_F_z, told):
    """Fill told (TOLD,) with what the last period of a flat trace comes to."""
    _, _, z, z_dot, _ = row_of(block)
    n_t = z.size - 1
    ways, h, n_steps = int(block[N_WAYS]), 2.0 * np.pi / n_t, trace.size // (OF_STEP * int(block[N_WAYS]))
    along = across = swing = 0.0
    for way in range(ways):
        low, high = np.inf, -np.inf
        for k in range(n_steps - n_t, n_steps):
            area, y = trace[ways * k + way], trace[ways * (2 * n_steps + k) + way]
            along, across = (along + area, across) if way == 0 else (along, across + area)
            low, high = min(low, y), max(high, y)
        swing = max(swing, high - low)
    least = np.inf
    for k in range(n_steps - n_t, n_steps):
        if trace[ways * k] > 0.0:
            j, part = k % n_t, ways * (4 * n_steps + 6 * k)
            z_2 = (z_dot[j + 1] - z_dot[j]) / (2.0 * h)
            z_1, t = (z[j + 1] - z[j]) / h - z_2 * h, 0.0
            for _ in range(2):
                length, x_1, x_2 = trace[part], trace[part + ways], trace[part + 2 * ways]
                if length > 0.0:
                    least = min(least, x_1 - z_1 - 2.0 * z_2 * t)
                    t += length
                    least = min(least, x_1 + 2.0 * x_2 * length - z_1 - 2.0 * z_2 * t)
                part += 3 * ways
    period = 2.0 * np.pi * mean_F_z
    told[COF], told[COF_Y], told[SWING], told[LEAST_SLIP] = along / period, across / period, swing, least
