"""Every figure of the library: COF curves, spring maps, forces and traces of a run, and the mapped profile.

Functions with `ax` draw on it (or on a new one) and return it; the others return a Figure. Records are read
by attribute only. Times are in periods of the oscillation, lengths and forces in the prefix that reads best.
"""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from io import StringIO
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Any

import numpy as np

from mdr.tools.notation import scale_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike, NDArray

__all__ = [
    "COLOURS",
    "MODES",
    "around",
    "edges_of",
    "limit_of",
    "periods_of",
    "plot_curve",
    "plot_fit",
    "plot_force_curve",
    "plot_forces",
    "plot_profile",
    "plot_run",
    "plot_spring_map",
    "plot_spring_maps",
    "plot_traces",
    "prefix",
    "save",
    "style",
    "svg_of",
]

#: Okabe and Ito (2008): distinct to colour-blind readers, and dark enough on white
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#555555")
#: name and colour of each `mdr.State`, by its value; light to dark as a spring is held more firmly
MODES = (("free", "#D2D2D2"), ("stick", "#0B3C6F"), ("slip", "#F0B93A"), ("slip back", "#C8402B"))

OVER_V_C = r"$v_0/v_c$"
_ONE = Lock()  # pyplot has one style and one list of figures for all threads
PIECES = 16  #: straight ones between two points of a smooth line


@contextmanager
def style(changes: Mapping[str, Any] | None = None) -> Iterator[None]:
    """Font sizes, colours and layout of the figures, for use in a `with`; changes: more rcParams, or other values.

    What it set is put back at its end, and nothing else: pyplot may load its backend inside, which sets rcParams too.
    """
    import matplotlib as mpl
    from cycler import cycler

    look: dict[Any, Any] = {
        "figure.figsize": (6.4, 4.2),
        "figure.constrained_layout.use": True,
        "font.size": 11,
        "axes.titlesize": 11,
        "legend.fontsize": 9.5,
        "legend.frameon": False,
        "axes.prop_cycle": cycler(color=COLOURS),
        "axes.spines.top": False,
        "axes.spines.right": False,
        "lines.linewidth": 1.6,
        "svg.hashsalt": "mdr",
        **(changes or {}),
    }
    before = {name: mpl.rcParams[name] for name in look}
    try:
        mpl.rcParams.update(look)
        yield
    finally:
        mpl.rcParams.update(before)


def svg_of(draw: "Callable[[], Figure]") -> str:
    """The SVG of a figure that is drawn here, for a thread beside others."""
    from matplotlib import pyplot as plt

    out = StringIO()
    with _ONE:
        figure = draw()
        try:
            figure.savefig(out, format="svg")
        finally:
            plt.close(figure)
    return out.getvalue()


def plot_curve(
    curves: Any, ax: "Axes | None" = None, labels: Sequence[str] | None = None, *, absolute: bool | None = None
) -> "Axes":
    """Draw one CofCurve, COF over mu_0 against v_0 over v_c, or several, COF against v_0; unsettled points are hollow.

    Points are what was computed. The line between them is smooth, and rises and falls with them alone.

    Parameters
    ----------
    curves : CofCurve or sequence of CofCurve
        What is drawn.
    ax : matplotlib.axes.Axes, optional
        Where to draw. None makes a new figure.
    labels : sequence of str, optional
        One name for each curve.
    absolute : bool, optional
        True draws the COF against v_0 in m/s (or mm/s, µm/s), False either over the curve's own scale, mu_0 and v_c.
        None: True for several curves, and where ``ax`` shows something already, whose unit is taken. Where a curve has
        no finite v_c (resonance) it is True.

    Returns
    -------
    matplotlib.axes.Axes
        Where it was drawn.
    """
    curves = [curves] if hasattr(curves, "cof") else list(curves)
    absolute = len(curves) > 1 or (ax is not None and ax.has_data()) if absolute is None else absolute
    if labels is not None and len(labels) != len(curves):
        raise ValueError(f"labels must name each of the {len(curves)} curves, got {len(labels)}")
    scaled = not absolute and all(_is_scale(curve.v_c) for curve in curves)
    both = any(np.min(curve.v_0) < 0 for curve in curves)
    factor, unit = _prefix_on(ax, np.concatenate([np.ravel(curve.v_0) for curve in curves]))
    scales = [(curve.v_c, curve.full_cof) if scaled else (1 / factor, 1.0) for curve in curves]
    shades = colours(len(curves))
    with style():
        ax = axes_of(ax)
        for i, (curve, scale, colour) in enumerate(zip(curves, scales, shades, strict=True)):
            _draw_curve(ax, curve, scale, colour, labels[i] if labels else None)
        for level in {curve.full_cof / mu for curve, (_, mu) in zip(curves, scales, strict=True)}:
            _limits(ax, level, both)
        if both:
            _faint(ax.axhline, 0.0)
            _faint(ax.axvline, 0.0)
        _mark_critical(ax, curves, scales, shades, both)
        over_v_c = f"pulling velocity {OVER_V_C}" + (", $v_c$ of a forward pull" if both else "")
        ax.set_xlabel(over_v_c if scaled else rf"pulling velocity $v_0$ [{unit}]")
        over = r"$\mu/\mu_0$" if all(curve.full_cof == curve.mu_0 for curve in curves) else "over that of full slip"
        ax.set_ylabel("coefficient of friction " + (over if scaled else r"$\mu$"))
        if not both:
            ax.set_xlim(left=-0.015 * ax.get_xlim()[1])
        settled, across = (np.all(curve.settled) for curve in curves), (_across(curve) is not None for curve in curves)
        _curve_legend(ax, all(settled), both, any(across))
    return ax


def _prefix_on(ax: "Axes | None", v_0: Any) -> tuple[float, str]:
    """Factor and unit of velocities: of the axes, if they show velocities already."""
    shown = re.search(r"v_0\$ \[(.?)m/s\]", ax.get_xlabel()) if ax is not None and ax.has_data() else None
    if shown is None:
        return prefix(v_0, "m/s")
    unit = f"{shown[1]}m/s"
    return 1 / (scale_of(unit, "m/s") or 1.0), unit


def plot_fit(fitted: Any, ax: "Axes | None" = None) -> "Axes":
    """Draw measured coefficients of friction with their errors, the curve of the fitted contact, and residuals below.

    Parameters
    ----------
    fitted : Fit
        What `fit` returned.
    ax : matplotlib.axes.Axes, optional
        Where to draw data and curve alone. None makes a new figure, with a second panel for the residuals.

    Returns
    -------
    matplotlib.axes.Axes
        Where data and curve were drawn.
    """
    data, curve = fitted.data, fitted.curve
    if ax is not None and ax.has_data() and OVER_V_C in ax.get_xlabel():
        raise ValueError("ax shows friction over v_0/v_c, and data are over v_0: plot the curve with absolute=True")
    factor, unit = _prefix_on(ax, data.v_0)
    velocity = f"pulling velocity $v_0$ [{unit}]"
    with style():
        if ax is None:
            _, (ax, below) = subplots(2, 1, sharex=True, figsize=(6.4, 5.2), height_ratios=(3, 1))
            below.errorbar(data.v_0 * factor, fitted.residuals, data.error, fmt="o", color=COLOURS[1], capsize=2)
            below.axhline(0, color=COLOURS[0], linewidth=1.0, zorder=0)
            below.set(xlabel=velocity, ylabel="measured\nless fitted")
        ax.errorbar(data.v_0 * factor, data.cof, data.error, fmt="o", color=COLOURS[1], capsize=2, label="measured")
        ax.plot(curve.v_0 * factor, curve.cof, color=COLOURS[0], label="fitted contact")
        _limits(ax, fitted.case.mu_0, fitted.case.is_shaken)
        ax.set(xlabel=velocity, ylabel=r"coefficient of friction $\mu$")
        ax.label_outer()
        ax.legend()
    return ax


def plot_force_curve(curve: Any, ax: "Axes | None" = None) -> "Axes":
    """Draw a measured force over depth, what is taken of it, and the touch and the baseline.

    Parameters
    ----------
    curve : ForceCurve
        What `read_force_curve` returned.
    ax : matplotlib.axes.Axes, optional
        Where to draw. None makes a new figure.

    Returns
    -------
    matplotlib.axes.Axes
        Where it was drawn.
    """
    length, force = prefix(curve.d, "m"), prefix(curve.F, "N")
    touch = 0.0 if curve.touch is None else curve.touch
    with style():
        ax = axes_of(ax)
        ax.plot(curve.d * length[0], curve.F * force[0], ".", color="0.6", markersize=4, label="measured")
        taken = (touch + curve.depths) * length[0], (curve.baseline + curve.forces) * force[0]
        ax.plot(*taken, color=COLOURS[0], label="from the touch on")
        if curve.touch is not None:
            told = f"touch {touch * length[0]:.4g} {length[1]}, baseline {curve.baseline * force[0]:.4g} {force[1]}"
            ax.axvline(touch * length[0], color=COLOURS[1], linewidth=1.0, linestyle="--", label=told)
            ax.axhline(curve.baseline * force[0], color=COLOURS[1], linewidth=1.0, linestyle="--")
        ax.set(xlabel=f"depth [{length[1]}]", ylabel=f"normal force [{force[1]}]")
        ax.legend(loc="upper left")
    return ax


def plot_spring_map(run: Any, ax: "Axes | None" = None) -> "Axes":
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


def plot_spring_maps(runs: Sequence[Any], labels: Sequence[str]) -> "Figure":
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


def limit_of(run: Any) -> "NDArray[np.float64]":
    """The force of full slip at the instants of a record [N]: mu_0 F_z, and what a shear strength of the face adds."""
    strength = 0.0 if run.strength is None else run.strength.sum(axis=1)
    return np.asarray(run.mu_0 * np.asarray(run.F_z) + strength)


def plot_forces(run: Any, ax: "Axes | None" = None) -> "Axes":
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


def plot_run(run: Any) -> "Figure":
    """Show a recorded run: the spring map, and below it the forces that the springs add up to."""
    with style():
        fig, (above, below) = subplots(2, 1, sharex=True, figsize=(6.4, 5.6), height_ratios=(3, 2))
        plot_spring_map(run, above)
        plot_forces(run, below)
        above.set_xlabel("")
        fig.align_ylabels()
    return fig


def plot_traces(run: Any) -> "Figure":
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


def plot_profile(indenter: Any, d: float, n_springs: int = 40, springs: "ArrayLike | None" = None) -> "Figure":
    """Draw the shape f(r) and its image g(x), pressed to the depth d into its springs, with the contact radius.

    Parameters
    ----------
    indenter : Indenter
        The shape.
    d : float
        Depth [m].
    n_springs : int
        Number of springs, evenly on both sides.
    springs : array_like of float, optional
        Positions x >= 0 of the springs [m], or a record with `.x`, in the place of n_springs.

    Returns
    -------
    matplotlib.figure.Figure
        The figure. Heights are exaggerated: the two axes have their own scales.
    """
    a = float(indenter.contact_radius(d))
    if springs is None:
        x = (np.arange(-(-n_springs // 2)) + 0.5) * 1.5 * a / (n_springs / 2)
    else:
        x = np.sort(np.asarray(getattr(springs, "x", springs), dtype=float))
    units = prefix([1.5 * a], "m"), prefix([d], "m")
    with style():
        fig, (left, right) = subplots(1, 2, sharex=True, sharey=True, figsize=(7.4, 3.6))
        r = np.linspace(0.0, min(1.6 * a, indenter.max_radius), 321)
        _draw_shape(left, r, indenter.profile_3d(r), a, d, units)
        _draw_springs(right, indenter.profile_1d, x, a, d, units)
        _draw_shape(right, r, indenter.profile_1d(r), a, d, units)
        left.set(title="shape $f(r)$", xlabel=f"$r$ [{units[0][1]}]", ylabel=f"height [{units[1][1]}]")
        right.set(title="image $g(x)$ on its springs", xlabel=f"$x$ [{units[0][1]}]")
        reach = max(1.52 * a, 1.03 * np.max(x)) * units[0][0]
        left.set_xlim(-reach, reach)
        fig.legend(loc="outside lower center", ncols=2)
    return fig


def save(figure: "Figure", script: str, suffix: str = "") -> Path:
    """Save a figure as figures/<name of the script><suffix>.png beside the script; returns the path."""
    path = Path(script).resolve().parent / "figures" / f"{Path(script).stem}{suffix}.png"
    path.parent.mkdir(exist_ok=True)
    figure.savefig(path, dpi=200)
    return path


def _limits(ax: "Axes", mu: float, both: bool) -> None:
    """Lines at the full friction of a forward pull, and of a backward one."""
    for level in (mu, -mu)[: 1 + both]:
        _faint(ax.axhline, level)


def _faint(draw: Any, at: float) -> None:
    """A line to read other things by."""
    draw(at, color="0.75", linewidth=0.8, zorder=0)


def _mark_critical(ax: "Axes", curves: Any, scales: Any, shades: Any, both: bool) -> None:
    """Dotted lines at v_c, and at that of the other way: one line for curves that share it, else in their colours."""
    for name, field, way in (("$v_c$", "v_c", 1), ("$v_c$, other way", "v_c_back", -1))[: 1 + both]:
        marks: dict[float, Any] = {}
        for curve, (unit, _), shade in zip(curves, scales, shades, strict=True):
            v_c: Any = getattr(curve, field, None)
            if _is_scale(v_c):
                at = float(f"{way * v_c / unit:.6g}")
                marks[at] = "0.4" if at in marks or len(curves) == 1 else shade
        for at, shade in marks.items():
            ax.axvline(at, color=shade, linewidth=1.0, linestyle=":", zorder=0)
            ax.annotate(name, (at, 1.0), (0, 3), ("data", "axes fraction"), "offset points", ha="center")


def _draw_curve(ax: "Axes", curve: Any, scale: tuple[float, float], colour: Any, label: str | None) -> None:
    """Line, points (hollow where not settled), error bars wider than a point, and the static limit.

    scale: of velocities and of COFs.
    """
    v, mu = np.asarray(curve.v_0) / scale[0], np.asarray(curve.cof) / scale[1]
    error = np.nan_to_num(np.asarray(curve.cof_error) / scale[1], posinf=0.0)
    settled = np.asarray(curve.settled, dtype=bool)
    static = curve.static_cof / scale[1]
    ax.plot(*_line(curve, v, mu, scale[1]), color=colour, label=label, zorder=2)
    if (cof_y := _across(curve)) is not None:
        order = np.argsort(v)
        for way in (order[v[order] < 0], order[v[order] >= 0]):
            ax.plot(v[way], cof_y[way] / scale[1], color=colour, ls="-.", lw=1.2, zorder=2)
    size = 4.0 if len(v) <= 40 else 2.2
    ax.plot(v[settled], mu[settled], "o", color=colour, markersize=size, zorder=3)
    ax.plot(v[~settled], mu[~settled], "o", mfc="white", mec=colour, markersize=size + 0.5, zorder=3)
    seen = error * scale[1] / curve.full_cof > 0.005
    if np.any(seen):
        ax.errorbar(v[seen], mu[seen], error[seen], fmt="none", ecolor=colour, capsize=2, zorder=1)
    if np.isfinite(static) and np.min(curve.v_0) >= 0:
        reach = 0.15 * float(np.max(v, initial=0.0))
        ax.plot([0.0, reach], [static, static], color=colour, linewidth=1.2, linestyle="--", zorder=1)


def _line(curve: Any, v: "NDArray[Any]", mu: "NDArray[Any]", scale: float) -> "tuple[NDArray[Any], NDArray[Any]]":
    """A smooth line through the points; at rest, of a curve of both ways, upright from one limit to the other.

    Where the limit of a backward pull was not computed the line is broken there: friction may jump.
    """
    order = np.argsort(v)
    v, mu = v[order], mu[order]
    back, forward = v < 0, v > 0
    if not (back.any() and forward.any()):
        return smooth(v, mu)
    low = np.nan if curve.static_cof_back is None else curve.static_cof_back / scale
    backward = smooth(np.append(v[back], 0.0), np.append(mu[back], low))
    onward = smooth(np.append(0.0, v[forward]), np.append(curve.static_cof / scale, mu[forward]))
    at, line = (np.concatenate(pair) for pair in zip(backward, onward, strict=True))
    return at, line


def smooth(x: "NDArray[Any]", y: "NDArray[Any]") -> "tuple[NDArray[Any], NDArray[Any]]":
    """A line through points with x ascending, cubic between them and never beyond either neighbour.

    It is broken at a point that is nan, and straight where points share a place.
    """
    from scipy.interpolate import PchipInterpolator

    seen = np.isfinite(y)
    if np.count_nonzero(seen) < 2 or np.any(np.diff(x) <= 0):
        return x, y
    share = np.arange(PIECES * (x.size - 1) + 1) / PIECES
    at, nodes = np.interp(share, np.arange(x.size), x), np.interp(share, np.arange(x.size), y)  # nan beside a nan
    line = np.where(np.isfinite(nodes), PchipInterpolator(x[seen], y[seen])(at), np.nan)
    line[::PIECES] = y  # to the last digit
    return at, line


def _across(curve: Any) -> Any:
    """The COF across the pull (n_v,), where there is one."""
    cof_y = getattr(curve, "cof_y", None)
    return None if cof_y is None or np.all(np.abs(cof_y) <= curve.cof_error) else np.asarray(cof_y)


def _curve_legend(ax: "Axes", settled: bool, both: bool, across: bool) -> None:
    """Explain the labels given, the static limit, and a hollow point and the COF across where there are such."""
    from matplotlib.lines import Line2D

    handles, _ = ax.get_legend_handles_labels()
    if not both:
        handles.append(Line2D([], [], color="0.3", linewidth=1.2, linestyle="--", label="static limit"))
    if across:
        handles.append(Line2D([], [], color="0.3", lw=1.2, ls="-.", label="across the pull"))
    if not settled:
        handles.append(Line2D([], [], color="0.3", ls="", marker="o", mfc="white", label="not settled"))
    if handles:
        ax.legend(handles=handles, loc="best", frameon=True, edgecolor="none")


def _draw_map(ax: "Axes", run: Any, unit: tuple[float, str]) -> Any:
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


def _draw_places(ax: "Axes", t: "NDArray[np.float64]", run: Any) -> None:
    """Draw body and foot points less v_0 t, each about its own mean: only the oscillation is left."""
    moved = np.asarray(run.v_0 * run.t)
    lines: list[tuple[Any, dict[str, Any]]] = [(run.u_x - moved, {"label": "body", "color": "k"})]
    lines += [(foot - moved, look) for foot, look in _feet(run)]
    lines = [(y - np.nanmean(y), look) for y, look in lines if np.any(np.isfinite(y))]
    factor, unit = prefix(np.concatenate([y for y, _ in lines]), "m")
    for y, look in lines:
        ax.plot(t, y * factor, **look)
    ax.set_ylabel(f"$u - v_0 t$ [{unit}]\nabout its mean")


def _draw_velocities(ax: "Axes", t: "NDArray[np.float64]", run: Any) -> None:
    """Velocity of the foot points over v_0: zero where one sticks."""
    _faint(ax.axhline, 0.0)
    for foot, look in _feet(run):
        ax.plot(t, np.gradient(foot, run.t) / (run.v_0 or 1.0), **look)
    ax.set_ylabel("foot velocity / $v_0$" if run.v_0 else "foot velocity [m/s]")


def _feet(run: Any) -> "Iterable[tuple[NDArray[np.float64], dict[str, Any]]]":
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


def _draw_shape(ax: "Axes", r: Any, profile: Any, a: float, d: float, units: Any) -> None:
    """Draw the indenter, pressed down by d into the undeformed surface, and the contact radius.

    Both flanks out to 1.6 a, with a vertical wall where the profile ends before that.
    """
    (per_r, _), (per_z, _) = units
    r, z = r[np.isfinite(profile)], profile[np.isfinite(profile)] - d
    if r[-1] < 1.6 * a:
        r, z = np.append(r, r[-1]), np.append(z, max(z[-1], d))
    r, z = np.concatenate([-r[::-1], r]), np.concatenate([z[::-1], z])
    top = 0.6 * d
    ax.fill_between(r * per_r, np.minimum(z, top) * per_z, top * per_z, color="0.88", linewidth=0, zorder=1)
    ax.plot(r * per_r, z * per_z, color="k", zorder=4)
    ax.axhline(0.0, color="0.4", linewidth=0.8, zorder=0)
    for side in (-a, a):
        ax.axvline(side * per_r, color="0.4", linewidth=1.0, linestyle=":", zorder=0)
    ax.annotate("$a$", (a * per_r, 0.0), (3, 3), ("data", "axes fraction"), "offset points")
    ax.set_ylim(-1.7 * d * per_z, top * per_z)


def _draw_springs(ax: "Axes", profile: Any, x: Any, a: float, d: float, units: Any) -> None:
    """One line per spring from the ground up: to the indenter where it presses, to the surface where not."""
    (per_x, _), (per_z, _) = units
    x = np.concatenate([-x[x > 0][::-1], x])
    pressed = np.abs(x) < a
    height = np.zeros_like(x)
    height[pressed] = np.minimum(np.asarray(profile(np.abs(x[pressed])), dtype=float) - d, 0.0)
    for name, these, colour in (("in contact", pressed, COLOURS[0]), ("free", ~pressed, "0.7")):
        ax.vlines(x[these] * per_x, -1.4 * d * per_z, height[these] * per_z, color=colour, lw=1.2, label=name)
        ax.plot(x[these] * per_x, height[these] * per_z, ".", color=colour, markersize=4, zorder=3)
    ax.plot(x[[0, -1]] * per_x, [-1.4 * d * per_z] * 2, color="k", linewidth=2)


def axes_of(ax: "Axes | None") -> "Axes":
    """The axes given, or those of a new figure."""
    return subplots()[1] if ax is None else ax


def subplots(*args: Any, **kwargs: Any) -> "tuple[Figure, Any]":
    """pyplot's, of a figure that a notebook shows once."""
    import matplotlib.pyplot as plt

    from mdr.plots.picture import Picture

    return plt.subplots(*args, FigureClass=Picture, **kwargs)


def colours(n: int) -> list[Any]:
    """Take the named colours, or a perceptual scale where they do not suffice."""
    import matplotlib as mpl

    if n <= len(COLOURS):
        return list(COLOURS[:n])
    return list(mpl.colormaps["viridis"](np.linspace(0.0, 0.9, n)))


def _is_scale(v_c: Any) -> bool:
    return v_c is not None and bool(np.isfinite(v_c)) and v_c > 0


def _recorded(run: Any) -> Any:
    """The run, if it kept its arrays."""
    if run.t is None:
        raise ValueError("the run kept no arrays to draw; call slide(case, v_0, record=2) to keep two periods")
    return run


def periods_of(run: Any) -> "NDArray[np.float64]":
    """Time in periods, from the last whole period before the record begins."""
    t = np.asarray(run.t) * run.omega / (2 * np.pi)
    return np.asarray(t - np.floor(t[0] + 1e-9))


def _span(t: "NDArray[np.float64]") -> tuple[float, float]:
    """What a record spans: its instants are the ends of its steps."""
    return float(2 * t[0] - t[1]), float(t[-1])


def edges_of(centres: "NDArray[np.float64]") -> "NDArray[np.float64]":
    """Cell boundaries half-way between ascending centres (n,), the outer cells symmetric: (n + 1,)."""
    if len(centres) == 1:
        half = abs(centres[0]) or 0.5
        return np.array([centres[0] - half, centres[0] + half])
    middle = (centres[1:] + centres[:-1]) / 2
    return np.concatenate([[2 * centres[0] - middle[0]], middle, [2 * centres[-1] - middle[-1]]])


def _boundaries(centres: "NDArray[np.float64]") -> "NDArray[np.float64]":
    """Boundaries (n + 1,) of adjoining cells from 0 on with these centres (n,); half-way between if none fit."""
    edges = np.zeros(len(centres) + 1)
    for i, centre in enumerate(centres):
        edges[i + 1] = 2 * centre - edges[i]
    return edges if np.all(np.diff(edges) > 0) else np.maximum(edges_of(centres), 0.0)


def prefix(values: Any, unit: str) -> tuple[float, str]:
    """Factor and unit that bring the largest magnitude between 1 and 1000."""
    largest = float(np.max(np.abs(values), initial=0.0, where=np.isfinite(values)))
    power = int(np.clip(np.floor(np.log10(largest) / 3 + 1e-9), -4, 3)) if largest > 0 else 0
    return 10.0 ** (-3 * power), "pnµm kMG"[power + 4].strip() + unit
