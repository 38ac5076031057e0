"""Notebooks as pages. They are saved without outputs, so their code is run as the page is built."""

import ast
import base64
import contextlib
import io
import json
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from myst_parser.parsers.sphinx_ import MystParser
from sphinx.application import Sphinx

DPI = 110  #: of the pictures


class NotebookParser(MystParser):
    """A notebook read as the Markdown page that it amounts to."""

    supported = ("ipynb",)

    def parse(self, inputstring: str, document: Any) -> None:
        """Read one notebook."""
        import matplotlib as mpl

        cells = json.loads(inputstring)["cells"]
        backend = mpl.get_backend()
        mpl.use("template")  # plt.show() shows nothing
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            page = "\n\n".join(pieces(cells, document.settings.env.config.run_notebooks))
        mpl.use(backend)
        super().parse(page, document)


def pieces(cells: list[dict[str, Any]], run: bool) -> Iterator[str]:
    """The Markdown of every cell, and of what its code prints and draws if it is run."""
    names: dict[str, Any] = {"__name__": "__main__"}
    for cell in cells:
        source = "".join(cell["source"])
        if cell["cell_type"] == "code":
            yield f"````python\n{source}\n````"
            if run:
                yield from shown(source, names)
        else:
            yield source


def shown(source: str, names: dict[str, Any]) -> Iterator[str]:
    """Run a cell: its text, its pictures, and the picture that its last line may be."""
    from matplotlib import pyplot as plt

    tree = ast.parse(source)
    last = tree.body.pop().value if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    value = None
    with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()):
        exec(compile(tree, "notebook", "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last), "notebook", "eval"), names)
    if text := out.getvalue().rstrip():
        yield f"````text\n{text}\n````"
    for number in plt.get_fignums():
        drawn = io.BytesIO()
        plt.figure(number).savefig(drawn, format="png", dpi=DPI)
        yield picture("image/png", drawn.getvalue())
    plt.close("all")
    if value is not None and (path := Path(str(getattr(value, "path", "")))).suffix == ".gif":
        yield picture("image/gif", path.read_bytes())


def picture(kind: str, data: bytes) -> str:
    """A picture within the page."""
    return f"![drawn by the code above](data:{kind};base64,{base64.b64encode(data).decode()})"


def setup(app: Sphinx) -> dict[str, bool]:
    """Read .ipynb beside .md."""
    app.add_config_value("run_notebooks", True, "env", bool)
    app.add_source_suffix(".ipynb", "ipynb")
    app.add_source_parser(NotebookParser)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
