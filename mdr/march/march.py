"""One march of a contact: prepared, brought to its steady state, looked at closely.

From full slip the periodic state of a body is searched for (orbit_search.py). Where none is found, and from rest, the
march goes on until it settles (waiting.py). Under a rigid pull it needs a period or two. Then its last periods are
looked at closely: modes, forces and energies. If its core was lumped and turns out not to move as one, the march is
done again with every spring for itself. A COF that contradicts a theorem (theorems.py) is not called settled.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.march import kernels
from mdr.march.dimensionless import ScaledContact
from mdr.march.orbit_search import Orbit, at_other_resolution, gain_at_other_resolution, search, search_from_full_slip
from mdr.march.steady_state import TOLERANCE, Settling
from mdr.march.stepper import MarchState, PeriodRecord, Stepper
from mdr.march.theorems import outside
from mdr.march.waiting import Waiting, way_from_rest
from mdr.normal.springs import SpringArray
from mdr.tools.memoise import remembered

DEEPEST = 1e9  #: u_z0/du_z, beyond which the amplitude is lost in the rounding of an extension
FASTEST = 1e15  #: v_0 over Eq. (1), beyond which nothing but the pull is left in the digits of a slip velocity
MOST_SHARED = 8192  #: springs of arrays that are kept for further runs
MOST_BESIDE = 512  #: periods that a run beside another waits whose periodic state is not found from that one
MAX_PERIODS = {"rigid": 65536, "spring": 8192}  #: after which a run is called unsettled


@dataclass(frozen=True)
class Knobs:
    """What a march may choose: resolution, start, and what to keep."""

    n_springs: int
    steps: int
    start: str
    lump: bool
    record: int = 0

    def coarser(self, steps: int | None = None, n_springs: int | None = None) -> Knobs:
        """The knobs of a companion with other steps or springs, that keeps nothing."""
        return replace(
            self, n_springs=max(n_springs or self.n_springs, 16), steps=max(steps or self.steps, 16), record=0
        )


@dataclass(frozen=True, eq=False)
class March:
    """A finished march: what it said of itself, still in scaled form."""

    case: SlidingContact
    v_0: float
    knobs: Knobs
    scaled: ScaledContact
    springs: SpringArray
    settling: Settling
    n_periods: int
    on_the_way: float  # periods that a run from rest takes to stretch springs and system
    mean_F_z: float
    account: PeriodRecord  # the period that modes and energies are taken from
    record: tuple[PeriodRecord, ...]  # all observed periods
    state: MarchState  # before the observed periods

    @property
    def cof(self) -> float:
        """COF over mu_0."""
        return self.settling.mean

    @property
    def sees_contact(self) -> bool:
        """Whether any spring presses for longer than an instant between two steps."""
        sums = self.account.seen.sums
        return bool(sums[kernels.CONTACT_TIME] > 0 and np.isfinite(sums[kernels.LEAST_SLIP]))

    @property
    def least_slip(self) -> float:
        """Least slip velocity in contact over v_0 of a run in full slip; zero of any other."""
        sums = self.account.seen.sums
        full = float(sums[kernels.STICK_TIME]) == 0 and abs(1 - self.cof) < 1e-12
        return float(sums[kernels.LEAST_SLIP]) * self.scaled.speed / self.v_0 if full else 0.0


def march(
    case: SlidingContact, v_0: float, knobs: Knobs, n_periods: int | None = None, near: March | None = None
) -> March:
    """March until settled, or exactly n_periods; the last ones observed.

    near: a march of the case at other resolution, whose periodic state is a good one to search from.
    """
    cycle = case.cycle
    if cycle.u_z0 > DEEPEST * cycle.du_z:
        raise ValueError(
            f"the amplitude du_z = {cycle.du_z:g} m is less than {1 / DEEPEST:g} of u_z0 and lost in the rounding of a "
            "march; raise it: 1 - cof/mu_0 is proportional to it there"
        )
    if v_0 > FASTEST * case.unit_velocity:
        raise ValueError(
            f"v_0 = {v_0:g} m/s is {FASTEST:g} times Eq. (1) or more, full slip but for rounding; lower it"
        )
    springs, scaled = at_hand(case, knobs)
    if not scaled.normal.mean > 0:
        raise too_coarse(knobs.steps)
    stepper, n_seen = Stepper(scaled, v_0 / scaled.speed), max(1, knobs.record)
    from_full_slip = knobs.start == "full_slip"
    waiting = Waiting(
        stepper,
        stepper.full_slip() if from_full_slip else stepper.rest(),
        0.0 if from_full_slip else way_from_rest(scaled, stepper.v),
    )
    if n_periods is None:
        orbit = _steady(stepper, waiting, from_full_slip, near)
    else:
        waiting.advance(n_periods - n_seen)
        orbit = None
    start = state = waiting.state if orbit is None else orbit.state
    records = []
    for _ in range(n_seen):
        state, record = stepper.observe(state, keep=knobs.record > 0)
        records.append(record)
    periods = [waiting.periods if orbit is None else orbit.period, *(record.period for record in records)]
    if not all(np.isfinite(one.cof).all() for one in periods):
        raise ValueError(f"the run left the range of floats at v_0 = {v_0:g} m/s: use units nearer to one")
    as_one = all(one.as_one for one in periods)
    if not as_one and knobs.lump:  # the core did not move as one after all: every spring for itself
        return march(case, v_0, replace(knobs, lump=False), n_periods, near)
    if orbit is None:
        for record in records:
            waiting.append(record.period)
        settling = waiting.assess()
    else:
        settling = orbit.settling
    account = records[0] if n_periods is None else records[-1]  # the same period however many are kept
    if settling.settled and (why := _contradiction(stepper, account, settling)):
        settling = replace(settling, settled=False, kind="unsettled", why=why, contradicts=True)
    return March(
        case,
        v_0,
        knobs,
        scaled,
        springs,
        settling,
        stepper.n_periods,
        waiting.on_the_way,
        stepper.mean_F_z,
        account,
        tuple(records),
        start,
    )


def _steady(stepper: Stepper, waiting: Waiting, from_full_slip: bool, near: March | None) -> Orbit:
    """The steady state, solved for if it can be, awaited else."""
    scaled, orbit = stepper.scaled, None
    if near is not None and near.settling.solved:
        start = at_other_resolution(near.state, near.scaled, waiting.state, scaled)
        orbit = search(stepper, (start,), gain_at_other_resolution(near.settling.gain, near.scaled, scaled))
    if orbit is None and from_full_slip and (scaled.n_arms or not scaled.rigid):
        orbit = search_from_full_slip(stepper)
    most = MAX_PERIODS["rigid" if scaled.rigid else "spring"] if near is None else MOST_BESIDE
    return orbit or waiting.wait(most)


def _contradiction(stepper: Stepper, account: PeriodRecord, settling: Settling) -> str:
    """Why the COF that a march has settled at cannot be one; nothing if it can."""
    least = float(account.seen.F_z.min()) / stepper.mean_F_z
    # between two nodes F_z may be lower by h² F_z''/8, and means over nodes miss as much
    return outside(settling.mean, least, settling.spread + TOLERANCE + 10 * stepper.scaled.h**2)


def touches(case: SlidingContact, knobs: Knobs) -> bool:
    """Whether any spring presses at the instants of these steps."""
    scaled = at_hand(case, knobs)[1]
    return scaled.n_core > 0 or scaled.normal.mean > 0


def too_coarse(steps: int) -> ValueError:
    """The error of a contact that the steps do not see."""
    return ValueError(
        f"steps_per_period = {steps} is too coarse: the contact begins and ends within a step; "
        "raise it, or press deeper"
    )


def at_hand(case: SlidingContact, knobs: Knobs) -> tuple[SpringArray, ScaledContact]:
    """Springs and their scaled form; runs of one case at other velocities share them."""
    prepared = _shared if knobs.n_springs <= MOST_SHARED else _prepared
    return prepared(case, knobs.n_springs, knobs.steps, knobs.lump and knobs.start == "full_slip")


@remembered(maxsize=16)
def _shared(case: SlidingContact, n_springs: int, steps: int, lump: bool) -> tuple[SpringArray, ScaledContact]:
    return _prepared(case, n_springs, steps, lump)


def _prepared(case: SlidingContact, n_springs: int, steps: int, lump: bool) -> tuple[SpringArray, ScaledContact]:
    springs = SpringArray.of(case, n_springs)
    return springs, ScaledContact.of(case, springs, steps, lump)
