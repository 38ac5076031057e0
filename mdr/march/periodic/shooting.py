"""The periodic state of body and springs by shooting: solved for instead of awaited.

One period of the march is a map x -> P(x) of the state of body and springs; a periodic motion is its fixed point.
Friction under a given normal motion is monotone, so two motions never move apart (validation/uniqueness.py): P is
non-expansive in the norm of energy. Three things follow.

* Where any motion stays bounded there is a fixed point (Browder 1965), and the COF of all of them is one.
* No Floquet multiplier, an eigenvalue of P', lies outside the unit circle: a fixed point need not be tested for
  stability before it is an answer. What the multipliers tell is how far from it a small change over a period can be.
* Along a march the change over a period never grows. So a step of a search that makes it smaller is a gain for good.

A body with little damping rings for hundreds of periods, or beats without end, while its springs forget their past in
one or a few: what has to be found lies close to a plane. Anderson's method (anderson.py) takes of the last few periods
the combination whose change over a period is least, and marches on from there. Where instants of stick make it go
astray, a Newton-Picard method follows (Lust, Roose, Spence & Champneys 1998): the body is pushed in its position and in
its velocity, and the combination of the two displacements that leaves the least change is added, as much of it as makes
the change smaller; the springs follow by marching.

A search stops when the change in a period is so small that the error of the COF is below the tolerance. This limit
follows from the gain as known before. If the gain turns out to be larger, the search goes on to a smaller change.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from mdr.march.dynamics.state import UNKNOWN, MarchState
from mdr.march.dynamics.stepper import Stepper
from mdr.march.periodic.anderson import (
    BEST,
    ENDED,
    ENOUGH,
    IMAGES,
    KEPT,
    LEAST,
    MOVES,
    PERIODS,
    SINCE,
    START,
    Search,
    seek,
)
from mdr.march.periodic.orbit import Orbit, SlowMotions
from mdr.march.periodic.settling import LATE, Settling
from mdr.tools.arrays import EXACT, Array
from mdr.tools.iterate import iterate
from mdr.tools.progress import time_is_over

FULL = EXACT  #: what is missing in the COF in full slip
SHARE = 20.0  #: safety: a search first stops at a change of tolerance/(SHARE gain); COFs are off by twice the distance
SOLVED_TOLERANCE = 1e-5  #: of cof/mu_0, bound on the error of a periodic state that was solved for; cof_error has it
CLOSE = 1e-10  #: change over a period, over the size of the state, that any answer may have
CLOSEST = 1e-13  #: the same that can be reached: some roundings
PUSH = 1e-4  #: displacement of the body, over the size of the state
FARTHEST = 0.1  #: the same, where the motion has kinks
BETWEEN = 2  #: periods between a push and the measurement, in which springs fall in with the body
DIED_OUT = 1e-5  #: of a push: what is left of it is not told from what a step of the march leaves unsolved
CREEP = 10.0  #: what outlives the slowest time of a material at most, as strain outlives stress
EXPANDS = 1.01  #: multiplier from which on a map is not one of friction
STABLE = 0.9999  #: largest multiplier told from one, of motions that slow arms make hard to tell apart
AGES = 1e6  #: periods that full slip must last to count as periodic
TURNS = 30  #: corrections of the Newton-Picard method
SHORTEST = 1 / 64  #: share of a correction that is tried before the march goes on without it
LOST = 5  #: corrections one after the other of which no share was a gain, after which it ends


class OutOfTime(Exception):
    """The time limit of the caller is over in the middle of a step."""


@dataclass(frozen=True, eq=False)
class Options:
    """Options of a search for a periodic state, of n_x numbers."""

    roots: Array  #: (n_x,) of stiffness and mass: a state times them is as long as the root of its energy
    places: tuple[Any, ...]  #: k, one of a number or several, of what moves slowly among the n_x numbers
    slow: tuple[float, ...]  #: relaxation times of material and pull, in periods, that a period does not relax
    stable: bool  #: whether it is guaranteed that with these no multiplier reaches 1
    memory: int  #: periods that Anderson's method combines
    most: int  #: periods after which it gives up
    at_once: int  #: periods between two looks at the clock

    @cached_property
    def pushes(self) -> Array:
        """Displacements (k, n_x) of unit length along the slow motions."""
        pushes = np.zeros((len(self.places), self.roots.size))
        for push, at in zip(pushes, self.places, strict=True):
            push[at] = 1 / np.sqrt(np.sum(self.roots[at] ** 2))
        return pushes


class _Aim(NamedTuple):
    """Next aim of a search."""

    x: Array  #: (n_x,) where it begins
    close: float  #: change over a period, over the size of the state
    over: bool = False  #: whether there is nothing left to go for


class _Correction(NamedTuple):
    """Pushes of the next correction."""

    signs: Array  #: (k,) of its pushes
    push: float = PUSH  #: their length, over the size of the state
    lost: int = 0  #: corrections one after the other that were no gain


class Shooting:
    """A search for the periodic state of a march, from a state on.

    plain: periods before the first combination, while springs find their modes.
    """

    def __init__(self, stepper: Stepper, start: MarchState, how: Options, plain: int) -> None:
        self.stepper, self.how, self.start, self.s = stepper, how, start.x, start.s
        self.search = Search.of(start.x.size, how.memory, plain, how.most)
        self.flat, self.trace = stepper.new_room(1)  # of Anderson's last period, that pushes must not overwrite
        #: bound on the distance from the periodic state over the change in a period, if it is known beforehand; what is
        #: measured depends on how close a state has come
        self.gain: float | None = None
        self.motions: SlowMotions | None = None  #: the slow ones about it, where they are known
        self.found: Orbit | None = None
        self.is_close = False  #: whether what is found is as close to the periodic state as is asked for

    def shoot(self) -> Orbit | None:
        """The periodic state, close enough or the best that there is."""
        first = self.stepper.tolerance / (SHARE * (self.gain or max((1.0, *self.how.slow))))
        with suppress(OutOfTime):
            iterate(self._come_closer, lambda aim: aim.over, _Aim(self.start, first))
        return self.found

    def _come_closer(self, aim: _Aim) -> _Aim:
        """Search for so small a change; the next aim, until what is found is close enough, or comes no closer."""
        stepper, search, close = self.stepper, self.search, aim.close
        self._begin(aim.x, close)
        iterate(self._seek, lambda search: bool(search.counts[ENDED]), search)
        if not (search.counts[ENDED] and np.isfinite(search.changes[LEAST])):
            return aim._replace(over=True)
        best = search.states[BEST].copy()
        last = search.counts[SINCE] == search.counts[PERIODS] - 1  # the last period is that of the best state
        cofs = stepper.cof_of(self.trace)
        if last and (slip := self._slip_for_good(cofs[0])):
            self._tell(best, cofs, slip, np.inf, 0.0)
            self.is_close = True
            return aim._replace(over=True)
        if search.changes[LEAST] > search.changes[ENOUGH]:
            last = False
            iterate(self._correct, self._corrected, _Correction(np.ones(len(self.how.places))), TURNS)
        near = search.changes[LEAST] <= max(search.changes[ENOUGH], CLOSE)
        gain = self.gain
        if near and gain is None:
            gain = self._measured()
        if not near or gain is None:
            return _Aim(best, CLOSE, over=close <= CLOSE)
        spread = self._judge(cofs if last else None, close, gain)
        over = self.is_close or close <= CLOSEST
        return _Aim(search.states[BEST], close * min(0.01, stepper.tolerance / (SHARE * spread + 1e-300)), over)

    def _seek(self, search: Search) -> Search:
        """Some more periods of Anderson's method, in place."""
        stepper, how, before = self.stepper, self.how, int(search.counts[PERIODS])
        most = stepper.scaled.limit.most
        seek(stepper.kernel, stepper.block, stepper.v, self.s, most, how.roots, how.at_once, self.flat, *search)
        stepper.count(int(search.counts[PERIODS]) - before)
        return search

    def _begin(self, x: Array, close: float) -> None:
        """Seek from a state on; what is known of slow motions is combined from the first period on."""
        search = self.search
        search.begin(x, max(close, CLOSEST))
        if self.motions is not None:
            k = min(len(self.motions.after), search.past.shape[1])
            before, after = (of[:k] for of in self.motions)
            search.past[IMAGES, :k], search.past[MOVES, :k] = after, self.how.roots * (after - before)
            search.counts[KEPT] = k

    def _period(self, x: Array) -> Array:
        """The state a period later, which begins within the cone of friction. Raises OutOfTime."""
        if time_is_over():
            raise OutOfTime
        return self.stepper.period(self.stepper.within_friction(MarchState(x.copy(), self.s.copy()))).x

    def _length(self, x: Array) -> float:
        """Root of the energy of a state."""
        return float(np.linalg.norm(self.how.roots * x))

    def _slip_for_good(self, cof: float) -> float:
        """The least slip velocity of the best state if it is one of full slip that is more than AGES times what changes
        over a period; else zero. It need not be close to the exact periodic state: the COF is the same.

        Where a free oscillation is a whole multiple of the drive, full slip has not one periodic motion but many.
        """
        search, stepper, body = self.search, self.stepper, self.stepper.scaled.body
        if not (least := stepper.least_slip(self.trace, cof)):
            return 0.0
        drift = float(search.changes[LEAST]) * self._length(search.states[BEST])
        drift /= np.sqrt(body.M or (1.0 if body.rigid else body.K))  # under a rigid pull that of the springs
        return least if AGES * drift < least < np.inf else 0.0

    def _judge(self, cofs: tuple[float, float] | None, close: float, gain: float) -> float:
        """Take the best state for the periodic one. Returned is how far its COF may be from that of the exact one.

        cofs: of the last period that was marched, if that is its own.
        """
        stepper, search = self.stepper, self.search
        begin, state, trace = search.states[START].copy(), search.states[BEST].copy(), self.trace
        if cofs is None:
            begin = stepper.within_friction(MarchState(state, self.s)).x
            state, trace = self._period(begin), stepper.last
            cofs = stepper.cof_of(trace)
        # all springs together have the stiffness one: the mean force is off by at most twice the distance (SHARE)
        distance = (float(search.changes[LEAST]) + 1e-15) * gain  # 1e-15: rounding
        spread = 2 * distance * self._length(search.states[BEST]) / stepper.mean_limit
        ends = MarchState(begin, self.s), MarchState(state, self.s)
        late = stepper.v > 0 and stepper.late(*ends, 1) > stepper.tolerance
        self._tell(state, cofs, stepper.least_slip(trace, cofs[0]), gain, spread, late)
        settled = spread <= min(stepper.tolerance, SOLVED_TOLERANCE) and not late
        nearly_full = FULL < 1 - cofs[0] < SOLVED_TOLERANCE  # it has to be told from nothing
        self.is_close = bool(settled and (close <= CLOSE or not nearly_full))
        return spread

    def _tell(
        self, x: Array, cofs: tuple[float, float], least_slip: float, gain: float, spread: float, late: bool = False
    ) -> None:
        """Take a state for the one that is found. spread: bound on the error of its COF over mu_0."""
        cof, across = cofs
        if spread <= SOLVED_TOLERANCE and not late:
            settling = Settling(cof, spread, True, "periodic", gain, across=across)
        else:
            why = LATE if late else "a periodic state was found, but it may be too far from the exact one"
            spread = UNKNOWN if late else min(spread, UNKNOWN)
            settling = Settling(cof, spread, False, "unsettled", gain, why, across=across)
        self.found = Orbit(MarchState(x, self.s.copy()), settling, least_slip, self.motions)

    def _pushed(self, signs: Array, push: float) -> tuple[Array, Array, float]:
        """Push the best state by a share of its size. What it comes to after some periods, and a period later (2, n_x);
        what its pushes have become then (2, k, n_x), as displacements from there; their length.

        signs: (k,), of the pushes.
        """
        best = self.search.states[BEST]
        size = push * (self._length(best) or 1.0)  # of a state that is nothing, as in flight, the unit
        x = np.concatenate([best[None], best + size * signs[:, None] * self.how.pushes])
        pairs = np.empty((2, *x.shape))
        for j, one in enumerate(x):
            for _ in range(BETWEEN):
                one = self._period(one)
            pairs[:, j] = one, self._period(one)
        return pairs[:, 0], pairs[:, 1:] - pairs[:, :1], size

    def _measured(self) -> float | None:
        """Bound on the distance to the fixed point over the change over a period, of a state that returns so closely
        that its own change is small beside a push, and blurs what is seen of it; None for a map that expands.
        """
        roots, slow = self.how.roots, max(self.how.slow, default=0.0)
        _, moved, size = self._pushed(np.ones(len(self.how.places)), PUSH)
        before, after = moved * roots / size
        if not np.isfinite(moved).all():
            return None
        left, lengths, right = np.linalg.svd(before.T, full_matrices=False)
        lasts = lengths > DIED_OUT
        if not lasts.any():
            self.motions = SlowMotions(*moved)
            return float(1 / (1 - lengths[0] ** (1 / BETWEEN)))
        images = after.T @ right[lasts].T / lengths[lasts]
        onto = left[:, lasts].T @ images
        missed = float(np.linalg.norm(images - left[:, lasts] @ onto, axis=0).max())
        largest = float(np.abs(np.linalg.eigvals(onto)).max())
        if largest > EXPANDS:
            return None
        self.motions = SlowMotions(*moved)
        if slow and largest < STABLE:
            return 1 / (1 - largest)
        least = float(np.linalg.svd(np.eye(len(onto)) - onto, compute_uv=False)[-1])
        along = 1 / max(least - missed - float(self.search.changes[LEAST]) / PUSH, 1e-300)
        if not slow:
            return along
        creep = -1 / float(np.expm1(-1 / (CREEP * slow)))  # few arms are told apart in so short a time
        return creep if self.how.stable else max(along, creep)

    def _corrected(self, at: _Correction) -> bool:
        """Whether no further correction is asked for, or would be a gain."""
        changes = self.search.changes
        return not changes[LEAST] > changes[ENOUGH] or at.lost >= LOST

    def _correct(self, at: _Correction) -> _Correction:
        """A Newton-Picard correction of the best state along the pushed motions, for one of less change over a period.

        The map has kinks, where stick begins. A correction that has to be cut short meets one; so the next pushes go
        in the same direction and as far, to see the slope on both sides of it.
        """
        search, roots = self.search, self.how.roots
        (begin, image), (before, after), _ = self._pushed(at.signs, at.push)
        size, move = self._length(image) + 1e-300, roots * (image - begin)
        change, turn = float(np.linalg.norm(move)) / size, (roots * (after - before)).T
        search.states[BEST], search.changes[LEAST] = image, change
        if not np.isfinite(turn).all():
            return at._replace(lost=LOST)
        share = -np.linalg.lstsq(turn, move, rcond=1e-12)[0]
        step, signs, part = share @ after, at.signs * np.where(share < 0, -1, 1), 1.0
        while part >= SHORTEST:
            tried = image + part * step
            reached = self._period(tried)
            less = self._length(reached - tried) / size
            if less < (1 - 0.1 * part) * change:
                search.states[BEST], search.changes[LEAST] = reached, less
                push = np.clip(part * self._length(step) / size, 1e-9, PUSH if part == 1 else FARTHEST)
                return _Correction(signs, float(push))
            part *= 0.5
        return _Correction(signs, 0.1 * at.push, at.lost + 1)  # no part is a gain: what the pushes saw was not of here
