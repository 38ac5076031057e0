"""Factors of the arms and modes of a material over a step, or a part of it; and room to work in."""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mdr.spring.law import phi_of
from mdr.spring.path import FAST, LENT
from mdr.tools.arrays import Array
from mdr.tools.jit import inner

# for each value of a literal numba would compile a function anew: these are none
STEP, PART = np.int64(0), np.int64(1)  #: rows of Times: of the whole step, and of the part of it that is being followed
ALONE = np.int64(0)  #: place of a spring that has arrays of its own


class Times(NamedTuple):
    """Factors of arms and modes over the step, known once, and over the part of it that is followed now."""

    h: float  #: length of the step
    arms: Array  #: (8, 9, J) what arms come to that are held on p t + q t²: see `fill`; rows from 2 on: returned.py
    decay: Array  #: (2, K) exp(-mu_k t)
    pieces: np.int64  #: that a stretch of contact is cut into, by returned.py alone


class Room(NamedTuple):
    """Room to work in."""

    modes: Array  #: (K,) of a compression, or of what is left alone in slip
    vectors: Array  #: (K,) of an extension, of its type
    work: Array  #: (J + K,) of a function whose zero is sought, or of the account of energies
    q: Array  #: (1 + J, n) states whose force is the limit of friction, where that is not Coulomb's (limit.py)
    whole: Array  #: (4 n,) of n springs in a row with friction: what becomes of those that do one thing (whole.py)


class Tools(NamedTuple):
    """Times of a step, and room to work in."""

    times: Times
    room: Room


@inner(forceinline=True, error_model="numpy", fastmath=FAST, **LENT)
def fill(t, modes, arms, times, k):
    """Fill row k of Times for a time t: of x_j, p and q the arm after it takes the parts arms[k, 0:3], the area of
    its force over the time arms[k, 3:6], and its moment arms[k, 6:9].
    """
    if arms is not None:
        for j in range(arms.rho.size):
            one, of, rho = phi_of(t * arms.rate[j]), times.arms[k], arms.rho[j]
            of[0, j], of[1, j], of[2, j] = one[0], t * one[1], 2.0 * t * t * one[2]
            of[3, j], of[4, j], of[5, j] = rho * of[1, j], rho * 0.5 * of[2, j], 2.0 * rho * t * t * t * one[3]
            of[6, j] = rho * t * t * (one[1] - one[2])
            of[7, j] = rho * t * t * t * (one[2] - one[3])
            of[8, j] = 2.0 * rho * t * t * t * t * (one[3] - one[4])
    if modes is not None:
        for j in range(modes.mu.size):
            times.decay[k, j] = np.exp(-modes.mu[j] * t)


@inner(error_model="numpy", fastmath=FAST)
def times_of(h, modes, arms):
    """Times of a step of length h."""
    J = K = 0
    if arms is not None:
        J = arms.rho.size
    if modes is not None:
        K = modes.mu.size
    times = Times(h, np.empty((8, 9, J)), np.empty((2, K)), np.int64(1))
    fill(h, modes, arms, times, STEP)
    return times


@inner(error_model="numpy", fastmath=FAST)
def new_tools(h, modes, arms, zero, n):
    """Tools of a step of length h, for extensions of the type of `zero`, and rows of n springs with friction."""
    times = times_of(h, modes, arms)
    J, K = times.arms.shape[2], times.decay.shape[1]
    of_modes = np.zeros(K)
    vectors = of_modes * zero
    return Tools(times, Room(of_modes, vectors, np.empty(J + K), np.empty((1 + J, n)), np.empty(4 * n)))


@inner(error_model="numpy", fastmath=FAST)
def tools_of(h, modes, arms, tools):
    """The tools of another step, with the same room."""
    return Tools(times_of(h, modes, arms), tools.room)
