"""The search for the periodic state of a contact by shooting (shooting.py): the states that it begins from, and what it
is told of the contact. States are measured by the energy of springs, system spring and mass.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from mdr.march.dynamics.body import RATE, U
from mdr.march.dynamics.dimensionless import ScaledContact
from mdr.march.dynamics.state import MarchState, on_other_springs
from mdr.march.dynamics.stepper import AT_ONCE, Stepper
from mdr.march.periodic.orbit import Orbit, SlowMotions
from mdr.march.periodic.shooting import CREEP, Options, Shooting
from mdr.tools.arrays import Array

FORGOTTEN = 0.3  #: omega times the relaxation time of an arm that keeps exp(-2 pi/0.3) = 8e-10 over a period
SLOW_PULL = 100.0  #: relaxation time of a pull, in periods, from which on it is a slow time as those of a material are
SAME_GAIN = 0.25  #: gain times h², up to which it is known at another resolution too
MEMORY, MOST = 8, 80  #: periods that Anderson's method combines, and after which it gives up
A_TIME = (3, 20)  #: how many more of both for each of the slow times
UNCOMBINED = 3  #: periods marched before the first combination, while springs find their modes


def search(
    stepper: Stepper,
    starts: tuple[MarchState, ...],
    gain: float | None = None,
    near: bool = False,
    motions: SlowMotions | None = None,
) -> Orbit | None:
    """The periodic state that a march would end in, from the first of the starts whose search ends close enough, or
    settled; with slow motions from the first that leads to any. None else.

    gain: bound on the distance from the periodic state, divided by the change in one period, where it is known. near:
    whether the starts are periodic states themselves, found with other steps, springs or velocity. motions: the slow
    motions about them.
    """
    n_before, how, plain = stepper.n_periods, _how(stepper.scaled), 0 if near else UNCOMBINED
    for start in starts:
        shooting = Shooting(stepper, start, how, plain)
        shooting.gain, shooting.motions = gain, motions
        orbit, motions = shooting.shoot(), shooting.motions
        # waiting for slow motions takes far longer
        if orbit is not None and (shooting.is_close or how.slow or orbit.settling.settled):
            return orbit
    stepper.n_periods = n_before
    return None


@lru_cache(maxsize=32)
def _how(scaled: ScaledContact) -> Options:
    """Options of the search for the periodic state of a contact, at any velocity."""
    slow, (roots, places) = _slow_times(scaled), _energy_of(scaled)
    stable = bool(slow) and (scaled.body.rigid or scaled.body.C > 0)
    memory, most = (of + more * len(slow) for of, more in zip((MEMORY, MOST), A_TIME, strict=True))
    at_once = max(1, AT_ONCE // scaled.drive.steps)
    return Options(roots, places, slow, stable, memory, most, at_once)


def _slow_times(scaled: ScaledContact) -> tuple[float, ...]:
    """Times, in periods, of what a period does not relax; CREEP times as much outlasts all of it: of arms, of a dashpot
    of the material, and beside these of the ringing body, 2M/C; of an overdamped pull.
    """
    slow = tuple(theta / (2 * np.pi) for theta in scaled.rheology.theta if theta > FORGOTTEN)
    if 2 * np.pi < scaled.law.T:
        slow += (scaled.law.T / (2 * np.pi),)
    if slow and scaled.body.C:
        slow += (scaled.body.M / (np.pi * scaled.body.C) / CREEP,)
    if scaled.body.pull_time > SLOW_PULL:
        slow += (2 * scaled.body.pull_time / CREEP,)  # a material may be slower than is seen; this is known
    return slow


def search_from_full_slip(stepper: Stepper) -> Orbit | None:
    """The periodic state, from full slip on; on a driven resonance first from the motion to which stick limits it."""
    driven = stepper.resonant()
    return search(stepper, (*(() if driven is None else (driven,)), stepper.full_slip()))


def at_other_resolution(
    state: MarchState, motions: SlowMotions | None, of: ScaledContact, on: ScaledContact
) -> tuple[MarchState, SlowMotions | None]:
    """A state of a march with other springs or steps, and the slow motions about it, on those of this one."""
    parts = [state.x[None]] if motions is None else [state.x[None], motions.before, motions.after]
    xs, gap = np.concatenate(parts), of.springs.gap
    if not np.array_equal(gap, on.springs.gap):
        xs = on_other_springs(xs, gap, of.order, on.springs.gap, on.n_axes)
    if motions is not None:
        k = len(motions.before)
        motions = SlowMotions(xs[1 : 1 + k], xs[1 + k :])
    return MarchState(xs[0], on.normal.s.copy()), motions


def gain_at_other_resolution(gain: float | None, one: ScaledContact, other: ScaledContact) -> float | None:
    """The gain of a march with other springs or steps, whose multipliers differ by h²; None where that may be much."""
    h = max(one.drive.h, other.drive.h)
    return gain / (1 - gain * h**2) if gain is not None and gain * h**2 < SAME_GAIN else None


def _energy_of(scaled: ScaledContact) -> tuple[Array, tuple[Any, ...]]:
    """Roots (n_x,) of the stiffness of every spring, of every arm of it and of the pull, and of the mass, in each
    direction: the square of a state vector times them is twice its energy.

    And the places of slow motions: of the position and velocity of the body, and of each arm of all springs that a
    period does not forget; of the springs themselves where there is neither.
    """
    n_axes, rheology, bodies = scaled.n_axes, scaled.rheology, (scaled.body, scaled.body_across)[: scaled.n_axes]
    of_springs = np.multiply.outer(np.sqrt((1.0, *rheology.rho)), np.sqrt(scaled.springs.w))
    of_bodies = [[0.0 if one.rigid else one.K for one in bodies], [one.M for one in bodies]]
    roots = np.concatenate([np.repeat(of_springs.ravel(), n_axes), np.sqrt(of_bodies).ravel()])
    n, body = of_springs.shape[1], n_axes * of_springs.size  # springs, and where the numbers of the body begin
    places: list[Any] = []
    for axis, one in enumerate(bodies):
        places += [body + n_axes * part + axis for part in ((U, RATE) if one.M else () if one.rigid else (U,))]
    parts = [1 + j for j, theta in enumerate(rheology.theta) if theta > FORGOTTEN]
    parts = parts if parts or places else [0]
    places += [slice(n_axes * j * n + axis, n_axes * (j + 1) * n, n_axes) for axis in range(n_axes) for j in parts]
    return roots, tuple(places)
