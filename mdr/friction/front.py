"""front(): the least power that a vibration takes, over the friction that it leaves."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mdr.case.contact import SlidingContact, as_given
from mdr.case.paths import facts_at
from mdr.friction.design import LAW
from mdr.friction.room_search import Design, Search, Space
from mdr.friction.target import Target
from mdr.normal.normal_force import full_cof
from mdr.normal.resolved import at_rest, resolved
from mdr.plots.figures import Figure
from mdr.tools.arrays import EXACT, Array
from mdr.tools.checks import count, positive
from mdr.tools.csv_table import Tabled, csv_text
from mdr.tools.keywords import offering
from mdr.tools.notation import shown
from mdr.tools.progress import progress
from mdr.tools.records import ArrayRecord
from mdr.tools.summary import Summarised, Summary, span


@dataclass(frozen=True, eq=False, repr=False)
class Front(Summarised, Tabled, ArrayRecord):
    """Designs of the least power, the least friction first; arrays of shape (n,)."""

    up_to: float  #: velocity [m/s] up to which friction holds
    cof: Array  #: greatest friction [-] of each design up to there
    power: Array  #: mean power [W] of the drives that vibrate it, at up_to
    designs: tuple[Design, ...]
    full_cof: float  #: friction [-] without vibration
    why: str  #: that the drives take no power, or that nothing lowers friction; "" where there is nothing to say
    stopped: str  #: what ended the search before its end; "" where nothing did

    def _summary(self) -> Summary:
        rows = [
            ("COF", span(self.cof), f"of {self.full_cof:.6g} without vibration, up to {shown(self.up_to, 'm/s')}"),
            ("power", span(self.power, "W"), "of the drives, the least of each friction"),
        ]
        for path in self.designs[0].values:
            rows.append((path, span([one.values[path] for one in self.designs], facts_at(path).unit), ""))
        told = [(name, said, "") for name in ("why", "stopped") if (said := getattr(self, name))]
        return Summary(f"Front of {self.cof.size} designs", [*rows, *told])

    def table(self) -> str:
        """A row for each design as CSV: friction, power, and the numbers that were free.

        Returns
        -------
        str
            What `to_csv` writes.
        """
        free = {
            f"{path} [{facts_at(path).unit}]": [one.values[path] for one in self.designs]
            for path in self.designs[0].values
        }
        return csv_text({"cof [-]": self.cof, "power [W]": self.power, **free})

    def plot(self) -> Figure:
        """Draw the power over friction, and below it the numbers that bring it about.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.
        """
        from mdr.plots.inputs import plot_front

        return plot_front(self)


@offering
def front(
    case: SlidingContact,
    up_to: float,
    free: Mapping[str, Any],
    n: int = 8,
    *,
    held: Mapping[str, Any] | None = None,
    limit_s: float | None = None,
) -> Front:
    """The least power that a vibration takes, over the friction that it leaves at all velocities up to one.

    Parameters
    ----------
    case : SlidingContact
        The contact; what is not free stays.
    up_to : float
        Velocity [m/s].
    free : dict of str to (low, high)
        Ranges of the numbers that may change, as in `design`.
    n : int
        Designs, at least 2: friction from the least that there is in equal steps towards that of full slip.
    held : mapping of str to float, optional
        "load" [N], "frequency" [Hz] or "tan_delta" [-] that hold meanwhile, as in `find`.
    limit_s : float, optional
        Computing time [s] after which the search ends; an interrupt (Ctrl-C) ends it too. The designs so far are
        answered, and `stopped` says so. None: no limit.

    Returns
    -------
    Front
        Friction and power of each design. An elastic contact takes no power to move up and down: `why` says so.

    Raises
    ------
    ValueError, TypeError
        As `design`.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=1e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=vibration)
    >>> found = mdr.front(case, 1e-4, {"du_z": ("1um", "15um")}, n=3)
    >>> bool(found.power[0] > found.power[1] > found.power[2])
    True
    """
    case = LAW.seen(as_given(case), "front")
    at_rest(case)  # warns of what is unlikely
    up_to, n = positive("up_to", up_to), count("n", n, 2)
    target = Target(cof_at_most=0.0, up_to=up_to)
    space = Space(case, free, held or {})
    searches = [Search(space, target)]
    full = full_cof(resolved(case))

    def work() -> None:
        searches[0].most_room()
        least = searches[0].design().reached["cof_at_most"]
        for k in progress(range(1, n), "front", "designs"):
            search = Search(space, replace(target, cof_at_most=least + (full - least) * k / n))
            search.least_power([searches[-1].found])
            searches.append(search)
        for k in progress(range(n - 2, 0, -1), "front, back again", "designs"):  # each from its other neighbour
            searches[k].least_power([searches[k].found, searches[k + 1].found])

    stopped = searches[0].stopped(work, limit_s)
    designs = [search.design() for search in searches]
    power = np.array([one.power for one in designs])
    cofs = np.array([one.reached["cof_at_most"] for one in designs])
    why = ""
    if not cofs.min() < full * (1 - EXACT):
        why = "no vibration in these ranges lowers friction at up_to: it is above the critical velocity of each"
    elif not np.any(power > 0):
        why = "the drives take no power: an elastic contact gives back what moves it"
    return Front(up_to, cofs, power, tuple(designs), full, why, stopped)
