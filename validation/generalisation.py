"""Eq. (15) for general contacts: exact for a rigid pull and for the flat punch, the limit of small amplitude for all
others; as long as the contact exists when the depth grows fastest (validation/rigid_pull.py: a surface that comes back
late, or tapping, ends it), which it does at the alpha <= 0.6 and T = 0 and 1 tested here.

In full slip all springs slip at one velocity, so they reach the stick limit together and one v_c serves the array;
that much of the argument holds at any amplitude. What Eq. (15) needs besides is a normal force with a single
harmonic. A curved contact grows and shrinks within the period; for g ~ x^n its stiffness goes as d^(1/n), and to
second order in du_z

    F_N = F(u_z0) + k_zc du_z [p + (alpha/n) q],   p = cos(phi) - T sin(phi),   q = (2 e p - e²)/2,

derived here from F_N = E* [2 a(g_c)(u_z - g_c + tau u_z_dot) + F(g_c)/E*] at the edge depth g_c = u_z0 + du_z e(phi).
The receptance H turns each harmonic of q into a motion of the body; where Eq. (15) has its maximum, this adds alpha
C/n, with C the same for every shape:

    C = sum over m of Re[i m q_m k_zc H(m omega) exp(i m phi)] / |kappa + k_zc (1 + i T) H(omega)|  at that phase.

A rigid pull has H = 0. Without any damping the harmonics of q are at rest at that phase, C = 0, and the power is 2. Two
terms then share alpha²: that of C squared, ~ 1/n², and that of the curvature of F(d), ~ (1 - 1/n)/n; so the shapes no
longer differ by 1/n. Both powers are of small amplitude: further up the deviation turns back and may change its sign.

Symbols: alpha = du_z/u_z0, T = omega tau, kappa = k_zc/k_xc, phi = omega t, n power of the shape (infinite for the
punch).
"""

from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

import mdr
from mdr.plots import COLOURS, style
from mdr.progress import progress
from mdr.unilateral import contact_edge
from validation.cases import DEPTH, POWERS, SHAPES, contact
from validation.report import Check, Claim, Figure

Array = NDArray[np.float64]

PULLS: dict[str, dict[str, Any]] = {
    "rigid pull": {},
    "stiff spring": {"k_ratio": 1.5, "omega_0_ratio": 1.7, "damping_ratio": 0.05},  # omega_0 > omega
    "soft spring": {"k_ratio": 1.5, "omega_0_ratio": 0.6, "damping_ratio": 0.05},  # omega_0 < omega
}
ALPHAS = (0.02, 0.1, 0.3, 0.6)
DEPTHS = (0.5 * DEPTH, DEPTH, 2 * DEPTH)
AMPLITUDE = 0.02 * DEPTH  # of the sweep of depths
SWEEP = {
    "quick": (0.5, 1.0, 2.0),
    "full": (0.25, 1.0, 4.0),
    "long": tuple(2.0 ** (i / 2) for i in range(-4, 5)),
}  # u_z0/DEPTH
SMALL = np.geomspace(2.5e-4, 2e-3, 4)  # alphas of the fits
TOLERANCE = 2e-5 + (2 * np.pi / 1024) ** 2  # bracket of a measurement, and second order in its step, over v_c
LOOKS = dict(zip(SHAPES, zip(COLOURS, "sv^o", strict=False), strict=False))
BESIDE = dict(zip(SHAPES, (0.76, 0.9, 1.06, 1.23), strict=True))  # of alpha, so that points of one value all show
LEAST = 3e-9  # deviation that is drawn; only elastic undamped values, good to rounding, come near it


def system(
    shape: str, alpha: float, T: float, pull: str, u_z0: float = DEPTH, damped: bool = True
) -> mdr.SlidingContact:
    """A contact at any depth under the same spring, mass and damper, which belong to the depth of 20 µm."""
    knobs = PULLS[pull] if damped else PULLS[pull] | ({"damping_ratio": 0.0} if PULLS[pull] else {})
    return replace(contact(shape, alpha, T, u_z0=u_z0), pull=contact(shape, alpha, T, **knobs).pull)


@dataclass(frozen=True)
class Point:
    """One contact: what was measured beside Eq. (15) and the full-slip value."""

    shape: str
    alpha: float
    T: float
    pull: str
    u_z0: float
    measured: float | None  #: [m/s]
    eq_15: float  #: [m/s]
    full_slip: float  #: [m/s]
    rigid: float  #: Eq. (1) [m/s]
    kind: str

    @property
    def where(self) -> str:
        """Shape, amplitude, loss, pull and depth in words."""
        pull = f"ω_0 = {PULLS[self.pull]['omega_0_ratio']:g} ω" if PULLS[self.pull] else self.pull
        return f"{self.shape}, α = {self.alpha:g}, ωτ = {self.T:g}, {pull}, {self.u_z0 * 1e6:g} µm deep"

    @property
    def deviation(self) -> float:
        """Measured over Eq. (15), less 1; NaN where nothing was measured."""
        return np.nan if self.measured is None else self.measured / self.eq_15 - 1

    @property
    def miss(self) -> float:
        """Measured over the full-slip value, less 1; NaN where nothing was measured."""
        return np.nan if self.measured is None else self.measured / self.full_slip - 1


@cache
def measure(shape: str, alpha: float, T: float, pull: str, u_z0: float) -> Point:
    """Measure v_c of one contact from runs alone."""
    case = system(shape, alpha, T, pull, u_z0)
    found = mdr.measure_critical_velocity(case)
    return Point(
        shape,
        alpha,
        T,
        pull,
        u_z0,
        found.v_c,
        mdr.critical_velocity(case),
        mdr.full_slip_critical_velocity(case),
        case.unit_velocity,
        found.kind,
    )


def grid(effort: str) -> list[tuple[str, float, float, str, float]]:
    """Which contacts are measured."""
    if effort == "quick":
        return [
            *(
                (shape, alpha, T, "rigid pull", DEPTH)
                for shape in ("cone", "r^4")
                for alpha, T in ((0.02, 0.0), (0.6, 0.0), (0.6, 1.0))
            ),
            *(
                (shape, alpha, 0.0, "stiff spring", DEPTH)
                for shape in ("flat punch", "cone", "paraboloid")
                for alpha in (0.02, 0.6)
            ),
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
    case = system(shape, alpha, T, pull, damped=damped)
    return mdr.full_slip_critical_velocity(case) / mdr.critical_velocity(case) - 1


def power(shape: str, T: float, pull: str, damped: bool = True) -> float:
    """Slope of log|deviation| over log alpha at small alphas."""
    values = [abs(deviation(shape, float(alpha), T, pull, damped)) for alpha in SMALL]
    return float(np.polyfit(np.log(SMALL), np.log(values), 1)[0])


def constant(shape: str, T: float, pull: str) -> float:
    """Deviation/alpha for alpha -> 0, from two small alphas with the next power taken out."""
    one, two = (deviation(shape, alpha, T, pull) / alpha for alpha in (1e-3, 2e-3))
    return 2 * one - two


@cache
def constant_of_first_order(T: float, pull: str, n_t: int = 4096) -> float:
    """C of the module's docstring: deviation = C alpha/n of every shape."""
    case = system("paraboloid", 0.1, T, pull)
    phi = 2 * np.pi * np.arange(n_t) / n_t
    edge, p = contact_edge(phi, T), np.cos(phi) - T * np.sin(phi)
    m = np.arange(n_t // 2 + 1)
    H = np.asarray(case.pull.receptance(m * case.oscillation.omega))
    q_m = np.fft.rfft(0.5 * (2 * edge * p - edge**2)) / (n_t / 2)
    single = case.material.mindlin_ratio + case.k_zc * (1 + 1j * T) * H[1]
    top = np.exp(-1j * np.angle(1j * single))  # exp(i phi) where Eq. (15) has its maximum
    return float(np.sum(np.real(1j * m * q_m * case.k_zc * H * top**m)) / abs(single))


def claim(effort: str) -> Claim:
    """Measure the grid and the sweep of depths, fit the powers, and say where Eq. (15) holds."""
    points = [measure(*knobs) for knobs in progress(grid(effort), "generalisation")]
    shapes = ("flat punch", "cone") if effort == "quick" else tuple(SHAPES)
    depths = [
        measure(s, AMPLITUDE / (r * DEPTH), 0.0, "stiff spring", r * DEPTH) for s in shapes for r in SWEEP[effort]
    ]
    checks = [*_measured_checks([*points, *depths]), *_power_checks(), *_depth_checks(depths)]
    springs = [p for p in points if p.pull != "rigid pull" and p.shape != "flat punch"]
    far = max(springs, key=lambda p: abs(p.deviation))
    small = max((p for p in springs if p.alpha == 0.02), key=lambda p: abs(p.deviation))
    return Claim(
        name="generalisation",
        title="Eq. (15) for general contacts",
        quote="Note that the critical velocity depends on the oscillation amplitude but not on the average "
        "indentation. […] the existence an equivalent "
        "model with uncoupled spring elements, together with the indentation-independence of Eq. (15), implies that "
        "the obtained result in Eq. (15) is valid "
        "not only for the simple considered model with a single spring-damper combination, but also for quite "
        "general contacts (so long as the amplitude of "
        "oscillation remains small). — Section 2, after Eq. (15)",
        range=f"{', '.join(dict.fromkeys(p.shape for p in points))}; α = "
        f"{', '.join(f'{a:g}' for a in sorted({p.alpha for p in points}))}; elastic and ωτ = 1; depths "
        f"{', '.join(f'{d * 1e6:g}' for d in sorted({p.u_z0 for p in points}))} µm under the same spring, mass and "
        f"damper; rigid pull, ω_0 = 1.7 ω and 0.6 ω; "
        f"{len(points) + len(depths)} measured velocities",
        measured=f"Rigid pull: Eq. (1) for every shape, depth, amplitude and relaxation time tested, to "
        f"{_worst(points, 'rigid pull'):.1e}; each of these contacts exists when its depth grows fastest, as α ≤ "
        f"{max(p.alpha for p in points):g} and ωτ ≤ {max(p.T for p in points):g}. Spring pull: Eq. (15) for the flat "
        f"punch; for curved shapes it is the limit of small amplitude. For small α the deviation is proportional to α "
        f"times the exponent of the stiffness k_zc ∝ d^{{1/n}}, with one factor for all shapes (elastic and undamped: "
        f"to α^2); for large α it turns back and may change its sign. Farthest off: {100 * far.deviation:+.1f} % "
        f"({far.where}); at α = 0.02: {100 * small.deviation:+.2f} % ({small.where}). The full-slip condition with "
        f"all harmonics gives the measured value everywhere, to {max(abs(p.miss) for p in [*points, *depths]):.1e}.",
        verdict="holds if the pull is rigid, or the contact a flat punch, or the amplitude small",
        sentence="As long as the contact exists when the depth grows fastest (tested: α ≤ 0.6, ωτ = 0 and 1), Eq. "
        "(15) with the contact stiffness at the mean depth is exact for the rigid pull and the flat punch, and the "
        "limit of small amplitude for every other shape: for small α its error is proportional to α times the "
        "exponent with which the stiffness depends on depth. Only for the rigid pull and the flat punch does the "
        "depth drop out.",
        checks=tuple(checks),
        figures=(_glance(points), _powers(), _depths(depths)),
    )


def _worst(points: list[Point], pull: str) -> float:
    return max(abs(p.deviation) for p in points if p.pull == pull)


def _measured_checks(points: list[Point]) -> list[Check]:
    why = "bracket 2e-5 of the measurement and (2π/1024)², second order in its step"
    checks = []
    for shape in SHAPES:
        here = [p for p in points if p.shape == shape]
        stiff, soft = [p for p in here if p.pull == "rigid pull"], [p for p in here if p.pull != "rigid pull"]
        if stiff:
            checks.append(
                Check.at_most(
                    f"{shape}, rigid pull: worst |v_c/Eq. (1) − 1| of {len(stiff)}",
                    max(abs(p.deviation) for p in stiff),
                    TOLERANCE,
                    why,
                )
            )
        if soft and shape == "flat punch":
            checks.append(
                Check.at_most(
                    f"{shape}, spring pull: worst |v_c/Eq. (15) − 1| of {len(soft)}",
                    max(abs(p.deviation) for p in soft),
                    TOLERANCE,
                    why,
                )
            )
        elif soft:
            checks.append(
                Check.at_most(
                    f"{shape}, spring pull: worst |v_c/full-slip value − 1| of {len(soft)}",
                    max(abs(p.miss) for p in soft),
                    TOLERANCE,
                    why,
                )
            )
            large = max(soft, key=lambda p: abs(p.deviation))
            checks.append(
                Check.at_least(
                    f"{shape}, spring pull: largest |v_c/Eq. (15) − 1|",
                    abs(large.deviation),
                    10 * TOLERANCE,
                    f"Eq. (15) is off by far more than the measurement ({large.where})",
                )
            )
    odd = [p for p in points if p.kind != "end of stick"]
    checks.append(
        Check(
            f"measurements of {len(points)} whose signs disagree",
            len(odd),
            0,
            0,
            "end of stick, least slip velocity and COF name one velocity",
        )
    )
    return checks


def _power_checks() -> list[Check]:
    checks = []
    for shape in list(SHAPES)[1:]:
        for T, pull, damped, expected in (
            (0.0, "stiff spring", False, 2),
            (0.0, "stiff spring", True, 1),
            (1.0, "stiff spring", True, 1),
            (1.0, "soft spring", True, 1),
        ):
            if damped:
                got, limit = constant(shape, T, pull), constant_of_first_order(T, pull) / POWERS[shape]
                checks.append(
                    Check(
                        f"{shape}, {_called(T, pull, damped)}: deviation/α for α → 0",
                        got,
                        limit,
                        2e-3 * abs(limit),
                        "C/n; 1e-8 of v_c in the full-slip value is up to 1e-3 of it, and the next power is taken out",
                    )
                )
            name = f"{shape}, {_called(T, pull, damped)}: power of α in the deviation"
            checks.append(
                Check(
                    name,
                    power(shape, T, pull, damped),
                    expected,
                    0.02,
                    "the next power adds up to 5 α, and alphas end at 0.002"
                    + ("" if damped else "; rounding of 1e-12 of v_c is below 1 % of the least deviation"),
                )
            )
    return checks


def _depth_checks(depths: list[Point]) -> list[Check]:
    checks = []
    for shape in dict.fromkeys(p.shape for p in depths):
        here = [p for p in depths if p.shape == shape]
        assert all(p.measured for p in here)
        ratio = np.array([(p.measured or np.nan) / p.rigid for p in here])
        spread = float(np.ptp(ratio) / ratio.mean())
        if shape == "flat punch":
            checks.append(
                Check.at_most(
                    f"{shape}: spread of v_c over depths, amplitude fixed",
                    spread,
                    TOLERANCE,
                    "its stiffness does not depend on depth",
                )
            )
            continue
        expected = np.array([p.eq_15 / p.rigid for p in here])
        near = max(p.alpha for p in here) * abs(constant_of_first_order(0.0, "stiff spring")) / POWERS[shape]
        checks.append(
            Check(
                f"{shape}: spread of v_c over depths, amplitude fixed",
                spread,
                float(np.ptp(expected) / expected.mean()),
                2 * near,
                "Eq. (15) with k_c(u_z0); its own deviation C α/n at either end",
            )
        )
    return checks


def _called(T: float, pull: str, damped: bool) -> str:
    return f"{'elastic' if T == 0 else f'ωτ = {T:g}'}, {pull}{'' if damped else ' undamped'}"


def _glance(points: list[Point]) -> Figure:
    import matplotlib.pyplot as plt
    from matplotlib.lines import Line2D

    panels = (
        ("rigid pull", None, "rigid pull"),
        ("spring pull, elastic", 0.0, "stiff spring"),
        (r"spring pull, $\omega\tau$ = 1", 1.0, "stiff spring"),
    )
    alphas = np.geomspace(0.01, 0.7, 80)
    with style():
        fig, axes = plt.subplots(1, 3, sharey=True, figsize=(9.6, 4.6))
        for ax, (title, T, pull) in zip(axes, panels, strict=True):
            ax.axhline(1.0, color="0.4", lw=0.9, ls="--", zorder=0)
            for shape, (colour, marker) in LOOKS.items():
                if T is not None:
                    ax.plot(alphas, [1 + deviation(shape, float(a), T, pull) for a in alphas], color=colour, lw=1.2)
                here = [
                    p
                    for p in points
                    if p.shape == shape and p.pull == pull and (T is None or (p.T == T and p.u_z0 == DEPTH))
                ]
                ax.plot(
                    [p.alpha * (BESIDE[shape] if T is None else 1) for p in here],
                    [1 + p.deviation for p in here],
                    marker,
                    color=colour,
                    ms=7,
                    mfc="none",
                    mew=1.6,
                )
            ax.set(xscale="log", xlim=(0.009, 0.9), xlabel=r"amplitude $\Delta u_z/u_{z0}$", title=title)
            ax.set_xticks([0.01, 0.03, 0.1, 0.3], ["0.01", "0.03", "0.1", "0.3"])
            ax.minorticks_off()
        axes[0].set_ylabel(r"measured $v_c$ over Eq. (15)")
        handles = [
            Line2D([], [], color=colour, marker=marker, mfc="none", mew=1.6, ms=7, label=shape.replace("r^4", "$r^4$"))
            for shape, (colour, marker) in LOOKS.items()
        ]
        fig.legend(handles=handles, loc="outside lower center", ncols=4)
    return Figure(
        "glance",
        "Does Eq. (15) hold for general contacts? Points: critical velocities measured with arrays of springs that "
        "each stick, slip and lift on their own, over Eq. (15) with the "
        "contact stiffness at the mean depth. Lines: the full-slip condition with all harmonics of the normal force. "
        f"Under a rigid pull (points of one amplitude side by side; ωτ = 0 and 1, all depths) all shapes lie on 1 up "
        f"to the α = {max(ALPHAS):g} tested; under a spring and a mass (ω_0 = 1.7 ω, damper 5 % of critical) only the "
        f"flat punch does. The others tend to 1 in proportion to α as it becomes small; for large α the cone turns "
        f"back and crosses 1. Spring pulls at a depth of {DEPTH * 1e6:g} µm.",
        fig,
        "Three panels of measured critical velocity over Eq. (15) against amplitude: all on one for a rigid pull, "
        "falling away from one for curved shapes under a spring pull, the cone rising again at large amplitude.",
    )


def _powers() -> Figure:
    import matplotlib.pyplot as plt
    from matplotlib.lines import Line2D

    alphas = np.r_[np.geomspace(1e-3, 0.1, 20), np.linspace(0.11, 0.6, 50)]
    kinds = (
        ("elastic, undamped", 0.0, False, ":"),
        ("elastic, damper", 0.0, True, "--"),
        (r"$\omega\tau$ = 1, damper", 1.0, True, "-"),
    )
    with style():
        fig, ax = plt.subplots(figsize=(6.8, 4.6))
        for shape in list(SHAPES)[1:]:
            for _, T, damped, line in kinds:
                values = np.array([abs(deviation(shape, float(a), T, "stiff spring", damped)) for a in alphas])
                ax.plot(alphas, np.where(values > LEAST, values, np.nan), line, color=LOOKS[shape][0])
        ax.set(
            xscale="log",
            yscale="log",
            xlabel=r"amplitude $\alpha = \Delta u_z/u_{z0}$",
            ylabel="|full-slip value over Eq. (15) − 1|",
            ylim=(LEAST, 1),
        )
        handles = [
            Line2D([], [], color=LOOKS[shape][0], label=shape.replace("r^4", "$r^4$")) for shape in list(SHAPES)[1:]
        ]
        handles += [Line2D([], [], color="0.3", ls=line, label=name) for name, _, _, line in kinds]
        ax.legend(handles=handles, loc="lower right", ncols=2)
    return Figure(
        "powers",
        "How fast Eq. (15) becomes exact under a spring pull (ω_0 = 1.7 ω): with α^2 where nothing dissipates "
        "(dotted), with α as soon as the contact or the system is damped. For small α the shapes then differ by the "
        f"exponent of their stiffness, {_ratios(0.0, True)} (dashed) and {_ratios(1.0, True)} (full); undamped by "
        f"more, {_ratios(0.0, False)}. The dip of the cone is a change of sign.",
        fig,
        "Log-log plot of the deviation from Eq. (15) over amplitude, with slopes one and two.",
    )


def _ratios(T: float, damped: bool) -> str:
    """Deviations of the curved shapes at the least of the SMALL amplitudes, over that of the cone."""
    at = [deviation(shape, float(SMALL[0]), T, "stiff spring", damped) for shape in list(SHAPES)[1:]]
    return " : ".join(f"{value / at[0]:.2g}" for value in at)


def _depths(depths: list[Point]) -> Figure:
    import matplotlib.pyplot as plt

    ratios = np.geomspace(0.22, 4.5, 60)
    with style():
        fig, ax = plt.subplots(figsize=(6.8, 4.2))
        for shape in dict.fromkeys(p.shape for p in depths):
            colour, marker = LOOKS[shape]
            cases = [system(shape, AMPLITUDE / (r * DEPTH), 0.0, "stiff spring", r * DEPTH) for r in ratios]
            ax.plot(
                ratios * DEPTH * 1e6,
                [mdr.critical_velocity(case) / case.unit_velocity for case in cases],
                color=colour,
                lw=1.2,
            )
            here = [p for p in depths if p.shape == shape]
            ax.plot(
                [p.u_z0 * 1e6 for p in here],
                [(p.measured or np.nan) / p.rigid for p in here],
                marker,
                color=colour,
                ms=6.5,
                mec="white",
                mew=0.5,
                label=shape.replace("r^4", "$r^4$"),
            )
        ax.axhline(1.0, color="0.4", lw=0.9, ls="--", zorder=0)
        ax.annotate("rigid pull", (80, 1.0), (0, 4), textcoords="offset points", ha="right", fontsize=9)
        ax.set(xscale="log", xlabel="mean depth $u_{z0}$ [µm]", ylabel="$v_c$ over Eq. (1)", ylim=(0.9, None))
        ax.set_xticks([5, 10, 20, 40, 80], ["5", "10", "20", "40", "80"])
        ax.minorticks_off()
        ax.legend(loc="upper left")
    return Figure(
        "depth",
        f"Measured v_c (points) over the mean depth at a fixed amplitude of {AMPLITUDE * 1e6:g} µm under one and the "
        f"same spring and mass, elastic; lines are Eq. (15) with the stiffness "
        "at that depth. Eq. (15) is independent of the depth as far as k_x,c is, for the flat punch, and for all "
        "shapes under a rigid pull (dashed).",
        fig,
        "Critical velocity over depth: constant for the flat punch, rising with depth for the curved shapes.",
    )
