"""Compiled functions as Python: the same texts, which call one another and no machine code.

A function that numba compiles finds others by their names in its module. Its twin finds in the place of each the twin
of that. Every loop of a twin begins with a look at the clock, so that a call can be left whose machine code is ready.
"""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from types import CellType, FunctionType
from typing import Any

import numpy as np

from mdr.tools import sources

EVERY = 0.2  #: s, between looks whether a call may be left


class Left(BaseException):
    """A call is left; what it did to its arguments is undone."""


class _Open(threading.local):
    """The calls of a thread, outermost first: the error by which each is left, and whether it may be."""

    def __init__(self) -> None:
        self.calls: list[tuple[Left, Callable[[], bool]]] = []
        self.next = 0.0  # instant [s] of the next look


_open = _Open()
_making = threading.Lock()  # of twins, which find one another before they are whole


def called(function: FunctionType, args: tuple[Any, ...], may_leave: Callable[[], bool]) -> Any:
    """What the twin of a function answers. Raises Left, soon after the call may be left, with its arguments as before.

    Of calls within one another the outermost is left that may be.
    """
    with _making:
        twin = twin_of(function)
    kept, left = _copies(args), Left()
    _open.calls.append((left, may_leave))
    try:
        with np.errstate(all="ignore"):  # as in machine code
            return twin(*args)
    except Left as one:
        if one is left:
            _put_back(args, kept)
        raise
    finally:
        _open.calls.pop()


def is_outermost() -> bool:
    """Whether no twin runs in this thread."""
    return not _open.calls


def _range(*of: int) -> range:
    now = time.monotonic()
    if now > _open.next:
        _open.next = now + EVERY
        for left, may_leave in _open.calls:
            if may_leave():
                raise left
    return range(*of)


@cache
def twin_of(function: FunctionType) -> FunctionType:
    """The twin of a function of this package."""
    names, cells = _names_of(function.__module__), function.__closure__
    closure = cells and tuple(CellType(_twin(cell.cell_contents)) for cell in cells)
    twin = FunctionType(function.__code__, names, function.__name__, function.__defaults__, closure)
    twin.__kwdefaults__ = function.__kwdefaults__
    return twin


_names: dict[str, dict[str, Any]] = {}  #: of modules


def _names_of(module: str) -> dict[str, Any]:
    """The names of a module, as its twins find them."""
    if module not in _names:
        names = _names[module] = {}  # before it is filled, as modules name one another
        names.update({name: _twin(one) for name, one in vars(sys.modules[module]).items()}, range=_range)
    return _names[module]


def _twin(value: Any) -> Any:
    """The twin of a function, compiled or not; anything else as it is."""
    function = getattr(value, "py_func", value)
    own = isinstance(function, FunctionType) and function.__module__ in sources.compiled()
    return twin_of(function) if own else value


def _copies(value: Any) -> Any:
    """Of the arrays in arguments."""
    if isinstance(value, np.ndarray):
        return value.copy()
    return [_copies(one) for one in value] if isinstance(value, tuple) else None


def _put_back(value: Any, kept: Any) -> None:
    """Give arrays in arguments what they held."""
    if isinstance(value, np.ndarray):
        with suppress(ValueError):  # it is read-only
            value[...] = kept
    elif isinstance(value, tuple):
        for one, of in zip(value, kept, strict=True):
            _put_back(one, of)
