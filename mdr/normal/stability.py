"""A mass under an oscillating load: the greatest Floquet multiplier of its depth, and what is unlikely of it.

A small deviation v of a periodic depth obeys m_z v'' + dF_N = 0. A spring that presses is compressed by v more, one
that is free relaxes from what it had, and one that touches earlier or later presses by the dashpot's share of what v
and its own compression differ by. So the modes of the periodic motion are all that has to be known. Over a step forces
are those of its middle; without dashpot and arms this keeps the area of the phase plane, and with it the modulus 1 of a
stable deviation, to rounding.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.case.depth_cycle import Cycle
from mdr.case.motion import LoadOscillation
from mdr.indenters.base import Indenter
from mdr.indenters.mapping.quadrature import double_exponential
from mdr.materials.base import Material
from mdr.materials.operator import Rheology
from mdr.normal.followed_force import N_STEPS, followed_springs
from mdr.normal.spring_grid import Depths, nodes
from mdr.tools.arrays import SAME
from mdr.tools.memoise import remembered
from mdr.tools.notation import GRAVITY


@remembered(maxsize=64)
def floquet_multiplier(shape: Indenter, material: Material, load: LoadOscillation, cycle: Cycle) -> float:
    """Modulus of the greatest Floquet multiplier [-] of a periodic depth under a load with mass.

    A deviation grows by this factor in a period: above 1 the depth is unstable.
    """
    rheology, h = Rheology.periodic(material, load.omega), 2 * np.pi / N_STEPS
    depths = Depths.of(cycle, cycle.kept_gap(rheology.response))
    _, gap, width, n_core = nodes(shape, depths, 32)  # that touch and leave
    n_kept = min(n_core, 1)  # springs that press throughout are one
    width = np.concatenate([[width[:n_core].sum()][:n_kept], width[n_core:]])
    band = followed_springs(rheology, gap[n_core:] / cycle.unit, width[n_kept:], cycle, N_STEPS)
    presses = np.ones((N_STEPS + 1, width.size), dtype=bool)
    presses[1:, n_kept:] = band.pressed_for > 0
    presses[0] = presses[-1]
    M = load.m_z * load.omega**2 / material.E_star
    T, rho, theta = rheology.T, np.array(rheology.rho), np.array(rheology.theta)
    decay, gain = np.exp(-h / theta), -np.expm1(-h / theta) * theta / h  # of arms that are held
    lag, of_arms = T / h + float(rho * theta / h @ (1 - gain)), rho * theta / h * (1 - decay)
    from mdr.spring.law import law_of

    modes = law_of(T, rheology.rho, rheology.theta).modes
    free = np.zeros((1, 1)) if modes is None else modes.out * np.exp(-modes.mu * h) @ modes.into
    n = width.size
    v, p, *rest = np.eye(2 + n * (1 + rho.size))  # columns: deviations to begin with
    x = np.array(rest).reshape(1 + rho.size, n, -1)
    for before, after in pairwise(presses):
        static, rate = 0.5 * (width * before + width * after), width * np.where(after, 1.0, 0.5 * before)
        A = 0.5 * static.sum() + lag * rate.sum()
        B = 0.5 * static.sum() * v + np.concatenate([[-lag], of_arms]) @ (rate @ x)
        end = (v + h * p - h**2 / (2 * M) * B) / (1 + h**2 * A / (2 * M))
        p, v = 2 * (end - v) / h - p, end
        arms = decay[:, None, None] * x[1:] + gain[:, None, None] * (v - x[0])
        held = np.concatenate([np.broadcast_to(v, x[:1].shape), arms])
        x = np.where(after[:, None], held, np.tensordot(free, x, 1))
    return float(np.abs(np.linalg.eigvals(np.concatenate([[v, p], *x]))).max())


def doubts_of_load(known: SlidingContact) -> Iterator[str]:
    """What is unlikely of a mass that an oscillating load moves, in a case of known depth: see `mdr.case.doubts`."""
    load = known.oscillation.load
    if not isinstance(load, LoadOscillation) or load.m_z == 0:
        return
    m_z = load.m_z
    if load.dF_z > load.F_z0:
        yield (
            f"the amplitude of the load, dF_z = {load.dF_z:.4g} N, is above its mean, F_z0 = {load.F_z0:.4g} N, so "
            "that the load pulls up in part of each period; if this is not meant, the two may be swapped"
        )
    if known.oscillation.knows_depth:
        grows = floquet_multiplier(known.indenter, known.material, load, known.oscillation.cycle)
        if grows > 1.001:  # without damping it is 1 of a stable depth
            yield (
                f"the periodic depth that was found under the load is unstable: a deviation grows {grows:.3g} times in "
                "a period (its Floquet multiplier), so that m_z will move in another way, in another rhythm or in "
                "none; lower dF_z, move omega, or damp it"
            )
        elif not known.keeps_contact:
            yield (
                "the mass under the load leaves the surface in every period: the periodic motion that was found is "
                f"stable (Floquet multiplier {grows:.3g}), but a bouncing mass may move in several ways"
            )
    softened = _softened(known, load)
    # the closed form is off by about as much
    if softened > 0.03:
        what = "would open the contact, or leave the shape"
        if softened < np.inf:
            what = f"changes the stiffness of the contact by {softened:.2g} of what m_z omega² leaves of it"
        yield (
            "dF_z is too great for critical_velocity(case), or omega too near the natural frequency of m_z on the "
            f"contact: the amplitude of depth that a small load would have {what}, and the closed form is off by "
            "about as much; full_slip_critical_velocity(case) takes the depth that the load brings about"
        )
    # springs may carry some of the weight
    if m_z * GRAVITY > 10.0 * load.F_z0:
        yield (
            f"the weight of m_z, {m_z * GRAVITY:.4g} N, is {m_z * GRAVITY / load.F_z0:.3g} times the mean load: is it "
            "in grams, or is the load given without the weight?"
        )


def _softened(known: SlidingContact, load: LoadOscillation) -> float:
    """How much the stiffness of the contact differs at the amplitude of depth of a small load, over K_z - m_z omega².

    Its stiffness at an amplitude is the first harmonic of an elastic force over it, at the mean depth that carries the
    mean load (describing function). Infinite where that amplitude would open the contact, or is beyond the shape.
    """
    shape, E_star, d = known.indenter, known.material.E_star, known.working_depth
    k_z, K_z = known.k_zc, complex(known.dynamic_stiffness(load.omega))
    left = abs(K_z - load.m_z * load.omega**2)
    if load.dF_z >= d * left:
        return np.inf
    rule, mean, step = double_exponential(), d, np.inf
    swing = load.dF_z / left * np.cos(np.pi * rule.from_low)
    try:
        while step > SAME * mean:  # Newton's method, from above on: the mean force is convex in the mean depth
            u_z = np.maximum(mean + swing, 0)
            F_z = np.asarray(shape.force(u_z, E_star))
            step = float((rule.weight @ F_z - load.F_z0) / (rule.weight @ np.asarray(shape.stiffness(u_z, E_star))))
            mean -= step
    except ValueError:
        return np.inf
    weight = rule.weight * swing
    return float(abs(weight @ F_z / (weight @ swing) / k_z - 1) * abs(K_z) / left)
