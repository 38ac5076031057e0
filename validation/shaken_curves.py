"""Shaken along the slide: which curves are one, what is held at rest, and when nothing is.

While no spring slips back, only the difference w = s - u_x/(mu_0 kappa) of depth and way counts: a small oscillation of
any direction and phase takes the friction (k_xc A/(mu_0 F_N)) psi(v_0/(omega A)), A = |mu_0 kappa du_z -+ du_x e^i phi|
(`mdr.laws.lost_under_shake`). A great one meets the other barrier too, and the springs yield little beside it:
mu/mu_0 = (2/pi) arcsin(v_0/(omega du_x)), `mdr.laws.rigid_shake`. At rest an elastic contact of constant depth holds
what the shake leaves of the reach of its springs, `mdr.laws.held_under_shake`.

Symbols: alpha = du_z/u_z0, chi = du_x/(mu_0 kappa u_z0), A amplitude [m], r = v_0/(omega du_x).
"""

import math
from dataclasses import replace
from itertools import product

import numpy as np

import mdr
from mdr import laws
from mdr.closed_forms.paper import deficit
from mdr.half_space.friction import Settings, in_three_dimensions
from validation.cases import DEPTH, LOOKS, SHAPES, shaken, shape_label
from validation.figures import COLOURS, figure, panel
from validation.half_space.springs import of_springs
from validation.measured import RUN, lost, with_band
from validation.report import Check, Checks, Claim, told

CHIS = (0.3, 1.0, 3.0, 30.0)  #: of the figure
ALPHA_3D = 0.4  #: du_z/u_z0 of the contact that is computed in three dimensions
SMALL = 1e-3  #: A over mu_0 kappa u_z0 that counts as small


def claim(effort: str) -> Claim:
    """Small oscillations of any phase lower friction alike; under a great shake a contact slides as if rigid

    How: Scale the curves of all phases and directions on one, and look at both ends of them.

    Quote: The reduction of static and sliding friction by ultrasonic oscillation in various directions is a well-known
    phenomenon … (Section 1)

    Range: Elastic flat punch, cone, paraboloid and r^4, rigid pull; longitudinal amplitudes from a thousandth of μ_0 κ
    u_z0 to a hundred times that, alone and with a normal oscillation, {phases} phases, both ways; and two of them in
    three dimensions.

    Measured: As long as no spring slips back, only the difference of depth and way counts, A = |μ_0 κ Δu_z ∓ Δu_x
    e^{{iφ}}|: the lost friction of all phases, directions and shapes is (k_xc A/(μ_0 F_N)) ψ(v_0/(ωA)), for a flat
    punch exactly, for the others in the limit of small A. A longitudinal amplitude far above μ_0 κ u_z0 leaves (2/π)
    arcsin(v_0/(ω Δu_x)), the law of a rigid contact, and comes to it like one over the amplitude. Between the two there
    is no common curve: shape and amplitude over μ_0 κ u_z0 both tell. At rest a contact of constant depth holds μ_0
    F_N(u_z0 − Δu_x/(μ_0 κ)) in either direction: stiction is gone from Δu_x = μ_0 κ u_z0 on, for every shape. Over both
    directions of the pull friction never falls with velocity. A half-space of ν = 0 in three dimensions, whose cells
    feel each other, has the friction of the springs under a longitudinal oscillation as closely as under a normal one.

    Verdict: holds

    Sentence: Elastic, rigid pull: small oscillations of any phase and direction have the curve of the normal one; a
    shake at constant depth, great beside μ_0 κ u_z0, has the curve of a rigid contact.
    """
    quick = effort == "quick"
    phases = "two" if quick else "four"
    return Claim(
        **told(claim, locals()),
        checks=(*_small_checks(quick), *_great_checks(), *_band_checks(quick), _order_check(), *_half_space_checks()),
        figures=(_figure(quick),),
    )


def _small_checks(quick: bool) -> Checks:
    for phi, way in product((0.0, 0.7, math.pi / 2, math.pi) if not quick else (0.7, math.pi), (1, -1)):
        worst = []
        for shape, size in (("flat punch", 0.1), *((one, SMALL) for one in SHAPES)):
            case = shaken(shape, size, 0.6 * size, phi)
            velocities = [way * v * mdr.critical_velocity(case, way) for v in (0.15, 0.6)]
            off = [lost(case, v_0, accuracy=1e-7) / laws.lost_under_shake(case, v_0) - 1 for v_0 in velocities]
            worst.append(max(off, key=abs))
        where = f"phase {phi / math.pi:.3g} π, {'forward' if way == 1 else 'the other way'}"
        name = f"lost friction over (k_xc A/(μ_0 F_N)) ψ, less 1: flat punch, Δu_z = 0.1 u_z0, {where}"
        yield Check(name, worst[0], 0.0, 1e-4, "1e-7 of μ_0 asked of a run, over a lost friction of 1e-3 or more")
        name = f"the same, worst of four shapes, Δu_z = {SMALL:g} u_z0, {where}"
        why = "the next order is the amplitude over the depth, and 1e-7 asked of a run over a lost friction of 1e-4"
        yield Check(name, max(worst[1:], key=abs), 0.0, 5 * SMALL, why)


def _great_checks() -> Checks:
    sizes = (30.0, 120.0)
    for shape in SHAPES:
        cases = [shaken(shape, 0.0, chi) for chi in sizes]
        cofs = [mdr.slide(case, 0.5 * mdr.critical_velocity(case)).cof / case.mu_0 for case in cases]
        off = [cof - laws.rigid_shake(0.5) for cof in cofs]
        name = f"COF/μ_0 less (2/π) arcsin r, r = 0.5, Δu_x = {sizes[1]:g} μ_0 κ u_z0: {shape}"
        yield Check(name, off[1], 0.0, 1.0 / sizes[1], "springs yield by μ_0 κ u_z0 at most, over the amplitude")
        falls = math.log(abs(off[1] / off[0])) / math.log(sizes[1] / sizes[0])
        name = f"power of the amplitude with which that vanishes, from {sizes[0]:g} to {sizes[1]:g} μ_0 κ u_z0: {shape}"
        yield Check.at_most(name, falls, -0.9, "at least like one over the amplitude, to the next order")


def _band_checks(quick: bool) -> Checks:
    for shape in SHAPES:
        chis, mu_0, depth = (0.2, 0.7) if quick else (0.1, 0.3, 0.5, 0.7, 0.9), 0.5, DEPTH
        bands = [mdr.holding_band(shaken(shape, 0.0, chi)) for chi in chis]
        laws_of = [laws.held_under_shake(SHAPES[shape], depth, chi * depth) for chi in chis]
        off = [band.high / mu_0 - law for band, law in zip(bands, laws_of, strict=True)]
        name = f"load held at rest over μ_0 F_N, less F_N(u_z0 − Δu_x/(μ_0 κ))/F_N(u_z0), worst: {shape}"
        yield Check(name, max(off, key=abs), 0.0, 1e-5, RUN)
        sides = [(band.high + band.low) / mu_0 for band in bands]
        yield Check(f"its two ends added, worst: {shape}", max(sides, key=abs), 0.0, 2e-5, RUN)
        gone = mdr.holding_band(shaken(shape, 0.0, 1.002))
        name = f"width of what is held over μ_0 F_N at Δu_x = 1.002 μ_0 κ u_z0: {shape}"
        yield Check.at_most(name, (gone.high - gone.low) / mu_0, 2e-5, RUN)


def _order_check() -> Check:
    """Friction never falls with velocity, both ways together."""
    falls = []
    for known in (("cone", 0.5, 1.5, 1.0), ("paraboloid", 0.8, 0.8, 2.0), ("flat punch", 1.3, 4.0, 4.0)):
        case = shaken(*known)
        fastest = max(mdr.critical_velocity(case, way) for way in (1, -1))
        falls.append(np.max(-np.diff(mdr.cof_curve(case, np.linspace(-1.1, 1.1, 23) * fastest).cof)) / case.mu_0)
    name = "greatest fall of COF/μ_0 with velocity, from −1.1 to 1.1 of the greater v_c, three contacts"
    return Check.at_most(name, max(falls), 1e-5, f"none, to {RUN}")


def _half_space_checks() -> Checks:
    """The springs beside three dimensions without coupling, in the same steps."""
    settings = Settings(cells=40, steps=48, cycles=6, coupled=False, settled=1e-6)
    for alpha in (0.0, ALPHA_3D):
        case = shaken("paraboloid", alpha, 1.0, 0.7)
        case = replace(case, material=replace(case.material, nu=0.0))
        v_0 = 0.3 * mdr.critical_velocity(case)
        apart = (in_three_dimensions(case, v_0, settings).cof - of_springs(case, v_0, settings).cof) / case.mu_0
        where = f"paraboloid, {f'Δu_z/u_z0 = {alpha:g}' if alpha else 'constant depth'}, v_0 = 0.3 v_c"
        name = f"COF/μ_0 in three dimensions less that of springs in the same steps: {where}"
        yield Check(name, apart, 0.0, 2e-4, f"as for normal oscillations; grid of {settings.cells}² cells")


@figure("shaken_curves", 1, 3, size=(13.2, 4.3))
def _figure(fig, axes, quick: bool):
    """Three panels: friction over velocity for four amplitudes; scaled loss on one curve; held load over amplitude

    Elastic contacts under a rigid pull. Left: friction of a paraboloid of constant depth that is shaken along its way
    goes from a step (amplitude χ far below 1, in units of μ_0 κ u_z0) to the law of a rigid contact; at rest it holds
    all loads of the vertical part. Middle: small oscillations of four shapes, normal and longitudinal together, each in
    another phase, filled forward and hollow the other way: all lose ψ. Right: what is held at rest, closed form (lines)
    and runs: nothing from χ = 1 on.
    """
    curves, one, held = axes
    r = np.linspace(-1.2, 1.2, 25 if quick else 49)
    fine, v = np.linspace(-1.2, 1.2, 241), np.linspace(0.05, 0.95, 7 if quick else 13)
    for chi, colour in zip(CHIS, COLOURS, strict=False):
        case = shaken("paraboloid", 0.0, chi)
        curves.plot(*with_band(case, r, mdr.critical_velocity(case)), color=colour, label=rf"$\chi = {chi:g}$")
    curves.plot(fine, [laws.rigid_shake(x) for x in fine], "k:", lw=1, label="rigid")
    x = r"$v_0/(\omega\Delta u_x)$"
    panel(curves, x, r"$\mu/\mu_0$", "paraboloid, longitudinal", legend="upper left")
    one.plot(v, [deficit(x) for x in v], "k", lw=1, label=r"$\psi$")
    for (shape, (colour, marker)), phi in zip(LOOKS.items(), (0.7, math.pi / 2, math.pi, 5.0), strict=True):
        for way, face in ((1, colour), (-1, "white")):
            case = shaken(shape, 0.02, 0.015, phi)
            v_c = mdr.critical_velocity(case, way)
            unit = laws.lost_under_shake(case, way * 0.5 * v_c) / deficit(0.5)
            name = f"{shape_label(shape)}, {phi / math.pi:.2g}$\\pi$" if way == 1 else None
            points = [lost(case, way * x * v_c, accuracy=1e-7) / unit for x in v]
            one.plot(v, points, marker, ls="", mfc=face, mec=colour, label=name)
    title = "small, any phase, both ways"
    panel(one, r"$v_0/(\omega A)$", r"lost friction over $k_{xc}A/(\mu_0F_N)$", title, legend="best")
    chi, at = np.linspace(0, 1.2, 121), np.arange(0.15, 1.2, 0.25)
    for shape, (colour, marker) in LOOKS.items():
        law = [laws.held_under_shake(SHAPES[shape], 2e-5, 2e-5 * x) for x in chi]
        held.plot(chi, law, color=colour, lw=1)
        bands = [mdr.holding_band(shaken(shape, 0.0, x)).high / 0.5 for x in at]
        held.plot(at, bands, marker, ls="", color=colour, label=shape_label(shape))
    x, y = r"$\chi = \Delta u_x/(\mu_0\kappa u_{z0})$", r"load held at rest over $\mu_0F_N$"
    panel(held, x, y, "at rest", legend="best")
