"""Work on the latest request only, in a thread beside the page."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from threading import Event, Lock, Thread
from typing import Generic, TypeVar

Request = TypeVar("Request")
Answer = TypeVar("Answer")


class Superseded(Exception):
    """A newer request has come, or nobody waits for an answer any more."""


class Latest(Generic[Request, Answer]):
    """Answers requests one at a time. A newer one ends the work on an older one, whose answers are dropped.

    `work(request, watch)` yields answers and calls `watch` now and then, which raises `Superseded`. `deliver(request,
    answer)` is called in the thread of the work, with the exception where the work raised one and None at its end.
    After each answer the work rests for `rest` seconds, so that the page can show it, and a newer request come.
    """

    def __init__(
        self,
        work: Callable[[Request, Callable[[], None]], Iterable[Answer]],
        deliver: Callable[[Request, Answer | Exception | None], None],
        rest: float = 0.0,
    ) -> None:
        self.work, self.deliver, self.rest = work, deliver, rest
        self.lock, self.newer = Lock(), Event()
        self.waiting: list[Request] = []
        self.busy = self.dropped = False

    def drop(self) -> None:
        """Work on nothing more, until asked again."""
        with self.lock:
            self.waiting, self.dropped = [], self.busy
            self.newer.set()

    def ask(self, request: Request) -> None:
        """Work on this request next, and on no older one."""
        with self.lock:
            self.waiting = [request]
            self.newer.set()
            if self.busy:
                return
            self.busy = True
        Thread(target=self._run, daemon=True).start()

    def _run(self) -> None:
        while (request := self._next()) is not None:
            try:
                for answer in self.work(request[0], self._watch):
                    self._watch()
                    self.deliver(request[0], answer)
                    self.newer.wait(self.rest)
                self._watch()
                self.deliver(request[0], None)
            except Superseded:
                continue
            except Exception as fault:  # whatever it is, the page says so and goes on
                self.deliver(request[0], fault)

    def _next(self) -> list[Request] | None:
        with self.lock:
            request, self.waiting, self.dropped = self.waiting, [], False
            self.newer.clear()
            self.busy = bool(request)
            return request or None

    def _watch(self) -> None:
        if self.waiting or self.dropped:
            raise Superseded
