"""The stepper of the march: a state in, the state some periods later out.

A state belongs to phase 0 of the normal motion. The stepper itself holds what does not change, the contact in scaled
form and the velocity of the pull, and counts the periods that it marched.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from mdr.march import kernels
from mdr.march.dimensionless import ScaledContact
from mdr.march.steady_state import TOLERANCE
from mdr.materials.operator import L_DECAY, L_RATIO
from mdr.tools.arrays import Array
from mdr.tools.progress import Ticker, time_is_over

AT_ONCE = 2**17  #: steps of a march whose forces are kept until their periods are averaged
IN_CACHE = 50_000  #: extensions that a close look keeps at once


class MarchState:
    """Springs and body between two periods. The springs of an elastic march keep no compression: it follows z.

    All that a period can change stands in one vector, of which the named parts are views.
    """

    __slots__ = ("body", "e", "s", "x")

    def __init__(self, x: Array, s: Array) -> None:
        self.x = x  #: (n_x,) extensions, y, S and the sums over arms
        self.s = s  #: (1 + J, n) compressions, and their arms
        self.e = x[: s.size].reshape(s.shape)  #: (1 + J, n) extensions, and their arms
        self.body = self.body_of(x)

    @classmethod
    def of(cls, e: Array, s: Array, body: kernels.BodyState) -> MarchState:
        """The state of these parts, copied."""
        return cls(np.concatenate([e.ravel(), *(part.ravel() for part in body)]), s.copy())

    def copy(self) -> MarchState:
        """A state that can be marched on without a change of this one."""
        return MarchState(self.x.copy(), self.s.copy())

    def body_of(self, x: Array) -> kernels.BodyState:
        """The body in the state that a vector stands for; views of it."""
        n = self.s.size
        return kernels.BodyState(x[n : n + 3], x[n + 3 : n + 5], x[n + 5 :].reshape(2, -1))

    def with_vector(self, x: Array) -> MarchState:
        """The state that a vector stands for; a copy."""
        return MarchState(x.copy(), self.s.copy())


class Periods(NamedTuple):
    """COF and swing of each of some periods."""

    cof: Array  #: (n_periods,) mean of L[e] over that of F_z, which is the COF over mu_0
    swing: Array  #: (n_periods,) of the body, greatest less least y
    as_one: bool  #: whether the lumped core moved as one all the way


@dataclass(frozen=True, eq=False)
class PeriodRecord:
    """A period that was looked at closely, in scaled form."""

    seen: kernels.Seen  #: forces, modes and energies
    y: Array  #: (n_steps + 3,) the body two nodes and one before the period, at its start, at the end of every step
    e: Array  #: (n_steps, n) extensions, or (0, n)
    s: Array  #: (n_steps, n) compressions, or (0, n)
    stored: tuple[float, float]  #: energy at both ends, in the unit of the tangential springs
    period: Periods  #: its COF and swing


class Stepper:
    """Marches a contact at one velocity.

    tolerance: of cof/mu_0, to which its periodic state is to be found; total: periods to be marched, where known.
    """

    def __init__(self, scaled: ScaledContact, v: float, tolerance: float = TOLERANCE, total: int | None = None) -> None:
        self.scaled, self.v, self.tolerance = scaled, v, tolerance
        self.springs, self.motion = scaled.springs, scaled.motion(v)
        self._remembers = bool(scaled.n_arms or scaled.table[L_DECAY, 0] > 0)
        self.mean_F_z = scaled.normal.mean
        self.n_periods = 0  # marched so far
        self.ticker = Ticker("slide" if total else "slide, waiting for a steady state", total, "periods")

    def full_slip(self) -> MarchState:
        """The state of full slip at phase 0; of a body without its free oscillation."""
        s = self.scaled.normal.s
        return MarchState.of(s, s, self.scaled.full_slip_state(self.scaled.normal.S, self.v))

    def resonant(self) -> MarchState | None:
        """The state of a body that a resonance drives as far as stick lets it; None where none does."""
        s, body = self.scaled.normal.s, self.scaled.resonant_state(self.scaled.normal.S, self.v)
        return None if body is None else MarchState.of(s, s, body)

    def rest(self) -> MarchState:
        """The state in which nothing is stretched and the body at rest."""
        s = self.scaled.normal.s
        return MarchState.of(np.zeros_like(s), s, self.scaled.rest_state(self.v))

    def period(self, state: MarchState) -> MarchState:
        """The state a period later; the one given is marched on in place."""
        self._marched(state, self.scaled.steps)
        return state

    def advance(self, state: MarchState, n_periods: int) -> tuple[MarchState, Periods]:
        """The state some periods later, with their COFs; fewer periods where the time limit of the caller is over."""
        parts = [Periods(np.empty(0), np.empty(0), True)]
        for part in _parts(n_periods, max(1, AT_ONCE // self.scaled.steps)):
            before, state = state.body, state.copy()
            trace, as_one = self._marched(state, part * self.scaled.steps)
            parts.append(self._periods_of(before, trace, as_one))
            if time_is_over():
                break
        return state, joined(parts)

    def _marched(self, state: MarchState, n_steps: int) -> tuple[kernels.Trace, bool]:
        """A whole number of periods in place, counted."""
        nothing = np.empty((0, *state.e.shape))
        trace = kernels.Trace(np.empty(n_steps), np.empty(n_steps), nothing, nothing)
        motion = self.springs, self.motion, self.scaled.table
        as_one = kernels.march(state.e, state.s, state.body, self.scaled.body, *motion, 0, trace)
        self._count(n_steps // self.scaled.steps)
        return trace, bool(as_one)

    def _count(self, n_periods: int) -> None:
        self.n_periods += n_periods
        self.ticker.tick(n_periods)

    def _periods_of(self, before: kernels.BodyState, trace: kernels.Trace, as_one: bool) -> Periods:
        """COF of each whole period: the mean of L[e] is that of e but for the ends; before: the state at its start."""
        scaled, S = self.scaled, trace.S
        ends = np.concatenate([before.S[:1], S[scaled.steps - 1 :: scaled.steps]])
        inner = S.reshape(-1, scaled.steps).mean(axis=1) - 0.5 * (ends[1:] - ends[:-1]) / scaled.steps
        arms = scaled.arms_at_ends(S, float(before.S[0]), before.arms[0])
        mean = scaled.mean_force(np.diff(ends), inner, np.diff(arms, axis=0), 2 * np.pi)
        return Periods(mean / self.mean_F_z, np.ptp(trace.y.reshape(-1, scaled.steps), axis=1), as_one)

    def _period_of(
        self, before: kernels.BodyState, after: kernels.BodyState, trace: kernels.Trace, as_one: bool
    ) -> Periods:
        """The same of one period, of which the body is known at both ends."""
        change = float(after.S[0] - before.S[0])
        inner = (float(trace.S.sum()) - 0.5 * change) / trace.S.size
        cof = self.scaled.mean_force(change, inner, after.arms[0] - before.arms[0], 2 * np.pi) / self.mean_F_z
        return Periods(np.array([cof]), np.array([trace.y.max() - trace.y.min()]), as_one)

    def observe(self, state: MarchState, keep: bool) -> tuple[MarchState, PeriodRecord]:
        """The state a period later, with a close look; the march is the same with and without `keep`."""
        scaled, n, n_steps = self.scaled, self.scaled.gap.size, self.scaled.steps
        before, state = state, state.copy()
        kept = n_steps if keep else 0
        F_x, F_z, slip = np.empty((3, n_steps))
        f_x, f_z = np.empty((2, kept, n))
        seen = kernels.Seen(np.zeros(kernels.N_SUMS), F_x, F_z, slip, np.zeros((kept, n), dtype=np.uint8), f_x, f_z)
        seen.sums[kernels.LEAST_SLIP] = np.inf
        trace = kernels.Trace(
            np.empty(n_steps), np.empty(n_steps), *np.empty((2, kept, 1, n))
        )  # of the springs, not of their arms
        at_once = min(n_steps, max(8, IN_CACHE // state.e.size))  # in cache, in not too many parts
        motion = self.springs, self.motion, scaled.table
        as_one = kernels.watch(state.e, state.s, state.body, scaled.body, *motion, at_once, trace, seen)
        self.n_periods += 1
        y = np.concatenate([before.body.y[::-1], trace.y])
        stored = self.stored_energy(before), self.stored_energy(state)
        period = self._period_of(before.body, state.body, trace, bool(as_one))
        return state, PeriodRecord(seen, y, trace.e[:, 0], trace.s[:, 0], stored, period)

    def within_friction(self, state: MarchState) -> MarchState:
        """The state with every extension within the cone of friction, and the sums that belong to it; in place."""
        kernels.begin(state.e, self._compression(state), state.body, self.springs, self.scaled.table)
        return state

    def search(self, at: kernels.Search, like: MarchState, roots: Array, n_periods: int) -> tuple[bool, Periods]:
        """Go on with a search for its periodic state, for at most so many periods; whether it has come to its end, and
        the last period, if it was the one that moved least. like: a state of this march.
        """
        n_before, nothing = int(at.counts[kernels.PERIODS]), np.empty((0, *like.e.shape))
        trace = kernels.Trace(np.empty(self.scaled.steps), np.empty(self.scaled.steps), nothing, nothing)
        motion = self.springs, self.motion, self.scaled.table
        ended, as_one = kernels.search(
            at, like.s, self._compression(like), roots, self.scaled.body, *motion, n_periods, trace
        )
        self._count(int(at.counts[kernels.PERIODS]) - n_before)
        start, end = like.body_of(at.start), like.body_of(at.best)
        return bool(ended), self._period_of(start, end, trace, bool(as_one))

    def settled_in(self, states: Array, like: MarchState, n_periods: int) -> tuple[Array, Array]:
        """What states (k, n_x) of the march have come to after so many periods, and a period later; like: one of it."""
        steps, nothing = self.scaled.steps, np.empty((0, *like.e.shape))
        trace = kernels.Trace(np.empty(steps), np.empty(steps), nothing, nothing)
        before, after = np.empty_like(states), np.empty_like(states)
        motion = self.springs, self.motion, self.scaled.table
        pressed = self._compression(like)
        kernels.settle_in(states, like.s, pressed, self.scaled.body, *motion, n_periods, trace, before, after)
        self._count(len(states) * (n_periods + 1))
        return before, after

    def _compression(self, state: MarchState) -> Array:
        """Compressions at phase 0; the elastic march does not keep them."""
        return np.asarray(state.s[0]) if self._remembers else self._pressed

    @cached_property
    def _pressed(self) -> Array:
        """Compressions of elastic springs at phase 0; not to be written to."""
        return np.asarray(np.maximum(self.scaled.z[0] - self.scaled.gap, 0))

    def stored_energy(self, state: MarchState) -> float:
        """Elastic and kinetic energy of springs, body and system spring, in the unit of the tangential springs."""
        scaled, (y, y_old, y_older) = self.scaled, state.body.y
        u_dot = self.v + (1.5 * y - 2 * y_old + 0.5 * y_older) / scaled.h
        if scaled.far_end.any():  # the body moves on the way of the shake too, and stretches its spring by less
            u_dot, y = u_dot + float(scaled.x_dot[0]), y + float(scaled.x[0] - scaled.far_end[0])
        ratios = scaled.table[L_RATIO]
        springs = 0.5 * float(ratios @ (state.e**2 @ scaled.w))
        normal = 0.5 * float(scaled.w @ self._compression(state) ** 2 + ratios[1:] @ (state.s[1:] ** 2 @ scaled.w))
        ratio = scaled.stiffness_z * scaled.length_z**2 / (scaled.stiffness_x * scaled.length_x**2)
        system = 0.0 if scaled.rigid else 0.5 * scaled.K * y**2 + 0.5 * scaled.M * u_dot**2
        return float(springs + normal * ratio + system)


def joined(parts: list[Periods]) -> Periods:
    """Periods one after the other."""
    cofs, swings, as_one = zip(*parts, strict=True)
    return Periods(np.concatenate(cofs), np.concatenate(swings), all(as_one))


def _parts(total: int, most: int) -> list[int]:
    """Cut a number of steps into parts of at most `most`."""
    return [min(most, total - start) for start in range(0, total, most)]
