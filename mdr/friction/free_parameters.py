"""What a fit may vary: a number of the case, the scale on which it is searched for, and the range of the search.

A number that is positive is searched for by its logarithm, so that its scale does not matter. One that may change sign,
such as a phase, one that begins at zero, and one whose bounds reach zero, is searched for on a linear scale, in the
unit that the contact makes of it: depths in the greatest depth, times in 1/omega, stiffnesses in that of the contact.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.case.paths import GROUPS, HOLD, RIG, facts_at, one_name, paths_of
from mdr.given.vary import case_at, value_at
from mdr.materials.base import poisson_ratio_of
from mdr.normal.resolved import at_rest, resolved
from mdr.tools.allowed import last_allowed, refusal_of
from mdr.tools.arrays import SAME
from mdr.tools.checks import ends
from mdr.tools.messages import offer, short

DECADES = 3.0  #: of the search for a positive parameter to either side; an interval that is wider says nothing
NEAR_END = 1e-3  #: of the range: a best fit nearer to an end is at it, and no search begins nearer


@dataclass(frozen=True)
class Parameter:
    """One number that is fitted; its coordinate is the logarithm of the value, or the value over `unit`."""

    name: str  #: as given
    path: str  #: in the case
    start: float  #: value in the case, in SI
    low: float  #: ends of the search
    high: float
    unit: float  #: of a linear scale; 0 for that of the logarithm

    @classmethod
    def of(cls, case: SlidingContact, name: Any, given: Any, held: Mapping[str, Any]) -> Parameter:
        """A parameter of the case, by its name, with what is held; `given`: bounds, None for as far as is sensible."""
        path = path_of(case, name)
        start = value_of(case, path, held)
        if why := _refusal(case, path, start, held):
            raise ValueError(f"{name} cannot be varied: {why}")
        unit = natural_unit(case, path, start)
        signed = path != "mindlin_ratio" and not _refusal(case, path, -1e-9 * unit, held)
        bounds = None if given is None else _bounds(case, name, path, start, given, held)
        if signed or start == 0 or path == "mindlin_ratio" or (bounds and bounds[0] <= 0):
            # ten units to either side, of an angle half a turn
            away = unit * (np.pi if facts_at(path).unit == "rad" else 10.0)
            reach = start - away, start + away
        else:
            unit, reach = 0.0, (start / 10**DECADES, start * 10**DECADES)
        low, high = bounds or (allowed(case, path, start, end, held) for end in reach)
        return cls(name, path, start, low, high, unit)

    def coordinate(self, value: float) -> float:
        """Where a value stands on the scale of the search."""
        return value / self.unit if self.unit else float(np.log(value))

    def value(self, x: float) -> float:
        """The value at a coordinate, within the range."""
        inside = min(max(x, self.coordinate(self.low)), self.coordinate(self.high))
        return float(min(max(inside * self.unit if self.unit else np.exp(inside), self.low), self.high))

    def told(self, x: float) -> str:
        """The value at a coordinate as it is printed."""
        return f"{self.value(x):.4g} {self.symbol}".rstrip()

    @property
    def ends(self) -> tuple[float, float]:
        """Coordinates of the ends of the search."""
        return self.coordinate(self.low), self.coordinate(self.high)

    @property
    def first(self) -> float:
        """Coordinate at which the search begins: that of the case, a little inside the range."""
        low, high = self.ends
        margin = NEAR_END * (high - low)
        return min(max(self.coordinate(self.start), low + margin), high - margin)

    @property
    def widest(self) -> float:
        """Width of an interval, on the scale of the search, from which on it says nothing."""
        low, high = self.ends
        return high - low if self.unit else min(high - low, float(np.log(10)) * DECADES)

    @property
    def symbol(self) -> str:
        """Its unit, "" for a pure number."""
        unit = "" if self.path == "mindlin_ratio" else facts_at(self.path).unit
        return "" if unit == "-" else unit


def case_of(case: SlidingContact, values: Mapping[str, Any]) -> SlidingContact:
    """The case with these values at these paths; mindlin_ratio sets Poisson's ratio."""
    settings: dict[str, Any] = dict(values)
    if "mindlin_ratio" in settings:
        settings["material.nu"] = poisson_ratio_of(settings.pop("mindlin_ratio"))
    return case_at(case, settings)


def path_of(case: SlidingContact, name: Any) -> str:
    """The path of a parameter in the case."""
    if not isinstance(name, str):
        raise TypeError(f"parameters must be names, got {short(repr(name))}")
    numbers = [path for path in paths_of(case) if isinstance(value_at(case, path), int | float)]
    if one_name(name) in ("mindlin_ratio", *GROUPS, *RIG, *numbers):
        return one_name(name)
    ends = [path for path in numbers if path.partition(".")[2] == name]
    if len(ends) == 1:
        return ends[0]
    short_names = ["mindlin_ratio", *(path.rpartition(".")[2] for path in numbers)]
    meant = f"is {' or '.join(ends)}" if ends else f"is no parameter of this case; {offer(name, short_names)}"
    raise ValueError(f"{short(name)} {meant}")


def value_of(case: SlidingContact, path: str, held: Mapping[str, Any]) -> float:
    """The value in the case, or what is held; zero of a group for which it has no spring, mass or depth."""
    if path in held:
        return float(held[path])
    hold = held.get(HOLD, "depth")
    value = float(case.material.mindlin_ratio if path == "mindlin_ratio" else value_at(case, path, hold))
    return value if np.isfinite(value) else 0.0


def natural_unit(case: SlidingContact, path: str, start: float) -> float:
    """What the contact makes a unit of a quantity that has this value, in SI."""
    known, omega = resolved(case), case.omega
    depth, E_star = known.u_z_max, case.material.E_star
    k = float(case.indenter.stiffness(depth, E_star))
    if path == "tau_0":  # as much as bears the load by a coefficient of one
        return float(case.indenter.force(depth, E_star)) / (np.pi * float(case.indenter.contact_radius(depth)) ** 2)
    units = {
        "m": depth, "s": 1 / omega, "Pa": E_star, "N": k * depth, "N/m": k, "N s/m": k / omega, "kg": k / omega**2,
        "rad/s": omega, "rad": 1.0, "-": 1.0,
    }  # fmt: skip
    return units.get(facts_at(path).unit) or abs(start) or 1.0


def changed(case: SlidingContact, path: str, value: float, held: Mapping[str, Any]) -> SlidingContact:
    """The case with another value at a path, and what is held."""
    return case_of(case, {**held, path: value})


def _refusal(case: SlidingContact, path: str, value: float, held: Mapping[str, Any]) -> str:
    """Why the case cannot have this value; "" where it can."""
    return refusal_of(lambda: at_rest(changed(case, path, value, held)))


def allowed(case: SlidingContact, path: str, start: float, end: float, held: Mapping[str, Any]) -> float:
    """The end of a range, or the value nearest to it that the case can have."""
    return last_allowed(lambda value: at_rest(changed(case, path, value, held)), start, end, SAME)


def _bounds(
    case: SlidingContact, name: str, path: str, start: float, given: Any, held: Mapping[str, Any]
) -> tuple[float, float]:
    """The ends of the search that were given."""
    low, high = ends(f"bounds of {name}", given)
    for end in (low, high):
        if why := _refusal(case, path, end, held):
            raise ValueError(f"bounds of {name}: {end:.6g} is no value of it: {why}")
    if not low <= start <= high:
        raise ValueError(
            f"bounds of {name} must hold the value of the case, where the search begins: {start:.6g} is not in "
            f"{low:.6g} to {high:.6g}; change the case or the bounds"
        )
    return low, high
