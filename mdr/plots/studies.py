"""Figures of studies: a map over two axes, a family of curves, and small multiples of either.

A study of more axes is cut down by `Study.select` first. What failed or is missing is hatched, what did not settle is
dotted or hollow, and both are named in the legend, so that no point hides. Axes whose values grow by a constant factor
are drawn on a logarithmic scale.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from mdr.case.paths import facts_at
from mdr.plots.figures import Axes, Figure, axes_of, colours, edges_of, prefix, style, subplots
from mdr.tools.arrays import Array
from mdr.tools.status import Status

Study: TypeAlias = Any  #: of mdr.studies, read by attribute
Axis: TypeAlias = Any
LABELS = {
    "cof": r"coefficient of friction $\mu$",
    "static_cof": r"static friction $\mu_s$",
    "v_c": "critical velocity $v_c$, Eq. (15)",
    "full_slip_v_c": "critical velocity $v_c$ in full slip",
    "measured_v_c": "measured critical velocity $v_c$",
    "stick_share": "share of contact time in stick",
    "least_velocity": "least velocity of the body",
    "cof_error": "error of the coefficient of friction",
}  #: how quantities are written in figures; any other by its name
NEAR = 0.1  #: of the greatest value, below which zero is worth a tick
ABSENT = (("failed", Status.FAILED), ("not computed", Status.MISSING))


class DrawnStudy:
    """Base of studies, which draw themselves. Values are in SI, but for those of axes, which take a prefix."""

    def plot(self: Study, quantity: str | None = None, levels: Sequence[float] | None = None) -> Figure:
        """Draw the picture that suits the axes: curves along one, a map or curves over two, small multiples over three.

        Across stands the velocity where there is one, and else the last axis of numbers; the multiples go over texts
        where there are any. Axes of one value are left out.

        Parameters
        ----------
        quantity : str, optional
            What is drawn. None: the first quantity.
        levels : sequence of float, optional
            Contours of maps. None: some round values; an empty list: none.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.

        Raises
        ------
        ValueError
            For a study of other axes.
        """
        quantity = self.quantities[0] if quantity is None else quantity
        lone = {axis.path: axis.values[0] for axis in self.grid if len(axis) == 1}
        study = self.select(lone) if len(lone) < len(self.axes) else self
        numbers = [axis.path for axis in study.grid if axis.is_numeric]
        if not numbers:
            raise ValueError(f"no axis of numbers to draw along; the study has {', '.join(study.axes)}")
        x = next((path for path in numbers if path in ("v_0", "v_0/v_c")), numbers[-1])
        if len(study.axes) == 3:
            rest = [path for path in study.axes if path != x]
            texts = [path for path in rest if path not in numbers]
            over = texts[0] if texts else min(rest, key=lambda path: len(study.axes[path]))
            contours = _contours(study, quantity, levels if len(texts) < 2 else ())  # two of texts leave curves
            figure: Figure = study.plot_multiples(quantity, over, x, **contours)
        elif len(study.axes) == 2 and len(numbers) == 2:
            figure = study.plot_map(quantity, x, **_contours(study, quantity, levels)).figure
        else:
            figure = study.plot_curves(quantity, x).figure
        return figure

    def plot_map(
        self: Study,
        quantity: str,
        x: str | None = None,
        ax: Axes | None = None,
        *,
        levels: Sequence[float] = (),
        limits: tuple[float, float] | None = None,
        log: bool = False,
        colorbar: bool = True,
    ) -> Axes:
        """Draw a quantity over the two axes of a study in colours.

        The critical velocity is dashed where an axis is v_0/v_c, or v_0.

        Parameters
        ----------
        quantity : str
            What is drawn.
        x : str, optional
            Path of the axis across. None: the last one.
        ax : matplotlib.axes.Axes, optional
            Where to draw. None makes a new figure.
        levels : sequence of float
            Contours to draw and label.
        limits : (float, float), optional
            Of the colours. None: those of the values.
        log : bool
            Logarithmic colours.
        colorbar : bool
            Draw the bar of the colours.

        Returns
        -------
        matplotlib.axes.Axes
            Where it was drawn.
        """
        from matplotlib.colors import LogNorm, Normalize

        study = _without_single(self)
        across, up = _two_axes(study, x)
        order = np.ix_(np.argsort(up.values), np.argsort(across.values))
        values, status = (_over(study, up, across, one)[order] for one in (study[quantity], study.status))
        norm = (LogNorm if log else Normalize)(*(limits or _limits(values, log)))
        with style():
            ax = axes_of(ax)
            factors = [_scale(ax, which, axis) for which, axis in (("x", across), ("y", up))]
            centres = [np.sort(axis.values) * factor for axis, factor in zip((across, up), factors, strict=True)]
            edges = [_edges(axis, places) for axis, places in zip((across, up), centres, strict=True)]
            shown = np.ma.masked_invalid(values)
            mesh = ax.pcolormesh(*edges, shown, norm=norm, cmap="viridis", rasterized=True)
            if len(levels) and min(values.shape) > 1:
                lines = ax.contour(*centres, shown, levels=sorted(levels), colors="white", linewidths=1.2)
                ax.clabel(lines, fmt="%g", fontsize=9)
            for line in _critical(study, (across, up), factors):
                _draw_critical(ax, line)
            _mark(ax, edges, centres, ~np.isfinite(values), status)
            if colorbar:
                _colorbar(ax.figure, mesh, ax, study, quantity)
        return ax

    def plot_curves(self: Study, quantity: str, x: str | None = None, ax: Axes | None = None) -> Axes:
        """Draw a family of curves over one axis of a study, one for each value of its other axis, if it has two.

        Parameters
        ----------
        quantity : str
            What is drawn.
        x : str, optional
            Path of the axis across. None: the last one.
        ax : matplotlib.axes.Axes, optional
            Where to draw. None makes a new figure.

        Returns
        -------
        matplotlib.axes.Axes
            Where it was drawn.
        """
        study = _without_single(self)
        across, by = _one_or_two_axes(study, x)
        values = _over(study, by, across, study[quantity]) if by else study[quantity][None]
        status = _over(study, by, across, study.status) if by else study.status[None]
        names = [f"{_value(by, i)}" for i in range(len(by))] if by else [None]
        with style():
            ax = axes_of(ax)
            factor = _scale(ax, "x", across)
            places = np.asarray(across.values) * factor
            order = np.argsort(places)
            shades = colours(len(names))
            for i, (row, fate, colour, name) in enumerate(zip(values, status, shades, names, strict=True)):
                named = len(names) <= 10 or i in (0, len(names) - 1)  # else first and last
                ax.plot(places[order], row[order], color=colour, label=name if named else None)
                loose = fate == Status.UNSETTLED
                ax.plot(places[loose], row[loose], "o", mfc="white", mec=colour, markersize=5)
            ax.set_ylabel(_name(quantity, study.units[quantity]))
            _explain(ax, status, by)
        return ax

    def plot_multiples(
        self: Study, quantity: str, over: str, x: str | None = None, *, columns: int = 3, **knobs: Any
    ) -> Figure:
        """Draw a map, or a family of curves where one or two axes are left, for each value of an axis.

        All share their scales.

        Parameters
        ----------
        quantity : str
            What is drawn.
        over : str
            Path of the axis that has one picture for each of its values.
        x : str, optional
            Path of the axis across. None: the last one.
        columns : int
            How many pictures stand side by side, at most.
        **knobs
            As in `plot_map`, for maps.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
        if columns < 1:
            raise ValueError(f"columns must be at least 1, got {columns!r}")
        axis = _axis(self, over)
        parts = [self.select({over: axis.values[i]}) for i in range(len(axis))]
        is_map = len(parts[0].axes) == 2 and all(one.is_numeric for one in parts[0].grid)
        if knobs and not is_map:
            raise TypeError(f"{', '.join(knobs)} is for maps, and these are curves")
        columns = min(columns, len(parts))
        rows = -(-len(parts) // columns)
        with style():
            size = (1.2 + 2.9 * columns, 0.8 + 2.5 * rows)
            fig, grid = subplots(rows, columns, sharex=True, sharey=True, figsize=size, squeeze=False)
            if is_map:
                knobs = {"limits": _limits(self[quantity], knobs.get("log", False))} | knobs
            marks: dict[str, Any] = {}
            for i, (part, ax) in enumerate(zip(parts, grid.ravel(), strict=False)):
                if is_map:
                    part.plot_map(quantity, x, ax, colorbar=False, **knobs)
                else:
                    part.plot_curves(quantity, x, ax)
                if (i or is_map) and (legend := ax.get_legend()):
                    names = (text.get_text() for text in legend.texts)
                    marks |= dict(zip(names, legend.legend_handles, strict=True))
                    legend.remove()
                ax.set_title(_value(axis, i, name=True), fontsize=10)
                if i % columns:
                    ax.set_ylabel("")
                if i + columns < len(parts):
                    ax.set_xlabel("")
            for ax in grid.ravel()[len(parts) :]:
                ax.set_visible(False)
            first = grid.ravel()[0].get_legend()
            known = {text.get_text() for text in first.texts} if first else set()
            if marks := {name: mark for name, mark in marks.items() if name not in known}:
                fig.legend(marks.values(), marks.keys(), loc="outside lower left", ncols=3)
            if is_map:
                _colorbar(fig, grid.ravel()[0].collections[0], grid, self, quantity)
        return fig


def _contours(study: Study, quantity: str, levels: Sequence[float] | None) -> dict[str, Any]:
    """The levels of a map as its argument: those asked for, or round ones."""
    if levels is None:
        from matplotlib.ticker import MaxNLocator

        low, high = _limits(study[quantity], log=False)
        rim = 0.01 * (high - low)  # on a plateau at an end a contour would follow rounding
        levels = [float(one) for one in MaxNLocator(6).tick_values(low, high) if low + rim < one < high - rim]
    return {"levels": levels} if len(levels) else {}


def _critical(study: Study, axes: tuple[Axis, Axis], factors: Sequence[float]) -> Iterator[list[Array]]:
    """The line x, y at which the velocity on one axis is the critical one, in the units of the figure."""
    for i, (axis, other) in enumerate((axes, axes[::-1])):
        order = np.argsort(other.values)
        along = np.asarray(other.values, dtype=float)[order] * factors[1 - i]
        if axis.path == "v_0/v_c":
            v_c = np.ones(along.size)
        elif axis.path == "v_0" and "v_c" in study.quantities:
            v_c = _over(study, other, axis, study["v_c"])[order, 0] * factors[i]
        else:
            continue
        line = [v_c, along]
        yield line if i == 0 else line[::-1]


def _draw_critical(ax: Axes, line: list[Array]) -> None:
    """Dash the line, over the whole map where it is straight, and name it half-way along what is in sight."""
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    x, y = line
    if np.ptp(x) == 0:
        x, y = np.repeat(x[0], 3), np.linspace(low, high, 3)
    elif np.ptp(y) == 0:
        x, y = np.linspace(left, right, 3), np.repeat(y[0], 3)
    seen = np.flatnonzero((left <= x) & (x <= right) & (low <= y) & (y <= high))
    if not seen.size:
        return
    ax.autoscale(False)
    ax.plot(x, y, color="black", linewidth=1.2, linestyle="--")
    half = seen[seen.size // 2]
    ax.annotate("$v_c$", (x[half], y[half]), (-3, 3), textcoords="offset points", ha="right", va="bottom")


def _limits(values: Array, log: bool) -> tuple[float, float]:
    """The range of what colours can show; one that nearly begins at zero begins there."""
    seen = values[np.isfinite(values) & ((values > 0) | (not log))]
    if not seen.size:
        return 0.1, 1.0
    low, high = float(seen.min()), float(seen.max())
    return (low if log or not 0 < low < NEAR * high else 0.0), high


def _colorbar(fig: Any, mesh: Any, ax: Any, study: Study, quantity: str) -> None:
    bar = fig.colorbar(mesh, ax=ax, pad=0.02)
    bar.set_label(_name(quantity, study.units[quantity]))
    bar.outline.set_visible(False)


# --- axes ---


def _axis(study: Study, path: str) -> Axis:
    if path not in study.axes:
        raise ValueError(f"{path!r} is no axis of the study; there are {', '.join(study.axes)}")
    return study.grid[list(study.axes).index(path)]


def _without_single(study: Study) -> Study:
    """The study without axes of one value, where it has more axes than a picture."""
    single = {one.path: one[0] for one in study.grid if len(one) == 1} if len(study.axes) > 2 else {}
    return study.select(single) if single else study


def _two_axes(study: Study, x: str | None) -> tuple[Axis, Axis]:
    """The axis across and the one up, both of numbers."""
    across, up = _one_or_two_axes(study, x)
    if up is None or not up.is_numeric:
        raise ValueError(f"a map needs two axes of numbers, the study has {', '.join(study.axes)}; use plot_curves")
    return across, up


def _one_or_two_axes(study: Study, x: str | None) -> tuple[Axis, Axis | None]:
    if not 1 <= len(study.axes) <= 2:
        raise ValueError(
            f"a picture has one or two axes, the study has {len(study.axes)} ({', '.join(study.axes)}); "
            "fix the others with study.select({path: value}), or use plot_multiples"
        )
    across = _axis(study, x) if x is not None else study.grid[-1]
    if not across.is_numeric:
        raise ValueError(f"{across.path} has no numbers to draw along; give another axis as x")
    return across, next((one for one in study.grid if one is not across), None)


def _over(study: Study, up: Axis, across: Axis, values: NDArray[Any]) -> NDArray[Any]:
    """Values (n_up, n_across), whatever the order of the axes in the study."""
    return values if study.grid[0] is up else values.T


def _scale(ax: Axes, which: str, axis: Axis) -> float:
    """Set scale and label of an axis of the figure; the factor that its values are drawn with."""
    factor, unit = prefix(axis.values, axis.unit) if axis.unit not in ("", "-") else (1.0, axis.unit)
    getattr(ax, f"set_{which}label")(_name(axis.path, unit))
    if _is_log(axis):
        from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

        getattr(ax, f"set_{which}scale")("log")
        ticks, few = getattr(ax, f"{which}axis"), max(axis.values) <= 100 * min(axis.values)
        ticks.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if few else (1.0,)))
        ticks.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        ticks.set_minor_formatter(NullFormatter())
    return factor


def _is_log(axis: Axis) -> bool:
    """Whether the values grow by a constant factor."""
    values = np.sort(np.asarray(axis.values, dtype=float))
    # a scale may be logarithmic from a ratio of 4 on
    if values.size < 3 or values[0] <= 0 or values[-1] < 4.0 * values[0]:
        return False
    steps = np.diff(np.log(values))
    return bool(np.ptp(steps) < 0.01 * steps.mean())


def _edges(axis: Axis, places: Array) -> Array:
    """Borders (n + 1,) of the cells of a map about these places; at zero ends an axis that has no value beyond it."""
    if _is_log(axis):
        return np.asarray(np.exp(edges_of(np.log(places))))
    edges = edges_of(places)
    return np.maximum(edges, 0.0) if places[0] >= 0 else np.minimum(edges, 0.0) if places[-1] <= 0 else edges


def _name(name: str, unit: str) -> str:
    return _label(name) + (f" [{unit}]" if unit not in ("", "-") else "")


def _label(name: str) -> str:
    return LABELS.get(name) or facts_at(name).label or name


def _value(axis: Axis, index: int, name: bool = False) -> str:
    """One value of an axis as a label, with its symbol if asked for."""
    if not axis.is_numeric:
        return str(axis.labels[index])
    factor, unit = prefix([axis[index]], axis.unit) if axis.unit not in ("", "-") else (1.0, "")
    number = f"{axis[index] * factor:.3g}{f' {unit}' if unit else ''}"
    return f"{_label(axis.path)} = {number}" if name else number


# --- what is not there ---


def _mark(ax: Axes, edges: list[Array], centres: list[Array], empty: NDArray[np.bool_], status: NDArray[Any]) -> None:
    """Hatch cells without a value, dot those that did not settle, and name both above the axes."""
    from matplotlib.patches import Patch

    handles: list[Any] = []
    if empty.any():
        look: dict[str, Any] = {"hatch": "///", "edgecolor": "0.6", "linewidth": 0}
        ax.pcolor(*edges, np.ma.masked_where(~empty, np.zeros(empty.shape)), cmap="Greys", **look)
        names = [name for name, fate in ABSENT if np.any(status[empty] == fate)] or ["no value"]
        handles.append(Patch(facecolor="white", label=" or ".join(names), **look))
    rows, columns = np.nonzero(status == Status.UNSETTLED)
    if rows.size:
        handles += ax.plot(centres[0][columns], centres[1][rows], "k.", markersize=2.5, label="not settled")
    if handles:
        ax.legend(handles=handles, loc="lower left", bbox_to_anchor=(0, 1), ncols=2, borderaxespad=0.2)


def _explain(ax: Axes, status: NDArray[np.uint8], by: Axis | None) -> None:
    """The legend of a family: what the curves are, what a hollow point means, and how many are not there."""
    from matplotlib.lines import Line2D

    handles, _ = ax.get_legend_handles_labels()
    if np.any(status == Status.UNSETTLED):
        handles.append(Line2D([], [], color="0.3", ls="", marker="o", mfc="white", label="not settled"))
    for name, fate in ABSENT:
        if count := int(np.count_nonzero(status == fate)):
            handles.append(Line2D([], [], color="none", label=f"{count} {name}"))
    if handles:
        title = _name(by.path, "") if by is not None else None
        ax.legend(handles=handles, title=title, title_fontsize=9.5, loc="best", frameon=True, edgecolor="none")
