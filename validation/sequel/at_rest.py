"""Static friction under vibration, in terms of forces: Eqs. (4), (6) and (8) of the author's later paper.

At rest means the limit of slow slides, by runs. Friction under a normal oscillation varies like v_0, and is followed to
v_0 = 0 by runs at two velocities.

Symbols: A_z mean less least normal force, A_x greatest less mean force along, A_y of the force across; eta =
du/(mu_0 kappa u_z0) of a shake.
"""

import math
from collections.abc import Iterable
from dataclasses import replace
from itertools import product

import numpy as np

import mdr
from mdr import laws
from validation.cases import DEPTH, OMEGA, SHAPES, contact, reach, shaken
from validation.report import Check, Checks, Part, told

SLOW = 1e-5  #: of mu_0 kappa omega u_z0
WAVES = {"harmonic": ((0.4,), (0.0,)), "two harmonics": ((0.3, 0.15), (0.1, -0.2))}  #: cosines and sines of the depth
MU_0 = 0.5


def part(effort: str) -> Part:
    """At rest

    How: Slow runs beside the three equations.

    Range: Elastic flat punch, cone, paraboloid and r^4; depth of one and two harmonics; longitudinal shake of η = 0.3
    and 0.7, one and two harmonics; shake across of η = 0.5.

    Measured: Eq. (4): static friction is μ_0 times the least normal force, so μ_0 (1 − A_z/F_N) of any shape and
    waveform, and none where contact is lost. Eq. (6): shaken along, the force comes to μ_0 F_N once a period; what is
    held is less by the amplitude of the force. Both are statements on forces: for a given motion the amplitude of the
    force is a function of the shape, F_N(d) − F_N(d − Δu_x/(μ_0 κ)). Eq. (8), √(μ_0^2 − A_y^2/F_N^2), is that of a
    vector of one length; springs reach their limits one after the other, and a half-space in every point.

    Sentence: (4) and (6) hold for forces, with any shape and waveform; (8) holds for a flat face alone.
    """
    quick = effort == "quick"
    return Part(
        **told(part, locals()),
        checks=(*_normal_checks(quick), *_tapping_checks(), *_along_checks(quick), *_across_checks()),
    )


def _shapes(quick: bool) -> Iterable[str]:
    return ("flat punch", "paraboloid") if quick else SHAPES


def _normal_checks(quick: bool) -> Checks:
    for shape, (name, rows) in product(_shapes(quick), WAVES.items()):
        motion = mdr.PeriodicMotion(OMEGA, DEPTH, *(tuple(DEPTH * np.array(row)) for row in rows))
        case = replace(contact(shape, 0.1), oscillation=motion)
        one, two = (mdr.slide(case, k * SLOW * OMEGA * reach(case), record=1, accuracy=1e-6) for k in (1, 2))
        least = float(case.indenter.force(DEPTH + motion.cycle.unit * motion.cycle.least, case.material.E_star))
        at_rest = (2 * one.cof - two.cof) / MU_0
        why = "followed to v_0 = 0, as an elastic contact leaves it like v_0"
        yield Check(f"(4): COF/μ_0 at rest, {shape}, {name}", at_rest, least / one.mean_F_z, 2e-5, why)


def _tapping_checks() -> Checks:
    for shape in ("flat punch", "paraboloid"):
        case = contact(shape, 1.2)
        cof = mdr.slide(case, SLOW * OMEGA * reach(case), accuracy=1e-5).cof
        yield Check(f"(4), cut at zero: COF/μ_0 at rest, {shape}, tapping", cof / MU_0, 0.0, 1e-3, "it rises like v_0")


def _along_checks(quick: bool) -> Checks:
    for shape, (eta, twice) in product(_shapes(quick), ((0.3, 0.0), (0.7, 0.0), (0.3, 0.1))):
        case = shaken(shape, 0.0, eta)
        way = reach(case)
        if twice:
            shake = mdr.InPlaneMotion(OMEGA, x_cos=(eta * way, twice * way), x_sin=(0.0, 0.05 * way))
            case = replace(case, shake=shake)
        run = mdr.slide(case, SLOW * OMEGA * way, record=1, accuracy=1e-5)
        got, where = run.cof / MU_0, f"{shape}, η = {eta:g}{', two harmonics' if twice else ''}"
        amplitude = float(run.F_x.max() - run.mean_F_x) / (MU_0 * run.mean_F_z)
        why = "a slow slide adds v^(2/3) or less to what is held at rest"
        name = f"(6): COF/μ_0 plus A_x over μ_0 F_N, so greatest F_x over μ_0 F_N, {where}"
        yield Check(name, got + amplitude, 1.0, 2e-3, why)
        if not twice:
            known = laws.held_under_shake(case.indenter, DEPTH, eta * DEPTH)
            yield Check(f"COF/μ_0 at rest by the motion, {where}", got, known, 2e-3, why)


def _across_checks() -> Checks:
    for shape in ("flat punch", "paraboloid"):
        case = shaken(shape, 0.0, eta=0.5)
        cof = mdr.slide(case, 1e-3 * OMEGA * reach(case), accuracy=1e-4).cof / MU_0
        known, why = laws.held_across(case.indenter, DEPTH, 0.5 * DEPTH), "it leaves the law like v^(2/3)"
        yield Check(f"COF/μ_0 of a slow run across, η = 0.5, {shape}", cof, known, 1e-2, why)
    for shape, (by, surface) in product(SHAPES, (("springs", False), ("a half-space", True))):
        amplitude = 1 - laws.held_under_shake(SHAPES[shape], DEPTH, 0.5 * DEPTH)
        off = laws.held_across(SHAPES[shape], DEPTH, 0.5 * DEPTH, surface=surface) - math.sqrt(1 - amplitude**2)
        name = f"(8): held over μ_0 F_N by {by} less Eq. (8), η = 0.5, {shape}"
        if shape == "flat punch":
            yield Check(name, off, 0.0, 1e-12, "all springs have one limit, and so all points")
        else:
            yield Check.at_most(name, off, -0.1 if surface else -0.03, "springs slip one after the other")
