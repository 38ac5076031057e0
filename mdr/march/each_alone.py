"""The periodic state of springs under a rigid pull, which know nothing of each other: each solved for by itself.

Newton's method on the map of a period, for all springs at once: the derivative of each by its own extensions and arms
comes from as many periods as it has of these, but for arms that a period forgets. Friction makes the map non-expansive
(periodic_orbit.py), so that a step which does not make the change of a spring smaller is no gain, and this spring is
marched on instead.
"""

from __future__ import annotations

import numpy as np

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


def search_alone(stepper: Stepper, start: MarchState) -> Orbit | None:
    """The periodic state of every spring, from one of any other; None where it is not found."""
    scaled = stepper.scaled
    n, w = scaled.springs.gap.size, scaled.springs.w
    lasting = np.tile(np.r_[True, np.array(scaled.rheology.theta) > FORGOTTEN], scaled.ways)
    roots = np.sqrt(np.tile(np.r_[1.0, scaled.rheology.rho], scaled.ways))[:, None]
    farthest = float(start.s[0].max())
    x = _inside(stepper, _rows(start.e), start)
    before: Array = np.full(n, np.inf)
    part = np.ones(n)
    last = after = x
    step = np.zeros_like(x)
    for _ in range(TURNS):
        if time_is_over():
            return None
        image = _marched(stepper, x, start)
        change = _length(roots * (image - x))
        worse = ~(change <= before)
        if worse.any():  # less of that step, and at last none: on to where it was marched to
            part = np.where(worse, SHORTER * part, 1.0)
            shorter = np.where(part >= SHORTEST, _inside(stepper, last + part * step, start), after)
            x = np.where(worse, shorter, x)
            image = _marched(stepper, x, start)
            change = np.where(worse & (part < SHORTEST), before, _length(roots * (image - x)))
            part = np.where(part < SHORTEST, 1.0, part)
        turn = np.zeros((n, len(x), len(x)))
        for k in np.flatnonzero(lasting):
            push = np.zeros_like(x)
            push[k] = np.where(x[k] > 0, -PUSH, PUSH) * farthest
            turn[:, :, k] = ((_marched(stepper, x + push, start) - image) / push[k]).T
        moved = image - x
        last, after, before = x, image, change
        left = (1 + FLAT) * np.eye(len(x)) - turn
        step = np.asarray(np.linalg.solve(left, moved.T[:, :, None])[:, :, 0].T, dtype=float)
        off = float(_length(roots * step) @ w) / stepper.mean_F_z
        if not np.isfinite(off):
            return None
        if off <= BEFORE * stepper.tolerance:
            end, periods = stepper.advance(state := _state(x, start), 1)
            if stepper.late(state, end, 1) > stepper.tolerance:
                return None
            cof, cof_y = float(periods.cof[-1]), float(periods.cof_y[-1])
            return Orbit(end, periods, Settling(cof, 2 * off, True, "periodic", gain=1.0, across=cof_y))
        step *= np.minimum(1.0, 2 * farthest / np.maximum(_length(step), 1e-300))
        x = _inside(stepper, x + step, start)
    return None


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


def _inside(stepper: Stepper, x: Array, like: MarchState) -> Array:
    """The extensions within the friction of each spring."""
    return _rows(stepper.within_friction(_state(x, like)).e)
