"""Measurements in CSV files: points of a profile, force over depth, dynamic moduli, recorded motion.

Each file has a header that names its columns and their units (`mdr.tools.csv_table`); `units` gives those that a header
lacks, `columns` what it calls a column. Friction over velocity is read in `mdr.friction.friction_data`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike, fsdecode
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.files.toml_text import read_text
from mdr.materials.base import poisson_ratio
from mdr.tools.arrays import EPS, Array
from mdr.tools.csv_table import Column, Table, fault, table_of

Words = Mapping[str, str] | None

PROFILE = (
    Column("r", ("x", "radius", "position", "distance"), "m"),
    Column("f", ("h", "z", "height", "profile"), "m"),
)
FORCE = (
    Column("d", ("depth", "indentation", "displacement"), "m"),
    Column("F", ("F_N", "F_z", "force", "normal force", "load"), "N"),
)
MODULI = (
    Column("omega", ("ω", "w", "f", "frequency", "freq", "angular frequency"), "rad/s"),
    Column("storage", ("E'", "storage modulus"), "Pa", needed=False),
    Column("loss", ("E''", "loss modulus"), "Pa", needed=False),
    Column("tan_delta", ("tan(delta)", "tan δ", "tan(δ)", "loss tangent", "loss factor", "damping"), needed=False),
    Column("G'", ("shear storage modulus",), "Pa", needed=False),
    Column("G''", ("shear loss modulus",), "Pa", needed=False),
)
MOTION = (
    Column("t", ("time",), "s"),
    Column("u_x", ("x",), "m", needed=False),
    Column("u_y", ("y",), "m", needed=False),
    Column("u_z", ("z", "u", "depth", "displacement"), "m", needed=False),
    Column("F_z", ("F_N", "normal force", "load"), "N", needed=False),
    Column("a_x", (), "m/s²", needed=False),
    Column("a_y", (), "m/s²", needed=False),
    Column("a_z", ("a", "acceleration"), "m/s²", needed=False),
)


class DynamicModuli(NamedTuple):
    """Dynamic moduli of a material over frequency, arrays of shape (n,), as `Prony.fit` takes them."""

    omega: Array  #: angular frequencies [rad/s]
    storage: Array  #: storage modulus E' [Pa]
    loss: Array  #: loss modulus E'' [Pa]


def read_table(
    path: str | PathLike[str], columns: Sequence[Column], units: Words = None, called: Words = None
) -> Table:
    """The columns in a CSV file."""
    return table_of(read_text(path), fsdecode(path), columns, units=units, called=called)


def read_moduli(
    path: str | PathLike[str], *, nu: float | None = None, units: Words = None, columns: Words = None
) -> DynamicModuli:
    r"""Dynamic moduli [Pa] over frequency from a CSV file, for `Prony.fit`.

    Parameters
    ----------
    path : str or path-like
        The file. Its header names the frequency (in Hz or rad/s), the storage modulus E', and the loss modulus E'' or
        tan delta: `f [Hz], E' [MPa], tan delta`.
    nu : float, optional
        Poisson's ratio [-]. Only shear moduli need it, columns G' and G'': E = 2 (1 + nu) G.
    units : dict of str, optional
        Units of columns whose header has none, such as {"omega": "Hz", "storage": "MPa"}.
    columns : dict of str, optional
        What the header calls a column, such as {"storage": "Speichermodul"}; the columns are omega, storage, loss,
        tan_delta, G' and G''.

    Returns
    -------
    DynamicModuli
        Angular frequencies in rad/s, ascending, E' and E'' in Pa.

    Raises
    ------
    ValueError
        With file and line of what is wrong.

    Examples
    --------
    >>> from pathlib import Path
    >>> import mdr
    >>> _ = Path("moduli.csv").write_text("f [Hz], E' [MPa], tan delta\n1, 3.0, 0.1\n10, 4.0, 0.2\n")
    >>> moduli = mdr.read_moduli("moduli.csv")
    >>> print(moduli.storage, moduli.loss)
    [3000000. 4000000.] [300000. 800000.]
    >>> rubber = mdr.Prony.fit(*moduli, nu=0.5)
    """
    table = read_table(path, MODULI, units, columns)
    found = table.values
    of_shear, stretch = "storage" not in found and "G'" in found, 1.0
    if of_shear:
        if nu is None:
            raise table.fault("shear moduli G' and G'' need Poisson's ratio, as E = 2 (1 + nu) G: give nu=")
        stretch = 2 * (1 + poisson_ratio("nu", nu))
    storage, loss = (found.get(name) for name in (("G'", "G''") if of_shear else ("storage", "loss")))
    if storage is None:
        raise table.fault("the header names no storage modulus; write f [Hz], E' [MPa], E'' [MPa]")
    if loss is None and "tan_delta" not in found:
        raise table.fault("the header names neither E'' nor tan delta; write f [Hz], E' [MPa], tan delta")
    for name, values in {"frequency": found["omega"], "storage modulus": storage}.items():
        _require_rows(table, values > 0, f"{name} must be positive")
    loss = storage * found["tan_delta"] if loss is None else loss
    _require_rows(table, loss >= 0, "loss must not be negative")
    order = np.argsort(found["omega"], kind="stable")
    return DynamicModuli(found["omega"][order], stretch * storage[order], stretch * loss[order])


def read_record(path: str | PathLike[str], *, units: Words = None, columns: Words = None) -> dict[str, Array]:
    r"""A recorded motion or acceleration in SI, from a CSV file.

    Parameters
    ----------
    path : str or path-like
        The file. Its header names the time t and at least one of u_x, u_y, u_z (or u, displacement), F_z, a_x, a_y,
        a_z (or a, acceleration), with their units: `t [ms], a [g]`.
    units : dict of str, optional
        Units of columns whose header has none, such as {"t": "s", "a_z": "m/s²"}.
    columns : dict of str, optional
        What the header calls a column, such as {"a_z": "Kanal 1"}.

    Returns
    -------
    dict of ndarray
        The columns that the file has, by the names above: times in s, positions and depths in m, forces in N,
        accelerations in m/s². Depths and a_z are positive into the half-space.

    Raises
    ------
    ValueError
        With file and line of what is wrong.

    See Also
    --------
    slide_record : takes t, u_x, u_y, u_z and F_z by these names.
    displacement_of : integrates an acceleration.

    Examples
    --------
    >>> from pathlib import Path
    >>> import mdr
    >>> _ = Path("shaker.csv").write_text("t [ms], a [g]\n0, 1\n0.5, -2\n")
    >>> record = mdr.read_record("shaker.csv")
    >>> print(record["t"], record["a_z"])
    [0.     0.0005] [  9.80665 -19.6133 ]
    """
    table = read_table(path, MOTION, units, columns)
    if len(table.values) < 2:
        raise table.fault("the header names a time alone; write t [s], a [m/s²], or t [s], u_x [um], u_z [um]")
    return table.values


def profile_points(
    path: str | PathLike[str], units: Words, columns: Words, apex: float, side: str, flip: bool
) -> tuple[Array, Array]:
    """Radii from 0 and heights [m] of one side of a scan across the tip, or of both laid upon one another."""
    if side not in ("both", "left", "right"):
        raise ValueError(f'side must be "both", "left" or "right", got {side!r}')
    table = read_table(path, PROFILE, units, columns)
    x, f = table.values["r"] - apex, table.values["f"] * (-1 if flip else 1)
    tiny = EPS**0.5 * float(np.max(np.abs(x)))  # two points that agree to half of their digits are one
    _refuse_repeated(table, "r", x, tiny)
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


FARTHEST_ORIGIN = 3.0  #: first depth over the widest step, to which the point (0, 0) is added


def force_points(path: str | PathLike[str], units: Words, columns: Words, touch: float | None) -> tuple[Array, Array]:
    """Depths [m] from the first touch, and forces [N] at them, both from 0."""
    table = read_table(path, FORCE, units, columns)
    d, F = table.values["d"], table.values["F"]
    if np.all(F <= 0):
        raise table.fault("no force is above zero; compression must be positive, turn the sign of F")
    falls = np.flatnonzero(np.diff(d) <= 0)
    if falls.size:
        i = int(falls[0])
        where = f"{table.source}: line {table.lines[i + 1]}"
        raise fault(where, f"d must ascend, got {d[i + 1]:.6g} m after {d[i]:.6g} m; give the loading alone, sorted")
    if touch is not None:
        d, F = d[d >= touch] - touch, F[d >= touch]
    if d.size and d[0] < 0:
        raise table.fault(f"d = {d[0]:.6g} m is above the surface; give the depth of the first touch as touch=")
    if d.size > 1 and d[0] > FARTHEST_ORIGIN * float(np.diff(d).max()):
        raise table.fault(f"the first d is {d[0]:.6g} m, far from 0; give the depth of the first touch as touch=")
    if d.size and d[0] > 0:
        d, F = np.insert(d, 0, 0.0), np.insert(F, 0, 0.0)
    return d, F


def _require_rows(table: Table, good: NDArray[np.bool_], rule: str) -> None:
    """Refuse the first row that is not good."""
    if not np.all(good):
        i = int(np.argmin(good))
        row = ", ".join(f"{name} = {values[i]:.6g}" for name, values in table.values.items())
        raise fault(f"{table.source}: line {table.lines[i]}", f"{rule}, got {row} in SI")


def _refuse_repeated(table: Table, name: str, x: Array, tiny: float) -> None:
    order = np.argsort(x, kind="stable")
    again = np.flatnonzero(np.diff(x[order]) <= tiny)
    if again.size:
        one, two = sorted(table.lines[order[again[0] + k]] for k in (0, 1))
        value = table.values[name][order[again[0]]]
        raise table.fault(f"lines {one} and {two} both have {name} = {value:.6g} m; give one, or their mean")
