"""Animated picture of a recorded run: springs that stick, slip and leave contact, and their tangential force."""

from __future__ import annotations

from base64 import b64encode
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from mdr.plots.figures import COLOURS, prefix, style
from mdr.plots.leashes import Leashes
from mdr.plots.runs import MODES, limit_of, mode_patches, periods_of, plot_forces
from mdr.plots.side_view import SideView
from mdr.tools.checks import count
from mdr.tools.progress import progress

COIL = np.array([0, 0, *[1, -1] * 4, 0, 0])  #: places of the bends of a spring beside its axis, from the foot up


@dataclass(frozen=True)
class Gif:
    """A GIF on the disk; a notebook that ends a cell with it shows it."""

    path: Path  #: where it lies

    def __fspath__(self) -> str:
        return str(self.path)

    def _repr_html_(self) -> str:
        return f'<img alt="{self.path.stem}" src="data:image/gif;base64,{b64encode(self.path.read_bytes()).decode()}">'


def animate_springs(
    run: Any, path: str | PathLike[str], frames: int = 60, title: str | None = None, comment: str = ""
) -> Gif:
    """Write an animated GIF of the recorded periods of a run.

    Above, seen from the indenter: its image g(x) goes up and down on springs that stand on the ground, which the pull
    draws away below. Their feet lag behind as far as they are sheared (exaggerated, as is the way of the ground). Their
    colour is their state: the foot of a spring that sticks goes with the ground, that of one that slips does not, as it
    holds the limit. Below: the tangential force and its limit mu_0 F_z, with the instant shown.

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
    comment : str
        What the file says of itself.

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
        fig = Figure(figsize=(6.4, 5.3), dpi=100)
        canvas: Any = FigureCanvasAgg(fig)
        above, below = fig.subplots(2, 1, height_ratios=(9, 5))
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
    palette = few.quantize(32, method=Image.Quantize.FASTOCTREE)  # colours of the file
    first, *rest = (one.quantize(palette=palette, dither=Image.Dither.NONE) for one in pictures)
    lasts = round(4e3 * periods / len(at))  # ms; a period lasts four seconds
    first.save(path, save_all=True, append_images=rest, duration=lasts, loop=0, comment=comment.encode())
    return Gif(path)


def _of(run: Any) -> str:
    """What the friction of a run is told over."""
    return r"$\mu/\mu_0$" if run.strength is None else "share of full slip"


def _title(run: Any) -> str:
    per, unit = prefix(run.v_0, "m/s")
    return rf"$v_0$ = {run.v_0 * per:.3g} {unit}, {_of(run)} = {run.share:.3f}"


class _Springs:
    """The upper picture: both sides of the contact."""

    def __init__(self, ax: Any, run: Any) -> None:
        from matplotlib.collections import LineCollection

        self.ax, self.run, self.view = ax, run, (view := SideView(run, 13))  # springs on each side
        self.coil = 0.3 * COIL * 2 * view.x[-1] / view.x.size
        (self.body,) = ax.fill([0], [0], facecolor="0.9", linewidth=0, animated=True)
        (self.surface,) = ax.plot([], [], color="0.2", linewidth=1.2, animated=True)
        self.lines = LineCollection([], linewidths=1.8, animated=True)
        self.marks = LineCollection([], linewidths=1.0, colors="0.45", animated=True)
        for lines in (self.lines, self.marks):
            ax.add_collection(lines)
        reach, bottom = view.reach, 1.08 * view.ground
        ax.set(xlim=(-reach, reach), ylim=(bottom, view.top), ylabel=f"height [{view.unit_z}]")
        ax.axhline(view.ground, color="0.2", linewidth=1.2)
        way = view.lean * 2 * np.pi / run.omega * abs(run.v_0) or 2 * reach  # of the ground in a period
        self.apart = way / max(1, round(24 * way / (2 * reach)))  # about 24 marks on the ground
        begins = np.arange(-reach - self.apart, reach, self.apart)
        ends = (begins, np.full_like(begins, bottom)), (begins + self.apart / 2, np.full_like(begins, view.ground))
        self.hatching = np.moveaxis(np.array(ends), 2, 0)
        ax.set_xlabel(f"$x$ {view.label}")
        corner = {"xycoords": "axes fraction", "va": "center", "annotation_clip": False}
        ax.annotate("$v_0$", (1.0, 1.06), (0.88, 1.06), arrowprops={"arrowstyle": "->"}, **corner)
        self.colours = [colour for _, colour in MODES]
        names = mode_patches(run.state, free="no contact")
        ax.legend(handles=names, loc="lower left", bbox_to_anchor=(0, 1), ncols=4, borderaxespad=0.2)

    def show(self, k: int) -> None:
        """Draw the instant k of the record."""
        view, up = self.view, np.linspace(0, 1, COIL.size)  # along a spring
        height = view.ground + np.outer(view.tops(k) - view.ground, up)
        place = view.feet(k)[:, None] + np.outer(view.x - view.feet(k), up) + self.coil
        self.lines.set_segments(list(np.stack([place, height], axis=2)))
        self.marks.set_segments(list(self.hatching + np.array([-self.run.u_x[k] * view.lean % self.apart, 0])))
        self.lines.set_color([self.colours[mode] for mode in view.both(self.run.state[k])])
        outline = np.stack([view.flanks, view.surface(k)], axis=1)
        self.surface.set_data(*outline.T)
        self.body.set_xy([*outline, [view.flanks[-1], 10 * view.top], [view.flanks[0], 10 * view.top]])
        for artist in (self.body, self.marks, self.lines, self.surface):
            self.ax.draw_artist(artist)


class _Force:
    """The lower picture."""

    def __init__(self, ax: Any, run: Any) -> None:
        plot_forces(run, ax)
        self.ax, self.t = ax, periods_of(run)
        self.now = ax.axvline(0, color=COLOURS[1], linewidth=1.2, animated=True)
        (self.dot,) = ax.plot([], [], "o", color=COLOURS[1], zorder=3, animated=True)
        per = prefix(np.concatenate([run.F_x, limit_of(run)]), "N")[0]
        self.forces = np.stack([one * per for one in (run.F_x, run.F_y) if one is not None], axis=1)

    def show(self, k: int) -> None:
        """Mark the instant k of the record."""
        self.now.set_xdata([self.t[k]] * 2)
        self.dot.set_data([self.t[k]] * self.forces.shape[1], self.forces[k])
        for artist in (self.now, self.dot):
            self.ax.draw_artist(artist)
