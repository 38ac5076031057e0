"""Two maps, each a study of the library: v_c over frequency and damping, and friction over velocity and amplitude.

The first is Eq. (15) of a body on a paraboloid, over Eq. (1), in the plane of omega/omega_0 and omega_0 tau. Its ridge
is the resonance of the body on its spring, its valley that of the body on spring and contact, where an elastic contact
drives the body just as the stick limit moves; dashpots fill the valley. Above both the body stands still, and v_c is
that of the rigid pull.

The second is mu/mu_0 in the plane of v_0/v_c, v_c of Eq. (15), and alpha = du_z/u_z0, once for a rigid pull in closed
form and once for a body, velocity by velocity. Friction is full from the full-slip v_c on and reduced below it, with
the contact kept or lost; for a body that line leaves Eq. (15) as the amplitude grows.

What a designer reads off it, under a rigid pull and for any shape and loss tangent: the least amplitude that halves
friction at rest, and the greatest v_0/v_c at which any amplitude still halves it.

Symbols: omega_0² = k_x/m, k_xc tangential contact stiffness at u_z0, T = omega tau, zeta share of critical damping.
"""

from dataclasses import dataclass, replace

import numpy as np

import mdr
from validation.cases import LOOKS, OMEGA, SHAPES, contact, shape_label
from validation.figures import figure, ticks
from validation.measured import TOLERANCE, Point, measured
from validation.report import Check, Checks, Claim, told
from validation.words import number, span

SMALL = 0.003  #: alpha of the first map
ZETA, STIFFNESS = 0.02, 2.0  #: damping of the body, k_x over k_xc
BODY = contact("paraboloid", SMALL, 0.1, k_ratio=STIFFNESS, omega_0_ratio=1.0, damping_ratio=ZETA)
RIGID = contact("paraboloid", SMALL, 0.3)
LIGHT = contact("paraboloid", SMALL, 0.3, k_ratio=1.0, omega_0_ratio=1.9, damping_ratio=0.1)
KNOBS = {"n_springs": 96, "steps_per_period": 256}  #: of the marched map
EQ_1 = mdr.Quantity("eq_1", "m/s", lambda case: case.unit_velocity, "Eq. (1)")
LOSSES = (0.0, 0.1, 0.3, 1.0, 3.0, 10.0)  #: T of the control by half
POINTS = ((0.3, 0.03), (1.0, 0.03), (1.22, 0.02), (1.22, 1.0), (2.0, 0.1), (4.0, 10.0))  #: omega/omega_0, omega_0 tau


def claim(effort: str) -> Claim:
    """Friction is reduced below the critical velocity and full above it, everywhere on the map

    How: Compute the two maps and look at every point of them.

    Quote: The velocity-dependences all start from the static value at vanishing velocity. Second, the coefficient of
    friction increases monotonically (again, barring exceptional system-dynamical circumstances) until it reaches the
    microscopic value at some critical velocity. (Section 3)

    Range: Paraboloid. Eq. (15) at {of_v_c[v_c].size} points, ω/ω_0 from 0.1 to 10 and ω_0 τ from 0.01 to 100, and
    {n_points} measured; friction at {rigid[cof].size} points under a rigid pull and {body[cof].size} of a body (k_x =
    k_x,c, ω_0 = 1.9 ω), v_0/v_c from 0 to 1.3, Δu_z/u_z0 from 0.05 to 1.6, the contact kept and lost.

    Measured: v_c of a body lies between {least_v_c} and {most_v_c} times Eq. (1), by frequency more than by anything
    else. Friction rises along every line of velocity, from its static value to μ_0, which it reaches at the full-slip
    v_c: under a rigid pull at Eq. (1) for every amplitude, for the body at Eq. (15) for small ones and at down to
    {least:.2f} of it for large. To halve friction at rest takes an amplitude of {amplitudes} of the depth; no amplitude
    halves it beyond {reaches} v_c (four shapes, ωτ from 0 to {greatest_T:g}, rigid pull).

    Verdict: holds

    Sentence: On the maps of a paraboloid friction is reduced at all points below 0.95 of the full-slip v_c and full at
    all points above it. This v_c is Eq. (15) under a rigid pull, or at small amplitude.
    """
    quick = effort == "quick"
    of_v_c = over_frequency(*((25, 13) if quick else (121, 61)))
    n_v, n_alpha = (14, 8) if quick else (40, 30)
    rigid, body = over_velocity(RIGID, 4 * n_v, 2 * n_alpha), over_velocity(LIGHT, n_v, n_alpha)
    places = [place(ratio * OMEGA, loss / OMEGA) for ratio, loss in (POINTS[1::2] if quick else POINTS)]
    points = [measured(case, "") for case in places]
    halves = [half_of(shape, T, quick) for shape in SHAPES for T in (LOSSES[::3] if quick else LOSSES)]
    furthest = [half.reach for half in halves]
    low, high = (float(f(of_v_c["v_c"] / of_v_c["eq_1"])) for f in (np.min, np.max))
    checks = (*_checks_of_cof(rigid, "rigid pull"), *_checks_of_cof(body, "body"))
    least = float(np.nanmin(body["full_slip_v_c"] / body["v_c"]))
    n_points, least_v_c, most_v_c = len(points), number(low), number(high)
    amplitudes, reaches = span((half.at_rest for half in halves), 2), span(furthest, 2)
    greatest_T = max(half.T for half in halves)
    return Claim(
        **told(claim, locals()),
        checks=(*_checks_of_v_c(of_v_c, points), *checks, *_checks_of_half(halves)),
        figures=(_figure_of_v_c(of_v_c, points), _figure_of_cof(rigid, body), _figure_of_half(halves)),
    )


# --- studies ---


def over_frequency(n_omega: int, n_tau: int) -> mdr.Study:
    """v_c over omega/omega_0 from 0.1 to 10 and omega_0 tau from 0.01 to 100."""
    taus, omegas = np.geomspace(0.01, 100, n_tau) / OMEGA, np.geomspace(0.1, 10, n_omega) * OMEGA  # BODY: its omega_0
    return mdr.sweep(BODY, {"material.tau": taus, "oscillation.omega": omegas}, quantities=("v_c", EQ_1))


def over_velocity(case: mdr.SlidingContact, n_v: int, n_alpha: int) -> mdr.Study:
    """COF over v_0/v_c and alpha."""
    axes = {"alpha": np.linspace(0.05, 1.6, n_alpha), "v_0/v_c": np.linspace(0, 1.3, n_v)}
    return mdr.sweep(case, axes, quantities=("cof", "cof_error", "v_c", "full_slip_v_c"), **KNOBS)


def reach_of_half(study: mdr.Study) -> float:
    """Greatest v_0/v_c with half of mu_0 at any amplitude of the study."""
    v = study.axes["v_0/v_c"]
    return max(float(np.interp(0.5 * RIGID.mu_0, row, v)) for row in study["cof"] if row[0] < 0.5 * RIGID.mu_0)


@dataclass(frozen=True)
class Half:
    """What it takes to halve the friction of a shape under a rigid pull."""

    shape: str
    T: float
    at_rest: float  #: alpha that halves the static friction
    reach: float  #: greatest v_0/v_c at which some alpha halves it


def half_of(shape: str, T: float, coarse: bool) -> Half:
    """Half the friction at rest, by its closed form, and in motion, over amplitudes from 0.02 to 20 of the depth."""
    from scipy.optimize import brentq

    def excess(alpha: float) -> float:
        case = contact(shape, alpha, T)
        return mdr.static_cof(case) / case.mu_0 - 0.5

    n_alpha, n_v = (16, 31) if coarse else (60, 121)
    axes = {"alpha": np.geomspace(0.02, 20, n_alpha), "v_0/v_c": np.linspace(0, 0.6, n_v)}
    study = mdr.sweep(contact(shape, 0.1, T), axes)
    return Half(shape, T, float(brentq(excess, 1e-3, 2)), reach_of_half(study))


def place(omega: float, tau: float) -> mdr.SlidingContact:
    """The body of the first map at a place of it."""
    material, oscillation = replace(BODY.material, tau=tau), replace(BODY.oscillation, omega=omega)
    return replace(BODY, material=material, oscillation=oscillation)


# --- checks ---


def _checks_of_v_c(study: mdr.Study, points: list[Point]) -> Checks:
    why = "a study computes what the function does"
    tau, omega = study.axes["material.tau"], study.axes["oscillation.omega"]
    some = ((0, 0), (tau.size // 2, omega.size // 2), (-1, -1))
    off = [abs(study["v_c"][i, j] / mdr.critical_velocity(place(omega[j], tau[i])) - 1) for i, j in some]
    name = "v_c in the study against critical_velocity(), two corners and the middle, worst"
    yield Check.at_most(name, max(off), 1e-13, why)
    for p in points:
        where = f"ω/ω_0 = {p.case.oscillation.omega / OMEGA:g}, ω_0 τ = {p.case.material.tau * OMEGA:g}"
        got = p.v_c / mdr.full_slip_critical_velocity(p.case)
        why = "half the bracket of the measurement, and its step to second order"
        yield Check(f"measured v_c over that of full slip: {where}", got, 1.0, TOLERANCE, why)
    why = f"the body moves by (ω_0/ω)² of what a spring would, and its viscous part by T/(k_x/k_x,c) of that: {1e-2:g}"
    got = study["v_c"][0, -1] / study["eq_1"][0, -1]
    yield Check("v_c over Eq. (1) at ω = 10 ω_0, nearly elastic", got, 1.0, 1e-2, why)


def _checks_of_cof(study: mdr.Study, what: str) -> Checks:
    """Reduced below the full-slip v_c, full above it, and never falling; every point computed."""
    mu_0, cof, error = RIGID.mu_0, study["cof"], study["cof_error"]
    v = study.axes["v_0/v_c"] * study["v_c"] / study["full_slip_v_c"]  # over the full-slip v_c
    above, below = v >= 1, v <= 0.95
    excess = (1 - cof / mu_0 - 2 * error / mu_0)[above].max()
    deficit = ((1 - cof / mu_0) / np.maximum(error / mu_0, 1e-12))[below].min()
    fall = (-np.diff(cof, axis=1) / mu_0 - (error[:, 1:] + error[:, :-1]) / mu_0).max()
    bad = int(np.count_nonzero(study.status))
    name = f"{what}: lost friction above the full-slip v_c, less twice its error, greatest"
    yield Check.at_most(name, excess, 0.0, "twice the bound on its own error, by steps of 1/256 of a period")
    name = f"{what}: lost friction up to 0.95 of the full-slip v_c, over its error, least"
    yield Check.at_least(name, deficit, 3.0, "a deficit of three errors is there")
    name = f"{what}: fall of μ/μ_0 from one velocity to the next, less both errors, greatest"
    yield Check.at_most(name, fall, 0.0, "friction never falls with velocity")
    yield Check(f"{what}: points that failed or did not settle", bad, 0.0, 0.0, "all are to be computed")


def _checks_of_half(halves: list[Half]) -> Checks:
    for half in halves:
        if half.shape == "flat punch":
            name = f"amplitude over depth that halves the friction of a flat punch at rest: ωτ = {half.T:g}"
            yield Check(name, half.at_rest, 0.5 / np.hypot(1, half.T), 1e-11, "Eq. (7), and the root to 1e-12")
    why = "a quarter to a third: read off many contacts, no law behind it"
    for which, of in (("least", min), ("greatest", max)):
        half = of(halves, key=lambda one: one.reach)
        name = f"{which} v_0/v_c up to which friction can be halved: {half.shape}, ωτ = {half.T:g}"
        yield Check.between(name, half.reach, 0.25, 0.35, why)


# --- figures ---


@figure("critical_velocity", size=(6.8, 4.4))
def _figure_of_v_c(fig, ax, study: mdr.Study, points: list[Point]):
    """Map of the critical velocity over frequency and relaxation time with a ridge and a valley.

    Eq. (15) over Eq. (1) for a body on a paraboloid, k_x = {stiffness:g} k_x,c, {zeta:g} % of critical damping. The
    ridge at ω = ω_0 is the body on its spring; the valley at ω = 1.22 ω_0 is the body on spring and contact, where
    almost any velocity is too fast to be controlled, and dashpots fill it. To the right the body is too heavy to move,
    and v_c is Eq. (1); to the left a slow body follows the force, which dashpots raise. Circles: where v_c was
    measured.
    """
    tau, omega = study.axes["material.tau"] * OMEGA, study.axes["oscillation.omega"] / OMEGA
    values, levels = study["v_c"] / study["eq_1"], (0.03, 0.1, 0.3, 0.9, 1.1, 3, 10, 20)
    mesh = ax.pcolormesh(omega, tau, values, norm="log", cmap="viridis", rasterized=True, shading="nearest")
    lines = ax.contour(omega, tau, values, levels=levels, colors="white", linewidths=1)
    ax.clabel(lines, fmt="%g", fontsize=9)
    places = [(p.case.oscillation.omega / OMEGA, p.case.material.tau * OMEGA) for p in points]
    ax.plot(*np.transpose(places), "o", mfc="none", mec="w", ms=7, mew=1.6)
    ax.set(xscale="log", yscale="log", xlim=(omega[0], omega[-1]), ylim=(tau[0], tau[-1]))
    ax.set(xlabel=r"frequency $\omega/\omega_0$", ylabel=r"relaxation time $\omega_0\tau$")
    fig.colorbar(mesh, ax=ax, pad=0.02, label="$v_c$ over Eq. (1)").outline.set_visible(False)
    return {"stiffness": STIFFNESS, "zeta": 100 * ZETA}


@figure("friction", 1, 2, size=(11, 4.4), sharey=True)
def _figure_of_cof(fig, axes, rigid: mdr.Study, body: mdr.Study):
    """Two maps of friction over velocity and amplitude with the line on which it becomes full.

    μ (μ_0 = 0.5) over velocity and amplitude, a paraboloid, ωτ = 0.3. Dashed, v_c: Eq. (15). Orange: the full-slip v_c,
    to the right of which friction is full. Under a rigid pull it is v_c of Eq. (1) at every amplitude; for a body (ω_0
    = 1.9 ω) it bends away from Eq. (15), as the second harmonic of the force grows, which is near the resonance.
    Dotted: above it the contact is lost in every period. To halve friction takes an amplitude of about a third of the
    depth; with more of it half lasts up to {reach:.2f} v_c, but no amplitude takes it further.
    """
    for ax, study, title in zip(axes, (rigid, body), ("rigid pull", "body on a spring"), strict=True):
        levels = RIGID.mu_0 * np.array([0.25, 0.5, 0.75, 0.9])
        study.plot_map("cof", "v_0/v_c", ax, levels=levels, limits=(0, RIGID.mu_0), colorbar=ax is axes[-1])
        ax.plot((study["full_slip_v_c"] / study["v_c"])[:, 0], study.axes["alpha"], color="#D55E00", lw=2)
        ax.axhline(1 / np.hypot(1, 0.3), color="w", lw=1, ls=":")
        ax.set_title(title)
    axes[1].set_ylabel("")
    return {"reach": reach_of_half(rigid)}


@figure("half", 1, 2, size=(10, 4))
def _figure_of_half(fig, axes, halves: list[Half]):
    """Two panels over the loss tangent: the amplitude for half the static friction, and the velocity with half.

    Rigid pull. Left: the amplitude, over the depth, that halves friction at rest; dashpots lower it as they unload the
    contact on its way up. Right: how fast the contact may slide for any amplitude to halve its friction: up to a
    quarter to a third of v_c, whatever the shape, given the amplitude. The best one is one to three times that at which
    contact is first lost; more raises v_c, but the share with half the friction falls.
    """
    rest, motion = axes
    for shape, (colour, marker) in LOOKS.items():
        own = [half for half in halves if half.shape == shape]
        T = [max(half.T, 0.03) for half in own]
        look = {"color": colour, "marker": marker, "label": shape_label(shape)}
        rest.plot(T, [half.at_rest for half in own], **look)
        motion.plot(T, [half.reach for half in own], **look)
    for ax in (rest, motion):
        ax.set(xscale="log", xlabel=r"loss tangent $\omega\tau$")
        ax.set_xticks([0.03, 0.1, 1, 10], ["0", "0.1", "1", "10"])
    rest.set(yscale="log", ylabel=r"amplitude $\alpha$ that halves static friction")
    motion.set(ylim=(0, 0.4), ylabel="greatest $v_0/v_c$ with half the friction")
    ticks(rest.yaxis, 0.03, 0.1, 0.3, 0.5)
    rest.legend()
