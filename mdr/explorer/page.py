"""The page: a state, the controls that change it, and what is computed of it in a thread."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from html import escape
from typing import Any

import panel as pn

from mdr.case.contact import SlidingContact
from mdr.explorer.board import Board
from mdr.explorer.figures import BAND_LEGEND, CURVE_LEGEND, FORCES_LEGEND, SPRINGS_LEGEND, Figures
from mdr.explorer.keep import Keep
from mdr.explorer.latest import Latest
from mdr.explorer.links import state_of
from mdr.explorer.look import (
    HEADING,
    IN_SIGHT,
    LAYOUT,
    PAGE,
    REFUSALS,
    SMALL,
    area,
    doubted,
    html,
    refused,
    table,
    words_of,
)
from mdr.explorer.pictures import ACCURACY, Picture, pictures_of, verdict_of
from mdr.explorer.state import State

REST = 0.1  #: s between the first sight of a curve and the work on a better one
FIRST_SIGHT = "first sight, its error is not bounded yet"
BOUNDED = f"error of friction ≤ {ACCURACY:g} μ<sub>0</sub>, where settled; hollow points are not"


class Page:
    """One visitor's page. The state changes here alone."""

    def __init__(self, state: State, refusal: str = "") -> None:
        self.state, self.document, self.loaded = state, pn.state.curdoc, False
        self.alert, self.status, self.numbers, self.said, self.legend = (html() for _ in range(5))
        self.figures, self.keep = Figures(), Keep(self._load, self._refuse)
        self.pictures: Latest[State, Picture] = Latest(pictures_of, self._computed(self._show), REST)
        self.verdicts: Latest[SlidingContact, str] = Latest(verdict_of, self._computed(self._say))
        self.board = Board(state, self.change, self.choose, self._hold)
        self._refuse(refusal)
        self._take(state)
        pn.state.onload(self._loaded)

    @property
    def view(self) -> Any:
        """All of it."""
        judge = pn.widgets.Button(name="Judge the closed form by simulation", button_type="primary", margin=(6, 5))
        judge.on_click(self._judge)
        friction = html("Friction over velocity", HEADING)
        body = pn.Column(
            area("curve", friction, self.legend, self.figures.curve, self.status, sheet=IN_SIGHT),
            self.board.view,
            area("numbers", self.numbers, judge, self.said),
            area(
                "springs",
                html("The springs over a period", HEADING), html(SPRINGS_LEGEND, SMALL), self.figures.springs,
                html("The forces over a period", HEADING), html(FORCES_LEGEND, SMALL), self.figures.forces,
            ),
            self.keep.view, stylesheets=[LAYOUT], sizing_mode="stretch_width",
        )  # fmt: skip
        head = html("<b style='font-size:19px'>mdr explore</b> &nbsp; sliding friction of a contact under vibration")
        return pn.Column(head, self.alert, body, stylesheets=[PAGE], sizing_mode="stretch_width")

    # --- changes ---

    def change(self, path: str, value: Any) -> str:
        """Set a path; the answer is why it was refused."""
        return self._try(lambda: self.state.changed(path, value))

    def choose(self, slot: str, kind: str) -> str:
        """Set the kind of a part; the answer is why it was refused."""
        return self._try(lambda: self.state.with_kind(slot, kind))

    def _try(self, change: Callable[[], State]) -> str:
        try:
            self._take(change())
        except REFUSALS as refusal:
            return words_of(refusal)
        return ""

    def _hold(self, in_groups: bool) -> None:
        self._take(replace(self.state, in_groups=in_groups))

    def _load(self, case: SlidingContact) -> None:
        self._take(replace(State.of(case), in_groups=self.state.in_groups), anew=True)
        self._refuse("")

    def _refuse(self, words: str) -> None:
        self.alert.object = refused(words)

    def _take(self, state: State, anew: bool = False) -> None:
        """Make this the state: the controls stand at it, and its pictures are asked for."""
        self.state = state
        self.board.show(state, anew)
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
            self.status.object = refused(f"{words_of(answer)}; the picture is that of before")
        elif answer is not None:
            with pn.io.hold(self.document):  # one message to the browser
                self._draw(answer)
        else:
            self.keep.write(state)

    def _draw(self, picture: Picture) -> None:
        self.keep.picture = picture
        self.figures.show(picture)
        self.legend.object = f'<span style="{SMALL}">{CURVE_LEGEND}{BAND_LEGEND if picture.band else ""}</span>'
        self.numbers.object = table(picture.numbers) + "".join(map(doubted, picture.doubts))
        self._tell(BOUNDED if picture.curve else FIRST_SIGHT)

    def _tell(self, status: str) -> None:
        self.status.object = f'<span style="{SMALL}" class="status">{status}</span>'

    def _judge(self, _: Any) -> None:
        self.said.object = "computing the verdict, which takes some seconds …"
        self.verdicts.ask(self.state.case)

    def _say(self, case: SlidingContact, answer: str | Exception | None) -> None:
        if answer is not None and case == self.state.case:
            text = refused(words_of(answer)) if isinstance(answer, Exception) else escape(answer)
            self.said.object = f'<div style="font-size:13px;line-height:1.5" class="verdict">{text}</div>'


def page_of(case: SlidingContact) -> Any:
    """The page for a visitor: the state of its link, or the case where the link has none."""
    query = {key: values[-1].decode("utf-8", "replace") for key, values in pn.state.session_args.items()}
    try:
        return Page(state_of(query) if query else State.of(case)).view
    except REFUSALS as refusal:
        return Page(State.of(case), words_of(refusal)).view
