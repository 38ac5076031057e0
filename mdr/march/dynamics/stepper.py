"""The stepper of the march: a state in, the state some periods later out.

A state belongs to phase 0 of the normal motion. The stepper itself holds what does not change, the contact in scaled
form and the velocity of the pull, and counts the periods that it marched.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import NamedTuple

import numpy as np

from mdr.march.dynamics import loop
from mdr.march.dynamics.body import N_BODY, RATE, Body, U
from mdr.march.dynamics.dimensionless import AxisMotion, ScaledContact
from mdr.march.dynamics.kernel import new_trace, trace_of
from mdr.march.dynamics.state import UNKNOWN, MarchState, on_other_springs, within_friction
from mdr.spring.contact import Springs
from mdr.spring.contact_modes import SLIP
from mdr.spring.energies import CONTACT_IMPULSE, LEAST_SLIP, N_SUMS, SHAKE_WORK, STICK_IMPULSE
from mdr.spring.limit import NO_MODES
from mdr.tools.arrays import EXACT, Array
from mdr.tools.progress import Ticker, time_is_over

TOLERANCE = 1e-6  #: of cof/mu_0, to which a periodic state is known
ALIKE = 3.0  #: ratio of second differences; a slip velocity jumps, and bends otherwise, where springs touch and leave
FINE = 65  #: places at which `least_between` looks at a polynomial; a parabola there misses 1e-6 of a second difference
WITH_IT = 0.5  #: of the distance of the pull: a spring whose extension changes by less has slipped about as far
AT_ONCE = 2**17  #: steps between two looks at the clock, whose forces are kept until they are averaged


class Periods(NamedTuple):
    """COF and swing of each of some periods."""

    cof: Array  #: (n_periods,) mean of F_x over that of F_z, which is the COF over mu_0
    swing: Array  #: (n_periods,) of the body, greatest less least y
    cof_y: Array  #: (n_periods,) mean of F_y over that of F_z, over mu_0


@dataclass(frozen=True, eq=False)
class PeriodRecord:
    """A period that can be looked at closely, in scaled form."""

    look: Callable[[], loop.Seen]  #: steps it again
    u: Array  #: (n_steps + 1,) the body at the start of the period and at the end of every step: complex in the plane
    rate: Array  #: (n_steps + 1,) its velocity there
    stored: tuple[float, float]  #: energy at both ends, in the unit of the tangential springs
    period: Periods  #: its COF and swing
    solved: bool  #: whether every step of it was solved for

    @cached_property
    def seen(self) -> loop.Seen:
        """Forces, modes and energies; the close look is taken when it is asked for."""
        return self.look()

    @property
    def sees_contact(self) -> bool:
        """Whether any spring presses for longer than an instant between two steps."""
        sums = self.seen.sums
        return bool(sums[CONTACT_IMPULSE] > 0 and np.isfinite(sums[LEAST_SLIP]))


def stick_share(records: Sequence[PeriodRecord]) -> float:
    """Force-weighted share of contact time spent sticking."""
    stuck, pressed = (sum(record.seen.sums[one] for record in records) for one in (STICK_IMPULSE, CONTACT_IMPULSE))
    return float(stuck / pressed)


class Stepper:
    """Marches a contact at one velocity.

    tolerance: of cof/mu_0, to which its periodic state is to be found; total: periods to be marched, where known.
    """

    def __init__(self, scaled: ScaledContact, v: float, tolerance: float = TOLERANCE, total: int | None = None) -> None:
        self.scaled, self.v, self.tolerance = scaled, v, tolerance
        self.kernel, self.block = scaled.in_numbers
        self.mean_limit = scaled.limit.mean
        self.n_periods = 0  # marched so far
        self.solved = True  # whether every step of the last march was solved for
        self.ticker = Ticker("slide" if total else "slide, waiting for a steady state", total, "periods")

    @cached_property
    def motion(self) -> loop.Motion:
        """Motion of the indenter over a period."""
        return self.scaled.drive.with_pull(self.v)

    @cached_property
    def room(self) -> tuple[Array, loop.Trace]:
        """Room for the trace of a period, flat and by its names."""
        return self.new_room(1)

    @property
    def last(self) -> loop.Trace:
        """The last period, overwritten by the next march."""
        return self.room[1]

    def full_slip(self) -> MarchState:
        """The state of full slip at phase 0; of a body without its free oscillation."""
        return self._ahead(self.scaled.full_slip.state(self.v))

    def resonant(self) -> MarchState | None:
        """The state of a body that a resonance drives as far as stick lets it; None where none does."""
        body = self.scaled.full_slip.resonant(self.v)
        return None if body is None else self._ahead(body)

    def _ahead(self, body: Array) -> MarchState:
        """All springs at their limit along the pull, and the body so."""
        scaled, one = self.scaled, 1.0 if self.scaled.n_axes == 1 else 1 + 0j
        modes = np.full(scaled.springs.gap.size, float(SLIP)) if scaled.limit.falls else NO_MODES
        return MarchState.of(one * scaled.limit.s, scaled.normal.s, one * body, modes)

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
            parts.append(self.periods_of(self._marched(state, min(most, n_periods - start))))
            if time_is_over():
                break
        return state, joined(parts)

    def late(self, before: MarchState, after: MarchState, n_periods: int) -> float:
        """Friction over mu_0 that springs may still gain which have not slipped as far as the pull went in these last
        periods: in a periodic motion each does, however slow the pull, and however little a state changes that has
        hardly moved.
        """
        pull = 2 * np.pi * self.v
        if pull <= self.scaled.hidden_pull:
            return UNKNOWN if pull else 0.0
        went = (after.e[0] - before.e[0] - (after.body[U] - before.body[U])).real
        late = np.abs(went) > WITH_IT * n_periods * pull
        return 2 * float(self.scaled.greatest_force @ late) / self.mean_limit

    def _marched(self, state: MarchState, n_periods: int) -> loop.Trace:
        """A whole number of periods in place, counted."""
        n_steps = n_periods * self.scaled.drive.steps
        flat, trace = self.room if n_periods == 1 else self.new_room(n_periods)
        self.solved = self.kernel(self.block, self.v, state.x, state.s, n_steps, flat)
        self.count(n_periods)
        if n_periods > 1:
            for of, last in zip(trace, self.last, strict=True):
                last[:] = of[-len(last) :]
        return trace

    def new_room(self, n_periods: int) -> tuple[Array, loop.Trace]:
        """Flat room for a trace, and the trace."""
        flat, n_steps = new_trace(self.block, n_periods), n_periods * self.scaled.drive.steps
        return flat, trace_of(flat, n_steps, self.scaled.in_plane)  # type: ignore[no-untyped-call]

    def count(self, n_periods: int) -> None:
        """Add periods to those that were marched."""
        self.n_periods += n_periods
        self.ticker.tick(n_periods)

    def periods_of(self, trace: loop.Trace) -> Periods:
        """COFs and swing of each whole period."""
        area, u = (one.reshape(-1, self.scaled.drive.steps) for one in (trace.area, trace.u))
        cof = area.sum(axis=1) / (2 * np.pi * self.mean_limit)
        return Periods(cof.real, np.maximum(np.ptp(u.real, axis=1), np.ptp(u.imag, axis=1)), cof.imag)

    def cof_of(self, trace: loop.Trace) -> tuple[float, float]:
        """Mean force along the pull and across it, of a period, over that of full slip: COFs over mu_0."""
        cof = complex(trace.area.sum()) / (2 * np.pi * self.mean_limit)
        return cof.real, cof.imag

    def least_slip(self, trace: loop.Trace, cof: float) -> float:
        """Least slip velocity, along the pull, in a period of this COF over mu_0, of springs that slip all the time;
        zero if some do not. A step in which contact begins counts as a whole, if it is not cut there.
        """
        if not (self.scaled.limit.gap_tells and abs(1 - cof) <= EXACT):
            return 0.0
        (z, z_dot, *_), h = self.motion, self.scaled.drive.h
        z_2 = np.diff(z_dot) / (2 * h)
        length, x_1, x_2 = trace.parts[:, 1].real.T
        first = x_1 - np.diff(z) / h + z_2 * h - 2 * z_2 * (h - length)
        last = first + 2 * (x_2 - z_2) * length
        return float(np.minimum(first, last).min(where=trace.area.real > 0, initial=np.inf))

    def unseen(self, state: MarchState) -> float:
        """Limit.unseen of the period from a state on."""
        if not self.scaled.limit.hides_stick:
            return 0.0
        length, x_1, x_2 = self._marched(state.copy(), 1).parts[:, 1].T
        return self.scaled.limit.unseen(np.abs(x_1 + length * x_2), self.scaled.drive.z_dot[:-1])

    def observe(self, state: MarchState, keep: bool) -> tuple[MarchState, PeriodRecord]:
        """The state a period later, and its record. keep: whether a close look keeps each spring."""
        before, state = state, state.copy()
        start, last = before.body, self._marched(state, 1)
        trace = loop.Trace(*(one.copy() for one in last))
        stored = self.stored_energy(before), self.stored_energy(state)
        u, rate = (np.append(start[at], one) for at, one in ((U, trace.u), (RATE, trace.rate)))
        look = partial(self._look, before.copy(), trace, keep)
        return state, PeriodRecord(look, u, rate, stored, self.periods_of(trace), self.solved)

    def _look(self, passed: MarchState, trace: loop.Trace, keep: bool) -> loop.Seen:
        """A close look at a period from a state on, which is changed."""
        scaled, n, n_steps = self.scaled, self.scaled.springs.gap.size, self.scaled.drive.steps
        sums, F, kept = np.zeros(N_SUMS), np.zeros((n_steps, 4)), n_steps if keep else 0
        mode, f_z, s = np.zeros((3, kept, n))
        f, e = np.zeros((2, kept, n), passed.e.dtype)
        seen = loop.Seen(sums, F, mode, f, f_z, e, s)
        sums[LEAST_SLIP] = np.inf
        if scaled.drive.is_shaken:
            sums[SHAKE_WORK] = self._work_of(scaled.drive.along, trace.area.real, trace.moment.real)
        limits = scaled.strengths
        if limits is not None:
            limits = limits._replace(was=passed.modes, now=np.zeros_like(passed.modes))
        loop.look(passed.e, passed.s, scaled.springs, limits, self.motion, scaled.law, trace, seen)
        if scaled.drive.across is None:
            sums[LEAST_SLIP] = min(sums[LEAST_SLIP], least_between(F[:, 2]))
        else:
            sums[SHAKE_WORK] += self._work_of(scaled.drive.across, trace.area.imag, trace.moment.imag)
        return seen

    def of_springs(self, state: MarchState, springs: Springs, looks: int = 2) -> tuple[Array, Array, Array]:
        """Mode, force and normal force over stiffness (n_t, n) at the end of each step, under Coulomb's limit, of any
        springs that come along without weight in a periodic motion, from its state on. looks: at it, before the last of
        which springs that are not of the row come to where they return to.
        """
        scaled, n_t, n = self.scaled, self.scaled.drive.steps, springs.gap.size
        gap, order, trace = scaled.springs.gap, scaled.order, self._marched(state.copy(), 1)
        x = on_other_springs(state.x[None], gap, order, springs.gap, scaled.n_axes)[0]
        beside = MarchState(x, np.array([np.interp(springs.gap, gap[order], one[order]) for one in state.s]))
        for _ in range(looks):
            seen = loop.Seen(np.zeros(N_SUMS), np.zeros((n_t, 4)), *np.zeros((5, n_t, n)))
            loop.look(beside.e, beside.s, springs, None, self.motion, scaled.law, trace, seen)
        return seen.mode, seen.f, seen.f_z

    def _work_of(self, axis: AxisMotion, area: Array, moment: Array) -> float:
        """Work of a shake, which goes on parabolas."""
        h = self.scaled.drive.h
        x_2 = np.diff(axis.x_dot) / (2 * h)
        return float((np.diff(axis.x) / h - x_2 * h) @ area + 2 * x_2 @ moment)

    def within_friction(self, state: MarchState) -> MarchState:
        """The state with every extension within the cone of friction; in place."""
        within_friction(state.x, state.s, self.scaled.limit.most)
        return state

    def stored_energy(self, state: MarchState) -> float:
        """Elastic and kinetic energy of springs, body and system spring, in the unit of the tangential springs."""
        scaled, system = self.scaled, 0.0
        for body, axis, pull, (u, u_dot) in self.directions(state.body[U], state.body[RATE]):
            stretch, velocity = float(u), float(u_dot) + pull
            if axis.far_end.any():  # the body moves with the shake too, and stretches its spring by less
                velocity, stretch = velocity + float(axis.x_dot[0]), stretch + float(axis.x[0] - axis.far_end[0])
            system += 0.0 if body.rigid else 0.5 * body.K * stretch**2 + 0.5 * body.M * velocity**2
        ratios = np.concatenate([[1.0], scaled.rheology.rho])
        springs = 0.5 * float(ratios @ (np.abs(state.e) ** 2 @ scaled.springs.w))
        normal = 0.5 * float(ratios @ (state.s**2 @ scaled.springs.w))
        return springs + normal * scaled.units.energy_z / scaled.units.energy_x + system

    def directions(self, u: Array, rate: Array) -> list[tuple[Body, AxisMotion, float, tuple[Array, Array]]]:
        """Body, shake, velocity of the pull, and motion and rate of the body, along the pull and across it."""
        scaled, aside = self.scaled, self.scaled.drive.across
        along = scaled.body, scaled.drive.along, self.v, (u.real, rate.real)
        return [along] if aside is None else [along, (scaled.body_across, aside, 0.0, (u.imag, rate.imag))]


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
