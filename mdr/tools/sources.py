"""The sources of this package as they were when it was imported: which of them are compiled, and a hash of some."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from functools import cache
from hashlib import sha256
from pathlib import Path

_HOUSE = Path(__file__).parent.parent
_IMPORT = re.compile(r"^[ \t]*(?:from|import)[ \t]+([\w.]+)(?:[ \t]+import[ \t]+(\([^)]*\)|.*))?", re.MULTILINE)


@cache
def texts() -> dict[str, str]:
    """The text of each module by its name, such as "mdr.tools.sources"; empty where no sources are installed."""
    found = {}
    for path in sorted(_HOUSE.rglob("*.py")):
        parts = (_HOUSE.name, *path.relative_to(_HOUSE).with_suffix("").parts)
        if all(part.isidentifier() for part in parts):  # no copies that an editor keeps
            found[".".join(parts).removesuffix(".__init__")] = path.read_text(encoding="utf-8")
    return found


@cache
def compiled() -> frozenset[str]:
    """The modules that use numba, and all that they import, as the numbers of those are compiled in."""
    found: set[str] = set()
    likely = [name for name, text in texts().items() if "numba" in text or "jit" in text]
    left = {name for name in likely if any(_compiles(one) for one in _imports(texts()[name]))}
    while left:
        found |= left
        left = {one for name in left for one in _imports(texts()[name])} & texts().keys() - found
    return frozenset(found)


def hash_of(names: Iterable[str]) -> str:
    """A hash of the texts of these modules, on all systems the same."""
    return sha256(json.dumps([(name, texts()[name]) for name in sorted(names)]).encode("ascii")).hexdigest()[:16]


def _imports(text: str) -> set[str]:
    """What a text imports, by full names; of `from a import b`, both a and a.b."""
    return {name for a, b in _IMPORT.findall(text) for name in (a, *(f"{a}.{one}" for one in re.findall(r"\w+", b)))}


def _compiles(name: str) -> bool:
    return name == "mdr.tools.jit" or name.partition(".")[0] == "numba"
