"""Three dimensions without coupling: an elastic half-space, friction as a vector, and the springs beside it.

The Method of Dimensionality Reduction promises that a row of independent springs has the forces of the axisymmetric
contact, whatever its history, as long as pressure and friction leave each other alone (Dundurs' beta = 0) and nothing
slips across the pull (exact for nu = 0). Here a half-space of nu = 0 without coupling takes the very steps of the
springs, its cells sticking and slipping with their neighbours in view, through loss and return of contact, elastic and
Kelvin. What transverse slip does for nu > 0 is another claim (validation/transverse_slip.py).

The table (validation/half_space/tables/uncoupled.csv) is computed by `python -m validation --long --only uncoupled`.
"""

from collections.abc import Iterable
from dataclasses import replace
from itertools import product

from mdr.half_space.friction import Settings
from validation.cases import LOOKS, SHAPES, loss, shape_label
from validation.figures import figure
from validation.half_space import tables
from validation.half_space.tables import Point, Row
from validation.report import Check, Checks, Claim, told
from validation.words import number

KEPT, LOST = 0.3, 1.5  # du_z/u_z0
TIMES = (0.0, 1.0)
VELOCITIES = (0.8, 0.4, 0.1)  # over Eq. (1)
ALLOWED = 2e-4  # of mu_0
SETTINGS = Settings(cells=48, steps=50, cycles=20, coupled=False, settled=1e-6)
FINER = replace(SETTINGS, cells=96)  # where contact is lost, and small for a part of the period


def claim(effort: str) -> Claim:
    """Without coupling springs give the friction of the three-dimensional contact

    How: Read the table, and compute some of it again.

    Quote: According to the Method of Dimensionality Reduction (MDR), any rotationally symmetric contact can be
    equivalently represented by a model consisting of a series of independent springs. (Section 2.2.2)

    Range: {n_rows} contacts in three dimensions, ν = 0 and no coupling: four shapes, elastic and ωτ = 1, contact kept
    (Δu_z/u_z0 = {KEPT:g}) and lost ({LOST:g}), v_0/v_c from {slowest:g} to {fastest:g}; {SETTINGS.cells}² cells where
    contact is kept, {FINER.cells}² where it is lost, {SETTINGS.steps} steps a period
    (validation/half_space/tables/uncoupled.csv)

    Measured: The COF in three dimensions differs from that of the springs by at most {worst:.2e} of μ_0, both in the
    same steps; half the steps and half the cells change that by at most {step:.0e} and {grid:.0e}. So independent
    springs do what neighbours that feel each other do, cell by cell with stick, slip and loss of contact.

    Verdict: holds

    Sentence: Where pressure and friction do not act on each other, the springs have the friction of the half-space, to
    {worst_of_all} of μ_0.
    """
    if effort == "long":
        kept = tables.compute(_columns(SHAPES, KEPT, VELOCITIES), SETTINGS)
        lost = tables.compute(_columns(SHAPES, LOST, VELOCITIES), FINER)
        tables.write("uncoupled", [*kept, *lost], FINER, "no coupling; 48 x 48 where contact is kept")
    rows = tables.read("uncoupled")
    if effort == "quick":
        columns = _columns(("paraboloid",), KEPT, VELOCITIES[1:2])
        again = tables.compute(columns, replace(SETTINGS, cells=32, steps=24))
    else:
        again = tables.compute(_columns(SHAPES, KEPT, VELOCITIES[1:2]), SETTINGS)
        again += tables.compute(_columns(("cone",), LOST, VELOCITIES[1:2])[:1], FINER)
    worst = max(abs(row.loss) for row in rows)
    n_rows, slowest, fastest = len(rows), min(VELOCITIES), max(VELOCITIES)
    step, grid = max(row.step for row in rows), max(row.grid for row in rows)
    worst_of_all = number(worst, 1)
    return Claim(
        **told(claim, locals()), checks=(*_table_checks(rows), *_again_checks(again, rows)), figures=(_figure(rows),)
    )


def _columns(shapes: Iterable[str], alpha: float, velocities: Iterable[float]) -> list[list[Point]]:
    return [[Point(shape, 0.0, 0.3, alpha, T, v) for v in velocities] for shape in shapes for T in TIMES]


def _table_checks(rows: list[Row]) -> Checks:
    for shape, (alpha, contact) in product(SHAPES, ((KEPT, "kept"), (LOST, "lost"))):
        own = [row for row in rows if (row.point.shape, row.point.alpha) == (shape, alpha)]
        why = f"2e-4 asked; half the steps and cells change it by {max(row.step + row.grid for row in own):.0e}"
        name = f"{shape}, contact {contact}: worst COF(springs) − COF(3D), over μ_0, of {len(own)}"
        yield Check(name, max((row.loss for row in own), key=abs), 0, ALLOWED, why)


def _again_checks(again: list[Row], rows: list[Row]) -> Checks:
    """The same computed now; a coarser grid must come as close as it says of itself."""
    known = {row.point: row for row in rows}
    shares = [abs(row.loss - known[row.point].loss) / (row.error + known[row.point].error) for row in again]
    name = f"{len(again)} of the table computed again: greatest change over the errors of both"
    yield Check.at_most(name, max(shares), 1, "steps, cells and settling")


@figure("cof", 1, 4, size=(10.4, 3.4), sharey=True)
def _figure(fig, panels, rows: list[Row]):
    """Four panels of friction against velocity; marks of four shapes lie on their lines.

    Friction in three dimensions (marks) on that of independent springs in the same steps (lines): no difference can be
    seen, with contact kept and lost.
    """
    for ax, (alpha, T) in zip(panels, product((KEPT, LOST), TIMES), strict=True):
        for shape, (colour, marker) in LOOKS.items():
            own = [r for r in rows if (r.point.shape, r.point.alpha, r.point.T) == (shape, alpha, T)]
            v = [row.point.v for row in own]
            ax.plot(v, [row.springs for row in own], "-", color=colour, label=shape_label(shape))
            ax.plot(v, [row.cof for row in own], marker, color=colour, mfc="w", ms=7)
        ax.set(title=f"{loss(T)}, contact {'kept' if alpha == KEPT else 'lost'}", xlabel="$v_0/v_c$", xlim=(0, 0.9))
    panels[0].set_ylabel(r"$\mu/\mu_0$")
    panels[0].legend()
