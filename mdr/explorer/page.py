"""The page: a state, the controls that change it, and what is computed of it in a thread."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any
from urllib.parse import parse_qsl

import panel as pn
from tornado.ioloop import IOLoop

from mdr.case.contact import SlidingContact
from mdr.explorer import look
from mdr.explorer.asked import Asked, half_space_of, verdict_of
from mdr.explorer.board import Board, built_of
from mdr.explorer.curve import Curve, curve_legend
from mdr.explorer.keep import Keep
from mdr.explorer.latest import Latest
from mdr.explorer.links import state_of
from mdr.explorer.over_period import OverPeriod, forces_legend, springs_legend
from mdr.explorer.pictures import Picture, pictures_of
from mdr.explorer.state import State
from mdr.explorer.together import together
from mdr.given.case_file import parse_said
from mdr.march.periodic.steady import LEAST_ACCURATE
from mdr.tools.compiling import TALLY
from mdr.tools.notation import shown

COMPUTING = "computing …"
COMPILING = "compiling, once on this machine: pictures take longer until it is done …"
NOTHING = "nothing to show: the reason stands below"
BEHIND = "a box holds what was refused, see there: the pictures are of the last valid case"
FIRST_SIGHT = "first sight, its error is not bounded yet"
BOUNDED = f"error of friction at the points ≤ {LEAST_ACCURATE:g} μ<sub>0</sub>; hollow ones are not settled"
LOAD = "load = {}: the page holds the depth at which it rests, so that the load changes with all that is changed here"


class Page:
    """One visitor's page. The state changes here alone."""

    def __init__(self, state: State, refusal: str = "") -> None:
        self.state, self.first, self.document, self.loaded = state, state, pn.state.curdoc, False
        self.waits = False  #: whether more is computed of the state
        self.alert, self.behind, self.status, self.numbers = (look.html() for _ in range(4))
        self.legends = {name: look.html() for name in ("curve", "springs", "forces")}
        self.curve, self.over_period = Curve(), OverPeriod()
        self.keep, self.board = Keep(self._go), Board(state, self.attempt, self._refused)
        self.pictures: Latest[State, Picture] = Latest(pictures_of, self._computed(self._show))
        self.asked = [
            Asked("Judge the closed form by simulation", "verdict", verdict_of, self._computed, lambda: self.state),
            Asked("See the contact on a half-space", "half-space", half_space_of, self._computed, lambda: self.state),
        ]
        self.alert.object = look.refused(refusal)
        curve, springs, forces = self.legends.values()
        over = self.over_period
        self.faded = {"curve": look.column(curve, self.curve.figure), "springs": look.column(
            springs, over.controls, over.moving, over.map, look.heading("The forces over a period"), forces, over.forces
        )}  # fmt: skip
        self._take(state)
        pn.state.onload(self._loaded)

    @property
    def view(self) -> Any:
        """All of it."""
        given: Any = pn.widgets.FileInput(accept=".toml", margin=5, width=230, css_classes=["upload", "case"])
        given.param.watch(lambda event: self._load(event.new, given.filename or "file"), "value")
        reset = pn.widgets.Button(name="Reset", margin=5)
        reset.on_click(lambda _: self._take(self.first))
        title = "<b style='font-size:19px'>mdr explore</b> &nbsp; sliding friction of a contact under vibration"
        top = pn.FlexBox(pn.pane.HTML(title), pn.pane.HTML("load a case:"), given, reset, align_items="center")
        from_zero: Any = pn.widgets.Checkbox(name="axis of friction from 0", margin=(0, 10), css_classes=["from-zero"])
        from_zero.param.watch(lambda event: self._begin(event.new), "value")
        head = look.heading(f"Friction over velocity{look.ASIDE}")
        pictures = look.column(
            look.area("curve", head, self.behind, self.faded["curve"], from_zero, self.status),
            look.area("springs", look.heading("The springs over a period"), self.faded["springs"]),
            stylesheets=[look.PICTURES],
        )
        numbers = look.area("numbers", self.numbers, *(part for one in self.asked for part in one.parts))
        body = look.column(pictures, self.board.view, numbers, self.keep.view, stylesheets=[look.LAYOUT])
        return look.column(top, self.alert, body, stylesheets=[look.PAGE])

    def _begin(self, from_zero: bool) -> None:
        """Where the axis of friction begins."""
        together()
        self.curve.begin(from_zero)

    def _refused(self) -> None:
        """Say beside the pictures whether a box holds what they do not show."""
        self.behind.object = look.doubted(BEHIND) if self.board.refuses else ""

    # --- changes ---

    def attempt(self, change: Callable[[State], State]) -> str:
        """Change the state; the answer is why that was refused."""
        try:
            after = change(self.state)
            built_of(after)  # a value that a control shows may be refused too
            self._take(after)
        except look.REFUSALS as refusal:
            return look.words_of(refusal)
        return ""

    def _load(self, data: bytes | None, name: str) -> None:
        """Take a case file."""
        if data is None:
            return
        together()

        def loaded(state: State) -> State:
            said = parse_said(data.decode("utf-8-sig"), name)
            after = replace(State.of(said.case), in_groups=state.in_groups)
            held.update(said.held)
            self.curve.complete = None  # the curve of another contact is none to compare with
            return after

        held: dict[str, Any] = {}
        why = self.attempt(loaded)
        lost = look.doubted(LOAD.format(shown(held["load"], "N"))) if "load" in held and not why else ""
        self.alert.object = look.refused(why) or lost

    def _go(self, query: str) -> None:
        """Take the state of a link, as the browser goes back and forth."""
        together()
        self.alert.object = look.refused(self.attempt(lambda _: state_of(dict(parse_qsl(query.lstrip("?"))))))

    def _take(self, state: State) -> None:
        """Make this the state: the controls stand at it, and its pictures are asked for."""
        together()
        self.state = state
        self.board.show(state)
        for one in self.asked:
            one.drop()
        if self.loaded:
            self._ask()

    def _loaded(self) -> None:
        """Compute only once the browser listens: what changes before may be lost on its way."""
        pn.state.add_periodic_callback(self._watch, 500)
        pn.state.on_session_destroyed(lambda _: self._closed())
        together()
        self.loaded = True
        self.board.name()
        self.keep.write(self.state)
        self._ask()

    def _closed(self) -> None:
        """Nobody waits for what is worked on."""
        self.pictures.drop()
        for one in self.asked:
            one.work.drop()

    def _ask(self) -> None:
        """Ask for the pictures; those of the state before fade until they come."""
        empty = {"curve": self.curve.word.visible, "springs": self.over_period.words[0].visible}
        for name, part in self.faded.items():
            part.styles = look.FRESH if empty[name] else look.STALE
        self.waits = True
        self._tell(COMPUTING)
        self.pictures.ask(self.state)

    def _watch(self) -> None:
        """Say what is waited for on a machine that is new to it."""
        if self.waits and TALLY.open:
            together()
            self._tell(COMPILING)

    # --- answers ---

    def _computed(self, show: Callable[[Any, Any], None]) -> Callable[[Any, Any], None]:
        """What a thread calls, for `show` to be called where the page may be changed."""
        loop = IOLoop.current()

        def shown(request: Any, answer: Any) -> None:
            together()
            show(request, answer)

        def called(request: Any, answer: Any) -> None:
            self.document.add_next_tick_callback(partial(shown, request, answer))

        return lambda request, answer: loop.add_callback(called, request, answer)

    def _show(self, state: State, answer: Picture | Exception | None) -> None:
        if state is not self.state:
            return
        self.waits = isinstance(answer, Picture)
        if isinstance(answer, Exception):
            self.status.object = look.refused(f"{look.words_of(answer)}; the picture is that of before")
            self._wait(NOTHING)
        elif answer is not None:
            self._draw(answer)
        else:
            self.curve.complete = self.curve.shown
            self.keep.write(state)

    def _draw(self, picture: Picture) -> None:
        """Show what is known of a picture; what is not yet stays as it was before, faded."""
        if self.curve.show(picture):
            self.faded["curve"].styles = look.FRESH
            self._legend("curve", curve_legend(picture, before=self.curve.ghost is not None))
        if picture.run is not None and picture.run is not (self.keep.picture and self.keep.picture.run):
            self.over_period.show(picture.run)
            self.faded["springs"].styles = look.FRESH
            self._legend("springs", springs_legend(picture.run))
            self._legend("forces", forces_legend(picture.run))
        self.keep.picture = picture
        self.numbers.object = look.table(picture.numbers) + "".join(map(look.doubted, picture.doubts))
        self._tell(BOUNDED if picture.curve else COMPUTING if picture.cof is None else FIRST_SIGHT)

    def _legend(self, name: str, legend: str) -> None:
        self.legends[name].object = f'<span style="{look.SMALL}">{legend}</span>'

    def _wait(self, why: str) -> None:
        """Say in figures that are empty yet what they wait for."""
        for one in (self.curve.word, *self.over_period.words):
            one.text = why

    def _tell(self, status: str) -> None:
        self._wait(status)
        self.status.object = f'<span style="{look.SMALL}" class="status">{status}</span>'


def page_of(case: SlidingContact) -> Any:
    """The page for a visitor: the state of its link, or the case where the link has none."""
    query = {key: values[-1].decode("utf-8", "replace") for key, values in pn.state.session_args.items()}
    try:
        return Page(state_of(query) if query else State.of(case)).view
    except look.REFUSALS as refusal:
        return Page(State.of(case), look.words_of(refusal)).view
