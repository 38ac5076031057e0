"""How a curve is drawn: a smooth line through what was computed, and axes that stay while they suit it."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import PchipInterpolator

from mdr.tools.arrays import Array

FINE = 8  #: pieces of the line between two points
FILLED = 0.55  #: of an axis that what is shown must span, for the axis to stay as it is


def line_of(v: Array, cof: Array | None) -> dict[str, Array]:
    """A smooth line through points, which rises where they rise; on both sides of rest, where friction may jump."""
    x: list[Array] = []
    y: list[Array] = []
    cof = np.full(v.shape, np.nan) if cof is None else cof
    for side in (v < 0, v >= 0):
        here = side & np.isfinite(cof)
        if here.sum() > 1:
            fine = np.interp(np.arange(FINE * here.sum() - FINE + 1) / FINE, np.arange(here.sum()), v[here])
            x.append(fine)
            y.append(PchipInterpolator(v[here], cof[here])(fine))
    return {"v_0": np.concatenate([[], *x]), "cof": np.concatenate([[], *y])}


def suits(held: tuple[float, float], low: float, high: float) -> bool:
    """Whether what lies between low and high fits an axis and fills a good part of it."""
    slack = 1e-9 * (held[1] - held[0])
    within = held[0] - slack <= low and high <= held[1] + slack
    return within and high - low >= FILLED * (held[1] - held[0])
