"""Derivatives of friction, and of what is in closed form, with respect to one input of a case.

Each is a central difference, D(h) = (f(x + h) - f(x - h))/2h. An error of f moves it by its share over h, and it misses
the derivative by h²: so h, over x, is the cube root of the relative error of f. The slopes S(2h) to either side should
be what the curvature, of S(h) to both sides, makes of S(h). What they differ from this by tells the error: h² misses
a third of it, and at a corner each differs by half of what the slope jumps.

In closed form D(h) + (D(h) - D(2h))/3 is the answer. Elsewhere f is friction of runs of one resolution, that of a run
as accurate as asked for, whose row is cut where springs begin to slip back (order.py), and D(h) the answer. What
springs and steps miss of friction is almost the same in all these runs, and falls out. For what is left of it S(2h) is
of coarser runs, above with 1/2 of both numbers, below with 3/8: at second order they differ by 3 and by 6 times what
D(h) misses, and the bound is 8 times that. Where it is too large, the same is asked of runs with twice the springs and
steps. Runs may agree by chance: no derivative is known better than friction is asked for, each over its scale.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.case.paths import facts_at
from mdr.friction.cof_curve import counted, friction_at
from mdr.friction.inputs import OF_RUN
from mdr.march.periodic.order import cut_of
from mdr.march.periodic.steady import MOST_ACCURATE, MarchEnd, Resolution, steady
from mdr.march.result.refinement import BY_CHANCE, MOST_CHOSEN, MOST_GAINED, UNEVENLY, companions, resolution_of, within
from mdr.march.result.run import friction_of
from mdr.normal.normal_force import full_cof
from mdr.normal.resolved import resolved
from mdr.tools.arrays import EPS
from mdr.tools.notation import shown

#: error up to which there is a derivative, over the greater of itself and the quantity over the input
SURE = 1e-3
AIM = SURE / 2  #: the same from which on finer runs are asked
CHANCE = BY_CHANCE / MOST_GAINED  #: what the coarser of two differences counts, as in the bound of a run


class Function(NamedTuple):
    """A quantity of a case at a velocity."""

    of: Callable[[SlidingContact, float], float]
    value: float  #: of the case that is asked for
    error: float  #: relative, by which values of cases close by scatter


class Functions(NamedTuple):
    """A quantity, as it is asked for in differences of one size, and of twice the size to either side."""

    main: Function
    below: Function
    above: Function
    missed: float = 0.0  #: relative, what the numerics are allowed to miss of the quantity itself
    finer: Callable[[], Functions | None] = lambda: None  #: with finer numerics; None where there are none

    @classmethod
    def of_one(cls, function: Function) -> Functions:
        """Of a quantity that is known in one way."""
        return cls(function, function, function)

    @property
    def is_one(self) -> bool:
        """Whether it is known in one way."""
        return self.main is self.above


class Slope(NamedTuple):
    """A derivative in SI, and its error; or why there is none."""

    value: float = np.nan
    error: float = np.nan
    why: str = ""


def closed_form(case: SlidingContact, law: Callable[[SlidingContact], float], error: float = EPS) -> Functions:
    """A quantity in closed form; error: relative, to which values of cases close by are known."""
    return Functions.of_one(Function(lambda one, _: law(one), float(law(case)), error))


def friction(case: SlidingContact, v_0: float, accuracy: float) -> Functions:
    """Friction at a velocity: in closed form, or of runs at the resolution of one that is as accurate.

    Raises ValueError where it does not settle.
    """
    if counted(case, v_0)[1]:
        return _runs(case, v_0, accuracy)
    value, error, why = friction_at(case, v_0, accuracy)
    _settled(value, why)

    def of(one: SlidingContact, speed: float) -> float:
        cof, _, why = friction_at(one, speed, accuracy)
        return _settled(cof, why)

    return Functions.of_one(Function(of, value, error / full_cof(case)))


def _settled(cof: float, why: str) -> float:
    """Friction that has settled. ValueError of another, and why it has not."""
    if why:
        raise ValueError(why)
    return cof


def _runs(case: SlidingContact, v_0: float, accuracy: float) -> Functions:
    """Friction of runs at three resolutions, each begun in the periodic state that one of the case has come to."""
    known, speed = _forward(case, v_0)
    end = within(known, speed, resolution_of(known, None, None, accuracy))
    found = friction_of(end)
    _settled(found.cof, "" if found.settled else f"the run did not settle: {found.why}")
    missed = accuracy / max(abs(end.cof), EPS)

    def function(resolution: Resolution) -> Function:
        of_case = steady(known, speed, resolution, near=end.to_begin_from)
        return Function(_of_resolution(resolution, of_case), _of_end(of_case, v_0), of_case.settling.spread)

    def at(main: Resolution, finer: Callable[[], Functions | None]) -> Functions:
        beside = companions(known, main)
        return Functions(function(main), function(beside.less), function(beside.half), missed, finer)

    main = end.resolution._replace(bounded=False, accuracy=MOST_ACCURATE, cut=cut_of(end))
    if end.slips_fully and not end.error:  # as finer runs do, but coarser ones may stick
        return Functions.of_one(function(main))
    twice = main.of_size(2 * main.steps, 2 * main.n_springs)
    is_dear = twice.n_springs * twice.steps > MOST_CHOSEN
    return at(main, cache(lambda: None if is_dear else at(twice, lambda: None)))


def _forward(case: SlidingContact, v_0: float) -> tuple[SlidingContact, float]:
    """The case, or its mirror image, pulled forward."""
    known = resolved(case)
    return (known.mirrored, -v_0) if v_0 < 0 else (known, v_0)


def _of_resolution(resolution: Resolution, near: MarchEnd) -> Callable[[SlidingContact, float], float]:
    """Friction of a case close by, by a run of this resolution."""

    def of(case: SlidingContact, v_0: float) -> float:
        known, speed = _forward(case, v_0)
        end = steady(known, speed, resolution, near=near.to_begin_from)
        return _settled(_of_end(end, v_0), "" if end.settling.settled else "the run did not settle")

    return of


def _of_end(end: MarchEnd, v_0: float) -> float:
    """Friction of a run, in the direction of the pull."""
    return math.copysign(full_cof(end.case), v_0) * end.cof


def slope(at: Callable[[float], SlidingContact], path: str, x: float, v_0: float, of: Functions) -> Slope:
    """The derivative of a quantity with respect to an input, x in the case, which is `at` another value of it pulled by
    v_0.
    """
    here = f"{path} = {shown(x, facts_at(path).unit)}"
    if x == 0:
        rest = "the limit of a pull forward, which may be another than that of a pull back"
        return Slope(why=f"{here} is {rest if path == OF_RUN else 'zero: give a value of which a share can be varied'}")
    if not np.isfinite(of.main.value):
        return Slope(why="it is infinite")

    def moved(value: float, function: Function) -> float:
        """Slope from the case to another value of the input."""
        there = function.of(at(value), value if path == OF_RUN else v_0)
        return (there - function.value) / (value - x)

    found, unit, lasts = _of_sides(moved, x, of), abs(of.main.value / x), 0.0
    if found.error > AIM * max(abs(found.value), unit) and (finer := of.finer()) is not None:
        lasts, found = found.jump / 2, _of_sides(moved, x, finer)  # a corner is as large in finer runs
    if found.error <= SURE * max(abs(found.value), unit):
        return Slope(found.value, found.error)
    why = "as there is a corner or a jump here" if found.jump > lasts else found.across
    return Slope(why=f"{here}: slope {', '.join(filter(None, (*found.told, why)))}")


class _Sides(NamedTuple):
    """A derivative between the slopes to both sides."""

    told: tuple[str, ...]  #: what there is to either side
    value: float = np.nan
    error: float = np.nan
    jump: float = np.nan  #: half of what the derivatives from above and from below differ; 0 where that is no corner
    across: str = ""  #: what there is to both sides together


def _of_sides(moved: Callable[[float, Function], float], x: float, of: Functions) -> _Sides:
    """The derivative at x of a quantity that has `moved` by so much for each unit at another value."""
    size, sides, told = max(of.main.error, EPS) ** (1 / 3), [], []
    for way, word, wide in ((-1, "below", of.below), (1, "above", of.above)):
        try:
            near, far = (moved(x + way * k * size * abs(x), one) for k, one in ((1, of.main), (2, wide)))
        except ValueError as refusal:
            told.append(f"nothing {word}, as {refusal}")
        else:
            sides.append((near, far))
            told.append(f"{2 * near - far:.6g} {word}")
    if len(sides) < 2:
        return _Sides(tuple(told))
    below, above = sides
    near, far = ((one + two) / 2 for one, two in zip(below, above, strict=True))
    bend = (above[0] - below[0]) / 2
    off_above, off_below = above[1] - above[0] - bend, below[1] - below[0] + bend
    way_out = "" if of.is_one else ", with fewer springs and steps: ask for a smaller accuracy"
    return _Sides(
        told=tuple(told),
        value=near + (near - far) / 3 if of.is_one else near,
        error=UNEVENLY * (abs(off_above) + CHANCE * abs(off_below)) + (EPS / size + of.missed) * abs(of.main.value / x),
        jump=abs(off_above - off_below) / 2 if off_above * off_below < 0 else 0.0,
        across=f"{near:.6g}, {far:.6g} across 1, 2 times {size:.1e} of it to either side{way_out}",
    )
