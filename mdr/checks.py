"""Checks of the numbers a record is made of: quantity, rule, value, way out.

Each returns the value as a float, so that records compare and hash alike whether an int or a numpy scalar went in.
"""

from __future__ import annotations

import math
from numbers import Real
from typing import Any


def finite(name: str, value: Any, meaning: str = "a finite number") -> float:
    """A real number that is neither NaN nor infinite.

    Raises TypeError for anything that is not a real number (bool, str, array, complex, None), ValueError for NaN and
    infinity.
    """
    if isinstance(value, bool) or not isinstance(value, Real):
        raise TypeError(f"{name} must be a real number, got {value!r} ({type(value).__name__})")
    number = float(value)
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
        raise ValueError(f"{name} must not be negative, got {number!r}" + (f" ({meaning})" if meaning else ""))
    return number


def between(name: str, value: Any, low: float, high: float, meaning: str = "") -> float:
    """A number strictly between low and high."""
    number = finite(name, value)
    if not low < number < high:
        raise ValueError(
            f"{name} must lie between {low:.6g} and {high:.6g}, got {number!r}" + (f" ({meaning})" if meaning else "")
        )
    return number
