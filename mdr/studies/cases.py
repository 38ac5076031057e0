"""From the values of a point to its case: fields first, then the dimensionless groups in their order.

All fields of a record are set together, so that only the record as a whole has to be sound.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.checks import positive
from mdr.contact import KINDS, SlidingContact
from mdr.studies.axes import fields_of
from mdr.theory import critical_velocity

Array = NDArray[np.float64]


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
        omega = changes["oscillation"].get("omega", parts["oscillation"].omega)
        changes["material"]["tau"] = settings["T"] / omega
    changed = {slot: replace(part, **changes[slot]) if changes[slot] else part for slot, part in parts.items()}
    contact = SlidingContact(mu_0=settings.get("mu_0", case.mu_0), **changed)
    if "k_x/k_xc" in settings:
        contact = _with_pull(contact, "k_x/k_xc", "k_x", settings["k_x/k_xc"] * _stiffness(contact))
    if "omega_0/omega" in settings:
        _require_field("omega_0/omega", contact.pull, "k_x")
        omega_0 = positive("omega_0/omega", settings["omega_0/omega"]) * contact.oscillation.omega
        pull: Any = contact.pull
        contact = _with_pull(contact, "omega_0/omega", "m", pull.k_x / omega_0**2)
    return contact


def velocities_of(case: SlidingContact, path: str, values: Array) -> Array:
    """Pulling velocities [m/s] of an axis "v_0" or "v_0/v_c" for this very case."""
    if path == "v_0":
        return values
    v_c = critical_velocity(case)
    if not 0 < v_c < np.inf:
        what = "zero" if v_c == 0 else "infinite, as on an undamped resonance"
        raise ValueError(f"v_0/v_c: the critical velocity of this case is {what}, so that its multiples say nothing")
    return values * v_c


def _require_field(path: str, record: Any, field: str) -> None:
    if field not in fields_of(record):
        raise ValueError(f"{path}: {type(record).__name__} has no {field}")


def _with_pull(contact: SlidingContact, path: str, field: str, value: float) -> SlidingContact:
    _require_field(path, contact.pull, field)
    pull: Any = contact.pull
    return replace(contact, pull=replace(pull, **{field: value}))


def _stiffness(contact: SlidingContact) -> float:
    """k_xc [N/m], of a contact that has one."""
    k_xc = contact.k_xc
    if k_xc == 0:
        raise ValueError("k_x/k_xc: the contact has no stiffness at its mean depth, which a ratio could refer to")
    return k_xc
