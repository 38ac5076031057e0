"""One way to make the figure of a claim: panels in the style of the library, what is drawn on them, words for both."""

from collections.abc import Callable
from functools import wraps
from typing import Any

from mdr.plots import style
from validation.cases import LOOKS, shape_label
from validation.report import Figure


def figure(
    name: str, rows: int = 1, columns: int = 1, size: tuple[float, float] | None = None, **panels: Any
) -> Callable[[Callable[..., str]], Callable[..., Figure]]:
    """Decorator of a function draw(fig, axes, ...) that draws on axes of `plt.subplots` and returns the caption.

    The docstring of draw says what there is to see, for those who cannot see it. The decorated function takes the
    further arguments alone, and returns the Figure.
    """

    def decorated(draw: Callable[..., str]) -> Callable[..., Figure]:
        @wraps(draw)
        def made(*args: Any) -> Figure:
            import matplotlib.pyplot as plt

            with style():
                fig, axes = plt.subplots(rows, columns, figsize=size, **panels)
                caption = draw(fig, axes, *args)
            return Figure(name, caption, fig, " ".join((draw.__doc__ or "").split()))

        return made

    return decorated


def circles(ax: Any, x: Any, y: Any, colour: str, **look: Any) -> None:
    """Hollow circles: a known answer beside a line, or the other way round."""
    ax.plot(x, y, "o", **{"mfc": "white", "mec": colour, "ms": 4.5, **look})


def key(label: str, **look: Any) -> Any:
    """An entry of a legend for what is drawn without one."""
    from matplotlib.lines import Line2D

    return Line2D([], [], label=label, **look)


def shape_keys(**look: Any) -> list[Any]:
    """An entry for each of the shapes, in its colour and with its marker."""
    return [key(shape_label(s), color=colour, marker=mark, **look) for s, (colour, mark) in LOOKS.items()]


def outer_labels(panels: Any, x: str, y: str) -> None:
    """Label the lowest row and the first column of an array of panels."""
    for ax in panels[-1]:
        ax.set_xlabel(x)
    for ax in panels[:, 0]:
        ax.set_ylabel(y)


def ticks(axis: Any, *places: float) -> None:
    """Mark these places of an axis, as numbers, and no others."""
    axis.set_ticks(places, [f"{place:g}" for place in places])
    axis.axes.minorticks_off()
