"""Memoisation: the result of a function is kept for the next call with an equal record.

A record that holds a function, such as a Profile, equals another one with the same function, although the function may
since return something else. Results are kept for that very object alone. Nothing is kept for a record that can be
changed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, is_dataclass
from functools import lru_cache, wraps
from typing import Any, TypeVar

T = TypeVar("T")


class _Itself:
    """Wrapper that compares by identity: equal to nothing but a wrapper of the same object."""

    def __init__(self, one: Any) -> None:
        self.one = one

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Itself) and self.one is other.one

    def __hash__(self) -> int:
        return id(self.one)


def remembered(maxsize: int) -> Callable[[Callable[..., T]], Callable[..., T]]:
    """Decorator: lru_cache for a function whose first argument is a case or a shape."""

    def wrap(function: Callable[..., T]) -> Callable[..., T]:
        @lru_cache(maxsize=maxsize)
        def known(shape: _Itself | None, *args: Any) -> T:
            return function(*args)

        @wraps(function)
        def call(*args: Any) -> T:
            shape = getattr(args[0], "indenter", args[0])
            if not _is_frozen(shape):
                return function(*args)
            holds_function = any(callable(getattr(shape, one.name)) for one in fields(shape))
            return known(_Itself(shape) if holds_function else None, *args)

        return call

    return wrap


def _is_frozen(record: Any) -> bool:
    """True if a record cannot be changed and has a hash."""
    return is_dataclass(record) and type(record).__dataclass_params__.frozen and type(record).__hash__ is not None  # type: ignore[union-attr]
