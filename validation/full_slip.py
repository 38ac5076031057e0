"""One period of full slip as arrays: what the claims on it are measured on."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.normal.followed_force import N_STEPS
from mdr.normal.normal_force import edge_of, followed, normal_force
from mdr.normal.resolved import resolved
from mdr.tools.arrays import Array
from mdr.tools.checks import count
from mdr.tools.records import ArrayRecord


@dataclass(frozen=True, eq=False, repr=False)
class FullSlip(ArrayRecord):
    """One period of full slip at equidistant instants; arrays of shape (n_t,)."""

    t: Array  #: time [s]
    F_N: Array  #: normal force [N]
    contact_radius: Array  #: edge of the contact a(g_c) [m]
    u_z_dot: Array  #: rate of the depth [m/s]
    in_contact: NDArray[np.bool_]  #: whether any spring touches


def full_slip(case: SlidingContact, n_t: int = N_STEPS) -> FullSlip:
    """The normal force and the contact of a case over one period, at n_t instants."""
    case = resolved(case)
    cycle = case.cycle
    n_t = count("n_t", n_t, 16)
    phase = 2 * np.pi * np.arange(n_t) / n_t
    u_z_dot = cycle.omega * cycle.unit * cycle.over_a_period(n_t)[1][:-1]
    if case.material.contact_arms:
        known = followed(case, n_t)
        radius, in_contact = known.contact_radius, known.in_contact
    else:
        g_c = np.maximum(cycle.u_z0 + cycle.unit * edge_of(case).gap(phase), 0)
        radius, in_contact = np.asarray(case.indenter.contact_radius(g_c)), g_c > 0
    return FullSlip(phase / cycle.omega, normal_force(case, phase), radius, u_z_dot, in_contact)
