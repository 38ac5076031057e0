"""README as a package index shows it: its pictures and links are absolute, or left out while there is no address."""

import re
from pathlib import Path
from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface

RELATIVE = re.compile(r"(!?)\[([^\]]*)\]\((?!https?:|#|mailto:)([^)\s]+)\)")  #: picture or link, words, target


class Readme(MetadataHookInterface):
    """Hook of the build: the field readme of the metadata."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Fill it, with the address Source of [project.urls] where there is one."""
        source = metadata.get("urls", {}).get("Source", "")
        text = Path(self.root, "README.md").read_text(encoding="utf-8")
        text = for_an_index(text, source, f"v{metadata['version']}")
        metadata["readme"] = {"content-type": "text/markdown", "text": text}


def for_an_index(text: str, source: str, tag: str) -> str:
    """The text without relative targets: they are files at a tag of the source, or words alone without one."""

    def put(found: re.Match[str]) -> str:
        picture, words, target = found.groups()
        if not source:
            return "" if picture else words
        return f"{picture}[{words}]({source.rstrip('/')}/{'raw' if picture else 'blob'}/{tag}/{target})"

    return RELATIVE.sub(put, text)
