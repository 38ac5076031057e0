"""The store of a study: a folder with its specification, and its chunks until they are merged into one file.

    study.json            specification and identity
    chunks/plan.json      how the work is cut
    chunks/000012.npz     a finished chunk, with its checksum
    study.nc              all of it, once no chunk is missing; the chunks are then removed

Every file appears whole or not at all, so that a kill at any instant costs only the chunks in flight. Several
processes may work on one store at a time: whoever finds that nothing is missing merges, all to the same bytes.
"""

from __future__ import annotations

import errno
import json
import os
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from hashlib import sha256
from io import BytesIO
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from mdr.studies.points import Part
from mdr.studies.specification import differences
from mdr.tools.atomic_write import is_partial, write_once, write_whole

_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
_READ_ONLY = (errno.EROFS, errno.EACCES, errno.EPERM)


class StudyError(RuntimeError):
    """A store that cannot be used or written, or a study that ended before its work was done."""


class Store:
    """A folder that one study is kept in."""

    def __init__(self, folder: str | PathLike[str]) -> None:
        self.folder = Path(folder)
        self.chunks = self.folder / "chunks"
        self.file = self.folder / "study.nc"
        self.n_kept, self.n_chunks = 0, 0  #: chunks that are there, of how many; for messages

    @property
    def kept(self) -> str:
        """Number of chunks that are there, in words; empty before they are counted."""
        return f"{self.n_kept} of {self.n_chunks} chunks are safe in {self.folder}" if self.n_chunks else ""

    # --- the study as a whole ---

    def open(self, head: Mapping[str, Any]) -> None:
        """Make the store of a study; if there is one, check that it is of the same study."""
        with self._told("study.json"):
            if self.folder.exists() and not self.folder.is_dir():
                raise StudyError(f"{self.folder}: is a file; give a folder for the store")
            self.folder.mkdir(parents=True, exist_ok=True)
            known = self.head()
            if known is None:
                self._refuse_strangers()
                text = json.dumps(head, indent=1, ensure_ascii=False, allow_nan=False)
                write_once(self.folder / "study.json", text.encode("utf-8"))
                known = self.head()
        if known is None or known["identity"] != head["identity"]:
            what = differences((known or {}).get("specification", {}), head["specification"])
            raise StudyError(f"{self.folder}: is the store of another study: {what}; give another folder")

    def head(self) -> dict[str, Any] | None:
        """Specification and identity of the study in the store; None where there is none."""
        path = self.folder / "study.json"
        try:
            head = json.loads(path.read_text(encoding="utf-8"))
            if not isinstance(head, dict) or not {"identity", "specification", "frame", "block"} <= head.keys():
                raise ValueError("it lacks what every study has")
        except (FileNotFoundError, NotADirectoryError):
            return None
        except ValueError as fault:
            raise StudyError(f"{path}: is damaged ({fault}); move the store away and repeat the call") from None
        return head

    def merged(self) -> bytes | None:
        """The finished study; None while chunks are missing."""
        try:
            return self.file.read_bytes()
        except (FileNotFoundError, NotADirectoryError):
            return None

    def merge(self, data: bytes) -> None:
        """Put the finished study in the place of its chunks."""
        with self._told("study.nc"):
            try:
                write_whole(self.file, data)
            except FileNotFoundError:  # another process merged, and cleared away the file just written
                if not self.file.exists():
                    raise
        self.clear()

    def clear(self) -> None:
        """Remove what a finished study no longer needs, and what killed processes left."""
        if self.chunks.exists():
            shutil.rmtree(self.chunks, ignore_errors=True)
        with suppress(OSError):
            for one in self.folder.iterdir():
                if is_partial(one.name):
                    one.unlink(missing_ok=True)

    # --- its chunks ---

    def require_writable(self) -> None:
        """Check before the work that its outcome can be written."""
        with self._told("chunks"):
            self.chunks.mkdir(exist_ok=True)
            write_whole(self.chunks / "plan.try", b"")
            (self.chunks / "plan.try").unlink(missing_ok=True)

    def plan(self) -> dict[str, int] | None:
        """How the work is cut; None before that is settled."""
        path = self.chunks / "plan.json"
        try:
            plan = json.loads(path.read_bytes())
            if min(plan["units_per_chunk"], plan["n_units"]) < 1:
                raise ValueError("nothing is planned")
            return {name: int(plan[name]) for name in ("units_per_chunk", "n_units")}
        except (FileNotFoundError, NotADirectoryError):
            return None
        except (ValueError, KeyError, TypeError):
            message = f"{path}: is damaged; remove the folder {self.chunks} and repeat the call"
            raise StudyError(message) from None

    def settle(self, plan: Mapping[str, int]) -> dict[str, int]:
        """Write down how the work is cut, unless another process has done so meanwhile; returns the cut that holds."""
        with self._told("plan.json"):
            write_once(self.chunks / "plan.json", json.dumps(dict(plan)).encode("ascii"))
        return self.plan() or dict(plan)

    def finished(self) -> set[int]:
        """Numbers of the chunks that are there."""
        try:
            names = os.listdir(self.chunks)
        except (FileNotFoundError, NotADirectoryError):
            return set()
        return {int(name[:-4]) for name in names if name.endswith(".npz") and name[:-4].isdigit()}

    def write(self, number: int, identity: str, part: Part) -> None:
        """Keep a finished chunk."""
        path = self._path(number)
        with self._told(path.name):
            try:
                write_whole(path, _packed(number, identity, part))
            except FileNotFoundError:  # another process has merged meanwhile
                if not self.file.exists():
                    raise
        self.n_kept += 1

    def read(self, number: int, identity: str, shape: tuple[int, int]) -> Part | None:
        """A chunk of (n_quantities, n_points); None for one that is damaged."""
        try:
            part = _unpacked(number, identity, self._path(number).read_bytes())
        except FileNotFoundError:
            raise
        except Exception:  # whatever a reader of archives meets in bytes that are none
            return None
        return part if part.values.shape == shape else None

    def _path(self, number: int) -> Path:
        return self.chunks / f"{number:06d}.npz"

    # --- what goes wrong ---

    def _refuse_strangers(self) -> None:
        names = sorted(name for name in os.listdir(self.folder) if not is_partial(name))
        if names and not (self.folder / "study.json").exists():
            some = ", ".join(names[:3]) + (", ..." if len(names) > 3 else "")
            raise StudyError(f"{self.folder}: holds other files ({some}) and no study.json; give an empty folder")

    @contextmanager
    def _told(self, name: str) -> Iterator[None]:
        """Errors of the system as what they mean for the study."""
        try:
            yield
        except OSError as error:
            what, safe = error.strerror or str(error), f"; {self.kept}" if self.kept else ""
            if error.errno in _FULL:
                message = f"no room to write {name} ({what}){safe}; free space and repeat the call"
            elif error.errno in _READ_ONLY:
                message = f"{name} cannot be written ({what}){safe}; make the folder writable, or give another store"
            else:
                message = f"{name} cannot be written ({what}){safe}; repeat the call once that is mended"
            raise StudyError(f"{self.folder}: {message}") from error


def _packed(number: int, identity: str, part: Part) -> bytes:
    """The bytes of a chunk, with a checksum over all that it says."""
    buffer, reasons = BytesIO(), json.dumps(part.reasons).encode("ascii")
    np.savez(
        buffer,
        values=part.values,
        status=part.status,
        reason=part.reason,
        reasons=np.frombuffer(reasons, dtype=np.uint8),
        checksum=np.frombuffer(_checksum(number, identity, part), dtype=np.uint8),
    )
    return buffer.getvalue()


def _unpacked(number: int, identity: str, data: bytes) -> Part:
    with np.load(BytesIO(data), allow_pickle=False) as file:
        reasons = tuple(json.loads(file["reasons"].tobytes()))
        part = Part(file["values"], file["status"], file["reason"], reasons)
        checksum = file["checksum"].tobytes()
    if checksum != _checksum(number, identity, part):
        raise ValueError("the checksum is another")
    return part


def _checksum(number: int, identity: str, part: Part) -> bytes:
    seal = sha256(json.dumps([number, identity, part.values.shape, part.reasons]).encode("ascii"))
    for array in (part.values, part.status, part.reason):
        seal.update(np.ascontiguousarray(array).tobytes())
    return seal.digest()
