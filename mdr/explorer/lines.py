"""How a curve is drawn: a smooth line through what was computed, and axes that stay while they suit it."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from mdr.plots.curves import smooth
from mdr.tools.arrays import Array


def line_of(v: Array, cof: Array | None, jumps: Iterable[float] = ()) -> dict[str, Array]:
    """A smooth line through points, which rises where they rise; on both sides of rest, where friction may jump. It is
    broken at the velocities at which it does.
    """
    here = np.zeros(v.shape, dtype=bool) if cof is None else np.isfinite(cof)
    side = np.searchsorted(sorted({0.0, *jumps}), v, side="right")
    sides = [smooth(v[one], np.asarray(cof)[one]) for k in np.unique(side) if (one := here & (side == k)).any()]
    x, y = ([*parts] for parts in zip(*sides, strict=True)) if sides else ([], [])
    if jumps:
        x, y = ([np.append(part, np.nan) for part in parts] for parts in (x, y))
    return {"v_0": np.concatenate([[], *x]), "cof": np.concatenate([[], *y])}


def suits(held: tuple[float, float], low: float, high: float) -> bool:
    """Whether what lies between low and high fits an axis and fills a good part of it."""
    slack = 1e-9 * (held[1] - held[0])
    within = held[0] - slack <= low and high <= held[1] + slack
    # an axis stays as it is while what is shown spans this share of it
    return within and high - low >= 0.55 * (held[1] - held[0])
