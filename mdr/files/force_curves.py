"""Force over depth in a CSV file: approach or retract, less the force before the touch, from the touch on.

Where the curve begins before the touch, the force there is flat. Touch and baseline are then those of

    F = baseline + C max(d - touch, 0)^n

that come closest to the first third of the rise, n as the tip has it; they are told. Where the tip is not known, so are
the touches of a round and of a sharp one: a cone with a round end has its touch between them.
"""

from __future__ import annotations

import re
from itertools import pairwise
from os import PathLike
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.files.measurements import read_table
from mdr.indenters.mapping.force_curves import TIPS, tip_of
from mdr.tools.arrays import Array
from mdr.tools.checks import finite, positive
from mdr.tools.csv_header import Column, Columns, Reading, Units
from mdr.tools.csv_table import Table
from mdr.tools.messages import first_of
from mdr.tools.noisy_curves import before_it_stands, in_order, reach_of_noise, turning_points
from mdr.tools.warned import warn_outside

PARTS = ("approach", "retract")
LEAST_PART = 0.02  #: share of the whole way from which on a way back is no jitter
LEAST_RISE = 0.1  #: share of the range of forces that a part changes by, and what happens in the air does not
RISE = 0.3  #: share of the force up to which touch and baseline are looked for
ON_IT = 1e-3  #: part of a step of depth within which a reading is that of the touch
POWERS = (1.0, 1.25, 1.5, 1.75, 2.0)  #: n of a tip that is not known: a flat one to a cone
FLAT = 5  #: points before the touch that make a baseline
TOLD_FROM = 10  #: the same, from which their noise is known
LEAST_FLAT = 2  #: the same of a curve whose readings are no depths
DEPTHS = ("depth", "indentation", "indentation depth", "penetration", "penetration depth")
HEIGHTS = (
    "displacement", "extension", "height", "measured height", "height sensor", "piezo", "piezo height",
    "piezo position", "z", "z position", "z piezo", "z sensor", "position", "travel",
)  # fmt: skip
OF_PIEZO = "if the height of a piezo, the stiffness of its cantilever too, spring_constant= in N/m"
DEPTH = Column("d", DEPTHS, "m", likely=(1e-12, 0.01), doubtful=HEIGHTS, asked=OF_PIEZO)
HEIGHT = DEPTH._replace(names=HEIGHTS, doubtful=("d", *DEPTHS), asked="of a depth, leave spring_constant out")
FORCE = (DEPTH, Column("F", ("F_N", "F_z", "force", "normal force", "load"), "N", lone=True, likely=(0.0, 1e6)))


class ForceCurve(NamedTuple):
    """A measured force over depth, one way of it, arrays of shape (n,), as `FromForce.read` takes it."""

    d: Array  #: readings of the depth [m], ascending
    F: Array  #: forces [N], with what there is before the touch
    touch: float | None  #: reading of the depth at first touch [m]; None where the readings are depths from there
    baseline: float  #: force before the touch [N]
    depths: Array  #: (n_p,) from the touch on, from 0 [m]
    forces: Array  #: (n_p,) less the baseline, from 0 [N]


def read_force_curve(
    path: str | PathLike[str],
    *,
    units: Units = None,
    columns: Columns = None,
    skip: int | None = None,
    table: int | str | None = None,
    part: str = "approach",
    touch: float | None = None,
    baseline: float | None = None,
    tip: str = "any",
    spring_constant: float | None = None,
) -> ForceCurve:
    r"""Normal force [N] over depth [m] from a CSV file, with its touch and baseline: to look at what is taken.

    Parameters
    ----------
    path, units, columns, skip, table, part, touch, baseline, tip, spring_constant
        As in `FromForce.read`.

    Returns
    -------
    ForceCurve
        The curve, which `mdr.plots.plot_force_curve` draws.

    Raises
    ------
    ValueError
        With file and line of what is wrong.

    Examples
    --------
    >>> from pathlib import Path
    >>> import mdr
    >>> points = "".join(f"{d}, {1 + 0.4 * max(d - 3, 0)**1.5}\n" for d in range(12))
    >>> _ = Path("press.csv").write_text("z [um], F [mN]\n" + points)
    >>> curve = mdr.read_force_curve("press.csv", columns={"d": "z"}, touch=3e-6)
    >>> print(f"{curve.baseline:.3g} N, {curve.depths[-1]:.2g} m")
    0.001 N, 8e-06 m
    """
    if not re.fullmatch(rf"({'|'.join(PARTS)})( [1-9]\d*)?", str(part)):
        raise ValueError(f'part must be one of {", ".join(PARTS)}, or "approach 2" of several, got {part!r}')
    power = TIPS[tip_of("tip", tip)]
    touch = None if touch is None else finite("touch", touch, "reading of d in m")
    baseline = None if baseline is None else finite("baseline", baseline, "force before the touch in N")
    give = 0.0 if spring_constant is None else 1 / positive("spring_constant", spring_constant, "in N/m")
    measured = read_table(path, (HEIGHT if give else DEPTH, FORCE[1]), Reading(units, columns, skip, table))
    sign = _inwards(measured)
    z, F = sign * measured.values["d"], measured.values["F"]
    rows = _one_way(measured, z, F, part)
    z, F = z[rows], F[rows]
    touch = None if touch is None else sign * touch
    if touch is not None and baseline is None and np.any(z < touch):
        baseline = float(F[z < touch].mean())
        warn_outside(f"{measured.source}: baseline={baseline:.4g} N is taken, the mean force before the touch")
    d, F = in_order(z - give * (F - (baseline or 0.0)), F)
    if d.size > 2 * TOLD_FROM and np.sum(np.diff(F) ** 2) > np.sum((F - F.mean()) ** 2):  # of noise alone it is twice
        raise measured.fault("the forces scatter and do not rise: nothing is touched, or the column is another")
    # the point (0, 0) is added to a depth that is at most three of the widest steps away
    are_depths = d.size < 2 or 0 <= d[0] <= 3.0 * float(np.diff(d).max())
    found = touch_of(d, F, power) if touch is None and d.size > 2 * LEAST_FLAT else None
    if found is not None and _begins_before(d, F, found[0], are_depths):
        unbent = give * found[1] if baseline is None else 0.0  # of a cantilever, by what was not taken off yet
        touch, baseline, d = found[0] + unbent, found[1] if baseline is None else baseline, d + unbent
        taken = f"touch={sign * touch:.6g} m and baseline={baseline:.4g} N are taken, as found"
        warn_outside(f"{measured.source}: {taken}{'' if power else _of_other_tips(d, F)}")
    baseline = baseline or 0.0
    if touch is not None:
        _doubt(measured, F - baseline, d, touch)
    elif not are_depths:
        where = "above the surface" if d[0] < 0 else "far from 0"
        raise measured.fault(f"the first d is {d[0]:.6g} m, {where}; give the depth of the first touch as touch=")
    return ForceCurve(d, F, touch, baseline, *_from_the_touch(measured, d, F - baseline, touch))


def _from_the_touch(table: Table, d: Array, F: Array, touch: float | None) -> tuple[Array, Array]:
    """Depths from the touch, and forces less the baseline, both from 0."""
    if np.all(F <= 0) or (-F.min() > 2 * F.max() and np.argmin(F) > 0.9 * F.size):  # what is deepest pulls most
        raise table.fault("no force is above zero; compression must be positive, turn the sign of F")
    if touch is not None:
        early = np.arange(d.size) < np.argmax(RISE * F.max() <= F)
        below = np.flatnonzero(early & (F <= 0))  # before the touch, or by noise after it
        step = np.diff(d).mean() if d.size > 1 else 0.0
        kept = (d > touch + ON_IT * step) & (np.arange(d.size) > (below[-1] if below.size else -1))
        d, F = d[kept] - touch, F[kept]
    if d.size and d[0] > 0:
        d, F = np.insert(d, 0, 0.0), np.insert(F, 0, 0.0)
    return d, F


def _of_other_tips(d: Array, F: Array) -> str:
    """Between which touches that of an unknown tip lies: one that is round at first and sharp above is between both."""
    sharp, is_round = (touch_of(d, F, TIPS[tip])[0] for tip in ("sharp", "round"))
    return f'; with tip="sharp" the touch would be {sharp:.6g} m, with tip="round" {is_round:.6g} m'


def _doubt(table: Table, F: Array, d: Array, touch: float) -> None:
    """Warn of a baseline that drifts, and of adhesion."""
    early, most = d < touch, float(F.max())
    n = np.count_nonzero(early)
    if n < TOLD_FROM:
        return
    noise = 1.05 * float(np.median(np.abs(np.diff(F[early]))))  # the standard deviation, of normal noise
    x = (d - d[early].mean()) / np.ptp(d[early])
    drift = float(x[early] @ F[early] / (x[early] @ x[early]))  # of a straight line, from end to end of what is early
    drifts = abs(drift) > max(6 * noise * np.sqrt(12 / n), 0.01 * most)
    near = d <= touch + np.ptp(d[early])  # farther off the line is not known
    pull = float((F[early].mean() + drifts * drift * x - F)[near].max())
    if pull > max(8 * noise, 0.01 * most):
        warn_outside(
            f"{table.source}: forces down to -{pull:.2g} N pull: of an adhesive contact, which this library does not "
            "know, the shape comes out wrong"
        )
    elif drifts:
        warn_outside(
            f"{table.source}: the force drifts by {drift:.2g} N before the touch, which shifts what is found of it: "
            "take the straight line off the forces, and give touch= and baseline=0"
        )


def _inwards(table: Table) -> int:
    """1 where the readings of depth or height rise as the tip is pressed; -1, which is told, where they fall."""
    z, F = table.values["d"], table.values["F"]
    middle = np.median(F)
    if F.size < 3 or (z - z.mean()) @ (F - F.mean()) >= 0 or F.max() - middle < middle - F.min():
        return 1
    warn_outside(f"{table.source}: d is turned, as the force rises where it falls: it points out of the body")
    return -1


def _one_way(table: Table, z: Array, F: Array, part: str) -> NDArray[np.intp]:
    """The rows of one part of the curve, from its least reading z to its greatest; what no part holds is told."""
    lines, turns = table.lines, turning_points(z, max(reach_of_noise(z), LEAST_PART * float(np.ptp(z))))
    parts: dict[str, list[tuple[int, int]]] = {way: [] for way in (*PARTS, "")}
    for first, end in ((first, last + 1) for first, last in pairwise(turns)):
        is_loaded = np.ptp(F[first:end]) >= LEAST_RISE * np.ptp(F)
        parts[PARTS[int(z[end - 1] < z[first])] if is_loaded else ""].append((first, end))
    way, _, number = part.partition(" ")
    found, k = parts[way], int(number or 1) - 1
    if k >= len(found) or (len(found) > 1 and not number):
        there = [
            f'part="{one}{f" {n}" if len(parts[one]) > 1 else ""}" of lines {lines[first]} to {lines[end - 1]}'
            for one in PARTS
            for n, (first, end) in enumerate(parts[one], 1)
        ]
        what = f"{len(found)} parts of the curve are" if found else "no part of the curve is"
        raise table.fault(f"{what} {way}: choose {', '.join(first_of(there))}")
    first, end = found[k]
    rows = np.arange(first, end) if way == "approach" else np.arange(end - 1, first - 1, -1)
    is_high = F[rows] - F[rows].min() > LEAST_RISE * np.ptp(F[rows])
    rows = rows[: min(before_it_stands(x[rows], is_high) for x in (z, F))]
    top = np.flatnonzero(z[rows] >= z[rows].max() - reach_of_noise(z))  # of these by noise one is the deepest
    rows = rows[: top[np.argmax(F[rows][top] >= F[rows][top].max() - reach_of_noise(F[rows]))] + 1]
    unread = np.ones(z.size, dtype=bool)
    for others in (run for one in PARTS for run in parts[one] if run != (first, end)):
        unread[slice(*others)] = False
    unread[rows] = False
    if np.any(unread):
        ends = np.flatnonzero(np.diff(unread, prepend=False, append=False)).reshape(-1, 2)
        said = " and ".join(f"{lines[a]} to {lines[b - 1]}" for a, b in ends)
        warn_outside(f"{table.source}: lines {said} are left out: the tip is held there, or does not touch")
    return rows


def _begins_before(d: Array, F: Array, touch: float, are_depths: bool) -> bool:
    """Whether there is a force before the touch, which does not rise, where the readings could be depths."""
    flat = F[d < touch]
    return flat.size >= (FLAT if are_depths else LEAST_FLAT) and not (are_depths and np.mean(np.diff(flat) > 0) > 0.75)


def touch_of(d: Array, F: Array, power: float) -> tuple[float, float]:
    """Touch [m] and baseline [N] of a curve."""
    from scipy.optimize import minimize_scalar

    before = float(np.median(F[: max(3, F.size // 10)]))
    end = max(int(np.argmax(before + RISE * (F.max() - before) <= F)) + 1, min(2 * FLAT, F.size))
    length = float(np.ptp(d[:end]))
    x, y = (d[:end] - d[0]) / length, F[:end]

    def missed(touch: float, n: float) -> tuple[float, float]:
        rows = np.column_stack([np.ones(x.size), np.maximum(x - touch, 0) ** n])
        found = np.linalg.lstsq(rows, y, rcond=None)[0]
        return float(np.sum((rows @ found - y) ** 2)), float(found[0])

    tried = []
    for n in (power,) if power else POWERS:
        places = x[:: max(1, x.size // 200)]
        k = int(np.argmin([missed(place, n)[0] for place in places[:-1]]))
        bounds = (places[max(k - 1, 0)], places[min(k + 1, places.size - 1)])
        found = minimize_scalar(
            lambda at, n=n: missed(at, n)[0], bounds=bounds, method="bounded", options={"xatol": 1e-9}
        )
        touch = float(found.x)
        tried.append((*missed(touch, n), touch))
    _, base, touch = min(tried)
    return float(d[0]) + length * touch, base
