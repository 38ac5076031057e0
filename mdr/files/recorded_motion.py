"""Recorded motion, velocity and acceleration over time in a CSV file."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import partial
from os import PathLike
from typing import Any

import numpy as np

from mdr.files.force_curves import HEIGHTS
from mdr.files.measurements import read_table
from mdr.tools.arrays import Array
from mdr.tools.checks import positive
from mdr.tools.csv_header import Column, Columns, Reading, Units
from mdr.tools.csv_table import Table, warn_of_size
from mdr.tools.messages import short
from mdr.tools.notation import GRAVITY, is_number, parted, scale_of, shown
from mdr.tools.warned import warn_outside

FASTEST = (0.0, 1e7)  #: acceleration [m/s²], of 100 µm at 50 kHz
FAST = (0.0, 1e3)  #: velocity [m/s]
UNEVEN = 0.1  #: share of a step that times may be off even ones
TIME = Column("t", ("time", "elapsed time", "timestamp"), "s", lone=True, instead="rate=, in Hz, for even steps")
WAYS = ("displacement", "disp", "position", "way", "u")  #: along the slide, or into the half-space
OF_SLIDE = ("friction", "tangential", "lateral", "COF", "reciprocat", "slid")  #: words of a tribometer


def _along(letter: str, unit: str, words: tuple[str, ...], axis: str, *more: str, **rules: Any) -> Column:
    """A component; the letter of its axis alone is a name too, which a unit tells from a position."""
    names = [f"{word} {axis}" for word in words] + [f"{axis} {word}" for word in (*words, f"axis {words[0]}")]
    return Column(f"{letter}_{axis}", (axis, f"{axis} axis", *names, *more), unit, needed=False, **rules)


_ACCELERATED = ("acceleration", "linear acceleration", "accelerometer", "accel", "acc")
_a = partial(_along, "a", "m/s²", _ACCELERATED, likely=FASTEST)
_v = partial(_along, "v", "m/s", ("velocity", "vibration velocity"), likely=FAST)
MOTION = (
    TIME,
    Column("u_x", ("x",), "m", needed=False, doubtful=(*WAYS, "stroke", "travel"), beside=OF_SLIDE),
    Column("u_y", ("y",), "m", needed=False),
    Column("u_z", ("depth", "indentation"), "m", needed=False, likely=(0.0, 0.01), doubtful=(*WAYS, *HEIGHTS)),
    Column("F_z", ("F_N", "normal force", "load"), "N", needed=False),
    _a("x"),
    _a("y"),
    _a("z", "a", "acceleration", "accel", "acc", lone=True),
    _v("x", doubtful=("v", "velocity", "speed", "sliding velocity"), beside=OF_SLIDE),
    _v("y"),
    _v("z", doubtful=("v", "velocity", "speed")),
)


def read_record(
    path: str | PathLike[str],
    *,
    units: Units = None,
    columns: Columns = None,
    skip: int | None = None,
    table: int | str | None = None,
    rate: float | None = None,
    sensitivity: str | Mapping[str, str] | None = None,
) -> dict[str, Array]:
    r"""A recorded motion, velocity or acceleration in SI, from a CSV file.

    Parameters
    ----------
    path : str or path-like
        The file. Its header names the time t and at least one of u_x, u_y, u_z (or depth), F_z, v_x, v_y, v_z, a_x,
        a_y, a_z (or a, acceleration), with their units: `t [ms], a [g]`.
    units : dict of str, optional
        Units of columns whose header has none, such as {"t": "s", "a_z": "m/s²"}.
    columns : dict of str or int, optional
        What the header calls a column, such as {"a_z": "Kanal 1"}, or its number, from 1.
    skip : int, optional
        Lines above the header. None finds it.
    table : int or str, optional
        Which table of a file with several, from 1, or words above it.
    rate : float, optional
        Samples a second [Hz], in the place of t: times are even, from 0.
    sensitivity : str or dict of str, optional
        Of a sensor whose voltage was recorded: "100 mV/g", "125 mm/s/V"; or of each, {"a_x": "99 mV/g", ...}.

    Returns
    -------
    dict of ndarray
        The columns that the file has, by the names above: times in s, positions and depths in m, forces in N,
        velocities in m/s, accelerations in m/s². Depths, v_z and a_z are positive into the half-space.

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
    displacement_of : integrates an acceleration or a velocity.
    PeriodicMotion.from_acceleration, PeriodicMotion.from_velocity, PeriodicMotion.from_displacement : a motion.

    Examples
    --------
    >>> from pathlib import Path
    >>> import mdr
    >>> _ = Path("shaker.csv").write_text("t [ms], a [g]\n0, 1\n0.5, -2\n")
    >>> record = mdr.read_record("shaker.csv")
    >>> print(record["t"], record["a_z"])
    [0.     0.0005] [  9.80665 -19.6133 ]
    """
    per_volt = {} if sensitivity is None else _per_volt(sensitivity)
    wanted = [one._replace(unit="V", likely=(0, math.inf)) if one.name in per_volt else one for one in MOTION]
    found = read_table(path, wanted[rate is not None :], Reading(units, columns, skip, table))
    record = found.values
    if not record.keys() - {"t"}:
        raise _nothing(found)
    for column in MOTION:
        if column.name in per_volt and column.name in record:
            record[column.name] *= per_volt[column.name]
            warn_of_size(column.name, float(np.abs(record[column.name]).max()), column.likely, column.unit)
    idle = sorted(per_volt.keys() - record.keys())
    if idle and (not isinstance(sensitivity, str) or idle == sorted(per_volt)):
        raise found.fault(f"sensitivity has no effect: the file has no {' and no '.join(idle)} in V")
    if rate is not None:
        record = {"t": counted(found, TIME, 1 / positive("rate", rate, "in Hz"), "rate"), **record}
    elif np.any(falls := np.diff(record["t"]) < 0):
        raise found.fault(f"t falls in line {found.lines[int(np.argmax(falls)) + 1]}: put the samples in order")
    record["t"] = _evened(record["t"], found.source)
    _doubt_units(record)
    return record


def _nothing(table: Table) -> ValueError:
    """The error of a file with no motion by its name; what its units may be is told."""
    said, meant, volts, header = "", [], "", table.header
    for i in header.free():
        head = header.heads[i]
        if scale_of(head.unit, "V") is not None:
            sensor = f'columns={{"a_z": {header.word_for(i)}}}, sensitivity="100 mV/g", or what it is'
            volts = volts or f"{short(head.whole)} is a voltage: say of which quantity, such as {sensor}"
        elif names := [one.name for one in MOTION[1:] if one.measured_in(head.unit)]:
            said += f"; {short(head.whole)} may be {', '.join(names)}"
            meant += [one for one in names if one[-1] in head.axes] or names[-1:]
    if volts and not said:
        return table.fault(volts)
    example = f"t [s], a [m/s²], or t [s], u_x [um], u_z [um]{said}"
    return table.lacks("a time, and nothing else by a name known here", example, *(meant or ["a_z"]))


def _per_volt(sensitivity: str | Mapping[str, str]) -> dict[str, float]:
    """What a volt means of each column that is measured by a sensor."""
    if isinstance(sensitivity, str):
        unit, value = _meaning(sensitivity)
        return {one.name: value for one in MOTION if one.unit == unit}
    if not isinstance(sensitivity, Mapping):
        raise TypeError(f'sensitivity must be a text, "100 mV/g", or a dict of such, got {sensitivity!r}')
    found, units = {}, {one.name: one.unit for one in MOTION if one is not TIME}
    for name, text in sensitivity.items():
        unit, found[name] = _meaning(text)
        if units.get(name) != unit:
            raise ValueError(f"sensitivity: {name} is measured in {units.get(name, 'nothing here')}, got {text!r}")
    return found


def _meaning(text: str) -> tuple[str, float]:
    """Unit and size of what a volt means, of a sensitivity as mV/g or mm/s/V."""
    number, symbol = parted(str(text))
    first, _, last = symbol.partition("/")
    volts, signal = scale_of(first, "V"), last.strip("( )")
    if is_per_volt := volts is None:
        signal, _, last = symbol.rpartition("/")
        signal, volts = signal.strip("( )"), scale_of(last, "V")
    unit = next((one for one in ("m/s²", "m/s", "m", "N") if scale_of(signal, one) is not None), "")
    if not (volts and unit and is_number(number) and float(number)):
        raise ValueError(f'sensitivity must be as "100 mV/g", "10 mV/(m/s²)", "125 mm/s/V" or "2 um/V", got {text!r}')
    scale = (scale_of(signal, unit) or 1.0) / volts
    return unit, scale * float(number) if is_per_volt else scale / float(number)


def counted(table: Table, column: Column, step: float, word: str) -> Array:
    """Even values in the place of a column. Warns where the file has some that go on by another step than is said."""
    name = column.name
    own = table.again((column,), table.reading._replace(units=None, columns=None)).get(name, np.zeros(1))
    taken, said = float(np.ptp(own)), step * (own.size - 1)
    rounded = np.diff(np.unique(own)).min(initial=np.inf)
    if abs(taken - said) - rounded > 0.01 * said:
        spans = f"over {shown(taken, column.unit)}, at this {word} over {shown(said, column.unit)}"
        warn_outside(f"{table.source}: its {name} goes {spans}: the {word} is taken")
    return np.asarray(step * np.arange(len(table.lines)))


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
