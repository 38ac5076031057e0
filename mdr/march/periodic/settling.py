"""Has a run settled? Decided by comparing windows of whole periods, never by waiting a fixed time.

A run gives one value a period, the mean of F_x. Compared are its means over three windows of doubling length, the last
of them the second half of the run. What is missing to the limit shrinks by a constant ratio from window to window not
only for a transient that dies out exponentially (ratio near zero) but also for one that dies like a power of time
(ratio 2^-p), as an undamped body does whose free oscillation is trimmed by instants of stick. That goes by fits and
starts, so the spread is twice what is missing by that ratio, and no less than twice the last change. Where the means
scatter instead, as under a beat, their scatter is the spread. They are weighted by sin², from nothing at either end of
a window: of a beat that fits into it N times they keep some N^-3, where the plain mean keeps N^-1. The run has settled
when the spread is below the tolerance.

With any damping no motion is quasi-periodic or of several periods for good, as two motions one period apart merge like
any other two (validation/uniqueness.py): such a kind names a transient that the mean outlives. Where friction falls
they do not merge, and states of several periods are found by repeats.py.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mdr.march.dynamics.state import UNKNOWN

MIN_PERIODS = 8  #: fewer give no three windows
LATE = "springs have not yet slipped as far as the pull went"  #: why a state that hardly changes is not periodic


@dataclass(frozen=True)
class Settling:
    """COF that the windows tell, how far it may be from its limit, and whether it has settled."""

    mean: float  #: over the second half, by smooth weights
    spread: float  #: bound on what is missing to the limit; UNKNOWN when the run is too short to tell
    settled: bool  #: whether it is an answer: the spread below its tolerance, and nothing known to move
    kind: str  #: "periodic", "period-2" ... "period-64", "averaged", "quasi-periodic" or "unsettled"
    gain: float | None = None  #: of a periodic state that was solved for (shooting.py); None of an awaited motion
    why: str = ""  #: what still moves where the windows agree
    contradicts: bool = False  #: whether the mean contradicts a theorem (theorems.py)
    across: float = 0.0  #: the mean of the force across the pull

    @property
    def periods(self) -> int:
        """After how many periods the state comes back, as the kind says; 1 of other kinds."""
        return int(self.kind.removeprefix("period-")) if self.kind.startswith("period-") else 1

    @property
    def solved(self) -> bool:
        """Whether the periodic state was solved for, not awaited."""
        return self.gain is not None


def assess(values: NDArray[np.float64], tolerance: float) -> Settling:
    """Whether a run has settled, by its values per period, shape (n_periods,)."""
    n = values.size
    if n < MIN_PERIODS:
        return Settling(float(values[-1]), UNKNOWN, False, "unsettled")
    first, second, third = (smooth_mean(values[a:b]) for a, b in ((n // 8, n // 4), (n // 4, n // 2), (n // 2, n)))
    before, last = second - first, third - second
    ratio = last / before if before else 0.0
    if 0 <= ratio < 0.9:
        spread = 2 * abs(last) * max(1.0, ratio / (1 - ratio))
    else:  # scatter, or a creep too slow to extrapolate
        spread = max(abs(before), abs(last)) * (1 if ratio < 0 else 100)
    spread = max(spread, 0.05 * abs(before))  # windows may agree by chance once
    settled = bool(spread <= tolerance)
    kind = _kind(values, tolerance) if settled else "unsettled"
    return Settling(third, float(min(spread, UNKNOWN)), settled, kind)


def smooth_mean(values: NDArray[np.float64]) -> float:
    """Mean with the weights sin² over the window, shape (n,): what beats leave of themselves in it falls like n^-3."""
    weights = np.sin(np.pi * (np.arange(values.size) + 0.5) / values.size) ** 2
    return float(values[0] + weights @ (values - values[0]) / weights.sum())  # a constant keeps its last digit


def _kind(values: NDArray[np.float64], tolerance: float) -> str:
    tail = values[-max(2, min(values.size // 2, 32)) :]
    for n in range(1, 9):
        if tail.size > n and np.max(np.abs(tail[n:] - tail[:-n])) <= 10 * tolerance:
            return "periodic" if n == 1 else f"period-{n}"
    return "quasi-periodic"
