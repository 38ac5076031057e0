"""Normal contact with memory: the springs against the half-space of Lee and Radok, and of Ting.

Under a step of load a contact of a body with creep compliance J grows as (Lee and Radok 1960)

    flat punch u = F J(t)/(2 a),    cone u² = (π/2) tan(theta) F J(t),    paraboloid u^(3/2) = (3/4) F J(t)/√R.

Pressed in and drawn out, u = d sin(π t/P), the contact retreats through the radii it has grown through, a(t) = a(t_1),

    ∫_{t_1}^t E(t - s) u'(s) ds = 0,    F(t) = ∫_0^{t_1} E(t - s) d phi(u(s)),    phi = F_N/E*  (Ting 1966),

with phi = c u^n, and it ends at t_1 = 0. For u = d sin the integrals of a modulus E_inf + E_1 exp(-t/tau_1) and of a
dashpot E_inf tau are taken here by Gauss quadrature, t_1 by bisection; nothing here has springs.

Symbols: u depth, d its peak, P duration of the press, F force, J creep compliance, T = tau/P or tau_1/P.
"""

import math
from itertools import product
from typing import Any

import numpy as np

import mdr
from mdr.normal.indentation import Indentation, indent
from validation.cases import DEPTH, RADIUS, SHAPES, E, shape_label
from validation.figures import COLOURS, circles, figure, outer_labels
from validation.report import Check, Checks, Claim, told
from validation.words import listed, ranged, span

P = 20e-3  #: duration of a press [s]
LOAD = 0.1  #: of the creep test [N]
GLASSY = 10.0  #: instantaneous over long-time modulus of the standard solid
E_STAR = E / (1 - 0.5**2)
N_SAMPLES = 2000
DRAWN = (0.03, 0.3, 3.0)  # relaxation times of the figure, over P
PRESSES = {"quick": (0.3,), "full": (0.03, 0.1, 0.3, 1.0, 3.0), "long": tuple(np.geomspace(0.01, 10, 13))}
POWERS = {"cone": 2.0, "paraboloid": 1.5}
BODIES: dict[str, mdr.Material] = {
    "Kelvin": mdr.KelvinVoigt(E=E, nu=0.5, tau=P),
    "standard solid": mdr.StandardLinearSolid(E_inf=E, E_1=(GLASSY - 1) * E, tau_1=P, nu=0.5),
    "Prony, five decades": mdr.Prony(E_inf=E, arms=tuple((E, P * 10.0**k) for k in range(-3, 3)), nu=0.5),
    "Maxwell": mdr.StandardLinearSolid(E_inf=0, E_1=E, tau_1=P, nu=0.5),
}
KNOWN = ("flat punch", "cone", "paraboloid")  #: shapes whose creep has a closed form
NODES, WEIGHTS = np.polynomial.legendre.leggauss(80)


class Ting:
    """Half a sine of depth on a standard solid (tau = 0) or a Kelvin body (E_1 = 0), without springs."""

    def __init__(self, shape: str, E_1: float = 0.0, tau_1: float = 1.0, tau: float = 0.0) -> None:
        """Moduli in units of E_inf; shape is a name of SHAPES."""
        self.power = POWERS[shape]
        self.c = float(SHAPES[shape].force(DEPTH, 1.0)) / DEPTH**self.power
        self.E_1, self.tau_1, self.tau = E_1, tau_1, tau

    def u(self, t: Any) -> Any:
        """Depth [m]."""
        return DEPTH * np.sin(np.pi * t / P)

    def u_dot(self, t: Any) -> Any:
        """Its rate [m/s]."""
        return DEPTH * np.pi / P * np.cos(np.pi * t / P)

    def integral(self, rate: Any, low: float, high: float, t: float) -> float:
        """∫ E(t - s) rate(s) ds over E_inf, with s = low + (high - low) y² for the root at first touch."""
        y = 0.5 * (NODES + 1)
        s = low + (high - low) * y**2
        modulus = 1 + self.E_1 * np.exp(-(t - s) / self.tau_1)
        return float(np.sum(WEIGHTS * y * (high - low) * modulus * rate(s)))

    def balance(self, t_1: float, t: float) -> float:
        """Line load at the edge of the contact at t_1."""
        return self.integral(self.u_dot, t_1, t, t) + self.tau * float(self.u_dot(t))

    def t_1(self, t: float) -> float:
        """When the contact was as wide as at t: t while it grows, 0 after its end."""
        if self.balance(t, t) > 0 or (self.tau == 0 and t <= P / 2):
            return t
        return _root(lambda at: self.balance(at, t), 0.0, min(t, P / 2))

    def force(self, t: float) -> float:
        """F [N]."""
        t_1 = self.t_1(t)

        def rate(s: Any) -> Any:
            return self.c * self.power * self.u(s) ** (self.power - 1) * self.u_dot(s)

        impulse = self.tau * float(rate(t)) if t_1 == t else 0.0
        return E_STAR * (self.integral(rate, 0.0, t_1, t) + impulse)

    @property
    def end(self) -> float:
        """The end of contact [s]."""
        return _root(lambda t: self.balance(0.0, t), P / 2, P)


def _root(function: Any, low: float, high: float) -> float:
    """Where a falling function becomes zero; low if it is not above zero there."""
    if function(low) <= 0:
        return low
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if function(middle) > 0 else (low, middle)
    return low


def pressed(shape: str, kind: str, T: float) -> tuple[Indentation, Ting]:
    """One press of the springs, and Ting's solution of it."""
    if kind == "Kelvin":
        body: mdr.Material = mdr.KelvinVoigt(E=E, nu=0.5, tau=T * P)
        ting = Ting(shape, tau=T * P)
    else:
        body = mdr.StandardLinearSolid(E_inf=E, E_1=(GLASSY - 1) * E, tau_1=T * P, nu=0.5)
        ting = Ting(shape, GLASSY - 1, T * P)
    t = np.linspace(0, P, N_SAMPLES + 1)
    return indent(SHAPES[shape], body, t, ting.u(t)), ting


def claim(effort: str) -> Claim:
    """Springs with memory stand for a half-space with memory

    How: Set creep, relaxation, press and release beside the half-space.

    Range: creep over ten decades of time and relaxation, flat punch, cone and paraboloid, {bodies}; press and release
    of cone and paraboloid on Kelvin body and standard solid, checked at relaxation times {tested_times} of the
    duration, and drawn at {drawn_times}

    Measured: Creep agrees with the closed forms to rounding, and the springs carry the load under which it happens.
    Through the release the force is Ting's to {worst:.0e} of its peak. Contact ends, at these relaxation times, while
    the indenter is still {ends} % of the peak depth below the old surface.

    Verdict: holds

    Sentence: Releasing each spring where its own force vanishes reproduces Lee and Radok's growing and Ting's
    retreating contact: loads, contact radii and the end of contact.
    """
    every = product(POWERS, ("Kelvin", "standard solid"), PRESSES[effort])
    presses = {one: pressed(*one) for one in every}
    checks = (*_creep_checks(effort), *_relaxation_checks(), *_press_checks(presses))
    worst = max(float(c.got or 0) for c in checks if "force" in c.name and "press" in c.name)
    left = [100 * float(ting.u(ting.end)) / DEPTH for _, ting in presses.values()]
    times = sorted({T for _, _, T in presses})
    bodies = ", ".join(BODIES)
    tested_times = ranged(times).removeprefix("= ")
    drawn_times = listed(DRAWN)
    ends = span(left, 2)
    return Claim(**told(claim, locals()), checks=checks, figures=(_press_figure(), _creep_figure()))


# --- checks ---


def creep_depth(shape: str, FJ: Any) -> Any:
    """Depth [m] from F J(t) [m²], Lee and Radok (1960)."""
    indenter = SHAPES[shape]
    if shape == "flat punch":
        return FJ / (2 * RADIUS)
    if shape == "cone":
        return np.sqrt(np.pi / 2 * math.tan(indenter.theta) * FJ)
    return (0.75 * FJ / math.sqrt(indenter.R)) ** (2 / 3)


def _creep_checks(effort: str) -> Checks:
    t = np.concatenate([[0.0], P * np.geomspace(1e-6, 1e4, 101)])
    fine = np.concatenate([[0.0], P * np.geomspace(1e-4, 1e3, 1000 if effort == "quick" else 4000)])
    for name, body in BODIES.items():
        off = []
        for shape in KNOWN:
            run = indent(SHAPES[shape], body, t, F_z=np.full(t.size, LOAD))
            expected = creep_depth(shape, LOAD * np.asarray(body.creep_compliance(t)))[1:]
            off.append(np.max(np.abs(run.u_z[1:] / expected - 1)))
        why = "while the contact grows both are sums of exponentials"
        yield Check.at_most(f"{name}: depth under a step of load, greatest relative error", max(off), 1e-6, why)
    body = BODIES["standard solid"]
    for shape in KNOWN:
        run = indent(SHAPES[shape], body, fine, creep_depth(shape, LOAD * np.asarray(body.creep_compliance(fine))))
        why = "the depth is straight between samples, and six springs share the load that falls off at the edge"
        name, off = f"{shape}: force of the springs that creep, over the load", np.max(np.abs(run.F_z / LOAD - 1))
        yield Check.at_most(name, off, 1e-4 if effort != "quick" else 1e-3, why)


def _relaxation_checks() -> Checks:
    t = P * np.concatenate([[0.0], np.geomspace(1e-6, 1e4, 101)])
    for name, body in BODIES.items():
        off = []
        for shape in KNOWN:
            run = indent(SHAPES[shape], body, t, np.full(t.size, DEPTH))
            expected = float(SHAPES[shape].force(DEPTH, 1.0)) * np.asarray(body.relaxation_modulus(t))
            off.append(np.max(np.abs(run.F_z - expected)) / expected[0])
        why = "all springs touch at once: exponentials on both sides"
        yield Check.at_most(f"{name}: force after a step of depth, over its start", max(off), 1e-12, why)


def _press_checks(presses: dict[tuple[str, str, float], tuple[Indentation, Ting]]) -> Checks:
    some = np.arange(0, N_SAMPLES + 1, 50)
    for (shape, kind, T), (run, ting) in presses.items():
        F = np.array([ting.force(t) for t in run.t[some]])
        off = float(np.max(np.abs(run.F_z[some] - F)) / F.max())
        name = f"{shape} on {kind}, T = {T:.3g}: press and release"
        why = "512 springs, and a sine of 2000 straight pieces"
        yield Check.at_most(f"{name}, force over its peak", off, 1e-3, why)
        last = run.t[np.flatnonzero(run.contact_radius)[-1]]
        yield Check(f"{name}, end of contact over P", last / P, ting.end / P, 1e-3, "two samples of P/2000")


# --- figures ---


@figure("press", 2, 2, size=(9.4, 7.2), sharex=True, sharey=True)
def _press_figure(fig, axes):
    """Force-depth loops of cone and paraboloid on Kelvin body and standard solid, lines of springs through Ting's
    circles.

    Half a sine of depth in the duration P, force over depth; every loop runs clockwise. Lines: springs, each released
    where its own force vanishes; circles: Ting's integrals; crosses: Ting's end of contact. Contact is lost while the
    indenter is still below the old surface, for slow materials hardly after the turn (Kelvin) or, once they are glassy
    throughout the press, close to the old surface again (standard solid).
    """
    for ax, (kind, shape) in zip(axes.flat, product(("Kelvin", "standard solid"), POWERS), strict=True):
        scale = E_STAR * float(SHAPES[shape].force(DEPTH, 1.0))
        for T, colour in zip(DRAWN, COLOURS, strict=False):
            run, ting = pressed(shape, kind, T)
            kept = np.arange(np.flatnonzero(run.contact_radius)[-1] + 2)
            label = f"relaxation time {T:g} $P$"
            ax.plot(run.u_z[kept] / DEPTH, run.F_z[kept] / scale, color=colour, label=label)
            some = np.linspace(0.02 * P, ting.end * 0.999, 23)
            circles(ax, ting.u(some) / DEPTH, np.array([ting.force(t) for t in some]) / scale, colour)
            ax.plot(ting.u(ting.end) / DEPTH, 0, "x", color=colour, ms=7, mew=1.8, clip_on=False, zorder=4)
        ax.set(title=f"{shape_label(shape)}, {kind}", xlim=(0, 1.02))
    outer_labels(axes, "depth $u/d$", r"force over elastic peak, $E_\infty$")
    axes[0, 0].set_ylim(0, 10.5)
    fig.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)


@figure("creep", 1, 2, size=(9.4, 4.2))
def _creep_figure(fig, axes):
    """Creep curves over eight decades through circles, and the compression of the central spring under tapping.

    P is the duration of a press. Left: depth under a step of load, lines the library, circles the closed form of Lee
    and Radok. Right: the spring in the centre is left by the indenter while still compressed, relaxes, and is met again
    below the old surface, a little deeper at every stroke.
    """
    left, right = axes
    t = np.concatenate([[0.0], P * np.geomspace(1e-5, 1e3, 161)])
    some = P * np.geomspace(1.3e-5, 0.8e3, 17)
    for (name, body), colour in zip(BODIES.items(), COLOURS, strict=False):
        run = indent(SHAPES["paraboloid"], body, t, F_z=np.full(t.size, LOAD))
        left.loglog(t[1:] / P, run.u_z[1:] * 1e6, color=colour, label=name)
        J = np.asarray(body.creep_compliance(some))
        circles(left, some / P, creep_depth("paraboloid", LOAD * J) * 1e6, colour)
    left.set(xlabel="time $t/P$", ylabel="depth [µm]", title="creep of a paraboloid under 0.1 N")
    t = P * np.linspace(0, 6, 1201)
    u_z = DEPTH * np.sin(2 * np.pi * t / (2 * P))
    run = indent(SHAPES["paraboloid"], BODIES["standard solid"], t, u_z, record=True)
    right.plot(t / P, u_z / DEPTH, color="0.6", label="indenter")
    right.plot(t / P, run.s[:, 0] / DEPTH, color=COLOURS[0], label="surface in the centre")
    touching = run.F_z > 0
    right.fill_between(t / P, -1.05, 1.05, where=list(touching), color=COLOURS[5], alpha=0.2, lw=0, label="contact")
    right.set(xlabel="time $t/P$", ylabel="over peak depth", ylim=(-1.05, 1.05), title="standard solid, tapped")
    fig.legend(loc="outside lower center", ncols=4)
