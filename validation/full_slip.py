"""One period of full slip as arrays: what the claims on it are measured on."""

import numpy as np

import mdr
from mdr.normal.followed_force import N_STEPS
from mdr.normal.normal_force import normal_force
from mdr.tools.arrays import Array


def full_slip(case: mdr.SlidingContact, n_t: int = N_STEPS) -> tuple[Array, Array]:
    """The normal force [N] and the rate of the depth [m/s] at n_t equidistant instants of a period."""
    cycle = case.cycle
    u_z_dot = cycle.omega * cycle.unit * cycle.over_a_period(n_t)[1][:-1]
    return normal_force(case, 2 * np.pi * np.arange(n_t) / n_t), u_z_dot
