"""The springs stand for the half-space: force, stiffness, contact radius and pressure of every shape.

Truth here is three-dimensional and older than the springs: Hertz (1881), Boussinesq's punch, Sneddon's cone and power
law (1965), and the half-space itself, which a pressure p(r) sinks by

    u(r) = 4/(pi E*) int_0^a p(s) s/(r + s) K(m) ds,    m = 4 r s/(r + s)²,

K the complete elliptic integral. Inside the contact this must be d - f(r): a pressure that does so, adds up to F_N and
pulls nowhere is the solution, whatever formula it came from. So the whole catalogue is tested.

Symbols (SI): d depth, a contact radius, F_N force, k_zc = dF_N/dd stiffness, p pressure, E_star contact modulus,
alpha = du_z/u_z0.
"""

import math
from collections.abc import Iterable
from itertools import pairwise, product
from typing import Any

import numpy as np

import mdr
import mdr.indenters as shapes
from mdr.tools.arrays import Array
from validation.cases import CATALOGUE, DEPTH, OMEGA, RADIUS, SHAPES, E, contact, depth_of, shape_label, widest_cell
from validation.figures import COLOURS, below, circles, figure, outer_labels, panel, ticks
from validation.measured import power
from validation.report import Check, Checks, Claim, told

E_STAR = E / (1 - 0.5**2)  # of the rubber
ROUNDING = 1e-12  # some ten roundings of 2e-16 on either side, times a/(a - r) < 100 near the rim
PLACES = RADIUS * np.array([0.05, 0.4, 0.7, 0.95])  # within the contact, where the half-space is looked at
ENDS = "the row is cut there and each stretch keeps its mean depth: only rounding is left"
AMPLITUDES = {"quick": (1e-9, 1e-3, 0.3, 1.0, 2.0), "full": (1e-9, 1e-6, 1e-3, 0.03, 0.3, 0.9, 1.0, 1.3, 2.0)}


def claim(effort: str) -> Claim:
    """A row of independent springs stands for the contact

    How: Test shapes, quadrature and spring array against three-dimensional contact mechanics.

    Quote: According to the Method of Dimensionality Reduction (MDR), any rotationally symmetric contact can be
    equivalently represented by a model consisting of a series of independent springs. (Section 2.2.2)

    Range: flat punch, cone, paraboloid and r^4, depths from 2·10⁻⁵ to 40 µm, each also given as a mere function f(r);
    every other shape of the catalogue, with flat faces, caps and corners, also given by points and by a curve of force;
    spring arrays for Δu_z/u_z0 from 10^-9 to 2, with {counts[0]} to {most} springs.

    Measured: Contact radius, force, stiffness and pressure agree with the solutions of Hertz, Sneddon and Boussinesq to
    rounding, {off_formulas:.0e}; of a shape given as a mere function f(r), to {off_functions:.0e}. That pressure adds
    up to the force to {off_force:.0e}, for each of the {n_shapes} shapes, and, put on an elastic half-space, sinks its
    surface into the shape to {off_surface:.0e} of the depth, as far as these quadratures go. The springs add up to F_N
    and k_zc to rounding at both extremes of the oscillation, however small it is. In between a force is off by the one
    spring that is about to touch: an error that falls with the square of the number of springs.

    Verdict: holds

    Sentence: The springs carry the force, stiffness and pressure of the three-dimensional contact: to rounding where
    both sides are formulas, to the accuracy of the quadrature where one is an integral.
    """
    amplitudes = AMPLITUDES["quick" if effort == "quick" else "full"]
    counts = (32, 64, 128, 256, 512) if effort == "quick" else (32, 64, 128, 256, 512, 1024, 2048)
    orders = {shape: _errors(shape, 0.3, counts) for shape in SHAPES if shape != "flat punch"}
    sunk = {shape: _sunk(indenter, depth_of(indenter)) for shape, indenter in CATALOGUE.items()}
    checks = (*_shape_checks(sunk), *_profile_checks(), *_sum_checks(amplitudes), *_catalogue_sum_checks())
    checks += tuple(_order_checks(orders, counts))
    formulas = [check for check in checks if "as a function" not in check.name]
    most, off_formulas = counts[-1], _greatest(formulas, ": a, F_N")
    off_functions = _greatest(checks, "as a function")
    off_force = _greatest(checks, "over the disc")
    n_shapes, off_surface = len(SHAPES) + len(CATALOGUE), _greatest(checks, "half-space")
    return Claim(
        **told(claim, locals()),
        checks=checks,
        figures=(_pressure_figure(), _catalogue_figure(sunk), _error_figure(orders, counts)),
    )


def _greatest(checks: Iterable[Check], name: str) -> float:
    """Largest value among the checks of that name."""
    return max(float(check.got) for check in checks if name in check.name and check.got is not None)


# --- three dimensions, written from the textbooks ---


def textbook(shape: str, d: Any) -> tuple[Any, Any, Any]:
    """Contact radius [m], force [N] and stiffness [N/m] at depth d [m] after Boussinesq, Sneddon, Hertz, Sneddon."""
    indenter = SHAPES[shape]
    if shape == "flat punch":
        return indenter.a + 0 * d, 2 * E_STAR * indenter.a * d, 2 * E_STAR * indenter.a + 0 * d
    if shape == "cone":
        slope = math.tan(indenter.theta)
        return 2 * d / (np.pi * slope), 2 * E_STAR * d**2 / (np.pi * slope), 4 * E_STAR * d / (np.pi * slope)
    if shape == "paraboloid":
        root = np.sqrt(indenter.R * d)
        return root, 4 / 3 * E_STAR * root * d, 2 * E_STAR * root
    a = (3 * d / (8 * indenter.c)) ** 0.25
    return a, 8 / 5 * E_STAR * a * d, 2 * E_STAR * a


def textbook_pressure(shape: str, r: Array, d: float) -> Array:
    """Pressure [Pa] at radii r < a [m]."""
    indenter = SHAPES[shape]
    a = float(textbook(shape, d)[0])
    chord = np.sqrt((a - r) * (a + r))
    if shape == "flat punch":
        return np.asarray(E_STAR * d / (np.pi * chord))
    if shape == "cone":
        return np.asarray(E_STAR / 2 * math.tan(indenter.theta) * np.arccosh(a / r))
    if shape == "paraboloid":
        return np.asarray(2 * E_STAR / (np.pi * indenter.R) * chord)
    return np.asarray(32 * E_STAR * indenter.c / (9 * np.pi) * chord * (a**2 + 2 * r**2))


def sunk_surface(indenter: mdr.Indenter, r: float, d: float) -> float:
    """Displacement [m] of the half-space at r under the indenter's own pressure.

    With s = a sin t the rim is tame; t is graded towards tip, corners, r and rim, where the integrand has a logarithm.
    """
    from scipy.special import ellipkm1

    a = float(indenter.contact_radius(d))
    u, weight = np.polynomial.legendre.leggauss(120)
    u, weight = 0.5 * (u + 1), 0.5 * weight
    total = 0.0
    marks = sorted({0.0, r, *(b for b in indenter.kinks if b < a), a})
    for low, high in pairwise(np.arcsin(np.array(marks) / a)):
        t, dt = low + (high - low) * u**3 * (10 - 15 * u + 6 * u**2), (high - low) * 30 * u**2 * (1 - u) ** 2
        s = a * np.sin(t)
        p = np.asarray(indenter.pressure(s, d, E_STAR))
        kernel = s / (r + s) * ellipkm1(((r - s) / (r + s)) ** 2)
        total += float(np.sum(weight * dt * p * kernel * a * np.cos(t)))
    return 4 / (np.pi * E_STAR) * total


# --- checks ---


def _off_textbook(indenter: mdr.Indenter, shape: str, depths: Array) -> float:
    """Greatest relative difference of contact radius, force, stiffness and pressure from those of the shape."""
    r = RADIUS * np.array([0.01, 0.2, 0.5, 0.8, 0.99])
    got = (indenter.contact_radius(depths), indenter.force(depths, E_STAR), indenter.stiffness(depths, E_STAR))
    pairs = [*zip(got, textbook(shape, depths), strict=True)]
    pairs.append((indenter.pressure(r, DEPTH, E_STAR), textbook_pressure(shape, r, DEPTH)))
    return max(float(np.max(np.abs(one / other - 1))) for one, other in pairs)


def _shape_checks(sunk: dict[str, Array]) -> Checks:
    """Set the shapes beside the textbook, and put them and the whole catalogue on the half-space."""
    for shape, indenter in SHAPES.items():
        off = _off_textbook(indenter, shape, DEPTH * np.array([1e-6, 1e-3, 0.1, 1.0, 2.0]))
        why = "closed forms on both sides: rounding, a hundred times larger next to the rim"
        yield Check.at_most(f"{shape}: a, F_N, k_zc, p against the textbook", off, ROUNDING, why)
        yield from _half_space_checks(shape, indenter, DEPTH, _sunk(indenter, DEPTH))
    for shape, indenter in CATALOGUE.items():
        yield from _half_space_checks(shape, indenter, depth_of(indenter), sunk[shape])


def _half_space_checks(shape: str, indenter: mdr.Indenter, d: float, sunk: Array) -> Checks:
    disc = _disc(indenter, d) - 1
    off = float(np.max(np.abs(sunk - d + np.asarray(indenter.profile_3d(PLACES))))) / d
    pull = float(np.min(np.asarray(indenter.pressure(RADIUS * np.linspace(0.001, 0.999, 99), d, E_STAR))))
    rough = shape.startswith("force")
    why = "Gauss quadrature of 200 nodes, smooth after r = a sin t with t graded towards tip and corners"
    why += "; the pressure of a force curve is promised to 2e-7" if rough else ""
    yield Check.at_most(f"{shape}: integral of p over the disc against F_N", abs(disc), 1e-6 if rough else 1e-10, why)
    name = f"{shape}: half-space under p takes the shape d - f(r), over d"
    why = "quadrature over a logarithm: halving its nodes changes the sum by less"
    yield Check.at_most(name, off, 1e-6 if rough else 1e-7, why)
    yield Check.at_least(f"{shape}: least p inside the contact [Pa]", pull, 0, "a contact without adhesion never pulls")


def _sunk(indenter: mdr.Indenter, d: float) -> Array:
    """Displacement [m] of the half-space at PLACES within the contact."""
    return np.array([sunk_surface(indenter, r, d) for r in PLACES])


def _disc(indenter: mdr.Indenter, d: float) -> float:
    """2 pi int p r dr over F_N, with r = a sin t and t graded towards tip and corners."""
    u, weight = np.polynomial.legendre.leggauss(200)
    u, weight = 0.5 * (u + 1), 0.5 * weight
    a, total = float(indenter.contact_radius(d)), 0.0
    for low, high in pairwise(np.arcsin(np.array([0.0, *(b for b in indenter.kinks if b < a), a]) / a)):
        way, share, rate = high - low, u**3, 3 * u**2  # to the rim, where p r dr is smooth in t
        if high < np.pi / 2:
            share, rate = u**3 * (10 - 15 * u + 6 * u**2), 30 * u**2 * (1 - u) ** 2
        t, dt = low + way * share, way * rate
        p = np.asarray(indenter.pressure(a * np.sin(t), d, E_STAR))
        total += 2 * np.pi * a**2 * float(np.sum(weight * dt * p * np.sin(t) * np.cos(t)))
    return total / float(indenter.force(d, E_STAR))


def _profile_checks() -> Checks:
    """Give each curved shape as a mere function f(r): the library then maps it by quadrature."""
    for shape in ("cone", "paraboloid", "r^4"):
        mapped = mdr.Profile(SHAPES[shape].profile_3d)
        off = _off_textbook(mapped, shape, DEPTH * np.array([1e-3, 0.1, 1.0, 2.0]))
        why = "what Profile promises for a smooth f(r): its own estimate warns above 1e-9"
        yield Check.at_most(f"{shape} as a function f(r): a, F_N, k_zc, p against the textbook", off, 1e-9, why)


def _sum_checks(amplitudes: tuple[float, ...]) -> Checks:
    for shape in SHAPES:
        force, stiffness = [], []
        for alpha, n_springs in product(amplitudes, (16, 100, 384)):
            springs = mdr.SpringArray.of(contact(shape, alpha), n_springs)
            for u_z in (DEPTH - alpha * DEPTH, DEPTH + alpha * DEPTH):
                _, F_N, k_zc = textbook(shape, max(u_z, 0.0))
                force.append(abs(springs.normal_force(u_z, DEPTH) - F_N) / (2 * E_STAR * RADIUS * DEPTH))
                k_zc = k_zc if u_z > 0 else 0.0
                stiffness.append(abs(springs.normal_stiffness(u_z, DEPTH) - k_zc) / (2 * E_STAR * RADIUS))
        for what, off, scale in (("F_N", force, "2 E* a u_z0"), ("k_zc", stiffness, "2 E* a")):
            name = f"{shape}: {what} of 16, 100 and 384 springs at u_z0 ± Δu_z, over {scale}"
            yield Check.at_most(name, max(off), ROUNDING, ENDS)


def _catalogue_sum_checks() -> Checks:
    """Springs of every shape of the catalogue that can lose contact at its edge."""
    for shape, indenter in CATALOGUE.items():
        if isinstance(indenter, shapes.ConcavePunch):  # never leaves in complete contact: F_N is linear in the depth
            continue
        u_z0 = depth_of(indenter) / 1.3 * (1 - 1e-9)
        motion = mdr.NormalOscillation(u_z0=u_z0, du_z=0.3 * u_z0, omega=OMEGA)
        case = mdr.SlidingContact(indenter, mdr.Elastic(E=E, nu=0.5), 0.5, motion)
        springs, a = mdr.SpringArray.of(case, 100), float(indenter.contact_radius(u_z0))
        depths = (0.7 * u_z0, 1.3 * u_z0)
        off = max(abs(springs.normal_force(u_z, u_z0) - float(indenter.force(u_z, E_STAR))) for u_z in depths)
        name = f"{shape}: F_N of 100 springs at u_z0 ± 0.3 u_z0, over 2 E* a u_z0"
        yield Check.at_most(name, off / (2 * E_STAR * a * u_z0), ROUNDING, ENDS)


def _errors(shape: str, alpha: float, counts: tuple[int, ...]) -> tuple[Array, Array]:
    """Greatest error of the array's force over the oscillation, and what its widest cell allows, (n_counts,)."""
    case = contact(shape, alpha)
    u_z = DEPTH * (1 + alpha * np.linspace(-1, 1, 8001))
    F_N = textbook(shape, u_z)[1]
    errors, bounds = [], []
    for n_springs in counts:
        springs = mdr.SpringArray.of(case, n_springs)
        F_z = np.sum(springs.dk_z * np.maximum(u_z[:, None] - DEPTH - springs.gap, 0), axis=1)
        errors.append(np.max(np.abs(F_z - F_N)))
        bounds.append(widest_cell(case, springs))
    scale = 2 * E_STAR * RADIUS * DEPTH
    return np.array(errors) / scale, np.array(bounds) / scale


def _order_checks(orders: dict[str, tuple[Array, Array]], counts: tuple[int, ...]) -> Checks:
    for shape, (errors, bounds) in orders.items():
        order = -power(counts, errors)
        why = "slope of a least-squares line; panels share out whole springs, which bends it by a few hundredths"
        yield Check(f"{shape}: order in the number of springs of F_N(u_z) between the extremes", order, 2.0, 0.1, why)
        name = f"{shape}: greatest error of F_N over that of its widest cell, {counts[-1]} springs"
        why = "a cell of stiffness dk over which g rises by dg errs by dk dg/8 at most, when half of it touches"
        yield Check.at_most(name, errors[-1] / bounds[-1], 1.0, why)


# --- figures ---


@figure("shapes", 1, 2, size=(8.2, 3.9))
def _pressure_figure(fig, axes):
    """Pressure over radius and normal force over depth for flat punch, cone, paraboloid and r^4, lines on textbook
    circles.

    The four test shapes on rubber of E = 3 MPa. Lines: the library; circles: the textbook, Boussinesq for the flat
    punch, Hertz for the paraboloid, Sneddon for cone and r^4. Their pressures differ as widely as pressures can,
    infinite at the rim of the punch and at the tip of the cone, yet all touch over the same disc at 20 µm and are
    equally stiff there.
    """
    left, right = axes
    r, few = np.linspace(0.002, 0.998, 400), np.linspace(0.05, 0.95, 13)
    d, some = DEPTH * np.geomspace(0.05, 2, 100), DEPTH * np.geomspace(0.06, 1.9, 9)
    for (shape, indenter), colour in zip(SHAPES.items(), COLOURS, strict=False):
        mean = float(indenter.force(DEPTH, E_STAR)) / (np.pi * RADIUS**2)
        p = np.asarray(indenter.pressure(r * RADIUS, DEPTH, E_STAR))
        left.plot(r, p / mean, color=colour, label=shape_label(shape))
        circles(left, few, textbook_pressure(shape, few * RADIUS, DEPTH) / mean, colour)
        right.loglog(d * 1e6, np.asarray(indenter.force(d, E_STAR)), color=colour)
        circles(right, some * 1e6, textbook(shape, some)[1], colour)
    panel(left, "radius $r/a$", "pressure over its mean", "pressure at 20 µm", ylim=(0, 3.2), xlim=(0, 1.02))
    panel(right, "depth $d$ [µm]", "normal force $F_N$ [N]", "force")
    circles(left, [], [], "0.3", label="textbook")
    below(fig, left, 5)


TALLEST = 3.2  #: pressure over its mean up to which it is drawn


@figure("catalogue", 3, 4, size=(9.6, 8.0), sharex=True, sharey=True)
def _catalogue_figure(fig, axes, sunk: dict[str, Array]):
    """Twelve small panels, one a shape, with the pressure above and the shape with circles on it below.

    Every other shape of the library, pressed until it touches over a disc of radius a. Above the line the pressure that
    follows from its one-dimensional image; below it the indenter and, as circles, where that pressure puts the surface
    of an elastic half-space: they meet the indenter in each case.
    """
    r = np.linspace(0.0, 1.0, 201)
    for ax, (shape, indenter) in zip(axes.flat, CATALOGUE.items(), strict=True):
        d = depth_of(indenter)
        a = float(indenter.contact_radius(d))
        f = np.asarray(indenter.profile_3d(r * a)) / d
        p = np.asarray(indenter.pressure(np.minimum(r, 0.9995) * a, d, E_STAR))
        mean = float(indenter.force(d, E_STAR)) / (np.pi * a**2)
        ax.fill_between(r, f - 1, 0, color="0.88", lw=0)
        ax.plot(r, f - 1, color="0.3", lw=1.2)
        circles(ax, PLACES / RADIUS, -sunk[shape] / d, COLOURS[1], clip_on=False)
        shown = p / mean < TALLEST
        ax.plot(r, np.where(shown, p / mean, np.nan), color=COLOURS[0])
        for peak in r[1:-1][~shown[1:-1] & (p[1:-1] >= p[:-2]) & (p[1:-1] >= p[2:])]:
            ax.plot(peak, TALLEST, "^", color=COLOURS[0], ms=6)
        ax.axhline(0.0, color="0.4", lw=0.8)
        ax.set_title(shape_label(shape), fontsize="medium")
    outer_labels(axes, "$r/a$", "")
    left = axes[0, 0]
    left.set(xlim=(0, 1.05), ylim=(-1.5, TALLEST + 0.3), yticks=[-1, 0, 1, 2, 3])
    left.set_xticks([0, 0.5, 1], ["0", "0.5", "1"])
    left.plot([], [], color=COLOURS[0], label="pressure over its mean")
    left.plot([], [], "^", color=COLOURS[0], ms=6, label="infinite")
    left.plot([], [], color="0.3", lw=1.2, label="indenter, depth over $d$")
    circles(left, [], [], COLOURS[1], label="half-space under that pressure")
    below(fig, left, 4)


@figure("springs")
def _error_figure(fig, ax, orders: dict[str, tuple[Array, Array]], counts: tuple[int, ...]):
    """Error of the normal force against the number of springs, with a line of second order and points at rounding.

    Force of the spring array at Δu_z/u_z0 = 0.3. Hollow: the greatest error in between falls by four when the springs
    are doubled. Full: at the mean depth and at both extremes the sum is exact to rounding with any number of springs.
    """
    for (shape, (errors, _)), colour, marker in zip(orders.items(), COLOURS[1:], "osD", strict=False):
        label = f"{shape_label(shape)}, between the extremes"
        ax.loglog(counts, errors, marker, color=colour, ms=6, mfc="white", label=label)
        at_ends = [_at_ends(shape, n) for n in counts]
        ax.loglog(counts, np.maximum(at_ends, 1e-17), marker, color=colour, ms=4)
    n = np.array([counts[0], counts[-1]], dtype=float)
    ax.loglog(n, 1.6 * orders["cone"][0][0] * (n[0] / n) ** 2, color="0.4", lw=1, ls="--", label="second order")
    ax.plot([], [], "o", color="0.3", ms=4, label="at $u_{z0}$ and $u_{z0}\\pm\\Delta u_z$")
    ax.set(xlabel="number of springs", ylabel=r"error of $F_N$ over $2E^{*}a\,u_{z0}$", ylim=(1e-17, 1e-2))
    ticks(ax.xaxis, *counts)
    ax.legend(loc="center right", bbox_to_anchor=(1.0, 0.4))


def _at_ends(shape: str, n_springs: int) -> float:
    springs = mdr.SpringArray.of(contact(shape, 0.3), n_springs)
    depths = [DEPTH * (1 + share) for share in (-0.3, 0.0, 0.3)]
    off = [abs(springs.normal_force(u_z, DEPTH) - textbook(shape, u_z)[1]) for u_z in depths]
    return float(max(off)) / (2 * E_STAR * RADIUS * DEPTH)
