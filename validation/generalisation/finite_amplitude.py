"""Finite amplitude: Eq. (15) beside the full-slip v_c and the measured one, up to and beyond the loss of contact.

Eq. (15) keeps one harmonic of the normal force. A curved contact has more at any amplitude, a punch only once it loses
contact; a body with omega_0 near n omega answers the n-th one most. So the error of Eq. (15) is a map over alpha
and omega_0/omega, and the full-slip condition with all harmonics (full_slip_body.py) is the one that is measured.

Curved shapes. For alpha -> 0 the deviation is C alpha/n (`mdr.laws.first_order`), C = 0 where nothing dissipates;
alpha² follows. A light damper alone makes C proportional to itself: the error is of first order below, of second above
an amplitude alpha_x = |C_1/C_2| of the series C_1 alpha + C_2 alpha² + ..., that grows with the damping. Not so at
omega_0 = 2 omega, where the body resonates with the one harmonic that is of first order in alpha: there C ~ 1/damping,
and the error of Eq. (15) is of first order however light the damper. The higher harmonics have higher powers.
Where m omega² = k_x + k_xc, Eq. (15) of an elastic contact is zero but for the damper, and any error is a large share.

A flat punch is exact until it is lost; how it then leaves Eq. (15), and where lost contact leads to in the end:
validation/lost_contact.py.

Symbols: alpha = du_z/u_z0, T = omega tau, n power of the shape, omega_0² = k_x/m.
"""

from dataclasses import dataclass
from functools import cache
from itertools import product

import numpy as np

import mdr
from mdr.tools.arrays import Array
from mdr.tools.progress import progress
from validation.cases import DAMPING, LOOKS, POWERS, SHAPES, STIFFNESS, driven, loss, loss_label, shape_label
from validation.figures import circles, figure, key, outer_labels, shape_keys, ticks
from validation.measured import TOLERANCE, Point, measured, power, worst
from validation.measured import deviation as deviation_of
from validation.report import Check, Checks, Figure, Part, told
from validation.words import counted

RATIOS = (0.3, 0.6, 0.8, 1.2, 1.5, 2.5, 3.5)  # omega_0/omega of the table
ALPHAS = (0.01, 0.03, 0.1, 0.3, 0.6, 1.3, 1.6)
CURVED = ("cone", "paraboloid", "r^4")
RANGE = ((0.01, 1.6), (0.3, 5.5))  # alpha and omega_0/omega of the maps
ZERO = np.sqrt(STIFFNESS / (1 + STIFFNESS))  # omega_0/omega where Eq. (15) of an elastic contact nearly vanishes
ASIDE = 0.5  # from ZERO and from the resonance at 2: omega_0/omega further off than that are aside
BANDS = (0, 1, 3, 10, 30, 100)  # % of the colours of the map
KELVIN = (  # of the full grid, as a Kelvin contact takes some four times longer to measure
    ("flat punch", 0.6, 3.5),
    ("flat punch", 1.3, 1.5),
    ("cone", 0.3, 1.2),
    ("cone", 1.3, 2.5),
    ("paraboloid", 0.1, 2.5),
    ("paraboloid", 1.3, 3.5),
    ("r^4", 0.6, 0.6),
    ("r^4", 1.3, 0.8),
)
RIDGE = (("cone", 0.1, 0.0, 2.0), ("cone", 1.6, 1.0, 2.0))  # on the resonance where Eq. (15) is worst
FEW = (  # of the quick grid
    ("flat punch", 0.1, 0.0, 0.6),
    ("flat punch", 1.3, 0.0, 3.5),
    ("flat punch", 0.6, 1.0, 2.5),
    ("cone", 1.3, 0.0, 2.5),
    ("paraboloid", 1.3, 0.0, 1.5),
    ("r^4", 1.3, 0.0, 3.5),
)


def deviation(shape: str, alpha: float, T: float, ratio: float, damping_ratio: float = DAMPING) -> float:
    """Full-slip value over Eq. (15), less 1."""
    return deviation_of(driven(shape, alpha, T, ratio, damping_ratio))


@cache
def measure(shape: str, alpha: float, T: float, ratio: float) -> Point:
    """Measure v_c of one contact."""
    where = f"{shape}, α = {alpha:g}, ωτ = {T:g}, ω_0 = {ratio:g} ω"
    return measured(driven(shape, alpha, T, ratio), where, shape, alpha, T, ratio)


def _lost(p: Point) -> bool:
    """Whether the whole contact is lost in every period."""
    return bool(p.alpha * np.hypot(1, p.T) > 1)


def grid(effort: str) -> list[tuple[str, float, float, float]]:
    """Which contacts are measured: shape, alpha, T, omega_0/omega."""
    if effort == "quick":
        return list(FEW)
    if effort == "long":
        return [*RIDGE, *((s, a, T, r) for s in SHAPES for T in (0.0, 1.0) for r in RATIOS for a in ALPHAS[1:])]
    # a Latin square: every shape at every alpha and every omega_0, every alpha at more than one omega_0
    square = [(s, (3 * j + 2 * i) % len(ALPHAS), r) for i, s in enumerate(SHAPES) for j, r in enumerate(RATIOS)]
    elastic = [(s, ALPHAS[k], 0.0, r) for s, k, r in square]
    return [*elastic, *((s, a, 1.0, r) for s, a, r in KELVIN), *RIDGE]


@dataclass(frozen=True, eq=False)
class Map:
    """Deviation of the full-slip value from Eq. (15) over alpha and omega_0/omega."""

    shape: str
    T: float
    alphas: Array  # (n_alphas,)
    ratios: Array  # (n_ratios,)
    values: Array  # (n_ratios, n_alphas)

    def share_within(self, bound: float) -> float:
        """Share of the map, log alpha across and omega_0/omega up, where |deviation| is at most so much."""
        area = np.outer(np.diff(_edges(self.ratios)), np.diff(_edges(np.log(self.alphas))))
        return float(area[abs(self.values) <= bound].sum() / area.sum())

    def reach(self, bound: float) -> float:
        """Largest alpha of the map up to which |deviation| is at most so much, aside of ZERO and of 2."""
        aside = np.minimum(abs(self.ratios - 2), abs(self.ratios - ZERO)) > ASIDE
        good = np.logical_and.accumulate((abs(self.values[aside]) <= bound).all(axis=0))
        return float(self.alphas[good][-1]) if good[0] else 0.0

    @property
    def name(self) -> str:
        """Shape and loss in words."""
        return f"{self.shape}, {loss(self.T)}"


def maps(effort: str) -> list[Map]:
    """The maps of the curved shapes, closer where the body resonates with a harmonic."""
    alphas = np.geomspace(*RANGE[0], 8 if effort == "quick" else 24)
    near = (0.0,) if effort == "quick" else (-0.15, -0.06, 0.0, 0.06, 0.15)
    whole, even = [n + shift for n in range(1, 6) for shift in near], 7 if effort == "quick" else 15
    ratios = np.unique(np.r_[whole, ZERO + np.array(near) / 2, np.linspace(*RANGE[1], even)].round(6))
    ratios = ratios[np.r_[True, np.diff(ratios) > 0.02]]
    out = []
    for shape, T in progress([(s, T) for T in (0.0, 1.0) for s in CURVED], "finite_amplitude, maps"):
        values = [[deviation(shape, float(a), T, float(r)) for a in alphas] for r in ratios]
        out.append(Map(shape, T, alphas, ratios, np.array(values)))
    return out


def _farthest(known: list[Map]) -> str:
    """The greatest deviation of all, and where it is."""
    far = max(known, key=lambda m: abs(m.values).max())
    i, j = np.unravel_index(np.argmax(abs(far.values)), far.values.shape)
    where = f"{far.name}, α = {far.alphas[j]:.2g}, ω_0 = {far.ratios[i]:.2g} ω"
    return f"{100 * far.values[i, j]:+.0f} % ({where})"


def _edges(centres: Array) -> Array:
    middle = 0.5 * (centres[1:] + centres[:-1])
    return np.concatenate([centres[:1], middle, centres[-1:]])


def power_of(shape: str, T: float, ratio: float, damping_ratio: float) -> float:
    """Power of alpha in the deviation, at alphas below alpha_x where something dissipates."""
    alphas = np.geomspace(1e-3, 1e-2, 3) if T == damping_ratio == 0 else np.geomspace(1e-5, 1e-4, 3)
    return power(alphas, [abs(deviation(shape, float(alpha), T, ratio, damping_ratio)) for alpha in alphas])


def alpha_x(shape: str, T: float, ratio: float, damping_ratio: float = DAMPING) -> float:
    """|C_1/C_2| of the series of the deviation: its error is of first order below, of second above."""
    alphas = np.array([1, 2, 3, 4]) * 5e-4
    over = [deviation(shape, float(alpha), T, ratio, damping_ratio) / alpha for alpha in alphas]
    *_, C_2, C_1 = np.polyfit(alphas, over, 3)
    return float(abs(C_1 / C_2))


def part(effort: str) -> Part:
    """Amplitude: up to and beyond the loss of contact

    How: Map the deviation, measure the table, fit the powers.

    Quote: Only this “non-jumping” case is considered in the following. — Section 2.2, on Eq. (5)

    Range: {shapes}; elastic and ωτ = 1; k_x = {STIFFNESS:g} k_x,c, damper {damping:g} % of critical; maps over α =
    {RANGE[0][0]:g} … {RANGE[0][1]:g} and ω_0/ω = {RANGE[1][0]:g} … {RANGE[1][1]:g}; {velocities}, {n_lost} of them with
    the whole contact lost in every period (α > 1 elastic, α > {lost_from:.2f} for ωτ = 1).

    Measured: Within 1 % of Eq. (15), as a share of the map: {within}. Farthest off: {farthest}; measured:
    {far_percent:+.0f} % ({far_point.where}). The full-slip value with all harmonics lies in the bracket of every
    measurement, with contact kept or lost, and within {miss:.1e} of the measured one. For small α the error is of first
    order where anything dissipates, of second where nothing does. With the damper alone, elastic cone, second order
    takes over at α = {turns}, in proportion to a light damping. At ω_0 = 2ω it is the other way round: the second
    harmonic, itself of first order in α, drives the body on its resonance, and with this damper 1 % is passed at α =
    {resonant_elastic:.2g} (elastic) and {resonant_kelvin:.2g} (ωτ = 1), the sooner the lighter the damper. The relative
    error is large too beside ω_0 = {ZERO:.2g} ω, where Eq. (15) of an elastic contact itself nearly vanishes:
    {beside:+.1f} % at ω_0 = 0.8 ω, α = 0.03 (cone). On the maps, more than {ASIDE:g} ω aside of both, 1 % is kept by
    every curved shape up to α = {reach_elastic:.2g} (elastic) and {reach_kelvin:.2g} (ωτ = 1). Where a flat punch is
    lost it leaves Eq. (15), by a law of its own (claim on lost contact).

    Sentence: How small is small depends on the body: with this damper, and ω_0 more than {ASIDE:g} ω aside of 2ω and of
    {ZERO:.2g} ω, Eq. (15) is good to 1 % up to α = {reach_elastic:.2g} (elastic) and {reach_kelvin:.2g} (ωτ = 1), but
    only to {resonant_elastic:.2g} and {resonant_kelvin:.2g} at ω_0 = 2ω; the full-slip condition is exact throughout,
    lost contact included.
    """
    points = [measure(*knobs) for knobs in progress(grid(effort), "finite_amplitude, measured")]
    known = maps(effort)
    far_point, lost = max(points, key=lambda p: abs(p.deviation)), [p for p in points if _lost(p)]
    reach_elastic, reach_kelvin = (min(m.reach(0.01) for m in known if m.T == T) for T in (0.0, 1.0))
    crossing = {r: alpha_x("cone", 0.0, r) for r in (1.5, 2.5)}
    # where it is C alpha
    resonant_elastic, resonant_kelvin = (0.01 / abs(deviation("cone", 1e-5, T, 2.0) / 1e-5) for T in (0.0, 1.0))
    shapes = ", ".join(SHAPES)
    damping = 100 * DAMPING
    velocities = counted(len(points), "measured velocity")
    n_lost, lost_from = len(lost), 1 / np.sqrt(2)
    within = "; ".join(f"{m.name}: {100 * m.share_within(0.01):.0f} %" for m in known)
    farthest, far_percent = _farthest(known), 100 * far_point.deviation
    miss = max(abs(p.miss) for p in points)
    turns = "; ".join(f"{value:.2g} (ω_0 = {r:g} ω)" for r, value in crossing.items())
    beside = 100 * deviation("cone", 0.03, 0.0, 0.8)
    return Part(
        **told(part, locals()),
        checks=(*_measured_checks(points), *_power_checks(effort)),
        figures=(_map_figure(known, points), _table_figure(points, effort)),
    )


def _measured_checks(points: list[Point]) -> Checks:
    lost, why = [p for p in points if _lost(p)], "each measurement brings its bracket; both name one velocity"
    out = [p.where for p in points if not p.in_bracket]
    resolution = f"bracket and second order in the step, {TOLERANCE:.1e}, and as much where contact returns within one"
    far = max((p for p in points if p.shape != "flat punch"), key=lambda p: abs(p.deviation))
    kept = [p for p in points if p.shape == "flat punch" and not _lost(p)]
    flew = max((p for p in lost if p.shape == "flat punch"), key=lambda p: abs(p.deviation))
    yield Check(f"measured v_c of {len(points)} whose bracket misses the full-slip value", len(out), 0, 0, why)
    yield Check(f"the same of {len(lost)} with the whole contact lost", sum(not p.in_bracket for p in lost), 0, 0, why)
    yield Check.at_least("shapes measured with the whole contact lost", len({p.shape for p in lost}), 4, "all of them")
    yield Check.at_most("worst |v_c/full-slip value − 1|", max(abs(p.miss) for p in points), 1e-4, resolution)
    why = "end of stick, least slip velocity and COF name one velocity; the damper lets every run settle"
    yield Check("measurements whose signs disagree", sum(p.found.kind != "end of stick" for p in points), 0, 0, why)
    name = f"flat punch in contact: worst |v_c/Eq. (15) − 1| of {len(kept)}"
    yield Check.at_most(name, max(abs(p.deviation) for p in kept), 1e-4, "the force has one harmonic; " + resolution)
    why = f"Eq. (15) is off by far more than the measurement ({flew.where})"
    yield Check.at_least("flat punch lost: largest |v_c/Eq. (15) − 1| measured", abs(flew.deviation), 0.01, why)
    name = "curved shapes: largest |v_c/Eq. (15) − 1| measured"
    yield Check.at_least(name, abs(far.deviation), 0.01, f"the same ({far.where})")


def _power_checks(effort: str) -> Checks:
    ratios = (0.6, 2.5) if effort == "quick" else RATIOS[1:]
    for shape, T, damping_ratio in product(CURVED, (0.0, 1.0), (0.0, DAMPING)):
        expected, why = 1, "α = 1e-5 … 1e-4 is far below α_x, where α^2 takes over: up to 1 % in slope"
        if T == damping_ratio == 0:
            expected, why = 2, "nothing dissipates; α = 0.001 … 0.01, the next power adds a few α"
        got = worst((power_of(shape, T, r, damping_ratio) for r in ratios), expected)
        where = f"{shape}, {loss(T)}, {'damper' if damping_ratio else 'no damper'}"
        yield Check(f"{where}: power of α in the deviation, worst of {len(ratios)} ω_0/ω", got, expected, 0.01, why)
    twice = [alpha_x(s, 0.0, r, DAMPING / 8) / alpha_x(s, 0.0, r, DAMPING / 16) for s in CURVED for r in (1.5, 2.5)]
    why = "first order comes from the damping alone; the next order of a damping of 0.25 % adds up to a few per cent"
    yield Check(f"elastic: α_x at twice the damping, over α_x, worst of {len(twice)}", worst(twice, 2), 2, 0.05, why)
    for T in (0.0, 1.0):
        C = [deviation(s, 1e-5, T, 2.0) / 1e-5 * POWERS[s] for s in CURVED]
        why = "C/n, one C for all; α = 1e-5 times a next order of up to 300"
        name = f"{loss(T)}, ω_0 = 2ω: n times deviation/α for α → 0, worst shape over the cone"
        yield Check(name, worst((c / C[0] for c in C), 1), 1, 5e-3, why)
        half = deviation("cone", 1e-5, T, 2.0, DAMPING / 2) / 1e-5
        why = "the resonance is as high as the damper is light; the other harmonics, of order one, share C with it"
        name = f"cone, {loss(T)}, ω_0 = 2ω: deviation/α at half the damping, over that at {100 * DAMPING:g} %"
        yield Check(name, half / C[0], 2, 0.1, why)


@figure("errors", 2, 3, size=(9.6, 6.6), sharex=True, sharey=True)
def _map_figure(fig, axes, known: list[Map], points: list[Point]):
    """Six maps of the error of Eq. (15) over amplitude and natural frequency: pale at small amplitude and for heavy
    bodies, a ridge where the natural frequency is twice that of the oscillation, darker where the material
    dissipates.

    How far the full-slip v_c with all harmonics is from Eq. (15), up or down, over amplitude and natural frequency of
    the body. Palest: less than 1 %, which is {elastic:.0f} % of the elastic maps and {kelvin:.0f} % of the viscoelastic
    ones. Most is off right of the dotted line, where the whole contact is lost in every period, and at ω_0 = 2ω, where
    the second harmonic of the force drives the body. Greatest: {farthest}. Circles: where v_c was measured.
    """
    from matplotlib.colors import BoundaryNorm

    norm = BoundaryNorm(BANDS, 256, extend="max")
    for ax, one in zip(axes.flat, known, strict=True):
        corners = np.exp(_edges(np.log(one.alphas))), _edges(one.ratios)
        mesh = ax.pcolormesh(*corners, 100 * abs(one.values), norm=norm, cmap="YlGnBu", rasterized=True)
        ax.axvline(1 / np.hypot(1, one.T), color="0.15", lw=1, ls=":")
        here = [p for p in points if (p.shape, p.T) == (one.shape, one.T)]
        if here:
            circles(ax, [p.alpha for p in here], [p.pull for p in here], "0.15", ms=5, clip_on=False)
        ax.set(xscale="log", xlim=RANGE[0], ylim=RANGE[1], title=f"{shape_label(one.shape)}, {loss_label(one.T)}")
        ax.grid(False)
        ticks(ax.xaxis, 0.01, 0.03, 0.1, 0.3, 1)
    outer_labels(axes, r"amplitude $\Delta u_z/u_{z0}$", r"$\omega_0/\omega$")
    fig.colorbar(mesh, ax=axes, ticks=BANDS, aspect=35, pad=0.02, label="$v_c$ off Eq. (15) by [%]")
    by_T = {T: np.mean([m.share_within(0.01) for m in known if m.T == T]) for T in (0.0, 1.0)}
    return {"elastic": 100 * by_T[0.0], "kelvin": 100 * by_T[1.0], "farthest": _farthest(known)}


def _table_figure(points: list[Point], effort: str) -> Figure:
    rows = 2 if effort == "quick" else 4
    return figure("table", rows, 4, size=(9.6, 2.15 * rows), sharex=True)(_table)(points)


def _table(fig, axes, points: list[Point]):
    """Panels of critical velocity over amplitude, one for each natural frequency, elastic above and viscoelastic
    below: all shapes start on the dashed line of Eq. (15); the punch leaves it at the dotted line.

    The critical velocity over shape, natural frequency and amplitude: Eq. (15) (dashed, one value for all shapes and
    amplitudes), full slip with all harmonics (lines) and {n} measured values (symbols), which lie on the lines to
    {miss:.1e}. The flat punch follows Eq. (15) up to the dotted line, where it loses contact, and then leaves it:
    {off:+.0f} % measured at α = {alpha:g}, ωτ = {T:g}, ω_0 = {ratio:g} ω.
    """
    n_low, n_high = (14, 20) if len(axes) > 2 else (4, 5)
    ratios, rows = (RATIOS, 2) if len(axes) > 2 else ((0.6, 2.5, 3.5), 1)  # rows for each material
    alphas = np.r_[np.geomspace(RANGE[0][0], 0.5, n_low), np.linspace(0.55, RANGE[0][1], n_high)]
    for k, T in enumerate((0.0, 1.0)):
        panels = axes[rows * k : rows * (k + 1)].flat
        for ax, ratio in zip(panels, ratios, strict=False):
            case = driven("cone", 0.1, T, ratio)
            unit = mdr.critical_velocity(case) / case.unit_velocity
            for shape, (colour, marker) in LOOKS.items():
                ax.plot(alphas, [unit * (1 + deviation(shape, float(a), T, ratio)) for a in alphas], color=colour)
                here = [p for p in points if (p.shape, p.T, p.pull) == (shape, T, ratio)]
                ax.plot([p.alpha for p in here], [unit * (1 + p.deviation) for p in here], marker, color=colour)
            ax.axhline(unit, color="0.2", lw=1, ls="--")
            ax.axvline(1 / np.hypot(1, T), color="0.4", lw=0.8, ls=":")
            low, high = ax.get_ylim()
            least = 0.02 * unit  # half width, so that a line within 1 % of Eq. (15) looks like one
            ax.set(xscale="log", xlim=(0.008, 2), ylim=(min(low, unit - least), max(high, unit + least)))
            ticks(ax.xaxis, 0.01, 0.1, 1)
            ax.set_title(rf"{loss_label(T)}, $\omega_0$ = {ratio:g} $\omega$", fontsize=9)
            ax.tick_params(labelsize=8)
    for ax in (axes[rows - 1, 3], axes[-1, 3]):
        ax.axis("off")
    others = [key("Eq. (15)", color="0.2", ls="--", lw=1), key("contact lost", color="0.4", ls=":", lw=0.8)]
    axes[rows - 1, 3].legend(handles=[*shape_keys(), *others], loc="center")
    for ax in axes[::rows, 3] if rows > 1 else ():
        ax.tick_params(labelbottom=True)
    fig.supxlabel(r"amplitude $\Delta u_z/u_{z0}$", fontsize=11)
    fig.supylabel("$v_c$ over Eq. (1)", fontsize=11)
    shown = [p for p in points if p.pull in ratios]
    lost = [p for p in shown if p.shape == "flat punch" and _lost(p)]
    far = max(lost, key=lambda p: abs(p.deviation))
    return {
        "n": len(shown),
        "miss": max(abs(p.miss) for p in shown),
        "off": 100 * far.deviation,
        "alpha": far.alpha,
        "T": far.T,
        "ratio": far.pull,
    }
