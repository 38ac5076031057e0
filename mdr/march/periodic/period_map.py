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
    slowest: float  #: the longest of its slow times; zero where it has none
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
    (kernel, block), body, roots, slow = scaled.in_numbers, scaled.body, roots_of(scaled), slow_times(scaled)
    return PeriodMap(
        block,
        scaled.springs.gap,
        np.argsort(scaled.springs.gap, kind="stable"),
        scaled.normal.s,
        scaled.limit.most,
        scaled.bears,
        roots,
        pushes_of(scaled, roots),
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


def roots_of(scaled: ScaledContact) -> Array:
    """Roots (n_x,) of the stiffness of every spring, of every arm of it and of the pull, and of the mass, in each
    direction: a state vector times them is as long as the root of its energy.
    """
    moduli = np.sqrt(np.append(1.0, scaled.rheology.rho))
    of_springs = np.multiply.outer(moduli, np.sqrt(scaled.springs.w)).ravel()
    bodies = (scaled.body, scaled.body_across)[: scaled.ways]
    of_bodies = np.sqrt([[0.0 if one.rigid else one.K for one in bodies], [one.M for one in bodies]])
    return np.concatenate([np.repeat(of_springs, scaled.ways), np.ravel(of_bodies)])


def pushes_of(scaled: ScaledContact, roots: Array) -> Array:
    """Displacements (k, n_x) of unit length: of each arm of all springs that outlasts a period, and of the position and
    velocity of the body; of the springs themselves where there is neither.
    """
    n, parts, ways = scaled.springs.gap.size, 1 + len(scaled.rheology.rho), scaled.ways
    vectors, moved = np.arange(roots.size).reshape(-1, ways), []
    for way, body in enumerate((scaled.body, scaled.body_across)[:ways]):
        if not body.rigid:
            moved += [vectors[parts * n + part, way] for part in ((Y, RATE) if body.M else (Y,))]
    rows = [1 + j for j, theta in enumerate(scaled.rheology.theta) if theta > FORGOTTEN]
    rows = rows if rows or moved else [0]
    moved += [vectors[j * n : (j + 1) * n, way] for way in range(ways) for j in rows]
    pushes = np.zeros((len(moved), roots.size))
    for push, at in zip(pushes, moved, strict=True):
        push[at] = 1 / np.linalg.norm(np.atleast_1d(roots[at]))
    return pushes


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
