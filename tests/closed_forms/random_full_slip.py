"""Full slip beside its definition: random contacts, and the difference from twins/full_slip.py.

Each class of body, elastic, Kelvin and with an arm, kept and lost, of up to three harmonics, shaken at the tool or at
the pull. Over v_c or a tenth of the greatest rate of the depth, where the twin is known well enough.
"""

import math

import numpy as np
from conftest import SHAPES
from twins import full_slip as twin

import mdr

BODIES = ("rigid", "mass", "light", "massless", "no damper")
UNIT, OMEGA, MU_0 = 2e-6, 300.0, 0.4


def series(rng, n, decay):
    return (rng.normal(size=n) + 1j * rng.normal(size=n)) / np.arange(1, n + 1) ** decay


def drawn(seed, body, arms):
    """A contact, the numbers of the twin, the velocity these are in, and whether contact is kept."""
    rng = np.random.default_rng(seed)
    shape, exponent = SHAPES[rng.choice(list(SHAPES))]
    n = int(rng.choice([1, 1, 2, 3]))
    Z = series(rng, n, 1) if n > 1 else np.ones(1, dtype=complex)
    Z /= np.abs(Z).sum()
    T = float(rng.choice([0, 0.3] if arms else [0, 0.1, 0.5, 2, 5]))
    branch = ((float(rng.uniform(0.1, 3)),), (float(10 ** rng.uniform(-1, 0.7)),)) if arms else None
    if branch:
        pairs = [(3e6 * rho, theta / OMEGA) for rho, theta in zip(*branch, strict=True)]
        material = mdr.Prony(E_inf=3e6, arms=pairs, nu=0.4, tau=T / OMEGA)
    else:
        material = mdr.KelvinVoigt(E=3e6, nu=0.4, tau=T / OMEGA)
    motion = mdr.PeriodicMotion(OMEGA, 1.0, tuple(Z.real * UNIT), tuple(-Z.imag * UNIT))
    deep = mdr.SlidingContact(shape, material, MU_0, motion)
    kept_from = -deep.kept_gap * deep.cycle.unit / UNIT
    kept = bool(rng.random() < 0.5)
    highest = deep.cycle.unit * deep.cycle.greatest / UNIT
    depth = float(kept_from * rng.uniform(1.05, 4) if kept else rng.uniform(-0.3 * highest, 0.9 * kept_from))
    size = max(depth, 0.5) ** (1 / exponent)
    M, C, K = 0.0, 0.0, math.inf
    if body != "rigid":
        K = size * float(10 ** rng.uniform(-1, 1))
    if body == "mass":
        M, C = K / float(rng.choice([0.4, 1.25, 2.3, 3.4, 10.3])) ** 2, size * float(rng.uniform(0, 0.3))
    if body == "light":
        M, C = K / float(10 ** rng.uniform(1.3, 2.3)) ** 2, size * float(rng.uniform(0.05, 0.5))
    if body == "massless":
        C = size * float(rng.uniform(0.05, 1))
    k = float(shape.stiffness(UNIT, material.G_star))
    pull = mdr.RigidPull() if body == "rigid" else mdr.SpringPull(K * k, M * k / OMEGA**2, C * k / OMEGA)
    length, shake, X = MU_0 * material.mindlin_ratio * UNIT, None, np.zeros(0, dtype=complex)
    if rng.random() < 0.5:
        X = series(rng, int(rng.choice([1, 1, 2])), 1) * 10 ** rng.uniform(-1, 0.5)
        at = "tool" if body == "rigid" else str(rng.choice(["tool", "pull"]))
        shake = mdr.InPlaneMotion(OMEGA, tuple(X.real * length), tuple(-X.imag * length), at=at)
        if at == "pull":
            order = np.arange(1, X.size + 1)
            X = X * (K + 1j * order * C) / (K - M * order**2 + 1j * order * C)
    motion = mdr.PeriodicMotion(OMEGA, depth * UNIT, tuple(Z.real * UNIT), tuple(-Z.imag * UNIT))
    case = mdr.SlidingContact(shape, material, MU_0, motion, pull, shake=shake)
    return case, (Z, X, exponent, depth, T, branch, M, C, K), length * OMEGA, kept


def difference(case, numbers, unit, **grid):
    """Of the library and the twin, and what the latter does not know; None where v_c is infinite."""
    found = mdr.full_slip_critical_velocity(case) / unit
    if math.isinf(found):
        return None
    v_c, unknown = twin.converged(*numbers, **grid)
    return abs(found - v_c) / max(abs(v_c), 0.1 * np.abs(twin.rate(numbers[0])).sum()), unknown
