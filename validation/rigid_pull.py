"""Rigid pull: v_c is Eq. (1) for any shape, amplitude and relaxation time, as long as the contact is there in time.

In full slip every spring in contact slips at v_0 - v_1 (-sin phi), v_1 = mu_0 kappa omega du_z of Eq. (1), so v_c = v_1
if any spring touches at phi = -pi/2, where the depth grows fastest. The centre touches longest. A Kelvin spring leaves
at phi_r, u_z + tau u_z' = 0, still compressed; it relaxes like exp(-(phi - phi_r)/T) and touches again at phi_c, where
the indenter meets the relaxed surface. So v_c/v_1 = 1 if phi_c comes before -pi/2, and sin|phi_c| after. With
u_z0 > 0 the limit phi_c = -pi/2 is

    alpha_1(T) = min over pi < theta < 2 pi of [exp(theta/T) - 1]/(-sin theta),   4.6/T for large T,

(theta: how long ago), far above the limit 1/sqrt(1 + T²) of Eq. (5).

Below v_c an elastic punch that keeps contact follows cof/mu_0 = 1 - alpha psi(v), theory.deficit, v = v_0/v_c. Other
shapes follow 1 - (k_zc du_z/F_N) psi(v) [1 + C(v) alpha/n] to first order, n = d ln u_z/d ln a of the shape: the edge
band between a(u_z0 - du_z) and a(u_z0 + du_z) has a lag of its own, and C = (its sum over gaps -1 to 1)/psi - 1.

Symbols: alpha = du_z/u_z0, T = omega tau, phi phase, kappa = E*/G*, psi deficit of the punch.
"""

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

import mdr
from mdr import theory
from validation.cases import SHAPES, contact
from validation.report import Check, Claim, Figure

Array = NDArray[np.float64]

#: alpha, T, shapes
QUICK = (
    (0.03, 0.0, tuple(SHAPES)),
    (1.7, 0.0, tuple(SHAPES)),
    (0.03, 1.0, ("paraboloid",)),
    (1.7, 1.0, ("cone",)),
    (0.5, 10.0, ("flat punch", "paraboloid")),
    (1.0, 10.0, ("r^4",)),
    (0.2, 30.0, ("paraboloid",)),
    (1.0, 30.0, ("flat punch", "cone", "paraboloid")),
)
FULL = tuple(
    (alpha, T, tuple(SHAPES))
    for alpha, T in (
        (0.03, 0.0),
        (0.5, 0.0),
        (0.9, 0.0),
        (1.7, 0.0),
        (0.03, 1.0),
        (0.5, 1.0),
        (1.7, 1.0),
        (0.2, 10.0),
        (0.5, 10.0),
        (0.7, 10.0),
        (1.0, 10.0),
        (0.03, 30.0),
        (0.2, 30.0),
        (0.5, 30.0),
        (1.0, 30.0),
        (1.7, 30.0),
    )
)
SHARP = 3e-5  # bracket of 2e-5 on either side, and 6e-6 = h²/6 by which a mean over a step misses the least slip


def claim(effort: str) -> Claim:
    """Measure v_c by runs alone, and set COF curves beside closed forms."""
    cases = QUICK if effort == "quick" else FULL
    found = {(alpha, T): _measure(alpha, T, shapes) for alpha, T, shapes in cases}
    tapped = {T: _measure(-3.0, T, ("flat punch", "paraboloid"), u_z0=-1e-5) for T in (0.0, 1.0)}
    checks = [
        *_velocity_checks(found, tapped),
        *_limit_checks(),
        *_punch_checks(effort),
        *_small_checks(effort),
    ]
    return Claim(
        name="rigid_pull",
        title="Under a rigid pull v_c depends neither on shape, depth nor rheology",
        quote=(
            "In the limit of a very stiff system spring, k_x → ∞, the critical velocity, Eq. (15), is reduced"
            " to Eq. (1), which thus appears to be valid independently of the viscoelastic properties of the"
            " medium. (Section 2.2.2)"
        ),
        range=(
            f"{sum(len(shapes) for _, _, shapes in cases)} contacts of four shapes, Δu_z/u_z0 from 0.03 to"
            " 1.7 and tapping from above the surface, ωτ from 0 to 30; v_c measured from runs alone; COF of"
            " elastic contacts over v_0/v_c against closed forms."
        ),
        measured=(
            "Eq. (1) is exact far beyond the limits it was derived under: not only for small amplitudes and"
            " unbroken contact, but for every shape and amplitude, as long as the contact exists at the"
            " instant when the depth grows fastest, a quarter of a period before the deepest point. Loss of"
            " contact, Eq. (5), does no harm by itself. What ends Eq. (1) is a surface that comes back late:"
            " a slow rubber does so for Δu_z/u_z0 above α_1 = min (e^{θ/ωτ} − 1)/|sin θ| over π < θ < 2π,"
            " that is 70 at ωτ = 1 (never, in practice), 0.58 at ωτ = 10 and 0.166 at ωτ = 30, tending to"
            " 4.6/ωτ. Beyond, and under tapping (u_z0 < 0), v_c is lower, Eq. (1) times sin|φ_c| with φ_c the"
            " phase at which the centre touches again: 0.74 at ωτ = 30 and Δu_z = u_z0. It is still the same"
            " for all shapes, since the centre decides. Below v_c the COF of the elastic punch follows the"
            " closed form, and that of the other shapes follows it for small amplitudes, with a correction of"
            " first order, C(v_0/v_c) Δu_z/(n u_z0) for f = r^n, that the edge band alone explains."
        ),
        verdict="holds if the contact exists when the depth grows fastest",
        sentence=(
            "One v_c for every shape and relaxation time, that of Eq. (1), unless a slow surface comes back"
            " later than a quarter period before the deepest point: Δu_z/u_z0 above about 4.6/ωτ for ωτ ≫ 1,"
            " or tapping; then v_c is lower, and again the same for all shapes."
        ),
        checks=tuple(checks),
        figures=(_curve_figure(effort), _late_figure(found)),
    )


# --- when the centre touches again ---


def clearance(phi: float, depth: float, T: float) -> float:
    """Indenter over the relaxed surface, in du_z, at phase phi after the centre was left; depth is u_z0/du_z."""
    release = np.arccos(-depth / np.hypot(1, T)) - np.arctan(T)
    relaxed = (depth + np.cos(release)) * np.exp(-(phi - release) / T) if T else 0.0
    return float(depth + np.cos(phi) - relaxed)


def late(depth: float, T: float) -> float:
    """v_c over Eq. (1) of a rigid pull, 1 or sin|phi_c|, for the depth ratio u_z0/du_z > -1 and T = omega tau."""
    from scipy.optimize import brentq

    if depth >= np.hypot(1, T) or clearance(1.5 * np.pi, depth, T) >= 0:
        return 1.0
    return float(-np.sin(brentq(clearance, 1.5 * np.pi, 2 * np.pi, args=(depth, T), xtol=1e-14)))


def amplitude_limit(T: float) -> float:
    """alpha_1(T): the greatest du_z/u_z0 for which the centre touches at phi = -pi/2."""
    from scipy.optimize import minimize_scalar

    found = minimize_scalar(
        lambda theta: np.expm1(theta / T) / -np.sin(theta),
        bounds=(np.pi + 1e-9, 2 * np.pi - 1e-9),
        method="bounded",
        options={"xatol": 1e-12},
    )
    return float(found.fun)


# --- checks ---


def _measure(alpha: float, T: float, shapes: Iterable[str], **more: float) -> dict[str, tuple[float | None, float]]:
    """Measured and full-slip v_c over Eq. (1)."""
    found = {}
    for shape in shapes:
        case = contact(shape, alpha, T, **more)
        v_1 = theory.eq_1(case.mu_0, case.oscillation.du_z, case.oscillation.omega, case.material.mindlin_ratio)
        v_c = mdr.measure_critical_velocity(case).v_c
        found[shape] = (None if v_c is None else v_c / v_1, mdr.full_slip_critical_velocity(case) / v_1)
    return found


def _velocity_checks(found: dict[Any, Any], tapped: dict[Any, Any]) -> list[Check]:
    checks = []
    for (alpha, T), measured in found.items():
        name = f"ωτ = {T:g}, Δu_z/u_z0 = {alpha:g} ({_contact(alpha, T)})"
        checks += _of_one(name, late(1 / alpha, T), measured)
    for T, measured in tapped.items():
        checks += _of_one(f"ωτ = {T:g}, tapping with u_z0 = −Δu_z/3", late(-1 / 3, T), measured)
    why = "touches where cos φ = 1/3, with nothing left to relax"
    checks.append(Check("that limit for an elastic tapping contact", late(-1 / 3, 0.0), np.sqrt(8) / 3, 1e-12, why))
    return checks


def _of_one(name: str, expected: float, measured: dict[str, tuple[float | None, float]]) -> list[Check]:
    """The worst of the shapes, for runs and for the full-slip condition."""
    runs = [np.nan if run is None else run for run, _ in measured.values()]
    worst = runs[int(np.argmax(np.abs(np.nan_to_num(runs) - expected)))]
    full = max((full for _, full in measured.values()), key=lambda value: abs(value - expected))
    whom = f"{len(runs)} shapes" if len(runs) > 1 else next(iter(measured))
    return [
        Check(
            f"measured v_c over Eq. (1), worst of {whom}: {name}",
            worst,
            expected,
            SHARP * expected,
            "bracket of 2e-5 of the measurement and h²/6 = 6e-6 of the mean over a step",
        ),
        Check(
            f"full-slip v_c over Eq. (1), worst of {whom}: {name}",
            full,
            expected,
            1e-8,
            "a root or a maximum, both closed",
        ),
    ]


def _contact(alpha: float, T: float) -> str:
    if alpha * np.hypot(1, T) < 1:
        return "contact kept"
    return "contact lost, back in time" if not T or alpha < amplitude_limit(T) else "back late"


def _limit_checks() -> list[Check]:
    """alpha_1(T) from its formula against the phase of contact itself, and for a very slow material."""
    from scipy.optimize import brentq

    checks = []
    for T in (1.0, 10.0, 30.0):
        touched = brentq(lambda depth, T=T: clearance(1.5 * np.pi, depth, T), 1e-3, np.hypot(1, T) - 1e-9, xtol=1e-15)
        name = f"α_1, where Eq. (1) ends, by its formula over the phase of contact: ωτ = {T:g}"
        why = "a minimum against a root, both found to 1e-12"
        checks.append(Check(name, amplitude_limit(T) * touched, 1.0, 1e-9, why))
    why = "θ/|sin θ| is least at tan θ = θ, 4.6033; the next term of the exponential is θ/(2ωτ) = 2.3e-4 of it"
    checks.append(
        Check(
            "α_1 ωτ of a very slow material, ωτ = 10000",
            amplitude_limit(1e4) * 1e4,
            4.6033388,
            4.6 * 2.3e-4,
            why,
        )
    )
    return checks


def _punch_checks(effort: str) -> list[Check]:
    v_hat = np.array([0.02, 0.1, 0.3, 0.6, 0.9, 0.98]) if effort == "quick" else np.linspace(0.02, 0.98, 25)
    checks = []
    for alpha in (0.03, 0.5, 0.98):
        case = contact("flat punch", alpha)
        v_c = mdr.critical_velocity(case)
        runs = [mdr.slide(case, v * v_c) for v in v_hat]
        off = np.array(
            [run.cof / case.mu_0 - 1 + alpha * theory.deficit(v) for run, v in zip(runs, v_hat, strict=True)]
        )
        name = f"COF/μ_0 of slide() against 1 − (Δu_z/u_z0) ψ, worst: elastic punch, Δu_z/u_z0 = {alpha:g}"
        why = "what the run promises when it chooses step and springs itself"
        checks.append(Check.at_most(name, np.max(np.abs(off)), 1e-5, why))
    return checks


def small_amplitude(shape: str, alpha: float, v_hat: float) -> tuple[float, float]:
    """(1 - cof/mu_0) F_N/(k_zc du_z psi) - 1 of an elastic contact, F_N at u_z0, and its numerical error."""
    case = contact(shape, alpha)
    run = mdr.slide(case, v_hat * mdr.critical_velocity(case), n_springs=384, steps_per_period=1024)
    force = float(case.indenter.force(case.oscillation.u_z0, case.material.E_star))
    law = case.k_zc * case.oscillation.du_z / force * theory.deficit(v_hat)
    return (1 - run.cof / run.mu_0) / law - 1, run.cof_error / run.mu_0 / law


def edge_band(v_hat: float) -> float:
    """C(v_hat): sum of the lag s - e of elastic springs of gaps -1 to 1 over that of the core, less 1.

    e is the least of sigma(t - theta) + v theta over the past, sigma = max(cos - gap, 0): two passes over a period.
    """
    n = 4096
    phase = 2 * np.pi * np.arange(2 * n) / n
    node, weight = np.polynomial.legendre.leggauss(60)
    pressed = np.maximum(np.cos(phase) - node[:, None], 0)
    e = np.minimum.accumulate(pressed - v_hat * phase, axis=1) + v_hat * phase
    lag = np.mean((pressed - e)[:, n:], axis=1)
    return float(weight @ lag) / theory.deficit(v_hat) - 1


def _small_checks(effort: str) -> list[Check]:
    amplitudes = (0.1, 0.05) if effort == "quick" else (0.05, 0.025)
    checks = []
    for v_hat in (0.1, 0.3, 0.7):
        C, first = edge_band(v_hat), []
        for shape, n in (("cone", 1), ("paraboloid", 2), ("r^4", 4)):
            far, near = (n * small_amplitude(shape, alpha, v_hat)[0] / alpha for alpha in amplitudes)
            first.append(2 * near - far)
        worst = max(first, key=lambda value: abs(value - C))
        name = f"first-order term C of the deficit for cone, paraboloid and r^4, worst of them: v_0/v_c = {v_hat:g}"
        why = "two amplitudes extrapolated leave their product, the next order, with a factor of order one"
        checks.append(Check(name, worst, C, amplitudes[0] * amplitudes[1], why))
    return checks


# --- figures ---


def _curve_figure(effort: str) -> Figure:
    import matplotlib.pyplot as plt

    from mdr.plots import plot_curve, style

    grid = np.linspace(0.03, 1.2, 9 if effort == "quick" else 30)
    with style():
        fig, axes = plt.subplots(1, 2, figsize=(9.4, 4.2), sharey=True)
        for ax, T in zip(axes, (0.0, 1.0), strict=True):
            cases = [contact(shape, 0.3, T) for shape in SHAPES]
            curves = [mdr.cof_curve(case, grid * mdr.critical_velocity(case)) for case in cases]
            plot_curve(curves, ax, labels=[shape.replace("r^4", "$r^4$") for shape in SHAPES])
            ax.set_title("elastic" if T == 0 else rf"Kelvin, $\omega\tau={T:g}$", y=1.05)
        axes[1].set_ylabel("")
    return Figure(
        "curves",
        "COF of the four shapes under a rigid pull, Δu_z/u_z0 = 0.3. Each starts at its own static value and"
        " takes its own way, and all reach μ_0 at the velocity of Eq. (1). Viscosity lowers the static value"
        " and bends the start upwards, but leaves v_c where it was.",
        fig,
        "COF over mu_0 against v_0 over v_c for four shapes, elastic and Kelvin, all ending at v_c.",
    )


def _late_figure(found: dict[Any, Any]) -> Figure:
    import matplotlib.pyplot as plt

    from mdr.plots import COLOURS, style

    marks = dict(zip(SHAPES, "osD^", strict=True))
    alphas = np.linspace(0.02, 1.75, 400)
    with style():
        fig, ax = plt.subplots(figsize=(7.4, 4.2))
        for T, colour in zip((0.0, 1.0, 5.0, 10.0, 30.0), (COLOURS[6], *COLOURS), strict=False):
            if T > 1:
                ax.plot(
                    alphas,
                    [late(1 / alpha, T) for alpha in alphas],
                    color=colour,
                    label=rf"$\omega\tau={T:g}$",
                )
                ax.axvline(1 / np.hypot(1, T), color=colour, lw=0.9, ls=":", ymax=0.12)
            for (alpha, T_found), measured in found.items():
                for shape, (run, _) in measured.items():
                    if T_found == T and run is not None:
                        ax.plot(
                            alpha,
                            run,
                            marks[shape],
                            mfc="none",
                            mec=colour,
                            ms=5 + 1.6 * list(SHAPES).index(shape),
                        )
        for shape, mark in marks.items():
            ax.plot([], [], mark, mfc="none", mec="0.3", label=shape.replace("r^4", "$r^4$"))
        ax.set(
            xlabel=r"amplitude $\Delta u_z/u_{z0}$",
            ylabel="$v_c$ over Eq. (1)",
            ylim=(0.6, 1.03),
            xlim=(0, 1.78),
        )
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return Figure(
        "late",
        "Measured v_c over Eq. (1) (symbols, one on the other, for the four shapes) and sin|φ_c| of the"
        " centre (lines); all elastic contacts and those at ωτ = 1 lie at 1. Eq. (1) holds far beyond the"
        " loss of contact, Eq. (5), marked at the foot of the axes, and ends where a slow rubber comes back"
        " too late to meet the fastest indentation.",
        fig,
        "Critical velocity over Eq. (1) against amplitude, flat at one and falling beyond a limit for slow materials.",
    )
