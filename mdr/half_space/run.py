"""slide() and curve() on the half-space: friction of a case in three dimensions, with bounds on its errors.

Errors come from companions with half of the cells and half of the steps. Twice what they change bounds an error of any
order from 0.6 on: cells and steps are of the first order or better, but for steps in which friction turns by much.
But differences also vanish by chance, as the edges of contact and stick lie in whole cells, and the instants at which
stick begins and ends in whole steps. No error is therefore called smaller than `_least` has it, which contacts with a
closed form were off by at worst (validation/half_space/benchmarks.py). What is left of the start follows from how the
last periods changed.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.case.contact import SlidingContact, require_case
from mdr.case.friction import named_full
from mdr.half_space.friction import Friction, LastPeriod, Settings, contact_of, last_period, stuck
from mdr.half_space.influence import X, Y, Z
from mdr.half_space.steps import Step
from mdr.normal.normal_force import full_cof
from mdr.plots.figures import Axes, Figure
from mdr.tools.arrays import Array
from mdr.tools.checks import count, finite, positive, row, truth, word
from mdr.tools.companions import Companion, bound
from mdr.tools.csv_table import Tabled, csv_text
from mdr.tools.messages import MOST_TOLD
from mdr.tools.progress import time_is_over, time_limit
from mdr.tools.records import ArrayRecord
from mdr.tools.summary import Summarised, Summary, number, span, with_error

PERIODS = 60  #: at most, unless they are given
LEAST_CELLS = 8  #: cells along a side, and steps of a period
SETTLED = 1e-4  #: share of mu_0 that the COF may still change by


@dataclass(frozen=True, eq=False, repr=False)
class HalfSpaceRun(Summarised, Tabled, ArrayRecord):
    """Outcome of `mdr.half_space.slide`, in SI, with the fields of the last period at the ends of its steps.

    Errors bound those of `cof` and of `cof_y`. Axes of fields are instant, x, y.
    """

    cof: float  #: mean F_x over mean F_z in the last period [-]
    cof_y: float  #: mean F_y, across the pull, over mean F_z [-]
    cof_error: float  #: estimated bound on the error of either: grid, step and cycle together, at most 2 full_cof [-]
    grid_error: float  #: part of the cells: twice what half as many change, or more [-]
    step_error: float  #: part of the time steps: twice what half as many change, or more [-]
    cycle_error: float  #: part of the start: what further periods would change [-]
    settled: bool  #: whether cycle_error is within 1e-4 of mu_0
    kind: str  #: "full slip" (no cell sticks), "periodic" or "unsettled"
    why: str  #: what keeps the run from settling and what to change; empty if all is well
    stick_share: float  #: force-weighted share of contact time spent sticking [-]
    mean_F_x: float  #: [N]
    mean_F_y: float  #: [N]
    mean_F_z: float  #: [N]
    v_0: float  #: pulling velocity [m/s]
    mu_0: float  #: local coefficient of friction [-]
    full_cof: float  #: COF of full slip [-]: mu_0, or what a shear strength of the face makes of it
    coupled: bool  #: False: normal-tangential coupling was left out
    cells: int  #: along each side of the grid
    steps_per_period: int  #: time steps of one period
    n_periods: int  #: periods marched
    x: Array  #: (cells,) centres of cells along the pull [m]
    y: Array  #: (cells,) centres of cells across the pull [m]
    t: Array  #: (steps,) time since the least depth [m], of the last period [s]
    pressure: Array  #: (steps, cells, cells) [Pa]
    q_x: Array  #: (steps, cells, cells) traction on the half-space along the pull [Pa]
    q_y: Array  #: (steps, cells, cells) traction across the pull [Pa]
    stick: NDArray[np.bool_]  #: (steps, cells, cells) whether a cell in contact sticks

    def _summary(self) -> Summary:
        size = f"{self.cells} x {self.cells} cells, {self.steps_per_period} steps per period, {self.n_periods} periods"
        parts = f"grid {self.grid_error:.1e}, step {self.step_error:.1e}, cycle {self.cycle_error:.1e}"
        full = named_full(self.full_cof, self.mu_0)
        return Summary(
            f"HalfSpaceRun at v_0 = {number(self.v_0, 'm/s')}{'' if self.coupled else ', without coupling'}",
            [
                ("COF", with_error(self.cof, self.cof_error), f"{self.cof / self.full_cof:.6g} of {full}"),
                ("COF across", with_error(self.cof_y, self.cof_error), "of the force across the pull"),
                ("error", number(self.cof_error), parts),
                ("settled", "yes" if self.settled else "no", self.kind),
                *([("why", self.why, "")] if self.why else []),
                ("stick", f"{self.stick_share:.4g}", "share of the contact time spent sticking, weighted by force"),
                ("mean F_x", number(self.mean_F_x, "N"), "tangential force, which holds the indenter back"),
                ("mean F_y", number(self.mean_F_y, "N"), "the same across the pull"),
                ("mean F_z", number(self.mean_F_z, "N"), "normal force"),
                ("march", size, ""),
            ],
        )

    def table(self) -> str:
        """Time and forces of the last period as CSV.

        Returns
        -------
        str
            What `to_csv` writes.
        """
        cell = (self.x[1] - self.x[0]) ** 2
        forces = {"F_x [N]": self.q_x, "F_y [N]": self.q_y, "F_z [N]": self.pressure}
        return csv_text({"t [s]": self.t} | {name: cell * q.sum(axis=(1, 2)) for name, q in forces.items()})

    def plot(self, instant: float | None = None) -> Figure:
        """Draw the contact from above: pressure, tractions, and what sticks and slips.

        Parameters
        ----------
        instant : float, optional
            Share of the last period, from 0 to 1, from the least depth on. None draws four instants.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
        from mdr.plots.half_space import plot_half_space

        return plot_half_space(self, instant)


@dataclass(frozen=True, eq=False, repr=False)
class HalfSpaceCurve(Summarised, Tabled, ArrayRecord):
    """Friction in three dimensions over the pulling velocity, arrays of shape (n_v,)."""

    v_0: Array  #: pulling velocities [m/s]
    cof: Array  #: average coefficient of friction [-]
    cof_y: Array  #: that of the force across the pull [-]
    cof_error: Array  #: estimated bound on the numerical error of either [-]
    grid_error: Array  #: part of the cells [-]
    step_error: Array  #: part of the time steps [-]
    cycle_error: Array  #: part of the start [-]
    settled: NDArray[np.bool_]  #: whether the run settled
    stick_share: Array  #: force-weighted share of contact time spent sticking [-]
    mu_0: float  #: local coefficient of friction [-]
    full_cof: float  #: COF of full slip [-]: mu_0, or what a shear strength of the face makes of it
    coupled: bool  #: False: normal-tangential coupling was left out
    why: tuple[str, ...]  #: what the runs had to say, "" where nothing

    def _summary(self) -> Summary:
        n, settled = self.v_0.size, int(self.settled.sum())
        parts = ", ".join(f"{name} {getattr(self, f'{name}_error').max():.1e}" for name in ("grid", "step", "cycle"))
        return Summary(
            f"HalfSpaceCurve at {n} velocities, {span(self.v_0, 'm/s')}{'' if self.coupled else ', without coupling'}",
            [
                ("COF", span(self.cof), f"of {named_full(self.full_cof, self.mu_0)}"),
                ("COF across", span(self.cof_y), "of the force across the pull"),
                ("error", span(self.cof_error), f"greatest parts: {parts}"),
                ("settled", f"{settled} of {n}", ""),
                *(("why", why, "") for why in list(dict.fromkeys(filter(None, self.why)))[:MOST_TOLD]),
            ],
        )

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw cof over v_0 with its error bars, and cof_y where something moves across.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw. None makes a new figure.

        Returns
        -------
        matplotlib.axes.Axes
            Where it was drawn.
        """
        from mdr.plots.half_space import plot_half_space_curve

        return plot_half_space_curve(self, ax)

    def table(self) -> str:
        """Velocities, friction, errors and settled as CSV.

        Returns
        -------
        str
            What `to_csv` writes.
        """
        names = ("cof", "cof_y", "cof_error", "grid_error", "step_error", "cycle_error")
        columns = {"v_0 [m/s]": self.v_0} | {f"{name} [-]": getattr(self, name) for name in names}
        return csv_text(columns | {"settled": self.settled.astype(int), "stick_share [-]": self.stick_share})


def slide(
    case: SlidingContact,
    v_0: float,
    *,
    cells: int | None = None,
    steps_per_period: int | None = None,
    n_periods: int | None = None,
    coupled: bool = True,
    start: str = "full_slip",
    limit_s: float | None = None,
) -> HalfSpaceRun:
    """Friction [-] in three dimensions of a contact that slides at v_0 while it is shaken.

    Tractions on the cells of an elastic or Kelvin half-space, each with its own history; friction is a vector.

    Parameters
    ----------
    case : SlidingContact
        The contact: with a rigid pull, a given depth, and an elastic or Kelvin material. Of a load, the depth under it
        is that of `mdr.resolved(case)`.
    v_0 : float
        Pulling velocity [m/s], above zero. Where something shakes in the plane it may be of either sign, or zero.
    cells : int, optional
        Along each side of the grid, from 8 on. None takes 41.
    steps_per_period : int, optional
        Time steps of one period, from 8 on. None takes 100.
    n_periods : int, optional
        None goes on until the friction has settled, for 60 periods at most. A number runs exactly so many.
    coupled : bool
        False leaves out normal-tangential coupling, as springs do.
    start : {"full_slip", "rest"}
        First state, at the least depth. "full_slip": all cells at their limit, along the pull. "rest": no traction
        in the plane.
    limit_s : float, optional
        Seconds of computing. The period after that is the last, and the run is unsettled. None sets no limit.

    Returns
    -------
    HalfSpaceRun
        `cof` and `cof_y` are mean F_x and mean F_y over mean F_z [-], `cof_error` the bound on the error of either.

    Raises
    ------
    TypeError, ValueError
        For what the half-space cannot judge, and for an argument out of range, with a way out.
    mdr.half_space.NotConverged
        If a step did not converge, which more steps or cells may mend.

    See Also
    --------
    mdr.slide : the same by springs, which leave out coupling and, if nothing moves across, slip across.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=6e-6, omega=300.0)
    >>> case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.3), 0.3, oscillation=vibration)
    >>> run = mdr.half_space.slide(case, 2e-4, cells=15, steps_per_period=16)
    >>> f"{run.cof:.2f}", run.settled
    ('0.24', True)
    """
    settings = _settings(case, cells, steps_per_period, n_periods, coupled, start)
    v_0 = _velocity(case, v_0)
    with time_limit(limit_s):
        return _with_errors(case, v_0, settings, Ends())[0]


def curve(
    case: SlidingContact,
    v_0: ArrayLike,
    *,
    cells: int | None = None,
    steps_per_period: int | None = None,
    n_periods: int | None = None,
    coupled: bool = True,
    start: str = "full_slip",
    limit_s: float | None = None,
) -> HalfSpaceCurve:
    """Coefficient of friction [-] in three dimensions over the pulling velocity.

    Parameters
    ----------
    case : SlidingContact
        The contact, as in `mdr.half_space.slide`.
    v_0 : array_like of float, shape (n_v,)
        Pulling velocities [m/s].
    cells, steps_per_period, n_periods, coupled : optional
        Of every run, as in `mdr.half_space.slide`.
    start : {"full_slip", "rest"}
        First state of the highest velocity. Every other one begins where the next higher one ended.
    limit_s : float, optional
        Seconds of computing for all velocities, after which runs end unsettled. None sets no limit.

    Returns
    -------
    HalfSpaceCurve
        Friction and its errors, arrays of shape (n_v,), in the order of the velocities given.

    Raises
    ------
    TypeError, ValueError
        As `mdr.half_space.slide`.
    mdr.half_space.NotConverged
        If a step did not converge.

    Examples
    --------
    >>> import mdr
    >>> shake = mdr.InPlaneOscillation(omega=300.0, du_y=6e-6)
    >>> ball, rubber, depth = mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.3), mdr.ConstantDepth(u_z0=20e-6)
    >>> case = mdr.SlidingContact(ball, rubber, 0.3, oscillation=depth, shake=shake)
    >>> mdr.half_space.curve(case, [3e-4, 2e-3], cells=9, steps_per_period=12).cof.round(2)
    array([0.22, 0.27])
    """
    settings = _settings(case, cells, steps_per_period, n_periods, coupled, start)
    velocities = row("v_0", v_0, "m/s", "velocities")
    asked = [_velocity(case, one) for one in velocities.tolist()]
    runs: dict[int, HalfSpaceRun] = {}
    with time_limit(limit_s):
        near = Ends()
        for place in np.argsort(velocities)[::-1].tolist():
            runs[place], near = _with_errors(case, asked[place], settings, near)
    found = [runs[place] for place in range(len(asked))]
    names = ("cof", "cof_y", "cof_error", "grid_error", "step_error", "cycle_error", "settled", "stick_share")
    columns = {name: np.array([getattr(run, name) for run in found]) for name in names}
    why = tuple(run.why for run in found)
    return HalfSpaceCurve(v_0=velocities, mu_0=case.mu_0, full_cof=full_cof(case), coupled=coupled, why=why, **columns)


# --- what was asked for ---


def _settings(
    case: SlidingContact, cells: int | None, steps: int | None, periods: int | None, coupled: bool, start: str
) -> Settings:
    """How a case is marched; refuses what cannot be."""
    require_case(case)
    truth("coupled", coupled)
    word("start", start, "full_slip", "rest")
    settings = Settings(
        Settings.cells if cells is None else count("cells", cells, LEAST_CELLS),
        Settings.steps if steps is None else count("steps_per_period", steps, LEAST_CELLS),
        PERIODS if periods is None else count("n_periods", periods, 1),
        coupled,
        settled=SETTLED if periods is None else 0.0,
        from_rest=start == "rest",
    )
    contact_of(case, replace(settings, cells=LEAST_CELLS))
    return settings


def _velocity(case: SlidingContact, v_0: Any) -> float:
    if case.is_shaken:
        return finite("v_0", v_0)
    return positive(
        "v_0", v_0, "pulling velocity in m/s, and the other way is the same where nothing shakes in the plane"
    )


# --- runs and their companions ---


class Ends(NamedTuple):
    """Where a run and its companions ended, for others to begin from."""

    fine: Step | None = None
    halved: Step | None = None  #: half of the steps
    wide: Step | None = None  #: half of the cells


def _with_errors(case: SlidingContact, v_0: float, settings: Settings, near: Ends) -> tuple[HalfSpaceRun, Ends]:
    """A run that begins where another one at a near velocity ended, with two companions, and where they ended."""
    fine = last_period(case, v_0, settings, near.fine)
    end, least = fine.steps[-1], _least(case, settings)

    def beside(coarser: Settings, start: Step | None, least: float) -> tuple[Companion, Step | None]:
        """What a coarser run tells of the error, and where it ended."""
        if time_is_over():
            return Companion(2 * full_cof(case)), start
        found = last_period(case, v_0, coarser, start, arrived=start is end)
        one, other = fine.friction, found.friction
        apart = max(abs(one.cof - other.cof), abs(one.cof_y - other.cof_y))
        return Companion(apart, 2.0, least), found.steps[-1]

    grid, wide = beside(replace(settings, cells=(settings.cells + 1) // 2), near.wide, least.cells)
    begin = end if settings.settled else near.halved
    step, halved = beside(replace(settings, steps=settings.steps // 2), begin, least.steps)
    return _record(case, v_0, settings, fine, grid, step), Ends(end, halved, wide)


class Least(NamedTuple):
    """What errors are not called smaller than [-]."""

    cells: float
    steps: float


def _least(case: SlidingContact, settings: Settings) -> Least:
    """The least errors of these cells and steps.

    Pressure rises from the edge of contact like a square root, so that a cell there carries (1/cells)^(3/2). An instant
    of stick that is off by a part of a step changes a force by as small a part, for no longer. A Kelvin material of
    loss tangent T lags by half a step.
    """
    lag = case.T / np.hypot(1.0, case.T)
    by_steps = 1.5 / settings.steps**2 + 0.7 * lag / settings.steps
    full = full_cof(case)
    return Least(cells=0.12 * full / settings.cells**1.5, steps=by_steps * full)


def _record(
    case: SlidingContact, v_0: float, settings: Settings, last: LastPeriod, grid: Companion, step: Companion
) -> HalfSpaceRun:
    found, full = last.friction, full_cof(case)
    rest = found.settling if found.cycles > 1 else 2 * full  # between -full and full no two are further apart
    settled = rest <= SETTLED * full and not time_is_over()
    tractions = np.stack([one.tractions for one in last.steps])
    stick = np.stack([stuck(last.contact, one) for one in last.steps])
    share = float(tractions[:, Z][stick].sum() / tractions[:, Z].sum())
    places = last.contact.half_space.places
    return HalfSpaceRun(
        **{name: getattr(found, name) for name in ("cof", "cof_y", "mean_F_x", "mean_F_y", "mean_F_z")},
        cof_error=min(bound(grid, step, Companion(rest)), 2 * full),
        grid_error=grid.error,
        step_error=step.error,
        cycle_error=rest,
        settled=settled,
        kind="unsettled" if not settled else "periodic" if share else "full slip",
        why="" if settled else "; ".join(_why_not(found, rest / full)),
        stick_share=share,
        v_0=v_0,
        mu_0=case.mu_0,
        full_cof=full,
        coupled=settings.coupled,
        cells=settings.cells,
        steps_per_period=settings.steps,
        n_periods=found.cycles,
        x=places,
        y=places,
        t=case.period * np.arange(1, settings.steps + 1) / settings.steps,
        pressure=tractions[:, Z],
        q_x=tractions[:, X],
        q_y=tractions[:, Y],
        stick=stick,
    )


def _why_not(found: Friction, left: float) -> Iterator[str]:
    """Why a run has not settled, and what helps; left: what is not settled, over mu_0."""
    if time_is_over():
        yield f"the time limit was reached after {found.cycles} periods: raise limit_s"
    if left > SETTLED:
        change = f"F_x or F_y may still change by {100 * left:.2g} % of mu_0 F_z"
        yield change if time_is_over() else f"{change} after {found.cycles} periods: raise n_periods"
