"""Drives: an oscillating load, with or without mass, and periodic depths of any form.

Nearly every experiment prescribes a load, F_z(t) = F_z0 + dF_z cos(omega t), and not a depth. Friction has no part in
the normal problem, so the depth follows first, and then all is as before: a periodic depth with its harmonics u_n. To
first order in dF_z,

    u_1 = dF_z/[K_z(omega) - m_z omega²],
    v_c = mu_0 omega dF_z |kappa + K_z(omega) H(omega)|/|K_z(omega) - m_z omega²|,

with K_z = 2 a E*(omega) at the depth on which the mean load rests, derived here from Eq. (15) in its complex form. Two
things differ from a prescribed depth. Stiffness enters even under a rigid pull, v_c = mu_0 kappa omega dF_z/|K_z|, so
that no v_c under load is independent of shape and depth. And without mass the force on the body, mu_0 F_z(t), has one
harmonic at any amplitude; it is the depth that has many:

    v_c = max over t of mu_0 [kappa u_z' + dF_z Re(i omega H exp(i omega t))],    elastic: u_z' = F_z'/(2 E* a(u_z)).

A rigid pull then leaves the linear formula in second order of eps = dF_z/F_z0, for every shape (`mdr.laws.load_error`).

For a periodic depth each spring of a rigid pull slips from mu_0 kappa times the fastest approach on: v_c = mu_0 kappa
max u_z', which for a square-like tapping is far above that of its first harmonic alone.

Symbols: eps = dF_z/F_z0, alpha = du_z/u_z0, T = omega tau, n power of the shape, f ~ r^n.
"""

from functools import cache
from typing import Any

import numpy as np

import mdr
from mdr import laws
from mdr.tools.progress import progress
from validation.cases import BODY, DEPTH, LOOKS, OMEGA, POWERS, SHAPES, E, any_contact, shape_label
from validation.figures import figure
from validation.measured import TOLERANCE, Point, lost, measured
from validation.measured import deviation as deviation_of
from validation.report import Check, Checks, Figure, Part, told

NU = 0.5
MATERIALS: dict[str, mdr.Material] = {
    "elastic": mdr.Elastic(E, NU),
    "ωτ = 1": mdr.KelvinVoigt(E, NU, 1 / OMEGA),
    "standard solid": mdr.StandardLinearSolid(E, 2 * E, 0.7 / OMEGA, NU),
}
SMALL, GREAT = 1e-3, 0.6
EQUIVALENT = [("cone", "elastic"), ("paraboloid", "ωτ = 1")]
EQUIVALENT += [("paraboloid", "standard solid"), ("flat punch", "standard solid")]
SQUARE = tuple(4 / np.pi / n if n % 2 else 0.0 for n in range(1, 10))  # a square wave of amplitude 1, five terms
PERIODIC = {
    "two frequencies": mdr.PeriodicMotion(OMEGA, DEPTH, cos=(0.15 * DEPTH, 0.0, 0.05 * DEPTH)),
    "saw tooth": mdr.PeriodicMotion(OMEGA, DEPTH, sin=tuple(0.15 * DEPTH / n for n in range(1, 7))),
    "square-like": mdr.PeriodicMotion(OMEGA, DEPTH, sin=tuple(0.1 * DEPTH * one for one in SQUARE)),
    "square-like tapping": mdr.PeriodicMotion(OMEGA, -0.2 * DEPTH, sin=tuple(0.5 * DEPTH * one for one in SQUARE)),
}


def contact(shape: str, material: str, motion: mdr.Motion, groups: Any = None) -> mdr.SlidingContact:
    """A shape on a material under any drive, pulled rigidly or by a body."""
    return any_contact(SHAPES[shape], MATERIALS[material], motion, groups)


def load(shape: str, material: str, eps: float, mass_ratio: float = 0.0) -> mdr.LoadOscillation:
    """The load that rests at 20 µm; mass_ratio: m_z omega² over the stiffness there."""
    F_z0 = float(SHAPES[shape].force(DEPTH, MATERIALS[material].E_star))
    k_zc = float(SHAPES[shape].stiffness(DEPTH, MATERIALS[material].E_star))
    return mdr.LoadOscillation(F_z0, eps * F_z0, OMEGA, mass_ratio * k_zc / OMEGA**2)


_ALL = (
    f"oscillating load of {SMALL:g} and {GREAT:g} of the mean without mass, and of 0.3 with mass in z, four shapes,"
    " elastic, Kelvin and standard solid, rigid pull and body; periodic depths of three to nine harmonics, square-like"
    " tapping among them"
)  #: the contacts of a full report in words


def part(effort: str) -> Part:
    """Drive: an oscillating load, a periodic depth

    How: Drives other than Eq. (3), from runs alone.

    Quote: [MDR provides a natural theoretical framework] for further generalizations to arbitrary contact geometries
    and loading histories. — Section 3; the depth of the paper is u_z0 + Δu_z cos ωt, Eq. (3).

    Range: {n_points} contacts measured from runs: {contacts}.

    Measured: Under an oscillating load v_c is that of the depth which the load brings about. For small ΔF_z this is a
    closed form, v_c = μ_0 ω ΔF_z |κ + K_z H|/|K_z − m_z ω^2|, in which shape, mean load and material enter even under a
    rigid pull. Without mass the force on the body has a single harmonic at any amplitude, and what leaves the formula
    is the depth alone: for an elastic contact in second order of ΔF_z/F_z0, by (ΔF_z/F_z0)^2/2(n+1)^2. For periodic
    depths v_c is the greatest slip velocity over the cycle, with every harmonic; a square-like drive has a v_c far
    above that of its first harmonic.

    Sentence: Under an oscillating load Eq. (15) holds with Δu_z = ΔF_z/|K_z − m_z ω^2| for small ΔF_z; for a periodic
    depth v_c is the maximum of the same expression over the cycle.
    """
    quick = effort == "quick"
    points = [_measured(*which) for which in progress(_grid(quick), "motions")]
    n_points = len(points)
    contacts = "; ".join(p.where for p in points) if quick else _ALL
    return Part(
        **told(part, locals()),
        checks=(*_measured_checks(points), *_equivalence_checks(quick), *_amplitude_checks()),
        figures=(_figure_of_loads(quick), *(() if quick else (_figure_of_series(),))),
    )


# --- measured from runs alone ---


def _grid(quick: bool) -> list[tuple[str, str, str, float, float, bool]]:
    """shape, material, drive, eps, mass ratio, body."""
    if quick:
        return [
            ("paraboloid", "elastic", "load", SMALL, 0.0, True),
            ("flat punch", "elastic", "square-like tapping", 0.0, 0.0, False),
        ]
    found = [(s, m, "load", SMALL, 0.0, True) for s, m in EQUIVALENT]
    found += [(s, m, "load", GREAT, 0.0, False) for s in SHAPES for m in ("elastic", "standard solid")]
    found += [("cone", m, "load", 0.3, 0.3, True) for m in MATERIALS]
    found += [("paraboloid", "elastic", d, 0.0, 0.0, True) for d in PERIODIC]
    found += [("cone", "ωτ = 1", d, 0.0, 0.0, False) for d in ("saw tooth", "square-like tapping")]
    found += [("paraboloid", "standard solid", "two frequencies", 0.0, 0.0, True)]
    return found


def _measured_checks(points: list[Point]) -> Checks:
    """Against the full-slip value, and against the formula where the load swings little."""
    why = "bracket of the measurement, second order in its step; depth and force are followed to 1e-5"
    for p in points:
        yield Check(f"measured v_c over the full-slip value: {p.where}", 1 + p.miss, 1, 2 * TOLERANCE, why)
        motion = p.case.oscillation
        if isinstance(motion, mdr.LoadOscillation) and motion.dF_z < 2 * SMALL * motion.F_z0:
            small = "ΔF_z/F_z0 = 1e-3, first order for a body, and the bracket"
            yield Check(f"measured v_c over the formula: {p.where}", 1 + p.deviation, 1, 1e-3, small)


@cache
def _measured(shape: str, material: str, drive: str, eps: float, mass_ratio: float, pulled: bool) -> Point:
    motion = load(shape, material, eps, mass_ratio) if drive == "load" else PERIODIC[drive]
    case = contact(shape, material, motion, BODY if pulled else None)
    words = f"ΔF_z/F_z0 = {eps:g}" + (f", m_z ω² = {mass_ratio:g} k_zc" if mass_ratio else "")
    where = f"{shape}, {material}, {words if drive == 'load' else drive}{', body' if pulled else ', rigid pull'}"
    return measured(case, where)


# --- a small load is a small depth ---


def _equivalence_checks(quick: bool) -> Checks:
    for shape, material in EQUIVALENT[:1] if quick else EQUIVALENT:
        motion = load(shape, material, SMALL)
        loaded = mdr.resolved(contact(shape, material, motion, BODY))
        K_z = complex(loaded.dynamic_stiffness(OMEGA))
        depth = mdr.NormalOscillation(loaded.working_depth, abs(motion.dF_z / K_z), OMEGA)
        pressed = contact(shape, material, depth, BODY)
        for share in (0.2, 0.6):
            v_0 = share * mdr.critical_velocity(pressed)
            one, two = lost(loaded, v_0), lost(pressed, v_0)
            name = f"COF deficit under load over that at its depth, {share:g} v_c: {shape}, {material}"
            yield Check(name, one / two, 1.0, 5e-3, "first order in ΔF_z/F_z0 = 1e-3, with a factor of some units")


# --- how the formula ends ---


@cache
def deviation(shape: str, material: str, eps: float, pulled: bool, mass_ratio: float = 0.0) -> float:
    """Full-slip value over the formula, less 1."""
    return deviation_of(contact(shape, material, load(shape, material, eps, mass_ratio), BODY if pulled else None))


def _amplitude_checks() -> Checks:
    for shape, n in POWERS.items():
        got = deviation(shape, "elastic", 0.04, False) / 0.04**2
        name = f"elastic, rigid pull: deviation of v_c over (ΔF_z/F_z0)²: {shape}"
        yield Check(name, got, laws.load_error(1.0, n), 2e-3, "the next term of the series, of order eps² = 1.6e-3")
    for drive, motion in list(PERIODIC.items())[:3]:
        case = contact("paraboloid", "elastic", motion)
        fastest = np.max(motion.u_z_dot(np.linspace(0, 2 * np.pi / OMEGA, 200_001)))
        name = f"v_c of a rigid pull over μ_0 κ max u_z': {drive}"
        got = mdr.critical_velocity(case) / (case.mu_0 * case.material.mindlin_ratio * fastest)
        yield Check(name, got, 1.0, 1e-6, "200001 instants miss the maximum by (9 · 3e-5)²/2")


# --- figures ---


def _figure_of_loads(quick: bool) -> Figure:
    panels = (("rigid pull", "elastic", False), ("rigid pull", "standard solid", False), ("body", "elastic", True))
    shown = panels[:: 2 if quick else 1]
    return figure("loads", 1, len(shown), size=(3.4 * len(shown), 3.6))(_loads)(shown, quick)


def _loads(fig, axes, panels: Any, quick: bool):
    """Panels of deviation in % over relative load amplitude for four shapes.

    Load-controlled drive: how far v_c at finite amplitude is from μ_0 ω ΔF_z |κ + K_z H|/|K_z|. The punch stays on it.
    Elastic curved shapes leave it in second order, as their stiffness falls while the load is low: under a rigid pull
    the more, the sharper the shape.{measured}
    """
    shares = np.array([0.0, 0.3, 0.6, 0.9]) if quick else np.linspace(0, 0.9, 10)
    for ax, (pull, material, pulled) in zip(axes, panels, strict=True):
        for shape, (colour, marker) in LOOKS.items():
            values = [0.0, *(deviation(shape, material, float(eps), pulled) for eps in shares[1:])]
            ax.plot(shares, 100 * np.array(values), color=colour, label=shape_label(shape))
            if not pulled and not quick:
                point = _measured(shape, material, "load", GREAT, 0.0, False)
                ax.plot(GREAT, 100 * point.deviation, marker, color=colour, mfc="white")
        ax.set(xlabel=r"$\Delta F_z/F_{z0}$", title=f"{pull}, {material}")
    axes[0].set_ylabel("full-slip $v_c$ over the formula, less 1 [%]")
    axes[0].legend(loc="upper left")
    return {"measured": "" if quick else " Symbols: measured from runs at ΔF_z = 0.6 F_z0."}


@figure("series", 1, 2, size=(8.8, 3.6))
def _figure_of_series(fig, axes):
    """Depth over a period for four drives, and their COF curves.

    Periodic depths (left) and the friction of an elastic paraboloid under a rigid pull (right). Dotted lines: v_c of
    the first harmonic alone. Steep fronts reduce friction up to velocities several times higher, but the reduction
    there is slight: what matters for the COF is how long the contact is lightly pressed.
    """
    phase = np.linspace(0, 1, 600)
    for (name, motion), colour in zip(PERIODIC.items(), ("C0", "C1", "C2", "C3"), strict=True):
        axes[0].plot(phase, motion.u_z(phase * 2 * np.pi / OMEGA) * 1e6, color=colour, label=name)
        case = contact("paraboloid", "elastic", motion)
        v_c = mdr.full_slip_critical_velocity(case)
        first = mdr.NormalOscillation(motion.u_z0, float(np.hypot(motion.cos[0], motion.sin[0])), OMEGA)
        alone = mdr.full_slip_critical_velocity(contact("paraboloid", "elastic", first))
        v = np.array([0.01, 0.03, 0.06, 0.1, 0.15, 0.2, 0.3, 0.45, 0.6, 0.8, 1.0, 1.1])
        cof = [mdr.slide(case, x * v_c, n_springs=96, steps_per_period=512).cof / case.mu_0 for x in v]
        axes[1].plot(np.r_[0, v] * v_c * 1e3, [mdr.static_cof(case) / case.mu_0, *cof], "-o", ms=3, color=colour)
        axes[1].axvline(alone * 1e3, color=colour, lw=0.8, ls=":")
    axes[0].axhline(0, color="0.6", lw=0.8)
    axes[0].set(xlabel="time over period", ylabel="depth $u_z$ [µm]")
    axes[0].legend(loc="lower left")
    axes[1].set(xlabel="pulling velocity $v_0$ [mm/s]", ylabel=r"$\mu/\mu_0$", xlim=(0, 8))
