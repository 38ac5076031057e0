"""The stepper of the march: a state in, the state some periods later out.

A state belongs to phase 0 of the normal motion. The stepper itself holds what does not change, the contact in scaled
form and the velocity of the pull, and counts the periods that it marched.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mdr.march import loop, orbit_loop
from mdr.march.body import N_BODY, RATE, Body, Y
from mdr.march.dimensionless import ScaledContact, Way
from mdr.march.steady_state import TOLERANCE, UNKNOWN
from mdr.march.turning import Across, look_turning, march_turning
from mdr.spring.energies import LEAST_SLIP, N_SUMS, SHAKE_WORK, nodes_of
from mdr.spring.settle import tools_for
from mdr.spring.step import ROUNDING
from mdr.tools.arrays import Array
from mdr.tools.progress import Ticker, time_is_over

ALIKE = 3.0  #: ratio of second differences; a slip velocity jumps, and bends otherwise, where springs touch and leave
FINE = 65  #: places at which `least_between` looks at a polynomial; a parabola there misses 1e-6 of a second difference
LOST = 10 * ROUNDING  #: of a length, way of a spring in a step that is not told from rounding
WITH_IT = 0.5  #: of the way of the pull, on which a spring may go with it or lose and still count as slipping as far
AT_ONCE = 2**17  #: steps between two looks at the clock, whose forces are kept until they are averaged


class MarchState:
    """Springs and body between two periods.

    All that friction can change stands in one vector, of which the named parts are views.
    """

    __slots__ = ("body", "e", "s", "x")

    def __init__(self, x: Array, s: Array) -> None:
        self.x = x  #: (n_x,) extensions, then the body
        ways = x.size // (s.size + N_BODY)
        self.s = s  #: (1 + J, n) compressions, and their arms
        self.e = x[: ways * s.size].reshape(-1, s.shape[1])  #: (1 + J, n) extensions and arms, and those across
        self.body = x[ways * s.size :]  #: (N_BODY,) see body.py, and the body across

    @classmethod
    def of(cls, e: Array, s: Array, body: Array) -> MarchState:
        """The state of these parts, copied."""
        return cls(np.concatenate([e.ravel(), body]), s.copy())

    def copy(self) -> MarchState:
        """A state that can be marched on without a change of this one."""
        return MarchState(self.x.copy(), self.s.copy())

    def with_vector(self, x: Array) -> MarchState:
        """The state that a vector stands for; a copy."""
        return MarchState(x.copy(), self.s.copy())


class Periods(NamedTuple):
    """COF and swing of each of some periods."""

    cof: Array  #: (n_periods,) mean of F_x over that of F_z, which is the COF over mu_0
    swing: Array  #: (n_periods,) of the body, greatest less least y
    cof_y: Array  #: (n_periods,) mean of F_y over that of F_z, over mu_0


@dataclass(frozen=True, eq=False)
class PeriodRecord:
    """A period that was looked at closely, in scaled form."""

    seen: loop.Seen  #: forces, modes and energies
    y: Array  #: (n_steps + 1,) the body at the start of the period and at the end of every step
    rate: Array  #: (n_steps + 1,) its velocity there
    across: tuple[Array, Array]  #: the same two across the pull; zero where nothing moves there
    stored: tuple[float, float]  #: energy at both ends, in the unit of the tangential springs
    period: Periods  #: its COF and swing
    solved: bool  #: whether every step of it was solved for


class Stepper:
    """Marches a contact at one velocity.

    tolerance: of cof/mu_0, to which its periodic state is to be found; total: periods to be marched, where known.
    """

    def __init__(self, scaled: ScaledContact, v: float, tolerance: float = TOLERANCE, total: int | None = None) -> None:
        self.scaled, self.v, self.tolerance = scaled, v, tolerance
        self._parts = (
            scaled.body,
            scaled.springs,
            *scaled.full_slip_force,
            scaled.drive.with_pull(v),
            scaled.law,
            tools_for(scaled.law, scaled.drive.h),
        )
        self.mean_F_z = scaled.normal.mean
        self.n_periods = 0  # marched so far
        self.solved = True  # whether every step of the last march was solved for
        self.ticker = Ticker("slide" if total else "slide, waiting for a steady state", total, "periods")

    def full_slip(self) -> MarchState:
        """The state of full slip at phase 0; of a body without its free oscillation."""
        return self._ahead(self.scaled.full_slip.state(self.v))

    def resonant(self) -> MarchState | None:
        """The state of a body that a resonance drives as far as stick lets it; None where none does."""
        body = self.scaled.full_slip.resonant(self.v)
        return None if body is None else self._ahead(body)

    def _ahead(self, body: Array) -> MarchState:
        """All springs at their limit along the pull, and the body so."""
        s, nothing = self.scaled.normal.s, self.scaled.ways - 1
        return MarchState.of(
            np.concatenate([s, *nothing * [np.zeros_like(s)]]), s, np.r_[body, np.zeros(nothing * N_BODY)]
        )

    def rest(self) -> MarchState:
        """The state in which nothing is stretched and the body at rest, from which the pull sets off."""
        state = self._ahead(np.zeros(N_BODY))
        state.x[:] = 0.0
        state.body[RATE] = 0.0 if self.scaled.body.rigid else -self.v
        return state

    def period(self, state: MarchState) -> MarchState:
        """The state a period later; the one given is marched on in place."""
        self._marched(state, 1)
        return state

    def advance(self, state: MarchState, n_periods: int) -> tuple[MarchState, Periods]:
        """The state some periods later, with their COFs; fewer periods where the time limit of the caller is over."""
        parts, most = [Periods(*np.empty((3, 0)))], max(1, AT_ONCE // self.scaled.drive.steps)
        state = state.copy()
        for start in range(0, n_periods, most):
            parts.append(self._periods_of(*self._marched(state, min(most, n_periods - start))))
            if time_is_over():
                break
        return state, joined(parts)

    def late(self, before: MarchState, after: MarchState, n_periods: int) -> float:
        """Friction over mu_0 that springs may still gain which have not slipped as far as the pull went in these last
        periods: in a periodic motion each does, however slow the pull, and however little a state changes that has
        hardly moved.
        """
        (gap, w), drive, pull = self.scaled.springs, self.scaled.drive, 2 * np.pi * self.v
        if pull <= drive.steps * LOST * (1 + np.abs(gap).max()):
            return UNKNOWN if pull else 0.0
        went = after.e[0] - before.e[0] - (after.body[Y] - before.body[Y])
        late = np.abs(went) > WITH_IT * n_periods * pull
        return 2 * float(w[late] @ np.maximum(drive.z.max() - gap[late], 0.0)) / self.mean_F_z

    def _traces(self, n_periods: int) -> tuple[loop.Trace, Across | None]:
        """Room for what a march leaves, along and across."""
        trace, way = self.scaled.trace(n_periods), self.scaled.drive.across
        if way is None:
            return trace, None
        return trace, Across(way.x, way.x_dot, self.scaled.body_across, self.scaled.trace(n_periods))

    def _marched(self, state: MarchState, n_periods: int) -> tuple[loop.Trace, Across | None]:
        """A whole number of periods in place, counted."""
        trace, across = self._traces(n_periods)
        n_steps = n_periods * self.scaled.drive.steps
        if across is None:
            self.solved = loop.march(state.e, state.s, state.body, *self._parts, n_steps, trace)
        else:
            body, springs, _, _, *others = self._parts
            self.solved = march_turning(state.e, state.s, state.body, body, springs, *others, n_steps, trace, across)
        self._count(n_periods)
        return trace, across

    def _count(self, n_periods: int) -> None:
        self.n_periods += n_periods
        self.ticker.tick(n_periods)

    def _periods_of(self, trace: loop.Trace, across: Across | None) -> Periods:
        """COFs and swing of each whole period."""
        (cof, swing), (cof_y, aside) = (self._means(one) for one in (trace, trace if across is None else across.trace))
        return Periods(cof, swing, 0 * cof_y) if across is None else Periods(cof, np.maximum(swing, aside), cof_y)

    def _means(self, trace: loop.Trace) -> tuple[Array, Array]:
        area, y = (one.reshape(-1, self.scaled.drive.steps) for one in (trace.area, trace.y))
        return area.sum(axis=1) / (2 * np.pi * self.mean_F_z), np.ptp(y, axis=1)

    def observe(self, state: MarchState, keep: bool) -> tuple[MarchState, PeriodRecord]:
        """The state a period later, with a close look; the march is the same with and without `keep`."""
        scaled, n, n_steps = self.scaled, self.scaled.springs.gap.size, self.scaled.drive.steps
        before, state = state, state.copy()
        kept = n_steps if keep else 0
        nodes = nodes_of(scaled.drive.h, scaled.law.modes, scaled.law.arms)
        seen = loop.Seen(nodes, np.zeros(N_SUMS), np.zeros((n_steps, 4)), *np.zeros((7, kept, n)))
        seen.sums[LEAST_SLIP] = np.inf
        (trace, across), passed = self._marched(state, 1), before.copy()
        _, springs, _, _, motion, law, tools = self._parts
        nothing = np.zeros(n_steps + 1)
        seen.sums[SHAKE_WORK] = self._work_of(scaled.drive.along, trace)
        if across is None or scaled.drive.across is None:
            loop.look(passed.e, passed.s, springs, motion, law, tools, trace, seen)
            seen.sums[LEAST_SLIP] = min(seen.sums[LEAST_SLIP], least_between(seen.F[:, 2]))
            aside = nothing, nothing
        else:
            look_turning(passed.e, passed.s, springs, motion, law, tools, trace, across, seen)
            seen.sums[SHAKE_WORK] += self._work_of(scaled.drive.across, across.trace)
            aside = _from(before.body[N_BODY:], across.trace)
        stored = self.stored_energy(before), self.stored_energy(state)
        periods = self._periods_of(trace, across)
        return state, PeriodRecord(seen, *_from(before.body, trace), aside, stored, periods, self.solved)

    def _work_of(self, way: Way, trace: loop.Trace) -> float:
        """Work of a shake, which goes on parabolas."""
        h = self.scaled.drive.h
        x_2 = np.diff(way.x_dot) / (2 * h)
        return float((np.diff(way.x) / h - x_2 * h) @ trace.area + 2 * x_2 @ trace.moment)

    def within_friction(self, state: MarchState) -> MarchState:
        """The state with every extension within the cone of friction; in place."""
        orbit_loop.within_friction(state.x, state.s, self.scaled.ways == 2)
        return state

    def search(self, at: orbit_loop.Search, like: MarchState, roots: Array, n_periods: int) -> tuple[bool, Periods]:
        """Go on with a search for its periodic state, for at most so many periods; whether it has come to its end, and
        the last period, if it was the one that moved least. like: a state of this march.
        """
        n_before, (trace, across) = int(at.counts[orbit_loop.PERIODS]), self._traces(1)
        ended = orbit_loop.search(at, like.s, roots, *self._parts, n_periods, trace, across)
        self._count(int(at.counts[orbit_loop.PERIODS]) - n_before)
        return bool(ended), self._periods_of(trace, across)

    def stored_energy(self, state: MarchState) -> float:
        """Elastic and kinetic energy of springs, body and system spring, in the unit of the tangential springs."""
        scaled, system = self.scaled, 0.0
        for body, way, pull, at in self.directions:
            y, u_dot = float(state.body[at + Y]), pull + float(state.body[at + RATE])
            if way.far_end.any():  # the body moves on the way of the shake too, and stretches its spring by less
                u_dot, y = u_dot + float(way.x_dot[0]), y + float(way.x[0] - way.far_end[0])
            system += 0.0 if body.rigid else 0.5 * body.K * y**2 + 0.5 * body.M * u_dot**2
        ratios = np.concatenate([[1.0], scaled.rheology.rho])
        springs = 0.5 * float(np.tile(ratios, scaled.ways) @ (state.e**2 @ scaled.springs.w))
        normal = 0.5 * float(ratios @ (state.s**2 @ scaled.springs.w))
        return springs + normal * scaled.units.energy_z / scaled.units.energy_x + system

    @property
    def directions(self) -> list[tuple[Body, Way, float, int]]:
        """Body, way, velocity of the pull, and place in the state of the body: along the pull, and across it."""
        drive, aside = self.scaled.drive, self.scaled.drive.across
        along: list[tuple[Body, Way, float, int]] = [(self.scaled.body, drive.along, self.v, 0)]
        return along if aside is None else [*along, (self.scaled.body_across, aside, 0.0, N_BODY)]


def least_between(values: Array) -> float:
    """Least value over a period of a function that is known at equidistant phases (n,), or infinite there: where it is
    positive, and bends alike about its least value, that of the polynomial through as many as five nodes there.
    """
    k = int(np.argmin(values))
    near, at = np.take(values, np.arange(k - 2, k + 3), mode="wrap"), np.arange(-2.0, 3.0)
    known = np.isfinite(near)
    known[[0, 4]] &= known[[1, 3]]
    near, at = near[known], at[known]
    bends = near[2:] - 2 * near[1:-1] + near[:-2]
    if values[k] <= 0 or not bends.size or not 0 < bends.max() < ALIKE * bends.min():
        return float(values[k])
    powers, fine = np.arange(at.size), np.linspace(max(-1.0, at[0]), min(1.0, at[-1]), FINE)
    on_fine = fine[:, None] ** powers @ np.linalg.solve(at[:, None] ** powers, near)
    j = int(np.argmin(on_fine))
    left, least, right = on_fine[[max(j - 1, 0), j, min(j + 1, FINE - 1)]]
    ends = j in (0, FINE - 1)
    return float(min(values[k], least if ends else least - (left - right) ** 2 / (8 * (left - 2 * least + right))))


def joined(parts: list[Periods]) -> Periods:
    """Periods one after the other."""
    return Periods(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def _from(before: Array, trace: loop.Trace) -> tuple[Array, Array]:
    """Motion and rate of a body from the begin of a period on, (n_steps + 1,)."""
    return np.r_[before[Y], trace.y], np.r_[before[RATE], trace.rate]
