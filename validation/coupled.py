"""Three dimensions with coupling: how far friction falls below that of the springs.

On a compressible body pressing drags the surface to the middle of the contact, and friction along the surface moves it
up and down; springs know neither. Here elastic contacts slide with all couplings, from friction nearly at rest to far
above Eq. (1). Where stick ends, and what is left above, is validation/end_of_stick.py; on which groups the loss
depends, validation/coupling_law.py.

The sign of beta does not matter: to change it turns all tractions along the surface about, which is the same as to turn
the picture by half a turn.

Symbols: beta Dundurs' constant, kappa = E*/G*, lambda = 2 |beta|/(pi mu_0 kappa), v_c Eq. (1). The table
(validation/half_space/tables/coupled.csv) is computed by `python -m validation --long --only coupled`.
"""

from dataclasses import replace
from itertools import product

import numpy as np

import mdr
from mdr.closed_forms.coupling import radial_rub
from mdr.half_space.friction import Settings, in_three_dimensions
from validation.cases import contact
from validation.figures import COLOURS, figure, outer_labels
from validation.half_space import pictures, tables
from validation.half_space.tables import Point, Row
from validation.report import Check, Checks, Claim, told
from validation.words import span

SHAPES = ("paraboloid", "flat punch")
RATIOS, FRICTIONS = (0.0, 0.15, 0.3, 0.45), (0.1, 0.3, 0.6)  # nu, mu_0
ALPHA = 0.3
VELOCITIES = (5.0, 3.0, 2.0, 1.5, 1.2, 1.0, 0.9, 0.8, 0.6, 0.4, 0.2)  # over Eq. (1)
SHOWN = 0.6  # v_0/v_c of the map
FASTEST_SHOWN = 2.5  # v_0/v_c of the curves
NEARLY = 0.5 - 1e-7  # Poisson's ratio at which coupling is on, and does next to nothing


def claim(effort: str) -> Claim:
    """Springs give the friction of a compressible body

    How: Read the table, compute some of it again, and look into the contact.

    Quote: In the limit of a very stiff system spring … Eq. (1) … thus appears to be valid independently of the
    viscoelastic properties of the medium. … the obtained result in Eq. (15) is valid not only for the simple considered
    model …, but also for quite general contacts. (Section 2.2.2)

    Range: {n_rows} points in three dimensions with all couplings: paraboloid and flat punch, elastic, ν = 0 to 0.45
    (and next to 0.5 beside the table), μ_0 = 0.1 to 0.6, Δu_z/u_z0 = {ALPHA:g}, v_0/v_c from {slowest:g} to
    {fastest:g}; {tables.SETTINGS.cells}² cells and {tables.SETTINGS.steps} steps, errors beside each
    (validation/half_space/tables/coupled.csv)

    Measured: Dundurs' β couples the two: where it vanishes, coupled and uncoupled runs agree. Where it does not, the
    contact grows and shrinks with the surface rubbing radially under it, at up to λ = 2|β|/(π μ_0 κ) times the velocity
    of Eq. (1), and friction is lower than that of the springs. At most, by {heavy} of μ_0 at ν = 0.45, {usual} at ν =
    0.3 and {light} at ν = 0 (μ_0 = 0.3; paraboloid and punch). The loss is greatest at {where} for λ up to 1.2; for the
    largest λ it goes on growing down to {slowest:g} v_c, the lowest velocity that was tried. A core that is shifted to
    the trailing edge sticks, and what slips around it slips outward as the contact grows.

    Verdict: holds if Dundurs' β is zero: an incompressible body (ν = 0.5), or two bodies of the same material

    Sentence: With ν < 0.5 under a rigid indenter pressing moves the surface radially. Friction is lower than that of
    the springs by {usual} of μ_0 at ν = μ_0 = 0.3 and up to {greatest:.0f} % in the table.
    """
    quick = effort == "quick"
    if effort == "long":
        contacts = [(shape, nu, mu_0, ALPHA, 0.0) for mu_0 in FRICTIONS for nu in RATIOS for shape in SHAPES]
        computed = tables.compute([[Point(*one, v) for v in VELOCITIES] for one in contacts], tables.SETTINGS)
        tables.write("coupled", computed, tables.SETTINGS, "elastic, rigid pull, coupled")
    rows = tables.read("coupled")
    most = max(rows, key=lambda row: row.loss)
    n_rows, slowest, fastest = len(rows), min(VELOCITIES), max(VELOCITIES)
    heavy = _percent(rows, 0.45, 0.3)
    usual = _percent(rows, 0.3, 0.3)
    light = _percent(rows, 0.0, 0.3)
    where, greatest = _where(rows, 1.2), 100 * most.loss
    return Claim(
        **told(claim, locals()),
        checks=(*_equal_checks(quick), *_table_checks(rows), *_again_checks(rows, quick)),
        figures=(_curve_figure(rows), _map_figure(quick)),
    )


def _where(rows: list[Row], most: float) -> str:
    """Velocities of the greatest losses for lambda below a value."""
    within = tables.columns_of(row for row in rows if radial_rub(row.point.case) < most)
    return f"{span(max(column, key=lambda row: row.loss).point.v for column in within)} v_c"


def _percent(rows: list[Row], nu: float, mu_0: float) -> str:
    """The greatest loss of either shape, and the error of that."""
    own = tables.columns_of(row for row in rows if (row.point.nu, row.point.mu_0) == (nu, mu_0))
    most = sorted((max(column, key=lambda row: row.loss) for column in own), key=lambda row: row.loss)
    low, high = (f"{100 * row.loss:.2g}" for row in most)
    return f"{low} to {high} % (each ± {100 * max(row.error for row in most):.1g} %)"


# --- checks ---


def _equal_checks(quick: bool) -> Checks:
    for shape in SHAPES[:1] if quick else SHAPES:
        case = contact(shape, ALPHA, mu_0=0.3, nu=NEARLY)
        settings = Settings(17 if quick else 31, 24 if quick else 50, cycles=2)
        v_0 = 0.4 * mdr.critical_velocity(case)
        one, two = (in_three_dimensions(case, v_0, replace(settings, coupled=on)).cof for on in (True, False))
        name = f"{shape}, ν = 0.4999999: COF coupled over uncoupled"
        yield Check(name, one / two, 1, 1e-5, "forces to 1e-6 a step")
    pair = Point("paraboloid", 0.5, 0.3, ALPHA, 0.0, 0.6, nu_2=0.0)  # beta < 0
    turned = replace(pair, nu=0.0, nu_2=0.5)
    one, two = (tables.loss(point, Settings(cells=17, steps=24, cycles=3)) for point in (pair, turned))
    yield Check("two bodies, β → −β: loss over that of +β", one / two, 1, 1e-3, "of the solver, over a loss of 2 %")


def _table_checks(rows: list[Row]) -> Checks:
    most, least = max(row.error for row in rows), min(row.loss + row.error for row in rows)
    yield Check.at_most("greatest error of a point of the table, over μ_0", most, 0.02, "of a loss of up to a half")
    yield Check.at_least("least loss with its error, over μ_0", least, 0, "coupling never raises friction")
    for shape in SHAPES:
        own = [row for row in rows if row.point.shape == shape and row.point.v == 0.8 and row.point.mu_0 < 0.5]
        losses = np.array([row.loss for row in sorted(own, key=lambda row: radial_rub(row.point.case))])
        name = f"{shape}, 0.8 v_c: least growth of the loss from one λ to the next of {len(own)}"
        yield Check.at_least(name, float(np.diff(losses).min()), 0, "λ puts them in order")


def _again_checks(rows: list[Row], quick: bool) -> Checks:
    """Points computed now on a coarser grid."""
    known = {row.point: row for row in rows}
    settings = Settings(17 if quick else 21, 24 if quick else 32, cycles=4, settled=1e-3)
    velocities = (0.6,) if quick else (1.2, 0.6)
    for shape in SHAPES[:1] if quick else SHAPES:
        for new in tables.column([Point(shape, 0.3, 0.3, ALPHA, 0.0, v) for v in velocities], settings):
            old = known[new.point]
            name = f"{shape}, ν = μ_0 = 0.3, {new.point.v:g} v_c: loss computed again"
            yield Check(name, new.loss, old.loss, new.error + old.error, "errors of both")


# --- figures ---


@figure("cof", 2, 3, size=(10.2, 6.4), sharex=True, sharey=True)
def _curve_figure(fig, panels, rows: list[Row]):
    """Six panels of friction against velocity: four Poisson's ratios below the dashed springs.

    Friction in three dimensions with coupling (dots) below that of the springs (dashed), which do not know Poisson's
    ratio. The more compressible the body and the smaller μ_0, the lower; ν = 0.5 is the dashed line itself. Ticks above
    the curves: (1 + λ) v_c, about where stick ends, where this is below {fastest_shown:g} v_c. Friction is not full
    there, nor beyond.
    """
    for ax, (shape, mu_0) in zip(panels.flat, product(SHAPES, FRICTIONS), strict=True):
        for nu, colour in zip(RATIOS, COLOURS, strict=False):
            own = [r for r in rows if (r.point.shape, r.point.mu_0, r.point.nu) == (shape, mu_0, nu)]
            v, cof = [r.point.v for r in own], [r.cof for r in own]
            ax.plot(v, cof, "o-", ms=3.5, lw=1, color=colour, label=rf"$\nu = {nu:g}$")
            end = 1 + radial_rub(own[0].point.case)
            if end < 0.98 * FASTEST_SHOWN:
                ax.plot([end, end], [1.015, 1.05], color=colour, lw=2)
        ax.plot(v, [r.springs for r in own], "k--", lw=1.2, label="springs")
        ax.set(title=rf"{shape}, $\mu_0 = {mu_0:g}$", xlim=(0, FASTEST_SHOWN))
        ax.axvline(1, color="0.8", lw=0.8, zorder=0)
    panels[0, 0].set_ylim(None, 1.065)
    outer_labels(panels, "$v_0$ over Eq. (1)", r"$\mu/\mu_0$")
    panels[0, 2].legend(loc="lower right")
    return {"fastest_shown": FASTEST_SHOWN}


@figure("map", 1, 4, size=(10.4, 3.1), sharey=True)
def _map_figure(fig, panels, quick: bool):
    """Four maps of the contact over a period with regions of stick and arrows of slip.

    The contact of a paraboloid from above at {shown:g} v_c (ν = μ_0 = 0.3, Δu_z/u_z0 = {alpha:g}). Dark: stick. Yellow:
    slip, with arrows along the slip of the indenter, in each map as long as it is fast. While the depth grows (first
    and second) what sticks is a region shifted to the trailing edge, and around it the indenter slips outward, over a
    surface that is drawn to the middle; on retreat all slips, along the pull.
    """
    pictures.period(panels, pictures.last_of_a_paraboloid(SHOWN, quick))
    return {"shown": SHOWN, "alpha": ALPHA}
