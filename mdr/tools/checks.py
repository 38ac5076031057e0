"""Checks of the numbers a record is made of: quantity, rule, value, way out.

Each returns the value as a float, so that records compare and hash alike whether an
int or a numpy scalar went in.
"""

from __future__ import annotations

import math
from numbers import Integral, Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def finite(name: str, value: Any, meaning: str = "a finite number") -> float:
    """A real number that is neither NaN nor infinite.

    Raises TypeError for anything that is not a real number (bool, str, array, complex, None), ValueError for
    NaN and infinity.
    """
    if isinstance(value, bool) or not isinstance(value, Real):
        raise TypeError(f"{name} must be a real number, got {value!r} ({type(value).__name__})")
    try:
        number = float(value)
    except OverflowError:
        raise ValueError(f"{name} must be {meaning}, got a whole number beyond the range of floats") from None
    if not math.isfinite(number):
        raise ValueError(f"{name} must be {meaning}, got {number!r}")
    return number


def positive(name: str, value: Any, meaning: str = "") -> float:
    """A number above zero."""
    number = finite(name, value)
    if number <= 0:
        raise ValueError(f"{name} must be positive, got {number!r}" + (f" ({meaning})" if meaning else ""))
    return number


def not_negative(name: str, value: Any, meaning: str = "") -> float:
    """A number at or above zero."""
    number = finite(name, value)
    if number < 0:
        note = f" ({meaning})" if meaning else ""
        raise ValueError(f"{name} must not be negative, got {number!r}{note}")
    return number


def between(name: str, value: Any, low: float, high: float, meaning: str = "") -> float:
    """A number strictly between low and high."""
    number = finite(name, value)
    if not low < number < high:
        note = f" ({meaning})" if meaning else ""
        raise ValueError(f"{name} must lie between {low:.6g} and {high:.6g}, got {number!r}{note}")
    return number


def count(name: str, value: Any, least: int) -> int:
    """A whole number of at least `least`."""
    if isinstance(value, bool) or not isinstance(value, Integral):
        raise TypeError(f"{name} must be a whole number, got {value!r}")
    if value < least:
        raise ValueError(f"{name} must be at least {least}, got {value}")
    return int(value)


def finite_array(name: str, values: ArrayLike, unit: str = "") -> FloatArray:
    """Real numbers of any shape as float64 (a number becomes shape ()), refused if one is NaN or infinite."""
    try:
        array = np.asarray(values)
    except ValueError as ragged:
        raise TypeError(f"{name} must be an array of numbers{_in(unit)}, got {values!r}") from ragged
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{name} must be real numbers{_in(unit)}, got {values!r}")
    if not np.all(np.isfinite(array)):
        bad = array[~np.isfinite(array)].flat[0]
        raise ValueError(f"{name} must be finite{_in(unit)}, got {float(bad)!r}")
    return array.astype(np.float64, copy=False)


def positive_array(name: str, values: ArrayLike, unit: str = "") -> FloatArray:
    """As `finite_array`, every number above zero."""
    array = finite_array(name, values, unit)
    if not np.all(array > 0):
        raise ValueError(f"{name} must be positive{_in(unit)}, got {float(array[array <= 0].flat[0])!r}")
    return array


def plain(values: Any) -> FloatArray:
    """The answer in the form of the question: a float for a plain number, else a float64 array."""
    answer: FloatArray = np.asarray(values, dtype=np.float64)[()]
    return answer


def _in(unit: str) -> str:
    return f" in {unit}" if unit else ""
