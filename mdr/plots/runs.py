"""A run that kept its last periods: the modes of its springs, its forces, and where body and feet move.

Functions with `ax` draw on it (or on a new one) and return it; the others return a Figure. Records are read by
attribute only. Times are in periods of the oscillation, lengths and forces in the prefix that reads best.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.plots.figures import COLOURS, Axes, Figure, axes_of, edges_of, faint, prefix, style, subplots

#: name and colour of each `mdr.State`, by its value; light to dark as a spring is held more firmly
MODES = (("free", "#D2D2D2"), ("stick", "#0B3C6F"), ("slip", "#F0B93A"), ("slip back", "#C8402B"))


def plot_spring_map(run: Any, ax: Axes | None = None) -> Axes:
    """Draw the mode of every spring, free, stick or slip, over time and position.

    Of a run that is shaken across, the colour of a spring that slips is the direction of slip, which is that of its
    force.

    Parameters
    ----------
    run : SlidingRun
        A run made with `record=1` or more.
    ax : matplotlib.axes.Axes, optional
        Where to draw. None makes a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        Where it was drawn.
    """
    with style():
        ax = axes_of(ax)
        turned = _draw_map(ax, run, prefix(_recorded(run).x, "m"))
        if turned is not None:
            _direction_bar(ax.figure, turned, ax)
        patches = mode_patches(run.state, slip=turned is None)
        ax.legend(handles=patches, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4, borderaxespad=0.2)
    return ax


def plot_spring_maps(runs: Sequence[Any], labels: Sequence[str]) -> Figure:
    """Show the spring maps of several runs side by side, under their labels and on the same axes."""
    runs, labels = [_recorded(run) for run in runs], list(labels)
    if not runs or len(labels) != len(runs):
        raise ValueError(f"labels must name each of the {len(runs)} runs (at least one), got {len(labels)}")
    unit = prefix(np.concatenate([run.x for run in runs]), "m")
    with style():
        size = (max(3.4, 1.2 + 2.4 * len(runs)), 3.4)
        fig, axes = subplots(1, len(runs), sharex=True, sharey=True, squeeze=False, figsize=size)
        turned = [_draw_map(ax, run, unit) for ax, run in zip(axes[0], runs, strict=True)]
        for ax, label in zip(axes[0], labels, strict=True):
            ax.set_title(label)
            ax.label_outer()
            ax.locator_params(axis="x", nbins=3)
        layout: Any = fig.get_layout_engine()
        layout.set(w_pad=0.07)  # the last number of one time axis stands beside the first of the next
        if directed := [one for one in turned if one is not None]:
            _direction_bar(fig, directed[0], axes[0])
        handles = mode_patches(*(run.state for run in runs), slip=len(directed) < len(runs))
        fig.legend(handles=handles, loc="outside lower center", ncols=4)
    return fig


def limit_of(run: Any) -> NDArray[np.float64]:
    """The force of full slip at the instants of a record [N]: mu_0 F_z, and what a shear strength of the face adds."""
    strength = 0.0 if run.strength is None else run.strength.sum(axis=1)
    return np.asarray(run.mu_0 * np.asarray(run.F_z) + strength)


def plot_forces(run: Any, ax: Axes | None = None) -> Axes:
    """Tangential force and its limit mu_0 F_z against time; the shaded gap is the friction that is missing.

    Its share of the area under the limit, named in the legend, is 1 − mean F_x/(mu_0 mean F_z). Where the force turns,
    as under a shake in the plane, both limits are drawn and the mean is named instead. Shaken across, F_y is drawn too.
    """
    t = periods_of(_recorded(run))
    limit, F_x, F_y = limit_of(run), np.asarray(run.F_x), getattr(run, "F_y", None)
    name = r"$\mu_0 F_z$" if run.strength is None else "full slip"
    factor, unit = prefix(np.concatenate([F_x, limit]), "N")
    mean = run.mean_F_x / (run.full_cof * run.mean_F_z)
    turns = F_y is not None or float(F_x.min()) < -1e-9 * float(limit.max())
    with style():
        ax = axes_of(ax)
        if turns:
            ax.fill_between(t, -limit * factor, limit * factor, color="0.9", linewidth=0)
            of = "mean" if F_y is None else "mean $F_x$"
            ax.axhline(run.mean_F_x * factor, color="0.4", lw=1, ls="--", label=f"{of}, {mean:.3g} of {name}")
            ax.plot(t, -limit * factor, color="0.6")
        else:
            gap = f"{100 * (1 - mean):.3g} % missing" if mean < 1 - 1e-6 else "nothing missing"
            ax.fill_between(t, F_x * factor, limit * factor, color="0.9", linewidth=0, label=gap)
        ax.plot(t, limit * factor, color="0.6", label=f"{name}, the limit")
        ax.plot(t, F_x * factor, color="k", label="$F_x$")
        if F_y is not None:
            ax.plot(t, F_y * factor, color=COLOURS[0], label="$F_y$")
        ax.set(xlabel="time [periods]", ylabel=f"force [{unit}]", xlim=_span(t))
        ax.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=4, columnspacing=1.3, handlelength=1.5)
    return ax


def plot_run(run: Any) -> Figure:
    """Show a recorded run: the spring map, and below it the forces that the springs add up to."""
    with style():
        fig, (above, below) = subplots(2, 1, sharex=True, figsize=(6.4, 5.6), height_ratios=(3, 2))
        plot_spring_map(run, above)
        plot_forces(run, below)
        above.set_xlabel("")
        fig.align_ylabels()
    return fig


def plot_traces(run: Any) -> Figure:
    """Draw forces, displacements relative to the pulled end, and velocities of the foot points over time.

    A foot point whose velocity is zero sticks. One that is off the plane is left out.

    Parameters
    ----------
    run : SlidingRun
        A run made with `record=1` or more.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.
    """
    t = periods_of(_recorded(run))
    with style():
        fig, (forces, places, velocities) = subplots(3, 1, sharex=True, figsize=(6.4, 7.2))
        plot_forces(run, forces)
        forces.set_xlabel("")
        _draw_places(places, t, run)
        _draw_velocities(velocities, t, run)
        velocities.set_xlabel("time [periods]")
        places.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=4, columnspacing=1.3, handlelength=1.5)
        fig.align_ylabels()
    return fig


def _draw_map(ax: Axes, run: Any, unit: tuple[float, str]) -> Any:
    """Colours of the modes over time and position, positions in the unit (factor, name).

    Returns the mesh of the directions of slip, None where slip has but two.
    """
    from matplotlib.colors import BoundaryNorm, ListedColormap

    order, t = np.argsort(run.x), periods_of(run)
    every = -(-len(t) // 2000)  # more than a page has pixels
    cells = edges_of(t[::every]), _boundaries(np.asarray(run.x)[order]) * unit[0]
    state = np.asarray(run.state)[::every, order].T
    modes, norm = ListedColormap([colour for _, colour in MODES]), BoundaryNorm(np.arange(5) - 0.5, 4)
    ax.pcolormesh(*cells, state, cmap=modes, norm=norm, rasterized=True)
    ax.set(xlabel="time [periods]", ylabel=f"position of the spring $x$ [{unit[1]}]", xlim=_span(t))
    if getattr(run, "f_y", None) is None:
        return None
    angle = np.degrees(np.arctan2(run.f_y, run.f_x))[::every, order].T
    slips = np.array([name.startswith("slip") for name, _ in MODES])[state]
    return ax.pcolormesh(*cells, np.where(slips, angle, np.nan), cmap=around(), vmin=-180, vmax=180, rasterized=True)


def around() -> Any:
    """The cyclic colour map of directions, from -180 to 180 degrees."""
    from matplotlib.colors import LinearSegmentedColormap

    # that along the pull is the colour of slip
    colours = {-180: "#CC79A7", -90: "#D55E00", 0: MODES[2][1], 90: "#009E73", 135: "#56B4E9", 180: "#CC79A7"}
    return LinearSegmentedColormap.from_list("around", [((at + 180) / 360, one) for at, one in colours.items()])


def _direction_bar(figure: Any, turned: Any, beside: Any) -> None:
    """Colour bar of the direction of slip."""
    bar = figure.colorbar(turned, ax=beside, ticks=range(-180, 181, 90), aspect=16, pad=0.02)
    bar.set_label("direction of slip [°]\n0 along the pull, 90 across")


def mode_patches(*states: Any, slip: bool = True, free: str = MODES[0][0]) -> list[Any]:
    """Legend entries of the modes that occur in arrays of modes; slip: also of those that slip; free: its name."""
    from matplotlib.patches import Patch

    seen = np.unique(np.concatenate([np.unique(state) for state in states]))
    shown = [MODES[m] for m in seen if slip or not MODES[m][0].startswith("slip")]
    names = {MODES[0][0]: free}
    return [Patch(fc=colour, ec="0.6", lw=0.5, label=names.get(name, name)) for name, colour in shown]


def _draw_places(ax: Axes, t: NDArray[np.float64], run: Any) -> None:
    """Draw body and foot points less v_0 t, each about its own mean: only the oscillation is left."""
    moved = np.asarray(run.v_0 * run.t)
    lines: list[tuple[Any, dict[str, Any]]] = [(run.u_x - moved, {"label": "body", "color": "k"})]
    lines += [(foot - moved, look) for foot, look in _feet(run)]
    lines = [(y - np.nanmean(y), look) for y, look in lines if np.any(np.isfinite(y))]
    factor, unit = prefix(np.concatenate([y for y, _ in lines]), "m")
    for y, look in lines:
        ax.plot(t, y * factor, **look)
    ax.set_ylabel(f"$u - v_0 t$ [{unit}]\nabout its mean")


def _draw_velocities(ax: Axes, t: NDArray[np.float64], run: Any) -> None:
    """Velocity of the foot points over v_0: zero where one sticks."""
    faint(ax.axhline, 0.0)
    for foot, look in _feet(run):
        ax.plot(t, np.gradient(foot, run.t) / (run.v_0 or 1.0), **look)
    ax.set_ylabel("foot velocity / $v_0$" if run.v_0 else "foot velocity [m/s]")


def _feet(run: Any) -> Iterable[tuple[NDArray[np.float64], dict[str, Any]]]:
    """Position (nan off the plane) and look of the foot at the centre, half-way and the mean edge.

    Lines grow thinner, so that feet moving as one all show.
    """
    x, free = np.asarray(run.x), np.array([name == "free" for name, _ in MODES])[run.state]
    touching = np.flatnonzero(free.mean(axis=0) <= 0.5)
    edge = touching[np.argmax(x[touching])] if len(touching) else np.argmin(x)
    chosen = {"centre": np.argmin(x), "half-way": np.argmin(np.abs(x - x[edge] / 2)), "mean edge": edge}
    looks = zip(chosen.items(), COLOURS, (4.5, 2.8, 1.3), strict=False)
    taken = set()
    for (name, i), colour, width in looks:
        if i not in taken:
            foot = np.where(free[:, i], np.nan, run.u_x - np.asarray(run.e)[:, i])
            yield foot, {"label": f"foot, {name}", "color": colour, "lw": width}
        taken.add(i)


def _recorded(run: Any) -> Any:
    """The run, if it kept its arrays."""
    if run.t is None:
        raise ValueError("the run kept no arrays to draw; call slide(case, v_0, record=2) to keep two periods")
    return run


def periods_of(run: Any) -> NDArray[np.float64]:
    """Time in periods, from the last whole period before the record begins."""
    t = np.asarray(run.t) * run.omega / (2 * np.pi)
    return np.asarray(t - np.floor(t[0] + 1e-9))


def _span(t: NDArray[np.float64]) -> tuple[float, float]:
    """What a record spans: its instants are the ends of its steps."""
    return float(2 * t[0] - t[1]), float(t[-1])


def _boundaries(centres: NDArray[np.float64]) -> NDArray[np.float64]:
    """Boundaries (n + 1,) of adjoining cells from 0 on with these centres (n,); half-way between if none fit."""
    edges = np.zeros(len(centres) + 1)
    for i, centre in enumerate(centres):
        edges[i + 1] = 2 * centre - edges[i]
    return edges if np.all(np.diff(edges) > 0) else np.maximum(edges_of(centres), 0.0)
