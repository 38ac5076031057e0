"""Claims that are done are kept until the report is: a run that was stopped goes on from them.

A claim is kept as one file in `kept/` of the report's folder, under a key: a hash of all that it may stand on, the
sources of `mdr`, of the claims and of the scripts, the versions of what computes, and the effort. A claim of another
key is left alone, and computed anew. A complete report forgets its claims, so that the next run tests them all again.
"""

import importlib
import pickle
from collections.abc import Iterable
from contextlib import suppress
from hashlib import sha256
from io import BytesIO
from pathlib import Path
from typing import Any

from mdr.tools.atomic_write import write_whole
from mdr.tools.provenance import versions
from validation import Outcome
from validation.report import Check, Claim, Equation, Figure, Part

OF_THE_PAGE = (".css", ".html", ".js")  #: files that no number stands on
DIGEST = 32  #: bytes before the claim, of its SHA-256


class Kept:
    """The claims in the folder of a report that were tested with the sources as they are."""

    def __init__(self, report: Path, package: str, effort: str) -> None:
        self.folder, self.package, self.effort = report / "kept", package, effort
        self.key = key_of(package, effort)

    def read(self, names: Iterable[str]) -> dict[str, Outcome]:
        """Those of these claims that are there, whole and of this key."""
        found = {}
        for name in names:
            with suppress(Exception):  # whatever a reader meets in bytes that are none
                data = self._path(name).read_bytes()
                if sha256(data[DIGEST:]).digest() == data[:DIGEST]:
                    found[name] = _Claims(BytesIO(data[DIGEST:])).load()
        return found

    def write(self, name: str, outcome: Outcome) -> None:
        """Keep a claim, unless it broke off, or the sources were edited meanwhile."""
        if not outcome.trace and key_of(self.package, self.effort) == self.key:
            self.folder.mkdir(parents=True, exist_ok=True)
            data = pickle.dumps(outcome)
            write_whole(self._path(name), sha256(data).digest() + data)

    def forget(self, names: Iterable[str]) -> None:
        """Remove these claims, of any key."""
        for name in names:
            for path in self.folder.glob(f"{name}.*"):
                path.unlink(missing_ok=True)
        with suppress(OSError):  # none, or others are left
            self.folder.rmdir()

    def _path(self, name: str) -> Path:
        return self.folder / f"{name}.{self.key}"


class _Claims(pickle.Unpickler):
    """Reads outcomes and what they are made of, and nothing else."""

    def find_class(self, module: str, name: str) -> Any:
        parts = {(one.__module__, one.__name__): one for one in (Outcome, Claim, Part, Check, Figure, Equation)}
        return parts[module, name]


def key_of(package: str, effort: str) -> str:
    """A hash of all that the claims of a package may stand on."""
    own = Path(str(importlib.import_module(package).__file__)).parent
    house = Path(__file__).parents[1]
    state = sha256(f"{versions()} {effort}".encode())
    for folder in dict.fromkeys((house / "mdr", house / "geometries", house / "validation", own)):
        for path in sorted(folder.rglob("*")):
            if path.is_file() and path.suffix not in OF_THE_PAGE and "__pycache__" not in path.parts:
                state.update(f"{path.relative_to(folder.parent)}".encode() + sha256(path.read_bytes()).digest())
    return state.hexdigest()[:16]
