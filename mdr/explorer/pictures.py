"""What is computed of a state: a curve without a bound on its error, then one with, then what is held at rest.

Both come of the same functions as everywhere, with few points and a coarse accuracy, to be there at once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.closed_forms.critical_velocity import critical_velocity, velocity_scale
from mdr.explorer.state import DECADE, POINTS, UP_TO, State
from mdr.friction.cof_curve import CofCurve, cof_curve, friction_without_bound
from mdr.friction.shaken import HoldingBand, holding_band
from mdr.friction.verdict import verdict
from mdr.march.march import LEAST_ACCURATE
from mdr.march.run import SlidingRun
from mdr.march.slide import slide
from mdr.normal.resolved import plausibility, resolved
from mdr.plots import MODES, edges_of
from mdr.spring.contact_modes import SLIP
from mdr.tools.arrays import Array
from mdr.tools.notation import shown
from mdr.tools.progress import silent, time_limit

RUN = (96, 256)  #: springs and steps of the run, whose picture they are; half as many of the curve without a bound
DIRECTIONS = 72  #: of slip that have their own colours, shaken across
PATIENCE = 8.0  #: s of computing, after which a run that has not settled ends


@dataclass(frozen=True, eq=False)
class Picture:
    """What is shown of a state."""

    state: State
    run: SlidingRun
    v_0: Array  #: velocities of the curve [m/s], (n,)
    cof: Array  #: friction at them [-], (n,)
    v_c: float  #: critical velocity in closed form [m/s]
    v_c_back: float | None  #: the same the other way, None if nothing shakes in the plane
    curve: CofCurve | None = None  #: with a bound on its error; None as long as it has none
    band: HoldingBand | None = None  #: of a contact shaken in the plane

    @property
    def springs(self) -> NDArray[np.uint8]:
        """Modes (n_springs, n_t) of the springs from the middle to `reach`, in equal rows.

        Shaken across, a slip is not SLIP but one of `DIRECTIONS` from len(MODES) on, from -180 degrees.
        """
        x, state = np.asarray(self.run.x), np.asarray(self.run.state)
        if self.run.f_y is not None:
            turns = np.arctan2(self.run.f_y, np.asarray(self.run.f_x)) / (2 * np.pi) + 0.5
            which = len(MODES) + np.minimum(DIRECTIONS * turns, DIRECTIONS - 1).astype(np.uint8)
            state = np.where(state == SLIP, which, state)
        order, rows = np.argsort(x), (np.arange(x.size) + 0.5) / x.size * self.reach
        return state[:, order[np.searchsorted(edges_of(x[order])[1:-1], rows)]].T

    @property
    def reach(self) -> float:
        """Position of the outermost spring [m]."""
        return float(np.max(np.asarray(self.run.x)))

    @property
    def doubts(self) -> tuple[str, ...]:
        """What is unlikely of the case, in sentences."""
        return plausibility(self.state.case)

    @property
    def numbers(self) -> list[tuple[str, str, str]]:
        """Name, value and meaning of what one reads off."""
        run, known = self.run, resolved(self.state.case)
        depth = known.working_depth
        a = float(known.indenter.contact_radius(depth)) if depth > 0 else 0.0
        end = "" if run.settled else ", not settled"
        rows = [("v_c", with_prefix(self.v_c, "m/s"), "critical velocity in closed form")]
        if known.moves_across:
            rows = [("v_c", "infinite", "shaken across, friction is below mu_0 at every velocity")]
        elif self.v_c_back is not None:
            rows.append(("v_c, other way", with_prefix(self.v_c_back, "m/s"), "the same, pulled the other way"))
        else:
            rows.append(("COF at rest", f"{self.cof[0]:.4g}", "limit of friction as v_0 → 0"))
        if self.band is not None:
            held = "mean F_x over F_z at rest, under a rigid pull that stands still"
            rows.append(("band", f"{self.band.low:.4g} to {self.band.high:.4g}", held))
        aside = run.cof_y if abs(run.cof_y) > run.cof_error else 0.0
        return [
            *rows,
            ("COF at v_0", f"{run.cof:.4g} ± {run.cof_error:.1g}{end}", "mean F_x over mean F_z of the run"),
            *([("COF across", f"{aside:.4g}", "mean F_y over mean F_z of the run")] if known.moves_across else []),
            ("stick", f"{100 * run.stick_share:.3g} %", "share of contact time, weighted by force"),
            ("F_z", with_prefix(run.mean_F_z, "N"), "mean load"),
            ("a", with_prefix(a, "m"), "contact radius at the mean depth"),
        ]


def pictures_of(state: State, watch: Callable[[], None] = lambda: None) -> Iterator[Picture]:
    """Pictures of a state, each better than the one before. `watch` may end the work by raising an error."""
    case = state.case
    with silent(watch), time_limit(PATIENCE):
        run = slide(case, state.v_0, n_springs=RUN[0], steps_per_period=RUN[1], record=1, accuracy=LEAST_ACCURATE)
        v_0 = velocities_of(state)
        watch()
        cof = friction_without_bound(case, v_0, RUN[0] // 2, RUN[1] // 2)
        back = critical_velocity(case, -1) if case.is_shaken else None
        first = Picture(state, run, v_0, cof, critical_velocity(case), back)
    yield first
    with silent(watch), time_limit(PATIENCE):
        curve = cof_curve(case, v_0, accuracy=LEAST_ACCURATE)
        second = replace(first, cof=curve.cof, curve=curve)
    yield second
    if case.is_shaken:
        with silent(watch), time_limit(PATIENCE), suppress(ValueError):  # it is not known where no run settles in time
            second = replace(second, band=holding_band(case))
        yield second


def velocities_of(state: State) -> Array:
    """Velocities [m/s] of the curve: to a little beyond v_c, or to the run; both ways where something shakes."""
    scales = [velocity_scale(case) for case in (state.case, state.case.mirrored)]
    forward, back = (min(max(UP_TO * one, 1.1 * abs(state.v_0)), DECADE * one) for one in scales)
    share = np.linspace(0, 1, POINTS // 2 + 1)  # half as fine as elsewhere, to be there at once
    if not state.case.is_shaken:
        return share * forward
    share[0] = share[1] ** 2  # beside zero, where friction of a shaken contact jumps
    return np.concatenate([-back * share[::-1], forward * share])


def with_prefix(value: float, unit: str) -> str:
    """A number with the prefix that suits it; "infinite" where it is."""
    if not np.isfinite(value):
        return "infinite"
    return shown(value, unit, 4)


def verdict_of(case: SlidingContact, watch: Callable[[], None] = lambda: None) -> Iterator[str]:
    """The sentence on how good the closed form is for a case."""
    with silent(watch):
        yield str(verdict(case))
