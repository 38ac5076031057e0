"""The slope of friction over velocity: how long it says that springs stick, and the damper that slow motion meets.

Rigid pull. More velocity adds to the way of a spring in stick, and slip forgets it. A stick begins where the velocity
of slip is zero, and ends where the force is continuous; so these instants add nothing, and a spring that sticks for d
of the period P adds k_x d²/2P to dF/dv_0 (`mdr.laws.stick_impedance`, with dashpots and for motions that are not slow).

Symbols: alpha = du_z/u_z0, T = omega tau, v over v_c, q = d/P share of the period in stick, W frequency of the slow
motion, c = F_N dCOF/dv_0.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import mdr
from mdr.normal.normal_force import mean_normal_force
from mdr.tools.arrays import Array
from mdr.tools.progress import progress
from validation.cases import BODY, DEPTH, OMEGA, contact, loss, shaken
from validation.figures import COLOURS, circles, figure, panel
from validation.report import Check, Checks, Claim, Equation, told
from validation.words import percent

N = 2048  #: steps in a period of runs whose springs are looked at
CASES = {
    "flat punch, α = 0.5": contact("flat punch", 0.5, nu=0.4),
    "flat punch, α = 1.4": contact("flat punch", 1.4, nu=0.4),
    "flat punch, α = 0.5, ωτ = 0.6": contact("flat punch", 0.5, 0.6, nu=0.4),
    "paraboloid, α = 0.5": contact("paraboloid", 0.5, nu=0.4),
    "cone, α = 1.3, ωτ = 0.6": contact("cone", 1.3, 0.6, nu=0.4),
    "paraboloid, α = 0.5, shaken along": shaken("paraboloid", 0.5, 0.2, 2.3, nu=0.4),
}
FACE = replace(contact("paraboloid", 0.5, nu=0.4), friction=mdr.ShearStrength(0.5, 2e4))
OTHERS = {
    "a body that swings": contact("flat punch", 0.5, nu=0.4, **BODY),
    "friction that falls": replace(contact("flat punch", 0.5, nu=0.4), friction=mdr.StaticKinetic(0.6, 0.5)),
}
HEAVY = contact("flat punch", 0.5, nu=0.4, k_ratio=1.5, omega_0_ratio=0.1, damping_ratio=0.1)
SWAYED = (("flat punch", 0.5, 0.0, 0.3), ("flat punch", 0.5, 0.6, 0.3), ("flat punch", 1.4, 0.6, 0.02))  #: alpha, T, v
SLOW = ((1, 16), (1, 8), (1, 4), (3, 8), (3, 4))  #: W/omega
SWAY = 0.03  #: greatest velocity of the slow motion over that of the pull
ZETA, TURN, LOST = 0.05, 20, 1.4  #: damping ratio of the stage, periods of the vibration in one of its own, alpha


class Stick(NamedTuple):
    """What is known of a case at a velocity."""

    slope: float  #: dF/dv_0 [N s/m], by differences of runs
    by_stick: float  #: the same by the times of stick
    resolved: float  #: relative, to which these are known
    time: float  #: root of their mean square, weighted by stiffness, over the period


def claim(effort: str) -> Claim:
    """The slope of friction over velocity tells how long springs stick, and is the damper that slow motion meets

    How: Derivatives by `mdr.sensitivity`, beside the springs of runs, slowly modulated pulls and a stage that swings.

    Range: Rigid pull. {n_cases} contacts that are kept, lost and shaken, elastic and ωτ = 0.6, with and without a shear
    strength, at 0.1 and 0.4 v_c; pulls modulated at 1/16 to 3/4 of the frequency of the vibration.

    Measured: A spring that sticks for the share q of the period adds k_x q²/2f to the slope of the mean force over
    velocity, so that the slope of a measured curve is a clock: q = √(2f F_N COF′(v_0)/k_xc), without a view of the
    contact. Times of stick in runs give the slope to {worst:.1g}. The force that springs gain while they stick is
    v_0 dF/dv_0, in the mean. The rest, μ_0 dF/dμ_0, is not that of slip alone, but also what springs held when they
    began to stick: at 0.01 v_c stick has {held:.0f} % of the load and time, and the slope {gained:.0f} % of the force.
    With a body that follows the vibration the times of stick give {swings} of the slope; one too heavy for that is as a
    rigid pull to {heavy}. Of friction that falls they give {falls}. A slow motion at frequency W besides the pull meets
    the damper c = dF/dv_0 up to (W d)²/12, d = q/f: within 1 % for W below {slowest:.3f} ω/q. One that is faster
    also meets a spring, and both are known from the slope: runs differ by {swayed:.0e}. A contact that is lifted off in
    each period has no friction at rest: it is a damper c = k_xc q²/2f, which knows no μ_0, up to the share
    v_0/(v_c √(1 − 1/α²)). So 10 N/µm that touch for half of each period at 1 kHz are 1.25 kN s/m. A stage on such a
    foot swings out as on this damper to {damped:.1g} of the way, where the foot held it before. A Kelvin contact that
    is kept has a slope that grows like v_0 to the power {power:.3f} towards rest, and above v_c there is none.

    Verdict: holds if the pull is rigid or the body heavy, and friction does not fall

    Sentence: Springs that stick for the share <i>q</i> of each period add k_x <i>q</i>²/2<i>f</i> to the slope, the
    damper of motions slower than 0.055 ω/<i>q</i>. Contact lost in each period makes dry friction this damper.
    """
    quick = effort == "quick"
    chosen = [(name, case, v) for name, case in CASES.items() for v in ((0.4,) if quick else (0.1, 0.4))]
    chosen.append(("paraboloid with a shear strength", FACE, 0.4))
    sticks = [stick(case, v) for _, case, v in progress(chosen, "damping")]
    others = {name: stick(case, 0.4) for name, case in OTHERS.items()}
    far = stick(HEAVY, 0.4)
    at_rest = parts(CASES["flat punch, α = 0.5"], 0.01)
    impedances = [sway(*one, p, r) for one in SWAYED[: 2 if quick else None] for p, r in SLOW[:: 2 if quick else 1]]
    stage = swing(0.05, 4)
    worst = max(abs(one.by_stick / one.slope - 1) for one in sticks)
    held, gained = 100 * at_rest.stick_share, 100 * at_rest.gained / at_rest.force
    swings, falls = (percent(one.by_stick / one.slope, 3) for one in others.values())
    heavy = percent(abs(far.by_stick / far.slope - 1), 1)
    swayed = max(abs(one.by_run / one.by_law - 1) for one in impedances)
    slowest, power = np.sqrt(0.12) / (2 * np.pi), _power()
    damped = float(np.abs(stage.x - stage.damped).max())
    n_cases = len(CASES) + 1
    return Claim(
        **told(claim, locals()),
        checks=(
            *_stick_checks(chosen, sticks, others, far),
            *_share_checks(at_rest),
            *_impedance_checks(impedances),
            *_lost_checks(),
            Check(
                "way of a stage less that on the damper", damped, 0.0, stage.resolved, "second order; over its start"
            ),
            Check("power of v_0 of the slope, ωτ = 0.6, kept", power, -1 / 3, 0.01, "the next term is v^(1/3) smaller"),
        ),
        figures=(_shares_figure(quick), _damper_figure(impedances, stage)),
        equations=_EQUATIONS,
    )


_EQUATIONS = (
    Equation(
        "",
        r"\frac{d\langle F_x \rangle}{d v_0} = \sum_i k_{x,i} \frac{q_i^2}{2 f}",
        "Slope of the mean force of elastic springs that stick for the share <i>q</i> of each period 1/<i>f</i>.",
    ),
    Equation(
        "",
        r"\langle F_x \rangle = v_0 \frac{\partial \langle F_x \rangle}{\partial v_0}"
        r" + \mu_0 \frac{\partial \langle F_x \rangle}{\partial \mu_0}",
        "Euler's theorem, as the force is <i>μ</i><sub>0</sub> times a function of <i>v</i><sub>0</sub>/<i>μ</i>"
        "<sub>0</sub>. The first term is what springs gain in stick, the second what slips, or was held before.",
    ),
)


def eq_1(case: mdr.SlidingContact) -> float:
    """v_c [m/s] of a rigid pull, by Eq. (1): also where a shear strength keeps the edge in stick at any velocity."""
    return case.mu_0 * case.material.mindlin_ratio * OMEGA * case.oscillation.du_z


def slope(case: mdr.SlidingContact, v: float) -> float:
    """F_N dCOF/dv_0 [N s/m] at so many v_c; not a number where there is none, such as at v_c."""
    found = mdr.sensitivity(case, v * eq_1(case), fields=["v_0"])
    return found.d_cof.get("v_0", np.nan) * mean_normal_force(case)


def stick(case: mdr.SlidingContact, v: float) -> Stick:
    """Slope of the force at so many v_c, and that which the times of stick make."""
    run = mdr.slide(case, v * eq_1(case), record=1, steps_per_period=N)
    k_x = case.material.G_star * run.width
    shares = [_episodes(one) for one in (run.state == mdr.State.STICK).T]
    tau = getattr(case.material, "tau", 0.0)
    one = [sum(mdr.laws.stick_impedance(q, 1.0, OMEGA, tau=tau).real for q in qs) for qs in shares]
    time = float(np.sqrt(k_x @ [sum(q**2 for q in qs) for qs in shares] / k_x.sum()))
    return Stick(slope(case, v), float(k_x @ one), 4 / (N * time), time)


def _episodes(sticks: Array) -> list[float]:
    """Shares of the period that each stick of a spring lasts, (n_t,) of one period."""
    if sticks.all() or not sticks.any():
        return []
    turned = np.roll(sticks, -int(np.argmin(sticks)))
    ends = np.diff(np.r_[0, turned.astype(int), 0])
    return [float(one) for one in (np.flatnonzero(ends == -1) - np.flatnonzero(ends == 1)) / sticks.size]


class Parts(NamedTuple):
    """The mean force [N], and what of it springs slip with, and gain while they stick."""

    force: float
    slips: float
    gained: float
    stick_share: float


def parts(case: mdr.SlidingContact, v: float) -> Parts:
    """The parts of the force of an elastic contact at so many v_c."""
    run = mdr.slide(case, v * eq_1(case), record=1, steps_per_period=N)
    sticks = np.asarray(run.state == mdr.State.STICK)
    n, gained = len(sticks), 0.0
    for k_x, qs in zip(case.material.G_star * run.width, map(_episodes, sticks.T), strict=True):
        gained += sum(k_x * run.v_0 * q**2 / 2 * 2 * np.pi / OMEGA for q in qs)
    return Parts(run.mean_F_x, float(run.f_x[~sticks].sum() / n), gained, run.stick_share)


class Sway(NamedTuple):
    """Impedance of a contact to a pull that is modulated, [N s/m]."""

    name: str
    slow: float  #: W times d
    damper: float  #: slope of the force over velocity
    by_run: complex
    by_law: complex
    off: float  #: error of the run over it


def sway(shape: str, alpha: float, T: float, v: float, p: int, r: int) -> Sway:
    """The impedance at p/r of the frequency of the vibration, by a run, and by the law from the slope of friction."""
    case = contact(shape, alpha, T, nu=0.4)
    v_0, slow, tau = v * eq_1(case), OMEGA * p / r, T / OMEGA
    du_x = SWAY * v_0 / slow
    modulated = replace(case, shake=mdr.InPlaneOscillation(OMEGA * p / r, du_x, 0.0, 0.0, 0.0, "tool"))
    run = mdr.slide(modulated, v_0, record=1, steps_per_period=N * r)
    force = 2 * np.mean(run.F_x * np.exp(-1j * slow * run.t))
    c = slope(case, v)

    def off(q: float) -> float:
        return mdr.laws.stick_impedance(q, case.k_xc, OMEGA, tau=tau).real - c

    q = brentq(off, 1e-6, 1 - 1e-6, xtol=1e-14)
    law = mdr.laws.stick_impedance(q, case.k_xc, OMEGA, slow, tau)
    where = f"{shape}, α = {alpha:g}, {loss(T)}, {v:g} v_c, W = {p}/{r} ω"
    return Sway(where, slow * q * 2 * np.pi / OMEGA, c, complex(force / (1j * slow * du_x)), law,
                SWAY**2 + run.cof_error * run.mean_F_z / abs(force))  # fmt: skip


class Foot(NamedTuple):
    """An elastic flat punch that is lifted off in each period."""

    alpha: float

    @property
    def case(self) -> mdr.SlidingContact:
        """As a contact that is pulled."""
        return contact("flat punch", self.alpha, nu=0.4)

    @property
    def touch(self) -> float:
        """Share of the period in contact, in which a slow pull sticks."""
        return float(np.arccos(-1 / self.alpha) / np.pi)

    @property
    def end(self) -> float:
        """Velocity at which it is lifted off, over the greatest one."""
        return float(np.sqrt(1 - 1 / self.alpha**2))

    @property
    def damper(self) -> float:
        """What the slowest pull meets [N s/m]."""
        return mdr.laws.stick_impedance(self.touch, self.case.k_xc, OMEGA).real


class Swing(NamedTuple):
    """Free swing of a stage on a foot."""

    t: Array
    x: Array  #: over that at the start
    damped: Array  #: the same of a stage on its spring and the damper
    resolved: float  #: to which the damper is known


def swing(start: float, turns: int, vibrated: bool = True) -> Swing:
    """Let go a stage at so many v_c over its frequency, on a foot that vibrates or stays at its mean depth."""
    foot, W = Foot(LOST), OMEGA / TURN
    case, c = foot.case, foot.damper
    m = c / (2 * ZETA * W)
    k, x = m * W**2, start * eq_1(case) / W
    element = mdr.ContactElement(case.indenter, case.material, case.mu_0, u_z_max=2.5 * DEPTH, n_springs=16)
    steps = 64 * TURN
    t = 2 * np.pi / W * np.arange(turns * steps + 1) / steps
    depth, dt = DEPTH * (1 + LOST * vibrated * np.cos(OMEGA * t)), float(t[1])
    state, v, a, found = element.at_rest((x, 0.0, depth[0])), 0.0, -k * x / m, [x]
    for u_z in depth[1:].tolist():  # Newmark's method, of mean acceleration
        known = x + dt * v + dt**2 / 4 * a
        x, residual = known, np.inf
        while abs(residual) > 1e-9 * k * abs(found[0]):
            F, new, K = element.step(state, 0.0, (x, 0.0, u_z), tangent=True)
            residual = 4 * m / dt**2 * (x - known) + k * x + F[0]
            x -= residual / (4 * m / dt**2 + k + K[0, 0])
        after = 4 / dt**2 * (x - known)
        v, a, state = v + dt / 2 * (a + after), after, new
        found.append(x)
    W_d, fast = W * foot.touch * 2 * np.pi / OMEGA, start / foot.end

    def motion(_: float, y: Array) -> tuple[float, float]:
        """Mass less what the spring of the contact takes up, and a damper that is less the faster it is."""
        damper = c * y[1] * (1 - fast * abs(y[1]) / abs(W * found[0]))
        return y[1], -(k * y[0] + damper) / (m * (1 - 2 * ZETA * W_d / 3))

    damped = solve_ivp(motion, (0.0, t[-1]), (found[0], 0.0), t_eval=t, rtol=1e-8, atol=1e-8 * found[0]).y[0]
    return Swing(t, np.array(found) / found[0], damped / found[0], ZETA**2 + fast**2 + W_d**2 / 12)


def _power() -> float:
    """Power of v_0 with which the slope of a kept Kelvin contact goes near rest."""
    case = CASES["flat punch, α = 0.5, ωτ = 0.6"]
    return float(np.log(slope(case, 8e-3) / slope(case, 1e-3)) / np.log(8))


# --- checks ---


def _stick_checks(chosen, sticks: list[Stick], others: dict[str, Stick], far: Stick) -> Checks:
    why = "each end of a stick lies within a step"
    for (name, _, v), one in zip(chosen, sticks, strict=True):
        yield Check(f"slope by the times of stick over dF/dv_0, {name}, {v:g} v_c", one.by_stick / one.slope, 1.0,
                    one.resolved, why)  # fmt: skip
    for name, one in others.items():
        off = abs(one.by_stick / one.slope - 1)
        yield Check.at_least(f"slope by the times of stick less dF/dv_0, over it, {name}", off, 0.1, "it fails there")
    why = f"{why}, and the body moves by (ω_0/ω)² of a rigid one's force"
    yield Check("slope by the times of stick over dF/dv_0, heavy body", far.by_stick / far.slope, 1.0,
                far.resolved + 0.1**2, why)  # fmt: skip
    for name, case in {**CASES, **OTHERS}.items():
        if case.shake is None and isinstance(case.friction, mdr.Coulomb):
            v_0 = 0.4 * eq_1(case)
            found = mdr.sensitivity(case, v_0, fields=["v_0", "mu_0"])
            total = v_0 * found.d_cof["v_0"] + case.mu_0 * found.d_cof["mu_0"]
            error = v_0 * found.error["cof"]["v_0"] + case.mu_0 * found.error["cof"]["mu_0"]
            yield Check(f"v_0 dCOF/dv_0 + μ_0 dCOF/dμ_0 over COF, {name}", total / found.cof, 1.0,
                        error / found.cof, "their stated errors")  # fmt: skip


def _share_checks(at_rest: Parts) -> Checks:
    why = "stick is nearly all the time, and gains nearly nothing"
    yield Check.at_least("share of load and time in stick at 0.01 v_c", at_rest.stick_share, 0.95, why)
    yield Check.at_most("v_0 dF/dv_0 over F at 0.01 v_c", at_rest.gained / at_rest.force, 0.1, why)


def _impedance_checks(impedances: list[Sway]) -> Checks:
    for one in impedances:
        why = "square of the modulation of the velocity, and the error of the run"
        yield Check(f"impedance by a run less that by the slope, over it, {one.name}", abs(one.by_run / one.by_law - 1),
                    0.0, one.off, why)  # fmt: skip
        if one.slow < 0.5 and "elastic" in one.name:
            yield Check(f"damper of a slow motion over dF/dv_0, {one.name}", one.by_run.real / one.damper,
                        1 - one.slow**2 / 12, one.off + one.slow**4 / 360, "and the next term")  # fmt: skip


def _lost_checks() -> Checks:
    for alpha in (1.1, LOST, 3.0):
        foot, v = Foot(alpha), 1e-4
        name = f"dF/dv_0 over k_xc q²/2f, q the share of the period in contact, flat punch, α = {alpha:g}"
        less = 2 * v / foot.end
        why = "the end of contact slips, to first order in v_0/v_c; the next is that times 2 pi v/(1 - 1/α²) at most"
        yield Check(name, slope(foot.case, v) / foot.damper, 1 - less, less * 2 * np.pi * v / foot.end**2, why)


# --- figures ---


@figure("shares", columns=2, size=(8.6, 3.6), sharey=True)
def _shares_figure(fig, axes, quick: bool):
    """Parts of friction against velocity: what slips, what was held when a stick began, and what is gained in it.

    Friction over μ_0, flat punch, elastic. Springs that stick hold what they had when the stick began, and gain
    v_0 dCOF/dv_0 (above the dashed line, which is what the derivatives say). Left, contact is kept: towards rest all is
    held. Right, it is lost in each period: what is gained bears a slow pull alone, and friction begins as a damper's.
    """
    v = np.linspace(0.01, 1.1, 12 if quick else 45)
    for ax, name in zip(axes, list(CASES)[:2], strict=True):
        case = CASES[name]
        found = [parts(case, one) for one in v]
        force, slips, gained = (np.array([getattr(one, of) for one in found]) for of in ("force", "slips", "gained"))
        full = force[-1]
        held = np.maximum(force - slips - gained, 0)
        ax.stackplot(v, slips / full, held / full, gained / full, colors=COLOURS[:3], alpha=0.6,
                     labels=("slips", "held since a stick began", "gained in stick"))  # fmt: skip
        ax.plot(v, force / full, "k", lw=1.2, label=r"COF/$\mu_0$")
        by_slope = v * eq_1(case) * [slope(case, one) for one in v]
        ax.plot(v, (force - by_slope) / full, "k--", lw=1.2, label=r"less $v_0\,d\mathrm{COF}/dv_0$")
        ax.set_title(name.partition(", ")[2].replace("α", r"$\alpha$"))
    panel(axes, "velocity over $v_c$", r"friction over $\mu_0$", xlim=(0, 1.1), ylim=(0, 1.02))
    axes[0].legend(loc="lower right", fontsize="small")


@figure("damper", columns=2, size=(8.6, 3.6))
def _damper_figure(fig, axes, impedances: list[Sway], stage: Swing):
    """Left, the impedance over frequency: damper and spring by the law and runs. Right, a stage that swings out.

    Left: elastic flat punch at 0.3 v_c, force of a modulated pull over its velocity and the slope c = dF/dv_0, over
    frequency W times the time of stick d; lines by the law, circles by runs. Right: a stage on a foot that is lifted
    off in each period, beside one on the damper c in its place (dashed), and on the same foot without vibration.
    """
    ax, way = axes
    W_d = np.linspace(0, 4, 81)
    x = 1j * np.where(W_d > 0, W_d, 1e-3)
    law = 2 * (x - 1 + np.exp(-x)) / x**2
    ax.plot(W_d, law.real, color=COLOURS[0], label="damper, $\\mathrm{Re}\\,Z/c$")
    ax.plot(W_d, -law.imag, color=COLOURS[1], label="spring, $-\\mathrm{Im}\\,Z/c$")
    for one in impedances:
        if "elastic" in one.name and "0.3 v_c" in one.name:
            circles(ax, one.slow, one.by_run.real / one.damper, COLOURS[0])
            circles(ax, one.slow, -one.by_run.imag / one.damper, COLOURS[1])
    panel(ax, "$W d$", "impedance over that of slow motion", legend="upper right", ylim=(0, 1.05))
    for vibrated, label, colour in ((True, "vibrated", COLOURS[0]), (False, "not vibrated", COLOURS[2])):
        one = stage if vibrated else swing(0.05, 4, vibrated)
        way.plot(1e3 * one.t, one.x, color=colour, lw=2.5, alpha=0.6, label=label)
    way.plot(1e3 * stage.t, stage.damped, "k--", lw=1.2, label="on the damper")
    panel(way, "time [ms]", "way over that at the start", legend="lower right")
