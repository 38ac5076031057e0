"""The controls of the page, part by part: which kind it is, and the knobs of its fields or groups."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import panel as pn

from mdr.case.contact import KINDS
from mdr.explorer.controls import controls_of
from mdr.explorer.knob import Change, Knob
from mdr.explorer.look import HEADING, area, html, refused
from mdr.explorer.scales import group_values
from mdr.explorer.state import State, kind_of, kinds_of

TITLES = {
    "indenter": "Shape",
    "material": "Material",
    "oscillation": "Motion in depth",
    "pull": "Pull",
    "shake": "Shake in the plane",
}


class Board:
    """All controls. `change` sets a path, `choose` the kind of a part; both answer why not, or ""."""

    def __init__(self, state: State, change: Change, choose: Change, hold: Callable[[bool], None]) -> None:
        self.state, self.change, self.choose = state, change, choose
        self.built: tuple[Any, ...] = ()
        self.knobs: dict[str, Knob] = {}
        self.parts: dict[str, Any] = {slot: pn.Column(sizing_mode="stretch_width", margin=0) for slot in ("", *KINDS)}
        self.kinds = {slot: self._kind(slot) for slot in KINDS}
        self.held: Any = pn.widgets.RadioButtonGroup(
            options={"SI units": False, "dimensionless groups": True}, value=state.in_groups, margin=(4, 5),
            sizing_mode="stretch_width",
        )  # fmt: skip
        self.held.param.watch(lambda event: hold(event.new), "value")
        titled = [
            (html(TITLES[slot], HEADING + "margin-top:10px;"), self.kinds[slot], self.parts[slot]) for slot in KINDS
        ]
        self.view = area("controls", self.held, self.parts[""], *(one for three in titled for one in three))

    def show(self, state: State, anew: bool = False) -> None:
        """Stand at a state; `anew` also moves every grid there."""
        self.state, case = state, state.case
        kinds = [kind_of(case, slot) for slot in KINDS]
        built = (state.in_groups, state.v_c is None, case.is_shaken, *kinds, *group_values(case))
        if anew or self.built != built:
            self.built, self.knobs = built, {}
            for slot, controls in controls_of(state).items():
                made = [Knob(one, self.change) for one in controls]
                self.knobs |= {knob.control.path: knob for knob in made}
                self.parts[slot].objects = [knob.view for knob in made]
        for slot, kind in zip(KINDS, kinds, strict=True):
            self.kinds[slot][0].value, self.kinds[slot][1].object = kind, ""
        for knob in self.knobs.values():
            knob.show(state)

    def _kind(self, slot: str) -> Any:
        """The choice of a kind of a part, and below it why it was refused."""
        choice = pn.widgets.Select(
            options=kinds_of(slot), value=kind_of(self.state.case, slot), sizing_mode="stretch_width", margin=(2, 5),
            css_classes=["kind", slot],
        )  # fmt: skip
        words = html()

        def chosen(event: Any) -> None:
            if event.new != kind_of(self.state.case, slot) and (why := self.choose(slot, event.new)):
                choice.value = kind_of(self.state.case, slot)
                words.object = refused(f"{event.new}: {why}")

        choice.param.watch(chosen, "value")
        return pn.Column(choice, words, sizing_mode="stretch_width", margin=0)
