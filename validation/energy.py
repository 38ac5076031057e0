"""What the pull and the normal drive supply is lost in friction, in the material and in the damper, or stored.

Every term comes from its own definition, none as the difference of others: friction mu_0 F_N times slip velocity,
spring by spring; viscous gamma s_dot² and gamma e_dot²; damper c_x y_dot²; pull v_0 times its force; normal drive F_N
u_z_dot. A wrong law of friction, of detachment or of the body would leave a residual that refinement does not remove.

In full slip, above v_c, the terms are known without any march, from the normal force over the period (P = 2
pi/omega): pull mu_0 <F_N> v_0 P; friction the integral of mu_0 F_N (v_0 + y_dot - mu_0 kappa u_z_dot), y_dot by the
receptance H of the pull; for the flat punch viscous pi gamma_zc omega du_z² (1 + mu_0² kappa), damper pi c_x omega
(mu_0 |K_z| du_z |H|)², K_z = k_zc (1 + i T).

Symbols: n steps per period, h = 2 pi/n, T = omega tau, alpha = du_z/u_z0, relative residual: (supply - use)/losses.
"""

from dataclasses import dataclass
from functools import cache
from itertools import product
from typing import Any

import numpy as np

import mdr
from mdr.closed_forms.full_slip import normal_force_harmonics
from mdr.tools.arrays import Array
from validation.cases import SWUNG, contact, loss
from validation.figures import COLOURS, figure, ticks
from validation.full_slip import full_slip
from validation.measured import power
from validation.report import Check, Checks, Claim, told
from validation.words import span

# a factor of 16, without common factors, so that kinks fall anywhere
LEVELS = tuple(round(64 * 16 ** (i / 10)) for i in range(11))
SHARES = {
    "quick": (0.3, 0.55, 0.8),
    "full": tuple(np.linspace(0.2, 0.9, 10)),
    "long": tuple(np.linspace(0.2, 0.9, 24)),
}
PULLS: dict[str, dict[str, Any]] = {"rigid pull": {}, "spring pull": SWUNG}
PERIODS = 24
STEP = (2 * np.pi / LEVELS[-1]) ** 2  # h² at the finest level
ROUNDING = 1e-11  # of the losses, which PERIODS * 1024 steps of 128 springs add up


@dataclass(frozen=True)
class Balance:
    """The energies of one case under refinement."""

    name: str
    residual: Array  #: (n_levels,) relative, root mean square over velocities
    example: mdr.SlidingRun  #: at the finest level and half of v_c

    @property
    def exact(self) -> bool:
        """Whether nothing but rounding is left: no body moves in the step."""
        return "rigid pull" in self.name

    @property
    def order(self) -> float:
        """With which the residual falls."""
        return -power(LEVELS, self.residual)


def balance(shape: str, alpha: float, T: float, pull: str, shares: tuple[float, ...]) -> Balance:
    """Energies at velocities below v_c, where springs stick and slip, over the levels; the springs stay the same."""
    case = contact(shape, alpha, T, **PULLS[pull])
    v_c = mdr.full_slip_critical_velocity(case)

    def run(share: float, n: int) -> mdr.SlidingRun:
        return mdr.slide(case, share * v_c, n_springs=128, steps_per_period=n, n_periods=PERIODS)

    residual = [np.sqrt(np.mean([run(share, n).energy_balance.relative ** 2 for share in shares])) for n in LEVELS]
    kept = "contact kept" if case.keeps_contact else "contact lost"
    return Balance(f"{shape}, {kept}, {loss(T)}, {pull}", np.array(residual), run(0.5, LEVELS[-1]))


def in_full_slip(case: mdr.SlidingContact, v_0: float) -> dict[str, float]:
    """The energies [J] of one period of full slip, from the normal force alone."""
    F_N, u_z_dot = full_slip(case)
    period, mu_0, kappa = case.oscillation.period, case.mu_0, case.material.mindlin_ratio
    F_n = normal_force_harmonics(case)
    omega_n = np.arange(F_n.size) * case.oscillation.omega
    y_n = -mu_0 * F_n * np.asarray(case.pull.receptance(omega_n))
    y_dot = np.fft.irfft(1j * omega_n * y_n, F_N.size) * F_N.size
    c_x = case.pull.c_x if isinstance(case.pull, mdr.SpringPull) else 0.0
    slip = v_0 + y_dot - mu_0 * kappa * u_z_dot
    return {
        "pull_work": mu_0 * float(F_n[0].real) * v_0 * period,
        "normal_work": float(np.mean(F_N * u_z_dot)) * period,
        "friction_loss": mu_0 * float(np.mean(F_N * slip)) * period,
        "damper_loss": c_x * float(np.mean(y_dot**2)) * period,
    }


def claim(effort: str) -> Claim:
    """Energy is conserved

    How: Balance the energies of sticking and slipping contacts, and set those of full slip beside their closed forms.

    Range: {shapes}, contact kept (but for the edge of a curved shape) and lost, elastic and ωτ = 1, rigid pull and
    spring pull with a damper, {n_shares} velocities below v_c; {LEVELS[0]} to {most_steps} steps. Full slip at 1.5 v_c

    Measured: Under a rigid pull the balance closes to rounding, {rounding:.1e} of the losses. With a body what is
    missing falls with the power {orders_found} of the step and is at most {finest:.1e} of the losses at {most_steps}
    steps; in full slip every term agrees with its closed form.

    Verdict: holds

    Sentence: What the pull and the normal drive supply is found again as friction, viscous and damper loss, each from
    its own definition.
    """
    grid = [("flat punch", 0.3), ("paraboloid", 0.3), ("paraboloid", 1.5)]
    if effort == "quick":
        grid = grid[1:]
    which = [(shape, alpha, T, pull) for shape, alpha in grid for pull in PULLS for T in (0.0, 1.0)]
    balances = [balance(*one, SHARES[effort]) for one in which]
    orders = [b.order for b in balances if not b.exact]
    finest = max(float(b.residual[-1]) for b in balances)
    rounding = max(float(np.max(b.residual)) for b in balances if b.exact)
    shapes = " and ".join(dict.fromkeys(shape for shape, _ in grid))
    n_shares = len(SHARES[effort])
    most_steps, orders_found = LEVELS[-1], span(orders)
    return Claim(
        **told(claim, locals()),
        checks=(*_balance_checks(balances), *_full_slip_checks(effort)),
        figures=(_figure(balances),),
    )


def _balance_checks(balances: list[Balance]) -> Checks:
    for b in balances:
        if b.exact:
            why = "springs are exact from event to event, and their depth is given: rounding is left"
            name = f"{b.name}: greatest relative residual, {LEVELS[0]} to {LEVELS[-1]} steps"
            yield Check.at_most(name, np.max(b.residual), ROUNDING, why)
            continue
        why = "slope of the least-squares line over a factor of 16; the damper is known from instant to instant"
        yield Check.at_least(f"{b.name}: order of the residual in the step", b.order, 1.9, why)
        name = f"{b.name}: relative residual at {LEVELS[-1]} steps"
        yield Check.at_most(name, b.residual[-1], STEP, "h², h = 2π/1024")


def _full_slip_checks(effort: str) -> Checks:
    why = "h², h = 2π/1024: each term is a sum over the steps of the period"
    shapes = ("flat punch", "paraboloid") if effort != "quick" else ("flat punch",)
    for shape, T in product(shapes, (0.0, 1.0)):
        case, run = _slipping(shape, T)
        for term, expected in in_full_slip(case, run.v_0).items():
            if expected > 1e-9 * run.energy_balance.pull_work:
                name = f"full slip, {shape}, ωτ = {T:g}: {term.replace('_', ' ')} over its integral"
                # the damper belongs to the body, whose response to the force is resolved with its own oscillation
                times, more = (4, "; twice for a square, twice for the body") if term == "damper_loss" else (1, "")
                yield Check(name, getattr(run.energy_balance, term) / expected, 1.0, times * STEP, why + more)
    case, run = _slipping("flat punch", 1.0)
    omega, du_z, kappa = case.oscillation.omega, case.oscillation.du_z, case.material.mindlin_ratio
    viscous = np.pi * case.gamma_zc * omega * du_z**2 * (1 + case.mu_0**2 * kappa)
    name = "full slip, flat punch, ωτ = 1: viscous loss over π γ_zc ω Δu_z² (1 + mu_0² κ)"
    yield Check(name, run.energy_balance.viscous_loss / viscous, 1.0, STEP, why)


@cache
def _slipping(shape: str, T: float) -> tuple[mdr.SlidingContact, mdr.SlidingRun]:
    """A contact and its run in full slip."""
    case = contact(shape, 0.3, T, **SWUNG)
    v_0 = 1.5 * mdr.full_slip_critical_velocity(case)
    return case, mdr.slide(case, v_0, n_springs=256, steps_per_period=1024, n_periods=8)


@figure("balance", 1, 2, size=(9.8, 4.2), width_ratios=(1.2, 1))
def _figure(fig, axes, balances: list[Balance]):
    """Stacked bars of energies supplied and lost, of equal length, and residuals: with a body falling with the
    second power of the steps, under a rigid pull at rounding.

    Left: what the pull and the normal drive supply in a period (upper bar) and where it goes (lower bar), at half of
    v_c, paraboloid, ωτ = 1; the bars end together. Right: what is missing, for all {n} contacts: with a body it falls
    with the second power of the step, else it is rounding.
    """
    bars, ax = axes
    _draw_bars(bars, [b for b in balances if b.name.startswith("paraboloid") and "ωτ = 1" in b.name])
    n = np.array(LEVELS, dtype=float)
    for b in balances:
        colour, elastic = COLOURS["spring" in b.name], "elastic" in b.name
        ax.plot(n, b.residual, "-" if elastic else "--", color=colour, lw=1.1)
    top = 3 * max(float(b.residual[0]) for b in balances)
    ax.plot(n, top * (n[0] / n) ** 2, color="0.6", ls=":", lw=1.4, label="second order")
    for colour, pull in zip(COLOURS, PULLS, strict=False):
        ax.plot([], [], color=colour, label=pull)
    ax.plot([], [], "--", color="0.3", label=r"$\omega\tau$ = 1, else elastic")
    ax.set(xscale="log", yscale="log", xlabel="steps per period", ylabel="missing, over the losses")
    ticks(ax.xaxis, 64, 128, 256, 512, 1024)
    ax.legend(loc="lower left")
    return {"n": len(balances)}


def _draw_bars(ax: Any, balances: list[Balance]) -> None:
    """Supply above and losses below, as shares of the supply."""
    supplies = (("pull", "pull_work", COLOURS[0]), ("normal drive", "normal_work", COLOURS[4]))
    losses = [(name, f"{name}_loss", COLOURS[i]) for name, i in (("friction", 1), ("viscous", 3), ("damper", 6))]
    place = np.arange(len(balances), dtype=float)[::-1]
    runs = [b.example.energy_balance for b in balances]
    total = np.array([run.pull_work + run.normal_work for run in runs])
    for offset, terms in ((0.18, supplies), (-0.18, losses)):
        left = np.zeros(len(runs))
        for name, term, colour in terms:
            share = np.array([getattr(run, term) for run in runs]) / total
            ax.barh(place + offset, share, 0.34, left=left, color=colour, label=name)
            left += share
    names = [b.name.split(", ") for b in balances]  # shape, contact, loss, pull
    ax.set_yticks(place, [f"{contact},\n{pull}" for _, contact, _, pull in names])
    ax.set(xlabel="share of the supply", xlim=(0, 1.01))
    ax.legend(loc="lower center", bbox_to_anchor=(0.4, 1.0), ncols=5, handlelength=1, columnspacing=1)
