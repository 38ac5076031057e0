"""The figures of the page, in Bokeh: friction over velocity, springs over a period, forces over a period."""

from __future__ import annotations

from typing import Any

import numpy as np
from bokeh.models import ColumnDataSource, LinearColorMapper, Range1d, Span
from bokeh.plotting import figure
from matplotlib.colors import to_hex

from mdr.explorer.pictures import DIRECTIONS, Picture
from mdr.plots import COLOURS, MODES, around, periods_of, prefix

GREY, DARK = "#bbbbbb", "#666666"
EMPTY = 0.1  #: of mu_0: least height of the curve's axis


def swatches(*named: tuple[str, str]) -> str:
    """A legend as HTML: names and colours."""
    box = "display:inline-block;width:12px;height:12px;border-radius:2px;margin:0 5px -1px 12px;border:1px solid #0002;"
    return "".join(f'<span style="{box}background:{colour}"></span>{name}' for name, colour in named)


def springs_legend(picture: Picture) -> str:
    """The legend of the springs: of slip its directions, where it has more than two."""
    if picture.run.f_y is None:
        return swatches(*MODES)
    ways = (("along", 0), ("across", 90), ("back", 180), ("-90°", -90))
    return swatches(*MODES[:2], *((f"slip {way}", to_hex(around()(0.5 + angle / 360))) for way, angle in ways))


def forces_legend(picture: Picture) -> str:
    """The legend of the forces."""
    across = [] if picture.run.F_y is None else [("F<sub>y</sub>", COLOURS[0])]
    return swatches(("F<sub>x</sub>", "#000000"), *across, ("μ<sub>0</sub> F<sub>z</sub>, the limit", GREY))


def curve_legend(picture: Picture) -> str:
    """The legend of the curve."""
    critical = f'<span style="border-left:2px dotted {DARK};margin:0 6px 0 14px"></span>v<sub>c</sub>'
    critical = critical if np.isfinite([picture.v_c, picture.v_c_back or np.nan]).any() else ""
    across = swatches(("across", COLOURS[4])) if picture.run.f_y is not None else ""
    held = swatches(("held at rest by a rigid pull", COLOURS[2])) if picture.band else ""
    return swatches(("friction", COLOURS[0]), ("the run at v<sub>0</sub>", COLOURS[1])) + across + critical + held


class Figures:
    """Three figures and their data; `show` puts a picture into all of them."""

    def __init__(self) -> None:
        self.curve = _figure(320, "pulling velocity", "coefficient of friction μ")
        self.forces = _figure(230, "time [periods]", "force")
        self.springs = _figure(250, "time [periods]", "position of the spring x", x_range=self.forces.x_range)
        self.forces.x_range.start, self.forces.x_range.end = 0.0, 1.0
        self.line, self.run = _data("v_0", "cof", name="curve"), _data("v_0", "cof")
        self.across = _data("v_0", "cof")
        self.points, self.held = _data("v_0", "cof", "fill"), _data("v_0", "low", "high")
        self.over_time, self.modes = _data("t", "F_x", "F_y", "low", "high"), _data("image", "x", "y", "dw", "dh")
        limit, critical = {"dimension": "width", "line_color": GREY, "line_width": 1}, {"dimension": "height"}
        critical |= {"line_color": DARK, "line_dash": "dotted"}
        self.marks = [Span(**look) for look in (limit, limit, critical, critical)]
        for mark in self.marks:
            self.curve.add_layout(mark)
        self.curve.segment("v_0", "low", "v_0", "high", source=self.held, line_width=6, color=COLOURS[2])
        self.curve.line("v_0", "cof", source=self.across, line_width=1.5, color=COLOURS[4])
        self.curve.line("v_0", "cof", source=self.line, line_width=2, color=COLOURS[0])
        self.curve.scatter("v_0", "cof", source=self.points, size=5, fill_color="fill", line_color=COLOURS[0])
        self.curve.scatter("v_0", "cof", source=self.run, size=11, color=COLOURS[1])
        self.forces.varea("t", "low", "high", source=self.over_time, color="#e9e9e9")
        for limits in ("low", "high"):
            self.forces.line("t", limits, source=self.over_time, color=GREY, line_width=1.5)
        self.forces.line("t", "F_y", source=self.over_time, color=COLOURS[0], line_width=1.8)
        self.forces.line("t", "F_x", source=self.over_time, color="#000000", line_width=1.8)
        turned = [to_hex(around()((i + 0.5) / DIRECTIONS)) for i in range(DIRECTIONS)]
        palette = [*(colour for _, colour in MODES), *turned]
        mapper = LinearColorMapper(palette=palette, low=-0.5, high=len(palette) - 0.5)
        self.springs.image("image", "x", "y", "dw", "dh", source=self.modes, color_mapper=mapper)

    def show(self, picture: Picture) -> None:
        """Put a picture into the figures."""
        self._show_curve(picture)
        self._show_forces(picture)
        factor, unit = prefix([picture.reach], "m")
        reach = picture.reach * factor
        self.modes.data = {"image": [picture.springs], "x": [0], "y": [0], "dw": [1], "dh": [reach]}
        _span(self.springs.y_range, 0.0, reach)
        self.springs.yaxis.axis_label = f"position of the spring x [{unit}]"

    def _show_curve(self, picture: Picture) -> None:
        state, mu_0, both = picture.state, picture.state.case.mu_0, picture.state.case.is_shaken
        factor, unit = prefix(picture.v_0, "m/s")
        label = f"pulling velocity v₀ [{unit}]"
        if state.in_groups and state.v_c:
            factor, label = 1 / state.v_c, "pulling velocity v₀/v_c"
        v, cof, curve, band = picture.v_0 * factor, picture.cof, picture.curve, picture.band
        self.line.data = {"v_0": v, "cof": cof}
        self.points.data = {"v_0": [], "cof": [], "fill": []}
        if curve is not None:
            self.points.data = {**self.line.data, "fill": np.where(curve.settled, COLOURS[0], "#ffffff").tolist()}
        cof_y = None if curve is None else curve.cof_y
        self.across.data = {"v_0": [] if cof_y is None else v, "cof": [] if cof_y is None else cof_y}
        self.run.data = {"v_0": [state.v_0 * factor], "cof": [picture.run.cof]}
        held = [] if band is None else [(0.0, band.low, band.high)]
        self.held.data = {name: [one[i] for one in held] for i, name in enumerate(("v_0", "low", "high"))}
        back = -picture.v_c_back * factor if picture.v_c_back is not None else np.nan
        places = (mu_0, -mu_0 if both else np.nan, picture.v_c * factor, back)
        for mark, at in zip(self.marks, places, strict=True):
            mark.visible, mark.location = bool(np.isfinite(at)), float(at) if np.isfinite(at) else 0.0
        least = min(float(cof.min()), 0.0 if cof_y is None else float(cof_y.min()), picture.run.cof, (1 - EMPTY) * mu_0)
        room = 0.06 * (mu_0 - least)
        _span(self.curve.y_range, least - room, max(mu_0, float(cof.max())) + room)
        _span(self.curve.x_range, float(v[0] if both else -0.02 * v[-1]), 1.01 * float(v[-1]))
        self.curve.xaxis.axis_label = label

    def _show_forces(self, picture: Picture) -> None:
        run = picture.run
        F_x, limit = np.asarray(run.F_x), run.mu_0 * np.asarray(run.F_z)
        F_y = np.full(F_x.shape, np.nan) if run.F_y is None else run.F_y
        factor, unit = prefix(np.concatenate([F_x, limit]), "N")
        turns = run.F_y is not None or float(F_x.min()) < -1e-9 * float(limit.max())
        low = (-limit if turns else F_x) * factor
        forces = {"F_x": F_x * factor, "F_y": F_y * factor}
        self.over_time.data = {"t": periods_of(run), **forces, "low": low, "high": limit * factor}
        top = 1.05 * float(limit.max()) * factor
        _span(self.forces.y_range, -top if turns else 0.0, top)
        self.forces.yaxis.axis_label = f"force [{unit}]"


def _data(*columns: str, **named: str) -> Any:
    """Data of these columns, none as yet."""
    return ColumnDataSource({column: [] for column in columns}, **named)


def _figure(height: int, x_label: str, y_label: str, x_range: Any = None) -> Any:
    """An empty figure in the style of the project's plots."""
    made = figure(
        height=height, sizing_mode="stretch_width", toolbar_location="right",
        active_drag=None, x_range=x_range or Range1d(0, 1), y_range=Range1d(0, 1), tools="box_zoom,reset,save",
    )  # fmt: skip
    made.toolbar.logo = None
    made.outline_line_color = None
    made.grid.grid_line_color = "#f0f0f0"
    made.axis.minor_tick_line_color = None
    made.axis.axis_label_text_font_style = "normal"
    made.axis.axis_line_color = made.axis.major_tick_line_color = DARK
    made.xaxis.axis_label, made.yaxis.axis_label = x_label, y_label
    made.xaxis.ticker.desired_num_ticks = 5
    return made


def _span(axis: Any, start: float, end: float) -> None:
    """What an axis spans, also after a reset."""
    axis.update(start=start, end=end, reset_start=start, reset_end=end)
