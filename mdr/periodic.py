"""The periodic state of body and springs, solved for instead of awaited.

One period of the march is a map x -> P(x) of the state of body and springs; a periodic motion is its fixed point. A
body with little damping rings for hundreds of periods, while its springs forget their past in one or a few: what has
to be found lies close to a plane. Anderson's method (1965; Walker & Ni 2011) does that: from the last few periods it
takes the combination whose change over a period is least, and marches on from there.

A fixed point need not be where a march ends. So its multipliers are measured: the body is pushed in its position and
in its velocity, and two periods later the two displacements of the state are followed through one period more. They map
on a combination of themselves, whose eigenvalues are the multipliers of the slowest motions. All must lie within the
unit circle; their distance from it also turns the change over one period into a bound on what is missing to the limit.
Where this fails (no convergence, a multiplier near or beyond one: a beat, a period of two, an undamped body in full
slip) there is no answer here, and the motion is awaited.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Step = Callable[[Array], Array]
Measure = Callable[[Array], Array]

MEMORY = 8  #: periods that are combined
PLAIN = 3  #: periods marched before the first combination, while springs find their modes
MOST = 80  #: periods after which the search gives up
A_TIME = (3, 20)  #: how much more memory, and how many more periods, each slow time of a material gets
CLOSE = 1e-10  #: change over a period, over the size of the state, at which it has arrived
AWAY = 1e-6  #: distance, over the size of the state, to which a slow time lets a change over a period add up
GROWTH = 4.0  #: of the change over the least seen, at which combinations start anew
KICK = 1e-4  #: of the body, over the size of the state
AFTER = 2  #: periods between kick and measurement, in which springs fall in with the body
FORGOTTEN = 1e-5  #: of a kick: what is left of it is not told from the change over a period
STABLE = 0.9999  #: largest multiplier that is told from one
CREEP = 10.0  #: what outlives the slowest time of a material at most, as strain outlives stress


@dataclass(frozen=True, eq=False)
class FixedPoint:
    """A state that returns after a period, and returns when pushed."""

    x: Array  #: the state
    change: float  #: what is left of its change over a period, over its size
    multiplier: float  #: largest of the slowest motions around it, in absolute value, below 1

    @property
    def distance(self) -> float:
        """Bound on the distance to the exact fixed point, over the size of the state."""
        return (self.change + 1e-15) / (1 - self.multiplier)  # 1e-15: rounding


def find(
    step: Step,
    start: Array,
    measure: Measure,
    kicks: tuple[Array, ...],
    slow: tuple[float, ...] = (),
    sure: bool = False,
) -> FixedPoint | None:
    """The stable fixed point of `step` near `start`, shape (n,), or None.

    measure: makes states (..., n) vectors (..., k) whose length measures them, linearly. kicks: pushes of unit length.
    slow: times of the material, in periods, that the springs remember. sure: that with them the motion cannot be
    unstable, and forgets with these times.
    """
    found = _anderson(step, start, measure, slow)
    if found is None:
        return None
    x, change = found
    multiplier, missed = _multiplier(step, x, measure, kicks)
    if not slow:  # few arms are told apart from one another in so short a time
        multiplier += missed
    if multiplier >= STABLE and sure:
        multiplier = float(np.exp(-1 / (CREEP * max(slow))))
    return FixedPoint(x, change, multiplier) if sure or multiplier < STABLE else None


def _anderson(step: Step, x: Array, measure: Measure, slow: tuple[float, ...] = ()) -> tuple[Array, float] | None:
    memory, most = (n + more * len(slow) for n, more in zip((MEMORY, MOST), A_TIME, strict=True))
    close = min(CLOSE, AWAY / max(slow)) if slow else CLOSE
    images: list[Array] = []
    changes: list[Array] = []
    least = np.inf
    for turn in range(most):
        image = step(x)
        size = float(np.linalg.norm(measure(image))) + 1e-300
        if not np.isfinite(size):
            return None
        change = float(np.linalg.norm(measure(image - x))) / size
        if change <= close:
            return image, change
        if change > GROWTH * least:
            images, changes, least = [], [], np.inf
        least = min(least, change)
        images, changes = [*images, image][-memory:], [*changes, image - x][-memory:]
        x = image if turn < PLAIN or len(images) < 2 else _combined(images, changes, measure)
    return None


def _combined(images: list[Array], changes: list[Array], measure: Measure) -> Array:
    """The combination of images, of weights that sum to one, whose change is least."""
    steps = np.diff(np.array(changes), axis=0)
    share = np.linalg.lstsq(measure(steps).T, measure(changes[-1]), rcond=1e-10)[0]
    return np.asarray(images[-1] - share @ np.diff(np.array(images), axis=0))


def _multiplier(step: Step, x: Array, measure: Measure, kicks: tuple[Array, ...]) -> tuple[float, float]:
    """Largest multiplier of the pushed motions, and what their combinations do not explain."""
    size = KICK * (float(np.linalg.norm(measure(x))) or 1.0)  # of a state that is nothing, as in flight, the unit
    before, after = [], []
    for kick in kicks:
        pushed = x + size * kick
        for _ in range(AFTER):
            pushed = step(pushed)
        before.append(measure(pushed - x) / size)
        after.append(measure(step(pushed) - x) / size)
    left, lengths, right = np.linalg.svd(np.array(before).T, full_matrices=False)
    lasts = lengths > FORGOTTEN
    if not lasts.any():
        return float(lengths[0] ** (1 / AFTER)), 0.0
    images = np.array(after).T @ right[lasts].T / lengths[lasts]
    onto = left[:, lasts].T @ images
    missed = np.linalg.norm(images - left[:, lasts] @ onto, axis=0).max()
    return float(np.abs(np.linalg.eigvals(onto)).max()), float(missed)
