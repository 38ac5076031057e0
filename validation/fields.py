"""From the springs back to the surface: pressure, traction and displacement of a contact that partly slips.

Pulled by u_x at the fixed depth d, a contact of any shape sticks within the radius c, g(c) = d - u_x/(mu_0 κ), and

    F_x = mu_0 [F_N(d) - F_N(d - u_x/(mu_0 κ))];

for the paraboloid the traction is that of Cattaneo (1938) and Mindlin (1949), and a loop between ±T costs (Mindlin and
Deresiewicz 1953)

    tau = mu_0 p_0 [√(1 - r²/a²) - (c/a) √(1 - r²/c²)],
    W = (18/5) (mu_0 F_N)²/(G* a) [1 - θ^(5/2) - (5 T/(6 mu_0 F_N)) (1 + θ)],    θ = (1 - T/(mu_0 F_N))^(2/3).

The springs stick and slip one by one here, and know nothing of these formulas.

Symbols: d depth, a contact radius, c stick radius, p pressure, tau traction, κ = E*/G*, u_x displacement of the
indenter, U amplitude of a loop, n number of springs.
"""

import math
from itertools import pairwise

import numpy as np

import mdr
from mdr.friction.surface_fields import from_line_load, surface_fields
from mdr.normal.indentation import indent
from mdr.normal.partial_slip import partial_slip, tangential_loop
from mdr.tools.arrays import Array
from validation.cases import DEPTH, LOOKS, OMEGA, RADIUS, SHAPES, E, contact, shape_label
from validation.figures import COLOURS, circles, figure
from validation.report import Check, Checks, Claim, told

BODY = mdr.Elastic(E=E, nu=0.5)
MU_0 = 0.5
FULL = MU_0 * BODY.mindlin_ratio * DEPTH  #: displacement from which all springs slip [m]
P_0 = 2 * BODY.E_star * DEPTH / (math.pi * RADIUS)  #: Hertz's greatest pressure [Pa]
SHARES = (0.2, 0.5, 0.8, 1.0)
N_SPRINGS = {"quick": 1000, "full": 4000, "long": 16000}


class Row:
    """Springs in cells of equal width under a shape at the depth DEPTH: a return mapping, spring by spring."""

    def __init__(self, shape: str, n: int) -> None:
        """Cells know their mean load from the area under g."""
        edges = RADIUS * np.linspace(0, 1, n + 1)
        dx = np.diff(edges)
        self.x = 0.5 * (edges[1:] + edges[:-1])
        g = np.diff(np.asarray(SHAPES[shape].profile_area(edges))) / dx
        self.limit = MU_0 * BODY.E_star * np.maximum(DEPTH - g, 0) * 2 * dx
        self.k = BODY.G_star * 2 * dx
        self.f, self.u = np.zeros(n), 0.0

    def to(self, u: float) -> float:
        """Move the indenter to u [m]; the tangential force [N] there."""
        self.f = np.clip(self.f + self.k * (u - self.u), -self.limit, self.limit)
        self.u = u
        return float(self.f.sum())

    def traction(self, r: Array) -> Array:
        """Traction [Pa] at radii r."""
        q = self.f / (2 * RADIUS / self.f.size)
        return from_line_load(np.concatenate([[0.0], self.x, [RADIUS]]), np.concatenate([q[:1], q, [0.0]]), r)

    @property
    def stick_radius(self) -> float:
        """Where the first slipping spring stands [m]."""
        slips = np.abs(self.f) >= self.limit * (1 - 1e-12)
        return float(self.x[slips][0]) if slips.any() else RADIUS


def mindlin(r: Array, c: float) -> Array:
    """Traction [Pa] of the paraboloid."""
    outer = np.sqrt(np.maximum(1 - (r / RADIUS) ** 2, 0))
    inner = np.sqrt(np.maximum(1 - (r / c) ** 2, 0)) if c > 0 else 0.0
    return np.asarray(MU_0 * P_0 * (outer - c / RADIUS * inner))


def disc(*cuts: float) -> tuple[Array, Array]:
    """Radii of the contact, close together at its tip, edge and cuts, and weights of 2π ∫ ... r dr."""
    u, weight = np.polynomial.legendre.leggauss(160)
    u, weight = 0.5 * (u + 1), 0.5 * weight
    radii, weights = [], []
    inner = [math.asin(c / RADIUS) for c in cuts if 0 < c < RADIUS]
    for low, high in pairwise([0.0, *inner, math.pi / 2]):
        t, dt = low + (high - low) * u**2 * (3 - 2 * u), (high - low) * 6 * u * (1 - u)
        radii.append(RADIUS * np.sin(t))
        weights.append(2 * np.pi * RADIUS**2 * weight * dt * np.sin(t) * np.cos(t))
    return np.concatenate(radii), np.concatenate(weights)


def off(got: Array, expected: Array, weight: Array) -> float:
    """Relative difference in the mean square over the disc."""
    return math.sqrt(float(np.sum(weight * (got - expected) ** 2) / np.sum(weight * expected**2)))


def claim(effort: str) -> Claim:
    """The springs give the tractions of the three-dimensional contact

    How: Set tractions, loops and sums beside the textbook.

    Range: flat punch, cone, paraboloid and r^4 at a depth of 20 µm, pulled until all springs slip, and back; rows of
    {n} springs, and the springs of a sliding run

    Measured: The traction of springs that stick and slip one by one is Cattaneo's and Mindlin's to {off_mindlin:.0e} in
    the mean square; pressures and tractions add up to F_N and F_x; every shape obeys Masing's rule to rounding, and the
    loops of the paraboloid cost what Mindlin and Deresiewicz say.

    Verdict: holds

    Sentence: Pressure, traction, stick radius, surface displacement and the loss of a loop follow from the springs as
    contact mechanics has them.
    """
    n = N_SPRINGS[effort]
    checks = (*_mindlin_checks(n), *_run_checks(), *_sum_checks(), *_loop_checks(n), *_surface_checks())
    off_mindlin = max(float(c.got or 0) for c in checks if "one by one" in c.name)
    return Claim(**told(claim, locals()), checks=checks, figures=(_traction_figure(), _loop_figure()))


# --- checks ---


def _mindlin_checks(n: int) -> Checks:
    for share in SHARES[:3]:
        row, c = Row("paraboloid", n), RADIUS * math.sqrt(1 - share)
        row.to(share * FULL)
        r, weight = disc(c)
        tau = row.traction(r)
        name = f"paraboloid pulled to {share:g} of full slip"
        why = f"a kink within a cell h = a/{n}: off by the root of h over a width h, which is h in the mean square"
        yield Check.at_most(f"{name}: traction of {n} springs, one by one", off(tau, mindlin(r, c), weight), 2 / n, why)
        why = "the first spring that slips stands within one spacing"
        yield Check(f"{name}: stick radius over a", row.stick_radius / RADIUS, c / RADIUS, 1 / n, why)
        pulled = partial_slip(SHAPES["paraboloid"], BODY, MU_0, DEPTH, share * FULL)
        found = surface_fields(pulled, r)
        worst = float(np.max(np.abs(found.traction - mindlin(r, c)))) / (MU_0 * P_0)
        yield Check.at_most(f"{name}: traction of partial_slip over mu_0 p_0", worst, 1e-12, "closed on both sides")


def _run_checks() -> Checks:
    """The surface under a sliding run from rest, half way to full slip.

    The oscillation is a thousandth of the depth, and small beside the pull.
    """
    n, case = 2048, contact("paraboloid", 1e-3, mu_0=MU_0)
    knobs = {"steps_per_period": 256, "n_periods": 1, "start": "rest", "record": 1, "lump": False}
    run = mdr.slide(case, 0.5 * FULL * OMEGA / (2 * np.pi), n_springs=n, **knobs)
    d_c = float(run.u_z[-1]) - float(run.u_x[-1]) / (MU_0 * BODY.mindlin_ratio)
    c = float(SHAPES["paraboloid"].contact_radius(d_c))
    r, weight = disc(c)
    found = surface_fields(run, r)
    core = n // 8  # springs of a run crowd at the edge of the contact
    why = f"a/{core} is the spacing of the springs inside; the edge slips to and fro with the oscillation"
    name = f"sliding run of {n} springs: stick radius over a"
    yield Check(name, found.stick_radius / RADIUS, c / RADIUS, 1.0 / core, why)
    name = f"sliding run of {n} springs: traction, mean square"
    yield Check.at_most(name, off(found.traction, mindlin(r, c), weight), 5e-3, why)
    name = f"sliding run of {n} springs: integral of traction over F_x"
    why = "quadrature over the kinks of straight lines, and an edge a thousandth further out"
    yield Check(name, float(np.sum(weight * found.traction)) / found.F_x, 1.0, 1e-3, why)


def _sum_checks() -> Checks:
    for shape, indenter in SHAPES.items():
        pulled = partial_slip(indenter, BODY, MU_0, DEPTH, FULL * np.array(SHARES))
        worst = []
        for i, c in enumerate(np.asarray(pulled.stick_radius)):
            r, weight = disc(float(c))
            found = surface_fields(pulled, r, i=i)
            worst.append(abs(np.sum(weight * found.pressure) / pulled.F_z - 1))
            worst.append(abs(np.sum(weight * found.traction) / pulled.F_x[i] - 1))
        why = "Gauss quadrature with nodes that crowd at tip, edge and stick radius"
        yield Check.at_most(f"{shape}: p and traction over the disc against F_N and F_x", max(worst), 1e-6, why)
        run = indent(indenter, BODY, [0, 1], [0, DEPTH], record=True)
        r, weight = disc()
        apart = off(surface_fields(run, r).pressure, np.asarray(indenter.pressure(r, DEPTH, BODY.E_star)), weight)
        why = "straight lines between 3000 knots"
        yield Check.at_most(f"{shape}: p of the springs, mean square", apart, 1e-4, why)


def _loop_checks(n: int) -> Checks:
    w = np.linspace(0, 1, 41)
    for shape in SHAPES:
        worst = []
        for share in (0.3, 0.8, 1.3):
            row, U = Row(shape, n), share * FULL
            first = np.array([row.to(u) for u in U * w])
            back = np.array([row.to(u) for u in U - 2 * U * w])
            again = np.array([row.to(u) for u in -U + 2 * U * w])
            turns = np.concatenate([back[0] - back, again - again[0]])
            worst.append(np.max(np.abs(turns - np.tile(2 * first, 2))) / (MU_0 * row.limit.sum()))
        why = f"sums of {n} springs that were never told the rule, over mu_0 F_N"
        yield Check.at_most(f"{shape}: Masing's rule, twice the force for twice the way", max(worst), 1e-10, why)
    for share in SHARES[:3]:
        loop = tangential_loop(SHAPES["paraboloid"], BODY, MU_0, DEPTH, share * FULL)
        F_N, theta = float(loop.F_z), 1 - share
        T = MU_0 * F_N * (1 - theta**1.5)
        loss = 18 / 5 * (MU_0 * F_N) ** 2 / (BODY.G_star * RADIUS)
        loss *= 1 - theta**2.5 - 5 * T / (6 * MU_0 * F_N) * (1 + theta)
        name = f"paraboloid, loop of {share:g} of full slip: loss over Mindlin and Deresiewicz"
        yield Check(name, loop.loss / loss, 1.0, 1e-9, "closed on both sides, up to one quadrature")
        row, way = Row("paraboloid", n), share * FULL * np.cos(np.linspace(0, 2 * np.pi, 4001))
        row.to(way[0])
        F = np.array([row.to(u) for u in way])
        got = abs(float(np.sum(np.diff(way) * (F[1:] + F[:-1]) / 2))) / loss
        why = "trapezoids on 4000 steps, cells that slip as a whole"
        yield Check(f"{name}, {n} springs", got, 1.0, 1e-4, why)


def _surface_checks() -> Checks:
    r = RADIUS * np.linspace(1.001, 5, 60)
    ratio = r / RADIUS
    hertz = DEPTH / math.pi * ((2 - ratio**2) * np.arcsin(1 / ratio) + np.sqrt(ratio**2 - 1))
    run = indent(SHAPES["paraboloid"], BODY, [0, 1], [0, DEPTH], record=True)
    outside = float(np.max(np.abs(np.asarray(surface_fields(run, r).u_z) / hertz - 1)))
    why = "second order in 3000 knots"
    yield Check.at_most("paraboloid: surface outside the contact against Hertz", outside, 1e-5, why)


# --- figures ---


@figure("traction", 1, 2, size=(9.4, 4.3))
def _traction_figure(fig, axes):
    """Tangential traction over radius, lines through circles for the paraboloid, and four shapes with stick radii.

    Left: tractions under a paraboloid pulled sideways; lines from springs that stick and slip one by one, circles
    Cattaneo and Mindlin. Right: the four shapes at half of full slip; within the dotted radius the surface sticks, and
    the punch sticks as a whole.
    """
    left, right = axes
    r, some = RADIUS * np.linspace(0, 1.0, 601)[:-1], RADIUS * np.linspace(0.02, 0.98, 17)
    for share, colour in zip(SHARES, COLOURS, strict=False):
        row, c = Row("paraboloid", 1000), RADIUS * math.sqrt(1 - share)
        row.to(share * FULL)
        left.plot(r / RADIUS, row.traction(r) / (MU_0 * P_0), color=colour, label=f"{share:g}")
        circles(left, some / RADIUS, mindlin(some, c) / (MU_0 * P_0), colour)
    for ax in axes:
        ax.set(xlabel="radius $r/a$", xlim=(0, 1.02))
    left.set(ylabel=r"traction over $\mu_0 p_0$", title="paraboloid", ylim=(0, 1.05))
    left.legend(title=r"$u_x$ over full slip")
    for shape, indenter in SHAPES.items():
        pulled = partial_slip(indenter, BODY, MU_0, DEPTH, 0.5 * FULL)
        mean = MU_0 * pulled.F_z / (math.pi * RADIUS**2)
        tau = surface_fields(pulled, r[1:]).traction / mean
        right.plot(r[1:] / RADIUS, tau, color=LOOKS[shape][0], label=shape_label(shape))
        c = float(pulled.stick_radius)
        if 0 < c < RADIUS:
            right.plot([c / RADIUS] * 2, [0, np.interp(c, r[1:], tau)], color=LOOKS[shape][0], lw=1, ls=":")
    right.set(ylabel=r"traction over $\mu_0 F_N/\pi a^2$", title="half of full slip", ylim=(0, 2.2))
    right.legend()


@figure("loops", 1, 2, size=(9.4, 4.3))
def _loop_figure(fig, axes):
    """Hysteresis loops of four shapes, and loss against amplitude on logarithmic axes.

    Left: to and fro at fixed depth; lines by Masing's rule, circles springs one by one. Right: its cost, below full
    slip (dotted, displacement u_s) the third power of the amplitude for the curved shapes, while the punch, which
    sticks as a whole, loses nothing.
    """
    left, right = axes
    for shape, indenter in SHAPES.items():
        colour = LOOKS[shape][0]
        loop = tangential_loop(indenter, BODY, MU_0, DEPTH, 0.8 * FULL)
        left.plot(loop.u_x / FULL, loop.F_x / (MU_0 * loop.F_z), color=colour, label=shape_label(shape))
        row = Row(shape, 1000)
        way = 0.8 * FULL * np.concatenate([[1.0], np.linspace(0.9, -0.9, 13), [-1.0], np.linspace(-0.9, 0.9, 13)])
        F = np.array([row.to(u) for u in way])
        circles(left, way / FULL, F / (MU_0 * loop.F_z), colour, ms=4)
        shares, unit = np.geomspace(0.02, 1.5, 40), 4 * MU_0 * loop.F_z * FULL
        lost = np.array([tangential_loop(indenter, BODY, MU_0, DEPTH, share * FULL, n=3).loss for share in shares])
        shown = lost > 1e-9 * unit
        right.loglog(shares[shown], lost[shown] / unit, color=colour, label=shape_label(shape))
    left.set(xlabel="displacement over full slip", ylabel=r"$F_x/\mu_0 F_N$", title="loops of 0.8 of full slip")
    right.set(xlabel="amplitude over full slip", ylabel=r"loss over $4\mu_0 F_N u_s$", ylim=(1e-7, 1))
    right.set_title("loss in a loop")
    right.axvline(1, color="0.6", lw=1, ls=":")
    fig.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=4)
