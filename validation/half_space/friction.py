"""Friction of a case under a rigid pull in three dimensions, and of its springs in the same steps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import mdr
from mdr.case.depth_cycle import harmonic_sum
from mdr.tools.arrays import Array
from validation.half_space import springs
from validation.half_space.influence import HalfSpace, X, Z
from validation.half_space.march import Contact, Step

#: of the grid around the greatest contact; with coupling friction spreads it, by 9 % where beta mu_0 = 0.3: what is cut
#: off then carries 1e-4 of F_z
MARGIN = 1.06
BELOW = 1 - 1e-5  #: its limit, where a traction counts as that of a cell that sticks
OUT_OF_REACH = 1e3  #: depths, where a shape has ended


@dataclass(frozen=True)
class Knobs:
    """Cells along each side, steps of a period, periods at most, what is left out: coupling, slip across."""

    cells: int = 41
    steps: int = 100
    cycles: int = 2
    coupled: bool = True
    transverse: bool = True
    settled: float = 0.0  #: share of mu_0 by which the COF may still be off when a march ends before its last period


@dataclass(frozen=True)
class Friction:
    """Mean forces [N] over the last period, their ratio, and how far that had settled."""

    cof: float
    mean_F_x: float
    mean_F_z: float
    settling: float  #: what further periods would still change, were changes to fall as the last two did
    cycles: int


@dataclass(frozen=True)
class March:
    """The steps of the last period of a march in three dimensions, and the friction over it."""

    friction: Friction
    contact: Contact
    steps: tuple[Step, ...]

    @property
    def stick(self) -> Array:
        """Share of the area in contact that sticks in each step, (steps,); NaN where nothing touches."""
        return np.array([_share_stuck(self.contact, step) for step in self.steps])


def in_three_dimensions(case: mdr.SlidingContact, v_0: float, knobs: Knobs) -> Friction:
    """Friction of the half-space, from full slip at the least depth on. Raises NotConverged, ValueError."""
    return march(case, v_0, knobs).friction


def march(case: mdr.SlidingContact, v_0: float, knobs: Knobs, start: Step | None = None) -> March:
    """The same with its last period, from `start`, the end of another march, on. Raises NotConverged, ValueError."""
    contact = contact_of(case, knobs)
    depth, way, dt = path(case, v_0, knobs)
    state, ratios = start or contact.full_slip(float(depth[0])), []
    for _ in range(knobs.cycles):
        steps = tuple(contact.march(state, depth, way, dt))
        state = steps[-1]
        F = np.array([contact.forces(step.tractions) for step in steps])
        ratios.append(float(F[:, X].sum() / F[:, Z].sum()))
        if len(ratios) > 2 and _settling(ratios) <= knobs.settled * case.mu_0:
            break
    return March(_friction(F[:, X], F[:, Z], ratios), contact, steps)


def of_springs(case: mdr.SlidingContact, v_0: float, knobs: Knobs) -> Friction:
    """Friction of independent springs in the very steps of `in_three_dimensions`, over all periods."""
    depth, way, dt = path(case, v_0, knobs)
    depth = np.append(np.tile(depth[:-1], knobs.cycles), depth[-1])
    moved = np.cumsum(np.tile(np.diff(way), knobs.cycles))
    way = np.append(0.0, moved)
    material = case.material
    F_x, F_z = springs.forces(
        case.indenter.profile_1d, float(case.indenter.contact_radius(depth.max())), depth, way, dt,
        case.mu_0, material.mindlin_ratio, material.tau,
    )  # fmt: skip
    F_x, F_z = (material.E_star * F[1:].reshape(knobs.cycles, knobs.steps) for F in (F_x, F_z))
    return _friction(F_x[-1], F_z[-1], [float(x.sum() / z.sum()) for x, z in zip(F_x, F_z, strict=True)])


def contact_of(case: mdr.SlidingContact, knobs: Knobs) -> Contact:
    """The grid that holds the contact at its greatest, and the shape on it; ValueError for what it cannot judge."""
    if not isinstance(case.pull, mdr.RigidPull) or not case.oscillation.knows_depth:
        raise ValueError("the half-space takes a rigid pull and a given depth: leave [pull] out, and give u_z0")
    if case.material.contact_arms:
        raise ValueError("the half-space is elastic or Kelvin: choose Elastic, ElasticPair or KelvinVoigt")
    shape, material = case.indenter, case.material
    deepest = float(path(case, 1.0, knobs)[0].max())
    side = 2 * MARGIN * float(shape.contact_radius(deepest))
    h = side / knobs.cells
    places = (np.arange(knobs.cells) - (knobs.cells - 1) / 2) * h
    r = np.hypot(places[:, None], places[None, :])
    height = np.full(r.shape, OUT_OF_REACH * deepest)
    height[r <= shape.max_radius] = shape.profile_3d(r[r <= shape.max_radius])
    beta = material.dundurs_beta if knobs.coupled else 0.0
    half_space = HalfSpace(knobs.cells, h, material.E_star, material.G_star, beta)
    return Contact(half_space, height, case.mu_0, material.tau, transverse=knobs.transverse)


def path(case: mdr.SlidingContact, v_0: float, knobs: Knobs) -> tuple[Array, Array, float]:
    """Depth and way at the instants of a period, (steps + 1,), from the least depth on, and the step [s]."""
    dt = case.period / knobs.steps
    i = np.arange(knobs.steps + 1)
    phase = 2 * np.pi * i[:-1] / knobs.steps
    one = case.cycle.u_z0 + case.cycle.unit * case.cycle.z(phase)
    shake = harmonic_sum(case.way, phase)
    at = (int(np.argmin(one)) + i) % knobs.steps
    return one[at], v_0 * dt * i + shake[at], dt


def _friction(F_x: Array, F_z: Array, ratios: list[float]) -> Friction:
    return Friction(ratios[-1], float(F_x.mean()), float(F_z.mean()), _settling(ratios), len(ratios))


def _settling(ratios: list[float]) -> float:
    """The sum of a geometric series that goes on as the last two changes; the last change, where it does not fall."""
    if len(ratios) < 3:
        return abs(ratios[-1] - ratios[0]) if len(ratios) > 1 else np.nan
    last, before = abs(ratios[-1] - ratios[-2]), abs(ratios[-2] - ratios[-3])
    return last if not before else last / max(1 - last / before, 0.1)


def stuck(contact: Contact, step: Step) -> Array:
    """Which cells stick in a step, (n, n)."""
    below = np.hypot(*step.tractions[:2]) < BELOW * contact.mu_0 * step.pressure
    return np.asarray((step.pressure > 0) & below)


def _share_stuck(contact: Contact, step: Step) -> float:
    touching = np.count_nonzero(step.pressure)
    return np.count_nonzero(stuck(contact, step)) / touching if touching else np.nan
