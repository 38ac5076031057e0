"""The loop of every search for a periodic state: a solver says what a step is, and when it has come to its end."""

from __future__ import annotations

from typing import Protocol, TypeVar

from mdr.tools.progress import time_is_over

State = TypeVar("State")  #: what a solver knows between two steps


class Solver(Protocol[State]):
    """A method that comes nearer to a periodic state step by step."""

    most: int  #: steps after which it gives up

    def step(self, at: State) -> State:
        """The state after one more step."""
        ...

    def ended(self, at: State) -> bool:
        """Whether it has found what it looks for, or knows that it will not."""
        ...


class OutOfTime(Exception):
    """The time limit of the caller is over in the middle of a search."""


def iterate(solver: Solver[State], at: State) -> State:
    """Where a solver comes to from here. Raises OutOfTime."""
    for _ in range(solver.most):
        if solver.ended(at):
            break
        if time_is_over():
            raise OutOfTime
        at = solver.step(at)
    return at
