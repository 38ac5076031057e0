"""The page: controls on the left, figures and numbers beside them, and below the case as text."""

from __future__ import annotations

from functools import partial
from html import escape
from io import BytesIO, StringIO
from typing import Any

import panel as pn

from mdr.case.contact import KINDS, SlidingContact
from mdr.explorer.controls import controls_of
from mdr.explorer.figures import BAND_LEGEND, CURVE_LEGEND, FORCES_LEGEND, SPRINGS_LEGEND, Figures
from mdr.explorer.knob import Knob, refused
from mdr.explorer.latest import Latest
from mdr.explorer.links import link_of, python_of, state_of
from mdr.explorer.pictures import ACCURACY, Picture, pictures_of, verdict_of
from mdr.explorer.scales import group_values
from mdr.explorer.state import State, kind_of, kinds_of
from mdr.files.case_files import parse_case
from mdr.files.examples import example_file

REFUSALS = (ValueError, TypeError, ArithmeticError, LookupError)
TITLES = {"indenter": "Shape", "material": "Material", "oscillation": "Motion in depth", "pull": "Pull",
          "shake": "Shake in the plane"}  # fmt: skip
HEADING = "font-weight:600;font-size:15px;"
SMALL = "color:#666;font-size:12.5px;"
#: wide: controls, curve, springs side by side; narrow: one below the other, and the curve stays in sight
LAYOUT = """
:host { display: grid !important; gap: 8px 28px; align-items: start;
        grid-template-columns: 350px minmax(0, 1fr) minmax(0, 1fr); grid-template-rows: auto auto 1fr;
        grid-template-areas: "controls curve springs" "controls numbers springs" "controls files files"; }
@media (max-width: 1150px) { :host {
        grid-template-columns: 330px minmax(0, 1fr); grid-template-rows: auto auto auto 1fr;
        grid-template-areas: "controls curve" "controls numbers" "controls springs" "controls files"; } }
@media (max-width: 720px) { :host {
        grid-template-columns: minmax(0, 1fr); grid-template-rows: auto;
        grid-template-areas: "curve" "controls" "numbers" "springs" "files"; } }
"""
IN_SIGHT = """
@media (max-width: 720px) { :host { position: sticky !important; top: 0; z-index: 5; background: white; } }
"""
PAGE = ":host { max-width: 1560px; margin: 0 auto !important; padding: 0 14px; box-sizing: border-box; }"


class Page:
    """One visitor's page. The state changes here alone; pictures come from a thread."""

    def __init__(self, state: State, refusal: str = "") -> None:
        self.state, self.picture, self.document = state, None, pn.state.curdoc
        self.figures = Figures()
        self.parts: dict[str, Any] = {slot: pn.Column(sizing_mode="stretch_width", margin=0) for slot in ("", *KINDS)}
        self.kinds = {slot: self._kind(slot) for slot in KINDS}
        self.knobs: dict[str, Knob] = {}
        self.built: tuple[Any, ...] = ()
        self.held: Any = pn.widgets.RadioButtonGroup(
            options={"SI units": False, "dimensionless groups": True}, value=state.in_groups, margin=(4, 5),
            sizing_mode="stretch_width",
        )  # fmt: skip
        self.held.param.watch(self._in_groups, "value")
        self.alert, self.status, self.numbers, self.said, self.legend = (_html("") for _ in range(5))
        self.toml, self.python = _code("TOML"), _code("Python")
        self.link: Any = pn.widgets.TextInput(name="Link to this state", sizing_mode="stretch_width", disabled=True)
        self.link.jscallback(value="history.replaceState(null, '', location.pathname + '?' + cb_obj.value)")
        self.pictures: Latest[State, Picture] = Latest(pictures_of, self._computed(self._show))
        self.verdicts: Latest[SlidingContact, str] = Latest(verdict_of, self._computed(self._say))
        self.alert.object = refused(refusal)
        self.loaded = False
        self._take(state)
        pn.state.onload(self._load)

    @property
    def view(self) -> Any:
        """All of it."""
        judge = pn.widgets.Button(name="Judge the closed form by simulation", button_type="primary", margin=(6, 5))
        judge.on_click(self._judge)
        curve = _area(
            "curve", _html("Friction over velocity", HEADING), self.legend, self.figures.curve, self.status,
            stylesheets=[IN_SIGHT],
        )  # fmt: skip
        numbers = _area("numbers", self.numbers, judge, self.said)
        springs = _area(
            "springs",
            _html("The springs over a period", HEADING), _html(SPRINGS_LEGEND, SMALL), self.figures.springs,
            _html("The forces over a period", HEADING), _html(FORCES_LEGEND, SMALL), self.figures.forces,
        )  # fmt: skip
        controls = _area("controls", self.held, self.parts[""])
        for slot in KINDS:
            controls.extend([_html(TITLES[slot], HEADING + "margin-top:10px;"), self.kinds[slot], self.parts[slot]])
        body = pn.Column(curve, controls, numbers, springs, self._files(), stylesheets=[LAYOUT], sizing_mode="stretch_width")
        head = _html("<b style='font-size:19px'>mdr explore</b> &nbsp; sliding friction of a contact under vibration")
        return pn.Column(head, self.alert, body, stylesheets=[PAGE], sizing_mode="stretch_width")

    # --- changes ---

    def change(self, path: str, value: Any) -> str:
        """Set a path; the answer is why it was refused."""
        try:
            self._take(self.state.changed(path, value))
        except REFUSALS as refusal:
            return _told(refusal)
        return ""

    def _take(self, state: State) -> None:
        """Make this the state: controls stand at it, texts say it, pictures are asked for."""
        self.state = state
        built = (state.in_groups, *(kind_of(state.case, slot) for slot in KINDS), *group_values(state.case))
        if self.built != (built := (*built, state.case.is_shaken)):
            self._build(state)
            self.built = built
        for knob in self.knobs.values():
            knob.show(state)
        self.said.object = ""
        if self.loaded:
            self.status.object = f'<span style="{SMALL}" class="status">computing …</span>'
            self.pictures.ask(state)

    def _load(self) -> None:
        """Compute only once the browser listens: what changes before may be lost on its way."""
        self.loaded = True
        self.pictures.ask(self.state)

    def _build(self, state: State) -> None:
        self.knobs = {}
        for slot, controls in controls_of(state).items():
            made = [Knob(one, self.change) for one in controls]
            self.knobs |= {knob.control.path: knob for knob in made}
            self.parts[slot].objects = [knob.view for knob in made]
        for slot, (choice, _) in self.kinds.items():
            choice.value = kind_of(state.case, slot)

    def _kind(self, slot: str) -> Any:
        """The choice of a kind of a part, and below it why it was refused."""
        choice = pn.widgets.Select(
            options=kinds_of(slot), value=kind_of(self.state.case, slot), sizing_mode="stretch_width", margin=(2, 5),
            css_classes=["kind", slot],
        )  # fmt: skip
        words = _html("")

        def chosen(event: Any) -> None:
            if event.new == kind_of(self.state.case, slot):
                return
            try:
                self._take(self.state.with_kind(slot, event.new))
                words.object = ""
            except REFUSALS as refusal:
                words.object = refused(f"{event.new}: {_told(refusal)}")
                choice.value = kind_of(self.state.case, slot)

        choice.param.watch(chosen, "value")
        return pn.Column(choice, words, sizing_mode="stretch_width", margin=0)

    def _in_groups(self, event: Any) -> None:
        from dataclasses import replace

        self._take(replace(self.state, in_groups=event.new))

    # --- answers ---

    def _computed(self, show: Any) -> Any:
        """What a thread calls, for `show` to be called in the page's own."""
        return lambda request, answer: self.document.add_next_tick_callback(partial(show, request, answer))

    def _show(self, state: State, answer: Picture | Exception | None) -> None:
        if state is not self.state:
            return
        if isinstance(answer, Exception):
            self.status.object = refused(f"{_told(answer)}; the picture is that of before")
        elif answer is not None:
            self._draw(answer)
        else:
            self._write(state)

    def _draw(self, picture: Picture) -> None:
        self.picture = picture
        self.figures.show(picture)
        self.legend.object = f'<span style="{SMALL}">{CURVE_LEGEND}{BAND_LEGEND if picture.band else ""}</span>'
        bound = f"error of friction ≤ {ACCURACY:g} μ<sub>0</sub>, where settled; hollow points are not"
        how = bound if picture.curve else "first sight, its error is not bounded yet"
        self.status.object = f'<span style="{SMALL}" class="status">{how}</span>'
        rows = "".join(
            f'<tr><td style="padding-right:14px">{name}</td><td style="padding-right:14px"><b>{value}</b></td>'
            f'<td style="color:#666">{meaning}</td></tr>'
            for name, value, meaning in picture.numbers
        )
        self.numbers.object = f'<table style="font-size:13px;line-height:1.5">{rows}</table>'

    def _write(self, state: State) -> None:
        """The texts of a state whose pictures are all there."""
        self.toml.value, self.python.value, self.link.value = example_file(state.case), python_of(state), link_of(state)

    def _judge(self, _: Any) -> None:
        self.said.object = "computing the verdict, which takes some seconds …"
        self.verdicts.ask(self.state.case)

    def _say(self, case: SlidingContact, answer: str | Exception | None) -> None:
        if answer is not None and case == self.state.case:
            text = refused(_told(answer)) if isinstance(answer, Exception) else escape(answer)
            self.said.object = f'<div style="font-size:13px;line-height:1.5" class="verdict">{text}</div>'

    # --- files ---

    def _files(self) -> Any:
        case = pn.widgets.FileDownload(callback=lambda: StringIO(self.toml.value), filename="case.toml", label="Case (TOML)")
        curve = pn.widgets.FileDownload(callback=partial(self._svg, "curve"), filename="curve.svg", label="Curve (SVG)")
        run = pn.widgets.FileDownload(callback=partial(self._svg, "run"), filename="run.svg", label="Springs and forces (SVG)")
        given: Any = pn.widgets.FileInput(accept=".toml", margin=5, css_classes=["upload", "case"])
        given.param.watch(lambda event: self._upload(given.filename, event.new), "value")
        row = pn.FlexBox(case, curve, run, pn.pane.HTML("load a case:", margin=(8, 0, 8, 12)), given, align_items="center")
        texts = pn.FlexBox(
            *(pn.Column(text, _copy(text), styles={"flex": "1 1 340px"}) for text in (self.toml, self.python)), gap="12px"
        )
        return _area("files", _html("To keep", HEADING), row, self.link, texts)

    def _upload(self, name: str | None, data: bytes | None) -> None:
        if data is None:
            return
        try:
            case = parse_case(data.decode("utf-8-sig"), name or "file")
            self.built = ()
            self._take(State.of(case))
            self.alert.object = ""
        except REFUSALS as refusal:
            self.alert.object = refused(_told(refusal))

    def _svg(self, what: str) -> BytesIO:
        """A figure of the project's plots."""
        from mdr.plots import plot_curve, plot_run

        out = BytesIO()
        if self.picture is not None and self.picture.curve is not None:
            drawn = plot_curve(self.picture.curve).figure if what == "curve" else plot_run(self.picture.run)
            drawn.savefig(out, format="svg")
        out.seek(0)
        return out


def page_of(case: SlidingContact) -> Any:
    """The page for a visitor: the state of its link, or the case where the link has none."""
    query = {key: values[-1].decode("utf-8", "replace") for key, values in pn.state.session_args.items()}
    try:
        return Page(state_of(query) if query else State.of(case)).view
    except REFUSALS as refusal:
        return Page(State.of(case), _told(refusal)).view


def _area(name: str, *parts: Any, **more: Any) -> Any:
    """Parts one below the other, in an area of the layout."""
    return pn.Column(*parts, styles={"grid-area": name}, sizing_mode="stretch_width", **more)


def _html(text: str, style: str = "") -> Any:
    return pn.pane.HTML(f'<span style="{style}">{text}</span>' if style else text, margin=(2, 5), sizing_mode="stretch_width")


def _code(name: str) -> Any:
    style = "textarea { font-family: ui-monospace, monospace; font-size: 12px; color: #222 !important;"
    style += " opacity: 1 !important; white-space: pre; overflow-x: auto; }"
    return pn.widgets.TextAreaInput(name=name, rows=16, disabled=True, sizing_mode="stretch_width", stylesheets=[style])


def _copy(text: Any) -> Any:
    button = pn.widgets.Button(name="Copy", margin=(0, 10))
    button.jscallback(clicks="navigator.clipboard.writeText(text.value)", args={"text": text})
    return button


def _told(refusal: Exception) -> str:
    return str(refusal) or type(refusal).__name__


__all__ = ["Page", "page_of"]
