"""Progress on standard error; nothing is printed by what ends within two seconds.

On a terminal a bar; anywhere else plain lines. Both tell how much is done, and about how long the rest takes.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from threading import Event
from typing import TypeVar

from mdr.tools.checks import positive
from mdr.tools.compiling import TALLY

T = TypeVar("T")


class Ended(Exception):
    """Work was ended before it was done, as nobody waits for it any more."""


PATIENCE = 2.0  #: s before the first word

_deadline: ContextVar[float] = ContextVar("deadline", default=float("inf"))
_watch: ContextVar[Callable[[], None] | None] = ContextVar("watch", default=None)


def progress(
    items: Iterable[T], what: str, parts: str = "", total: int | None = None, done: int = 0, alike: bool = True
) -> Iterator[T]:
    """Loop over items with progress: a bar on a terminal, plain lines elsewhere; parts: what the items are called.

    total: how many there are with those that are `done` before; None asks the items. alike: whether each takes about as
    long, so that the time of some tells that of the rest.
    """
    if total is None:
        total = len(items)  # type: ignore[arg-type]
    if sys.stderr.isatty() and _watch.get() is None:
        from tqdm import tqdm

        unit = f" {parts or 'it'}"
        bar = None if alike else "{l_bar}{bar}| {n_fmt}/{total_fmt} [{elapsed}]"
        yield from tqdm(
            items, desc=what, total=total, initial=done, unit=unit, delay=PATIENCE, leave=False, bar_format=bar
        )
        return
    ticker = Ticker(what, total, parts, done, alike)
    for item in items:
        yield item
        ticker.tick()


@contextmanager
def silent(watch: Callable[[], None]) -> Iterator[None]:
    """Print no progress inside. `watch` is called at each step instead; it may end the work by raising an error."""
    token = _watch.set(watch)
    try:
        yield
    finally:
        _watch.reset(token)


def unless(ended: Event) -> Callable[[], None]:
    """What `silent` calls for work to end by Ended, soon after the event is set."""

    def watch() -> None:
        if ended.is_set():
            raise Ended

    return watch


@contextmanager
def time_limit(seconds: float | None) -> Iterator[None]:
    """Limit of computing time, after which `time_is_over` is true; compiling does not count.

    None sets none; an earlier outer limit stays.
    """
    ends = float("inf") if seconds is None else TALLY.clock + positive("limit_s", seconds, "seconds")
    token = _deadline.set(min(_deadline.get(), ends))
    try:
        yield
    finally:
        _deadline.reset(token)


def time_is_over() -> bool:
    """True once the time limit of this work has passed."""
    return TALLY.clock > _deadline.get()


def tell(line: str) -> None:
    """Write a line on standard error, where there is one that somebody reads."""
    with suppress(OSError, ValueError):
        if sys.stderr is not None:
            print(line, file=sys.stderr, flush=True)


class Ticker:
    """Progress line for loops of any or unknown length, at most one every ten seconds; starts at `done` parts.

    clock: time [s] by which it goes, that which stands still while something is compiled, as this is once, and is told.
    """

    def __init__(
        self,
        what: str,
        total: int | None = None,
        parts: str = "",
        done: int = 0,
        alike: bool = True,
        clock: Callable[[], float] = lambda: TALLY.clock,
    ) -> None:
        self.what, self.total, self.parts, self.alike, self.clock = what, total, parts, alike, clock
        self.done, self.before, self.watch = done, done, _watch.get()
        self.start = clock()
        self.next = self.start + PATIENCE

    def tick(self, parts: int = 1) -> None:
        """One more part is done, or several."""
        self.done += parts
        if self.watch is not None:
            self.watch()
            return
        now = self.clock()
        if now > self.next and (self.total is None or self.done < self.total):
            self.next = now + 10.0  # s, between plain lines
            tell(f"{self.what}: {self.done}{self._rest(now)}")

    def _rest(self, now: float) -> str:
        parts = f" {self.parts}" if self.parts else ""
        if self.total is None:
            return f"{parts} so far"
        if not self.alike:
            return f" of {self.total}{parts}"
        left = (now - self.start) / (self.done - self.before) * (self.total - self.done)
        return f" of {self.total}{parts}, about {in_words(left)} left"


def in_words(seconds: float) -> str:
    """A duration with a unit that suits it: 90 s, 5 min, 3 h, 4 days."""
    for unit, length, most in (("s", 1, 100), ("min", 60, 100), ("h", 3600, 50)):
        if seconds < most * length:
            return f"{seconds / length:.0f} {unit}"
    return f"{seconds / 86400:.0f} days"
