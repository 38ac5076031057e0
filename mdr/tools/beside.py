"""Another process, of low priority, that compiles what this one asks for, into the cache on disk.

It reads pickles of what is asked from its standard input and has no other tie to this process: no terminal, no pipe
out. LINGER seconds after its input has ended, as that does where this process is gone, it ends with the function that
it is at, as else short programs on a busy machine would never find one; and at once where what it made is not found on
disk. It stays in the process group of this one, and is ended with it. Of all such processes of a user one compiles at
a time: the others wait for its lock, which the system takes off one that was killed, and then find on disk what it has
done; for one that was stopped they do not wait for ever. Without `fcntl`, on Windows, there is no lock: two programs
that start at once compile twice.
"""

# mypy: disallow-untyped-calls=false
from __future__ import annotations

import os
import pickle
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path
from queue import Queue
from threading import Lock, Thread
from typing import Any, NamedTuple

from mdr.tools.compiling import TALLY
from mdr.tools.progress import tell

LINGER = 30.0  #: s that it goes on after nobody waits for it, so that the next program finds more
PATIENT = 60.0  #: s that it waits for the lock, as who holds it may have been stopped
NICE = 5  #: which leaves it a third of the share of another process, where cores are busy
TOLD = "compiling in another process, once on this machine for each kind of run; until it is done, runs take longer"


class Code(NamedTuple):
    """Machine code of a compiled function for types of its arguments."""

    function: Any  #: of numba
    types: tuple[Any, ...]

    def is_there(self) -> bool:
        """Whether it is in memory, or on disk."""
        return self.types in self.function.overloads or self.is_kept()

    def can_be_kept(self) -> bool:
        """Whether there is a folder for it."""
        return hasattr(self.function._cache, "holds")

    def is_kept(self) -> bool:
        """Whether it is on disk."""
        return self.can_be_kept() and bool(self.function._cache.holds(self.types, self.function.targetctx))

    def __reduce__(self) -> Any:
        """By the name of the function in its module."""
        of = self.function.py_func
        return _code, (of.__module__, of.__qualname__, self.types)


def _code(module: str, name: str, types: tuple[Any, ...]) -> Code:
    return Code(getattr(import_module(module), name), types)


class Beside:
    """The process, which is started when something is asked for; none is where there is no core for it."""

    def __init__(self) -> None:
        self.process: subprocess.Popen[bytes] | None = None
        self.asked: set[Code] = set()
        self.lock = Lock()

    def ask(self, codes: Iterable[Code]) -> None:
        """Let it compile these, in this order, after what was asked before."""
        with self.lock:
            self._ask(codes)

    def _ask(self, codes: Iterable[Code]) -> None:
        new = [code for code in codes if code not in self.asked and code.can_be_kept()]
        if not new or cores() < 2 or not sys.executable:
            return
        if self.process is None:
            script = f"import sys; sys.path[:] = {sys.path!r}; from mdr.tools import beside; beside.main()"
            command, env = [sys.executable, "-c", script], {**os.environ, "MDR_COMPILE": "first"}
            none = subprocess.DEVNULL
            with suppress(OSError):
                self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=none, stderr=none, env=env)
            if TALLY.is_told and self.process is not None:
                tell(TOLD)
        if self.process is not None and self.process.stdin is not None:
            with suppress(OSError):  # it has ended
                self.process.stdin.write(b"".join(map(pickle.dumps, new)))
                self.process.stdin.flush()
        self.asked.update(new)

    def is_alive(self) -> bool:
        """Whether what was asked for may still come."""
        return self.process is not None and self.process.poll() is None

    def forget(self) -> None:
        """Leave it to the process of which this one is a fork."""
        if self.process is not None and self.process.stdin is not None:
            os.close(self.process.stdin.fileno())
        self.process, self.asked, self.lock = None, set(), Lock()


BESIDE = Beside()
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=BESIDE.forget)


def cores() -> int:
    """Number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def main() -> None:
    """Compile what is asked for, until there is no more."""
    with suppress(AttributeError, OSError):
        os.nice(NICE)
    asked: Queue[Code | None] = Queue()
    ended: list[float] = []  # when its input did
    Thread(target=_read, args=(asked, ended), daemon=True).start()
    with suppress(KeyboardInterrupt):
        while (code := asked.get()) is not None and not (ended and time.monotonic() > ended[0] + LINGER):
            with _alone():
                if not code.is_there():
                    code.function.compile(code.types)
                    if not code.is_kept():  # the disk is full, say
                        break


def _read(asked: Queue[Code | None], ended: list[float]) -> None:
    """Read what is asked for, until nobody asks."""
    with suppress(Exception):  # its end, or what cannot be found by its name
        while True:
            asked.put(pickle.load(sys.stdin.buffer))
    ended.append(time.monotonic())
    asked.put(None)


@contextmanager
def _alone() -> Iterator[None]:
    """Inside, no other such process of this user does the same."""
    try:
        import fcntl
    except ImportError:
        yield
        return
    with open(Path(tempfile.gettempdir()) / f"mdr-compiles-{os.getuid()}.lock", "w") as file:
        gives_up = time.monotonic() + PATIENT
        while time.monotonic() < gives_up:
            with suppress(BlockingIOError):
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                break
            time.sleep(0.1)
        yield
