"""One way to make the figure of a claim: panels in the style of the library, what is drawn on them, words for both."""

import inspect
import re
from collections.abc import Callable, Mapping
from functools import wraps
from typing import Any

from mdr.plots import COLOURS as COLOURS  # the claims take it from here
from mdr.plots import style
from validation.cases import LOOKS, shape_label
from validation.report import Figure


def figure(
    name: str, rows: int = 1, columns: int = 1, size: tuple[float, float] | None = None, **panels: Any
) -> Callable[[Callable[..., Any]], Callable[..., Figure]]:
    """Decorator of a function draw(fig, axes, ...) that draws on axes of `plt.subplots`.

    The docstring of draw says first what there is to see, for those who cannot see it; then, after an empty line, comes
    the caption. Names in braces in the caption are numbers, or words, that draw returns as a dict; a text
    that draw returns takes the place of the caption. The decorated function takes the further arguments alone, and
    returns the Figure.
    """

    def decorated(draw: Callable[..., Any]) -> Callable[..., Figure]:
        @wraps(draw)
        def made(*args: Any) -> Figure:
            import matplotlib.pyplot as plt

            alt, _, caption = re.sub(r"(?<!\n)\n(?!\n)", " ", inspect.getdoc(draw) or "").partition("\n\n")
            with style():
                fig, axes = plt.subplots(rows, columns, figsize=size, **panels)
                told = draw(fig, axes, *args)
            return Figure(name, told if isinstance(told, str) else caption.format(**told or {}), fig, alt)

        return made

    return decorated


def panel(
    axes: Any, x: str = "", y: str = "", title: str = "", log: str = "", legend: Any = None, **limits: Any
) -> None:
    """Labels of an axis, or of a row of axes whose first one has y; log: axes of a logarithmic scale, "x", "y", "xy".

    legend: where it stands ("best"), or the keywords of a legend. limits and all else are those of `Axes.set`.
    """
    for ax in axes if (row := hasattr(axes, "__iter__")) else [axes]:
        scales = {f"{one}scale": "log" for one in log}
        words = {"xlabel": x, "ylabel": y if not row or ax is axes[0] else "", "title": title}
        ax.set(**scales, **{key: text for key, text in words.items() if text}, **limits)
        if legend:
            ax.legend(**(legend if isinstance(legend, Mapping) else {"loc": legend}))


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


def below(fig: Any, ax: Any, ncols: int) -> None:
    """The legend of an axis below all panels."""
    fig.legend(*ax.get_legend_handles_labels(), loc="outside lower center", ncols=ncols)


def ticks(axis: Any, *places: float) -> None:
    """Mark these places of an axis, as numbers, and no others."""
    axis.set_ticks(places, [f"{place:g}" for place in places])
    axis.axes.minorticks_off()
