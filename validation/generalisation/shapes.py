"""Four shapes at several depths, under a rigid pull and under bodies.

Every contact exists when its depth grows fastest, as alpha <= 0.6 and T = 0 or 1 here; validation/rigid_pull.py has
what happens else.

In full slip all springs slip at one velocity, so they reach the stick limit together and one v_c serves the array;
that much of the argument holds at any amplitude. What Eq. (15) needs besides is a normal force with a single
harmonic. A curved contact grows and shrinks within the period; for g ~ x^n its stiffness goes as d^(1/n), and to
first order the deviation of v_c is C alpha/n, with one C for every shape (`mdr.laws.first_order`).

A rigid pull has C = 0, and so has a body where nothing dissipates: the power is then 2. Two terms share alpha²: that of
C squared, ~ 1/n², and that of the curvature of F(d), ~ (1 - 1/n)/n; so the shapes no longer differ by 1/n. Both powers
are of small amplitude: further up the deviation turns back and may change its sign.

Symbols: alpha = du_z/u_z0, T = omega tau, n power of the shape (infinite for the punch).
"""

from dataclasses import replace
from functools import cache
from itertools import product
from typing import Any

import numpy as np

import mdr
from mdr import laws
from mdr.tools.arrays import Array
from mdr.tools.progress import progress
from validation.cases import BODY, DEPTH, LOOKS, POWERS, SHAPES, contact, loss, loss_label, shape_label
from validation.figures import figure, key, shape_keys, ticks
from validation.measured import TOLERANCE, Point, measured, power, slope_at_zero, worst
from validation.measured import deviation as deviation_of
from validation.report import Check, Checks, Part, told
from validation.words import counted, listed, number, ranged

PULLS: dict[str, dict[str, Any]] = {
    "rigid pull": {},
    "stiff spring": BODY,  # omega_0 > omega
    "soft spring": BODY | {"omega_0_ratio": 0.6},  # omega_0 < omega
}
ALPHAS = (0.02, 0.1, 0.3, 0.6)
DEPTHS = (0.5 * DEPTH, DEPTH, 2 * DEPTH)
SPAN, LOSSES = (0.25, 4.5), (0.01, 10.0)  # omega_0/omega and T of the map
SMALL = np.geomspace(2.5e-4, 2e-3, 4)  # alphas of the fits
BESIDE = dict(zip(SHAPES, (0.76, 0.9, 1.06, 1.23), strict=True))  # of alpha, so that points of one value all show
LEAST = 3e-9  # deviation that is drawn; only elastic undamped values, good to rounding, come near it


def system(
    shape: str, alpha: float, T: float, pull: str, u_z0: float = DEPTH, damped: bool = True
) -> mdr.SlidingContact:
    """A contact at any depth under the same spring, mass and damper, which belong to the depth of 20 µm."""
    knobs = PULLS[pull] if damped else PULLS[pull] | ({"damping_ratio": 0.0} if PULLS[pull] else {})
    return replace(contact(shape, alpha, T, u_z0=u_z0), pull=contact(shape, alpha, T, **knobs).pull)


@cache
def measure(shape: str, alpha: float, T: float, pull: str, u_z0: float) -> Point:
    """Measure v_c of one contact."""
    body = f"ω_0 = {PULLS[pull]['omega_0_ratio']:g} ω" if PULLS[pull] else pull
    where = f"{shape}, α = {alpha:g}, ωτ = {T:g}, {body}, {u_z0 * 1e6:g} µm deep"
    return measured(system(shape, alpha, T, pull, u_z0), where, shape, alpha, T, pull)


def grid(effort: str) -> list[tuple[str, float, float, str, float]]:
    """Which contacts are measured."""
    if effort == "quick":
        return [
            *((shape, alpha, 0.0, "rigid pull", DEPTH) for shape in ("cone", "r^4") for alpha in (0.02, 0.6)),
            *((shape, 0.6, 0.0, "stiff spring", DEPTH) for shape in ("flat punch", "cone", "paraboloid")),
            ("cone", 0.02, 0.0, "stiff spring", DEPTH),
            ("cone", 0.3, 1.0, "stiff spring", DEPTH),
            ("cone", 0.3, 0.0, "soft spring", 2 * DEPTH),
        ]
    if effort == "long":
        return [(s, a, T, p, d) for s in SHAPES for a in ALPHAS for T in (0.0, 1.0) for p in PULLS for d in DEPTHS]
    shallow, middle, deep = DEPTHS
    chosen = (  # each shape at every depth, amplitude and T, and under a spring at more than one depth
        ("rigid pull", 0.0, ((0.02, middle), (0.6, middle), (0.3, deep))),
        ("rigid pull", 1.0, ((0.02, middle), (0.6, middle), (0.1, shallow))),
        ("stiff spring", 0.0, ((0.02, middle), (0.1, middle), (0.3, middle), (0.6, middle))),
        ("stiff spring", 1.0, ((0.1, middle), (0.6, middle))),
        ("soft spring", 0.0, ((0.1, shallow), (0.6, deep))),
        ("soft spring", 1.0, ((0.3, deep),)),
    )
    found = [(s, a, T, p, d) for s in SHAPES for p, T, pairs in chosen for a, d in pairs]
    far = [("cone", 0.6, 1.0, "stiff spring", depth) for depth in (shallow, deep)]
    return [*found, *far, ("cone", 0.02, 1.0, "stiff spring", middle)]


@cache
def deviation(shape: str, alpha: float, T: float, pull: str, damped: bool = True) -> float:
    """Full-slip value over Eq. (15), less 1."""
    return deviation_of(system(shape, alpha, T, pull, damped=damped))


def constant(shape: str, T: float, pull: str) -> float:
    """Deviation/alpha for alpha -> 0, from two small alphas with the next power taken out."""
    return slope_at_zero(*(system(shape, alpha, T, pull) for alpha in (1e-3, 2e-3)))


def mapped(ratio: float, T: float, alpha: float = 0.1, shape: str = "paraboloid") -> mdr.SlidingContact:
    """A contact of the map: the stiff spring with another mass."""
    return contact(shape, alpha, T, **(BODY | {"omega_0_ratio": ratio}))


def first_order_map(effort: str) -> tuple[Array, Array, Array]:
    """C over omega_0/omega (n,) and T (m,), shape (m, n)."""
    n, m = (61, 13) if effort == "quick" else (241, 65)
    ratios, losses = np.linspace(*SPAN, n), np.geomspace(*LOSSES, m)
    C = [[laws.first_order(mapped(float(r), float(T)), 512) for r in ratios] for T in losses]
    return ratios, losses, np.array(C)


def part(effort: str) -> Part:
    """Shape: a punch, a cone, a paraboloid and r^4

    How: Measure the grid, fit the powers, map the first order.

    Range: {names}; α = {alphas}; elastic and ωτ = 1; depths {depths} µm under the same spring, mass and damper; rigid
    pull, ω_0 = 1.7 ω and 0.6 ω; {velocities}. First order in α over ω_0/ω = {SPAN[0]:g} … {SPAN[1]:g} and ωτ =
    {LOSSES[0]:g} … {LOSSES[1]:g}

    Measured: Rigid pull: Eq. (1) in all of {measurements} ({tested}), to {off:.1e}; each of these contacts is closed at
    the moment of fastest approach. Spring pull: Eq. (15) for the flat punch; for curved shapes it is the limit of small
    amplitude. For small α the deviation is proportional to α times the exponent of the stiffness k_zc ∝ d^{{1/n}}, with
    one factor for all shapes (elastic and undamped: to α^2); for large α it turns back and may change its sign.
    Farthest off: {far_percent:+.1f} % ({far.where}); at α = 0.02: {small_percent:+.2f} % ({small.where}). The full-slip
    condition with all harmonics gives the measured value in all of them, to {miss:.1e}.

    Sentence: For a curved shape under a body the error of Eq. (15) is proportional to α for small α, and to the
    exponent with which the stiffness depends on depth.
    """
    points = [measure(*knobs) for knobs in progress(grid(effort), "shapes")]
    fields = first_order_map(effort)
    rigid = [p for p in points if p.pull == "rigid pull"]
    springs = [p for p in points if p.pull != "rigid pull" and p.shape != "flat punch"]
    far = max(springs, key=lambda p: abs(p.deviation))
    small = max((p for p in springs if p.alpha == 0.02), key=lambda p: abs(p.deviation))
    names = listed(shape for shape in SHAPES if shape in {p.shape for p in points})
    alphas = listed(sorted({p.alpha for p in points}))
    depths = listed(d * 1e6 for d in sorted({p.u_z0 for p in points}))
    velocities = counted(len(points), "measured velocity")
    measurements = counted(len(rigid), "measurement")
    tested = _tested(rigid)
    off = max(abs(p.deviation) for p in rigid)
    far_percent = 100 * far.deviation
    small_percent, miss = 100 * small.deviation, max(abs(p.miss) for p in points)
    return Part(
        **told(part, locals()),
        checks=(*_measured_checks(points), *_power_checks(), *_map_checks()),
        figures=(_glance(points, effort), _powers(effort), _map_figure(*fields)),
    )


def _tested(points: list[Point]) -> str:
    """Shapes, losses and amplitudes of some points."""
    shapes = listed(shape for shape in SHAPES if shape in {p.shape for p in points})
    return f"{shapes}, {listed(loss(T) for T in sorted({p.T for p in points}))}, α {ranged(p.alpha for p in points)}"


def _measured_checks(points: list[Point]) -> Checks:
    why = "bracket 2e-5 of the measurement and (2π/1024)², second order in its step"
    for shape in SHAPES:
        here = [p for p in points if p.shape == shape]
        stiff, soft = [p for p in here if p.pull == "rigid pull"], [p for p in here if p.pull != "rigid pull"]
        exact = {"rigid pull: worst |v_c/Eq. (1) − 1|": stiff}
        if shape == "flat punch":
            exact["spring pull: worst |v_c/Eq. (15) − 1|"] = soft
        for what, found in exact.items():
            if found:
                name = f"{shape}, {what} of {len(found)}"
                yield Check.at_most(name, max(abs(p.deviation) for p in found), TOLERANCE, why)
        if soft and shape != "flat punch":
            name = f"{shape}, spring pull: worst |v_c/full-slip value − 1| of {len(soft)}"
            yield Check.at_most(name, max(abs(p.miss) for p in soft), TOLERANCE, why)
            large = max(soft, key=lambda p: abs(p.deviation))
            name = f"{shape}, spring pull: largest |v_c/Eq. (15) − 1|"
            off = f"Eq. (15) is off by far more than the measurement ({large.where})"
            yield Check.at_least(name, abs(large.deviation), 10 * TOLERANCE, off)
    odd = sum(p.found.kind != "end of stick" for p in points)
    why = "end of stick, least slip velocity and COF name one velocity"
    yield Check(f"measurements of {len(points)} whose signs disagree", odd, 0, 0, why)


def _power_checks() -> Checks:
    kinds = ((0.0, "stiff spring", False), (0.0, "stiff spring", True), (1.0, "stiff spring", True))
    for shape, (T, pull, damped) in product(list(SHAPES)[1:], (*kinds, (1.0, "soft spring", True))):
        where = f"{shape}, {loss(T)}, {pull}{'' if damped else ' undamped'}"
        if damped:
            limit = laws.first_order(system(shape, 0.1, T, pull)) / POWERS[shape]
            why = "C/n; 1e-8 of v_c in the full-slip value is up to 1e-3 of it, and the next power is taken out"
            yield Check(f"{where}: deviation/α for α → 0", constant(shape, T, pull), limit, 2e-3 * abs(limit), why)
        why = "the next power adds up to 5 α, and alphas end at 0.002"
        why += "" if damped else "; rounding of 1e-12 of v_c is below 1 % of the least deviation"
        values = [abs(deviation(shape, float(alpha), T, pull, damped)) for alpha in SMALL]
        yield Check(f"{where}: power of α in the deviation", power(SMALL, values), 1 if damped else 2, 0.02, why)


def _map_checks() -> Checks:
    rng, ratios = np.random.default_rng(15), []
    for shape, _ in product(("cone", "paraboloid", "r^4"), range(6)):
        ratio, T = float(rng.uniform(*SPAN)), float(LOSSES[0] * (LOSSES[1] / LOSSES[0]) ** rng.uniform())
        got = slope_at_zero(*(mapped(ratio, T, alpha, shape) for alpha in (2e-5, 4e-5)))
        ratios.append(got * POWERS[shape] / laws.first_order(mapped(ratio, T)))
    name = f"n times deviation/α for α → 0 over C of the map, worst of {len(ratios)} random places and shapes"
    why = "1e-10 of v_c in the full-slip value over C α; powers beyond the next"
    yield Check(name, worst(ratios, 1.0), 1.0, 2e-3, why)


@figure("glance", 1, 3, size=(9.6, 4.6), sharey=True)
def _glance(fig, axes, points: list[Point], effort: str):
    """Three panels of measured critical velocity over Eq. (15) against amplitude: all on one for a rigid pull, falling
    away from one for curved shapes under a spring pull, the cone rising again at large amplitude.

    Points: critical velocities measured with arrays of springs, over Eq. (15) with the contact stiffness at the mean
    depth. Lines: the full-slip condition. Under a rigid pull ({rigid}; points of one amplitude side by side) all lie
    on 1. Under a spring and a mass (ω_0 = 1.7 ω, damper 5 % of critical, {depth:g} µm deep) only the flat punch does;
    the other lines tend to 1 in proportion to α as it becomes small, and for large α that of the cone turns back and
    crosses 1.{springs}
    """
    hollow = {"mfc": "none", "mew": 1.6, "ms": 7}
    alphas = np.geomspace(0.01, 0.7, 30 if effort == "quick" else 80)
    rigid, springs = ([p for p in points if (p.pull == "rigid pull") is side] for side in (True, False))
    for ax, T in zip(axes, (None, 0.0, 1.0), strict=True):
        pull = "rigid pull" if T is None else "stiff spring"
        title = pull if T is None else f"spring pull, {loss_label(T)}"
        ax.axhline(1.0, color="0.4", lw=0.9, ls="--", zorder=0)
        for shape, (colour, marker) in LOOKS.items():
            if T is not None:
                ax.plot(alphas, [1 + deviation(shape, float(a), T, pull) for a in alphas], color=colour, lw=1.2)
            here = [p for p in points if p.shape == shape and p.pull == pull]
            here = [p for p in here if T is None or (p.T == T and p.u_z0 == DEPTH)]
            beside = BESIDE[shape] if T is None else 1
            values = [1 + p.deviation for p in here]
            ax.plot([p.alpha * beside for p in here], values, marker, color=colour, **hollow)
        ax.set(xscale="log", xlim=(0.009, 0.9), xlabel=r"amplitude $\Delta u_z/u_{z0}$", title=title)
        ticks(ax.xaxis, 0.01, 0.03, 0.1, 0.3)
    axes[0].set_ylabel(r"measured $v_c$ over Eq. (15)")
    fig.legend(handles=shape_keys(**hollow), loc="outside lower center", ncols=4)
    few = f" Measured under a spring were {_tested(springs)}, not all combined."
    return {"rigid": _tested(rigid), "depth": DEPTH * 1e6, "springs": few if effort == "quick" else ""}


@figure("powers", size=(6.8, 4.6))
def _powers(fig, ax, effort: str):
    """Log-log plot of the deviation from Eq. (15) over amplitude, with slopes one and two.

    How fast Eq. (15) becomes exact under a spring pull (ω_0 = 1.7 ω): with α^2 where nothing dissipates (dotted), with
    α as soon as the contact or the system is damped. For small α the shapes then differ by the exponent of their
    stiffness, {elastic} (dashed) and {kelvin} (full); undamped by more, {undamped}. The dip of the cone is a change of
    sign.
    """
    alphas = np.r_[np.geomspace(1e-3, 0.1, 9), np.linspace(0.11, 0.6, 20 if effort == "quick" else 50)]
    kinds = ((0.0, False, ":"), (0.0, True, "--"), (1.0, True, "-"))
    for shape in list(SHAPES)[1:]:
        for T, damped, line in kinds:
            values = np.array([abs(deviation(shape, float(a), T, "stiff spring", damped)) for a in alphas])
            ax.plot(alphas, np.where(values > LEAST, values, np.nan), line, color=LOOKS[shape][0])
    ax.set(xscale="log", yscale="log", ylim=(LEAST, 1))
    ax.set(xlabel=r"amplitude $\alpha = \Delta u_z/u_{z0}$", ylabel="|full-slip value over Eq. (15) − 1|")
    handles = [key(shape_label(shape), color=LOOKS[shape][0]) for shape in list(SHAPES)[1:]]
    for T, damped, line in kinds:
        handles.append(key(f"{loss_label(T)}, {'damper' if damped else 'undamped'}", color="0.3", ls=line))
    ax.legend(handles=handles, loc="lower right", ncols=2)
    return {"elastic": _ratios(0.0, True), "kelvin": _ratios(1.0, True), "undamped": _ratios(0.0, False)}


def _ratios(T: float, damped: bool) -> str:
    """Deviations of the curved shapes at the least of the SMALL amplitudes, over that of the cone."""
    at = [deviation(shape, float(SMALL[0]), T, "stiff spring", damped) for shape in list(SHAPES)[1:]]
    return " : ".join(f"{value / at[0]:.2g}" for value in at)


@figure("map", size=(7.6, 4.4))
def _map_figure(fig, ax, ratios: Array, losses: Array, C: Array):
    """Map of the amplitude at which Eq. (15) is off by 1 %, over natural frequency and relaxation time: dark for
    slow materials and near twice the frequency.

    How small is small? The amplitude Δu_z/u_z0 at which the leading error of Eq. (15), C α/n, is 1 %, for a cone (n =
    1) under a spring of k_x = 1.5 k_x,c with a damper of 5 % of critical; twice that for a paraboloid, four times for
    r^4, as C is the same for all shapes. White lines: 0.001, 0.01 and 0.1. Slow materials and bodies near ω_0 = 2ω,
    whose second harmonic is of first order in α, are the worst: α = {least} at ω_0 = {ratio:.2g} ω, ωτ = {loss:.2g}.
    Fast materials under heavy bodies, ω_0 < ω, are the best, except for a stripe where Eq. (15) itself nearly vanishes,
    near ω_0 = 0.8 ω. Along thin bright lines C changes its sign, and the next order decides.
    """
    from matplotlib.colors import LogNorm

    reach = 0.01 / np.abs(C)
    mesh = ax.pcolormesh(ratios, losses, reach, norm=LogNorm(5e-4, 0.5), cmap="viridis", rasterized=True)
    ax.contour(ratios, losses, reach, (1e-3, 1e-2, 1e-1), colors="white", linewidths=0.8)
    ax.set(yscale="log", xlabel=r"$\omega_0/\omega$", ylabel=r"$\omega\tau$")
    ax.grid(False)
    fig.colorbar(mesh, ax=ax, extend="both", label="amplitude at which Eq. (15) is off by 1 %, cone")
    row, column = np.unravel_index(np.argmin(reach), reach.shape)
    return {"least": number(reach[row, column]), "ratio": ratios[column], "loss": losses[row]}
