"""Every shape of the handbook, and materials with arms.

The four shapes of shapes.py are powers, g ~ x^n, whose stiffness goes as d^(1/n) at any depth. What counts at small
amplitude is only how the stiffness changes about the mean depth, s = d ln k_zc/d ln d in the place of 1/n
(`mdr.laws.stiffness_exponent`): the deviation of v_c from Eq. (15) is C alpha s with the same C for every shape. A flat
punch, hollow or not, has s = 0, a worn tip little, a capped one that of its cap or of its flank. For a material with
arms C is another number, but still the same for all shapes.

Symbols: alpha = du_z/u_z0, T = omega tau.
"""

from functools import cache
from itertools import product

import numpy as np

import mdr
from mdr import laws
from mdr.tools.progress import progress
from validation.cases import BODY, CATALOGUE, OMEGA, SHAPES, E, any_contact, depth_of, shape_label
from validation.figures import figure
from validation.measured import TOLERANCE, Point, measured, slope_at_zero
from validation.report import Check, Checks, Equation, Part, told
from validation.words import counted

NU = 0.5
ALL: dict[str, mdr.Indenter] = {**SHAPES, **CATALOGUE}
SHARE = 0.6  # of the depth at which the disc of 1 mm is touched: no shape ends there, none is at a corner
MATERIALS: dict[str, mdr.Material] = {
    "elastic": mdr.Elastic(E, NU),
    "ωτ = 1": mdr.KelvinVoigt(E, NU, 1 / OMEGA),
    "standard solid": mdr.StandardLinearSolid(E, 0.5 * E, 0.7 / OMEGA, NU),
}


def contact(shape: str, material: str, alpha: float, pulled: bool) -> mdr.SlidingContact:
    """A shape of the catalogue at its own depth, pulled rigidly or by a body of the same groups."""
    depth = mean_depth(shape)
    motion = mdr.NormalOscillation(depth, alpha * depth, OMEGA)
    return any_contact(ALL[shape], MATERIALS[material], motion, BODY if pulled else None, depth)


def mean_depth(shape: str) -> float:
    """Mean depth u_z0 [m]; a hollow face needs all of it to press through the period."""
    indenter = ALL[shape]
    if indenter.least_depth > 0:
        return 3 * indenter.least_depth
    return SHARE * (depth_of(indenter) if shape in CATALOGUE else 20e-6)


def slope(shape: str) -> float:
    """d ln k_zc/d ln d at the mean depth."""
    return laws.stiffness_exponent(ALL[shape], mean_depth(shape))


_EQUATION = Equation(
    "",
    r"\frac{v_c}{v_c^{(15)}} - 1 \to C \alpha s, \quad s = \frac{d \ln k_{z,c}}{d \ln d}",
    "As α → 0; C knows the material and the body, s the shape (<code>mdr.laws.first_order</code>,"
    " <code>stiffness_exponent</code>).",
)


def part(effort: str) -> Part:
    """Shape: all of the handbook

    How: Every shape: measured, and by the first order of its deviation.

    Range: {n_shapes} shapes: {shapes}; each at a depth within its range; {velocities} at α = 0.1 ({pulls}); and the
    full-slip value under a body at α → 0: elastic{and_kelvin} for all shapes, standard solid for {some}.

    Measured: {rigid}Body: what a shape does to v_c at small amplitude is one number, the exponent s with which its
    stiffness changes about the mean depth. The deviation from Eq. (15) is C α s, with one C for all shapes, closed
    forms, sampled points and measured forces alike; a flat or hollow punch has none. For a standard solid C is another
    number, again the same for {those}.

    Sentence: At small amplitude the error of Eq. (15) is C α s for every shape, s = d ln k_zc/d ln d; C does not know
    the shape.
    """
    quick = effort == "quick"
    points = [_measured(*which) for which in progress(_grid(quick), "catalogue")]
    n_shapes = len(ALL)
    shapes = ", ".join(ALL)
    velocities = counted(len(points), "measured velocity")
    pulls = "body" if quick else "rigid pull and body"
    and_kelvin = "" if quick else " and Kelvin (ωτ = 1)"
    some = "three" if quick else "the curved ones"
    rigid = "" if quick else "Rigid pull: Eq. (1) for every shape. "
    those = "the three shapes computed" if quick else "all curved shapes"
    return Part(
        **told(part, locals()),
        checks=(*_measured_checks(points), *_order_checks(quick)),
        figures=(_figure(quick),),
        equations=(_EQUATION,),
    )


# --- measured ---


def _grid(quick: bool) -> list[tuple[str, str, bool]]:
    """shape, material, body."""
    if quick:
        return [("capped cone", "elastic", True)]
    rigid = [(shape, "ωτ = 1", False) for shape in CATALOGUE]
    return [*rigid, *((shape, "elastic", True) for shape in CATALOGUE)]


def _measured_checks(points: list[Point]) -> Checks:
    """Against Eq. (1) under a rigid pull, else against the full-slip value."""
    why = "bracket of the measurement and second order in its step"
    for p in points:
        rigid = isinstance(p.case.pull, mdr.RigidPull)
        name = f"{p.where}: measured v_c over {'Eq. (1)' if rigid else 'the full-slip value'}"
        yield Check(name, p.over_rigid if rigid else 1 + p.miss, 1.0, TOLERANCE, why)


@cache
def _measured(shape: str, material: str, pulled: bool) -> Point:
    where = f"{shape}, {material}, {'body' if pulled else 'rigid pull'}"
    return measured(contact(shape, material, 0.1, pulled), where)


# --- first order in the amplitude ---


@cache
def limit(shape: str, material: str, alpha: float) -> float:
    """Deviation of the full-slip value from Eq. (15) over alpha, for alpha -> 0: the next power taken out."""
    return slope_at_zero(*(contact(shape, material, share * alpha, True) for share in (1, 2)))


def _order_checks(quick: bool) -> Checks:
    for material, shape in product(("elastic",) if quick else ("elastic", "ωτ = 1"), ALL):
        expected = laws.first_order(contact(shape, material, 0.1, True)) * slope(shape)
        why = "1e-10 of the full-slip value over α = 1e-3, the third power of α, and the slope to 1e-8"
        name = f"{shape}, {material}: deviation/α for α → 0 against C d ln k_zc/d ln d"
        yield Check(name, limit(shape, material, 1e-3), expected, 1e-4 * abs(expected) + 1e-6, why)
    shapes = ("cone", "capped cone") if quick else [s for s in ALL if slope(s) > 0.02]
    first = limit("paraboloid", "standard solid", 0.01) / slope("paraboloid")
    for shape in shapes:
        name = f"{shape}, standard solid: C of its deviation over that of the paraboloid"
        ratio = limit(shape, "standard solid", 0.01) / slope(shape) / first
        why = "the third power of α = 0.01, with factors of some units; more where the stiffness changes within it"
        yield Check(name, ratio, 1.0, 0.02, why)


# --- figure ---


@figure("slopes", size=(8.4, 4.4))
def _figure(fig, ax, quick: bool):
    """Points of all shapes on a straight line through zero, one line for each material.

    {n} shapes under the same body{kind}: how fast v_c leaves Eq. (15) with amplitude, over the exponent with which the
    stiffness of the contact changes about its mean depth. {they} lie on one straight line through zero: at small
    amplitude v_c depends on the shape through this exponent alone.
    """
    slopes = np.array([slope(shape) for shape in ALL])
    for material, colour in zip(list(MATERIALS)[: 1 if quick else 3], ("C0", "C1", "C2"), strict=False):
        alpha = 0.01 if material == "standard solid" else 1e-3
        C = np.array([limit(shape, material, alpha) for shape in ALL])
        ax.plot([0, 1], [0, C[list(ALL).index("cone")]], color=colour, lw=1)
        ax.plot(slopes, C, "o", ms=5, mfc="white", color=colour, label=material)
    ax.set(xlabel=r"$s = d\ln k_{zc}/d\ln d$ at the mean depth", ylabel=r"(full-slip $v_c$ over Eq. (15) $-1)/\alpha$")
    ax.legend(loc="lower left")
    rows = [f"{abs(slope(shape)):.2f}  {shape_label(shape)}" for shape in sorted(ALL, key=slope)]
    ax.text(1.04, 1.0, "\n".join(["$s$       shape", *rows]), transform=ax.transAxes, va="top", fontsize=8)
    return {
        "n": len(ALL),
        "kind": ", elastic" if quick else "",
        "they": "They" if quick else "All shapes of one material",
    }
