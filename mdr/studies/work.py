"""The work of a study: a case, the axes that vary it, and the quantities that are computed at every point."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from mdr.case.contact import SlidingContact
from mdr.march.march import BUDGET
from mdr.normal.vary import case_at
from mdr.studies.axes import Axis
from mdr.studies.layout import Layout
from mdr.studies.quantities import CurveQuantity, Quantity

IN_CLOSED_FORM, MARCHED = 64, 8  #: velocities of a unit under a rigid pull, and of one that is run velocity by velocity


@dataclass(frozen=True)
class Work:
    """What is to be computed for every point of a grid."""

    case: SlidingContact  #: what the axes vary
    axes: tuple[Axis, ...]
    quantities: tuple[Quantity | CurveQuantity, ...]
    n_springs: int | None = None  #: knobs of runs, None: chosen to meet the accuracy budget
    steps_per_period: int | None = None
    accuracy: float = BUDGET
    held: Mapping[str, float] = field(default_factory=dict)  #: what every case has besides, of `mdr.normal.vary.RIG`

    @cached_property
    def velocity_axis(self) -> Axis | None:
        """The axis of the velocity, if there is one."""
        return next((axis for axis in self.axes if axis.is_velocity), None)

    @cached_property
    def layout(self) -> Layout:
        """The order of its points."""
        velocity = next((i for i, axis in enumerate(self.axes) if axis.is_velocity), None)
        pulls = next((axis.values for axis in self.axes if axis.path == "pull"), (self.case.pull,))
        block = IN_CLOSED_FORM if all(pull.is_rigid for pull in pulls) else MARCHED
        return Layout(tuple(len(axis) for axis in self.axes), velocity, block)

    def case_of(self, unit: int) -> SlidingContact:
        """The case of a unit; what its records refuse is raised."""
        axes = (axis for axis in self.axes if not axis.is_velocity)
        varied: dict[str, Any] = {axis.path: axis[i] for axis, i in zip(axes, self.layout.case(unit), strict=True)}
        return case_at(self.case, {**self.held, **varied})
