"""At small amplitude the elastic COF curves of all shapes are one; what is left of the shape is known to first order.

Rigid pull, elastic contact that is kept. The springs of the core lose what one spring loses, psi(v), `deficit` of
mdr/closed_forms/paper.py. Those at the edge touch later or not at all, and add C(v) alpha/n to it for f ~ r^n, with one
C for all shapes (`mdr.laws.edge_band`). This first order is all there is for the flat punch (n = infinity) and for the
cone (n = 1), whose stiffness is linear in the depth; the second has the factor (1/n) (1/n - 1)/2.

Symbols: alpha = du_z/u_z0, v = v_0/v_c, <F_N> mean normal force.
"""

from dataclasses import dataclass
from itertools import product

import numpy as np

import mdr
from mdr import laws
from mdr.closed_forms import paper as theory
from mdr.closed_forms.rigid_pull import average_friction
from mdr.normal.normal_force import mean_normal_force
from mdr.tools.arrays import Array
from validation.cases import POWERS, SHAPES, contact, shape_label
from validation.figures import COLOURS, figure
from validation.measured import RUN, power, worst
from validation.report import Check, Checks, Claim, Equation, told

ALPHAS = np.geomspace(0.003, 0.03, 6)  #: to which the order of what is left is fitted
SHOWN = 0.3  #: alpha of the figure


@dataclass(frozen=True)
class OneCurve:
    """psi and C at velocities v; arrays of shape (n_v,)."""

    v: Array
    psi: Array
    C: Array

    def of(self, shape: str, alpha: float) -> Array:
        """psi (1 + C alpha/n)."""
        return np.asarray(self.psi * (1 + self.C * alpha / POWERS[shape]))


_EQUATIONS = (
    Equation(
        "ψ",
        r"\psi(\hat{v}) = \frac{1}{2\pi} \left[ \sin \varphi_2 - \sin \varphi_1 - (\varphi_2 - \varphi_1) \cos"
        r" \varphi_1 - \frac{\hat{v}}{2} (\varphi_2 - \varphi_1)^2 \right]",
        "Lost by a single spring, v̂ = v_0/v_c. It sticks from φ_1 = π + arcsin v̂ until cos φ_2 = cos φ_1 + v̂"
        " (φ_2 − φ_1).",
    ),
    Equation(
        "",
        r"\left( 1 - \frac{\mu}{\mu_0} \right) \frac{\langle F_N \rangle}{k_{z,c} \Delta u_z} = \psi(\hat{v})"
        r" \left[ 1 + C(\hat{v}) \frac{\alpha}{n} \right]",
        "The first two orders of any shape f ~ <i>r</i>^n; C is −1/4 at rest and 0 at v_c"
        " (<code>mdr.laws.edge_band</code>).",
    ),
)


def claim(effort: str) -> Claim:
    """At small amplitude the whole COF curve, not only v_c, is the same for all shapes

    How: Scale the curves of four shapes on one, and count the order of what is left.

    Quote: In the present paper, the critical velocity of controllability was determined for … the simplest possible
    contact geometry … However, it does not depend on absolute indentation, which permits easy generalization to more
    realistic contact geometry. (Section 3)

    Range: Elastic flat punch, cone, paraboloid and r^4 that keep contact, rigid pull, Δu_z/u_z0 up to 0.98,
    {law.v.size} velocities up to v_c; closed form of the COF, and runs for the punch and the cone.

    Measured: The lost friction 1 − μ/μ_0, in units of k_zc Δu_z/⟨F_N⟩, is one function ψ(v_0/v_c) for all shapes, up to
    terms of order Δu_z/u_z0: that of a single spring, since all springs of the core move alike. The first of these
    terms comes from the springs at the edge and is <i>C</i>(v_0/v_c) Δu_z/(<i>n</i> u_z0) for <i>f</i> ~ <i>r</i>^n,
    with the same <i>C</i> for all. With it the punch and the cone are exact at any amplitude that keeps contact, and
    what is left of the others falls with the amplitude to the power {orders[paraboloid]:.2f} (paraboloid) and
    {orders[r^4]:.2f} (r^4). At Δu_z/u_z0 = {SHOWN:g} the curves differ among each other by up to {raw:.2g}, the scaled
    ones from ψ by {scaled:.1g}, and by {left:.1g} after the correction.

    Verdict: holds

    Sentence: Elastic, rigid pull: to first order in the amplitude every shape loses the friction of one spring, (k_zc
    Δu_z/⟨F_N⟩) ψ(v_0/v_c), and to second order, for <i>r</i>^n, that times 1 + <i>C</i> Δu_z/(<i>n</i> u_z0).
    """
    quick = effort == "quick"
    law = one_curve(np.linspace(1e-6, 0.999, 40 if quick else 120))
    orders = {shape: order(shape, law, corrected=True) for shape in ("paraboloid", "r^4")}
    raw, scaled, left = spreads(law)
    return Claim(
        **told(claim, locals()),
        checks=(*_exact_checks(law, 6 if quick else 25), *_first_order_checks(), *_order_checks(law, orders)),
        figures=(_figure(law),),
        equations=_EQUATIONS,
    )


def one_curve(v: Array) -> OneCurve:
    """The two functions at 0 < v < 1, shape (n_v,)."""
    return OneCurve(v, np.array([theory.deficit(x) for x in v]), np.array([laws.edge_band(x) for x in v]))


def lost(shape: str, alpha: float, v: Array) -> Array:
    """1 - mu/mu_0 of an elastic contact, shape (n_v,)."""
    case = contact(shape, alpha)
    return np.asarray(1 - average_friction(case, v * mdr.critical_velocity(case)).cof / case.mu_0)


def unit(shape: str, alpha: float) -> float:
    """k_zc du_z/<F_N>, the unit of the lost friction."""
    case = contact(shape, alpha)
    return float(case.k_zc * case.oscillation.du_z / mean_normal_force(case))


def left_over(shape: str, alpha: float, law: OneCurve, *, corrected: bool) -> Array:
    """The scaled curve less psi, or less psi with its first-order term; (n_v,)."""
    return lost(shape, alpha, law.v) / unit(shape, alpha) - (law.of(shape, alpha) if corrected else law.psi)


def order(shape: str, law: OneCurve, *, corrected: bool) -> float:
    """Power of alpha with which the largest left-over grows, fitted over ALPHAS."""
    return power(ALPHAS, [np.max(np.abs(left_over(shape, a, law, corrected=corrected))) for a in ALPHAS])


def spreads(law: OneCurve) -> tuple[float, float, float]:
    """At alpha = SHOWN, the largest: spread of 1 - mu/mu_0; left-over; left-over of the corrected curve."""
    left = [[left_over(shape, SHOWN, law, corrected=which) for shape in SHAPES] for which in (False, True)]
    raw = np.max(np.ptp([lost(shape, SHOWN, law.v) for shape in SHAPES], axis=0))
    return float(raw), float(np.max(np.abs(left[0]))), float(np.max(np.abs(left[1])))


# --- checks ---


def _exact_checks(law: OneCurve, n_v: int) -> Checks:
    """Punch and cone, by the closed form and by runs."""
    run_at = one_curve(np.linspace(0.02, 0.98, n_v))
    for shape, alpha in product(("flat punch", "cone"), (0.03, 0.5, 0.98)):
        share, case = unit(shape, alpha), contact(shape, alpha)
        off = share * np.max(np.abs(left_over(shape, alpha, law, corrected=True)))
        what = f"1 − (k_zc Δu_z/⟨F_N⟩) ψ (1 + C Δu_z/(n u_z0)), worst: elastic {shape}, Δu_z/u_z0 = {alpha:g}"
        why = "what the closed form promises for an elastic contact"
        yield Check.at_most(f"COF/μ_0 in closed form against {what}", off, 1e-10, why)
        runs = np.array([mdr.slide(case, v * mdr.critical_velocity(case)).cof for v in run_at.v])
        off = np.max(np.abs(runs / case.mu_0 - 1 + share * run_at.of(shape, alpha)))
        yield Check.at_most(f"COF/μ_0 of slide() against {what}", off, 1e-5, RUN)


def _first_order_checks() -> Checks:
    """C from two small amplitudes, for every shape that has such a term."""
    near, far = 1e-3, 2e-3
    law = one_curve(np.array([0.1, 0.3, 0.7]))

    def slope(shape: str, alpha: float) -> Array:
        return POWERS[shape] * left_over(shape, alpha, law, corrected=False) / (alpha * law.psi)

    found = np.array([2 * slope(shape, near) - slope(shape, far) for shape in ("cone", "paraboloid", "r^4")])
    for i, v in enumerate(law.v):
        name = f"first-order term C of the lost friction, worst of cone, paraboloid and r^4: v_0/v_c = {v:g}"
        why = "two amplitudes extrapolated leave their product, the next order, with a factor of order one"
        yield Check(name, worst(found[:, i], law.C[i]), law.C[i], near * far, why)
    why = "at rest the lag of a spring is its mean compression: 3/4 of that of the core; C rises from it like v_0/2"
    yield Check("C at v_0/v_c = 1e-9", laws.edge_band(1e-9), -0.25, 1e-8, why)


def _order_checks(law: OneCurve, orders: dict[str, float]) -> Checks:
    """The power of alpha before and after the correction."""
    why = f"the next order is smaller by Δu_z/u_z0, at most {ALPHAS[-1]:g}, with a factor of order one"
    name = "power of Δu_z/u_z0 by which the scaled curve differs from"
    for shape in ("cone", *orders):
        yield Check(f"{name} ψ: {shape}", order(shape, law, corrected=False), 1.0, ALPHAS[-1], why)
    for shape, got in orders.items():
        yield Check(f"{name} ψ (1 + C Δu_z/(n u_z0)): {shape}", got, 2.0, ALPHAS[-1], why)
    alpha = ALPHAS[0]
    second = {shape: left_over(shape, alpha, law, corrected=True)[0] for shape in orders}
    n_2, n_4 = (1 / POWERS[shape] * (1 / POWERS[shape] - 1) for shape in ("paraboloid", "r^4"))
    name = f"what is left of r^4 over that of the paraboloid near rest, Δu_z/u_z0 = {alpha:g}, as (1/n)(1/n − 1)"
    got = second["r^4"] / second["paraboloid"]
    yield Check(name, got, n_4 / n_2, alpha, "the next order is smaller by Δu_z/u_z0")


# --- figure ---


@figure("collapse", 1, 3, size=(12.6, 4.2))
def _figure(fig, axes, law: OneCurve):
    """Three panels over velocity: four curves apart; the same scaled, nearly one; what is left with and without a
    correction.

    Elastic contacts of four shapes, α = Δu_z/u_z0 = {shown:g}. Left: they lose up to {raw:.2g} μ_0 more or less than
    each other. Middle: in units of k_zc Δu_z/⟨F_N⟩ all lose ψ(v_0/v_c), the deficit of a single spring, to
    {before:.1g}. Right: what the edge adds in first order, <i>C</i>(v_0/v_c) α/<i>n</i>, leaves {after:.1g} of the
    paraboloid and less of r^4 (solid), and nothing of the punch and the cone, solid lines at zero.
    """
    curves, scaled, left = axes
    v = law.v
    for shape, colour in zip(SHAPES, COLOURS, strict=False):
        raw = lost(shape, SHOWN, v)
        curves.plot(v, raw, color=colour, label=shape_label(shape))
        scaled.plot(v, raw / unit(shape, SHOWN), color=colour)
        left.plot(v, left_over(shape, SHOWN, law, corrected=False), color=colour, lw=1, ls="--")
        left.plot(v, left_over(shape, SHOWN, law, corrected=True), color=colour)
    scaled.plot(v, law.psi, color="k", lw=1, ls=":", label=r"$\psi$")
    left.plot([], [], color="0.3", lw=1, ls="--", label=r"from $\psi$")
    left.plot([], [], color="0.3", label=r"from $\psi\,(1+C\alpha/n)$")
    curves.set(title="lost friction", ylabel=r"$1-\mu/\mu_0$")
    scaled.set(title="scaled", ylabel=r"$(1-\mu/\mu_0)\,\langle F_N\rangle/(k_{zc}\,\Delta u_z)$")
    left.set(title="difference of the scaled curves", ylabel="scaled curve less its law")
    for ax in (curves, scaled, left):
        ax.set(xlabel="pulling velocity $v_0/v_c$", xlim=(0, 1))
        ax.legend()
    raw, before, after = spreads(law)
    return {"shown": SHOWN, "raw": raw, "before": before, "after": after}
