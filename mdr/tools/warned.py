"""Warnings of what is legal but unlikely, told at the line outside the package that led to them."""

from __future__ import annotations

import sys
import warnings
from types import FrameType


class PlausibilityWarning(UserWarning):
    """A contact is legal but unlikely: a unit may be wrong, or the theory be left. Silence it by its class."""


def warn_outside(doubt: str) -> None:
    """Warn of the last line outside the package that led here."""
    level, frame = 1, sys._getframe(0)
    while is_ours(frame) and frame.f_back is not None:
        level, frame = level + 1, frame.f_back
    warnings.warn(doubt, PlausibilityWarning, stacklevel=level)


def is_ours(frame: FrameType) -> bool:
    """Whether a frame belongs to the package."""
    return str(frame.f_globals.get("__name__", "")).partition(".")[0] == __name__.partition(".")[0]
