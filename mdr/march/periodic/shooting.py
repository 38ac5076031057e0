"""The periodic state of body and springs by shooting: solved for instead of awaited; of many contacts at once.

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
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mdr.march.dynamics.marches import Marches, Which
from mdr.march.dynamics.state import COF, LEAST_SLIP, TOLD
from mdr.march.periodic.anderson import BEST, ENDED, ENOUGH, IMAGES, KEPT, LEAST, MOVES, PERIODS, SINCE, START, Search
from mdr.tools.arrays import EXACT, Array
from mdr.tools.progress import time_is_over

FULL = EXACT  #: what is missing in the COF in full slip
SHARE = 20.0  #: safety: a search first stops at a change of tolerance/(SHARE gain); COFs are off by twice the distance
SOLVED_TOLERANCE = 1e-5  #: of cof/mu_0, bound on the error of a periodic state that was solved for; cof_error has it
CLOSE = 1e-10  #: change over a period, over the size of the state, that any answer may have
CLOSEST = 1e-13  #: the same that can be reached: some roundings
PUSH = 1e-4  #: displacement of the body, over the size of the state
FARTHEST = 0.1  #: the same, where the motion has kinks
BETWEEN = 2  #: periods between a push and the measurement, in which springs fall in with the body
FORGOTTEN = 1e-5  #: of a push: what is left of it is not told from what a step of the march leaves unsolved
CREEP = 10.0  #: what outlives the slowest time of a material at most, as strain outlives stress
EXPANDS = 1.01  #: multiplier from which on a map is not one of friction
STABLE = 0.9999  #: largest multiplier told from one, of motions that slow arms make hard to tell apart
AGES = 1e6  #: periods that full slip must last to count as periodic
TURNS = 30  #: corrections of the Newton-Picard method
SHORTEST = 1 / 64  #: share of a correction that is tried before the march goes on without it
LOST = 5  #: corrections in a row of which no share was a gain, after which it ends


class Shots:
    """Searches for the periodic states of contacts that are marched together (C of them, of n_x numbers each)."""

    def __init__(self, marches: Marches, tolerance: Array) -> None:
        n, k, n_x = marches.pushes.shape
        self.marches, self.tolerance = marches, tolerance  #: (C,) of cof/mu_0
        #: (C,) bound on the distance from the periodic state over the change in a period
        self.gain = np.full(n, np.nan)
        #: (C,) whether the slow motions about it are known, displacements (C, k, n_x) that outlive a few periods, and
        #: what they are a period later
        self.has_motions = np.zeros(n, dtype=bool)
        self.before, self.after = np.empty((2, n, k, n_x))
        #: (C, n_x) the periodic state, at the begin and the end of the period that is told, (C, TOLD) of state.py
        self.begins, self.state = np.empty((2, n, n_x))
        self.told = np.full((n, TOLD), np.nan)
        self.spread = np.full(n, np.inf)  #: (C,) bound on the error of the COF over mu_0
        self.late, self.slips = np.zeros((2, n), dtype=bool)  #: (C,) whether springs are; whether it is full slip
        self.found, self.has_state = np.zeros((2, n), dtype=bool)  #: (C,) whether one is close enough; whether any is
        self.n_periods = np.zeros(n, dtype=np.int64)  #: (C,) marched

    def shoot(self, x: Array, plain: int, memory: int, most: int, at_once: int) -> None:
        """Search from these states (C, n_x) on. plain: periods before the first combination; memory, most: periods that
        are combined, and after which Anderson's method gives up; at_once: periods between two looks at the clock.
        """
        marches = self.marches
        n, n_x = x.shape
        self.search = search = Search.of(n, n_x, memory, plain, most)
        first = self.tolerance / (SHARE * np.where(np.isnan(self.gain), np.maximum(1.0, marches.slow), self.gain))
        which = self._begin(np.arange(n), x, first)
        while which.size and not time_is_over():
            periods = search.counts[which, PERIODS]
            search.go_on(marches, which, at_once)
            self.n_periods[which] += search.counts[which, PERIODS] - periods
            ready = search.counts[which, ENDED] == 1
            goes_on, ended = which[~ready], which[ready & np.isfinite(search.changes[which, LEAST])]
            which = np.concatenate([goes_on, self._judged(ended)])

    def _begin(self, which: Which, x: Array, close: Array) -> Which:
        """Seek from states (m, n_x) on; what is known of slow motions is combined from the first period on."""
        search, marches = self.search, self.marches
        search.begin(which, x, np.maximum(close, CLOSEST))
        known = which[self.has_motions[which]]
        if known.size:
            k = min(self.after.shape[1], search.past.shape[2])
            before, after = self.before[known, :k], self.after[known, :k]
            search.past[known, IMAGES, :k], search.counts[known, KEPT] = after, k
            search.past[known, MOVES, :k] = marches.roots[known, None] * (after - before)
        return which

    def _judged(self, which: Which) -> Which:
        """What Anderson's method has ended with, of these contacts; those of them that go on."""
        search, (counts, changes) = self.search, (self.search.counts, self.search.changes)
        told = search.told[which]
        last = counts[which, SINCE] == counts[which, PERIODS] - 1  # the last period is that of the best state
        change = changes[which, LEAST] * self.marches.length(search.states[which, BEST], which)
        full = last & (np.abs(1 - told[:, COF]) <= FULL) & (told[:, LEAST_SLIP] > AGES * self._drift(which, change))
        self._leave(which[full], search.states[which[full], START], search.states[which[full], BEST], told[full])
        slipping = which[full]
        self.slips[slipping] = self.found[slipping] = True
        self.gain[slipping], self.spread[slipping] = np.inf, 0.0
        which, last = which[~full], last[~full]
        for c in which[changes[which, LEAST] > changes[which, ENOUGH]]:
            last &= which != c
            self._corrected(c)
        close = changes[which, ENOUGH]
        near = changes[which, LEAST] <= np.maximum(close, CLOSE)
        if (unknown := which[near & np.isnan(self.gain[which])]).size:
            self._measure(unknown)
        near &= ~np.isnan(self.gain[which])
        again = which[~near & (close > CLOSE)]
        self._begin(again, search.states[again, BEST], np.full(again.size, CLOSE))
        return np.concatenate([again, self._told(which[near], last[near])]) if near.any() else again

    def _drift(self, which: Which, change: Array) -> Array:
        """Velocity of a body that moves by no more than the change in a period; under a rigid pull that of springs."""
        roots = self.marches.roots[which]
        rate = roots[:, -self.marches.ways]
        place = roots[:, -2 * self.marches.ways]
        return np.asarray(change / np.where(rate > 0, rate, np.where(place > 0, place, 1.0)))

    def _leave(self, which: Which, begin: Array, end: Array, told: Array) -> None:
        self.begins[which], self.state[which], self.told[which], self.has_state[which] = begin, end, told, True

    def _told(self, which: Which, last: NDArray[np.bool_]) -> Which:
        """The COF of periodic states, and how far it may be from that of the exact ones; those that have to go on.

        last: whether the last period that was marched is theirs.
        """
        marches, search = self.marches, self.search
        best, change, close = (search.states[which, BEST], search.changes[which, LEAST], search.changes[which, ENOUGH])
        begin, end, told = search.states[which, START], best.copy(), search.told[which]
        if not last.all():
            other = ~last
            begin[other] = best[other]
            end[other], told[other] = marches.period(best[other], which[other])
            self.n_periods[which[other]] += 1
        self._leave(which, begin, end, told)
        # all springs together have the stiffness one: the mean force is off by at most twice the distance (SHARE)
        distance = (change + 1e-15) * self.gain[which]  # 1e-15: rounding
        spread = 2 * distance * marches.length(best, which) / marches.mean_F_z[which]
        tolerance, lacks = self.tolerance[which], marches.late(begin, end, which)
        self.spread[which], self.late[which] = spread, (lacks > tolerance) & (marches.v[which] > 0)
        lacking = 1 - told[:, COF]
        settled = (spread <= np.minimum(tolerance, SOLVED_TOLERANCE)) & ~self.late[which]
        found = settled & ((close <= CLOSE) | ~((lacking > FULL) & (lacking < SOLVED_TOLERANCE)))
        self.found[which[found]] = True
        again = ~found & (close > CLOSEST)
        finer = close * np.minimum(0.01, tolerance / (SHARE * spread + 1e-300))
        return self._begin(which[again], best[again], finer[again])

    def _pushed(self, which: Which, ways: Array, push: Array) -> tuple[Array, Array, Array]:
        """Push the best states (m,) by a share (m,) of their size. What these come to after some periods, and a period
        later (m, 2, n_x); what their pushes have become then (m, 2, k, n_x), as displacements from there; their length.

        ways (k,): signs.
        """
        marches, best = self.marches, self.search.states[which, BEST]
        size = marches.length(best, which)
        size = push * np.where(size > 0, size, 1.0)  # of a state that is nothing, as in flight, the unit
        pushes = marches.pushes[which] * ways[:, None]
        x = np.concatenate([best[:, None], best[:, None] + size[:, None, None] * pushes], axis=1)
        m, k, n_x = x.shape
        x, each = x.reshape(m * k, n_x), np.repeat(which, k)
        for _ in range(BETWEEN):
            x, _ = marches.period(x, each)
        image, _ = marches.period(x, each)
        self.n_periods[which] += (BETWEEN + 1) * k
        pairs = np.stack([x.reshape(m, k, n_x), image.reshape(m, k, n_x)], axis=1)
        return pairs[:, :, 0], pairs[:, :, 1:] - pairs[:, :, :1], size

    def _measure(self, which: Which) -> None:
        """Bound on the distance to the fixed point over the change over a period, of states that return so closely that
        their own change is small beside a push, and blurs what is seen of it. It stays unknown where the map expands.
        """
        marches = self.marches
        _, moved, size = self._pushed(which, np.ones(self.after.shape[1]), np.full(which.size, PUSH))
        self.before[which], self.after[which] = moved[:, 0], moved[:, 1]
        seen = moved * marches.roots[which, None, None] / size[:, None, None, None]
        whole = np.isfinite(seen).all(axis=(1, 2, 3))
        which, seen = which[whole], seen[whole]
        self.has_motions[which] = True
        left, lengths, right = np.linalg.svd(seen[:, 0].transpose(0, 2, 1), full_matrices=False)
        lasts = lengths > FORGOTTEN
        with np.errstate(divide="ignore", invalid="ignore"):
            inverse = np.where(lasts, 1 / lengths, 0.0)
        images = seen[:, 1].transpose(0, 2, 1) @ (right.transpose(0, 2, 1) * inverse[:, None])
        left = left * lasts[:, None]
        onto = left.transpose(0, 2, 1) @ images  # nothing in rows and columns of what does not last
        missed = np.sqrt(((images - left @ onto) ** 2).sum(axis=1)).max(axis=1)
        largest = np.abs(np.linalg.eigvals(onto)).max(axis=1)
        along = np.eye(onto.shape[1]) * np.where(lasts, 1.0, 10.0)[:, None]  # which is least of none that lasts
        least = np.linalg.svd(along - onto, compute_uv=False)[:, -1] - missed - self.search.changes[which, LEAST] / PUSH
        gain, slow = 1 / np.maximum(least, 1e-300), marches.slow[which]
        with np.errstate(divide="ignore"):
            creep = -1 / np.expm1(-1 / (CREEP * slow))  # few arms are told apart in so short a time
            told_apart = np.where(marches.stable[which], creep, np.maximum(gain, creep))
            gain = np.where(slow > 0, np.where(largest < STABLE, 1 / (1 - largest), told_apart), gain)
        gain = np.where(lasts.any(axis=1), gain, 1 / (1 - lengths[:, 0] ** (1 / BETWEEN)))
        self.gain[which] = np.where(largest > EXPANDS, np.nan, gain)

    def _corrected(self, c: int) -> None:
        """Newton-Picard corrections of the best state of one contact along the pushed motions, for a state of less
        change over a period.

        The map has kinks, where stick begins. A correction that has to be cut short meets one; so the next pushes go
        the same way and as far, to see the slope on both sides of it.
        """
        marches, search, one, push, lost = self.marches, self.search, np.array([c]), PUSH, 0
        roots, ways = marches.roots[c], np.ones(self.after.shape[1])
        for _ in range(TURNS):
            change, close = search.changes[c, [LEAST, ENOUGH]]
            if not change > close or lost == LOST or time_is_over():
                break
            pair, moved, _ = self._pushed(one, ways, np.array([push]))
            (begin, image), (before, after) = pair[0], moved[0]
            size, move = float(np.linalg.norm(roots * image)) + 1e-300, roots * (image - begin)
            change = float(np.linalg.norm(move)) / size
            turn = (roots * (after - before)).T
            if not np.isfinite(turn).all():
                lost = LOST
                continue
            share = -np.linalg.lstsq(turn, move, rcond=1e-12)[0]
            step, ways = share @ after, ways * np.where(share < 0, -1, 1)
            part, lost, push = 1.0, lost + 1, 0.1 * push  # if no part is a gain, what these pushes saw was not of here
            while part >= SHORTEST:
                tried = image + part * step
                reached = marches.period(tried[None], one)[0][0]
                self.n_periods[c] += 1
                less = float(np.linalg.norm(roots * (reached - tried))) / size
                if less < (1 - 0.1 * part) * change:
                    push = float(np.linalg.norm(part * roots * step)) / size
                    push = float(np.clip(push, 1e-9, PUSH if part == 1 else FARTHEST))
                    image, change, lost = reached, less, 0
                    break
                part *= 0.5
            search.states[c, BEST], search.changes[c, LEAST] = image, change
