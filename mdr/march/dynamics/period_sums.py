"""What a period of a march comes to, by the state before and after it and its flat trace (kernel.py)."""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

import numpy as np

from mdr.march.dynamics.body import Y
from mdr.march.dynamics.kernel import HEAD, N_ARMS, N_T, N_WAYS, N
from mdr.spring.path import FAST
from mdr.tools.arrays import EXACT
from mdr.tools.jit import compiled

_call = compiled(nogil=True, error_model="numpy", fastmath=FAST)

WITH_IT = 0.5  #: of the way of the pull, on which a spring may go with it or lose and still count as slipping as far


@_call
def mean_and_swing(trace, block):
    """Mean force along the pull and across it, and the swing of the body, greatest less least y in either direction."""
    n_t, ways = int(block[N_T]), int(block[N_WAYS])
    mean, swing = np.zeros(2), 0.0
    for way in range(ways):
        least, greatest = np.inf, -np.inf
        for k in range(n_t):
            y = trace[ways * (2 * n_t + k) + way]
            mean[way] += trace[ways * k + way] / (2.0 * np.pi)
            least, greatest = min(least, y), max(greatest, y)
        swing = max(swing, greatest - least)
    return mean[0], mean[1], swing


@_call
def least_slip(trace, block, mean_limit):
    """Least velocity, the way of the pull, of springs that slip all the time, in a period; zero if some do not. A step
    in which contact begins counts as a whole, if it is not cut there.
    """
    n, n_t, ways, area = int(block[N]), int(block[N_T]), int(block[N_WAYS]), 0.0
    for k in range(n_t):
        area += trace[ways * k]
    if not abs(1.0 - area / (2.0 * np.pi * mean_limit)) <= EXACT:
        return 0.0
    h, z, z_dot, least = 2.0 * np.pi / n_t, HEAD + 2 * n, HEAD + 2 * n + n_t + 1, np.inf
    for k in range(n_t):
        if trace[ways * k] > 0.0:
            part = 4 * n_t + 6 * k + 3
            length, x_1, x_2 = trace[ways * part], trace[ways * (part + 1)], trace[ways * (part + 2)]
            z_2 = (block[z_dot + k + 1] - block[z_dot + k]) / (2.0 * h)
            first = x_1 - (block[z + k + 1] - block[z + k]) / h + z_2 * h - 2.0 * z_2 * (h - length)
            least = min(least, first, first + 2.0 * (x_2 - z_2) * length)
    return least


@_call
def late_share(before, after, block, bears, pull):
    """Share of the friction that springs may still gain which have not slipped as far as the pull went, twice their
    force over that of all, between two states. bears (n,): the greatest force of each; pull: how far it went.
    """
    n, ways, parts = int(block[N]), int(block[N_WAYS]), 1 + int(block[N_ARMS])
    y = ways * (parts * n + Y)
    gone, late = after[y] - before[y], 0.0
    for i in range(n):
        if abs(after[ways * i] - before[ways * i] - gone) > WITH_IT * pull:
            late += bears[i]
    return 2.0 * late
