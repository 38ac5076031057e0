"""slide(): march a sliding contact, every spring with its own stick/slip state, and bound the error of what comes out.

Beside a run go companions, with half the springs, with half the steps and with three quarters of the steps (for two of
them may agree by chance). Where dashpots touch a body that no mass holds, its velocity jumps, the error falls at first
order and erratically, and companions of steps in no simple ratio are added. The scheme is of second order, so the
difference to one of half the resolution is three times the error, and to one of three quarters 7/9 of it; the greater
of the two, springs and spread of the windows bound the error of the COF.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.march.dimensionless import RESOLVED, fast_ratio
from mdr.march.march import Knobs, March, march, too_coarse, touches
from mdr.march.run import SlidingRun, finish
from mdr.normal.resolved import resolved
from mdr.tools.checks import count, positive
from mdr.tools.progress import time_is_over, time_limit

ROUNDING = 1e-14  #: of cof/mu_0, up to which two runs have the same
BUDGET = 1e-5  #: of cof/mu_0, what the default knobs are to meet
MOST, MOST_KEPT = 10**6, 2e8  #: springs, or steps of a period; values of a record per array
LIGHT = 4.0  #: omega_1/omega from which on a body rings within the period
N_SPRINGS, _STEPS = 384, 1024  # first choice; doubled while cof_error exceeds the budget
MOST_STEPS = 16384  #: of a period, that are chosen
RINGING = 1.2  #: of the difference to a run that resolves the oscillation of the body, whose own error is small
MOST_UNEVEN = 4096  #: of such a motion, whose error falls at first order only
UNEVEN = (0.53, 0.61, 0.69, 0.83, 0.91)  #: of the steps, of companions of motions that jump as dashpots touch


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
    limit_s: float | None = None,
) -> SlidingRun:
    """Friction [-] of a contact that slides at v_0 under its normal oscillation, by a run in time.

    Every spring has its own state: free, stick or slip. The run goes on until the motion repeats (`run.settled`).

    Parameters
    ----------
    case : SlidingContact
        The contact.
    v_0 : float
        Pulling velocity [m/s], above zero. The limit of zero velocity is `static_cof`.
    n_springs : int, optional
        Springs at x > 0, each for the pair at +x and -x. None chooses them, and the steps, so that `cof_error` is at
        most 1e-5 mu_0 where that is possible.
    steps_per_period : int, optional
        Time steps of one period of the oscillation. None chooses them.
    n_periods : int, optional
        None goes on until the motion has settled. A number runs exactly so many periods, without the companion runs
        that bound the error: `cof_error` then holds settling only.
    start : {"full_slip", "rest"}
        First state. "full_slip": all springs slide; the periodic state of a body is then solved for. "rest": no spring
        is loaded in the plane; the run waits for the periodic state.
    record : int
        Number of last periods whose forces and springs are kept as arrays. 0 keeps none.
    lump : bool
        Compute springs that provably move as one only once.
    limit_s : float, optional
        Seconds of computing after which a run that has not settled ends. None sets no limit.

    Returns
    -------
    SlidingRun
        `cof` is mean F_x over mean F_z [-], `cof_error` the bound on its numerical error. `settled` says whether the
        motion is periodic, or how long it was waited for; `why` says what to change where it is not.

    Raises
    ------
    TypeError, ValueError
        For an argument out of range, with its name, the rule and a way out.

    See Also
    --------
    cof_curve : friction over many velocities.
    static_cof : the limit of zero velocity.

    Notes
    -----
    The scheme is of second order in time. Two companion runs with coarser steps and one with half the springs bound the
    error of the friction.

    Examples
    --------
    >>> import mdr
    >>> tapping = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=tapping)
    >>> run = mdr.slide(case, 1e-4, n_springs=64, steps_per_period=256)
    >>> f"{run.cof:.3f}", run.settled
    ('0.365', True)
    """
    case = resolved(case)
    if not isinstance(lump, bool):
        raise TypeError(f"lump must be True or False, got {lump!r}")
    v_0 = positive("v_0", v_0, "pulling velocity in m/s; the limit of zero velocity is static_cof(case)")
    if start not in ("full_slip", "rest"):
        raise ValueError(f'start must be "full_slip" or "rest", got {start!r}')
    least = 32 if n_periods is None else 16  # companions have half
    for name, value, lowest in (
        ("n_springs", n_springs, least),
        ("steps_per_period", steps_per_period, least),
        ("n_periods", n_periods, 1),
    ):
        if value is not None:
            count(name, value, lowest)
    count("record", record, 0)
    if n_periods is not None and record > n_periods:
        raise ValueError(f"record = {record} periods cannot be kept of n_periods = {n_periods}")
    knobs = Knobs(n_springs or N_SPRINGS, steps_per_period or default_steps(case), start, lump, record)
    if max(knobs.n_springs, knobs.steps) > MOST or knobs.n_springs * knobs.steps * record > MOST_KEPT:
        raise ValueError(
            f"n_springs = {knobs.n_springs}, steps_per_period = {knobs.steps}, record = {record} is more than memory "
            f"holds: at most {MOST} springs or steps, and {MOST_KEPT:g} values of a record"
        )
    if limit_s is not None:
        limit_s = positive("limit_s", limit_s, "seconds")
    with time_limit(limit_s):
        if n_periods is not None:
            return finish(march(case, v_0, knobs, n_periods), why="no companion run: cof_error holds settling only")
        return _within_budget(case, v_0, knobs, free=(n_springs is None, steps_per_period is None))


def default_steps(case: SlidingContact) -> int:
    """Steps per period that resolve the oscillation of the body on the contact, if that can be afforded."""
    fast = fast_ratio(case)
    return (
        _STEPS
        if fast * 2 * RESOLVED < _STEPS or not np.isfinite(fast)
        else int(min(2 * RESOLVED * np.ceil(fast), MOST_STEPS))
    )


def _within_budget(case: SlidingContact, v_0: float, knobs: Knobs, free: tuple[bool, bool]) -> SlidingRun:
    """Run with its companions; refine what was left free while the error exceeds the budget."""
    main: March | None = None
    run: SlidingRun | None = None
    while True:
        knobs = _that_touch(case, knobs, free[1])
        main = march(case, v_0, knobs, None, main)
        if not main.sees_contact and free[1] and knobs.steps < MOST_STEPS:
            knobs = replace(knobs, steps=min(2 * knobs.steps, MOST_STEPS))
            continue
        if not main.settling.settled:
            # finer steps make a state that hardly repeats harder to find, but a contradiction is one
            return finish(main) if run is None or main.settling.contradicts else run
        # a companion of an awaited motion waits as long, whatever is kept; of a solved one, it is solved for itself
        as_long = None if main.settling.solved else main.n_periods - len(main.record) + 1
        half = march(case, v_0, knobs.coarser(knobs.steps // 2), as_long, main)
        ringing = _of_ringing(case, main)
        if ringing == 0 and _clear_of_stick(main, half):
            return finish(main)
        most = march(case, v_0, knobs.coarser(3 * knobs.steps // 4), as_long, main)
        fewer = march(case, v_0, knobs.coarser(n_springs=knobs.n_springs // 2), as_long, main)
        error_springs = _difference(main, fewer)
        error_steps = max(_difference(main, half), 2 * _difference(main, most)) * _erratic(case)
        if main.scaled.light and main.scaled.remembers and not case.keeps_contact:
            others = (march(case, v_0, knobs.coarser(int(share * knobs.steps)), as_long, main) for share in UNEVEN)
            error_steps = max(error_steps, *(2 * _difference(main, other) for other in others))
            free = (free[0], free[1] and knobs.steps < MOST_UNEVEN)
        error_steps += _of_fast_relaxation(main) + ringing
        if time_is_over():
            if run is not None:
                return run
            why = "the time limit is over before the runs beside it, which bound cof_error, were done"
            return finish(replace(main, settling=replace(main.settling, settled=False, kind="unsettled", why=why)))
        run = finish(main, error_springs + error_steps)
        finer = replace(
            knobs,
            n_springs=knobs.n_springs * (2 if free[0] and error_springs > BUDGET / 2 and knobs.n_springs < 4096 else 1),
            steps=knobs.steps * (2 if free[1] and error_steps > BUDGET / 2 and knobs.steps < MOST_STEPS else 1),
        )
        awaited = not main.scaled.rigid and not main.settling.solved
        if run.cof_error <= BUDGET * case.mu_0 or finer == knobs or awaited or main.settling.spread > BUDGET / 4:
            return run
        knobs = finer


def _that_touch(case: SlidingContact, knobs: Knobs, free: bool) -> Knobs:
    """The knobs, with more steps where they are free and the contact too brief for them or for their companions."""
    if case.keeps_contact:
        return knobs
    while not all(touches(case, knobs.coarser(n)) for n in (knobs.steps, knobs.steps // 2, 3 * knobs.steps // 4)):
        if not free or knobs.steps >= MOST_STEPS:
            raise too_coarse(knobs.steps)
        knobs = replace(knobs, steps=min(2 * knobs.steps, MOST_STEPS))
    return knobs


def _clear_of_stick(main: March, half: March) -> bool:
    """Whether no finer step would stick either, so that F_x is mu_0 F_z without error.

    Both runs must slip throughout, by more than a tenth of v_0 and ten times what doubling the steps changed. And this
    change must be small beside v_0 less the slip velocity, which is v_c, so that it converges: the velocity of a light
    body may jump by more with every finer step. That of one without mass and damper, on dashpots, has no bound at all.
    """
    if main.scaled.T and not main.scaled.rigid and not main.scaled.M and not main.scaled.C:
        return False
    least, moved = min(main.least_slip, half.least_slip), abs(main.least_slip - half.least_slip)
    return least > max(0.1, 10 * moved) and moved < 0.01 * (1 - least) + 1e-12


def _of_ringing(case: SlidingContact, main: March) -> float:
    """What steps miss, over mu_0, that do not resolve the oscillation of a mass on the contact but damp it, as their
    companions do: found beside steps that resolve it. Those that are chosen do, as far as that can be afforded.
    """
    steps = int(np.ceil(1.1 * RESOLVED * fast_ratio(case))) if main.scaled.light and main.scaled.M else 0
    if not main.knobs.steps < steps <= MOST_STEPS:
        return 0.0
    resolved = march(case, main.v_0, main.knobs.coarser(steps), None, main)
    missed = resolved.settling.spread if resolved.settling.settled else 1.0
    return missed + RINGING * abs(main.cof - resolved.cof)


def _erratic(case: SlidingContact) -> float:
    """Margin on the differences of companions: a light body rings on the contact through stick and slip, and where the
    nodes meet its oscillation makes the error of a step erratic; of ten random bodies with omega_1 from 4 to 40 omega,
    two exceeded the plain differences, by 2 and 3 % (tests/table_of_errors.py).
    """
    return 1.5 if LIGHT < fast_ratio(case) < np.inf else 1.0


def _of_fast_relaxation(main: March) -> float:
    """What a change of mode in the core misses where the lag relaxes within a step, over mu_0.

    It is of second order but irregular, so that companions may agree by chance. Measured against the closed form of a
    rigid pull (T from 1e-4 to 0.3, all shapes and speeds), it stays below h² x/3(2 + x), x = h/T, per spring that keeps
    contact; a quarter of that for arrays that lose it.
    """
    T, h = main.scaled.T, main.scaled.h
    if T == 0:
        return 0.0
    core = float(main.scaled.w[: main.scaled.n_core].sum())
    return max(core, 0.25) * h**2 / 3 * h / (2 * T + h) / main.mean_F_z


def _difference(main: March, companion: March) -> float:
    """Difference of the COFs, over mu_0, with what a kink between two nodes can hide.

    A kink of size [e'] at the end of stick costs a mean up to [e'] h²/8 of one step. Near v_c, with psi ~ (1 - v)² the
    deficit of one spring, [e'] falls only like psi^(1/4); so the allowance follows this, not the deficit.
    """
    if abs(main.cof - companion.cof) <= ROUNDING:
        return 0.0
    missing = companion.settling.spread if main.settling.solved else 0.0
    if main.settling.solved and not companion.settling.settled:
        missing = max(missing, BUDGET)
    finer_steps = main.knobs.steps > companion.knobs.steps
    coarseness = (2 * np.pi / main.knobs.steps) ** 2 if finer_steps else 4.0 / main.knobs.n_springs**2
    psi = min(max(1 - main.cof, 0.0) * main.mean_F_z, 1.0)
    return missing + abs(main.cof - companion.cof) + 0.015 * coarseness / main.mean_F_z * float(psi**0.25)
