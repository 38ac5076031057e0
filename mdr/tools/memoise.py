"""Results that are remembered for the next call with equal records, unless equal records may mean different things.

A shape that holds a function, such as a Profile, equals another with the same function, which may have come to return
something else since; so its results are remembered for that very object. A shape that can be written to has none.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, is_dataclass
from functools import lru_cache, wraps
from typing import Any, TypeVar

T = TypeVar("T")


class _Itself:
    """Equal to nothing but the same object."""

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
    """Whether a record cannot be written to, and has a hash."""
    return is_dataclass(record) and type(record).__dataclass_params__.frozen and type(record).__hash__ is not None  # type: ignore[union-attr]
