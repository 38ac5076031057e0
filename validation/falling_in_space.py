"""A static coefficient on one continuous contact: a half-space beside springs that know nothing of each other.

Springs are let go one by one, each at mu_s times its force. On a half-space a point that is let go hands its load to
its neighbours. A zone of slip is then a crack in shear: it takes energy to grow, mu_s - mu_k times half of the pressure
and of the slip distance d_c, on each area (validation/half_space/weakening.py). Without a slip distance it takes none,
and what lets a cell bear more than mu_k p is its size alone.

Symbols: alpha = du_z/u_z0, stick = mu_s/mu_k, v over v_c by Eq. (1) with mu_k, d_c over mu_k kappa u_z0.
"""

from functools import cache

import numpy as np

import mdr
from mdr.half_space.friction import Settings, in_three_dimensions
from mdr.tools.arrays import Array
from mdr.tools.progress import progress
from validation.cases import contact
from validation.figures import COLOURS, figure, panel
from validation.half_space.weakening import Points, Stick, breakaway, friction, half_space, springs, square_cells
from validation.report import Check, Checks, Claim, told
from validation.two_coefficients import falling
from validation.words import percent, ranged, span

ALPHA, STICK, V = 0.3, 1.5, 0.5
DISTANCES = (0.0, 0.02, 0.05, 0.2)  #: d_c
FALLS = (0.05, 0.1, 0.2, 0.4, 0.8, 1.2)  #: the same, over stick - 1
N = 80  #: annuli of the radius, and springs, where their number is not what is asked for
FIRST_ORDER = 1e-3  #: what 200 steps of a period leave


def claim(effort: str) -> Claim:
    """With a static coefficient independent springs stand for one continuous contact

    How: March annuli of a half-space and springs side by side, by the same steps.

    Quote: According to the Method of Dimensionality Reduction (MDR), any rotationally symmetric contact can be
    equivalently represented by a model consisting of a series of independent springs. (Section 2.2.2)

    Range: Elastic half-space of ν = 0 without coupling, solved on {coarsest} to {finest} annuli over the radius of
    contact; rigid pull at {slow} v_c, Δu_z/u_z0 = {ALPHA:g}, and a slow pull without vibration; μ_s/μ_k {sticks}.
    Friction falls at once, or on a line over a slip distance d_c; a point that sticks bears μ_s p again at once.
    Inertia is left out, also where friction falls by a jump. Annuli slip alike all around; square cells need not, and
    are few.

    Measured: With one coefficient annuli have the friction of cells and of springs, to {one:.0e}. With two they part. A
    zone of slip runs in from the edge of a curved face like a crack. If friction falls at once this takes no energy,
    and the next point is let go however little is missing. So the answer has a limit as cells become finer, and it is
    that of μ_k alone: under a paraboloid, at {V:g} v_c and μ_s/μ_k = {STICK:g}, μ_s adds {added} to friction on
    springs, and on annuli {excess[0]}, then {excess[1]} and {excess[2]} with twice and four times as many. The peak of
    a slow pull from rest is {peak_springs} above sliding on springs, and on annuli {peaks[0]}, {peaks[1]} and
    {peaks[2]}. A slip distance gives friction a limit of its own, as soon as annuli are finer than the end of the zone:
    of what μ_s adds on springs, {weak} is there for d_c = {DISTANCES[2]:g} μ_k κu_z0. The half is there for d_c =
    {half:.2g} (μ_s − μ_k)κu_z0, about alike for each μ_s/μ_k and velocity; and all, to {off:.0f} %, from {FALLS[4]:g}
    of it on, where friction falls so slowly that a spring is hardly let go by a jump. Over a very long slip distance
    friction is that of μ_s alone. A flat punch is let go as a whole, and is one spring, but only as long as no point is
    weaker: if its outermost annulus has no static coefficient, {left} is left of what μ_s adds, however narrow it is.
    What was not asked: ν > 0, coupling, inertia, and μ_s that takes time to come back.

    Verdict: fails when the face is curved and friction falls at once or over a short slip

    Sentence: On one continuous curved face where friction falls at once, μ_s does nothing. Springs that know it stand
    for separate contacts, or for friction that falls over a slip of about (μ_s − μ_k)κu_z0.
    """
    quick = effort == "quick"
    sizes = (20, 40, 80) if quick else (20, 40, 80, 160)
    velocities, chosen = ((V,), (STICK,)) if quick else ((V, 0.9), (1.2, STICK, 2.0))
    added_by = {d_c: np.array([added_in("paraboloid", n, STICK, d_c, V) for n in sizes]) for d_c in DISTANCES}
    by_springs = added_on("paraboloid", STICK, 0.0, V)
    shares = {
        (v, stick): np.array([share_of(stick, x * (stick - 1), v) for x in FALLS])
        for v in progress(velocities, "falling_in_space")
        for stick in chosen
    }
    broken = np.array([breakaway(half_space("paraboloid", 0.0, n), STICK) - 1 for n in sizes])
    broken_springs = breakaway(springs("paraboloid", 0.0, 4 * N), STICK) - 1
    known, ring = _known(), np.array([_weak_ring(n) for n in sizes])
    coarsest, finest, slow, sticks = sizes[0], sizes[-1], span(velocities), ranged(chosen)
    added, excess = percent(by_springs), [percent(float(x)) for x in added_by[0.0]]
    peak_springs, peaks = percent(broken_springs), [percent(float(x)) for x in broken]
    weak, left = percent(float(added_by[DISTANCES[2]][-1]) / by_springs), percent(float(ring[-1]))
    half = float(np.mean([np.interp(0.5, one, FALLS) for one in shares.values()]))
    off = 100 * max(float(np.abs(one[4:] - 1).max()) for one in shares.values())
    one = max(map(abs, known.values()))
    return Claim(
        **told(claim, locals()),
        checks=(
            *_known_checks(),
            *_size_checks(sizes, added_by, by_springs),
            *_distance_checks(shares),
            *_peak_checks(sizes, broken),
            *_cell_checks(),
            *_punch_checks(sizes, ring),
        ),
        figures=(_figure(sizes, added_by, by_springs, shares),),
    )


def _added(points: Points, stick: Stick, d_c: float, v: float, steps: int = 200) -> float:
    """What the static coefficient adds to friction, over that of sliding."""
    return friction(points, ALPHA, v, stick, d_c, steps).share - friction(points, ALPHA, v, 1.0, steps=steps).share


@cache
def added_in(shape: str, n: int, stick: float, d_c: float, v: float) -> float:
    """That on n annuli of a half-space."""
    return _added(half_space(shape, ALPHA, n), stick, d_c, v)


@cache
def added_on(shape: str, stick: float, d_c: float, v: float) -> float:
    """That on springs."""
    return _added(springs(shape, ALPHA, N), stick, d_c, v)


def share_of(stick: float, d_c: float, v: float) -> float:
    """The one over the other."""
    return added_in("paraboloid", N, stick, d_c, v) / added_on("paraboloid", stick, d_c, v)


@cache
def _known() -> dict[str, float]:
    """Annuli with one coefficient less what is known of them, and springs with two less those of the library."""
    found, v_c = {}, mdr.critical_velocity(contact("paraboloid", ALPHA, nu=0.0))
    for shape in ("cone", "paraboloid", "flat punch"):
        case = contact(shape, ALPHA, nu=0.0)
        here = friction(half_space(shape, ALPHA, N // 2), ALPHA, V, 1.0).share
        found[f"annuli with μ_s = μ_k less springs of the library, {shape}"] = here - mdr.slide(case, V * v_c).share
    case, settings = contact("paraboloid", ALPHA, nu=0.0), Settings(31, 50, cycles=2, coupled=False)
    here = friction(half_space("paraboloid", ALPHA, N // 2), ALPHA, V, 1.0, steps=50).share
    cells = in_three_dimensions(case, V * v_c, settings).cof / case.mu_0
    found["the same less cells of the half-space, paraboloid"] = here - cells
    here, case = friction(springs("paraboloid", ALPHA, N), ALPHA, V, STICK).share, falling("paraboloid", ALPHA, STICK)
    known = mdr.slide(case, V * mdr.critical_velocity(case)).share
    found["springs let go at once less those of the library, paraboloid"] = here - known
    return found


def _weak_ring(n: int) -> float:
    """What is left of what mu_s adds under a flat punch whose outermost annulus has mu_k alone."""
    weak = np.where(np.arange(n) < n - 1, STICK, 1.0)
    return _added(half_space("flat punch", ALPHA, n), weak, 0.0, V) / added_in("flat punch", n, STICK, 0.0, V)


# --- checks ---


def _known_checks() -> Checks:
    for name, off in _known().items():
        yield Check(f"friction over sliding, {name}", off, 0.0, FIRST_ORDER, "first order in 200 steps; 40 annuli")
    points = half_space("paraboloid", ALPHA, N // 2)
    worst = max(friction(points, ALPHA, V, STICK, d_c).unbalanced for d_c in DISTANCES)
    yield Check.at_most("work of the pull less what slip takes, over the work, at worst", worst, 1e-9, "rounding")
    long = friction(points, ALPHA, V, STICK, 1e3).share
    known = STICK * friction(points, ALPHA, V / STICK, 1.0).share
    why = "the same law with μ_s in the place of μ_k; first order in the step"
    yield Check("friction over sliding, d_c = 1000, less that of μ_s alone", long - known, 0.0, FIRST_ORDER, why)


def _size_checks(sizes: tuple[int, ...], added: dict[float, Array], by_springs: float) -> Checks:
    for n, before, here in zip(sizes[1:], added[0.0], added[0.0][1:], strict=False):
        name = f"what μ_s adds on {n} annuli over that on half as many, d_c = 0"
        why = "what a cell bears at a tip is that of a d_c like its width: at most like the root of it, 0.71"
        yield Check.at_most(name, here / before, 0.75, why)
    name = f"what μ_s adds on {sizes[-1]} annuli over that on springs, d_c = 0"
    yield Check.at_most(name, added[0.0][-1] / by_springs, 0.06, "the limit is zero")
    for d_c in DISTANCES[2:]:
        change = added[d_c][-1] / added[d_c][-2] - 1
        name = f"what μ_s adds on {sizes[-1]} annuli over that on half as many, d_c = {d_c:g}, less 1"
        why = "twice the width of an annulus over the end of the zone, some d_c/(μ_s/μ_k − 1) of the radius"
        yield Check(name, change, 0.0, 2 * (STICK - 1) / (sizes[-1] * d_c), why)
    name = f"what μ_s adds on {sizes[-1]} annuli for d_c = {DISTANCES[2]:g} over that for d_c = 0"
    yield Check.at_least(
        name, added[DISTANCES[2]][-1] / added[0.0][-1], 4.0, "the slip distance, not the size of cells"
    )


def _distance_checks(shares: dict[tuple[float, float], Array]) -> Checks:
    for (v, stick), found in shares.items():
        where = f"μ_s/μ_k = {stick:g}, {v:g} v_c"
        name = "what μ_s adds on annuli over that on springs, d_c over (μ_s − μ_k)κu_z0"
        bounds = {0.05: (0.05, 0.3), 0.2: (0.35, 0.65), 0.8: (0.85, 1.15)}
        for x, (low, high) in bounds.items():
            why = "one curve for all coefficients and velocities"
            yield Check.between(f"{name} = {x:g}, {where}", found[FALLS.index(x)], low, high, why)


def _peak_checks(sizes: tuple[int, ...], broken: Array) -> Checks:
    for n, before, here in zip(sizes[1:], broken, broken[1:], strict=False):
        name = f"peak of a slow pull less sliding on {n} annuli over that on half as many, paraboloid, d_c = 0"
        yield Check.at_most(name, here / before, 0.75, "as above")
    yield Check.at_most(f"peak of a slow pull less sliding, over it, {sizes[-1]} annuli", broken[-1], 0.01, "likewise")
    for make in (half_space, springs):
        peak, way = breakaway(make("flat punch", 0.0, N // 2), STICK), 2 * STICK / 400
        name = f"peak of a slow pull over sliding, flat punch, {'annuli' if make is half_space else 'springs'}"
        yield Check.between(name, peak, STICK - way, STICK, "let go as a whole; the way of a step")


def _cell_checks() -> Checks:
    n = 15
    cells, rest = square_cells("paraboloid", 0.0, n), half_space("paraboloid", 0.0, N)
    d_c, why = DISTANCES[-1], "annuli as wide as a cell are off by a twentieth; springs by a fourth and more"
    peak = (breakaway(cells, STICK, d_c, steps=200) - 1) / (breakaway(rest, STICK, d_c, steps=200) - 1)
    name = f"{n} x {n} square cells over annuli, d_c = {d_c:g}"
    yield Check(f"peak of a slow pull less sliding, {name}", peak, 1.0, 0.1, why)
    share = _added(square_cells("paraboloid", ALPHA, n), STICK, d_c, V, steps=100)
    share /= _added(half_space("paraboloid", ALPHA, N), STICK, d_c, V, steps=100)
    yield Check(f"what μ_s adds, {name}", share, 1.0, 0.1, why)


def _punch_checks(sizes: tuple[int, ...], ring: Array) -> Checks:
    off = added_in("flat punch", N, STICK, 0.0, V) / added_on("flat punch", STICK, 0.0, V) - 1
    yield Check("what μ_s adds under a flat punch, annuli over springs, less 1", off, 0.0, 1e-6, "it is one spring")
    for n, left in zip(sizes, ring, strict=True):
        name = f"what is left of it, the outermost of {n} annuli without μ_s"
        yield Check.between(name, left, 0.15, 0.35, "pressure at the edge is infinite like 1/√h, and the load with it")


# --- figure ---


@figure("cells", 1, 2, size=(9.6, 3.9))
def _figure(
    fig,
    panels,
    sizes: tuple[int, ...],
    added: dict[float, Array],
    by_springs: float,
    shares: dict[tuple[float, float], Array],
):
    """Left, what the static coefficient adds over the number of annuli: to zero without a slip distance. Right, its
    share of that on springs over the slip distance: from zero to one.

    What μ_s adds to friction of a paraboloid. Left, at {V:g} v_c and μ_s/μ_k = {STICK:g}, on annuli of a half-space for
    four slip distances d_c, over μ_k κu_z0, and on springs (dashed): where friction falls at once (d_c = 0) it tends to
    nothing. Right, over that on springs: springs stand for the half-space where friction falls over a slip of about
    (μ_s − μ_k)κu_z0.
    """
    left, right = panels
    for (d_c, one), colour in zip(added.items(), COLOURS, strict=False):
        left.plot(sizes, 100 * one, "o-", color=colour, ms=4.5, label=f"$d_c$ = {d_c:g}")
    left.axhline(100 * by_springs, ls="--", color="0.4", label="springs, $d_c$ = 0")
    panel(left, "annuli over the radius", r"what $\mu_s$ adds, % of sliding", log="xy", legend="lower left")
    left.set(xticks=sizes, xticklabels=sizes)
    left.minorticks_off()
    for ((v, stick), one), colour in zip(shares.items(), COLOURS * 2, strict=False):
        right.plot(FALLS, one, "o-" if v == V else "s--", color=colour, ms=4, label=rf"{stick:g}, {v:g} $v_c$")
    right.axhline(1.0, color="0.8", lw=0.8)
    panel(
        right,
        r"$d_c/(\mu_s - \mu_k)\kappa u_{z0}$",
        r"what $\mu_s$ adds, over that on springs",
        log="x",
        ylim=(0, 1.25),
    )
    right.legend(title=r"$\mu_s/\mu_k$, $v_0$", loc="lower right")
    return {"V": V, "STICK": STICK}
