"""Eq. (15) for general contacts: exact for a rigid pull and for the flat punch, the limit of small amplitude for all
others.

In full slip all springs slip at one velocity, so they reach the stick limit together and one v_c serves the array;
that much of the argument holds at any amplitude. What Eq. (15) needs besides is a normal force with a single
harmonic. A curved contact grows and shrinks within the period; for g ~ x^n its stiffness goes as d^(1/n), and to
second order in du_z

    F_N = F(u_z0) + k_zc du_z [p + (alpha/n) q],   p = cos(phi) - T sin(phi),   q = (2 e p - e²)/2,

derived here from F_N = E* [2 a(g_c)(u_z - g_c + tau u_z_dot) + F(g_c)/E*] at the edge depth g_c = u_z0 + du_z e(phi).
The receptance H turns each harmonic of q into a motion of the body; where Eq. (15) has its maximum, this adds alpha
C/n, with C the same for every shape:

    C = sum over m of Re[i m q_m k_zc H(m omega) exp(i m phi)] / |kappa + k_zc (1 + i T) H(omega)|  at that phase.

A rigid pull has H = 0. Without any damping the harmonics of q are at rest at that phase, C = 0, and the power is 2.

Symbols: alpha = du_z/u_z0, T = omega tau, kappa = k_zc/k_xc, phi = omega t, n power of the shape (infinite for the
punch).
"""

from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

import mdr
from mdr import theory
from mdr.plots import COLOURS, style
from mdr.progress import progress
from mdr.unilateral import contact_edge
from validation.cases import DEPTH, SHAPES, contact
from validation.report import Check, Claim, Figure

Array = NDArray[np.float64]

EXPONENT = {"flat punch": 0.0, "cone": 1.0, "paraboloid": 1 / 2, "r^4": 1 / 4}  # of the stiffness, k_zc ~ d^(1/n)
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
    "full": (0.25, 0.5, 1.0, 2.0, 4.0),
    "long": tuple(2.0 ** (i / 2) for i in range(-4, 5)),
}  # u_z0/DEPTH
SMALL = np.geomspace(2.5e-4, 2e-3, 4)  # alphas of the fits
TOLERANCE = 2e-5 + (2 * np.pi / 1024) ** 2  # bracket of a measurement, and second order in its step, over v_c
LOOKS = dict(zip(SHAPES, zip(COLOURS, "sv^o", strict=False), strict=False))
SIZES = dict(zip(SHAPES, (11, 9, 7, 4.5), strict=True))  # so that points on each other all show


def system(
    shape: str, alpha: float, T: float, pull: str, u_z0: float = DEPTH, damped: bool = True
) -> mdr.SlidingContact:
    """A contact at any depth under the same spring, mass and damper, which belong to the depth of 20 µm."""
    knobs = PULLS[pull] if damped else PULLS[pull] | ({"damping_ratio": 0.0} if PULLS[pull] else {})
    return replace(contact(shape, alpha, T, u_z0=u_z0), pull=contact(shape, alpha, T, **knobs).pull)


def rigid(case: mdr.SlidingContact) -> float:
    """Eq. (1) of a case [m/s]."""
    return theory.eq_1(case.mu_0, case.oscillation.du_z, case.oscillation.omega, case.material.mindlin_ratio)


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
    def deviation(self) -> float:
        """Measured over Eq. (15), less 1; NaN where nothing was measured."""
        return np.nan if self.measured is None else self.measured / self.eq_15 - 1

    @property
    def miss(self) -> float:
        """Measured over the full-slip value, less 1; NaN where nothing was measured."""
        return np.nan if self.measured is None else self.measured / self.full_slip - 1


def measure(shape: str, alpha: float, T: float, pull: str, u_z0: float = DEPTH) -> Point:
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
        rigid(case),
        found.kind,
    )


def grid(effort: str) -> list[tuple[str, float, float, str, float]]:
    """Which contacts are measured."""
    if effort == "quick":
        return [
            *(
                (shape, alpha, T, "rigid pull", DEPTH)
                for shape in ("cone", "r^4")
                for alpha in (0.02, 0.6)
                for T in (0.0, 1.0)
            ),
            *(
                (shape, alpha, 0.0, "stiff spring", DEPTH)
                for shape in ("flat punch", "cone", "paraboloid")
                for alpha in (0.02, 0.6)
            ),
            ("cone", 0.3, 1.0, "soft spring", 2 * DEPTH),
        ]
    all_of_them = [(s, a, T, p, d) for s in SHAPES for a in ALPHAS for T in (0.0, 1.0) for p in PULLS for d in DEPTHS]
    if effort == "long":
        return all_of_them
    # springs away from the middle depth at two amplitudes only
    return [(s, a, T, p, d) for s, a, T, p, d in all_of_them if p == "rigid pull" or d == DEPTH or a in (0.1, 0.6)]


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
        range=f"flat punch, cone, paraboloid and r^4; α = "
        f"{', '.join(f'{a:g}' for a in sorted({p.alpha for p in points}))}; elastic and ωτ = 1; depths "
        f"{', '.join(f'{d * 1e6:g}' for d in sorted({p.u_z0 for p in points}))} µm under the same spring, mass and "
        f"damper; rigid pull, ω_0 = 1.7 ω and 0.6 ω; "
        f"{len(points) + len(depths)} measured velocities",
        measured=f"Rigid pull: Eq. (1) for every shape, depth, amplitude and relaxation time, to "
        f"{_worst(points, 'rigid pull'):.1e}. Spring pull: Eq. (15) for the "
        f"flat punch; for curved shapes it is the limit of small amplitude. The deviation is proportional to α times "
        f"the exponent of the stiffness k_zc ∝ d^{{1/n}}, "
        f"with one factor for all shapes (elastic and undamped: to α^2). It reaches {100 * far.deviation:+.1f} % "
        f"({far.shape}, α = {far.alpha:g}, ωτ = {far.T:g}), and "
        f"{100 * small.deviation:+.2f} % at α = 0.02. The full-slip condition with all harmonics gives the measured "
        f"value everywhere, to "
        f"{max(abs(p.miss) for p in [*points, *depths]):.1e}.",
        verdict="holds if the pull is rigid, or the stiffness constant, or the amplitude small",
        sentence="Eq. (15), with the contact stiffness at the mean depth, is the limit of small amplitude for every "
        "shape; its error grows like α times the "
        "exponent with which the stiffness depends on depth. Only for a rigid pull does the depth drop out.",
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
                    f"Eq. (15) is off by far more than the measurement (at α = {large.alpha:g}, ωτ = {large.T:g})",
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
                got, limit = constant(shape, T, pull), EXPONENT[shape] * constant_of_first_order(T, pull)
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
                    "the next power adds up to 5 α, and alphas end at 0.002",
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
        near = max(p.alpha for p in here) * EXPONENT[shape] * abs(constant_of_first_order(0.0, "stiff spring"))
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
    alphas = np.geomspace(0.01, 0.7, 19)
    with style():
        fig, axes = plt.subplots(1, 3, sharey=True, figsize=(10.6, 4.3))
        for ax, (title, T, pull) in zip(axes, panels, strict=True):
            ax.axhline(1.0, color="0.4", lw=0.9, ls="--", zorder=0)
            for shape, (colour, marker) in LOOKS.items():
                if T is not None:
                    ax.plot(alphas, [1 + deviation(shape, float(a), T, pull) for a in alphas], color=colour, lw=1.2)
                here = [
                    p
                    for p in points
                    if p.shape == shape and p.pull == pull and (T is None or p.T == T) and p.u_z0 == DEPTH
                ]
                ax.plot(
                    [p.alpha for p in here],
                    [1 + p.deviation for p in here],
                    marker,
                    color=colour,
                    ms=SIZES[shape],
                    mec="white",
                    mew=0.5,
                )
            ax.set(xscale="log", xlim=(0.009, 0.78), xlabel=r"amplitude $\Delta u_z/u_{z0}$", title=title)
            ax.set_xticks([0.01, 0.03, 0.1, 0.3], ["0.01", "0.03", "0.1", "0.3"])
            ax.minorticks_off()
        axes[0].set_ylabel(r"measured $v_c$ over Eq. (15)")
        handles = [
            Line2D([], [], color=colour, marker=marker, label=shape.replace("r^4", "$r^4$"))
            for shape, (colour, marker) in LOOKS.items()
        ]
        fig.legend(handles=handles, loc="outside lower center", ncols=4)
    return Figure(
        "glance",
        "Does Eq. (15) hold for general contacts? Points: critical velocities measured with arrays of springs that "
        "each stick, slip and lift on their own, over Eq. (15) with the "
        "contact stiffness at the mean depth. Lines: the full-slip condition with all harmonics of the normal force. "
        "Under a rigid pull all shapes lie on 1 at any amplitude; under a "
        "spring and a mass (ω_0 = 1.7 ω, damper 5 % of critical) only the flat punch does, and the others tend to 1 "
        "as the amplitude becomes small.",
        fig,
        "Three panels of measured critical velocity over Eq. (15) against amplitude: all on one for a rigid pull, "
        "falling away from one for curved shapes under a spring pull.",
    )


def _powers() -> Figure:
    import matplotlib.pyplot as plt
    from matplotlib.lines import Line2D

    alphas = np.geomspace(1e-3, 0.5, 14)
    kinds = (
        ("elastic, undamped", 0.0, False, ":"),
        ("elastic, damper", 0.0, True, "--"),
        (r"$\omega\tau$ = 1, damper", 1.0, True, "-"),
    )
    with style():
        fig, ax = plt.subplots(figsize=(6.8, 4.6))
        for shape in list(SHAPES)[1:]:
            for _, T, damped, line in kinds:
                values = [abs(deviation(shape, float(a), T, "stiff spring", damped)) for a in alphas]
                ax.plot(alphas, values, line, color=LOOKS[shape][0])
        ax.set(
            xscale="log",
            yscale="log",
            xlabel=r"amplitude $\alpha = \Delta u_z/u_{z0}$",
            ylabel="|full-slip value over Eq. (15) − 1|",
            ylim=(1e-8, 1),
        )
        handles = [
            Line2D([], [], color=LOOKS[shape][0], label=shape.replace("r^4", "$r^4$")) for shape in list(SHAPES)[1:]
        ]
        handles += [Line2D([], [], color="0.3", ls=line, label=name) for name, _, _, line in kinds]
        ax.legend(handles=handles, loc="lower right", ncols=2)
    return Figure(
        "powers",
        "How fast Eq. (15) becomes exact under a spring pull (ω_0 = 1.7 ω): with α^2 where nothing dissipates "
        "(dotted), with α as soon as the contact or the system is damped. Shapes "
        "differ by the exponent of their stiffness, 1 : 1/2 : 1/4. Dips are changes of sign.",
        fig,
        "Log-log plot of the deviation from Eq. (15) over amplitude, with slopes one and two.",
    )


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
                [mdr.critical_velocity(case) / rigid(case) for case in cases],
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
        "at that depth. Eq. (15) is independent of the depth as far as k_x,c is: for the flat punch, and for all "
        "shapes under a rigid pull (dashed).",
        fig,
        "Critical velocity over depth: constant for the flat punch, rising with depth for the curved shapes.",
    )
