"""A name that there is not is met with the one that was meant: keywords of functions, attributes of records."""

from __future__ import annotations

from collections.abc import Callable, Iterable
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

    def __init__(self, owner: str, name: str, known: Callable[[], Iterable[str]]) -> None:
        super().__init__(owner, name=name)
        self.known = known

    def __str__(self) -> str:
        known = sorted(one for one in self.known() if not one.startswith("_"))
        return f"{self.args[0]} has no attribute {self.name!r}; {offer(str(self.name), known)}"

    def __reduce__(self) -> tuple[type[AttributeError], tuple[str]]:
        return AttributeError, (str(self),)  # as another process is told


class Offering:
    """Base of what people read values from: an attribute that it has not, or an index, is met with what it has."""

    if not TYPE_CHECKING:  # what is not there, a checker of types says

        def __getattr__(self, name: str) -> Any:
            if name.startswith("_") or hasattr(type(self), name):
                return object.__getattribute__(self, name)  # as Python tells it; of a property, what fails in it
            raise NoSuch(f"{type(self).__name__!r} object", name, self.__dir__)

        __iter__ = None  # an index alone would make it one to loop over

        def __getitem__(self, index: Any) -> Any:
            own = vars(self)
            lists = [name for name, value in own.items() if isinstance(value, tuple) or getattr(value, "ndim", 0)]
            names = "".join(f", as .{name}" for name in [*own][:1])
            way = " or ".join(f".{name}[{index!r}]" for name in lists[:2]) or f"its values{names}"
            raise TypeError(f"{type(self).__name__} is no list; take {f'.{index}' if isinstance(index, str) else way}")


def _meant(name: str, known: list[str]) -> str:
    ends = [one for one in known if one.endswith(f"_{name}")]
    return f"did you mean {' or '.join(ends)}?" if ends else offer(name, known)
