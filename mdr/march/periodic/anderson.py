"""The compiled search for a state that returns after a period, by Anderson's method (1965; Walker & Ni 2011): of the
last few periods the combination whose change over a period is least; from there the march goes on.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.march.periodic.period_map import marched
from mdr.spring.copies import copy
from mdr.spring.path import OWN
from mdr.tools.anderson import shares
from mdr.tools.arrays import Array
from mdr.tools.jit import inner

PATIENCE = 30  #: periods without a smaller change, or with steps that were not solved for, after which it gives up
GROWTH = 4.0  #: of the change over the least seen, at which combinations start anew

# states of a search: that which the next period starts from; that from which the last one did; what it came to; how far
# that was, measured; the image that moved least; the last image, and what was its move; the best one that was come to
# before it was corrected; and the one that was found (shooting.py)
X, START, IMAGE, MOVED, BEST, LAST, LAST_MOVED, SOUGHT, FOUND, STATES = range(10)
IMAGES, MOVES = range(2)  # what is kept of the past: from image to image, oldest first; from move to move, measured
# counts: periods so far, those combined now, the one that moved least, the last ones with an unsolved step; whether it
# has ended; periods before the first combination, and after which it gives up; all that were marched; and of shooting:
# its phase, whether slow motions are known, corrections so far, and those in a row that were no gain
PERIODS, KEPT, SINCE, UNSOLVED, ENDED, PLAIN, MOST, MARCHED, PHASE, KNOWN, TURN, MISSED, COUNTS = range(13)
# changes over a period, over the size of the state: the least of those combined, the least of all, and that at which it
# ends
LEAST_KEPT, LEAST, ENOUGH, CHANGES = range(4)
LAST_PERIOD, OTHER = range(2)  # traces: of Anderson's last period, that others must not overwrite, and of any other

_FAST = {"reassoc", "contract"}
_inner = inner(error_model="numpy", fastmath=_FAST, **OWN)


class Search(NamedTuple):
    """A search on its way, updated in place, of states of n_x numbers that k pushes move slowly."""

    states: Array  #: (STATES, n_x)
    past: Array  #: (2, memory, n_x)
    counts: NDArray[np.int64]  #: (COUNTS,)
    changes: Array  #: (CHANGES,)
    traces: Array  #: (2, n_trace) flat
    slow: Array  #: (2, k, n_x) displacements that outlive a few periods, and what they are a period later
    signs: Array  #: (k,) of the pushes
    told: Array  #: what shooting knows and has found


@_inner
def begin(search, x, enough):
    """Begin a search at a state; it ends where a period changes no more than is enough."""
    counts, changes = search.counts, search.changes
    copy(x, search.states[X])
    counts[PERIODS] = counts[KEPT] = counts[SINCE] = counts[UNSOLVED] = counts[ENDED] = 0
    changes[LEAST_KEPT] = changes[LEAST] = np.inf
    changes[ENOUGH] = enough


@_inner
def seek(of, search, n_periods):
    """Go on with a search for so many periods at most of a PeriodMap, each begun within the cone of friction."""
    states, counts, changes = search.states, search.counts, search.changes
    for _ in range(n_periods):
        if counts[ENDED]:
            break
        copy(states[X], states[START])
        solved = marched(of, states[START], states[IMAGE], search.traces[LAST_PERIOD])
        counts[MARCHED] += 1
        counts[ENDED] = combine(of.roots, states, search.past, counts, changes)
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
