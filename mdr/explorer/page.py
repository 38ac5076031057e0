"""The page: a state, the controls that change it, and what is computed of it in a thread."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from html import escape
from typing import Any

import panel as pn

from mdr.case.contact import SlidingContact
from mdr.explorer import look
from mdr.explorer.board import Board
from mdr.explorer.figures import Figures, curve_legend, forces_legend, springs_legend
from mdr.explorer.keep import Keep
from mdr.explorer.latest import Latest
from mdr.explorer.links import state_of
from mdr.explorer.pictures import Picture, pictures_of, verdict_of
from mdr.explorer.state import State
from mdr.files.case_files import parse_case
from mdr.march.march import LEAST_ACCURATE

FIRST_SIGHT = "first sight, its error is not bounded yet"
BOUNDED = f"error of friction ≤ {LEAST_ACCURATE:g} μ<sub>0</sub>, where settled; hollow points are not"


class Page:
    """One visitor's page. The state changes here alone."""

    def __init__(self, state: State, refusal: str = "") -> None:
        self.state, self.document, self.loaded = state, pn.state.curdoc, False
        self.alert, self.status, self.numbers, self.said = (look.html() for _ in range(4))
        self.legends = {legend: look.html() for legend in (curve_legend, springs_legend, forces_legend)}
        self.figures, self.keep, self.board = Figures(), Keep(self._load), Board(state, self.attempt)
        self.pictures: Latest[State, Picture] = Latest(pictures_of, self._computed(self._show))
        self.verdicts: Latest[SlidingContact, str] = Latest(verdict_of, self._computed(self._say))
        self.alert.object = look.refused(refusal)
        self._take(state)
        pn.state.onload(self._loaded)

    @property
    def view(self) -> Any:
        """All of it."""
        judge = pn.widgets.Button(name="Judge the closed form by simulation", button_type="primary", margin=(6, 5))
        judge.on_click(self._judge)
        curve, springs, forces = self.legends.values()
        body = pn.Column(
            look.area("curve", look.heading("Friction over velocity"), curve, self.figures.curve, self.status),
            self.board.view,
            look.area("numbers", self.numbers, judge, self.said),
            look.area(
                "springs",
                look.heading("The springs over a period"), springs, self.figures.springs,
                look.heading("The forces over a period"), forces, self.figures.forces,
            ),
            self.keep.view, stylesheets=[look.LAYOUT], **look.WIDE,
        )  # fmt: skip
        title = "<b style='font-size:19px'>mdr explore</b> &nbsp; sliding friction of a contact under vibration"
        return pn.Column(look.html(title), self.alert, body, stylesheets=[look.PAGE], **look.WIDE)

    # --- changes ---

    def attempt(self, change: Callable[[State], State]) -> str:
        """Change the state; the answer is why that was refused."""
        try:
            self._take(change(self.state))
        except look.REFUSALS as refusal:
            return look.words_of(refusal)
        return ""

    def _load(self, data: bytes, name: str) -> None:
        """Take a case file."""

        def loaded(state: State) -> State:
            return replace(State.of(parse_case(data.decode("utf-8-sig"), name)), in_groups=state.in_groups)

        self.alert.object = look.refused(self.attempt(loaded))

    def _take(self, state: State) -> None:
        """Make this the state: the controls stand at it, and its pictures are asked for."""
        self.state = state
        self.board.show(state)
        self.said.object = ""
        self.verdicts.drop()
        if self.loaded:
            self._tell("computing …")
            self.pictures.ask(state)

    def _loaded(self) -> None:
        """Compute only once the browser listens: what changes before may be lost on its way."""
        self.loaded = True
        self.pictures.ask(self.state)

    # --- answers ---

    def _computed(self, show: Callable[[Any, Any], None]) -> Callable[[Any, Any], None]:
        """What a thread calls, for `show` to be called where the page may be changed."""
        return lambda request, answer: self.document.add_next_tick_callback(partial(show, request, answer))

    def _show(self, state: State, answer: Picture | Exception | None) -> None:
        if state is not self.state:
            return
        if isinstance(answer, Exception):
            self.status.object = look.refused(f"{look.words_of(answer)}; the picture is that of before")
        elif answer is not None:
            with pn.io.hold(self.document):  # one message to the browser
                self._draw(answer)
        else:
            self.keep.write(state)

    def _draw(self, picture: Picture) -> None:
        self.keep.picture = picture
        self.figures.show(picture)
        for legend, pane in self.legends.items():
            pane.object = f'<span style="{look.SMALL}">{legend(picture)}</span>'
        self.numbers.object = look.table(picture.numbers) + "".join(map(look.doubted, picture.doubts))
        self._tell(BOUNDED if picture.curve else FIRST_SIGHT)

    def _tell(self, status: str) -> None:
        self.status.object = f'<span style="{look.SMALL}" class="status">{status}</span>'

    def _judge(self, _: Any) -> None:
        self.said.object = "computing the verdict, which takes some seconds …"
        self.verdicts.ask(self.state.case)

    def _say(self, case: SlidingContact, answer: str | Exception | None) -> None:
        if answer is not None and case == self.state.case:
            text = escape(answer) if isinstance(answer, str) else look.refused(look.words_of(answer))
            self.said.object = f'<div style="font-size:13px;line-height:1.5" class="verdict">{text}</div>'


def page_of(case: SlidingContact) -> Any:
    """The page for a visitor: the state of its link, or the case where the link has none."""
    query = {key: values[-1].decode("utf-8", "replace") for key, values in pn.state.session_args.items()}
    try:
        return Page(state_of(query) if query else State.of(case)).view
    except look.REFUSALS as refusal:
        return Page(State.of(case), look.words_of(refusal)).view
