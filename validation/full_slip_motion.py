"""Above v_c the simulated body and its foot move as Eqs. (10), (12), (13) say, and slip at the velocity of Eq. (14).

The closed forms are one Kelvin element and no solver; the run is a time march of springs that would stick if
they could. A flat punch that keeps contact is one element, so both must agree up to the parabolas that depth and body
move on within a step h: area and moment of the force leave h⁴. A velocity by a central difference errs by h²/6.

Symbols: y = u_x - v_0 t, h = 2 pi/steps, T = omega tau, alpha = du_z/u_z0, k_xc contact and k_x system stiffness,
m mass.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

import mdr
from mdr.closed_forms import paper as theory
from mdr.tools.arrays import Array
from validation.cases import contact, widest_cell
from validation.figures import COLOURS, circles, figure, ticks
from validation.full_slip import full_slip
from validation.measured import power
from validation.report import Check, Checks, Claim, told

ROUNDING = 1e-12  #: of a place, over its amplitude
#: alpha, T, k_x/k_xc, omega_0/omega of the flat punch; it keeps contact in all
PUNCHES = ((0.5, 0.0, 0.5, 0.7), (0.5, 0.5, 0.5, 0.7), (0.2, 3.0, 3.0, 1.6), (0.3, 1.0, 1.0, 0.0))


@dataclass(frozen=True)
class Motion:
    """One period of a run and of the closed forms, arrays (n_t,) of both; bounds in units of the closed amplitude."""

    h: float
    y: tuple[Array, Array]
    foot: tuple[Array, Array]
    slip: tuple[Array, Array]
    extension: float  #: greatest difference to Eq. (12), over its greatest value
    least: float  #: least slip velocity the run itself reports, less v_0 - v_c, over v_c
    v_c: float

    @property
    def errors(self) -> tuple[float, float, float]:
        """Complex relative error of the harmonics of y and foot; greatest error of the slip velocity over v_c."""
        y, foot = (abs(np.fft.rfft(got)[1] / np.fft.rfft(closed)[1] - 1) for got, closed in (self.y, self.foot))
        return float(y), float(foot), float(np.max(np.abs(self.slip[0] - self.slip[1]))) / self.v_c

    @property
    def bounds(self) -> tuple[float, float, float]:
        """What the step allows for each of the three."""
        body, foot = (np.ptp(closed) / 2 for _, closed in (self.y, self.foot))
        return self.h**4, self.h**4 * body / foot, self.h**2 / 6 + self.h**4


def claim(effort: str) -> Claim:
    """Above the critical velocity the body moves as Eqs. (10) to (14) say

    How: Compare march and closed form, step by step of refinement.

    Quote: Under the assumption that the immediate contact point is always in the sliding state … Eq. (8) … can be
    easily solved with respect to u_x, Eq. (10); … u_x − u_x,c = mu_0 (k_z,c/k_x,c) (u_z,0 + Δu_z cos ωt), Eq. (12).
    From Eqs. (10) and (12) we can first determine u_x,c, Eq. (13), and finally its velocity, Eq. (14). (Section 2.2.2)

    Range: a flat punch that keeps contact at twice v_c, ωτ from 0 to 3, k_x/k_xc from 0.5 to 3, driven above and below
    its natural frequency and without mass, 64 to {most_steps} steps a period; the force of a paraboloid, elastic and at
    ωτ = 1.

    Measured: Mean offset, amplitude and phase of body and foot, the extension and the slip velocity agree with the
    closed forms; what differs falls with the fourth power of the step. Slip never stops; its least velocity is v_0 −
    v_c. With a damper a body that starts from rest ends in the same motion, with k_x + iω c_x in the place of k_x.
    Under a paraboloid springs come and go, and the force of the array follows the full-slip solution: the elastic one
    with the square of the number of springs, the viscous one up to the dashpot of the single spring that touches.

    Verdict: holds

    Sentence: In full slip one element describes the whole punch: offset, amplitude, phase and slip velocity.
    """
    steps = (64, 128, 256, 512) if effort == "quick" else (64, 128, 256, 512, 1024, 2048, 4096)
    motions = {punch: [follow(punch, n) for n in steps] for punch in PUNCHES}
    checks = [c for punch, refined in motions.items() for c in _motion_checks(_name(punch), refined, steps)]
    most_steps = steps[-1]
    return Claim(
        **told(claim, locals()),
        checks=(*checks, _from_rest(), *_force_checks(effort)),
        figures=(_motion_figure(), _order_figure(motions, steps)),
    )


def follow(punch: tuple[float, float, float, float], steps: int) -> Motion:
    """Run a punch at twice its v_c and set the last period beside Eqs. (10), (12), (13), (14)."""
    alpha, T, k_ratio, omega_0_ratio = punch
    case = contact("flat punch", alpha, T, k_ratio=k_ratio, omega_0_ratio=omega_0_ratio)
    v_c = mdr.critical_velocity(case)
    run = mdr.slide(case, 2 * v_c, steps_per_period=steps, n_springs=16, n_periods=8, record=1)
    t, v_0, pull, oscillation = run.t, run.v_0, case.pull, case.oscillation
    motion = case.mu_0, oscillation.u_z0, oscillation.du_z, oscillation.omega
    kappa = case.material.mindlin_ratio
    contact_of, body = (case.k_zc, case.gamma_zc, kappa), (pull.k_x, pull.m)
    foot, stretched = run.u_x - v_0 * t - run.e[:, 0], theory.eq_12(t, *motion, kappa)
    slip = v_0 + (np.roll(foot, -1) - np.roll(foot, 1)) / (2 * oscillation.period / steps)
    return Motion(
        h=2 * np.pi / steps,
        y=(run.u_x - v_0 * t, theory.eq_10(t, 0.0, *motion, case.k_zc, case.gamma_zc, *body)),
        foot=(foot, theory.eq_13(t, 0.0, *motion, *contact_of, *body)),
        slip=(slip, theory.eq_14(t, v_0, case.mu_0, *motion[2:], *contact_of, *body)),
        extension=float(np.max(np.abs(run.e - stretched[:, None])) / np.max(stretched)),
        least=(run.least_slip - (v_0 - v_c)) / v_c,
        v_c=v_c,
    )


def _name(punch: tuple[float, float, float, float]) -> str:
    alpha, T, k_ratio, omega_0_ratio = punch
    body = f"ω_0/ω = {omega_0_ratio:g}" if omega_0_ratio else "no mass"
    return f"ωτ = {T:g}, Δu_z/u_z0 = {alpha:g}, k_x/k_xc = {k_ratio:g}, {body}"


def _motion_checks(name: str, refined: list[Motion], steps: tuple[int, ...]) -> Checks:
    finest = refined[-1]
    offset = max(abs(np.mean(got) / np.mean(closed) - 1) for got, closed in (finest.y, finest.foot))
    rounding = "roundings of 2e-16 of a travel that is ten times the offset, over thousands of steps"
    yield Check.at_most(f"mean offset of u_x and u_xc, Eqs. (10), (13): {name}", offset, 1e-10, rounding)
    yield Check.at_most(f"extension, Eq. (12): {name}", finest.extension, 1e-10, rounding)
    reasons = {
        "harmonic of u_x, Eq. (10)": "h⁴: depth and body move on parabolas in a step",
        "harmonic of u_xc, Eq. (13)": "the same error of the body, over the smaller or larger amplitude of the foot",
        "slip velocity, Eq. (14)": "h²/6 of the central difference that gives the velocity",
    }
    for (what, why), error, bound in zip(reasons.items(), finest.errors, finest.bounds, strict=True):
        yield Check.at_most(f"{what}, {steps[-1]} steps: {name}", error, max(bound, ROUNDING), why)
    places = np.array([m.errors[:2] for m in refined])
    bound, why = finest.bounds[2], "h²/6: a body without mass has the rate of the parabolas"
    if places.max() > ROUNDING:
        above = [(np.array(steps)[errors > ROUNDING], errors[errors > ROUNDING]) for errors in places.T]
        order = min(-power(*one) for one in above)
        what = f"least order in the step of u_x and u_xc: {name}"
        yield Check(what, order, 4.0, 0.1, "slope of errors above rounding")
        bound, why = max(finest.h**4, ROUNDING), "h⁴: the least value of a polynomial through rates at five instants"
    yield Check(f"least slip velocity less v_0 − v_c, over v_c: {name}", finest.least, 0.0, bound, why)


def _from_rest() -> Check:
    """A damped body started from rest; its free oscillation has died by exp(-0.07 * 2 pi * 60) = 3e-12."""
    case = contact("flat punch", 0.5, 0.5, k_ratio=0.5, omega_0_ratio=0.7, damping_ratio=0.1)
    v_0, steps = 2 * mdr.critical_velocity(case), 512
    run = mdr.slide(case, v_0, steps_per_period=steps, n_springs=16, n_periods=60, start="rest", record=1)
    got = 2 * np.fft.rfft(run.u_x - v_0 * run.t)[1] / steps * np.exp(-1j * 2 * np.pi / steps)  # t begins at h
    force = case.k_zc * case.oscillation.du_z * (1 + 1j * case.T)
    closed = -case.mu_0 * force * case.pull.receptance(case.oscillation.omega)
    why = "h⁴ as from full slip; of the free oscillation 3e-12 is left"
    name = "from rest with 10 % of critical damping: harmonic of u_x"
    return Check.at_most(name, abs(got / closed - 1), (2 * np.pi / steps) ** 4, why)


def _force_checks(effort: str) -> Checks:
    counts = (64, 128, 256) if effort == "quick" else (64, 128, 256, 512, 1024)
    for T in (0.0, 1.0):
        case = contact("paraboloid", 0.2, T)
        exact = np.roll(full_slip(case, 512)[0], -1)
        offs, means = [], []
        v_0 = 2 * mdr.critical_velocity(case)
        for n in counts:
            run = mdr.slide(case, v_0, n_springs=n, steps_per_period=512, n_periods=8, record=1)
            offs.append((run.F_z - exact) / exact.mean())
            means.append(abs(run.mean_F_z / exact.mean() - 1))
        springs = mdr.SpringArray.of(case, counts[-1])
        name = f"paraboloid, ωτ = {T:g}, Δu_z/u_z0 = 0.2"
        if T:
            bound = float(np.max(springs.dk_z[springs.n_core :])) * T * case.oscillation.du_z / exact.mean()
            why = "the dashpot of the one spring that touches, γ u_z' at most"
        else:
            bound = widest_cell(case, springs) * 1.05 / exact.mean()
            why = "dk dg/8 of the widest cell that is half in contact; g bends within it by less than 5 %"
        worst = float(np.max(np.abs(offs[-1])))
        yield Check.at_most(f"greatest error of F_N(t), {counts[-1]} springs: {name}", worst, bound, why)
        order = -power(counts, [np.sqrt(np.mean(off**2)) for off in offs])
        why = "first order: a dashpot resists at once" if T else "second order: an elastic spring starts from zero"
        yield Check(f"order in springs of F_N(t): {name}", order, 1.0 if T else 2.0, 0.1, why + "; slope of a line")
        why = "the mean over the period is smooth along each stretch of the row, so that its rule has converged"
        yield Check.at_most(f"error of the mean force, {counts[0]} springs: {name}", means[0], 1e-9, why)


# --- figures ---


@figure("motion", 1, 2, size=(8.6, 3.9))
def _motion_figure(fig, axes):
    """Body and foot positions and slip velocity over one period, circles of the run on the lines of the closed
    forms.

    Flat punch on a Kelvin rubber (ωτ = 0.5) at v_0 = 2 v_c, driven above its natural frequency. Lines: Eqs. (10), (13),
    (14); circles: every eighth step of the run. Body and extension swing nearly together, so the foot swings less than
    the body. Slip is slowest at v_0 − v_c: it would stop at v_0 = v_c.
    """
    left, right = axes
    motion = follow(PUNCHES[1], 256)
    phase = np.arange(1, 257) * motion.h / (2 * np.pi)
    for ax, label, (got, closed), unit, colour in (
        (left, "body $u_x-v_0t$, closed form", motion.y, 1e-6, COLOURS[0]),
        (left, "foot $u_{xc}-v_0t$, closed form", motion.foot, 1e-6, COLOURS[1]),
        (right, "slip velocity, Eq. (14)", motion.slip, motion.v_c, COLOURS[2]),
    ):
        ax.plot(phase, closed / unit, color=colour, label=label)
        circles(ax, phase[::8], got[::8] / unit, colour)
    right.axhline(1.0, color="0.4", lw=1, ls=":")
    right.annotate("$v_0-v_c$", (1.0, 1.0), (0, 3), ("data", "data"), "offset points", ha="right", va="bottom")
    left.set(xlabel="time [periods]", ylabel="place [µm]")
    right.set(xlabel="time [periods]", ylabel="slip velocity over $v_c$", ylim=(0, None))
    circles(left, [], [], "0.3", label="run")
    fig.legend(loc="outside lower center", ncols=4)


@figure("order")
def _order_figure(fig, ax, motions: dict[Any, list[Motion]], steps: tuple[int, ...]):
    """Errors of body and foot against the steps per period, parallel to a line of fourth order or at rounding.

    Error of the run against Eqs. (10) and (13) in four systems: it falls by sixteen when the step is halved, and
    without mass is rounding, so nothing but the step stands between the march and the closed forms.
    """
    for (punch, refined), colour in zip(motions.items(), COLOURS, strict=False):
        for k, marker in enumerate("os"):
            ax.loglog(steps, [m.errors[k] for m in refined], marker, mfc="white", color=colour, ms=5.5)
        _, T, _, omega_0_ratio = punch
        body = rf"$\omega_0/\omega={omega_0_ratio:g}$" if omega_0_ratio else "no mass"
        ax.plot([], [], color=colour, lw=4, label=rf"$\omega\tau={T:g}$, {body}")
    for marker, label in zip("os", ("body", "foot"), strict=True):
        ax.plot([], [], marker, mfc="white", color="0.3", label=label)
    n = np.array([steps[0], steps[-1]], dtype=float)
    ax.loglog(n, (2 * np.pi / n) ** 4, color="0.4", lw=1, ls="--", label="$h^4$")
    ax.set(xlabel="steps per period", ylabel="relative error")
    ticks(ax.xaxis, *steps)
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
