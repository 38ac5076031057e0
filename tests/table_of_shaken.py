"""True error of slide() for contacts shaken along their way: beside the closed form, and bodies beside the twin.

`python tests/table_of_shaken.py [n]`: n random rigid pulls (320) of four shapes, elastic and Kelvin, alone and with a
normal oscillation at four phases, contact kept and lost, at velocities of either sign, against the closed form, which
shares nothing with the march. Takes some seconds. Prints in how many the true error is within cof_error.

`python tests/table_of_shaken.py n bodies`: n random bodies (60), tool or pulling point shaken, against the twin of
reference_shaken.py, whose own error is added to the bound; takes some minutes.

`python tests/table_of_shaken.py n solver`: the closed form of n random arrays of Kelvin springs (8) against a solver of
differential equations and adaptive quadrature over the springs; takes half a minute each.
"""

import math
import sys
from dataclasses import dataclass, replace

import numpy as np
import reference_shaken
from conftest import SHAPES

import mdr
from mdr.closed_forms.shaken_pull import ShakenPull, average_friction
from mdr.tools.progress import progress

OMEGA, MU_0, NU, DEPTH, UNIT = 300.0, 0.4, 0.4, 20e-6, 2e-6
TIMES, PHASES = (0.0, 0.3, 1.0), (0.0, np.pi / 2, np.pi, 0.7)


@dataclass(frozen=True)
class Row:
    """One run beside what it should be; COFs and errors over mu_0."""

    name: str
    error: float
    bound: float
    doubt: float  #: of the value that it is compared with
    settled: bool

    @property
    def within(self) -> bool:
        return self.error <= self.bound + self.doubt


def drawn(n: int, bodies: bool) -> list[tuple[str, str, mdr.SlidingContact, float]]:
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
        cof, doubt = float(known.cof[0]), float(known.cof_error[0])
    elif (
        abs(abs(run.cof) - MU_0) < 1e-9
    ):  # full slip ends where the full-slip condition says, to 1e-3 at a lost contact
        least = mdr.full_slip_critical_velocity(case, 1 if run.cof > 0 else -1)
        cof = run.cof if math.copysign(v_0, v_0 * run.cof) > 0.999 * least else np.nan
        doubt = 0.0
    else:
        cof, doubt = by_twin(shape, case, v_0)
    return Row(name, abs(run.cof - cof) / MU_0, run.cof_error / MU_0, doubt / MU_0, run.settled)


def by_twin(shape: str, case: mdr.SlidingContact, v_0: float) -> tuple[float, float]:
    side, unit, k_xc = math.copysign(1, v_0), case.cycle.unit, case.k_xc
    length = MU_0 * case.material.mindlin_ratio * unit
    m, c_x, k_x = case.pull.coefficients
    body = m * OMEGA**2 / k_xc, c_x * OMEGA / k_xc, k_x / k_xc
    z_n = [1.0] if case.oscillation.omega else [0.0]
    x_n, v = [side * x / length for x in case.way], abs(v_0) / (length * OMEGA)
    knobs = {"steps": 8192, "count": 300, "n_periods": 60}
    cof, doubt = reference_shaken.friction(SHAPES[shape][1], DEPTH / unit, z_n, x_n, case.T, v, body, **knobs)
    return side * MU_0 * cof, MU_0 * (doubt + 2e-6)  # its 300 springs


def by_solver(n: int) -> None:
    """Cones and paraboloids, kept and lost, at the stated error of the closed form and beside the solver."""
    rng, worst = np.random.default_rng(13), 0.0
    for i in progress(range(n), "arrays"):
        shape, depth = ("cone", "paraboloid")[i % 2], 2.5 if i % 4 < 2 else rng.uniform(0.2, 0.9)
        T, chi, phi, v = rng.uniform(0.3, 1), rng.uniform(0.3, 3), PHASES[int(rng.integers(4))], rng.uniform(-1, 1)
        X = np.array([chi * np.exp(1j * phi)])
        twin = reference_shaken.array(SHAPES[shape][1], depth, [1.0], X, T, v)
        pull = ShakenPull(SHAPES[shape][0], depth * UNIT, UNIT, np.ones(1, complex), X, T)
        forward = average_friction(pull if v >= 0 else pull.mirrored, [abs(v)])
        cof, error, _ = (float(row[0]) for row in forward)
        cof *= math.copysign(1, v)
        worst = max(worst, abs(cof - twin))
        print(f"{abs(cof - twin):.1e} (stated {error:.1e}): {shape}, {depth:.3g} du_z, T = {T:.2g}, chi = {chi:.2g}")
    print(f"{n} arrays: largest difference {worst:.1e}")


def main(n: int, bodies: bool) -> None:
    rows = [row_of(*one) for one in progress(drawn(n, bodies), "cases")]
    held = sum(row.within for row in rows)
    print(f"{len(rows)} cases, {sum(row.settled for row in rows)} settled; error within cof_error: {held}")
    print(f"within 1e-5 of mu_0: {sum(row.error <= 1e-5 + row.doubt for row in rows)}")
    slipping = [row for row in rows if row.error > 0]
    print(f"median cof_error/error: {np.median([row.bound / row.error for row in slipping]):.3g}")
    for row in sorted(rows, key=lambda row: row.error / (row.bound + row.doubt + 1e-300))[-8:]:
        print(f"{row.error:.1e} of {row.bound:.1e} (and {row.doubt:.1e}): {row.name}")


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 320
    by_solver(count) if "solver" in sys.argv else main(count, "bodies" in sys.argv)
