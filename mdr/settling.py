"""Has a run settled? Decided by comparing windows of whole periods, never by waiting a fixed time.

A run gives one value a period, the mean of F_x. Three windows of a quarter of the run each are compared. Where
their means creep towards a limit, the rest of the way is extrapolated geometrically; where they scatter (the beat of a lightly damped
body), the scatter itself is the spread. The run has settled when the spread is below the tolerance.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

MIN_PERIODS = 4  #: fewer give no three windows


@dataclass(frozen=True)
class Settling:
    """What the windows say."""

    mean: float  #: mean of the last window
    spread: float  #: bound on what is missing to the limit; infinite when the run is too short to tell
    settled: bool  #: whether the spread is below the tolerance
    kind: str  #: "periodic", "period-2" ... "period-8", "quasi-periodic" or "unsettled"


def judge(values: NDArray[np.float64], tolerance: float) -> Settling:
    """Judge a run by its values per period, shape (n_periods,)."""
    length = values.size // 4
    if values.size < MIN_PERIODS:
        return Settling(float(values[-1]), np.inf, False, "unsettled")
    windows = values[values.size - 3 * length :].reshape(3, length).mean(axis=1)
    before, last = np.diff(windows)
    ratio = last / before if before else 0.0
    if 0 <= ratio < 0.9:
        spread = abs(last) * max(1.0, ratio / (1 - ratio))
    else:  # scatter, or a creep too slow to extrapolate
        spread = max(abs(before), abs(last)) * (1 if ratio < 0 else 10)
    settled = bool(spread <= tolerance)
    return Settling(float(windows[-1]), float(spread), settled, _kind(values, tolerance) if settled else "unsettled")


def _kind(values: NDArray[np.float64], tolerance: float) -> str:
    tail = values[-max(2, min(values.size // 2, 32)) :]
    for n in range(1, 9):
        if tail.size > n and np.max(np.abs(tail[n:] - tail[:-n])) <= 10 * tolerance:
            return "periodic" if n == 1 else f"period-{n}"
    return "quasi-periodic"
