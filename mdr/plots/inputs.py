"""Figures of what inputs do to friction and v_c: of a tolerance, a sensitivity, samples, and a front of designs.

Records are read by attribute only.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from mdr.case.paths import facts_at
from mdr.plots.figures import COLOURS, Axes, Figure, axes_of, prefix, style, subplots
from mdr.tools.notation import shown


def plot_tolerance(found: Any, ax: Axes | None = None) -> Axes:
    """Draw a bar for each input, friction at its smaller and larger value; beside it the critical velocity.

    Parameters
    ----------
    found : Tolerance
        What `tolerance` returned.
    ax : matplotlib.axes.Axes, optional
        Where to draw friction alone. None makes a new figure, with a second panel for the critical velocity.

    Returns
    -------
    matplotlib.axes.Axes
        Where friction was drawn.
    """
    with style():
        if ax is None and np.isfinite(found.base_v_c):
            factor, unit = prefix([found.base_v_c], "m/s")
            size = (8.4, 1.4 + 0.32 * len(found.cof))
            _, (ax, beside) = subplots(1, 2, sharey=True, figsize=size, layout="constrained")
            _bars(beside, found.v_c, found.base_v_c, found.by, factor)
            beside.set_xlabel(f"critical velocity $v_c$ [{unit}]")
        ax = axes_of(ax)
        _bars(ax, found.cof, found.base_cof, found.by)
        ax.set_xlabel(r"coefficient of friction $\mu$")
        ax.set_yticks(range(len(found.cof)), [_label(path) for path in found.cof])
        ax.invert_yaxis()
        ax.legend(loc="lower right")
    return ax


def plot_sensitivity(known: Mapping[str, Mapping[str, float]], ax: Axes | None = None) -> Axes:
    """Draw a bar for each elasticity, a panel for each quantity, what matters most to the first on top.

    Parameters
    ----------
    known : mapping of str to mapping of str to float
        By the name of a quantity its elasticities, by the path of the input.
    ax : matplotlib.axes.Axes, optional
        Where to draw the first quantity alone. None makes a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        Where the first quantity was drawn.
    """
    shown = dict([*known.items()][: None if ax is None else 1])
    paths = list(dict.fromkeys(path for one in shown.values() for path in one))
    with style():
        if ax is None:
            size = (4.6 + 2.2 * len(shown), 1.4 + 0.32 * len(paths))
            _, row = subplots(1, max(len(shown), 1), sharey=True, squeeze=False, figsize=size, layout="constrained")
        else:
            row = np.array([[ax]])
        for beside, (name, elasticity) in zip(row[0], shown.items(), strict=False):
            lengths = np.array([elasticity.get(path, 0.0) for path in paths])
            beside.barh(np.arange(len(paths)), lengths, color=np.where(lengths < 0, *COLOURS[:2]), height=0.6)
            beside.axvline(0, color="0.3", linewidth=0.8, zorder=3)
            beside.set_xlabel(f"{name.replace('v_c', '$v_c$')} [% per %]")
        first: Axes = row[0, 0]
        first.set_yticks(range(len(paths)), [_label(path) for path in paths])
        first.invert_yaxis()
    return first


def _bars(ax: Axes, pairs: Mapping[str, tuple[float, float]], base: float, by: float, factor: float = 1.0) -> None:
    """A bar for each end of each input, from the base; the shorter of two on one side stands before the longer."""
    moved = factor * (np.array([*pairs.values()]) - base)
    moved = np.where(np.isfinite(moved), moved, 0.0)
    most = np.abs(moved).max(initial=0.0) or 1.0
    for lengths, colour, way in zip(moved.T, COLOURS, ("less", "more"), strict=False):
        label = f"{100 * by:.3g} % {way}"
        bars = ax.barh(np.arange(len(pairs)), lengths, left=factor * base, color=colour, height=0.6, label=label)
        for bar, length in zip(bars, lengths, strict=True):
            bar.set_zorder(2 - abs(length) / most)
    ax.axvline(factor * base, color="0.3", linewidth=0.8, zorder=3)
    ax.locator_params(axis="x", nbins=6)


def _label(path: str) -> str:
    """What an input is called."""
    return facts_at(path).label or facts_at(path).meaning or path


def plot_front(found: Any) -> Figure:
    """Draw the power of a Front over friction, and below it each number that was free.

    Parameters
    ----------
    found : Front
        What `front` returned.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    paths = [*found.designs[0].values]
    with style():
        fig, axes = subplots(1 + len(paths), 1, sharex=True, figsize=(6.4, 2.0 + 1.8 * len(paths)))
        factor, symbol = prefix(found.power, "W")
        axes[0].plot(found.cof, factor * found.power, "o-", color="k")
        axes[0].set(ylabel=f"least power [{symbol}]", yscale="log" if np.all(found.power > 0) else "linear")
        for ax, path, colour in zip(axes[1:], paths, COLOURS, strict=False):
            values, unit = np.array([one.values[path] for one in found.designs]), facts_at(path).unit
            factor, symbol = prefix(values, unit)
            ax.plot(found.cof, factor * values, "o-", color=colour)
            ax.set(ylabel=f"{_label(path)}\n[{symbol}]")
        for ax in axes:
            ax.axvline(found.full_cof, color="0.6", lw=1, ls="--")
        axes[-1].set_xlabel(f"greatest friction up to {shown(found.up_to, 'm/s')}")
        fig.align_ylabels()
    return fig


def plot_propagated(found: Any, ax: Axes | None = None) -> Axes:
    """Draw samples of friction and v_c as histograms, each with the normal curve of the slopes.

    Parameters
    ----------
    found : Propagated
        What `propagate` returned.
    ax : matplotlib.axes.Axes, optional
        Where to draw friction alone, or v_c where there is none. None makes a new figure with a panel for each.

    Returns
    -------
    matplotlib.axes.Axes
        Where the first was drawn.
    """
    names = {"cof": (r"coefficient of friction $\mu$", ""), "v_c": ("critical velocity $v_c$", "m/s")}
    with style():
        n = len(found.samples)
        panels = subplots(1, n, figsize=(4.4 * n, 3.6), squeeze=False)[1].flat if ax is None else [ax]
        for panel, (name, samples) in zip(panels, found.samples.items(), strict=False):
            what, unit = names[name]
            values = samples.known[np.isfinite(samples.known)]
            factor, symbol = prefix(values, unit) if unit else (1.0, "")
            _histogram(panel, factor * values, factor * getattr(found, name), getattr(found, f"{name}_sd"), factor)
            panel.set(xlabel=f"{what} [{symbol}]" if symbol else what, ylabel="samples")
            ax = ax or panel
        assert ax is not None
        ax.legend()
    return ax


def _histogram(ax: Axes, values: Any, centre: float, sd: float | None, factor: float) -> None:
    """Samples, and how many of them a normal distribution has there; without a spread a line where it is."""
    _, edges, _ = ax.hist(values, bins=max(round(np.sqrt(values.size)), 1), color=COLOURS[4], label="samples")
    most = ax.get_ylim()
    if sd and np.isfinite(centre):
        x = np.linspace(-4, 4, 201)
        bell = np.exp(-(x**2) / 2) / (np.sqrt(2 * np.pi) * factor * sd)
        ax.plot(centre + factor * sd * x, values.size * (edges[1] - edges[0]) * bell, color=COLOURS[0], label="slopes")
    elif np.isfinite(centre):
        ax.axvline(centre, color=COLOURS[0], label="the case")
    ax.set_ylim(most)
    ax.locator_params(axis="x", nbins=5)
