"""design(): values of several numbers of a case, each in a range, with which it is as far as can be inside a target.

What is raised is the least room (target.py) over all limits and places, by sequential quadratic programming with the
least room as one more unknown: where two limits hold each other their rooms meet. Slopes are differences of quick runs,
all of one number of springs and steps, so that what these miss is alike. It begins at the best of some points that fill
the ranges evenly. Each end is looked at everywhere; where a limit is missed more than at the places asked so far, that
place is asked, too, and the search goes on. The last design is run as accurately as `slide` does.

Of the least power the same search raises the room of the power alone, with all limits held.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact, as_given
from mdr.case.domain import ALIKE, Domain
from mdr.case.paths import facts_at
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
from mdr.normal.resolved import at_rest
from mdr.tools.arrays import EXACT, Array
from mdr.tools.checks import ends, instance, word
from mdr.tools.keywords import offering
from mdr.tools.messages import short
from mdr.tools.notation import shown, value_in
from mdr.tools.progress import Ended, Ticker, time_limit
from mdr.tools.ranges import Range
from mdr.tools.summary import Row, Summarised, Summary

LAW = Domain((ALIKE,), instead="slide(case, v_0) at each velocity; find with smooth=True is where stick-slip ends")
STARTS = 3  #: of the points looked at first from which the search goes on
ROUNDS = 4  #: of places that are added
STEP = 1e-3  #: of a range, over which slopes are taken: well above what runs scatter by, well below any curvature
CLOSE = 0.01  #: room by which a limit is above the least one and limits too
REFUSED = -2.0  #: room of what is no case: below all others
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
    why: str  #: what is missed, what a resonance does, what ended the search; "" where there is nothing to say
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
        rows += [("why", self.why, "")] if self.why else []
        return Summary(f"Design: the target is {'met' if self.met else 'not met'}", rows)


@offering
def design(
    case: SlidingContact,
    target: Target,
    free: Mapping[str, Any],
    *,
    least: str | None = None,
    held: Mapping[str, Any] | None = None,
    limit_s: float | None = None,
) -> Design:
    """Values of some numbers of a case with which it meets a target, as far inside as can be; or comes nearest to it.

    Parameters
    ----------
    case : SlidingContact
        The contact; what is not free stays.
    target : Target
        Limits on friction, critical velocity and power.
    free : dict of str to (low, high)
        Ranges of the numbers that may change, in SI or with units, ("0.1um", "2um"), by paths as in `find`.
    least : {"power"}, optional
        Ask for the least power of the drives with which the target is met, not for the most room.
    held : mapping of str to float, optional
        "load" [N], "frequency" [Hz] or "tan_delta" [-] that hold meanwhile, as in `find`.
    limit_s : float, optional
        Computing time [s] after which the search ends; an interrupt (Ctrl-C) ends it too. The best design so far is
        answered, and `why` says so. None: no limit.

    Returns
    -------
    Design
        The case, whether it meets the target, what is reached, and what limits it.

    Raises
    ------
    ValueError
        For a range of what is no number of the case, and where no case of the ranges can be.
    TypeError
        For another type.

    See Also
    --------
    front : least power over friction.
    find : all values of one number.

    Notes
    -----
    The room of a limit is, of friction, its distance over friction of full slip, of a velocity or power v with limit b
    (v - b)/(v + b), or its negative. The design has the greatest least room that was found; nothing proves that there
    is none greater. Friction and power are looked at at `up_to`, and at 1/2, 1/4 and 1/8 of it. Where a body or a mass
    may swing, all limits are to hold at frequencies 5 % below and above too, which keeps away from resonances.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=1e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=vibration)
    >>> target = mdr.Target(cof_at_most=0.2, up_to=1e-4)
    >>> found = mdr.design(case, target, {"du_z": ("1um", "15um")})
    >>> found.met, found.active
    (True, ('oscillation.du_z at its highest',))
    """
    case = LAW.seen(as_given(case), "design")
    at_rest(case)  # warns of what is unlikely
    instance("target", target, Target)
    if least is not None:
        word("least", least, "power")
        if target.up_to is None:
            raise ValueError("least power wants up_to of the target, the velocity in m/s at which it is taken")
    space = _Space(case, free, held or {})
    search = _Search(space, target)
    stopped = ""
    with time_limit(limit_s):
        try:
            search.most_room(space.first)
            if least and search.is_met:
                search.least_power()
        except Ended:
            stopped = f"stopped by the limit of {limit_s:g} s"
        except KeyboardInterrupt:
            stopped = "stopped by an interrupt"
            if search.best is None:
                raise
    return search.design(stopped)


class _Space:
    """The cases of all values within the ranges, over coordinates x (k,) from 0 to 1."""

    def __init__(self, case: SlidingContact, free: Any, held: Mapping[str, Any]) -> None:
        if not isinstance(free, Mapping) or not free:
            raise TypeError(f'free must be a dict, {{"du_z": (low, high)}}, got {short(repr(free))}')
        paths = [path_of(case, name) for name in free]
        if len(set(paths)) < len(paths):
            raise ValueError(f"free names one twice: {', '.join(map(str, free))}")
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
    def first(self) -> list[Array]:
        """The case itself, brought into the ranges, and points that fill them evenly: the first of Sobol's sequence."""
        from scipy.stats.qmc import Sobol

        k = len(self.ranges)
        of_case = [one.coordinate(value_of(self.case, path, self.held)) for path, one in self.ranges.items()]
        return [np.array(of_case), *Sobol(k, scramble=False).random(2 ** (3 + k.bit_length()))]


def _ends(path: str, given: Any) -> tuple[float, float]:
    """The ends of a range, in SI."""
    unit = facts_at(path).unit
    if isinstance(given, tuple | list):
        given = tuple(value_in(path, one, unit) if isinstance(one, str) else one for one in given)
    return ends(f"range of {path}", given)


class _Search:
    """The search for the design with the most room, or with the least power."""

    def __init__(self, space: _Space, target: Target) -> None:
        self.space, self.asked, self.target = space, target, target
        self.raised = set(target.limits)  #: names of the limits whose room is raised; others are kept
        self.inside = dict.fromkeys(LIMITS, 0.0)  #: least room of a limit that is kept
        self.places = first_places(target, space.case)
        self.room: dict[tuple[float, ...], dict[Place, float]] = {}  #: by quick runs, at coordinates and places
        self.answers: dict[tuple[Any, ...], Answer] = {}
        self.ends: list[Array] = []  #: coordinates that climbs came to
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

    def most_room(self, starts: list[Array]) -> None:
        """The greatest least room over all limits and places."""
        self._raise(sorted(starts, key=self.score, reverse=True)[:STARTS])

    def least_power(self) -> None:
        """The least power with which all limits hold, by more than the errors of runs; from the best so far on."""
        start, places = self.best, self.places
        assert start is not None
        most = max(self.answer_at(start, one).power for one in places if one.v_0)
        if most <= 0:
            return  # there is none to spare
        self.target = replace(self.asked, power_at_most=most)
        self.raised = {POWER}
        self.room, self.places = (
            {},
            [*(one for one in places if one.name != POWER), Place(POWER, self.target.velocities[-1])],
        )
        starts = [start, *self.ends]
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
        for _ in range(ROUNDS * len(starts)):
            best = max(self.ends, key=self.score)
            if not (worse := self._worse(best)):
                return
            self.places = [*self.places, *worse]
            self.ends.append(self._climbed(best))

    def _worse(self, x: Array) -> list[Place]:
        """Of each limit the worst place that was not asked for, where there is one that is worse than those asked."""
        places = all_places(self.target, self.space.case_at(x))
        above, least = self.above(x, places), np.where(self.is_raised(places), self.score(x), 0.0)
        found: dict[str, Place] = {}
        for value, bound, place in sorted(zip(above.tolist(), least.tolist(), places, strict=True)):
            if value < bound - EXACT:
                found.setdefault(place.name, place)
        return list(found.values())

    def _climbed(self, start: Array) -> Array:
        """Coordinates with the most room near to these, or these."""
        from scipy.optimize import minimize

        is_raised, seen = self.is_raised(self.places), [start]

        def spare(z: Array) -> Array:
            seen.append(np.clip(z[:-1], 0, 1))
            return self.above(seen[-1], self.places) - np.where(is_raised, z[-1], 0.0)

        def slopes(z: Array) -> Array:
            return np.column_stack([self._slopes(np.clip(z[:-1], 0, 1)), np.where(is_raised, -1.0, 0.0)])

        up = np.append(np.zeros(start.size), -1.0)
        minimize(
            lambda z: -z[-1], np.append(start, self.score(start)), jac=lambda _: up, method="SLSQP",
            bounds=[*(start.size * [(0.0, 1.0)]), (REFUSED, 1.0)],
            constraints={"type": "ineq", "fun": spare, "jac": slopes}, options={"maxiter": 25, "ftol": 1e-5},
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
        x, limits = self._found, self.asked.limits
        quick = {one: self.rooms(x, [one])[0] for one in all_places(self.asked, self.space.case_at(x))}
        worst = [min((one for one in quick if one.name == name), key=quick.__getitem__) for name in limits]
        return {one: LIMITS[one.name].of(self.answer_at(x, one, is_quick=False), limits[one.name]) for one in worst}

    @property
    def _found(self) -> Array:
        """The best coordinates. ValueError where there are none."""
        if (found := self.best) is None:
            raise ValueError(f"no case of these ranges can be: {self.refused}")
        return found

    @property
    def is_met(self) -> bool:
        """Whether the best meets the target, as accurately as runs are."""
        return all(room >= error for room, error in self.confirmed().values())

    def design(self, stopped: str) -> Design:
        """The best as it is answered."""
        x, asked = self._found, self.asked
        worst = self.confirmed()
        case, values = self.space.case_at(x), self.space.values(x)
        warn_of_load({**self.space.held, **values}, case, "of the design ")
        room = {one.name: room for one, (room, _) in worst.items()}
        met = all(room >= error for room, error in worst.values())
        reached = {one.name: LIMITS[one.name].value(self.answer_at(x, one, is_quick=False)) for one in worst}
        power = None if asked.up_to is None else self.answer_at(x, Place(POWER, asked.up_to), is_quick=False).power
        # of the least power, limits that are kept; else those with the least room
        edge = {name: self.inside[name] if self.raised == {POWER} else min(room.values()) for name in room}
        limiting = [one for one, (has, _) in worst.items() if has <= edge[one.name] + CLOSE]
        ends = [f"{path} at its {end}" for path, end in self.space.at_end(x)]
        told = [stopped] if stopped else []
        for name, limit in asked.limits.items():
            if room[name] < 0:
                unit = LIMITS[name].unit
                told.append(f"{name} = {shown(limit, unit)} is missed: {shown(reached[name], unit)}")
        kept = self.rooms(x, [Place(OFF_RESONANCE, 0.0)])[0] < CLOSE
        told += (
            [f"{100 * DETUNED:.3g} % off a resonance, on which friction would stay reduced, at one frequency alone"]
            if kept
            else []
        )
        return Design(
            case=case,
            target=asked,
            met=met,
            values=values,
            reached=reached,
            room=room,
            active=(*(one.name for one in limiting), *(["a resonance"] if kept else []), *ends),
            power=power,
            why="; ".join(told),
            ranges=dict(self.space.ranges),
        )
