"""What one takes from the page: the case as a file and as Python, a link, figures; and a case that is brought."""

from __future__ import annotations

from collections.abc import Callable
from io import BytesIO, StringIO
from typing import Any

import panel as pn

from mdr.explorer import look
from mdr.explorer.links import link_of, python_of
from mdr.explorer.pictures import Picture, pictures_of
from mdr.explorer.state import State
from mdr.files.examples import example_file

CODE = (
    "textarea { font: 12px ui-monospace, monospace; color: #222 !important; opacity: 1 !important; white-space: pre; }"
)
LINK = "history.replaceState(null, '', location.pathname + (cb_obj.value && '?' + cb_obj.value))"


class Keep:
    """Texts, link and files of the last picture. `load` takes the text and the name of a file that was brought."""

    def __init__(self, load: Callable[[bytes, str], Any]) -> None:
        self.picture: Picture | None = None
        self.toml, self.python = _text("TOML"), _text("Python")
        named = "Link to this state, also in the address bar"
        self.link: Any = pn.widgets.TextInput(name=named, disabled=True, margin=5, **look.WIDE)
        self.link.jscallback(value=LINK)
        given: Any = pn.widgets.FileInput(accept=".toml", margin=5, css_classes=["upload", "case"])
        given.param.watch(lambda event: event.new is not None and load(event.new, given.filename or "file"), "value")
        files = pn.FlexBox(
            _file("Case (TOML)", "case.toml", lambda: StringIO(self.toml.value)),
            _file("Curve (SVG)", "curve.svg", lambda: self._svg(lambda picture: _bounded(picture).plot().figure)),
            _file("Springs and forces (SVG)", "run.svg", lambda: self._svg(lambda picture: picture.run.plot())),
            pn.pane.HTML("load a case:", margin=(8, 0, 8, 12)), given, align_items="center",
        )  # fmt: skip
        texts = [pn.Column(text, _copy(text), styles={"flex": "1 1 340px"}) for text in (self.toml, self.python)]
        self.view = look.area("files", look.heading("To keep"), files, self.link, pn.FlexBox(*texts, gap="12px"))

    def write(self, state: State) -> None:
        """The texts of a state."""
        self.toml.value, self.python.value, self.link.value = example_file(state.case), python_of(state), link_of(state)

    def _svg(self, draw: Callable[[Picture], Any]) -> BytesIO:
        """A figure of the project's plots."""
        from matplotlib import pyplot as plt

        out = BytesIO()
        if self.picture is not None:
            drawn = draw(self.picture)
            drawn.savefig(out, format="svg")
            plt.close(drawn)
        out.seek(0)
        return out


def _bounded(picture: Picture) -> Any:
    """The curve whose error is bounded."""
    return picture.curve or [*pictures_of(picture.state)][-1].curve


def _file(label: str, name: str, make: Callable[[], Any]) -> Any:
    return pn.widgets.FileDownload(callback=make, filename=name, label=label, margin=5)


def _text(name: str) -> Any:
    return pn.widgets.TextAreaInput(name=name, rows=16, disabled=True, stylesheets=[CODE], margin=5, **look.WIDE)


def _copy(text: Any) -> Any:
    button = pn.widgets.Button(name=f"Copy {text.name}", margin=5)
    button.jscallback(clicks="navigator.clipboard.writeText(text.value)", args={"text": text})
    return button
