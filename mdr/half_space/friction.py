"""Friction of a case under a rigid pull in three dimensions."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.case.depth_cycle import harmonic_sum
from mdr.case.domain import ALIKE, GIVEN_DEPTH, NO_ARMS, RIGID, Domain
from mdr.half_space.influence import HalfSpace, Z
from mdr.half_space.steps import Contact, Step
from mdr.normal.normal_force import full_cof
from mdr.tools.arrays import Array
from mdr.tools.progress import Ticker, time_is_over

#: of the grid around the greatest contact; with coupling friction spreads it, by 9 % where beta mu_0 = 0.3: what is cut
#: off then carries 1e-4 of F_z
MARGIN = 1.06
#: what can be judged
JUDGED = Domain(
    (ALIKE, RIGID, GIVEN_DEPTH, NO_ARMS), instead="mdr.slide; the depth under a load is that of mdr.resolved(case)"
)
BELOW = 1 - 1e-5  #: its limit, where a traction counts as that of a cell that sticks


@dataclass(frozen=True)
class Settings:
    """How fine and how long a contact is marched, and what is left out."""

    cells: int = 41  #: along each side of the grid
    steps: int = 100  #: of a period
    cycles: int = 2  #: periods, at most
    coupled: bool = True  #: False: without normal-tangential coupling
    transverse: bool = True  #: False: without slip and traction across the pull
    settled: float = 0.0  #: share of mu_0 by which the COF may still be off when the run ends before its last period
    from_rest: bool = False  #: True: begin without traction in the plane, not from full slip


@dataclass(frozen=True)
class Friction:
    """Mean forces over the last period, their ratios, and how far those had settled."""

    cof: float
    cof_y: float  #: of the force across the pull
    mean_F_x: float  #: [N]
    mean_F_y: float  #: [N]
    mean_F_z: float  #: [N]
    settling: float  #: what further periods would still change either COF by, were changes to fall as the last two did
    cycles: int  #: periods that were marched

    @classmethod
    def over(cls, F: Array) -> Self:
        """That of forces (cycles, steps, 3) [N]."""
        means = F.mean(axis=1)
        cofs = means[:, :Z] / means[:, Z:]
        (cof, cof_y), (F_x, F_y, F_z) = cofs[-1].tolist(), means[-1].tolist()
        return cls(cof, cof_y, F_x, F_y, F_z, max(map(_settling, cofs.T)), len(cofs))


@dataclass(frozen=True)
class LastPeriod:
    """The steps of the last period, and the friction over it."""

    friction: Friction
    contact: Contact
    steps: tuple[Step, ...]

    @property
    def stick(self) -> Array:
        """Share of the area in contact that sticks in each step, (steps,); NaN where nothing touches."""
        touching = np.array([np.count_nonzero(step.pressure) or np.nan for step in self.steps])
        return np.array([np.count_nonzero(stuck(self.contact, step)) for step in self.steps] / touching)


def in_three_dimensions(case: SlidingContact, v_0: float, settings: Settings) -> Friction:
    """Friction at v_0 [m/s], from full slip at the least depth on. Raises NotConverged, ValueError."""
    return last_period(case, v_0, settings).friction


def last_period(
    case: SlidingContact, v_0: float, settings: Settings, start: Step | None = None, arrived: bool = False
) -> LastPeriod:
    """The last period at v_0 [m/s], from `start`, the end of another one, on; as a default from full slip.

    A contact at rest, or shaken across, which loses more of its force than a slow pull gives back in a period, has not
    settled before the pull has gone the way of full slip; arrived: unless it begins at its end at this velocity.
    Raises NotConverged, and ValueError for what `contact_of` refuses.
    """
    contact = contact_of(case, settings)
    depth, way, dt = path(case, v_0, settings)
    toward = 0.0 if settings.from_rest else np.copysign(1.0, v_0)
    far = 0.0 if arrived or not (settings.from_rest or case.moves_across) else case.reach(case.u_z_max)
    full = full_cof(case)
    state, forces = start or contact.full_slip(float(depth[0]), toward), []
    ticker = Ticker("half-space", parts="steps")
    for _ in range(settings.cycles):
        steps = []
        for step in contact.march(state, depth, way, dt):
            steps.append(step)
            ticker.tick()
        state = steps[-1]
        forces.append([contact.forces(step.tractions) for step in steps])
        friction = Friction.over(np.array(forces))
        if abs(v_0) * case.period * len(forces) < far:
            friction = replace(friction, settling=2 * full)
        if (len(forces) > 2 and friction.settling <= settings.settled * full) or time_is_over():
            break
    return LastPeriod(friction, contact, tuple(steps))


def contact_of(case: SlidingContact, settings: Settings) -> Contact:
    """The grid that holds the contact at its greatest, and the shape on it; ValueError for what it cannot judge."""
    JUDGED.seen(case, "the half-space")
    shape, material, cells = case.indenter, case.material, settings.cells
    deepest = float(path(case, 1.0, settings)[0].max())
    beta = material.dundurs_beta if settings.coupled else 0.0
    h = 2 * MARGIN * float(shape.contact_radius(deepest)) / cells
    half_space = HalfSpace(cells, h, material.E_star, material.G_star, beta)
    r = half_space.radii
    height = np.full(r.shape, np.inf)  # where the shape has ended
    height[r <= shape.max_radius] = shape.profile_3d(r[r <= shape.max_radius])
    turning = case.moves_across and not material.tau
    return Contact(half_space, height, case.friction, material.tau, transverse=settings.transverse, turning=turning)


def path(case: SlidingContact, v_0: float, settings: Settings) -> tuple[Array, Array, float]:
    """Depth (steps + 1,) and x, y (2, steps + 1) [m] of the indenter over a period, from the least depth on; dt [s]."""
    dt = case.period / settings.steps
    i = np.arange(settings.steps + 1)
    phase = 2 * np.pi * i[:-1] / settings.steps
    depth = case.cycle.u_z0 + case.cycle.unit * case.cycle.z(phase)
    at = (int(np.argmin(depth)) + i) % settings.steps
    x, y = (harmonic_sum(harmonics, phase)[at] for harmonics in (case.way, case.way_across))
    return depth[at], np.stack([v_0 * dt * i + x, y]), dt


def stuck(contact: Contact, step: Step) -> NDArray[np.bool_]:
    """Which cells stick in a step, (n, n)."""
    below = np.hypot(*step.tractions[:2]) < BELOW * contact.limit(step.pressure)
    return np.asarray((step.pressure > 0) & below)


def _settling(cofs: Array) -> float:
    """The sum of a geometric series that goes on as the last two changes; the last change, where it does not fall."""
    if len(cofs) < 3:
        return float(abs(cofs[-1] - cofs[0])) if len(cofs) > 1 else np.nan
    last, before = abs(cofs[-1] - cofs[-2]), abs(cofs[-2] - cofs[-3])
    return float(last if not before else last / max(1 - last / before, 0.1))
