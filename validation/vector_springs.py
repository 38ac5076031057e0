"""Springs whose friction is a vector beside a half-space: shaken across, MDR superposes tractions of many directions.

A row of springs has the forces of the contact as long as tractions have one direction. Shaken across, springs near the
edge slip while others stick, and point elsewhere. The traction on the surface follows from the slope of the springs'
load along the row. Where the direction changes there it exceeds mu_0 p, elsewhere it stays below: Coulomb's law holds
in every spring, and not in every point.

Two judges. A half-space of nu = 0 without coupling needs one traction for each annulus (validation/half_space/
annuli.py), and is solved to 1e-3 down to slow slides. Cells (mdr.half_space) have any nu and coupling.

What replaces springs: at rest Coulomb's law in every point has a closed form (`mdr.laws.held_across`, surface=True);
how its difference to the springs fades with velocity is fitted (`mdr.laws.excess_across`). Coupling acts as if the
contact were stiffer by 0.36 beta²/kappa (`mdr.laws.stiffened_by_coupling`): springs at a shake and a velocity larger by
this share.

Symbols: eta = du_y/(mu_0 kappa u_z0), v = v_0/(mu_0 kappa omega u_z0), q traction, p pressure.

The tables (validation/half_space/tables/across_annuli.csv, across_cells.csv) are computed by
`python -m validation --long --only vector_springs`.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np

import mdr
from mdr import laws
from mdr.closed_forms.laws.across import FADES, STIFFER
from mdr.friction.surface_fields import from_line_load
from mdr.tools.arrays import Array
from validation.cases import DEPTH, LOOKS, RADIUS, SHAPES, shape_label
from validation.figures import COLOURS, figure, panel
from validation.half_space import kept
from validation.half_space.across import Point, Row, of_springs, on_annuli, on_cells
from validation.half_space.annuli import annuli, friction, pressure
from validation.report import Check, Checks, Claim, Equation, told

CURVED = ("paraboloid", "cone", "r^4")
SIZES, SLOWER = (0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 4.0), (1.6, 0.8, 0.4, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005)
FASTER = (1.6, 0.8, 0.4, 0.2, 0.1, 0.05, 0.025)
ANNULI, CELLS, STEPS = 40, 31, 60
MU_0, NU = 0.3, 0.3
MIXED = ((0.5, 0.1), (0.9, 0.02), (1.5, 0.4))  #: eta and v at which springs have many directions
ALPHA = 0.3  #: du_z/u_z0 of contacts that are pushed to the side
ALLOWED = 0.03  #: of mu_0, what the law may be off by without coupling
ALLOWED_SLOW = 0.02  #: the same where a part of the contact never slips
ALLOWED_COUPLED = 0.015  #: and what is said of coupling


def columns(name: str) -> list[list[Point]]:
    """The contacts of a table: "across_annuli", or "across_cells" with nu and coupling."""
    if name == "across_annuli":
        known = [(shape, 0.0, MU_0, False, eta, 0.0, 0.0) for shape in CURVED for eta in SIZES]
        known += [("flat punch", 0.0, MU_0, False, eta, 0.0, 0.0) for eta in (0.5, 1.5)]
        return [[Point(*one, v) for v in SLOWER] for one in known]
    paraboloid = [(0.3, 0.3, True, eta) for eta in (0.25, 0.5, 1.0, 2.0)]
    paraboloid += [(nu, 0.3, False, eta) for nu in (0.3, 0.5) for eta in (0.5, 1.0)]
    paraboloid += [(nu, mu_0, True, eta) for nu, mu_0 in ((0.3, 0.1), (0.0, 0.3), (0.3, 0.6)) for eta in (0.5, 1.0)]
    constant = [("paraboloid", *one) for one in paraboloid]
    constant += [(shape, NU, MU_0, True, eta) for shape in ("flat punch", "cone", "r^4") for eta in (0.5, 1.0)]
    found = [[Point(*one, 0.0, 0.0, v) for v in FASTER] for one in constant]
    shaken = product((True, False), (0.0, np.pi / 2))
    found += [[Point("paraboloid", NU, MU_0, c, 0.5, ALPHA, phi, v) for v in FASTER[1:5]] for c, phi in shaken]
    return found


def law(point: Point) -> float:
    """What springs are too high by without coupling, over mu_0."""
    case = replace(point, nu=0.5).case
    return laws.excess_across(case, replace(point, nu=0.5).v_0)


def by_coupling(row: Row) -> float:
    """What the law of the stiffer contact adds to it: springs less springs at a larger shake and velocity."""
    point = row.point
    more = 1 + laws.stiffened_by_coupling(point.case.material)
    stiffer = replace(point, eta=point.eta * more, v=point.v * more)
    return float(row.springs - of_springs(stiffer.case, [stiffer.v_0])[0, 0] / point.mu_0)


def claim(effort: str) -> Claim:
    """Springs whose friction is a vector are not quite the half-space: slow, they hold too much

    How: Read the tables, compute some of them again, and try the laws on them.

    Quote: According to the Method of Dimensionality Reduction (MDR), any rotationally symmetric contact can be
    equivalently represented by a model consisting of a series of independent springs. (Section 2.2.2)

    Range: {n_exact} contacts of ν = 0 without coupling: paraboloid, cone, r^4, flat punch; η = Δu_y/(μ_0 κ u_z0) from
    {SIZES[0]:g} to {greatest_eta:g}, v = v_0/(μ_0 κ ω u_z0) from {slowest:g} to {SLOWER[0]:g}; errors up to
    {worst_exact:.0e}, {usual_exact:.0e} in the median. {n_cells} more on cells, ν from 0 to 0.5, with coupling and
    without, errors up to {worst_cells:.0e}. Elastic, at a constant depth but for the force to the side
    (validation/half_space/tables/across_annuli.csv, across_cells.csv).

    Measured: A flat punch is one spring, and has its friction exactly. Under curved faces springs are right for fast
    slides; in between they are off by up to {between:.2f} of μ_0, and slow they hold too much: {worst.off:.2f} of μ_0
    too much at v = {worst.point.v:g} under a {worst.point.shape}. At rest, shaken by half of what its deepest spring
    can follow, a paraboloid holds {held_by_springs:.3f} of μ_0 F_N by springs, {held_by_points:.3f} by Coulomb's law in
    every point, and {by_eq_8:.3f} by Eq. (8) of the author's later paper (Front. Mech. Eng. 6:69), which is said to be
    independent of the contact's geometry: it holds for a flat face alone. The reason is on the surface: where springs
    of different directions follow one another, the traction that belongs to them comes to {beyond:.2f} μ_0 p. The law
    of the difference, fitted to the paraboloid, leaves {far:.3f} of μ_0 at most on all three ({rms:.3f} in the mean
    square). ν does not matter without coupling. With it the contact is stiffer along its surface by about 0.36 β^2/κ
    (less under a flat punch), which tells what coupling takes, up to {most_taken:.3f} of μ_0, to {off_taken:.3f}.
    Pushed to the side by a normal oscillation ({ALPHA:g} of the depth), springs have the force across to {off_side:.3f}
    of μ_0 from v = 0.1 on.

    Verdict: holds if the contact is flat, or the slide not slow

    Sentence: Shaken across, springs are exact under a flat punch and good for fast slides; at rest a paraboloid holds
    up to 0.13 of μ_0 less, as Coulomb's law does not hold in every point of the surface.
    """
    if effort == "long":
        on = {"across_annuli": (on_annuli, ANNULI, STEPS), "across_cells": (on_cells, CELLS, STEPS)}
        for name, (judge, size, steps) in on.items():
            made = f"{size} along a {'radius' if judge is on_annuli else 'side'}, {steps} steps a period"
            kept.write(name, [row for points in columns(name) for row in judge(points, size, steps)], made)
    exact, cells = kept.read("across_annuli", Row), kept.read("across_cells", Row)
    off = {shape: [row for row in exact if row.point.shape == shape] for shape in SHAPES}
    worst = max((row for shape in CURVED for row in off[shape]), key=lambda row: row.off)
    left = {shape: np.array([row.off - law(row.point) for row in off[shape]]) for shape in CURVED}
    far = max(float(np.abs(one).max()) for one in left.values())
    rms = max(float(np.sqrt(np.mean(one**2))) for one in left.values())
    quick = effort == "quick"
    beyond = max(_surface_excess("paraboloid", *one, quick) for one in MIXED)
    coupled = _coupled(cells, exact, quick)
    of_annuli = (*_rest_checks(quick), *_table_checks(off, left), *_again_checks(exact, effort))
    of_cells = (*_cell_checks(cells, exact, coupled), *_side_checks(cells))
    n_exact, greatest_eta, slowest = len(exact), SIZES[-1], SLOWER[-1]
    worst_exact = max(row.error for row in exact)
    usual_exact = np.median([row.error for row in exact])
    n_cells = len(cells)
    worst_cells = max(row.error for row in cells)
    between = max(abs(row.off) for row in exact if row.point.v >= 0.05)
    held_by_springs = _held("paraboloid", 0.5, False)
    held_by_points = _held("paraboloid", 0.5, True)
    by_eq_8, most_taken = _eq_8("paraboloid"), max(found for _, found, _ in coupled)
    off_taken = max(abs(found - said) for _, found, said in coupled)
    off_side = max(abs(row.springs_y - row.cof_y) for row in cells if row.point.alpha)
    return Claim(
        **told(claim, locals()),
        checks=(*of_annuli, *of_cells, *_surface_checks(beyond)),
        figures=(_figure(off), _law_figure(off, coupled), _surface_figure()),
        equations=(
            Equation(
                "at rest",
                r"\frac{\mu}{\mu_0} = \frac{\int_{r < c} \sqrt{p^2 - (p - p_c)^2} r dr}{\int p r dr}, \quad p_c ="
                r" p(u_{z0} - \Delta u_y/\mu_0\kappa)",
                "Coulomb's law in every point; c the contact radius of p_c.",
            ),
            Equation(
                "slow",
                r"\frac{\mu_{\text{springs}} - \mu_{\text{3D}}}{\mu_0} = \Delta_0 e^{-(v/0.012\sqrt{\eta})^{2/3}}",
                "Δ_0 the difference at rest.",
            ),
        ),
    )


def _held(shape: str, eta: float, surface: bool) -> float:
    return laws.held_across(SHAPES[shape], DEPTH, eta * DEPTH, surface=surface)


def _eq_8(shape: str, eta: float = 0.5) -> float:
    """sqrt(1 - (F_y/(mu_0 F_z))²), with the amplitude of the force across that the shake makes in a contact stuck."""
    lost = 1 - float(SHAPES[shape].force((1 - eta) * DEPTH, 1.0) / SHAPES[shape].force(DEPTH, 1.0))
    return float(np.sqrt(1 - lost**2))


# --- checks ---


def _rest_checks(quick: bool) -> Checks:
    """The closed form at rest is a state that lasts, and where others end."""
    n = 24 if quick else 48
    for shape, eta in [("cone", 0.6)] if quick else product(("paraboloid", "cone"), (0.3, 0.6)):
        rings, case = annuli(n), SHAPES[shape]
        p = pressure(case, RADIUS, DEPTH, n)
        stuck = float(case.contact_radius((1 - eta) * DEPTH)) / RADIUS
        inside = np.minimum(case.pressure(RADIUS * rings.r, (1 - eta) * DEPTH, 1.0) * RADIUS / DEPTH, p)
        along = np.where(rings.r < stuck, np.sqrt(inside * (2 * p - inside)), 0.0)
        start = (np.sqrt(rings.area) * np.stack([along, 0 * p]))[:, :, None]
        phase = 2 * np.pi * np.arange(n + 1) / n
        way = np.stack([0 * phase, eta * np.sin(phase)])
        known, where = _held(shape, eta, True), f"{shape}, η = {eta:g}"
        for what, cycles, begin in (("its own state", 12, start), ("full slip", 48, None)):
            name = f"load over μ_0 F_N after {cycles} periods at rest from {what}, less the closed form: {where}"
            found = friction(p, way, cycles, 0.0, begin).cof.real
            yield Check(name, found - known, 0.0, 0.25 / n, "an annulus more or less that sticks")


def _table_checks(off: dict[str, list[Row]], left: dict[str, Array]) -> Checks:
    flat = max((row.off for row in off["flat punch"]), key=abs)
    why = "one spring; what is left are steps of 1/60 of a period, a quarter with half of them"
    yield Check("flat punch: greatest difference over μ_0", flat, 0.0, 0.003, why)
    for shape in CURVED:
        fast = max(abs(row.off) - row.error for row in off[shape] if row.point.v >= 1.6 and row.point.eta <= 1)
        name = f"{shape}, v = 1.6, η ≤ 1: difference beyond its errors"
        yield Check.at_most(name, fast, 5e-4, "of fourth order in 1/v")
        slow = max(row.off for row in off[shape])
        yield Check.at_least(f"{shape}: greatest difference over μ_0", slow, 0.05, "half of that at rest and less")
        worst = float(left[shape][np.abs(left[shape]).argmax()])
        name = f"{shape}: springs less three dimensions over μ_0, less the law, worst of {left[shape].size}"
        yield Check(name, worst, 0.0, ALLOWED, "fitted to the paraboloid at η < 1")
        slow = max((row.off - law(row.point) for row in off[shape] if row.point.eta < 1), key=abs)
        yield Check(f"the same at η < 1: {shape}", slow, 0.0, ALLOWED_SLOW, "where it says more than nothing")
    own = [(row.off, row.point, _at_rest(row.point)) for row in off["paraboloid"] if row.point.eta < 1]
    paces = np.geomspace(0.006, 0.024, 61)
    best = min(paces, key=lambda pace: sum((found - _with(pace, *of)) ** 2 for found, *of in own))
    yield Check("constant of the law by least squares", float(best), FADES, 0.05 * FADES, "as the library has it")
    for eta in (0.3, 0.5, 0.7):
        gap, name = _eq_8("flat punch", eta) - _held("flat punch", eta, True), "Eq. (8) of the later paper less"
        yield Check(f"{name} the closed form: flat punch, η = {eta:g}", gap, 0.0, 1e-9, "one spring")
        for shape in CURVED:
            gap = _eq_8(shape, eta) - _held(shape, eta, False)
            where = f"{shape}, η = {eta:g}"
            yield Check.at_least(f"{name} what springs hold: {where}", gap, 0.015, "springs at the edge hold nothing")


def _at_rest(point: Point) -> float:
    """What springs are too high by at rest, over mu_0."""
    return _held(point.shape, point.eta, False) - _held(point.shape, point.eta, True)


def _with(pace: float, point: Point, at_rest: float) -> float:
    """The law with another constant."""
    return float(at_rest * np.exp(-((point.v / (pace * np.sqrt(point.eta))) ** (2 / 3))))


def _again_checks(exact: Sequence[Row], effort: str) -> Checks:
    """The same computed now; coarser, it must come as close as it says of itself."""
    quick, known = effort == "quick", {row.point: row for row in exact}
    points = [Point("paraboloid", 0.0, MU_0, False, 1.0, 0.0, 0.0, v) for v in ((0.4,) if quick else (1.6, 0.4, 0.1))]
    again = on_annuli(points, 16 if quick else 24, 24)
    shares = [abs(row.off - known[row.point].off) / (row.error + known[row.point].error) for row in again]
    name = f"{len(again)} of the annuli again: greatest change over the errors"
    yield Check.at_most(name, max(shares), 1, "its errors")


def _cell_checks(cells: Sequence[Row], exact: Sequence[Row], coupled: Sequence[tuple[Row, float, float]]) -> Checks:
    known = {row.point.place: row for row in exact}
    for nu in (0.3, 0.5):
        own = [row for row in cells if row.point.plain and row.point.nu == nu and row.point.place in known]
        shares = [abs(row.off - known[row.point.place].off) / (row.error + known[row.point.place].error) for row in own]
        name = f"cells of ν = {nu:g} without coupling beside annuli of ν = 0, over their errors, worst of {len(shares)}"
        yield Check.at_most(name, max(shares), 1.0, "ν moves the surface across by its square")
    own = [(found, said) for row, found, said in coupled if _is_fitted(row.point)]
    best = sum(found * said for found, said in own) / sum(said**2 for _, said in own) * STIFFER
    name = "share of β^2/κ by which coupling stiffens, by least squares"
    yield Check(name, best, STIFFER, 0.03, "as the library has it")
    for what, some in KINDS.items():
        found, said = np.array([one[1:] for one in coupled if some(one[0].point)]).reshape(-1, 2).T
        if found.size:
            name = f"what coupling takes over μ_0, less the law: {what}, worst of {found.size}"
            yield Check(name, max(found - said, key=abs), 0.0, ALLOWED_COUPLED, "errors of cells, and the fit")
            left = np.sqrt(np.mean((found - said) ** 2) / np.mean(found**2))
            name = f"what the law leaves of it, in the mean square: {what}"
            yield Check.at_most(name, left, 0.85 if what == "flat punch" else 0.5, "nothing at all would leave 1")
            yield Check.at_least(f"the greatest of it: {what}", max(found), 0.002, "seen above its errors")


def _side_checks(cells: Sequence[Row]) -> Checks:
    """Pushed to the side by a normal oscillation."""
    for coupled in (False, True):
        own = [row for row in cells if row.point.alpha and row.point.coupled == coupled]
        what = f"Δu_z/u_z0 = {ALPHA:g}, {'with' if coupled else 'without'} coupling, of {len(own)}"
        off, most = max((row.springs_y - row.cof_y for row in own), key=abs), max(row.cof_y for row in own)
        name = f"force across over μ_0 F_N, springs less cells, worst: {what}"
        yield Check(name, off, 0.0, 0.04, "as along the pull")
        yield Check.at_least(f"greatest force across: {what}", most, 0.3, "springs are not what pushes")


def _is_fitted(point: Point) -> bool:
    return (point.shape, point.nu, point.mu_0) == ("paraboloid", NU, MU_0)


#: contacts with coupling
KINDS = {
    "ν = 0.3, μ_0 = 0.3, fitted": _is_fitted,
    "μ_0 = 0.1 and 0.6": lambda p: p.shape == "paraboloid" and p.mu_0 != MU_0,
    "ν = 0": lambda p: p.nu == 0,
    "flat punch": lambda p: p.shape == "flat punch",
    "cone and r^4": lambda p: p.shape in ("cone", "r^4"),
}


def _coupled(cells: Sequence[Row], exact: Sequence[Row], quick: bool) -> list[tuple[Row, float, float]]:
    """Rows with coupling at a constant depth, what it takes over mu_0 beyond what is off without, and what is said.

    Rows at velocities for which nothing is known without coupling are left out; a punch is one spring there.
    """
    without = {row.point.place: row.off for row in (*exact, *(row for row in cells if row.point.plain))}
    without |= {("flat punch", row.point.eta, row.point.v): 0.0 for row in cells}
    rows = [row for row in cells if row.point.coupled and not row.point.alpha and row.point.place in without]
    rows = [row for row in rows if not quick or row.point.v in (0.1, 0.8)]
    return [(row, row.off - without[row.point.place], by_coupling(row)) for row in rows]


def _surface_checks(beyond: float) -> Checks:
    name = "greatest traction of springs on the surface over μ_0 p: paraboloid"
    yield Check.at_least(name, beyond, 1.1, "Coulomb's law fails there")
    flat = _surface_excess("flat punch", 0.5, 0.1, True)
    yield Check.at_most("the same under a flat punch", flat, 1 + 1e-9, "all springs have one direction")


def _surface_excess(shape: str, eta: float, v: float, quick: bool) -> float:
    """Greatest q/(mu_0 p) over radius and instant."""
    return max(float(ratio.max()) for ratio in _surface(shape, eta, v, 100 if quick else 400)[1])


def _surface(shape: str, eta: float, v: float, n: int) -> tuple[Array, list[Array]]:
    """Distances over the contact radius, and q/(mu_0 p) at instants of a period, by springs."""
    point = Point(shape, 0.0, MU_0, False, eta, 0.0, 0.0, v)
    run = mdr.slide(point.case, point.v_0, record=1, n_springs=n, steps_per_period=64)
    r, ratios = np.linspace(0.02, 0.95, 80), []
    x, f_x, f_y, f_z = np.append(run.x, RADIUS), run.f_x, run.f_y, run.f_z
    for i in range(0, 64, 4):
        rim = 1.0 if shape == "flat punch" else 0.0  # the load ends with a jump there
        loads = [np.append(f[i] / run.width, rim * f[i, -1] / run.width[-1]) for f in (f_x, f_y, f_z)]
        q_x, q_y, p = (from_line_load(x, load, r * RADIUS) for load in loads)
        ratios.append(np.hypot(q_x, q_y) / (MU_0 * p))
    return r, ratios


# --- figures ---


@figure("across", 1, 3, size=(13.2, 4.2), sharey=True)
def _figure(fig, panels, off: dict[str, list[Row]]):
    """Three panels of friction against velocity: marks of three dimensions on lines of springs, and below them

    Shaken across at a constant depth, no coupling: springs (lines) and a half-space with Coulomb's law in every point
    (circles). They agree from v_0 = 0.05 μ_0 κ ω u_z0 on, to 0.02. At rest, at the left edge, springs hold what the
    dashes say, a half-space what the triangles say: both are closed forms.
    """
    for ax, shape in zip(panels, CURVED, strict=True):
        for eta, colour in zip((0.25, 0.5, 0.75, 1.0, 2.0), COLOURS, strict=False):
            own = sorted((row for row in off[shape] if row.point.eta == eta), key=lambda row: row.point.v)
            v = [row.point.v for row in own]
            ax.plot(v, [row.springs for row in own], color=colour, label=rf"$\eta = {eta:g}$")
            ax.plot(v, [row.cof for row in own], "o", color=colour, mfc="w", ms=5)
            if eta < 1:
                ax.plot(0.0033, _held(shape, eta, True), "<", color=colour, ms=6)
                ax.plot(0.0033, _held(shape, eta, False), "_", color=colour, ms=9, mew=2)
        ax.set(xscale="log", xlabel=r"$v_0/(\mu_0\kappa\omega u_{z0})$", title=shape_label(shape))
    panels[0].set_ylabel(r"$\mu/\mu_0$")
    panels[0].legend(loc="lower right")


@figure("across_law", 1, 3, size=(13.2, 4.2))
def _law_figure(fig, panels, off: dict[str, list[Row]], coupled: Sequence[tuple[Row, float, float]]):
    """Three panels: what is held at rest; difference over the law; what coupling takes over its law

    Left: what a contact shaken across holds at rest, colours as in the middle; flat punch: the three agree, for curved
    faces a half-space holds least. Middle: how much springs are too high by, over the law that was fitted to the
    paraboloid. Right: what coupling takes beyond that, over that of a stiffer contact; crosses are what it was fitted
    to, red is ν = 0.
    """
    rest, slow, side = panels
    sizes = np.linspace(0, 1, 41)
    for shape, (colour, marker) in LOOKS.items():
        for line, surface in (("--", False), ("-", True)):
            rest.plot(sizes, [_held(shape, eta, surface) if eta < 1 else 0 for eta in sizes], line, color=colour)
        rest.plot(sizes, [_eq_8(shape, eta) for eta in sizes], ":", color=colour, lw=1)
        own = [row for row in off[shape] if row.point.eta < 1]
        found = [row.off for row in own]
        slow.plot([law(row.point) for row in own], found, marker, color=colour, mfc="w", label=shape_label(shape))
    for line, label in (("--", "springs"), ("-", "half-space"), (":", "Eq. (8), later paper")):
        rest.plot([], [], line, color="0.3", label=label)
    panel(rest, r"$\eta = \Delta u_y/(\mu_0\kappa u_{z0})$", r"held at rest over $\mu_0F_N$", legend="best")
    slow.plot([0, 0.08], [0, 0.08], color="0.75", lw=0.8)
    panel(slow, "the law", r"(springs $-$ half-space)/$\mu_0$", "no coupling", legend="best")
    for row, found, said in coupled:
        mark, colour = ("+", "k") if _is_fitted(row.point) else ("o", {0.0: "C3", 0.3: COLOURS[0]}[row.point.nu])
        side.plot(said, found, mark, color=colour, mfc="w")
    top = max(max(found, said) for _, found, said in coupled)
    side.plot([0, top], [0, top], color="0.75", lw=0.8)
    x, y = r"a contact stiffer by $0.36\,\beta^2/\kappa$", r"what coupling takes, over $\mu_0$"
    panel(side, x, y, "crosses: fitted")


@figure("across_surface", size=(6.4, 4.0))
def _surface_figure(fig, ax):
    """Curves of the traction over the limit against the distance from the axis, above and below one

    Traction on the surface that belongs to springs, over its limit, at four instants: paraboloid, η = 0.5, v = 0.1.
    Above the dashed line Coulomb's law is broken, though every spring obeys it.
    """
    r, ratios = _surface("paraboloid", 0.5, 0.1, 200)
    for i, colour in zip((0, 2, 4, 6), COLOURS, strict=False):
        ax.plot(r, ratios[i], color=colour, label=f"{i}/16 of a period")
    ax.axhline(1.0, color="0.5", lw=1, ls="--")
    panel(ax, "distance from the axis over the contact radius", r"$|q|/(\mu_0\,p)$", legend="best")
