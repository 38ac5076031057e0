"""One call of sweep(): find what is there, compute what is missing in chunks, merge once all is there."""

from __future__ import annotations

import pickle
import sys
import time
import warnings
from collections import deque
from collections.abc import Callable, Collection, Generator, Sequence
from contextlib import closing
from dataclasses import replace
from functools import lru_cache
from itertools import islice
from queue import SimpleQueue
from random import Random
from threading import Event, Thread
from typing import Any

from mdr.friction.cof_curve import LEAST_KNOB
from mdr.studies.formats import packed
from mdr.studies.helpers import Lost, helper_for
from mdr.studies.points import Points, compute
from mdr.studies.specification import identity_of, specification
from mdr.studies.store import Store, StudyError
from mdr.studies.study import Study, frame_of, study_of_points, tree_of
from mdr.studies.work import Work, units_of
from mdr.tools.beside import cores
from mdr.tools.compiling import TALLY
from mdr.tools.progress import progress
from mdr.tools.status import Status

#: of a study with a store that has so many units, so that several workers share them evenly; as many units are timed
LEAST_CHUNKS = 32
#: chunks that an executor of the user is given at a time, more than a cluster has workers; and of a study in memory
MOST_IN_FLIGHT = 1024
ALONE = 2.0  #: s of computing after which other processes help, which take about as long to begin


class Call:
    """One call of sweep(), on a store or in memory alone."""

    def __init__(self, work: Work, store: Store | None, executor: Any) -> None:
        self.work, self.store, self.executor = work, store, executor
        self.points = Points.blank(len(work.quantities), work.layout.n_points, Status.MISSING)
        self.specification: dict[str, Any] = {}
        self.identity = ""
        try:
            self.specification = specification(work)
            self.identity = identity_of(self.specification)
        except ValueError:  # a function without a name, which only a store has to tell from others
            if store is not None:
                raise
        self.frame = frame_of(work, self.identity)

    def study(self, chunk_seconds: float, shard: tuple[int, int]) -> Study:
        """The study; what is missing of this shard in the store is computed before."""
        try:
            if self.store is not None:
                return self._in_store(self.store, chunk_seconds, shard)
            cut = _cut_in_memory(self.work.layout.n_units)
            self._compute(range(len(cut)), cut, len(cut))
            return self._found()
        except KeyboardInterrupt:
            print(f"sweep: interrupted; {self._kept}", file=sys.stderr)
            raise

    @property
    def _kept(self) -> str:
        if self.store is None:
            return "nothing is kept, as there is no store (store=, --store)"
        return f"{self.store.kept or 'nothing is computed yet'}; the same call goes on from there"

    def _found(self) -> Study:
        return study_of_points(self.frame, self.work.layout, self.points)

    def _in_store(self, store: Store, chunk_seconds: float, shard: tuple[int, int]) -> Study:
        head = {"identity": self.identity, "specification": self.specification, "frame": tree_of(self.frame)}
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
        study = store.merged()
        if study is None:
            return None
        if study.identity != self.identity:
            raise StudyError(f"{store.file}: is of another study than study.json beside it; give another folder")
        store.clear()
        return replace(study, grid=self.frame.grid)

    def _cut(self, store: Store, chunk_seconds: float) -> range:
        """As the store has it, or as a trial finds; all processes on a store cut alike."""
        cut = store.plan() or store.settle(timed(self.work, chunk_seconds))
        if cut.stop != self.work.layout.n_units:
            raise StudyError(f"{store.chunks}: its plan is of another study; remove that folder, repeat the call")
        return cut

    def _completed(self, store: Store, cut: range, shard: tuple[int, int]) -> Study:
        """The study once the chunks of the shard are there; merged if none is missing then."""
        k, n = shard
        own = range(k - 1, len(cut), n)
        others = set(range(len(cut))).difference(own)
        self._compute(self._missing(store, own, cut), cut, len(own))
        if others and store.finished().issuperset(others):
            self._compute(self._missing(store, others, cut), cut, len(cut))  # what is damaged of these
        study = self._found()
        if study.complete:
            store.merge(packed(study))
        return study

    def _missing(self, store: Store, chunks: Collection[int], cut: range) -> list[int]:
        """Take over the chunks that are in the store; returns the others."""
        finished = store.finished()
        kept = [chunk for chunk in chunks if chunk in finished]
        damaged = store.load(kept, cut, self.work.layout, self.identity, self.points)
        for chunk in damaged:
            warnings.warn(f"{store.chunks}: chunk {chunk} is damaged and is computed again", stacklevel=6)
        store.n_kept, store.n_chunks = len(finished) - len(damaged), len(cut)
        return [chunk for chunk in chunks if chunk not in finished or chunk in damaged]

    def _compute(self, chunks: Sequence[int], cut: range, total: int) -> None:
        """Compute chunks and keep each as soon as it is finished."""
        if not chunks:
            return
        finished = run(self.work, cut, chunks, self.executor)
        meter = progress(finished, "sweep", "chunks", total, done=total - len(chunks))
        try:
            with closing(finished):
                for chunk, points in meter:
                    if self.store is not None:
                        self.store.write(chunk, self.identity, points)
                    self.points[self.work.layout.points(units_of(cut, chunk))].put(points)
        except Exception as error:
            if _lost(error):
                what = f"the workers were lost, as when one is killed or runs out of memory ({error})"
                raise StudyError(f"{what}; {self._kept}") from error
            if "pickle" in str(error) or "local object" in str(error):
                error.add_note("what is sent to other processes must be defined at the top of a module")
            raise


def points_of(work: Work, what: str) -> Points:
    """All points of a work, in memory, with progress under this name."""
    points = Points.blank(len(work.quantities), work.layout.n_points, Status.MISSING)
    cut = _cut_in_memory(work.layout.n_units)
    with closing(run(work, cut, range(len(cut)), None)) as finished:
        for chunk, found in progress(finished, what, "chunks", len(cut)):
            points[work.layout.points(units_of(cut, chunk))].put(found)
    return points


def _cut_in_memory(n_units: int) -> range:
    """How a study without a store is cut."""
    return range(0, n_units, max(1, n_units // MOST_IN_FLIGHT))


def run(work: Work, cut: range, chunks: Sequence[int], executor: Any) -> Generator[tuple[int, Points], None, None]:
    """Compute chunks in any order, here and by helpers, or by an executor; yields each with its points as it is
    finished.

    What the executor or the work itself raises ends the run; so does closing the generator.
    """
    from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, ThreadPoolExecutor, wait

    if executor is None:
        yield from _run_here(work, cut, chunks)
        return
    ended = Event()
    stop = (ended,) if isinstance(executor, ThreadPoolExecutor) else ()  # an event cannot be sent to other processes
    asked: tuple[Any, ...] = (compute, work)
    if isinstance(executor, ProcessPoolExecutor):
        asked = compute_sent, pickle.dumps(work)
    waiting: dict[Future[Points], int] = {}
    remaining = iter(chunks)
    try:
        while True:
            for chunk in islice(remaining, MOST_IN_FLIGHT - len(waiting)):
                waiting[executor.submit(*asked, units_of(cut, chunk), *stop)] = chunk
            if not waiting:
                return
            for future in wait(waiting, return_when=FIRST_COMPLETED).done:
                yield waiting.pop(future), future.result()
    finally:
        ended.set()
        for future in waiting:
            future.cancel()


def compute_sent(frame: bytes, units: range) -> Points:
    """The points of some units of a work that was sent. It is read once: what is mapped of a shape stays known."""
    return compute(_sent(frame), units)


@lru_cache(maxsize=1)
def _sent(frame: bytes) -> Work:
    work: Work = pickle.loads(frame)
    return work


def _run_here(work: Work, cut: range, chunks: Sequence[int]) -> Generator[tuple[int, Points], None, None]:
    """Compute chunks by a thread of this process, and by a helper for every other core once it has lasted a while."""
    ended, finished, remaining = Event(), SimpleQueue[tuple[int, Points] | BaseException](), deque(chunks)

    def compute_here(units: range) -> Points:
        return compute(work, units, ended)

    def take(by: Callable[[range], Points]) -> None:
        try:
            while not ended.is_set():
                chunk = remaining.popleft()
                finished.put((chunk, by(units_of(cut, chunk))))
        except IndexError:
            return  # there is no chunk left
        except BaseException as error:
            finished.put(error)

    def help_later() -> None:
        begin = TALLY.clock
        while TALLY.clock < begin + ALONE:  # which stands still while something is compiled
            if ended.wait(0.1):
                return
        helper = helper_for(work, ended) if remaining else None

        def compute_there(units: range) -> Points:
            try:
                return compute_here(units) if helper is None else helper.compute(units)
            except Lost:
                return compute_here(units)

        try:
            take(compute_there)
        finally:
            if helper is not None:
                helper.close()

    others = [Thread(target=help_later, daemon=True) for _ in range(min(cores(), len(chunks)) - 1)]
    threads = [Thread(target=take, args=(compute_here,), daemon=True), *others]
    for thread in threads:
        thread.start()
    try:
        for _ in chunks:
            one = finished.get()
            if isinstance(one, BaseException):
                raise one
            yield one
    finally:
        ended.set()
        for thread in threads:
            thread.join()


def _lost(error: Exception) -> bool:
    """Whether an executor has lost its processes and cannot go on."""
    from concurrent.futures import BrokenExecutor, CancelledError

    # KilledWorker is of distributed, which is not imported here
    return isinstance(error, BrokenExecutor | CancelledError) or type(error).__name__ == "KilledWorker"


def timed(work: Work, seconds: float) -> range:
    """Chunks of about so many seconds, estimated from trial units spread over the grid, after compilation."""
    n = work.layout.n_units
    most = n // LEAST_CHUNKS
    if most < 2:
        return range(n)
    trials = Random(0).sample(range(n), LEAST_CHUNKS)
    coarse = {"n_springs": LEAST_KNOB, "steps_per_period": LEAST_KNOB}
    compute(replace(work, knobs={**work.knobs, **coarse}), range(trials[0], trials[0] + 1))
    lasted, begin = [0.0], time.perf_counter()
    for unit in trials:
        if lasted[-1] > seconds:
            break
        compute(work, range(unit, unit + 1))
        lasted.append(time.perf_counter() - begin)
    each = max(lasted[-1] / (len(lasted) - 1), 1e-9)
    return range(0, n, max(1, min(most, int(seconds / each))))
