"""Derivatives of friction, and of what is in closed form, with respect to one input of a case.

Each is a central difference, D(h) = (f(x + h) - f(x - h))/2h. An error of f moves it by its share over h, and it misses
the derivative by h²: so h, over x, is the cube root of the relative error of f. D(2h) misses four times as much. The
error is |D(h) - D(2h)|, what rounding leaves, and half of the difference between the derivatives from below and from
above. With the slope S(h) to one side these are 2 S(h) - S(2h). Of a smooth f they differ by no more than its error
brings about; at a corner by what the slope jumps.

In closed form D(h) + (D(h) - D(2h))/3 is the answer. Elsewhere f is friction of runs of one resolution, that of a run
as accurate as asked for, and D(h) the answer. What springs and steps miss is almost the same in all these runs, and
falls out. Larger differences, D(2h) and D(3h), are of runs with 1/2 and with 3/8 of both numbers: how far neighbours
are apart, one and a half times the greater of two, bounds what springs and steps leave of the error, too.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.case.paths import facts_at
from mdr.friction.cof_curve import counted, friction_at
from mdr.friction.inputs import OF_RUN
from mdr.march.periodic.steady import MOST_ACCURATE, MarchEnd, Resolution, steady
from mdr.march.result.refinement import UNEVENLY, companions, resolution_of, within
from mdr.march.result.run import friction_of
from mdr.normal.normal_force import full_cof
from mdr.normal.resolved import resolved
from mdr.tools.arrays import EPS, Array
from mdr.tools.notation import shown

#: error up to which there is a derivative, over the greater of itself and the quantity over the input
SURE = 0.01


class Function(NamedTuple):
    """A quantity of a case at a velocity."""

    of: Callable[[SlidingContact, float], float]
    value: float  #: of the case that is asked for
    error: float  #: relative, by which values of cases close by scatter


class Slope(NamedTuple):
    """A derivative in SI, and its error; or why there is none."""

    value: float = np.nan
    error: float = np.nan
    why: str = ""


def closed_form(case: SlidingContact, law: Callable[[SlidingContact], float]) -> list[Function]:
    """A quantity that is good to rounding."""
    return 2 * [Function(lambda one, _: law(one), float(law(case)), EPS)]


def friction(case: SlidingContact, v_0: float, accuracy: float) -> list[Function]:
    """Friction at a velocity, and as it is known more coarsely: of runs at the resolution of one that is as accurate.

    Raises ValueError where it does not settle.
    """
    if counted(case, v_0)[1]:
        return _runs(case, v_0, accuracy)
    value, error, why = friction_at(case, v_0, accuracy)
    _settled(value, why)

    def of(one: SlidingContact, speed: float) -> float:
        cof, _, why = friction_at(one, speed, accuracy)
        return _settled(cof, why)

    return 2 * [Function(of, value, error / full_cof(case))]


def _settled(cof: float, why: str) -> float:
    """Friction that has settled. ValueError of another, and why it has not."""
    if why:
        raise ValueError(why)
    return cof


def _runs(case: SlidingContact, v_0: float, accuracy: float) -> list[Function]:
    """Friction of runs at three resolutions, each begun in the periodic state that one of the case has come to."""
    known, speed = _forward(case, v_0)
    end = within(known, speed, resolution_of(known, None, None, accuracy))
    found = friction_of(end)
    _settled(found.cof, "" if found.settled else f"the run did not settle: {found.why}")
    beside, functions = companions(known, end.resolution), []
    is_full = end.slips_fully and not end.error  # of finer runs, too; coarser ones may stick
    for size in (end.resolution, *(() if is_full else (beside.half, beside.less))):
        resolution = size._replace(bounded=False, accuracy=MOST_ACCURATE)
        end = steady(known, speed, resolution, near=end.to_begin_from)
        of = _of_resolution(resolution, end)
        functions.append(Function(of, _of_end(end, v_0), end.settling.spread))
    return 2 * functions if is_full else functions


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


def slope(at: Callable[[float], SlidingContact], path: str, x: float, v_0: float, functions: list[Function]) -> Slope:
    """The derivative with respect to an input, x in the case, which is `at` another value of it pulled by v_0.

    functions: the quantity, and what it is in differences of twice the size, and so on.
    """
    main, here = functions[0], f"{path} = {shown(x, facts_at(path).unit)}"
    if x == 0:
        rest = "the limit of a pull forward, which may be another than that of a pull back"
        return Slope(why=f"{here} is {rest if path == OF_RUN else 'zero: give a value of which a share can be varied'}")
    if not np.isfinite(main.value):
        return Slope(why="it is infinite")
    size = max(main.error, EPS) ** (1 / 3)

    def to(value: float, function: Function) -> float:
        """Slope from the case to another value of the input."""
        moved = function.of(at(value), value if path == OF_RUN else v_0)
        return (moved - function.value) / (value - x)

    sides: list[Array] = []
    told = []
    for way, word in ((-1, "below"), (1, "above")):
        try:
            slopes = np.array([to(x + way * k * size * abs(x), one) for k, one in enumerate(functions, 1)])
        except ValueError as refusal:
            told.append(f"nothing {word}, as {refusal}")
        else:
            sides.append(slopes)
            told.append(f"{2 * slopes[0] - slopes[1]:.6g} {word}")
    if len(sides) == 2:
        below, above = sides
        found = _across(below, above, main.value / x, size, is_one=functions[1] is main)
        if not found.why:
            return found
        told.append(found.why)
    return Slope(why=f"{here}: slope {', '.join(told)}")


def _across(below: Array, above: Array, unit: float, size: float, is_one: bool) -> Slope:
    """The derivative between slopes to both sides; is_one: whether of one function; unit: it over the input."""
    across = (below + above) / 2
    moved = (1.0 if is_one else UNEVENLY) * np.abs(np.diff(across)).max()
    jump = abs((2 * above[0] - above[1]) - (2 * below[0] - below[1])) / 2
    value = across[0] + (across[0] - across[1]) / 3 if is_one else across[0]
    error = moved + jump + EPS / size * abs(unit)
    if error <= SURE * max(abs(value), abs(unit)):
        return Slope(float(value), float(error))
    if jump > moved:
        return Slope(why="as there is a corner or a jump here")
    way_out = "" if is_one else ", with ever fewer springs and steps: ask for a smaller accuracy"
    steps = ", ".join(f"{one:.6g}" for one in across)
    return Slope(why=f"{steps} across 1, 2, ... times {size:.1e} of it to either side{way_out}")
