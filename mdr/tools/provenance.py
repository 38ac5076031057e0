"""What made a file: the command and the versions, in the form that each kind of file keeps them."""

from __future__ import annotations

import platform

from mdr.tools.version import version_of

PARTS = ("numpy", "scipy", "numba", "matplotlib")  #: whose versions can move a digit or a figure


def versions() -> str:
    """Versions of this library and of what it computes with, in one line."""
    parts = [f"{name} {version_of(name)}" for name in PARTS]
    return ", ".join([f"mdr {version_of('mdr-friction')}", *parts, f"Python {platform.python_version()}"])


def commented(*texts: str) -> str:
    """Texts as lines behind a #, for the head of a CSV file."""
    lines = [line for text in texts for line in text.splitlines() or [""]]
    return "".join(f"# {line}".rstrip() + "\n" for line in lines)


def figure_metadata(kind: str, command: str) -> dict[str, str | None]:
    """Metadata for `savefig` of a "png" or "svg", without the date: the same input gives the same bytes."""
    if kind == "svg":
        return {"Creator": versions(), "Description": command, "Date": None}
    return {"Software": versions(), "Description": command}
