"""Memoisation: the result of a function is kept for the next call with equal records.

A record that holds a function, such as a Profile, equals another one with the same function, although the function may
since return something else. Results are kept for that very object alone. Nothing is kept for a record that can be
changed, such as a shape or a motion that is no frozen dataclass, nor for a case that has such a part.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import fields, is_dataclass
from functools import lru_cache, wraps
from typing import Any, TypeVar

import numpy as np

T = TypeVar("T")

PLAIN = int, float, complex, str, tuple, type(None), np.generic, np.ndarray  #: what holds no record


class _Itself:
    """Wrapper that compares by identity: equal to nothing but a wrapper of the same object."""

    def __init__(self, one: Any) -> None:
        self.one = one

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Itself) and self.one is other.one

    def __hash__(self) -> int:
        return id(self.one)


def remembered(maxsize: int) -> Callable[[Callable[..., T]], Callable[..., T]]:
    """Decorator: lru_cache for a function of records and plain values."""

    def wrap(function: Callable[..., T]) -> Callable[..., T]:
        @lru_cache(maxsize=maxsize)
        def known(holding: tuple[_Itself, ...], *args: Any) -> T:
            return function(*args)

        @wraps(function)
        def call(*args: Any) -> T:
            holding: tuple[_Itself, ...] = ()
            for one in args:
                if not isinstance(one, PLAIN) and not callable(one):
                    of_one = _holding(_Itself(one)) if _kind(type(one))[0] else None  # type: ignore[arg-type]
                    if of_one is None:
                        return function(*args)
                    holding += of_one
            return known(holding, *args)

        return call

    return wrap


@lru_cache(256)
def _holding(record: _Itself) -> tuple[_Itself, ...] | None:
    """The records that hold a function among a record and its parts; None where one of them can be changed. Known by
    identity, as the hash of a case takes as long as this.
    """
    holding = []
    for one in _records([record.one]):
        frozen, names = _kind(type(one))  # type: ignore[arg-type]
        if not frozen:
            return None
        if any(callable(getattr(one, name)) for name in names):
            holding.append(_Itself(one))
    return tuple(holding)


def _records(values: Iterable[Any]) -> Iterator[Any]:
    """The records among some values, and within these."""
    for one in values:
        if not isinstance(one, PLAIN) and not callable(one):
            yield one
            yield from _records(getattr(one, name) for name in _kind(type(one))[1])  # type: ignore[arg-type]


@lru_cache(256)
def _kind(record: type[Any]) -> tuple[bool, tuple[str, ...]]:
    """Whether records of a class cannot be changed and have a hash, and their fields."""
    if not is_dataclass(record):
        return False, ()
    frozen = record.__dataclass_params__.frozen and record.__hash__ is not None  # type: ignore[attr-defined]
    return frozen, tuple(one.name for one in fields(record))
