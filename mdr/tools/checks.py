"""Checks of the numbers a record is made of: quantity, rule, value, way out.

Each returns the value as a float, so that records compare and hash alike whether an
int or a numpy scalar went in.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from numbers import Integral, Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mdr.tools.arrays import Array
from mdr.tools.messages import short


def finite(name: str, value: Any, note: str = "") -> float:
    """A real number that is neither NaN nor infinite; its refusals need no note.

    Raises TypeError for anything that is not a real number (bool, str, array, complex, None), ValueError for NaN and
    infinity.
    """
    if isinstance(value, bool) or not isinstance(value, Real):
        raise TypeError(f"{name} must be a real number, got {value!r} ({type(value).__name__})")
    try:
        number = float(value)
    except OverflowError:
        raise ValueError(f"{name} must be a finite number, got a whole number beyond the range of floats") from None
    if not math.isfinite(number):
        raise ValueError(f"{name} must be a finite number, got {number!r}")
    return number


def positive(name: str, value: Any, note: str = "") -> float:
    """A number above zero."""
    number = finite(name, value)
    return _ruled(name, number, number > 0, "be positive", note)


def positive_or_none(name: str, value: Any, note: str = "") -> float | None:
    """A number above zero, or none."""
    return None if value is None else positive(name, value, note)


def not_negative(name: str, value: Any, note: str = "") -> float:
    """A number at or above zero."""
    number = finite(name, value)
    return _ruled(name, number, number >= 0, "not be negative", note)


def between(name: str, value: Any, low: float, high: float, note: str = "") -> float:
    """A number strictly between low and high."""
    number = finite(name, value)
    rule = f"lie between {low:.6g} and {high:.6g}" if math.isfinite(high) else f"be above {low:.6g}"
    return _ruled(name, number, low < number < high, rule, note)


def ends(name: str, given: Any) -> tuple[float, float]:
    """The two ends of a range, the lower one first."""
    if not isinstance(given, tuple | list) or len(given) != 2:
        raise TypeError(f"{name} must be a pair (low, high), got {short(repr(given))}")
    low, high = (finite(name, end) for end in given)
    if not low < high:
        raise ValueError(f"{name} must be (low, high) with low < high, got {low:.6g} and {high:.6g}")
    return low, high


def _ruled(name: str, number: float, holds: bool, rule: str, note: str) -> float:
    """The number, for which a rule holds."""
    if not holds:
        raise ValueError(f"{name} must {rule}, got {number!r}{f' ({note})' if note else ''}")
    return number


def count(name: str, value: Any, least: int) -> int:
    """A whole number of at least `least`."""
    if isinstance(value, bool) or not isinstance(value, Integral):
        raise TypeError(f"{name} must be a whole number, got {value!r}")
    if value < least:
        raise ValueError(f"{name} must be at least {least}, got {value}")
    return int(value)


def truth(name: str, value: Any) -> bool:
    """True or False."""
    if not isinstance(value, bool):
        raise TypeError(f"{name} must be True or False, got {value!r}")
    return value


def word(name: str, value: Any, *words: str) -> str:
    """One of two words or more."""
    if not isinstance(value, str) or value not in words:
        *first, last = (f'"{one}"' for one in words)
        raise ValueError(f"{name} must be {', '.join(first)} or {last}, got {short(repr(value))}")
    return value


def instance(name: str, value: object, *kinds: type[Any]) -> None:
    """TypeError unless the value is of one of the kinds; a class in the place of its record is told so."""
    if not isinstance(value, kinds):
        hint = f"; write {value.__name__}(...)" if isinstance(value, type) else ""
        names = " or ".join(kind.__name__ for kind in kinds)
        raise TypeError(f"{name} must be of kind {names}, got {value!r}{hint}")


def real_array(name: str, values: ArrayLike, unit: str = "") -> Array:
    """Real numbers of any shape as float64 (a number becomes shape ())."""
    try:
        array = np.asarray(values)
    except ValueError as ragged:
        raise TypeError(f"{name} must be an array of numbers{_in(unit)}, got {values!r}") from ragged
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{name} must be real numbers{_in(unit)}, got {values!r}")
    return array.astype(np.float64, copy=False)


def finite_array(name: str, values: ArrayLike, unit: str = "") -> Array:
    """As `real_array`, refused if one is NaN or infinite."""
    array = real_array(name, values, unit)
    if not (np.isfinite(array).all() if array.ndim else math.isfinite(array)):
        bad = array[~np.isfinite(array)].flat[0]
        raise ValueError(f"{name} must be finite{_in(unit)}, got {float(bad)!r}")
    return array


def row(name: str, values: ArrayLike, unit: str = "", what: str = "numbers") -> Array:
    """As `finite_array`, in a row of one or more: a copy, that whoever asked may keep."""
    array = np.array(finite_array(name, values, unit), ndmin=1)
    if array.ndim != 1 or array.size == 0:
        raise ValueError(f"{name} must be a list of {what}, got an array of shape {array.shape}")
    return array


def positive_array(name: str, values: ArrayLike, unit: str = "") -> Array:
    """As `finite_array`, every number above zero."""
    array = finite_array(name, values, unit)
    if not (array > 0).all():
        raise ValueError(f"{name} must be positive{_in(unit)}, got {float(array[array <= 0].flat[0])!r}")
    return array


@contextmanager
def in_range(what: str) -> Iterator[None]:
    """ValueError, and no warning of NumPy, where a term inside is beyond the range of floats, or divided by 0."""
    try:
        with np.errstate(over="raise", divide="raise", invalid="raise"):
            yield
    except ArithmeticError as fault:
        raise ValueError(f"{what} is beyond the range of floats ({fault}): give numbers nearer to one") from None


def instants(name: str, values: ArrayLike) -> Array:
    """Two or more instants [s], each after the one before."""
    t = finite_array(name, values, "s")
    if t.ndim != 1 or t.size < 2:
        raise ValueError(f"{name} must be a list of two instants or more, got shape {t.shape}")
    if not np.all(np.diff(t) > 0):
        k = int(np.argmin(np.diff(t) > 0))
        raise ValueError(f"{name} must rise, got {t[k + 1]:.9g} s after {t[k]:.9g} s (sample {k + 1})")
    return t


def plain(values: Any) -> Array:
    """The answer in the form of the question: a float for a plain number, else a float64 array."""
    answer: Array = np.asarray(values, dtype=np.float64)[()]
    return answer


def _in(unit: str) -> str:
    return f" in {unit}" if unit else ""
