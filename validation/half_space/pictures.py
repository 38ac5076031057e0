"""The contact seen from above: what sticks, what slips, and the way it slips."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from mdr.half_space.friction import MARGIN, LastPeriod, stuck
from mdr.plots import style
from mdr.tools.arrays import Array

if TYPE_CHECKING:
    from matplotlib.figure import Figure

OPEN, SLIPS, STICKS = "#FFFFFF", "#F6D98B", "#0B3C6F"
ARROWS = 13  #: along a side, at most


def places(found: LastPeriod) -> tuple[Array, Array]:
    """Coordinates x and y of the cells, (n, n) each, over the greatest radius of contact."""
    n = found.contact.half_space.n
    side = MARGIN * (2 * np.arange(n) + 1 - n) / n
    x, y = np.meshgrid(side, side, indexing="ij")
    return x, y


def period(found: LastPeriod) -> Figure:
    """Maps at four instants of the last period, a quarter apart."""
    n = len(found.steps)
    titles = ("fastest approach", "deepest", "fastest retreat", "least depth")
    return maps(found, [round(n * share) - 1 for share in (0.25, 0.5, 0.75, 1.0)], titles)


def maps(found: LastPeriod, moments: Sequence[int], titles: Sequence[str]) -> Figure:
    """Maps of stick and slip in these steps of the last period, with arrows of slip, one scale a map."""
    import matplotlib.pyplot as plt
    from matplotlib.colors import ListedColormap

    x, y = places(found)
    with style():
        fig, panels = plt.subplots(1, len(moments), figsize=(2.6 * len(moments), 3.1), sharey=True)
        for ax, i, title in zip(panels, moments, titles, strict=True):
            step = found.steps[i]
            kind = (step.pressure > 0).astype(float) + stuck(found.contact, step)
            look = ListedColormap([OPEN, SLIPS, STICKS])
            ax.pcolormesh(x, y, kind, cmap=look, vmin=0, vmax=2, rasterized=True)
            _arrows(ax, x, y, step.slip, kind == 1)
            ax.set_title(title)
            ax.set_aspect("equal")
            ax.set(xlabel=r"$x/a$ (pull $\rightarrow$)", xlim=(-1.1, 1.1), ylim=(-1.1, 1.1))
        panels[0].set_ylabel("$y/a$")
    return fig


def _arrows(ax: Any, x: Array, y: Array, slip: Array, where: Array) -> None:
    """Every few cells one arrow, its tail in the cell."""
    every = -(-x.shape[0] // ARROWS)
    first = (x.shape[0] // 2) % every  # so that a row runs through the middle
    some = np.zeros_like(where)
    some[first::every, first::every] = True
    some &= where
    longest = np.max(np.hypot(*slip)[where], initial=1e-300)
    along, across = (part[some] / longest for part in slip)
    how = {"angles": "xy", "scale_units": "xy", "scale": 4.5, "width": 0.008, "color": "0.15"}
    ax.quiver(x[some], y[some], along, across, **how)
