"""The judge before it judges: contacts in three dimensions whose answer is known, and the order of its errors.

The half-space of validation/half_space shares nothing with the springs: tractions on a grid of cells, Boussinesq's and
Cerruti's influence coefficients, friction as a vector. It is asked first for

* the forces of Hertz and of the flat punch, free of friction and bonded, where Mossakovskii (1954) has
  ln(3 - 4 nu) (1 - nu)/(1 - 2 nu) for the ratio of the two,
* the partial slip of Cattaneo (1938) and Mindlin (1949), exact for nu = 0, and what their neglect of transverse slip
  costs for nu > 0,
* Spence's (1968, 1975) radius of stick under a load alone, for which validation/half_space/rings.py solves the
  axisymmetric equations in another way; the textbook's closed form leaves out that friction moves the surface down,
* errors that fall with cells and steps as they should.
"""

from functools import cache

import numpy as np

import mdr
from mdr.half_space.friction import Settings, in_three_dimensions
from validation.cases import contact
from validation.figures import COLOURS, figure, ticks
from validation.half_space import rings
from validation.half_space.benchmarks import PartialSlip, cattaneo_mindlin, hertz, punch, spence
from validation.report import Check, Checks, Claim, told

SHARES = (0.2, 0.5, 0.8)  #: of the way to full slip
SPENCE = ((0.0, 0.3), (0.0, 0.6), (0.15, 0.3), (0.3, 0.3))  #: nu, mu_0


def claim(effort: str) -> Claim:
    """The reference solver in three dimensions agrees with known solutions

    How: Ask for what is known.

    Range: a rigid paraboloid and flat punch on an elastic half-space, ν from 0 to 0.5: pressed with and without
    friction, bonded, and pulled; grids of 16² to 64² cells

    Measured: Forces, tractions and radii of stick are those of the closed forms. Where transverse slip, which Cattaneo
    and Mindlin leave out, plays a part, it changes the force by {force:.1e} of μ_0 <i>F<sub>z</sub></i> at ν = 0.5,
    with tractions across the pull of up to {across:.2f} μ_0 p_0, less than ν/(4 − 2ν) = 0.17. Spence's radius of stick
    under a normal load comes out as the axisymmetric equations have it. The closed form in the textbooks for it leaves
    out that friction moves the surface down (Goodman); at ν = 0 and μ_0 = 0.3 that alone makes the radius
    {gone_percent:.0f} % smaller.

    Verdict: holds

    Sentence: The reference solver meets Hertz, Cattaneo and Mindlin, the bonded punch and Spence within its stated
    errors.
    """
    quick = effort == "quick"
    n = 32 if quick else 64
    slips = {nu: [cattaneo_mindlin(n, nu, share) for share in SHARES] for nu in (0.0, 0.3, 0.5)}
    force = max(abs(one.force - one.closed_form) for one in slips[0.5])
    across = max(one.transverse for one in slips[0.5])
    gone = 1 - rings.stick_radius(0.5, 0.3) / rings.goodman(0.5, 0.3)
    gone_percent = 100 * gone
    return Claim(
        **told(claim, locals()),
        checks=(*_normal_checks(quick), *_slip_checks(slips, n), *_spence_checks(quick), *_order_checks(quick)),
        figures=(_figure(quick),),
    )


# --- checks ---


def _normal_checks(quick: bool) -> Checks:
    n = 32 if quick else 64
    yield Check(f"Hertz, force on {n}² cells, over 4/3 E* a d", hertz(n), 1, 5e-4 if quick else 1e-4, "O(h)")
    if not quick:
        first, last = (abs(hertz(n) - 1) for n in (16, 64))
        order = np.log(first / last) / np.log(4)
        yield Check.at_least("Hertz, order in the cell size from 16² to 64²", order, 1.0, "a kinked edge")
        order = np.log2(abs((punch(32, 0.0)[0] - 1) / (punch(64, 0.0)[0] - 1)))
        yield Check("flat punch, order in the cell size from 32² to 64²", order, 1, 0.2, "infinite pressure")
    for nu in (0.0,) if quick else (0.0, 0.3, 0.45):
        smooth, bonded = (2 * fine - coarse for fine, coarse in zip(punch(64, nu), punch(32, nu), strict=True))
        known = np.log(3 - 4 * nu) * (1 - nu) / (1 - 2 * nu)
        why = "from 32² and 64² cells, in the first power of their size"
        if not nu:
            yield Check("flat punch, force over 2 E* a d", smooth, 1, 1e-3, why)
        yield Check(f"flat punch, bonded over smooth, ν = {nu:g}, over Mossakovskii's", bonded / known, 1, 1e-3, why)


def _slip_checks(slips: dict[float, list[PartialSlip]], n: int) -> Checks:
    for share, one in zip(SHARES, slips[0.0], strict=True):
        name = f"Cattaneo and Mindlin, ν = 0, {share:g} of full slip"
        yield Check(f"{name}: F_x/(μ_0 F_z)", one.force, one.closed_form, 6e-3 / n, "of the cells; 1e-3 asked")
        yield Check(f"{name}: stick radius over a", one.stick, np.sqrt(1 - share), 0.01, "areas in whole cells")
        yield Check.at_most(f"{name}: traction, over μ_0 p_0", one.traction, 3 / n, "infinite slope within a cell")
    for nu in (0.3, 0.5):
        most = max(abs(one.force - one.closed_form) for one in slips[nu])
        name = f"transverse slip left out, ν = {nu:g}: ΔF_x/(μ_0 F_z)"
        yield Check.at_most(name, most, 0.1 * nu / (4 - 2 * nu), "of second order")
        most = max(one.transverse for one in slips[nu])
        name = f"transverse slip left out, ν = {nu:g}: q_y/(μ_0 p_0)"
        yield Check.at_most(name, most, nu / (4 - 2 * nu), "its order")


def _spence_checks(quick: bool) -> Checks:
    for nu, mu_0 in SPENCE[::3] if quick else SPENCE:
        known = rings.stick_radius(_beta(nu), mu_0)
        got = {"flat punch": np.mean([spence(n, nu, mu_0) for n in ((32,) if quick else (48, 64))])}
        if not quick:
            got["paraboloid, loaded in 40 steps"] = spence(45, nu, mu_0, 40)
        why = "areas in whole cells; 2 % asked"
        for shape, radius in got.items():
            name = f"Spence, {shape}, ν = {nu:g}, μ_0 = {mu_0:g}: stick radius over that of the equations"
            yield Check(name, float(radius) / known, 1, 0.02, why)
    for nu, mu_0 in SPENCE:
        beta = _beta(nu)
        name = f"the equations, u_z by friction left out, ν = {nu:g}, μ_0 = {mu_0:g}: over the closed form"
        got = rings.stick_radius(beta, mu_0, coupled=False) / rings.goodman(beta, mu_0)
        yield Check(name, got, 1, 1e-5, "100 nodes")


def _beta(nu: float) -> float:
    return mdr.Elastic(E=1.0, nu=float(nu)).dundurs_beta


@cache
def _stepped(steps: int) -> float:
    case, settings = contact("paraboloid", 0.3, mu_0=0.3, nu=0.3), Settings(cells=17, steps=steps, cycles=2)
    return in_three_dimensions(case, 0.4 * mdr.critical_velocity(case), settings).cof / case.mu_0


def _order_checks(quick: bool) -> Checks:
    n = 20 if quick else 40
    first, second = (_stepped(m) - _stepped(2 * m) for m in (n, 2 * n))
    name = f"COF with coupling, change from {n} to {2 * n} steps over that from {2 * n} to {4 * n}"
    yield Check.between(name, first / second, 1.5, 4.5, "implicit steps: 2 for the first order, 4 for the second")


# --- figure ---


@figure("trust", 1, 2, size=(9.6, 3.9))
def _figure(fig, axes, quick: bool):
    """Two panels: relative errors falling with the number of cells; stick radius against Poisson's ratio for three
    coefficients of friction, circles on full lines.

    Left: forces of the reference solver approach the closed forms with the number of cells, at first order or better.
    Right: stick under a normal load alone (Spence). The circles of the three-dimensional solver lie on the full lines
    of the axisymmetric equations, with every coupling; Goodman's closed form (dashed) leaves out that friction moves
    the surface down, and is too high where ν and μ_0 are small.
    """
    left, right = axes
    cells = (16, 32) if quick else (16, 24, 32, 48, 64)
    nus = np.linspace(0, 0.49, 15)
    betas = [_beta(nu) for nu in nus]
    left.loglog(cells, [abs(hertz(n) - 1) for n in cells], "o-", label="Hertz")
    left.loglog(cells, [abs(punch(n, 0.0)[0] - 1) for n in cells], "s-", label="punch, smooth")
    left.loglog(cells, [abs(punch(n, 0.0)[1] / np.log(3) - 1) for n in cells], "^-", label="punch, bonded over smooth")
    left.loglog(cells, 0.2 / np.array(cells), "k:", lw=1, label="first order")
    ticks(left.xaxis, *cells)
    left.set(ylim=(3e-5, 0.15), xlabel="cells along a side", ylabel="relative error of the force")
    left.legend(loc="upper right", ncols=2)
    for mu_0, colour in ((0.1, COLOURS[3]), (0.3, COLOURS[0]), (0.6, COLOURS[1])):
        right.plot(nus, [rings.stick_radius(b, mu_0) for b in betas], color=colour, label=rf"$\mu_0 = {mu_0:g}$")
        right.plot(nus, [rings.goodman(b, mu_0) for b in betas], "--", color=colour, lw=1)
        some = (0.0, 0.3) if quick else (0.0, 0.1, 0.2, 0.3, 0.4)
        right.plot(some, [spence(32 if quick else 64, nu, mu_0) for nu in some], "o", color=colour, mfc="w")
    right.plot([], [], "k--", lw=1, label="Goodman's approximation")
    right.plot([], [], "ko", mfc="w", label="three dimensions")
    right.set(xlabel=r"Poisson's ratio $\nu$", ylabel=r"stick radius over $a$", ylim=(0, 1.02))
    right.legend(loc=(0.02, 0.13), fontsize=9)
