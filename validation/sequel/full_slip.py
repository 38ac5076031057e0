"""Friction in full slip, Eq. (12) of the author's later paper: normal and longitudinal oscillation leave mu_0."""

from itertools import product

import mdr
from mdr import laws
from validation.cases import BODY, OMEGA, contact, loss, shaken
from validation.report import Check, Checks, Part, told

FAST = 1.05  #: of the full-slip critical velocity


def part(effort: str) -> Part:
    """Full slip

    How: Runs above the critical velocity, and fast ones across.

    Range: Flat punch and paraboloid, elastic and ωτ = 1, rigid pull and a body; normal and longitudinal oscillation, at
    {FAST:g} v_c of full slip. Elastic, rigid pull: transverse, at 20 and 40 ω Δu_y.

    Measured: Where all springs slip forward all the time, each force is μ_0 times its own normal force, whatever moves:
    μ_0 is left under a normal and a longitudinal oscillation. Across, the direction of slip turns, and 1 − μ/μ_0 falls
    like 1/v_0^2.

    Sentence: (12) holds: full slip leaves μ_0 for a normal and a longitudinal oscillation; across it never does.
    """
    return Part(**told(part, locals()), checks=tuple(_checks(effort == "quick")))


def _checks(quick: bool) -> Checks:
    for shape, T, pull in product(("flat punch", "paraboloid"), (0.0, 1.0), ({}, BODY)):
        for way, case in (("normal", contact(shape, 0.4, T, **pull)), ("along", shaken(shape, 0.0, 0.4, T=T, **pull))):
            v_c = mdr.full_slip_critical_velocity(case)
            where = f"{way}, {shape}, {loss(T)}, {'body' if pull else 'rigid pull'}"
            above, below = (mdr.slide(case, share * v_c, accuracy=1e-6).cof / 0.5 for share in (FAST, 0.5))
            yield Check(f"(12): COF/μ_0 at {FAST:g} v_c, {where}", above, 1.0, 1e-9, "all springs slip")
            yield Check.at_most(f"COF/μ_0 at half of v_c, {where}", below, 0.99, "so the former is no triviality")
    for shape in ("flat punch", "paraboloid"):
        case, lost = shaken(shape, 0.0, eta=0.4), []
        for fast in (20, 40):
            v_0 = fast * OMEGA * case.shake.du_y
            lost.append(1 - mdr.slide(case, v_0, accuracy=1e-8).cof / 0.5)
            name = f"across: 1 − COF/μ_0 at v_0 = {fast} ω Δu_y over its law, {shape}"
            yield Check(name, lost[-1] / laws.lost_across(case, v_0), 1.0, 1 / fast**2, "the next order")
        yield Check(f"across: the same at twice that v_0, over it, {shape}", lost[1] / lost[0], 0.25, 5e-3, "1/v_0²")
