"""The work of a study: a case, what varies it, what is computed at every point, and in which order and pieces.

Points are computed in units, blocks of the velocities of one case, numbered from 0; under a rigid pull, where friction
is found at all of them together, a unit has all. The velocity is innermost whatever the order of the axes, so that a
case is built once for all its velocities. A unit is computed in one piece and alike wherever it is, so that no result
depends on how the units are dealt out. A chunk is some consecutive units, equally many but in the last; how a study is
cut is told by the first unit of each, as range(0, n_units, units_per_chunk).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.closed_forms.critical_velocity import critical_velocity
from mdr.given.vary import case_at
from mdr.studies.axes import Axis
from mdr.studies.quantities import Quantity
from mdr.tools.arrays import Array

MARCHED = 8  #: velocities of a unit that is run velocity by velocity: some seconds of work for one of several workers
#: of a study, and of an axis: with its status and reason a number takes some 20 bytes, and all of them 2 GB of memory
MOST_NUMBERS = 10**8


@dataclass(frozen=True)
class Layout:
    """Order of the points of a grid."""

    shape: tuple[int, ...]  #: how many values each axis has, in the order of the user
    velocity: int | None  #: which of the axes is the velocity
    block: int  #: how many velocities a unit has at most

    @classmethod
    def of(cls, axes: tuple[Axis, ...], block: int) -> Layout:
        """The order of the points over these axes."""
        velocity = next((i for i, axis in enumerate(axes) if axis.is_velocity), None)
        return cls(tuple(len(axis) for axis in axes), velocity, block)

    @property
    def of_cases(self) -> tuple[int, ...]:
        """Shape of the grid without the velocity."""
        return tuple(n for i, n in enumerate(self.shape) if i != self.velocity)

    @property
    def n_velocities(self) -> int:
        """Number of points of each case."""
        return 1 if self.velocity is None else self.shape[self.velocity]

    @property
    def n_points(self) -> int:
        """Number of points."""
        return prod(self.shape)

    @property
    def blocks(self) -> int:
        """Number of units of each case."""
        return -(-self.n_velocities // self.block)

    @property
    def n_units(self) -> int:
        """Number of units."""
        return prod(self.of_cases) * self.blocks

    def points(self, units: range) -> slice:
        """The points of consecutive units."""
        cases, blocks = np.divmod((units.start, units.stop), self.blocks)
        return slice(*(cases * self.n_velocities + blocks * self.block).tolist())

    def case(self, unit: int) -> tuple[int, ...]:
        """Index of the case of a unit along each axis but the velocity."""
        return tuple(map(int, np.unravel_index(unit // self.blocks, self.of_cases)))

    def velocities(self, unit: int) -> slice:
        """The velocities of a unit, as a part of their axis."""
        start = unit % self.blocks * self.block
        return slice(start, min(start + self.block, self.n_velocities))

    def in_place(self, points: NDArray[Any]) -> NDArray[Any]:
        """Arrays (..., n_points) as (..., *shape)."""
        ahead = points.shape[:-1]
        if self.velocity is None:
            return points.reshape(*ahead, *self.shape)
        grid = points.reshape(*ahead, *self.of_cases, self.n_velocities)
        return np.moveaxis(grid, -1, len(ahead) + self.velocity)


def units_of(cut: range, chunk: int) -> range:
    """The units of a chunk."""
    return range(cut[chunk], min(cut[chunk] + cut.step, cut.stop))


@dataclass(frozen=True)
class Work:
    """What is to be computed for every point of a grid."""

    case: SlidingContact  #: what the axes vary
    axes: tuple[Axis, ...]
    quantities: tuple[Quantity, ...]
    knobs: Mapping[str, Any] = field(default_factory=dict)  #: of runs: n_springs, steps_per_period and accuracy
    held: Mapping[str, Any] = field(default_factory=dict)  #: what every case has besides, of `mdr.case.paths.RIG`

    @property
    def velocity_axis(self) -> Axis | None:
        """The axis of the velocity, if there is one."""
        return next((axis for axis in self.axes if axis.is_velocity), None)

    @cached_property
    def layout(self) -> Layout:
        """The order of its points."""
        pulls = next((axis.values for axis in self.axes if axis.path == "pull"), (self.case.pull,))
        n = 1 if self.velocity_axis is None else len(self.velocity_axis)
        return Layout.of(self.axes, n if all(pull.is_rigid for pull in pulls) else MARCHED)

    @property
    def moves(self) -> bool:
        """Whether its points have a velocity."""
        return self.velocity_axis is not None

    def v_0_of(self, unit: int, case: SlidingContact) -> Array:
        """Pulling velocities [m/s] of a unit, whose case is this."""
        axis = self.velocity_axis
        assert axis is not None
        values = np.asarray(axis.values)[self.layout.velocities(unit)]
        if axis.path == "v_0":
            return values
        v_c = critical_velocity(case)
        if not 0 < v_c < np.inf:
            infinite = "infinite, as on an undamped resonance, shaken across, and of curved faces with tau_0"
            what = "zero" if v_c == 0 else infinite
            raise ValueError(
                f"v_0/v_c: the critical velocity of this case is {what}, so that its multiples say nothing"
            )
        return values * v_c

    def case_of(self, unit: int) -> SlidingContact:
        """The case of a unit; what its records refuse is raised."""
        axes = (axis for axis in self.axes if not axis.is_velocity)
        varied: dict[str, Any] = {axis.path: axis[i] for axis, i in zip(axes, self.layout.case(unit), strict=True)}
        return case_at(self.case, {**self.held, **varied})
