"""Measured friction over velocity, from a CSV file whose header names columns and units.

    v_0 [mm/s], COF, error
    0.5, 0.31, 0.01
    1.0, 0.35, 0.01

What `CofCurve.to_csv` writes is read too. A contact that is shaken in the plane may be pulled either way:
velocities the other way are negative.
"""

from __future__ import annotations

import warnings
from contextlib import suppress
from dataclasses import dataclass
from itertools import product
from os import PathLike

import numpy as np

from mdr.case.doubts import GREATEST_MU_0
from mdr.files.measurements import read_table
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array
from mdr.tools.csv_header import Column
from mdr.tools.csv_table import Columns, Reading, Units, table_of
from mdr.tools.records import ArrayRecord
from mdr.tools.summary import Summarised, Summary, span
from mdr.tools.warned import warn_outside

_WORDS = ("error", "err", "std", "sd", "sem", "sigma", "uncertainty")
_OF = tuple(f"{a} {b}" for one, two in product(("cof", "mu", "friction"), _WORDS) for a, b in ((one, two), (two, one)))
ERRORS = (*_WORDS, *_OF, "error bar", "std dev", "standard deviation", "standard error", "u(mu)")
COLUMNS = (
    Column(
        "v_0", ("v", "velocity", "speed", "sliding velocity", "sliding speed"), "m/s", lone=True, likely=(0.0, 100.0)
    ),
    Column("cof", ("mu", "μ", "friction", "coefficient of friction", "friction coefficient"), "-"),
    Column("error", ERRORS, "-", needed=False),
)


@dataclass(frozen=True, eq=False, repr=False)
class FrictionData(Summarised, ArrayRecord):
    """Measured coefficients of friction; arrays of shape (n,)."""

    v_0: Array  #: velocities [m/s], ascending; negative for a pull the other way, where the contact is shaken in plane
    cof: Array  #: coefficients of friction [-]; mean F_x over mean F_z, F_x positive where it holds the pull back
    error: Array | None = None  #: standard deviation of each [-], None where not known

    def __post_init__(self) -> None:
        columns = {"v_0": "m/s", "cof": "", **({"error": ""} if self.error is not None else {})}
        for name, unit in columns.items():
            values = np.array(finite_array(name, getattr(self, name), unit), ndmin=1)
            if values.ndim != 1 or values.size != np.size(self.v_0) or not values.size:
                raise ValueError(f"{name} must be a list of as many numbers as v_0, got shape {values.shape}")
            object.__setattr__(self, name, values)
        if self.error is not None and np.any(self.error <= 0):
            raise ValueError(f"error must be positive, got {float(self.error.min())!r}; leave it out where not known")
        order = np.argsort(self.v_0, kind="stable")
        for name in columns:
            object.__setattr__(self, name, getattr(self, name)[order])
        super().__post_init__()
        if np.max(self.cof) > GREATEST_MU_0:
            warn_outside(
                f"a COF of {np.max(self.cof):.4g} is more than {GREATEST_MU_0:g}: is it in per cent, or a force?"
            )

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


def read_friction_data(
    path: str | PathLike[str], *, units: Units = None, columns: Columns = None, skip: int | None = None
) -> FrictionData:
    r"""Measured friction [-] over velocity from a CSV file.

    Parameters
    ----------
    path : str or path-like
        The file. Its header names the columns and the unit of the velocity, `v_0 [mm/s], cof, error`; the last is
        optional.
    units : dict of str, optional
        Unit of the velocity, where the header has none: {"v_0": "mm/s"}.
    columns : dict of str or int, optional
        What the header calls a column, {"cof": "Reibwert"}, or its number, from 1.
    skip : int, optional
        Lines above the header. None finds it.

    Returns
    -------
    FrictionData
        Velocities in m/s, ascending.

    Raises
    ------
    ValueError
        With file and line of what is wrong.

    Warns
    -----
    PlausibilityWarning
        Of columns that may be the error, where none is named so.

    Examples
    --------
    >>> from pathlib import Path
    >>> import mdr
    >>> _ = Path("measured.csv").write_text("v_0 [mm/s], cof\n0.5, 0.31\n1.0, 0.35\n")
    >>> mdr.read_friction_data("measured.csv").v_0
    array([0.0005, 0.001 ])
    """
    table, maybe = read_table(path, COLUMNS, Reading(units, columns, skip)), []
    if "error" not in table.values and "error" not in (columns or {}):
        for name in table.header.unread:
            with suppress(ValueError), warnings.catch_warnings(action="ignore"):
                reading = Reading(units, {**(columns or {}), "error": name}, skip)
                error = table_of(table.text, table.source, COLUMNS, reading).values["error"]
                if np.all((error > 0) & (error < table.values["cof"])):
                    maybe.append(name)
    if maybe:
        say = f'columns={{"error": "{maybe[0]}"}}'
        warn_outside(f"{table.source}: no error is known; if {' or '.join(maybe)} is that of the COF, say {say}")
    try:
        return FrictionData(**table.values)
    except ValueError as refusal:
        raise table.fault(str(refusal)) from None
