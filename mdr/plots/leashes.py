"""Springs of a run that is shaken across, seen from above: feet that the indenter drags behind it on leashes.

Records are read by attribute only.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from mdr.plots.figures import prefix
from mdr.plots.runs import MODES, mode_patches


class Leashes:
    """The plane from above, moving with the pull; on axes, for an animation that calls `show`."""

    def __init__(self, ax: Any, run: Any) -> None:
        from matplotlib.collections import LineCollection

        depth, k_x = run.s.max(axis=0), _stiffness(run)
        # five springs, evenly by their greatest depth
        some = np.unique(np.abs(depth[:, None] - np.linspace(depth.max(), 0, 5, endpoint=False)).argmin(axis=0))
        path = np.stack([run.u_x - run.v_0 * run.t, run.u_y], axis=1)
        feet = path[:, None] - np.stack([run.e[:, some], run.e_y[:, some]], axis=2)
        reach = 0 * run.s[:, some] if k_x is None else run.mu_0 * run.f_z[:, some] / k_x[some]
        if k_x is not None and run.strength is not None:
            reach = reach + run.strength[:, some] / k_x[some]
        half = 1.08 * float(max(np.abs(path[:, 1]).max() + reach.max(), np.abs(feet[..., 1]).max()))
        per, unit = prefix(half, "m")
        self.ax, self.path, self.feet, self.reach = ax, path * per, feet * per, reach * per
        self.step = run.v_0 * (run.t[1] - run.t[0]) * per  #: of the pull
        self.state, self.colours = run.state[:, some], np.array([colour for _, colour in MODES])
        moves = {"animated": True}
        (self.trail,) = ax.plot([], [], color="0.5", lw=1.2, ls=":", zorder=0, label="path of the indenter", **moves)
        self.circles = LineCollection([], colors="0.8", linewidths=1.0, label="reach of a spring", **moves)
        self.lines = LineCollection([], linewidths=1.8, **moves)
        for lines in (self.circles, self.lines):
            ax.add_collection(lines)
        self.dots = ax.scatter(*self.feet[0].T, s=28, zorder=3, **moves)
        (self.body,) = ax.plot([], [], "o", color="k", ms=9, zorder=4, **moves)
        # reach of the picture behind the pull and ahead of it, over half of its width
        ends = np.sort((np.sign(run.v_0) or 1.0) * half * per * np.array([-2.6, 1.2]))
        ax.set(aspect="equal", xlim=ends, ylim=(-half * per, half * per))
        ax.set(xlabel=f"along the pull, and moving with it [{unit}]", ylabel=f"across [{unit}]")
        known = mode_patches(self.state[self.state > 0]), [self.trail], [] if k_x is None else [self.circles]
        look = {"loc": "lower left", "bbox_to_anchor": (0, 1), "ncols": 4, "columnspacing": 1.3, "handlelength": 1.5}
        ax.legend(handles=[one for part in known for one in part], **look)

    def show(self, k: int) -> None:
        """Draw the instant k of the record."""
        here, touching = self.path[k], self.state[k] > 0
        feet, shades = self.feet[k][touching], self.colours[self.state[k][touching]]
        turn = np.linspace(0, 2 * np.pi, 73)
        around = np.stack([np.cos(turn), np.sin(turn)], axis=1)
        self.circles.set_segments([here + radius * around for radius in self.reach[k][touching]])
        self.lines.set_segments([np.stack([here, foot]) for foot in feet])
        self.lines.set_color(shades)
        self.dots.set_offsets(feet)
        self.dots.set_color(shades)
        self.body.set_data(*here[:, None])
        past = np.arange(-8 * len(self.path), 1)  # the path behind the indenter
        x, y = self.path[(k + past) % len(self.path)].T
        self.trail.set_data(x + self.step * past, y)
        for artist in (self.trail, self.circles, self.lines, self.dots, self.body):
            self.ax.draw_artist(artist)


def _stiffness(run: Any) -> Any:
    """Tangential stiffness (n_springs,) [N/m] of springs whose force is that of their stretch alone; None of others."""
    stretched = np.sum(run.e**2 + run.e_y**2, axis=0)
    k_x = np.sum(run.f_x * run.e + run.f_y * run.e_y, axis=0) / np.where(stretched > 0, stretched, 1.0)
    off = np.hypot(run.f_x - k_x * run.e, run.f_y - k_x * run.e_y)
    return k_x if off.max() < 1e-6 * np.hypot(run.f_x, run.f_y).max() else None
