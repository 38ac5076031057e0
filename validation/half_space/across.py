"""Tables of contacts shaken across: friction in three dimensions beside that of springs whose friction is a vector.

Springs are run to convergence; three dimensions carry their own errors of grid, step and cycles, as
`mdr.half_space.curve` states them, or, on annuli, by half of the annuli and half of the steps.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

import mdr
from mdr.half_space.run import SETTLED
from mdr.tools.arrays import Array
from validation.cases import DEPTH, RADIUS, SHAPES, reach, shaken
from validation.half_space.annuli import Found, friction, pressure

CYCLES = 400  #: at most, on annuli


@dataclass(frozen=True)
class Point:
    """A contact by its groups, pulled rigidly and shaken across."""

    shape: str  #: of validation/cases.py
    nu: float  #: Poisson's ratio
    mu_0: float
    coupled: bool  #: whether pressure and friction act on each other
    eta: float  #: du_y/(mu_0 kappa u_z0)
    alpha: float  #: du_z/u_z0
    phi: float  #: phase of the shake against the depth
    v: float  #: v_0/(mu_0 kappa omega u_z0)

    @property
    def case(self) -> mdr.SlidingContact:
        """The case of the library."""
        return shaken(self.shape, self.alpha, eta=self.eta, phi_y=self.phi, mu_0=self.mu_0, nu=self.nu)

    @property
    def place(self) -> tuple[str, float, float]:
        """By what contacts at a constant depth are told apart, whatever nu, mu_0 and coupling."""
        return self.shape, self.eta, self.v

    @property
    def plain(self) -> bool:
        """At a constant depth, without coupling."""
        return not self.coupled and not self.alpha

    @property
    def v_0(self) -> float:
        """Pulling velocity [m/s]."""
        return self.v * self.case.omega * reach(self.case)


@dataclass(frozen=True)
class Row:
    """What was found at a point, over mu_0."""

    point: Point
    cof: float  #: in three dimensions
    cof_y: float
    springs: float
    springs_y: float
    grid: float  #: errors of three dimensions
    step: float
    cycle: float

    @property
    def off(self) -> float:
        """What springs are too high by."""
        return self.springs - self.cof

    @property
    def error(self) -> float:
        """Of it; that of springs is far smaller."""
        return self.grid + self.step + self.cycle


def on_cells(points: Sequence[Point], cells: int, steps: int) -> list[Row]:
    """Rows of one contact at several velocities, on cells. Raises NotConverged."""
    case, mu_0, v_0 = points[0].case, points[0].mu_0, [point.v_0 for point in points]
    found = mdr.half_space.curve(case, v_0, cells=cells, steps_per_period=steps, coupled=points[0].coupled)
    columns = found.cof, found.cof_y, *(of_springs(case, v_0).T), found.grid_error, found.step_error, found.cycle_error
    return [Row(point, *row) for point, row in zip(points, np.stack(columns, axis=1) / mu_0, strict=True)]


def on_annuli(points: Sequence[Point], n: int, steps: int) -> list[Row]:
    """Rows of one contact of nu = 0 without coupling at a constant depth, on n annuli, fastest first."""
    points = sorted(points, key=lambda point: -point.v)
    springs = of_springs(points[0].case, [point.v_0 for point in points]) / points[0].mu_0
    fine, wide, halved = (_annular(points, *size) for size in ((n, steps), (n // 2, steps), (n, steps // 2)))
    rows = []
    for point, cofs, one, *others in zip(points, springs, fine, wide, halved, strict=True):
        errors = (abs(other.cof - one.cof) for other in others)
        rows.append(Row(point, one.cof.real, one.cof.imag, *cofs, *errors, one.settling))
    return rows


def _annular(points: Sequence[Point], n: int, steps: int) -> list[Found]:
    """Runs on annuli, each from the end of the one before."""
    p, phase, out = pressure(SHAPES[points[0].shape], RADIUS, DEPTH, n), 2 * np.pi * np.arange(steps + 1) / steps, []
    for point in points:
        way = np.stack([point.v * phase, point.eta * np.cos(phase + point.phi)])
        out.append(friction(p, way, CYCLES, 0.1 * SETTLED, out[-1].tractions if out else None))
    return out


def of_springs(case: mdr.SlidingContact, v_0: Iterable[float]) -> Array:
    """COF along and across (n_v, 2), run to convergence."""
    runs = [mdr.slide(case, one) for one in v_0]
    return np.array([(run.cof, run.cof_y) for run in runs])
