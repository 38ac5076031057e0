"""Lost contact: where Eq. (1) and Eq. (15) end, and what v_c is beyond.

A spring of the depth d is lost in every period if its amplitude du_z sqrt(1 + T²) exceeds d, the reverse of Eq. (5).
The laws tested here are derived in mdr/closed_forms/laws/:

* rigid pull: when the centre of the contact touches again (`mdr.laws.late_return`, `amplitude_limit`, `slow_limit`);
* a punch that has just been lost under a body (`onset`), (*) below;
* a slow material under a body (`blow`), (**) below, and its limit (`half_a_blow`).

Symbols: alpha = du_z/u_z0, T = omega tau, phi phase, omega_0² = k_x/m.
"""

from functools import cache
from itertools import product

import numpy as np

import mdr
from mdr import laws
from mdr.normal.kelvin_edges import contact_edge
from mdr.tools.progress import progress
from validation.cases import DAMPING, LOOKS, SHAPES, STIFFNESS, contact, driven, loss, shape_label
from validation.figures import COLOURS, figure, key, panel
from validation.measured import SHARP, Point, deviation, measured, worst
from validation.report import Check, Checks, Claim, Equation, told
from validation.words import counted, listed, percent, ranged

RATIOS = (0.6, 1.5, 2.5)  # omega_0/omega
TIMES = (0.0, 1.0, 10.0, 30.0, 100.0)  # of the curves under a rigid pull
LATE = ((0.04, 100.0), (0.1, 100.0), (0.5, 100.0), (1.5, 100.0), (0.3, 30.0), (1.5, 10.0))  # alpha, T
RIGID = {  # alpha, T, shape
    "quick": ((1.0, 100.0, "cone"),),
    "full": tuple((alpha, T, shape) for alpha, T in LATE for shape in ("flat punch", "paraboloid")),
}
BODY = {  # shape, alpha, T, omega_0/omega
    "quick": (("flat punch", 1.0, 30.0, 0.6),),
    "full": (
        ("flat punch", 1.0, 10.0, 0.6), ("flat punch", 0.1, 100.0, 1.5), ("cone", 1.0, 100.0, 1.5),
        ("cone", 3.0, 0.0, 2.5), ("paraboloid", 0.5, 30.0, 0.6), ("paraboloid", 1.0, 100.0, 2.5),
        ("r^4", 0.2, 100.0, 0.6), ("r^4", 2.0, 3.0, 1.5),
    ),
}  # fmt: skip


# --- a punch that has just been lost ---


def lost_punch(eps: float, T: float, ratio: float) -> mdr.SlidingContact:
    """A flat punch of alpha sqrt(1 + T²) = 1 + eps under a body."""
    return driven("flat punch", (1 + eps) / np.hypot(1, T), T, ratio)


def reached(bound: float, T: float, ratio: float) -> float:
    """Eps at which the deviation of the punch has grown to so much, by bisection."""
    low, high = 1e-12, 1e-2
    while high / low > 1 + 1e-6:
        eps = np.sqrt(low * high)
        low, high = (low, eps) if abs(_punch(eps, T, ratio)) > bound else (eps, high)
    return float(np.sqrt(low * high))


def _punch(eps: float, T: float, ratio: float) -> float:
    return deviation(lost_punch(eps, T, ratio))


# --- measured ---


@cache
def measure(shape: str, alpha: float, T: float, ratio: float | None = None) -> Point:
    """Measure v_c of one contact, under a rigid pull or a body of omega_0 = ratio * omega."""
    case = contact(shape, alpha, T) if ratio is None else driven(shape, alpha, T, ratio)
    where = f"{shape}, α = {alpha:g}, ωτ = {T:g}" + ("" if ratio is None else f", ω_0 = {ratio:g} ω")
    return measured(case, where, shape, alpha, T, ratio)


# --- the claim ---


def claim(effort: str) -> Claim:
    """Eqs. (1) and (15) hold for a contact that is lost in every period

    How: Measure v_c of contacts that are lost, and test the laws of where the formulas end and what comes after.

    Quote: Only this “non-jumping” case is considered in the following. (Section 2.2, on Eq. (5))

    Range: Contact lost in every period, α √(1 + (ωτ)²) > 1. Rigid pull: {rigid_velocities}, ωτ {times}, α {alphas}.
    Mass and spring (k_x = {stiffness:g} k_x,c, damper {damping:g} % of critical): {more}, {shapes}; full-slip values up
    to ωτ = 100 000.

    Measured: Under a rigid pull the loss of contact, Eq. (5), does no harm by itself. What ends Eq. (1) is a surface
    that comes back later than a quarter of a period before the deepest point: α above α_1 = min (e^{{θ/ωτ}} − 1)/|sin
    θ| over π < θ < 2π, that is {limit_1:.0f} at ωτ = 1 (never, in practice), {limit_10:.2f} at ωτ = 10 and
    {limit_100:.3f} at ωτ = 100, tending to {slow:.1f}/ωτ. Beyond, v_c is Eq. (1) times sin|φ_c|, φ_c the phase at which
    the centre touches again. With a mass and a spring a flat punch, for which Eq. (15) is exact until then, leaves it
    as ε^{{3/2}} if elastic and as ε^2 if viscoelastic, α √(1 + (ωτ)²) = 1 + ε, since what a Kelvin contact misses as a
    pull while it is off, it misses again as pressure before it returns. Far beyond, with a slow material, the contact
    is a blow once in a period, and v_c no longer depends on τ nor, under a light damper and away from ω_0 = nω, where
    the blows add up, on k_x: it is half the velocity that one blow gives the body, π μ_0 F_N(u_z0 + Δu_z)/(mω), F_N the
    elastic force at the deepest point, plus a known term in (ωτ)^{{−1/2}}. Eq. (15) grows with ωτ; the least v_c
    measured is {least_percent} of it ({least.where}). The full-slip condition with the true times of contact lies in
    the bracket of every measurement.

    Verdict: holds if the pull is rigid and the contact closed at the moment of fastest approach

    Sentence: Losing contact leaves Eq. (1) untouched up to Δu_z/u_z0 of about {slow:.1f}/ωτ (ωτ ≫ 1), but ends Eq. (15)
    of a punch at once. If slow rubber taps, off resonances, v_c is half the velocity of each impact.
    """
    size = "quick" if effort == "quick" else "full"
    knobs = [*((s, a, T, None) for a, T, s in RIGID[size]), *BODY[size]]
    points = [measure(*one) for one in progress(knobs, "lost_contact")]
    rigid, body = points[: len(RIGID[size])], points[len(RIGID[size]) :]
    least, slow = min(body, key=lambda p: p.deviation), laws.slow_limit()
    rigid_velocities = counted(len(rigid), "measured velocity")
    times = ranged(p.T for p in rigid)
    alphas = ranged(p.alpha for p in rigid)
    stiffness, damping = STIFFNESS, 100 * DAMPING
    more = counted(len(body), "more", "more")
    shapes = listed(dict.fromkeys(p.shape for p in body))
    limit_1 = laws.amplitude_limit(1.0)
    limit_10, limit_100 = laws.amplitude_limit(10.0), laws.amplitude_limit(100.0)
    least_percent = percent(1 + least.deviation, 3)
    return Claim(
        **told(claim, locals()),
        checks=(*_rigid_checks(rigid), *_limit_checks(), *_onset_checks(), *_slow_checks(), *_body_checks(body)),
        figures=(_rigid_figure(rigid), _onset_figure(effort), _slow_figure(body, effort)),
        equations=_EQUATIONS,
    )


_EQUATIONS = (
    Equation(
        "(*)",
        r"v_c - v_c^{(15)} = \frac{\mu_0 k_{z,c} u_{z0}}{m \omega_d \omega} \text{ Im } \frac{(A s + B s^2/\omega)"
        r" e^{s t_m}}{1 - e^{2\pi s/\omega}}, \quad s = -\frac{c_x}{2m} + i \omega_d",
        "A punch just lost under a body, whose free oscillation is e^{<i>s</i>t}; <i>t</i><sub>m</sub> is the time from"
        " the loss of contact to the maximum of Eq. (15). Elastic: <i>A</i> = (4√2/3) ε^{3/2}, <i>B</i> = 0. Kelvin:"
        " <i>B</i> = (9/2) ε^2, <i>A</i> = <i>B</i>/ωτ. Leading order in ε (<code>mdr.laws.onset</code>).",
    ),
    Equation(
        "(**)",
        r"v_c = \frac{2\pi \mu_0}{m \omega \omega_d} \text{ Im } \frac{s \sum k d e^{2 s \delta/3\omega}}"
        r"{1 - e^{2\pi s/\omega}}, \quad \delta = \sqrt{\frac{4\pi d}{\omega\tau \Delta u_z}}",
        "A slow material, ωτ ≫ 1, that gives the body one blow in a period; the sum is over the springs, of the"
        " stiffness k and the greatest compression d (<code>mdr.laws.blow</code>).",
    ),
)


def _rigid_checks(points: list[Point]) -> Checks:
    why = "bracket of 2e-5 of the measurement and h²/6 = 6e-6 of the mean over a step"
    for alpha, T in dict.fromkeys((p.alpha, p.T) for p in points):
        here = [p.over_rigid for p in points if (p.alpha, p.T) == (alpha, T)]
        law = laws.late_return(1 / alpha, T)
        name = f"measured v_c over Eq. (1), worst of {len(here)} shapes: ωτ = {T:g}, Δu_z/u_z0 = {alpha:g}"
        yield Check(name, worst(here, law), law, SHARP * law, why)


def _limit_checks() -> Checks:
    """alpha_1(T) from its formula against the edge of the library, and for a very slow material."""
    for T in (1.0, 10.0, 30.0, 100.0):
        name = f"α_1, where Eq. (1) ends, times u_z0/Δu_z of a centre that touches at −π/2: ωτ = {T:g}"
        touched = -float(contact_edge(np.array(1.5 * np.pi), T))
        yield Check(name, laws.amplitude_limit(T) * touched, 1.0, 1e-11, "a minimum against a root, both to 1e-12")
    T, limit = 1e4, laws.slow_limit()
    why = "the next term of the exponential is θ/(2ωτ) of it, at tan θ = θ < 4.5"
    name = f"α_1 ωτ of a very slow material, ωτ = {T:g}"
    yield Check(name, laws.amplitude_limit(T) * T, limit, limit * 2.25 / T, why)


def _onset_checks() -> Checks:
    for T, power, why in ((0.0, 1.5, "3/2, an impulse"), (1.0, 2, "2, a doublet as the impulse is repaid")):
        edge = max(abs(_punch(0.0, T, r)) for r in RATIOS)
        kept = "the force has one harmonic while contact is kept; rounding of its panels"
        yield Check.at_most(f"flat punch, {loss(T)}: |deviation| as α √(1 + T²) reaches 1", edge, 1e-9, kept)
        for ratio in (0.6, 2.5):
            law, where = (1e-9 / abs(laws.onset(lost_punch(1.0, T, ratio)))) ** (1 / power), f"flat punch, {loss(T)}"
            name = f"{where}, ω_0 = {ratio:g} ω: α √(1 + T²) where |deviation| passes 1e-9"
            next_order = "its next order is a few √ε" if T else "1 + ε of the law (*); its next order is a few ε of it"
            size = 3 * np.sqrt(law) if T else 10 * law
            yield Check(name, 1 + reached(1e-9, T, ratio), 1 + law, float(size * law), next_order)
            slope = np.log(_punch(1e-5, T, ratio) / _punch(1e-6, T, ratio)) / np.log(10)
            name = f"{where}, ω_0 = {ratio:g} ω: power of ε in the deviation"
            yield Check(name, slope, power, 0.01, why + "; the next order at ε = 1e-5")


def _slow_checks() -> Checks:
    for shape, alpha in product(SHAPES, (0.2, 1.0)):
        off = {}
        for T in (1e5, 1e6):
            cases = [driven(shape, alpha, T, ratio) for ratio in RATIOS]
            off[T] = [mdr.full_slip_critical_velocity(case) / laws.blow(case) - 1 for case in cases]
        # a blow is known by its impulse and its mean time; its mean square time is delta²/2
        next_order = 0.5 * 0.5 * 4 * np.pi * (1 + 1 / alpha) / 1e5 * max(RATIOS) ** 2
        name = f"{shape}, α = {alpha:g}, ωτ = 100000: worst |full-slip value over (**) − 1| of {len(RATIOS)} ω_0/ω"
        yield Check.at_most(name, max(map(abs, off[1e5])), next_order, "the next order of a blow, (ω_0 δ/ω)²/4")
        powers = [float(-np.log10(b / a)) for a, b in zip(off[1e5], off[1e6], strict=True)]
        name = f"{shape}, α = {alpha:g}: power of 1/ωτ in that, worst of {len(RATIOS)} ω_0/ω"
        why = "(**) leaves out 1/ωτ; the next term, (ωτ)^{−1/2} of it, at ωτ = 100 000"
        yield Check(name, worst(powers, 1), 1.0, 0.05, why)
    undamped = [driven("paraboloid", 1.0, 1e10, ratio, 0.0) for ratio in RATIOS]
    light = worst((laws.blow(case) / laws.half_a_blow(case) for case in undamped), 1)
    name = "(**) over π μ_0 F_N(u_z0 + Δu_z)/(mω) without damper, ωτ = 1e10, worst of three ω_0/ω"
    yield Check(name, light, 1.0, 5e-5, "what is left of the (ωτ)^{−1/2} term")
    for n in (1, 2):
        case = driven("cone", 1.0, 1e8, n / np.sqrt(1 - DAMPING**2))
        add_up = 2 / -np.expm1(-2 * np.pi * n * DAMPING / np.sqrt(1 - DAMPING**2))
        name = f"cone, ωτ = 1e8, free oscillation at {n}ω: full-slip value over π μ_0 F_N(u_z0 + Δu_z)/(mω)"
        why = "2/[1 − exp(−2πnζ)], blows that add up; (ωτ)^{−1/2} of it"
        yield Check(name, mdr.full_slip_critical_velocity(case) / laws.half_a_blow(case), add_up, 1e-3 * add_up, why)


def _body_checks(points: list[Point]) -> Checks:
    why = "each measurement brings its bracket; both name one velocity"
    off = max(points, key=lambda p: abs(p.miss))
    least = min(points, key=lambda p: p.deviation)
    name = f"with a body: measured v_c of {len(points)} whose bracket misses the full-slip value"
    yield Check(name, sum(not p.in_bracket for p in points), 0, 0, why)
    name = f"with a body: measured v_c over the full-slip value, worst of {len(points)} ({off.where})"
    yield Check(name, 1 + off.miss, 1.0, 1e-4, "what a measurement promises")
    name = f"with a body: least measured v_c over Eq. (15) ({least.where})"
    yield Check.at_most(name, 1 + least.deviation, 0.5, "Eq. (15) is off by far more than the measurement")


# --- figures ---


@figure("rigid", 1, 2, size=(9.6, 4.2))
def _rigid_figure(fig, axes, points: list[Point]):
    """Left: critical velocity over Eq. (1), flat at one and falling beyond an amplitude that is smaller for slower
    materials. Right: the two limits in the plane of amplitude and relaxation time.

    Rigid pull, any shape. Left: v_c over Eq. (1) against amplitude, measured (symbols) and sin|φ_c| of the phase at
    which the centre touches again (lines); an elastic contact stays at 1. Right: where contact is lost (dotted) nothing
    happens to v_c; Eq. (1) holds through the shaded region and ends at the full line, {limit:.1f}/ωτ for slow
    materials, above which the surface is not back when the depth grows fastest.
    """
    ax, where = axes
    colours = dict(zip(TIMES, (COLOURS[6], *COLOURS), strict=False))
    alphas, times = np.geomspace(0.01, 2, 160), np.geomspace(0.1, 300, 200)
    for T, colour in colours.items():
        law = [laws.late_return(1 / alpha, T) for alpha in alphas]
        ax.plot(alphas, law, color=colour, label=rf"$\omega\tau={T:g}$")
    for p in points:
        size = 5 + 2 * list(SHAPES).index(p.shape)
        ax.plot(p.alpha, p.over_rigid, LOOKS[p.shape][1], mfc="none", mec=colours[p.T], ms=size)
    for shape in dict.fromkeys(p.shape for p in points):
        ax.plot([], [], LOOKS[shape][1], mfc="none", mec="0.3", label=shape_label(shape))
    small = {"loc": "lower left", "fontsize": 8}
    panel(ax, r"amplitude $\Delta u_z/u_{z0}$", "$v_c$ over Eq. (1)", log="x", legend=small, ylim=(0.3, 1.05))
    ax.set_xticks([0.01, 0.1, 1], ["0.01", "0.1", "1"])
    lost, end = 1 / np.hypot(1, times), np.array([laws.amplitude_limit(T) for T in times])
    where.plot(times, lost, color="0.3", ls=":", label="contact is lost, Eq. (5)")
    where.plot(times, end, color=COLOURS[0], label=r"Eq. (1) ends, $\alpha_1$")
    where.fill_between(times, lost, np.minimum(end, 10), color=COLOURS[0], alpha=0.12, lw=0)
    panel(where, r"$\omega\tau$", r"amplitude $\Delta u_z/u_{z0}$", log="xy", legend=small)
    where.set(ylim=(3e-3, 10), xlim=(times[0], times[-1]))
    where.text(0.16, 0.03, "kept: Eq. (1)", fontsize=9)
    where.text(0.16, 2.4, "lost, back in time:\nEq. (1)", fontsize=9)
    where.text(60, 1.6, "back late:\nEq. (1) sin|$\\varphi_c$|", fontsize=9, ha="center", va="center")
    return {"limit": laws.slow_limit()}


@figure("onset", 1, 2, size=(9.6, 4.2), sharey=True)
def _onset_figure(fig, axes, effort: str):
    """Log-log plots of the deviation from Eq. (15) over the excess amplitude, slope three halves and two.

    A flat punch under mass and spring leaves Eq. (15) when its contact is lost, α √(1 + (ωτ)²) = 1 + ε. Full-slip
    values (symbols) and the law (*), nothing fitted (lines): the missing pull costs ε^{{3/2}} if elastic; if
    viscoelastic it is repaid before the contact returns, and ε^2 is left.
    """
    eps, law = np.geomspace(1e-7, 1, 15 if effort == "quick" else 29), np.geomspace(1e-7, 1, 2)
    for ax, T in zip(axes, (0.0, 1.0), strict=True):
        for colour, mark, ratio in zip(COLOURS, "os^", RATIOS, strict=False):
            values = np.array([abs(_punch(float(e), T, ratio)) for e in eps])
            seen = values > 1e-11
            ax.plot(law, [abs(laws.onset(lost_punch(e, T, ratio))) for e in law], color=colour, lw=1.1)
            label = rf"$\omega_0$ = {ratio:g} $\omega$"
            ax.plot(eps[seen], values[seen], mark, color=colour, mfc="white", label=label)
        ax.set_title(r"elastic: $\varepsilon^{3/2}$" if T == 0 else r"$\omega\tau$ = 1: $\varepsilon^2$")
    panel(axes, r"$\varepsilon$", "|full-slip value over Eq. (15) − 1|", log="xy", ylim=(1e-11, 5))
    axes[0].legend(loc="upper left")


@figure("slow", 1, 3, size=(9.6, 4.4), sharey=True)
def _slow_figure(fig, axes, points: list[Point], effort: str):
    """Critical velocity over relaxation time for three natural frequencies: Eq. (15) rises without end, the
    full-slip value levels off.

    A slow material that loses contact, α = 1, under mass and spring: full-slip v_c (full lines) and what was measured
    (symbols) over half of what one blow gives the body. Eq. (15) (dashed) grows with ωτ; the true v_c levels off at a
    value without τ and nearly without k_x (dotted; a damper of 2 % keeps it a little above), along the law (**) (chain
    line), for either shape.
    """
    times, shapes = np.geomspace(0.3, 1e4, 24 if effort == "quick" else 60), ("flat punch", "cone")
    for ax, ratio in zip(axes, RATIOS, strict=True):
        cases = {shape: [driven(shape, 1.0, float(T), ratio) for T in times] for shape in shapes}
        unit = laws.half_a_blow(cases["cone"][0])
        for shape in shapes:
            colour = LOOKS[shape][0]
            ax.plot(times, [mdr.full_slip_critical_velocity(c) / unit for c in cases[shape]], color=colour)
            slow = [case for case in cases[shape] if case.T > 30]
            ax.plot([c.T for c in slow], [laws.blow(c) / unit for c in slow], color=colour, ls="-.", lw=1)
        ax.plot(times, [mdr.critical_velocity(c) / unit for c in cases["cone"]], color="0.2", ls="--", lw=1)
        ax.axhline(1.0, color="0.5", lw=0.9, ls=":")
        for p in points:
            if (p.alpha, p.pull) == (1.0, ratio):
                colour, mark = LOOKS[p.shape]
                ax.plot(p.T, p.v_c / laws.half_a_blow(p.case), mark, color=colour, ms=7, mec="white")
        ax.set_title(rf"$\omega_0$ = {ratio:g} $\omega$")
    y = r"$v_c$ over $\pi\mu_0 F_N(u_{z0}+\Delta u_z)/(m\omega)$"
    panel(axes, r"$\omega\tau$", y, log="xy", ylim=(0.05, 30))
    handles = [key(shape, color=LOOKS[shape][0]) for shape in shapes]
    for shape in dict.fromkeys(p.shape for p in points if p.alpha == 1.0):
        handles.append(key(f"{shape}, measured", color=LOOKS[shape][0], marker=LOOKS[shape][1], ls=""))
    handles += [key("Eq. (15)", color="0.2", ls="--", lw=1), key("law (**)", color="0.4", ls="-.", lw=1)]
    fig.legend(handles=handles, loc="outside lower center", ncols=len(handles), fontsize=8.5)
