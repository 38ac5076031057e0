"""The stepper of the march: a state in, the state some periods later out.

A state belongs to phase 0 of the normal motion. The stepper itself holds what does not change, the contact in scaled
form and the velocity of the pull, and counts the periods that it marched.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mdr.march import loop
from mdr.march.body import N_BODY, RATE, Y
from mdr.march.dimensionless import ScaledContact
from mdr.march.steady_state import TOLERANCE
from mdr.spring.energies import LEAST_SLIP, N_SUMS, SHAKE_WORK, nodes_of
from mdr.spring.settle import tools_for
from mdr.tools.arrays import Array
from mdr.tools.progress import Ticker, time_is_over

ALIKE = 3.0  #: ratio of second differences; a slip velocity jumps, and bends otherwise, where springs touch and leave
FINE = 65  #: places at which `least_between` looks at a polynomial; a parabola there misses 1e-6 of a second difference
AT_ONCE = 2**17  #: steps between two looks at the clock, whose forces are kept until they are averaged


class MarchState:
    """Springs and body between two periods.

    All that friction can change stands in one vector, of which the named parts are views.
    """

    __slots__ = ("body", "e", "s", "x")

    def __init__(self, x: Array, s: Array) -> None:
        self.x = x  #: (n_x,) extensions, then the body
        self.s = s  #: (1 + J, n) compressions, and their arms
        self.e = x[: s.size].reshape(s.shape)  #: (1 + J, n) extensions, and their arms
        self.body = x[s.size :]  #: (N_BODY,) see body.py

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


@dataclass(frozen=True, eq=False)
class PeriodRecord:
    """A period that was looked at closely, in scaled form."""

    seen: loop.Seen  #: forces, modes and energies
    y: Array  #: (n_steps + 1,) the body at the start of the period and at the end of every step
    rate: Array  #: (n_steps + 1,) its velocity there
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
            scaled.full_slip_force,
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
        s = self.scaled.normal.s
        return MarchState.of(s, s, self.scaled.full_slip.state(self.v))

    def resonant(self) -> MarchState | None:
        """The state of a body that a resonance drives as far as stick lets it; None where none does."""
        s, body = self.scaled.normal.s, self.scaled.full_slip.resonant(self.v)
        return None if body is None else MarchState.of(s, s, body)

    def rest(self) -> MarchState:
        """The state in which nothing is stretched and the body at rest, from which the pull sets off."""
        s, body = self.scaled.normal.s, np.zeros(N_BODY)
        body[RATE] = 0.0 if self.scaled.body.rigid else -self.v
        return MarchState.of(np.zeros_like(s), s, body)

    def period(self, state: MarchState) -> MarchState:
        """The state a period later; the one given is marched on in place."""
        self._marched(state, 1)
        return state

    def advance(self, state: MarchState, n_periods: int) -> tuple[MarchState, Periods]:
        """The state some periods later, with their COFs; fewer periods where the time limit of the caller is over."""
        parts, most = [Periods(np.empty(0), np.empty(0))], max(1, AT_ONCE // self.scaled.drive.steps)
        state = state.copy()
        for start in range(0, n_periods, most):
            parts.append(self._periods_of(self._marched(state, min(most, n_periods - start))))
            if time_is_over():
                break
        return state, joined(parts)

    def _marched(self, state: MarchState, n_periods: int) -> loop.Trace:
        """A whole number of periods in place, counted."""
        trace = self.scaled.trace(n_periods)
        n_steps = n_periods * self.scaled.drive.steps
        self.solved = loop.march(state.e, state.s, state.body, *self._parts, n_steps, trace)
        self._count(n_periods)
        return trace

    def _count(self, n_periods: int) -> None:
        self.n_periods += n_periods
        self.ticker.tick(n_periods)

    def _periods_of(self, trace: loop.Trace) -> Periods:
        """COF and swing of each whole period."""
        area, y = (one.reshape(-1, self.scaled.drive.steps) for one in (trace.area, trace.y))
        return Periods(area.sum(axis=1) / (2 * np.pi * self.mean_F_z), np.ptp(y, axis=1))

    def observe(self, state: MarchState, keep: bool) -> tuple[MarchState, PeriodRecord]:
        """The state a period later, with a close look; the march is the same with and without `keep`."""
        scaled, n, n_steps = self.scaled, self.scaled.springs.gap.size, self.scaled.drive.steps
        before, state = state, state.copy()
        kept = n_steps if keep else 0
        nodes = nodes_of(scaled.drive.h, scaled.law.modes, scaled.law.arms)
        seen = loop.Seen(nodes, np.zeros(N_SUMS), np.zeros((n_steps, 3)), *np.zeros((5, kept, n)))
        seen.sums[LEAST_SLIP] = np.inf
        trace, passed = self._marched(state, 1), before.copy()
        _, springs, _, motion, law, tools = self._parts
        loop.look(passed.e, passed.s, springs, motion, law, tools, trace, seen)
        x_2 = np.diff(scaled.drive.x_dot) / (2 * scaled.drive.h)  # the shake goes on parabolas
        x_1 = np.diff(scaled.drive.x) / scaled.drive.h - x_2 * scaled.drive.h
        seen.sums[SHAKE_WORK] = x_1 @ trace.area + 2 * x_2 @ trace.moment
        seen.sums[LEAST_SLIP] = min(seen.sums[LEAST_SLIP], least_between(seen.F[:, 2]))
        y, rate = (np.concatenate([before.body[k : k + 1], of]) for k, of in ((Y, trace.y), (RATE, trace.rate)))
        stored = self.stored_energy(before), self.stored_energy(state)
        return state, PeriodRecord(seen, y, rate, stored, self._periods_of(trace), self.solved)

    def within_friction(self, state: MarchState) -> MarchState:
        """The state with every extension within the cone of friction; in place."""
        loop.within_friction(state.x, state.s)
        return state

    def search(self, at: loop.Search, like: MarchState, roots: Array, n_periods: int) -> tuple[bool, Periods]:
        """Go on with a search for its periodic state, for at most so many periods; whether it has come to its end, and
        the last period, if it was the one that moved least. like: a state of this march.
        """
        n_before, trace = int(at.counts[loop.PERIODS]), self.scaled.trace()
        ended = loop.search(at, like.s, roots, *self._parts, n_periods, trace)
        self._count(int(at.counts[loop.PERIODS]) - n_before)
        return bool(ended), self._periods_of(trace)

    def stored_energy(self, state: MarchState) -> float:
        """Elastic and kinetic energy of springs, body and system spring, in the unit of the tangential springs."""
        scaled, y, rate = self.scaled, float(state.body[Y]), float(state.body[RATE])
        u_dot = self.v + rate
        if scaled.drive.far_end.any():  # the body moves on the way of the shake too, and stretches its spring by less
            u_dot, y = u_dot + float(scaled.drive.x_dot[0]), y + float(scaled.drive.x[0] - scaled.drive.far_end[0])
        ratios = np.concatenate([[1.0], scaled.rheology.rho])
        springs, normal = (0.5 * float(ratios @ (one**2 @ scaled.springs.w)) for one in (state.e, state.s))
        ratio = scaled.units.energy_z / scaled.units.energy_x
        system = 0.0 if scaled.body.rigid else 0.5 * scaled.body.K * y**2 + 0.5 * scaled.body.M * u_dot**2
        return float(springs + normal * ratio + system)


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
    cofs, swings = zip(*parts, strict=True)
    return Periods(np.concatenate(cofs), np.concatenate(swings))
