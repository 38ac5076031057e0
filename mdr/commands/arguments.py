"""What several commands take: accuracy and whole numbers; velocities in m/s, another unit, or over v_c."""

from __future__ import annotations

import argparse
import math
import re
from collections.abc import Callable
from typing import NamedTuple, TypeVar

import mdr
from mdr.closed_forms.critical_velocity import velocity_scale
from mdr.commands.output import WrongInput
from mdr.files.toml_text import StandardInput
from mdr.march.march import BUDGET, accuracy_of
from mdr.tools.notation import UNITS

OF_V_C = "v_c"  #: unit of a multiple of the critical velocity
_UNIT = "|".join(map(re.escape, (*UNITS["m/s"], OF_V_C)))
_WRITTEN = re.compile(rf"(?P<number>.*?)\s*(?P<unit>{_UNIT})?", re.DOTALL)
#: how a value begins that is no option, as -1e-3 and -0.5v_c; argparse itself knows -1 and -0.001 alone
NEGATIVE = re.compile(r"-[\d.]")
T = TypeVar("T")


def read_as(must_be: str, read: Callable[[str], T]) -> Callable[[str], T]:
    """What argparse reads an argument with: where `read` raises ValueError, it says what the argument must be."""

    def checked(text: str) -> T:
        try:
            return read(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"must be {must_be}, got {text!r}") from None

    return checked


def path_of(text: str) -> str:
    """The path of a file as the command line gives it; - is standard input."""
    return StandardInput("standard input") if text == "-" else text


def whole_number(least: int, most: int = 100_000) -> Callable[[str], int]:
    """What argparse reads a whole number with; more springs, steps or points than `most` do not fit into memory."""

    def read(text: str) -> int:
        if not text.isascii() or not text.isdigit() or not least <= int(text[: len(str(most)) + 1]) <= most:
            raise ValueError
        return int(text)

    return read_as(f"a whole number from {least} to {most}", read)


def no_options(_: argparse.ArgumentParser) -> None:
    """None, of a command that takes a file alone, or nothing."""


def add_accuracy(command: argparse.ArgumentParser, of_what: str) -> None:
    """How accurate an answer is to be."""
    read = read_as("a number from 1e-8 to 1e-3", lambda text: accuracy_of(float(text)))
    meaning = f"{of_what}, 1e-8 to 1e-3 (default: {BUDGET:g})"
    command.add_argument("--accuracy", metavar="share", type=read, default=BUDGET, help=meaning)


class Velocity(NamedTuple):
    """A velocity as it was given."""

    number: float  #: in m/s, or a multiple of v_c
    of_v_c: bool

    def on(self, case: mdr.SlidingContact) -> float:
        """The velocity [m/s] for a case. Raises WrongInput for a multiple where v_c is infinite or zero."""
        if not self.of_v_c:
            return self.number
        v_c = mdr.critical_velocity(case, -1 if self.number < 0 else 1)
        if wrong := _no_scale(v_c):
            raise WrongInput(f"{self.number:g}v_c: {wrong}; give the velocity in m/s")
        return self.number * v_c


def velocity_in(usual: str) -> Callable[[str], Velocity]:
    """What argparse reads a velocity with; usual: the unit of a plain number, "m/s" or "v_c"."""

    def read(text: str) -> Velocity:
        found = _WRITTEN.fullmatch(text.strip())
        assert found is not None
        unit, number = found["unit"] or usual, float(found["number"])
        if not math.isfinite(number):
            raise ValueError
        return Velocity(number * UNITS["m/s"].get(unit, 1.0), unit == OF_V_C)

    return read_as("a velocity such as 1e-3, 1mm/s or 0.5v_c", read)


def stand_in_of_v_c(case: mdr.SlidingContact) -> str:
    """What stands in the place of v_c in a curve's velocities, in a sentence; empty where v_c does."""
    wrong = _no_scale(mdr.critical_velocity(case))
    return wrong and f"{wrong}: velocities are multiples of {velocity_scale(case):.6g} m/s in its place"


def _no_scale(v_c: float) -> str:
    """Why velocities cannot be multiples of this v_c; empty where they can."""
    return "" if 0 < v_c < math.inf else f"v_c is {'zero' if v_c == 0 else 'infinite'} here"
