"""Measurements in CSV files: points of a profile, dynamic moduli, recorded motion.

Each file has a header that names its columns and their units (`mdr.tools.csv_table`); `units` gives those that a header
lacks, `columns` what it calls a column, or its number. Force over depth is read in
`force_curves`, relaxation and creep in `step_tests`, friction over velocity in `mdr.friction.friction_data`.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence
from contextlib import suppress
from os import PathLike, fsdecode
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.files.toml_text import read_bytes
from mdr.materials.base import poisson_ratio
from mdr.materials.prony_fit import ONE, TOLD, twice
from mdr.tools.arrays import EPS, SAME, Array
from mdr.tools.checks import finite, positive
from mdr.tools.csv_header import Column
from mdr.tools.csv_layout import decoded
from mdr.tools.csv_table import Columns, Reading, Table, Units, table_of
from mdr.tools.notation import GRAVITY, ZEROS
from mdr.tools.warned import warn_outside

LIKELY_MODULUS = (200.0, 2e12)  #: [Pa], from soft gels to beyond diamond
FASTEST = (0.0, 1e7)  #: acceleration [m/s²], of 100 µm at 50 kHz
UNEVEN = 0.1  #: share of a step that times may be off even ones
MOST_SHIFTED = 15.0  #: decades by which a frequency is shifted up
WITHIN = 0.5  #: [K], that readings at one temperature may be off it
MOST_BYTES = 2**27  #: of a table
PROFILE = (
    Column("r", ("x", "radius", "position", "distance", "lateral", "X position", "length"), "m", likely=(1e-10, 1.0)),
    Column("f", ("h", "z", "height", "profile", "total profile", "raw height"), "m", likely=(0.0, 1.0)),
)
TAN_DELTA = ("tan(delta)", "tan δ", "tan(δ)", "tan d", "loss tangent", "loss factor", "damping", "damping factor")
MODULI = (
    Column("omega", ("ω", "w", "f", "frequency", "freq", "angular frequency"), "rad/s", lone=True),
    Column("storage", ("E'", "storage modulus"), "Pa", needed=False, likely=LIKELY_MODULUS),
    Column("loss", ("E''", "loss modulus"), "Pa", needed=False),
    Column("|E*|", ("|E|", "E*", "complex modulus", "dynamic modulus"), "Pa", needed=False, likely=LIKELY_MODULUS),
    Column("tan_delta", TAN_DELTA, needed=False, likely=(0.0, 5.0)),
    Column("G'", ("shear storage modulus",), "Pa", needed=False, likely=LIKELY_MODULUS),
    Column("G''", ("shear loss modulus",), "Pa", needed=False),
    Column("T", ("temperature", "temp"), "K", needed=False, likely=(100.0, 2000.0)),
)
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


class DynamicModuli(NamedTuple):
    """Dynamic moduli of a material over frequency, arrays of shape (n,), as `Prony.fit` takes them."""

    omega: Array  #: angular frequencies [rad/s]
    storage: Array  #: storage modulus E' [Pa]
    loss: Array  #: loss modulus E'' [Pa]


def read_table(path: str | PathLike[str], columns: Sequence[Column], reading: Reading) -> Table:
    """The columns in a CSV file."""
    text, said = decoded(read_bytes(path, MOST_BYTES, "table"))
    return table_of(text, fsdecode(path), columns, reading, said)


def read_moduli(
    path: str | PathLike[str],
    *,
    nu: float | None = None,
    temperature: float | None = None,
    wlf: tuple[float, float] | None = None,
    units: Units = None,
    columns: Columns = None,
    skip: int | None = None,
) -> DynamicModuli:
    r"""Dynamic moduli [Pa] over frequency from a CSV file, for `Prony.fit`.

    Parameters
    ----------
    path : str or path-like
        The file. Its header names the frequency (in Hz or rad/s), the storage modulus E', and the loss modulus E'' or
        tan delta: `f [Hz], E' [MPa], tan delta`; or the complex modulus `|E*|` and tan delta.
    nu : float, optional
        Poisson's ratio [-]. Only shear moduli need it, columns G' and G'': E = 2 (1 + nu) G.
    temperature : float, optional
        Temperature [°C] whose rows are taken, those within 0.5 K, of a file with several in a column T.
    wlf : (float, float), optional
        C1 [-] and C2 [K] of the equation of Williams, Landel and Ferry (1955) about `temperature`: the rows of all
        temperatures are taken, their frequencies shifted to it, omega 10**(-C1 dT/(C2 + dT)).
    units : dict of str, optional
        Units of columns whose header has none, such as {"omega": "Hz", "storage": "MPa"}.
    columns : dict of str or int, optional
        What the header calls a column, such as {"storage": "Speichermodul"}, or its number, from 1; the columns are
        omega, storage, loss, tan_delta, `|E*|`, G', G'' and T. An empty name leaves a column out: {"T": ""} of a
        master curve, whose frequencies are shifted to one temperature.
    skip : int, optional
        Lines above the header. None finds it.

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
    table = read_table(path, MODULI, Reading(units, columns, skip))
    found = table.values
    of_shear, stretch = "storage" not in found and "G'" in found, 1.0
    if of_shear:
        if nu is None:
            raise table.fault("shear moduli G' and G'' need Poisson's ratio, as E = 2 (1 + nu) G: give nu=")
        stretch = 2 * (1 + poisson_ratio("nu", nu))
    storage, loss = (found.get(name) for name in (("G'", "G''") if of_shear else ("storage", "loss")))
    if storage is None and "|E*|" in found and "tan_delta" in found:
        storage = found["|E*|"] / np.hypot(1, found["tan_delta"])
    if storage is None:
        raise table.lacks("no storage modulus", "f [Hz], E' [MPa], E'' [MPa]", "storage", "loss")
    if loss is None and "tan_delta" not in found:
        raise table.lacks("neither E'' nor tan delta", "f [Hz], E' [MPa], tan delta", "loss")
    for name, values in {"frequency": found["omega"], "storage modulus": storage}.items():
        require_rows(table, values > 0, f"{name} must be positive")
    if loss is not None and "tan_delta" in found:
        _require_same(table, loss / storage, found["tan_delta"])
    loss = storage * found["tan_delta"] if loss is None else loss
    sign = "" if np.any(loss > 0) else "; all are: turn the sign of the column"
    require_rows(table, loss >= 0, f"loss must not be negative{sign}")
    if wlf is None:
        taken = _at_temperature(table, temperature)
        omega, modulus = found["omega"][taken], stretch * (storage + 1j * loss)[taken]
        _look_for_repeats(table, taken, omega, modulus, temperature is not None or "T" in (columns or {}))
    else:
        omega, modulus = found["omega"] * _shift(table, temperature, wlf), stretch * (storage + 1j * loss)
    order = np.argsort(omega, kind="stable")
    return DynamicModuli(omega[order], modulus.real[order], modulus.imag[order])


def _shift(table: Table, temperature: float | None, wlf: Any) -> Array:
    """What the frequency of each row is multiplied by, to be one at a temperature [°C]."""
    if temperature is None or "T" not in table.values:
        lack = 'a column T, such as "T [degC]"' if "T" not in table.values else "temperature=, in °C"
        raise table.fault(f"wlf shifts all rows to one temperature: give {lack}")
    if np.shape(wlf) != (2,):
        raise TypeError(f"wlf must be C1 [-] and C2 [K], such as (17.4, 51.6), got {wlf!r}")
    C_1, C_2 = positive("C1 of wlf", wlf[0]), positive("C2 of wlf", wlf[1], "in K")
    warmer = _celsius(table) - finite("temperature", temperature, "in °C")
    far = f"T is too far below temperature = {temperature:.6g} degC for these constants, a glass: leave such rows out"
    require_rows(table, (C_2 + warmer > 0) & (C_1 * -warmer < MOST_SHIFTED * (C_2 + warmer)), far)
    return np.asarray(10 ** (-C_1 * warmer / (C_2 + warmer)))


def _celsius(table: Table) -> Array:
    """The temperatures in °C."""
    require_rows(table, table.values["T"] > 0, "T must be above 0 K (is it in degC?)")
    return table.values["T"] - ZEROS["degC"]


def _at_temperature(table: Table, temperature: float | None) -> NDArray[np.intp]:
    """The rows of one temperature [°C]. Refused where it must be chosen, or is not there."""
    if temperature is not None:
        temperature = finite("temperature", temperature, "in °C")
    if "T" not in table.values:
        if temperature is not None:
            raise table.lacks("no temperature", "f [Hz], T [degC], E' [MPa], E'' [MPa]", "T")
        return np.arange(len(table.lines))
    T = _celsius(table)
    known = np.sort(T)
    there = ", ".join(f"{part.mean():.6g}" for part in np.split(known, np.flatnonzero(np.diff(known) > WITHIN) + 1))
    if temperature is None:
        if np.ptp(T) > 2 * WITHIN:
            example = f"temperature={T[0]:.4g}"
            master = 'of a master curve, shifted to one, leave the column out, columns={"T": ""}'
            raise table.fault(f"moduli at several temperatures, {there} degC: choose one, {example}; {master}")
        return np.arange(T.size)
    if not np.any(near := np.abs(T - temperature) <= WITHIN * (1 + SAME)):
        raise table.fault(f"no moduli within {WITHIN:g} K of temperature = {temperature:.6g} degC; there are {there}")
    if np.any(beside := ~near & (np.abs(T - temperature) <= 2 * WITHIN)):
        i, n = int(np.argmax(beside)), int(np.count_nonzero(beside))
        rows = f"line {table.lines[i]}{f' and {n - 1} more are' if n > 1 else ' is'} left out, at {T[i]:.6g} degC"
        warn_outside(f"{table.source}: {rows}, more than {WITHIN:g} K from temperature = {temperature:.6g} degC")
    return np.flatnonzero(near)


def _require_same(table: Table, ratio: Array, tan_delta: Array) -> None:
    """Refuse loss moduli that are not those of the loss tangent beside them: of either a unit is wrong, or the name."""
    off = np.abs(ratio - tan_delta) > TOLD * np.abs(tan_delta)
    if np.mean(off) > 0.5:
        i = int(np.argmax(off))
        raise table.fault(
            f"line {table.lines[i]}: loss/storage is {ratio[i]:.4g}, and tan_delta {tan_delta[i]:.4g}: a unit or a "
            'name is wrong; correct it, or leave one out, columns={"tan_delta": ""}'
        )


def _look_for_repeats(table: Table, taken: NDArray[np.intp], omega: Array, modulus: Any, is_one: bool) -> None:
    """Refuse a frequency that has two moduli, or warn of it where the temperature is known to be one."""
    if not (again := twice(omega, modulus)).size:
        return
    i = again[0]
    near = np.abs(omega / omega[i] - 1) <= ONE
    j = int(np.argmax(np.where(near, np.abs(modulus - modulus[i]), 0.0)))
    one, two = sorted((i, j))
    lines = " and ".join(str(table.lines[taken[k]]) for k in (one, two))
    values = " and ".join(f"{modulus[k].real:.4g}" for k in (one, two))
    what = f"lines {lines} have one frequency, {omega[i] / (2 * np.pi):.4g} Hz, and storage moduli {values} Pa"
    if is_one:
        warn_outside(f"{table.source}: {what}: give one sample, or the mean")
    else:
        column = 'name the column, columns={"T": ...}, and choose one, temperature=20'
        raise table.fault(f"{what}: if of several temperatures, {column}; else give one, or the mean")


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


def profile_points(
    path: str | PathLike[str], reading: Reading, apex: float, side: str, flip: bool
) -> tuple[Array, Array]:
    """Radii from 0 and heights [m] of one side of a scan across the tip, or of both laid upon one another."""
    if side not in ("both", "left", "right"):
        raise ValueError(f'side must be "both", "left" or "right", got {side!r}')
    table = read_table(path, PROFILE, reading)
    x, f = table.values["r"] - apex, table.values["f"] * (-1 if flip else 1)
    tiny = EPS**0.5 * float(np.max(np.abs(x)))  # two points that agree to half of their digits are one
    _refuse_repeated(table, x, tiny)
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


def require_rows(table: Table, good: NDArray[np.bool_], rule: str) -> None:
    """Refuse the first row that is not good."""
    if not np.all(good):
        i = int(np.argmin(good))
        row = ", ".join(f"{name} = {values[i]:.6g}" for name, values in table.values.items())
        raise table.fault(f"line {table.lines[i]}: {rule}, got {row} in SI")


def _refuse_repeated(table: Table, x: Array, tiny: float) -> None:
    order = np.argsort(x, kind="stable")
    again = np.flatnonzero(np.diff(x[order]) <= tiny)
    if again.size:
        one, two = sorted(table.lines[order[again[0] + k]] for k in (0, 1))
        r = table.values["r"][order[again[0]]]
        raise table.fault(f"lines {one} and {two} both have r = {r:.6g} m; give one, or their mean")
