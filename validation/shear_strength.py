"""Faces with a shear strength, |tau| <= tau_0 + mu_0 p, as soft clean faces have it: what is left of v_c.

Tested here: what a flat punch loses, the laws of mdr/closed_forms/laws/strength.py and of full slip
(mdr/closed_forms/full_slip_face.py) beside runs, whether the critical velocity depends on the depth, springs beside the
half-space, on cells and on annuli (half_space/growing.py), and a table of friction of a plastic plate on silicone,
measured without vibration.

The table: a 4 x 4 mm plate of PLA turning on silicone (DragonSkin 10) at 10 mm/s, means over cycles; file
CoF-Measurements.csv of github.com/tolstoys19/Friction-Measurements-Between-PLA-and-Silicone (MIT licence), article
doi 10.1109/LRA.2024.3376975. From 1 N on it was another tribometer.

Symbols: alpha = du_z/u_z0, T = omega tau, v̂ = v_0/((2 tau_0/G*) omega a(u_z0)).
"""

from dataclasses import replace
from functools import cache

import numpy as np

import mdr
from mdr import laws
from mdr.normal.normal_force import contact_radius
from mdr.tools.arrays import Array
from mdr.tools.progress import progress
from validation.cases import DEPTH, OMEGA, POWERS, contact, loss, loss_label
from validation.figures import COLOURS, figure, panel
from validation.half_space import growing
from validation.measured import TOLERANCE, measured, power
from validation.report import Check, Checks, Claim, Equation, told

TAU_0 = 1e4  #: shear strength [Pa]
FALLING = (0.5, 4.0)  #: v̂ of the tail, times n of a face r^n: so fast does the edge move
VISCOUS = (  # shape, alpha, T, mu_0
    ("paraboloid", 0.3, 0.5, 0.0), ("cone", 0.3, 2.0, 0.0), ("r^4", 0.6, 1.0, 0.2), ("paraboloid", 1.5, 1.0, 0.2),
    ("cone", 0.1, 0.3, 0.0), ("cone", 1.2, 0.5, 0.1), ("r^4", 0.2, 3.0, 0.0), ("paraboloid", 0.05, 5.0, 0.0),
    ("paraboloid", 0.8, 0.2, 0.5), ("r^4", 1.4, 2.0, 0.0), ("cone", 0.7, 1.0, 0.3), ("flat punch", 1.5, 1.0, 0.0),
)  # fmt: skip
IN_SPACE = (("paraboloid", 0.3, 0.15), ("cone", 0.5, 0.1), ("paraboloid", 0.8, 0.5))  # shape, alpha, v̂
PHASES = 8192  #: at which annuli are told the radius of contact
ENDING = (0.45, 0.6)  #: v̂ at which the exponential law is met, alpha = 0.5
LOADS = np.array([0.01, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7])  #: of the table [N]
OVER_LOAD = np.array([2.13, 2.76, 2.51, 2.02, 1.70, 1.42, 1.22])  #: friction over load there
SPREAD = np.array([0.26, 0.10, 0.10, 0.07, 0.06, 0.07, 0.03])  #: between cycles
PLATE = 16e-6  #: its area [m²]
FIXED = (3, 5)  #: the two loads that fix mu_0 and tau_0


def strong(shape: str, alpha: float, T: float = 0.0, mu_0: float = 0.0, u_z0: float = DEPTH) -> mdr.SlidingContact:
    """One of the shapes with a shear strength."""
    return replace(contact(shape, alpha, T, u_z0=u_z0, mu_0=mu_0 or 0.5, nu=0.4), mu_0=mu_0, tau_0=TAU_0)


def unit_of(case: mdr.SlidingContact) -> float:
    """(2 tau_0/G*) omega a(u_z0) [m/s]."""
    a = float(case.indenter.contact_radius(case.oscillation.u_z0))
    return 2 * case.tau_0 / case.material.G_star * case.omega * a


def claim(effort: str) -> Claim:
    """The critical velocity does not depend on the indentation, on faces with a shear strength too

    How: Add tau_0 to the limit of friction of every spring, and ask again.

    Quote: As the obtained results do not depend on the indentation, we can conclude that they will be valid for quite
    general contacts. (Abstract, in short)

    Range: |τ| ≤ τ_0 + μ_0 p, τ_0 = 10 kPa on rubber; flat punch, cone, paraboloid, r^4; elastic and ωτ from 0.2 to 5;
    μ_0 from 0 to 0.5; contact kept and lost; rigid pull. {n_viscous} measured critical velocities, {n_space} contacts
    in three dimensions, one table of friction without vibration.

    Measured: On a flat punch that keeps contact τ_0 adds the same to every limit: what vibration takes is what it takes
    of Coulomb's part, and v_c is that of Eqs. (1) and (15). A curved elastic face has no critical velocity. The limit
    of a spring that the edge of contact has just reached grows like the root of time, faster than any pull, so that it
    sticks; friction comes back like v_0^-3. The velocity at which all but 1 % is back goes with u_z0 to the power
    {of_depth:.2f} at a fixed amplitude, under a paraboloid: the deeper the contact, the slower. On a dashpot the
    critical velocity is back. By springs it is 2 τ_0 ω/G* times the root of Δu_z and of the slope of a^2 over u_z,
    times a function of ωτ, which falls by a factor of {by_tau:.2f} from ωτ = 0.5 to 2. So with twice the depth it is
    the same under a paraboloid, {of_cone:.2f} of it under a cone and {of_fourth:.2f} under r^4. But with a shear
    strength springs are no half-space, not even without coupling: where an edge grows, the surface of a half-space
    moves as fast as a logarithm has it, and springs as a root. Friction differs by up to {off_space:.1f} % of the full
    one. The velocity at which it is full differs more. What an elastic half-space lacks falls exponentially. On a
    viscous one v_c of the paraboloid with α = 0.1, ωτ = 0.5 is {of_space:.2f} of that of springs, and at twice the
    depth {of_ball:.2f} of itself: it depends on the depth. Of the table two loads fix μ_0 = {mu_0:.2f} and τ_0 =
    {tau_0:.1f} kPa; they meet the loads of 0.3 and 0.7 N to {met:.2f}, and miss below 0.2 N, where the plate may not
    touch with all of its face, and from 1 N on, where another tribometer was used. Another silicone does not follow
    such a law at all. A rig could tell the two laws apart, at the same friction without vibration, in {told_apart:.0f}
    % of the map of amplitude and velocity, where they differ by more than ten per cent.

    Verdict: fails when the face is curved: elastic ones have no v_c, that of viscous ones depends on depth

    Sentence: With a shear strength a curved elastic face has no v_c. That of a viscous one depends on the depth, and is
    lower than springs have it. A flat punch keeps Eqs. (1) and (15).
    """
    quick = effort == "quick"
    chosen = VISCOUS[: 1 if quick else None]
    points = [
        measured(strong(*one), f"{one[0]}, α = {one[1]:g}, {loss(one[2])}, μ_0 = {one[3]:g}")
        for one in progress(chosen, "shear_strength")
    ]
    depths = DEPTH * np.array([0.5, 1.0, 2.0])
    back = [laws.velocity_of_share(strong("paraboloid", 0.1 * DEPTH / d, u_z0=d), 0.99) for d in depths]
    of_depth = power(depths, back)
    by_tau = _full("paraboloid", 0.3, 0.5) / _full("paraboloid", 0.3, 2.0)
    of_cone, of_fourth = _twice_as_deep("cone"), _twice_as_deep("r^4")
    mu_0, strength = _of_the_table()
    tau_0 = 1e-3 * strength / PLATE
    met = np.abs(mu_0 + strength / LOADS - OVER_LOAD)[[4, 6]].max()
    space = [_in_space(*one, cells=24 if quick else 48) for one in IN_SPACE[: 1 if quick else None]]
    off_space = 100 * max(abs(springs - annuli) for springs, annuli, *_ in space)
    shallow = laws.full_slip_of_half_space(strong("paraboloid", 0.1, 0.5))
    deep = laws.full_slip_of_half_space(strong("paraboloid", 0.05, 0.5, u_z0=2 * DEPTH))
    of_space, of_ball = shallow / _full("paraboloid", 0.1, 0.5), deep / shallow
    apart, n_viscous, n_space = _apart(4 if quick else 14), len(chosen), len(space)
    told_apart = 100 * float(np.mean(np.abs(apart[2]) > 0.1))
    checks = (
        *_punch_checks(), *_static_checks(), *_tail_checks(1 if quick else None), *_end_checks(points),
        *_depth_checks(of_depth), *_table_checks(), *_space_checks(space),
        *_logarithm_checks(of_ball, 1 if quick else None),
    )  # fmt: skip
    return Claim(
        **told(claim, locals()),
        checks=checks,
        figures=(_tail_figure(quick), _apart_figure(apart)),
        equations=_EQUATIONS,
    )


_EQUATIONS = (
    Equation(
        "limit",
        r"\mu_0 f_z + 2 \tau_0 \sqrt{a(t)^2 - x^2} dx",
        "The limit of friction of a spring at x, a(t) the radius of contact at that instant.",
    ),
    Equation(
        "tail",
        r"1 - \frac{F_x}{F_{full}} \to \frac{2}{9\pi^2} \left(\frac{\alpha}{\hat{v}}\right)^3",
        "An elastic paraboloid, μ_0 = 0, small α; for any shape <code>mdr.laws.lost_at_the_edge</code>.",
    ),
)


def _full(shape: str, alpha: float, T: float, u_z0: float = DEPTH) -> float:
    return mdr.full_slip_critical_velocity(strong(shape, alpha, T, u_z0=u_z0))


def _of_the_table() -> Array:
    """mu_0, and tau_0 times the area [N], from the two loads that fix them."""
    at = list(FIXED)
    return np.linalg.solve(np.column_stack([np.ones(2), 1 / LOADS[at]]), OVER_LOAD[at])


# --- checks ---


def _punch_checks() -> Checks:
    knobs = {"n_springs": 64, "steps_per_period": 128, "n_periods": 40}  # marched, not searched for
    for T in (0.0, 1.0):
        plain = contact("flat punch", 0.3, T, nu=0.4)
        both = plain, replace(plain, tau_0=TAU_0)
        one, two = (mdr.slide(case, 0.4 * plain.unit_velocity, **knobs) for case in both)
        lost, with_strength = ((run.full_cof - run.cof) * run.mean_F_z for run in (one, two))
        name = f"flat punch, {loss(T)}: force that is lost less that without τ_0, over all friction"
        yield Check(name, (with_strength - lost) / (two.full_cof * two.mean_F_z), 0.0, 1e-12, "rounding")
        v_c = mdr.critical_velocity(both[1]) / mdr.critical_velocity(plain)
        yield Check(f"flat punch, {loss(T)}: v_c over that without τ_0", v_c, 1.0, 1e-14, "rounding")


def _static_checks() -> Checks:
    for shape in ("cone", "paraboloid", "r^4"):
        case = strong(shape, 0.3, mu_0=0.2)
        depth = case.oscillation.u_z0 * (1 + 0.3 * np.cos(2 * np.pi * np.arange(256) / 256))
        F = case.indenter.force(depth, case.material.E_star)
        A = np.pi * np.asarray(case.indenter.contact_radius(depth)) ** 2
        known = (case.mu_0 * F.min() + case.tau_0 * A.min()) / F.mean()
        why = "least depth on an instant, means of smooth periodic functions"
        name = f"static COF, {shape}: (μ_0 F + τ_0 A) at the least depth over ⟨F⟩"
        yield Check(name, mdr.static_cof(case), known, 1e-9, why)
        slow = mdr.slide(case, 1e-5 * case.unit_velocity, accuracy=1e-6)
        why = "its error, and what a pull adds in proportion to v_0"
        yield Check(f"a slow run beside it, {shape}", slow.cof, known, slow.cof_error + 1e-4 * known, why)


@cache
def _tail(shape: str, mu_0: float) -> tuple[Array, Array, Array]:
    """v̂, what runs lose, and the law."""
    case = strong(shape, 0.3, mu_0=mu_0)
    v = unit_of(case) * np.array(FALLING) / POWERS[shape] + mu_0 * case.material.mindlin_ratio * OMEGA * 0.3 * DEPTH
    lost = np.array([1 - mdr.slide(case, one, accuracy=1e-8).share for one in v])
    return np.array(FALLING) / POWERS[shape], lost, np.array([laws.lost_at_the_edge(case, one) for one in v])


def _tail_checks(n: int | None) -> Checks:
    for shape, mu_0 in (("paraboloid", 0.2), ("paraboloid", 0.0), ("cone", 0.0), ("r^4", 0.0))[:n]:
        v, lost, law = _tail(shape, mu_0)
        miss = np.abs(lost / law - 1)
        name = f"lost at v̂ = {v[1]:.3g} over the law, {shape}, μ_0 = {mu_0:g}"
        yield Check(name, lost[1] / law[1], 1.0, 0.02, "next order in 1/v̂; 1e-8 of friction in the run")
        name = f"its miss at v̂ = {v[1]:.3g} over that at {v[0]:.3g}, {shape}, μ_0 = {mu_0:g}"
        yield Check.at_most(name, miss[1] / miss[0], 0.3, "falls with v̂, and 1e-8 of friction in the run")
    alpha = 0.02
    case = strong("paraboloid", alpha)
    closed = 2 / (9 * np.pi**2) * alpha**3
    name = "the law at v̂ = 1 over (2/9π²) α³, paraboloid, α = 0.02"
    yield Check(name, laws.lost_at_the_edge(case, unit_of(case)) / closed, 1.0, 2 * alpha**2, "of second order in α")
    case = strong("paraboloid", 0.3)
    fast = mdr.slide(case, 10 * unit_of(case), n_springs=256, steps_per_period=512)
    yield Check.at_least("share of stick at v̂ = 10, paraboloid", fast.stick_share, 1e-8, "springs at the edge")
    v_c = mdr.critical_velocity(strong("cone", 0.3))
    yield Check("critical velocity of a curved elastic face", v_c, np.inf, 0.0, "none")


def _end_checks(points) -> Checks:
    for point in points:
        why = "bracket of the measurement, steps and springs; 1e-3 asked"
        yield Check(f"measured v_c over full slip, {point.where}", 1 + point.miss, 1.0, max(TOLERANCE, 5e-4), why)


def _depth_checks(of_depth: float) -> Checks:
    name = "power of u_z0 in the velocity of all but 1 %, elastic paraboloid"
    yield Check(name, of_depth, -0.5, 0.05, "small amplitudes")
    why = "a² − x² of a paraboloid knows the depth above its mean alone"
    yield Check("full slip at twice the depth, paraboloid, ωτ = 0.5", _twice_as_deep("paraboloid"), 1.0, 1e-9, why)
    for shape, root in (("cone", 0.5), ("r^4", -0.25)):
        name = f"the same, {shape}, over the root of d(a²)/du_z"
        yield Check(name, _twice_as_deep(shape) / 2**root, 1.0, 0.1 * 0.3, "of second order in α, 0.3 and 0.15")
    by_amplitude = _full("paraboloid", 0.3, 0.5) / _full("paraboloid", 0.1, 0.5)
    yield Check("full slip at three times the amplitude, paraboloid", by_amplitude, np.sqrt(3), 1e-9, "its root")


def _twice_as_deep(shape: str) -> float:
    """Velocity of full slip at twice the depth and the same amplitude, over that of the depth; ωτ = 0.5."""
    return _full(shape, 0.15, 0.5, u_z0=2 * DEPTH) / _full(shape, 0.3, 0.5)


def _table_checks() -> Checks:
    mu_0, strength = _of_the_table()
    for i in (4, 6):
        off = mu_0 + strength / LOADS[i] - OVER_LOAD[i]
        error = 3 * float(np.hypot(SPREAD[i], SPREAD[list(FIXED)].max()))
        yield Check(f"friction over load at {LOADS[i]:g} N, predicted less measured", off, 0.0, error, "three spreads")
    off = mu_0 + strength / LOADS[0] - OVER_LOAD[0]
    yield Check.at_least("the same at 0.01 N, where the law misses", off / SPREAD[0], 10.0, "spreads between cycles")


@cache
def _annuli(shape: str, alpha: float, v: float, T: float = 0.0, n: int = 300) -> float:
    """What annuli lose of the friction of full slip at v̂ and mu_0 = 0, as their width goes to zero."""
    case = strong(shape, alpha, T)
    a = contact_radius(case, 2 * np.pi * np.arange(PHASES) / PHASES)
    pull = 2 * v * float(case.indenter.contact_radius(case.oscillation.u_z0))
    return 2 * growing.lost(a, pull, T, n) - growing.lost(a, pull, T, n // 2)


def _in_space(shape: str, alpha: float, v: float, cells: int) -> tuple[float, float, float, float, str]:
    """Share of full friction by springs, annuli and cells, the error of cells, and where."""
    case = strong(shape, alpha)
    at = v * unit_of(case)
    springs, space = mdr.slide(case, at), mdr.half_space.slide(case, at, coupled=False, cells=cells)
    full, where = springs.full_cof, f"{shape}, α = {alpha:g}, v̂ = {v:g}"
    return springs.share, 1 - _annuli(shape, alpha, v), space.cof / full, space.cof_error / full, where


def _space_checks(space: list[tuple[float, float, float, float, str]]) -> Checks:
    for springs, annuli, cells, error, where in space:
        why = "the error of cells, and ν = 0.4 beside 0"
        yield Check(f"cells less annuli, over full slip, {where}", cells - annuli, 0.0, error + 2e-3, why)
        why = "springs are no half-space where an edge grows"
        yield Check.at_most(f"springs less annuli, over full slip, {where}", abs(springs - annuli), 0.03, why)


def _logarithm_checks(of_ball: float, n: int | None) -> Checks:
    """A half-space beside its own laws."""
    case = strong("paraboloid", 0.5)
    law = [laws.lost_at_the_edge(case, v * unit_of(case), half_space=True) for v in ENDING]
    miss = [abs(_annuli("paraboloid", 0.5, v, n=800) / one - 1) for v, one in zip(ENDING, law, strict=True)]
    name = f"lost by annuli over the exponential law, less one, v̂ = {ENDING[1]:g}, α = 0.5"
    yield Check.at_most(name, miss[1], 0.06, "next order in the width of the ring, which it comes to")
    yield Check.at_most(f"the same over that at v̂ = {ENDING[0]:g}", miss[1] / miss[0], 0.8, "it falls")
    for shape in ("paraboloid", "cone", "r^4")[:n]:
        case = strong(shape, 0.3, 0.5)
        v_c = laws.full_slip_of_half_space(case) / unit_of(case)
        slips, sticks = (_annuli(shape, 0.3, share * v_c, 0.5) for share in (1.01, 0.95))
        why = "nothing is lost above full slip"
        yield Check(f"lost by viscous annuli at 1.01 of their full slip, {shape}", slips, 0.0, 1e-12, why)
        yield Check.at_least(f"the same at 0.95 of it, {shape}", sticks, 1e-5, "some annuli stick")
    why = "one over the root of it, and a logarithm"
    yield Check("full slip of a half-space at twice the depth, paraboloid, ωτ = 0.5", of_ball, 0.75, 0.05, why)


# --- which law? ---


def _apart(n: int) -> tuple[Array, Array, Array]:
    """alpha, v over mu omega kappa u_z0, and by how much of friction shear strength and Coulomb differ (n_v, n_alpha).

    Both have the same friction without vibration.
    """
    alphas, v = np.linspace(0.05, 0.95, n), np.linspace(0.05, 1.2, n)
    apart = np.empty((n, n))
    for j, alpha in enumerate(alphas):
        shear = strong("paraboloid", float(alpha))
        mu_0 = _mu_of(shear)
        plain = replace(shear, mu_0=mu_0, tau_0=0.0)
        at = v * mu_0 * shear.material.mindlin_ratio * OMEGA * DEPTH
        share = np.array([mdr.slide(shear, one, accuracy=1e-4).share for one in at])
        apart[:, j] = share - mdr.cof_curve(plain, at).cof / mu_0
    return alphas, v, apart


def _mu_of(case: mdr.SlidingContact) -> float:
    """Friction over load without vibration."""
    d = case.oscillation.u_z0
    area = np.pi * float(case.indenter.contact_radius(d)) ** 2
    return case.mu_0 + case.tau_0 * area / float(case.indenter.force(d, case.material.E_star))


# --- figures ---


@figure("tail", size=(6.6, 4.2))
def _tail_figure(fig, ax, quick: bool):
    """Double logarithmic plot of lost friction over velocity: straight for elastic springs, bent for a half-space.

    Share of friction that vibration takes from a paraboloid with a shear strength alone, Δu_z/u_z0 = 0.3, by springs
    (dots) and on a half-space without coupling (lines). By elastic springs it falls like v̂^-3 (dashed) and never ends,
    on the half-space it falls exponentially. On a viscous material it ends, at the velocity of full slip (dotted for
    springs), which falls with the relaxation time; the half-space slips all over from a lower one on.
    """
    v = np.geomspace(0.05, 8, 5 if quick else 25)
    for T, colour in zip((0.0, 0.5, 2.0), COLOURS, strict=False):
        case = strong("paraboloid", 0.3, T)
        unit, end = unit_of(case), mdr.full_slip_critical_velocity(case)
        at = v if np.isinf(end) else np.geomspace(v[0], 0.98 * end / unit, v.size // 2)
        lost = np.array([1 - mdr.slide(case, one * unit, accuracy=1e-5 if quick else 1e-6).share for one in at])
        seen = lost > 1e-6
        ax.plot(at[seen], lost[seen], "o", ms=3.5, color=colour, label=loss_label(T))
        last = 0.45 if np.isinf(end) else 0.97 * laws.full_slip_of_half_space(case) / unit
        near = np.linspace(v[0], last, v.size)
        n = 80 if quick else 300
        ax.plot(near, [_annuli("paraboloid", 0.3, float(one), T, n) for one in near], color=colour, lw=1.2)
        if np.isfinite(end):
            ax.axvline(end / unit, color=colour, ls=":", lw=1.2)
    tail = v[v > 0.3]
    law, label = 2 / (9 * np.pi**2) * (0.3 / tail) ** 3, r"$\frac{2}{9\pi^2}(\alpha/\hat v)^3$"
    ax.plot(tail, law, color="0.3", ls="--", lw=1, label=label)
    x = r"velocity $\hat v = v_0/((2\tau_0/G^*)\,\omega a)$"
    panel(ax, x, "share of friction that is lost", log="xy", legend="lower left")


@figure("apart", size=(6.0, 4.4))
def _apart_figure(fig, ax, apart: tuple[Array, Array, Array]):
    """Map of amplitude and velocity, coloured by the difference of two laws of friction, with lines at ten per cent.

    Friction of an elastic paraboloid with a shear strength alone, less that of one by Coulomb's law with the same
    friction without vibration, as a share of it. Below the long line they differ by more than ten per cent. Load and
    stiffness enter through the unit of velocity alone.
    """
    alphas, v, off = apart
    most = np.ceil(20 * np.abs(off).max()) / 20
    image = ax.contourf(alphas, v, off, levels=np.linspace(-most, most, 41), cmap="RdBu_r")
    ax.contour(alphas, v, off, levels=[-0.1, 0.1], colors="k", linewidths=1)
    fig.colorbar(image, ax=ax, label="shear strength less Coulomb")
    panel(ax, r"amplitude $\Delta u_z/u_{z0}$", r"velocity $v_0/(\mu\kappa\omega u_{z0})$")
