"""Progress on standard error for everything that lasts; silence for what is over within two seconds.

A terminal gets a bar, anything else plain lines; both tell how much is done and about how long the rest takes.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, TypeVar

T = TypeVar("T")

PATIENCE = 2.0  #: s before the first word
BETWEEN = 10.0  #: s between plain lines

_deadline: ContextVar[float] = ContextVar("deadline", default=float("inf"))
_watch: ContextVar[Callable[[], None] | None] = ContextVar("watch", default=None)


def progress(items: Sequence[T], what: str) -> Iterator[T]:
    """Iterate, with a bar after two seconds when standard error is a terminal, and plain lines when it is none."""
    meter = Meter(what, len(items))
    try:
        for item in items:
            yield item
            meter.tick()
    finally:
        meter.close()


@contextmanager
def silent(watch: Callable[[], None]) -> Iterator[None]:
    """Nothing inside speaks; at each of its ticks `watch` is called instead, and may end the work by raising."""
    token = _watch.set(watch)
    try:
        yield
    finally:
        _watch.reset(token)


@contextmanager
def time_limit(seconds: float | None) -> Iterator[None]:
    """Within it `time_is_over` after so many seconds, or when that of an outer limit is over; None sets no limit."""
    token = _deadline.set(min(_deadline.get(), float("inf") if seconds is None else time.monotonic() + seconds))
    try:
        yield
    finally:
        _deadline.reset(token)


def time_is_over() -> bool:
    """Whether the time that was given for this work is over."""
    return time.monotonic() > _deadline.get()


class Meter:
    """How many of so many parts are done: a bar, or a line now and then."""

    def __init__(self, what: str, total: int, parts: str = "", done: int = 0) -> None:
        self.bar: Any = None
        if sys.stderr.isatty() and _watch.get() is None:
            from tqdm import tqdm

            self.bar = tqdm(desc=what, total=total, initial=done, unit=f" {parts or 'it'}", delay=PATIENCE, leave=False)
        self.ticker = Ticker(what, total, parts, done)

    def tick(self) -> None:
        """One more part is done."""
        if self.bar is None:
            self.ticker.tick()
        else:
            self.bar.update()

    def close(self) -> None:
        """Take the bar off the terminal."""
        if self.bar is not None:
            self.bar.close()


class Ticker:
    """Says now and then how far something has got whose end may be unknown; `done` parts were there before."""

    def __init__(self, what: str, total: int | None = None, parts: str = "", done: int = 0) -> None:
        self.what, self.total, self.parts = what, total, parts
        self.done, self.before, self.watch = done, done, _watch.get()
        self.start = time.monotonic()
        self.next = self.start + PATIENCE

    def tick(self, parts: int = 1) -> None:
        """One more part is done, or several."""
        self.done += parts
        if self.watch is not None:
            self.watch()
            return
        now = time.monotonic()
        if now > self.next and self.done != self.total:
            self.next = now + BETWEEN
            print(f"{self.what}: {self.done}{self._rest(now)}", file=sys.stderr, flush=True)

    def _rest(self, now: float) -> str:
        if self.total is None:
            return ""
        left = (now - self.start) / (self.done - self.before) * (self.total - self.done)
        return f" of {self.total}{f' {self.parts}' if self.parts else ''}, about {in_words(left)} left"


def in_words(seconds: float) -> str:
    """A time in the unit that suits it."""
    for unit, length, most in (("s", 1, 100), ("min", 60, 100), ("h", 3600, 50)):
        if seconds < most * length:
            return f"{seconds / length:.0f} {unit}"
    return f"{seconds / 86400:.0f} days"
