"""One march of a contact, brought to its steady state.

The periodic state is searched for from full slip (search.py). Where none is found, and from rest, the march goes on
until the COF settles (waiting.py). Springs under a rigid pull are independent: elastic ones along a line need two
periods from full slip; those with arms, and those in the plane, are solved for one by one (each_alone.py).

All this rests on friction that does not fall as springs are let go: two motions never move apart, so that the state is
one of one period and shooting has a gain; that of an elastic spring is below full slip (`_after_two_periods`); the map
of a period does not jump (each_alone.py); no force is above that of full slip (`within_friction`); what springs lack
that do not slip back is alike (`cut_of`, order.py). Where friction falls, repeats.py marches.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.march.dynamics.dimensionless import ScaledContact
from mdr.march.dynamics.stepper import TOLERANCE, Stepper
from mdr.march.periodic.each_alone import search_alone
from mdr.march.periodic.orbit import Orbit
from mdr.march.periodic.repeats import repeated
from mdr.march.periodic.search import at_other_resolution, gain_at_other_resolution, search, search_from_full_slip
from mdr.march.periodic.settling import Settling
from mdr.march.periodic.shooting import FULL
from mdr.march.periodic.waiting import Waiting, pre_sliding
from mdr.normal.springs import SpringArray, springs_of
from mdr.tools.checks import finite
from mdr.tools.memoise import remembered

DEEPEST = 1e9  #: u_z0/du_z, beyond which the amplitude is lost in the rounding of an extension
#: v_0 over mu_0 kappa omega du_z, Eq. (1), beyond which slip velocity and v_0 are the same but for rounding
FASTEST = 1e15
BUDGET = 1e-5  #: of cof/mu_0, bound on its error that a run is to meet
MOST_ACCURATE, LEAST_ACCURATE = 1e-8, 1e-3  #: that can be asked for
MOST_BESIDE = 512  #: most periods of a companion, or of a finer run, whose periodic state is not found
MAX_PERIODS = {"rigid": 65536, "spring": 8192}  #: after which a run is called unsettled


def accuracy_of(value: Any) -> float:
    """An accuracy that can be asked for; ValueError or TypeError of any other."""
    number = finite("accuracy", value)
    if not MOST_ACCURATE <= number <= LEAST_ACCURATE:
        rule = f"accuracy must lie between {MOST_ACCURATE:g} and {LEAST_ACCURATE:g}"
        raise ValueError(f"{rule}, a bound on the error of cof over mu_0, got {number!r}")
    return number


class Resolution(NamedTuple):
    """Settings of a march: numbers of springs and steps, its start, what to keep, and how accurate it has to be."""

    n_springs: int
    steps: int  #: of a period
    start: str  #: initial state, "full_slip" or "rest"
    lump: bool  #: whether springs that move as one are computed once
    record: int = 0  #: last periods that are kept with all forces and springs
    accuracy: float = BUDGET  #: bound on the error of cof/mu_0 that is asked for
    free: tuple[bool, bool] = (False, False)  #: whether springs and steps are doubled until the error is within it
    bounded: bool = True  #: whether companions, runs of fewer springs and steps, bound the error
    cut: float = np.inf  #: gap [amplitudes] at which the row of springs is cut (order.py); infinite: not cut

    def of_size(self, steps: int | None = None, n_springs: int | None = None) -> Resolution:
        """The resolution of a companion with these steps or springs, at least 16 of each; it keeps no record."""
        return self._replace(
            n_springs=max(n_springs or self.n_springs, 16), steps=max(steps or self.steps, 16), record=0
        )


@dataclass(frozen=True, eq=False)
class MarchEnd:
    """The end of a march, settled or not, before or after its last periods are looked at; state and COF are scaled."""

    case: SlidingContact
    v_0: float  #: velocity of the pull [m/s]
    resolution: Resolution
    springs: SpringArray
    stepper: Stepper
    orbit: Orbit  #: state and COF at the end
    n_periods: int  #: marched so far
    waited: Waiting | None  #: the march that led here; None where the periodic state was solved for
    awaits: bool  #: whether n_periods were asked for, so that periods that are looked at count for settling too
    #: bound on that of cof/mu_0, 0 in full slip or if unsettled; None where no companion was run
    error: float | None = None

    @property
    def scaled(self) -> ScaledContact:
        """The contact in scaled form."""
        return self.stepper.scaled

    @property
    def settling(self) -> Settling:
        """Whether it has settled, and at which COF."""
        return self.orbit.settling

    @property
    def pre_sliding(self) -> float:
        """Periods of pre-sliding: those that a run from rest takes to stretch springs and pull; zero from full slip."""
        return 0.0 if self.waited is None else self.waited.pre_sliding

    @property
    def cof(self) -> float:
        """Mean friction over that of full slip: COF over mu_0."""
        return self.settling.mean

    @property
    def load_error(self) -> float:
        """Relative error of the mean normal force under a load that is given; zero where the depth is."""
        load, units = self.case.oscillation.load, self.scaled.units
        mean = self.scaled.normal.mean
        return 0.0 if load is None else abs(mean * units.stiffness_z * units.length_z / load.F_z0 - 1)

    @property
    def hidden_error(self) -> float:
        """Error over mu_0 that no companion shows: of the load, or of the depth that was solved from it, of slow arms
        that are taken for springs, and of stick at the edge of contact that no run sees (Limit.unseen).
        """
        of_depth = max(self.case.cycle.missing, self.load_error)
        return of_depth + self.stepper.unseen(self.orbit.state) + (0.0 if self.slips_fully else self.scaled.slow.error)

    @property
    def to_begin_from(self) -> MarchEnd | None:
        """Itself, if other runs may begin in its periodic state; None in full slip, where they begin anyway."""
        return self if self.settling.solved and not self.slips_fully else None

    @property
    def slips_fully(self) -> bool:
        """Whether the COF is mu_0 to rounding: full slip."""
        return abs(1 - self.cof) < FULL

    @property
    def least_slip(self) -> float:
        """Least slip velocity in contact, over v_0 or the greatest velocity of a shake if that is more; zero unless the
        run is in full slip.
        """
        return self.orbit.least_slip / self.scaled.drive.pace(self.stepper.v) if self.slips_fully else 0.0

    def unsettled(self, why: str, contradicts: bool = False) -> MarchEnd:
        """The same, not settled. contradicts: whether its COF contradicts a theorem."""
        return self.judged(replace(self.settling, settled=False, kind="unsettled", why=why, contradicts=contradicts))

    def judged(self, settling: Settling) -> MarchEnd:
        """The same, with another judgement of whether it has settled."""
        return replace(self, orbit=replace(self.orbit, settling=settling))


def steady(
    case: SlidingContact,
    v_0: float,
    resolution: Resolution,
    n_periods: int | None = None,
    near: MarchEnd | None = None,
    most: int | None = None,
) -> MarchEnd:
    """March until the COF settles, or for exactly n_periods: the end of the march.

    v_0: pulling velocity [m/s]. near: the end of a march of the case at other resolution or velocity, in whose periodic
    state the search begins. most: periods after which a march that does not settle is given up; None is MAX_PERIODS.
    """
    springs, scaled = at_hand(case, resolution)
    if not scaled.normal.mean > 0:
        raise too_coarse(resolution.steps)
    total = None if n_periods is None else n_periods + max(1, resolution.record)  # with those looked at
    stepper = Stepper(scaled, v_0 / scaled.units.speed, min(TOLERANCE, resolution.accuracy / 10), total)
    from_full_slip, waiting = resolution.start == "full_slip", None
    orbit = None
    resolves(scaled, resolution)
    if n_periods is None and scaled.limit.falls:
        state = stepper.full_slip() if from_full_slip else stepper.rest()
        orbit = repeated(stepper, state, pre_sliding(scaled, stepper.v), resolution.accuracy, most)
    elif n_periods is None:
        orbit = _searched(stepper, resolution, near)
    if orbit is None:
        start = stepper.full_slip() if from_full_slip else stepper.rest()
        waiting = Waiting(stepper, start, 0.0 if from_full_slip else pre_sliding(scaled, stepper.v))
        if n_periods is None:
            orbit = waiting.wait(most or MAX_PERIODS["rigid" if scaled.body.rigid else "spring"])
        else:
            orbit = waiting.after(n_periods)
    if not np.isfinite(orbit.settling.mean):
        raise out_of_range(v_0)
    n_marched, awaits = stepper.n_periods, n_periods is not None
    return MarchEnd(case, v_0, resolution, springs, stepper, orbit, n_marched, waiting, awaits)


def resolves(scaled: ScaledContact, resolution: Resolution) -> None:
    """Refuse steps that do not resolve the body where friction falls."""
    if scaled.limit.falls and scaled.light:
        raise ValueError(
            f"steps_per_period = {resolution.steps} is too coarse for friction that falls: steps must resolve how fast "
            "the body swings on the contact, and how dashpots stop it; raise steps_per_period, or the mass of the body"
        )


def check(case: SlidingContact, v_0: float) -> None:
    """Refuse an amplitude too small, and a shake or a velocity too large, for the digits of a march."""
    cycle = case.cycle
    if cycle.u_z0 > DEEPEST * cycle.unit:
        raise ValueError(
            f"the amplitude du_z = {cycle.unit:g} m is less than {1 / DEEPEST:g} of u_z0 and lost in the rounding of a "
            "march; raise it: 1 - cof/mu_0 is proportional to it there"
        )
    farthest = max(float(np.abs(x).max(initial=0.0)) for x in (case.way, case.way_across))
    if np.inf > farthest > DEEPEST * case.unit_length:
        raise ValueError(
            f"the shake is more than {DEEPEST:g} times mu_0 kappa u_z0 (or du_z), so that the deflection of springs is "
            "lost in its rounding; lower it: beyond, a contact is rigid"
        )
    if v_0 > FASTEST * (max(case.pace, case.unit_velocity) if case.is_shaken else case.unit_velocity):
        raise ValueError(
            f"v_0 = {v_0:g} m/s is {FASTEST:g} times mu_0 kappa omega du_z, Eq. (1), or more, "
            "full slip but for rounding; lower it"
        )


def _searched(stepper: Stepper, resolution: Resolution, near: MarchEnd | None) -> Orbit | None:
    """The periodic state; None where it is not found. Springs under a rigid pull are not coupled: each is solved for by
    itself.
    """
    scaled, orbit, from_full_slip = stepper.scaled, None, resolution.start == "full_slip"
    in_two_periods = scaled.body.rigid and not scaled.rheology.remembers and scaled.n_axes == 1
    if in_two_periods and from_full_slip and stepper.v > 0:
        return _after_two_periods(stepper)
    uncoupled = (
        (scaled.n_axes == 2 or scaled.rheology.rho) and scaled.body.rigid and scaled.body_across.rigid and stepper.v > 0
    )
    known = near is not None and near.settling.solved and not (from_full_slip and near.slips_fully)
    if near is not None and known and stepper.v > 0:  # with v_0 = 0 a contact may stay wherever it begins
        start, motions = at_other_resolution(near.orbit.state, near.orbit.motions, near.scaled, scaled)
        if uncoupled and (orbit := search_alone(stepper, start)) is not None:
            return orbit
        # that of a velocity close by will do where no bound rests on it
        trusted = near.stepper.v == stepper.v or not resolution.bounded
        gain = gain_at_other_resolution(near.settling.gain, near.scaled, scaled) if trusted else None
        orbit = search(stepper, (start,), gain, near=True, motions=motions)
    if uncoupled and from_full_slip and (orbit := search_alone(stepper, stepper.full_slip())) is not None:
        return orbit
    if from_full_slip and (orbit is None or not orbit.settling.settled):
        again = search_from_full_slip(stepper)
        orbit = again if orbit is None or (again is not None and again.settling.settled) else orbit
    return orbit


def _after_two_periods(stepper: Stepper) -> Orbit:
    """The periodic state of elastic springs under a rigid pull.

    A spring that begins in full slip is extended by no less than in its periodic state. That state slips in each
    period; there both are at the limit of friction, and one from then on. So the second period is the periodic one.
    """
    state = stepper.period(stepper.period(stepper.full_slip()))
    cof, _ = stepper.cof_of(stepper.last)
    return Orbit(state, Settling(cof, 0.0, True, "periodic", gain=1.0), stepper.least_slip(stepper.last, cof))


def out_of_range(v_0: float) -> ValueError:
    """The error of a run whose numbers are too large or too small."""
    return ValueError(f"the run left the range of floats at v_0 = {v_0:g} m/s: use units nearer to one")


def too_coarse(steps: int) -> ValueError:
    """The error of a contact that the steps do not see."""
    return ValueError(
        f"steps_per_period = {steps} is too coarse: the contact begins and ends within a step; "
        "raise it, or press deeper"
    )


def at_hand(case: SlidingContact, resolution: Resolution) -> tuple[SpringArray, ScaledContact]:
    """The springs and the scaled contact, kept: runs at other velocities share them."""
    lump = resolution.lump and resolution.start == "full_slip"
    return _scaled(case, resolution.n_springs, resolution.steps, lump, resolution.cut)


@remembered(maxsize=8)
def _springs(case: SlidingContact, n_springs: int, cut: float) -> SpringArray:
    return springs_of(case, n_springs, cut)


@remembered(maxsize=24)
def _scaled(
    case: SlidingContact, n_springs: int, steps: int, lump: bool, cut: float
) -> tuple[SpringArray, ScaledContact]:
    springs = _springs(case, n_springs, cut)
    return springs, ScaledContact.of(case, springs, steps, lump)
