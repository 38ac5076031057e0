"""The critical velocity measured from simulated runs alone.

The measured v_c is the smallest v_0 above which every settled run, from either start, has a deficit 1 - cof/mu_0 below
its own error. Near v_c the deficit vanishes like (1 - v_0/v_c)² for an elastic contact. For a Kelvin contact it
vanishes like (1 - v_0/v_c)^(3/2), as its lag behind full slip lasts for the relaxation time instead of the stick phase.
A threshold on the COF alone would therefore read v_c too low. Two sharper signs give the digits:

* In a run without any stick the slip velocity is at least v_0 - v_c, since in full slip the motion relative to the pull
  does not depend on v_0. One such run locates v_c: it is v_0 less the smallest slip velocity.
* Below v_c there is stick, above it there is none. Two runs close to v_c, one on either side, confirm this. They are
  the bracket, which is widened by what the numbers of steps and springs still change.

Runs at higher velocities, from both starts, then look for friction that stays low. If they do not settle, `why` tells.

A run close to v_c that has not settled is no evidence. The search then takes runs at velocities close by. If these do
not settle either, the answer is "unsettled". So it is where no end of stick tells the end of friction reduction:

* An undamped body whose omega_0 is a whole multiple of omega can keep a free oscillation in step with the drive. It may
  keep springs from sticking, so that the end of stick depends on it (`mdr.laws.lock_in`).
* The velocity of a body without mass jumps whenever a single spring touches on a dashpot. Isolated stick then goes on
  far above the velocity at which friction is full.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.case.domain import KEPT, Domain, where_it_falls
from mdr.march.periodic.steady import BUDGET, MarchEnd, Resolution, accuracy_of
from mdr.march.result.refinement import MOST_SPRINGS, MOST_STEPS, default_springs, default_steps, oscillations
from mdr.march.result.run import SlidingRun, finish
from mdr.march.result.slide import runs, slide
from mdr.normal.resolved import resolved
from mdr.tools.checks import word
from mdr.tools.companions import Companion, bound
from mdr.tools.progress import Ticker, time_is_over, time_limit
from mdr.tools.summary import Summarised, Summary, number

#: cases in which springs that slip tell where stick ends: one that touches anew on friction that falls sticks longer
TOLD_BY_SLIP = Domain(where_it_falls(KEPT), instead="full_slip_critical_velocity")
LEAST_V_C = 1e-4  #: times Eq. (1): a critical velocity below this is not told from zero
HIGHEST = 1e2  #: times Eq. (1): if no run below this is free, there is no v_c

#: why a curved elastic face with a shear strength has no critical velocity, and one that is shaken across
AT_THE_EDGE = (
    "springs that the edge of contact reaches stick at any velocity, as the shear strength of the face gives them a "
    "limit that grows faster than any pull"
)
ACROSS = (
    "shaken across the pull, friction is less than mu_0 at every velocity, as its direction follows that of slip: what "
    "is missing falls like 1/v_0² (mdr.laws.lost_across)"
)


@dataclass(frozen=True)
class MeasuredVelocity(Summarised):
    """A critical velocity found from runs alone: v_c between low and high [m/s].

    The kinds of end:

    * "end of stick": a run just above v_c has no stick and full friction, one just below has not. No settled run
      further above has reduced friction; `why` names those that did not settle.
    * "none": no run without stick up to the highest velocity. v_c is None.
    * "unsettled": the runs that would tell do not settle, or contradict one another, or stick does not tell where
      friction becomes full. v_c is None.
    """

    v_c: float | None  #: [m/s]; None where there is none
    low: float | None  #: highest velocity [m/s] seen with stick, less the doubt of resolution
    high: float | None  #: lowest velocity [m/s] seen without, plus that doubt
    kind: str  #: one of the kinds of end above
    why: str  #: in words
    n_runs: int = field(default=0, compare=False)  #: how many runs it took

    def _summary(self) -> Summary:
        found = "none" if self.v_c is None else number(self.v_c, "m/s")
        rows = [("v_c", found, self.kind)]
        if self.low is not None and self.high is not None:
            rows.append(("bracket", f"{self.low:.9g} to {self.high:.9g} m/s", "stick below, none above"))
        return Summary("MeasuredVelocity", [*rows, ("why", self.why, ""), ("runs", str(self.n_runs), "")])

    def contains(self, v_0: float) -> bool:
        """True if a velocity lies within the bracket.

        Parameters
        ----------
        v_0 : float
            Velocity [m/s].

        Returns
        -------
        bool
            False also where there is no bracket.
        """
        return self.low is not None and self.high is not None and self.low <= v_0 <= self.high


def measure_critical_velocity(
    case: SlidingContact,
    direction: int = 1,
    *,
    start: str = "full_slip",
    limit_s: float | None = None,
    accuracy: float = BUDGET,
) -> MeasuredVelocity:
    """Critical velocity [m/s] from simulated runs alone, with its bracket.

    v_c comes from no closed form: Eq. (1) only sets which velocities are tried, and below which one v_c counts as zero.
    So the agreement with Eq. (15) is evidence.

    Parameters
    ----------
    case : SlidingContact
        The contact.
    direction : {1, -1}
        1 is the pull forward, -1 the pull the other way, whose velocities are given as positive numbers too. They
        differ only where something shakes in the plane.
    start : {"full_slip", "rest"}
        First state of the runs that locate v_c, as in `slide`.
    limit_s : float, optional
        Seconds of computing after which the search ends unsettled. None sets no limit.
    accuracy : float
        A quarter of the relative width [-] of the bracket that is asked for, from 1e-8 to 1e-3; values below 1e-6 count
        as 1e-6.

    Returns
    -------
    MeasuredVelocity
        `v_c` between `low` and `high` [m/s], and the `kind` of end. All three are None where there is no v_c.

    Raises
    ------
    ValueError
        For an unknown start or direction, and for a contact whose edge moves where friction falls.
    TypeError
        For a case that is no SlidingContact.

    Notes
    -----
    The bracket is four to eight times the accuracy wide, 4e-5 to 8e-5 of v_c by default. It is wider where the number
    of steps or springs still moves it, and where two runs so close to v_c do not tell stick from none. The search takes
    10 to 40 runs, some hundredths of a second to a second.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> punch, rubber = mdr.FlatPunch(a=1e-3), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(punch, rubber, mu_0=0.4, oscillation=vibration)
    >>> found = mdr.measure_critical_velocity(case)
    >>> print(f"{found.v_c:.3g} m/s, {found.kind}; Eq. (1) gives {mdr.critical_velocity(case):.3g} m/s")
    0.00036 m/s, end of stick; Eq. (1) gives 0.00036 m/s
    """
    word("start", start, "full_slip", "rest")
    # stick is told from none within 2e-6 of v_c
    half_width = max(2 * accuracy_of(accuracy), 2e-6)  # accuracy is a quarter of the width
    case = TOLD_BY_SLIP.seen(resolved(case), "measure_critical_velocity")
    search = _Search(case.pulled(direction), start, half_width)
    if search.case.moves_across or search.case.always_sticks:
        return MeasuredVelocity(None, None, None, "none", ACROSS if search.case.moves_across else AT_THE_EDGE)
    if not (search.case.mu_0 or search.case.strength_moves or search.case.is_shaken):
        why = "the limit of friction is constant, so that the vibration takes nothing from it"
        return MeasuredVelocity(0.0, 0.0, 0.0, "end of stick", why)
    with time_limit(limit_s):
        try:
            return search.measure()
        except _Undecided as at:
            return search.undecided(float(at.args[0]))


class _Undecided(Exception):
    """Raised where a run that must settle does not, nor any run near its velocity."""


class _Search:
    """The runs of one measurement."""

    def __init__(self, case: SlidingContact, start: str, margin: float) -> None:
        self.case, self.start, self.margin, self.n_runs = case, start, margin, 0
        self.ticker = Ticker("critical velocity from runs", parts="runs")
        self.few = self.steps = default_steps(case)
        self.n_springs = default_springs(case)
        self.near: MarchEnd | None = None  # the last run from full slip in which springs stuck
        self.doubt = 0.0  # of the end of stick [m/s], by resolution
        self.scale = case.pace  # only a scale of velocity

    def run(self, v_0: float, start: str | None = None) -> SlidingRun:
        self._begin(v_0)
        start = start or self.start
        return slide(self.case, v_0, start=start, n_springs=self.n_springs, steps_per_period=self.steps)

    def quick_run(self, v_0: float, start: str | None = None) -> SlidingRun:
        """A run that tells whether springs stick; the bound on its error is worked out only where that decides."""
        self._begin(v_0)
        start = start or self.start
        # with many steps a run from full slip begins in the state of one of few
        if start == "full_slip" and self.near is None and self.steps >= 4 * self.few:
            self._without_bound(v_0, start, self.few)
        run = self._without_bound(v_0, start, self.steps)
        return self.run(v_0, start) if run.settled and _slips(run) and _is_reduced(run) else run

    def _without_bound(self, v_0: float, start: str, steps: int) -> SlidingRun:
        """A run; one from full slip begins in the state of the last in which springs stuck."""
        near = self.near if start == "full_slip" else None
        end = next(runs(self.case, [v_0], Resolution(self.n_springs, steps, start, lump=True, bounded=False), near))
        if start == "full_slip":
            self.near = end.to_begin_from or self.near
        return finish(end)

    def _begin(self, v_0: float) -> None:
        """One more run, if there is time."""
        self.n_runs += 1
        self.ticker.tick()
        if time_is_over():
            raise _Undecided(v_0)

    def measure(self) -> MeasuredVelocity:
        free = self._first_free_run()
        if free is not None and (ambiguous := self._stick_tells_nothing()):
            return self._without("unsettled", ambiguous)
        free = free and self._resolve(free)
        if free is None:
            return self._without("none", "friction stays reduced, or stick goes on, up to the highest velocity tried")
        v_c, low, high = self._locate(free)
        low, high = max(low - self.doubt, 0.0), high + self.doubt
        if v_c <= LEAST_V_C * self.scale:
            why = f"stick ends below {LEAST_V_C:g} of Eq. (1), which is not told from zero"
            return MeasuredVelocity(v_c, low, high, "end of stick", why, n_runs=self.n_runs)
        return self._look_above(v_c, low, high)

    def _without(self, kind: str, why: str) -> MeasuredVelocity:
        """The answer where there is no critical velocity, or none is known."""
        return MeasuredVelocity(None, None, None, kind, why, n_runs=self.n_runs)

    def undecided(self, v_0: float) -> MeasuredVelocity:
        """The answer where runs that would tell do not settle."""
        why = f"runs near {v_0:.6g} m/s do not settle, so that nothing is known of friction there"
        if time_is_over():
            why = f"the time limit is over after {self.n_runs} runs, before one at {v_0:.6g} m/s: raise limit_s"
        return self._without("unsettled", why)

    def _stick_tells_nothing(self) -> str:
        """Why the end of stick is not that of friction reduction; empty where it is."""
        case, pull = self.case, self.case.pull
        if pull.is_rigid:
            return ""
        kept = case.cycle.u_z0 + case.cycle.unit * case.kept_gap
        moving_edge = case.indenter.contact_radius(case.u_z_max) > case.indenter.contact_radius(kept)
        if pull.coefficients[0] == 0 and case.T > 0 and moving_edge:
            return (
                "the velocity of a body without inertia jumps when single springs touch on their dashpots, so that "
                "isolated stick goes on where friction is full: give the body a mass"
            )
        ratio = pull.omega_0 / case.omega
        multiple = round(ratio) if np.isfinite(ratio) else 0
        # a free oscillation that loses or gains less than 1e-6 turns in a period stays in step
        if multiple and pull.damping_ratio == 0 and abs(ratio - multiple) < 1e-6:
            return (
                f"the undamped body has omega_0 = {multiple} omega: a free oscillation in step with the drive "
                "may keep springs from sticking, so that the end of stick depends on it (mdr.laws.lock_in): give the "
                "body a damper"
            )
        return ""

    def _decided(self, v_0: float) -> SlidingRun:
        """A settled run at this velocity, or within a quarter of the margin."""
        for off in (0.0, self.margin / 4, -self.margin / 4):
            if (run := self.quick_run(v_0 * (1 + off))).settled:
                return run
        raise _Undecided(v_0)

    def _first_free_run(self) -> SlidingRun | None:
        """A settled run without stick, not far above v_c.

        In full slip the motion of the body is the same at any v_0: one run without stick, however fast, tells where
        stick begins. The factors of velocity are chosen such that they do not hit v_c by construction.
        """
        guess, unsettled = self.scale, None
        # times Eq. (1): runs so fast are free of stick wherever there is a v_c that can be told
        for times in (1e6, 1e4, 1e3):
            far = self.quick_run(times * self.scale, "full_slip")  # from rest it would swing as fast
            if far.settled:
                guess = far.v_0 - far.least_slip if _is_free(far) else guess
                break
        v_0 = 1.37 * max(guess, LEAST_V_C * self.scale)
        while v_0 < HIGHEST * max(guess, self.scale):
            run = self.quick_run(v_0)
            if _is_free(run):
                return run
            unsettled = unsettled if run.settled else v_0
            v_0 *= 6.85
        if unsettled is not None:
            raise _Undecided(unsettled)
        return None

    def _resolve(self, free: SlidingRun) -> SlidingRun | None:
        """Double steps and springs until the end of stick moves by less than the margin, or up to their limits.

        Returns the last run without stick. A first touch falls anywhere within a step, so that its error is irregular.
        So 1, 1.5 and 2 times the steps and springs are compared. The farthest two of the three tell the doubt of the
        coarsest, which is then used.
        """
        while True:
            steps, n_springs, ends = self.steps, self.n_springs, [free.v_0 - free.least_slip]
            for halves in (3, 4):
                self.steps, self.n_springs = halves * steps // 2, halves * n_springs // 2
                free = self._decided(free.v_0)
                if not _is_free(free):  # free in coarse steps only: begin anew, further up
                    further = self._first_free_run()
                    return None if further is None else self._resolve(further)
                ends.append(free.v_0 - free.least_slip)
            by_chance = (Companion(abs(ends[i] - ends[1])) for i in (0, 2))
            self.doubt = bound(Companion(abs(ends[2] - ends[0])), others=tuple(by_chance))
            enough = self.margin * max(free.v_0 - free.least_slip, LEAST_V_C * self.scale)
            if self.doubt <= enough or 2 * self.steps > MOST_STEPS or 2 * self.n_springs > MOST_SPRINGS:
                self.steps, self.n_springs = steps, n_springs
                return free

    def _locate(self, free: SlidingRun) -> tuple[float, float, float]:
        """The end of stick, and [low, high] around it.

        The smallest slip velocity gives a guess. One run is taken on either side of it, one margin away. If these do
        not show stick below and none above, they are taken 4, 16 and 64 margins away; such a bracket stays that wide.
        If none of these does, [low, high] is halved down to the margin.
        """
        low, high, guess = 0.0, free.v_0, free.v_0 - free.least_slip
        # the rate of a parabola is off by h²/12 where stick ends: that of these steps by half of the margin
        steps = int(oscillations(self.case) * np.pi * np.sqrt(2 / (3 * self.margin)))
        self.steps = max(self.steps, min(steps, MOST_STEPS))
        if guess <= LEAST_V_C * self.scale and _is_free(slow := self.quick_run(LEAST_V_C * self.scale)):
            return max(slow.v_0 - slow.least_slip, 0.0), 0.0, slow.v_0
        guess = max(guess, LEAST_V_C * self.scale)
        for width in (self.margin, 4 * self.margin, 16 * self.margin, 64 * self.margin):
            above, below = (self._decided(guess * (1 + side * width)) for side in (1, -1))
            if _is_free(above) and not _is_free(below):
                return guess, below.v_0, above.v_0
            low = max([low, *(run.v_0 for run in (above, below) if not _is_free(run))])
            high, guess = min(
                [(high, guess), *((run.v_0, run.v_0 - run.least_slip) for run in (above, below) if _is_free(run))]
            )
            self.steps = max(self.steps, min(2 * self.steps, MOST_STEPS))
        low, high = min(low, high), max(low, high)  # stick that only grazes may be seen above a run without any
        while high - low > 2 * self.margin * high:
            run = self._decided(0.5 * (low + high))
            low, high = (low, run.v_0) if _is_free(run) else (run.v_0, high)
        return 0.5 * (low + high), low, high

    def _look_above(self, v_c: float, low: float, high: float) -> MeasuredVelocity:
        """Runs above v_c from both starts: is friction full there?"""
        factors = (1.02, 1.3, 4.0)
        beside: list[str] = []
        unsettled, self.steps, self.n_springs = [], default_steps(self.case), default_springs(self.case)
        for factor, start in product(factors, ("full_slip", "rest")):
            run = self.quick_run(factor * v_c, start)
            if not run.settled:
                unsettled.append(f"{factor:g} v_c from {start}")
            elif _is_reduced(run) and _is_reduced(self.run(run.v_0, start)):
                if self.case.friction.stick > 1:
                    beside.append(f"{factor:g} v_c from {start}")
                    continue
                why = f"stick ends at {v_c:.6g} m/s, but a run from {start} keeps friction reduced at {run.v_0:.6g} m/s"
                return self._without("unsettled", f"{why}: no two steady motions do that, so one has not settled")
        why = "stick ends and friction is full at the same velocity"
        if len(unsettled) == 2 * len(factors):
            why = "stick ends at this velocity"
        if unsettled:
            why += f"; not settled: {', '.join(unsettled)}"
        if beside:
            why += f"; beside full slip another motion goes on, in which the body sticks and slips: {', '.join(beside)}"
        return MeasuredVelocity(v_c, low, high, "end of stick", why, n_runs=self.n_runs)


def _slips(run: SlidingRun) -> bool:
    """True if no spring sticks for longer than it hesitates at its touch, in a motion that was followed to its end."""
    # springs hesitate for one step at their touch; 2e-5 below v_c the share is above 1e-3
    return run.stick_share < 1e-4 and run.least_slip > 0 and run.kind != "averaged"


def _is_free(run: SlidingRun) -> bool:
    """True if no spring sticks: positive slip velocity throughout, in a settled run of full COF."""
    return run.settled and _slips(run) and not _is_reduced(run)


def _is_reduced(run: SlidingRun) -> bool:
    return run.settled and abs(run.full_cof - run.cof) > run.cof_error  # above it where friction falls
