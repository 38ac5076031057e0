"""What is computed only when a button asks for it: the verdict on the closed form, and the contact on a half-space."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from html import escape
from typing import Any

import panel as pn

from mdr.explorer import look
from mdr.explorer.latest import Latest
from mdr.explorer.state import State
from mdr.explorer.together import together
from mdr.friction.verdict import verdict
from mdr.normal.resolved import resolved
from mdr.tools.progress import silent

Deliver = Callable[[Any, Any], None]


class Asked:
    """A button, and below it the answer, HTML, to the state shown; dropped as soon as another one is."""

    def __init__(
        self, label: str, kind: str, work: Callable[[State, Callable[[], None]], Iterator[str]],
        computed: Callable[[Deliver], Deliver], shown: Callable[[], State],
    ) -> None:  # fmt: skip
        self.said, self.kind = look.html(), kind
        self.asked: State | None = None
        self.work: Latest[State, str] = Latest(work, computed(self._say))
        self.button: Any = pn.widgets.Button(name=label, button_type="primary", margin=(6, 5), css_classes=[kind])
        self.button.on_click(lambda _: self._ask(shown()))

    @property
    def parts(self) -> list[Any]:
        """Button and answer."""
        return [self.button, self.said]

    def drop(self) -> None:
        """Another state is shown."""
        self.work.drop()
        self.asked, self.said.object = None, ""

    def _ask(self, state: State) -> None:
        together()
        self.asked = state
        self.said.object = "computing, some seconds …"
        self.work.ask(state)

    def _say(self, state: State, answer: str | Exception | None) -> None:
        if answer is not None and state is self.asked:
            text = answer if isinstance(answer, str) else look.refused(look.words_of(answer))
            self.said.object = f'<div style="font-size:13px;line-height:1.5" class="said {self.kind}">{text}</div>'


def verdict_of(state: State, watch: Callable[[], None]) -> Iterator[str]:
    """The sentence on how good the closed form is for a case."""
    with silent(watch):
        yield escape(str(verdict(state.case)))


def half_space_of(state: State, watch: Callable[[], None]) -> Iterator[str]:
    """Friction at v_0 on cells of a half-space, and the contact from above at four instants of a period."""
    from mdr import half_space
    from mdr.plots.figures import svg_of

    if not state.case.pull.is_rigid:
        raise ValueError("the half-space is pulled rigidly: choose RigidPull under “What pulls in the plane”")
    with silent(watch):
        run = half_space.slide(resolved(state.case), state.v_0)
        drawn = svg_of(run.plot).partition("<svg")[2]
    told = f"On {run.cells} × {run.cells} cells of a half-space the COF is {run.cof:.4g} ± {run.cof_error:.1g}."
    if beta := state.case.material.dundurs_beta:
        told += f" Cells feel normal-tangential coupling (Dundurs' beta = {beta:.2f}), which springs leave out."
    yield f'{told}<svg style="max-width:100%;height:auto" {drawn}'
