"""Records that hold arrays: they compare and hash by value, pickle, print in one line, and cannot be written to."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np

from mdr.tools.messages import short


class ArrayRecord:
    """Base of frozen dataclasses (eq=False, repr=False) with arrays among their fields, which become read-only."""

    def __post_init__(self) -> None:
        for name, value in list(vars(self).items()):
            if isinstance(value, np.ndarray):
                own = value.view()  # the array itself may be somebody's, who goes on writing to it
                own.setflags(write=False)
                object.__setattr__(self, name, own)

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        ArrayRecord.__post_init__(self)

    def _values(self) -> tuple[Any, ...]:
        return tuple(getattr(self, field.name) for field in fields(self))  # type: ignore[arg-type]

    def __repr__(self) -> str:
        told = zip(fields(self), self._values(), strict=True)  # type: ignore[arg-type]
        given = ", ".join(f"{one.name}={_short(value)}" for one, value in told if value is not None)
        return f"{type(self).__name__}({given})"

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other) or not isinstance(other, ArrayRecord):
            return NotImplemented
        return all(_same(one, two) for one, two in zip(self._values(), other._values(), strict=True))

    def __hash__(self) -> int:
        return hash(
            tuple(
                (value.shape, value.tobytes()) if isinstance(value, np.ndarray) else value for value in self._values()
            )
        )


def _same(one: Any, two: Any) -> bool:
    if isinstance(one, np.ndarray) and isinstance(two, np.ndarray):
        return np.array_equal(one, two, equal_nan=one.dtype.kind == two.dtype.kind == "f")
    return bool(type(one) is type(two) and one == two)


def _short(value: Any) -> str:
    """A value as it is written: numbers of six digits, of an array its shape, of a record in a record its kind."""
    if isinstance(value, np.ndarray) and value.ndim:
        return f"<array {value.shape}>"
    if isinstance(value, float | np.floating):
        return f"{value:.6g}"
    text = repr(value)
    return text if text == short(text) else f"{type(value).__name__}(...)"
