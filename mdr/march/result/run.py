"""Results of a march, in SI: SlidingRun, its modes, its energies and its recorded periods.

Sign and symbols: F_x > 0 holds back an indenter that is pulled forward [N], F_z > 0 presses [N], v_0 pulling velocity
[m/s], u_x position of the indenter [m].
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from os import PathLike
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.case.friction import named_full
from mdr.march.dynamics.energy import EnergyBalance, does_not_close, energy_balance
from mdr.march.dynamics.state import UNKNOWN
from mdr.march.dynamics.stepper import TOLERANCE, PeriodRecord, stick_share
from mdr.march.periodic.settling import LATE, MIN_PERIODS
from mdr.march.periodic.steady import MarchEnd, too_coarse
from mdr.march.periodic.waiting import NO_STEP
from mdr.march.result.look import looked_at, may_rest_elsewhere
from mdr.normal.normal_force import full_cof
from mdr.spring.contact_modes import State
from mdr.spring.energies import LEAST_SLIP
from mdr.tools.arrays import EXACT, Array, beyond
from mdr.tools.csv_table import Tabled, csv_text
from mdr.tools.records import ArrayRecord
from mdr.tools.summary import Summarised, Summary, number, with_error

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HOLDS = (
    "the contact holds: at rest it may stay in many states, of which this is one, and cof_error is the error of this "
    "one alone; ask {}(case) for all that it holds"
)


@dataclass(frozen=True, eq=False, repr=False)
class SlidingRun(Summarised, Tabled, ArrayRecord):
    """Outcome of slide(), in SI. Arrays are kept only with `record`; otherwise they are None.

    A run at v_0 = 0 whose contact holds may come to rest in many states (`kind` "holds"): `cof` is that of one of them,
    and `cof_error` does not bound how far the others are from it; `holding_band` tells all, and of a body on a spring
    `blocked_cof` does.

    Recorded forces are those at the end of a step; `cof` is of their exact mean over each step, so that mean F_x over
    mean F_z of the record differs from it, by less the more steps there are.
    """

    cof: float  #: mean F_x over mean F_z in whole periods [-]
    cof_y: float  #: mean F_y, across the pull, over mean F_z [-]
    cof_error: float  #: bound on the numerical error of both, estimated; 2 full_cof, all there can be, if unsettled [-]
    #: whether the motion is periodic: solved for, or windows of periods agree and its beat is over; where friction
    #: falls, also whether a long run tells its mean, with a statistical error in cof_error
    settled: bool
    kind: str  #: "full slip", "periodic", "period-2" ..., "averaged", "quasi-periodic", "holds" or "unsettled"
    #: what keeps the run from settling and what to change, or what cof_error leaves out, or another motion that goes on
    #: from the other start; empty if all is well
    why: str
    stick_share: float  #: force-weighted share of contact time spent sticking [-]
    least_slip: float  #: smallest slip velocity, along the pull, of the springs in contact in that time [m/s]
    mean_F_x: float  #: [N]
    mean_F_y: float  #: [N]
    mean_F_z: float  #: [N]
    energy_balance: EnergyBalance  #: of one of the last periods, or a mean over those after which the motion comes back
    v_0: float  #: pulling velocity [m/s]
    mu_0: float  #: local coefficient of friction [-]
    full_cof: float  #: COF of full slip, with nothing lost [-]: mu_0, or what a shear strength makes of it
    omega: float  #: of the oscillation [rad/s]
    n_springs: int  #: springs at x >= 0, each for the pair +x, -x
    steps_per_period: int  #: time steps of one period
    n_periods: int  #: periods marched
    t: Array | None = None  #: (n_t,) instants [s]
    u_x: Array | None = None  #: (n_t,) position of the indenter [m]: of the body, with what shakes the tool
    u_z: Array | None = None  #: (n_t,) depth [m]
    F_x: Array | None = None  #: (n_t,) tangential force at the end of a step [N]
    F_z: Array | None = None  #: (n_t,) normal force at the end of a step [N]
    x: Array | None = None  #: (n_springs,) positions [m]
    width: Array | None = None  #: (n_springs,) 2 dx, both sides of the contact [m]
    e: Array | None = None  #: (n_t, n_springs) tangential extensions [m]
    s: Array | None = None  #: (n_t, n_springs) normal compressions [m]
    f_x: Array | None = None  #: (n_t, n_springs) tangential forces of the springs, pairs at +x and -x [N]
    f_z: Array | None = None  #: (n_t, n_springs) normal forces [N]
    state: NDArray[np.uint8] | None = None  #: (n_t, n_springs) modes, see State; slip in any direction is SLIP
    u_y: Array | None = None  #: (n_t,) position of the indenter across the pull [m]; None where nothing moves there
    F_y: Array | None = None  #: (n_t,) force across at the end of a step [N]
    e_y: Array | None = None  #: (n_t, n_springs) extensions across [m]
    strength: Array | None = None  #: (n_t, n_springs) limit of friction besides mu_0 f_z [N]; None without tau_0
    f_y: Array | None = None  #: (n_t, n_springs) forces across [N], which have the direction of slip where it slips

    @property
    def periods(self) -> int | None:
        """After how many periods of the vibration the motion repeats itself; None where it does not, or was not seen
        to. Shares, energies and powers are means over them, or over 16 periods of a motion that does not.
        """
        if not self.settled or not self.kind.startswith(("full slip", "period")):
            return None
        return int(self.kind.removeprefix("period-")) if "-" in self.kind else 1

    @property
    def share(self) -> float:
        """`cof` over that of full slip [-]: what is left of friction; cof/mu_0 where the face has no shear strength."""
        return self.cof / self.full_cof

    @property
    def power(self) -> dict[str, float]:
        """Mean power [W] of one of the last periods: from "pull", "shake" and "normal" drive, and "lost" as heat.

        What is within the residual of the balance is 0. Below 0 a drive takes power up: a pull that is driven.
        """
        spent = self.energy_balance
        works = np.array([spent.pull_work, spent.shake_work, spent.normal_work, spent.lost])
        watts = self.omega / (2 * np.pi) * beyond(abs(spent.residual) + EXACT * np.abs(works).max(), works)
        return dict(zip(("pull", "shake", "normal", "lost"), watts.tolist(), strict=True))

    @property
    def mirrored(self) -> SlidingRun:
        """The run seen from the other side, which goes the other way."""
        turned = {name: _turned(getattr(self, name)) for name in ("v_0", "cof", "mean_F_x", "u_x", "F_x", "e", "f_x")}
        state = self.state
        if state is not None and self.f_y is None:
            state = np.array([State.FREE, State.STICK, State.SLIP_BACK, State.SLIP], dtype=state.dtype)[state]
        return replace(self, **turned, state=state)

    def _summary(self) -> Summary:
        spent = self.energy_balance
        kept = "none; slide(..., record=1) keeps forces and springs" if self.t is None else f"{self.t.size} instants"
        size = f"{self.n_springs} springs, {self.steps_per_period} steps per period, {self.n_periods} periods"
        missing = f"missing from the balance of one period, {spent.lost:.4g} J lost in it"
        across = ("COF across", with_error(self.cof_y, self.cof_error), "mean F_y/mean F_z")
        rows = [
            (
                "COF",
                with_error(self.cof, self.cof_error),
                f"{self.share:.6g} of {named_full(self.full_cof, self.mu_0)}",
            ),
            ("settled", "yes" if self.settled else "no", self.kind),
            *([("why", self.why, "")] if self.why else []),
            ("stick", f"{self.stick_share:.4g}", "share of the contact time spent sticking, weighted by force"),
            *([across] if abs(self.cof_y) > self.cof_error else []),
            ("mean F_x", number(self.mean_F_x, "N"), "tangential force, which holds the indenter back"),
            ("mean F_z", number(self.mean_F_z, "N"), "normal force"),
            ("energy", f"{spent.residual:.1e} J", missing),
            ("power", *power_text(self.power)),
            ("march", size, ""),
            ("record", kept, ""),
        ]
        return Summary(f"SlidingRun at v_0 = {number(self.v_0, 'm/s')}", rows)

    def table(self) -> str:
        """Time, position, depth and forces of the recorded periods as CSV.

        Returns
        -------
        str
            What `to_csv` writes.

        Raises
        ------
        ValueError
            For a run without a record.
        """
        if self.t is None:
            raise ValueError("the run kept no arrays to write; call slide(case, v_0, record=1) to keep a period")
        columns = {"t [s]": self.t, "u_x [m]": self.u_x, "u_z [m]": self.u_z, "F_x [N]": self.F_x, "F_z [N]": self.F_z}
        if self.u_y is not None and self.F_y is not None:
            columns |= {"u_y [m]": self.u_y, "F_y [N]": self.F_y}
        return csv_text(columns)

    def plot(self) -> Figure:
        """Draw what was recorded: the mode of every spring over time, and the forces below.

        Shaken across, a spring that slips has the colour of its direction of slip.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
        from mdr import plots

        return plots.plot_run(self)

    def animate(self, path: str | PathLike[str] = "springs.gif", frames: int = 60, title: str | None = None) -> Any:
        """Write a GIF that shows the springs move over the recorded periods; see `mdr.plots.animation`.

        Parameters
        ----------
        path : str or path-like
            The file, ending in .gif.
        frames : int
            Number of pictures of one period.
        title : str, optional
            What stands above them. None: velocity and friction.

        Returns
        -------
        mdr.plots.animation.Gif
            The file; a notebook shows it.

        Raises
        ------
        ValueError
            For a run without a record, or another ending of the path.
        """
        from mdr.plots.animation import animate_springs

        return animate_springs(self, path, frames, title)


def power_text(power: Mapping[str, float]) -> tuple[str, str]:
    """The power [W] that is lost, and which drives it comes from; those that give none are left out."""
    drives = {"shake": "the shake", "normal": "the normal drive", "pull": "the pull"}
    told = ", ".join(f"{number(power[one], 'W')} from {its}" for one, its in drives.items() if power[one])
    return number(power["lost"], "W"), told


def _turned(values: Any) -> Any:
    return None if values is None else 0.0 - values  # no -0.0


class Found(NamedTuple):
    """What a run has found of friction, in SI."""

    cof: float  #: as of SlidingRun, and what follows
    cof_y: float
    cof_error: float
    settled: bool
    kind: str  #: but for "full slip", of which springs tell
    why: str


def friction_of(end: MarchEnd) -> Found:
    """The friction of a march. A close look at springs and energies is not taken where these cannot tell against it.

    They can where steps damp what they do not resolve: the oscillation of a body with mass that is stepped as a light
    one (body.py).
    """
    if end.scaled.body.light and end.scaled.body.M:
        run = finish(end)
        return Found(*(getattr(run, name) for name in Found._fields))
    end, accounts, _ = looked_at(end)
    return _found(end, accounts[0])


def _found(end: MarchEnd, account: PeriodRecord) -> Found:
    """The friction of a march whose last periods were marched."""
    error, why = end.error or 0.0, "" if end.error is not None else "no companion run: cof_error holds settling only"
    case, settling, full = end.case, end.settling, full_cof(end.case)
    error += end.hidden_error + case.cycle.lost_in_digits
    own = settling.spread + EXACT  # error of the mean over a period, whatever the steps miss
    cof, across = beyond(own if settling.settled else 0.0, (settling.mean, settling.across)).tolist()
    kind = settling.kind
    if settling.settled and may_rest_elsewhere(end, account):
        holds = HOLDS.format("holding_band" if case.pull.is_rigid else "blocked_cof")
        if not (case.pull.is_rigid or case.is_shaken_at_pull):
            holds += ", and holding_band(case) for what it holds under a rigid pull"
        kind, why = "holds", "; ".join(filter(None, (holds, why)))
    return Found(
        cof=full * cof,
        cof_y=full * across,
        cof_error=full * (min(error + own, UNKNOWN) if settling.settled else UNKNOWN),
        settled=settling.settled,
        kind=kind,
        why=why if settling.settled else _why_not(end),
    )


def finish(end: MarchEnd) -> SlidingRun:
    """The run of a march, after a close look at its last periods, in SI."""
    end, accounts, record = looked_at(end)
    account, balance = accounts[0], energy_balance(end.stepper, accounts)
    open_account = does_not_close(balance, end.stepper, account, (end.error or 0.0) + end.settling.spread)
    if end.settling.settled and open_account:
        end = end.unsettled(open_account, contradicts=True)
    if not account.sees_contact:
        raise too_coarse(end.scaled.drive.steps)
    case, scaled, settling, sticks = end.case, end.scaled, end.settling, stick_share(accounts)
    found, mean_F_z = _found(end, account), scaled.normal.mean * (scaled.units.stiffness_z * scaled.units.length_z)
    if found.kind != "holds" and found.settled and sticks == 0 and abs(1 - settling.mean) <= TOLERANCE:
        found = found._replace(kind="full slip")
    return SlidingRun(
        **found._asdict(),
        stick_share=sticks,
        least_slip=min(float(one.seen.sums[LEAST_SLIP]) for one in accounts) * scaled.units.speed,
        mean_F_x=found.cof * mean_F_z,
        mean_F_y=found.cof_y * mean_F_z,
        mean_F_z=mean_F_z,
        energy_balance=balance,
        v_0=end.v_0,
        mu_0=case.mu_0,
        full_cof=full_cof(case),
        omega=scaled.units.omega,
        n_springs=end.resolution.n_springs,
        steps_per_period=scaled.drive.steps,
        n_periods=end.n_periods,
        **(_recorded(end, record) if end.resolution.record else {}),
    )


def _why_not(end: MarchEnd) -> str:
    settling, n = end.settling, end.n_periods
    if end.v_0 == 0 and not end.case.pull.is_rigid and not settling.contradicts:
        why = settling.why or f"F_x still changes after {n} periods"
        return f"{why}: ask blocked_cof(case) for what the body holds at rest"
    if settling.why == NO_STEP:
        return f"{NO_STEP}: raise steps_per_period, or hold the indenter rigidly"
    if settling.contradicts:
        return f"{settling.why}: change start or steps_per_period"
    if LATE in settling.why:
        return f"{settling.why}: raise v_0 or n_periods, or ask cof_curve(case, [0]) for the limit of a slow pull"
    if settling.why:
        return f"{settling.why}: raise {'limit_s' if 'time limit' in settling.why else 'n_periods or c_x'}"
    if n < MIN_PERIODS:
        return f"{n} periods are too few to compare windows: raise n_periods to {MIN_PERIODS} or more"
    if end.resolution.start == "rest" and n < end.pre_sliding:
        return f"a start from rest takes {end.pre_sliding:.3g} periods to stretch the springs: start from full slip"
    change = f"F_x still changes by {100 * settling.spread:.2g} % of mu_0 F_z between windows after {n} periods"
    if end.scaled.body.M and end.scaled.body.C == 0:
        return f"{change}: a body without damper loses its free oscillation slowly; raise n_periods, or add c_x"
    from_rest = end.resolution.start != "full_slip"
    return f"{change}: raise n_periods" + (" or start from full slip" if from_rest else "")


def _recorded(end: MarchEnd, records: list[PeriodRecord]) -> dict[str, Any]:
    """The last periods in SI, springs that stand alike each for itself."""
    scaled, springs = end.scaled, end.springs
    F_x, F_z, F_y, y, e, s, f, f_z, mode = (
        np.concatenate(parts) for parts in zip(*(_arrays(record) for record in records), strict=True)
    )
    step = np.arange(1, F_x.size + 1)
    t = (end.n_periods - end.resolution.record) * end.case.period + step * scaled.drive.h / scaled.units.omega
    if scaled.slow.rho:  # they have relaxed about the mean, from which the stiffer springs were counted
        s = s + scaled.slow.sunk
        e = e + scaled.slow.rho * e.mean(axis=0)
    n = scaled.n_alike
    if n > 1:
        e, s, f, f_z, mode = (np.repeat(one, n, axis=1) for one in (e, s, f, f_z, mode))
    phase = step % scaled.drive.steps
    share, side = springs.width / springs.width.sum(), scaled.drive.across
    across: dict[str, Any] = {}
    if side is not None:
        across = {
            "u_y": (y.imag + side.x[phase]) * scaled.units.length_x,
            "F_y": F_y * scaled.units.stiffness_x * scaled.units.length_x,
            "e_y": e.imag * scaled.units.length_x,
            "f_y": f.imag * share * scaled.units.stiffness_x * scaled.units.length_x,
        }
    for name, one in scaled.limit.beside((phase - 1) % scaled.drive.steps).items():
        across[name] = one * (mode != State.FREE) * share * scaled.units.stiffness_x * scaled.units.length_x
    return across | {
        "t": t,
        "u_x": end.v_0 * t + (y.real + scaled.drive.along.x[phase]) * scaled.units.length_x,
        "u_z": end.case.cycle.u_z0 + scaled.units.length_z * scaled.drive.z[phase],
        "F_x": F_x * scaled.units.stiffness_x * scaled.units.length_x,
        "F_z": F_z * scaled.units.stiffness_z * scaled.units.length_z,
        "x": springs.x,
        "width": springs.width,
        "e": e.real * scaled.units.length_x,
        "s": s * scaled.units.length_z,
        "f_x": f.real * share * scaled.units.stiffness_x * scaled.units.length_x,
        "f_z": f_z * share * scaled.units.stiffness_z * scaled.units.length_z,
        "state": mode,
    }


def _arrays(record: PeriodRecord) -> tuple[Array | NDArray[np.uint8], ...]:
    """A period as it is kept, at the ends of its steps."""
    seen = record.seen
    forces = seen.F[:, 0], seen.F[:, 1], seen.F[:, 3]
    springs = seen.e, seen.s, seen.f, seen.f_z
    return *forces, record.u[1:], *springs, seen.mode.astype(np.uint8)
