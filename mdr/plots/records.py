"""Figures of recorded and of random motion.

Records are read by attribute only.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from mdr.plots.figures import COLOURS, Axes, Figure, axes_of, prefix, style, subplots


def plot_slide_record(found: Any) -> Figure:
    """Draw position, forces and running COF of a SlideRecord over time."""
    every = slice(None, None, -(-found.t.size // 20_000))  # samples that are drawn
    time, second = prefix(found.t - found.t[0], "s")
    t = time * found.t[every]
    panels = (("position", "m", ("u_x", "u_y", "u_z")), ("force", "N", ("F_x", "F_y", "F_z")))
    with style():
        fig, axes = subplots(3, 1, sharex=True, figsize=(6.4, 7.2))
        for ax, (what, unit, names) in zip(axes, panels, strict=False):
            shown = [(name, getattr(found, name)[every]) for name in names if np.any(getattr(found, name))]
            factor, symbol = prefix(np.concatenate([values for _, values in shown]), unit)
            for (name, values), colour in zip(shown, COLOURS, strict=False):
                ax.plot(t, factor * values, color=colour, label=f"${name}$")
            ax.set(ylabel=f"{what} [{symbol}]")
            ax.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=3)
        axes[2].plot(t, found.running_cof[every], color="k")
        axes[2].axhline(found.mu_0, color="0.6", lw=1, ls="--")
        axes[2].set(ylabel="running COF", xlabel=f"time [{second}]")
        fig.align_ylabels()
    return fig


def plot_random_cof(found: Any, ax: Axes | None = None) -> Axes:
    """Draw friction of a RandomCof with two standard errors over the velocity."""
    factor, symbol = prefix(found.v_0, "m/s")
    with style():
        ax = axes_of(ax)
        ax.errorbar(factor * found.v_0, found.cof, 2 * found.standard_error, fmt="o-", ms=4, capsize=2)
        ax.axhline(found.mu_0, color="0.6", lw=1, ls="--")
        ax.set(xlabel=f"pulling velocity $v_0$ [{symbol}]", ylabel=r"coefficient of friction, $\pm 2$ standard errors")
    return ax
