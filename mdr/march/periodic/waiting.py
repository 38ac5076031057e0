"""Waiting for the steady state: march on until the COF settles and the body has outlasted its beat.

The last resort, where no periodic state was solved for. Now and then one is searched for from where the march has come
to. Windows of periods decide on the COF (settling.py); beside a resonance the swing of the body changes long before
the COF does, so that it is asked too.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np

from mdr.march.dynamics.body import U
from mdr.march.dynamics.dimensionless import ScaledContact
from mdr.march.dynamics.state import UNKNOWN, MarchState
from mdr.march.dynamics.stepper import TOLERANCE, Periods, Stepper, joined
from mdr.march.periodic.orbit import Orbit
from mdr.march.periodic.search import search
from mdr.march.periodic.settling import LATE, MIN_PERIODS, Settling, assess, smooth_mean
from mdr.tools.iterate import iterate
from mdr.tools.progress import time_is_over

BEATS = 2.0  #: of an undamped body that a settled run has seen
E_FOLDS = 8.0  #: of a damped oscillation after which no beat is left, and of a creep
NEARLY = 2e-3  #: below the end of stick, of it: where less than TOLERANCE is missing in the COF
SOLVE_AGAIN = 8  #: times the periods after which the periodic state is looked for once more
DYING = 0.1  #: share of the swing of a damped body that is still to die away
#: why a march ends at once whose steps do not converge
NO_STEP = "the motion of the body over a step, in which it and its springs agree, was not found"
FEW = 0.1  #: of the distance of pre-sliding, that a pull has to go while it is waited for late springs
SWING_TOLERANCE = 1e-3  #: growth of the swing of the body within the run, over the swing


class Waiting:
    """A march that goes on until it settles."""

    def __init__(self, stepper: Stepper, state: MarchState, pre_sliding: float = 0.0) -> None:
        self.stepper, self.scaled, self.state, self.pre_sliding = stepper, stepper.scaled, state, pre_sliding
        self.periods, self.late, self.least_slip = Periods(*np.empty((3, 0))), 0.0, 0.0
        self.most, self.solve_at, self.over = 0, 0, False  # of `wait`

    @property
    def n(self) -> int:
        """Periods so far."""
        return self.periods.cof.size

    @property
    def first_look(self) -> int:
        """Periods after which it makes sense to ask whether a run has settled."""
        return 4 * MIN_PERIODS if self.scaled.body.M else MIN_PERIODS

    def advance(self, n_periods: int) -> None:
        """March on, period by period; `late` is that of the latter half."""
        for part in (n_periods // 2, n_periods - n_periods // 2):
            before = self.state
            self.state, periods = self.stepper.advance(before, part)
            self.append(periods)
        self.late = self.stepper.late(before, self.state, periods.cof.size)
        last = self.stepper.last
        self.least_slip = self.stepper.least_slip(last, self.stepper.cof_of(last)[0])

    def append(self, periods: Periods) -> None:
        """Add further periods to those that the judgement rests on."""
        self.periods = joined([self.periods, periods])

    def after(self, n_periods: int) -> Orbit:
        """The end after so many periods."""
        self.advance(n_periods)
        return self._ended(self.assess() if self.n else Settling(0.0, UNKNOWN, False, "unsettled"))

    def wait(self, most: int) -> Orbit:
        """March until the windows agree, but not before every spring has been pulled as far as it has to go."""
        if self.pre_sliding > most:
            self.advance(self.first_look)
            return self._ended(replace(self.assess(), settled=False, kind="unsettled"))
        self.advance(max(self.first_look, int(self.pre_sliding)))
        self.most, self.solve_at, self.over = most, self.n, False
        at = iterate(self._wait_on, lambda at: at.settling.settled or self.over, self._ended(self.assess()))
        if at.settling.settled or self.over:
            return at
        return self._ended(replace(at.settling, why=f"the time limit is over after {self.n} periods"))

    def _wait_on(self, at: Orbit) -> Orbit:
        """The end after half as many periods again, or a periodic state; the same, over, where more do not help."""
        if not self.scaled.body.rigid and self.n >= self.solve_at:
            self.solve_at = SOLVE_AGAIN * self.n
            if (orbit := search(self.stepper, (self.state,))) is not None:
                self.over = True
                return orbit
        if time_is_over():
            return at
        why = ""
        if not self.stepper.solved:
            why = NO_STEP
        elif self._is_late and self.scaled.drive.is_shaken and FEW * self._pull_through > self.most:
            why = self._why_late
        elif self._may_settle_by(self.most):
            self.advance(max(4, self.n // 2))
            return self._ended(self.assess())
        self.over = True
        return self._ended(replace(at.settling, why=why or at.settling.why))

    def _ended(self, settling: Settling) -> Orbit:
        return Orbit(self.state, settling, self.least_slip)

    def assess(self) -> Settling:
        """Whether the COF has settled, and the body too."""
        # under a rigid pull a change shrinks at a constant rate, so that any tolerance is met in time
        tolerance = self.stepper.tolerance if self.scaled.body.rigid else TOLERANCE
        settling, beside = (assess(one, tolerance) for one in (self.periods.cof, self.periods.cof_y))
        settling = replace(settling, across=beside.mean)
        if beside.spread > settling.spread:
            settling = replace(beside, mean=settling.mean, across=beside.mean)
        if self.n < E_FOLDS * self.scaled.body.pull_time and not self._is_full(settling.mean):
            takes = f"spring and damper of the pull take {self.scaled.body.pull_time:.3g}"
            why = f"after {self.n} periods the body still creeps: {takes}"
            return replace(settling, spread=UNKNOWN, settled=False, kind="unsettled", why=why)
        if settling.settled and (why := self._still_moves(settling.mean)):
            return replace(settling, settled=False, kind="unsettled", why=why)
        return settling

    @property
    def _is_late(self) -> bool:
        """Whether the pull has not yet drawn all springs as far as it goes."""
        return self.late > self.stepper.tolerance

    @cached_property
    def _pull_through(self) -> float:
        return pre_sliding(self.scaled, self.stepper.v)

    @property
    def _why_late(self) -> str:
        return f"after {self.n} periods {LATE}, which may take {self._pull_through:.2g} of them"

    def _is_full(self, cof: float) -> bool:
        """Whether next to nothing is missing in the COF, of what oscillations can take from it."""
        return abs(1 - cof) <= TOLERANCE * self.scaled.at_stake

    def _still_moves(self, cof: float) -> str:
        """Why a COF that has settled is not the end of the motion; nothing if it is."""
        scaled, n = self.scaled, self.n
        if self._is_late:
            return self._why_late
        if not scaled.body.M:
            return ""
        changes = (abs(self.growth) if scaled.body.C == 0 else self.growth) * n > SWING_TOLERANCE
        if changes or self._dies_away(cof):
            return f"the swing of the body still grows or dies away after {n} periods"
        if n < self.beat:
            return f"after {n} periods the body may still be in a beat, which lasts {self.beat:.3g} of them"
        if self._is_full(cof) and not self._locks_in and self.stepper.v < (1 - NEARLY) * scaled.full_slip.end:
            return f"full slip cannot last at this velocity: after {n} periods the body has not yet come to stick"
        return ""

    @cached_property
    def _off_multiple(self) -> float:
        """Distance of omega_0/omega from a whole number."""
        ratio = float(np.sqrt(self.scaled.body.K / self.scaled.body.M))
        off = abs(ratio - round(ratio))
        return off if off > 1e-12 * ratio else 0.0

    @cached_property
    def _locks_in(self) -> bool:
        """Whether a free oscillation of the body stays in step with a drive that does not feed it."""
        driven = bool(np.isinf(self.scaled.full_slip.end))
        return self.scaled.body.C == 0 and self._off_multiple == 0 and not driven

    @cached_property
    def beat(self) -> float:
        """Periods that beats of the free oscillation with the drive last, or its dying away if that is shorter; where
        the drive feeds it without end, its growth tells.
        """
        scaled = self.scaled
        if scaled.body.C == 0 and self._off_multiple == 0:
            return 0.0
        beats = BEATS / self._off_multiple if self._off_multiple else np.inf
        return min(beats, E_FOLDS * scaled.body.M / (np.pi * scaled.body.C) if scaled.body.C else np.inf)

    def _dies_away(self, cof: float) -> bool:
        """Whether a body that rings for many periods still loses a swing that friction depends on: springs that it
        carries to and fro slip as it has them, however steadily. In full slip forward a smaller swing changes nothing.
        """
        scaled = self.scaled
        if not (scaled.body.M and scaled.body.C) or self._is_full(cof):
            return False
        return -self.growth * scaled.body.M / (np.pi * scaled.body.C) > DYING

    def _may_settle_by(self, most: int) -> bool:
        """Whether to wait on: not where a resonance drives the swing so slowly that stick never stops it in time."""
        driven = self.n > 64 and self.growth * self.n > SWING_TOLERANCE
        full = self._is_full(self.periods.cof[-1])
        if driven and np.isinf(self.scaled.full_slip.end) and self.scaled.body.M and full:
            body = self.scaled.body
            at_stick = 2 * self.stepper.v * np.sqrt(body.M / body.K)  # swing of a body that reaches -v
            return float(at_stick / (self.growth * self.periods.swing[-1])) < most and self.n < most
        return self.n < most

    @property
    def growth(self) -> float:
        """Growth of the swing of the body a period, over the swing, between the last two windows."""
        n, swings = self.n, self.periods.swing
        if n < 4 or self.scaled.body.rigid:
            return 0.0
        late, early = smooth_mean(swings[n // 2 :]), smooth_mean(swings[n // 4 : n // 2])
        # a swing that is rounding of the position does not count
        return (late - early) / (late * (3 * n / 8) + 1e-300) if late > 1e-9 * abs(self.state.body[U]) else 0.0


def pre_sliding(scaled: ScaledContact, v: float) -> float:
    """Periods until a run from rest can have stretched springs and system."""
    greatest = scaled.limit.greatest
    distance = float(greatest.max()) + float(scaled.springs.w @ greatest) / scaled.body.K
    return distance / (2 * np.pi * v) if v else 0.0  # at rest the start tells where it ends
