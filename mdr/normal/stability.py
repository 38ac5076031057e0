"""Stability of a depth under an oscillating load with mass: its greatest Floquet multiplier.

A small deviation v of a periodic depth obeys m_z v'' + dF_N = 0. A spring that presses is compressed by v more, one
that is free relaxes from what it had, and one that touches earlier or later presses by the dashpot's share of what v
and its own compression differ by. So the modes of the periodic motion are all that has to be known. Over a step forces
are those of its middle; without dashpot and arms this keeps the area of the phase plane, and with it the modulus 1 of a
stable deviation, to rounding.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from mdr.case.depth_cycle import Cycle
from mdr.case.motion import LoadOscillation
from mdr.indenters.base import Indenter
from mdr.materials.base import Material
from mdr.materials.operator import Rheology
from mdr.normal.followed_force import N_STEPS, followed_springs
from mdr.normal.spring_grid import nodes
from mdr.spring.law import law_of
from mdr.tools.memoise import remembered

N_BAND = 32  #: springs that touch and leave


@remembered(maxsize=64)
def floquet_multiplier(shape: Indenter, material: Material, load: LoadOscillation, cycle: Cycle) -> float:
    """Modulus of the greatest Floquet multiplier [-] of a periodic depth under a load with mass.

    A deviation grows by this factor in a period: above 1 the depth is unstable.
    """
    rheology, h = Rheology.periodic(material, load.omega), 2 * np.pi / N_STEPS
    _, gap, width, n_core = nodes(shape, cycle, cycle.kept_gap(rheology.response), N_BAND)
    n_kept = min(n_core, 1)  # springs that press throughout are one
    width = np.concatenate([[width[:n_core].sum()][:n_kept], width[n_core:]])
    band = followed_springs(rheology, gap[n_core:] / cycle.unit, width[n_kept:], cycle, N_STEPS)
    presses = np.ones((N_STEPS + 1, width.size), dtype=bool)
    presses[1:, n_kept:] = band.since > 0
    presses[0] = presses[-1]
    M = load.m_z * load.omega**2 / material.E_star
    T, rho, theta = rheology.T, np.array(rheology.rho), np.array(rheology.theta)
    decay, gain = np.exp(-h / theta), -np.expm1(-h / theta) * theta / h  # of arms that are held
    lag, of_arms = T / h + float(rho * theta / h @ (1 - gain)), rho * theta / h * (1 - decay)
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
        held = np.concatenate(
            [np.broadcast_to(v, x[:1].shape), decay[:, None, None] * x[1:] + gain[:, None, None] * (v - x[0])]
        )
        x = np.where(after[:, None], held, np.tensordot(free, x, 1))
    return float(np.abs(np.linalg.eigvals(np.concatenate([[v, p], *x]))).max())
