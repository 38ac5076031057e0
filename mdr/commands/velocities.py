"""Velocities on the command line: in m/s or another unit, or as multiples of the critical velocity."""

from __future__ import annotations

import argparse
import math
import re
from collections.abc import Callable
from typing import NamedTuple

from mdr.case.contact import SlidingContact
from mdr.closed_forms.critical_velocity import critical_velocity, velocity_scale
from mdr.commands.output import WrongInput
from mdr.tools.notation import UNITS

OF_V_C = "v_c"  #: unit of a multiple of the critical velocity
_UNITS = UNITS["m/s"] | {OF_V_C: 1.0}
_WRITTEN = re.compile(rf"(?P<number>.*?)\s*(?P<unit>{'|'.join(map(re.escape, _UNITS))})?", re.DOTALL)


_NEGATIVE = re.compile(r"-[\d.]")  #: how a value begins that is no option


class Velocity(NamedTuple):
    """A velocity as it was given."""

    number: float  #: in m/s, or a multiple of v_c
    of_v_c: bool

    def on(self, case: SlidingContact) -> float:
        """The velocity [m/s] for a case. Raises WrongInput for a multiple where v_c is infinite or zero."""
        if not self.of_v_c:
            return self.number
        v_c = critical_velocity(case, -1 if self.number < 0 else 1)
        if not _is_scale(v_c):
            raise WrongInput(f"{self.number:g}v_c: v_c is {_called(v_c)} here; give the velocity in m/s")
        return self.number * v_c


def let_values_be_negative(command: argparse.ArgumentParser) -> None:
    """Let -1e-3 and -0.5v_c be values of options; argparse itself knows -1 and -0.001 alone."""
    command._negative_number_matcher = _NEGATIVE


def velocity_in(usual: str) -> Callable[[str], Velocity]:
    """What argparse reads a velocity with; usual: the unit of a plain number, "m/s" or "v_c"."""

    def read(text: str) -> Velocity:
        found = _WRITTEN.fullmatch(text.strip())
        assert found is not None
        unit = found["unit"] or usual
        try:
            number = float(found["number"])
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            raise argparse.ArgumentTypeError(f"must be a velocity such as 1e-3, 1mm/s or 0.5v_c, got {text!r}")
        return Velocity(number * _UNITS[unit], unit == OF_V_C)

    return read


def stand_in_of_v_c(case: SlidingContact) -> str:
    """What stands in the place of v_c in a curve's velocities, in a sentence; empty where v_c does."""
    v_c = critical_velocity(case)
    if _is_scale(v_c):
        return ""
    return f"v_c is {_called(v_c)} here: velocities are multiples of {velocity_scale(case):.6g} m/s in its place"


def _is_scale(v_c: float) -> bool:
    return math.isfinite(v_c) and v_c > 0


def _called(v_c: float) -> str:
    return "zero" if v_c == 0 else "infinite"
