"""How far a range goes before what is made of its values is refused."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


def refusal_of(make: Callable[..., Any], *given: Any) -> str:
    """Why this cannot be made; "" where it can."""
    try:
        make(*given)
    except (ValueError, TypeError, ArithmeticError) as refused:
        return str(refused) or type(refused).__name__
    return ""


def last_allowed(make: Callable[[float], Any], start: float, end: float, error: float) -> float:
    """The end of a range, or the value nearest to it that is not refused, as `start` is not; error: relative to it."""
    if not refusal_of(make, end):
        return end
    good, bad = start, end
    while abs(bad - good) > error * abs(good or end):
        middle = (good + bad) / 2
        good, bad = (good, middle) if refusal_of(make, middle) else (middle, bad)
    return good
