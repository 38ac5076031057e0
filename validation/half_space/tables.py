"""Tables of friction in three dimensions beside that of springs: how they are computed, kept as CSV and read again.

A row is a contact of validation/cases.py at one velocity, and `loss` what the springs are too high by, over mu_0, both
in the same steps. Its errors stand beside it: `step` and `grid` are what half of the steps and half of the cells change
it by (of first order or better, so that the row itself is off by less), `settling` what further periods would.

A contact is marched from its highest velocity down, each velocity from the end of the one before: so the settled state
is near, and few periods suffice.
"""

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

import mdr
from mdr.half_space.friction import Settings, last_period
from validation.cases import E, contact
from validation.half_space import kept
from validation.half_space.springs import of_springs

SETTINGS = Settings(cells=25, steps=40, cycles=30, settled=3e-4)
SPRING_CYCLES = 40  #: of the springs, which cost nothing


@dataclass(frozen=True)
class Point:
    """A contact by its groups, pulled rigidly at v times the velocity of Eq. (1)."""

    shape: str  #: of validation/cases.py
    nu: float  #: Poisson's ratio of the body
    mu_0: float
    alpha: float  #: du_z/u_z0
    T: float  #: omega tau
    v: float
    nu_2: float | None = None  #: of the other body, as soft as the first; None for a rigid indenter

    @property
    def case(self) -> mdr.SlidingContact:
        """The case of the library."""
        case = contact(self.shape, self.alpha, self.T, mu_0=self.mu_0, nu=self.nu)
        return case if self.nu_2 is None else replace(case, material=mdr.ElasticPair(E, self.nu, E, self.nu_2))


@dataclass(frozen=True)
class Row:
    """A point, what was found at it, and the errors of that; all over mu_0."""

    point: Point
    cof: float  #: in three dimensions
    springs: float
    step: float
    grid: float
    settling: float
    cycles: int
    stick: float  #: greatest share of the area in contact that sticks in a step

    @property
    def loss(self) -> float:
        """What the springs are too high by."""
        return self.springs - self.cof

    @property
    def error(self) -> float:
        """Step, grid and settling together."""
        return self.step + self.grid + self.settling


Column = Sequence[Row]  #: of one contact


def columns_of(rows: Iterable[Row]) -> list[Column]:
    """The rows of each contact together."""
    found = defaultdict(list)
    for row in rows:
        found[replace(row.point, v=0.0)].append(row)
    return list(found.values())


def compute(columns: Iterable[Sequence[Point]], settings: Settings) -> list[Row]:
    """The rows of all columns, each the points of one contact. Raises NotConverged."""
    return [row for points in columns for row in column(points, settings)]


def column(points: Sequence[Point], settings: Settings) -> list[Row]:
    """The rows of one contact, fastest first."""
    points = sorted(points, key=lambda point: -point.v)
    fine = _marched(points, settings)
    halved = _marched(points, replace(settings, steps=settings.steps // 2))
    wide = _marched(points, replace(settings, cells=(settings.cells + 1) // 2))
    rows = []
    for point, one, slow, coarse in zip(points, fine, halved, wide, strict=True):
        loss = one[1] - one[0]
        errors = (abs(loss - (other[1] - other[0])) for other in (slow, coarse))
        rows.append(Row(point, one[0], one[1], *errors, *one[2:]))
    return rows


def loss(point: Point, settings: Settings) -> float:
    """The loss at a point alone, over mu_0, without its errors, which ask for two runs more. Raises NotConverged."""
    cof, springs, *_ = _marched([point], settings)[0]
    return springs - cof


def _marched(points: Sequence[Point], settings: Settings) -> list[tuple[float, float, float, int, float]]:
    """COF and that of springs, what is not settled, all over mu_0, periods, and the greatest share that sticks."""
    found, state = [], None
    for point in points:
        case, mu_0 = point.case, point.mu_0
        v_0 = point.v * mdr.critical_velocity(case)
        last = last_period(case, v_0, settings, state)
        state = last.steps[-1]
        springs = of_springs(case, v_0, replace(settings, cycles=SPRING_CYCLES))
        stick = float(np.nanmax(last.stick))
        friction = last.friction
        found.append((friction.cof / mu_0, springs.cof / mu_0, friction.settling / mu_0, friction.cycles, stick))
    return found


# --- files ---


def write(name: str, rows: Sequence[Row], settings: Settings, what: str) -> Path:
    """Keep rows, see `kept`."""
    cells, steps, cycles = settings.cells, settings.steps, settings.cycles
    return kept.write(name, rows, f"{what}; {cells} x {cells} cells, {steps} steps a period, {cycles} periods at most")


def read(name: str) -> list[Row]:
    """The rows that are kept."""
    return kept.read(name, Row)
