"""The compiled search for a state that returns after a period, by Anderson's method (1965; Walker & Ni 2011): of the
last few periods the combination whose change over a period is least; from there the march goes on.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.march.dynamics.kernel import N_T
from mdr.march.dynamics.state import within_friction
from mdr.spring.copies import copy, put
from mdr.spring.path import OWN
from mdr.tools.anderson import shares
from mdr.tools.arrays import Array
from mdr.tools.jit import compiled, inner

PATIENCE = 30  #: periods without a smaller change, or with steps that were not solved for, after which it gives up
GROWTH = 4.0  #: of the change over the least seen, at which combinations start anew

# states of a search: that which the next period starts from; that from which the last one did; what it came to; how far
# that was, measured; the image that moved least; the last image, and what was its move
X, START, IMAGE, MOVED, BEST, LAST, LAST_MOVED, STATES = range(8)
IMAGES, MOVES = range(2)  # what is kept of the past: from image to image, oldest first; from move to move, measured
# counts: periods so far, those combined now, the one that moved least, the last ones with an unsolved step; whether it
# has ended; periods before the first combination, and after which it gives up
PERIODS, KEPT, SINCE, UNSOLVED, ENDED, PLAIN, MOST, COUNTS = range(8)
# changes over a period, over the size of the state: the least of those combined, the least of all, and that at which it
# ends
LEAST_KEPT, LEAST, ENOUGH, CHANGES = range(4)

_FAST = {"reassoc", "contract"}
_inner = inner(error_model="numpy", fastmath=_FAST, **OWN)


class Search(NamedTuple):
    """A search on its way, updated in place."""

    states: Array  #: (STATES, n_x)
    past: Array  #: (2, memory, n_x)
    counts: NDArray[np.int64]  #: (COUNTS,)
    changes: Array  #: (CHANGES,)

    @classmethod
    def of(cls, n_x: int, memory: int, plain: int, most: int) -> Search:
        """One that combines so many periods; to be begun."""
        counts = np.zeros(COUNTS, dtype=np.int64)
        counts[PLAIN], counts[MOST] = plain, most
        past = np.empty((2, memory - 1, n_x))
        return cls(np.zeros((STATES, n_x)), past, counts, np.zeros(CHANGES))

    def begin(self, x: Array, enough: float) -> None:
        """Begin at this state; it ends where a period changes no more than is enough."""
        self.states[X] = x
        self.counts[: ENDED + 1] = 0
        self.changes[:ENOUGH], self.changes[ENOUGH] = np.inf, enough


@compiled(nogil=True, error_model="numpy", fastmath=_FAST)
def seek(kernel, block, v, s, most, roots, n_periods, trace, states, past, counts, changes):
    """Go on with a search for so many periods at most, each begun within the cone of friction.

    kernel, block, v: what is marched (kernel.py); s (1 + J, n): compressions at phase 0, most (n,): the longest that
    extensions can be there; roots (n_x,): of stiffness and mass, a state times them is as long as the root of its
    energy. trace: flat, of the last period.
    """
    n_t, room = int(block[N_T]), np.empty_like(s)
    for _ in range(n_periods):
        if counts[ENDED]:
            break
        put(s, room)
        within_friction(states[X], room, most)
        copy(states[X], states[START])
        copy(states[X], states[IMAGE])
        solved = kernel(block, v, states[IMAGE], room, n_t, trace)
        counts[ENDED] = combine(roots, states, past, counts, changes)
        counts[UNSOLVED] = 0 if solved else counts[UNSOLVED] + 1
        if counts[UNSOLVED] > PATIENCE:
            changes[LEAST], counts[ENDED] = np.nan, 1


@_inner
def combine(roots, vectors, past, counts, changes):
    """Take into a search what a period has made of START; whether it has come to its end. If not, X is the state to go
    on from.
    """
    image, start, moved, x = vectors[IMAGE], vectors[START], vectors[MOVED], vectors[X]
    size = change = 0.0
    for i in range(image.size):
        moved[i] = roots[i] * (image[i] - start[i])
        size += (roots[i] * image[i]) ** 2
        change += moved[i] ** 2
    if not np.isfinite(size):
        changes[LEAST] = np.nan
        return True
    change, period, k = np.sqrt(change) / (np.sqrt(size) + 1e-300), counts[PERIODS], counts[KEPT]
    counts[PERIODS] += 1
    if change < changes[LEAST]:
        copy(image, vectors[BEST])
        changes[LEAST], counts[SINCE] = change, period
    if change <= changes[ENOUGH] or period - counts[SINCE] > PATIENCE or counts[PERIODS] >= counts[MOST]:
        return True
    if change > GROWTH * changes[LEAST_KEPT]:
        k, changes[LEAST_KEPT] = 0, np.inf
    elif period > 0:
        if k == past.shape[1]:
            k -= 1
            for of in range(2):
                for j in range(k):
                    copy(past[of, j + 1], past[of, j])
        for i in range(image.size):
            past[IMAGES, k, i], past[MOVES, k, i] = image[i] - vectors[LAST, i], moved[i] - vectors[LAST_MOVED, i]
        k += 1
    counts[KEPT], changes[LEAST_KEPT] = k, min(changes[LEAST_KEPT], change)
    copy(image, x)
    copy(image, vectors[LAST])
    copy(moved, vectors[LAST_MOVED])
    if period >= counts[PLAIN] and k > 0:
        share = shares(past[MOVES, :k], moved, 1e-10)
        for j in range(k):
            for i in range(x.size):
                x[i] -= share[j] * past[IMAGES, j, i]
    return False
