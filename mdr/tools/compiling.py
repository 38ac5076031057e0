"""How far this process has got with compiling: jit.py counts, and whoever asks need not import what compiles."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass


@dataclass
class Tally:
    """Functions of this package."""

    done: int = 0  #: that have been compiled
    open: int = 0  #: that are being compiled, one within another
    since: float = 0.0  #: instant [s] from which on they are
    took: float = 0.0  #: time [s] that those before took
    in_python: float = 0.0  #: time [s] that functions took as Python, before they were compiled
    is_told: bool = True  #: whether it is said how many

    def begin(self) -> None:
        """One more is being compiled."""
        if not self.open:
            self.since = time.monotonic()
        self.open += 1

    def end(self, done: int = 1) -> None:
        """It is compiled; or, where none is done, has run as Python."""
        self.open -= 1
        self.done += done
        if not self.open:
            self.took += time.monotonic() - self.since

    @property
    def clock(self) -> float:
        """Time [s] that stands still while something is compiled."""
        return (self.since if self.open else time.monotonic()) - self.took


TALLY = Tally()


@contextmanager
def unsaid() -> Iterator[None]:
    """Nothing is told inside, where who compiles on purpose says how far it has got."""
    TALLY.is_told = False
    try:
        yield
    finally:
        TALLY.is_told = True
