"""Functions that meet a keyword which they do not take with the one that was meant, as records do."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from inspect import signature
from typing import ParamSpec, TypeVar

from mdr.tools.messages import offer

P = ParamSpec("P")
T = TypeVar("T")


def offering(function: Callable[P, T]) -> Callable[P, T]:
    """Decorator: TypeError with the keywords that end alike, or the nearest one, for a keyword that is none."""
    known = list(signature(function).parameters)

    @wraps(function)
    def call(*args: P.args, **given: P.kwargs) -> T:
        for name in sorted(given.keys() - set(known)):
            raise TypeError(f"{function.__name__} takes no {name}; {_meant(name, known)}")
        return function(*args, **given)

    return call


def _meant(name: str, known: list[str]) -> str:
    ends = [one for one in known if one.endswith(f"_{name}")]
    return f"did you mean {' or '.join(ends)}?" if ends else offer(name, known)
