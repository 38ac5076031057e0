"""How the work of a study is cut into chunks: consecutive units, enough of them to be worth a file."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass, replace

from mdr.studies.points import compute
from mdr.studies.work import Work

TRIAL = 1.0  #: s in which units are timed
MOST_TRIALS = 32
LEAST_CHUNKS = 32  #: where there are so many units, so that several workers share them evenly
IN_MEMORY = 256  #: chunks of a study without a store
COARSE = 32  #: springs and steps of the run that compiles

GOLDEN = 0.6180339887498949


@dataclass(frozen=True)
class Cut:
    """Chunks of equally many units; the last may have fewer."""

    n_units: int
    units_per_chunk: int

    @property
    def n_chunks(self) -> int:
        """Number of chunks."""
        return -(-self.n_units // self.units_per_chunk)

    def units(self, chunk: int) -> tuple[int, int]:
        """First unit of a chunk, and the first unit after it."""
        start = chunk * self.units_per_chunk
        return start, min(start + self.units_per_chunk, self.n_units)

    @classmethod
    def in_memory(cls, work: Work) -> Cut:
        """Chunks that share the work evenly among workers, for a study without a store."""
        n = work.layout.n_units
        return cls(n, max(1, n // IN_MEMORY))

    @classmethod
    def timed(cls, work: Work, seconds: float) -> Cut:
        """Chunks of about so many seconds, estimated from trial units spread over the grid."""
        n = work.layout.n_units
        most = max(1, n // LEAST_CHUNKS)
        times = list(_times(work)) if most > 1 else [seconds]
        mean = sum(times) / len(times)
        return cls(n, max(1, min(most, int(seconds / max(mean, 1e-9)))))


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
