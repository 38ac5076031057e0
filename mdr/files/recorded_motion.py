"""Recorded motion and acceleration over time in a CSV file."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from contextlib import suppress
from os import PathLike
from typing import Any

import numpy as np

from mdr.files.measurements import read_table
from mdr.tools.arrays import Array
from mdr.tools.checks import positive
from mdr.tools.csv_header import Column
from mdr.tools.csv_table import Columns, Reading, Table, Units, table_of
from mdr.tools.notation import GRAVITY
from mdr.tools.warned import warn_outside

FASTEST = (0.0, 1e7)  #: acceleration [m/s²], of 100 µm at 50 kHz
UNEVEN = 0.1  #: share of a step that times may be off even ones
TIME = Column("t", ("time", "elapsed time", "timestamp"), "s", lone=True, instead="rate=, in Hz, for even steps")


def _acceleration(axis: str, *names: str) -> Column:
    """A component; its letter alone is a name too, which a unit tells from a position."""
    words = [f"{word} {axis}" for word in ("acceleration", "linear acceleration", "accelerometer", "accel", "acc")]
    words += [f"{axis} axis", f"{axis} acceleration", f"{axis} axis acceleration"]
    return Column(f"a_{axis}", (axis, *words, *names), "m/s²", needed=False, lone=axis == "z", likely=FASTEST)


MOTION = (
    TIME,
    Column("u_x", ("x",), "m", needed=False),
    Column("u_y", ("y",), "m", needed=False),
    Column("u_z", ("z", "u", "depth", "displacement"), "m", needed=False, likely=(0.0, 0.01)),
    Column("F_z", ("F_N", "normal force", "load"), "N", needed=False),
    _acceleration("x"),
    _acceleration("y"),
    _acceleration("z", "a", "acceleration", "accel", "acc"),
)


def read_record(
    path: str | PathLike[str],
    *,
    units: Units = None,
    columns: Columns = None,
    skip: int | None = None,
    rate: float | None = None,
) -> dict[str, Array]:
    r"""A recorded motion or acceleration in SI, from a CSV file.

    Parameters
    ----------
    path : str or path-like
        The file. Its header names the time t and at least one of u_x, u_y, u_z (or u, displacement), F_z, a_x, a_y,
        a_z (or a, acceleration), with their units: `t [ms], a [g]`.
    units : dict of str, optional
        Units of columns whose header has none, such as {"t": "s", "a_z": "m/s²"}.
    columns : dict of str or int, optional
        What the header calls a column, such as {"a_z": "Kanal 1"}, or its number, from 1.
    skip : int, optional
        Lines above the header. None finds it.
    rate : float, optional
        Samples a second [Hz], in the place of t: times are even, from 0.

    Returns
    -------
    dict of ndarray
        The columns that the file has, by the names above: times in s, positions and depths in m, forces in N,
        accelerations in m/s². Depths and a_z are positive into the half-space.

    Raises
    ------
    ValueError
        With all that is wrong, and what to give so that the file is read as it is.

    Warns
    -----
    PlausibilityWarning
        Of a guess: even times for rounded ones, a column for its unit alone, letters that are not UTF-8. And where the
        file has times that go on by another step than `rate` says.

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
    wanted = MOTION if rate is None else tuple(one for one in MOTION if one is not TIME)
    step = None if rate is None else 1 / positive("rate", rate, "in Hz")
    table = read_table(path, wanted, Reading(units, columns, skip))
    record = table.values
    if not record.keys() - {"t"}:
        what, example = "a time, and nothing else by a name known here", "t [s], a [m/s²], or t [s], u_x [um], u_z [um]"
        raise table.lacks(what, example, "a_x", "a_y", "a_z")
    if step is not None:
        _doubt_rate(table, Reading(_of_time(units), _of_time(columns), skip), step)
        record = {"t": np.asarray(step * np.arange(len(table.lines))), **record}
    elif np.any(falls := np.diff(record["t"]) < 0):
        raise table.fault(f"t falls in line {table.lines[int(np.argmax(falls)) + 1]}: put the samples in order")
    record["t"] = _evened(record["t"], table.source)
    _doubt_units(record)
    return record


def _doubt_rate(table: Table, reading: Reading, step: float) -> None:
    """Warn where a file has times of its own that go on by another step [s], by more than they are rounded."""
    t = np.zeros(1)
    with suppress(ValueError), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        t = table_of(table.text, table.source, (TIME,), reading).values["t"]
    taken, rounded, n = float(np.ptp(t)), np.diff(np.unique(t)).min(initial=np.inf), t.size - 1
    if abs(taken - step * n) - rounded > 0.01 * step * n:
        what = f"its times last {taken:.4g} s, at this rate {step * n:.4g} s: the rate is taken"
        warn_outside(f"{table.source}: {what}")


def _of_time(given: Mapping[str, Any] | None) -> dict[str, Any]:
    return {key: value for key, value in (given or {}).items() if key == "t"}


def _evened(t: Array, source: str) -> Array:
    """Even times for those that are even but for rounding to a decimal place, which is told; else the same."""
    from scipy.optimize import minimize_scalar

    if t.size < 4:
        return t
    steps = np.diff(t)
    places = next((k for k in range(10) if np.allclose(t * 10.0**k, np.round(t * 10.0**k), rtol=0, atol=1e-6)), None)
    # one step, or two, that differ may be a sample that was lost
    if places is None or np.sum(np.abs(steps - np.median(steps)) > UNEVEN * np.mean(steps)) < 3:
        return t
    n, place, slope = np.arange(t.size), 10.0**-places, float(np.mean(steps))
    bounds, fine = (slope - 2 * place / t.size, slope + 2 * place / t.size), {"xatol": 1e-5 * place / t.size}
    slope = float(minimize_scalar(lambda s: np.ptp(t - s * n), bounds=bounds, method="bounded", options=fine).x)
    off = t - slope * n
    if np.ptp(off) > place * (1 + 1e-4):  # as near as the slope is found
        return t
    warn_outside(f"{source}: t is rounded to {place:g} s: even steps of {slope:.6g} s are taken")
    return np.asarray((off.min() + off.max()) / 2 + slope * n)


def _doubt_units(record: Mapping[str, Array]) -> None:
    """Warn where gravity, or the pace of the samples, says that an acceleration or the time is in another unit."""
    with np.errstate(over="ignore"):
        mean = math.hypot(*(float(np.mean(record[name])) for name in ("a_x", "a_y", "a_z") if name in record))
    for scale, meant in ((1 / GRAVITY, "g and not m/s²"), (GRAVITY, "m/s² and not g"), (1e3, "mg and not g")):
        if abs(mean / (scale * GRAVITY) - 1) < 0.02:  # a mean that is gravity
            warn_outside(f"the mean acceleration is {mean:.4g} m/s², and gravity {GRAVITY:.4g}: is it in {meant}?")
    step = float(np.median(np.diff(record["t"]))) if record["t"].size > 2 else 0.0
    if mean and step >= 0.5:  # such samples show no vibration
        warn_outside(f"accelerations at steps of {step:.4g} s: is the time in ms, or the number of the sample?")
