"""The periodic state of springs under a rigid pull, which know nothing of each other: each solved for by itself.

Slow arms hardly move in a period, and friction hardly feels them: it sees the force, and two motions of a spring under
the same force differ by what relaxes without force, in the modes of the material (law.py). So what a period has changed
is a first term of a geometric series in each mode; its sum, the *creep*, is what would come of it under this force.
With arms, springs go there first, in one period each time.

Newton's method on the map of a period follows, for all springs at once: the derivative of each by its own extensions
and arms comes from as many periods as it has of these, but for arms that a period forgets. A step which does not make
the creep of a spring smaller is no gain, and this spring goes to where it would creep instead.

A march misses a little of the slip, so that its periodic state may lie a little outside of friction: what a step of the
search is kept within is wider.
"""

from __future__ import annotations

import numpy as np

from mdr.march.dimensionless import ScaledContact
from mdr.march.orbit_search import FORGOTTEN, Orbit
from mdr.march.steady_state import Settling
from mdr.march.stepper import MarchState, Stepper
from mdr.tools.arrays import Array
from mdr.tools.progress import time_is_over

TURNS = 60  #: of Newton's method; springs at slow pulls meet kinks in a dozen
PUSH = 1e-6  #: displacement that tells the derivative, over the greatest compression
FLAT = 1e-9  #: share of itself by which a spring is taken to forget in a period, where it forgets nothing
SHORTER, SHORTEST = 0.25, 0.01  #: shares of a step that is no gain, which are tried
BEFORE = 0.01  #: part of the tolerance at which it ends
CREEPS = 12  #: periods at most in which springs with arms go to where they creep; in most cases six do
SHRINKS = 0.5  #: share of the last move that the next one may have, for what is still to come to be known
WIDER = 0.1  #: of the greatest compression: how far outside of friction a step may take a spring


def search_alone(stepper: Stepper, start: MarchState) -> Orbit | None:
    """The periodic state of every spring, from one of any other; None where it is not found."""
    scaled = stepper.scaled
    n, w = scaled.springs.gap.size, scaled.springs.w
    lasting = np.tile(np.r_[True, np.array(scaled.rheology.theta) > FORGOTTEN], scaled.ways)
    roots = np.sqrt(np.tile(np.r_[1.0, scaled.rheology.rho], scaled.ways))[:, None]
    farthest = float(start.s[0].max())
    creep = _creep(scaled)
    inside = _Inside(start.s[0], WIDER * farthest, scaled.ways)
    x, moves, enough = inside(_rows(start.e)), [], BEFORE * stepper.tolerance * stepper.mean_F_z
    for _ in range(CREEPS if scaled.rheology.rho else 0):
        if time_is_over():
            return None
        move = creep @ (_marched(stepper, x, start) - x)
        moves.append(float(_length(roots * move) @ w))
        if not np.isfinite(moves[-1]):
            return None
        x = inside(x + move)
        slow = moves[-1] / max(moves[-2], 1e-300) if len(moves) > 1 else 1.0
        if slow <= SHRINKS and moves[-1] / (1 - slow) <= enough:  # what is to come is less than a last move
            return _found(stepper, _state(x, start), moves[-1] / (1 - slow))
    before: Array = np.full(n, np.inf)
    part = np.ones(n)
    last = after = x
    step = np.zeros_like(x)
    for _ in range(TURNS):
        if time_is_over():
            return None
        image = _marched(stepper, x, start)
        move = creep @ (image - x)
        change = _length(roots * move)
        worse = ~(change <= before)
        if worse.any():  # less of that step, and at last none: on to where it was marched to
            part = np.where(worse, SHORTER * part, 1.0)
            shorter = np.where(part >= SHORTEST, inside(last + part * step), after)
            x = np.where(worse, shorter, x)
            image = _marched(stepper, x, start)
            move = creep @ (image - x)
            change = np.where(worse & (part < SHORTEST), before, _length(roots * move))
            part = np.where(part < SHORTEST, 1.0, part)
        turn = np.zeros((n, len(x), len(x)))
        for k in np.flatnonzero(lasting):
            push = np.zeros_like(x)
            push[k] = np.where(x[k] > 0, -PUSH, PUSH) * farthest
            turn[:, :, k] = ((_marched(stepper, x + push, start) - image) / push[k]).T
        moved = image - x
        last, after, before = x, inside(x + move), change
        left = (1 + FLAT) * np.eye(len(x)) - turn
        step = np.asarray(np.linalg.solve(left, moved.T[:, :, None])[:, :, 0].T, dtype=float)
        off = float(_length(roots * step) @ w) / stepper.mean_F_z
        if not np.isfinite(off):
            return None
        if off <= BEFORE * stepper.tolerance:
            return _found(stepper, _state(x, start), off * stepper.mean_F_z)
        step *= np.minimum(1.0, 2 * farthest / np.maximum(_length(step), 1e-300))
        x = inside(x + step)
    return None


def _found(stepper: Stepper, state: MarchState, off: float) -> Orbit | None:
    """The periodic state next to one that is off by so much; None where springs are late."""
    end, periods = stepper.advance(state, 1)
    if stepper.late(state, end, 1) > stepper.tolerance:
        return None
    cof, cof_y = float(periods.cof[-1]), float(periods.cof_y[-1])
    spread = 2 * off / stepper.mean_F_z
    return Orbit(end, periods, Settling(cof, spread, True, "periodic", gain=1.0, across=cof_y))


def _length(x: Array) -> Array:
    """Of the vector of each spring."""
    return np.asarray(np.sqrt((x**2).sum(axis=0)))


def _rows(e: Array) -> Array:
    """Extensions (1 + J, n) as real rows: those across after those along."""
    return np.concatenate([e.real, e.imag]) if np.iscomplexobj(e) else e.copy()


def _state(x: Array, like: MarchState) -> MarchState:
    """The state with these rows."""
    parts = like.e.shape[0]
    return MarchState.of(x if len(x) == parts else x[:parts] + 1j * x[parts:], like.s, like.body)


def _marched(stepper: Stepper, x: Array, like: MarchState) -> Array:
    """The extensions a period later."""
    return _rows(stepper.period(_state(x, like)).e)


def _creep(scaled: ScaledContact) -> Array:
    """What becomes of the changes of a period, of extensions and arms (n_x,), if the force goes on as it was."""
    modes, n = scaled.law.modes, 1 + len(scaled.rheology.rho)
    if modes is None:
        return np.eye(scaled.ways * n)
    left = np.exp(-2 * np.pi * modes.mu) / -np.expm1(-2 * np.pi * modes.mu)
    of_one = np.eye(n) + modes.out @ (left[:, None] * modes.into)
    return np.asarray(np.kron(np.eye(scaled.ways), of_one), dtype=float)


class _Inside:
    """Brings extensions to where friction lets them be, or a little further."""

    def __init__(self, s: Array, wider: float, ways: int) -> None:
        self.most, self.ways = s + wider, ways

    def __call__(self, x: Array) -> Array:
        x = x.copy()
        along = x[:: len(x) // self.ways]
        along *= np.minimum(1.0, self.most / np.maximum(_length(along), 1e-300))
        return x
