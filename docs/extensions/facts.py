"""Fields of records as attributes, with the meaning and unit that stand at the field."""

import inspect
from dataclasses import fields, is_dataclass
from typing import Any

from sphinx.application import Sphinx

from mdr.tools.fields import facts_of


def add_fields(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """At the end of the docstring of a record, the fields that it declares."""
    if what != "class" or not is_dataclass(obj):
        return
    for field in fields(obj):
        told = str(facts_of(field))
        if told and field.name in inspect.get_annotations(obj):
            lines += ["", f".. py:attribute:: {field.name}", "", f"   {told.replace('*', chr(92) + '*')}", ""]


def setup(app: Sphinx) -> dict[str, bool]:
    """Listen to autodoc, after numpydoc has set the docstring."""
    app.connect("autodoc-process-docstring", add_fields, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
