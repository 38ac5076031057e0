"""Warnings of what is legal but unlikely, told at the line outside the package that led to them."""

from __future__ import annotations

import sys
import warnings
from types import FrameType

WRAPPERS = ("mdr.tools.memoise", "mdr.tools.keywords", "mdr.case.domain")  #: where decorators stand


class PlausibilityWarning(UserWarning):
    """A contact is legal but unlikely: a unit may be wrong, or the theory be left. Silence it by its class."""


def warn_outside(doubt: str) -> None:
    """Warn of the last line outside the package that led here."""
    level, frame = 1, sys._getframe(0)
    while is_ours(frame) and frame.f_back is not None:
        level, frame = level + 1, frame.f_back
    warnings.warn(doubt, PlausibilityWarning, stacklevel=level)


def asked_from_outside() -> bool:
    """True if user code, not mdr, called the current public function."""
    public = sys._getframe(3)
    outside = _past_wrappers(public.f_back) if is_ours(public) else public
    return outside is not None and not is_ours(outside)


def _past_wrappers(frame: FrameType | None) -> FrameType | None:
    """The frame, or the first before it that is no decorator's."""
    while frame is not None and frame.f_globals.get("__name__") in WRAPPERS:
        frame = frame.f_back
    return frame


def is_ours(frame: FrameType) -> bool:
    """Whether a frame belongs to the package."""
    return str(frame.f_globals.get("__name__", "")).partition(".")[0] == __name__.partition(".")[0]
