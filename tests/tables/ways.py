"""One motion written in six ways: no function may tell them apart by more than the errors that it states.

`python tests/tables ways [n] [quick]`: n random contacts (200), of four shapes, elastic, Kelvin or with arms, pulled
rigidly or through a body, kept or lost, shaken or not; some minutes for each ten, most of them for the verdicts, which
`quick` leaves out.

Prints for each function how many answers differ from that to the motion as it is given by more than the sum of both
stated errors, the largest difference, and the answers that stand out.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from conftest import SHAPES

import mdr
from mdr.tools.progress import progress

OMEGA, MU_0, NU, E, DEPTH = 300.0, 0.4, 0.4, 3e6, 20e-6
LITTLE = 1e-9  #: of what is put beside a motion or a material
MOVED = 10 * LITTLE  #: what that may move, of any answer
VELOCITIES = (0.0, 0.2, 0.5, 0.9)  #: of a curve, over the full-slip critical velocity
RUN = 0.4  #: that of the run


def drawn(n: int, seed: int = 3000) -> list[tuple[str, mdr.SlidingContact]]:
    """Random contacts."""
    rng, out = np.random.default_rng(seed), []
    for i in range(n):
        shape, tau = tuple(SHAPES)[int(rng.integers(4))], 0.1 * 30 ** rng.uniform() / OMEGA
        material = (
            mdr.Elastic(E, NU),
            mdr.KelvinVoigt(E, NU, tau),
            mdr.Prony(E, ((E * rng.uniform(0.2, 2), tau),), NU),
        )[i % 3]
        alpha = (rng.uniform(0.05, 0.7), rng.uniform(1.05, 1.8))[int(rng.integers(2))]
        chi, phi, ratio = 0.1 * 20 ** rng.uniform(), rng.uniform(0, 6), 0.3 * 8 ** rng.uniform()
        shake = mdr.InPlaneOscillation(OMEGA, chi * MU_0 * material.mindlin_ratio * DEPTH, phi) if i % 4 > 1 else None
        motion = mdr.NormalOscillation(DEPTH, alpha * DEPTH, OMEGA)
        k_x = 0.3 * 10 ** rng.uniform() * float(SHAPES[shape][0].stiffness(DEPTH, E / (2 + 2 * NU)))
        m, zeta = k_x / (ratio * OMEGA) ** 2, rng.uniform(0.05, 0.5)
        body = mdr.SpringPull(k_x, m, 2 * zeta * math.sqrt(k_x * m))
        pull = body if i % 8 in (1, 3, 4, 6) else mdr.RigidPull()
        case = mdr.SlidingContact(SHAPES[shape][0], material, MU_0, motion, pull, shake)
        name = f"{i}: {shape}, {type(material).__name__}, T = {tau * OMEGA:.3g}, alpha = {alpha:.3g}"
        name += f", chi = {chi:.3g} at {phi:.3g}" if shake else ""
        out.append((name + (f", omega_0 = {ratio:.3g}" if pull is body else ""), case))
    return out


def as_harmonics(case: mdr.SlidingContact, n: int = 1, shift: float = 0.0) -> mdr.SlidingContact:
    """Depth and shake as harmonic n of a frequency n times lower, with a phase that is shifted in both alike."""
    z, x, nothing = case.oscillation, case.shake, (0.0,) * (n - 1)
    way = 0.0 if x is None else x.du_x * np.exp(1j * (x.phi_x + shift))
    cos, sin = z.du_z * math.cos(shift), -z.du_z * math.sin(shift)
    motion = mdr.PeriodicMotion(z.omega / n, z.u_z0, (*nothing, cos), (*nothing, sin))
    shake = mdr.InPlaneMotion(z.omega / n, (*nothing, float(np.real(way))), (*nothing, -float(np.imag(way))))
    return replace(case, oscillation=motion, shake=x and shake)


def with_a_shake(case: mdr.SlidingContact) -> mdr.SlidingContact:
    """A shake of next to no amplitude beside it, or a second harmonic of the shake."""
    little = LITTLE * MU_0 * case.material.mindlin_ratio * DEPTH
    if case.shake is None:
        return replace(case, shake=mdr.InPlaneOscillation(case.omega, little))
    shake = as_harmonics(case).shake
    return replace(case, shake=replace(shake, x_cos=(*shake.x_cos, little), x_sin=(*shake.x_sin, 0.0)))


def with_a_harmonic(case: mdr.SlidingContact) -> mdr.SlidingContact:
    """A second harmonic of the depth, of next to no amplitude."""
    motion = as_harmonics(case).oscillation
    return replace(case, oscillation=replace(motion, cos=(*motion.cos, LITTLE * motion.cos[0])))


def with_an_arm(case: mdr.SlidingContact) -> mdr.SlidingContact:
    """An arm of next to no modulus."""
    material, arm = case.material, (LITTLE * E, 1 / OMEGA)
    tau = material.tau if isinstance(material, mdr.KelvinVoigt) else 0.0
    return replace(case, material=mdr.Prony(E, (*getattr(material, "arms", ()), arm), NU, tau))


WAYS: dict[str, Callable[[mdr.SlidingContact], mdr.SlidingContact]] = {
    "as given": lambda case: case,
    "of half the frequency": lambda case: as_harmonics(case, n=2),
    "with a little shake": with_a_shake,
    "with a little harmonic": with_a_harmonic,
    "with a little arm": with_an_arm,
    "begun later": lambda case: as_harmonics(case, shift=2.0),
}


@dataclass(frozen=True)
class Answer:
    """What a function said, and the error that it states; infinite where it says that it does not know."""

    values: np.ndarray
    errors: np.ndarray

    def beside(self, other: "Answer") -> tuple[float, float, bool]:
        """Largest difference, largest over the sum of the stated errors, and whether all of these are known."""
        apart, errors = np.abs(self.values - other.values), self.errors + other.errors
        return float(apart.max()), float((apart / errors).max()), bool(np.isfinite(errors).all())


def answers(case: mdr.SlidingContact, v: float, verdict: bool) -> Iterator[tuple[str, Answer]]:
    """What each function says, COFs over mu_0 and velocities over v; of what does not settle any error is stated."""
    # the docstring: 1e-7 of v_c or of a tenth of mu_0 kappa u_z'; with arms as stiff as E_inf 1e-6, of a body 1e-4
    weight = sum(E_k for E_k, _ in getattr(case.material, "arms", ())) / E
    error = (1e-7 + weight * (1e-6 if case.pull.is_rigid else 1e-4)) * max(1, 0.1 * case.unit_velocity / v)
    yield "full slip", Answer(np.array([mdr.full_slip_critical_velocity(case) / v]), np.array([MOVED + error]))
    curve = mdr.cof_curve(case, v * np.array(VELOCITIES))
    cofs, errors = curve.cof / MU_0, np.where(curve.settled, curve.cof_error / MU_0 + MOVED, np.inf)
    yield "static", Answer(cofs[:1], errors[:1])
    yield "curve", Answer(cofs[1:], errors[1:])
    run = mdr.slide(case, RUN * v)
    error = run.cof_error / MU_0 + MOVED if run.settled else np.inf
    yield "run", Answer(np.array([run.cof / MU_0]), np.array([error]))
    if verdict:
        found = mdr.verdict(case).measurement
        half = np.inf if found.v_c is None else max(found.high - found.v_c, found.v_c - found.low) / v
        yield "verdict", Answer(np.array([(found.v_c or 0.0) / v]), np.array([half + MOVED]))


@dataclass(frozen=True)
class Row:
    """One function asked in one way beside the motion as given."""

    name: str
    way: str
    function: str
    apart: float  #: COF over mu_0, or velocity over the full-slip one
    ratio: float  #: over the sum of the stated errors
    known: bool  #: whether both state one


def rows_of(name: str, case: mdr.SlidingContact, verdict: bool) -> Iterator[Row]:
    """All functions, asked in all ways."""
    v = abs(mdr.full_slip_critical_velocity(case))
    v = v if math.isfinite(v) and v > 1e-3 * case.pace else case.pace
    given: dict[str, Answer] = {}
    for way, written in WAYS.items():
        for function, answer in answers(written(case), v, verdict):
            first = given.setdefault(function, answer)
            if first is not answer:
                yield Row(name, way, function, *first.beside(answer))


def main(n: int = 200, quick: str = "") -> int:
    """Print the table; 0 if no answer stands out."""
    rows = [row for one in progress(drawn(n), "ways") for row in rows_of(*one, not quick)]
    print(f"{n} contacts, {len(WAYS)} ways; largest difference over the sum of the stated errors")
    for function, way in dict.fromkeys((row.function, row.way) for row in rows):
        these = [row.ratio for row in rows if (row.function, row.way) == (function, way)]
        print(f"{function:9} {way:23} {max(these):8.2g}")
    beyond = sorted((row for row in rows if row.ratio > 1), key=lambda row: -row.ratio)
    for row in beyond[:40]:
        print(f"{row.function}, {row.way}: {row.apart:.1e}, {row.ratio:.3g} times the errors; {row.name}")
    return 1 if beyond else 0
