"""The loop of every method that comes nearer to its answer step by step, within the time limit of the caller."""

from __future__ import annotations

from collections.abc import Callable
from itertools import repeat
from typing import TypeVar

from mdr.tools.progress import time_is_over

State = TypeVar("State")  #: what a method knows between two steps


def iterate(
    step: Callable[[State], State], ended: Callable[[State], bool], at: State, most: int | None = None
) -> State:
    """Where steps lead from here: to where the method has ended, or as far as their number and the time limit allow.

    ended: whether the answer is found, or known not to be found.
    """
    for _ in repeat(None) if most is None else repeat(None, most):
        if ended(at) or time_is_over():
            break
        at = step(at)
    return at
