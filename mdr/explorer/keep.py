"""What one takes from the page: the case as a file and as Python, a link, figures; and a case that is brought."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from io import BytesIO, StringIO
from typing import Any

import panel as pn

from mdr.case.contact import SlidingContact
from mdr.explorer.links import link_of, python_of
from mdr.explorer.look import HEADING, REFUSALS, area, html, words_of
from mdr.explorer.pictures import Picture, pictures_of
from mdr.explorer.state import State
from mdr.files.case_files import parse_case
from mdr.files.examples import example_file

CODE = (
    "textarea { font: 12px ui-monospace, monospace; color: #222 !important; opacity: 1 !important; white-space: pre; }"
)
LINK = "history.replaceState(null, '', location.pathname + (cb_obj.value && '?' + cb_obj.value))"


class Keep:
    """Texts, link and files of the last picture. `take` takes a case that was loaded, `refuse` says what is wrong."""

    def __init__(self, take: Callable[[SlidingContact], None], refuse: Callable[[str], None]) -> None:
        self.take, self.refuse = take, refuse
        self.picture: Picture | None = None
        self.toml, self.python = _text("TOML"), _text("Python")
        self.link: Any = pn.widgets.TextInput(
            name="Link to this state, also in the address bar", disabled=True, sizing_mode="stretch_width", margin=5
        )
        self.link.jscallback(value=LINK)
        self.given: Any = pn.widgets.FileInput(accept=".toml", margin=5, css_classes=["upload", "case"])
        self.given.param.watch(self._load, "value")

    @property
    def view(self) -> Any:
        """All of it."""
        files = pn.FlexBox(
            _file("Case (TOML)", "case.toml", lambda: StringIO(self.toml.value)),
            _file("Curve (SVG)", "curve.svg", partial(self._svg, "curve")),
            _file("Springs and forces (SVG)", "run.svg", partial(self._svg, "run")),
            pn.pane.HTML("load a case:", margin=(8, 0, 8, 12)), self.given, align_items="center",
        )  # fmt: skip
        texts = [pn.Column(text, _copy(text), styles={"flex": "1 1 340px"}) for text in (self.toml, self.python)]
        return area("files", html("To keep", HEADING), files, self.link, pn.FlexBox(*texts, gap="12px"))

    def write(self, state: State) -> None:
        """The texts of a state."""
        self.toml.value, self.python.value, self.link.value = example_file(state.case), python_of(state), link_of(state)

    def _load(self, event: Any) -> None:
        if event.new is None:
            return
        try:
            self.take(parse_case(event.new.decode("utf-8-sig"), self.given.filename or "file"))
        except REFUSALS as refusal:
            self.refuse(words_of(refusal))

    def _svg(self, what: str) -> BytesIO:
        """A figure of the project's plots, of the curve whose error is bounded."""
        from matplotlib import pyplot as plt

        from mdr.plots import plot_curve, plot_run

        out, picture = BytesIO(), self.picture
        if picture is not None:
            curve = picture.curve or [*pictures_of(picture.state)][-1].curve
            drawn: Any = plot_curve(curve).figure if what == "curve" else plot_run(picture.run)
            drawn.savefig(out, format="svg")
            plt.close(drawn)
        out.seek(0)
        return out


def _file(label: str, name: str, make: Callable[[], Any]) -> Any:
    return pn.widgets.FileDownload(callback=make, filename=name, label=label, margin=5)


def _text(name: str) -> Any:
    return pn.widgets.TextAreaInput(
        name=name, rows=16, disabled=True, sizing_mode="stretch_width", stylesheets=[CODE], margin=5
    )


def _copy(text: Any) -> Any:
    button = pn.widgets.Button(name=f"Copy {text.name}", margin=5)
    button.jscallback(clicks="navigator.clipboard.writeText(text.value)", args={"text": text})
    return button
