"""The search for the periodic orbit of a contact by shooting: which states it begins from, and how far it may be off.

What fixed_point.py solves for any map that does not expand is put here to the map of one period of the march, in
the norm of energy of springs, system spring and mass.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mdr.march.dynamics.body import N_BODY, RATE, Body, Y
from mdr.march.dynamics.dimensionless import ScaledContact
from mdr.march.dynamics.stepper import AT_ONCE, UNKNOWN, MarchState, PeriodRecord, Periods, Stepper
from mdr.march.periodic import anderson, fixed_point
from mdr.march.periodic.settling import LATE, Settling
from mdr.march.periodic.solver import OutOfTime, iterate
from mdr.spring.energies import LEAST_SLIP, STICK_IMPULSE
from mdr.tools.arrays import EXACT, Array
from mdr.tools.progress import time_is_over

FULL = EXACT  #: what is missing in the COF in full slip
SHARE = 20.0  #: safety: a search first stops at a change of tolerance/(SHARE gain); COFs are off by twice the distance
AGES = 1e6  #: periods that full slip must last to count as periodic
SOLVED_TOLERANCE = 1e-5  #: of cof/mu_0, bound on the error of a periodic state that was solved for; cof_error has it
FORGOTTEN = 0.3  #: relaxation time over 1/omega of an arm that keeps 1e-9 of itself over a period
SLOW_PULL = 100.0  #: relaxation time of a pull, in periods, from which on it is a slow time as those of a material are
SAME_GAIN = 0.25  #: gain times h², up to which it is known at another resolution too


@dataclass(frozen=True, eq=False)
class Orbit:
    """A periodic state that was found."""

    state: MarchState  #: at the end of the period that `period` tells of
    period: Periods
    settling: Settling
    seen: PeriodRecord | None = None  #: a close look at that period, where one was taken
    motions: fixed_point.SlowMotions | None = None  #: the slow ones about it, where they are known


def search(
    stepper: Stepper,
    starts: tuple[MarchState, ...],
    gain: float | None = None,
    near: bool = False,
    motions: fixed_point.SlowMotions | None = None,
) -> Orbit | None:
    """The periodic state that a march would end in, from the first of the starts that leads to one; None else.

    A search stops when the change in a period is so small that the error of the COF is below the tolerance. This limit
    follows from the gain as known before. If the gain turns out to be larger, the search goes on to a smaller change.

    gain: bound on the distance from the periodic state, divided by the change in one period, where it is known. near:
    whether the starts are periodic states themselves, found with other steps, springs or velocity. motions: the slow
    motions about them.
    """
    scaled, norm, n_before = stepper.scaled, EnergyNorm(stepper.scaled), stepper.n_periods
    slow = tuple(theta / (2 * np.pi) for theta in scaled.rheology.theta if theta > FORGOTTEN)
    if 2 * np.pi < scaled.law.T:  # a dashpot that a period does not relax
        slow += (scaled.law.T / (2 * np.pi),)
    if slow and scaled.body.C:
        slow += (scaled.body.M / (np.pi * scaled.body.C) / fixed_point.CREEP,)
    if scaled.body.pull_time > SLOW_PULL:
        slow += (2 * scaled.body.pull_time / fixed_point.CREEP,)  # a material may be slower than is seen; this is known
    how = fixed_point.Options(
        slow, bool(slow) and (scaled.body.rigid or scaled.body.C > 0), plain=0 if near else fixed_point.PLAIN
    )
    first = stepper.tolerance / (SHARE * (gain or max((1.0, *slow))))
    for start in starts:
        x, orbit, period, close = start.x, None, _Period(stepper, start), first
        while True:
            how, arrived = replace(how, close=max(close, fixed_point.CLOSEST)), None
            try:
                arrived = _by_anderson(stepper, start.with_vector(x), norm, how, motions)
                if arrived is not None and (full := _full_slip(stepper, start, arrived, norm)) is not None:
                    return full
                found = fixed_point.find(period, arrived, norm.of, norm.pushes, how, gain)
            except OutOfTime:
                arrived = found = None
            if found is None:
                if arrived is None or close <= fixed_point.CLOSE:
                    break
                x, close = arrived.x, fixed_point.CLOSE
                continue
            motions = found.motions or motions
            orbit = replace(_repeated(stepper, start.with_vector(found.x), found, norm), motions=motions)
            spread, x = orbit.settling.spread, found.x
            if (
                spread <= stepper.tolerance
                and orbit.settling.settled
                and (close <= fixed_point.CLOSE or not _nearly_full(orbit.settling.mean))
            ):
                return orbit
            if close <= fixed_point.CLOSEST:
                break
            close *= min(0.01, stepper.tolerance / (SHARE * spread + 1e-300))
        if orbit is not None and (slow or orbit.settling.settled):  # waiting for slow motions takes far longer
            return orbit
    stepper.n_periods = n_before
    return None


class _Period:
    """The map of one period of the march; it stops where the time limit of the caller is over."""

    def __init__(self, stepper: Stepper, like: MarchState) -> None:
        self.stepper, self.like = stepper, like

    def __call__(self, x: Array) -> Array:
        if time_is_over():
            raise OutOfTime
        return self.stepper.period(self.stepper.within_friction(self.like.with_vector(x))).x


class _Anderson:
    """Anderson's method from a state on: in each step as many periods as are marched at once."""

    def __init__(self, stepper: Stepper, start: MarchState, norm: EnergyNorm, most: int) -> None:
        self.stepper, self.start, self.roots, self.left = stepper, start, norm.roots, most
        self.at_once = max(1, AT_ONCE // stepper.scaled.drive.steps)
        self.most, self.has_ended, self.trace = -(-most // self.at_once), False, stepper.scaled.trace()

    def ended(self, at: anderson.Search) -> bool:
        return self.has_ended

    def step(self, at: anderson.Search) -> anderson.Search:
        """The same search, which goes on in place."""
        image, n_before = self.start.copy(), int(at.counts[anderson.PERIODS])
        state, n = (image.x, image.e, image.s, image.body), min(self.left, self.at_once)
        ended = anderson.search(at, *state, self.start.s, self.roots, *self.stepper.parts, n, self.trace)
        self.has_ended = bool(ended)
        self.left -= self.at_once
        self.stepper.count(int(at.counts[anderson.PERIODS]) - n_before)
        return at


def _by_anderson(
    stepper: Stepper,
    start: MarchState,
    norm: EnergyNorm,
    how: fixed_point.Options,
    motions: fixed_point.SlowMotions | None,
) -> fixed_point.Iterate | None:
    """The state of least change that Anderson's method meets; None where a state leaves the range of floats."""
    solver = _Anderson(stepper, start, norm, how.most)
    at = iterate(solver, how.by_anderson(start.x, norm.of, motions))
    change = float(at.changes[anderson.BEST])
    if not np.isfinite(change):
        return None
    is_last = at.counts[anderson.SINCE] == at.counts[anderson.PERIODS] - 1
    known = (stepper.periods_of(solver.trace), at.start.copy()) if is_last else ()
    return fixed_point.Iterate(at.best, change, *known)


def _nearly_full(cof: float) -> bool:
    """Whether so little is missing in the COF that a search may have to tell it from nothing."""
    return FULL < 1 - cof < SOLVED_TOLERANCE


def search_from_full_slip(stepper: Stepper) -> Orbit | None:
    """The periodic state from that of full slip, on a driven resonance from that of the body as stick limits it."""
    driven = stepper.resonant()
    return search(stepper, (*(() if driven is None else (driven,)), stepper.full_slip()))


def at_other_resolution(
    state: MarchState, motions: fixed_point.SlowMotions | None, of: ScaledContact, on: ScaledContact
) -> tuple[MarchState, fixed_point.SlowMotions | None]:
    """A state of a march with other springs or steps, and the slow motions about it, on those of this one."""
    parts = [state.x[None]] if motions is None else [state.x[None], motions.before, motions.after]
    xs = _on_other_springs(np.concatenate(parts), of, on)
    if motions is not None:
        motions = fixed_point.SlowMotions(*np.split(xs[1:], 2))
    return MarchState(xs[0], on.normal.s.copy()), motions


def _on_other_springs(xs: Array, of: ScaledContact, on: ScaledContact) -> Array:
    """State vectors (k, n_x) of other springs on the springs of this march, linear between those."""
    if of.springs.gap is on.springs.gap or np.array_equal(of.springs.gap, on.springs.gap):
        return xs
    order = np.argsort(of.springs.gap, kind="stable")
    place = np.interp(on.springs.gap, of.springs.gap[order], np.arange(order.size))
    before = np.minimum(place.astype(int), order.size - 2)  # -1 of a single spring is itself
    vectors = xs if on.ways == 1 else xs.view(complex)
    e = vectors[:, :-N_BODY].reshape(len(xs), -1, order.size)[:, :, order]
    e = e[..., before] + (place - before) * (e[..., before + 1] - e[..., before])
    return np.concatenate([e.reshape(len(xs), -1), vectors[:, -N_BODY:]], axis=1).view(float)


def gain_at_other_resolution(gain: float | None, one: ScaledContact, other: ScaledContact) -> float | None:
    """The gain of a march with other springs or steps, whose multipliers differ by h²; None where that may be much."""
    h = max(one.drive.h, other.drive.h)
    return gain / (1 - gain * h**2) if gain is not None and gain * h**2 < SAME_GAIN else None


def _full_slip(stepper: Stepper, like: MarchState, near: fixed_point.Iterate, norm: EnergyNorm) -> Orbit | None:
    """The orbit of a state in full slip that is far from stick; None of any other state.

    Its least slip velocity is more than AGES times what changes over a period. So it need not be close to the exact
    periodic state: the COF is the same, and the least slip velocity is known within that change.

    Where a free oscillation is a whole multiple of the drive, full slip has not one periodic motion but many.
    """
    if near.period is None or abs(1 - near.period.cof[-1]) > FULL:
        return None
    scaled = stepper.scaled
    state, record = stepper.observe(stepper.within_friction(like.with_vector(near.x)), keep=False)
    sums = record.seen.sums
    change = near.change * float(np.linalg.norm(norm.of(near.x)))
    body = scaled.body
    drift = change / np.sqrt(body.M or (1.0 if body.rigid else body.K))  # under a rigid pull that of the springs
    if sums[STICK_IMPULSE] > 0 or not AGES * drift < sums[LEAST_SLIP] < np.inf:
        return None
    cof = float(record.period.cof[-1])
    return Orbit(state, record.period, Settling(cof, 0.0, True, "periodic", gain=np.inf), record)


def _repeated(stepper: Stepper, state: MarchState, found: fixed_point.FixedPoint, norm: EnergyNorm) -> Orbit:
    """The COF of the periodic state, and how far it may be from that of the exact one."""
    # all springs together have the stiffness one: the mean force is off by at most twice the distance (SHARE)
    spread = 2 * found.distance * float(np.linalg.norm(norm.of(found.x))) / stepper.mean_F_z
    period, before = found.end.period, found.end.before  # began as far from the exact one as `spread` says
    if period is None or before is None:
        begin = stepper.within_friction(state)
        state, period = stepper.advance(begin, 1)
    else:
        begin = state.with_vector(before)
    cof, cof_y = float(period.cof[-1]), float(period.cof_y[-1])
    late = stepper.v > 0 and stepper.late(begin, state, 1) > stepper.tolerance
    if spread <= SOLVED_TOLERANCE and not late:
        return Orbit(state, period, Settling(cof, spread, True, "periodic", found.gain, across=cof_y))
    why = LATE if late else "a periodic state was found, but not how far it may be from the exact one"
    spread = UNKNOWN if late else spread
    return Orbit(state, period, Settling(cof, min(spread, UNKNOWN), False, "unsettled", found.gain, why, across=cof_y))


class EnergyNorm:
    """Length of a state vector: the root of the energy of springs, arms, system spring and mass."""

    def __init__(self, scaled: ScaledContact) -> None:
        self.scaled = scaled
        moduli = np.concatenate([[1.0], scaled.rheology.rho])
        of_springs = np.sqrt(np.outer(moduli, scaled.springs.w)).ravel()
        of_bodies = np.zeros((N_BODY, scaled.ways))
        for way, body in self.bodies:
            of_bodies[[Y, RATE], way] = np.sqrt([body.K, body.M])
        # of the stiffness of every spring, of every arm of it and of the pull; of a vector for each of its parts
        self.roots = np.concatenate([np.repeat(of_springs, scaled.ways), of_bodies.ravel()])

    @property
    def bodies(self) -> list[tuple[int, Body]]:
        """Directions, 0 along the pull and 1 across it, and bodies, of those that are not rigid."""
        both = enumerate((self.scaled.body, self.scaled.body_across)[: self.scaled.ways])
        return [(way, body) for way, body in both if not body.rigid]

    def of(self, x: Array) -> Array:
        """State vectors (n_x,) or (k, n_x), measured: vectors of the same shape whose squares are energies."""
        return np.asarray(x * self.roots)

    def pushes(self) -> tuple[Array, ...]:
        """Displacements of unit length: of each arm of all springs that outlasts a period, and of the position and
        velocity of the body; of the springs themselves where there is neither.
        """
        scaled, n = self.scaled, self.scaled.springs.gap.size
        n_x, parts = self.roots.size, 1 + len(scaled.rheology.rho)
        vectors, moved = np.arange(n_x).reshape(-1, scaled.ways), []
        for way, body in self.bodies:
            moved += [vectors[parts * n + part, way] for part in ((Y, RATE) if body.M else (Y,))]
        rows = [1 + j for j, theta in enumerate(scaled.rheology.theta) if theta > FORGOTTEN]
        if not rows and not self.bodies:
            rows = [0]
        moved += [vectors[j * n : (j + 1) * n, way] for way in range(scaled.ways) for j in rows]
        pushes = np.zeros((len(moved), n_x))
        for push, at in zip(pushes, moved, strict=True):
            push[at] = 1 / np.linalg.norm(np.atleast_1d(self.roots[at]))
        return tuple(pushes)
