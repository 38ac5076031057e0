"""What is explored: a case and the pulling velocity of one run, in SI or by dimensionless groups.

In groups, those of the case and v_0/v_c are held while anything else changes; in SI the fields are. A new part begins
at what it shares with the one before, and else at sizes that suit the case.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from mdr.case.contact import KINDS, SlidingContact, as_given
from mdr.case.paths import GROUPS, SET
from mdr.closed_forms.critical_velocity import UP_TO, critical_velocity, velocity_scale
from mdr.files.examples import PARTS, STILL, WAVEFORMS
from mdr.given.vary import case_at, value_at
from mdr.normal.resolved import at_rest
from mdr.tools.checks import finite, positive
from mdr.tools.fields import fields_of

DECADE = 10.0  #: how far a slider goes to both sides of the first value, and a curve beyond the velocity scale


@dataclass(frozen=True)
class State:
    """A case and a velocity; `of` makes the first one of a case. Every change answers a new state or raises."""

    case: SlidingContact
    v_0: float  #: pulling velocity of the run [m/s]
    in_groups: bool = False  #: whether groups and v_0/v_c are held, not fields and v_0
    #: fields that kinds left behind had, by path, for when they come back; and under "" a shake that came of itself
    kept: Mapping[str, Any] = field(default_factory=dict, compare=False, repr=False)

    @classmethod
    def of(cls, case: SlidingContact) -> State:
        """The case and the middle of its curve."""
        return cls(case, _first(case))

    @property
    def v_c(self) -> float | None:
        """Critical velocity [m/s] in closed form, None where it is no scale: zero, or infinite."""
        v_c = critical_velocity(self.case)
        return v_c if 0 < v_c < np.inf else None

    def value(self, path: str) -> Any:
        """The value at a path: a field, a group, or the velocity; of a part what it is, by name."""
        if path == "v_0":
            return self.v_0
        if path == "v_0/v_c":
            return self.v_0 / (self.v_c or np.nan)
        value = value_at(as_given(self.case), path)
        return value if path not in PARTS else STILL if value is None else type(value).__name__

    def changed(self, path: str, value: Any) -> State:
        """The state with another value at a path. ValueError or TypeError, as its record words it."""
        case = self.case
        if path in PARTS:
            return self._with_kind(path, value)
        if path in ("v_0", "v_0/v_c"):
            v_0 = finite(path, value) if case.is_shaken else positive(path, value, "pulling velocity")
            return replace(self, v_0=v_0 if path == "v_0" else v_0 * (self.v_c or np.nan))
        settings = {path: value}
        if self.in_groups:
            settings |= {name: one for name, one in group_values(case).items() if name != path}
        if path == "oscillation.omega" and case.shake is not None and case.oscillation.omega:
            ratio = case.shake.omega / case.oscillation.omega  # is kept
            settings["shake.omega"] = ratio * positive("omega", value, "angular frequency in rad/s")
        return self._with(case_at(as_given(case), settings))

    def _with_kind(self, slot: str, name: str) -> State:
        """The state with another kind of a part. What it shares with the one before keeps its value, and what it had
        when it was left comes back.
        """
        case: Any = as_given(self.case)
        old, new = getattr(case, slot), PARTS[slot][name]
        now = {one: getattr(old, one) for one in fields_of(old)}
        state = replace(self, kept={**self.kept, **{f"{slot}.{one}": value for one, value in now.items()}})
        if new is None:
            return state._with(replace(case, **{slot: None}))
        mine = {path.partition(".")[2]: one for path, one in state.kept.items() if path.startswith(f"{slot}.")}
        sizes, others = scales_of(self.case), {}
        if slot == "shake":
            mine["omega"] = sizes["omega"]
        if slot == "oscillation" and not new.omega and case.shake is None:  # else nothing would move
            shaken = state._with_kind("shake", "InPlaneOscillation")
            case, state = shaken.case, replace(shaken, kept={**shaken.kept, "": shaken.case.shake})
        elif slot == "oscillation" and new.omega and case.shake is not None and case.shake == state.kept.get(""):
            others = {"shake": None}
        if slot == "oscillation" and name in WAVEFORMS:  # falls as far as what moves now
            known, moves = sizes | now, old.knows_depth and old.omega
            fall = -old.cycle.unit * old.cycle.least if moves else sizes["du_z"]
            wave = WAVEFORMS[name](known["u_z0"], fall, known["omega"] or sizes["omega"])
            return state._with(replace(case, **others, oscillation=wave))
        for known in (sizes | mine | now, sizes | now):
            shared = {one: known[one] for one in fields_of(new) if one in known}
            with suppress(TypeError, ValueError):  # what has the same name may mean another thing
                return state._with(replace(case, **others, **{slot: replace(new, **shared)}))
        return state._with(replace(case, **others, **{slot: new}))

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
    return float(f"{UP_TO / 2 * velocity_scale(case):.3g}")


def group_values(case: SlidingContact) -> dict[str, float]:
    """The groups that the case has and that can be set in it, with their values [-]."""
    own = [path for path in GROUPS if any(SET[path].field_of(slot, type(getattr(case, slot))) for slot in KINDS)]
    values = {path: value_at(case, path) for path in own}
    return {path: value for path, value in values.items() if np.isfinite(value)}


def scales_of(case: SlidingContact) -> dict[str, float]:
    """Sizes [SI] of fields that the case may not have, to two digits: where a slider or a new part begins.

    A contact of its depth, an amplitude of a tenth, a spring as stiff as the contact, a body of twice the frequency.
    """
    case = at_rest(case)
    depth, kappa = case.contact_depth, case.material.mindlin_ratio
    k_zc = float(case.indenter.stiffness(depth, case.material.E_star))
    load, k_x = float(case.indenter.force(depth, case.material.E_star)), k_zc / kappa
    small = 0.1  # of an amplitude over its mean, a damping ratio, a loss tangent: where nothing leaves the plane
    natural = 2.0 * case.omega  # of a new body: off resonance
    m = k_x / natural**2
    reach = case.reach(depth)
    a = float(case.indenter.contact_radius(depth))
    sizes = {
        "u_z0": depth,
        "du_z": small * depth,
        "F_z0": load,
        "dF_z": small * load,
        "m_z": k_zc / natural**2,
        "tau": small / case.omega,
        "k_x": k_x,
        "m": m,
        "c_x": 2 * small * float(np.sqrt(k_x * m)),
        "tau_0": float(case.friction.full(load, a)) / (np.pi * a**2),  # bears as much
        "du_x": reach / 2,
        "du_y": reach / 2,
    }
    return {name: float(f"{size:.2g}") for name, size in sizes.items()} | {"omega": case.omega}
