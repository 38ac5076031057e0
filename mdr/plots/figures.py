"""What all figures share: their style, colours, axes, units of numbers, and the file they go to."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from io import StringIO
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Axes
    from matplotlib.figure import Figure as Figure
else:
    Axes = Figure = Any  # matplotlib is imported where something is drawn

#: Okabe and Ito (2008): distinct to colour-blind readers, and dark enough on white
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#555555")
_ONE = Lock()  # pyplot has one style and one list of figures for all threads


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


def svg_of(draw: Callable[[], Figure]) -> str:
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


def save(figure: Figure, script: str, suffix: str = "") -> Path:
    """Save a figure as figures/<name of the script><suffix>.png beside the script; returns the path."""
    path = Path(script).resolve().parent / "figures" / f"{Path(script).stem}{suffix}.png"
    path.parent.mkdir(exist_ok=True)
    figure.savefig(path, dpi=200)
    return path


def faint(draw: Any, at: float) -> None:
    """A line to read other things by."""
    draw(at, color="0.75", linewidth=0.8, zorder=0)


def axes_of(ax: Axes | None) -> Axes:
    """The axes given, or those of a new figure."""
    return subplots()[1] if ax is None else ax


def subplots(*args: Any, **kwargs: Any) -> tuple[Figure, Any]:
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


def edges_of(centres: NDArray[np.float64]) -> NDArray[np.float64]:
    """Cell boundaries half-way between ascending centres (n,), the outer cells symmetric: (n + 1,)."""
    if len(centres) == 1:
        half = abs(centres[0]) or 0.5
        return np.array([centres[0] - half, centres[0] + half])
    middle = (centres[1:] + centres[:-1]) / 2
    return np.concatenate([[2 * centres[0] - middle[0]], middle, [2 * centres[-1] - middle[-1]]])


def prefix(values: Any, unit: str) -> tuple[float, str]:
    """Factor and unit that bring the largest magnitude between 1 and 1000."""
    largest = float(np.max(np.abs(values), initial=0.0, where=np.isfinite(values)))
    power = int(np.clip(np.floor(np.log10(largest) / 3 + 1e-9), -4, 3)) if largest > 0 else 0
    return 10.0 ** (-3 * power), "pnµm kMG"[power + 4].strip() + unit
