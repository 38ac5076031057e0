"""Friction of a case under a rigid pull in three dimensions, and of its springs in the same steps."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

import mdr
from mdr.motion import DepthMotion
from validation.half_space import springs
from validation.half_space.influence import HalfSpace, X, Z
from validation.half_space.march import Contact

Array = NDArray[np.float64]

MARGIN = 1.06  #: of the grid around the greatest contact
OUT_OF_REACH = 1e3  #: depths, where a shape has ended


@dataclass(frozen=True)
class Knobs:
    """Cells along each side, steps of a period, periods, and what is left out of the half-space."""

    cells: int = 41
    steps: int = 100
    cycles: int = 2
    coupled: bool = True
    transverse: bool = True


@dataclass(frozen=True)
class Friction:
    """Mean forces [N] over the last period and their ratio; `drift` is its change from the period before."""

    cof: float
    mean_F_x: float
    mean_F_z: float
    drift: float  #: of the COF; NaN with a single period
    turns: float  #: mean number of turns of pressure and tractions in a step


def in_three_dimensions(case: mdr.SlidingContact, v_0: float, knobs: Knobs) -> Friction:
    """Friction of the half-space, from full slip at the least depth on. Raises NotConverged, ValueError."""
    contact = contact_of(case, knobs)
    depth, way, dt = path(case, v_0, knobs)
    forces, turns = [], []
    for step in contact.march(contact.full_slip(float(depth[0])), depth, way, dt):
        forces.append(contact.forces(step.tractions))
        turns.append(step.turns)
    F = np.array(forces)
    return _averaged(F[:, X], F[:, Z], knobs.steps, float(np.mean(turns)))


def of_springs(case: mdr.SlidingContact, v_0: float, knobs: Knobs) -> Friction:
    """Friction of independent springs in the very steps of `in_three_dimensions`."""
    depth, way, dt = path(case, v_0, knobs)
    material = case.material
    F_x, F_z = springs.forces(
        case.indenter.profile_1d, float(case.indenter.contact_radius(depth.max())), depth, way, dt,
        case.mu_0, material.mindlin_ratio, material.tau,
    )  # fmt: skip
    return _averaged(F_x[1:] * material.E_star, F_z[1:] * material.E_star, knobs.steps, 0.0)


def contact_of(case: mdr.SlidingContact, knobs: Knobs) -> Contact:
    """The grid that holds the contact at its greatest, and the shape on it; ValueError for what it cannot judge."""
    if not isinstance(case.pull, mdr.RigidPull) or not isinstance(case.oscillation, DepthMotion):
        raise ValueError("the half-space takes a rigid pull and a given depth: leave [pull] out, and give u_z0")
    if case.material.contact_arms:
        raise ValueError("the half-space is elastic or Kelvin: choose Elastic, ElasticPair or KelvinVoigt")
    shape, material = case.indenter, case.material
    deepest = float(path(case, 1.0, replace(knobs, cycles=1))[0].max())
    side = 2 * MARGIN * float(shape.contact_radius(deepest))
    h = side / knobs.cells
    places = (np.arange(knobs.cells) - (knobs.cells - 1) / 2) * h
    r = np.hypot(places[:, None], places[None, :])
    height = np.full(r.shape, OUT_OF_REACH * deepest)
    height[r <= shape.max_radius] = shape.profile_3d(r[r <= shape.max_radius])
    beta = material.dundurs_beta if knobs.coupled else 0.0
    half_space = HalfSpace(knobs.cells, h, material.E_star, material.G_star, beta, knobs.transverse)
    return Contact(half_space, height, case.mu_0, material.tau)


def path(case: mdr.SlidingContact, v_0: float, knobs: Knobs) -> tuple[Array, Array, float]:
    """Depth and way at the instants, (steps * cycles + 1,), from the least depth on, and the step [s]."""
    motion = case.oscillation
    assert isinstance(motion, DepthMotion)
    dt = motion.period / knobs.steps
    one = motion.u_z(dt * np.arange(knobs.steps))
    first = int(np.argmin(one))
    i = np.arange(knobs.steps * knobs.cycles + 1)
    return one[(first + i) % knobs.steps], v_0 * dt * i, dt


def _averaged(F_x: Array, F_z: Array, steps: int, turns: float) -> Friction:
    ratios = [float(F_x[a : a + steps].sum() / F_z[a : a + steps].sum()) for a in range(0, F_x.size, steps)]
    drift = ratios[-1] - ratios[-2] if len(ratios) > 1 else np.nan
    return Friction(ratios[-1], float(F_x[-steps:].mean()), float(F_z[-steps:].mean()), drift, turns)
