"""With coupling: where stick ends, and what is left of the loss above.

A rate d' of the depth adds the pressure of a flat punch, E*/pi d'/sqrt(a² - r²), to any elastic contact, and the
pressure within a circle pulls the surface to its middle (Gauss's law in Boussinesq's 1/r). So pressure alone moves the
surface radially, for beta > 0 inward as the depth grows, at

    2 beta/pi d' R(r/a),    R(x) = (1 - sqrt(1 - x²))/x,    0 in the middle and 1 at the edge.

In full slip friction along the pull moves it along at mu_0 kappa d' as ever: the punch's pressure, turned along x,
shifts the whole disc evenly, and not across, for any nu. Together: at r, theta from the pull, the surface moves along
the pull at d' [mu_0 kappa - 2 beta/pi R cos theta], most at the trailing edge while the depth grows, so that the
indenter, at v_0, comes to rest on it last at

    v_s ~ (mu_0 kappa + 2 |beta|/pi) du_z omega = v_c (1 + lambda),    lambda = 2 |beta|/(pi mu_0 kappa).          (*)

That is an estimate, of lowest order in mu_0 and lambda. Two things are left out of it: friction, which is of order
beta mu_0 in the pressure, raises v_s with mu_0; and slip across the pull, where friction keeps its direction. Both are
in the linear problem of validation/half_space/last_stick.py, whose two limits hold the runs between them on the same
cells. At the edge itself R is reached with an infinite slope: finer cells stick somewhat longer.

Far above, friction is turned out of the line of the pull by the radial slip, and is short of mu_0 F_z by

    1 - mu/mu_0 -> lambda² M/8 (v_c/v_0)²,    M = mean of R² over the pressure,                                   (**)

as v_0 grows: M is 2 ln 2 - 1 of a flat punch, 6 ln 2 - 4 of a paraboloid. To turn takes friction a way of the order of
mu_0 kappa u_z0, so that (**) asks for v_0 well above v_c/alpha and v_c. Before, less is lost at small alpha, more at
large (0.2 to 1.6 times (**) in the tables).

Symbols: kappa = E*/G*, beta Dundurs' constant, alpha = du_z/u_z0, v_c Eq. (1). Elastic, rigid pull.
"""

from itertools import product
from math import log

import numpy as np

import mdr
from mdr.closed_forms.coupling import radial_rub
from mdr.half_space.friction import LastPeriod, Settings, contact_of, in_three_dimensions, path, stuck
from validation.cases import LOOKS, contact, shape_label
from validation.figures import figure
from validation.half_space import pictures, tables
from validation.half_space.last_stick import fastest
from validation.half_space.tables import Point
from validation.report import Check, Checks, Claim, Equation, told
from validation.words import counted, percent, ranged, span

Known = tuple[str, float, float, float]  #: shape, nu, mu_0, alpha

MEANS = {"paraboloid": 6 * log(2) - 4, "flat punch": 2 * log(2) - 1}  # M
ENDS: tuple[Known, ...] = (
    ("flat punch", 0.3, 0.3, 0.3),
    ("paraboloid", 0.3, 0.6, 0.3),
    ("flat punch", 0.3, 0.1, 0.3),
    ("flat punch", 0.3, 0.6, 0.3),
    ("flat punch", 0.0, 0.3, 0.3),
    ("flat punch", 0.0, 0.6, 0.3),
    ("flat punch", 0.45, 0.3, 0.3),
    ("flat punch", 0.3, 0.3, 0.05),
    ("paraboloid", 0.3, 0.3, 0.3),
    ("paraboloid", 0.0, 0.3, 0.3),
    ("paraboloid", 0.3, 0.3, 1.5),
    ("cone", 0.3, 0.3, 0.3),
)
STEPS, FOUND = 64, 0.02  # of a period; share of lambda to which an end is found
ABOVE = 1.2  # v_0/v_c of the map
FAST = 6.0  # alpha v_0/v_c at which (**) is asked for


_EQUATIONS = (
    Equation(
        "(*)",
        r"v_s \approx \left( \mu_0 \kappa + \frac{2 |\beta|}{\pi} \right) \Delta u_z \omega"
        r" = v_c (1 + \lambda), \quad \lambda = \frac{2 |\beta|}{\pi \mu_0 \kappa}",
        "End of stick, to lowest order in μ_0 and λ; the line in the figure below.",
    ),
    Equation(
        "(**)",
        r"1 - \frac{\mu}{\mu_0} \to \frac{\lambda^2 M}{8} \left( \frac{v_c}{v_0} \right)^2, \quad"
        r" M = \frac{1}{F_z} \int R^2 p \, dA, \quad R = \frac{a - \sqrt{a^2 - r^2}}{r}",
        "Loss far above it, <i>R</i> the radial velocity of the surface over that at the edge.",
    ),
)


def claim(effort: str) -> Claim:
    """On a compressible body stick ends at Eq. (1), and friction is full above it

    How: Search the end of stick, set it beside the linear problem, and go far beyond.

    Quote: Second, the coefficient of friction increases monotonically … until it reaches the microscopic value at some
    critical velocity. (Section 3)

    Range: {contacts} under a rigid pull, ν {nus}, μ_0 {frictions}, Δu_z/u_z0 {amplitudes}, on {cells}² cells and
    {STEPS} steps; stick of the tables of validation/half_space/tables; the COF up to {FAST:g} v_c/α

    Measured: Eq. (1) is not where stick ends. The last of it is a crescent at the trailing edge, at the instant when
    the depth grows fastest: there the surface, drawn to the middle, keeps up with the pull. It shrinks with velocity,
    and is gone on these cells at (v_s/v_c − 1)/λ = {shares}; found to {FOUND:g}, in steps that change it by as much. On
    twice as many cells a side v_s of the linear problem is {finer_percent} {finer_way}. To lowest order in μ_0 it is
    v_c(1 + λ), from the radial velocity of the surface at the edge; friction adds to it by what it does to the
    pressure. Above, nothing sticks, and friction is still short of μ_0, as radial slip turns it away from the pull. The
    law (**) of this loss holds for velocities well above v_c/α, with <i>M</i> = {MEANS[paraboloid]:.2f} of a paraboloid
    and {MEANS[flat punch]:.2f} of a punch. Before, it is {before_punch:.2f} of that at 2 v_c for a punch at Δu_z/u_z0 =
    0.1, where friction has not the way to turn, and {before_paraboloid:.2f} times it for a paraboloid at 0.9.

    Verdict: holds if β = 0

    Sentence: Something sticks up to about (μ_0 κ + 2|β|/π) Δu_z ω (to {off_percent:.0f} %), last at the trailing edge
    if β > 0; above, radial slip turns friction aside, and there is no velocity at which it is full.
    """
    quick = effort == "quick"
    cells = 17 if quick else 31
    ends = {known: end(*known, cells) for known in (ENDS[:1] if quick else ENDS)}
    seen = pictures.last_of_a_paraboloid(ABOVE, quick)
    by_mu = {
        mu_0: [(v - 1) / _rub(k) for k, v in ends.items() if k[2] == mu_0] for mu_0 in sorted({k[2] for k in ends})
    }
    shares = "; ".join(f"{span(one, 3)} at μ_0 = {mu_0:g}" for mu_0, one in by_mu.items())
    finer = fastest(cells, 0.3, 0.3, False), fastest(2 * cells + 1, 0.3, 0.3, False)
    contacts, nus = counted(len(ends), "elastic contact"), ranged(k[1] for k in ends)
    frictions, amplitudes = ranged(k[2] for k in ends), ranged(k[3] for k in ends)
    finer_percent = percent(abs(finer[1] / finer[0] - 1), 1)
    finer_way = "higher" if finer[1] > finer[0] else "lower"
    before_punch = _before(0.1, "flat punch")
    before_paraboloid = _before(0.9, "paraboloid")
    off_percent = 100 * max(abs(_over_estimate(k, v) - 1) for k, v in ends.items())
    return Claim(
        **told(claim, locals()),
        checks=(*_end_checks(ends, cells), *_table_checks(), *_place_checks(seen), *_tail_checks(quick)),
        figures=(_end_figure(ends, cells), _map_figure(seen)),
        equations=_EQUATIONS,
    )


def _over_estimate(known: Known, ratio: float) -> float:
    """v_s over (*)."""
    return ratio / (1 + _rub(known))


def _rub(known: Known) -> float:
    return radial_rub(_case(known))


def _case(known: Known) -> mdr.SlidingContact:
    shape, nu, mu_0, alpha = known
    return contact(shape, alpha, mu_0=mu_0, nu=nu)


# --- runs ---


def end(shape: str, nu: float, mu_0: float, alpha: float, cells: int) -> float:
    """Greatest v_0/v_c at which any cell sticks while the depth grows: from full slip on, in half a period."""
    case = _case((shape, nu, mu_0, alpha))
    low, high = 1.0, 1 + 2 * radial_rub(case)
    while high - low > FOUND * radial_rub(case):
        v = (low + high) / 2
        low, high = (v, high) if _sticks(case, v, Settings(cells, STEPS)) else (low, v)
    return (low + high) / 2


def _sticks(case: mdr.SlidingContact, v: float, settings: Settings) -> bool:
    judged, half = contact_of(case, settings), settings.steps // 2 + 1
    depth, way, dt = path(case, v * mdr.critical_velocity(case), settings)
    steps = judged.march(judged.full_slip(float(depth[0])), depth[:half], way[:, :half], dt)
    return any(stuck(judged, step).any() for step in steps)


def _before(alpha: float, shape: str) -> float:
    """Loss at 2 v_c over (**) in the tables, for nu = mu_0 = 0.3."""
    rows = tables.read("coupling_held_out")
    point = Point(shape, 0.3, 0.3, alpha, 0.0, 2.0)
    row = next(row for row in rows if row.point == point)
    return row.loss / (radial_rub(point.case) ** 2 * MEANS[shape] / 8 / point.v**2)


# --- checks ---


def _end_checks(ends: dict[Known, float], cells: int) -> Checks:
    for known, ratio in ends.items():
        shape, nu, mu_0, alpha = known
        name = f"{shape}, ν = {nu:g}, μ_0 = {mu_0:g}, Δu_z/u_z0 = {alpha:g}"
        why = "an estimate for small μ_0 on cells of this size"
        yield Check(f"{name}: end of stick over v_c(1 + λ)", _over_estimate(known, ratio), 1, 0.12, why)
        if shape == "flat punch":
            turned, fixed = (fastest(cells, nu, mu_0, turned) for turned in (True, False))
            low, high = turned - 0.08 * _rub(known), fixed + FOUND * _rub(known)
            why = f"friction free to turn, {turned:.4g}, less λ² of a slip that is not small, to fixed, {fixed:.4g}"
            yield Check.between(f"{name}: end of stick over v_c by the linear problem", ratio, low, high, why)


def _table_checks() -> Checks:
    rows = [row for name in ("coupled", "coupling_held_out") for row in tables.read(name)]
    beyond = [row.stick for row in rows if row.point.v > 1 + 1.6 * radial_rub(row.point.case)]
    below = [row.stick for row in rows if row.point.v < 1 + 0.4 * radial_rub(row.point.case)]
    what = "share that sticks in the tables"
    name = f"greatest {what}, {len(beyond)} points above (1 + 1.6 λ) v_c"
    yield Check.at_most(name, max(beyond), 0, "beyond all ends")
    yield Check.at_least(f"least {what}, {len(below)} points below (1 + 0.4 λ) v_c", min(below), 1e-3, "below all ends")


def _place_checks(found: LastPeriod) -> Checks:
    """Above Eq. (1): what sticks does so at the trailing edge, while the depth grows fastest."""
    shares = found.stick
    i = int(np.nanargmax(shares))
    x, y = pictures.places(found)
    sticks = stuck(found.contact, found.steps[i])
    phase, along, across = (i + 1) / shares.size, np.mean(x[sticks]), np.mean(y[sticks])
    what = f"{ABOVE:g} v_c, greatest stick"
    name = f"{what}: when, in periods after the least depth"
    yield Check.between(name, phase, 0.15, 0.35, "the depth grows, at least at 0.8 of its fastest")
    yield Check.at_most(f"{what}: mean place along the pull, over a", along, -0.5, "the trailing edge")
    yield Check(f"{what}: mean place across the pull, over a", across, 0, 1e-6, "the contact is symmetric")


def _tail_checks(quick: bool) -> Checks:
    known = ((0.3, 0.1, 0.3),) if quick else ((0.3, 0.1, 0.3), (0.0, 0.1, 0.3), (0.3, 0.3, 0.3), (0.3, 0.3, 0.1))
    settings = Settings(17 if quick else 31, 32, cycles=1)
    for (shape, mean), (nu, mu_0, alpha) in product(MEANS.items(), known):
        v, case = FAST / alpha, _case((shape, nu, mu_0, alpha))
        cof = in_three_dimensions(case, v * mdr.critical_velocity(case), settings).cof
        scaled = 8 * v**2 * (1 - cof / mu_0) / radial_rub(case) ** 2
        name = f"{shape}, ν = {nu:g}, μ_0 = {mu_0:g}, {v:g} v_c = {FAST:g} v_c/α: 8 (1 − μ/μ_0)(v_0/v_c)²/λ² over M"
        yield Check(name, scaled / mean, 1, 0.08 if quick else 0.05, "(v_c/α v_0)² and α² of it, and cells")


# --- figures ---


@figure("ends", size=(6.2, 4.4))
def _end_figure(fig, ax, ends: dict[Known, float], cells: int):
    """Scatter of the end of stick against one plus lambda, along the diagonal.

    The velocity at which the last cell stops to stick, against the estimate (line). Bars: the linear problem on the
    same cells, friction free to turn (lower end) and fixed in its direction (upper end).{off_the_line}
    """
    line = np.array([1.0, 2.7])
    ax.plot(line, line, "-", color="0.6", lw=0.9, label=r"$(1 + \lambda) v_c$")
    for known, ratio in ends.items():
        colour, marker = LOOKS[known[0]]
        if known[0] == "flat punch":
            limits = [fastest(cells, known[1], known[2], turned) for turned in (True, False)]
            ax.plot([1 + _rub(known)] * 2, limits, "-", color=colour, lw=6, alpha=0.3)
        ax.plot(1 + _rub(known), ratio, marker, color=colour, mfc="w", ms=7)
    for shape in dict.fromkeys(known[0] for known in ends):
        ax.plot([], [], LOOKS[shape][1], color=LOOKS[shape][0], mfc="w", label=shape_label(shape))
    ax.plot([], [], "-", color=LOOKS["flat punch"][0], lw=6, alpha=0.3, label="linear problem, its two limits")
    ax.set(xlabel=r"$1 + \lambda$", ylabel="velocity at which stick ends, over Eq. (1)")
    ax.legend()
    off = " Above the line: large μ_0; below it: large λ, where the slip is not small and the linear problem ends."
    return {"off_the_line": off if len(ends) > 2 else ""}


@figure("map", 1, 4, size=(10.4, 3.1), sharey=True)
def _map_figure(fig, panels, found: LastPeriod):
    """Four maps of the contact over a period, with a crescent of stick in the first and arrows of slip.

    The contact of a paraboloid from above at {above:g} v_c (Eq. (1); ν = μ_0 = 0.3, Δu_z/u_z0 = 0.3). Dark: stick.
    Yellow: slip, with arrows along the slip of the indenter, in each map as long as it is fast. A crescent at the
    trailing edge sticks as the depth grows fastest (first): there the surface, drawn to the middle, keeps up with the
    pull. No spring sticks at this velocity.
    """
    pictures.period(panels, found)
    return {"above": ABOVE}
