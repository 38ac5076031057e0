"""The figures of the run over a period, in Bokeh: springs that move, a map of what they do, forces; and a time cursor.

What moves is drawn by the browser, out of frames that come with the run: nothing is sent while it plays.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from bokeh.layouts import row
from bokeh.models import CustomJS, LinearColorMapper, Slider, Span, Toggle
from matplotlib.colors import to_hex

from mdr.explorer.canvas import GREY, canvas, data_of, span, swatches, word
from mdr.explorer.springs import DIRECTIONS, FRAMES, frames_of, map_of
from mdr.march.result.run import SlidingRun
from mdr.plots import COLOURS, MODES, around, limit_of, periods_of, prefix
from mdr.plots.side_view import SideView

SHADES = [*(colour for _, colour in MODES), *(to_hex(around()((i + 0.5) / DIRECTIONS)) for i in range(DIRECTIONS))]
#: draw the frame at the phase of the slider
DRAW = """
const d = frames.data, f = still.data, k = Math.round(phase.value * d.depth.length) % d.depth.length, n = f.x.length;
if (d.depth.length) {
  const part = name => Array.from(d[name].slice(k * n, (k + 1) * n));
  springs.data = {x: Array.from(f.x), ground: Array.from(f.ground), top: part('top'), foot: part('foot'),
                  colour: part('mode').map(one => shades[one])};
  const o = outline.data, low = Array.from(o.image).map(one => one - d.depth[k]);
  body.data = {x: Array.from(o.x), low: low, high: low.map(() => o.top[0])};
}
for (const cursor of cursors) cursor.location = phase.value;
"""
PLAY = """
clearInterval(window.mdr_plays);
cb_obj.label = cb_obj.active ? '❚❚ Pause' : '▶ Play';
if (cb_obj.active) window.mdr_plays = setInterval(() => { phase.value = (phase.value + phase.step) % 1; }, wait);
"""


def springs_legend(run: SlidingRun) -> str:
    """The legend of the springs: of slip its directions, where it has more than two."""
    if run.f_y is None:
        return swatches(*MODES)
    directions = (("along", 0), ("across", 90), ("back", 180), ("-90°", -90))
    return swatches(*MODES[:2], *((f"slip {name}", to_hex(around()(0.5 + angle / 360))) for name, angle in directions))


def forces_legend(run: SlidingRun) -> str:
    """The legend of the forces."""
    across = [] if run.F_y is None else [("F<sub>y</sub>", COLOURS[0])]
    return swatches(("F<sub>x</sub>", "#000000"), *across, ("μ<sub>0</sub> F<sub>z</sub>, the limit", GREY))


class OverPeriod:
    """The figures and their data; what moves is of the browser alone."""

    def __init__(self) -> None:
        self.moving = canvas(210, "x", "height")
        self.forces = canvas(190, "time [periods]", "force")
        self.map = canvas(190, "time [periods]", "position of the spring x", x_range=self.forces.x_range)
        self.over_time, self.modes = data_of("t", "F_x", "F_y", "low", "high"), data_of("image", "x", "y", "dw", "dh")
        self.frames, self.still = data_of("top", "foot", "mode", "depth"), data_of("x", "ground")
        self.outline = data_of("x", "image", "top")
        self.forces.varea("t", "low", "high", source=self.over_time, color="#e9e9e9")
        for limits in ("low", "high"):
            self.forces.line("t", limits, source=self.over_time, color=GREY, line_width=1.5)
        self.forces.line("t", "F_y", source=self.over_time, color=COLOURS[0], line_width=1.8)
        self.forces.line("t", "F_x", source=self.over_time, color="#000000", line_width=1.8)
        mapper = LinearColorMapper(palette=SHADES, low=-0.5, high=len(SHADES) - 0.5)
        self.map.image("image", "x", "y", "dw", "dh", source=self.modes, color_mapper=mapper)
        self.controls = self._animate()
        #: what the figures wait for, until they are shown
        self.words = [word(figure) for figure in (self.moving, self.map, self.forces)]

    def _animate(self) -> Any:
        """Springs that move, a cursor in the other figures, and the phase: a slider, and a button that moves it."""
        body, springs = data_of("x", "low", "high"), data_of("x", "ground", "top", "foot", "colour", name="springs")
        self.moving.varea("x", "low", "high", source=body, color="#e6e6e6")
        self.moving.line("x", "low", source=body, color="#333333", line_width=1.2)
        self.moving.segment("foot", "ground", "x", "top", source=springs, color="colour", line_width=2.2)
        cursors = [Span(dimension="height", line_color=COLOURS[1], line_width=1.5) for _ in range(2)]
        for figure, cursor in zip((self.map, self.forces), cursors, strict=True):
            figure.add_layout(cursor)
        phase = Slider(start=0, end=1, step=1 / FRAMES, value=0, title="phase [periods]", format="0.00",
                       sizing_mode="stretch_width", bar_color=COLOURS[1], css_classes=["slider", "phase"])  # fmt: skip
        play = Toggle(label="▶ Play", width=90)
        for one in (body, springs, phase, play, *cursors):
            one.syncable = False
        named: dict[str, Any] = {"frames": self.frames, "still": self.still, "outline": self.outline, "phase": phase}
        named |= {"springs": springs, "body": body, "shades": SHADES, "cursors": cursors}
        draw = CustomJS(args=named, code=DRAW)
        phase.js_on_change("value", draw)
        self.frames.js_on_change("data", draw)
        # a period lasts four seconds
        play.js_on_change("active", CustomJS(args={"phase": phase, "wait": 4e3 / FRAMES}, code=PLAY))
        return row(play, phase, sizing_mode="stretch_width")

    def show(self, run: SlidingRun) -> None:
        """Show a recorded run."""
        for one in self.words:
            one.visible = False
        self._show_forces(run)
        factor, unit = prefix([np.max(np.asarray(run.x))], "m")
        reach = float(np.max(np.asarray(run.x))) * factor
        self.modes.data = {"image": [map_of(run)], "x": [0], "y": [0], "dw": [1], "dh": [reach]}
        span(self.map.y_range, 0.0, reach)
        self.map.yaxis.axis_label = f"spring x [{unit}]"
        view = SideView(run)
        self.still.data = {"x": view.x, "ground": np.full_like(view.x, view.ground)}
        self.outline.data = {"x": view.flanks, "image": view.image, "top": np.full_like(view.flanks, 2 * view.top)}
        self.frames.data = frames_of(run, view)  # last, as it draws
        span(self.moving.x_range, -view.reach, view.reach)
        span(self.moving.y_range, view.ground, view.top)
        self.moving.xaxis.axis_label = f"x {view.label}"
        self.moving.yaxis.axis_label = f"height [{view.unit_z}]"

    def _show_forces(self, run: SlidingRun) -> None:
        F_x, limit = np.asarray(run.F_x), limit_of(run)
        F_y = np.full(F_x.shape, np.nan) if run.F_y is None else run.F_y
        factor, unit = prefix(np.concatenate([F_x, limit]), "N")
        turns = run.F_y is not None or float(F_x.min()) < -1e-9 * float(limit.max())
        low = (-limit if turns else F_x) * factor
        forces = {"F_x": F_x * factor, "F_y": F_y * factor}
        self.over_time.data = {"t": periods_of(run), **forces, "low": low, "high": limit * factor}
        top = 1.05 * float(limit.max()) * factor
        span(self.forces.y_range, -top if turns else 0.0, top)
        self.forces.yaxis.axis_label = f"force [{unit}]"
