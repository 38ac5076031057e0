"""Rigid pull: v_c is Eq. (1) for any shape, amplitude and relaxation time, as long as the contact is there in time.

In full slip every spring in contact slips at v_0 - v_1 (-sin phi), v_1 = mu_0 kappa omega du_z of Eq. (1), so v_c = v_1
if any spring touches at phi = -pi/2, where the depth grows fastest. A slow surface that was left may come back later,
and v_c is then lower (`mdr.laws.late_return`).

Below v_c the COF is known in closed form (mdr/closed_forms/rigid_pull.py), and so are both ends of its curve. It is set
beside runs, which share no code with it. What the curves of different shapes have in common: validation/one_curve.py;
how runs leave the static value: validation/static_cof.py.

Symbols: alpha = du_z/u_z0, T = omega tau, phi phase, kappa = E*/G*.
"""

from collections.abc import Iterable
from itertools import product

import numpy as np

import mdr
from mdr import laws
from mdr.closed_forms.rigid_pull import Asymptote, average_friction, near_critical, small_velocity
from mdr.tools.arrays import Array
from validation.cases import SHAPES, contact, shape_label
from validation.figures import COLOURS, circles, figure
from validation.measured import RUN, SHARP, Point, measured, worst
from validation.report import Check, Checks, Claim, Equation, told
from validation.words import listed

Measured = dict[tuple[float, float], list[Point]]  #: by alpha and T

#: alpha, T, shapes
QUICK = (
    (0.03, 0.0, ("flat punch", "cone")),
    (1.7, 0.0, ("paraboloid", "r^4")),
    (1.7, 1.0, ("cone",)),
    (0.5, 10.0, ("r^4",)),
)
AMPLITUDES = {
    0.0: (0.03, 0.5, 0.9, 1.7),
    1.0: (0.03, 0.5, 1.7),
    10.0: (0.2, 0.5, 0.7, 1.0),
    30.0: (0.03, 0.2, 0.5, 1.0, 1.7),
}
FULL = tuple((alpha, T, tuple(SHAPES)) for T, alphas in AMPLITUDES.items() for alpha in alphas)
TAPPING = -1 / 3  # u_z0/du_z of contacts that exist for less than half of the period


def claim(effort: str) -> Claim:
    """Under a rigid pull v_c depends neither on shape, depth nor rheology

    How: Measure v_c by runs alone, and set the closed form of the COF beside runs and its own ends.

    Quote: In the limit of a very stiff system spring, k_x → ∞, the critical velocity, Eq. (15), is reduced to Eq. (1),
    which thus appears to be valid independently of the viscoelastic properties of the medium. (Section 2.2.2)

    Range: {n_contacts} contacts of four shapes, Δu_z/u_z0 from {least_alpha:g} to {most_alpha:g} and tapping from above
    the surface, ωτ from {least_T:g} to {most_T:g}; v_c measured from runs alone. COF of {n_runs} further runs against
    the closed form, which is then followed to both ends of its curve.

    Measured: Eq. (1) is exact far beyond the limits it was derived under: not only for small amplitudes and unbroken
    contact, but for every shape and amplitude, as long as the contact exists at the instant when the depth grows
    fastest, a quarter of a period before the deepest point. Loss of contact, Eq. (5), does no harm by itself. What ends
    Eq. (1) is a surface that comes back late: a slow rubber does so for Δu_z/u_z0 above α_1 = min (e^{{θ/ωτ}} − 1)/|sin
    θ| over π < θ < 2π, that is {limit_1:.0f} at ωτ = 1 (never, in practice), {limit_10:.2f} at ωτ = 10 and
    {limit_30:.3f} at ωτ = 30, tending to {slow:.1f}/ωτ. Beyond, and under tapping (u_z0 < 0), v_c is lower, Eq. (1)
    times sin|φ_c| with φ_c the phase at which the centre touches again: {late:.2f} at ωτ = 30 and Δu_z = u_z0. It is
    still the same for all shapes, since the centre decides. Below v_c runs follow the closed form of the COF within
    their own bounds. An elastic contact joins μ_0 with (1 − v_0/v_c)^2, a Kelvin contact, whose lag outlives the stick,
    with (1 − v_0/v_c)^{{3/2}}: so softly that a velocity at which the COF comes close to μ_0 is not v_c. The other end,
    at v_0 → 0, is shown with the static value.

    Verdict: holds if the contact is closed at the moment of fastest approach

    Sentence: One v_c for every shape and relaxation time, that of Eq. (1), unless the surface comes back late: by
    tapping, or for Δu_z/u_z0 above about {slow:.1f}/ωτ (ωτ ≫ 1).
    """
    cases = QUICK if effort == "quick" else FULL
    found = {(alpha, T): _measure(alpha, T, shapes) for alpha, T, shapes in cases}
    shapes = ("flat punch",) if effort == "quick" else ("flat punch", "paraboloid")
    tapped = {T: _measure(1 / TAPPING, T, shapes, u_z0=-1e-5) for T in (0.0, 1.0)}
    marched = _marched(effort)
    alphas, times = ([case[i] for case in cases] for i in (0, 1))
    slow = laws.slow_limit()
    n_contacts = sum(len(shapes) for _, _, shapes in cases)
    least_alpha = min(alphas)
    most_alpha = max(alphas)
    least_T, most_T, n_runs = min(times), max(times), len(marched)
    limit_1, limit_10 = laws.amplitude_limit(1.0), laws.amplitude_limit(10.0)
    limit_30, late = laws.amplitude_limit(30.0), laws.late_return(1.0, 30.0)
    return Claim(
        **told(claim, locals()),
        checks=(*_velocity_checks(found, tapped), *_march_checks(marched), *_end_checks()),
        figures=(_curve_figure(), _end_figure()),
        equations=_EQUATIONS,
    )


_EQUATIONS = (
    Equation(
        "closed form",
        r"1 - \frac{\mu}{\mu_0} = \frac{\Delta u_z}{2\pi \langle F_N \rangle} \int k_{z,c}(\theta) D(\theta)"
        r" \left[ T + \frac{\sigma}{1 - E} \right] d\theta, \quad E = e^{-(2\pi - \sigma)/T}, \quad"
        r" D = -\sin \theta - \hat{v} + E (\hat{v} + \sin b)",
        "COF under a rigid pull, v̂ = v_0/v_c with v_c of Eq. (1), T = ωτ. A spring touches at the phase θ and sticks"
        " until b = θ + σ, where T (v̂ + sin b)(1 − E) = cos b − cos θ − v̂ σ; over all θ with D > 0 and σ > 0.",
    ),
    Equation(
        "its end",
        r"1 - \frac{\mu}{\mu_0} \to \frac{9}{4\pi} \frac{k_{z,c} \Delta u_z}{\langle F_N \rangle} (1 - \hat{v})^2"
        r" \text{ elastic}, \quad"
        r" \frac{2 \sqrt{2} T}{3\pi} \frac{k_{z,c} \Delta u_z}{\langle F_N \rangle} (1 - \hat{v})^{3/2} \text{ Kelvin}",
        "As v_0 → v_c, with the stiffness at the instant when the depth grows fastest.",
    ),
)


# --- checks of v_c ---


def _measure(alpha: float, T: float, shapes: Iterable[str], **more: float) -> list[Point]:
    return [measured(contact(shape, alpha, T, **more), shape) for shape in shapes]


def _velocity_checks(found: Measured, tapped: dict[float, list[Point]]) -> Checks:
    for (alpha, T), points in found.items():
        name = f"ωτ = {T:g}, Δu_z/u_z0 = {alpha:g} ({_contact(alpha, T)})"
        yield from _of_one(name, laws.late_return(1 / alpha, T), points)
    for T, points in tapped.items():
        yield from _of_one(f"ωτ = {T:g}, tapping with u_z0 = −Δu_z/3", laws.late_return(TAPPING, T), points)
    why = "touches where cos φ = 1/3, with nothing left to relax"
    yield Check("that limit for an elastic tapping contact", laws.late_return(TAPPING, 0.0), np.sqrt(8) / 3, 1e-12, why)


def _of_one(name: str, expected: float, points: list[Point]) -> Checks:
    """The worst of the shapes, for runs and for the full-slip condition."""
    runs = worst([1 + p.deviation for p in points], expected)
    full = worst([mdr.full_slip_critical_velocity(p.case) / mdr.critical_velocity(p.case) for p in points], expected)
    whom = f"worst of {len(points)} shapes" if len(points) > 1 else points[0].where
    why = "bracket of 2e-5 of the measurement and h²/6 = 6e-6 of the mean over a step"
    yield Check(f"measured v_c over Eq. (1), {whom}: {name}", runs, expected, SHARP * expected, why)
    yield Check(f"full-slip v_c over Eq. (1), {whom}: {name}", full, expected, 1e-8, "1, or a root against a root")


def _contact(alpha: float, T: float) -> str:
    if alpha * np.hypot(1, T) < 1:
        return "contact kept"
    return "contact lost, back in time" if not T or alpha < laws.amplitude_limit(T) else "back late"


# --- checks of the closed form ---


def _marched(effort: str) -> list[tuple[mdr.SlidingContact, float]]:
    """Cases and v_0 over Eq. (1): shapes, amplitudes and relaxation times crossed, velocities in turn."""
    alphas, times, velocities = (0.03, 0.4, 0.9, 1.7), (0.0, 0.3, 1.0, 3.0), (0.05, 0.37, 0.81, 0.97)
    every = product(enumerate(SHAPES), range(4), range(4))
    crossed = [(contact(s, alphas[j], times[k]), velocities[(i + j + k) % 4]) for (i, s), j, k in every]
    tapping = [(contact("cone", 1 / TAPPING, T, u_z0=-1e-5), v) for T, v in ((0.0, 0.37), (1.0, 0.81))]
    back_late = [(contact("cone", 1.0, 30.0), 0.37), (contact("r^4", 1.0, 10.0), 0.81)]
    return crossed[:: 5 if effort == "quick" else 1] + tapping + back_late


def _march_checks(marched: list[tuple[mdr.SlidingContact, float]]) -> Checks:
    off, share = [], []
    for case, v in marched:
        v_0 = v * mdr.critical_velocity(case)
        run = mdr.slide(case, v_0)
        miss = abs(run.cof - float(average_friction(case, v_0).cof))
        off.append(miss / case.mu_0)
        share.append(miss / run.cof_error if run.settled else np.nan)
    whom = f"worst of {len(marched)} contacts of four shapes, kept, lost, tapping and back late"
    yield Check.at_most(f"COF/μ_0 of slide() less that of the closed form, {whom}", np.max(off), 1e-5, RUN)
    yield Check.at_most(f"the same over the bound of the run, {whom}", np.max(share), 1.0, "a bound is one")


def leading_term(x: Array, y: Array, step: float) -> Asymptote:
    """Power and coefficient of y = A x^p [1 + O(x^step)]: log y fitted with the next three powers of x^step too."""
    columns = [np.log(x), np.ones_like(x), *(x ** (k * step) for k in (1, 2, 3))]
    p, log_A, *_ = np.linalg.lstsq(np.column_stack(columns), np.log(y), rcond=None)[0]
    return Asymptote(float(p), float(np.exp(log_A)))


def _near_v_c(case: mdr.SlidingContact, short: Array) -> Array:
    """1 - cof/mu_0 at v_0 = (1 - short) v_c."""
    return np.asarray(1 - average_friction(case, (1 - short) * mdr.critical_velocity(case)).cof / case.mu_0)


def _near_rest(case: mdr.SlidingContact, v: Array) -> Array:
    """(cof - static)/mu_0 at v_0 = v v_c."""
    cof = average_friction(case, v * mdr.critical_velocity(case)).cof
    return np.asarray((cof - mdr.static_cof(case)) / case.mu_0)


def _end_checks() -> Checks:
    """Both ends of the curve, fitted to the closed form, against their leading terms."""
    short, v = np.geomspace(1e-4, 1e-3, 25), np.geomspace(1e-6, 1e-4, 25)
    for T, alphas in ((0.0, (0.3, 1.7)), (1.0, (0.3, 1.7))):
        cases = [contact(shape, alpha, T) for shape, alpha in product(SHAPES, alphas)]
        fits = [leading_term(short, _near_v_c(case, short), 1 / 2) for case in cases]
        name = f"1 − μ/μ_0 in 1 − v_0/v_c near v_c, ωτ = {T:g}, Δu_z/u_z0 = {listed(alphas)}"
        yield from _term_checks(name, fits, [near_critical(case) for case in cases])
    for T, alphas, step in ((0.0, (0.3, 1.7), 1 / 2), (1.0, (0.1, 0.3), 1 / 3)):
        cases = [contact(shape, alpha, T) for shape, alpha in product(SHAPES, alphas)]
        fits = [leading_term(v, _near_rest(case, v), step) for case in cases]
        name = f"(μ − static)/μ_0 in v_0/v_c near rest, ωτ = {T:g}, Δu_z/u_z0 = {listed(alphas)}"
        yield from _term_checks(name, fits, [small_velocity(case) for case in cases])


def _term_checks(name: str, fits: list[Asymptote], laws: list[Asymptote]) -> Checks:
    power, ratio = laws[0].power, [fit.coefficient / law.coefficient for fit, law in zip(fits, laws, strict=True)]
    why = "the fit knows three terms beyond the leading one; the fourth, at most 5e-6 of it, moves the power by 5e-7"
    why += " and the coefficient by 1e-5, times its own factor of order one to ten"
    whom = f"worst of {len(fits)}"
    yield Check(f"power of {name}, {whom}", worst([fit.power for fit in fits], power), power, 5e-6, why)
    yield Check(f"coefficient over the derived one of {name}, {whom}", worst(ratio, 1.0), 1.0, 1e-4, why)


# --- figures ---


@figure("curves", 1, 2, size=(9.4, 4.2), sharey=True)
def _curve_figure(fig, axes):
    """COF over mu_0 against v_0 over v_c for four shapes, elastic and Kelvin, all ending at v_c.

    COF of the four shapes under a rigid pull, Δu_z/u_z0 = {alpha:g}. Each starts at its own static value and takes its
    own way, and all reach μ_0 at the velocity of Eq. (1). Viscosity lowers the static value and bends the start
    upwards, but leaves v_c where it was.
    """
    alpha, grid = 0.3, 1.2 * np.linspace(0, 1, 200) ** 2
    for ax, T in zip(axes, (0.0, 1.0), strict=True):
        for shape in SHAPES:
            case = contact(shape, alpha, T)
            curve = mdr.cof_curve(case, grid * mdr.critical_velocity(case))
            ax.plot(curve.v_0 / curve.v_c, curve.cof / curve.mu_0, label=shape_label(shape))
        ax.axvline(1.0, color="0.4", lw=1, ls=":", zorder=0)
        ax.set_title(_material(T), y=1.05)
        ax.set(xlabel="pulling velocity $v_0/v_c$", xlim=(0, 1.2))
        ax.annotate("$v_c$", (1.0, 1.0), (0, 3), ("data", "axes fraction"), "offset points", ha="center")
    axes[0].set_ylabel(r"coefficient of friction $\mu/\mu_0$")
    axes[0].legend(loc="lower center")
    return {"alpha": alpha}


def read_off(case: mdr.SlidingContact, short: float) -> float:
    """v_0/v_c at which the COF is mu_0 (1 - short)."""
    from scipy.optimize import brentq

    return 1 - float(brentq(lambda x: _near_v_c(case, np.array(x)) - short, 1e-6, 0.99))


def _reach(case: mdr.SlidingContact) -> float:
    """1 - v_0/v_c up to which the leading term near v_c is good to a tenth."""
    x, law = np.geomspace(1e-4, 0.99, 400), near_critical(case)
    bad = np.abs(_near_v_c(case, x) / (law.coefficient * x**law.power) - 1) > 0.1
    return float(x[np.argmax(bad)])


@figure("near-critical", 1, 2, size=(9.4, 4.4), sharey=True)
def _end_figure(fig, axes):
    """Double logarithmic plot of one less COF over mu_0 against one less v_0 over v_c, slopes two and three halves.

    How friction joins μ_0, Δu_z/u_z0 = {alpha:g}: closed form (symbols) and leading terms, none of them fitted (lines).
    The shapes differ by a factor alone, their stiffness over their mean force. The elastic law is good to a tenth down
    to {elastic:.2f} v_c; that of the Kelvin contact, whose lag outlives the stick by the time τ, down to {kelvin:.3f}
    v_c only, as below the stick is no longer short beside τ. So soft an end hides v_c: a thousandth below μ_0 (dotted)
    the velocity is only {low:.2f} to {high:.2f} v_c.
    """
    alpha, x, threshold = 0.3, np.geomspace(1e-4, 0.99, 25), 1e-3
    cases = {(shape, T): contact(shape, alpha, T) for shape, T in product(SHAPES, (0.0, 1.0))}
    for (shape, T), case in cases.items():
        ax, law, colour = axes[int(T)], near_critical(case), COLOURS[list(SHAPES).index(shape)]
        ax.loglog(x, law.coefficient * x**law.power, color=colour, lw=1.1)
        circles(ax, x, _near_v_c(case, x), colour, label=shape_label(shape))
        ax.set(title=f"{_material(T)}: power {'3/2' if T else '2'}", xlabel="$1-v_0/v_c$")
    for ax in axes:
        ax.axhline(threshold, color="0.4", lw=1, ls=":", zorder=0)
    axes[0].set_ylabel(r"$1-\mu/\mu_0$")
    axes[0].legend(loc="lower right")
    low, high = (f([read_off(case, threshold) for case in cases.values()]) for f in (min, max))
    elastic, Kelvin = (min(_reach(case) for (_, at), case in cases.items() if at == T) for T in (0.0, 1.0))
    return {"alpha": alpha, "elastic": 1 - elastic, "kelvin": 1 - Kelvin, "low": low, "high": high}


def _material(T: float) -> str:
    return "elastic" if T == 0 else rf"Kelvin, $\omega\tau={T:g}$"
