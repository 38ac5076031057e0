"""Curves: friction over velocity, beside measured points, and a measured force over depth.

Functions with `ax` draw on it (or on a new one) and return it. Records are read by attribute only.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.plots.figures import COLOURS, Axes, axes_of, colours, faint, prefix, style, subplots
from mdr.tools.notation import scale_of

OVER_V_C = r"$v_0/v_c$"
PIECES = 16  #: straight ones between two points of a smooth line


def plot_curve(
    curves: Any, ax: Axes | None = None, labels: Sequence[str] | None = None, *, absolute: bool | None = None
) -> Axes:
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
            faint(ax.axhline, 0.0)
            faint(ax.axvline, 0.0)
        _mark_critical(ax, curves, scales, shades, both)
        over_v_c = f"pulling velocity {OVER_V_C}" + (", $v_c$ of a forward pull" if both else "")
        ax.set_xlabel(over_v_c if scaled else rf"pulling velocity $v_0$ [{unit}]")
        over = r"$\mu/\mu_0$" if all(curve.full_cof == curve.mu_0 for curve in curves) else "over that of full slip"
        ax.set_ylabel("coefficient of friction " + (over if scaled else r"$\mu$"))
        if not both:
            ax.set_xlim(left=-0.015 * ax.get_xlim()[1])
        settled, across = (np.all(curve.settled) for curve in curves), (_across(curve) is not None for curve in curves)
        static = [] if both else [_at_rest(curve) / mu for curve, (_, mu) in zip(curves, scales, strict=True)]
        _curve_legend(ax, static, all(settled), any(across))
    return ax


def _prefix_on(ax: Axes | None, v_0: Any) -> tuple[float, str]:
    """Factor and unit of velocities: of the axes, if they show velocities already."""
    shown = re.search(r"v_0\$ \[(.?)m/s\]", ax.get_xlabel()) if ax is not None and ax.has_data() else None
    if shown is None:
        return prefix(v_0, "m/s")
    unit = f"{shown[1]}m/s"
    return 1 / (scale_of(unit, "m/s") or 1.0), unit


def plot_fit(fitted: Any, ax: Axes | None = None) -> Axes:
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
    data = fitted.data
    if data.over:
        return _plot_fit_over(fitted, ax)
    curve = fitted.curve
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
        _limits(ax, curve.full_cof, fitted.case.is_shaken)
        ax.set(xlabel=velocity, ylabel=r"coefficient of friction $\mu$")
        ax.label_outer()
        ax.legend()
    return ax


def _plot_fit_over(fitted: Any, ax: Axes | None) -> Axes:
    """Measured and fitted friction over what was varied beside the velocity, in SI."""
    data = fitted.data
    with style():
        ax = subplots()[1] if ax is None else ax
        ax.errorbar(data.values, data.cof, data.error, fmt="o", color=COLOURS[1], capsize=2, label="measured")
        ax.plot(data.values, data.cof - fitted.residuals, ".-", color=COLOURS[0], label="fitted contact")
        ax.set(xlabel=f"{data.over} [SI]", ylabel=r"coefficient of friction $\mu$")
        ax.legend()
    return ax


def plot_force_curve(curve: Any, ax: Axes | None = None) -> Axes:
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


def _limits(ax: Axes, mu: float, both: bool) -> None:
    """Lines at the full friction of a forward pull, and of a backward one."""
    for level in (mu, -mu)[: 1 + both]:
        faint(ax.axhline, level)


def _mark_critical(ax: Axes, curves: Any, scales: Any, shades: Any, both: bool) -> None:
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


def _draw_curve(ax: Axes, curve: Any, scale: tuple[float, float], colour: Any, label: str | None) -> None:
    """Line, points (hollow where not settled), error bars wider than a point, and the static limit.

    scale: of velocities and of COFs.
    """
    v, mu = np.asarray(curve.v_0) / scale[0], np.asarray(curve.cof) / scale[1]
    error = np.nan_to_num(np.asarray(curve.cof_error) / scale[1], posinf=0.0)
    settled = np.asarray(curve.settled, dtype=bool)
    static = _at_rest(curve) / scale[1]
    ax.plot(*_line(curve, v, mu, scale), color=colour, label=label, zorder=2)
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


def _at_rest(curve: Any) -> float:
    """The limit at rest; nan where it is not known."""
    return np.nan if curve.static_cof is None else float(curve.static_cof)


def _line(
    curve: Any, v: NDArray[Any], mu: NDArray[Any], scale: tuple[float, float]
) -> tuple[NDArray[Any], NDArray[Any]]:
    """A smooth line through the points; at rest, of a curve of both ways, upright from one limit to the other.

    Where the limit of a backward pull was not computed the line is broken there: friction may jump. Of friction that
    falls it is straight from point to point, and broken at v_c, where it jumps.
    """
    order = np.argsort(v)
    v, mu = v[order], mu[order]
    back, forward = v < 0, v > 0
    if getattr(curve, "falls", False):
        ends = [way * v_c / scale[0] for way, v_c in ((1, curve.v_c), (-1, curve.v_c_back)) if v_c is not None]
        at = np.searchsorted(v, sorted(ends))
        return np.insert(v, at, np.nan), np.insert(mu, at, np.nan)
    if not (back.any() and forward.any()):
        return smooth(v, mu)
    low = np.nan if curve.static_cof_back is None else curve.static_cof_back / scale[1]
    backward = smooth(np.append(v[back], 0.0), np.append(mu[back], low))
    onward = smooth(np.append(0.0, v[forward]), np.append(_at_rest(curve) / scale[1], mu[forward]))
    at, line = (np.concatenate(pair) for pair in zip(backward, onward, strict=True))
    return at, line


def smooth(x: NDArray[Any], y: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
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


def _curve_legend(ax: Axes, static: Sequence[float], settled: bool, across: bool) -> None:
    """Explain the labels given, and static limits, hollow points and the COF across where there are some."""
    from matplotlib.lines import Line2D

    handles, _ = ax.get_legend_handles_labels()
    if np.any(np.isfinite(static)):
        handles.append(Line2D([], [], color="0.3", linewidth=1.2, linestyle="--", label="static limit"))
    if across:
        handles.append(Line2D([], [], color="0.3", lw=1.2, ls="-.", label="across the pull"))
    if not settled:
        handles.append(Line2D([], [], color="0.3", ls="", marker="o", mfc="white", label="not settled"))
    if handles:
        ax.legend(handles=handles, loc="best", frameon=True, edgecolor="none")


def _is_scale(v_c: Any) -> bool:
    return v_c is not None and bool(np.isfinite(v_c)) and v_c > 0
