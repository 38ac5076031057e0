"""A case with other values at some of its paths: fields first, then the dimensionless groups in their order.

A path is a field ("mu_0", "indenter", "material.tau") or a group: alpha = du_z/u_z0 sets oscillation.du_z, chi =
du_x/(mu_0 kappa u_z0) shake.du_x, eta = du_y/(mu_0 kappa u_z0) shake.du_y, T = omega tau material.tau, k_x/k_xc
pull.k_x, and omega_0/omega = sqrt(k_x/m)/omega pull.m. Or it is what a rig is set to: load [N] sets F_z0, or of a
prescribed depth u_z0, at which this load rests, or beside hold = "load" about which it is the mean load; frequency [Hz]
sets omega of all that moves; and tan_delta = omega tau sets material.tau.

All fields of a record are set together, so that only the record as a whole has to be sound. The stiffness that k_x/k_xc
refers to is solved for under a load, which is why this stands beside the normal problem.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np

from mdr.case.contact import KINDS, SlidingContact, as_given
from mdr.case.motion import Motion
from mdr.materials import KelvinVoigt
from mdr.normal.load_control import static_depth, static_load
from mdr.normal.mean_load import hold_of, under_mean_load
from mdr.normal.normal_force import mean_normal_force
from mdr.normal.resolved import at_rest, resolved
from mdr.tools.arrays import SAME
from mdr.tools.checks import not_negative, positive

GROUPS = {
    "alpha": "oscillation.du_z",
    "chi": "shake.du_x",
    "eta": "shake.du_y",
    "T": "material.tau",
    "k_x/k_xc": "pull.k_x",
    "omega_0/omega": "pull.m",
}
#: what rigs are set to, and the fields, of which one (load) or all that are there (frequency) are set
RIG = {
    "load": ("oscillation.F_z0", "oscillation.u_z0"),
    "frequency": ("oscillation.omega", "shake.omega"),
    "tan_delta": ("material.tau",),
}
HOLD = "hold"  #: beside a load: whether the depth at which it rests stays, or the mean load
MOVING = ("oscillation", "shake")


def fields_set(path: str) -> tuple[str, ...]:
    """The fields, of which one or all are set by a path."""
    return RIG.get(path, (GROUPS.get(path, path),))


def still_held(held: Mapping[str, Any], paths: Iterable[str]) -> dict[str, Any]:
    """What is held besides, where none of these paths sets it too. ValueError for what cannot be held."""
    paths = list(paths)
    if unknown := [path for path in held if path not in (*RIG, HOLD)]:
        raise ValueError(f"held takes {', '.join((*RIG, HOLD))}, got {unknown[0]!r}")
    if HOLD in held and "load" not in (*held, *paths):
        raise ValueError(f"hold says what stays of a load: hold {{'load': ..., 'hold': {held[HOLD]!r}}}")
    taken = {field for path in paths for field in fields_set(path)}
    kept: dict[str, Any] = {
        path: positive(path, value) if path != "tan_delta" else not_negative(path, value)
        for path, value in held.items()
        if path != HOLD and not any(taken & {field, field.partition(".")[0]} for field in fields_set(path))
    }
    if HOLD in held and "load" in (*kept, *paths):
        kept[HOLD] = hold_of(held[HOLD])
    return kept


def load_asked(settings: Mapping[str, Any], case: SlidingContact) -> float | None:
    """The load [N] whose depth at rest these settings gave the case; None where no depth is driven, or hold said."""
    driven = case.oscillation.knows_depth and HOLD not in settings
    return settings.get("load") if driven else None


def case_at(case: SlidingContact, settings: Mapping[str, Any]) -> SlidingContact:
    """The case with these paths set to these values; what its records refuse is raised as they word it."""
    return contact_of({slot: getattr(case, slot) for slot in KINDS}, {"mu_0": case.mu_0, **settings})


def contact_of(parts: Mapping[str, Any], settings: Mapping[str, Any]) -> SlidingContact:
    """The contact of these parts with these paths, mu_0 among them, set to these values."""
    parts = {slot: settings.get(slot, part) for slot, part in parts.items()}
    changes: dict[str, dict[str, Any]] = {slot: {} for slot in KINDS}

    def changed(slot: str) -> Any:
        return replace(parts[slot], **changes[slot]) if changes[slot] else parts.get(slot)

    for path, value in settings.items():
        slot, _, field = path.partition(".")
        if field:
            _require_field(path, parts.get(slot), field)
            changes[slot][field] = value
    if "frequency" in settings:
        _one_omega("frequency", *map(parts.get, MOVING))
        omega = angular(settings["frequency"])
        for slot in MOVING:
            if "omega" in fields_of(parts.get(slot)):
                changes[slot]["omega"] = omega
    if "load" in settings:
        load, hold = positive("load", settings["load"], "mean load in N"), hold_of(settings.get(HOLD, "depth"))
        if "F_z0" in fields_of(parts["oscillation"]):
            changes["oscillation"]["F_z0"] = load
        else:
            _require_field("load", parts["oscillation"], "u_z0")
            rest = static_depth(changed("indenter"), changed("material"), load)
            changes["oscillation"]["u_z0"] = rest
            if hold == "load":
                return _under_mean_load(parts, settings, changed("oscillation"), load, rest)
    if "alpha" in settings:
        _require_field("alpha", parts["oscillation"], "du_z")
        u_z0 = changes["oscillation"].get("u_z0", parts["oscillation"].u_z0)
        changes["oscillation"]["du_z"] = settings["alpha"] * u_z0
    contact = SlidingContact(mu_0=settings["mu_0"], **{slot: changed(slot) for slot in parts})
    if "tan_delta" in settings:
        if not isinstance(material := contact.material, KelvinVoigt):
            raise ValueError(f"tan_delta is of KelvinVoigt alone, and the material is {type(material).__name__}")
        tan_delta = not_negative("tan_delta", settings["tan_delta"], "loss tangent")
        contact = _with(contact, "T", tan_delta / _one_omega("tan_delta", contact.oscillation, contact.shake))
    if "T" in settings:
        contact = _with(contact, "T", settings["T"] / contact.omega)
    for group, way in (("chi", "du_x"), ("eta", "du_y")):
        if group in settings:
            contact = _shaken_by(contact, group, way, settings[group])
    if "k_x/k_xc" in settings:
        contact = _with(contact, "k_x/k_xc", settings["k_x/k_xc"] * _stiffness(contact))
    if "omega_0/omega" in settings:
        _require_field("omega_0/omega", contact.pull, "k_x")
        omega_0 = positive("omega_0/omega", settings["omega_0/omega"]) * contact.omega
        contact = _with(contact, "omega_0/omega", contact.pull.coefficients[2] / omega_0**2)
    return contact


def _under_mean_load(
    parts: Mapping[str, Any], settings: Mapping[str, Any], motion: Motion, load: float, rest: float
) -> SlidingContact:
    """The contact with these settings about the mean depth at which the load is its mean load; motion: about `rest`."""
    others = {path: value for path, value in settings.items() if path not in ("load", HOLD)}

    def at(u_z0: float) -> SlidingContact:
        return contact_of(parts, {**others, "oscillation.u_z0": u_z0})

    swing = motion.cycle.unit * motion.cycle.greatest
    least = rest / (1 + max(settings["alpha"], 0.0)) if "alpha" in settings else rest - swing
    return under_mean_load(at, load, least, rest)


def value_at(case: SlidingContact, path: str, hold: str = "depth") -> Any:
    """The value of a case at a path, a group [-] and what a rig is set to included; hold: what the load is of.

    Infinite where there is no spring, mass or depth for it. Raises ValueError where the shape does not carry the load,
    and KeyError or AttributeError for what is no path.
    """
    if path in GROUPS:
        return _group(case, path)
    if path in RIG:
        return mean_normal_force(case) if path == "load" and hold == "load" else _setting(case, path)
    slot, _, field = path.rpartition(".")
    return getattr(getattr(case, slot) if slot else case, field)


def _group(case: SlidingContact, path: str) -> float:
    if path == "T":
        return case.T
    if path == "alpha":
        return resolved(case).alpha
    if path == "omega_0/omega":
        return case.pull.omega_0 / case.omega
    known = at_rest(case)
    if path in ("chi", "eta"):
        return float(getattr(known, path))
    return known.pull.coefficients[2] / known.k_xc if known.k_xc else np.inf


def _setting(case: SlidingContact, path: str) -> float:
    """What a rig is set to that makes this case."""
    motion: Any = as_given(case).oscillation
    if path != "load":
        omega = _one_omega(path, motion, case.shake)
        return omega / (2 * math.pi) if path == "frequency" else omega * float(getattr(case.material, "tau", 0.0))
    load = getattr(motion, "F_z0", None)
    return static_load(case.indenter, case.material, motion.u_z0) if load is None else float(load)


def angular(frequency: Any) -> float:
    """Angular frequency [rad/s] of a frequency [Hz]."""
    return 2 * math.pi * positive("frequency", frequency, "in Hz")


def _one_omega(path: str, *moving: Any) -> float:
    """The one angular frequency [rad/s] of what moves."""
    found = [one.omega for one in moving if one is not None and one.omega]
    if not found:
        raise ValueError(f"{path} needs something that moves at a frequency: an oscillation or a shake")
    if max(found) > (1 + SAME) * min(found):
        way_out = "give tau" if path == "tan_delta" else "give omega of each"
        raise ValueError(f"{path} belongs to one frequency, and oscillation and shake have two: {way_out}")
    return float(found[0])


def fields_of(record: Any) -> tuple[str, ...]:
    """Names of the fields that can be set in a record; none of what is no dataclass."""
    return tuple(one.name for one in fields(record) if one.init) if is_dataclass(record) else ()


def _require_field(path: str, record: Any, field: str) -> None:
    if record is None:
        raise ValueError(f"{path}: nothing shakes in the plane; give the case a shake")
    if field not in fields_of(record):
        raise ValueError(f"{path}: {type(record).__name__} has no {field}")


def _with(contact: SlidingContact, group: str, value: float) -> SlidingContact:
    """The contact with the field that a group sets."""
    slot, _, field = GROUPS[group].partition(".")
    record = getattr(contact, slot)
    _require_field(group, record, field)
    return replace(contact, **{slot: replace(record, **{field: value})})


def _shaken_by(contact: SlidingContact, group: str, way: str, value: float) -> SlidingContact:
    """The contact with an amplitude of its shake, over the deflection at which springs slip."""
    if value == 0:
        return _with(contact, group, 0.0)
    contact = _with(contact, group, 1.0)  # until the depth is known that it refers to
    if not np.isfinite(unit := _group(contact, group)):
        raise ValueError(
            f"{group}: the contact has no mean depth u_z0 > 0, which {group} = {way}/(mu_0 kappa u_z0) refers to"
        )
    return _with(contact, group, value / unit)


def _stiffness(contact: SlidingContact) -> float:
    """k_xc [N/m], of a contact that has one."""
    k_xc = at_rest(contact).k_xc
    if k_xc == 0:
        raise ValueError("k_x/k_xc: the contact has no stiffness at its mean depth, which a ratio could refer to")
    return k_xc
