"""slide(): march a sliding contact, every spring with its own stick/slip state; and runs at many velocities."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any

from mdr.case.contact import SlidingContact
from mdr.case.domain import MARCHED, Domain
from mdr.march.periodic.steady import BUDGET, MarchEnd, Resolution, check, steady
from mdr.march.result.refinement import resolution_of, within
from mdr.march.result.run import SlidingRun, finish, friction_of
from mdr.normal.resolved import resolved
from mdr.tools.checks import count, finite, positive
from mdr.tools.keywords import offering
from mdr.tools.progress import time_limit
from mdr.tools.summary import with_error

LAW = Domain(MARCHED, instead="for one coefficient, friction=mdr.Coulomb(mu_0)")
SLOWEST = 1e-9  #: pull, over mu_0 kappa omega du_z, of a run: a slower one moves springs by the rounding of their place


@offering
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
    accuracy: float = BUDGET,
) -> SlidingRun:
    """Friction [-] of a contact that slides at v_0 while it is shaken, by a run in time.

    Every spring has its own state: free, stick or slip. The run goes on until the motion repeats (`run.settled`).

    Parameters
    ----------
    case : SlidingContact
        The contact.
    v_0 : float
        Pulling velocity [m/s], at least 1e-9 of mu_0 kappa omega du_z. The limit of zero velocity is `static_cof`.
        Where something shakes in the plane it may be of either sign, or zero: there a contact that can hold ends in a
        state that depends on its start, see `holding_band`.
    n_springs : int, optional
        Springs at x > 0, each for the pair at +x and -x. None chooses them, and the steps, so that `cof_error` is
        within the accuracy where that is possible; they may stand closer where a run shows that they slip back, so that
        as many that are given can be less accurate.
    steps_per_period : int, optional
        Time steps of one period of the oscillation. None chooses them as friction needs them: to draw the motion of
        the body, ask for more, such as 1024.
    n_periods : int, optional
        None goes on until the motion has settled. A number runs exactly so many periods, without the companion runs
        that bound the error: `cof_error` then holds settling only.
    start : {"full_slip", "rest"}
        First state. "full_slip": all springs slide along the pull; the periodic state of a body is then solved
        for. "rest": no spring is loaded in the plane; the run waits for the periodic state.
    record : int
        Number of last periods whose forces and springs are kept as arrays. 0 keeps none.
    lump : bool
        Compute springs that provably move as one only once.
    limit_s : float, optional
        Seconds of computing, not of compiling, after which a run that has not settled ends. None sets no limit.
    accuracy : float
        Bound on the error of `cof` over mu_0 [-] that is asked for, from 1e-8 to 1e-3. Springs and steps that are not
        given are refined until `cof_error` is within it.

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
    The path of a spring over a step is exact; indenter and body move on parabolas in it. Companion runs with fewer
    steps and springs bound the error of the friction (refinement.py). The scheme is of second order or better in both.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=vibration)
    >>> run = mdr.slide(case, 1e-4, n_springs=64, steps_per_period=256)
    >>> f"{run.cof:.3f}", run.settled
    ('0.365', True)
    """
    case = LAW.seen(resolved(case), "slide")
    if not isinstance(lump, bool):
        raise TypeError(f"lump must be True or False, got {lump!r}")
    v_0 = checked_velocity(case, v_0)
    back = v_0 < 0
    if back:
        case, v_0 = case.mirrored, -v_0
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
    resolution = resolution_of(case, n_springs, steps_per_period, accuracy, start, lump, record)
    if limit_s is not None:
        limit_s = positive("limit_s", limit_s, "seconds")
    with time_limit(limit_s):
        if n_periods is not None:
            check(case, v_0)
            run = finish(steady(case, v_0, resolution, n_periods - max(1, record)))
        else:
            run = _told_of_others(finish(within(case, v_0, resolution)), case, resolution)
    return run.mirrored if back else run


def _told_of_others(run: SlidingRun, case: SlidingContact, resolution: Resolution) -> SlidingRun:
    """The run, which says so where one from the other start is another: where friction falls, a body may slide on, or
    stick and slip.
    """
    if case.friction.stick == 1 or case.pull.is_rigid or not run.settled:
        return run
    start = "rest" if resolution.start == "full_slip" else "full_slip"
    size = Resolution(run.n_springs, run.steps_per_period, start, lump=True, bounded=False)
    other = friction_of(steady(case, run.v_0, size))
    if not other.settled or abs(other.cof - run.cof) <= run.cof_error + other.cof_error:
        return run
    what = f'two motions go on here: from start = "{start}" the COF is {with_error(other.cof, other.cof_error)}'
    return replace(run, why="; ".join(filter(None, (run.why, what))))


def checked_velocity(case: SlidingContact, v_0: Any) -> float:
    """A pulling velocity [m/s] that a run can have. ValueError where it cannot."""
    if case.is_shaken or (case.shake is not None and finite("v_0", v_0) < 0):  # also of a shake with no amplitude
        return finite("v_0", v_0)
    what = "pulling velocity in m/s; the limit of zero velocity is static_cof(case)"
    velocity = positive("v_0", v_0, f"{what}, and the other way is the same where nothing shakes in the plane")
    if velocity < SLOWEST * case.unit_velocity:
        least = f"{SLOWEST:g} of mu_0 kappa omega du_z = {case.unit_velocity:.4g} m/s"
        rounding = "where rounding hides the motion of springs; ask static_cof(case)"
        raise ValueError(f"v_0 = {velocity:g} m/s is below {least}, {rounding}")
    return velocity


def runs(
    case: SlidingContact, velocities: Iterable[float], resolution: Resolution, near: MarchEnd | None = None
) -> Iterator[MarchEnd]:
    """The ends of runs at these velocities, each begun in the state of the one before: what `slide` answers, sooner.

    near: the end of a run in which the first begins. Without companions (resolution.bounded) their error is that of
    settling.
    """
    for v_0 in velocities:
        if resolution.bounded:
            end = within(case, v_0, resolution, near)
        else:
            check(case, v_0)
            end = steady(case, v_0, resolution, near=near)
        near = end.to_begin_from
        yield end
