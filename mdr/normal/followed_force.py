"""The normal force over one period of any depth, for any shape and material, spring by spring.

Springs that keep contact answer harmonic by harmonic with the dynamic modulus, exactly. Those of the edge band, which
touch and leave, are followed through the period until it repeats (mdr/spring/settle.py). Their sum is taken up to the
edge of the contact, at which dashpots jump, to third order in their width. Where the depth is harmonic and the material
has no arms, normal_force.py has the closed form of the same force; that these agree is a test.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mdr.case.depth_cycle import Cycle, at_instants
from mdr.indenters.base import Indenter
from mdr.materials.operator import Rheology
from mdr.normal.spring_grid import Depths, nodes
from mdr.tools.arrays import Array
from mdr.tools.records import ArrayRecord

if TYPE_CHECKING:
    from mdr.spring.settle import NormalPeriod

N_STEPS = 2048  #: of the period


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
    n_edge: int = 128,
    beside: Rheology | None = None,
) -> NormalCycle:
    """Normal contact through a cycle of depth, in n_t steps, with n_edge springs that touch and leave.

    beside: another operator, whose springs stand at the same places, so that the two differ by the material alone.
    """
    kept = min(cycle.kept_gap(one.response) for one in (rheology, beside or rheology))
    x, gap, width, n_core = nodes(shape, Depths.of(cycle, kept), n_edge)
    gap = gap / cycle.unit
    F, S, radius = np.zeros(n_t), np.zeros(n_t), np.full(n_t, 0.5 * float(width[:n_core].sum()))
    if n_core:
        response, depth = rheology.response(np.arange(1.0, cycle.cos.size + 1)), float(width[:n_core] @ gap[:n_core])
        F += 2 * radius[0] * at_instants(cycle.harmonics * response, n_t) - depth
        S += 2 * radius[0] * at_instants(cycle.harmonics, n_t) - depth
    in_contact, touches, leaves = np.ones(n_t, dtype=bool), np.empty(0), np.empty(0)
    if n_core < gap.size:
        band = followed_springs(rheology, gap[n_core:], width[n_core:], cycle, n_t)
        S += band.compression
        F, radius = _with_band(F, radius, band, x[n_core:], width[n_core:])
        if not n_core:
            in_contact, touches, leaves = _tip(rheology, cycle, n_t)
    return NormalCycle(F * cycle.unit, S * cycle.unit, radius, in_contact, touches, leaves)


def _with_band(F: Array, radius: Array, band: NormalPeriod, x: Array, width: Array) -> tuple[Array, Array]:
    """Force and radius of contact, (n_t,), with the springs that touch and leave; x, width: theirs, outwards.

    A sum over the springs that press is an integral up to the end of the cell of the last one. From there to the
    edge of the contact the force is linear, as between the last two springs: all is of third order in the width of
    a cell. The end of a midpoint rule adds its own term, width² slope/24.
    """
    force, since = _at_instants(band)
    now, presses, cell = np.arange(F.size), since > 0, 0.5 * width
    last = x.size - 1 - np.argmax(presses[:, ::-1], axis=1)
    behind, f = np.maximum(last - 1, 0), force[now, last]
    with np.errstate(invalid="ignore"):
        slope = np.nan_to_num((f - force[now, behind]) / (x[last] - x[behind]))
    to_end = (radius[0] + np.cumsum(cell) - x)[last]
    to_edge = _to_edge(x, last, f, slope, to_end, since)
    rest = (to_edge - to_end) * f + 0.5 * slope * (to_edge**2 - to_end**2 + cell[last] ** 2 / 12)
    some = presses.any(axis=1)
    return F + force @ width + np.where(some, 2 * rest, 0), np.where(some, x[last] + to_edge, radius)


def _to_edge(x: Array, last: Array, f: Array, slope: Array, to_end: Array, since: Array) -> Array:
    """From the last spring that presses to the edge of the contact, (n_t,).

    The edge of a growing contact passes by springs as they touch: a parabola in time through the last two and the
    next one. Another contact ends where the force has fallen to zero.
    """
    now, behind, ahead = np.arange(last.size), np.maximum(last - 1, 0), np.minimum(last + 1, x.size - 1)
    touched, touches = _touches(since)
    t_0, t_1, t_2 = touched[now, behind], touched[now, last], touches[now, ahead]
    to_next = x[ahead] - x[last]
    with np.errstate(all="ignore"):  # springs that touch at once, or never
        pace = to_next / (t_2 - t_1)
        bend = np.nan_to_num((pace - (x[last] - x[behind]) / (t_1 - t_0)) / (t_2 - t_0))
        grown = (now - t_1) * (pace + bend * (now - t_2))
        shrunk = np.where(slope < 0, -f / slope, to_end)
    to_edge = np.clip(np.where(t_2 < touches[now, last], grown, shrunk), 0, to_next)
    return np.where(ahead > last, to_edge, to_end)


def _touches(since: Array) -> tuple[Array, Array]:
    """Instants, in steps, of the last touch of each spring and of its next one, (n_t, n); NaN for none."""
    n_t = since.shape[0]
    begins = (since > 0) & (np.roll(since, 1, axis=0) <= 0)
    at = np.where(begins, np.arange(n_t)[:, None] - since, np.nan)
    touched = np.fmax.accumulate(np.concatenate([at - n_t, at]))[n_t:]
    touches = np.fmin.accumulate(np.concatenate([at, at + n_t])[::-1])[::-1]
    return touched, touches[1 : n_t + 1]


def _tip(rheology: Rheology, cycle: Cycle, n_t: int) -> tuple[NDArray[np.bool_], Array, Array]:
    """When the tip itself presses (n_t,), slightly longer than the first spring does; phases at which it touches, and
    at which its force has fallen to zero.
    """
    tip = followed_springs(rheology, np.array([-cycle.u_z0 / cycle.unit]), np.ones(1), cycle, n_t)
    force, shares = (values[:, 0] for values in _at_instants(tip))
    presses = shares > 0
    begins = np.flatnonzero(presses & ~np.roll(presses, 1))
    last = np.flatnonzero(presses & ~np.roll(presses, -1))
    fall = force[last - 1] - force[last]
    with np.errstate(divide="ignore", invalid="ignore"):
        more = np.where((fall > 0) & (force[last] < fall), force[last] / fall, 0.0)
    step = 2 * np.pi / n_t
    return presses, step * ((begins - shares[begins]) % n_t), np.asarray(step * ((last + more) % n_t))


def followed_springs(rheology: Rheology, gap: Array, w: Array, cycle: Cycle, n_t: int) -> NormalPeriod:
    """The periodic motion of springs of these gaps, over the unit of the cycle, and weights, in n_t steps."""
    from mdr.spring.law import law_of  # what is compiled waits until springs are followed
    from mdr.spring.settle import settled

    law = law_of(rheology.T, rheology.rho, rheology.theta)
    known = settled(gap, w, *cycle.over_a_period(n_t), law, each=True)
    if known is None:
        raise ValueError(
            "the normal motion of springs with these arms does not become periodic: an arm relaxes within less "
            f"than 1/{n_t} of a period, or is far stiffer than E_inf; leave out what is so fast, or merge arms"
        )
    return known


def _at_instants(known: NormalPeriod) -> tuple[Array, Array]:
    """At the instants, from phase 0, force and share of the step before for which a spring has pressed, (n_t, n)."""
    return np.roll(known.force, 1, axis=0), np.roll(known.pressed_for, 1, axis=0)
