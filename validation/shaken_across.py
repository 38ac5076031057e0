"""A contact that is shaken across its way: no velocity is critical, stiffness, and forces to the side.

Friction has the direction of slip, and across the pull the slip turns at every velocity. What is missing falls like
1/v_0² (`mdr.laws.lost_across`). At constant depth the way across against what the deepest spring can be deflected,
eta, tells how much the springs follow. With a normal oscillation the contact is pushed to one side: it is pressed more
while the slip has one direction (`mdr.laws.steered_across`).

Symbols: eta = du_y/(mu_0 kappa u_z0), alpha = du_z/u_z0, phi phase of the way across against the depth, r =
v_0/(omega du_y).
"""

import math
from dataclasses import replace
from itertools import pairwise, product

import numpy as np

import mdr
from mdr import laws
from validation.cases import DEPTH, OMEGA, SHAPES, loss, shaken
from validation.figures import COLOURS, figure, panel
from validation.measured import RUN
from validation.report import Check, Checks, Claim, Equation, told

MU_0 = 0.5
FAST = (8.0, 16.0)  #: v_0/(omega du_y), of laws of fast slides
SLOW, STIFF = 0.01, (1.5, 2.0, 3.0, 5.0, 12.0, 40.0)  #: r, and eta, of slow slides of a flat punch
QUARTER = math.pi / 2


def across(shape: str, eta: float, alpha: float = 0.0, phi: float = 0.0, T: float = 0.0) -> mdr.SlidingContact:
    """A contact of validation/cases.py, shaken across."""
    return shaken(shape, alpha, T=T, eta=eta, phi_y=phi)


def at(case: mdr.SlidingContact, r: float, accuracy: float = 1e-4) -> mdr.SlidingRun:
    """A run at r."""
    return mdr.slide(case, r * OMEGA * case.shake.du_y, accuracy=accuracy)


def claim(effort: str) -> Claim:
    """Shaken across its way a contact has no critical velocity

    How: Fast slides beside their laws, stiffness, and the force across with and without a normal oscillation.

    Range: Flat punch, cone, paraboloid and r^4, elastic and ωτ = 1, constant depth and Δu_z/u_z0 up to 0.6, rigid pull;
    η = Δu_y/(μ_0 κ u_z0) from 0.25 to {stiffest:g}, v_0/(ω Δu_y) from {SLOW:g} to {fastest:g}.

    Measured: Friction comes back to μ_0 at no velocity, whatever shape and rheology: what is missing falls like 1/v_0^2
    and is that of the law, up to the fourth order. There is no Eq. (1) or (15) for this direction. A stiffer contact,
    of larger η at the same shake, has less friction, down to that of a rigid contact, as its springs follow the shake
    less; but not at slow slides: at v_0 = {SLOW:g} ω Δu_y a punch of η = {least:g} has {least_cof:.4f} of μ_0, a rigid
    contact {rigid_cof:.4f}. With a normal oscillation of the same frequency the contact is pushed aside. Fast, most a
    quarter of a period apart, by the law of the mean of F_N y'; slow, most in phase: shaken by what the springs can
    follow (η = 0.5), up to {most} (of μ_0). A shake of one frequency alone makes no force across; one of two
    frequencies does.

    Verdict: holds

    Sentence: Shaken across, friction is back at μ_0 at no velocity: 1 − μ/μ_0 falls like 1/v_0^2. A normal oscillation
    beside it pushes the contact aside, by up to half of μ_0 and more.
    """
    quick = effort == "quick"
    slow = {eta: at(across("flat punch", eta), SLOW).cof / MU_0 for eta in STIFF}
    least = min(slow, key=lambda eta: slow[eta])
    sides = {alpha: _aside(alpha, quick) for alpha in (0.3, 0.6)}
    most = ", ".join(f"{max(map(abs, found)):.2f} at Δu_z/u_z0 = {alpha:g}" for alpha, found in sides.items())
    stiffest, fastest, least_cof = STIFF[-1], FAST[-1], slow[least]
    rigid_cof = laws.rigid_across(SLOW)
    return Claim(
        **told(claim, locals()),
        checks=(*_fast_checks(quick), *_stiffness_checks(quick, slow), *_side_checks(quick, sides)),
        figures=(_figure(quick),),
        equations=(
            Equation(
                "fast",
                r"1 - \frac{\mu}{\mu_0} \to \langle \frac{1}{4} \sum_n \frac{|n \omega Y_n|^2}{|v_0 + i n \omega"
                r" \mu_0 \kappa s/E^*_n|^2} \rangle",
                "Mean over the springs by their force; Y_n harmonics of y, the modulus is dynamic over long-time.",
            ),
            Equation(
                "aside",
                r"\mu_y \to \frac{\mu_0}{v_0} \frac{\langle F_N y' \rangle}{\langle F_N \rangle}",
                "Force across of a fast slide.",
            ),
        ),
    )


def _fast_checks(quick: bool) -> Checks:
    """The law of fast slides, and what it leaves out."""
    for shape, T in product(("flat punch", "paraboloid") if quick else SHAPES, (0.0, 1.0)):
        case = across(shape, 0.5, T=T)
        runs = [at(case, r, 1e-8) for r in FAST]
        off = [(1 - run.cof / MU_0) / laws.lost_across(case, run.v_0) - 1 for run in runs]
        where = f"{shape}, {loss(T)}, v_0 = {FAST[1]:g} ω Δu_y"
        why = "the next order is of the square of ω Δu_y/v_0"
        yield Check(f"lost friction over its law, less 1: {where}", off[1], 0.0, 1 / FAST[1] ** 2, why)
        name = f"what is left out of it, over that at half of v_0: {where}"
        yield Check.between(name, off[1] / off[0], 0.15, 0.35, "a quarter in the limit")


def _stiffness_checks(quick: bool, slow: dict[float, float]) -> Checks:
    sizes = (0.25, 1.0, 3.0, 30.0) if quick else (0.25, 0.5, 1.0, 3.0, 10.0, 30.0)
    for shape, T in product(("flat punch", "paraboloid"), (0.0,) if quick else (0.0, 1.0)):
        for r in (0.2, 1.0):
            cof = [at(across(shape, eta, T=T), r).cof / MU_0 for eta in sizes]
            where = f"{shape}, {loss(T)}, v_0 = {r:g} ω Δu_y"
            name = f"greatest change of COF/μ_0 from one η to a larger one: {where}"
            yield Check.at_most(name, max(b - a for a, b in pairwise(cof)), 0.0, "stiffer, less friction")
            far = cof[-1] - laws.rigid_across(r)
            name = f"COF/μ_0 at η = {sizes[-1]:g}, less that of a rigid contact: {where}"
            yield Check(name, far, 0.0, 0.6 / sizes[-1], "springs yield by 1/η of the shake")
    rigid = laws.rigid_across(SLOW)
    name = f"least COF of a punch over η, over that of a rigid contact: v_0 = {SLOW:g} ω Δu_y"
    yield Check.at_most(name, min(slow.values()) / rigid, 0.9, "slow, a compliant contact has less")
    far = at(across("flat punch", 1e4), 0.2, 1e-5).cof / MU_0
    name = "COF/μ_0 of a punch at η = 10^4, v_0 = 0.2 ω Δu_y"
    yield Check(name, far, laws.rigid_across(0.2), 1e-4, "springs yield by 1/η of the shake")


def _aside(alpha: float, quick: bool) -> list[float]:
    """Forces across over mu_0 of slow slides, shaken in phase with the depth."""
    velocities = (0.1,) if quick else (0.05, 0.1, 0.3)
    return [at(across("paraboloid", 0.5, alpha), r).cof_y / MU_0 for r in velocities]


def _side_checks(quick: bool, sides: dict[float, list[float]]) -> Checks:
    for shape, T in product(("paraboloid",) if quick else ("flat punch", "paraboloid"), (0.0, 1.0)):
        case = across(shape, 0.5, 0.4, 1.0, T)
        off = [(run.cof_y - laws.steered_across(case, run.v_0)) / MU_0 for run in (at(case, r, 1e-7) for r in FAST)]
        where = f"{shape}, {loss(T)}, φ = 1, v_0 = {FAST[1]:g} ω Δu_y"
        name = f"force across over μ_0 F_N, less its law: {where}"
        yield Check(name, off[1], 0.0, 2 / FAST[1] ** 2, "the next order is that of the square of ω Δu_y/v_0")
        name = f"that over the same at half of v_0: {where}"
        yield Check.between(name, off[1] / off[0], 0.15, 0.35, "a quarter in the limit")
    for alpha, found in sides.items():
        name = f"greatest force across of slow slides over μ_0 F_N: paraboloid, η = 0.5, φ = 0, Δu_z/u_z0 = {alpha:g}"
        yield Check.at_least(name, max(found), alpha / 2, "springs are pressed most while they are bent to one side")
    turned = at(across("paraboloid", 0.5, 0.3, math.pi), 0.1).cof_y / MU_0
    other = at(across("paraboloid", 0.5, 0.3), 0.1).cof_y / MU_0
    yield Check("the same in opposite phase, added", turned + other, 0.0, 2e-4, RUN)
    alone = max(abs(at(across(shape, 0.7), 0.1).cof_y) / MU_0 for shape in SHAPES)
    name = "greatest force across over μ_0 F_N at a constant depth, one frequency, four shapes"
    yield Check(name, alone, 0.0, 2e-4, RUN)
    case = across("paraboloid", 0.5)
    two = mdr.InPlaneMotion(OMEGA, y_sin=(case.shake.du_y,), y_cos=(0.0, case.shake.du_y))
    got = mdr.slide(replace(case, shake=two), 0.1 * OMEGA * case.shake.du_y).cof_y / MU_0
    yield Check.at_least("the same with two frequencies, paraboloid", abs(got), 0.05, "its two halves are not alike")


@figure("shaken_across", 1, 3, size=(13.2, 4.2))
def _figure(fig, axes, quick: bool):
    """Three panels: friction over velocity; friction over the stiffness; force across over velocity

    Elastic contacts shaken across. Left: friction comes back to μ_0 at no velocity; dotted is what is held at rest,
    dashed a rigid contact. Middle: over the stiffness of the contact; dotted: rigid. At slow slides a contact that
    yields a little has the least. Right: with a normal oscillation of phase φ the contact is pushed aside; dotted is
    the law of fast slides.
    """
    (curves, stiff, aside), velocity = axes, r"$v_0/(\omega\Delta u_y)$"
    r = np.geomspace(0.02, 10, 7 if quick else 16)
    for eta, colour in zip((0.25, 0.5, 1.0, 3.0), COLOURS, strict=False):
        case = across("paraboloid", eta)
        curves.plot(r, [at(case, one).cof / MU_0 for one in r], color=colour, label=rf"$\eta = {eta:g}$")
        if eta < 1:
            curves.axhline(laws.held_across(case.indenter, DEPTH, eta * DEPTH), color=colour, lw=1, ls=":")
    curves.plot(r, [laws.rigid_across(one) for one in r], "k--", lw=1, label="rigid")
    panel(curves, velocity, r"$\mu/\mu_0$", "paraboloid", "x", "best")
    sizes = np.geomspace(0.25, 60, 5 if quick else 10)
    for one, colour in zip((0.03, 0.2, 1.0), COLOURS, strict=False):
        cof = [at(across("flat punch", eta), one).cof / MU_0 for eta in sizes]
        stiff.plot(sizes, cof, color=colour, label=rf"$v_0 = {one:g}\,\omega\Delta u_y$")
        stiff.axhline(laws.rigid_across(one), color=colour, lw=1, ls=":")
    panel(stiff, r"$\eta = \Delta u_y/(\mu_0\kappa u_{z0})$", r"$\mu/\mu_0$", "flat punch", "x", "best")
    for phi, colour in zip((0.0, QUARTER / 2, QUARTER), COLOURS, strict=False):
        case = across("paraboloid", 0.5, 0.3, phi)
        aside_of = [at(case, one).cof_y / MU_0 for one in r]
        aside.plot(r, aside_of, color=colour, label=rf"$\varphi = {phi / math.pi:g}\pi$")
        fast = r[r > 2]
        law = [laws.steered_across(case, one * OMEGA * case.shake.du_y) / MU_0 for one in fast]
        aside.plot(fast, law, ":", color=colour)
    aside.axhline(0, color="0.75", lw=0.8)
    title = r"paraboloid, $\eta = 0.5$, $\Delta u_z/u_{z0} = 0.3$"
    panel(aside, velocity, r"$\mu_y/\mu_0$", title, "x", "best")
