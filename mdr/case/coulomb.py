"""Coulomb's friction and that of a face with a shear strength: what knows the first alone, and how each is told."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

from mdr.case.contact import SlidingContact

P = ParamSpec("P")
T = TypeVar("T")


def require_coulomb(case: SlidingContact, what: str) -> None:
    """ValueError for a case with a shear strength; what: name of what does not know it."""
    if case.tau_0:
        raise ValueError(
            f"{what} knows Coulomb's friction alone, and this face has a shear strength tau_0 = {case.tau_0:.6g} Pa: "
            "ask slide, cof_curve or full_slip_critical_velocity, or set tau_0 = 0"
        )


def of_coulomb(function: Callable[P, T]) -> Callable[P, T]:
    """Decorator: the same for a function whose first argument is the case."""

    @wraps(function)
    def call(*args: P.args, **given: P.kwargs) -> T:
        case = args[0] if args else given.get("case")
        if isinstance(case, SlidingContact):
            require_coulomb(case, function.__name__)
        return function(*args, **given)

    return call
