"""Progress on standard error for everything that lasts; silence for what is over within two seconds."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator, Sequence
from typing import TypeVar

T = TypeVar("T")

PATIENCE = 2.0  #: s before the first word
BETWEEN = 10.0  #: s between plain lines


def progress(items: Sequence[T], what: str) -> Iterator[T]:
    """Iterate, with a bar after two seconds when standard error is a terminal, and plain lines when it is none."""
    if sys.stderr.isatty():
        from tqdm import tqdm

        yield from tqdm(items, desc=what, delay=PATIENCE, leave=False)
        return
    ticker = Ticker(what, len(items))
    for item in items:
        yield item
        ticker.tick()


class Ticker:
    """Says now and then how far something has got whose end may be unknown."""

    def __init__(self, what: str, total: int | None = None) -> None:
        self.what, self.total, self.done = what, total, 0
        self.next = time.monotonic() + PATIENCE

    def tick(self) -> None:
        """One more part is done."""
        self.done += 1
        if time.monotonic() > self.next and self.done != self.total:
            self.next = time.monotonic() + BETWEEN
            of = "" if self.total is None else f" of {self.total}"
            print(f"{self.what}: {self.done}{of}", file=sys.stderr, flush=True)
