"""True error of slide() against 16 times the steps and 4 times the springs: `python tests/tables errors [n] [coarse]`,
or `[resonant]`.

n random contacts (100), half of them under a body, one in ten under a load that may lift off. The reference has errors
of its own, 1/256 and 1/16 of those of step and springs, and its settling, which is its doubt. `coarse`: with 32 to 512
steps and 32 to 384 springs, drawn at random, beside the run with default knobs, whose cof_error is the doubt.
`resonant`: bodies at and near resonances of body, contact and harmonics, with light and heavy dampers.
"""

import contextlib
import math
from dataclasses import replace

import numpy as np
from conftest import SHAPES, contact
from tables.beside import Row, row, told

import mdr
from mdr.march.periodic.steady import Resolution, steady
from mdr.tools.progress import progress

FINER = 16, 4  # times the steps, times the springs
MOST = 3e8  # spring-steps per period of a reference: a run that has itself refined gets 8 or 4 times the steps


def drawn(n: int) -> list[tuple[str, mdr.SlidingContact, float]]:
    """Random contacts and velocities, every other one under a body; none for a contact that is refused."""
    rng, out = np.random.default_rng(1000), []
    for i in range(n):
        shape = tuple(SHAPES)[int(rng.integers(4))]
        alpha, T = 0.03 * 50 ** rng.uniform(), (0.0, 0.1 * 30 ** rng.uniform())[int(rng.integers(2))]
        k_ratio, ratio = 0.3 * 10 ** rng.uniform(), 0.3 * 8 ** rng.uniform()
        if i % 10 in (7, 9):  # a light body, or none
            ratio = 3 * 10 ** rng.uniform() if i % 10 == 7 else math.inf
        damping, v_hat = 0.1 * rng.uniform(), rng.uniform(0.05, 1.1)
        c_ratio = 2 * damping * k_ratio / min(ratio, 10.0)  # c_x omega/k_xc; of a body without mass by itself
        body = (k_ratio, ratio, c_ratio) if i % 2 else ()
        case = contact(shape, 1 / alpha, T, *body)
        if i % 10 == 3:
            case = replace(case, oscillation=load_of(case, rng))
        name = f"{shape}, alpha = {alpha:.3g}, T = {T:.3g}, v = {v_hat:.3g} v_c"
        name += f", k = {k_ratio:.2g}, omega_0 = {ratio:.2g}, zeta = {damping:.2g}" if body else ""
        with contextlib.suppress(ValueError):  # a load that bounces in another rhythm
            v_c = mdr.full_slip_critical_velocity(case)
            out.append((name, case, v_hat * (v_c if math.isfinite(v_c) else mdr.critical_velocity(case))))
    return out


def resonant(n: int) -> list[tuple[str, mdr.SlidingContact, float]]:
    """Random bodies whose natural frequency, alone or on the contact, is near a multiple of that of the oscillation."""
    out = []
    for i in range(n):
        rng = np.random.default_rng((7, i))
        shape, alpha = "flat" if rng.uniform() < 0.5 else tuple(SHAPES)[int(rng.integers(4))], 0.2 * 10 ** rng.uniform()
        T, k_ratio = float(rng.choice([0, 1, 1]) * 0.05 * 60 ** rng.uniform()), 0.05 * 200 ** rng.uniform()
        ratio = rng.choice([1, 1, 1, 2, 3, 0.5]) * (1 + rng.choice([-1, 1]) * 10 ** rng.uniform(-4, -0.5))
        ratio *= rng.choice([1, np.sqrt(k_ratio / (1 + k_ratio))])
        zeta, v_hat = 10 ** rng.uniform(-4, -0.5), float(rng.uniform(0.05, 1.3))
        case = contact(shape, 1 / alpha, T, k_ratio, ratio, 2 * zeta * k_ratio / ratio, nu=rng.uniform(0, 0.5))
        name = f"{shape}, alpha = {alpha:.3g}, T = {T:.3g}, k = {k_ratio:.2g}, omega_0 = {ratio:.5g}, zeta = {zeta:.2g}"
        v_c = mdr.full_slip_critical_velocity(case)
        out.append((f"{name}, v = {v_hat:.3g}", case, v_hat * (v_c if rng.uniform() < 0.75 else case.unit_velocity)))
    return out


def load_of(case: mdr.SlidingContact, rng: np.random.Generator) -> mdr.LoadOscillation:
    """An oscillating load of the mean force at the mean depth, with a mass that lets it lift off."""
    shape, E_star, motion = case.indenter, case.material.E_star, case.oscillation
    F_z0, k_zc = (float(of(motion.u_z0, E_star)) for of in (shape.force, shape.stiffness))
    m_z = k_zc / (rng.uniform(0.5, 2.0) * motion.omega) ** 2
    return mdr.LoadOscillation(F_z0, F_z0 * rng.uniform(0.2, 1.3), motion.omega, m_z)


def coarse(name: str, case: mdr.SlidingContact, v_0: float, knobs: tuple[int, int]) -> Row:
    """Run with knobs of one's own, and with default ones."""
    run, fine = mdr.slide(case, v_0, n_springs=knobs[0], steps_per_period=knobs[1]), mdr.slide(case, v_0)
    name = f"{name}, {knobs[0]} springs, {knobs[1]} steps"
    return row(name, run, fine.cof / case.mu_0, fine.cof_error / case.mu_0, fine.settled)


def refined(name: str, case: mdr.SlidingContact, v_0: float) -> Row:
    """Run with default knobs, and once much finer."""
    case = mdr.resolved(case)
    run = mdr.slide(case, v_0)
    times, springs = FINER[0], FINER[1] * run.n_springs
    while times > 4 and times * run.steps_per_period * springs > MOST:
        times //= 2
    fine = steady(case, v_0, Resolution(springs, times * run.steps_per_period, "full_slip", lump=True))
    return row(name, run, fine.cof, fine.settling.spread, fine.settling.settled)


def main(n: int = 100, knobs: str = "") -> int:
    """Print the table; 0 if at least 99 of 100 errors are within their bound, 97 with coarse knobs."""
    rng, rows = np.random.default_rng(3), []
    for one in progress(resonant(n) if knobs == "resonant" else drawn(n), "errors"):
        own = int(32 * 12 ** rng.uniform()), int(32 * 16 ** rng.uniform())
        with contextlib.suppress(ValueError):  # a contact that is refused has no row
            rows.append(coarse(*one, own) if knobs == "coarse" else refined(*one))
    return told(rows, 0.97 if knobs == "coarse" else 0.99)
