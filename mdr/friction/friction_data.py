"""Measured friction over velocity, from a CSV file whose header names columns and units.

    v_0 [mm/s], COF, error
    0.5, 0.31, 0.01
    1.0, 0.35, 0.01

What `CofCurve.to_csv` writes is read too. A contact that is shaken in the plane may be pulled either way:
velocities the other way are negative.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from os import PathLike

import numpy as np

from mdr.case.doubts import GREATEST_MU_0
from mdr.files.measurements import read_table
from mdr.tools.arrays import Array
from mdr.tools.checks import finite, finite_array, positive
from mdr.tools.csv_header import Column, Columns, Reading, Units
from mdr.tools.csv_table import Table
from mdr.tools.records import ArrayRecord
from mdr.tools.summary import Summarised, Summary, span
from mdr.tools.warned import warn_outside

_WORDS = ("error", "err", "std", "sd", "sem", "sigma", "uncertainty")
_OF = tuple(f"{a} {b}" for one, two in product(("cof", "mu", "friction"), _WORDS) for a, b in ((one, two), (two, one)))
ERRORS = (*_WORDS, *_OF, "error bar", "std dev", "standard deviation", "standard error", "u(mu)")
VELOCITY = Column(
    "v_0", ("v", "velocity", "speed", "sliding velocity", "sliding speed"), "m/s", lone=True, likely=(0.0, 100.0),
    instead="v_0=, of friction over another column: du_x, du_y, du_z, u_z0, load or frequency",
)  # fmt: skip
FORCES = {
    "F_t": ("Ft", "F_f", "Ff", "F_x", "friction force", "tangential force", "lateral force"),
    "F_n": ("Fn", "F_N", "F_z", "normal force", "normal load"),
}
FRICTION = (
    Column(
        "cof", ("mu", "μ", "friction", "coefficient of friction", "friction coefficient"),
        instead="forces, F_t [N] and F_n [N]", others=(*FORCES,),
    ),
    Column("error", ERRORS, needed=False),
    *(Column(name, names, "N", needed=False, without="cof") for name, names in FORCES.items()),
)  # fmt: skip
TURNING = VELOCITY._replace(unit="rad/s", lone=False, instead="", likely=(0.0, np.inf))
#: what varies in the place of the velocity, by its name in a case
OVER = tuple(
    Column(name, (f"{part}.{name}" if part else name, *more), unit, needed=False)
    for name, part, unit, more in (
        ("du_x", "shake", "m", ()),
        ("du_y", "shake", "m", ()),
        ("du_z", "oscillation", "m", ()),
        ("u_z0", "oscillation", "m", ()),
        ("load", "", "N", ()),
        ("frequency", "", "Hz", ("f", "freq")),
    )
)


@dataclass(frozen=True, eq=False, repr=False)
class FrictionData(Summarised, ArrayRecord):
    """Measured coefficients of friction; arrays of shape (n,)."""

    v_0: Array  #: velocities [m/s], ascending; negative for a pull the other way, where the contact is shaken in plane
    cof: Array  #: coefficients of friction [-]; mean F_x over mean F_z, F_x positive where it holds the pull back
    error: Array | None = None  #: standard deviation of each [-], None where not known
    over: str = ""  #: path of a number of the case that was varied, "" for the velocity alone
    values: Array | None = None  #: its values, in SI, at each measurement

    def __post_init__(self) -> None:
        if bool(self.over) != (self.values is not None):
            raise ValueError("over, the path of what was varied, and values go together: give both or none")
        if self.values is not None:
            object.__setattr__(self, "v_0", np.broadcast_to(self.v_0, np.shape(self.values)))
        columns = {"v_0": "m/s", "cof": "", **({"error": ""} if self.error is not None else {})}
        columns |= {"values": ""} if self.over else {}
        for name, unit in columns.items():
            values = np.array(finite_array(name, getattr(self, name), unit), ndmin=1)
            if values.ndim != 1 or values.size != np.size(self.v_0) or not values.size:
                raise ValueError(f"{name} must be a list of as many numbers as v_0, got shape {values.shape}")
            object.__setattr__(self, name, values)
        if self.error is not None and np.any(self.error <= 0):
            raise ValueError(f"error must be positive, got {float(self.error.min())!r}; leave it out where not known")
        order = np.argsort(self.v_0 if self.values is None else self.values, kind="stable")
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
                *([] if self.values is None else [(self.over, span(self.values), "what was varied, in SI")]),
                ("COF", span(self.cof), "coefficients of friction"),
                ("error", error, "standard deviation of each"),
            ],
        )


def read_friction_data(
    path: str | PathLike[str],
    *,
    units: Units = None,
    columns: Columns = None,
    skip: int | None = None,
    table: int | str | None = None,
    v_0: float | None = None,
    radius: float | None = None,
) -> FrictionData:
    r"""Measured friction [-] over velocity, or over another number of the case, from a CSV file.

    Parameters
    ----------
    path : str or path-like
        The file. Its header names the columns and the unit of the velocity, `v_0 [mm/s], cof, error`; the last is
        optional. In the place of cof it may have the forces, `F_t [N], F_n [N]`: cof = F_t/F_n.
    units : dict of str, optional
        Unit of the velocity, where the header has none: {"v_0": "mm/s"}.
    columns : dict of str or int, optional
        What the header calls a column, {"cof": "Reibwert"}, or its number, from 1.
    skip : int, optional
        Lines above the header. None finds it.
    table : int or str, optional
        Which table of a file with several, from 1, or words above it.
    v_0 : float, optional
        The velocity [m/s] of all rows, in the place of its column, of a file of friction over du_x, du_y, du_z, u_z0,
        load or frequency: `du_x [um], cof`.
    radius : float, optional
        Radius of the track [m], where the velocity is a turning speed, in rpm or rad/s.

    Returns
    -------
    FrictionData
        Velocities in m/s, ascending; or what was varied, ascending.

    Raises
    ------
    ValueError
        With file and line of what is wrong.

    Warns
    -----
    PlausibilityWarning
        Of columns that may be the error, where none is named so, and of the mean load where the file has forces.

    Examples
    --------
    >>> from pathlib import Path
    >>> import mdr
    >>> _ = Path("measured.csv").write_text("v_0 [mm/s], cof\n0.5, 0.31\n1.0, 0.35\n")
    >>> mdr.read_friction_data("measured.csv").v_0
    array([0.0005, 0.001 ])
    >>> _ = Path("shaken.csv").write_text("du_x [um], cof\n0, 0.31\n1.0, 0.15\n")
    >>> mdr.read_friction_data("shaken.csv", v_0=1e-3).values
    array([0.e+00, 1.e-06])
    """
    if v_0 is not None and radius is not None:
        raise ValueError("radius is of a column of turning speeds, and v_0= the velocity of all rows: give one")
    over = OVER if v_0 is not None else (VELOCITY if radius is None else TURNING,)
    read = read_table(path, (*over, *FRICTION), Reading(units, columns, skip, table))
    found, varied = read.values, ""
    if v_0 is not None:
        kinds = [(one,) for one in OVER]
        varied = read.one_of(kinds, "nothing that is varied", "du_x [um], cof", "du_x")[0].name
    cof = found["cof"] if "cof" in found else _of_forces(read)
    if "error" not in found and "error" not in (columns or {}):
        _look_for_errors(read, cof)
    if v_0 is not None:
        velocity = np.full(cof.shape, finite("v_0", v_0))
    else:
        velocity = found["v_0"] * (1 if radius is None else positive("radius", radius, "of the track in m"))
    try:
        return FrictionData(velocity, cof, found.get("error"), varied, found.get(varied))
    except ValueError as refusal:
        raise read.fault(str(refusal)) from None


def _of_forces(table: Table) -> Array:
    """F_t/F_n, with the mean load, which is told."""
    F_t, F_n = table.values["F_t"], table.values["F_n"]
    table.require(F_n > 0, "F_n presses and must be positive")
    load = f"the mean load is {F_n.mean():.4g} N, of {F_n.min():.4g} to {F_n.max():.4g} N"
    warn_outside(f"{table.source}: cof = F_t/F_n is taken; {load}")
    return np.asarray(F_t / F_n)


def _look_for_errors(table: Table, cof: Array) -> None:
    """Warn of columns that may be the error, where none is named so."""
    maybe = []
    for name in table.header.unread:
        again = table.reading._replace(columns={**(table.reading.columns or {}), "error": name})
        error = table.again(table.header.columns, again).get("error", 0.0)
        if np.all((error > 0) & (error < cof)):
            maybe.append(name)
    if maybe:
        say = f'columns={{"error": "{maybe[0]}"}}'
        warn_outside(f"{table.source}: no error is known; if {' or '.join(maybe)} is that of the COF, say {say}")
