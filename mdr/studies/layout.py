"""The order in which a study is computed: units of one case with a block of its velocities, numbered from 0.

The velocity is innermost whatever the order of the axes, so that a case is built once for all its velocities. A unit is
computed in one piece and alike wherever it is, so that no result depends on how the units are dealt out.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Layout:
    """Order of the points of a grid."""

    shape: tuple[int, ...]  #: how many values each axis has, in the order of the user
    velocity: int | None  #: which of the axes is the velocity
    block: int  #: how many velocities a unit has at most

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

    def first_point(self, unit: int) -> int:
        """The first point of a unit; that of n_units is n_points."""
        case, block = divmod(unit, self.blocks)
        return case * self.n_velocities + block * self.block

    def case(self, unit: int) -> tuple[int, ...]:
        """Index of the case of a unit along each axis but the velocity."""
        return tuple(int(i) for i in np.unravel_index(unit // self.blocks, self.of_cases)) if self.of_cases else ()

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
