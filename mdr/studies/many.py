"""slide_many(): friction of a list of contacts, each at its own velocity, computed on all cores."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.case.contact import SlidingContact, as_given
from mdr.friction.cof_curve import require_knobs
from mdr.march.periodic.steady import BUDGET, accuracy_of
from mdr.studies.engine import points_of
from mdr.studies.quantities import CATALOGUE
from mdr.studies.work import Layout, Work
from mdr.tools.arrays import Array
from mdr.tools.checks import row
from mdr.tools.csv_table import Tabled, csv_text
from mdr.tools.keywords import offering
from mdr.tools.messages import most_frequent, short
from mdr.tools.records import ArrayRecord
from mdr.tools.status import Status
from mdr.tools.summary import Summarised, Summary, span

COLUMNS = tuple(CATALOGUE[name] for name in ("cof", "cof_y", "cof_error", "stick_share"))


@dataclass(frozen=True, eq=False, repr=False)
class ManyCofs(Summarised, Tabled, ArrayRecord):
    """Friction of n contacts, each at its velocity; arrays of shape (n,). NaN where a contact has no answer."""

    v_0: Array  #: pulling velocities [m/s]
    cof: Array  #: average coefficients of friction [-]
    cof_y: Array  #: the same across the pull [-]
    cof_error: Array  #: bound on the error of either [-]
    stick_share: Array  #: force-weighted share of contact time spent sticking [-]
    status: NDArray[np.uint8]  #: how each ended, see `mdr.studies.Status`: 0 is done, 1 unsettled, 2 failed
    why: tuple[str, ...]  #: what there is to say of each, "" where nothing

    @property
    def settled(self) -> NDArray[np.bool_]:
        """Which have an answer within their error."""
        return np.asarray(self.status == Status.DONE)

    def _summary(self) -> Summary:
        return Summary(
            f"ManyCofs of {self.v_0.size} contacts",
            [
                ("COF", span(self.cof), "average coefficient of friction"),
                ("error", span(self.cof_error), "bound on the numerical error of the COF"),
                ("settled", f"{int(self.settled.sum())} of {self.v_0.size}", ""),
                *(("why", one, "") for one in most_frequent(self.why)),
            ],
        )

    def table(self) -> str:
        """A row for each contact as CSV.

        Returns
        -------
        str
            What `to_csv` writes.
        """
        known = {f"{one.name} [{one.unit}]": getattr(self, one.name) for one in COLUMNS}
        ends = [Status(one).name.lower() for one in self.status.tolist()]
        return csv_text({"v_0 [m/s]": self.v_0, **known, "status": ends, "why": self.why})


@dataclass(frozen=True)
class Listed(Work):
    """Work of a list: a unit for each contact, and its one velocity."""

    cases: tuple[SlidingContact, ...] = ()
    v_0: tuple[float, ...] = ()

    @cached_property
    def layout(self) -> Layout:
        """One point after the other."""
        return Layout((len(self.v_0),), None, 1)

    @property
    def moves(self) -> bool:
        """Each has a velocity."""
        return True

    def case_of(self, unit: int) -> SlidingContact:
        """The contact of a unit."""
        return self.cases[unit]

    def v_0_of(self, unit: int, case: SlidingContact) -> Array:
        """Its velocity [m/s], (1,)."""
        return np.array([self.v_0[unit]])


@offering
def slide_many(
    cases: SlidingContact | Iterable[SlidingContact],
    v_0: ArrayLike,
    *,
    n_springs: int | None = None,
    steps_per_period: int | None = None,
    accuracy: float = BUDGET,
) -> ManyCofs:
    """Friction of many contacts, each at its own velocity, on all cores of this machine.

    For lists that are no grid: a random sample, the rows of a table. Of a grid `sweep` keeps what is finished. For many
    velocities of one contact `cof_curve` is faster.

    Parameters
    ----------
    cases : SlidingContact or iterable of SlidingContact
        The contacts (n,); one for all velocities.
    v_0 : array_like
        Pulling velocities [m/s], (n,); one for all contacts.
    n_springs, steps_per_period : int, optional
        Springs and time steps of every run, as in `slide`.
    accuracy : float
        Bound on the error of every friction over mu_0 [-] that is asked for, as in `slide`.

    Returns
    -------
    ManyCofs
        Arrays in the order of the list. A contact that cannot be computed is NaN, with its reason. No value depends on
        the number of cores.

    Raises
    ------
    TypeError, ValueError
        For what is no contact or no velocity, and for lists of different lengths.

    Examples
    --------
    >>> import mdr, numpy as np
    >>> rng = np.random.default_rng(1)
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=5e-6, omega=300.0)
    >>> balls = [mdr.Paraboloid(R=R) for R in rng.normal(5e-3, 2e-4, 6)]
    >>> cases = [mdr.SlidingContact(ball, mdr.Elastic(E=3e6, nu=0.5), 0.4, vibration) for ball in balls]
    >>> found = mdr.slide_many(cases, v_0=2e-4)
    >>> found.cof.shape, bool(found.settled.all())
    ((6,), True)
    """
    listed = list(cases) if isinstance(cases, Iterable) else [cases]
    for one in listed:
        if not isinstance(one, SlidingContact):
            raise TypeError(f"cases must be SlidingContact records, got {short(repr(one))}")
    velocities = row("v_0", v_0, "m/s")
    n = max(len(listed), velocities.size)
    if not listed or {len(listed), velocities.size} - {1, n}:
        raise ValueError(
            f"cases and v_0 must be as many, or one of them one for all; got {len(listed)} and {velocities.size}"
        )
    require_knobs(n_springs=n_springs, steps_per_period=steps_per_period)
    knobs = {"n_springs": n_springs, "steps_per_period": steps_per_period, "accuracy": accuracy_of(accuracy)}
    given = tuple(map(as_given, listed)) * (n // len(listed))
    pulls = np.broadcast_to(velocities, n)
    points = points_of(Listed(given[0], (), COLUMNS, knobs, {}, given, tuple(pulls.tolist())), "slide_many")
    cof, cof_y, cof_error, stick_share = points.values
    return ManyCofs(pulls.copy(), cof, cof_y, cof_error, stick_share, points.status, tuple(points.why.tolist()))
