"""One period of a march as a map of its state, x -> P(x), with what a search for its fixed point has to know."""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from mdr.march.dynamics.body import RATE, Y
from mdr.march.dynamics.dimensionless import ScaledContact
from mdr.march.dynamics.kernel import N_T, Kernel
from mdr.march.dynamics.state import within_friction
from mdr.march.dynamics.stepper import Stepper
from mdr.spring.copies import copy, put
from mdr.spring.path import FAST, OWN
from mdr.tools.arrays import Array
from mdr.tools.jit import inner

FORGOTTEN = 0.3  #: relaxation time over 1/omega of an arm that keeps 1e-9 of itself over a period
SLOW_PULL = 100.0  #: relaxation time of a pull, in periods, from which on it is a slow time as those of a material are
CREEP = 10.0  #: what outlives the slowest time of a material at most, as strain outlives stress


class Energy(NamedTuple):
    """The norm of energy of states of n_x numbers, and what moves slowly in it."""

    roots: Array  #: (n_x,) of stiffness and mass: a state times them is as long as the root of its energy
    pushes: Array  #: (k, n_x) displacements of unit length along slow motions
    slow: tuple[float, ...]  #: relaxation times of material and pull, in periods, that a period does not relax
    stable: bool  #: whether it is guaranteed that with these no multiplier reaches 1


class PeriodMap(NamedTuple):
    """The map of a period, of n springs with J arms and states of n_x numbers."""

    kernel: Kernel
    block: Array  #: what is marched (kernel.py)
    v: float  #: velocity of the pull
    s: Array  #: (1 + J, n) compressions at phase 0
    most: Array  #: (n,) the longest that extensions can be there
    bears: Array  #: (n,) the most that each spring bears, as a force
    roots: Array  #: (n_x,) of stiffness and mass, as of Energy
    pushes: Array  #: (k, n_x) as of Energy
    slowest: float  #: the longest of its slow times; zero where it has none
    stable: bool  #: as of Energy
    tolerance: float  #: of cof/mu_0, to which the fixed point is to be found
    mean_limit: float  #: mean force of full slip
    hidden_pull: float  #: way of a pull over a period that is not told from rounding
    inertia: float  #: mass of the body, or else the stiffness that moves with it
    has_face: bool  #: whether the face has a shear strength

    @classmethod
    def of(cls, stepper: Stepper) -> PeriodMap:
        """That of a march."""
        scaled, body, energy = stepper.scaled, stepper.scaled.body, energy_of(stepper.scaled)
        inertia = body.M or (1.0 if body.rigid else body.K)  # under a rigid pull that of the springs
        return cls(
            stepper.kernel,
            stepper.block,
            float(stepper.v),
            scaled.normal.s,
            scaled.limit.most,
            scaled.bears,
            energy.roots,
            energy.pushes,
            float(max(energy.slow, default=0.0)),
            energy.stable,
            float(stepper.tolerance),
            stepper.mean_limit,
            stepper.hidden_pull,
            float(inertia),
            scaled.faces is not None,
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


@lru_cache(maxsize=32)
def energy_of(scaled: ScaledContact) -> Energy:
    """That of a contact: the velocity has no part in it."""
    slow, roots = _slow_times(scaled), roots_of(scaled)
    stable = bool(slow) and (scaled.body.rigid or scaled.body.C > 0)
    return Energy(roots, pushes_of(scaled, roots), slow, stable)


def _slow_times(scaled: ScaledContact) -> tuple[float, ...]:
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
