"""A name that there is not is met with the one that was meant: keywords of functions, attributes of records."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from inspect import signature
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

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


class NoSuch(AttributeError):
    """An attribute that there is not; what was meant is sought when it is told, as many only ask whether it is there.

    `obj` stays None, so that Python adds no offer of its own.
    """

    def __init__(self, owner: str, name: str, known: Callable[[], list[str]]) -> None:
        super().__init__(owner, name=name)
        self.known = known

    def __str__(self) -> str:
        return f"{self.args[0]} has no attribute {self.name!r}; {offer(str(self.name), self.known())}"

    def __reduce__(self) -> tuple[type[AttributeError], tuple[str]]:
        return AttributeError, (str(self),)  # as another process is told


class Offering:
    """Base of what people read values from: an attribute that it has not, or an index, is met with what it has."""

    if not TYPE_CHECKING:  # what is not there, a checker of types says

        def __getattr__(self, name: str) -> Any:
            kind = type(self)
            if name.startswith("_") or hasattr(kind, name):
                return object.__getattribute__(self, name)  # as Python tells it; of a property, what fails in it
            raise NoSuch(f"{kind.__name__!r} object", name, lambda: [one for one in dir(self) if not one.startswith("_")])

        def __getitem__(self, index: Any) -> Any:
            own = vars(self).items()
            lists = [f".{name}[{index!r}]" for name, value in own if isinstance(value, tuple) or getattr(value, "ndim", 0)]
            way = f".{index}" if isinstance(index, str) else " or ".join(lists[:2]) or f"its values, as .{next(iter(own))[0]}"
            raise TypeError(f"{type(self).__name__} is no list; take {way}")


def _meant(name: str, known: list[str]) -> str:
    ends = [one for one in known if one.endswith(f"_{name}")]
    return f"did you mean {' or '.join(ends)}?" if ends else offer(name, known)
