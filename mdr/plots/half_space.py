"""Figures of friction in three dimensions: the contact seen from above, and the COF over the velocity.

Records are read by attribute only.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.plots.figures import COLOURS, Axes, Figure, axes_of, edges_of, faint, prefix, style, subplots

SEEN = 1e-6  #: share of mu_0 from which a COF across is told


def plot_half_space(run: Any, instant: float | None = None) -> Figure:
    """Draw the contact seen from above: pressure as colour, traction as arrows, a line around what sticks.

    Parameters
    ----------
    run : HalfSpaceRun
        The run.
    instant : float, optional
        Share of the last period, from 0 to 1, from the least depth on. None draws four instants.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    if instant is not None and not 0 <= instant <= 1:
        raise ValueError(f"instant must lie between 0 and 1, a share of the period, got {instant!r}")
    shares = (0.25, 0.5, 0.75, 1.0) if instant is None else (instant,)  # of the period
    length, pressure = prefix(run.x, "m"), prefix(run.pressure, "Pa")
    side, size = (2, (7.2, 6.9)) if instant is None else (1, (5.8, 5.4))
    with style():
        fig, panels = subplots(side, side, sharex=True, sharey=True, squeeze=False, figsize=size)
        for ax, share in zip(panels.flat, shares, strict=True):
            colour = _draw_instant(ax, run, round(share * run.t.size) - 1, length[0], pressure[0])
            ax.set_title(f"{share:.3g} of the period\nafter the least depth")
        for ax in panels[-1]:
            ax.set_xlabel(rf"$x$ [{length[1]}], pull $\rightarrow$")
        for ax in panels[:, 0]:
            ax.set_ylabel(f"$y$ [{length[1]}]")
        fig.colorbar(colour, ax=panels, label=f"pressure [{pressure[1]}]", shrink=0.7, pad=0.02)
        fig.suptitle(_told(run), fontsize=10.5)
    return fig


def _told(run: Any) -> str:
    """What to see, in two lines."""
    across = f", {run.cof_y / run.full_cof:.3f} across" if abs(run.cof_y) > SEEN * run.full_cof else ""
    full = r"$\mu_0$" if run.full_cof == run.mu_0 else "that of full slip"
    return (
        f"Mean friction over {full}: {run.cof / run.full_cof:.3f}{across}. Arrows: traction on the surface."
        "\nInside the orange line cells stick, hatched cells slip."
    )


def _draw_instant(ax: Axes, run: Any, step: int, length: float, pressure: float) -> Any:
    """One instant, lengths and pressures in the units of these factors; returns what the colour bar belongs to."""
    x, y = run.x * length, run.y * length
    p, stick = run.pressure[step], run.stick[step]
    touching = p > 0
    colour = ax.pcolormesh(
        edges_of(x), edges_of(y), np.where(touching, pressure * p, np.nan).T,
        cmap=_paler("Blues"), vmin=0, vmax=pressure * run.pressure.max(), rasterized=True,
    )  # fmt: skip
    if np.any(slips := touching & ~stick):
        hatch = ax.contourf(x, y, slips.T.astype(float), levels=[0.5, 1.5], colors="none", hatches=["////"])
        hatch.set_edgecolor("0.72")
        hatch.set_linewidth(0.0)
    if stick.any():
        ax.contour(x, y, stick.T.astype(float), levels=[0.5], colors=COLOURS[1], linewidths=1.8)
    _arrows(ax, x, y, run.q_x[step], run.q_y[step], touching, float(np.hypot(run.q_x, run.q_y).max()) or 1.0)
    ax.set_aspect("equal")
    return colour


def _paler(name: str) -> Any:
    """A scale of colours without its darkest third, on which arrows are seen."""
    import matplotlib as mpl

    return mpl.colors.ListedColormap(mpl.colormaps[name](np.linspace(0, 2 / 3, 256)))


def _arrows(
    ax: Axes, x: NDArray[Any], y: NDArray[Any], q_x: NDArray[Any], q_y: NDArray[Any], where: NDArray[Any], most: float
) -> None:
    """Every few cells one arrow, its middle in the cell, one scale in all panels."""
    every = -(-x.size // 13)  # arrows along a side, at most
    some = np.zeros_like(where)
    first = (x.size // 2) % every  # so that a row runs through the middle
    some[first::every, first::every] = True
    some &= where
    along, across = np.meshgrid(x, y, indexing="ij")
    scale = most / (2.2 * every * (x[1] - x[0]))
    ax.quiver(
        along[some], across[some], q_x[some], q_y[some],
        angles="xy", scale_units="xy", scale=scale, width=0.008, pivot="middle", color="0.1", zorder=3,
    )  # fmt: skip


def plot_half_space_curve(curve: Any, ax: Axes | None = None) -> Axes:
    """Draw the COF over the pulling velocity with its error bars, and the COF across where there is one.

    Parameters
    ----------
    curve : HalfSpaceCurve
        What is drawn.
    ax : matplotlib.axes.Axes, optional
        Where to draw. None makes a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        Where it was drawn.
    """
    factor, unit = prefix(curve.v_0, "m/s")
    order = np.argsort(curve.v_0)
    v, settled = factor * curve.v_0[order], curve.settled[order]
    with style():
        ax = axes_of(ax)
        parts = {"along the pull": curve.cof}
        if np.any(np.abs(curve.cof_y) > SEEN * curve.full_cof):
            parts["across the pull"] = curve.cof_y
        for colour, (name, cof) in zip(COLOURS, parts.items(), strict=False):
            mu = cof[order]
            ax.errorbar(v, mu, curve.cof_error[order], color=colour, capsize=2, label=name)
            ax.plot(v[settled], mu[settled], "o", color=colour, markersize=4.5)
            ax.plot(v[~settled], mu[~settled], "o", mfc="white", mec=colour, markersize=5)
        if not settled.all():
            ax.plot([], [], "o", mfc="white", mec="0.3", label="not settled")
        for level in {curve.full_cof, np.copysign(curve.full_cof, v[0])}:
            faint(ax.axhline, level)
        ax.set(xlabel=rf"pulling velocity $v_0$ [{unit}]", ylabel=r"coefficient of friction $\mu$")
        if len(ax.get_legend_handles_labels()[0]) > 1:
            ax.legend(frameon=True, edgecolor="none")
    return ax
