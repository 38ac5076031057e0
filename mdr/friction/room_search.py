"""The search behind `design`: values of several numbers of a case, each in a range, with the most room in a target.

What is raised is the least room (target.py) over all limits and places, by sequential quadratic programming with the
least room as one more unknown: where two limits hold each other their rooms meet. Slopes are differences of quick runs,
all of one number of springs and steps, so that what these miss is alike. It begins at the best of some points that fill
the ranges evenly. Each end is looked at everywhere; where a limit is missed more than at the places asked so far, that
place is asked, too, and the search goes on. The last design is run as accurately as `slide` does.

Of the least power the same search raises the room of the power alone, with all limits held.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.case.paths import facts_at, require_apart
from mdr.friction.free_parameters import case_of, path_of, value_of
from mdr.friction.target import (
    DETUNED,
    LIMITS,
    OFF_RESONANCE,
    Answer,
    Place,
    Target,
    all_places,
    at_frequency,
    first_places,
)
from mdr.given.vary import still_held, warn_of_load
from mdr.tools.arrays import EXACT, Array
from mdr.tools.checks import ends
from mdr.tools.messages import short
from mdr.tools.notation import shown, value_in
from mdr.tools.progress import Ended, Ticker, time_is_over, time_limit
from mdr.tools.ranges import Range
from mdr.tools.summary import Row, Summarised, Summary

STARTS = 3  #: peaks among the points looked at first from which the search goes on
LOOKS, CLOSER = 2, 4.0  #: how often points fill smaller ranges around the best, and by how much smaller each time
ROUNDS = 4  #: in which the least power is asked for with a little more room, until accurate runs keep all limits
STEP = 1e-3  #: of a range, over which slopes are taken: well above what runs scatter by, well below any curvature
GAIN, IDLE = 1e-4, 8  #: of room in so many steps, below which a climb ends
CLOSE = 0.01  #: room by which a limit is above the least one and limits too
REFUSED = -3.0  #: room of what is no case: below all others, of which none is below -2
POWER = "power_at_most"  #: the limit that is lowered where the least power is asked for


@dataclass(frozen=True)
class Design(Summarised):
    """A case that meets a target, or comes nearest to it. Dictionaries are by the names of the limits."""

    case: SlidingContact
    target: Target
    met: bool  #: whether all limits hold, by more than the errors of the runs
    values: dict[str, float]  #: of the numbers that were free, in SI, by path
    reached: dict[str, float]  #: the worst value of what is limited, in SI
    room: dict[str, float]  #: how far that is inside [-], below 0 outside; see Notes of `design`
    active: tuple[str, ...]  #: what limits it: names of limits, and ends of ranges
    power: float | None  #: mean power [W] of the drives that vibrate it, at up_to; None without one
    why: str  #: what is missed, and what a resonance does; "" where there is nothing to say
    stopped: str  #: what ended the search before its end; "" where nothing did
    ranges: dict[str, Range] = field(repr=False)  #: lowest and highest value of each, in SI

    def _summary(self) -> Summary:
        rows: list[Row] = []
        for path, value in self.values.items():
            unit = facts_at(path).unit
            low, high = (shown(end, unit) for end in self.ranges[path])
            rows.append((path, shown(value, unit), f"of {low} to {high}"))
        for name, limit in self.target.limits.items():
            unit = LIMITS[name].unit
            inside = f"room {self.room[name]:+.4f}"
            rows.append((name, shown(limit, unit), f"reached {shown(self.reached[name], unit)}, {inside}"))
        rows += [("power", shown(self.power, "W"), "of the drives at up_to")] if self.power is not None else []
        rows += [("limited by", ", ".join(self.active), "")] if self.active else []
        rows += [(name, told, "") for name in ("why", "stopped") if (told := getattr(self, name))]
        return Summary(f"Design: the target is {'met' if self.met else 'not met'}", rows)


class Space:
    """The cases of all values within the ranges, over coordinates x (k,) from 0 to 1."""

    def __init__(self, case: SlidingContact, free: Any, held: Mapping[str, Any]) -> None:
        if not isinstance(free, Mapping) or not free:
            raise TypeError(f'free must be a dict, {{"du_z": (low, high)}}, got {short(repr(free))}')
        paths = [path_of(case, name) for name in free]
        require_apart(paths, [*free])
        self.case, self.held = case, still_held(held, paths)
        self.ranges = {path: Range(*_ends(path, given)) for path, given in zip(paths, free.values(), strict=True)}

    def values(self, x: Array) -> dict[str, float]:
        """{path: value}."""
        return {path: one.value(at) for (path, one), at in zip(self.ranges.items(), x.tolist(), strict=True)}

    def at_end(self, x: Array) -> Iterator[tuple[str, str]]:
        """Paths of the numbers that are at an end of their range, and at which."""
        for path, at in zip(self.ranges, x.tolist(), strict=True):
            if min(at, 1 - at) < STEP:
                yield path, "lowest" if at < STEP else "highest"

    def case_at(self, x: Array) -> SlidingContact:
        """The case at coordinates. ValueError of what is none."""
        return case_of(self.case, {**self.held, **self.values(x)})

    @property
    def of_case(self) -> Array:
        """Coordinates of the case itself, brought into the ranges."""
        return np.array([one.coordinate(value_of(self.case, path, self.held)) for path, one in self.ranges.items()])

    @cached_property
    def evenly(self) -> Array:
        """Points (n, k) that fill the ranges evenly: the first of Sobol's sequence."""
        from scipy.stats.qmc import Sobol

        k = len(self.ranges)
        return np.asarray(Sobol(k, scramble=False).random(2 ** (4 + k.bit_length())))


def _ends(path: str, given: Any) -> tuple[float, float]:
    """The ends of a range, in SI."""
    unit = facts_at(path).unit
    if isinstance(given, tuple | list):
        given = tuple(value_in(path, one, unit) if isinstance(one, str) else one for one in given)
    return ends(f"range of {path}", given)


class _Still(Exception):
    """A climb does not gain any more."""


class Search:
    """The search for the design with the most room, or with the least power."""

    def __init__(self, space: Space, target: Target) -> None:
        self.space, self.asked, self.target = space, target, target
        self.raised = set(target.limits)  #: names of the limits whose room is raised; others are kept
        self.inside = dict.fromkeys(LIMITS, 0.0)  #: least room of a limit that is kept
        self.places = first_places(target, space.case)
        self.room: dict[tuple[float, ...], dict[Place, float]] = {}  #: by quick runs, at coordinates and places
        self.answers: dict[tuple[Any, ...], Answer] = {}
        self.ends: list[Array] = []  #: coordinates that climbs came to
        self.start: Array | None = None  #: the best of a search before, from which this one goes on
        self.refused = ""  #: why one of the cases cannot be
        self.ticker = Ticker("design", parts="runs")

    # --- what there is at coordinates ---

    @property
    def limits(self) -> dict[str, float]:
        """The limits, by name."""
        return {**self.target.limits, OFF_RESONANCE: DETUNED}

    def answer_at(self, x: Array, place: Place, is_quick: bool = True) -> Answer:
        """The contact at a place."""
        key = (*x.tolist(), *place[1:], is_quick)
        if key not in self.answers:
            self.ticker.tick()
            self.answers[key] = Answer(at_frequency(self.space.case_at(x), place.detuned), place.v_0, is_quick)
        return self.answers[key]

    def rooms(self, x: Array, places: list[Place]) -> Array:
        """Rooms at places, by quick runs."""
        known = self.room.setdefault(tuple(x.tolist()), {})
        for place in places:
            if place not in known:
                try:
                    answer = self.answer_at(x, place)
                    known[place], _ = LIMITS[place.name].of(answer, self.limits[place.name])
                except ValueError as refusal:
                    self.refused, known[place] = str(refusal), REFUSED
        return np.array([known[place] for place in places])

    def above(self, x: Array, places: list[Place]) -> Array:
        """Rooms at places above what is to be kept of them, zero of those that are raised."""
        return np.subtract(self.rooms(x, places), [self.inside[one.name] for one in places])

    def is_raised(self, places: list[Place]) -> NDArray[np.bool_]:
        """Of which places the room is raised."""
        return np.array([one.name in self.raised for one in places])

    def score(self, x: Array) -> float:
        """The least room that is raised, at the places asked; below all where a limit is not kept, or of no case."""
        above, is_raised = self.above(x, self.places), self.is_raised(self.places)
        missed = above[~is_raised].min(initial=0.0)
        return float(above[is_raised].min()) if missed == 0 else REFUSED + float(missed)

    @property
    def best(self) -> Array | None:
        """The best coordinates so far; None where there was none that is a case."""
        tried = [np.array(x) for x, known in self.room.items() if all(place in known for place in self.places)]
        found = max(tried, key=self.score, default=None)
        return None if found is None or self.score(found) <= REFUSED else found

    # --- the search ---

    def most_room(self) -> None:
        """The greatest least room over all limits and places: looked for everywhere, then twice closer to the best."""
        evenly, around, size = self.space.evenly, self.space.of_case, 1.0
        self._raise(self._peaks([around, *evenly])[:STARTS])
        for _ in range(LOOKS):
            around, size = self.found, size / CLOSER
            low = np.clip(around - size / 2, 0, 1 - size)
            peaks = self._peaks([around, *(low + size * evenly[: len(evenly) // 4])])
            if others := [x for x in peaks if x is not around]:
                self._raise([*others[:1], around])

    def _peaks(self, points: list[Array]) -> list[Array]:
        """The best of some points that have more room than the points next to them."""
        scores = np.array([self.score(x) for x in points])
        apart = np.linalg.norm(np.subtract(np.array(points)[:, None], points), axis=2)
        near = np.argsort(apart, axis=1)[:, : 2 * points[0].size + 1]  # and itself
        peaks = [i for i in np.argsort(-scores).tolist() if scores[i] >= scores[near[i]].max() > REFUSED]
        return [points[i] for i in peaks] or [self.found]

    def least_power(self, starts: list[Array]) -> None:
        """The least power with which all limits hold, by more than the errors of runs; from cases that keep them."""
        self.start = max(starts, key=self.score)
        powers = [self._known(self.start, one, LIMITS[POWER].value, is_quick=True) for one in self.places if one.v_0]
        if not max(powers) > 0:
            return  # there is none to spare, or a run does not settle
        self.target = replace(self.asked, power_at_most=max(powers))
        self.raised = {POWER}
        self.room, self.places = {}, [
            *(one for one in self.places if one.name != POWER), Place(POWER, self.target.velocities[-1])
        ]  # fmt: skip
        for _ in range(ROUNDS):
            self._raise(starts)
            short = {one.name: error - room for one, (room, error) in self.confirmed().items() if room < error}
            if not short:
                return
            # quick runs saw more room: keep twice what was missed
            self.inside = {name: one + 2 * short.get(name, 0.0) for name, one in self.inside.items()}

    def _raise(self, starts: list[Array]) -> None:
        """Raise the room from these on, until the best so far is as good at all places as at those asked."""
        self.ends = [self._climbed(x) for x in starts]
        while worse := self._worse(best := max(self.ends, key=self.score)):
            self.places = [*self.places, *worse]
            self.ends.append(self._climbed(best))

    def _worse(self, x: Array) -> list[Place]:
        """Of each limit the worst place that was not asked for, where there is one that is worse than those asked."""
        places = all_places(self.target, self.space.case_at(x))
        above, least = self.above(x, places), np.where(self.is_raised(places), self.score(x), 0.0)
        found: dict[str, Place] = {}
        for value, bound, place in sorted(zip(above.tolist(), least.tolist(), places, strict=True)):
            if value < bound - EXACT and place not in self.places:
                found.setdefault(place.name, place)
        return list(found.values())

    def _climbed(self, start: Array) -> Array:
        """Coordinates with the most room near to these, or these."""
        from scipy.optimize import minimize

        is_raised, seen, steps = self.is_raised(self.places), [start], [REFUSED]

        def spare(z: Array) -> Array:
            seen.append(np.clip(z[:-1], 0, 1))
            return self.above(seen[-1], self.places) - np.where(is_raised, z[-1], 0.0)

        def slopes(z: Array) -> Array:  # once in each step
            steps.append(max(map(self.score, seen)))
            if len(steps) > IDLE and steps[-1] - steps[-IDLE] < GAIN:
                raise _Still
            return np.column_stack([self._slopes(np.clip(z[:-1], 0, 1)), np.where(is_raised, -1.0, 0.0)])

        up = np.append(np.zeros(start.size), -1.0)
        with suppress(_Still):
            minimize(
                lambda z: -z[-1], np.append(start, self.score(start)), jac=lambda _: up, method="SLSQP",
                bounds=[*(start.size * [(0.0, 1.0)]), (None, None)],
                constraints={"type": "ineq", "fun": spare, "jac": slopes}, options={"ftol": 1e-1 * GAIN},
            )  # fmt: skip
        return max(seen, key=self.score)

    def _slopes(self, x: Array) -> Array:
        """Derivatives of rooms (n, k), to the side where there is a case."""
        here, columns = self.rooms(x, self.places), []
        for i in range(x.size):
            column = np.zeros(here.size)
            for step in (STEP, -STEP) if x[i] + STEP <= 1 else (-STEP,):
                there = self.rooms(x + step * (np.arange(x.size) == i), self.places)
                if min(there.min(), here.min()) > REFUSED:
                    column = (there - here) / step
                    break
            columns.append(column)
        return np.transpose(columns)

    # --- the answer ---

    def confirmed(self) -> dict[Place, tuple[float, float]]:
        """Room and error of the best at the worst place of each limit that was asked for, as accurate as runs are."""
        x, limits = self.found, self.asked.limits
        quick = {one: self.rooms(x, [one])[0] for one in all_places(self.asked, self.space.case_at(x))}
        worst = [min((one for one in quick if one.name == name), key=quick.__getitem__) for name in limits]
        found = {}
        for one in worst:
            try:
                found[one] = LIMITS[one.name].of(self.answer_at(x, one, is_quick=False), limits[one.name])
            except ValueError as refusal:
                self.refused, found[one] = str(refusal), (REFUSED, 0.0)
        return found

    @property
    def found(self) -> Array:
        """The best coordinates. ValueError where there are none."""
        best = self.best
        found = self.start if best is None else best
        if found is None:
            why = self.refused or f"each is less than {DETUNED:.0%} of the frequency off a resonance"
            raise ValueError(f"of {len(self.room)} cases in these ranges none can be: {why}; give other ranges")
        return found

    @property
    def is_met(self) -> bool:
        """Whether the best meets the target, as accurately as runs are."""
        return all(room >= error for room, error in self.confirmed().values())

    def stopped(self, work: Callable[[], None], limit_s: float | None) -> str:
        """Do the work; what ended it early, "" where nothing did. Without a case to answer the end is raised."""
        with time_limit(limit_s):
            try:
                work()
            except (Ended, KeyboardInterrupt) as end:
                is_over = time_is_over()
                if self.best is not None or self.start is not None:
                    return f"the limit of {limit_s:g} s" if is_over else "an interrupt"
                if not is_over:
                    raise
                raise ValueError(f"limit_s = {limit_s:g} s is over before the first case is done; raise it") from end
        return ""

    def design(self, stopped: str = "") -> Design:
        """The best as it is answered."""
        x, asked, worst = self.found, self.asked, self.confirmed()
        case, values = self.space.case_at(x), self.space.values(x)
        warn_of_load({**self.space.held, **values}, case, "of the design ")
        room = {one.name: room for one, (room, _) in worst.items()}
        reached = {one.name: self._known(x, one, LIMITS[one.name].value) for one in worst}
        # of the least power, limits that are kept; else those with the least room
        edge = self.inside if self.raised == {POWER} else dict.fromkeys(room, min(room.values()))
        limiting = [name for name in room if room[name] <= edge[name] + CLOSE]
        ends = [f"{path} at its {end}" for path, end in self.space.at_end(x)]
        missed = [name for name in room if room[name] < 0]
        told = [
            f"{name} = {shown(asked.limits[name], LIMITS[name].unit)} is missed: "
            + (self.refused if np.isnan(reached[name]) else shown(reached[name], LIMITS[name].unit))
            for name in missed
        ]
        if self.rooms(x, [Place(OFF_RESONANCE, 0.0)])[0] < CLOSE:
            limiting.append("a resonance")
            told.append(f"{DETUNED:.0%} of the frequency off a resonance: on it friction stays low, and only there")
        return Design(
            case=case,
            target=asked,
            met=all(room >= error for room, error in worst.values()),
            values=values,
            reached=reached,
            room=room,
            active=(*limiting, *ends),
            power=None if asked.up_to is None else self._known(x, Place(POWER, asked.up_to), LIMITS[POWER].value),
            why="; ".join(told),
            stopped=stopped,
            ranges=dict(self.space.ranges),
        )

    def _known(self, x: Array, place: Place, what: Callable[[Answer], float], is_quick: bool = False) -> float:
        """What there is at a place; NaN where a run does not settle."""
        try:
            return what(self.answer_at(x, place, is_quick))
        except ValueError as refusal:
            self.refused = str(refusal)
            return np.nan
