"""The normal force over one period of any depth, for any shape and material, spring by spring.

Springs that keep contact answer harmonic by harmonic with the dynamic modulus, exactly. Those of the edge band, which
touch and leave, are followed through the period until it repeats, with a force that is known at its instants to second
order in step and width (kernels.py). Where the depth is harmonic and the material has no arms, full_slip.py has
the closed form of the same force; that these agree is a test.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mdr.case.depth_cycle import Cycle
from mdr.indenters.base import Indenter
from mdr.march import kernels
from mdr.materials.operator import Rheology
from mdr.normal.spring_grid import cells
from mdr.tools.arrays import Array
from mdr.tools.records import ArrayRecord

N_EDGE = 512  #: springs
N_STEPS = 4096  #: of the period


@dataclass(frozen=True, eq=False, repr=False)
class NormalCycle(ArrayRecord):
    """One period of normal contact at equidistant instants, arrays of shape (n_t,)."""

    F_N: Array  #: normal force over E* [m²]
    compression: Array  #: sum over the springs of width times compression [m²]
    contact_radius: Array  #: half the width of the springs that press [m]
    in_contact: NDArray[np.bool_]  #: whether the deepest spring presses
    touches: Array  #: phases at which it touches, (n,); none where it keeps contact
    leaves: Array  #: and at which it leaves


def normal_cycle(
    shape: Indenter,
    rheology: Rheology,
    cycle: Cycle,
    n_t: int = N_STEPS,
    n_edge: int = N_EDGE,
    beside: Rheology | None = None,
) -> NormalCycle:
    """Normal contact through a cycle of depth.

    beside: another operator, whose springs stand at the same places, so that the two differ by the material alone.
    """
    kept = min(cycle.kept_gap(one.response) for one in (rheology, beside or rheology))
    x, gap, width, n_core = cells(shape, cycle, kept, n_edge)
    gap = gap / cycle.unit
    F, S, radius = np.zeros(n_t), np.zeros(n_t), np.full(n_t, 0.5 * float(width[:n_core].sum()))
    if n_core:
        response, depth = rheology.response(np.arange(1.0, cycle.cos.size + 1)), float(width[:n_core] @ gap[:n_core])
        F += 2 * radius[0] * of_harmonics(cycle.harmonics * response, n_t) - depth
        S += 2 * radius[0] * of_harmonics(cycle.harmonics, n_t) - depth
    in_contact, touches, leaves = np.ones(n_t, dtype=bool), np.empty(0), np.empty(0)
    if n_core < gap.size:
        F, radius = _Band(x[n_core:], gap[n_core:], width[n_core:]).press(F, S, radius, rheology, cycle)
        if not n_core:
            in_contact, touches, leaves = _tip(rheology, cycle, n_t)
    return NormalCycle(F * cycle.unit, S * cycle.unit, radius, in_contact, touches, leaves)


@dataclass(frozen=True, eq=False)
class _Band:
    """The springs that touch and leave, from the centre outwards; gap in du_z."""

    x: Array
    gap: Array
    width: Array

    def press(self, F: Array, S: Array, radius: Array, rheology: Rheology, cycle: Cycle) -> tuple[Array, Array]:
        """Force and radius of contact with the band, (n_t,); adds to S (n_t,) what the band is compressed by.

        A spring stands for its whole cell. Where contact grows the edge has come part of the way to the next spring,
        and that part of the cells between them presses like the last one: dashpots would jump without it.
        """
        n_t = F.size
        z, rate = cycle.over_a_period(n_t)
        outermost, at_edge, begins = np.empty(n_t, dtype=np.int64), np.empty(n_t), np.empty(self.x.size)
        table = rheology.over_step(2 * np.pi / n_t)
        kernels.normal_forces(self.gap, self.width, z, rate, table, F, S, outermost, at_edge, begins)
        if np.isnan(F).any():
            raise ValueError(
                "the normal motion of springs with these arms does not become periodic: an arm relaxes within less "
                f"than 1/{n_t} of a period, or is far stiffer than E_inf; leave out what is so fast, or merge arms"
            )
        some = outermost >= 0
        last = np.maximum(outermost, 0)
        ends = radius[0] + 0.5 * np.cumsum(self.width)
        ahead = np.minimum(last + 1, self.x.size - 1)
        since, way = (np.arange(n_t) - begins[last]) % n_t, (begins[ahead] - begins[last]) % n_t
        with np.errstate(invalid="ignore", divide="ignore"):
            grows = some & (ahead > last) & (since < way) & (way < n_t / 2)
            edge = np.where(grows, self.x[last] + since / way * (self.x[ahead] - self.x[last]), ends[last])
        F = F + 2 * (edge - ends[last]) * at_edge
        return F, np.where(some, edge, radius)


def _tip(rheology: Rheology, cycle: Cycle, n_t: int) -> tuple[NDArray[np.bool_], Array, Array]:
    """When the tip itself presses (n_t,), slightly longer than the first spring does; phases at which it touches, and
    at which its force has fallen to zero.
    """
    z, rate = cycle.over_a_period(n_t)
    force, shares, path = np.empty((3, n_t))
    table = rheology.over_step(2 * np.pi / n_t)
    state, guess = np.zeros((2, table.shape[1]))
    kernels.settle_spring(state, guess, -cycle.u_z0 / cycle.unit, z, rate, table, force, shares, path)
    presses = shares > 0
    begins = np.flatnonzero(presses & ~np.roll(presses, 1))
    last = np.flatnonzero(presses & ~np.roll(presses, -1))
    fall = force[last - 1] - force[last]
    with np.errstate(divide="ignore", invalid="ignore"):
        more = np.where((fall > 0) & (force[last] < fall), force[last] / fall, 0.0)
    step = 2 * np.pi / n_t
    return presses, step * ((begins - shares[begins]) % n_t), np.asarray(step * ((last + more) % n_t))


def shares_of_contact(rheology: Rheology, gaps: Array, cycle: Cycle, n_t: int) -> Array:
    """For springs of these gaps, over the unit of the cycle, above zero at the nodes at which they press, (n, n_t):
    there the share of the step since they touched.
    """
    z, rate = cycle.over_a_period(n_t)
    table = rheology.over_step(2 * np.pi / n_t)
    out, (force, path), (state, guess) = np.empty((gaps.size, n_t)), np.empty((2, n_t)), np.zeros((2, table.shape[1]))
    for gap, shares in zip(gaps, out, strict=True):
        kernels.settle_spring(state, guess, gap, z, rate, table, force, shares, path)
    return out


def of_harmonics(harmonics: NDArray[np.complex128], n_t: int) -> Array:
    """Re of sum C_n exp(i n phase), n = 1 ... N, at n_t equidistant phases; N < n_t/2."""
    spectrum = np.zeros(n_t // 2 + 1, dtype=complex)
    n = min(harmonics.size, n_t // 2 - 1)
    spectrum[1 : n + 1] = harmonics[:n] * n_t / 2
    return np.fft.irfft(spectrum, n_t)
