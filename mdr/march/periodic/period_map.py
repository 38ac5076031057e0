"""One period of a march as a map of its state, x -> P(x), with what a search for its fixed point has to know."""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.march.dynamics.body import N_BODY, RATE, Y
from mdr.march.dynamics.dimensionless import ScaledContact
from mdr.march.dynamics.kernel import N_T, Kernel
from mdr.march.dynamics.state import within_friction
from mdr.spring.copies import copy, put
from mdr.spring.path import FAST, OWN
from mdr.tools.arrays import Array
from mdr.tools.jit import compiled, inner

FORGOTTEN = 0.3  #: relaxation time over 1/omega of an arm that keeps 1e-9 of itself over a period
SLOW_PULL = 100.0  #: relaxation time of a pull, in periods, from which on it is a slow time as those of a material are
CREEP = 10.0  #: what outlives the slowest time of a material at most, as strain outlives stress


class PeriodMap(NamedTuple):
    """The map of a period, of n springs with J arms and states of n_x numbers."""

    block: Array  #: what is marched (kernel.py)
    gap: Array  #: (n,) of the springs
    order: NDArray[np.int64]  #: (n,) of rising gaps
    s: Array  #: (1 + J, n) compressions at phase 0
    most: Array  #: (n,) the longest that extensions can be there
    bears: Array  #: (n,) the most that each spring bears, as a force
    roots: Array  #: (n_x,) of stiffness and mass: a state times them is as long as the root of its energy
    pushes: Array  #: (k, n_x) displacements of unit length along slow motions
    n_slow: int  #: of its slow times
    slowest: float  #: the longest of these
    stable: bool  #: whether it is guaranteed that with these no multiplier reaches 1
    mean_limit: float  #: mean force of full slip
    hidden_pull: float  #: way of a pull over a period that is not told from rounding
    inertia: float  #: mass of the body, or else the stiffness that moves with it
    has_face: bool  #: whether the face has a shear strength
    v: float  #: velocity of the pull
    tolerance: float  #: of cof/mu_0, to which the fixed point is to be found
    kernel: Kernel


@lru_cache(maxsize=32)
def map_of(scaled: ScaledContact) -> PeriodMap:
    """That of a contact; its velocity and its tolerance are still to be told."""
    (kernel, block), body, slow = scaled.in_numbers, scaled.body, slow_times(scaled)
    return PeriodMap(
        block,
        scaled.springs.gap,
        np.argsort(scaled.springs.gap, kind="stable"),
        scaled.normal.s,
        scaled.limit.most,
        scaled.bears,
        *energy_of(scaled),
        len(slow),
        max(slow, default=0.0),
        bool(slow) and (body.rigid or body.C > 0),
        scaled.limit.mean,
        scaled.hidden_pull,
        body.M or (1.0 if body.rigid else body.K),  # under a rigid pull that of the springs
        scaled.faces is not None,
        0.0,
        0.0,
        kernel,
    )


@inner(error_model="numpy", fastmath=FAST, **OWN)
def marched(of, x, image, trace):
    """A period from x, which is brought within the cone of friction before: its image, updated, and its flat trace.
    Returns whether every step was solved for.
    """
    room = np.empty_like(of.s)
    put(of.s, room)
    within_friction(x, room, of.most)
    copy(x, image)
    return of.kernel(of.block, of.v, image, room, int(of.block[N_T]), trace)


def slow_times(scaled: ScaledContact) -> tuple[float, ...]:
    """Relaxation times, in periods, of what a period does not relax: arms, a dashpot, the pull."""
    slow = tuple(theta / (2 * np.pi) for theta in scaled.rheology.theta if theta > FORGOTTEN)
    if 2 * np.pi < scaled.law.T:
        slow += (scaled.law.T / (2 * np.pi),)
    if slow and scaled.body.C:
        slow += (scaled.body.M / (np.pi * scaled.body.C) / CREEP,)
    if scaled.body.pull_time > SLOW_PULL:
        slow += (2 * scaled.body.pull_time / CREEP,)  # a material may be slower than is seen; this is known
    return slow


def energy_of(scaled: ScaledContact) -> tuple[Array, Array]:
    """Roots (n_x,) of the stiffness of every spring, of every arm of it and of the pull, and of the mass, in each
    direction: a state times them is as long as the root of its energy.

    And displacements (k, n_x) of unit length: of the position and velocity of the body, and of each arm of all springs
    that outlasts a period; of the springs themselves where there is neither.
    """
    bodies, lasting = (scaled.body, scaled.body_across)[: scaled.ways], np.array(scaled.rheology.theta) > FORGOTTEN
    K = np.array([0.0 if body.rigid else body.K for body in bodies])
    rho, M = np.array(scaled.rheology.rho, dtype=float), np.array([body.M for body in bodies])
    rigid = np.array([body.rigid for body in bodies])
    return _energy(scaled.springs.w, rho, lasting, rigid, K, M)  # type: ignore[no-any-return]


@compiled(nogil=True, error_model="numpy")
def _energy(w, rho, lasting, rigid, K, M):
    """Roots and displacements of `energy_of`; rigid, K, M (ways,): of the bodies."""
    n, parts, ways = w.size, 1 + rho.size, K.size
    springs = ways * parts * n
    roots = np.empty(springs + ways * N_BODY)
    for part in range(parts):
        for i in range(n):
            for way in range(ways):
                roots[ways * (part * n + i) + way] = np.sqrt(w[i] * (rho[part - 1] if part > 0 else 1.0))
    for way in range(ways):
        roots[springs + ways * Y + way], roots[springs + ways * RATE + way] = np.sqrt(K[way]), np.sqrt(M[way])
    pushes, k = np.zeros((ways * (N_BODY + parts), roots.size)), 0
    for way in range(ways):
        if not rigid[way]:
            pushes[k, springs + ways * Y + way] = 1.0 / np.sqrt(K[way])
            k += 1
            if M[way] > 0.0:
                pushes[k, springs + ways * RATE + way] = 1.0 / np.sqrt(M[way])
                k += 1
    springs_too = k == 0 and not lasting.any()
    for way in range(ways):
        for part in range(parts):
            if (part > 0 and lasting[part - 1]) or (part == 0 and springs_too):
                length = 0.0
                for i in range(n):
                    length += roots[ways * (part * n + i) + way] ** 2
                for i in range(n):
                    pushes[k, ways * (part * n + i) + way] = 1.0 / np.sqrt(length)
                k += 1
    return roots, pushes[:k].copy()


@compiled(nogil=True, error_model="numpy", fastmath=FAST)
def on_other_springs(xs, gap, order, on, ways):
    """States (k, n_x) of springs with these gaps, and the order of rising ones, on springs with the gaps `on`: linear
    between those, and beyond as the first or the last.
    """
    k, n, m = len(xs), gap.size, on.size
    parts = (xs.shape[1] // ways - N_BODY) // n
    out = np.empty((k, ways * (parts * m + N_BODY)))
    for j in range(k):
        for i in range(ways * N_BODY):
            out[j, ways * parts * m + i] = xs[j, ways * parts * n + i]
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
        share = min(max((on[i] - gap[a]) / apart, 0.0), 1.0) if apart > 0.0 else 0.0
        for j in range(k):
            for part in range(parts):
                for way in range(ways):
                    at, of_a, of_b = (
                        ways * (part * m + i) + way,
                        ways * (part * n + a) + way,
                        ways * (part * n + b) + way,
                    )
                    out[j, at] = xs[j, of_a] + share * (xs[j, of_b] - xs[j, of_a])
    return out
