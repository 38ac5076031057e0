"""Chunks computed by an executor: threads, or any executor of concurrent.futures that the user gives."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from itertools import islice
from threading import Event
from typing import Any

from mdr.studies.cut import Cut
from mdr.studies.points import Part, compute
from mdr.studies.work import Work

MOST_IN_FLIGHT = 1024  #: chunks that an executor of the user is given at a time


class WorkersLost(Exception):
    """Raised where an executor has lost its processes and cannot go on."""


def run(work: Work, cut: Cut, chunks: Iterable[int], executor: Any, take: Callable[[int, Part], None]) -> None:
    """Compute chunks in any order; `take(chunk, part)` is called here for each that is finished.

    Raises WorkersLost where the workers are. What `take` or the work itself raises ends the run.
    """
    from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Future, ThreadPoolExecutor, wait

    ended, n_threads = Event(), cores()
    threads = ThreadPoolExecutor(n_threads) if executor is None else None
    pool = threads or executor
    most = n_threads + 2 if threads else MOST_IN_FLIGHT
    stop = (ended,) if isinstance(pool, ThreadPoolExecutor) else ()  # an event cannot be sent to other processes
    waiting: dict[Future[Part], int] = {}
    remaining = iter(chunks)
    try:
        while True:
            for chunk in islice(remaining, most - len(waiting)):
                waiting[pool.submit(compute, work, *cut.units(chunk), *stop)] = chunk
            if not waiting:
                return
            for future in wait(waiting, return_when=FIRST_COMPLETED).done:
                take(waiting.pop(future), future.result())
    except (BrokenExecutor, CancelledError) as error:
        raise _lost(error) from error
    except Exception as error:
        if type(error).__name__ == "KilledWorker":  # of distributed, which is not imported here
            raise _lost(error) from error
        if "pickle" in str(error) or "local object" in str(error):
            error.add_note("what is sent to other processes must be defined at the top of a module")
        raise
    finally:
        ended.set()
        for future in waiting:
            future.cancel()
        if threads is not None:
            threads.shutdown(cancel_futures=True)


def cores() -> int:
    """How many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _lost(error: BaseException) -> WorkersLost:
    return WorkersLost(f"the workers were lost, as when one is killed or runs out of memory ({error})")
