"""Points of a profile across a tip in a CSV file."""

from __future__ import annotations

from os import PathLike

import numpy as np

from mdr.files.measurements import read_table
from mdr.files.recorded_motion import counted
from mdr.tools.arrays import EPS, Array
from mdr.tools.checks import positive, word
from mdr.tools.csv_header import Column, Reading

PROFILE = (
    Column(
        "r", ("x", "radius", "position", "distance", "lateral", "X position", "length"), "m", likely=(1e-10, 1.0),
        instead="pitch=, in m, for even steps",
    ),
    Column("f", ("h", "z", "height", "profile", "total profile", "raw height"), "m", likely=(0.0, 1.0)),
)  # fmt: skip


def profile_points(
    path: str | PathLike[str], reading: Reading, apex: float, side: str, flip: bool, pitch: float | None
) -> tuple[Array, Array]:
    """Radii from 0 and heights [m] of one side of a scan across the tip, or of both laid upon one another."""
    word("side", side, "both", "left", "right")
    table = read_table(path, PROFILE[pitch is not None :], reading)
    if pitch is not None:
        table.values["r"] = counted(table, PROFILE[0], positive("pitch", pitch, "in m"), "pitch")
    x, f = table.values["r"] - apex, table.values["f"] * (-1 if flip else 1)
    tiny = EPS**0.5 * float(np.max(np.abs(x)))  # two points that agree to half of their digits are one
    order = np.argsort(x, kind="stable")
    if (again := np.flatnonzero(np.diff(x[order]) <= tiny)).size:
        one, two = sorted(table.lines[order[again[0] + k]] for k in (0, 1))
        r = table.values["r"][order[again[0]]]
        raise table.fault(f"lines {one} and {two} both have r = {r:.6g} m; give one, or their mean")
    at_tip = np.flatnonzero(np.abs(x) <= tiny)
    if not at_tip.size:
        low, high = (table.values["r"][take(table.values["f"])] for take in (np.argmin, np.argmax))
        nearest = table.values["r"][np.argmin(np.abs(x))]
        places = f"the nearest is at {nearest:.6g} m, the least height at {low:.6g} m, the greatest at {high:.6g} m"
        what = f"no point at the tip, r = {apex:.6g} m; {places}"
        raise table.fault(f"{what}: give the place of the tip as apex=, or add the height there")
    kept = np.abs(x) <= tiny if side != "both" else np.ones(x.size, dtype=bool)
    kept |= x > 0 if side == "right" else x < 0
    order = np.argsort(np.abs(x[kept]), kind="stable")
    r, f = np.abs(x[kept])[order], f[kept][order]
    r[0] = 0.0
    firsts = np.flatnonzero(np.diff(r, prepend=-1.0) > tiny)  # of both sides the mean
    counts = np.diff(np.append(firsts, r.size))
    r, f = r[firsts], np.add.reduceat(f, firsts) / counts
    if f[-1] < f[0]:
        raise table.fault("heights fall away from the tip; of a tip that was measured pointing up, give flip=True")
    return r, f
