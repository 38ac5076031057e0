"""The pulling velocities of a study, given as they are or over the critical velocity of each case."""

from __future__ import annotations

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.closed_forms.critical_velocity import critical_velocity
from mdr.tools.arrays import Array


def velocities_of(case: SlidingContact, path: str, values: Array) -> Array:
    """Pulling velocities [m/s] of an axis "v_0" or "v_0/v_c" for this very case."""
    if path == "v_0":
        return values
    v_c = critical_velocity(case)
    if not 0 < v_c < np.inf:
        what = "zero" if v_c == 0 else "infinite, as on an undamped resonance"
        raise ValueError(f"v_0/v_c: the critical velocity of this case is {what}, so that its multiples say nothing")
    return values * v_c
