"""Measured friction over velocity, from a CSV file whose header names columns and units.

    v_0 [mm/s], COF, error
    0.5, 0.31, 0.01
    1.0, 0.35, 0.01

The columns may stand in any order, beside others; commas, semicolons and tabs separate them; lines that begin with #
are left out. What `CofCurve.to_csv` writes is read too.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from os import PathLike, fsdecode

import numpy as np

from mdr.files.case_files import read_text
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array
from mdr.tools.csv_table import cells_of, fault
from mdr.tools.messages import short
from mdr.tools.records import ArrayRecord
from mdr.tools.summary import Summarised, Summary, span

UNITS = {"m/s": 1.0, "cm/s": 1e-2, "mm/s": 1e-3, "um/s": 1e-6, "µm/s": 1e-6, "μm/s": 1e-6, "nm/s": 1e-9}
NAMES = {
    "v_0": ("v_0", "v0", "v", "velocity", "speed"),
    "cof": ("cof", "mu", "µ", "μ", "friction", "coefficient of friction"),
    "error": ("error", "cof_error", "sigma", "std", "uncertainty"),
}
_HEAD = re.compile(r"^(?P<name>[^\[\](]*?)\s*(?:[\[(](?P<unit>[^\])]*)[\])])?$")


@dataclass(frozen=True, eq=False, repr=False)
class FrictionData(Summarised, ArrayRecord):
    """Measured coefficients of friction; arrays of shape (n,)."""

    v_0: Array  #: velocities [m/s], ascending
    cof: Array  #: coefficients of friction [-]
    error: Array | None = None  #: standard deviation of each [-], None where not known

    def __post_init__(self) -> None:
        columns = {"v_0": "m/s", "cof": "", **({"error": ""} if self.error is not None else {})}
        for name, unit in columns.items():
            values = np.array(finite_array(name, getattr(self, name), unit), ndmin=1)
            if values.ndim != 1 or values.size != np.size(self.v_0) or not values.size:
                raise ValueError(f"{name} must be a list of as many numbers as v_0, got shape {values.shape}")
            object.__setattr__(self, name, values)
        if np.any(self.v_0 < 0):
            raise ValueError(f"v_0 must not be negative, got {float(self.v_0.min())!r} m/s; give the speed")
        if self.error is not None and np.any(self.error <= 0):
            raise ValueError(f"error must be positive, got {float(self.error.min())!r}; leave it out where not known")
        order = np.argsort(self.v_0, kind="stable")
        for name in columns:
            object.__setattr__(self, name, getattr(self, name)[order])
        super().__post_init__()

    def _summary(self) -> Summary:
        error = "not known" if self.error is None else span(self.error)
        return Summary(
            f"FrictionData of {self.v_0.size} measurements",
            [
                ("v_0", span(self.v_0, "m/s"), "velocities"),
                ("COF", span(self.cof), "coefficients of friction"),
                ("error", error, "standard deviation of each"),
            ],
        )


def read_friction_data(path: str | PathLike[str]) -> FrictionData:
    r"""Measured friction [-] over velocity from a CSV file.

    Parameters
    ----------
    path : str or path-like
        The file. Its header names the columns and the unit of the velocity, `v_0 [mm/s], cof, error`; the last is
        optional.

    Returns
    -------
    FrictionData
        Velocities in m/s, ascending.

    Raises
    ------
    ValueError
        With file and line of what is wrong.

    Examples
    --------
    >>> from pathlib import Path
    >>> import mdr
    >>> _ = Path("measured.csv").write_text("v_0 [mm/s], cof\n0.5, 0.31\n1.0, 0.35\n")
    >>> mdr.read_friction_data("measured.csv").v_0
    array([0.0005, 0.001 ])
    """
    source = fsdecode(path)
    lines = [(n, line) for n, line in enumerate(read_text(path).splitlines(), start=1)]
    lines = [(n, line) for n, line in lines if line.strip() and not line.lstrip().startswith("#")]
    if len(lines) < 2:
        raise fault(source, "holds no table; a header such as v_0 [m/s], cof, error, and a row a measurement")
    separator = max(",;\t", key=lines[0][1].count)
    rows = [cells_of(line, f"{source}: line {number}", separator) for number, line in lines]
    places, scale = _columns(rows[0], source)
    values: dict[str, list[float]] = {name: [] for name in places}
    for (number, _), row in zip(lines[1:], rows[1:], strict=True):
        for name, place in places.items():
            values[name].append(_number(row, place, f"{source}: line {number}"))
    try:
        error = np.array(values["error"]) if "error" in values else None
        return FrictionData(np.array(values["v_0"]) * scale, np.array(values["cof"]), error)
    except ValueError as refusal:
        raise fault(source, str(refusal)) from None


def _columns(header: list[str], source: str) -> tuple[dict[str, int], float]:
    """Where each column stands, and what turns velocities into m/s."""
    places: dict[str, int] = {}
    scale = 1.0
    for place, head in enumerate(header):
        found = _HEAD.match(head.strip())
        name = found["name"].strip().casefold() if found else ""
        meant = next((column for column, names in NAMES.items() if name in names), None)
        if meant is None:
            continue
        if meant in places:
            raise fault(source, f"the header names {meant} twice: {short(', '.join(header))}")
        places[meant] = place
        unit = (found["unit"] or "").strip() if found else ""
        if meant == "v_0":
            if unit not in UNITS:
                wrong = f"the unit {short(unit)!r} of v_0 is none of"
                what = wrong if unit else "v_0 needs a unit in its header, one of"
                raise fault(source, f"{what} {', '.join(dict.fromkeys(UNITS))}: v_0 [mm/s]")
            scale = UNITS[unit]
        elif unit not in ("", "-", "1"):
            raise fault(source, f"{meant} is a pure number, got the unit {short(unit)!r}")
    if missing := [name for name in ("v_0", "cof") if name not in places]:
        raise fault(source, f"the header names no {missing[0]}: {short(', '.join(header))}; write v_0 [m/s], cof")
    return places, scale


def _number(row: list[str], place: int, where: str) -> float:
    text = row[place].strip() if place < len(row) else ""
    try:
        return float(text)
    except ValueError:
        what = short(text) if text else "nothing"
        raise fault(where, f"{what} is no number") from None
