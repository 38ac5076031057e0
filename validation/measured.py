"""A critical velocity measured from runs alone, the two formulas that it is compared with, and how far these differ."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

import mdr
from mdr.friction.measured_velocity import MeasuredVelocity
from mdr.tools.arrays import Array

TOLERANCE = 2e-5 + (2 * np.pi / 1024) ** 2  #: bracket of a measurement, and second order in its step, over v_c

RUN = "what a run promises when it chooses step and springs itself"  #: why a COF is that good

SHARP = 3e-5  #: under a rigid pull: the bracket on either side, and h²/6 by which a mean over a step misses least slip


@dataclass(frozen=True)
class Point:
    """One contact and its measured critical velocity; ratios are NaN where none was found."""

    case: mdr.SlidingContact
    found: MeasuredVelocity
    where: str  #: the contact in words
    shape: str = ""  #: this and the next are what points are told by where a claim varies them
    alpha: float = np.nan
    T: float = np.nan  #: omega tau
    pull: Any = None  #: the name of the pull, or omega_0/omega of the body

    @property
    def u_z0(self) -> float:
        """Mean depth [m]."""
        return self.case.oscillation.u_z0

    @property
    def v_c(self) -> float:
        """Measured [m/s]."""
        return np.nan if self.found.v_c is None else self.found.v_c

    @property
    def over_rigid(self) -> float:
        """Measured over Eq. (1)."""
        return self.v_c / self.case.unit_velocity

    @property
    def deviation(self) -> float:
        """Measured over Eq. (15), less 1."""
        return self.v_c / mdr.critical_velocity(self.case) - 1

    @property
    def miss(self) -> float:
        """Measured over the full-slip value, less 1."""
        return self.v_c / mdr.full_slip_critical_velocity(self.case) - 1

    @property
    def in_bracket(self) -> bool:
        """Whether the full-slip value lies in the bracket of this very measurement."""
        return self.found.contains(mdr.full_slip_critical_velocity(self.case))


def measured(case: mdr.SlidingContact, where: str, *told: Any) -> Point:
    """Measure the critical velocity of a case from runs alone."""
    return Point(case, mdr.measure_critical_velocity(case), where, *told)


def lost(case: mdr.SlidingContact, v_0: float, **knobs: Any) -> float:
    """1 - |mu|/mu_0 by a run."""
    return 1 - abs(mdr.slide(case, v_0, **knobs).cof) / case.mu_0


def deviation(case: mdr.SlidingContact) -> float:
    """Full-slip value over Eq. (15), less 1."""
    return mdr.full_slip_critical_velocity(case) / mdr.critical_velocity(case) - 1


def slope_at_zero(one: mdr.SlidingContact, two: mdr.SlidingContact) -> float:
    """`deviation` over alpha for alpha -> 0: from two cases, the second of twice the amplitude of the first."""
    a, b = (deviation(case) / case.alpha for case in (one, two))
    return 2 * a - b


def with_band(case: mdr.SlidingContact, r: Array, unit: float) -> tuple[Array, Array]:
    """v_0 over a unit [m/s] and COF/mu_0 to be drawn: runs at the velocities r but 0, there what the contact holds.

    The two points at rest are the limits v_0 -> -0 and +0, so that a line through all has a vertical part.
    """
    moving, band = r[np.abs(r) > 1e-9], mdr.holding_band(case)
    cof, at = mdr.cof_curve(case, moving * unit).cof, int(np.searchsorted(moving, 0.0))
    return np.insert(moving, at, (0.0, 0.0)), np.insert(cof, at, (band.low, band.high)) / case.mu_0


def power(x: Any, y: Any) -> float:
    """Power of x with which y goes: slope of the least-squares line of the logarithms."""
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])


def worst(values: Iterable[float], expected: float) -> float:
    """The value furthest from the expected one; NaN where there is any."""
    return max(values, key=lambda value: np.inf if np.isnan(value) else abs(value - expected))
