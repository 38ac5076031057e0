"""Animated picture of a recorded run: springs that stick, slip and leave contact, and their tangential force."""

from __future__ import annotations

from base64 import b64encode
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from mdr.plots.figures import COLOURS, MODES, mode_patches, periods_of, plot_forces, prefix, style
from mdr.plots.leashes import Leashes
from mdr.plots.side_view import SideView
from mdr.tools.checks import count
from mdr.tools.progress import progress

SECONDS = 4.0  #: that one period lasts in the picture


@dataclass(frozen=True)
class Gif:
    """A GIF on the disk; a notebook that ends a cell with it shows it."""

    path: Path  #: where it lies

    def __fspath__(self) -> str:
        return str(self.path)

    def _repr_html_(self) -> str:
        return f'<img alt="{self.path.stem}" src="data:image/gif;base64,{b64encode(self.path.read_bytes()).decode()}">'


def animate_springs(run: Any, path: str | PathLike[str], frames: int = 60, title: str | None = None) -> Gif:
    """Write an animated GIF of the recorded periods of a run.

    Above, seen from the indenter: its image g(x) goes up and down on springs that stand on the ground. Their feet lag
    behind as far as they are sheared (exaggerated). Their colour is their state: a spring that sticks is sheared
    further by the pull, one that slips holds the limit. Below: the tangential force and its limit mu_0 F_z, with the
    instant shown.

    Of a run that is shaken across the picture above is the plane seen from above, and moves with the pull. The indenter
    drags the feet of its springs behind it. A foot that sticks stands still in the plane; one that slips is drawn
    towards the indenter. Of an elastic material circles show how far a spring can be stretched before it slips.

    Parameters
    ----------
    run : SlidingRun
        A run made with `record=1` or more.
    path : str or path-like
        The file, ending in .gif.
    frames : int
        Number of pictures of one period.
    title : str, optional
        What stands above them. None: velocity and friction.

    Returns
    -------
    Gif
        The file; a notebook shows it.

    Raises
    ------
    ValueError
        For a run that kept no arrays, or another ending of the path.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from PIL import Image

    if run.t is None:
        raise ValueError("the run kept no arrays to draw; call slide(case, v_0, record=1) to keep a period")
    path, frames = Path(path), count("frames", frames, 2)
    if path.suffix != ".gif":
        raise ValueError(f"path must end in .gif, got {path.name!r}")
    periods = max(1, round(periods_of(run)[-1]))
    at = np.unique(np.linspace(0, run.t.size, frames * periods, endpoint=False).astype(int))
    with style():
        fig = Figure(figsize=(6.4, 5.6), dpi=80)
        canvas: Any = FigureCanvasAgg(fig)
        above, below = fig.subplots(2, 1, height_ratios=(2, 1))
        fig.suptitle(_title(run) if title is None else title)
        parts = (_Springs(above, run) if run.f_y is None else Leashes(above, run), _Force(below, run))
        canvas.draw()  # all but what moves
        still = canvas.copy_from_bbox(fig.bbox)
        pictures = []
        for k in progress(at.tolist(), "animation", "frames"):
            canvas.restore_region(still)
            for part in parts:
                part.show(k)
            pictures.append(Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3].copy()))
    few = Image.fromarray(np.concatenate([np.asarray(one) for one in pictures[:: max(1, len(pictures) // 4)]]))
    palette = few.quantize(method=Image.Quantize.FASTOCTREE)
    first, *rest = (one.quantize(palette=palette, dither=Image.Dither.NONE) for one in pictures)
    first.save(path, save_all=True, append_images=rest, duration=round(1e3 * SECONDS * periods / len(at)), loop=0)
    return Gif(path)


def _title(run: Any) -> str:
    per, unit = prefix(run.v_0, "m/s")
    return rf"$v_0$ = {run.v_0 * per:.3g} {unit}, $\mu/\mu_0$ = {run.cof / run.mu_0:.3f}"


class _Springs:
    """The upper picture: both sides of the contact."""

    def __init__(self, ax: Any, run: Any) -> None:
        from matplotlib.collections import LineCollection

        self.ax, self.run, self.view = ax, run, (view := SideView(run))
        (self.body,) = ax.fill([0], [0], facecolor="0.9", linewidth=0, animated=True)
        (self.surface,) = ax.plot([], [], color="0.2", linewidth=1.2, animated=True)
        self.lines = LineCollection([], linewidths=2.2, animated=True)
        ax.add_collection(self.lines)
        reach = 1.15 * float(view.flanks[-1])
        ax.set(xlim=(-reach, reach), ylim=(view.ground, view.top), ylabel=f"height [{view.unit_z}]")
        ax.set_xlabel(f"$x$ [{view.unit}]" + (f", shear drawn {view.lean / view.per_x:.2g} times" if view.lean else ""))
        corner = {"xycoords": "axes fraction", "va": "center", "annotation_clip": False}
        ax.annotate("$v_0$", (1.0, 1.06), (0.88, 1.06), arrowprops={"arrowstyle": "->"}, **corner)
        self.colours = [colour for _, colour in MODES]
        ax.legend(handles=mode_patches(run.state), loc="lower left", bbox_to_anchor=(0, 1), ncols=4, borderaxespad=0.2)

    def show(self, k: int) -> None:
        """Draw the instant k of the record."""
        view = self.view
        top = np.stack([view.x, view.tops(k)], axis=1)
        foot = np.stack([view.feet(k), np.full_like(view.x, view.ground)], axis=1)
        self.lines.set_segments(list(np.stack([foot, top], axis=1)))
        self.lines.set_color([self.colours[mode] for mode in view.both(self.run.state[k])])
        outline = np.stack([view.flanks, view.surface(k)], axis=1)
        self.surface.set_data(*outline.T)
        self.body.set_xy([*outline, [view.flanks[-1], 10 * view.top], [view.flanks[0], 10 * view.top]])
        for artist in (self.body, self.lines, self.surface):
            self.ax.draw_artist(artist)


class _Force:
    """The lower picture."""

    def __init__(self, ax: Any, run: Any) -> None:
        plot_forces(run, ax)
        self.ax, self.t = ax, periods_of(run)
        self.now = ax.axvline(0, color=COLOURS[1], linewidth=1.2, animated=True)
        (self.dot,) = ax.plot([], [], "o", color=COLOURS[1], zorder=3, animated=True)
        per = prefix(np.concatenate([run.F_x, run.mu_0 * run.F_z]), "N")[0]
        self.forces = np.stack([one * per for one in (run.F_x, run.F_y) if one is not None], axis=1)

    def show(self, k: int) -> None:
        """Mark the instant k of the record."""
        self.now.set_xdata([self.t[k]] * 2)
        self.dot.set_data([self.t[k]] * self.forces.shape[1], self.forces[k])
        for artist in (self.now, self.dot):
            self.ax.draw_artist(artist)
