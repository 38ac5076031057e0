"""Under a spring and a mass v_c follows Eqs. (2) and (15) through both resonances; on the pole there is none.

One flat punch that keeps contact, so that the contact stiffness is constant as in the paper. The frequency is swept
through m omega² = k_x (the pole, where the body swings without bound) and m omega² = k_x + k_xc (the zero, where an
elastic contact and the body swing in step and nothing slips more slowly than the rest). With a Kelvin material the
zero is a minimum, T times Eq. (1) high. A light damper c_x lets every run settle; k_x + i omega c_x in the place of
k_x extends Eq. (15) to it.

The plateau on the pole, derived here: once v_0 is large the body swings at nearly v_0, so its foot stands still for
one instant a period. The lack of friction at that instant is an impulse whose part at omega must cancel that of mu_0
F_N, or the swing would still grow; so it is pi mu_0 dF_N/omega, and the mean loses mu_0 dF_N/2: half of what the
static COF loses, Eq. (7).

Symbols: s = m omega²/k_x, T = omega tau, kappa = k_zc/k_xc, alpha = du_z/u_z0; here k_x = k_xc, so that the zero is
at s = 2.
"""

from dataclasses import dataclass
from itertools import product

import numpy as np

import mdr
from mdr.tools.arrays import Array
from validation.cases import contact, loss_label
from validation.figures import COLOURS, figure
from validation.report import Check, Checks, Claim, told
from validation.words import listed, ranged

ALPHA = 0.1
DAMPING = 0.05  # c_x/(2 sqrt(k_x m))
ZERO = 2.0  # s where m omega² = k_x + k_xc
BELOW, ABOVE = (0.0, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95), (2.05, 2.1, 2.3, 2.7, 3.5, 4.5, 6.0)  # s: pole, zero
BETWEEN = (1.05, 1.1, 1.2, 1.4, 1.6, 1.8, 1.9, 1.95)
SWEEP = {
    "quick": (0.5, 0.95, 1.95),
    "full": (0.0, 0.5, 0.9, 1.1, 1.4, 1.9, 2.1, 4.0),
    "long": (*BELOW, *BETWEEN, *ABOVE),
}
MATERIALS = {"quick": (0.0, 1.0), "full": (0.0, 0.3, 1.0), "long": (0.0, 0.3, 1.0)}  # T
PLATEAU = (0.1, 0.17, 0.3, 0.55, 1.0, 2.0, 4.0, 8.0, 16.0, 64.0, 256.0)  # v_0 over Eq. (1) on the pole
BRACKET = 2e-5  # half width of the bracket of a measurement, over v_c
STEP = (2 * np.pi / 1024) ** 2  # second-order error of one step, over the velocity it is made in


def punch(s: float, T: float, damping_ratio: float = DAMPING) -> mdr.SlidingContact:
    """The flat punch under k_x = k_xc and a mass m = s k_x/omega²; without mass no damper."""
    if s == 0:
        return contact("flat punch", ALPHA, T, k_ratio=1.0)
    return contact("flat punch", ALPHA, T, k_ratio=1.0, omega_0_ratio=s**-0.5, damping_ratio=damping_ratio)


@dataclass(frozen=True)
class Point:
    """One measurement beside Eq. (15)."""

    s: float
    T: float
    measured: float | None  #: over Eq. (1)
    expected: float  #: Eq. (15) over Eq. (1)
    tolerance: float  #: of measured/expected - 1

    @property
    def deviation(self) -> float:
        """measured/expected - 1; NaN where nothing was measured."""
        return np.nan if self.measured is None else self.measured / self.expected - 1


def measure(s: float, T: float, damping_ratio: float = DAMPING) -> Point:
    """Measure one point. Foot and body miss their own velocities by STEP each, also where the two nearly cancel."""
    case = punch(s, T, damping_ratio)
    found = mdr.measure_critical_velocity(case).v_c
    expected = mdr.critical_velocity(case) / case.unit_velocity
    swing = abs(case.k_zc * (1 + 1j * T) * complex(case.pull.receptance(case.oscillation.omega)))
    body = swing / case.material.mindlin_ratio
    got = None if found is None else found / case.unit_velocity
    return Point(s, T, got, expected, BRACKET + STEP * (1 + body) / expected)


def on_the_pole(T: float, ratio: float, start: str = "full_slip") -> mdr.SlidingRun:
    """The run at v_0 = ratio times Eq. (1), undamped, k_x = m omega²."""
    case = punch(1.0, T, 0.0)
    return mdr.slide(case, ratio * case.unit_velocity, start=start)


def half_way(T: float) -> float:
    """Plateau of cof/mu_0 on the pole: 1 less half the relative amplitude of the normal force, Eqs. (6) and (7)."""
    return 1 - 0.5 * ALPHA * float(np.hypot(1, T))


def claim(effort: str) -> Claim:
    """A flat punch under a spring and a mass has the v_c of Eqs. (2) and (15)

    How: Measure v_c over the sweep, at chosen undamped points, and the COF on the pole.

    Quote: Another notable feature is the presence of two resonant frequencies, in particular ω = √(k_x/m) where v_c
    becomes infinite. Numerical experiments show that in this case, the coefficient of friction reaches a plateau (which
    is less than mu_0) at fairly low sliding velocities and does not change thereafter. — Section 1, Eq. (2); with a
    Kelvin contact, Eq. (15)

    Range: flat punch in contact throughout, α = {ALPHA:g}, k_x = k_x,c, mω²/k_x {frequencies}, ωτ = {times}; damper c_x
    of {damping:g} % of critical, and none

    Measured: The measured v_c follows Eq. (15), with k_x + iωc_x in place of k_x, to {worst:.1e} {beside} pole and
    zero. Undamped at the zero an elastic contact has v_c = 0: at any velocity friction is not reduced; a Kelvin contact
    has ωτ times Eq. (1). Undamped on the pole no velocity is high enough, and the COF tends to the mean of its static
    value and mu_0.

    Verdict: holds

    Sentence: For a contact of constant stiffness Eq. (15) gives v_c on both sides of its pole and of its zero. On the
    pole the COF of an undamped body tends to the mean of static COF and μ_0, from below.
    """
    materials = MATERIALS[effort]
    points = [measure(s, T) for T in materials for s in SWEEP[effort]]
    swings = {T: [on_the_pole(T, ratio) for ratio in PLATEAU] for T in materials}
    plateaus = {T: np.array([run.cof / run.mu_0 for run in runs]) for T, runs in swings.items()}
    worst = np.nanmax([abs(point.deviation) for point in points])
    frequencies = f"= {listed(SWEEP[effort])}" if effort == "quick" else ranged(SWEEP[effort])
    times = listed(materials)
    damping = 100 * DAMPING
    beside = "beside" if effort == "quick" else "through"
    return Claim(
        **told(claim, locals()),
        checks=(*_sweep_checks(points), *_undamped_checks(effort), *_pole_checks(plateaus, swings)),
        figures=(_sweep_figure(points, materials), _pole_figure(plateaus)),
    )


def _sweep_checks(points: list[Point]) -> Checks:
    why = "over its tolerance: bracket 2e-5, and h² = (2π/1024)² of the velocities of foot and body, which nearly"
    why += " cancel at the zero; greatest difference"
    sides = {"below the pole": (0, 1), "between pole and zero": (1, ZERO), "above the zero": (ZERO, np.inf)}
    for T, (name, (low, high)) in product(dict.fromkeys(point.T for point in points), sides.items()):
        group = [p for p in points if p.T == T and low <= p.s < high]
        if group:
            share = max(abs(p.deviation) / p.tolerance for p in group)
            told = f"{why} {max(abs(p.deviation) for p in group):.1e} of v_c"
            yield Check.at_most(f"ωτ = {T:g}, {name}: worst |measured/Eq. (15) − 1|", share, 1.0, told)


def _undamped_checks(effort: str) -> Checks:
    near = measure(3.5, 0.0, 0.0)
    why = "bracket 2e-5, and h² = (2π/1024)² of the velocities of foot and body"
    yield Check("undamped, elastic, mω² = 3.5 k_x: v_c over Eq. (2)", 1 + near.deviation, 1.0, near.tolerance, why)
    if effort != "quick":
        zero = measure(ZERO, 0.3, 0.0)
        name = "undamped, ωτ = 0.3, at the zero: v_c over Eq. (1)"
        yield Check(name, zero.measured, 0.3, 0.3 * zero.tolerance, why + "; Eq. (15) gives ωτ there")
    case = punch(ZERO, 0.0, 0.0)
    run = mdr.slide(case, 0.01 * case.unit_velocity)
    name = "undamped, elastic, at the zero: 1 − cof/mu_0 at 0.01 of Eq. (1)"
    why = "Eq. (2) gives v_c = 0, so not even a crawl lowers friction (by more than the error of the run);"
    why += " static cof/mu_0 is 0.9"
    yield Check.at_most(name, 1 - run.cof / run.mu_0, run.cof_error / run.mu_0, why)


def _pole_checks(plateaus: dict[float, Array], swings: dict[float, list[mdr.SlidingRun]]) -> Checks:
    case = punch(1.0, 0.0, 0.0)
    found = mdr.measure_critical_velocity(case)
    yield Check("undamped pole: Eq. (15)", mdr.critical_velocity(case), np.inf, 0.0, "the denominator is zero")
    why = "friction stays reduced up to a million times Eq. (1), the highest velocity tried"
    yield Check("undamped pole: critical velocities found by measurement", int(found.v_c is not None), 0, 0.0, why)
    name = f"undamped pole: runs of {sum(map(len, swings.values()))} that have not settled"
    got = sum(not run.settled for runs in swings.values() for run in runs)
    yield Check(name, got, 0, 0.0, "every one of them is a point of the plateau")
    for T, cof in plateaus.items():
        far = 2 * cof[-1] - cof[-2]
        name = f"undamped pole, ωτ = {T:g}: cof/mu_0 carried on to v_0 → ∞"
        why = "halfway between static COF and mu_0; from 64 and 256 times Eq. (1) by the power −1/2 of v_0,"
        why += " the next power leaves α/64 at most"
        yield Check(name, far, half_way(T), ALPHA / PLATEAU[-2], why)
        name = f"undamped pole, ωτ = {T:g}: cof/mu_0 at 256 times Eq. (1)"
        yield Check.at_most(name, cof[-1], half_way(T), "the plateau is approached from below: mu_0 is never reached")
    rest = on_the_pole(0.0, 16.0, "rest")
    name = "undamped pole: cof/mu_0 from rest less that from full slip, at 16 times Eq. (1)"
    yield Check(name, rest.cof / rest.mu_0 - plateaus[0.0][PLATEAU.index(16.0)], 0.0, 2e-6, "both runs settled to 1e-6")


@figure("sweep", size=(7.2, 4.6))
def _sweep_figure(fig, ax, points: list[Point], materials: tuple[float, ...]):
    """Logarithmic plot of measured critical velocities on the curves of Eq. (15), with a peak at the pole and a dip
    at the zero.

    Critical velocity of a flat punch under a spring and a mass, over the frequency. Points are measured from runs
    alone, curves are Eq. (15). At the pole the body itself swings and v_c grows; at the zero body and contact swing in
    step and v_c falls, for an elastic contact to nothing, for a viscoelastic one to ωτ times Eq. (1).
    """
    s = np.unique(np.r_[np.linspace(0.005, 6.5, 300), np.linspace(0.9, 1.1, 101), np.linspace(1.8, 2.2, 101)])
    for T, colour in zip(materials, COLOURS, strict=False):
        for damping, look in ((DAMPING, {"lw": 1.6}), (0.0, {"lw": 0.8, "ls": "--"})):
            cases = [punch(float(value), T, damping) for value in s]
            curve = np.array([mdr.critical_velocity(case) / case.unit_velocity for case in cases])
            ax.plot(s, np.where(np.isfinite(curve), curve, np.nan), color=colour, **look)
        here = [p for p in points if p.T == T and p.measured is not None]
        look = {"color": colour, "mec": "white", "mew": 0.6, "ms": 7, "zorder": 3}
        ax.plot([p.s for p in here], [p.measured for p in here], "o", label=loss_label(T), **look)
    ax.set(yscale="log", xlim=(-0.1, 6.6), ylim=(0.02, 60), xlabel=r"$m\omega^2/k_x$", ylabel=r"$v_c$ over Eq. (1)")
    for place, name in ((1.0, "pole\n$m\\omega^2 = k_x$"), (ZERO, "zero\n$m\\omega^2 = k_x + k_{xc}$")):
        ax.axvline(place, color="0.6", lw=0.8, ls=":", zorder=0)
        ax.annotate(name, (place, 60), (4, -2), textcoords="offset points", va="top", fontsize=9)
    ax.plot([], [], color="0.3", label=f"Eq. (15), damper {100 * DAMPING:g} % of critical")
    ax.plot([], [], color="0.3", lw=0.8, ls="--", label="Eq. (15), undamped")
    ax.legend(loc="upper right", title="points: measured", alignment="left")


@figure("pole", size=(6.8, 4.0))
def _pole_figure(fig, ax, plateaus: dict[float, Array]):
    """COF over pulling velocity: plateaus below mu_0 on the pole, full friction above v_c off the pole.

    An undamped body driven at its own frequency: the COF rises towards a plateau (dashed: halfway between static COF
    and mu_0) and does not pass it, up to 256 times Eq. (1). Off the pole (grey) it reaches mu_0 at v_c.
    """
    for (T, cof), colour in zip(plateaus.items(), COLOURS, strict=False):
        ax.axhline(half_way(T), color=colour, lw=0.9, ls="--", zorder=0)
        ax.plot(PLATEAU, cof, "o-", color=colour, ms=5, label=f"on the pole, {loss_label(T)}")
    off, ratios = punch(0.5, 0.0), np.geomspace(0.1, 6.0, 40)
    cof = [mdr.slide(off, ratio * off.unit_velocity).cof / off.mu_0 for ratio in ratios]
    ax.plot(ratios, cof, "-", color="0.45", lw=1.0, label=r"off the pole, $m\omega^2 = k_x/2$")
    ax.axhline(1.0, color="0.75", lw=0.8, zorder=0)
    ax.set(xscale="log", xlabel=r"$v_0$ over Eq. (1)", ylabel=r"$\mu/\mu_0$", ylim=(None, 1.008))
    ax.legend(loc="lower right", bbox_to_anchor=(1.0, 0.02))
