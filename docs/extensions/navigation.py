"""Fills in the order of the pages, at the foot of the first one, and the records of a module in the reference."""

from __future__ import annotations

import re
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # tests read pages where sphinx is not installed
    from sphinx.application import Sphinx


def add_contents(app: Sphinx, page: str, source: list[str]) -> None:
    """Behind the text of the first page: one hidden table of contents a heading."""
    if page != app.config.root_doc:
        return
    for heading, pages in app.config.PAGES.items():
        entries = "\n".join(pages)
        source[0] += f"\n```{{toctree}}\n:hidden:\n:caption: {heading}\n\n{entries}\n```\n"


def with_records(text: str) -> str:
    """In place of `.. autoclass:: mdr.indenters.*` a line for each name of the module that the text does not have."""

    def lines(found: re.Match[str]) -> str:
        names = [f"mdr.{name}" for name in import_module(found[1]).__all__]
        return "\n".join(f".. autoclass:: {name}" for name in names if f":: {name}\n" not in text)

    return re.sub(r"^\.\. autoclass:: (\S+)\.\*$", lines, text, flags=re.MULTILINE)


def add_records(app: Sphinx, page: str, source: list[str]) -> None:
    """As `with_records`."""
    source[0] = with_records(source[0])


def setup(app: Sphinx) -> dict[str, bool]:
    """Listen to the reading of pages."""
    app.add_config_value("PAGES", {}, "env", dict)
    app.connect("source-read", add_contents)
    app.connect("source-read", add_records)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
