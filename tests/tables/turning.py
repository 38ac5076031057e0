"""True error of slide() under a shake: `python tests/tables turning [n] [bodies] [along]`.

n random rigid pulls (120) of four shapes, elastic, Kelvin and with two arms, alone and with a normal oscillation,
contact kept and lost. The indenter is moved across the pull, obliquely or along a figure-eight, or, if `along`, along
it and pulled either way. Along and across the pull the worse error counts, against the twin of twins/turning.py.
`bodies`: n random bodies (40), guided or on a spring across the pull, tool or pulling point shaken.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from conftest import SHAPES
from tables.beside import Row, along_or_across, told
from twins import turning as twin
from twins.tiny_steps import Friction

import mdr
from mdr.tools.progress import progress

OMEGA, MU_0, NU, DEPTH = 300.0, 0.4, 0.4, 20e-6
MATERIALS = {
    "elastic": mdr.Elastic(3e6, NU),
    "T = 0.3": mdr.KelvinVoigt(3e6, NU, 0.3 / OMEGA),
    "T = 1": mdr.KelvinVoigt(3e6, NU, 1 / OMEGA),
    "two arms": mdr.Prony(3e6, ((3e6, 0.3 / OMEGA), (1.5e6, 2 / OMEGA)), NU),
}
REACH = MU_0 * MATERIALS["elastic"].mindlin_ratio * DEPTH  # deflection at which the deepest spring slips
MOTIONS, ALONG = ("transverse", "oblique", "figure-eight"), ("backward", "forward", "forward")


def drawn(
    n: int, bodies: bool = False, motions: Sequence[str] = MOTIONS
) -> list[tuple[str, str, mdr.SlidingContact, float]]:
    """Random contacts and velocities."""
    rng, out = np.random.default_rng(3000 + bodies), []
    for i in range(n):
        shape, rheology = tuple(SHAPES)[i % 4], tuple(MATERIALS)[int(rng.integers(4))]
        alpha = (0.0, rng.uniform(0.05, 0.7), rng.uniform(1.05, 1.8))[int(rng.integers(3))]
        motion = mdr.NormalOscillation(DEPTH, alpha * DEPTH, OMEGA) if alpha else mdr.ConstantDepth(DEPTH)
        kind = motions[int(rng.integers(3))]
        case = mdr.SlidingContact(SHAPES[shape][0], MATERIALS[rheology], MU_0, motion, shake=shake(kind, rng))
        if bodies:
            case = on_a_body(case, rng)
        size = float(np.sqrt(sum(np.sum(np.abs(way) ** 2) for way in (case.way, case.way_across)))) / REACH
        v = rng.uniform(0.02, 1.5) * (-1 if kind == "backward" else 1)
        guided = "" if case.pull.is_rigid else ", guided" if math.isinf(case.pull.across[2]) else ", hung"
        name = f"{shape}, {rheology}, alpha = {alpha:.3g}, {kind} at {case.shake.at}, size {size:.3g}, v = {v:.3g}"
        out.append((name + guided, shape, case, v * fastest(case)))
    return out


def shake(kind: str, rng: np.random.Generator) -> mdr.InPlaneOscillation | mdr.InPlaneMotion:
    """A motion across the pull, oblique to it, or along a figure-eight."""
    size, slope, phases = 0.3 * 33 ** rng.uniform() * REACH, rng.uniform(0.2, 1.4), rng.uniform(0, 2 * np.pi, 2)
    if kind == "figure-eight":
        return mdr.InPlaneMotion(OMEGA, x_cos=(size * math.cos(slope),), y_sin=(0.0, size * math.sin(slope)))
    if kind in ALONG:
        return mdr.InPlaneOscillation(OMEGA, size, phases[0])
    if kind == "transverse":
        return mdr.InPlaneOscillation(OMEGA, du_y=size, phi_y=phases[1])
    return mdr.InPlaneOscillation(OMEGA, size * math.cos(slope), phases[0], size * math.sin(slope), phases[1])


def on_a_body(case: mdr.SlidingContact, rng: np.random.Generator) -> mdr.SlidingContact:
    """The contact under a body that is guided or hangs on a spring across the pull; shaken at the tool or the pull."""
    k_x = 0.2 * 25 ** rng.uniform() * case.k_xc
    m, k_y = k_x / (0.4 * 6 ** rng.uniform() * OMEGA) ** 2, 0.5 * 4 ** rng.uniform() * k_x
    c_x, c_y = (2 * rng.uniform(0.15, 0.8) * math.sqrt(k * m) for k in (k_x, k_y))
    if rng.integers(2):
        return replace(case, pull=mdr.SpringPull(k_x, m, c_x))  # at the pull nothing would move across
    at = ("tool", "pull")[int(rng.integers(2))]
    return replace(case, pull=mdr.SpringPull(k_x, m, c_x, k_y, c_y), shake=replace(case.shake, at=at))


def fastest(case: mdr.SlidingContact) -> float:
    """Greatest velocity [m/s] of the motion besides the pull."""
    phase, total = 2 * np.pi * np.arange(1024) / 1024, np.zeros(1024)
    for way in (case.way, case.way_across):
        n = np.arange(1, way.size + 1)
        total += (1j * n * case.omega * way @ np.exp(1j * np.outer(n, phase))).real ** 2
    return float(np.sqrt(total.max()))


def by_twin(shape: str, case: mdr.SlidingContact, v_0: float, **knobs: float) -> Friction:
    """COF over mu_0 along and across the pull."""
    unit, k_xc, L = case.cycle.unit, case.k_xc, case.rheology
    length = MU_0 * case.material.mindlin_ratio * unit
    bodies = (  # k_xc is zero of a rigid pull that does not touch at its mean depth
        twin.RIGID if math.isinf(k) else (m * case.omega**2 / k_xc, c * case.omega / k_xc, k / k_xc)
        for m, c, k in (case.pull.coefficients, case.pull.across)
    )
    motion = case.cycle.harmonics, case.way / length, case.way_across / length, v_0 / (length * case.omega)
    material = L.T, L.rho, L.theta
    return twin.friction(SHAPES[shape][1], case.cycle.u_z0 / unit, *motion, material, *bodies, **knobs)


def row_of(name: str, shape: str, case: mdr.SlidingContact, v_0: float, **knobs: float) -> Row:
    """The run beside the twin, along or across the pull, where they differ more."""
    return along_or_across(name, mdr.slide(case, v_0), by_twin(shape, case, v_0, **knobs), MU_0)


def main(n: int = 0, *words: str) -> int:
    """Print the table; 0 if all errors are within their bound."""
    bodies, motions = "bodies" in words, ALONG if "along" in words else MOTIONS
    systems = drawn(n or (40 if bodies else 120), bodies, motions)
    return told([row_of(*one) for one in progress(systems, "turning")], 1.0)
