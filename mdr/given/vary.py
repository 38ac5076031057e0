"""A case with other values at some of its paths (`mdr.case.paths`): fields first, then what sets them, in order.

alpha = du_z/u_z0 sets oscillation.du_z, or the amplitudes of a series together, chi = du_x/(mu_0 kappa u_z0)
shake.du_x, eta = du_y/(mu_0 kappa u_z0) shake.du_y, T = omega tau material.tau, k_x/k_xc pull.k_x, and omega_0/omega
= sqrt(k_x/m)/omega pull.m. Of what a rig is set to, load [N] sets F_z0, or of a prescribed depth u_z0, at which this
load rests, or beside hold = "load" about which it is the mean load; frequency [Hz] sets omega of all that moves;
tan_delta = omega tau sets material.tau; and the acceleration of the support of a mass sets dF_z and m_z.

All fields of a record are set together, so that only the record as a whole has to be sound. The stiffness that k_x/k_xc
refers to is solved for under a load, which is why this stands above the normal problem.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from mdr.case.contact import KINDS, SlidingContact, as_given
from mdr.case.friction import Friction
from mdr.case.motion import Motion, PeriodicMotion
from mdr.case.paths import HOLD, RIG, SET, fields_set, hold_of, set_in, slot_of
from mdr.given.mean_load import under_mean_load, warn_of_mean_loads
from mdr.materials import KelvinVoigt
from mdr.normal.load_control import static_depth, static_load
from mdr.normal.normal_force import mean_normal_force
from mdr.normal.resolved import at_rest, resolved
from mdr.tools.arrays import SAME
from mdr.tools.checks import positive
from mdr.tools.fields import fields_of
from mdr.tools.notation import GRAVITY

MOVING = ("oscillation", "shake")


def still_held(held: Mapping[str, Any], paths: Iterable[str]) -> dict[str, Any]:
    """What is held besides, where none of these paths sets it too. ValueError for what cannot be held."""
    paths = list(paths)
    if not isinstance(held, Mapping):
        raise TypeError(f"held must be a dict such as {{'load': 5.0}}, got {held!r}")
    if unknown := [path for path in held if path not in (*RIG, HOLD)]:
        raise ValueError(f"held takes {', '.join((*RIG, HOLD))}, got {unknown[0]!r}")
    if HOLD in held and "load" not in (*held, *paths):
        raise ValueError(f"hold says what stays of a load: hold {{'load': ..., 'hold': {held[HOLD]!r}}}")
    taken = {field for path in paths for field in fields_set(path)}
    kept: dict[str, Any] = {
        path: SET[path].checked(path, value)
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


def warn_of_load(settings: Mapping[str, Any], case: SlidingContact, where: str = "", way_out: str = "") -> None:
    """Warn where the mean load of the case is another than the load whose depth at rest these settings gave it."""
    if (asked := load_asked(settings, case)) is not None:
        warn_of_mean_loads([(asked, mean_normal_force(case))], where, way_out)


def case_at(case: SlidingContact, settings: Mapping[str, Any]) -> SlidingContact:
    """The case with these paths set to these values; what its records refuse is raised as they word it."""
    return contact_of({slot: getattr(case, slot) for slot in KINDS}, settings)


def contact_of(parts: Mapping[str, Any], settings: Mapping[str, Any]) -> SlidingContact:
    """The contact of these parts with these paths set to these values."""
    parts = {slot: settings.get(slot, part) for slot, part in parts.items()}
    changes: dict[str, dict[str, Any]] = {slot: {} for slot in KINDS}

    def changed(slot: str) -> Any:
        part: Any = parts.get(slot)
        if not changes[slot]:
            return part
        return part.varied(**changes[slot]) if isinstance(part, Friction) else replace(part, **changes[slot])

    for path, value in settings.items():
        slot, field = slot_of(path)
        if field and path not in (*_PATHS, HOLD):
            _require_field(path, parts.get(slot), field)
            changes[slot][field] = value
    if "frequency" in settings:
        _one_omega("frequency", *map(parts.get, MOVING))
        omega = SET["frequency"].told("frequency", settings["frequency"])
        for slot in MOVING:
            if "omega" in fields_of(parts.get(slot)):
                changes[slot]["omega"] = omega
    if "load" in settings:
        load, hold = SET["load"].checked("load", settings["load"]), hold_of(settings.get(HOLD, "depth"))
        if "F_z0" in fields_of(parts["oscillation"]):
            changes["oscillation"]["F_z0"] = load
        else:
            _require_field("load", parts["oscillation"], "u_z0")
            rest = static_depth(changed("indenter"), changed("material"), load)
            changes["oscillation"]["u_z0"] = rest
            if hold == "load":
                return _under_mean_load(parts, settings, changed("oscillation"), load, rest)
    if "support_acceleration" in settings:
        _require_field("support_acceleration", parts["oscillation"], "dF_z")
        changes["oscillation"] |= _of_support(parts["oscillation"], changes["oscillation"], settings)
    if "alpha" in settings and isinstance(parts["oscillation"], PeriodicMotion):
        series = changed("oscillation")
        if settings["alpha"] * series.u_z0 <= 0:
            raise ValueError(f"alpha must be positive about a depth above zero, got {settings['alpha']!r}")
        series = series.with_amplitude(settings["alpha"] * series.u_z0)
        changes["oscillation"] |= {"cos": series.cos, "sin": series.sin}
    elif "alpha" in settings:
        _require_field("alpha", parts["oscillation"], "du_z")
        u_z0 = changes["oscillation"].get("u_z0", parts["oscillation"].u_z0)
        changes["oscillation"]["du_z"] = settings["alpha"] * u_z0
    contact = SlidingContact(**{slot: changed(slot) for slot in parts})
    for path, of in _PATHS.items():
        if path in settings and of.field is not None:
            contact = _with(contact, path, of.field(contact, path, settings[path]))
    return contact


def _of_support(motion: Any, changes: Mapping[str, Any], settings: Mapping[str, Any]) -> dict[str, float]:
    """Amplitude of the load [N] and mass [kg] of what stands on a support that is accelerated: m_z u_z'' = F_z0 + m_z a
    - F_N, seen from there. A mass that is not given, or whose weight is the load, is that of the load.
    """
    a = SET["support_acceleration"].checked("support_acceleration", settings["support_acceleration"])
    load, m_z = changes.get("F_z0", motion.F_z0), changes.get("m_z", motion.m_z)
    if changes.get("m_z") == 0:
        raise ValueError(
            "support_acceleration moves a mass, and m_z = 0 is none: leave m_z out for the mass whose weight is the "
            "load, give it in kg, or give dF_z in N for a load that no mass brings about"
        )
    if m_z == 0 or math.isclose(m_z * GRAVITY, motion.F_z0, rel_tol=SAME):
        m_z = load / GRAVITY
    return {"m_z": m_z, "dF_z": m_z * a}


def _under_mean_load(
    parts: Mapping[str, Any], settings: Mapping[str, Any], motion: Motion, load: float, rest: float
) -> SlidingContact:
    """The contact with these settings about the mean depth at which the load is its mean load; motion: about `rest`."""
    others = {path: value for path, value in settings.items() if path not in ("load", HOLD)}

    def at(u_z0: float) -> SlidingContact:
        return contact_of(parts, {**others, "oscillation.u_z0": u_z0})

    cycle = motion.cycle
    alpha = max(settings["alpha"], 0.0) if "alpha" in settings else None
    least = rest - cycle.unit * cycle.greatest if alpha is None else rest / (1 + alpha * cycle.greatest)
    return under_mean_load(at, load, least, rest)


def value_at(case: SlidingContact, path: str, hold: str = "depth") -> Any:
    """The value of a case at a path, a group [-] and what a rig is set to included; hold: what the load is of.

    Infinite where there is no spring, mass or depth for it. Raises ValueError where the shape does not carry the load,
    and KeyError or AttributeError for what is no path.
    """
    if path == "load" and hold == "load":
        return mean_normal_force(case)
    if path in _PATHS:
        return _PATHS[path].value(case)
    slot, field = slot_of(path)
    part = getattr(case, slot)
    return getattr(part, field) if field else part


# --- there: the field that a path sets in a contact ---


def _tau(contact: SlidingContact, path: str, value: Any) -> float:
    if path == "T":
        return float(value / contact.omega)
    if not isinstance(contact.material, KelvinVoigt):
        raise ValueError(f"tan_delta is of KelvinVoigt alone, and the material is {type(contact.material).__name__}")
    tan_delta = SET[path].checked(path, value)
    return tan_delta / _one_omega(path, contact.oscillation, contact.shake)


def _amplitude(contact: SlidingContact, path: str, value: Any) -> float:
    """An amplitude of the shake, over the deflection at which springs slip."""
    if value == 0:
        return 0.0
    unit = value_at(_with(contact, path, 1.0), path)
    if not np.isfinite(unit):
        way = fields_set(path)[0].partition(".")[2]
        raise ValueError(
            f"{path}: the contact has no mean depth u_z0 > 0, which {path} = {way}/(mu_0 kappa u_z0) refers to"
        )
    return float(value / unit)


def _stiffness(contact: SlidingContact, path: str, value: Any) -> float:
    k_xc = at_rest(contact).k_xc
    if k_xc == 0:
        raise ValueError(f"{path}: the contact has no stiffness at its mean depth, which a ratio could refer to")
    return float(value * k_xc)


def _mass(contact: SlidingContact, path: str, value: Any) -> float:
    _require_field(path, contact.pull, "k_x")
    return float(contact.pull.coefficients[2] / (positive(path, value) * contact.omega) ** 2)


# --- and back ---


def _load(case: SlidingContact) -> float:
    motion: Any = as_given(case).oscillation
    load = getattr(motion, "F_z0", None)
    return static_load(case.indenter, case.material, motion.u_z0) if load is None else float(load)


def _of_load(case: SlidingContact) -> float:
    motion: Any = as_given(case).oscillation
    _require_field("support_acceleration", motion, "dF_z")
    return float(motion.dF_z / motion.m_z) if motion.m_z else np.inf


def _stiffness_ratio(case: SlidingContact) -> float:
    known = at_rest(case)
    return known.pull.coefficients[2] / known.k_xc if known.k_xc else np.inf


def _common_omega(case: SlidingContact, path: str) -> float:
    return _one_omega(path, as_given(case).oscillation, case.shake)


def _one_omega(path: str, *moving: Any) -> float:
    """The one angular frequency [rad/s] of what moves."""
    found = [one.omega for one in moving if one is not None and one.omega]
    if not found:
        raise ValueError(f"{path} needs something that moves at a frequency: an oscillation or a shake")
    if max(found) > (1 + SAME) * min(found):
        way_out = "give tau" if path == "tan_delta" else "give omega of each"
        raise ValueError(f"{path} belongs to one frequency, and oscillation and shake have two: {way_out}")
    return float(found[0])


def _require_field(path: str, record: Any, field: str) -> None:
    if record is None:
        raise ValueError(f"{path}: nothing shakes in the plane; give the case a shake")
    if field not in set_in(record):
        raise ValueError(f"{path}: {type(record).__name__} has no {field}")


def _with(contact: SlidingContact, path: str, value: float) -> SlidingContact:
    """The contact with the field that a path sets."""
    slot, _, field = fields_set(path)[0].partition(".")
    record = getattr(contact, slot)
    _require_field(path, record, field)
    return replace(contact, **{slot: replace(record, **{field: value})})


# --- both ---


class _Path(NamedTuple):
    """A path that is no field: its value in a case, and the value of the field that it sets in a contact."""

    value: Callable[[SlidingContact], float]
    field: Callable[[SlidingContact, str, Any], float] | None = None  #: None where it is set before there is a contact


#: in the order in which they are set
_PATHS = {
    "frequency": _Path(lambda case: _common_omega(case, "frequency") / (2 * math.pi)),
    "load": _Path(_load),
    "support_acceleration": _Path(_of_load),
    "alpha": _Path(lambda case: resolved(case).alpha),
    "tan_delta": _Path(lambda case: _common_omega(case, "tan_delta") * float(getattr(case.material, "tau", 0.0)), _tau),
    "T": _Path(lambda case: case.T, _tau),
    "chi": _Path(lambda case: at_rest(case).chi, _amplitude),
    "eta": _Path(lambda case: at_rest(case).eta, _amplitude),
    "k_x/k_xc": _Path(_stiffness_ratio, _stiffness),
    "omega_0/omega": _Path(lambda case: case.pull.omega_0 / case.omega, _mass),
}
