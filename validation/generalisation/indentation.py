"""Indentation: what of v_c depends on the mean depth, and what does not.

Eq. (15) does not contain u_z0. But it contains the stiffness k = k_xc, and that of a curved contact grows with the
depth, as u_z0^(1/n) for f ~ r^n. At a given du_z

    d ln v_c/d ln u_z0 = S/n,    S = Re[-z k/(q - z k)],    q = m omega² - k_x - i c_x omega,    z = 1 + i T

(`mdr.laws.depth_sensitivity`). So v_c does not depend on the depth

* at any amplitude, under a rigid pull (|q| infinite), as long as Eq. (1) holds (a surface that comes back late ends it,
  at a depth of its own: validation/lost_contact.py), and for a flat punch (1/n = 0), as long as contact is kept;
* nearly, under a heavy or stiff body, |q| >> k, whose S is -k Re(z/q);
* to first order, where v_c is least (`mdr.laws.least_over_depth`).

Otherwise it does: like u_z0^(1/n) under a soft or light body and on the pole q = 0, S = 1, and by more, of either sign,
next to the zero q = z k of an elastic contact. At finite amplitude a curved contact depends on the depth in a second
way, through alpha = du_z/u_z0
(shapes.py); what is measured here is at small alpha, but for the rigid pull and the punch.

Symbols: alpha = du_z/u_z0, T = omega tau, omega_0² = k_x/m.
"""

import numpy as np

import mdr
from mdr import laws
from mdr.tools.progress import progress
from validation.cases import DEPTH, LOOKS, POWERS, SHAPES, contact, loss, loss_label, shape_label
from validation.figures import COLOURS, figure, ticks
from validation.generalisation import shapes as powers
from validation.generalisation.shapes import PULLS, measure
from validation.measured import TOLERANCE, Point
from validation.report import Check, Checks, Equation, Part, told
from validation.words import counted, listed, number

AMPLITUDE = 0.02 * DEPTH  # of the sweep of depths
SHALLOW = 0.021 * DEPTH  # of the deepest amplitudes: alpha = 0.95
SWEEP = {  # u_z0/DEPTH under a body: T, pull, depths
    "quick": ((0.0, "stiff spring", (0.25, 4.0)),),
    "full": ((0.0, "stiff spring", (0.25, 1.0, 4.0)), (1.0, "soft spring", (0.25, 1.0, 4.0))),
}
TINY = 1e-6  # alpha at which the full-slip value is Eq. (15) but for C alpha


def system(shape: str, u_z0: float, T: float, pull: str, du_z: float = AMPLITUDE) -> mdr.SlidingContact:
    """A contact at any depth under the same spring, mass and damper, which belong to the depth of 20 µm."""
    return powers.system(shape, du_z / u_z0, T, pull, u_z0)


def measured_sensitivity(shape: str, u_z0: float, T: float, pull: str) -> float:
    """n d ln v_c/d ln u_z0 of the full-slip value at a tiny amplitude, by central differences."""
    step, du_z = 1e-3, TINY * u_z0
    cases = [system(shape, u_z0 * np.exp(shift), T, pull, du_z) for shift in (step, -step)]
    up, down = (np.log(mdr.full_slip_critical_velocity(case)) for case in cases)
    return float(POWERS[shape] * (up - down) / (2 * step))


_EQUATION = Equation(
    "",
    r"\frac{d \ln v_c}{d \ln u_{z0}} = \frac{S}{n}, \quad S = \text{Re } \frac{-z k_{x,c}}{q - z k_{x,c}},"
    r" \quad z = 1 + i\omega\tau, \quad q = m\omega^2 - k_x - i c_x \omega",
    "By how much v_c changes with the depth, from Eq. (15) (<code>mdr.laws.depth_sensitivity</code>).",
)


def part(effort: str) -> Part:
    """Depth: what of v_c depends on it

    How: Measure v_c over the depth, and set its slope beside the derivative of Eq. (15).

    Quote: However, it does not depend on absolute indentation, which permits easy generalization to more realistic
    contact geometry. — Section 3

    Range: {names}; an amplitude of {amplitude:g} µm at depths from {shallow:.2g} to {deep:.0f} µm under a rigid pull,
    and from {low:g} to {high:g} µm under one and the same mass, spring and damper; {velocities}, and slopes of the
    full-slip value.

    Measured: It is the formula that does not contain the depth, not v_c: the stiffness in Eq. (15) is that at the mean
    depth. Over a factor of 16 in depth, at the same amplitude and body (ω_0 = 1.7 ω), v_c of the flat punch stays the
    same to {same}, and changes by a factor of {changes}. The slope is d ln v_c/d ln u_z0 = S/n, n the power of the
    shape and S = Re[−zk/(q − zk)] with k = k_x,c, z = 1 + iωτ and q = mω² − k_x − i c_x ω: S = {S_stiff:.2g} for that
    body and {S_heavy:.2g} for a heavy one (ω_0 = 0.6 ω), elastic. It vanishes in three cases: under a rigid pull, for
    any shape, here {rigid_names} over a factor of 500 in depth and up to α = 0.95 at ωτ = 1 (a surface that comes back
    late ends this); for a flat punch that keeps contact; and at the one depth at which k_x,c = Re(q/z), where v_c has
    its minimum and changes only by the square of the change in depth.

    Sentence: v_c does not depend on the depth for a rigid pull and for a flat punch that keeps contact; else as much as
    the stiffness k_x,c(u_z0) in Eq. (15) does, so to use Eq. (15) one has to know the depth.
    """
    size = "quick" if effort == "quick" else "full"
    shapes = ("flat punch", "cone") if effort == "quick" else tuple(SHAPES)
    rigid_shapes = shapes[1:] if effort == "quick" else shapes
    knobs = [(s, u_z0, 1.0, "rigid pull") for s in rigid_shapes for u_z0 in (SHALLOW, 500 * SHALLOW)]
    knobs += [(s, r * DEPTH, T, pull) for T, pull, depths in SWEEP[size] for s in shapes for r in depths]
    points = [measure(s, AMPLITUDE / d, T, pull, d) for s, d, T, pull in progress(knobs, "indentation")]
    stiff = contact("cone", 0.1, 0.0, **PULLS["stiff spring"])
    heavy = contact("cone", 0.1, 0.0, **PULLS["soft spring"])
    over = {s: [p.over_rigid for p in points if (p.shape, p.pull, p.T) == (s, "stiff spring", 0.0)] for s in shapes}
    spans = {shape: max(ratios) / min(ratios) for shape, ratios in over.items()}
    names, amplitude, shallow = ", ".join(shapes), AMPLITUDE * 1e6, SHALLOW * 1e6
    deep, low, high = 500 * SHALLOW * 1e6, 0.25 * DEPTH * 1e6, 4 * DEPTH * 1e6
    velocities = counted(len(points), "measured velocity")
    same = number(spans.pop("flat punch") - 1, 1)
    changes = listed(f"{span:.3g} ({shape})" for shape, span in spans.items())
    S_stiff, S_heavy = laws.depth_sensitivity(stiff), laws.depth_sensitivity(heavy)
    rigid_names = listed(rigid_shapes)
    return Part(
        **told(part, locals()),
        checks=(*_measured_checks(points), *_slope_checks(effort), *_minimum_checks()),
        figures=(_depth_figure(points, effort), _slope_figure()),
        equations=(_EQUATION,),
    )


def _measured_checks(points: list[Point]) -> Checks:
    for shape, T, pull in dict.fromkeys((p.shape, p.T, p.pull) for p in points):
        here = [p for p in points if (p.shape, p.T, p.pull) == (shape, T, pull)]
        ratios = np.array([p.over_rigid for p in here])
        spread = np.ptp(ratios) / ratios.mean()
        name = f"{shape}, {pull}, {loss(T)}: spread of v_c over {len(here)} depths"
        if pull == "rigid pull" or shape == "flat punch":
            why = "its stiffness does not depend on depth" if shape == "flat punch" else "Eq. (1) holds no stiffness"
            yield Check.at_most(name, spread, TOLERANCE, why)
            continue
        expected = np.array([mdr.full_slip_critical_velocity(p.case) / p.case.unit_velocity for p in here])
        span = float(np.ptp(expected) / expected.mean())
        why = "full slip at each depth; bracket of the measurement at either end"
        yield Check(name, spread, span, 2 * TOLERANCE, why)
        yield Check.at_least(f"{name}, measured", spread, 10 * TOLERANCE, "v_c does depend on the depth")


def _slope_checks(effort: str) -> Checks:
    depths = (DEPTH,) if effort == "quick" else (0.3 * DEPTH, DEPTH, 5 * DEPTH)
    for pull in ("stiff spring", "soft spring"):
        which = [(s, d, T, pull) for s in list(SHAPES)[1:] for T in (0.0, 1.0) for d in depths]
        off = [measured_sensitivity(*one) - laws.depth_sensitivity(system(*one)) for one in which]
        name = f"{pull}: n d ln v_c/d ln u_z0 less S, worst of {len(off)} shapes, depths and materials"
        why = "differences of second order over 0.1 % of depth; C α at α = 1e-6; 1e-10 of v_c over 0.1 %, times n"
        yield Check(name, max(off, key=abs), 0.0, 2e-5, why)


def _minimum_checks() -> Checks:
    from scipy.optimize import minimize_scalar

    T = 1.0

    def over_depth(log_depth: float, shape: str) -> float:
        """Full-slip value over u_z0, and so over Eq. (1) but for a factor, at one tiny alpha."""
        u_z0 = float(np.exp(log_depth))
        return mdr.full_slip_critical_velocity(system(shape, u_z0, T, "soft spring", TINY * u_z0)) / u_z0

    for shape in list(SHAPES)[1:]:
        case = system(shape, DEPTH, T, "soft spring")
        k, least = laws.least_over_depth(case)
        depth = DEPTH * (k / case.k_xc) ** POWERS[shape]
        bracket = (np.log(0.7 * depth), np.log(depth), np.log(1.4 * depth))
        found = minimize_scalar(over_depth, bracket=bracket, args=(shape,))
        unit = system(shape, 1.0, T, "soft spring", TINY).unit_velocity
        name = f"{shape}, heavy body, ωτ = {T:g}: least v_c over Eq. (1), over |Im(q/z)| |z|/|q|"
        yield Check(name, float(found.fun) / unit / least, 1.0, 1e-5, "C α at α = 1e-6")
        name = f"{shape}, heavy body, ωτ = {T:g}: k_xc at that depth over Re(q/z)"
        at = float((np.exp(found.x) / depth) ** (1 / POWERS[shape]))
        yield Check(name, at, 1.0, 1e-3, "a minimum is found to the root of what its value is known to")


@figure("depth", 1, 2, size=(9.6, 4.2), sharey=True)
def _depth_figure(fig, axes, points: list[Point], effort: str):
    """Critical velocity over depth: constant for the flat punch, rising for curved shapes on the left, with a
    minimum on the right.

    v_c over the mean depth at a fixed amplitude of {amplitude:g} µm under one and the same spring, mass and damper: Eq.
    (15) with the stiffness at that depth (lines) and measured (points{later}). Eq. (15) is independent of the depth as
    far as k_x,c is: for the flat punch, and for all shapes under a rigid pull (dashed). Below its resonance the body
    amplifies and v_c grows with depth; a heavy body has one depth of least v_c, the same stiffness for every shape.
    """
    ratios = np.geomspace(0.1, 10, 60)
    for ax, T, pull in zip(axes, (0.0, 1.0), ("stiff spring", "soft spring"), strict=True):
        for shape, (colour, marker) in LOOKS.items():
            cases = [system(shape, float(r * DEPTH), T, pull) for r in ratios]
            curve = [mdr.critical_velocity(case) / case.unit_velocity for case in cases]
            ax.plot(ratios * DEPTH * 1e6, curve, color=colour, lw=1.2, label=shape_label(shape))
            here = [p for p in points if (p.shape, p.T, p.pull) == (shape, T, pull)]
            ax.plot([p.u_z0 * 1e6 for p in here], [p.over_rigid for p in here], marker, color=colour, mec="white")
        ax.axhline(1.0, color="0.4", lw=0.9, ls="--", zorder=0)
        ax.set(xscale="log", yscale="log", xlabel="mean depth $u_{z0}$ [µm]")
        ax.set_title(rf"{loss_label(T)}, $\omega_0$ = {PULLS[pull]['omega_0_ratio']:g} $\omega$")
        ticks(ax.xaxis, 2, 5, 10, 20, 50, 100, 200)
        ticks(ax.yaxis, 0.7, 1, 2, 5, 10)
    axes[0].annotate("rigid pull", (190, 1.0), (0, -11), textcoords="offset points", ha="right", fontsize=9)
    axes[0].set_ylabel("$v_c$ over Eq. (1)")
    axes[0].legend(loc="upper left")
    return {
        "amplitude": AMPLITUDE * 1e6,
        "later": "; the right panel has them in the full report" if effort == "quick" else "",
    }


@figure("slope", size=(6.8, 4.2))
def _slope_figure(fig, ax):
    """Sensitivity of the critical velocity to depth over the detuning of the body, with a pole-like swing for small
    damping.

    How strongly v_c depends on the depth, S = d ln v_c/d ln k_x,c, over the state of the body without damper. At the
    pole mω² = k_x (dotted) S = 1, beside the zero mω² = k_x + k_x,c of a nearly elastic contact it is largest, and far
    from both it tends to 0, the rigid pull. Circles: no dependence to first order.
    """
    q = np.linspace(-4, 8, 1201)
    for colour, T in zip(COLOURS, (0.1, 0.3, 1.0, 3.0), strict=False):
        z = 1 + 1j * T
        ax.plot(q, (-z / (q - z)).real, color=colour, label=rf"$\omega\tau$ = {T:g}")
        if abs(z) ** 2 < q[-1]:
            ax.plot(abs(z) ** 2, 0, "o", mfc="white", color=colour)
    ax.axhline(0, color="0.5", lw=0.8)
    ax.axvline(0, color="0.5", lw=0.8, ls=":")
    ax.set(xlabel=r"$(m\omega^2-k_x)/k_{x,c}$", ylabel=r"$S = n\,\mathrm{d}\ln v_c/\mathrm{d}\ln u_{z0}$", ylim=(-4, 4))
    ax.legend(loc="upper right")
