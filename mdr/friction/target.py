"""Target: limits on friction, critical velocity and power; how far inside them a contact is, and where the worst is.

The room of a limit is a number, above zero inside: of friction the distance over friction of full slip, or over the
limit where that is greater; of a velocity or a power L/(1 + |L|), L the logarithm of it over its limit, so that an
infinite one counts as 1.

Friction is limited at all velocities up to one. On a resonance of a body friction stays reduced however fast the pull,
and v_c is infinite; but a share of a per cent beside it all may be lost. So a design keeps off resonances, and where
there are some, limits are to hold at frequencies that are a little off, too. Each (velocity, frequency) is a place.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from mdr.case.contact import SlidingContact, as_given
from mdr.case.paths import fields_set, paths_of
from mdr.closed_forms.full_slip import normal_force_harmonics
from mdr.closed_forms.full_slip_body import full_slip_critical_velocity
from mdr.closed_forms.shaken_pull import CLOSED_FORM
from mdr.friction.cof_curve import friction_at
from mdr.friction.free_parameters import case_of
from mdr.friction.shaken import no_load_velocity
from mdr.given.vary import value_at
from mdr.march.periodic.steady import BUDGET, Resolution
from mdr.march.result.refinement import default_springs, default_steps
from mdr.march.result.run import SlidingRun, finish
from mdr.march.result.slide import checked_velocity, runs, slide
from mdr.normal.normal_force import full_cof
from mdr.normal.resolved import at_rest, resolved
from mdr.tools.allowed import refusal_of
from mdr.tools.checks import finite, positive_or_none
from mdr.tools.fields import Record, facts
from mdr.tools.notation import shown
from mdr.tools.progress import Ended, time_is_over
from mdr.tools.summary import Row, Summarised, Summary

DETUNED = 0.05  #: of the frequency, to either side, at which limits hold too where a body or a mass may swing
LEAST_HARMONIC = 0.01  #: of the normal force, over its mean, that makes a resonance of a multiple of the frequency
GUIDE = 0.01  #: of the way to where friction is not full any more, in the room: no run of full slip tells that way
PARTS = (0.125, 0.25, 0.5, 1.0)  #: of the greatest velocity, at which friction and power are looked at


def _finite_or_none(name: str, value: Any, note: str = "") -> float | None:
    """A finite number, or None."""
    return None if value is None else finite(name, value, note)


@dataclass(frozen=True, kw_only=True)
class Target(Record, Summarised):
    """What is wanted of a contact; None is no limit.

    Examples
    --------
    >>> import mdr
    >>> print(mdr.Target(cof_at_most=0.25, up_to=5e-3, power_at_most=3.0))
    Target
      cof_at_most    0.25
      up_to          5 mm/s
      power_at_most  3 W
    """

    cof_at_most: float | None = field(
        default=None, metadata=facts("-", "greatest friction at velocities up to up_to", _finite_or_none)
    )
    cof_at_least: float | None = field(default=None, metadata=facts("-", "least friction there", _finite_or_none))
    up_to: float | None = field(
        default=None, metadata=facts("m/s", "greatest velocity at which friction and power hold", positive_or_none)
    )
    v_c_at_least: float | None = field(
        default=None, metadata=facts("m/s", "least critical velocity, with all harmonics", positive_or_none)
    )
    no_load_velocity_at_least: float | None = field(
        default=None,
        metadata=facts(
            "m/s", "least velocity forward without load, of a contact that is shaken along", positive_or_none
        ),
    )
    power_at_most: float | None = field(
        default=None,
        metadata=facts("W", "greatest mean power of the drives that vibrate it, up to up_to", positive_or_none),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        low, high = self.cof_at_least, self.cof_at_most
        if low is not None and high is not None and low >= high:
            raise ValueError(f"cof_at_least must be below cof_at_most, got {low:.6g} and {high:.6g}")
        if not self.limits:
            raise ValueError(
                f"a target wants a limit: {', '.join(one.name for one in fields(self) if one.name in LIMITS)}"
            )
        if moving := [name for name in self.limits if LIMITS[name].moves and self.up_to is None]:
            raise ValueError(f"{moving[0]} wants up_to, the velocity in m/s up to which it is to hold")
        if self.up_to is not None and not any(LIMITS[name].moves for name in self.limits):
            raise ValueError("up_to is of friction or power: give cof_at_most, cof_at_least or power_at_most")

    @property
    def limits(self) -> dict[str, float]:
        """The limits that there are, by name."""
        given = {one.name: getattr(self, one.name) for one in fields(self)}
        return {name: value for name, value in given.items() if name in LIMITS and value is not None}

    @property
    def velocities(self) -> tuple[float, ...]:
        """Velocities [m/s] at which friction is looked at, rising to the greatest."""
        return () if self.up_to is None else tuple(self.up_to * part for part in PARTS)

    def _summary(self) -> Summary:
        rows: list[Row] = [(name, shown(value, LIMITS[name].unit), "") for name, value in self.limits.items()]
        where = [("up_to", shown(self.up_to, "m/s"), "")] if self.up_to is not None else []
        moving = sum(name.startswith("cof") for name in self.limits)
        return Summary("Target", [*rows[:moving], *where, *rows[moving:]])


class Place(NamedTuple):
    """Where a limit is asked about."""

    name: str  #: of the limit
    v_0: float  #: velocity [m/s]; 0 of one that has none
    detuned: float = 1.0  #: frequency over that of the case


class Answer:
    """What a contact does at a velocity, each asked for once: as accurately as `slide`, or quickly, by one run of half
    of the springs and steps with which that begins.
    """

    def __init__(self, case: SlidingContact, v_0: float, is_quick: bool) -> None:
        if time_is_over():
            raise Ended
        self.case, self.v_0, self.is_quick = resolved(case), v_0, is_quick

    @cached_property
    def _run(self) -> SlidingRun:
        if self.is_quick:
            springs, steps = (of(self.case) // 2 for of in (default_springs, default_steps))
            resolution = Resolution(springs, steps, "full_slip", lump=True, bounded=False)
            (end,) = runs(self.case, [checked_velocity(self.case, self.v_0)], resolution)
            run = finish(end)
        else:
            run = slide(self.case, self.v_0)
        if not run.settled:
            raise ValueError(f"the run at {shown(self.v_0, 'm/s')} did not settle: {run.why}")
        return run

    @cached_property
    def excess(self) -> float:
        """How far the velocity is above that from which all springs slip [-], where that is known; 0 below it."""
        case = self.case
        if not case.friction.is_coulomb or case.moves_across or refusal_of(full_slip_critical_velocity, case):
            return 0.0
        return max(-_above(full_slip_critical_velocity(case), abs(self.v_0)), 0.0)

    @cached_property
    def cof(self) -> tuple[float, float]:
        """Friction [-] and its error."""
        if self.is_quick and self.excess:
            return full_cof(self.case), 0.0
        if self.case not in CLOSED_FORM:
            return self._run.cof, 0.0 if self.is_quick else self._run.cof_error
        cof, error, why = friction_at(self.case, self.v_0, BUDGET)
        if why:
            raise ValueError(why)
        return cof, error

    @property
    def power(self) -> float:
        """Mean power [W] of the drives of the vibration."""
        return self._run.power["normal"] + self._run.power["shake"]


class Limit(NamedTuple):
    """One kind of limit."""

    unit: str
    moves: bool  #: whether it is of all velocities up to one
    of: Callable[[Answer, float], tuple[float, float]]  #: room within a limit, and its error
    value: Callable[[Answer], float]  #: what is limited


def _below_friction(answer: Answer, most: float) -> tuple[float, float]:
    """Room below the most; in a search full friction has a little less the farther above v_c it is full."""
    room, error = _above_friction(answer, most)
    return -room - (GUIDE * answer.excess if answer.is_quick else 0.0), error


def _above_friction(answer: Answer, least: float) -> tuple[float, float]:
    cof, error = answer.cof
    scale = max(full_cof(answer.case), abs(least))
    return (cof - least) / scale, error / scale


def _v_c(answer: Answer) -> float:
    return full_slip_critical_velocity(answer.case)


def _above(value: float, limit: float) -> float:
    """Room of a value >= 0 above a limit."""
    if value in (0, np.inf):
        return 1.0 if value else -1.0
    times = float(np.log(value / limit))
    return times / (1 + abs(times))


def _resonances(case: SlidingContact) -> list[float]:
    """Natural frequencies [rad/s] of the body on its spring and of a mass on the contact, where little damps them."""
    known = at_rest(case)
    mass = getattr(as_given(case).oscillation, "m_z", 0.0)
    found = [(known.pull.omega_0, known.pull.damping_ratio)]
    found += [(float(np.sqrt(known.k_zc / mass)), known.T / 2)] if mass else []
    return [omega_0 for omega_0, damping in found if 0 < omega_0 < np.inf and damping < DETUNED]


def _off_resonance(answer: Answer) -> float:
    """Share [-] by which the frequency is off the nearest resonance: of a harmonic that matters in the normal force, as
    friction stays short of that of full slip by its share, however fast the pull.
    """
    case, off = answer.case, [1.0]
    for omega_0 in _resonances(case):
        F_n = np.abs(normal_force_harmonics(case))
        for n in {1, max(1, round(omega_0 / case.omega))}:
            if n == 1 or (n < F_n.size and F_n[n] > LEAST_HARMONIC * F_n[0]):
                off.append(abs(omega_0 / (n * case.omega) - 1))
    return min(off)


def _friction(answer: Answer) -> float:
    return answer.cof[0]


def _no_load(answer: Answer) -> float:
    return no_load_velocity(answer.case)


OFF_RESONANCE = "off_resonance"  #: a limit of every target for what swings
LIMITS = {
    "cof_at_most": Limit("-", True, _below_friction, _friction),
    "cof_at_least": Limit("-", True, _above_friction, _friction),
    "v_c_at_least": Limit("m/s", False, lambda one, least: (_above(_v_c(one), least), 0.0), _v_c),
    # what drives at a velocity still runs faster without a load
    "no_load_velocity_at_least": Limit("m/s", False, lambda one, _: _below_friction(one, 0.0), _no_load),
    "power_at_most": Limit(
        "W", True, lambda one, most: (-_above(max(one.power, 0.0), most), 0.0), lambda one: one.power
    ),
    OFF_RESONANCE: Limit("-", False, lambda one, least: (_off_resonance(one) - least, 0.0), _off_resonance),
}


def first_places(target: Target, case: SlidingContact) -> list[Place]:
    """The places that a search begins with: the greatest velocity, where friction is most, or the least."""
    found = [Place(OFF_RESONANCE, 0.0)] if _resonances(case) else []
    for name, limit in target.limits.items():
        if name == "cof_at_least":
            found.append(Place(name, target.velocities[0]))
        else:
            found.append(Place(name, target.velocities[-1] if LIMITS[name].moves else _velocity(name, limit)))
    return found


def all_places(target: Target, case: SlidingContact) -> list[Place]:
    """All places that a design is judged by."""
    swings = bool(_resonances(case))
    found = [
        Place(name, v_0, detuned)
        for name, limit in target.limits.items()
        for v_0 in (target.velocities if LIMITS[name].moves else (_velocity(name, limit),))
        for detuned in ((1.0, 1 - DETUNED, 1 + DETUNED) if swings else (1.0,))
    ]
    return [*found, Place(OFF_RESONANCE, 0.0)] if swings else found


def _velocity(name: str, limit: float) -> float:
    """The velocity at which a limit that is of none is asked about."""
    return limit if name == "no_load_velocity_at_least" else 0.0


def at_frequency(case: SlidingContact, factor: float) -> SlidingContact:
    """The case at another frequency of all that vibrates."""
    if factor == 1:
        return case
    omegas = {path: value_at(case, path) for path in fields_set("frequency") if path in paths_of(case)}
    return case_of(case, {path: factor * omega for path, omega in omegas.items() if omega})
