"""Contacts of one kind and size that are marched together, each for itself, in one compiled call."""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mdr.march.dynamics.body import Y
from mdr.march.dynamics.body_step import put
from mdr.march.dynamics.kernel import HEAD, N_ARMS, N_T, N_WAYS, OF_STEP, Kernel, N
from mdr.march.dynamics.state import TOLD, UNKNOWN, tell, within_friction
from mdr.spring.path import FAST, ROUNDING
from mdr.tools.arrays import Array
from mdr.tools.jit import compiled

LOST = 10 * ROUNDING  #: of a length, way of a spring in a step that is not told from rounding
WITH_IT = 0.5  #: of the way of the pull, on which a spring may go with it or lose and still count as slipping as far

Which = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Marches:
    """C contacts of n springs with J arms, whose states are vectors of n_x numbers (state.py)."""

    kernel: Kernel
    blocks: Array  #: (C, size) see kernel.py
    v: Array  #: (C,) velocity of the pull
    s: Array  #: (C, 1 + J, n) compressions at phase 0
    roots: Array  #: (C, n_x) of stiffness and mass: a state times them is as long as the root of its energy
    pushes: Array  #: (C, k, n_x) displacements of unit length along slow motions
    mean_F_z: Array  #: (C,)
    slow: Array  #: (C,) longest relaxation time of material and pull, in periods, zero without
    n_slow: int  #: how many of these there are
    stable: NDArray[np.bool_]  #: (C,) whether it is guaranteed that with these no multiplier reaches 1

    @property
    def steps(self) -> int:
        """Steps per period."""
        return int(self.blocks[0, N_T])

    @cached_property
    def ways(self) -> int:
        """Directions in which springs are stretched."""
        return int(self.blocks[0, N_WAYS])

    def new_trace(self) -> Array:
        """Room for the flat trace of a period."""
        return np.empty(OF_STEP * self.steps * self.ways)

    def length(self, x: Array, which: Which) -> Array:
        """Roots of the energy of states (m, n_x), or (m, k, n_x), of some of the contacts (m,)."""
        roots = self.roots[which]
        return np.asarray(np.sqrt(((x * (roots if x.ndim == 2 else roots[:, None])) ** 2).sum(axis=-1)))

    def period(self, x: Array, which: Which) -> tuple[Array, Array]:
        """States (m, n_x) of some contacts a period later, and what this comes to (m, TOLD); each begins within the
        cone of friction.
        """
        x, told = np.array(x), np.empty((len(x), TOLD))
        _periods(self.kernel, self.blocks, self.v, self.s, self.mean_F_z, which, x, self.new_trace(), told)
        return x, told

    def late(self, before: Array, after: Array, which: Which, n_periods: int = 1) -> Array:
        """Friction over mu_0 (m,) that springs may still gain which have not slipped as far as the pull went in these
        periods between two states (m, n_x): in a periodic motion each does, however slow the pull, and however little a
        state changes that has hardly moved.
        """
        return lacking(self.blocks[which], self.v[which], after - before, n_periods, self.mean_F_z[which])


def lacking(blocks: Array, v: Array, moved: Array, n_periods: int, mean_F_z: Array) -> Array:
    """See Marches.late; moved (m, n_x): what the states have changed by."""
    n, n_t, n_arms, ways = blocks[0, [N, N_T, N_ARMS, N_WAYS]].astype(int).tolist()
    gap, w = blocks[:, HEAD : HEAD + n], blocks[:, HEAD + n : HEAD + 2 * n]
    deepest, pull = blocks[:, HEAD + 2 * n : HEAD + 2 * n + n_t + 1].max(axis=1), 2 * np.pi * v
    went = moved[:, : ways * n : ways] - moved[:, ways * (n * (1 + n_arms) + Y), None]
    lags = np.abs(went) > (WITH_IT * n_periods * pull)[:, None]
    lacks = 2 * (w * lags * np.maximum(deepest[:, None] - gap, 0.0)).sum(axis=1) / mean_F_z
    hidden = pull <= n_t * LOST * (1 + np.abs(gap).max(axis=1))
    return np.where(hidden, np.where(pull > 0, UNKNOWN, 0.0), lacks)


@compiled(nogil=True, error_model="numpy", fastmath=FAST)
def _periods(kernel, blocks, v, s, mean_F_z, which, x, trace, told):
    """March each state by a period."""
    n_t, room = int(blocks[0, N_T]), np.empty_like(s[0])
    for m in range(which.size):
        c = which[m]
        put(s[c], room)
        within_friction(x[m], room)
        kernel(blocks[c], v[c], x[m], room, n_t, trace)
        tell(blocks[c], trace, mean_F_z[c], told[m])
