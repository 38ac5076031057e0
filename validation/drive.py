"""A contact that is shaken along the slide while it is pressed drives itself: how hard, how fast, how well.

Pressed harder while the tool runs back, springs are carried forward more than back: friction is negative at rest. Two
ends of the characteristic tell most: the push where it is held (`mdr.blocked_cof`), and the velocity without load
(`mdr.no_load_velocity`). Where the shake is far greater than springs yield, a flat face pushes with (2/pi) alpha mu_0
F_N and runs at r omega du_x with arcsin r = alpha sqrt(1 - r²), `mdr.laws.elliptic_drive`. Springs that yield take of
both.

Efficiency: mechanical power out, the mean of -F_x times v_0, over the power of both drives, F_z u_z' and F_x x'.

Symbols: alpha = du_z/u_z0, chi = du_x/(mu_0 kappa u_z0), r = v_0/(omega du_x).
"""

import math
from itertools import product
from typing import Any

import numpy as np

import mdr
from mdr import laws
from validation.cases import BODY, LOOKS, OMEGA, SHAPES, reach, shaken, shape_label
from validation.figures import COLOURS, figure, panel
from validation.measured import RUN, with_band
from validation.report import Check, Checks, Claim, told

ALPHA, QUARTER = 0.5, math.pi / 2  #: of the figure; phase of the shake


def claim(effort: str) -> Claim:
    """Shaken along the slide a quarter of a period ahead of its depth, a contact drives itself

    How: Ends of the characteristic beside the law of a stiff contact, and the account of energy along it.

    Quote: … with many applications ranging from wire drawing and press forming … and production of directed motion, as
    in ultrasonic motors and linear actuators. (Section 1)

    Range: Elastic flat punch, cone, paraboloid and r^4, Δu_z/u_z0 = {ALPHA:g} (0.2 to 0.9 for the punch), longitudinal
    amplitude from 0.1 to 120 times μ_0 κ u_z0, a quarter of a period ahead; rigid pull and a body on a spring.

    Measured: A contact is stiff here if its springs yield far less than Δu_x. Held, a stiff flat face pushes with
    (2/π)(Δu_z/u_z0) μ_0 F_N; free, it runs at r ω Δu_x with arcsin r = (Δu_z/u_z0) √(1 − r^2). Curved shapes push more,
    since their force changes more with depth: a stiff elastic cone with (4α/π)/(1 + α^2/2) of μ_0 F_N, α = Δu_z/u_z0.
    Springs that yield take of both, and come to this like one over the amplitude. Between the two ends friction rises
    with velocity throughout, so that every load below the blocked one has one velocity. The best efficiency is
    {best_soft:.2f} at Δu_x = 3 μ_0 κ u_z0 and {best_stiff:.2f} at 30: what is not given out is lost to slip, as the
    account of three drives closes. Below some longitudinal amplitude the contact holds zero load and does not drive at
    all. Half a period later it pushes the other way. In phase it pushes weakly, because the springs need some travel to
    reverse at the two ends of the shake, and are pressed more at one end than at the other: (4/3π) [(1 + α)^1.5 − (1 −
    α)^1.5] (μ_0 κ u_z0/Δu_x)^½ of μ_0 F_N, backward, which vanishes far more slowly than all else.

    Verdict: holds

    Sentence: A contact drives itself if it does not hold zero load at rest. A stiff flat punch pushes with (2/π)α μ_0
    F_N and runs at r ω Δu_x, arcsin r = α √(1 − r^2), α = Δu_z/u_z0; curved shapes push more.
    """
    quick = effort == "quick"
    best_soft, best_stiff = _best(3.0), _best(30.0)
    return Claim(
        **told(claim, locals()),
        checks=(*_stiff_checks(), *_curve_checks(quick), *_energy_checks(), *_side_checks()),
        figures=(_figure(quick),),
    )


def _stiff_checks() -> Checks:
    sizes, why = (30.0, 120.0), "springs yield by μ_0 κ u_z0 (1 + Δu_z/u_z0) at most, over the amplitude"
    for alpha in (0.2, 0.5, 0.9):
        law, where = laws.elliptic_drive(alpha), f"Δu_z/u_z0 = {alpha:g}, Δu_x = {sizes[1]:g} μ_0 κ u_z0"
        cases = [shaken("flat punch", alpha, chi, QUARTER) for chi in sizes]
        pushes = [-mdr.blocked_cof(case) / case.mu_0 - law.blocked for case in cases]
        units = [OMEGA * chi * reach(case) for case, chi in zip(cases, sizes, strict=True)]
        frees = [mdr.no_load_velocity(case) / unit - law.free for case, unit in zip(cases, units, strict=True)]
        yield Check(f"blocked push over μ_0 F_N, less (2/π) α: {where}", pushes[1], 0.0, 2 / sizes[1], why)
        yield Check(f"velocity without load over ω Δu_x, less r: {where}", frees[1], 0.0, 2 / sizes[1], why)
        for name, off in (("push", pushes), ("velocity", frees)):
            power = math.log(abs(off[1] / off[0])) / math.log(sizes[1] / sizes[0])
            name = f"power of the amplitude with which that of the {name} vanishes: Δu_z/u_z0 = {alpha:g}"
            yield Check.at_most(name, power, -0.9, "at least like one over the amplitude, to the next order")
        cone = shaken("cone", alpha, sizes[1], QUARTER)
        known = (4 * alpha / math.pi) / (1 + alpha**2 / 2)  # force ~ depth squared: mean of sign(cos) (1 + a cos)²
        got = -mdr.blocked_cof(cone) / cone.mu_0
        yield Check(f"blocked push of a cone over μ_0 F_N: {where}", got, known, 2 / sizes[1], why)


def _curve_checks(quick: bool) -> Checks:
    for shape, body in product(SHAPES if not quick else ("flat punch", "paraboloid"), ({}, BODY)):
        case = shaken(shape, ALPHA, 5.0, QUARTER, **body)
        free = mdr.no_load_velocity(case)
        where = f"{shape}, {'body' if body else 'rigid pull'}, Δu_x = 5 μ_0 κ u_z0"
        at = mdr.slide(case, free).cof / case.mu_0
        yield Check(f"COF/μ_0 at the velocity without load: {where}", at, 0.0, 2e-5, RUN)
        rising = np.min(np.diff(mdr.cof_curve(case, np.linspace(0, 1.0, 7) * free).cof)) / case.mu_0
        name = f"least rise of COF/μ_0 from held to free, in seven velocities: {where}"
        yield Check.at_least(name, rising, 1e-3, "a sixth of the blocked friction is some per cent")


def _energy_checks() -> Checks:
    for chi in (3.0, 30.0):
        case = shaken("flat punch", ALPHA, chi, QUARTER)
        account = mdr.slide(case, 0.5 * mdr.no_load_velocity(case), accuracy=1e-6).energy_balance
        name = f"residual of the account of energy, over what is lost, half-way to no load: Δu_x = {chi:g} μ_0 κ u_z0"
        why = "second order in a step of 1/1000 of a period, over the share that drives"
        yield Check(name, account.relative, 0.0, 2e-4, why)
        name = f"efficiency there: Δu_x = {chi:g} μ_0 κ u_z0"
        yield Check.between(name, _efficiency(account), 0.02, 0.5, "a drive, and not a good one: slip takes most")


def _best(chi: float) -> float:
    """Greatest efficiency between held and free."""
    case = shaken("flat punch", ALPHA, chi, QUARTER)
    free = mdr.no_load_velocity(case)
    return max(_efficiency(mdr.slide(case, share * free).energy_balance) for share in np.linspace(0.3, 0.8, 6))


def _efficiency(account: Any) -> float:
    """Power out over that of the drives."""
    return -account.pull_work / (account.normal_work + account.shake_work)


def _side_checks() -> Checks:
    """Which way it drives, and when not."""
    one, other = (mdr.blocked_cof(shaken("paraboloid", ALPHA, 5.0, phi)) / 0.5 for phi in (QUARTER, -QUARTER))
    yield Check("push at rest with the phase turned, added to that before, over μ_0 F_N", one + other, 0.0, 2e-5, RUN)
    for phi, way in ((0.0, 1), (math.pi, -1)):
        where = f"way in phase {phi / math.pi:g} π: flat punch"
        name = f"COF/μ_0 at rest times the root of Δu_x/(μ_0 κ u_z0) = 120, {where}"
        push = mdr.blocked_cof(shaken("flat punch", ALPHA, 120.0, phi)) / 0.5
        known = way * 4 / (3 * math.pi) * ((1 + ALPHA) ** 1.5 - (1 - ALPHA) ** 1.5)
        why = "springs turn over while the way turns back, which takes a time like the root; the next order is 1/120"
        yield Check(name, push * math.sqrt(120), known, 1 / 120, why)
    held = mdr.holding_band(shaken("flat punch", ALPHA, 0.1, QUARTER))
    name = "low end of what is held at Δu_x = 0.1 μ_0 κ u_z0, a quarter apart"
    yield Check.at_most(name, held.low, 0.0, "zero load is held")
    yield Check.at_least("its high end", held.high, 0.0, "zero load is held")


@figure("drive", 1, 3, size=(13.2, 4.3))
def _figure(fig, axes, quick: bool):
    """Three panels: friction over velocity; efficiency over velocity; push over the amplitude of the shake

    Elastic contacts, Δu_z/u_z0 = {alpha:g}, shaken along the slide a quarter of a period ahead of the depth, χ =
    Δu_x/(μ_0 κ u_z0). Left: the characteristic of a flat punch crosses zero at its velocity without load; stars are the
    law of a stiff contact. Middle: efficiency between held and free. Right: the push where it is held: nothing at small
    amplitude, where zero load is still held, and for the flat punch the dotted law of a stiff face at great amplitude;
    curved shapes push more.
    """
    (curves, well, ends), velocity = axes, r"$v_0/(\omega\Delta u_x)$"
    r = np.linspace(-0.2, 1.05, 16 if quick else 40)
    chis = np.geomspace(0.5, 50, 7 if quick else 14)
    law = laws.elliptic_drive(ALPHA)
    for chi, colour in zip((1.0, 3.0, 30.0), COLOURS, strict=False):
        case = shaken("flat punch", ALPHA, chi, QUARTER)
        unit = OMEGA * chi * reach(case)
        curves.plot(*with_band(case, r, unit), color=colour, label=rf"$\chi = {chi:g}$")
        v = np.linspace(0, 1, 9 if quick else 17) * mdr.no_load_velocity(case)
        out = [_efficiency(mdr.slide(case, one).energy_balance) if one else 0.0 for one in v]
        well.plot(v / unit, out, color=colour)
    curves.plot(0, -law.blocked, "k*", ms=9, label="stiff contact")
    curves.plot(law.free, 0, "k*", ms=9)
    curves.axhline(0, color="0.75", lw=0.8)
    panel(curves, velocity, r"$\mu/\mu_0$", "force over velocity, flat punch", legend="upper left")
    panel(well, velocity, "efficiency", "power out over power of the drives")
    for shape, (colour, marker) in LOOKS.items():
        cases = [shaken(shape, ALPHA, chi, QUARTER) for chi in chis]
        push = [max(-mdr.holding_band(case).high, 0.0) / case.mu_0 for case in cases]
        ends.plot(chis, push, marker, ls="-", lw=1, color=colour, label=shape_label(shape))
    ends.axhline(law.blocked, color="k", lw=1, ls=":")
    panel(ends, r"$\chi = \Delta u_x/(\mu_0\kappa u_{z0})$", r"push at rest over $\mu_0F_N$", "held", "x", "best")
    return {"alpha": ALPHA}
