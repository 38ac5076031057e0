"""True error of slide() on faces with a shear strength: `python tests/tables strength [n] [level]`.

n random contacts (60) of four shapes, elastic, Kelvin and with two arms, with and without Coulomb's part, contact kept
and lost: pulled rigidly or by a body, which in turn is still, shaken along the pull and shaken across it. Along and
across the pull the worse error counts, over the COF of full slip, against the twin of twins/strength.py. `level`:
shapes that are level in the middle, whose springs differ there by their place alone; and a hollow one.
"""

from dataclasses import replace

import numpy as np
from conftest import SHAPES
from tables.beside import Row, along_or_across, told
from twins import strength as twin
from twins.tiny_steps import Friction

import mdr
from mdr.tools.progress import progress

OMEGA, E, NU, DEPTH, TIMES = 300.0, 3e6, 0.4, 20e-6, np.array([0.3, 2.0])
ARMS = tuple(zip((0.8 * E, 0.4 * E), TIMES / OMEGA, strict=True))
MATERIALS = {
    "elastic": (mdr.Elastic(E, NU), 0.0, ()),
    "Kelvin": (mdr.KelvinVoigt(E, NU, 0.4 / OMEGA), 0.4 / OMEGA, ()),
    "two arms": (mdr.Prony(E, ARMS, NU), 0.0, ARMS),
}
PROFILES = {
    "flat": twin.punch(1e-3),
    "cone": twin.cone(0.02),
    "paraboloid": twin.paraboloid(5e-3),
    "r4": twin.fourth_power(2e3),
}
KINDS = ("rigid", "body", "along", "across")  #: what pulls it, and how it is shaken


def level_shape(name: str, rng: np.random.Generator) -> tuple[mdr.Indenter, twin.Shape]:
    """A shape that is level, or hollow, in the middle."""
    b, R, theta = rng.uniform(0.1e-3, 0.6e-3), rng.uniform(2e-3, 20e-3), rng.uniform(0.01, 0.1)
    if name == "cone":
        return mdr.TruncatedCone(b, theta), twin.cone(theta, b)
    if name == "paraboloid":
        return mdr.TruncatedParaboloid(b, R), twin.paraboloid(R, b)
    if name == "r4":
        return mdr.RoundedPunch(b, R), twin.rounded_punch(R, b)
    R = b**2 / (0.3 * DEPTH)
    return mdr.ConcavePunch(b, R), twin.concave_punch(b, R)


def drawn(n: int, level: bool = False) -> list[tuple[str, mdr.SlidingContact, float, twin.Contact]]:
    """Random contacts and velocities, and what the twin is told of them."""
    rng, out = np.random.default_rng(5000 + level), []
    for i in range(n):
        shape, rheology, kind = tuple(SHAPES)[i % 4], tuple(MATERIALS)[i % 3], KINDS[i // 12 % 4]
        alpha = rng.uniform(0.05, 0.7) if rng.integers(2) else rng.uniform(1.05, 1.8)
        material, tau, arms = MATERIALS[rheology]
        indenter, mu_0, profile = SHAPES[shape][0], float(0.3 * rng.integers(2)), PROFILES[shape]
        if level:
            indenter, profile = level_shape(shape, rng)
            alpha = min(alpha, 0.3) if shape == "flat" else alpha
        reach = rng.uniform(0.1, 0.8) * material.mindlin_ratio * DEPTH  # of the strength, in the middle
        tau_0 = reach * material.G_star / (2 * float(indenter.contact_radius(DEPTH)))
        motion = mdr.NormalOscillation(DEPTH, alpha * DEPTH, OMEGA)
        case = mdr.SlidingContact(indenter, material, mu_0, motion, tau_0=tau_0)
        if kind != "rigid":
            case = replace(case, pull=body(case, kind, rng))
        if kind in ("along", "across"):
            size, phase = rng.uniform(0.2, 1.2, 2) * case.unit_length, rng.uniform(0, 2 * np.pi, 2)
            across = {"du_y": size[1], "phi_y": phase[1]} if kind == "across" else {}
            case = replace(case, shake=mdr.InPlaneOscillation(OMEGA, size[0], phase[0], **across))
        v = rng.uniform(0.05, 0.8) * (case.unit_velocity if kind in ("rigid", "body") else case.pace)
        known = twin.Contact(
            profile, E, NU, tau, arms, mu_0, tau_0, OMEGA, DEPTH, alpha * DEPTH, v,
            tuple(amplitude(way) for way in (case.shake_harmonics, case.harmonics_across)),
            (case.pull.coefficients, case.pull.across),
        )  # fmt: skip
        name = f"{i}: {type(indenter).__name__}, {rheology}, mu_0 = {mu_0}, {kind}, alpha = {alpha:.3g}"
        name += f", v = {v / case.pace:.3g}"
        out.append((name, case, v, known))
    return out


def body(case: mdr.SlidingContact, kind: str, rng: np.random.Generator) -> mdr.SpringPull:
    """A damped body; shaken across, it hangs on a spring there too."""
    k_x, ratio, zeta = 0.2 * 15 ** rng.uniform() * case.k_xc, 0.4 * 5 ** rng.uniform(), rng.uniform(0.2, 0.8)
    m = k_x / (ratio * OMEGA) ** 2
    c_x = 2 * zeta * np.sqrt(k_x * m)
    return mdr.SpringPull(k_x, m, c_x, *((0.8 * k_x, 0.7 * c_x) if kind == "across" else ()))


def amplitude(way: np.ndarray) -> complex:
    """Of the one harmonic, or nothing."""
    return complex(way[0]) if way.size else 0j


def row_of(name: str, case: mdr.SlidingContact, v_0: float, known: twin.Contact, **knobs: int) -> Row:
    """The run beside the twin, along or across the pull, where they differ more."""
    run, truth = mdr.slide(case, v_0), twin.friction(known, **knobs)
    return along_or_across(name, run, Friction(*(one / run.full_cof for one in truth)), run.full_cof)


def main(n: int = 60, *words: str) -> int:
    """Print the table; 0 if all errors are within their bound."""
    return told([row_of(*one) for one in progress(drawn(n, "level" in words), "strength")], 1.0)
