"""One COF beside what it should be, over mu_0, and what a table of them says."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from twins.tiny_steps import Friction

import mdr


@dataclass(frozen=True)
class Row:
    """One run beside the truth as far as that is known; all over mu_0."""

    name: str
    cof: float
    bound: float  #: its cof_error
    truth: float
    doubt: float  #: of the truth
    settled: bool

    @property
    def distance(self) -> float:
        return abs(self.cof - self.truth)

    @property
    def error(self) -> float:
        """What the doubt leaves of the distance."""
        return max(self.distance - self.doubt, 0.0)

    def __str__(self) -> str:
        return f"{self.distance:.1e} from the truth (doubt {self.doubt:.1e}), bound {self.bound:.1e}: {self.name}"


def row(name: str, run: mdr.SlidingRun, truth: float, doubt: float = 0.0, known: bool = True) -> Row:
    """A run beside a COF, that and its doubt over mu_0; whether that is known."""
    return Row(name, run.cof / run.mu_0, run.cof_error / run.mu_0, float(truth), float(doubt), run.settled and known)


def along_or_across(name: str, run: mdr.SlidingRun, twin: Friction, full: float) -> Row:
    """A run beside its twin over `full`, along or across the pull, where they differ more."""
    bound, known = run.cof_error / full, (twin.doubt, run.settled)
    along = Row(name, run.cof / full, bound, twin.along, *known)
    across = Row(f"{name}, across", run.cof_y / full, bound, twin.across, *known)
    return max(along, across, key=lambda one: one.distance)


def median_bound(rows: Sequence[Row]) -> float:
    """How much larger than the distance the bound is, in the median of those that have one."""
    return float(np.median([one.bound / one.distance for one in rows if one.distance > 1e-13]))


def told(rows: Sequence[Row], share: float) -> int:
    """Print how many errors are within their bound, and the worst; 0 if that is so for this share of them, and the
    bounds are neither missing nor a hundred times too wide.
    """
    usable = [one for one in rows if one.settled]
    held = sum(one.error <= one.bound for one in usable)
    print(f"{len(rows)} cases, {len(usable)} settled; error within cof_error: {held}; median bound over error: "
          f"{median_bound(usable):.3g}; worst error {max(one.error for one in usable):.2g} mu_0")  # fmt: skip
    for one in sorted(usable, key=lambda one: one.error / one.bound)[:-9:-1]:
        print(f"  {one}")
    return 0 if held >= share * len(usable) and len(usable) >= 0.9 * len(rows) and median_bound(usable) <= 100 else 1
