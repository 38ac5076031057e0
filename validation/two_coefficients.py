"""A static coefficient of friction above the kinetic one: does v_c know it, and does vibration then raise friction?

A spring sticks up to mu_s times its normal force, and slips at mu_k times it. What is known beforehand: springs that
keep contact under a rigid pull (`mdr.laws.falling_friction`), and from which velocity on nothing sticks
(mdr/closed_forms/full_slip_body.py). Both are met by runs here.

Symbols: alpha = du_z/u_z0, T = omega tau, stick = mu_s/mu_k, v over v_c by Eq. (1) or (15) with mu_k.
"""

from dataclasses import replace

import numpy as np

import mdr
from mdr.tools.arrays import Array
from mdr.tools.progress import progress
from validation.cases import BODY, contact, loss, shape_label
from validation.figures import COLOURS, figure, panel
from validation.measured import SHARP, measured
from validation.report import Check, Checks, Claim, told

STICK = 1.5  #: mu_s/mu_k of the figures
ENDS = (  # shape, alpha, T, mu_s/mu_k, whether a body is pulled
    ("paraboloid", 0.3, 0.0, 1.5, False), ("cone", 1.3, 0.3, 1.3, False), ("flat punch", 1.4, 2.0, 1.6, False),
    ("paraboloid", 0.4, 3.0, 1.5, False), ("cone", 0.3, 0.0, 1.5, True), ("flat punch", 0.4, 0.5, 2.0, True),
    ("r^4", 0.6, 0.0, 1.2, False), ("paraboloid", 1.2, 0.5, 1.8, True), ("flat punch", 1.3, 0.0, 1.6, False),
    ("cone", 0.5, 2.0, 1.4, True),
)  # fmt: skip
PUNCHES = ((0.4, 0.0, 1.5, False), (0.2, 0.8, 1.8, False), (0.3, 0.0, 1.3, True))  #: alpha, T, mu_s/mu_k, body
JUMPS = ((0.05, 1.2), (0.4, 1.5), (0.95, 2.0), (0.2, 1.05), (0.7, 1.8), (0.05, 2.0))  #: alpha, mu_s/mu_k
KNOBS = {"n_springs": 128, "steps_per_period": 512}
WITHIN = 1e-3  #: to which the end of stick is sought
BESIDE = 1e-6  #: of v_c, at which runs meet the jump; 4096 steps of a period tell as much


def falling(shape: str, alpha: float, stick: float = STICK, T: float = 0.0, **groups: float) -> mdr.SlidingContact:
    """One of the shapes whose static coefficient is so many times the kinetic one."""
    case = contact(shape, alpha, T, nu=0.4, **groups)
    return replace(case, friction=mdr.StaticKinetic(stick * case.mu_0, case.mu_0))


def claim(effort: str) -> Claim:
    """The critical velocity is that of the kinetic coefficient, and above it vibration does nothing

    How: Bisect for the velocity from which nothing sticks; follow friction over velocity and over amplitude.

    Quote: The coefficient of friction increases monotonically … until it reaches the microscopic value at some critical
    velocity. (Section 4, in short)

    Range: μ_s/μ_k from 1.05 to 2; {n_ends} contacts of all four shapes, elastic and ωτ from 0.3 to 3, contact kept
    and lost, rigid pulls and bodies, whose end of stick was sought by runs; {n_punches} flat punches whose v_c was
    measured.

    Measured: Springs that keep contact do not know μ_s: v_c of a flat punch is Eqs. (1) and (15) with μ_k, to
    {punch:.0e}. But friction does not rise to it from below. Just below v_c a spring sticks until it has come to μ_s,
    so that friction is above that of sliding, and on an elastic punch under a rigid pull it falls to it by a jump: by
    {jump:.1f} % for α = 0.4, μ_s/μ_k = 1.5, as the closed form has it. The smaller the amplitude, the nearer the jump
    comes to half of the difference of the two coefficients, as friction then goes from μ_k to μ_s on a line:
    {most:.1f} % of sliding at α = 0.05 and μ_s/μ_k = 2. So friction is no longer below that of sliding from
    {back:.2f} v_c on (α = 0.4). Springs that touch anew in each period, at the edge of a curved face or of a contact
    that is lost, begin in stick, and slip at once from a higher velocity on: that of Eq. (1) with μ_s on an elastic
    face; on a dashpot it is known by how fast top and free surface come together. Runs find it to {end:.0e} on each of
    {n_ends} contacts. Between the two velocities the edge alone holds friction above that of sliding: by at most
    {edge:.1f} % under a paraboloid with α = 0.4. Pulled at one velocity under a growing amplitude, friction first rises
    by a jump, as soon as springs stick at all, and then falls below that of sliding.

    Verdict: holds if v_c is taken with μ_k and contact is kept; just below it friction is above that of sliding

    Sentence: Eq. (15) holds with the kinetic coefficient. Just below v_c vibration raises friction, by up to half of
    the difference to the static one; springs that touch anew stick up to a higher velocity.
    """
    quick = effort == "quick"
    ends = ENDS[: 4 if quick else None]
    found = [_end(*one) for one in progress(ends, "two_coefficients")]
    punches = [_punch(*one) for one in PUNCHES[: 2 if quick else None]]
    n_ends, n_punches = len(ends), len(punches)
    end, punch = max(abs(one - 1) for one in found), max(abs(one - 1) for one in punches)
    jump, most = (100 * (_law(1.0, *one) - 1) for one in ((0.4, 1.5), (0.05, 2.0)))
    v = np.sort(np.append(np.linspace(0.13, 1.63, 26 if quick else 121), (0.9995, 1.0005)))
    curves = {shape: _shares(falling(shape, 0.4), v) for shape in ("flat punch", "cone", "paraboloid")}
    back, edge = float(v[np.argmax(curves["flat punch"] >= 1)]), 100 * float(curves["paraboloid"][v > 1].max() - 1)
    return Claim(
        **told(claim, locals()),
        checks=(
            *_end_checks(ends, found),
            *_punch_checks(punches),
            *_jump_checks(JUMPS[: 3 if quick else None]),
            *_curve_checks(v, curves),
        ),
        figures=(_curves_figure(v, curves), _amplitude_figure(quick)),
    )


def _body(pulled: bool) -> dict[str, float]:
    return BODY | {"damping_ratio": 0.2} if pulled else {}


def _end(shape: str, alpha: float, T: float, stick: float, pulled: bool) -> float:
    """Velocity from which no spring sticks, by runs alone, over the closed form."""
    case = falling(shape, alpha, stick, T, **_body(pulled))
    low, high = 0.0, 4 * stick * mdr.critical_velocity(case)
    while high - low > WITHIN * high:
        v = 0.5 * (low + high)
        low, high = (low, v) if mdr.slide(case, v, **KNOBS).kind == "full slip" else (v, high)
    return 0.5 * (low + high) / mdr.full_slip_critical_velocity(case)


def _punch(alpha: float, T: float, stick: float, pulled: bool) -> float:
    """v_c measured from runs, over Eq. (15) with the kinetic coefficient."""
    case = falling("flat punch", alpha, stick, T, **_body(pulled))
    return 1 + measured(case, "").deviation


def _law(v: float, alpha: float, stick: float) -> float:
    return mdr.laws.falling_friction(v, alpha, stick).share


def _shares(case: mdr.SlidingContact, v: Array) -> Array:
    """Friction over that of sliding, at velocities over v_c."""
    return mdr.cof_curve(case, v * mdr.critical_velocity(case), accuracy=1e-4).share


# --- checks ---


def _end_checks(ends, found: list[float]) -> Checks:
    for (shape, alpha, T, stick, pulled), one in zip(ends, found, strict=True):
        where = f"{shape}, α = {alpha:g}, {loss(T)}, μ_s/μ_k = {stick:g}, {'body' if pulled else 'rigid'}"
        why = "the last interval of the search, and second order in 512 steps"
        yield Check(f"end of stick by runs over the closed form, {where}", one, 1.0, 2 * WITHIN, why)
    case = falling("paraboloid", 0.3)
    ratio = mdr.full_slip_critical_velocity(case) / mdr.critical_velocity(case)
    yield Check("full slip over Eq. (1), elastic paraboloid", ratio, STICK, 1e-9, "Eq. (1) with μ_s")


def _punch_checks(punches: list[float]) -> Checks:
    for (alpha, T, stick, pulled), one in zip(PUNCHES, punches, strict=False):
        where = f"α = {alpha:g}, {loss(T)}, μ_s/μ_k = {stick:g}, {'body' if pulled else 'rigid'}"
        yield Check(f"measured v_c over Eq. (15) with μ_k, flat punch, {where}", one, 1.0, SHARP, "its bracket")


def _jump_checks(chosen) -> Checks:
    for alpha, stick in chosen:
        case, where = falling("flat punch", alpha, stick), f"flat punch, α = {alpha:g}, μ_s/μ_k = {stick:g}"
        below, above = (
            mdr.slide(case, (1 + side * BESIDE) * mdr.critical_velocity(case), steps_per_period=4096)
            for side in (-1, 1)
        )
        why = "4096 steps miss 2e-7 of the velocity"
        law = _law(1 - BESIDE, alpha, stick)
        name = f"friction over sliding just below v_c, by a run less the law, {where}"
        yield Check(name, below.share - law, 0.0, 1e-8, why)
        yield Check(f"friction over sliding just above v_c, {where}", above.share, 1.0, 1e-12, "full slip")
    law = mdr.laws.falling_friction(1.0, 1e-3, STICK)
    why = "friction goes from μ_k to μ_s on a line, and slips for a part of the last of its periods"
    yield Check("the jump over μ_s/μ_k − 1, α = 0.001", (law.share - 1) / (STICK - 1), 0.5, 1 / law.periods, why)


def _curve_checks(v: Array, curves: dict[str, Array]) -> Checks:
    law = np.array([_law(one, 0.4, STICK) for one in v])
    off = float(np.abs(curves["flat punch"] - law).max())
    yield Check.at_most("curve of the flat punch less the law, at worst", off, 1e-4, "accuracy that was asked for")
    for shape, share in curves.items():
        why = "friction is above that of sliding just below v_c"
        yield Check.at_least(f"greatest friction over sliding below v_c, {shape}", share[v < 1].max(), 1.02, why)
        if shape != "flat punch":
            between = share[(v > 1) & (v < 0.9 * STICK)]
            name = f"least friction over sliding from v_c to 1.35 v_c, {shape}"
            yield Check.at_least(name, between.min(), 1.0001, "springs at the edge")
        yield Check(
            f"friction over sliding from μ_s/μ_k v_c on, {shape}", share[v > STICK].max(), 1.0, 1e-9, "full slip"
        )
    case = falling("paraboloid", 0.4)
    slow = mdr.slide(case, 4e-3 * mdr.critical_velocity(case), accuracy=1e-3)
    why = "its error, and 3 times v_0/v_c, as friction leaves its limit"
    yield Check("slow friction less (μ_s + μ_k)/2 min F_N/⟨F_N⟩, paraboloid", slow.cof - mdr.static_cof(case), 0.0,
                slow.cof_error + 3 * 4e-3, why)  # fmt: skip


# --- figures ---


@figure("curves", size=(6.6, 4.2))
def _curves_figure(fig, ax, v: Array, curves: dict[str, Array]):
    """Friction over that of sliding against velocity for three shapes: all rise above one below v_c, and fall there.

    Friction over that of sliding, μ_s/μ_k = 1.5, Δu_z/u_z0 = 0.4, elastic, rigid pull; dashed, the same punch with μ_k
    alone. Below v_c friction rises above that of sliding, and falls by a jump at v_c (dotted). What remains above it is
    of springs that the edge of contact touches anew; it ends at μ_s/μ_k times v_c (dotted).
    """
    for (shape, share), colour in zip(curves.items(), COLOURS, strict=False):
        at = np.searchsorted(v, 1.0)
        ax.plot(np.insert(v, at, np.nan), np.insert(share, at, np.nan), color=colour, label=shape_label(shape))
    plain = contact("flat punch", 0.4, nu=0.4)
    curve = mdr.cof_curve(plain, v * mdr.critical_velocity(plain))
    ax.plot(v, curve.share, "--", color="0.4", lw=1, label="flat punch, $\\mu_s = \\mu_k$")
    for end in (1.0, STICK):
        ax.axvline(end, color="0.6", ls=":", lw=1)
    ax.axhline(1.0, color="0.8", lw=0.8)
    panel(ax, "pulling velocity $v_0/v_c$", r"friction over that of sliding", legend="lower right")


@figure("amplitude", size=(6.2, 4.0))
def _amplitude_figure(fig, ax, quick: bool):
    """Friction over that of sliding against amplitude at one velocity: one, a jump up, then a fall below one.

    Friction over that of sliding of an elastic flat punch that is pulled at a tenth of μ_k κωu_z0, under a growing
    amplitude. Where the amplitude is too small to let springs stick, friction is that of sliding. Then it is raised, by
    up to half of the difference of both coefficients, before it falls. Steps are where a spring is let go after one
    period less. Lines: closed form; circles: runs.
    """
    alpha = np.linspace(0.02, 0.98, 481)
    for stick, colour in zip((1.0, 1.2, STICK, 2.0), COLOURS, strict=False):
        share = np.array([_law(0.1 / one, float(one), stick) for one in alpha])
        jumps = np.flatnonzero(np.abs(np.diff(share)) > 0.02) + 1
        ax.plot(np.insert(alpha, jumps, np.nan), np.insert(share, jumps, np.nan), color=colour, label=f"{stick:g}")
        for one in np.linspace(0.07, 0.95, 5 if quick else 12):
            case = falling("flat punch", float(one), stick)
            run = mdr.slide(case, 0.1 / one * mdr.critical_velocity(case), accuracy=1e-4)
            ax.plot(one, run.share, "o", mfc="white", mec=colour, ms=4.5)
    ax.axhline(1.0, color="0.8", lw=0.8)
    panel(ax, r"amplitude $\Delta u_z/u_{z0}$", "friction over that of sliding")
    ax.legend(title=r"$\mu_s/\mu_k$", loc="upper right")
