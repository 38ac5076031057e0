"""The normal force over one period, of any shape, amplitude, material and periodic depth, in closed form but for arms.

It is the same whatever the springs do in the plane. On an elastic or Kelvin material contact_edge.py knows the gap g_c
of the spring at the edge of the contact at any instant, under any periodic depth. The force follows from the elastic
law alone,

    F_N = E* [2 a(g_c) (u_z - g_c + tau u_z') + F(g_c)/E*].

What arms add to it is followed spring by spring: the difference between the material and the same one without its arms
(followed_force.py). Two forces are known beforehand, harmonic by harmonic: that under an oscillating load,
F_N = F_z(t) - m_z u_z'', and one that oscillates by little, by its linear law K_z(n omega) u_n. Of the difference of
two forces that nearly agree too much is rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mdr.case.contact import SlidingContact
from mdr.case.depth_cycle import harmonic_sum
from mdr.case.motion import LoadOscillation
from mdr.indenters.mapping.quadrature import double_exponential
from mdr.materials.operator import Rheology
from mdr.normal.contact_edge import ContactEdge
from mdr.normal.followed_force import N_STEPS, NormalCycle, followed_springs, normal_cycle
from mdr.normal.load_control import LINEAR
from mdr.normal.resolved import resolved
from mdr.tools.arrays import SAME, Array
from mdr.tools.memoise import remembered

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline, PchipInterpolator

EDGE_GAPS = 257  #: depths of springs that tell where the edge of contact is, with arms
FIRST = 1e-30  #: depth of a first touch, over the unit of depth


@remembered(maxsize=8)
def followed(case: SlidingContact, n_t: int = N_STEPS) -> NormalCycle:
    """The normal contact of a case spring by spring, at n_t instants."""
    known = normal_cycle(case.indenter, case.rheology, case.cycle, n_t, beside=Rheology(case.T))
    if not known.in_contact.any() or not known.F_N.any():
        raise ValueError(
            f"u_z0 = {case.cycle.u_z0:.6g} m: the contact lasts less than 1/{n_t} of a period, as its springs are "
            "touched so late, or released so soon, by their dashpots; press deeper, or lower tau"
        )
    return known


@remembered(maxsize=8)
def _added_by_arms(case: SlidingContact) -> Array:
    """What the arms of a material add to F_N [N], at N_STEPS instants."""
    bare = normal_cycle(case.indenter, Rheology(case.T), case.cycle, beside=case.rheology)
    return case.material.E_star * (followed(case).F_N - bare.F_N)


def edge_of(case: SlidingContact) -> ContactEdge:
    """The edge of the contact without what arms change of it."""
    return ContactEdge.of(case.cycle, case.T)


def normal_force(case: SlidingContact, phase: Array) -> Array:
    """F_N [N] in full slip at phases omega t of any shape, of a case of known depth."""
    if (known := known_harmonics(case)) is not None:
        return known[0] + harmonic_sum(known[1], phase)
    F_N = _without_arms(case, phase)[0]
    return np.maximum(F_N + _of_arms(case)(phase) if case.material.contact_arms else F_N, 0)


def normal_force_rate(case: SlidingContact, phase: Array, slope: Callable[[Array], Array]) -> Array:
    """dF_N/dphase [N], with 2 E* a(g_c) [d(u_z + tau u_z') + (u_z - g_c + tau u_z') d ln a(g_c)]: only the contact
    radius has no derivative in closed form, which `slope` answers from its values at the phases.
    """
    if (known := known_harmonics(case)) is not None:
        F_n = known[1]
        return harmonic_sum(1j * np.arange(1, F_n.size + 1) * F_n, phase)
    n, cycle = np.arange(1, case.cycle.cos.size + 1), case.cycle
    _, k_zc, above = _without_arms(case, phase)
    of_depth = k_zc * cycle.unit * harmonic_sum(1j * n * (1 + 1j * n * case.T) * cycle.harmonics, phase)
    rate = of_depth + above * slope(k_zc)
    return np.asarray(rate + _of_arms(case)(phase, 1) if case.material.contact_arms else rate)


def _without_arms(case: SlidingContact, phase: Array) -> tuple[Array, Array, Array]:
    """F_N [N], 2 E* a(g_c) [N/m] and u_z - g_c + tau u_z' [m] of the material without its arms."""
    cycle, E_star = case.cycle, case.material.E_star
    edge = edge_of(case).gap(phase)
    g_c = cycle.u_z0 + cycle.unit * edge
    above = cycle.unit * (cycle.z(phase) - edge + case.T * cycle.rate(phase))
    k_zc = np.asarray(case.indenter.stiffness(g_c, E_star))
    return np.asarray(case.indenter.force(g_c, E_star)) + k_zc * above, k_zc, above


def _of_arms(case: SlidingContact) -> CubicSpline:
    """What the arms of a material add to F_N [N], over the phase."""
    from scipy.interpolate import CubicSpline

    added = _added_by_arms(case)
    return CubicSpline(2 * np.pi * np.arange(added.size + 1) / added.size, [*added, added[0]], bc_type="periodic")


def known_harmonics(case: SlidingContact) -> tuple[float, NDArray[np.complex128]] | None:
    """Mean [N] and harmonics F_n [N], n = 1 ... N, of F_N where they are known beforehand; None elsewhere."""
    load, cycle = case.oscillation.load, case.cycle
    n = np.arange(1, cycle.cos.size + 1)
    if isinstance(load, LoadOscillation):
        F_n = load.m_z * case.omega**2 * cycle.unit * n**2 * cycle.harmonics
        F_n[case.repeats[0] - 1] += load.dF_z
        return load.F_z0, F_n
    mean = float(case.indenter.force(case.working_depth, case.material.E_star)) if case.k_zc else 0.0
    mean = mean if load is None else load.F_z0
    F_n = case.dynamic_stiffness(case.omega * n) * cycle.unit * cycle.harmonics
    return (mean, F_n) if np.abs(F_n).sum() < LINEAR * mean else None


def contact_radius(case: SlidingContact, phase: Array) -> Array:
    """Radius of contact [m] at phases omega t of any shape, of a case of known depth: up to where springs press."""
    cycle = case.cycle
    depth = cycle.u_z0 + cycle.unit * pressing_edge(case).gap(phase)
    return np.asarray(case.indenter.contact_radius(np.maximum(depth, 0.0)))


@dataclass(frozen=True, eq=False)
class FollowedEdge:
    """The edge of the contact of a material with arms, as far as springs were followed."""

    curve: PchipInterpolator  #: gap over the phase
    least: float  #: gap of the deepest place; below it where contact is lost

    def gap(self, phase: Array) -> Array:
        """Gap of the spring at the edge, at phases of any shape."""
        gap = self.curve(np.mod(phase, 2 * np.pi))
        return np.where(gap > self.least, gap, self.least - SAME)

    def crossings(self, gap: float) -> tuple[list[float], list[float]]:
        """Phases at which the spring of a gap touches, and at which it leaves."""
        if gap < self.least - SAME:
            return [], []
        at = self.curve.solve(max(gap, self.least + SAME), extrapolate=False)  # it is at the least gap while in flight
        at = at[(at >= 0) & (at < 2 * np.pi)]
        rises = self.curve(at, 1) > 0
        return at[rises].tolist(), at[~rises].tolist()


def pressing_edge(case: SlidingContact) -> ContactEdge | FollowedEdge:
    """The edge of the contact, with what arms change of it."""
    return _followed_edge(case) if case.material.contact_arms else edge_of(case)


@remembered(maxsize=8)
def _followed_edge(case: SlidingContact) -> FollowedEdge:
    """Gap at the edge of contact over the phase, with arms: springs at close depths are followed, and the phases at
    which each touches and is let go are points of the curve.
    """
    from scipy.interpolate import PchipInterpolator

    cycle, rheology = case.cycle, case.rheology
    low, high = max(case.kept_gap, -cycle.u_z0 / cycle.unit), cycle.greatest
    gap = low + (high - low) * np.sin(np.linspace(0, np.pi / 2, EDGE_GAPS)) ** 2  # closest where it turns
    known = followed_springs(rheology, gap, np.ones(EDGE_GAPS), cycle, N_STEPS)
    f, since = known.force, known.pressed_for
    before = np.roll(since, 1, axis=0)
    k, touched = np.nonzero((since > 0) & ((since < 1) | (before == 0)))
    j, left = np.nonzero((since == 0) & (before > 0))
    last, falls = f[j - 1, left], f[j - 2, left] - f[j - 1, left]  # the force goes to zero on a line
    steps = 2 * np.pi / N_STEPS * np.arange(float(N_STEPS))
    bears = harmonic_sum(cycle.harmonics * rheology.response(np.arange(1.0, cycle.cos.size + 1)), steps)
    turns = [np.argmax(cycle.z(steps))] + [np.argmin(bears)] * case.keeps_contact
    times = np.concatenate([turns, k + 1 - since[k, touched], j + np.clip(last / np.maximum(falls, 1e-300), 0, 1)])
    time, at = np.unique(times % N_STEPS, return_index=True)
    place = np.concatenate([[high], [low] * case.keeps_contact, gap[touched], gap[left]])[at]
    time = np.concatenate([time - N_STEPS, time, time + N_STEPS])
    return FollowedEdge(PchipInterpolator(2 * np.pi / N_STEPS * time, np.tile(place, 3)), low)


def first_radius(case: SlidingContact) -> float:
    """Radius of contact [m] as soon as it touches: that of a flat face, zero of a tip."""
    return float(case.indenter.contact_radius(max(FIRST * case.cycle.unit, case.indenter.least_depth * (1 + SAME))))


def mean_area(case: SlidingContact, radius: Callable[[Array], Array] = np.asarray) -> float:
    """Mean area of contact [m²] over the period, or of the disc with this radius of that of contact."""
    if case.material.contact_arms:
        a = contact_radius(case, 2 * np.pi / N_STEPS * (np.arange(float(N_STEPS)) + 0.5))
        known, touch = followed(case), first_radius(case)
        # a flat face is there at once, whenever in a step that is
        lost = float(np.mod(known.touches - known.leaves, 2 * np.pi).sum()) / (2 * np.pi)
        return float(np.pi * (np.mean(radius(np.maximum(a, touch)) ** 2) - radius(np.array(touch)) ** 2 * lost))
    return 0.5 * _integral(case, lambda phase: radius(contact_radius(case, phase)) ** 2)


def edge_marks(case: SlidingContact, joints: bool) -> tuple[float, ...]:
    """Gaps at which the edge of the contact crosses the tip, a kink or the rim, where a(d) is not smooth, or friction
    is not in a; with joints also those at which pieces of a curve meet, where it is as smooth as a spline.
    """
    shape, cycle = case.indenter, case.cycle
    rim = [shape.max_radius] if np.isfinite(shape.max_radius) else []
    radii = [*(shape.joints if joints else shape.kinks), *case.friction.kinks, *rim]
    depths = {0.0, *(shape.profile_1d(np.array(radii)).tolist() if radii else ())}
    gaps, kept = {(depth - cycle.u_z0) / cycle.unit for depth in depths}, cycle.kept_gap(Rheology(case.T).response)
    return tuple(sorted(gap for gap in gaps if kept < gap < cycle.greatest))


def corners(case: SlidingContact, joints: bool = False) -> Array:
    """Phases at which F_N without arms is not smooth, ascending: the edge turns, or crosses one of the marks."""
    edge = edge_of(case)
    crossed = [phase for gap in edge_marks(case, joints) for some in edge.crossings(gap) for phase in some]
    return np.unique(np.mod([*edge.begins, *crossed], 2 * np.pi))


def mean_normal_force(case: SlidingContact) -> float:
    """Mean of F_N over the period [N], by the double-exponential rule between the instants at which it is not smooth.

    While springs slide, stick or fly their mean force is that of their mean compression: it is the same in any run.
    """
    case = resolved(case)
    if (known := known_harmonics(case)) is not None:
        return known[0]
    mean = _integral(case, lambda phase: _without_arms(case, phase)[0]) / (2 * np.pi)
    return mean + float(_added_by_arms(case).mean()) if case.material.contact_arms else mean


def full_cof(case: SlidingContact) -> float:
    """Mean friction of full slip over the mean normal force [-], of a case of known depth: mu_0, and what a shear
    strength adds, tau_0 times the mean area on which it acts.
    """
    law = case.friction
    if not law.needs_area:
        return law.mu_0
    return law.mu_0 + law.tau_0 * mean_area(case, law.strong_radius) / mean_normal_force(case)


def _integral(case: SlidingContact, function: Callable[[Array], Array]) -> float:
    """Of a function of the phase over the period, which is smooth where the edge of the contact is."""
    instants = corners(case, joints=True)
    return float(double_exponential().integral(function, np.append(instants, instants[0] + 2 * np.pi)))
