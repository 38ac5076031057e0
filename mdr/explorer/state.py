"""What is explored: a case and the pulling velocity of one run, in SI or by dimensionless groups.

In groups, those of the case and v_0/v_c are held while anything else changes; in SI the fields are.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any

import numpy as np

from mdr.case.contact import SlidingContact, as_given
from mdr.closed_forms.critical_velocity import critical_velocity, velocity_scale
from mdr.explorer.scales import group_values, scales_of
from mdr.files.case_files import nameable
from mdr.files.examples import PULLS, STILL, example
from mdr.normal.vary import case_at, value_at
from mdr.tools.checks import finite, positive

V_0 = 0.5  #: of the velocity scale of a case: where its first run is


@dataclass(frozen=True)
class State:
    """A case and a velocity; `of` makes the first one of a case. Every change answers a new state or raises."""

    case: SlidingContact
    v_0: float  #: pulling velocity of the run [m/s]
    in_groups: bool = False  #: whether groups and v_0/v_c are held, not fields and v_0

    @classmethod
    def of(cls, case: SlidingContact) -> State:
        """The case and half of its velocity scale."""
        return cls(case, _first(case))

    @property
    def v_c(self) -> float | None:
        """Critical velocity [m/s] in closed form, None where it is no scale: zero, or infinite."""
        v_c = critical_velocity(self.case)
        return v_c if 0 < v_c < np.inf else None

    def value(self, path: str) -> Any:
        """The value at a path: a field, a group, or the velocity."""
        if path == "v_0":
            return self.v_0
        if path == "v_0/v_c":
            return self.v_0 / (self.v_c or np.nan)
        return value_at(as_given(self.case), path)

    def changed(self, path: str, value: Any) -> State:
        """The state with another value at a path. ValueError or TypeError, as its record words it."""
        if path in ("v_0", "v_0/v_c"):
            return self._pulled_at(path, value)
        held = {name: one for name, one in group_values(self.case).items() if self.in_groups and name != path}
        return self._with(case_at(as_given(self.case), {path: value, **held, **self._followers(path, value)}))

    def with_kind(self, slot: str, name: str) -> State:
        """The state with another kind of a part; what it shares with the one before keeps its value."""
        case: Any = as_given(self.case)
        if name == STILL:
            return self._with(replace(case, **{slot: None}))
        old, new, known = getattr(case, slot), _example(slot, name), scales_of(case)
        known |= {one.name: getattr(old, one.name) for one in fields(old)} if is_dataclass(old) else {}
        shared = {one.name: known[one.name] for one in fields(new) if one.init and one.name in known}
        if slot == "oscillation" and not new.omega and case.shake is None:
            case = self.with_kind("shake", "InPlaneOscillation").case
        try:
            return self._with(replace(case, **{slot: replace(new, **shared)}))
        except (TypeError, ValueError):  # what has the same name may mean another thing
            return self._with(replace(case, **{slot: new}))

    def _pulled_at(self, path: str, value: Any) -> State:
        v_0 = finite(path, value) if self.case.is_shaken else positive(path, value, "pulling velocity")
        return replace(self, v_0=v_0 if path == "v_0" else v_0 * (self.v_c or np.nan))

    def _followers(self, path: str, value: Any) -> dict[str, float]:
        """A shake keeps the ratio of its frequency to that of the oscillation."""
        if path != "oscillation.omega" or self.case.shake is None or not self.case.oscillation.omega:
            return {}
        ratio = self.case.shake.omega / self.case.oscillation.omega
        return {"shake.omega": ratio * positive("omega", value, "angular frequency in rad/s")}

    def _with(self, case: SlidingContact) -> State:
        """Another case at the velocity that is held: v_0/v_c in groups; one that the case can be pulled at. ValueError
        where a case is not what its parts are one by one, as a load that is more than the shape carries.
        """
        velocity_scale(case)  # asks for its depth
        after = replace(self, case=case)
        if self.in_groups and self.v_c and after.v_c:
            after = replace(after, v_0=self.v_0 / self.v_c * after.v_c)
        return after if case.is_shaken or after.v_0 > 0 else replace(after, v_0=_first(case))


def _first(case: SlidingContact) -> float:
    """Velocity [m/s] of a first run, to three digits."""
    return float(f"{V_0 * velocity_scale(case):.3g}")


def kinds_of(slot: str) -> list[str]:
    """Names of what a part can be."""
    if slot == "pull":
        return list(PULLS)
    return [*([STILL] if slot == "shake" else []), *(name for name in nameable()[slot] if _has_example(slot, name))]


def kind_of(case: SlidingContact, slot: str) -> str:
    """What a part of the case is."""
    part = getattr(as_given(case), slot)
    return STILL if part is None else type(part).__name__


def _example(slot: str, name: str) -> Any:
    argument = {"indenter": "shape", "oscillation": "motion"}.get(slot, slot)
    return getattr(example(**{argument: name}), slot)


def _has_example(slot: str, name: str) -> bool:
    try:
        return _example(slot, name) is not None
    except ValueError:  # a class of a user's own
        return False
