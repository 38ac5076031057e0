"""Relaxation and creep in CSV files: moduli, or compliances, over the time since a step."""

from __future__ import annotations

from os import PathLike
from typing import NamedTuple

from mdr.files.measurements import LIKELY_MODULUS, read_table, stretch_of
from mdr.tools.arrays import Array
from mdr.tools.csv_header import Column, Columns, Reading, Units

LIKELY = (1 / LIKELY_MODULUS[1], 1 / LIKELY_MODULUS[0])
TIME = Column("t", ("time", "step time", "time since the step"), "s", lone=True)
RELAXATION = (
    TIME,
    Column("E", ("E(t)", "Young's modulus", "tensile relaxation modulus"), "Pa", needed=False, likely=LIKELY_MODULUS),
    Column("G", ("G(t)", "shear relaxation modulus"), "Pa", needed=False, likely=LIKELY_MODULUS),
)
CREEP = (
    TIME,
    Column("D", ("D(t)", "tensile compliance", "tensile creep compliance"), "1/Pa", needed=False, likely=LIKELY),
    Column("J", ("J(t)", "shear compliance", "shear creep compliance"), "1/Pa", needed=False, likely=LIKELY),
)


class Relaxation(NamedTuple):
    """A relaxation, arrays of shape (n,), as `Prony.fit_relaxation` takes it."""

    t: Array  #: times since the step [s]
    modulus: Array  #: Young's modulus E(t) [Pa]


class Creep(NamedTuple):
    """A creep, arrays of shape (n,), as `Prony.fit_creep` takes it."""

    t: Array  #: times since the step [s]
    compliance: Array  #: tensile compliance D(t) [1/Pa]


def read_relaxation(
    path: str | PathLike[str],
    *,
    nu: float | None = None,
    units: Units = None,
    columns: Columns = None,
    skip: int | None = None,
    table: int | str | None = None,
) -> Relaxation:
    r"""Modulus [Pa] over the time since a step of strain, from a CSV file, for `Prony.fit_relaxation`.

    Parameters
    ----------
    path : str or path-like
        The file. Its header names the time t and the modulus E: `t [s], E [MPa]`.
    nu : float, optional
        Poisson's ratio [-]. Only a shear modulus needs it, a column G: E = 2 (1 + nu) G.
    units : dict of str, optional
        Units of columns whose header has none: {"t": "s", "E": "MPa"}.
    columns : dict of str or int, optional
        What the header calls a column, {"E": "Er"}, or its number, from 1.
    skip : int, optional
        Lines above the header. None finds it.
    table : int or str, optional
        Which table of a file with several, from 1, or words above it.

    Returns
    -------
    Relaxation
        Times in s, E(t) in Pa.

    Raises
    ------
    ValueError
        With all that is wrong, and what to give so that the file is read as it is.

    Examples
    --------
    >>> from pathlib import Path
    >>> import mdr
    >>> _ = Path("relaxation.csv").write_text("t [s], E [MPa]\n0.1, 3\n1, 2\n10, 1.5\n")
    >>> mdr.read_relaxation("relaxation.csv").modulus
    array([3000000., 2000000., 1500000.])
    """
    return Relaxation(*_over_time(path, RELAXATION, nu, Reading(units, columns, skip, table)))


def read_creep(
    path: str | PathLike[str],
    *,
    nu: float | None = None,
    units: Units = None,
    columns: Columns = None,
    skip: int | None = None,
    table: int | str | None = None,
) -> Creep:
    r"""Compliance [1/Pa] over the time since a step of stress, from a CSV file, for `Prony.fit_creep`.

    Parameters
    ----------
    path : str or path-like
        The file. Its header names the time t and the tensile compliance D: `t [s], D [1/MPa]`.
    nu : float, optional
        Poisson's ratio [-]. Only a shear compliance needs it, a column J: D = J/(2 (1 + nu)).
    units : dict of str, optional
        Units of columns whose header has none: {"t": "s", "D": "1/MPa"}.
    columns : dict of str or int, optional
        What the header calls a column, {"D": "Nachgiebigkeit"}, or its number, from 1.
    skip : int, optional
        Lines above the header. None finds it.
    table : int or str, optional
        Which table of a file with several, from 1, or words above it.

    Returns
    -------
    Creep
        Times in s, D(t) in 1/Pa.

    Raises
    ------
    ValueError
        With all that is wrong, and what to give so that the file is read as it is.

    Examples
    --------
    >>> from pathlib import Path
    >>> import mdr
    >>> _ = Path("creep.csv").write_text("t [s], J [1/MPa]\n0.1, 1\n1, 1.5\n10, 2\n")
    >>> print(mdr.read_creep("creep.csv", nu=0.5).compliance * 3e6)
    [1.  1.5 2. ]
    """
    return Creep(*_over_time(path, CREEP, nu, Reading(units, columns, skip, table)))


def _over_time(
    path: str | PathLike[str], columns: tuple[Column, Column, Column], nu: float | None, reading: Reading
) -> tuple[Array, Array]:
    """Times, and the tensile value of one of two columns, in tension and in shear."""
    table = read_table(path, columns, reading)
    time, tensile, shear = columns
    example = f"{time.example}, {tensile.example}, or {shear.name} of shear"
    kinds = (tensile,), (shear,)
    kind = table.one_of(kinds, f"no {tensile.name}", example, tensile.name)
    t, values = table.values["t"], table.values[kind[0].name]
    table.require(t >= 0, "t counts from the step and must not be negative")
    table.require(values > 0, f"{kind[0].name} must be positive")
    stretch = stretch_of(table, kind, kinds, nu)
    return t, values * stretch if shear.unit == "Pa" else values / stretch
