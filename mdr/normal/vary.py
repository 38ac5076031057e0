"""A case with other values at some of its paths: fields first, then the dimensionless groups in their order.

A path is a field ("mu_0", "indenter", "material.tau") or a group: alpha = du_z/u_z0 sets oscillation.du_z, chi =
du_x/(mu_0 kappa u_z0) shake.du_x, T = omega tau material.tau, k_x/k_xc pull.k_x, and omega_0/omega = sqrt(k_x/m)/omega
pull.m.

All fields of a record are set together, so that only the record as a whole has to be sound. The stiffness that k_x/k_xc
refers to is solved for under a load, which is why this stands beside the normal problem.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np

from mdr.case.contact import KINDS, SlidingContact, common_frequency
from mdr.normal.resolved import at_rest, resolved
from mdr.tools.checks import positive

GROUPS = {
    "alpha": "oscillation.du_z",
    "chi": "shake.du_x",
    "T": "material.tau",
    "k_x/k_xc": "pull.k_x",
    "omega_0/omega": "pull.m",
}
MOVING = ("oscillation", "shake")


def case_at(case: SlidingContact, settings: Mapping[str, Any]) -> SlidingContact:
    """The case with these paths set to these values; what its records refuse is raised as they word it."""
    parts = {slot: settings.get(slot, getattr(case, slot)) for slot in KINDS}
    changes: dict[str, dict[str, Any]] = {slot: {} for slot in KINDS}
    for path, value in settings.items():
        slot, _, field = path.partition(".")
        if field:
            _require_field(path, parts[slot], field)
            changes[slot][field] = value
    if "alpha" in settings:
        _require_field("alpha", parts["oscillation"], "du_z")
        u_z0 = changes["oscillation"].get("u_z0", parts["oscillation"].u_z0)
        changes["oscillation"]["du_z"] = settings["alpha"] * u_z0
    if "T" in settings:
        _require_field("T", parts["material"], "tau")
        moving = (replace(parts[slot], **changes[slot]) if changes[slot] else parts[slot] for slot in MOVING)
        changes["material"]["tau"] = settings["T"] / common_frequency(*moving)
    if "chi" in settings:
        _require_field("chi", parts["shake"], "du_x")
        changes["shake"]["du_x"] = 1.0  # until the depth is known that it refers to
    changed = {slot: replace(part, **changes[slot]) if changes[slot] else part for slot, part in parts.items()}
    contact = SlidingContact(mu_0=settings.get("mu_0", case.mu_0), **changed)
    if "chi" in settings:
        kept: Any = contact.shake
        if not np.isfinite(unit := at_rest(contact).chi):
            raise ValueError(
                "chi: the contact has no mean depth u_z0 > 0, which chi = du_x/(mu_0 kappa u_z0) refers to"
            )
        shake = replace(kept, du_x=settings["chi"] / unit)
        contact = replace(contact, shake=shake)
    if "k_x/k_xc" in settings:
        contact = _with_pull(contact, "k_x/k_xc", "k_x", settings["k_x/k_xc"] * _stiffness(contact))
    if "omega_0/omega" in settings:
        _require_field("omega_0/omega", contact.pull, "k_x")
        omega_0 = positive("omega_0/omega", settings["omega_0/omega"]) * contact.omega
        pull: Any = contact.pull
        contact = _with_pull(contact, "omega_0/omega", "m", pull.k_x / omega_0**2)
    return contact


def value_at(case: SlidingContact, path: str) -> Any:
    """The value of a case at a path, a group [-] included; infinite where there is no spring, mass or depth for it.

    Raises ValueError where the shape does not carry the load, and KeyError or AttributeError for what is no path.
    """
    if path in GROUPS:
        return _group(case, path)
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
    if path == "chi":
        return known.chi
    return known.pull.coefficients[2] / known.k_xc if known.k_xc else np.inf


def fields_of(record: Any) -> tuple[str, ...]:
    """Names of the fields that can be set in a record; none of what is no dataclass."""
    return tuple(one.name for one in fields(record) if one.init) if is_dataclass(record) else ()


def _require_field(path: str, record: Any, field: str) -> None:
    if record is None:
        raise ValueError(f"{path}: nothing shakes in the plane; give the case a shake")
    if field not in fields_of(record):
        raise ValueError(f"{path}: {type(record).__name__} has no {field}")


def _with_pull(contact: SlidingContact, path: str, field: str, value: float) -> SlidingContact:
    _require_field(path, contact.pull, field)
    pull: Any = contact.pull
    return replace(contact, pull=replace(pull, **{field: value}))


def _stiffness(contact: SlidingContact) -> float:
    """k_xc [N/m], of a contact that has one."""
    k_xc = at_rest(contact).k_xc
    if k_xc == 0:
        raise ValueError("k_x/k_xc: the contact has no stiffness at its mean depth, which a ratio could refer to")
    return k_xc
