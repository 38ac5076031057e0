"""The COF curve of a contact: one run a velocity, and the static limit at v_0 = 0."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.checks import finite_array
from mdr.contact import SlidingContact, require_case
from mdr.full_slip import static_cof
from mdr.progress import progress
from mdr.sliding import slide
from mdr.theory import critical_velocity

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class CofCurve:
    """COF over pulling velocity; arrays of shape (n_v,). The point v_0 = 0 is the static limit."""

    v_0: Array  #: pulling velocities [m/s]
    cof: Array  #: average coefficient of friction [-]
    cof_error: Array  #: bound on its numerical error [-]
    settled: NDArray[np.bool_]  #: whether the run settled
    stick_share: Array  #: force-weighted share of contact time spent sticking [-]
    v_c: float  #: Eq. (15) for the case, the scale of the curve [m/s]
    mu_0: float  #: local coefficient of friction [-]
    static_cof: float  #: limit v_0 -> 0 [-]
    why: tuple[str, ...] = ()  #: what the runs had to say, "" where nothing

    def plot(self, ax: Any = None) -> Any:
        """Draw cof/mu_0 over v_0/v_c; returns the matplotlib Axes."""
        from mdr.plots import plot_curve

        return plot_curve(self, ax)

    def to_csv(self, path: str | Path) -> None:
        """Write v_0, cof, cof_error, settled, stick_share, with units in the header."""
        columns = (self.v_0, self.cof, self.cof_error, self.settled.astype(int), self.stick_share)
        lines = ["v_0 [m/s],cof [-],cof_error [-],settled,stick_share [-]"]
        lines += [",".join(f"{value:.17g}" for value in row) for row in zip(*columns, strict=True)]
        Path(path).write_text("\n".join(lines) + "\n", encoding="utf-8")


def cof_curve(case: SlidingContact, v_0: ArrayLike, *, method: str | None = None) -> CofCurve:
    """COF of a case over pulling velocities v_0 >= 0 [m/s], shape (n_v,).

    method: None chooses; "march" forces the time march. Raises ValueError for velocities that are negative, infinite
    or NaN.
    """
    case = require_case(case)
    if method not in (None, "march"):
        raise ValueError(f'method must be None or "march", got {method!r}')
    velocities = np.atleast_1d(finite_array("v_0", v_0, "m/s"))
    if velocities.ndim != 1 or velocities.size == 0:
        raise ValueError(f"v_0 must be a list of velocities, got an array of shape {velocities.shape}")
    if np.any(velocities < 0):
        raise ValueError(f"v_0 must not be negative, got {float(velocities.min())!r} m/s")
    runs = [slide(case, v) if v > 0 else None for v in progress(velocities.tolist(), "cof_curve")]
    static = static_cof(case)
    return CofCurve(
        v_0=velocities,
        cof=np.array([run.cof if run else static for run in runs]),
        cof_error=np.array([run.cof_error if run else 0.0 for run in runs]),
        settled=np.array([run.settled if run else True for run in runs]),
        stick_share=np.array([run.stick_share if run else 1.0 for run in runs]),
        v_c=critical_velocity(case),
        mu_0=case.mu_0,
        static_cof=static,
        why=tuple(run.why if run else "" for run in runs),
    )
