"""The figure of friction over velocity, in Bokeh.

Its axes stay as long as what is shown suits them, and the last curve that was complete stays as a pale line: what a
slider does is then seen.
"""

from __future__ import annotations

import numpy as np
from bokeh.models import Span

from mdr.explorer.canvas import DARK, GREY, canvas, data_of, span, stroke, swatches, word
from mdr.explorer.lines import line_of, suits
from mdr.explorer.pictures import Picture
from mdr.normal.normal_force import full_cof
from mdr.normal.resolved import resolved
from mdr.plots import COLOURS, prefix

BEFORE = "#c3d9ea"


def curve_legend(picture: Picture, before: bool) -> str:
    """The legend of the curve; `before`: and of the one before it."""
    known = np.isfinite([picture.v_c, picture.v_c_back or np.nan]).any()
    return "".join(
        [
            swatches(("friction", COLOURS[0]), ("the run at v<sub>0</sub>", COLOURS[1])),
            swatches(("before", BEFORE)) if before else "",
            stroke("under a rigid pull", f"border-top:2px dashed {DARK}") if picture.rigid is not None else "",
            swatches(("across", COLOURS[4])) if picture.state.case.moves_across else "",
            stroke("v<sub>c</sub>", f"border-left:2px dotted {DARK}") if known else "",
            swatches(("held at rest", COLOURS[2])) if picture.band else "",
        ]
    )


class Curve:
    """The figure and its data."""

    def __init__(self) -> None:
        self.figure = canvas(320, "pulling velocity", "coefficient of friction μ", name="friction")
        self.word = word(self.figure)  #: what it waits for, until it is shown
        self.shown: Picture | None = None
        self.complete: Picture | None = None  #: the last picture to which nothing is added any more
        self.ghost: Picture | None = None  #: what was complete before the state that is shown
        self.levels, self.ends = (0.0, 0.0), (0.0, 0.0)  #: of the axes of friction and of velocities [m/s], or over v_c
        self.in_groups = self.from_zero = False
        self.line, self.run = data_of("v_0", "cof", name="curve"), data_of("v_0", "cof")
        self.before = data_of("v_0", "cof", name="before")
        self.rigid, self.across = data_of("v_0", "cof"), data_of("v_0", "cof")
        self.points, self.held = data_of("v_0", "cof", "fill"), data_of("v_0", "low", "high")
        limit, critical = {"dimension": "width", "line_color": GREY, "line_width": 1}, {"dimension": "height"}
        critical |= {"line_color": DARK, "line_dash": "dotted"}
        self.marks = [Span(**look) for look in (limit, limit, critical, critical)]
        for mark in self.marks:
            self.figure.add_layout(mark)
        self.figure.segment("v_0", "low", "v_0", "high", source=self.held, line_width=6, color=COLOURS[2])
        self.figure.line("v_0", "cof", source=self.before, line_width=3, color=BEFORE)
        self.figure.line("v_0", "cof", source=self.rigid, line_width=1.3, color=DARK, line_dash="dashed")
        self.figure.line("v_0", "cof", source=self.across, line_width=1.5, color=COLOURS[4])
        self.figure.line("v_0", "cof", source=self.line, line_width=2, color=COLOURS[0])
        self.figure.scatter("v_0", "cof", source=self.points, size=4, fill_color="fill", line_color=COLOURS[0])
        self.figure.scatter("v_0", "cof", source=self.run, size=11, color=COLOURS[1])

    def show(self, picture: Picture) -> bool:
        """Show a picture; whether anything is shown of it: of a curve that is not known the one before stays."""
        if picture.cof is None and (picture.rigid is None or self.shown is not None):
            return False
        if self.shown is None or self.shown.state is not picture.state:
            self.ghost = self.complete
        self.shown, self.word.visible = picture, False
        per = self._hold(picture)
        v, curve, run, band = picture.v_0 * per, picture.curve, picture.run, picture.band
        cof_y = None if curve is None else curve.cof_y
        jumps = [end * per for end in picture.ends] if picture.state.case.friction.stick > 1 else []
        for source, values in ((self.line, picture.cof), (self.across, cof_y), (self.rigid, picture.rigid)):
            source.data = line_of(v, values, jumps)
        self.points.data = {"v_0": [], "cof": [], "fill": []}
        if curve is not None:
            fill = np.where(curve.settled, COLOURS[0], "#ffffff").tolist()
            self.points.data = {"v_0": v, "cof": curve.cof, "fill": fill}
        self.run.data = {"v_0": [], "cof": []} if run is None else {"v_0": [run.v_0 * per], "cof": [run.cof]}
        held = [] if band is None else [(0.0, band.low, band.high)]
        self.held.data = {name: [one[i] for one in held] for i, name in enumerate(("v_0", "low", "high"))}
        self.before.data = {"v_0": [], "cof": []}
        if self.ghost is not None:
            own = 1 / (self.ghost.state.v_c or np.nan) if self.in_groups else per
            self.before.data = line_of(self.ghost.v_0 * own, self.ghost.cof)
        self._show_limits(picture, per)
        return True

    def _hold(self, picture: Picture) -> float:
        """Hold or set the axis of velocities: what they are multiplied with there."""
        state = picture.state
        groups = bool(state.in_groups and state.v_c)
        per = 1 / (state.v_c or 1.0) if groups else 1.0
        low, high = float(picture.v_0[0]) * per, float(picture.v_0[-1]) * per
        if groups != self.in_groups or not suits(self.ends, low, high):
            self.ends, self.in_groups = (low, high), groups
        low, high = self.ends
        factor, unit = (1.0, "") if groups else prefix(self.ends, "m/s")
        span(self.figure.x_range, (low if low < 0 else -0.02 * high) * factor, 1.01 * high * factor)
        self.figure.xaxis.axis_label = "pulling velocity v₀/v_c" if groups else f"pulling velocity v₀ [{unit}]"
        return per * factor

    def _show_limits(self, picture: Picture, per: float) -> None:
        """Friction of full slip, critical velocities, and the axis of friction."""
        full, both = full_cof(resolved(picture.state.case)), picture.state.case.is_shaken
        forward, back = (*picture.ends, np.nan)[:2]
        places = (full, -full if both else np.nan, forward * per, back * per)
        for mark, at in zip(self.marks, places, strict=True):
            mark.visible, mark.location = bool(np.isfinite(at)), float(at) if np.isfinite(at) else 0.0
        cof_y = None if picture.curve is None else picture.curve.cof_y
        drawn = [one for one in (picture.cof, picture.rigid, cof_y) if one is not None]
        values = np.concatenate([*drawn, [0.9 * full, full]])  # the axis shows a tenth of it at least
        low, high = float(np.nanmin(values)), float(np.nanmax(values))
        room = 0.06 * (high - low)
        if not suits(self.levels, low - room, high + room):
            self.levels = (low - room, high + room)
        self.begin(self.from_zero)

    def begin(self, from_zero: bool) -> None:
        """Begin the axis of friction at zero, or where the curve does; it ends where the curve does."""
        self.from_zero = from_zero
        low, high = self.levels
        span(self.figure.y_range, min(low, 0.0) if from_zero else low, max(high, 0.0) if from_zero else high)
