"""What is computed of a state: closed forms, which compile nothing, then a run and a curve, then a bound on its error.

All come of the same functions as everywhere, with few points and a coarse accuracy, to be there at once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from mdr.case.domain import domain_of
from mdr.case.pull import RigidPull
from mdr.closed_forms.critical_velocity import POINTS, UP_TO, critical_velocity, velocity_scale
from mdr.closed_forms.full_slip import static_cof
from mdr.closed_forms.rigid_pull import average_friction
from mdr.explorer.state import DECADE, State
from mdr.friction.cof_curve import CofCurve, cof_curve, friction_without_bound
from mdr.friction.shaken import HoldingBand, holder_of, holding_band
from mdr.march.periodic.steady import LEAST_ACCURATE
from mdr.march.result.run import SlidingRun
from mdr.march.result.slide import slide
from mdr.normal.normal_force import mean_normal_force
from mdr.normal.resolved import plausibility, resolved
from mdr.tools.arrays import Array
from mdr.tools.compiling import TALLY
from mdr.tools.notation import shown
from mdr.tools.progress import silent, time_limit

#: springs and steps of the run, whose picture they are: few at first, which are there at once even uncompiled, then
#: many; half as many of the curve without a bound
GRIDS = ((32, 64), (96, 256))
WAITS = "…"  #: for a number that is being computed


@dataclass(frozen=True, eq=False)
class Picture:
    """What is shown of a state."""

    state: State
    v_0: Array  #: velocities of the curve [m/s], (n,)
    v_c: float  #: critical velocity in closed form [m/s]
    v_c_back: float | None  #: the same the other way, None if nothing shakes in the plane
    static: float | None = None  #: limit of friction as v_0 -> 0 [-], if nothing shakes in the plane
    load: float | None = None  #: mean normal force [N]
    rigid: Array | None = None  #: friction at them under a rigid pull [-], (n,), where that is known in closed form
    run: SlidingRun | None = None
    cof: Array | None = None  #: friction at them [-], (n,)
    curve: CofCurve | None = None  #: with a bound on its error; None as long as it has none
    band: HoldingBand | None = None  #: of a contact shaken in the plane

    @property
    def doubts(self) -> tuple[str, ...]:
        """What is unlikely of the case, in sentences."""
        return plausibility(self.state.case)

    @property
    def ends(self) -> list[float]:
        """The critical velocities [m/s]: of a pull forward, and below 0 of one the other way where it has its own."""
        return [self.v_c, *([] if self.v_c_back is None else [-self.v_c_back])]

    @property
    def numbers(self) -> list[tuple[str, str, str]]:
        """Name, value and meaning of what one reads off, and of the run a dot each as long as it is computed."""
        run, known = self.run, resolved(self.state.case)
        depth = known.working_depth
        a = float(known.indenter.contact_radius(depth)) if depth > 0 else 0.0
        rows = [("v_c", shown(self.v_c, "m/s", 4), "critical velocity in closed form")]
        if known.moves_across:
            rows = [("v_c", "infinite", "shaken across, friction is full at no velocity")]
        elif self.v_c_back is not None:
            rows.append(("v_c, other way", shown(self.v_c_back, "m/s", 4), "the same, pulled the other way"))
        elif self.static is not None:
            rows.append(("static COF", f"{self.static:.4g}", "limit of friction as v_0 → 0"))
        if self.band is not None:
            held = f"mean F_x over F_z at rest, under {holder_of(known)}"
            rows.append(("band", f"{self.band.low:.4g} to {self.band.high:.4g}", held))
        cof = across = stick = WAITS
        if run is not None:
            cof = f"{run.cof:.4g} ± {run.cof_error:.1g}{'' if run.settled else ', not settled'}"
            across = f"{run.cof_y if abs(run.cof_y) > run.cof_error else 0.0:.4g}"
            stick = f"{100 * run.stick_share:.3g} %"
        return [
            *rows,
            ("COF at v_0", cof, "mean F_x over mean F_z of the run"),
            *([("COF across", across, "mean F_y over mean F_z of the run")] if known.moves_across else []),
            ("stick", stick, "share of contact time, weighted by force"),
            ("F_z", WAITS if self.load is None else shown(self.load, "N", 4), "mean load"),
            ("a", shown(a, "m", 4), "contact radius at the mean depth"),
        ]


def pictures_of(state: State, watch: Callable[[], None] = lambda: None) -> Iterator[Picture]:
    """Pictures of a state, each better than the one before. `watch` may end the work by raising an error."""
    picture = at_once(state)
    yield picture
    steps: list[Callable[[Picture], Picture]] = []
    for grid in GRIDS:
        steps += [partial(one, grid) for one in ([_run] if picture.curve else [_run, _first_sight])]
    steps += [_bounded] if picture.curve is None else []
    for better in (*steps, *([_held] if state.case.is_shaken else [])):
        with silent(watch):
            picture = _in_time(better, picture)
        yield picture


def _in_time(better: Callable[[Picture], Picture], picture: Picture) -> Picture:
    """What becomes of a picture within eight seconds of computing; once more where compiling was what took the time."""
    for _ in range(2):
        before = TALLY.done
        with time_limit(8.0):
            after = better(picture)
        if TALLY.done == before:
            break
    return after


def at_once(state: State) -> Picture:
    """What is known in closed form and needs nothing to be compiled."""
    case, v_0 = resolved(state.case), velocities_of(state)
    back = critical_velocity(case, -1) if case.is_shaken else None
    picture = Picture(state, v_0, critical_velocity(case), back)
    if case.material.contact_arms:  # their normal force is followed spring by spring
        return picture
    picture = replace(picture, load=mean_normal_force(case))
    if case.is_shaken:
        return picture
    if case in domain_of(static_cof):
        picture = replace(picture, static=static_cof(case))
    pulled_rigidly = replace(case, pull=RigidPull())
    if pulled_rigidly not in domain_of(average_friction):
        return picture
    rigid = cof_curve(pulled_rigidly, v_0)
    return replace(picture, cof=rigid.cof, curve=rigid) if case.pull.is_rigid else replace(picture, rigid=rigid.cof)


def _run(grid: tuple[int, int], picture: Picture) -> Picture:
    """With a run at v_0."""
    springs, steps = grid
    case, v_0 = picture.state.case, picture.state.v_0
    run = slide(case, v_0, n_springs=springs, steps_per_period=steps, record=1, accuracy=LEAST_ACCURATE)
    return replace(picture, run=run, load=run.mean_F_z)


def _first_sight(grid: tuple[int, int], picture: Picture) -> Picture:
    """With a curve, whose error is not known; at v_0 it is that of the run."""
    springs, steps = grid
    cof = friction_without_bound(picture.state.case, picture.v_0, springs // 2, steps // 2)
    if picture.run is not None:
        cof[picture.v_0 == picture.state.v_0] = picture.run.cof
    return replace(picture, cof=cof)


def _bounded(picture: Picture) -> Picture:
    """With a curve whose error is bounded."""
    curve = cof_curve(picture.state.case, picture.v_0, accuracy=LEAST_ACCURATE)
    return replace(picture, cof=curve.cof, curve=curve, static=curve.static_cof)


def _held(picture: Picture) -> Picture:
    """With what is held at rest; it is not known where no run settles in time."""
    with suppress(ValueError):
        return replace(picture, band=holding_band(picture.state.case))
    return picture


def velocities_of(state: State) -> Array:
    """Velocities [m/s] of the curve: to a little beyond v_c, or to the run; both ways where something shakes."""
    scales = [velocity_scale(case) for case in (state.case, state.case.mirrored)]
    forward, back = (min(max(UP_TO * one, 1.1 * abs(state.v_0)), DECADE * one) for one in scales)
    share = np.linspace(0, 1, POINTS // 2 + 1)  # half as fine as elsewhere, to be there at once
    own = [state.v_0] if -back <= state.v_0 <= forward else []
    share = share if state.case in domain_of(static_cof) else share[1:]  # the limit at rest may not be known
    if not state.case.is_shaken:
        return np.unique([*(share * forward), *own])
    share[0] = share[0] or share[1] ** 2  # beside zero, where friction of a shaken contact jumps
    return np.unique([*(-back * share), *(forward * share), *own])
