"""slide(): march a sliding contact, every spring with its own stick/slip state, and say what came out.

The one bridge to the compiled march. A run starts on the full-slip solution (or from rest), goes on until windows of
periods agree (settling.py), and looks closely at its last period: modes, forces and energies. Beside it run two
companions, one with half the steps and one with half the springs. The scheme is of second order in both, so the
difference to a companion is three times the error, and their sum with the spread of the windows bounds the error of
the COF.

Sign and symbols: F_x > 0 holds the indenter back [N], F_z > 0 presses [N], v_0 pulling velocity [m/s], u_x position
of the body [m].
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr import kernels
from mdr.checks import positive
from mdr.contact import SlidingContact
from mdr.scaled import RESOLVED, ScaledContact, fast_ratio
from mdr.settling import Settling, judge
from mdr.springs import SpringArray

Array = NDArray[np.float64]

TOLERANCE = 1e-6  #: of cof/mu_0 between windows of a settled run
SWING_TOLERANCE = 1e-3  #: of the swing of the body between windows, over v_0/omega
BUDGET = 1e-5  #: of cof/mu_0, what the default knobs are to meet
MAX_PERIODS = {"rigid": 65536, "spring": 8192}  #: after which a run is called unsettled
_N_SPRINGS, _STEPS = 384, 1024  # first choice; doubled while cof_error exceeds the budget


class State(IntEnum):
    """Mode of a spring."""

    FREE = kernels.FREE  #: out of contact
    STICK = kernels.STICK  #: its foot rests on the indenter
    SLIP = kernels.SLIP  #: slides forward, friction holds the indenter back
    SLIP_BACK = kernels.SLIP_BACK  #: slides backward, friction drives the indenter on


@dataclass(frozen=True)
class EnergyBalance:
    """Energies [J] of the observed periods, each from its own definition.

    pull_work + normal_work = friction_loss + viscous_loss + damper_loss + stored_change, up to the residual of the
    scheme.
    """

    pull_work: float  #: of the far end of the pull, v_0 times the pulling force
    normal_work: float  #: of the normal drive, F_z u_z'
    friction_loss: float  #: mu_0 F_z times the slip velocity
    viscous_loss: float  #: gamma s'² and gamma e'² of the springs
    damper_loss: float  #: of the system damper c_x
    stored_change: float  #: elastic energy of springs and system, kinetic energy of the body

    @property
    def residual(self) -> float:
        """Supply less use [J]."""
        used = self.friction_loss + self.viscous_loss + self.damper_loss + self.stored_change
        return self.pull_work + self.normal_work - used

    @property
    def relative(self) -> float:
        """Residual over the energy that was lost [-]."""
        return self.residual / (self.friction_loss + self.viscous_loss + self.damper_loss)


@dataclass(frozen=True, eq=False)
class SlidingRun:
    """Outcome of slide(). The arrays of the last periods are None unless `record` asked for them."""

    cof: float  #: mean F_x over mean F_z in whole periods [-]
    cof_error: float  #: bound on its numerical error: step, springs and settling [-]
    settled: bool  #: whether windows of periods agree
    kind: str  #: "full slip", "periodic", "period-2" ..., "quasi-periodic" or "unsettled"
    why: str  #: what keeps the run from settling and what to change, or what cof_error leaves out; empty if all is well
    stick_share: float  #: force-weighted share of contact time spent sticking [-]
    least_slip: float  #: smallest slip velocity of a spring in contact in the observed periods [m/s]
    mean_F_x: float  #: [N]
    mean_F_z: float  #: [N]
    energy_balance: EnergyBalance  #: of the observed periods
    v_0: float  #: pulling velocity [m/s]
    mu_0: float  #: local coefficient of friction [-]
    omega: float  #: of the oscillation [rad/s]
    n_springs: int  #: springs at x >= 0, each for the pair +x, -x
    steps_per_period: int  #: time steps of one period
    n_periods: int  #: periods marched
    t: Array | None = None  #: (n_t,) instants [s]
    u_x: Array | None = None  #: (n_t,) position of the body [m]
    u_z: Array | None = None  #: (n_t,) depth [m]
    F_x: Array | None = None  #: (n_t,) tangential force [N]
    F_z: Array | None = None  #: (n_t,) normal force [N]
    x: Array | None = None  #: (n_springs,) positions [m]
    e: Array | None = None  #: (n_t, n_springs) tangential extensions [m]
    state: NDArray[np.uint8] | None = None  #: (n_t, n_springs) modes, see State


def slide(
    case: SlidingContact,
    v_0: float,
    *,
    n_springs: int | None = None,
    steps_per_period: int | None = None,
    n_periods: int | None = None,
    start: str = "full_slip",
    record: int = 0,
    lump: bool = True,
) -> SlidingRun:
    """Slide a contact at v_0 > 0 [m/s] under its normal oscillation.

    n_springs, steps_per_period: None chooses them, so that cof_error meets 1e-5 mu_0 where possible. n_periods: None
    marches until settled; a number runs exactly that many and makes no companion runs. start: "full_slip" or "rest"
    (unloaded in the plane). record: number of last periods kept as arrays. lump: let springs that provably move as
    one be computed once.

    Raises TypeError and ValueError for arguments out of range; v_0 = 0 is `static_cof`.
    """
    v_0 = positive("v_0", v_0, "pulling velocity in m/s; the limit of zero velocity is static_cof(case)")
    if start not in ("full_slip", "rest"):
        raise ValueError(f'start must be "full_slip" or "rest", got {start!r}')
    for name, value, least in (
        ("n_springs", n_springs, 16),
        ("steps_per_period", steps_per_period, 16),
        ("n_periods", n_periods, 1),
    ):
        if value is not None:
            _count(name, value, least)
    _count("record", record, 0)
    if n_periods is not None and record > n_periods:
        raise ValueError(f"record = {record} periods cannot be kept of n_periods = {n_periods}")
    knobs = _Knobs(n_springs or _N_SPRINGS, steps_per_period or default_steps(case), start, bool(lump), record)
    if n_periods is not None:
        return _finish(_march(case, v_0, knobs, n_periods), why="no companion run: cof_error holds settling only")
    return _within_budget(case, v_0, knobs, free=(n_springs is None, steps_per_period is None))


def default_steps(case: SlidingContact) -> int:
    """Steps per period that resolve the oscillation of the body on the contact, if that can be afforded."""
    fast = fast_ratio(case)
    return (
        _STEPS
        if fast * 2 * RESOLVED < _STEPS or not np.isfinite(fast)
        else int(min(2 * RESOLVED * np.ceil(fast), 16384))
    )


@dataclass(frozen=True)
class _Knobs:
    n_springs: int
    steps: int
    start: str
    lump: bool
    record: int = 0

    def coarser(self, n_springs: int = 1, steps: int = 1) -> _Knobs:
        return replace(
            self, n_springs=max(self.n_springs // n_springs, 16), steps=max(self.steps // steps, 16), record=0
        )


@dataclass(frozen=True, eq=False)
class _March:
    """A finished march: what it said of itself, still in scaled form."""

    case: SlidingContact
    v_0: float
    knobs: _Knobs
    scaled: ScaledContact
    springs: SpringArray
    settling: Settling
    n_periods: int
    mean_F_z: float
    seen: _Seen

    @property
    def cof(self) -> float:
        return self.settling.mean


@dataclass(frozen=True, eq=False)
class _Seen:
    """The observed periods in scaled form; F_x, F_z, slip, y per step, e and mode per step and spring (or empty)."""

    sums: Array
    F_x: Array
    F_z: Array
    slip: Array
    y: Array
    e: Array
    mode: NDArray[np.uint8]
    stored: tuple[float, float]


def _count(name: str, value: Any, least: int) -> None:
    if isinstance(value, bool) or not isinstance(value, int | np.integer):
        raise TypeError(f"{name} must be a whole number, got {value!r}")
    if value < least:
        raise ValueError(f"{name} must be at least {least}, got {value}")


def _within_budget(case: SlidingContact, v_0: float, knobs: _Knobs, free: tuple[bool, bool]) -> SlidingRun:
    """Run with its companions; refine what was left free while the error exceeds the budget."""
    while True:
        main = _march(case, v_0, knobs)
        if not main.settling.settled:
            return _finish(main)
        error_springs = _difference(main, _march(case, v_0, knobs.coarser(n_springs=2), main.n_periods))
        error_steps = _difference(main, _march(case, v_0, knobs.coarser(steps=2), main.n_periods))
        run = _finish(main, error_springs + error_steps)
        finer = replace(
            knobs,
            n_springs=knobs.n_springs * (2 if free[0] and error_springs > BUDGET / 2 and knobs.n_springs < 4096 else 1),
            steps=knobs.steps * (2 if free[1] and error_steps > BUDGET / 2 and knobs.steps < 16384 else 1),
        )
        if run.cof_error <= BUDGET * case.mu_0 or finer == knobs:
            return run
        knobs = finer


def _difference(main: _March, companion: _March) -> float:
    """Difference of the COFs, over mu_0, with what a kink between two nodes can hide.

    A kink of size [e'] at the end of stick costs a mean up to [e'] h²/8 of one step. Near v_c, with psi ~ (1 - v)² the
    deficit of one spring, [e'] falls only like psi^(1/4); so the allowance follows this, not the deficit.
    """
    if main.cof == companion.cof:
        return 0.0
    finer_steps = main.knobs.steps > companion.knobs.steps
    coarseness = (2 * np.pi / main.knobs.steps) ** 2 if finer_steps else 4.0 / main.knobs.n_springs**2
    psi = min(max(1 - main.cof, 0.0) * main.mean_F_z, 1.0)
    return abs(main.cof - companion.cof) + 0.015 * coarseness / main.mean_F_z * psi**0.25


def _march(case: SlidingContact, v_0: float, knobs: _Knobs, n_periods: int | None = None) -> _March:
    """March until settled, or exactly n_periods; the last ones observed."""
    springs = SpringArray.of(case, knobs.n_springs)
    lump = knobs.lump and knobs.start == "full_slip"
    scaled = ScaledContact.of(case, springs, knobs.steps, lump)
    v = v_0 / scaled.speed
    line = _Line(scaled, v, knobs.start)
    n_seen = max(1, knobs.record)
    settling = line.wait(MAX_PERIODS["spring" if scaled.K else "rigid"]) if n_periods is None else None
    if n_periods is not None:
        line.advance(n_periods - n_seen)
    seen = line.observe(n_seen, keep=knobs.record > 0)
    if not line.as_one:  # the core did not move as one after all: every spring for itself
        return _march(case, v_0, replace(knobs, lump=False), n_periods)
    if settling is None:
        settling = line.judge()
    return _March(case, v_0, knobs, scaled, springs, settling, line.n_periods, line.mean_F_z, seen)


class _Line:
    """The state of a march between calls of the kernel."""

    def __init__(self, scaled: ScaledContact, v: float, start: str) -> None:
        self.scaled, self.v = scaled, v
        n = scaled.gap.size
        self.s, self.e = np.zeros(n), np.zeros(n)
        self.mean_F_z = kernels.settle_normal(self.s, scaled.gap, scaled.w, scaled.z, scaled.z_dot, scaled.T)
        if start == "full_slip":
            self.e[:] = self.s
            self.history = scaled.full_slip_history(self._full_slip_force())
        else:
            self.history = scaled.rest_history(v)
        self.as_one = True
        self.cofs = np.empty(0)
        self.swings = np.empty(0)  # of the body, greatest less least y of a period

    @property
    def n_periods(self) -> int:
        return self.cofs.size

    def _full_slip_force(self) -> Array:
        """S at the nodes of one period in full slip, shape (n_steps,), from the normal motion of the springs."""
        scaled, s = self.scaled, self.s.copy()
        S = np.empty(scaled.steps)
        fast = 1e9  # sliding at any high velocity is full slip
        nothing = np.empty((0, s.size))
        kernels.march(
            s.copy(),
            s,
            np.zeros(5),
            np.zeros(5),
            scaled.gap,
            scaled.w,
            scaled.z,
            scaled.z_dot,
            fast,
            scaled.T,
            -np.inf,
            scaled.steps,
            0,
            np.empty(scaled.steps),
            S,
            nothing,
            nothing,
        )
        return np.roll(S, 1)

    def _call(self, n_steps: int, k_0: int, e_out: Array, s_out: Array) -> tuple[Array, Array]:
        scaled = self.scaled
        y, S = np.empty(n_steps), np.empty(n_steps)
        as_one = kernels.march(
            self.e,
            self.s,
            self.history,
            scaled.body,
            scaled.gap,
            scaled.w,
            scaled.z,
            scaled.z_dot,
            self.v,
            scaled.T,
            scaled.lump_margin,
            n_steps,
            k_0,
            y,
            S,
            e_out,
            s_out,
        )
        self.as_one = self.as_one and bool(as_one)
        return y, S

    def advance(self, n_periods: int) -> None:
        """March whole periods and append their COFs (over mu_0)."""
        if n_periods <= 0:
            return
        nothing = np.empty((0, self.e.size))
        for part in _parts(n_periods, max(1, 4_000_000 // self.scaled.steps)):
            S_start = self.history[3]
            y, S = self._call(part * self.scaled.steps, 0, nothing, nothing)
            self._append(S_start, y, S)

    def _append(self, S_start: float, y: Array, S: Array) -> None:
        """COF of each whole period in S: the mean of L[e], which is the mean of e but for the ends; and swing of y."""
        self.swings = np.concatenate([self.swings, np.ptp(y.reshape(-1, self.scaled.steps), axis=1)])
        ends = np.concatenate([[S_start], S[self.scaled.steps - 1 :: self.scaled.steps]])
        inner = S.reshape(-1, self.scaled.steps).mean(axis=1)
        mean = inner - 0.5 * np.diff(ends) / self.scaled.steps + self.scaled.T * np.diff(ends) / (2 * np.pi)
        self.cofs = np.concatenate([self.cofs, mean / self.mean_F_z])

    def wait(self, most: int) -> Settling:
        """March until the windows agree."""
        self.advance(8)
        while not (settling := self.judge()).settled and self.n_periods < most and self.as_one:
            self.advance(max(4, self.n_periods // 2))
        return settling

    def judge(self) -> Settling:
        """Whether the COF has settled, and the swing of the body with it: on a resonance it grows before stick begins."""
        settling = judge(self.cofs, TOLERANCE)
        if settling.settled and not judge(self.swings / self.v, SWING_TOLERANCE).settled:
            return replace(settling, settled=False, kind="unsettled")
        return settling

    def observe(self, n_periods: int, keep: bool) -> _Seen:
        """March the last periods with a close look; the march is the same with and without `keep`."""
        scaled, n = self.scaled, self.e.size
        n_steps = n_periods * scaled.steps
        sums, F_x, F_z, slip = np.zeros(kernels.N_SUMS), np.empty(n_steps), np.empty(n_steps), np.empty(n_steps)
        sums[kernels.LEAST_SLIP] = np.inf
        e_kept, mode = np.empty((n_steps if keep else 0, n)), np.zeros((n_steps if keep else 0, n), dtype=np.uint8)
        y_all, S_all, S_start = [self.history[2::-1].copy()], [], self.history[3]
        stored = self._stored()
        done = 0
        for part in _parts(n_steps, max(1, 1_000_000 // n)):
            e, s = np.empty((part + 1, n)), np.empty((part + 1, n))
            e[0], s[0] = self.e, self._compression(done)
            history = self.history[2::-1].copy()
            y, S = self._call(part, done, e[1:], s[1:])
            k = (done + np.arange(part + 1)) % scaled.steps
            k[-1] = k[-2] + 1
            now = slice(done, done + part)
            kernels.observe(
                e,
                s,
                np.concatenate([history, y]),
                scaled.z[k],
                scaled.z_dot[k],
                scaled.gap,
                scaled.w,
                scaled.T,
                self.v,
                np.exp(-scaled.h / scaled.T) if scaled.T else 0.0,
                scaled.h,
                sums,
                F_x[now],
                F_z[now],
                slip[now],
                mode[now] if keep else mode,
            )
            if keep:
                e_kept[now] = e[1:]
            y_all.append(y)
            S_all.append(S)
            done += part
        self._append(S_start, np.concatenate(y_all[1:]), np.concatenate(S_all))
        return _Seen(sums, F_x, F_z, slip, np.concatenate(y_all), e_kept, mode, (stored, self._stored()))

    def _compression(self, step: int) -> Array:
        """Compressions now; the elastic march does not keep them."""
        scaled = self.scaled
        return self.s if scaled.T else np.maximum(scaled.z[step % scaled.steps] - scaled.gap, 0)

    def _stored(self) -> float:
        """Elastic and kinetic energy of springs, body and system spring, tangential unit of energy; u_z part
        included.
        """
        scaled, (y, y_old, y_older) = self.scaled, self.history[:3]
        u_dot = self.v + (1.5 * y - 2 * y_old + 0.5 * y_older) / scaled.h
        springs = 0.5 * float(scaled.w @ self.e**2)
        normal = 0.5 * float(scaled.w @ self._compression(0) ** 2)
        ratio = scaled.stiffness_z * scaled.length_z**2 / (scaled.stiffness_x * scaled.length_x**2)
        return float(springs + normal * ratio + 0.5 * scaled.K * y**2 + 0.5 * scaled.M * u_dot**2)


def _parts(total: int, most: int) -> list[int]:
    """Cut a number of steps into parts of at most `most`."""
    return [min(most, total - start) for start in range(0, total, most)]


def _finish(march: _March, error: float = 0.0, why: str = "") -> SlidingRun:
    """From scaled form to SI."""
    case, scaled, seen, settling = march.case, march.scaled, march.seen, march.settling
    mu_0, sums = case.mu_0, seen.sums
    n_steps = seen.F_x.size
    force_z = scaled.stiffness_z * scaled.length_z
    mean_F_z = float(sums[kernels.SUM_S]) / n_steps * force_z
    sticks = float(sums[kernels.STICK_TIME] / sums[kernels.CONTACT_TIME])
    kind = "full slip" if settling.settled and sticks == 0 and abs(1 - settling.mean) <= TOLERANCE else settling.kind
    return SlidingRun(
        cof=mu_0 * settling.mean,
        cof_error=mu_0 * (error + settling.spread + 1e-12),
        settled=settling.settled,
        kind=kind,
        why=why if settling.settled else _why_not(march),
        stick_share=sticks,
        least_slip=float(sums[kernels.LEAST_SLIP]) * scaled.speed,
        mean_F_x=mu_0 * settling.mean * mean_F_z,
        mean_F_z=mean_F_z,
        energy_balance=_energy_balance(march),
        v_0=march.v_0,
        mu_0=mu_0,
        omega=scaled.omega,
        n_springs=march.knobs.n_springs,
        steps_per_period=scaled.steps,
        n_periods=march.n_periods,
        **(_recorded(march) if march.knobs.record else {}),
    )


def _why_not(march: _March) -> str:
    settling, n = march.settling, march.n_periods
    if not np.isfinite(settling.spread):
        return f"{n} periods are too few to compare windows: raise n_periods to 8 or more"
    if settling.spread <= TOLERANCE:
        return f"the swing of the body still changes after {n} periods, as on a resonance: raise n_periods or add c_x"
    change = f"F_x still changes by {100 * settling.spread:.2g} % of mu_0 F_z between windows after {n} periods"
    if march.scaled.K and march.scaled.C == 0:
        return f"{change}: the free oscillation of a body without damper does not die out; add c_x"
    return f"{change}: raise n_periods" + ("" if march.knobs.start == "full_slip" else " or start from full slip")


def _energy_balance(march: _March) -> EnergyBalance:
    scaled, seen = march.scaled, march.seen
    sums, v, h = seen.sums, march.v_0 / scaled.speed, scaled.h
    unit_x = scaled.stiffness_x * scaled.length_x**2
    unit_z = scaled.stiffness_z * scaled.length_z**2
    pull, damper = float(sums[kernels.SHEAR_WORK]), 0.0
    if scaled.K:
        y = seen.y[2:]
        y_dot = np.diff(y) / h
        pull = -v * (scaled.K * h * float(np.sum(0.5 * (y[1:] + y[:-1]))) + scaled.C * float(y[-1] - y[0]))
        damper = scaled.C * h * float(np.sum(y_dot**2))
    viscous = unit_x * sums[kernels.SHEAR_VISCOUS] + unit_z * sums[kernels.NORMAL_VISCOUS]
    return EnergyBalance(
        pull_work=unit_x * pull,
        normal_work=unit_z * float(sums[kernels.NORMAL_WORK]),
        friction_loss=unit_x * float(sums[kernels.FRICTION_LOSS]),
        viscous_loss=float(viscous),
        damper_loss=unit_x * damper,
        stored_change=unit_x * (seen.stored[1] - seen.stored[0]),
    )


def _recorded(march: _March) -> dict[str, Any]:
    """The last periods in SI, the lumped core spread over the springs it stands for."""
    scaled, seen, springs = march.scaled, march.seen, march.springs
    n_steps = seen.F_x.size
    t = (march.n_periods - march.knobs.record) * march.case.oscillation.period + np.arange(
        1, n_steps + 1
    ) * scaled.h / scaled.omega
    e, mode, n = seen.e, seen.mode, scaled.n_lumped
    if n > 1:
        core = springs.gap[:n] / scaled.length_z - scaled.gap[0]
        e = np.concatenate([e[:, :1] - core, e[:, 1:]], axis=1)
        mode = np.concatenate([np.repeat(mode[:, :1], n, axis=1), mode[:, 1:]], axis=1)
    phase = np.arange(1, n_steps + 1) % scaled.steps
    oscillation = march.case.oscillation
    return {
        "t": t,
        "u_x": march.v_0 * t + seen.y[3:] * scaled.length_x,
        "u_z": oscillation.u_z0 + oscillation.du_z * scaled.z[phase],
        "F_x": seen.F_x * scaled.stiffness_x * scaled.length_x,
        "F_z": seen.F_z * scaled.stiffness_z * scaled.length_z,
        "x": springs.x,
        "e": e * scaled.length_x,
        "state": mode,
    }
