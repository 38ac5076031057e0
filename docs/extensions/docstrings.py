"""Docstrings of mdr are plain text: paragraphs, indented formulas, lists with *, names in backticks.

Fields of records tell themselves, by their facts.
"""

import inspect
import re
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from itertools import groupby
from typing import Any

from sphinx.application import Sphinx

from mdr.tools.fields import facts_of

MOST = 100  #: characters of a signature
NAME = re.compile(r"``([^`]+)``|`([^`]+)`")


def reading(lines: list[str]) -> Iterator[str]:
    """The lines of a docstring as reStructuredText that looks like them."""
    for kind, group in groupby(_marked(lines), key=lambda marked: marked[0]):
        block = [line for _, line in group]
        if kind == "formula":
            yield from ["", "::", "", *block, ""]
        else:
            yield from (_escaped(line) for line in block)


def _marked(lines: list[str]) -> list[tuple[str, str]]:
    """Each line with what it belongs to, "formula" or "text"; blank lines go with what stands above."""
    marked: list[tuple[str, str]] = []
    kind, in_list = "text", False
    for line in lines:
        if line.strip():
            in_list = line.startswith("* ") or (in_list and line.startswith("  ") and not line.startswith("    "))
            kind = "formula" if line.startswith("    ") and not in_list else "text"
        marked.append((kind, line))
    return marked


def _escaped(line: str) -> str:
    """Nothing but names in backticks is markup."""
    indent, bullet, rest = re.fullmatch(r"(\s*)(\* )?(.*)", line).groups()
    out, end = [indent, bullet or ""], 0
    for name in NAME.finditer(rest):
        out += [_plain(rest[end : name.start()]), f"``{name[1] or name[2]}``"]
        end = name.end()
        if rest[end : end + 1].isalnum():
            out.append("\\ ")
    return "".join([*out, _plain(rest[end:])])


def _plain(text: str) -> str:
    return re.sub(r"([\\*|_`:<])", r"\\\1", text)


def _own_fields(record: Any) -> Iterator[str]:
    """The fields that a record declares, as attributes with the meaning and unit that their facts tell."""
    for field in fields(record) if is_dataclass(record) else ():
        told = str(facts_of(field))
        if told and field.name in inspect.get_annotations(record):
            yield from ["", f".. py:attribute:: {field.name}", "", f"   {_plain(told)}", ""]


def set_docstring(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """In place, as autodoc asks for it."""
    lines[:] = [*reading(lines), *(_own_fields(obj) if what == "class" else ())]


def set_signature(
    app: Sphinx, what: str, name: str, obj: Any, options: Any, signature: str | None, answer: str | None
) -> tuple[str | None, str | None]:
    """A default that a factory makes, as one would write it; none for a record too long to be made by hand."""
    if what == "class" and signature and len(signature) > MOST:
        return "", answer
    return (signature and signature.replace("<factory>", "RigidPull()")), answer


def setup(app: Sphinx) -> dict[str, bool]:
    """Listen to autodoc."""
    app.connect("autodoc-process-docstring", set_docstring)
    app.connect("autodoc-process-signature", set_signature)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
