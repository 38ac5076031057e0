"""What one takes from the page: the case as a file and as Python, a link, figures."""

from __future__ import annotations

from collections.abc import Callable
from io import StringIO
from typing import Any

import panel as pn

from mdr.explorer import look
from mdr.explorer.links import link_of, python_of
from mdr.explorer.pictures import Picture, pictures_of
from mdr.explorer.scripts import COPY, LINK
from mdr.explorer.state import State
from mdr.files.examples import example_file

CODE = "textarea {{ font: 12px ui-monospace, monospace; color: #222; white-space: {}; }}"


class Keep:
    """Texts, link and files of the last picture. `go` takes the query of a state that the browser goes back to."""

    def __init__(self, go: Callable[[str], Any]) -> None:
        self.picture: Picture | None = None
        self.toml, self.python = _text("TOML", "pre"), _text("Python", "pre-wrap")
        named = "Link to this state, for this machine while the page is served; the browser's back undoes a change"
        shown: dict[str, Any] = {"css_classes": ["shown"], "stylesheets": [look.WRAPPED], "margin": 5, **look.WIDE}
        self.link: Any = pn.widgets.TextInput(name=named, **shown)
        back: Any = pn.widgets.TextInput(visible=False)
        back.param.watch(lambda event: event.new and go(event.new), "value")
        self.link.jscallback(value=LINK, args={"back": back})
        files = pn.FlexBox(
            _file("Case (TOML)", "case.toml", lambda: StringIO(self.toml.value)),
            _file("Curve (SVG)", "curve.svg", lambda: self._svg(_curve_of)),
            _file("Springs and forces (SVG)", "run.svg", lambda: self._svg(lambda picture: picture.run.plot())),
            _copy("link", self.link), back,
        )  # fmt: skip
        wide = {"flex": "1 1 340px"}
        texts = [pn.Column(text, _copy(text.name, text), styles=wide) for text in (self.toml, self.python)]
        self.view = look.area("files", look.heading("To keep"), files, self.link, pn.FlexBox(*texts, gap="12px"))

    def write(self, state: State) -> None:
        """The texts of a state."""
        query, host = link_of(state), pn.state.headers.get("Host", "")
        self.toml.value, self.python.value = example_file(state.case), python_of(state)
        self.link.value = query and f"http://{host}/?{query}"

    def _svg(self, draw: Callable[[Any], Any]) -> StringIO:
        """A figure of the project's plots."""
        from mdr.plots.figures import svg_of

        if self.picture is None:
            return StringIO()
        picture = _complete(self.picture)
        return StringIO(svg_of(lambda: draw(picture)))


def _complete(picture: Picture) -> Picture:
    """The picture with its run and a curve whose error is bounded."""
    return picture if picture.run and picture.curve else [*pictures_of(picture.state)][-1]


def _curve_of(picture: Picture) -> Any:
    """The figure of friction over velocity, with the axes of the page."""
    assert picture.curve is not None
    return picture.curve.plot(absolute=not picture.state.in_groups).figure


def _file(label: str, name: str, make: Callable[[], Any]) -> Any:
    return pn.widgets.FileDownload(callback=make, filename=name, label=label, margin=5)


def _text(name: str, wrap: str) -> Any:
    looks: dict[str, Any] = {"css_classes": ["shown"], "stylesheets": [CODE.format(wrap)], "margin": 5, **look.WIDE}
    return pn.widgets.TextAreaInput(name=name, rows=16, **looks)


def _copy(name: str, text: Any) -> Any:
    button = pn.widgets.Button(name=f"Copy {name}", margin=5)
    button.jscallback(clicks=COPY, args={"text": text, "button": button})
    return button
