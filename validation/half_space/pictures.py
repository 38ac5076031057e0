"""The contact seen from above: what sticks, what slips, and the way it slips."""

from typing import Any

import numpy as np

import mdr
from mdr.half_space.friction import MARGIN, LastPeriod, Settings, last_period, stuck
from mdr.tools.arrays import Array
from validation.cases import contact

OPEN, SLIPS, STICKS = "#FFFFFF", "#F6D98B", "#0B3C6F"
ARROWS = 13  #: along a side, at most


def places(found: LastPeriod) -> tuple[Array, Array]:
    """Coordinates x and y of the cells, (n, n) each, over the greatest radius of contact."""
    n = found.contact.half_space.n
    side = MARGIN * (2 * np.arange(n) + 1 - n) / n
    x, y = np.meshgrid(side, side, indexing="ij")
    return x, y


def last_of_a_paraboloid(v: float, quick: bool) -> LastPeriod:
    """The last period at v over Eq. (1), elastic, nu = mu_0 = du_z/u_z0 = 0.3, with all couplings."""
    case = contact("paraboloid", 0.3, mu_0=0.3, nu=0.3)
    settings = Settings(*((21, 24) if quick else (41, 60)), cycles=2)
    return last_period(case, v * mdr.critical_velocity(case), settings)


def period(panels: Any, found: LastPeriod) -> None:
    """Maps of stick and slip at four instants of the last period, with arrows of slip, one scale a map."""
    from matplotlib.colors import ListedColormap

    x, y = places(found)
    titles = ("fastest approach", "deepest", "fastest retreat", "least depth")
    for ax, share, title in zip(panels, (0.25, 0.5, 0.75, 1.0), titles, strict=True):
        step = found.steps[round(len(found.steps) * share) - 1]
        kind = (step.pressure > 0).astype(float) + stuck(found.contact, step)
        ax.pcolormesh(x, y, kind, cmap=ListedColormap([OPEN, SLIPS, STICKS]), vmin=0, vmax=2, rasterized=True)
        _arrows(ax, x, y, step.slip, kind == 1)
        ax.set_aspect("equal")
        ax.set(title=title, xlabel=r"$x/a$ (pull $\rightarrow$)", xlim=(-1.1, 1.1), ylim=(-1.1, 1.1))
    panels[0].set_ylabel("$y/a$")


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
