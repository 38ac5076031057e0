"""The controls of the page, part by part: which kind it is, and a knob for each of its fields or groups."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import panel as pn

from mdr.case.contact import KINDS
from mdr.case.paths import facts_at
from mdr.explorer import look
from mdr.explorer.controls import Control, control_of, controls_of
from mdr.explorer.links import meaning_of, typed
from mdr.explorer.scripts import NAMES
from mdr.explorer.state import State, group_values
from mdr.explorer.together import together
from mdr.tools.notation import is_number, parted

GROUPED = (
    "Groups have no unit: contacts alike in all of them, and in c<sub>x</sub>/(m ω), have the same μ/μ<sub>0</sub> "
    "over v<sub>0</sub>/v<sub>c</sub>."
)

Attempt = Callable[[Callable[[State], State]], str]  #: makes a change; the answer is why it was refused, or ""


class Knob:
    """One control: name and meaning, a box to type in or to choose from, a slider, and why a value was refused."""

    def __init__(self, control: Control, attempt: Attempt, told: Callable[[], None]) -> None:
        self.control, self.attempt, self.told, self.showing = control, attempt, told, False
        self.words = pn.pane.HTML("", visible=False, margin=(0, 5, 4, 5), **look.WIDE)
        kind, listed = control.path in KINDS, isinstance(control.value, tuple)
        named = {"css_classes": ["kind" if kind else "box", control.path], "margin": (8, 5, 0, 5), **look.WIDE}
        named["stylesheets"] = [look.KIND if kind else look.LISTED if listed else look.BOX]
        named["name"] = facts_at(control.path).meaning.capitalize() if kind else look.label(control.name, control.facts)
        if control.words:
            self.box: Any = pn.widgets.Select(options=list(control.words), value=control.value, **named)
        else:
            self.box = pn.widgets.TextInput(value=self._text, **named)
        self.box.param.watch(self._typed, "value")
        rows: list[Any] = [self.box]
        self.slider: Any = None
        if control.grid:
            self.slider = pn.widgets.IntSlider(
                start=0, end=len(control.grid) - 1, value=control.place, show_value=False, tooltips=False,
                margin=(2, 10, 2, 8), height=14, name="", css_classes=["slider", control.path], **look.WIDE,
            )  # fmt: skip
            self.slider.param.watch(self._moved, "value")
            rows.append(self.slider)
        self.view = pn.Column(*rows, self.words, margin=0, **look.WIDE)

    @property
    def _text(self) -> str:
        """What the box holds."""
        return typed(self.control.value, self.control.facts.unit)

    def show(self, state: State) -> None:
        """Stand at the value of a state."""
        self.control = self.control.of(state)
        self._stand()
        self._say("")

    def _stand(self) -> None:
        self.showing = True
        self.box.value = self._text
        if self.slider is not None:
            self.slider.end, self.slider.value = len(self.control.grid) - 1, self.control.place
        self.showing = False

    def _moved(self, event: Any) -> None:
        if not self.showing:
            self._set(lambda: self.control.grid[event.new])

    def _typed(self, event: Any) -> None:
        if self.showing:
            return
        if event.new == self._text:  # as it was, also after a refusal
            self._say("")
        else:
            # a bare number is one in the unit that the box shows
            text = f"{event.new} {parted(self._text)[1]}" if is_number(event.new.strip()) else event.new
            told = (self.control.name, self.control.facts.unit)
            self._set(lambda: event.new if self.control.words else meaning_of(text.strip(), *told))

    def _set(self, value: Callable[[], Any]) -> None:
        why = self.attempt(lambda state: state.changed(self.control.path, value()))
        if why and self.control.words:  # what was chosen is not what is shown below
            self._stand()
            why = f"{value()}: {why}"
        self._say(why)

    def _say(self, words: str) -> None:
        """Why a value was refused; nothing where it was not."""
        if bool(words) or self.words.visible:
            together()
            self.words.object, self.words.visible = look.refused(words), bool(words)
            self.told()


def built_of(state: State) -> tuple[Any, ...]:
    """All that decides which controls a state has. Raises ValueError where a control has no value, in its words."""
    kinds = [state.value(slot) for slot in KINDS]
    return (state.in_groups, state.v_c is None, state.case.is_shaken, *kinds, *group_values(state.case))


class Board:
    """All controls."""

    def __init__(self, state: State, attempt: Attempt, told: Callable[[], None]) -> None:
        self.attempt, self.told, self.in_groups = attempt, told, state.in_groups
        self.built: tuple[Any, ...] = ()
        self.knobs: list[Knob] = []
        self.parts: dict[str, Any] = {slot: pn.Column(margin=0, **look.WIDE) for slot in ("", *KINDS)}
        self.kinds = {slot: Knob(control_of(state, slot), attempt, told) for slot in KINDS}
        self.held: Any = pn.widgets.RadioButtonGroup(
            options={"SI units": False, "dimensionless groups": True}, value=state.in_groups, margin=(4, 5), **look.WIDE
        )
        self.held.param.watch(self._grouped, "value")
        self.names = pn.widgets.IntInput(visible=False)
        self.names.jscallback(value=NAMES)
        explained = look.html(GROUPED, look.SMALL)
        self.view = look.area("controls", self.held, explained, self.parts[""], self.names)
        for slot, kind in self.kinds.items():
            self.view.extend([kind.view, self.parts[slot]])

    def _grouped(self, event: Any) -> None:
        if event.new != self.in_groups:  # else it follows the state
            self.attempt(lambda state: replace(state, in_groups=event.new))

    def show(self, state: State) -> None:
        """Stand at a state."""
        self.in_groups = self.held.value = state.in_groups
        if self.built != (built := built_of(state)):
            self.built, self.knobs = built, []
            for slot, controls in controls_of(state).items():
                made = [Knob(one, self.attempt, self.told) for one in controls]
                self.knobs += made
                self.parts[slot].objects = [knob.view for knob in made]
        for knob in (*self.kinds.values(), *self.knobs):
            knob.show(state)
        self.name()

    @property
    def refuses(self) -> bool:
        """Whether a box holds what was refused."""
        return any(knob.words.visible for knob in (*self.kinds.values(), *self.knobs))

    def name(self) -> None:
        """Have the browser name the sliders, which no widget does, for those who hear the page."""
        self.names.value += 1
