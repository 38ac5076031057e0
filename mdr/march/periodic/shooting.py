"""The periodic state of body and springs by shooting: solved for instead of awaited.

One period of the march is a map x -> P(x) of the state of body and springs; a periodic motion is its fixed point.
Friction under a given normal motion is monotone, so two motions never move apart (validation/uniqueness.py): P is
non-expansive in the norm of energy. Three things follow.

* Where any motion stays bounded there is a fixed point (Browder 1965), and the COF of all of them is one.
* No Floquet multiplier, an eigenvalue of P', lies outside the unit circle: a fixed point need not be tested for
  stability before it is an answer. What the multipliers tell is how far from it a small change over a period can be.
* Along a march the change over a period never grows. So a step of a search that makes it smaller is a gain for good.

A body with little damping rings for hundreds of periods, or beats without end, while its springs forget their past in
one or a few: what has to be found lies close to a plane. Anderson's method (anderson.py) takes of the last few periods
the combination whose change over a period is least, and marches on from there. Where instants of stick make it go
astray, a Newton-Picard method follows (Lust, Roose, Spence & Champneys 1998): the body is pushed in its position and in
its velocity, and the combination of the two displacements that leaves the least change is added, as much of it as makes
the change smaller; the springs follow by marching.

A search stops when the change in a period is so small that the error of the COF is below the tolerance. This limit
follows from the gain as known before. If the gain turns out to be larger, the search goes on to a smaller change.

The search is compiled, and goes from one phase to the next (`shoot`), so that the clock can be looked at between them.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mdr.march.dynamics.period_sums import late_share, least_slip, mean_and_swing
from mdr.march.dynamics.state import UNKNOWN
from mdr.march.dynamics.stepper import Periods
from mdr.march.periodic.anderson import (
    BEST,
    CHANGES,
    COUNTS,
    ENDED,
    ENOUGH,
    FOUND,
    IMAGE,
    IMAGES,
    KEPT,
    KNOWN,
    LAST_PERIOD,
    LEAST,
    MARCHED,
    MISSED,
    MOST,
    MOVES,
    OTHER,
    PERIODS,
    PHASE,
    PLAIN,
    SINCE,
    SOUGHT,
    START,
    STATES,
    TURN,
    Search,
    begin,
    seek,
)
from mdr.march.periodic.period_map import CREEP, PeriodMap, marched
from mdr.spring.copies import copy
from mdr.spring.path import FAST, OWN
from mdr.tools.anderson import shares
from mdr.tools.arrays import EXACT, Array
from mdr.tools.jit import compiled, inner
from mdr.tools.linear_maps import made_orthogonal, spectral_radius

FULL = EXACT  #: what is missing in the COF in full slip
SHARE = 20.0  #: safety: a search first stops at a change of tolerance/(SHARE gain); COFs are off by twice the distance
SOLVED_TOLERANCE = 1e-5  #: of cof/mu_0, bound on the error of a periodic state that was solved for; cof_error has it
CLOSE = 1e-10  #: change over a period, over the size of the state, that any answer may have
CLOSEST = 1e-13  #: the same that can be reached: some roundings
PUSH = 1e-4  #: displacement of the body, over the size of the state
FARTHEST = 0.1  #: the same, where the motion has kinks
BETWEEN = 2  #: periods between a push and the measurement, in which springs fall in with the body
DIED_OUT = 1e-5  #: of a push: what is left of it is not told from what a step of the march leaves unsolved
EXPANDS = 1.01  #: multiplier from which on a map is not one of friction
STABLE = 0.9999  #: largest multiplier told from one, of motions that slow arms make hard to tell apart
AGES = 1e6  #: periods that full slip must last to count as periodic
TURNS = 30  #: corrections of the Newton-Picard method
SHORTEST = 1 / 64  #: share of a correction that is tried before the march goes on without it
LOST = 5  #: corrections in a row of which no share was a gain, after which it ends

# phases: a start, Anderson's method, Newton-Picard, what the best state is worth, the end
BEGIN, SEEK, CORRECT, WEIGH, DONE = range(5)
# numbers of a search: bound on the distance from the periodic state over the change in a period, if it is known
# beforehand; the change at which Anderson's method ends; the next push; whether a state was found, and of that its
# parts in Found
GAIN, ENDS, NEXT_PUSH, IS_FOUND, COF, COF_Y, SWING, SLIP, GAINED, SPREAD, LATE, IS_CLOSE, NUMBERS = range(13)

_inner = inner(error_model="numpy", fastmath=FAST, **OWN)


class SlowMotions(NamedTuple):
    """What is known of the slow motions about a periodic state: k displacements that outlive a few periods, in all
    parts (k, n_x) of the state, and what they are a period later.
    """

    before: Array
    after: Array


class Found(NamedTuple):
    """A periodic state that was found."""

    state: Array  #: (n_x,) at the end of the period that is told
    period: Periods
    least_slip: float  #: in that period, the way of the pull, of springs that slip all the time
    gain: float  #: bound on the distance from the exact one, over the change in a period
    spread: float  #: bound on the error of the COF over mu_0
    late: bool  #: whether springs are late
    is_close: bool  #: whether it is as close as is asked for


@dataclass(frozen=True, eq=False)
class Shooting:
    """A search for the periodic state of a march."""

    of: PeriodMap
    search: Search

    @classmethod
    def begun(
        cls,
        of: PeriodMap,
        x: Array,
        n_trace: int,
        memory: int,
        plain: int,
        most: int,
        gain: float | None = None,
        motions: SlowMotions | None = None,
    ) -> Shooting:
        """One from the state x on.

        n_trace: size of a flat trace. memory: periods that Anderson's method combines; plain: periods before the first
        combination, while springs find their modes; most: periods after which it gives up. gain: bound on the distance
        from the periodic state over the change in a period, if it is known beforehand: what is measured depends on how
        close a state has come. motions: the slow ones about it, where they are known.
        """
        counts, told, k = np.zeros(COUNTS, dtype=np.int64), np.zeros(NUMBERS), len(of.pushes)
        counts[PLAIN], counts[MOST], counts[KNOWN] = plain, most, motions is not None
        told[GAIN] = np.nan if gain is None else gain
        told[ENDS] = of.tolerance / (SHARE * (gain or max(1.0, of.slowest)))
        slow = np.empty((2, k, x.size)) if motions is None else np.array(motions)
        search = Search(
            np.zeros((STATES, x.size)),
            np.empty((2, memory - 1, x.size)),
            counts,
            np.zeros(CHANGES),
            np.zeros((2, n_trace)),
            slow,
            np.ones(k),
            told,
        )
        search.states[BEST] = x
        counts[PHASE] = BEGIN
        return cls(of, search)

    def go_on(self, n_periods: int) -> int:
        """Go on for about so many periods; how many it were."""
        counts = self.search.counts
        before = int(counts[MARCHED])
        shoot(self.of[:-3], *self.of[-3:], tuple(self.search), n_periods)
        return int(counts[MARCHED]) - before

    @property
    def ended(self) -> bool:
        """Whether what is found is close enough, or comes no closer."""
        return bool(self.search.counts[PHASE] == DONE)

    @property
    def motions(self) -> SlowMotions | None:
        """The slow motions about the state, where they are known."""
        return SlowMotions(*self.search.slow) if self.search.counts[KNOWN] else None

    @property
    def found(self) -> Found | None:
        """The periodic state, close enough or the best that there is; None where none was found."""
        told, state = self.search.told.tolist(), self.search.states[FOUND]
        if not told[IS_FOUND]:
            return None
        period = Periods(*(self.search.told[at : at + 1].copy() for at in (COF, SWING, COF_Y)))
        return Found(state, period, told[SLIP], told[GAINED], told[SPREAD], bool(told[LATE]), bool(told[IS_CLOSE]))


@compiled(nogil=True, error_model="numpy", fastmath=FAST)
def shoot(contact, v, tolerance, kernel, search, n_periods):
    """Go on with a search for ever smaller changes, for about so many periods.

    contact: the first parts of the PeriodMap; search: Search. Plain tuples: numba is slow to tell the types of others.
    """
    of, search = PeriodMap(*contact, v, tolerance, kernel), Search(*search)  # type: ignore[call-arg]
    counts = search.counts
    until = counts[MARCHED] + n_periods
    while counts[PHASE] != DONE and counts[MARCHED] < until:
        if counts[PHASE] == BEGIN:
            start(of, search)
        elif counts[PHASE] == SEEK:
            seek(of, search, until - counts[MARCHED])
            if counts[ENDED]:
                sought(of, search)
        elif counts[PHASE] == CORRECT:
            correct(of, search)
        else:
            weigh(of, search)


@_inner
def start(of, search):
    """Seek from the best state on; what is known of slow motions is combined from the first period on."""
    counts, past = search.counts, search.past
    begin(search, search.states[BEST], max(search.told[ENDS], CLOSEST))
    if counts[KNOWN]:
        k = min(search.slow.shape[1], past.shape[1])
        for j in range(k):
            for i in range(past.shape[2]):
                before, after = search.slow[0, j, i], search.slow[1, j, i]
                past[IMAGES, j, i], past[MOVES, j, i] = after, of.roots[i] * (after - before)
        counts[KEPT] = k
    counts[PHASE] = SEEK


@_inner
def sought(of, search):
    """What comes after Anderson's method."""
    counts, changes, told = search.counts, search.changes, search.told
    counts[PHASE] = DONE
    if not np.isfinite(changes[LEAST]):
        return
    copy(search.states[BEST], search.states[SOUGHT])
    if is_last(counts):
        slip = slip_for_good(of, search)
        if slip > 0.0:
            tell(of, search, search.traces[LAST_PERIOD])
            copy(search.states[BEST], search.states[FOUND])
            told[SLIP], told[GAINED], told[SPREAD], told[LATE], told[IS_CLOSE] = slip, np.inf, 0.0, 0.0, 1.0
            return
    counts[PHASE], counts[TURN], counts[MISSED], told[NEXT_PUSH] = WEIGH, 0, 0, PUSH
    if changes[LEAST] > changes[ENOUGH]:
        counts[PHASE], counts[SINCE] = CORRECT, -1  # the last period is not that of the best state any more
        search.signs[:] = 1.0


@_inner
def is_last(counts):
    """Whether the last period of Anderson's method is that of the best state."""
    return counts[SINCE] == counts[PERIODS] - 1


@_inner
def weigh(of, search):
    """Tell what the best state is worth, and whether to look for one with a smaller change."""
    states, counts, changes, told = search.states, search.counts, search.changes, search.told
    gain, near = told[GAIN], changes[LEAST] <= max(changes[ENOUGH], CLOSE)
    if near and np.isnan(gain):
        gain = measured(of, search)
    if near and not np.isnan(gain):
        weighed(of, search, gain)
        counts[PHASE] = DONE if told[IS_CLOSE] or told[ENDS] <= CLOSEST else BEGIN
        told[ENDS] *= min(0.01, of.tolerance / (SHARE * told[SPREAD] + 1e-300))
        return
    counts[PHASE] = DONE if told[ENDS] <= CLOSE else BEGIN
    copy(states[SOUGHT], states[BEST])
    told[ENDS] = CLOSE


@_inner
def length(of, x):
    """Root of the energy of a state."""
    square = 0.0
    for i in range(x.size):
        square += (of.roots[i] * x[i]) ** 2
    return np.sqrt(square)


@_inner
def distance(of, x, y):
    """Root of the energy of a difference."""
    square = 0.0
    for i in range(x.size):
        square += (of.roots[i] * (x[i] - y[i])) ** 2
    return np.sqrt(square)


@_inner
def slip_for_good(of, search):
    """The least slip velocity of the best state if it is one of full slip that is more than AGES times what changes
    over a period; else zero. It need not be close to the exact periodic state: the COF is the same.

    Where a free oscillation is a whole multiple of the drive, full slip has not one periodic motion but many.
    """
    least = 0.0 if of.has_face else least_slip(search.traces[LAST_PERIOD], of.block, of.mean_limit)
    drift = search.changes[LEAST] * length(of, search.states[BEST]) / np.sqrt(of.inertia)
    return least if AGES * drift < least < np.inf else 0.0


@_inner
def tell(of, search, trace):
    """Leave COF and swing of a period."""
    told = search.told
    along, across, told[SWING] = mean_and_swing(trace, of.block)
    told[COF], told[COF_Y], told[IS_FOUND] = along / of.mean_limit, across / of.mean_limit, 1.0


@_inner
def weighed(of, search, gain):
    """Leave the COF of the best state, and how far it may be from that of the exact one."""
    states, changes, told = search.states, search.changes, search.told
    before, after, trace = states[START], states[BEST], search.traces[LAST_PERIOD]
    if not is_last(search.counts):
        before, after, trace = states[BEST].copy(), states[IMAGE], search.traces[OTHER]
        marched(of, before, after, trace)
        search.counts[MARCHED] += 1
    tell(of, search, trace)
    # all springs together have the stiffness one: the mean force is off by at most twice the distance (SHARE)
    off = (changes[LEAST] + 1e-15) * gain  # 1e-15: rounding
    spread = 2.0 * off * length(of, states[BEST]) / of.mean_limit
    pull, late = 2.0 * np.pi * of.v, 0.0
    if of.v > 0.0:
        late = late_share(before, after, of.block, of.bears, pull) / of.mean_limit
        late = UNKNOWN if pull <= of.hidden_pull else late
    settled = spread <= min(of.tolerance, SOLVED_TOLERANCE) and late <= of.tolerance
    nearly_full = FULL < 1.0 - told[COF] < SOLVED_TOLERANCE  # it has to be told from nothing
    told[SLIP] = 0.0 if of.has_face else least_slip(trace, of.block, of.mean_limit)
    told[GAINED], told[SPREAD], told[LATE] = gain, spread, 1.0 if late > of.tolerance else 0.0
    told[IS_CLOSE] = 1.0 if settled and (told[ENDS] <= CLOSE or not nearly_full) else 0.0
    copy(after, states[FOUND])


@_inner
def period(of, search, x, image):
    """The image of a state, counted. Its trace does not matter."""
    marched(of, x, image, search.traces[OTHER])
    search.counts[MARCHED] += 1


@_inner
def pushed(of, search, push, pairs):
    """Push the best state by a share of its size, in the directions of its signs. pairs (2, 1 + k, n_x): what it comes
    to after some periods, and a period later, are filled in; after it, what its pushes have become then, as
    displacements from there. Returns the length of the pushes.
    """
    best, k = search.states[BEST], len(of.pushes)
    size = push * length(of, best)
    if size == 0.0:
        size = push  # of a state that is nothing, as in flight, the unit
    for j in range(k + 1):
        copy(best, pairs[0, j])
        if j > 0:
            for i in range(best.size):
                pairs[0, j, i] += size * search.signs[j - 1] * of.pushes[j - 1, i]
        for _ in range(BETWEEN):
            period(of, search, pairs[0, j], pairs[1, j])
            copy(pairs[1, j], pairs[0, j])
        copy(pairs[0, j], search.states[IMAGE])
        period(of, search, search.states[IMAGE], pairs[1, j])
    for j in range(1, k + 1):
        for part in range(2):
            for i in range(best.size):
                pairs[part, j, i] -= pairs[part, 0, i]
    return size


@_inner
def measured(of, search):
    """Bound on the distance to the fixed point over the change over a period, of a state that returns so closely that
    its own change is small beside a push, and blurs what is seen of it; NaN for a map that expands.
    """
    k, n_x = of.pushes.shape
    pairs, lasts = np.empty((2, 1 + k, n_x)), 0
    search.signs[:] = 1.0
    size = pushed(of, search, PUSH, pairs)
    ways, images, known = np.empty((k, n_x)), np.empty((k, n_x)), True
    for j in range(k):
        for i in range(n_x):
            ways[j, i] = pairs[0, 1 + j, i] * of.roots[i] / size
            images[j, i] = pairs[1, 1 + j, i] * of.roots[i] / size
            known = known and np.isfinite(ways[j, i]) and np.isfinite(images[j, i])
    if not known:
        return np.nan
    lengths = made_orthogonal(ways, images)  # longest first
    for j in range(k):
        if lengths[j] > DIED_OUT:
            lasts = j + 1
            for i in range(n_x):
                ways[j, i] /= lengths[j]
                images[j, i] /= lengths[j]
    onto, missed = np.zeros((lasts, lasts)), 0.0
    for j in range(lasts):
        left = images[j].copy()
        for m in range(lasts):
            for i in range(n_x):
                onto[m, j] += ways[m, i] * images[j, i]
            for i in range(n_x):
                left[i] -= onto[m, j] * ways[m, i]
        missed = max(missed, np.sqrt((left * left).sum()))
    largest = spectral_radius(onto)
    if largest > EXPANDS:
        return np.nan
    for j in range(k):
        copy(pairs[0, 1 + j], search.slow[0, j])
        copy(pairs[1, 1 + j], search.slow[1, j])
    search.counts[KNOWN] = 1
    if lasts == 0:
        return 1.0 / (1.0 - lengths[0] ** (1.0 / BETWEEN))
    if of.n_slow > 0 and largest < STABLE:
        return 1.0 / (1.0 - largest)
    short = -onto
    for j in range(lasts):
        short[j, j] += 1.0
    least = made_orthogonal(short, short.copy())[lasts - 1]
    along = 1.0 / max(least - missed - search.changes[LEAST] / PUSH, 1e-300)
    if of.n_slow == 0:
        return along
    creep = -1.0 / np.expm1(-1.0 / (CREEP * of.slowest))  # few arms are told apart in so short a time
    return creep if of.stable else max(along, creep)


@_inner
def correct(of, search):
    """A Newton-Picard correction of the best state along the pushed motions, for one of less change over a period.

    The map has kinks, where stick begins. A correction that has to be cut short meets one; so the next pushes go the
    same way and as far, to see the slope on both sides of it.
    """
    states, counts, changes, told = search.states, search.counts, search.changes, search.told
    if not changes[LEAST] > changes[ENOUGH] or counts[MISSED] == LOST or counts[TURN] == TURNS:
        counts[PHASE] = WEIGH
        return
    counts[TURN] += 1
    k, n_x = of.pushes.shape
    pairs, turns, move = np.empty((2, 1 + k, n_x)), np.empty((k, n_x)), np.empty(n_x)
    pushed(of, search, told[NEXT_PUSH], pairs)
    image, size, known = pairs[1, 0], length(of, pairs[1, 0]) + 1e-300, True
    change = distance(of, image, pairs[0, 0]) / size
    for i in range(n_x):
        move[i] = of.roots[i] * (image[i] - pairs[0, 0, i])
        for j in range(k):
            turns[j, i] = of.roots[i] * (pairs[1, 1 + j, i] - pairs[0, 1 + j, i])
            known = known and np.isfinite(turns[j, i])
    copy(image, states[BEST])
    changes[LEAST] = change
    if not known:
        counts[PHASE] = WEIGH
        return
    share, step = shares(turns, move, 1e-12), np.zeros(n_x)
    for j in range(k):
        if share[j] > 0.0:
            search.signs[j] = -search.signs[j]
        for i in range(n_x):
            step[i] -= share[j] * pairs[1, 1 + j, i]
    # if no part is a gain, what these pushes saw was not of here
    part, counts[MISSED], told[NEXT_PUSH], tried, reached = (
        1.0,
        counts[MISSED] + 1,
        0.1 * told[NEXT_PUSH],
        np.empty(n_x),
        states[IMAGE],
    )
    while part >= SHORTEST:
        for i in range(n_x):
            tried[i] = image[i] + part * step[i]
        inside = tried.copy()
        period(of, search, inside, reached)
        less = distance(of, reached, tried) / size
        if less < (1.0 - 0.1 * part) * change:
            push = part * length(of, step) / size
            told[NEXT_PUSH] = min(max(push, 1e-9), PUSH if part == 1.0 else FARTHEST)
            copy(reached, states[BEST])
            changes[LEAST], counts[MISSED] = less, 0
            break
        part *= 0.5
