"""The springs of a recorded run as arrays: a map of their modes over a period, and frames of their motion."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.march.result.run import SlidingRun
from mdr.plots import MODES, edges_of
from mdr.plots.side_view import SideView
from mdr.spring.contact_modes import SLIP

DIRECTIONS = 72  #: of slip that have their own colours, shaken across
FRAMES = 64  #: of a period


def modes_of(run: SlidingRun) -> NDArray[np.uint8]:
    """Modes (n_t, n_springs) of the springs.

    Shaken across, a slip is not SLIP but one of `DIRECTIONS` from len(MODES) on, from -180 degrees.
    """
    state = np.asarray(run.state)
    if run.f_y is None:
        return state
    turns = np.arctan2(run.f_y, np.asarray(run.f_x)) / (2 * np.pi) + 0.5
    return np.where(state == SLIP, len(MODES) + np.minimum(DIRECTIONS * turns, DIRECTIONS - 1).astype(np.uint8), state)


def map_of(run: SlidingRun) -> NDArray[np.uint8]:
    """Modes (n_springs, n_t) from the middle to the outermost spring, in equal rows."""
    x = np.asarray(run.x)
    order, rows = np.argsort(x), (np.arange(x.size) + 0.5) / x.size * x.max()
    return modes_of(run)[:, order[np.searchsorted(edges_of(x[order])[1:-1], rows)]].T


def frames_of(run: SlidingRun, view: SideView) -> dict[str, NDArray[Any]]:
    """Heights of the springs, places of their feet and their modes, (FRAMES, n) each, and the indenter's depth."""
    at = np.linspace(0, np.asarray(run.t).size, FRAMES, endpoint=False).astype(int)
    return {
        "top": np.stack([view.tops(k) for k in at]),
        "foot": np.stack([view.feet(k) for k in at]),
        "mode": view.both(modes_of(run)[at]).astype(np.uint8),
        "depth": np.asarray(run.u_z)[at] * view.per_z,
    }
