"""One control on the page: name and meaning, a box to type in, a slider, and below it why a value was refused."""

from __future__ import annotations

from collections.abc import Callable
from html import escape
from typing import Any

import panel as pn

from mdr.explorer.controls import Control
from mdr.explorer.links import meaning_of
from mdr.explorer.look import refused
from mdr.explorer.state import State

Change = Callable[[str, Any], str]  #: sets a path to a value; the answer is why it was refused, or ""


class Slider(pn.widgets.IntSlider):  # type: ignore[misc]
    """A slider whose value is taken almost at once."""

    _debounce = 5  # ms in which moves are gathered, 50 in Panel


class Knob:
    """The widgets of one control."""

    def __init__(self, control: Control, change: Change) -> None:
        self.control, self.change, self.showing = control, change, False
        self.words = pn.pane.HTML("", visible=False, margin=(0, 5, 4, 5), sizing_mode="stretch_width")
        listed = isinstance(control.value, tuple)
        size: dict[str, Any] = {"sizing_mode": "stretch_width"} if listed else {"width": 104}
        if control.words:
            self.box: Any = pn.widgets.Select(options=list(control.words), value=control.value, margin=(0, 5), **size)
        else:
            self.box = pn.widgets.TextInput(value=control.text, margin=(0, 5), name="", **size)
        self.slider: Any = None
        head = pn.Column if listed else pn.Row
        rows: list[Any] = [head(self._label(), self.box, sizing_mode="stretch_width", margin=(4, 0, 0, 0))]
        if control.grid:
            self.slider = Slider(
                start=0, end=len(control.grid) - 1, value=control.place, show_value=False, tooltips=False,
                sizing_mode="stretch_width", margin=(2, 10, 2, 8), height=14, name="",
                css_classes=["slider", control.path],
            )  # fmt: skip
            self.slider.param.watch(self._moved, "value")
            rows.append(self.slider)
        self.box.css_classes = ["box", control.path]
        self.box.param.watch(self._typed, "value")
        self.view = pn.Column(*rows, self.words, sizing_mode="stretch_width", margin=0)

    def show(self, state: State) -> None:
        """Stand at the value of a state."""
        before, self.control = self.control, self.control.of(state)
        self.showing = True
        self.box.value = self.control.value if self.control.words else self.control.text
        if self.slider is not None:
            if self.control.grid != before.grid:
                self.slider.end = len(self.control.grid) - 1
            self.slider.value = self.control.place
        self.showing = False
        self._say("")

    def _label(self) -> Any:
        facts = self.control.facts
        unit = f" [{escape(facts.unit)}]" if facts.unit not in ("", "-") else ""
        text = f'<b>{escape(self.control.name)}</b>{unit}<br><span style="color:#666">{escape(facts.meaning)}</span>'
        return pn.pane.HTML(
            text, styles={"font-size": "12.5px", "line-height": "1.3"}, margin=(0, 5), sizing_mode="stretch_width"
        )

    def _moved(self, event: Any) -> None:
        if not self.showing:
            self._set(self.control.grid[event.new])

    def _typed(self, event: Any) -> None:
        if self.showing:
            return
        if event.new == self.control.text:  # as it was, also after a refusal
            self._say("")
        else:
            self._set(event.new if self.control.words else meaning_of(event.new))

    def _set(self, value: Any) -> None:
        self._say(self.change(self.control.path, value))

    def _say(self, words: str) -> None:
        """Why a value was refused; nothing where it was not."""
        if bool(words) or self.words.visible:
            self.words.object, self.words.visible = refused(words), bool(words)
