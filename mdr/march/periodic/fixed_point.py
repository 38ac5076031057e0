"""The periodic state of body and springs by shooting: solved for instead of awaited.

One period of the march is a map x -> P(x) of the state of body and springs; a periodic motion is its fixed point.
Friction under a given normal motion is monotone, so two motions never move apart (validation/uniqueness.py): P is
non-expansive in the norm of energy. Three things follow.

* Where any motion stays bounded there is a fixed point (Browder 1965), and the COF of all of them is one.
* No Floquet multiplier, an eigenvalue of P', lies outside the unit circle: a fixed point need not be tested for
  stability before it is an answer. What the multipliers tell is how far from it a small change over a period can be.
* Along a march the change over a period never grows. So a step of a search that makes it smaller is a gain for good.

A body with little damping rings for hundreds of periods, or beats without end, while its springs forget their past in
one or a few: what has to be found lies close to a plane. Anderson's method (1965; Walker & Ni 2011) takes of the last
few periods the combination whose change over a period is least, and marches on from there. Where instants of stick make
it go astray, a Newton-Picard method follows (Lust, Roose, Spence & Champneys 1998): the body is pushed in its position
and in its velocity, and the combination of the two displacements that leaves the least change is added, as much of it
as makes the change smaller; the springs follow by marching.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mdr.march.dynamics.stepper import Periods
from mdr.march.periodic import anderson
from mdr.march.periodic.solver import iterate
from mdr.tools.arrays import Array

Measure = Callable[[Array], Array]
PeriodMap = Callable[[Array], Array]  #: of a state (n,) to the one a period later
Pushes = Callable[[], tuple[Array, ...]]

MEMORY = 8  #: periods that are combined
PLAIN = 3  #: periods marched before the first combination, while springs find their modes
MOST = 80  #: periods after which Anderson's method gives up
PATIENCE = 30  #: periods without a smaller change, or with steps that were not solved for, after which it gives up too
A_TIME = (3, 20)  #: how much more memory, and how many more periods, each slow time of a material gets
CLOSE = 1e-10  #: change over a period, over the size of the state, that any answer may have
CLOSEST = 1e-13  #: the same that can be reached: some roundings
GROWTH = 4.0  #: of the change over the least seen, at which combinations start anew
PUSH = 1e-4  #: displacement of the body, over the size of the state
FARTHEST = 0.1  #: the same, where the motion has kinks
AFTER = 2  #: periods between a push and the measurement, in which springs fall in with the body
FORGOTTEN = 1e-5  #: of a push: what is left of it is not told from what a step of the march leaves unsolved
CREEP = 10.0  #: what outlives the slowest time of a material at most, as strain outlives stress
EXPANDS = 1.01  #: multiplier from which on a map is not one of friction
STABLE = 0.9999  #: largest multiplier told from one, of motions that slow arms make hard to tell apart
TURNS = 30  #: corrections of the Newton-Picard method
SHORTEST = 1 / 64  #: share of a correction that is tried before the march goes on without it
LOST = 5  #: corrections in a row of which no share is a gain, after which it ends


@dataclass(frozen=True, eq=False)
class Iterate:
    """A state that a search has come to."""

    x: Array  #: the state
    change: float  #: how far it moved in the last period, over its size
    period: Periods | None = None  #: what is known of that period
    before: Array | None = None  #: where that began, if the period is known


@dataclass(frozen=True, eq=False)
class SlowMotions:
    """What is known of the slow motions about a periodic state: k displacements of length PUSH that outlive a few
    periods, in all parts (k, n) of the state, and what they are a period later.
    """

    before: Array
    after: Array


@dataclass(frozen=True, eq=False)
class FixedPoint:
    """A state that returns after a period."""

    end: Iterate  #: the state
    gain: float  #: bound on its distance to the exact fixed point, over its change over a period
    motions: SlowMotions | None = None  #: the slow ones about it, where they were looked at

    @property
    def x(self) -> Array:
        """The state."""
        return self.end.x

    @property
    def distance(self) -> float:
        """Bound on the distance to the exact fixed point, over the size of the state."""
        return (self.end.change + 1e-15) * self.gain  # 1e-15: rounding


@dataclass(frozen=True)
class Options:
    """How to look for a fixed point; slow: relaxation times, in periods, of material and pull."""

    slow: tuple[float, ...] = ()
    stable: bool = False  #: whether it is guaranteed that with them no multiplier reaches 1
    close: float = CLOSE  #: change over a period, over the size of the state, at which Anderson's method ends
    plain: int = PLAIN  #: periods that are marched before the first combination

    @property
    def most(self) -> int:
        """Periods after which Anderson's method gives up."""
        return MOST + A_TIME[1] * len(self.slow)

    def by_anderson(
        self, x: Array, measure: Measure = np.asarray, motions: SlowMotions | None = None
    ) -> anderson.Search:
        """Anderson's method at its beginning, from a state (n,); motions: slow ones that it may begin to combine."""
        memory = MEMORY + A_TIME[0] * len(self.slow) - 1  # differences between so many images
        (start, image, moved, best), (d_image, d_moved) = np.zeros((4, x.size)), np.empty((2, memory, x.size))
        counts = np.zeros(4, dtype=np.int64)
        if motions is not None:
            counts[anderson.KEPT] = k = min(len(motions.after), memory)
            d_image[:k], d_moved[:k] = motions.after[:k], measure(motions.after[:k] - motions.before[:k])
        return anderson.Search(
            x=x.copy(),
            start=start,
            image=image,
            moved=moved,
            best=best,
            d_image=d_image,
            d_moved=d_moved,
            counts=counts,
            changes=np.array([np.inf, np.inf]),
            close=self.close,
            plain=self.plain,
            patience=PATIENCE,
            growth=GROWTH,
        )


def find(
    step: PeriodMap,
    near: Iterate | None,
    measure: Measure,
    pushes: Pushes,
    how: Options,
    gain: float | None = None,
) -> FixedPoint | None:
    """The fixed point of `step` near the state that Anderson's method has come to, shape (n,); None where there is none
    of either.

    measure: makes states (..., n) vectors (..., k) whose length measures them, linearly. pushes: gives displacements of
    unit length along the slow motions. gain: that of the same motion at another resolution, or at a velocity close by
    where no bound is asked for; None where it is not known.
    """
    if near is None:
        return None
    if near.change > how.close:
        solver = _NewtonPicard(step, measure, pushes(), how.close)
        near = iterate(solver, _Corrected(near, PUSH, np.ones(len(solver.pushes)))).best
    if near.change > max(how.close, CLOSE):
        return None
    if gain is not None:
        return FixedPoint(near, gain)
    _, before, after = _displaced(step, near.x, measure, pushes(), PUSH)
    motions = SlowMotions(before, after)
    gain = _gain(near, motions, measure, how.slow, how.stable)
    return FixedPoint(near, gain, motions) if gain is not None else None


@dataclass(frozen=True, eq=False)
class _Corrected:
    """Where Newton-Picard corrections have come to."""

    best: Iterate  #: the state of least change
    push: float  #: length of the next pushes, over the size of the state
    ways: Array  #: (k,) sign of each of them
    lost: int = 0  #: corrections in a row of which no share was a gain


class _NewtonPicard:
    """Corrections along the pushed motions, for a state of less change over a period.

    The map has kinks, where stick begins. A correction that has to be cut short meets one; so the next pushes go the
    same way and as far, to see the slope on both sides of it.
    """

    most = TURNS

    def __init__(self, step: PeriodMap, measure: Measure, pushes: tuple[Array, ...], close: float) -> None:
        self.period, self.measure, self.pushes, self.close = step, measure, pushes, close

    def ended(self, at: _Corrected) -> bool:
        return at.best.change <= self.close or at.lost == LOST or not np.isfinite(at.best.change)

    def step(self, at: _Corrected) -> _Corrected:
        measure = self.measure
        tried_ways = tuple(way * one for way, one in zip(at.ways, self.pushes, strict=True))
        (x, image), before, after = _displaced(self.period, at.best.x, measure, tried_ways, at.push)
        size = float(np.linalg.norm(measure(image))) + 1e-300
        best = Iterate(image, float(np.linalg.norm(measure(image - x))) / size)
        turn = measure(after - before).T
        if not np.isfinite(turn).all():
            return _Corrected(best, at.push, at.ways, LOST)
        share = -np.linalg.lstsq(turn, measure(image - x), rcond=1e-12)[0]
        move, ways = share @ after, at.ways * np.where(share < 0, -1, 1)
        part = 1.0
        while part >= SHORTEST:
            tried = image + part * move
            reached = self.period(tried)
            change = float(np.linalg.norm(measure(reached - tried))) / size
            if change < (1 - 0.1 * part) * best.change:
                push = float(np.linalg.norm(part * measure(move))) / size
                push = float(np.clip(push, 1e-9, PUSH if part == 1 else FARTHEST))
                return _Corrected(Iterate(reached, change), push, ways)
            part *= 0.5
        return _Corrected(best, 0.1 * at.push, ways, at.lost + 1)  # what these pushes saw was not of here


def _settled_in(step: PeriodMap, x: Array) -> tuple[Array, Array]:
    """A state after some periods, and its image."""
    for _ in range(AFTER):
        x = step(x)
    return x, step(x)


def _displaced(
    step: PeriodMap, x: Array, measure: Measure, pushes: tuple[Array, ...], push: float
) -> tuple[tuple[Array, Array], Array, Array]:
    """What the state x comes to after some periods, and a period later; and what pushes of it have become then, as
    displacements (k, n) from there.
    """
    size = push * (float(np.linalg.norm(measure(x))) or 1.0)  # of a state that is nothing, as in flight, the unit
    pairs = [_settled_in(step, one) for one in (x, *(x + size * np.array(pushes)))]
    before, after = (np.array(of) for of in zip(*pairs, strict=True))
    return (before[0], after[0]), before[1:] - before[0], after[1:] - after[0]


def _gain(
    found: Iterate, motions: SlowMotions, measure: Measure, slow: tuple[float, ...], guaranteed_stable: bool
) -> float | None:
    """Bound on the distance to the fixed point over the change over a period; None for a map that expands.

    found: a state that returns, so closely that its own change is small beside a push, and blurs what is seen of it.
    """
    x, before, after = found.x, motions.before, motions.after
    if not (np.isfinite(before).all() and np.isfinite(after).all()):
        return None
    size = PUSH * (float(np.linalg.norm(measure(x))) or 1.0)
    left, lengths, right = np.linalg.svd(measure(before).T / size, full_matrices=False)
    lasts = lengths > FORGOTTEN
    if not lasts.any():
        return 1 / (1 - float(lengths[0] ** (1 / AFTER)))
    images = measure(after).T / size @ right[lasts].T / lengths[lasts]
    onto = left[:, lasts].T @ images
    missed = float(np.linalg.norm(images - left[:, lasts] @ onto, axis=0).max())
    largest = float(np.abs(np.linalg.eigvals(onto)).max())
    if largest > EXPANDS:
        return None
    if slow and largest < STABLE:
        return 1 / (1 - largest)
    least = float(np.linalg.svd(np.eye(len(onto)) - onto, compute_uv=False)[-1])
    along = 1 / max(least - missed - found.change / PUSH, 1e-300)
    if not slow:
        return along
    creep = -1 / float(np.expm1(-1 / (CREEP * max(slow))))  # few arms are told apart in so short a time
    return creep if guaranteed_stable else max(along, creep)
