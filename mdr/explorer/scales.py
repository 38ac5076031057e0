"""Sizes that suit a case, by names of fields, and the dimensionless groups that it has."""

from __future__ import annotations

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.normal.resolved import at_rest
from mdr.normal.vary import GROUPS, fields_of, value_at

SMALL, DAMPED, NATURAL = 0.1, 0.1, 2.0  #: amplitude over mean, damping ratio, omega_0/omega


def scales_of(case: SlidingContact) -> dict[str, float]:
    """Sizes [SI] of fields that the case may not have, to two digits: where a slider or a new part begins.

    A contact of its depth, an amplitude of a tenth, a spring as stiff as the contact, a body of twice the frequency.
    """
    case = at_rest(case)
    depth = case.contact_depth
    k_zc = float(case.indenter.stiffness(depth, case.material.E_star))
    load, k_x = float(case.indenter.force(depth, case.material.E_star)), k_zc / case.material.mindlin_ratio
    m = k_x / (NATURAL * case.omega) ** 2
    sizes = {
        "u_z0": depth,
        "du_z": SMALL * depth,
        "F_z0": load,
        "dF_z": SMALL * load,
        "m_z": k_zc / (NATURAL * case.omega) ** 2,
        "tau": SMALL / case.omega,
        "k_x": k_x,
        "m": m,
        "c_x": 2 * DAMPED * float(np.sqrt(k_x * m)),
        "du_x": case.mu_0 * case.material.mindlin_ratio * depth / 2,
    }
    return {name: float(f"{size:.2g}") for name, size in sizes.items()} | {"omega": case.omega}


def group_values(case: SlidingContact) -> dict[str, float]:
    """The groups that the case has and that can be set in it, with their values [-]."""
    own = [path for path, at in GROUPS.items() if _has(case, *at.split("."))]
    values = {path: value_at(case, path) for path in own}
    return {path: value for path, value in values.items() if np.isfinite(value)}


def _has(case: SlidingContact, slot: str, field: str) -> bool:
    return field in fields_of(getattr(case, slot))
