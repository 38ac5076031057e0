"""Friction of a case under a rigid pull in three dimensions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.case.depth_cycle import harmonic_sum
from mdr.half_space.influence import HalfSpace, X, Z
from mdr.half_space.steps import Contact, Step
from mdr.tools.arrays import Array

#: of the grid around the greatest contact; with coupling friction spreads it, by 9 % where beta mu_0 = 0.3: what is cut
#: off then carries 1e-4 of F_z
MARGIN = 1.06
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


@dataclass(frozen=True)
class Friction:
    """Mean forces over the last period, their ratio, and how far that had settled."""

    cof: float
    mean_F_x: float  #: [N]
    mean_F_z: float  #: [N]
    settling: float  #: what further periods would still change the COF by, were changes to fall as the last two did
    cycles: int  #: periods that were marched

    @classmethod
    def over(cls, F_x: Array, F_z: Array) -> Self:
        """That of forces (cycles, steps) [N]."""
        cofs = F_x.sum(axis=1) / F_z.sum(axis=1)
        return cls(float(cofs[-1]), float(F_x[-1].mean()), float(F_z[-1].mean()), _settling(cofs), len(cofs))


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


def last_period(case: SlidingContact, v_0: float, settings: Settings, start: Step | None = None) -> LastPeriod:
    """The last period at v_0 [m/s], from `start`, the end of another one, on; as a default from full slip.

    Raises NotConverged, and ValueError for what `contact_of` refuses.
    """
    contact = contact_of(case, settings)
    depth, x, dt = path(case, v_0, settings)
    state, forces = start or contact.full_slip(float(depth[0])), []
    for _ in range(settings.cycles):
        steps = tuple(contact.march(state, depth, x, dt))
        state = steps[-1]
        forces.append([contact.forces(step.tractions) for step in steps])
        F = np.array(forces)
        friction = Friction.over(F[..., X], F[..., Z])
        if len(forces) > 2 and friction.settling <= settings.settled * case.mu_0:
            break
    return LastPeriod(friction, contact, steps)


def contact_of(case: SlidingContact, settings: Settings) -> Contact:
    """The grid that holds the contact at its greatest, and the shape on it; ValueError for what it cannot judge."""
    if not case.pull.is_rigid or not case.oscillation.knows_depth:
        raise ValueError("the half-space takes a rigid pull and a given depth: leave [pull] out, and give u_z0")
    if case.material.contact_arms:
        raise ValueError("the half-space is elastic or Kelvin: choose Elastic, ElasticPair or KelvinVoigt")
    shape, material, cells = case.indenter, case.material, settings.cells
    deepest = float(path(case, 1.0, settings)[0].max())
    h = 2 * MARGIN * float(shape.contact_radius(deepest)) / cells
    places = (np.arange(cells) - (cells - 1) / 2) * h
    r = np.hypot(places[:, None], places[None, :])
    height = np.full(r.shape, np.inf)  # where the shape has ended
    height[r <= shape.max_radius] = shape.profile_3d(r[r <= shape.max_radius])
    beta = material.dundurs_beta if settings.coupled else 0.0
    half_space = HalfSpace(cells, h, material.E_star, material.G_star, beta)
    return Contact(half_space, height, case.mu_0, material.tau, transverse=settings.transverse)


def path(case: SlidingContact, v_0: float, settings: Settings) -> tuple[Array, Array, float]:
    """Depth and x of the indenter [m] at the instants of a period, (steps + 1,), from the least depth on; dt [s]."""
    dt = case.period / settings.steps
    i = np.arange(settings.steps + 1)
    phase = 2 * np.pi * i[:-1] / settings.steps
    depth = case.cycle.u_z0 + case.cycle.unit * case.cycle.z(phase)
    shake = harmonic_sum(case.way, phase)
    at = (int(np.argmin(depth)) + i) % settings.steps
    return depth[at], v_0 * dt * i + shake[at], dt


def stuck(contact: Contact, step: Step) -> NDArray[np.bool_]:
    """Which cells stick in a step, (n, n)."""
    below = np.hypot(*step.tractions[:2]) < BELOW * contact.mu_0 * step.pressure
    return np.asarray((step.pressure > 0) & below)


def _settling(cofs: Array) -> float:
    """The sum of a geometric series that goes on as the last two changes; the last change, where it does not fall."""
    if len(cofs) < 3:
        return float(abs(cofs[-1] - cofs[0])) if len(cofs) > 1 else np.nan
    last, before = abs(cofs[-1] - cofs[-2]), abs(cofs[-2] - cofs[-3])
    return float(last if not before else last / max(1 - last / before, 0.1))
