"""The order of the pages, from conf.py to the foot of the first one, so that this stays plain Markdown."""

from sphinx.application import Sphinx


def add_contents(app: Sphinx, page: str, source: list[str]) -> None:
    """Behind the text of the first page: one hidden table of contents a heading."""
    if page != app.config.root_doc:
        return
    for heading, pages in app.config.PAGES.items():
        entries = "\n".join(pages)
        source[0] += f"\n```{{toctree}}\n:hidden:\n:caption: {heading}\n\n{entries}\n```\n"


def setup(app: Sphinx) -> dict[str, bool]:
    """Listen to the reading of pages."""
    app.add_config_value("PAGES", {}, "env", dict)
    app.connect("source-read", add_contents)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
