"""The COF curve of a contact: in closed form under a rigid pull, else one run for each velocity.

The point v_0 = 0 is the static limit.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.case.contact import SlidingContact
from mdr.case.domain import domain_of
from mdr.case.friction import named_full
from mdr.closed_forms.across import static_across
from mdr.closed_forms.critical_velocity import critical_velocity
from mdr.closed_forms.full_slip import static_cof
from mdr.closed_forms.held_body import CLOSE, held_forward
from mdr.closed_forms.rigid_pull import average_friction
from mdr.closed_forms.shaken_pull import CLOSED_FORM, ShakenPull
from mdr.closed_forms.shaken_pull import average_friction as shaken_friction
from mdr.march.periodic.steady import BUDGET, Resolution, accuracy_of
from mdr.march.periodic.theorems import disordered
from mdr.march.result.refinement import resolution_of
from mdr.march.result.run import finish, friction_of
from mdr.march.result.slide import LAW, SLOWEST, runs
from mdr.normal.normal_force import full_cof
from mdr.normal.resolved import resolved
from mdr.plots.figures import Axes
from mdr.tools.arrays import EXACT, Array
from mdr.tools.checks import count, row
from mdr.tools.csv_table import Tabled, csv_text
from mdr.tools.keywords import offering
from mdr.tools.messages import MOST_TOLD
from mdr.tools.progress import Ended, progress, time_is_over
from mdr.tools.records import ArrayRecord
from mdr.tools.summary import Summarised, Summary, number, span

LEAST_KNOB = 32  #: springs, or steps of a period, that a run and its companions can do with


@dataclass(frozen=True, eq=False, repr=False)
class CofCurve(Summarised, Tabled, ArrayRecord):
    """Coefficient of friction over the pulling velocity, arrays of shape (n_v,).

    The point v_0 = 0 is the static limit, of a pull ever slower forward.
    """

    v_0: Array  #: pulling velocities [m/s]
    cof: Array  #: average coefficient of friction [-]
    cof_error: Array  #: bound on its error, and on that of cof_y, estimated of runs; 2 full_cof of one not settled [-]
    settled: NDArray[np.bool_]  #: whether the run settled
    stick_share: Array  #: force-weighted share of contact time spent sticking [-]
    v_c: float  #: Eq. (15) for the case, the scale of the curve [m/s]
    mu_0: float  #: local coefficient of friction [-]
    full_cof: float  #: COF of full slip [-]: mu_0, or what a shear strength of the face makes of it
    static_cof: float | None  #: limit v_0 -> +0 [-]; None where friction falls and no closed form has it
    why: tuple[str, ...] = ()  #: what the runs had to say, "" where nothing
    v_c_back: float | None = None  #: the same as v_c of the pull the other way [m/s], positive; None if nothing shakes
    #: limit v_0 -> -0 [-] where both ways are asked for, and rest or in closed form
    static_cof_back: float | None = None
    cof_y: Array | None = None  #: mean F_y, across the pull, over mean F_z [-]; None where nothing moves across
    falls: bool = False  #: whether friction falls as springs are let go, so that it may jump, at v_c above all

    @property
    def share(self) -> Array:
        """`cof` over that of full slip [-], (n_v,): cof/mu_0 where the face has no shear strength."""
        return self.cof / self.full_cof

    def _summary(self) -> Summary:
        n, settled = self.v_0.size, int(self.settled.sum())
        back = [] if self.v_c_back is None else [("v_c back", number(self.v_c_back, "m/s"), "pulled the other way")]
        reasons = dict.fromkeys(why for why, one in zip(self.why, self.settled, strict=False) if why and not one)
        return Summary(
            f"CofCurve at {n} velocities, {span(self.v_0, 'm/s')}",
            [
                ("COF", span(self.cof), f"of {named_full(self.full_cof, self.mu_0)}"),
                *([] if self.cof_y is None else [("across", span(self.cof_y), "mean F_y over mean F_z")]),
                ("error", span(self.cof_error), "bound on the numerical error of the COF"),
                ("settled", f"{settled} of {n}", ""),
                *(("why", why, "") for why in list(reasons)[:MOST_TOLD]),
                *([] if self.static_cof is None else [("at rest", number(self.static_cof), "COF as v_0 -> +0")]),
                ("v_c", number(self.v_c, "m/s"), "critical velocity in closed form"),
                *back,
            ],
        )

    def plot(self, ax: Axes | None = None, *, absolute: bool = False) -> Axes:
        """Draw cof/mu_0 over v_0/v_c, or both as they are; with a shear strength the share of full slip for cof/mu_0.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw. None makes a new figure.
        absolute : bool
            Draw cof over v_0 in m/s.

        Returns
        -------
        matplotlib.axes.Axes
            Where it was drawn.
        """
        from mdr.plots import plot_curve

        return plot_curve(self, ax, absolute=absolute)

    def table(self) -> str:
        """Velocities, friction, its error, settled and stick_share as CSV; cof_y where it is known.

        Returns
        -------
        str
            What `to_csv` writes.
        """
        columns = {"v_0 [m/s]": self.v_0, "cof [-]": self.cof, "cof_error [-]": self.cof_error}
        columns |= {"settled": self.settled.astype(int), "stick_share [-]": self.stick_share}
        return csv_text(columns | ({} if self.cof_y is None else {"cof_y [-]": self.cof_y}))


@offering
def cof_curve(
    case: SlidingContact,
    v_0: ArrayLike,
    *,
    method: str | None = None,
    n_springs: int | None = None,
    steps_per_period: int | None = None,
    accuracy: float = BUDGET,
) -> CofCurve:
    """Coefficient of friction [-] of a contact over the pulling velocity.

    Parameters
    ----------
    case : SlidingContact
        The contact.
    v_0 : array_like of float, shape (n_v,)
        Pulling velocities [m/s], zero or above. Zero is the static limit. Where something shakes in the plane they may
        be of either sign, friction too, and zero is the limit of a pull ever slower forward. Without a shake a pull
        below 1e-9 of mu_0 kappa omega du_z is computed as one of this velocity, or as zero, within `cof_error`.
    method : {None, "march"}
        None takes the closed form where there is one (a rigid pull, an elastic or Kelvin material, a depth and a shake
        of no more than 64 harmonics) and one run for each velocity elsewhere. "march" takes runs for every case.
    n_springs, steps_per_period : int, optional
        Springs and time steps of every run, as in `slide`. None chooses them. The closed form has neither.
    accuracy : float
        Bound on the error of every `cof` over mu_0 [-] that is asked for, from 1e-8 to 1e-3, as in `slide`.

    Returns
    -------
    CofCurve
        Friction, its error and the share of stick, arrays of shape (n_v,).

    Raises
    ------
    ValueError
        For velocities that are infinite or NaN, and for negative ones where nothing shakes in the plane.
    TypeError
        For a case that is no SlidingContact.

    Notes
    -----
    The closed form holds for any shape and any amplitude; `mdr.closed_forms.rigid_pull` derives it for a harmonic
    depth, and `mdr.closed_forms.shaken_pull` for any other and under a shake.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> rubber = mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3)
    >>> case = mdr.SlidingContact(mdr.Cone(theta=0.0127), rubber, mu_0=0.4, oscillation=vibration)
    >>> mdr.cof_curve(case, [0, 1e-4, 3e-4, 5e-4]).cof.round(3)
    array([0.319, 0.364, 0.398, 0.4  ])
    """
    case = resolved(case)
    v_0 = velocities(case, v_0)
    asked = _Asked(case, v_0, method, accuracy, n_springs=n_springs, steps_per_period=steps_per_period)
    columns, back = asked.columns(asked.and_rest), None
    at_rest = columns.cof[asked.and_rest == 0]
    static = float(at_rest[0]) if at_rest.size else None
    if np.any(v_0 < 0) and case.is_alike_both_ways:
        back = None if static is None else -static
    elif np.any(v_0 < 0) and (asked.is_closed or np.any(v_0 == 0)):  # slow runs take long
        back = -float(_at_rest(case.mirrored, asked.friction)[0])
    known = columns.first(v_0.size)
    return CofCurve(
        v_0=v_0,
        **known._asdict() | {"why": tuple(known.why.tolist()), "cof_y": known.cof_y if case.moves_across else None},
        v_c=critical_velocity(case),
        mu_0=case.mu_0,
        full_cof=full_cof(case),
        static_cof=static,
        v_c_back=critical_velocity(case, -1) if case.is_shaken else None,
        static_cof_back=back,
        falls=case.friction.stick > 1,
    )


def cof_at(case: SlidingContact, v_0: ArrayLike, **knobs: Any) -> Columns:
    """Friction at velocities as a curve has it, without its limit at rest and its scale; knobs: of `cof_curve`."""
    case = resolved(case)
    asked = _Asked(case, velocities(case, v_0), **knobs)
    return asked.columns(asked.and_rest if asked.rest_judges else asked.counted).first(asked.v_0.size)


def velocities(case: SlidingContact, v_0: ArrayLike) -> Array:
    """Velocities in a row, negative only where something shakes in the plane."""
    v_0 = row("v_0", v_0, "m/s", "velocities")
    if case.shake is None and np.any(v_0 < 0):
        raise ValueError(
            f"v_0 must not be negative, got {float(v_0.min())!r} m/s: friction is the same both ways where "
            "nothing shakes in the plane"
        )
    return v_0


class _Asked:
    """What is asked of a curve."""

    def __init__(
        self,
        case: SlidingContact,
        v_0: Array,
        method: str | None = None,
        accuracy: float = BUDGET,
        closely: bool = True,
        **knobs: Any,
    ) -> None:
        self.case, self.v_0, accuracy = LAW.seen(case, "cof_curve"), v_0, accuracy_of(accuracy)
        require_knobs(**knobs)
        if method not in (None, "march"):
            raise ValueError(f'method must be None or "march", got {method!r}')
        self.is_closed = method is None and case in CLOSED_FORM
        self.counted = _not_too_slow(case, self.v_0, self.is_closed)  #: zero stands for the limit at rest
        by_runs = partial(_runs, accuracy=accuracy, closely=closely, **knobs)
        self.friction: Friction = _closed_form if self.is_closed else by_runs

    @property
    def and_rest(self) -> Array:
        """The same with zero, after them unless it is among them, or its limit is not known."""
        if np.any(self.counted == 0) or self.case not in domain_of(static_cof):
            return self.counted
        return np.append(self.counted, 0.0)

    @property
    def rest_judges(self) -> bool:
        """Whether the limit at rest judges the runs; one in closed form judges none."""
        return not self.is_closed and self.case.is_shaken

    def columns(self, v_0: Array) -> Columns:
        """Friction at velocities of which zero stands for its limit."""
        known = _both_ways(self.case, v_0, self.friction)
        if (slower := np.flatnonzero(self.counted != self.v_0)).size:
            known.cof[slower] = np.copysign(known.cof[slower], self.v_0[slower])
            known.cof_error[slower] += _as_slow(self.case, known.cof[slower], self.is_closed)
        if not self.is_closed and self.case.friction.stick == 1:
            judged = known.settled & ((v_0 != 0) | self.rest_judges)
            wrong = disordered(v_0, known.cof, known.cof_error, judged)
            known.why[wrong] = (
                "friction is less at a higher velocity than here, or more at a lower one, which no steady motions do"
            )
            known = known._replace(settled=known.settled & ~wrong)
        if known.settled.all() and np.max(known.cof_error) <= self.case.mu_0:
            return known
        most = 2 * full_cof(self.case)  # all there can be
        return known._replace(cof_error=np.where(known.settled, np.minimum(known.cof_error, most), most))


def require_knobs(**knobs: int | None) -> None:
    """Refuse fewer springs or steps than a run and its companions can do with; None is chosen."""
    for name, knob in knobs.items():
        if knob is not None:
            count(name, knob, LEAST_KNOB)


def friction_at(case: SlidingContact, v_0: float, accuracy: float = BUDGET) -> tuple[float, float, str]:
    """Friction [-] at one velocity as a curve has it, without the limit at rest; the bound on its error; and why it has
    not settled, "" where it has.
    """
    asked = _Asked(resolved(case), np.array([v_0]), accuracy=accuracy, closely=False)
    cof, error, settled, _, why, _ = (column[0] for column in asked.columns(asked.counted))
    return float(cof), float(error), "" if settled else f"the run did not settle{f': {why}' if why else ''}"


def counted(case: SlidingContact, v_0: float) -> tuple[float, bool]:
    """The velocity as it is computed, and whether by a run: neither in closed form nor as the limit at rest, zero."""
    is_closed = (case := resolved(case)) in CLOSED_FORM
    v_0 = float(_not_too_slow(case, velocities(case, v_0), is_closed)[0])
    return v_0, not is_closed and v_0 != 0


def _not_too_slow(case: SlidingContact, v_0: Array, is_closed: bool) -> Array:
    """The velocities as they are computed: a pull below SLOWEST in closed form as the slowest, in runs as the limit at
    rest, zero.
    """
    least = 0.0 if case.is_shaken else SLOWEST * case.unit_velocity
    slow = (np.abs(v_0) < least) & (v_0 != 0)
    return np.where(slow, np.copysign(least, v_0) if is_closed else 0.0, v_0)


def _as_slow(case: SlidingContact, cof: ArrayLike, is_closed: bool) -> Array:
    """Error of taking this friction, of the slowest pull or at rest, for that of a slower pull. It never falls with the
    velocity: in closed form it lies between this and the static one. Runs are no better than their default bound.
    """
    return np.abs(np.abs(cof) - static_cof(case)) if is_closed else np.asarray(BUDGET * full_cof(case))


class Columns(NamedTuple):
    """What a curve knows at each of its velocities, arrays (n_v,), by the names of `CofCurve`."""

    cof: Array
    cof_error: Array
    settled: NDArray[np.bool_]
    stick_share: Array
    why: NDArray[np.object_]
    cof_y: Array

    @classmethod
    def exact(cls, cof: Array, error: Array, sticks: Array) -> Columns:
        """Of what did not have to settle, and moves along the pull alone."""
        why = np.full(cof.shape, "", dtype=object)
        return cls(cof, error, np.ones(cof.shape, dtype=bool), sticks, why, np.zeros(cof.shape))

    def first(self, n: int) -> Columns:
        """Those of the first n velocities."""
        return Columns._make(column[:n] for column in self)


Point = tuple[float, float, bool, float, str, float]  #: a row of the columns
Friction = Callable[[SlidingContact, Array], Columns]  #: of a pull forward, at rising velocities


def _both_ways(case: SlidingContact, v_0: Array, friction: Friction) -> Columns:
    """Friction at velocities of either sign: of the mirror image of the contact for the other way."""
    if case.is_alike_both_ways and np.any(v_0 < 0):
        sizes, places = np.unique(np.abs(v_0), return_inverse=True)
        cof, error, settled, sticks, why, cof_y = _from_rest_on(case, sizes, friction)
        sign = np.where(v_0 < 0, -1.0, 1.0)
        return Columns(sign * cof[places], error[places], settled[places], sticks[places], why[places], cof_y[places])
    columns = Columns.exact(*np.empty((3, v_0.size)))
    for one, side, where in ((case, 1.0, v_0 >= 0), (case.mirrored, -1.0, v_0 < 0)):
        if not where.any():
            continue
        order = np.argsort(np.abs(v_0), kind="stable")
        places = order[where[order]]
        cof, *others = _from_rest_on(one, np.abs(v_0[places]), friction)
        for column, part in zip(columns, (side * cof + 0.0, *others), strict=True):
            column[places] = part
    return columns


def _from_rest_on(case: SlidingContact, v_0: Array, friction: Friction) -> Columns:
    """Friction at rising velocities >= 0, of which zero stands for its limit."""
    n_rest = int(np.sum(v_0 == 0))
    moving = friction(case, v_0[n_rest:]) if n_rest < v_0.size else Columns.exact(*np.empty((3, 0)))
    if not n_rest:
        return moving
    rest = _at_rest(case, friction)
    return Columns(*(np.r_[n_rest * [value], column] for value, column in zip(rest, moving, strict=True)))


def _at_rest(case: SlidingContact, friction: Friction) -> Point:
    """The limit of a pull ever slower forward: of a body that is held, by the forces that hold it, unless runs know
    more.
    """
    if case.friction.stick > 1:  # known in closed form, or refused
        return static_cof(case), EXACT * full_cof(case), True, 1.0, "", 0.0
    if (held := held_forward(case)) is None:
        return _slow(case, friction, is_held=False)
    known = held.cof, held.error, True, 1.0, "", held.cof_y
    return known if held.error <= CLOSE * case.mu_0 else min(_slow(case, friction, True), known, key=_doubt)


def _doubt(point: Point) -> tuple[bool, float]:
    """Whether it has not settled, and its error."""
    return not point[2], point[1]


def _slow(case: SlidingContact, friction: Friction, is_held: bool) -> Point:
    """The same, in closed form or by slow runs; is_held: of a body that creeps under what it is not held by.

    A body with mass, or arms, end a run at rest wherever they came to within the band of a shaken contact, and a body
    comes to it ever slower where an edge moves or a dashpot yields. There two slow runs tell the limit, to which
    friction falls like a power of the velocity between 2/3 and 1, of a body that is held from 1/2 on.
    """
    if case.moves_across:
        if case in domain_of(static_across):
            return static_cof(case), EXACT * case.mu_0, True, 1.0, "", 0.0
        # shaken across, a contact comes to rest by ever smaller slips: less slow
        return _slow_limit(friction(case, np.array([1e-3, 1e-2]) * case.pace), is_held)
    if not case.is_shaken:
        # arms are followed spring by spring, to this share of mu_0
        error = 5e-6 if case.material.contact_arms else EXACT
        return static_cof(case), (error + case.cycle.missing) * full_cof(case), True, 1.0, "", 0.0
    if case.material.contact_arms or case.pull.coefficients[0] or (is_held and (case.T or case.edge_moves)):
        return _slow_limit(friction(case, np.array([1e-5, 1e-4]) * case.pace), is_held)
    cof, error, settled, sticks, why, _ = (column[0] for column in friction(case, np.zeros(1)))
    return cof, error, settled, sticks, "" if settled else why, 0.0  # a start at one end of the band ends there


def _closed_form(case: SlidingContact, v_0: Array) -> Columns:
    """Friction of a case that has a closed form."""
    if case in domain_of(average_friction):  # good to rounding, and several times faster than event by event
        known = average_friction(case, v_0)
        return Columns.exact(known.cof, known.cof_error, known.stick_share)
    cof, error, sticks = shaken_friction(ShakenPull.of(case), v_0 / case.unit_velocity)
    return Columns.exact(case.mu_0 * cof, case.mu_0 * (error + case.cycle.missing), sticks)


def _slow_limit(runs: Columns, is_held: bool) -> Point:
    """The limit of two slow runs, velocities ten apart: a power 1 leaves 1/9 of their difference, 2/3 1/3.6, 1/2 1/2.2,
    which is that of a body that is held.
    """
    share, spread = (0.28, 0.23) if is_held else (1 / 6, 0.15)
    (slower, faster), (slow_y, fast_y) = runs.cof, runs.cof_y
    apart, aside = faster - slower, fast_y - slow_y
    bound = runs.cof_error[0] + (runs.cof_error[0] + runs.cof_error[1]) * share + spread * max(abs(apart), abs(aside))
    settled, why = bool(runs.settled.all()), runs.why[0] or runs.why[1]
    return slower - share * apart, bound, settled, runs.stick_share[0], why, slow_y - share * aside


def _runs(
    case: SlidingContact,
    v_0: Array,
    accuracy: float,
    closely: bool,
    n_springs: int | None = None,
    steps_per_period: int | None = None,
) -> Columns:
    """One run for each velocity. closely: whether stick_share is asked for, else NaN."""
    velocities = progress(v_0.tolist(), "COF curve", "velocities")
    of = finish if closely else friction_of
    found: list[Any] = [
        of(end) for end in runs(case, velocities, resolution_of(case, n_springs, steps_per_period, accuracy))
    ]
    columns = {name: np.array([getattr(run, name, np.nan) for run in found]) for name in Columns._fields}
    return Columns(**{**columns, "why": columns["why"].astype(object)})


def friction_without_bound(case: SlidingContact, v_0: Array, n_springs: int, steps_per_period: int) -> Array:
    """Friction (n_v,) [-] without a bound on its error: one run for each velocity, or the closed form.

    Raises Ended where the time limit is over between two runs.
    """
    resolution = Resolution(n_springs, steps_per_period, "full_slip", lump=True, bounded=False)

    def quick(one: SlidingContact, v_0: Array) -> Columns:
        found = []
        for end in runs(one, v_0.tolist(), resolution):
            found.append(full_cof(one) * end.cof)
            if time_is_over():
                raise Ended
        cof = np.array(found)
        return Columns.exact(cof, 0 * cof, 0 * cof)

    case = resolved(case)
    return _both_ways(case, v_0, _closed_form if case in CLOSED_FORM else quick).cof
