"""One call of sweep() with a store: find what is there, compute what is missing, merge once all is there."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from mdr.studies.cut import Cut
from mdr.studies.frame import Frame
from mdr.studies.netcdf import packed, unpacked
from mdr.studies.points import Part
from mdr.studies.results import Results
from mdr.studies.run import WorkersLost, run
from mdr.studies.specification import identity_of, specification
from mdr.studies.store import Store, StudyError
from mdr.studies.study import Study
from mdr.studies.work import Work
from mdr.tools.progress import Meter


class Stored:
    """One call of sweep() on a store."""

    def __init__(self, work: Work, store: Store, executor: Any) -> None:
        self.work, self.store, self.executor = work, store, executor
        self.specification = specification(work)
        self.identity = identity_of(self.specification)
        self.frame = Frame.of(work, self.identity)
        self.results = Results(work.layout, len(work.quantities))

    def study(self, chunk_seconds: float, shard: tuple[int, int]) -> Study:
        """The study in the store; what is missing of this shard is computed before."""
        head = {"identity": self.identity, "specification": self.specification, "frame": self.frame.tree()}
        self.store.open({**head, "block": self.work.layout.block})
        if (done := self._merged()) is not None:
            return done
        try:
            self.store.require_writable()
            return self._merged() or self._computed(self._cut(chunk_seconds), shard)
        except KeyboardInterrupt:
            kept = self.store.kept or "nothing is computed yet"
            print(f"sweep: interrupted; {kept}; the same call goes on from there", file=sys.stderr)
            raise
        except WorkersLost as error:
            message = f"{self.store.folder}: {error}; {self.store.kept}; the same call goes on from there"
            raise StudyError(message) from error
        except (StudyError, FileNotFoundError):  # another process may have merged, and removed the chunks
            if (done := self._merged()) is None:
                raise
            return done

    def _merged(self) -> Study | None:
        """The finished study, with the records of the axes in the place of their labels."""
        data = self.store.merged()
        if data is None:
            return None
        try:
            study = unpacked(data)
        except ValueError as fault:
            raise StudyError(f"{self.store.file}: is {fault}; move it away and repeat the call") from fault
        if study.identity != self.identity:
            raise StudyError(f"{self.store.file}: is of another study than study.json beside it; give another folder")
        self.store.clear()
        return replace(study, frame=self.frame)

    def _cut(self, chunk_seconds: float) -> Cut:
        """As the store has it, or as a trial finds; all processes on a store cut alike."""
        n_units = self.work.layout.n_units
        plan = self.store.plan()
        if plan is None:
            timed = Cut.timed(self.work, chunk_seconds)
            plan = self.store.settle({"n_units": n_units, "units_per_chunk": timed.units_per_chunk})
        if plan["n_units"] != n_units:
            raise StudyError(f"{self.store.chunks}: its plan is of another study; remove that folder, repeat the call")
        return Cut(n_units, plan["units_per_chunk"])

    def _computed(self, cut: Cut, shard: tuple[int, int]) -> Study:
        """The study once the chunks of the shard are there; merged if none is missing then."""
        k, n = shard
        own = range(k - 1, cut.n_chunks, n)
        missing, others = self._load(own, cut), [i for i in range(cut.n_chunks) if n > 1 and i % n != k - 1]
        self._compute(missing, cut, len(own))
        if others and self.store.finished().issuperset(others):
            self._compute(self._load(others, cut), cut, cut.n_chunks)  # of these, what turns out to be damaged
        study = self.results.study(self.frame)
        if study.complete:
            self.store.merge(packed(study))
        return study

    def _load(self, chunks: Sequence[int], cut: Cut) -> list[int]:
        """Put chunks that are in the store into the results; the others."""
        finished, missing = self.store.finished(), []
        self.store.n_kept, self.store.n_chunks = len(finished), cut.n_chunks
        for chunk in chunks:
            units = cut.units(chunk)
            part = None
            if chunk in finished:
                part = self.store.read(chunk, self.identity, self.results.shape_of(units))
                if part is None:
                    self.store.n_kept -= 1
                    name = f"{self.store.chunks}: chunk {chunk}"
                    warnings.warn(f"{name} is damaged and is computed again", stacklevel=5)
            if part is None:
                missing.append(chunk)
            else:
                self.results.put(units[0], part)
        return missing

    def _compute(self, chunks: Sequence[int], cut: Cut, total: int) -> None:
        """Compute chunks and keep each as soon as it is finished."""
        if not chunks:
            return
        meter = Meter("sweep", total, "chunks", done=total - len(chunks))

        def take(chunk: int, part: Part) -> None:
            self.store.write(chunk, self.identity, part)
            self.results.put(cut.units(chunk)[0], part)
            meter.tick()

        try:
            run(self.work, cut, chunks, self.executor, take)
        finally:
            meter.close()
        self.results.tell_slow()
