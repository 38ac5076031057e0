"""Any linear rheology: Eq. (15) with the dynamic stiffness of the material in the place of k + i gamma omega.

The paper takes one spring and dashpot and names more general rheology as the next step. In full slip the argument does
not ask what the operator L of the material is: dk_x L[e] = mu_0 dk_z L[s] for every spring makes e = mu_0 kappa s, so
all springs slip alike, the force on the body is mu_0 F_N, and with the receptance H of the pull

    v_c = mu_0 omega du_z |kappa + K_z(omega) H(omega)|,    K_z(omega) = 2 a E*(omega),

for a constant Poisson's ratio and as long as F_N has a single harmonic: a flat punch that keeps contact at any
amplitude, every other shape in the limit of small amplitude. With H = 0 the material drops out: Eq. (1).

Below v_c the material shows. An arm that relaxes within a period carries part of the load that oscillates and none of
the mean, so it lowers the COF; what its dashpot adds is greatest where omega tau_1 is about one.

Symbols: E_inf, E_1, tau_1 long-time modulus, modulus and relaxation time of the arm of a standard solid, T = omega tau
of the Kelvin branch, alpha = du_z/u_z0, v_hat = v_0 over Eq. (1).
"""

from dataclasses import replace
from functools import cache
from itertools import product
from typing import Any

import numpy as np

import mdr
from mdr.closed_forms import paper
from mdr.tools.progress import progress
from validation.cases import BODY, DEPTH, OMEGA, SHAPES, E, any_contact, shape_label
from validation.figures import figure
from validation.measured import TOLERANCE, Point, deviation, lost, measured
from validation.report import Check, Checks, Equation, Part, told
from validation.words import counted, listed

NU = 0.5
RATIO = 3.0  # E_1/E_inf of the standard solid
ARMS = ((0.7 * E, 0.03 / OMEGA), (1.3 * E, 1 / OMEGA), (0.4 * E, 30 / OMEGA))
MATERIALS: dict[str, mdr.Material] = {
    "standard solid, ωτ_1 = 0.5": mdr.StandardLinearSolid(E, RATIO * E, 0.5 / OMEGA, NU),
    "standard solid, ωτ_1 = 5": mdr.StandardLinearSolid(E, RATIO * E, 5 / OMEGA, NU),
    "three arms and a dashpot": mdr.Prony(E, ARMS, NU, 0.1 / OMEGA),
    "power law ω^0.3": mdr.Prony.power_law(modulus=E, exponent=0.3, omega=(OMEGA / 30, 30 * OMEGA), nu=NU, error=1e-2),
}
SEED = 20


def contact(shape: str, material: mdr.Material, alpha: float, groups: Any = None) -> mdr.SlidingContact:
    """A shape on a material, pulled rigidly or by a body whose groups refer to the long-time stiffness."""
    return any_contact(SHAPES[shape], material, mdr.NormalOscillation(DEPTH, alpha * DEPTH, OMEGA), groups)


_EQUATION = Equation(
    "",
    r"v_c = \mu_0 \omega \Delta u_z \left| \kappa + K_z(\omega) H(\omega) \right|, \quad K_z = 2 a E^*(\omega), \quad"
    r" E^*(\omega) = E^*_{\infty} (1 + i\omega\tau) + \sum_j E^*_j \frac{i\omega\tau_j}{1 + i\omega\tau_j}",
    "Any linear material with one Poisson’s ratio; for a Kelvin material this is Eq. (15).",
)


def part(effort: str) -> Part:
    """Rheology: any linear material

    How: The closed form against runs: random materials, chosen ones measured, the motion in full slip.

    Quote: In the future, the critical velocity could also be considered for materials with more general rheology. The
    Method of Dimensionality Reduction provides a natural theoretical framework for this … — Section 3

    Range: {n} random Prony materials of one to four arms (ωτ_j from 0.01 to 100, moduli up to ten times E_inf, with and
    without a dashpot) under random bodies; {materials} ({names}), measured for {shape_names} at 1 % amplitude.

    Measured: With K_z(ω) = 2aE*(ω) in the place of stiffness and damping, the formula is as exact as Eq. (15) is for a
    Kelvin material: at any amplitude for a flat punch that keeps contact, and for other shapes as the limit of small
    amplitude. Under a rigid pull the rheology drops out. Below v_c it does not: an arm that relaxes within a period
    stiffens the contact against the oscillation but not against the mean load, so that the static COF falls, and most
    at frequencies where the arm still follows, ωτ_1 above one.

    Sentence: Any linear rheology with constant Poisson's ratio obeys v_c = μ_0 ω Δu_z |κ + K_z(ω) H(ω)|, which is Eq.
    (15) for a Kelvin material.
    """
    quick = effort == "quick"
    n = 6 if quick else 50
    chosen = dict(list(MATERIALS.items())[1:2]) if quick else MATERIALS
    shapes = ("flat punch",) if quick else ("flat punch", "cone", "paraboloid")
    sides = [_sides(index) for index in progress(range(n), "rheology")]
    pairs = [(shape, name) for shape in shapes for name in chosen if shape == "flat punch" or "power" not in name]
    points = [_measured(*pair) for pair in progress(pairs, "rheology, measured")]
    checks = [*_side_checks(sides), *_measured_checks(points), *_motion_checks(chosen), *_limit_checks()]
    materials = counted(len(chosen), "chosen material")
    names = "; ".join(chosen)
    shape_names = listed(shapes)
    return Part(
        **told(part, locals()),
        checks=(*checks, *(() if quick else _amplitude_checks())),
        figures=(_figure_of_velocities(quick), *(() if quick else (_figure_of_curves(),))),
        equations=(_EQUATION,),
    )


# --- stick on one side of v_c, none on the other ---


@cache
def _sides(index: int) -> list[mdr.SlidingRun]:
    """Runs a little below and above the formula, on a random material."""
    rng = np.random.default_rng((SEED, index))
    n_arms = int(rng.integers(1, 5))
    arms = tuple((E * 10 ** rng.uniform(-1, 1), 10 ** rng.uniform(-2, 2) / OMEGA) for _ in range(n_arms))
    T = 10 ** rng.uniform(-1, 0.5) if rng.uniform() < 0.4 else 0.0
    material = mdr.Prony(E, arms, NU, T / OMEGA)
    groups = {"k_ratio": 10 ** rng.uniform(-0.5, 1), "omega_0_ratio": rng.uniform(0.3, 3), "damping_ratio": 0.1}
    alpha = 0.5 * E / (abs(complex(material.dynamic_modulus(OMEGA))) * (1 - NU**2))  # half of what would lose contact
    case = contact("flat punch", material, alpha, groups if index % 5 else None)
    v_c = mdr.critical_velocity(case)
    return [mdr.slide(case, share * v_c, n_springs=32, steps_per_period=1024) for share in (0.98, 1.02)]


def _side_checks(sides: list[list[mdr.SlidingRun]]) -> Checks:
    why = "at 0.98 v_c a few per cent of the period still stick; above v_c slip never stops"
    settled = sum(below.settled and above.settled for below, above in sides)
    least, most = min(below.stick_share for below, _ in sides), max(above.stick_share for _, above in sides)
    slip = min(above.least_slip / above.v_0 for _, above in sides)
    full = max(abs(1 - above.cof / above.mu_0) for _, above in sides)
    yield Check("random materials whose runs settle", settled, len(sides), 0, "all of them")
    yield Check.at_least(f"least stick share at 0.98 v_c, {len(sides)} random materials", least, 0.005, why)
    why += ", but for an instant by rounding"
    yield Check.at_most(f"greatest stick share at 1.02 v_c, {len(sides)} random materials", most, 1e-12, why)
    yield Check.at_least("least slip velocity at 1.02 v_c, over v_0", slip, 0.01, "v_0 − v_c is 0.0196 v_0")
    yield Check("greatest 1 − COF/μ_0 at 1.02 v_c", full, 0.0, 1e-11, "full slip but for rounding")


# --- measured from runs alone ---


def _measured_checks(points: list[Point]) -> Checks:
    """Against the full-slip value, and for the punch against the closed form, which is exact for it."""
    why = "bracket of the measurement and second order in its step"
    for p in points:
        yield Check(f"measured v_c over the full-slip value: {p.where}", 1 + p.miss, 1.0, TOLERANCE, why)
        if isinstance(p.case.indenter, mdr.FlatPunch):
            name = f"measured v_c over the closed form: {p.where}"
            yield Check(name, 1 + p.deviation, 1.0, TOLERANCE, why)


@cache
def _measured(shape: str, name: str) -> Point:
    return measured(contact(shape, MATERIALS[name], 0.01, BODY), f"{shape}, {name}")


# --- motion in full slip ---


def _motion_checks(chosen: dict[str, mdr.Material]) -> Checks:
    """The marched motion of the body, and its force, against the harmonic that they must be."""
    for name, material in chosen.items():
        case = contact("flat punch", material, 0.05, BODY)
        run = mdr.slide(case, 3 * mdr.critical_velocity(case), steps_per_period=1024, record=1)
        turn = np.exp(1j * OMEGA * run.t)
        F_1 = complex(case.dynamic_stiffness(OMEGA)) * case.cycle.du_z
        y_1 = -case.mu_0 * F_1 * complex(case.pull.receptance(OMEGA))
        y_0 = -case.mu_0 * case.k_zc * DEPTH / complex(case.pull.receptance(0.0) ** -1)
        off_x = np.abs(run.u_x - run.v_0 * run.t - (y_0 + y_1 * turn).real).max() / abs(y_1)
        off_z = np.abs(run.F_z - case.k_zc * DEPTH - (F_1 * turn).real).max() / abs(F_1)
        why = "second order of 1024 steps, h² = 4e-5, of which the harmonic of the recursion keeps a fraction"
        yield Check(f"body in full slip off −μ_0 H F_N, over its swing: {name}", off_x, 0.0, 2e-5, why)
        yield Check(f"normal force off K_z(ω) Δu_z, over its swing: {name}", off_z, 0.0, 2e-5, why)


# --- limits ---


def _limit_checks() -> Checks:
    """Fast and slow arms are dashpots and springs."""
    T, v_hat = 0.7, 0.4
    kelvin = mdr.KelvinVoigt(E, NU, T / OMEGA)
    fast = mdr.StandardLinearSolid(E, E * T / 1e-4, 1e-4 / OMEGA, NU)
    slow = mdr.StandardLinearSolid(E, RATIO * E, 1e5 / OMEGA, NU)
    cases = contact("paraboloid", fast, 0.2), contact("paraboloid", kelvin, 0.2), contact("flat punch", slow, 0.1)
    one, two, deficit = (lost(case, v_hat * case.unit_velocity) for case in cases)
    name = "COF deficit of an arm with ωτ_1 = 1e-4 over that of the dashpot it tends to"
    yield Check(name, one / two, 1.0, 1e-3, "what the force of the arm lags, 1e-4, and the error of the runs")
    name = "COF deficit of a punch with a slow arm over α (1 + E_1/E_inf) ψ(v_hat)"
    got = deficit / (0.1 * (1 + RATIO) * paper.deficit(v_hat))
    yield Check(name, got, 1.0, 2e-4, "1e-5 of the arm relaxes in a period")


def _amplitude_checks() -> Checks:
    """With small amplitude the closed form is approached in proportion to it, as for a Kelvin material."""
    for name, shape in product(("standard solid, ωτ_1 = 0.5", "three arms and a dashpot"), ("cone", "paraboloid")):
        one, two = (deviation(contact(shape, MATERIALS[name], alpha, BODY)) for alpha in (0.005, 0.01))
        why = "the next power of α, 1 %, with a factor of some units"
        got = np.log2(two / one)
        yield Check(f"power of α in full slip over closed form − 1: {shape}, {name}", got, 1.0, 0.06, why)


# --- figures ---


@figure("curves", 1, 2, size=(8.6, 3.7), sharey=True)
def _figure_of_curves(fig, axes):
    """Two panels of COF curves, one for each relaxation time, that meet at velocity one.

    COF of a standard solid (E_1 = 3 E_inf, Δu_z/u_z0 = 0.15) under a rigid pull, for relaxation times from a tenth of
    1/ω to a hundred times it. All curves end at Eq. (1), whatever the rheology. Slow arms (bright) never relax within
    the period and multiply what the oscillation takes from friction: for the punch they end on the dotted curve, four
    times the elastic deficit; a fast arm (dark) is nearly the long-time body, dashed.
    """
    from matplotlib import colormaps

    times = (0.1, 0.5, 2.0, 10.0, 100.0)
    v_hat = np.array([0.02, 0.06, 0.12, 0.2, 0.3, 0.42, 0.55, 0.7, 0.85, 0.95, 1.05])
    for ax, shape in zip(axes, ("flat punch", "paraboloid"), strict=True):
        for colour, time in zip(colormaps["viridis"](np.linspace(0, 0.9, len(times))), times, strict=True):
            case = contact(shape, mdr.StandardLinearSolid(E, RATIO * E, time / OMEGA, NU), 0.15)
            cof = [mdr.slide(case, v * case.unit_velocity, n_springs=96, steps_per_period=512).cof for v in v_hat]
            curve = np.array([mdr.static_cof(case), *cof]) / case.mu_0
            ax.plot([0, *v_hat], curve, "-o", ms=3, color=colour, label=rf"$\omega\tau_1={time:g}$")
        case = contact(shape, mdr.Elastic(E, NU), 0.15)
        known = mdr.cof_curve(case, np.linspace(0, 1.05, 60) * case.unit_velocity)
        v, cof = known.v_0 / case.unit_velocity, known.cof / case.mu_0
        ax.plot(v, cof, "--", color="0.4", lw=1, label="$E_\\infty$ alone")
        if shape == "flat punch":  # stiff against the oscillation, soft under the mean load
            ax.plot(v, 1 - (1 + RATIO) * (1 - cof), ":", color="0.4", lw=1, label="glassy")
        ax.set(xlabel=r"$v_0/(\mu_0\kappa\omega\Delta u_z)$", title=shape_label(shape))
    axes[0].set_ylabel(r"$\mu/\mu_0$")
    axes[0].legend(loc="lower right")


@figure("velocities", 1, 2, size=(8.6, 3.6))
def _figure_of_velocities(fig, axes, quick: bool):
    """Two panels of critical velocity over relaxation time, with curves of a standard solid and a Kelvin body.

    Critical velocity of a punch under a body on a standard solid, over the relaxation time of its arm: from that of the
    long-time modulus (dashed) to that of the glassy one (dotted). The Kelvin body of the paper with the same loss at
    low frequency (chain line) has no such end and rises without bound.
    """
    times = np.geomspace(1e-2, 1e2, 121)
    solid: list[Any] = [mdr.StandardLinearSolid(E, RATIO * E, t / OMEGA, NU) for t in times]
    kelvin: list[Any] = [mdr.KelvinVoigt(E, NU, RATIO * t / OMEGA) for t in times]
    bodies = (("$\\omega_0=1.7\\,\\omega$", BODY), ("$\\omega_0=0.6\\,\\omega$", BODY | {"omega_0_ratio": 0.6}))
    for ax, (title, groups) in zip(axes, bodies, strict=True):
        for materials, look, label in (
            (solid, {"color": "C0"}, "standard solid"),
            (kelvin, {"color": "0.15", "ls": "-."}, "Kelvin, same first loss"),
        ):
            cases = [contact("flat punch", material, 0.01, groups) for material in materials]
            ax.semilogx(times, [mdr.critical_velocity(c) / c.unit_velocity for c in cases], label=label, **look)
        for stiffer, ls, label in ((1, "--", "$E_\\infty$ alone"), (1 + RATIO, ":", "glassy")):
            soft = contact("flat punch", mdr.Elastic(E, NU), 0.01, groups)
            case = replace(soft, material=mdr.Elastic(stiffer * E, NU))
            ax.axhline(mdr.critical_velocity(case) / case.unit_velocity, color="0.4", ls=ls, lw=1, label=label)
        for time, label in ((0.5, "measured from runs"), (5, None)) if groups is BODY and not quick else ():
            found = _measured("flat punch", f"standard solid, ωτ_1 = {time:g}")
            ax.plot(time, found.over_rigid, "o", color="C0", mfc="white", label=label)
        ax.set(xlabel=r"$\omega\tau_1$", title=title, ylim=(0, min(ax.get_ylim()[1], 6)))
    axes[0].set_ylabel(r"$v_c/(\mu_0\kappa\omega\Delta u_z)$")
    axes[0].legend(loc="upper left")
