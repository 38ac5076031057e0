"""What figures of the page are made of, in Bokeh: an empty one in the style of the project's plots, data, legends."""

from __future__ import annotations

from typing import Any

from bokeh.models import ColumnDataSource, Label, Range1d
from bokeh.plotting import figure

GREY, DARK = "#bbbbbb", "#666666"


def swatches(*named: tuple[str, str]) -> str:
    """A legend as HTML: names and colours."""
    box = "display:inline-block;width:12px;height:12px;border-radius:2px;margin:0 5px -1px 12px;border:1px solid #0002;"
    return "".join(f'<span style="{box}background:{colour}"></span>{name}' for name, colour in named)


def stroke(name: str, border: str) -> str:
    """An upright or level line in a legend, as HTML."""
    size = "" if "left" in border else "display:inline-block;width:16px;vertical-align:middle;"
    return f'<span style="{size}{border};margin:0 6px 0 14px"></span>{name}'


def data_of(*columns: str, **named: str) -> Any:
    """Data of these columns, none as yet."""
    return ColumnDataSource({column: [] for column in columns}, **named)


def canvas(height: int, x_label: str, y_label: str, **options: Any) -> Any:
    """An empty figure in the style of the project's plots."""
    options = {"x_range": Range1d(0, 1), "y_range": Range1d(0, 1)} | options
    made = figure(
        height=height, sizing_mode="stretch_width", toolbar_location="right",
        active_drag=None, tools="box_zoom,reset,save", **options,
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


def word(figure: Any) -> Any:
    """A line of text in the middle of an empty figure, until it has something to show."""
    label = Label(x=0.5, y=0.5, text="", text_align="center", text_font_size="13px", text_color=DARK)
    figure.add_layout(label)
    return label


def span(axis: Any, start: float, end: float) -> None:
    """What an axis spans, also after a reset."""
    axis.update(start=start, end=end, reset_start=start, reset_end=end)
