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
from mdr.materials.operator import L_DECAY, L_FREE, L_GAIN, Rheology
from mdr.normal.followed_force import shares_of_contact
from mdr.normal.spring_grid import cells
from mdr.tools.memoise import remembered

N_BAND = 32  #: springs that touch and leave
N_STEPS = 1024  #: of the period


@remembered(maxsize=64)
def floquet_multiplier(shape: Indenter, material: Material, load: LoadOscillation, cycle: Cycle) -> float:
    """Modulus of the greatest Floquet multiplier [-] of a periodic depth under a load with mass.

    A deviation grows by this factor in a period: above 1 the depth is unstable.
    """
    rheology, h = Rheology.of(material, load.omega), 2 * np.pi / N_STEPS
    _, gap, width, n_core = cells(shape, cycle, cycle.kept_gap(rheology.response), N_BAND)
    table = rheology.over_step(h)
    n_kept = min(n_core, 1)  # springs that press throughout are one
    width = np.concatenate([[width[:n_core].sum()][:n_kept], width[n_core:]])
    presses = np.ones((N_STEPS + 1, width.size), dtype=bool)
    presses[:-1, n_kept:] = shares_of_contact(rheology, gap[n_core:] / cycle.unit, cycle, N_STEPS).T > 0
    presses[-1] = presses[0]
    M = load.m_z * load.omega**2 / material.E_star
    T, rho, theta = rheology.T, np.array(rheology.rho), np.array(rheology.theta)
    decay, gain = table[L_DECAY, 1:], table[L_GAIN, 1:]
    lag, of_arms = T / h + float(rho * theta / h @ (1 - gain)), rho * theta / h * (1 - decay)
    n, n_arms = width.size, rho.size
    v, p, *rest = np.eye(2 + n * (1 + n_arms))  # columns: deviations to begin with
    s, *arms = np.array(rest).reshape(1 + n_arms, n, -1)
    for before, after in pairwise(presses):
        static, rate = 0.5 * (width * before + width * after), width * np.where(after, 1.0, 0.5 * before)
        A = 0.5 * static.sum() + lag * rate.sum()
        B = 0.5 * static.sum() * v - lag * (rate @ s) + sum(c * (rate @ x) for c, x in zip(of_arms, arms, strict=True))
        end = (v + h * p - h**2 / (2 * M) * B) / (1 + h**2 * A / (2 * M))
        p, v = 2 * (end - v) / h - p, end
        free = table[L_FREE, 0] * s + sum(c * x for c, x in zip(table[L_FREE, 1:], arms, strict=True))
        s_end = np.where(after[:, None], v, free)
        arms = [one * x + share * (s_end - s) for one, share, x in zip(decay, gain, arms, strict=True)]
        s = s_end
    return float(np.abs(np.linalg.eigvals(np.concatenate([[v, p], s, *arms]))).max())
