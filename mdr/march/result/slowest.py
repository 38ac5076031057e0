"""How slowly a body moves at its slowest, period by period of the vibration: whether it sticks and slips."""

from __future__ import annotations

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.case.domain import NO_STRENGTH, WITH_MASS, holds_for, where_it_falls
from mdr.march.dynamics.body import U
from mdr.march.dynamics.stepper import Stepper
from mdr.march.periodic.repeats import DRAWN
from mdr.march.periodic.steady import LEAST_ACCURATE, at_hand, check, resolves
from mdr.march.periodic.waiting import pre_sliding
from mdr.march.result.refinement import resolution_of
from mdr.normal.resolved import resolved
from mdr.tools.checks import positive

MOST = 10**6  #: periods that are marched
TAKEN = (WITH_MASS, *where_it_falls(NO_STRENGTH))


@holds_for(*TAKEN, instead="slide(case, v_0)", of=resolved)
def least_velocity(case: SlidingContact, v_0: float) -> float:
    """Least velocity [m/s] of a body that is pulled from rest, averaged over one period of the vibration.

    v_0 where each period is like the one before. Next to zero where the body sticks and slips in a rhythm of its own:
    periods pass in which the contact does not slip, and the body moves with it by v_0 k_x/(k_x + k_xc), or swings on
    it. Within a period it may be less, as the vibration rocks the body: up and down by mu_k dF_z/(m omega).

    Parameters
    ----------
    case : SlidingContact
        A body with a mass.
    v_0 : float
        Pulling velocity [m/s].

    Returns
    -------
    float
        The least mean velocity [m/s] of a period in the second half of a march. This lasts eight times as long as the
        pull takes to stretch spring and contact, and the body to swing once.

    Raises
    ------
    ValueError
        For another case, and for a march of more than a million periods.

    Examples
    --------
    >>> import mdr
    >>> case = mdr.SlidingContact(
    ...     mdr.FlatPunch(1e-3), mdr.Elastic(3e6, 0.4), oscillation=mdr.NormalOscillation(20e-6, 2e-6, 6000.0),
    ...     friction=mdr.StaticKinetic(0.6, 0.4), pull=mdr.SpringPull(k_x=500.0, m=0.01, c_x=0.5),
    ... )
    >>> [round(mdr.least_velocity(case, v_0) / v_0, 2) for v_0 in (1e-3, 50e-3)]
    [-1.04, 0.97]
    """
    v_0 = positive("v_0", v_0, "pulling velocity in m/s")
    check(case, v_0)
    resolution = resolution_of(case, None, None, LEAST_ACCURATE, "rest", True, 0)
    _, scaled = at_hand(case, resolution)
    resolves(scaled, resolution)
    stepper = Stepper(scaled, v_0 / scaled.units.speed)
    swing = np.sqrt(scaled.body.M / scaled.body.K)
    half = int(np.ceil(DRAWN / 2 * (pre_sliding(scaled, stepper.v) + swing)))
    if 2 * half > MOST:
        raise ValueError(
            f"v_0 = {v_0:g} m/s stretches the spring so slowly that it takes {2 * half} periods of the vibration, more "
            f"than {MOST}: raise v_0 or k_x, or lower the frequency"
        )
    state, _ = stepper.advance(stepper.rest(), half)
    went = np.inf
    for _ in range(half):
        before, state = state.body[U], stepper.period(state)
        went = min(went, (state.body[U] - before).real)
    return float(v_0 + went / (2 * np.pi) * scaled.units.speed)
