"""The compiled search for a state that returns after a period: Anderson's method on the march (loop.py)."""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.march.dynamics.loop import copy, march, put, within_friction
from mdr.tools.anderson import shares
from mdr.tools.arrays import Array
from mdr.tools.jit import compiled

_jit = compiled(nogil=True, error_model="numpy", fastmath={"reassoc", "contract"})


# counts of a search: periods so far, those combined now, the one that moved least, the last ones with an unsolved step
PERIODS, KEPT, SINCE, UNSOLVED = range(4)
LEAST, BEST = range(2)  # its changes over a period, over the size of the state: least of those combined, and of all


class Search(NamedTuple):
    """Anderson's method on its way to a state that returns after a period, updated in place. Measured is a state as a
    vector whose length is the root of its energy.
    """

    x: Array  #: (n_x,) the state that the next period starts from
    start: Array  #: (n_x,) the one that the last period started from
    image: Array  #: (n_x,) what it came to
    moved: Array  #: (n_x,) how far that was, measured
    best: Array  #: (n_x,) the image that moved least
    d_image: Array  #: (memory, n_x) from image to image, oldest first
    d_moved: Array  #: (memory, n_x) from move to move, measured
    counts: NDArray[np.int64]  #: (4,)
    changes: Array  #: (2,)
    close: float  #: change at which the search ends
    plain: int  #: periods before the first combination, while springs find their modes
    patience: int  #: periods without a smaller change, or with a step that was not solved for, after which it ends too
    growth: float  #: of the change over the least, at which combinations start anew


@_jit
def combine(at, image, roots):
    """Take into a search what a period has made of at.x; whether the search has come to its end. If not, at.x is the
    state to go on from.
    """
    counts, changes = at.counts, at.changes
    size = change = 0.0
    for i in range(image.size):
        size += (roots[i] * image[i]) ** 2
        change += (roots[i] * (image[i] - at.start[i])) ** 2
    if not np.isfinite(size):
        changes[BEST] = np.nan
        return True
    change = np.sqrt(change) / (np.sqrt(size) + 1e-300)
    period = counts[PERIODS]
    counts[PERIODS] += 1
    if change < changes[BEST]:
        copy(image, at.best)
        changes[BEST], counts[SINCE] = change, period
    if change <= at.close or period - counts[SINCE] > at.patience:
        return True
    if change > at.growth * changes[LEAST]:
        counts[KEPT], changes[LEAST] = 0, np.inf
    elif period > 0:
        if counts[KEPT] == at.d_image.shape[0]:
            for j in range(1, counts[KEPT]):
                for i in range(image.size):
                    at.d_image[j - 1, i], at.d_moved[j - 1, i] = at.d_image[j, i], at.d_moved[j, i]
            counts[KEPT] -= 1
        for i in range(image.size):
            at.d_image[counts[KEPT], i] = image[i] - at.image[i]
            at.d_moved[counts[KEPT], i] = roots[i] * (image[i] - at.start[i]) - at.moved[i]
        counts[KEPT] += 1
    changes[LEAST] = min(changes[LEAST], change)
    for i in range(image.size):
        at.image[i] = at.x[i] = image[i]
        at.moved[i] = roots[i] * (image[i] - at.start[i])
    if period >= at.plain and counts[KEPT] > 0:
        share = shares(at.d_moved[: counts[KEPT]], at.moved, 1e-10)
        for j in range(share.size):
            for i in range(image.size):
                at.x[i] -= share[j] * at.d_image[j, i]
    return False


@_jit
def search(
    at, image, e, s, of_body, s_0, roots, body, side, springs, slip, flight, motion, law, tools, n_periods, trace
):
    """Go on with a search for so many periods, each begun within the cone of friction; whether it has come to its end.

    image (n_x,): room for a state, of which e and of_body are views; s: room, for s_0 (1 + J, n), the compressions at
    the start of a period. trace: of the last period. The others as of `march`.
    """
    n_t, ended = motion.z.size - 1, False
    while n_periods > 0 and not ended:
        n_periods -= 1
        copy(at.x, image)
        put(s_0, s)
        within_friction(e, s)
        copy(image, at.start)
        solved = march(e, s, of_body, body, side, springs, slip, flight, motion, law, tools, n_t, trace)
        ended = combine(at, image, roots)
        at.counts[UNSOLVED] = 0 if solved else at.counts[UNSOLVED] + 1
        if at.counts[UNSOLVED] > at.patience:
            at.changes[BEST], ended = np.nan, True
    return ended
