"""True error of slide() under a shake along the slide: `python tests/tables shaken [n] [bodies]`.

n random rigid pulls (320) of four shapes, elastic and Kelvin, alone and with a normal oscillation at four phases,
contact kept and lost, at velocities of either sign, against the closed form, which shares nothing with the march.
`bodies`: n random bodies, tool or pulling point shaken, against the twin of reference_shaken.py.
"""

import math
from dataclasses import replace

import numpy as np
import reference_shaken
from conftest import SHAPES
from tables.beside import Row, row, told

import mdr
from mdr.tools.progress import progress

OMEGA, MU_0, NU, DEPTH = 300.0, 0.4, 0.4, 20e-6
TIMES, PHASES = (0.0, 0.3, 1.0), (0.0, np.pi / 2, np.pi, 0.7)


def drawn(n: int, bodies: bool = False) -> list[tuple[str, str, mdr.SlidingContact, float]]:
    """Random contacts and velocities."""
    rng, out = np.random.default_rng(2000 + bodies), []
    for i in range(n):
        shape, T, phi = tuple(SHAPES)[i % 4], TIMES[int(rng.integers(3))], PHASES[int(rng.integers(4))]
        alpha = (0.0, rng.uniform(0.05, 0.7), rng.uniform(1.05, 1.8))[int(rng.integers(3))]
        chi, at = 0.3 * 33 ** rng.uniform(), ("tool", "pull")[int(rng.integers(2))]
        material = mdr.KelvinVoigt(3e6, NU, T / OMEGA) if T else mdr.Elastic(3e6, NU)
        motion = mdr.NormalOscillation(DEPTH, alpha * DEPTH, OMEGA) if alpha else mdr.ConstantDepth(DEPTH)
        shake = mdr.InPlaneOscillation(OMEGA, chi * MU_0 * material.mindlin_ratio * DEPTH, phi, at=at)
        case = mdr.SlidingContact(SHAPES[shape][0], material, MU_0, motion, shake=shake)
        if bodies:
            k_x = 0.2 * 25 ** rng.uniform() * float(case.indenter.stiffness(DEPTH, material.G_star))
            m = k_x / (0.4 * 6 ** rng.uniform() * OMEGA) ** 2
            case = replace(case, pull=mdr.SpringPull(k_x, m, 2 * rng.uniform(0.15, 0.8) * math.sqrt(k_x * m)))
        fastest = max(abs(mdr.full_slip_critical_velocity(case, way)) for way in (1, -1))
        v_0 = rng.uniform(-1.5, 1.5) * fastest
        name = (
            f"{shape}, alpha = {alpha:.3g}, chi = {chi:.3g}, phase {phi:.2f}, T = {T:g}, {at}, v = {v_0 / fastest:.3g}"
        )
        out.append((name, shape, case, v_0))
    return out


def row_of(name: str, shape: str, case: mdr.SlidingContact, v_0: float) -> Row:
    """The run, and the closed form or the twin."""
    run = mdr.slide(case, v_0)
    if case.pull.is_rigid:
        known = mdr.cof_curve(case, [v_0])
        return row(name, run, known.cof[0] / MU_0, known.cof_error[0] / MU_0)
    if abs(abs(run.cof) - MU_0) < 1e-9:  # full slip ends where its condition says, to 1e-3 at a lost contact
        least = mdr.full_slip_critical_velocity(case, 1 if run.cof > 0 else -1)
        return row(name, run, run.cof / MU_0 if math.copysign(v_0, v_0 * run.cof) > 0.999 * least else np.inf)
    return row(name, run, *by_twin(shape, case, v_0))


def by_twin(shape: str, case: mdr.SlidingContact, v_0: float) -> tuple[float, float]:
    """COF over mu_0, and its doubt."""
    side, unit, k_xc = math.copysign(1, v_0), case.cycle.unit, case.k_xc
    length = MU_0 * case.material.mindlin_ratio * unit
    m, c_x, k_x = case.pull.coefficients
    body = m * OMEGA**2 / k_xc, c_x * OMEGA / k_xc, k_x / k_xc
    z_n = [1.0] if case.oscillation.omega else [0.0]
    x_n, v = [side * x / length for x in case.way], abs(v_0) / (length * OMEGA)
    knobs = {"steps": 8192, "count": 300, "n_periods": 60}
    cof, doubt = reference_shaken.friction(SHAPES[shape][1], DEPTH / unit, z_n, x_n, case.T, v, body, **knobs)
    return side * cof, doubt + 2e-6  # its 300 springs


def main(n: int = 320, bodies: str = "") -> int:
    """Print the table; 0 if all errors are within their bound."""
    return told([row_of(*one) for one in progress(drawn(n, bool(bodies)), "shaken")], 1.0)
