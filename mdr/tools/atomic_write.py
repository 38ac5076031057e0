"""Atomic writes: a file is there whole or not at all. It is written beside its place, synced and renamed."""

from __future__ import annotations

import errno
import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

_PART = ".part"


def write_whole(path: Path, data: bytes) -> None:
    """Write or replace a file in one instant."""
    with _beside(path, data) as partial:
        os.replace(partial, path)
    _sync_folder(path.parent)


def write_once(path: Path, data: bytes) -> bool:
    """Write a file in one instant unless it exists; True if written. Of several writers one succeeds."""
    with _beside(path, data) as partial:
        try:
            os.link(partial, path)
        except FileExistsError:
            return False
        except OSError:  # a file system without links: of several at one instant, the last would win
            if path.exists():
                return False
            os.replace(partial, path)
    _sync_folder(path.parent)
    return True


def is_partial(name: str) -> bool:
    """True if a file of this name was left by a write that was cut off."""
    return name.startswith(".") and name.endswith(_PART)


@contextmanager
def _beside(path: Path, data: bytes) -> Iterator[Path]:
    """Write the data to a temporary file in the same folder and sync it; the file is removed at the end."""
    partial = path.parent / f".{path.name}-{os.getpid()}-{secrets.token_hex(4)}{_PART}"
    if not path.parent.is_dir():
        raise FileNotFoundError(errno.ENOENT, "no such folder", str(path.parent))
    try:
        with open(partial, "xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        yield partial
    finally:
        with suppress(OSError):
            partial.unlink(missing_ok=True)


def _sync_folder(folder: Path) -> None:
    """Sync the names in a folder to the disk, where the system can."""
    if os.name == "nt":
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        with suppress(OSError):
            os.fsync(descriptor)
    finally:
        os.close(descriptor)
