"""The march of one contact through its periods, in scaled form: the bridge to the compiled march.

A march starts on the full-slip solution, or from rest. From full slip the periodic state of a body is solved for
(periodic_orbit.py). Where that finds none, and from rest, the march goes on until windows of periods agree
(steady_state.py) and the body has outlasted its beat, and now and then solves from where it has come to. Under a rigid
pull it needs a period or two. Then it looks closely at its last periods: modes, forces and energies. If its core was
lumped and turns out not to move as one, the march is done again with every spring for itself. A COF that contradicts a
theorem (theorems.py) is not called settled.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.march import kernels
from mdr.march import periodic_orbit as periodic
from mdr.march.dimensionless import ScaledContact
from mdr.march.steady_state import UNKNOWN, Settling, judge, smooth_mean
from mdr.march.theorems import outside
from mdr.materials.operator import L_DECAY, L_RATIO
from mdr.normal.springs import SpringArray
from mdr.tools.memoise import remembered
from mdr.tools.progress import Ticker, time_is_over

Array = NDArray[np.float64]

TOLERANCE = 1e-6  #: of cof/mu_0 between windows of a settled run
BEATS = 2.0  #: of an undamped body that a settled run has seen
E_FOLDS = 8.0  #: of a damped oscillation after which no beat is left
NEARLY = 2e-3  #: below the end of stick, of it: where less than TOLERANCE is missing in the COF
FULL = 1e-12  #: what is missing in the COF in full slip: rounding
AGES = 1e6  #: periods that full slip must last to count as periodic
SOLVE_AGAIN = 8  #: times the periods after which the periodic state is looked for once more
SOLVED_TOLERANCE = 1e-5  #: of cof/mu_0, bound on the error of a periodic state that was solved for; cof_error has it
SAME_GAIN = 0.1  #: gain times h², up to which it is the same at another resolution: multipliers move by h²
DYING = 0.1  #: share of the swing of a damped body that is still to die away
SWING_TOLERANCE = 1e-3  #: growth of the swing of the body within the run, over the swing
DEEPEST = 1e9  #: u_z0/du_z, beyond which the amplitude is lost in the rounding of an extension
FASTEST = 1e15  #: v_0 over Eq. (1), beyond which nothing but the pull is left in the digits of a slip velocity
MOST_SHARED = 8192  #: springs of arrays that are kept for further runs
AT_ONCE = 2**17  #: steps of a march whose forces are kept until their periods are averaged
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
    seen: Seen  # the period that modes and energies are taken from
    record: tuple[Seen, ...]  # all observed periods
    state: tuple[Array, Array]  # extensions and history of the body at its end, which is a whole period

    @property
    def cof(self) -> float:
        """COF over mu_0."""
        return self.settling.mean

    @property
    def sees_contact(self) -> bool:
        """Whether any spring presses for longer than an instant between two steps."""
        sums = self.seen.sums
        return bool(sums[kernels.CONTACT_TIME] > 0 and np.isfinite(sums[kernels.LEAST_SLIP]))

    @property
    def least_slip(self) -> float:
        """Least slip velocity in contact over v_0 of a run in full slip; zero of any other."""
        sums = self.seen.sums
        full = float(sums[kernels.STICK_TIME]) == 0 and abs(1 - self.cof) < 1e-12
        return float(sums[kernels.LEAST_SLIP]) * self.scaled.speed / self.v_0 if full else 0.0


@dataclass(frozen=True, eq=False)
class Seen:
    """An observed period in scaled form; F_x, F_z, slip, y per step, the others per step and spring (or empty)."""

    sums: Array
    F_x: Array
    F_z: Array
    slip: Array
    y: Array
    e: Array
    s: Array
    f_x: Array  # over the stiffness of the spring
    f_z: Array
    mode: NDArray[np.uint8]
    stored: tuple[float, float]


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
    springs, scaled = _at_hand(case, knobs)
    if not scaled.normal.mean > 0:
        raise too_coarse(knobs.steps)
    v = v_0 / scaled.speed
    line = Line(scaled, v, knobs.start)
    n_seen = max(1, knobs.record)
    settling = None
    if n_periods is None:
        if near is not None and near.settling.solved:
            settling = line.solve((line.state_of(near),), line.gain_of(near))
        if settling is None and (scaled.K or scaled.n_arms) and knobs.start == "full_slip":
            settling = line.solve()
        most = MAX_PERIODS["spring" if scaled.K else "rigid"] if near is None else MOST_BESIDE
        settling = settling or line.wait(most)
    else:
        line.advance(n_periods - n_seen)
    state = line.e.copy(), line.history.copy()  # before the look at the last periods, however many are kept
    seen = [line.observe(keep=knobs.record > 0) for _ in range(n_seen)]
    if not np.isfinite(line.cofs).all():
        raise ValueError(f"the run left the range of floats at v_0 = {v_0:g} m/s: use units nearer to one")
    if not line.as_one and knobs.lump:  # the core did not move as one after all: every spring for itself
        return march(case, v_0, replace(knobs, lump=False), n_periods, near)
    if settling is None:
        settling = line.judge()
    account = seen[0] if n_periods is None else seen[-1]  # the same period however many are kept
    if settling.settled and (why := _contradiction(line, account, settling)):
        settling = replace(settling, settled=False, kind="unsettled", why=why, contradicts=True)
    return March(
        case,
        v_0,
        knobs,
        scaled,
        springs,
        settling,
        line.n_periods,
        line.on_the_way,
        line.mean_F_z,
        account,
        tuple(seen),
        state,
    )


def _contradiction(line: Line, seen: Seen, settling: Settling) -> str:
    """Why the COF that a march has settled at cannot be one; nothing if it can."""
    least = float(seen.F_z.min()) / line.mean_F_z
    # between two nodes F_z may be lower by h² F_z''/8, and means over nodes miss as much
    return outside(settling.mean, least, settling.spread + TOLERANCE + 10 * line.scaled.h**2)


def touches(case: SlidingContact, knobs: Knobs) -> bool:
    """Whether any spring presses at the instants of these steps."""
    scaled = _at_hand(case, knobs)[1]
    return scaled.n_core > 0 or scaled.normal.mean > 0


def too_coarse(steps: int) -> ValueError:
    """The error of a contact that the steps do not see."""
    return ValueError(
        f"steps_per_period = {steps} is too coarse: the contact begins and ends within a step; "
        "raise it, or press deeper"
    )


def _at_hand(case: SlidingContact, knobs: Knobs) -> tuple[SpringArray, ScaledContact]:
    prepared = _shared if knobs.n_springs <= MOST_SHARED else _prepared
    return prepared(case, knobs.n_springs, knobs.steps, knobs.lump and knobs.start == "full_slip")


@remembered(maxsize=16)
def _shared(case: SlidingContact, n_springs: int, steps: int, lump: bool) -> tuple[SpringArray, ScaledContact]:
    """Springs and their scaled form; runs of one case at other velocities share them."""
    return _prepared(case, n_springs, steps, lump)


def _prepared(case: SlidingContact, n_springs: int, steps: int, lump: bool) -> tuple[SpringArray, ScaledContact]:
    springs = SpringArray.of(case, n_springs)
    return springs, ScaledContact.of(case, springs, steps, lump)


class _OutOfTime(Exception):
    """The time limit of the caller is over in the middle of a search."""


class Line:
    """The state of a march between calls of the kernel."""

    def __init__(self, scaled: ScaledContact, v: float, start: str) -> None:
        self.scaled, self.v = scaled, v
        normal = scaled.normal
        self.s, self.spans, self.mean_F_z = normal.s.copy(), normal.spans, normal.mean  # rows of s: arms
        self.e = np.zeros_like(self.s)  # extension, likewise
        self.driven: Array | None = None  # history of the body on an undamped resonance, if it is on one
        self.on_the_way = 0.0  # periods until a run from rest can have stretched springs and system
        if start == "full_slip":
            self.e[:] = self.s
            if scaled.K:
                self.history = scaled.full_slip_history(scaled.full_slip_force, v)
                self.driven = scaled.resonant_history(scaled.full_slip_force, v)
            else:
                now, *arms = self.s @ scaled.w
                self.history = np.array([0, 0, 0, now, now, *arms, *arms])
        else:
            self.history = scaled.rest_history(v)
            load = float(scaled.w @ np.maximum(scaled.z.max() - scaled.gap, 0))
            distance = float(scaled.z.max()) - float(scaled.gap.min()) + (load / scaled.K if scaled.K else 0.0)
            self.on_the_way = distance / (2 * np.pi * v)
        self.as_one = True
        self.n_periods = 0  # marched so far
        self.cofs = np.empty(0)  # of each period that was not marched in search of the periodic state
        self.swings = np.empty(0)  # of the body in it, greatest less least y
        self.ticker = Ticker("slide, waiting for a steady state, periods")

    def _call(self, n_steps: int, k_0: int, e_out: Array, s_out: Array) -> tuple[Array, Array]:
        scaled = self.scaled
        y, S = np.empty(n_steps), np.empty(n_steps)
        as_one = kernels.march(
            self.e,
            self.s,
            self.history,
            scaled.body,
            scaled.gap,
            scaled.w,
            scaled.z,
            scaled.z_dot,
            self.spans,
            self.v,
            scaled.table,
            scaled.lump_margin,
            n_steps,
            k_0,
            y,
            S,
            e_out,
            s_out,
            scaled.light,
        )
        self.as_one = self.as_one and bool(as_one)
        return y, S

    def advance(self, n_periods: int) -> None:
        """March whole periods and append their COFs (over mu_0)."""
        if n_periods <= 0:
            return
        nothing = np.empty((0, *self.e.shape))
        for part in _parts(n_periods, max(1, AT_ONCE // self.scaled.steps)):
            start = self.history[3:].copy()
            y, S = self._call(part * self.scaled.steps, 0, nothing, nothing)
            self._append(start, y, S)
            self.n_periods += part
            self.ticker.tick(part)
            if time_is_over():
                break

    def _append(self, start: Array, y: Array, S: Array) -> None:
        """COF of each whole period in S: the mean of L[e], which is the mean of e but for the ends; and swing of y.

        start: S, S_old and the arms at the beginning.
        """
        self.swings = np.concatenate([self.swings, np.ptp(y.reshape(-1, self.scaled.steps), axis=1)])
        scaled = self.scaled
        ends = np.concatenate([start[:1], S[scaled.steps - 1 :: scaled.steps]])
        inner = S.reshape(-1, scaled.steps).mean(axis=1) - 0.5 * np.diff(ends) / scaled.steps
        arms = scaled.arms_at_ends(S, float(start[0]), start[2 : 2 + scaled.n_arms])
        mean = scaled.mean_force(ends, inner, arms, 2 * np.pi)
        self.cofs = np.concatenate([self.cofs, mean / self.mean_F_z])

    def wait(self, most: int) -> Settling:
        """March until the windows agree, but not before every spring has been pulled as far as it has to go.

        Now and then, where they do not, the periodic state is solved for from where the march has come to.
        """
        if self.on_the_way > most:
            self.advance(self.scaled.first_look)
            return replace(self.judge(), settled=False, kind="unsettled")
        self.advance(max(self.scaled.first_look, int(self.on_the_way)))
        solve_at = self.n_periods
        while not (settling := self.judge()).settled and self.as_one:
            if self.scaled.K and self.n_periods >= solve_at:
                solve_at = SOLVE_AGAIN * self.n_periods
                if (solved := self.solve((self._state(),))) is not None:
                    return solved
            if time_is_over():
                return replace(settling, why=f"the time limit is over after {self.n_periods} periods")
            if not self._may_settle_by(most):
                break
            self.advance(max(4, self.n_periods // 2))
        return settling

    def solve(self, starts: tuple[Array, ...] | None = None, gain: float | None = None) -> Settling | None:
        """Put the line into the periodic state that a march would end in, if one is found; else leave it as it was.

        starts: states to search from; None for that of full slip, before it that of a driven resonance. gain: how far
        a state may be from the periodic one, over its change over a period, where that is known.
        """
        before = self._state(), self.n_periods, self.cofs, self.swings
        if starts is None:
            driven = () if self.driven is None else (np.concatenate([self.e.ravel(), self.driven]),)
            starts = (*driven, before[0])
        scaled = self.scaled
        slow = tuple(theta / (2 * np.pi) for theta in scaled.rheology.theta)
        if slow and scaled.C:
            slow += (scaled.M / (np.pi * scaled.C) / periodic.CREEP,)
        guaranteed_stable = bool(slow) and (not scaled.K or scaled.C > 0)
        for start in starts:
            for close in (periodic.CLOSE, periodic.CLOSEST):
                try:
                    found = periodic.find(
                        self._period_from, start, self._size, self._pushes(), slow, guaranteed_stable, close, gain
                    )
                except _OutOfTime:
                    found = None
                if found is None:
                    break
                settling = self._repeated(found)
                if settling.spread <= TOLERANCE or slow or (settling.settled and close == periodic.CLOSEST):
                    return settling
                start = found.x
        self._put(before[0])
        _, self.n_periods, self.cofs, self.swings = before
        return None

    def _repeated(self, found: periodic.FixedPoint) -> Settling:
        """The COF of the periodic state, after one period in it, and how far it may be from the exact one."""
        self._put(found.x)
        self.as_one = True  # whether the core moves as one in this state; on the way to it it need not
        self.advance(1)
        # the mean force follows a displacement of the state, which spreads over springs of stiffness one in all
        size = float(np.linalg.norm(self._size(found.x)))
        spread = 2 * found.distance * size / self.mean_F_z
        if spread > TOLERANCE and self._slips_for_good(found.change * size):
            spread = 0.0
        if spread <= SOLVED_TOLERANCE:
            return Settling(float(self.cofs[-1]), spread, True, "periodic", found.gain)
        why = "a periodic state was found, but not how far it may be from the exact one"
        return Settling(float(self.cofs[-1]), min(spread, UNKNOWN), False, "unsettled", found.gain, why)

    def _slips_for_good(self, change: float) -> bool:
        """Whether the last period was full slip, by so much that a change of this size a period takes ages to end it.

        Where a free oscillation is a whole multiple of the drive, full slip has not one periodic motion but many.
        """
        if abs(1 - self.cofs[-1]) > FULL:
            return False
        sums = self.observe(keep=False).sums
        drift = change / np.sqrt(self.scaled.M or self.scaled.K or 1.0)  # under a rigid pull that of the springs
        return bool(sums[kernels.STICK_TIME] == 0 and AGES * drift < sums[kernels.LEAST_SLIP] < np.inf)

    def _state(self) -> Array:
        return np.concatenate([self.e.ravel(), self.history])

    def state_of(self, other: March) -> Array:
        """The state at the end of a march with other springs or steps, on those of this one."""
        e, history = other.state
        gap, step = other.scaled.gap, self.scaled.h / other.scaled.h
        order = np.argsort(gap, kind="stable")
        here = np.stack([np.interp(self.scaled.gap, gap[order], row[order]) for row in e])
        y, y_old, y_older = history[:3]
        rate, bend = 1.5 * y - 2 * y_old + 0.5 * y_older, y - 2 * y_old + y_older  # per step of the other, and its step
        at = -step * np.arange(3)
        S, S_old = history[3:5]
        body = y + rate * at + 0.5 * bend * at**2
        return np.concatenate([here.ravel(), body, [S, S + step * (S_old - S)], history[5:]])

    def gain_of(self, other: March) -> float | None:
        """The gain of a march with other springs or steps, where these move it by little; None where they may not."""
        gain, h = other.settling.gain, max(self.scaled.h, other.scaled.h)
        return gain if gain is not None and gain * h**2 < SAME_GAIN else None

    def _put(self, x: Array) -> None:
        """Take over a state; a combination of states may leave the cone of friction, which it is clipped to."""
        n, n_arms = self.e.size, self.scaled.n_arms
        s = self._compression(0)
        self.e[:] = x[:n].reshape(self.e.shape)
        self.e[0] = np.clip(self.e[0], -s, s)
        self.history[:] = x[n:]
        self.history[3] = float(self.scaled.w @ self.e[0])
        self.history[5 : 5 + n_arms] = self.e[1:] @ self.scaled.w

    def _period_from(self, x: Array) -> Array:
        if time_is_over():
            raise _OutOfTime
        self._put(x)
        nothing = np.empty((0, *self.e.shape))
        self._call(self.scaled.steps, 0, nothing, nothing)
        self.n_periods += 1
        self.ticker.tick()
        return self._state()

    @cached_property
    def _roots(self) -> Array:
        """Square roots of the stiffness of every spring, and of every arm of it, (e.size,)."""
        return np.sqrt(np.outer(self.scaled.table[L_RATIO], self.scaled.w)).ravel()

    def _size(self, x: Array) -> Array:
        """States (..., n) as vectors (..., m) whose squares are energies of springs, arms, system spring and mass."""
        scaled, n = self.scaled, self.e.size
        out = np.empty((*x.shape[:-1], n + (2 if scaled.K else 0)))
        out[..., :n] = self._roots * x[..., :n]
        if scaled.K:
            y, y_old = x[..., n], x[..., n + 1]
            out[..., n] = np.sqrt(scaled.K) * y
            out[..., n + 1] = np.sqrt(scaled.M or scaled.K) * (y - y_old) / scaled.h
        return out

    def _pushes(self) -> tuple[Array, ...]:
        """Displacements of unit size: of each arm of all springs, and of the position and velocity of the body."""
        scaled, n = self.scaled, self.e.size
        pushes = []
        for j, rho in enumerate(scaled.rheology.rho, start=1):
            arm, history = np.zeros(self.e.shape), np.zeros(self.history.size)
            arm[j] = 1 / np.sqrt(rho)
            pushes.append(np.concatenate([arm.ravel(), history]))
        if scaled.K:
            position, velocity = np.zeros((2, n + self.history.size))
            position[n : n + 3] = 1 / np.sqrt(scaled.K)
            velocity[n : n + 3] = np.array([0, -1, -2]) * scaled.h / np.sqrt(scaled.M or scaled.K)
            pushes += [position, velocity]
        return tuple(pushes)

    def judge(self) -> Settling:
        """Whether the COF has settled, and the body too: beside a resonance its swing changes long before the COF."""
        settling = judge(self.cofs, TOLERANCE)
        if settling.settled and (why := self._still_moves(settling.mean)):
            return replace(settling, settled=False, kind="unsettled", why=why)
        return settling

    def _still_moves(self, cof: float) -> str:
        """Why a COF that has settled is not the end of the motion; nothing if it is."""
        scaled, n = self.scaled, self.n_periods
        if not scaled.M:
            return ""
        changes = (abs(self.growth) if scaled.C == 0 else self.growth) * n > SWING_TOLERANCE
        if changes or self._dies_away(cof):
            return f"the swing of the body still grows or dies away after {n} periods"
        if n < self.beat:
            return f"after {n} periods the body may still be in a beat, which lasts {self.beat:.3g} of them"
        full = abs(1 - cof) <= TOLERANCE
        if full and not self._locks_in and self.v < (1 - NEARLY) * scaled.end_of_full_slip:
            return f"full slip cannot last at this velocity: after {n} periods the body has not yet come to stick"
        return ""

    @cached_property
    def _off_multiple(self) -> float:
        """How far omega_0/omega is from a whole number; zero where it is one."""
        ratio = float(np.sqrt(self.scaled.K / self.scaled.M))
        off = abs(ratio - round(ratio))
        return off if off > 1e-12 * ratio else 0.0

    @cached_property
    def _locks_in(self) -> bool:
        """Whether a free oscillation of the body stays in step with a drive that does not feed it."""
        driven = bool(np.isinf(self.scaled.end_of_full_slip))
        return self.scaled.C == 0 and self._off_multiple == 0 and not driven

    @cached_property
    def beat(self) -> float:
        """Periods that beats of the free oscillation with the drive last, or its dying away if that is shorter; where
        the drive feeds it without end, its growth tells.
        """
        scaled = self.scaled
        if scaled.C == 0 and self._off_multiple == 0:
            return 0.0
        beats = BEATS / self._off_multiple if self._off_multiple else np.inf
        return min(beats, E_FOLDS * scaled.M / (np.pi * scaled.C) if scaled.C else np.inf)

    def _dies_away(self, cof: float) -> bool:
        """Whether a body that rings for many periods still loses a swing that friction depends on: springs that it
        carries to and fro slip as it has them, however steadily. In full slip forward a smaller swing changes nothing.
        """
        scaled = self.scaled
        if not (scaled.M and scaled.C) or abs(1 - cof) <= TOLERANCE:
            return False
        return -self.growth * scaled.M / (np.pi * scaled.C) > DYING

    def _may_settle_by(self, most: int) -> bool:
        """Whether to wait on: not where a resonance drives the swing so slowly that stick never stops it in time."""
        driven = self.n_periods > 64 and self.growth * self.n_periods > SWING_TOLERANCE
        if driven and np.isinf(self.scaled.end_of_full_slip) and self.scaled.M and abs(1 - self.cofs[-1]) < TOLERANCE:
            at_stick = 2 * self.v * np.sqrt(self.scaled.M / self.scaled.K)  # swing of a body that reaches -v
            return float(at_stick / (self.growth * self.swings[-1])) < most and self.n_periods < most
        return self.n_periods < most

    @property
    def growth(self) -> float:
        """Growth of the swing of the body a period, over the swing, between the last two windows."""
        n = self.n_periods
        if n < 4 or not self.scaled.K:
            return 0.0
        late, early = smooth_mean(self.swings[n // 2 :]), smooth_mean(self.swings[n // 4 : n // 2])
        # a swing that is rounding of the position does not count
        return (late - early) / (late * (3 * n / 8) + 1e-300) if late > 1e-9 * abs(self.history[0]) else 0.0

    def observe(self, keep: bool) -> Seen:
        """March one more period with a close look; the march is the same with and without `keep`."""
        scaled, (n_x, n) = self.scaled, self.e.shape
        n_steps = scaled.steps
        sums, F_x, F_z, slip = np.zeros(kernels.N_SUMS), np.empty(n_steps), np.empty(n_steps), np.empty(n_steps)
        sums[kernels.LEAST_SLIP] = np.inf
        kept = (n_steps if keep else 0, n)
        (e_kept, s_kept, f_x, f_z), mode = np.empty((4, *kept)), np.zeros(kept, dtype=np.uint8)
        y_all, S_all, start = [self.history[2::-1].copy()], [], self.history[3:].copy()
        stored = self._stored()
        done = 0
        at_once = min(n_steps, max(8, 50_000 // self.e.size))  # arrays that stay in cache, not too many calls
        e_all, s_all = np.empty((2, at_once + 1, n_x, n))
        for part in _parts(n_steps, at_once):
            e, s = e_all[: part + 1], s_all[: part + 1]
            e[0], s[0] = self.e, self.s
            s[0, 0] = self._compression(done)
            history = self.history[2::-1].copy()
            y, S = self._call(part, done, e[1:], s[1:])
            k = (done + np.arange(part + 1)) % scaled.steps
            k[-1] = k[-2] + 1
            now = slice(done, done + part)
            kernels.observe(
                e,
                s,
                np.concatenate([history, y]),
                scaled.z[k],
                scaled.z_dot[k],
                np.ascontiguousarray(self.spans[:, now]),
                scaled.gap,
                scaled.w,
                self.v,
                scaled.table,
                scaled.h,
                sums,
                F_x[now],
                F_z[now],
                slip[now],
                mode[now],
                f_x[now],
                f_z[now],
                scaled.light,
            )
            if keep:
                e_kept[now], s_kept[now] = e[1:, 0], s[1:, 0]
            y_all.append(y)
            S_all.append(S)
            done += part
        self._append(start, np.concatenate(y_all[1:]), np.concatenate(S_all))
        self.n_periods += 1
        return Seen(
            sums, F_x, F_z, slip, np.concatenate(y_all), e_kept, s_kept, f_x, f_z, mode, (stored, self._stored())
        )

    def _compression(self, step: int) -> Array:
        """Compressions now; the elastic march does not keep them."""
        scaled = self.scaled
        if scaled.n_arms or scaled.table[L_DECAY, 0] > 0:
            return np.asarray(self.s[0])
        return np.asarray(np.maximum(scaled.z[step % scaled.steps] - scaled.gap, 0))

    def _stored(self) -> float:
        """Elastic and kinetic energy of springs, body and system spring, tangential unit of energy; u_z part
        included.
        """
        scaled, (y, y_old, y_older) = self.scaled, self.history[:3]
        u_dot = self.v + (1.5 * y - 2 * y_old + 0.5 * y_older) / scaled.h
        ratios = scaled.table[L_RATIO]
        springs = 0.5 * float(ratios @ (self.e**2 @ scaled.w))
        normal = 0.5 * float(scaled.w @ self._compression(0) ** 2 + ratios[1:] @ (self.s[1:] ** 2 @ scaled.w))
        ratio = scaled.stiffness_z * scaled.length_z**2 / (scaled.stiffness_x * scaled.length_x**2)
        return float(springs + normal * ratio + 0.5 * scaled.K * y**2 + 0.5 * scaled.M * u_dot**2)


def _parts(total: int, most: int) -> list[int]:
    """Cut a number of steps into parts of at most `most`."""
    return [min(most, total - start) for start in range(0, total, most)]
