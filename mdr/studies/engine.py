"""One call of sweep(): find what is there, compute what is missing in chunks, merge once all is there."""

from __future__ import annotations

import os
import sys
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import islice
from statistics import fmean
from threading import Event
from typing import Any

from mdr.studies.formats import packed, unpacked
from mdr.studies.points import SLOW, Part, compute
from mdr.studies.specification import identity_of, specification
from mdr.studies.store import Store, StudyError
from mdr.studies.study import Frame, Results, Study
from mdr.studies.work import Cut, Work
from mdr.tools.progress import Meter, in_words

TRIAL = 1.0  #: s in which units are timed
MOST_TRIALS = 32
LEAST_CHUNKS = 32  #: where there are so many units, so that several workers share them evenly
IN_MEMORY = 256  #: chunks of a study without a store
COARSE = 32  #: springs and steps of the run that compiles
MOST_IN_FLIGHT = 1024  #: chunks that an executor of the user is given at a time

GOLDEN = 0.6180339887498949


class Call:
    """One call of sweep(), on a store or in memory alone."""

    def __init__(self, work: Work, store: Store | None, executor: Any) -> None:
        self.work, self.store, self.executor = work, store, executor
        self.results = Results(work.layout, len(work.quantities))
        self.specification: dict[str, Any] = {}
        self.identity = ""
        try:
            self.specification = specification(work)
            self.identity = identity_of(self.specification)
        except ValueError:  # a function without a name, which only a store has to tell from others
            if store is not None:
                raise
        self.frame = Frame.of(work, self.identity)

    def study(self, chunk_seconds: float, shard: tuple[int, int]) -> Study:
        """The study; what is missing of this shard in the store is computed before."""
        try:
            return self._in_memory() if self.store is None else self._in_store(self.store, chunk_seconds, shard)
        except KeyboardInterrupt:
            print(f"sweep: interrupted; {self._kept}", file=sys.stderr)
            raise

    @property
    def _kept(self) -> str:
        if self.store is None:
            return "nothing is kept, as there is no store (store=, --store)"
        return f"{self.store.kept or 'nothing is computed yet'}; the same call goes on from there"

    def _in_memory(self) -> Study:
        n = self.work.layout.n_units
        cut = Cut(n, max(1, n // IN_MEMORY))
        self._compute(range(cut.n_chunks), cut, cut.n_chunks)
        return self.results.study(self.frame)

    def _in_store(self, store: Store, chunk_seconds: float, shard: tuple[int, int]) -> Study:
        head = {"identity": self.identity, "specification": self.specification, "frame": self.frame.tree()}
        store.open({**head, "block": self.work.layout.block})
        if (done := self._merged(store)) is not None:
            return done
        try:
            store.require_writable()
            return self._merged(store) or self._completed(store, self._cut(store, chunk_seconds), shard)
        except (StudyError, FileNotFoundError):  # another process may have merged, and removed the chunks
            if (done := self._merged(store)) is None:
                raise
            return done

    def _merged(self, store: Store) -> Study | None:
        """The finished study, with the records of the axes in the place of their labels."""
        data = store.merged()
        if data is None:
            return None
        try:
            study = unpacked(data)
        except ValueError as fault:
            raise StudyError(f"{store.file}: is {fault}; move it away and repeat the call") from fault
        if study.identity != self.identity:
            raise StudyError(f"{store.file}: is of another study than study.json beside it; give another folder")
        store.clear()
        return replace(study, frame=self.frame)

    def _cut(self, store: Store, chunk_seconds: float) -> Cut:
        """As the store has it, or as a trial finds; all processes on a store cut alike."""
        cut = store.plan() or store.settle(timed(self.work, chunk_seconds))
        if cut.n_units != self.work.layout.n_units:
            raise StudyError(f"{store.chunks}: its plan is of another study; remove that folder, repeat the call")
        return cut

    def _completed(self, store: Store, cut: Cut, shard: tuple[int, int]) -> Study:
        """The study once the chunks of the shard are there; merged if none is missing then."""
        k, n = shard
        own = range(k - 1, cut.n_chunks, n)
        missing, others = self._load(store, own, cut), [i for i in range(cut.n_chunks) if i not in own]
        self._compute(missing, cut, len(own))
        if others and store.finished().issuperset(others):
            self._compute(self._load(store, others, cut), cut, cut.n_chunks)  # what turns out to be damaged of these
        study = self.results.study(self.frame)
        if study.complete:
            store.merge(packed(study))
        return study

    def _load(self, store: Store, chunks: Sequence[int], cut: Cut) -> list[int]:
        """Put chunks that are in the store into the results; the others."""
        finished, missing = store.finished(), []
        store.n_kept, store.n_chunks = len(finished), cut.n_chunks
        for chunk in chunks:
            units = cut.units(chunk)
            part = store.read(chunk, self.identity, self.results.shape_of(units)) if chunk in finished else None
            if part is not None:
                self.results.put(units[0], part)
                continue
            missing.append(chunk)
            if chunk in finished:
                store.n_kept -= 1
                warnings.warn(f"{store.chunks}: chunk {chunk} is damaged and is computed again", stacklevel=6)
        return missing

    def _compute(self, chunks: Sequence[int], cut: Cut, total: int) -> None:
        """Compute chunks and keep each as soon as it is finished."""
        if not chunks:
            return
        meter = Meter("sweep", total, "chunks", done=total - len(chunks))
        slow: list[float] = []

        def take(chunk: int, part: Part) -> None:
            if self.store is not None:
                self.store.write(chunk, self.identity, part)
            self.results.put(cut.units(chunk)[0], part)
            slow.extend(part.slow)
            meter.tick()

        try:
            run(self.work, cut, chunks, self.executor, take)
        except Exception as error:
            if _lost(error):
                what = f"the workers were lost, as when one is killed or runs out of memory ({error})"
                raise StudyError(f"{what}; {self._kept}") from error
            if "pickle" in str(error) or "local object" in str(error):
                error.add_note("what is sent to other processes must be defined at the top of a module")
            raise
        finally:
            meter.close()
        if slow:
            cases = "1 case" if len(slow) == 1 else f"{len(slow)} cases"
            print(f"sweep: {cases} took more than {SLOW:g} s, at most {in_words(max(slow))}", file=sys.stderr)


def run(work: Work, cut: Cut, chunks: Sequence[int], executor: Any, take: Callable[[int, Part], None]) -> None:
    """Compute chunks in any order, by own threads or an executor; `take(chunk, part)` is called for each finished one.

    What `take`, the executor or the work itself raises ends the run.
    """
    from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait

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


def _lost(error: Exception) -> bool:
    """Whether an executor has lost its processes and cannot go on."""
    from concurrent.futures import BrokenExecutor, CancelledError

    # KilledWorker is of distributed, which is not imported here
    return isinstance(error, BrokenExecutor | CancelledError) or type(error).__name__ == "KilledWorker"


def timed(work: Work, seconds: float) -> Cut:
    """Chunks of about so many seconds, estimated from trial units spread over the grid."""
    n = work.layout.n_units
    most = n // LEAST_CHUNKS
    if most < 2:
        return Cut(n, 1)
    return Cut(n, max(1, min(most, int(seconds / max(fmean(_times(work)), 1e-9)))))


def _times(work: Work) -> Iterator[float]:
    """Computing times of trial units [s], after compilation."""
    trials = [int((0.5 + k * GOLDEN) % 1 * work.layout.n_units) for k in range(MOST_TRIALS)]
    coarse = replace(work, n_springs=COARSE, steps_per_period=COARSE)
    compute(coarse, trials[0], trials[0] + 1)
    begin = now = time.perf_counter()
    for unit in trials:
        if now - begin > TRIAL:
            return
        start = now
        compute(work, unit, unit + 1)
        now = time.perf_counter()
        yield now - start
