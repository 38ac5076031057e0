"""A recorded run as a moving picture: springs that stick, slip and leave, and the force they add up to."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.checks import count
from mdr.plots import MODES, prefix, style
from mdr.progress import progress

Array = NDArray[np.float64]

MOST_DRAWN = 40  #: springs on each side
LEAN = 0.06  #: greatest lean of a spring, over the width of the picture


def animate_springs(run: Any, path: str | PathLike[str], frames: int = 60) -> Path:
    """Write an animated GIF of the last periods of a run, slide(..., record=1); returns its path.

    Above, each spring stands on the ground and leans as far as it is sheared (exaggerated), coloured by its mode; the
    line is the surface. Below, the tangential force and its limit mu_0 F_z over time, the instant shown marked.
    """
    import matplotlib.pyplot as plt
    from matplotlib.animation import PillowWriter

    if run.t is None:
        raise ValueError("the run kept no arrays to draw; call slide(case, v_0, record=1) to keep a period")
    path, frames = Path(path), count("frames", frames, 2)
    if path.suffix != ".gif":
        raise ValueError(f"path must end in .gif, got {path.name!r}")
    at = np.unique(np.linspace(0, run.t.size - 1, frames).astype(int))
    with style():
        fig, (above, below) = plt.subplots(2, 1, figsize=(6.4, 5.2), height_ratios=(2, 1))
        springs, force = _Springs(above, run), _Force(below, run)
        writer = PillowWriter(fps=max(1, round(len(at) / 4)))
        with writer.saving(fig, str(path), dpi=90):
            for k in progress(at.tolist(), "frames"):
                springs.show(k)
                force.show(k)
                writer.grab_frame()
        plt.close(fig)
    return path


class _Springs:
    """The upper picture: both sides of the contact."""

    def __init__(self, ax: Any, run: Any) -> None:
        from matplotlib.collections import LineCollection
        from matplotlib.patches import Patch

        even = np.searchsorted(run.x, np.linspace(run.x[0], run.x[-1], MOST_DRAWN))  # springs stand closer at the edge
        every = np.unique(np.minimum(even, run.x.size - 1))
        self.run, self.every = run, every
        (self.per_x, unit), (self.per_z, unit_z) = prefix(run.x, "m"), prefix(run.s, "m")
        x = run.x[every] * self.per_x
        self.x = np.concatenate([-x[::-1], x])
        deepest, sheared = float(run.s.max()) * self.per_z, float(np.abs(run.e).max())
        self.lean = LEAN * 2.2 * float(self.x.max()) / sheared if sheared else 0.0
        self.ground = -2.2 * deepest
        self.lines = LineCollection([], linewidths=2.0)
        ax.add_collection(self.lines)
        (self.surface,) = ax.plot([], [], color="0.2", linewidth=1.2)
        ax.set(xlim=np.array([-1.1, 1.1]) * self.x.max(), ylim=(self.ground, 0.5 * deepest))
        ax.set(xlabel=f"$x$ [{unit}]", ylabel=f"height [{unit_z}]")
        self.colours = [colour if name != "free" else "#BBBBBB" for name, colour in MODES]
        patches = [Patch(color=colour, label=name) for (name, _), colour in zip(MODES, self.colours, strict=True)]
        ax.legend(handles=patches, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4, borderaxespad=0.2)

    def _both(self, values: NDArray[Any]) -> NDArray[Any]:
        one = values[self.every]
        return np.concatenate([one[::-1], one])

    def show(self, k: int) -> None:
        """Draw the instant k of the record."""
        top = np.stack(
            [self.x + self._both(self.run.e[k]) * self.lean, -self._both(self.run.s[k]) * self.per_z], axis=1
        )
        foot = np.stack([self.x, np.full_like(self.x, self.ground)], axis=1)
        self.lines.set_segments(list(np.stack([foot, top], axis=1)))
        self.lines.set_color([self.colours[mode] for mode in self._both(self.run.state[k])])
        self.surface.set_data(self.x, top[:, 1])


class _Force:
    """The lower picture."""

    def __init__(self, ax: Any, run: Any) -> None:
        self.t = (run.t - run.t[0]) * run.omega / (2 * np.pi)
        limit = run.mu_0 * run.F_z
        per, unit = prefix(np.concatenate([run.F_x, limit]), "N")
        self.F_x = run.F_x * per
        ax.plot(self.t, limit * per, color="0.6", label=r"$\mu_0 F_z$, the limit")
        ax.plot(self.t, self.F_x, color="k", label="$F_x$")
        (self.dot,) = ax.plot([], [], "o", color="#D55E00", zorder=3)
        ax.set(xlabel="time [periods]", ylabel=f"force [{unit}]", xlim=(0, self.t[-1]))
        ax.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=2, borderaxespad=0.2)

    def show(self, k: int) -> None:
        """Mark the instant k of the record."""
        self.dot.set_data([self.t[k]], [self.F_x[k]])
