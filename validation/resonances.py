"""Resonances: where the natural frequency of the body is a whole multiple of the frequency of the oscillation.

A contact shaken at omega drives the body with the harmonics F_n of its normal force. Where omega_0 = n omega and
nothing damps the body, the n-th one feeds its free oscillation without end; friction in full slip, mu_0 F_N(t), does
not hold it back. The swing grows until the body, at y' = -v_0, comes to rest on the indenter once in each of its own
periods. There springs stick, and friction stays short of mu_0 F_N by delta(t) in n short pulses a period. A steady
motion needs

    the n-th harmonic of mu_0 F_N - delta to vanish:  <delta> = mu_0 |F_n|,

as short pulses, all at one phase of the own oscillation, have a mean as large as their n-th harmonic. So mu/mu_0 ->
1 - |F_n|/F_0 at any velocity, however high (`mdr.laws.harmonic_share`). At finite velocity the pulses last for a time ~
v_0^(-1/4) of the period and this is exceeded by a share ~ v_0^(-1/2), their square.

Close to a resonance, or damped, v_c is finite, and has poles of first order (`mdr.laws.resonance_residue`). Where the
force has no n-th harmonic the undamped body locks in (`mdr.laws.lock_in`); off the multiple, or damped, a little stick
is needed in every period to hold the oscillation, and a little friction is missing up to Eq. (15).

Symbols: F_n complex harmonics of the normal force in full slip, F_0 its mean; alpha = du_z/u_z0, T = omega tau.
"""

from functools import cache
from itertools import product
from typing import Any

import numpy as np

import mdr
from mdr import laws
from mdr.tools.progress import progress
from validation.cases import contact, loss
from validation.figures import COLOURS, figure, ticks
from validation.measured import TOLERANCE, power, worst
from validation.report import Check, Checks, Claim, told
from validation.words import listed, percent

ALPHA, STIFFNESS = 0.3, 1.5  # du_z/u_z0, k_x/k_xc
MULTIPLES = (1, 2, 3, 4, 5)
FAST = (5, 20, 100)  # velocities over Eq. (15), on its own pole over Eq. (1)
BESIDE = (0.98, 1.005)  # velocities over the law of lock-in, at which friction is reduced, and full
LEAST = 5e-6  # share of F_0 that a harmonic must have for its reduction of the COF to stand out of the error of a run
LOOKS = {"flat punch": (COLOURS[0], "s"), "paraboloid": (COLOURS[2], "o")}


def system(shape: str, T: float, ratio: float, damping_ratio: float = 0.0) -> mdr.SlidingContact:
    """A body with omega_0 = ratio * omega."""
    return contact(shape, ALPHA, T, k_ratio=STIFFNESS, omega_0_ratio=ratio, damping_ratio=damping_ratio)


@cache
def share(shape: str, T: float, n: int) -> float:
    """|F_n|/F_0 of the normal force in full slip."""
    return laws.harmonic_share(system(shape, T, n), n)


def unit(case: mdr.SlidingContact, n: int) -> float:
    """Eq. (15) of a case [m/s], or Eq. (1) on its pole."""
    return case.unit_velocity if n == 1 else mdr.critical_velocity(case)


@cache
def reduction(shape: str, T: float, n: int, speed: float) -> tuple[float, float]:
    """1 - cof/mu_0 on the undamped resonance at a speed in units of `unit`, and its error; NaN while its swing
    still grows.
    """
    case = system(shape, T, n)
    run = mdr.slide(case, speed * unit(case, n), n_springs=192, steps_per_period=1024)
    if run.kind == "unsettled":
        return np.nan, np.nan
    return 1 - run.cof / run.mu_0, run.cof_error / run.mu_0


def contacts(effort: str) -> list[tuple[str, float, int]]:
    """Shape, T and multiple."""
    if effort == "quick":
        return [("flat punch", 0.0, 1), ("flat punch", 0.0, 2), ("paraboloid", 0.0, 2)]
    return [(s, T, n) for s in LOOKS for T in (0.0, 1.0) for n in MULTIPLES]


def claim(effort: str) -> Claim:
    """Eq. (15) gives v_c also where the body resonates

    How: COF far above Eq. (15) on every resonance, v_c with and without damping, the width of the window.

    Quote: Another notable feature is the presence of two resonant frequencies, in particular ω = √(k_x/m) where v_c
    becomes infinite. Numerical experiments show that in this case, the coefficient of friction reaches a plateau (which
    is less than μ_0) at fairly low sliding velocities and does not change thereafter. (Section 1, on Eq. (2))

    Range: {shapes}, Δu_z/u_z0 = {ALPHA:g}, k_x = {STIFFNESS:g} k_x,c; ωτ = {times}; ω_0/ω = {multiples}; without damper
    and with one of 1 %; velocities up to {fastest} times Eq. (15).

    Measured: Eq. (15) has one pole, ω_0 = ω. A punch has one harmonic and does just that. A curved contact has more (a
    paraboloid all of them), and an undamped body with ω_0 = nω has no critical velocity where there is an n-th: its
    swing grows until it comes to rest on the indenter once in each of its own periods, and at any velocity, however
    high, the COF stays below 1 − |F_n|/F_0 of μ_0, to which it tends. There it is lower than μ_0 by {reduced}. This
    share goes like α^n for an elastic contact, like α^2 for a viscoelastic one. With a damper of 1 % there is a
    critical velocity again, that of full slip with all harmonics; it is off Eq. (15) by up to {far_percent:+.0f} %
    ({far_name}). Where the force has no n-th harmonic the undamped body locks in: a free oscillation in step with the
    drive keeps every spring from sticking, and friction is full from cos(π/2n) of Eq. (15) on
    ({locked}).{still}{faint_ones}

    Verdict: fails when ω_0 is a whole multiple nω of ω, n ≥ 2

    Sentence: Eq. (15) has one pole; a contact whose stiffness grows with depth has one at each ω_0 = nω of its force:
    without damping friction stays reduced by |F_n|/F_0 or more at any velocity.
    """
    known = contacts(effort)
    driven = [knobs for knobs in known if share(*knobs) > LEAST]
    idle = [knobs for knobs in known if share(*knobs) < 1e-12]
    faint = [knobs for knobs in known if 1e-12 <= share(*knobs) <= LEAST]
    ends = {knobs: _end(*knobs, 0.0) for knobs in progress(driven, "resonances")}
    damped = {knobs: _end(*knobs, 0.01) for knobs in known if knobs[2] <= 3}
    speeds = FAST[1:2] if effort == "quick" else FAST
    checks = [*_end_checks(driven, ends, damped), *_lock_in_checks(idle), *_plateau_checks(driven, speeds)]
    far = max(damped.items(), key=lambda item: abs(item[1][0] or np.nan))
    growing = [f"{_name(knobs)} at {v} v_c" for knobs in driven for v in speeds if np.isnan(reduction(*knobs, v)[0])]
    unseen = "; ".join(f"{s}, ωτ = {T:g}, ω_0 = {n}ω: |F_n|/F_0 = {share(s, T, n):.1e}" for s, T, n in faint)
    shapes, times = " and ".join(LOOKS), listed(sorted({T for _, T, _ in known}))
    multiples, fastest = listed(sorted({n for _, _, n in known})), max(speeds)
    reduced = "; ".join(f"{percent(share(*knobs))} ({_name(knobs)})" for knobs in driven)
    far_percent, far_name = 100 * ((far[1][0] or np.nan) - 1), _name(far[0])
    locked = "; ".join(f"{_name(knobs)}: {laws.lock_in(knobs[2]):.4f}" for knobs in idle)
    still = f" Still growing at the end of the longest run: {', '.join(growing)}." if growing else ""
    faint_ones = f" Too faint to be told from the error of a run: {unseen}." if unseen else ""
    return Claim(
        **told(claim, locals()),
        checks=(*checks, *_pole_checks(driven), *_order_checks()),
        figures=(_plateau_figure(driven, speeds), _window_figure(effort, damped)),
    )


def _name(knobs: tuple[str, float, int]) -> str:
    shape, T, n = knobs
    return f"{shape}, {loss(T)}, ω_0 = {n}ω"


def _end(shape: str, T: float, n: int, damping_ratio: float) -> tuple[float | None, float]:
    """Measured v_c over Eq. (15) or None, and over the full-slip value."""
    case = system(shape, T, n, damping_ratio)
    found = mdr.measure_critical_velocity(case)
    if found.v_c is None:
        return None, np.nan
    return found.v_c / mdr.critical_velocity(case), found.v_c / mdr.full_slip_critical_velocity(case)


def _end_checks(driven: list[Any], ends: dict[Any, Any], damped: dict[Any, Any]) -> Checks:
    found = sum(ends[knobs][0] is not None for knobs in driven)
    why = "the harmonic drives the body up to stick at any velocity"
    yield Check(f"resonances of {len(driven)} driven ones on which a v_c was found", found, 0, 0, why)
    whole = sum(not np.isinf(mdr.full_slip_critical_velocity(system(*knobs))) for knobs in driven)
    yield Check(f"driven resonances of {len(driven)} with a finite full-slip value", whole, 0, 0, why)
    name = f"v_c over the full-slip value, damper of 1 %, worst of {len(damped)} resonances"
    why = "bracket 2e-5 of the measurement and (2π/1024)², second order in its step"
    yield Check(name, worst((end[1] for end in damped.values()), 1), 1.0, TOLERANCE, why)


def _lock_in_checks(idle: list[Any]) -> Checks:
    """Friction on either side of the law, where nothing drives the free oscillation of the body."""
    why = "law of lock-in: a free oscillation in step with the drive keeps springs from sticking; error of the run"
    for knobs in idle:
        case = system(*knobs)
        law, (low, high) = laws.lock_in(knobs[2]) * mdr.critical_velocity(case), BESIDE
        below, above = (mdr.slide(case, share * law, n_springs=192, steps_per_period=1024) for share in (low, high))
        name = f"times cos(π/2n) of Eq. (15), no damper: {_name(knobs)}"
        yield Check.at_most(f"1 − COF/μ_0 at {high} {name}", 1 - above.cof / above.mu_0, above.cof_error, why)
        yield Check.at_least(f"1 − COF/μ_0 at {low} {name}", 1 - below.cof / below.mu_0, 3 * below.cof_error, why)


def _plateau_checks(driven: list[Any], speeds: tuple[int, ...]) -> Checks:
    why = "law of short pulses; their width adds up to 0.3 (v/v_c)^(-1/2), their size |F_n|/F_0; error of the run"
    for knobs, speed in product(driven, speeds):
        (got, error), law = reduction(*knobs, speed), share(*knobs)
        if np.isnan(got):  # said in words
            continue
        # pulses of a width ~ v^(-1/4) exceed the law by its square, at most 0.3 at v = 1; error of the run
        tolerance = 0.3 * speed**-0.5 + law + error / law
        yield Check(f"(1 − COF/μ_0) F_0/|F_n| at {speed} v_c: {_name(knobs)}", got / law, 1.0, tolerance, why)
    n_found = sum(not np.isnan(reduction(*knobs, v)[0]) for knobs in driven for v in speeds)
    why = "a steady motion is solved for; the faintest harmonics drive too slowly at the highest speeds to be sure"
    why += " of it"
    name = f"runs of {len(driven) * len(speeds)} that are steady"
    yield Check.at_least(name, n_found, 0.8 * len(driven) * len(speeds), why)
    fall = [(reduction("flat punch", 0.0, 1, v)[0] / share("flat punch", 0.0, 1) - 1) for v in (4, 16, 64)]
    why = "pulses of a width ~ v^(-1/4) exceed the law by the square of it; the next order is not small at v = 4"
    name = "power of the velocity with which the punch comes down to the law"
    yield Check(name, power((4, 16, 64), fall), -0.5, 0.1, why)


def _pole_checks(driven: list[Any]) -> Checks:
    """The residue of v_c at the pole from full-slip values at a small detuning on both sides."""
    for shape, T, n in driven:
        case = system(shape, T, n)
        residue = laws.resonance_residue(case, n)
        shift = 1e-3 * residue / unit(case, n)  # v_c is then about a thousand times its usual value
        both = [mdr.full_slip_critical_velocity(system(shape, T, n * (1 + side * shift / n))) for side in (-1, 1)]
        name = f"v_c |ω_0/ω − n| m ω/(μ_0 |F_n|): {_name((shape, T, n))}"
        why = "the other harmonics add up to a few thousandths at that detuning"
        yield Check(name, float(np.mean(both)) * shift / residue, 1.0, 5e-3, why)


def _order_checks() -> Checks:
    """The power of alpha in |F_3|/F_0 of the paraboloid."""
    alphas = np.array([0.02, 0.03, 0.04])
    for T, expected in ((0.0, 3), (1.0, 2)):
        shares = [laws.harmonic_share(contact("paraboloid", float(alpha), T), 3) for alpha in alphas]
        name = f"power of α in |F_3|/F_0: paraboloid, ωτ = {T:g}"
        yield Check(name, power(alphas, shares), expected, 0.1, "the next power of α is a few α of it")


@figure("plateau", size=(7.2, 4.6))
def _plateau_figure(fig, ax, driven: list[Any], speeds: tuple[int, ...]):
    """Reduction of friction over the share of the driving harmonic, falling to one with the velocity.

    Friction of an undamped body on its resonances, elastic, far above the velocity of Eq. (15), from runs (symbols). It
    does not come back to μ_0: what is missing comes down to |F_n|/F_0, the share of the harmonic of the normal force
    that drives the body, like v_0^{{−1/2}}, and never below it.
    """
    shown = [knobs for knobs in driven if knobs[1] == 0.0]
    velocities = np.geomspace(1.5, max(speeds), 6 if len(speeds) == 1 else 14)
    for shape, T, n in shown:
        law = share(shape, T, n)
        over = np.array([reduction(shape, T, n, float(v))[0] for v in velocities]) / law
        name = f"{shape}, $\\omega_0 = {n if n > 1 else ''}\\omega$: $|F_n|/F_0$ = {percent(law)}"
        ax.plot(velocities, over, "os^vD"[n - 1], ms=6, mfc="w", color=LOOKS[shape][0], label=name)
    ax.axhline(1.0, color="0.3", lw=1.0)
    ax.set(xscale="log", xlim=(1.2, 1.25 * max(speeds)), ylim=(0.98, None))
    ax.set(xlabel="$v_0$ over Eq. (15), on its pole over Eq. (1)", ylabel=r"$(1 - \mu/\mu_0)$ over $|F_n|/F_0$")
    ax.legend(loc="upper right")
    ticks(ax.xaxis, *(2, 5, 10, 20, 50, 100)[: 4 if len(speeds) == 1 else 6])


@figure("window", 1, 2, size=(9.6, 4.2), sharey=True)
def _window_figure(fig, axes, effort: str, damped: dict[Any, Any]):
    """Critical velocity over natural frequency: spikes at whole multiples for the paraboloid, one for the punch.

    Critical velocity in full slip over the natural frequency of the body. The punch has the one pole of Eq. (15); the
    paraboloid has one at every whole multiple, the narrower the higher, and wider where the material dissipates and the
    force is less sinusoidal. A damper of 1 % (dotted) leaves the first two. Symbols: measured, with damper{only}.
    """
    aside = np.geomspace(1e-4, 0.45, 7 if effort == "quick" else 40)
    near = [n + side * s for n in MULTIPLES for side in (-1, 1) for s in aside]
    even = np.linspace(0.55, 5.5, 30 if effort == "quick" else 120)
    ratios = np.unique(np.array([r for r in [*near, *even] if r > 0.55]))
    for ax, T in zip(axes, (0.0, 1.0), strict=True):
        for shape, (colour, marker) in LOOKS.items():
            for damping_ratio, line in ((0.0, "-"), (0.01, ":")):
                cases = [system(shape, T, float(r), damping_ratio) for r in ratios]
                values = [mdr.full_slip_critical_velocity(case) / case.unit_velocity for case in cases]
                label = f"{shape}, {'no damper' if damping_ratio == 0 else 'damper 1 %'}"
                ax.plot(ratios, values, line, color=colour, lw=1.2, label=label)
            here = [(n, end[0]) for (*one, n), end in damped.items() if one == [shape, T]]
            if here:
                cases = [system(shape, T, n, 0.01) for n, _ in here]
                units = [mdr.critical_velocity(case) / case.unit_velocity for case in cases]
                found = [end * unit for (_, end), unit in zip(here, units, strict=True)]
                ax.plot([n for n, _ in here], found, marker, color=colour, mec="white", mew=0.6, ms=7)
        ax.set(yscale="log", ylim=(0.8, 60), xlim=(0.55, 5.5), xlabel=r"$\omega_0/\omega$")
        ax.set_title("elastic" if T == 0 else rf"Kelvin, $\omega\tau = {T:g}$")
    axes[0].set_ylabel("full-slip $v_c$ over Eq. (1)")
    fig.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return {"only": ", elastic only" if effort == "quick" else ""}
