"""Compilation by numba. The compiled code is kept on disk for the next process, wherever a folder can be written.

What takes long is said on standard error: the first run on a machine waits for it, nearly a minute on one core.
"""

from __future__ import annotations

import sys
import time
import warnings
from collections.abc import Callable
from typing import Any

from numba import njit
from numba.core import event

from mdr.tools.progress import BETWEEN, PATIENCE

Function = Callable[..., Any]

FUNCTIONS = 80  #: that all kinds of runs need together


def compiled(**options: Any) -> Callable[[Function], Function]:
    """Decorator: numba's njit with these options.

    What it compiles is kept beside the source, or else in the cache folder of the user, or in NUMBA_CACHE_DIR. Where
    none of them can be written to, as in some containers and on some nodes of clusters, every process compiles for
    itself, and a warning says so.
    """

    def wrap(function: Function) -> Function:
        ready: Function
        try:
            ready = njit(cache=True, **options)(function)
        except RuntimeError:  # "no locator available"
            warnings.warn(
                "compiled kernels cannot be kept, as no folder for them can be written to: every process compiles its "
                "own, which takes nearly a minute of one core; let NUMBA_CACHE_DIR name a folder that can"
            )
            ready = njit(**options)(function)
        return ready

    return wrap


class Notice(event.Listener):
    """Says on standard error how many functions of this package have been compiled, if it takes long."""

    def __init__(self) -> None:
        self.next, self.open, self.done = 0.0, 0, 0

    def on_start(self, event: Any) -> None:
        """A function begins to be compiled, perhaps within another."""
        if not _is_ours(event):
            return
        if not self.open:
            self.next = max(self.next, time.monotonic() + PATIENCE)
        self.open += 1

    def on_end(self, event: Any) -> None:
        """It is compiled."""
        if not _is_ours(event):
            return
        self.open -= 1
        self.done += 1
        now = time.monotonic()
        if now > self.next:
            self.next = now + BETWEEN
            done = f"{self.done} of at most some {FUNCTIONS} functions, which take nearly a minute of one core"
            print(f"compiling, once on this machine: {done}", file=sys.stderr, flush=True)


def _is_ours(event: Any) -> bool:
    return str(event.data["dispatcher"].py_func.__module__).startswith("mdr.")


event.register("numba:compile", Notice())  # type: ignore[no-untyped-call]
