"""The rule by which coarser runs bound the error of a run.

A run and a companion that differ in one number, of steps, springs or cells, tell the error that this number leaves. At
second order in it half as many miss four times as much, so that their difference is three times the error of the run;
who knows less of the order takes it times a factor. Errors of several numbers add. Two runs may agree by chance: what
other pairs of runs tell, or a law of the method, is the least that a bound may be.
"""

from __future__ import annotations

from typing import NamedTuple


class Companion(NamedTuple):
    """What a coarser run tells of an error; all in the unit of what is compared."""

    apart: float  #: how far two runs are apart that differ in one number
    times: float = 1.0  #: the error of the finer one over that, at most
    least: float = 0.0  #: what this error is not called smaller than

    @property
    def error(self) -> float:
        """Bound on the error that this number leaves."""
        return max(self.times * self.apart, self.least)


def bound(*companions: Companion, others: tuple[Companion, ...] = ()) -> float:
    """Bound on the error of a run: the sum over its numbers, and no less than what other pairs of runs tell."""
    return max([sum(one.error for one in companions), *(one.error for one in others)])
