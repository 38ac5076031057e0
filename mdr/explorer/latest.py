"""Work on the latest request only, in a thread beside the page."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from threading import Event, Lock, Thread
from typing import Generic, TypeVar

from mdr.tools.progress import Ended, unless

Request = TypeVar("Request")
Answer = TypeVar("Answer")


class Latest(Generic[Request, Answer]):
    """Answers requests one at a time. A newer one ends the work on an older one, whose answers are dropped.

    `work(request, watch)` yields answers and calls `watch` now and then, which raises `Ended`. `deliver(request,
    answer)` is called in the thread of the work, with the exception where the work raised one and None at its end.
    """

    def __init__(
        self,
        work: Callable[[Request, Callable[[], None]], Iterable[Answer]],
        deliver: Callable[[Request, Answer | Exception | None], None],
    ) -> None:
        self.work, self.deliver = work, deliver
        self.at_work, self.superseded = Lock(), Event()

    def drop(self) -> None:
        """Work on nothing more, until asked again."""
        self.superseded.set()

    def ask(self, request: Request) -> None:
        """Work on this request next, and on no older one."""
        self.superseded.set()
        self.superseded = Event()
        Thread(target=self._run, args=(request, self.superseded), daemon=True).start()

    def _run(self, request: Request, superseded: Event) -> None:
        watch = unless(superseded)
        with self.at_work:
            try:
                watch()
                for answer in self.work(request, watch):
                    watch()
                    self.deliver(request, answer)
                watch()
                self.deliver(request, None)
            except Ended:
                pass
            except Exception as fault:  # whatever it is, the page says so and goes on
                self.deliver(request, fault)
