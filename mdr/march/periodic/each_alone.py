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

from dataclasses import dataclass

import numpy as np

from mdr.march.dynamics.state import MarchState
from mdr.march.dynamics.stepper import Stepper
from mdr.march.periodic.orbit import Orbit
from mdr.march.periodic.search import FORGOTTEN
from mdr.march.periodic.settling import Settling
from mdr.tools.arrays import Array
from mdr.tools.iterate import iterate

TURNS = 60  #: of Newton's method; springs at slow pulls meet kinks in a dozen
PUSH = 1e-6  #: displacement that tells the derivative, over the greatest compression at phase 0
FLAT = 1e-9  #: share of itself by which a spring is taken to forget in a period, where it forgets nothing
SHORTER, SHORTEST = 0.25, 0.01  #: shares of a step that is no gain, which are tried
BEFORE = 0.01  #: part of the tolerance at which it ends
CREEPS = 12  #: periods at most in which springs with arms go to where they creep; in most cases six do
SHRINKS = 0.5  #: share of the last move that the next one may have, for what is still to come to be known
WIDER = 0.1  #: of the greatest compression: how far outside of friction a step may take a spring


def search_alone(stepper: Stepper, start: MarchState) -> Orbit | None:
    """The periodic state of every spring, from one of any other; None where it is not found."""
    springs = _Springs(stepper, start)
    x = springs.inside(_real(start.e))
    crept = _Crept(x, x)
    if stepper.scaled.rheology.rho:
        crept = iterate(springs.creep, springs.ended, crept, CREEPS)
    at: _At = crept
    if not springs.ended(at):
        at = iterate(springs.newton, springs.ended, _Stepped(crept.x, crept.x, after=crept.x), TURNS)
    return springs.found(at.place, at.off) if at.off <= springs.enough else None


@dataclass(frozen=True, eq=False)
class _At:
    """A step of the search."""

    x: Array  #: to go on from
    place: Array  #: the place of which it is known how far it is off
    off: float = 1e300  #: how far, as a force


@dataclass(frozen=True, eq=False)
class _Crept(_At):
    last: float = 0.0  #: length of the last move


@dataclass(frozen=True, eq=False)
class _Stepped(_At):
    change: Array | float = np.inf  #: (n,) length of the creep at the place
    after: Array | float = 0.0  #: where the springs would creep from there
    step: Array | float = 0.0  #: Newton's step from there
    part: Array | float = 1.0  #: (n,) of the step, that was taken


class _Springs:
    """Springs of a march; their extensions and arms, x, are real numbers (n_x, n), those across after those along."""

    def __init__(self, stepper: Stepper, like: MarchState) -> None:
        self.stepper, self.like, self.scaled = stepper, like, stepper.scaled
        n_axes, rheology, modes = self.scaled.n_axes, self.scaled.rheology, self.scaled.law.modes
        self.roots = np.sqrt(np.tile(np.r_[1.0, rheology.rho], n_axes))[:, None]
        self.lasting = np.flatnonzero(np.tile(np.r_[True, np.array(rheology.theta) > FORGOTTEN], n_axes))
        limit = self.scaled.limit
        self.farthest = float(limit.most.max()) or float(limit.greatest.max())  # at phase 0 all may be in flight
        self.most = limit.most + WIDER * self.farthest  # how far the vector of each spring may reach
        self.enough = BEFORE * stepper.tolerance * stepper.mean_limit
        self.series: Array = np.eye(len(self.roots))  # what the change of a period comes to under the same force
        if modes is not None:
            left = np.exp(-2 * np.pi * modes.mu) / -np.expm1(-2 * np.pi * modes.mu)
            of_one = np.eye(1 + len(rheology.rho)) + modes.out @ (left[:, None] * modes.into)
            self.series = np.asarray(np.kron(np.eye(n_axes), of_one), dtype=float)

    def inside(self, x: Array) -> Array:
        """Brought to where friction lets extensions be, or a little further."""
        x = x.copy()
        along = x[:: len(x) // self.scaled.n_axes]
        along *= np.minimum(1.0, self.most / np.maximum(_length(along), 1e-300))
        return x

    def marched(self, x: Array) -> Array:
        """The springs a period later."""
        return _real(self.stepper.period(self._state(x)).e)

    def moves(self, image: Array, x: Array) -> tuple[Array, Array]:
        """Displacement by which they would creep after a period that leads to this image, and its lengths (n,)."""
        move = self.series @ (image - x)
        return move, _length(self.roots * move)

    def off(self, moved: Array) -> float:
        """Bound on the mean force that is missing where each spring is off by this vector."""
        return float(_length(self.roots * moved) @ self.scaled.springs.w)

    def ended(self, at: _At) -> bool:
        """Whether they are close enough, or nowhere."""
        return not at.off > self.enough

    def creep(self, at: _Crept) -> _Crept:
        """Go to where the change of a period would make the springs creep."""
        move, _ = self.moves(self.marched(at.x), at.x)
        x, last = self.inside(at.x + move), self.off(move)
        slow = last / max(at.last, 1e-300)  # what is to come is less than the last move
        return _Crept(x, x, last / (1 - slow) if slow <= SHRINKS else max(last, 1e300), last)

    def newton(self, at: _Stepped) -> _Stepped:
        """A step of Newton's method on the map of a period, for each spring."""
        x, part = at.x, np.ones(at.x.shape[1])
        image = self.marched(x)
        move, change = self.moves(image, x)
        worse = ~(change <= at.change)
        if worse.any():  # less of that step, and at last none: on to where it would creep
            part = np.where(worse, SHORTER * at.part, 1.0)
            shorter = np.where(part >= SHORTEST, self.inside(at.place + part * at.step), at.after)
            x = np.where(worse, shorter, x)
            image = self.marched(x)
            move, length = self.moves(image, x)
            change = np.where(worse & (part < SHORTEST), at.change, length)
            part = np.where(part < SHORTEST, 1.0, part)
        turn = np.zeros((x.shape[1], len(x), len(x)))
        for k in self.lasting:
            push = np.zeros_like(x)
            push[k] = np.where(x[k] > 0, -PUSH, PUSH) * self.farthest
            turn[:, :, k] = ((self.marched(x + push) - image) / push[k]).T
        left = (1 + FLAT) * np.eye(len(x)) - turn
        step = np.asarray(np.linalg.solve(left, (image - x).T[:, :, None])[:, :, 0].T, dtype=float)
        off = self.off(step)
        step *= np.minimum(1.0, 2 * self.farthest / np.maximum(_length(step), 1e-300))
        return _Stepped(self.inside(x + step), x, off, change, self.inside(x + move), step, part)

    def found(self, x: Array, off: float) -> Orbit | None:
        """The periodic state next to one that is off by so much; None where springs are late."""
        state, stepper = self._state(x), self.stepper
        end = stepper.period(state.copy())
        if stepper.late(state, end, 1) > stepper.tolerance:
            return None
        cof, cof_y = stepper.cof_of(stepper.last)
        spread = 2 * off / stepper.mean_limit
        settling = Settling(cof, spread, True, "periodic", gain=1.0, across=cof_y)
        return Orbit(end, settling, stepper.least_slip(stepper.last, cof))

    def _state(self, x: Array) -> MarchState:
        parts = self.like.e.shape[0]
        e = x if len(x) == parts else x[:parts] + 1j * x[parts:]
        return MarchState.of(e, self.like.s, self.like.body)


def _length(x: Array) -> Array:
    """Of the vector of each spring."""
    return np.asarray(np.sqrt((x**2).sum(axis=0)))


def _real(e: Array) -> Array:
    """Extensions (1 + J, n) as real numbers (n_x, n)."""
    return np.concatenate([e.real, e.imag]) if np.iscomplexobj(e) else e.copy()
