"""Measurements in CSV files: what reads a table, and dynamic moduli over frequency.

Each file has a header that names its columns and their units (`mdr.tools.csv_table`); `units` gives those that a header
lacks, `columns` what it calls a column, or its number. Motion over time is read in `recorded_motion`, points of a tip
in `profiles`, force over depth in
`force_curves`, relaxation and creep in `step_tests`, friction over velocity in `mdr.friction.friction_data`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from os import PathLike, fsdecode
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.files.toml_text import read_bytes
from mdr.materials.base import poisson_ratio
from mdr.materials.prony_fit import ONE, TOLD, twice
from mdr.tools.arrays import SAME, Array
from mdr.tools.checks import finite, positive
from mdr.tools.csv_header import Column, Columns, Reading, Units, fault, repr_of
from mdr.tools.csv_layout import decoded, kind_of
from mdr.tools.csv_table import Table, table_of
from mdr.tools.messages import MOST_TOLD
from mdr.tools.notation import ZEROS
from mdr.tools.warned import warn_outside

LIKELY_MODULUS = (200.0, 2e12)  #: [Pa], from soft gels to beyond diamond
MOST_SHIFTED = 15.0  #: decades by which a frequency is shifted up
WITHIN = 0.5  #: [K], that readings at one temperature may be off it
MOST_BYTES = 2**27  #: of a table
TAN_DELTA = ("tan(delta)", "tan δ", "tan(δ)", "tan d", "loss tangent", "loss factor", "damping", "damping factor")
#: words of an instrument by which its "storage modulus" is that of shear, or of tension
OF_SHEAR = ("torque", "viscosity", "shear", "rheometer", "plate")
OF_TENSION = ("DMA", "tension", "tensile", "bending", "cantilever", "Young")


def _moduli(beside: tuple[str, ...], way_out: str, *names: tuple[str, ...]) -> tuple[Column, ...]:
    """Storage, loss and absolute modulus of one way to load, which instruments call by the same words."""
    words = ("storage modulus",), ("loss modulus",), ("complex modulus", "dynamic modulus")
    sizes = LIKELY_MODULUS, (0.0, math.inf), LIKELY_MODULUS
    return tuple(
        Column(name, tuple(own), "Pa", needed=False, likely=size, beside=beside, doubtful=said, asked=way_out)
        for (name, *own), said, size in zip(names, words, sizes, strict=True)
    )


TENSION = _moduli(
    OF_TENSION, "", ("storage", "E'", "tensile storage modulus"), ("loss", "E''", "tensile loss modulus"),
    ("|E*|", "|E|", "E*"),
)  # fmt: skip
SHEAR = _moduli(
    OF_SHEAR, "of shear, give nu= too", ("G'", "shear storage modulus"), ("G''", "shear loss modulus"),
    ("|G*|", "|G|", "G*", "complex shear modulus"),
)  # fmt: skip
MODULI = (
    Column("omega", ("ω", "w", "f", "frequency", "freq", "angular frequency"), "rad/s", lone=True),
    *TENSION,
    *SHEAR,
    Column("tan_delta", TAN_DELTA, needed=False, likely=(0.0, 5.0)),
    Column("phase", ("phase angle", "phase shift", "phase lag", "loss angle", "δ", "delta"), "rad", needed=False),
    Column("T", ("temperature", "temp"), "K", needed=False, likely=(100.0, 2000.0)),
)


class DynamicModuli(NamedTuple):
    """Dynamic moduli of a material over frequency, arrays of shape (n,), as `Prony.fit` takes them."""

    omega: Array  #: angular frequencies [rad/s]
    storage: Array  #: storage modulus E' [Pa]
    loss: Array  #: loss modulus E'' [Pa]


def read_table(path: str | PathLike[str], columns: Sequence[Column], reading: Reading) -> Table:
    """The columns in a CSV file."""
    data = read_bytes(path, MOST_BYTES, "table")
    if kind := kind_of(data):
        raise fault(fsdecode(path), f"is {kind}")
    text, said = decoded(data)
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
    table: int | str | None = None,
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
    table : int or str, optional
        Which table of a file with several, from 1, or words above it.

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
    wanted = [one._replace(given="nu=") if nu is not None and one in SHEAR else one for one in MODULI]
    read = read_table(path, wanted, Reading(units, columns, skip, table))
    found = read.values
    example = "f [Hz], E' [MPa], E'' [MPa], or G', G'' of shear"
    kind = read.one_of((TENSION, SHEAR), "no storage modulus", example, "storage", "loss")
    stretch = stretch_of(read, kind, (TENSION, SHEAR), nu)
    storage, loss = _components(read, kind)
    for name, values in {"frequency": found["omega"], "storage modulus": storage}.items():
        read.require(values > 0, f"{name} must be positive")
    sign = "" if np.any(loss > 0) else "; all are: turn the sign of the column"
    read.require(loss >= 0, f"loss must not be negative{sign}")
    if wlf is None:
        taken = _at_temperature(read, temperature)
        omega, modulus = found["omega"][taken], stretch * (storage + 1j * loss)[taken]
        _look_for_repeats(read, taken, omega, modulus, temperature is not None or "T" in (columns or {}))
    else:
        omega, modulus = found["omega"] * _shift(read, temperature, wlf), stretch * (storage + 1j * loss)
    order = np.argsort(omega, kind="stable")
    return DynamicModuli(omega[order], modulus.real[order], modulus.imag[order])


def _components(table: Table, kind: Sequence[Column]) -> tuple[Array, Array]:
    """Storage and loss modulus of a kind, from what the file has of modulus, loss tangent and phase."""
    found = table.values
    storage, loss, absolute = (found.get(one.name) for one in kind)
    tangent = found.get("tan_delta")
    if tangent is None and "phase" in found:
        table.require((found["phase"] >= 0) & (found["phase"] < math.pi / 2), "phase must lie between 0 and 90 degrees")
        tangent = np.tan(found["phase"])
    if storage is None and absolute is not None and tangent is not None:
        storage = absolute / np.hypot(1, tangent)
    if storage is None:
        alone = next(one.name for one in kind if one.name in found)
        raise table.lacks(f"{alone} alone", "f [Hz], E' [MPa], E'' [MPa]", kind[0].name, kind[1].name)
    if tangent is None:
        if loss is None:
            raise table.lacks("neither loss modulus, tan delta nor phase", "f [Hz], E' [MPa], tan delta", kind[1].name)
        return storage, loss
    if loss is not None:
        _require_same(table, loss / storage, tangent)
    return storage, storage * tangent if loss is None else loss


def _shift(table: Table, temperature: float | None, wlf: Any) -> Array:
    """Shift factor of each row to the reference temperature [°C]: it multiplies the frequency."""
    if temperature is None or "T" not in table.values:
        lack = 'a column T, such as "T [degC]"' if "T" not in table.values else "temperature=, in °C"
        raise table.fault(f"wlf shifts all rows to one temperature: give {lack}")
    if np.shape(wlf) != (2,):
        raise TypeError(f"wlf must be C1 [-] and C2 [K], such as (17.4, 51.6), got {wlf!r}")
    C_1, C_2 = positive("C1 of wlf", wlf[0]), positive("C2 of wlf", wlf[1], "in K")
    warmer = _celsius(table) - finite("temperature", temperature, "in °C")
    far = f"T is too far below temperature = {temperature:.6g} degC for these constants, a glass: leave such rows out"
    table.require((C_2 + warmer > 0) & (C_1 * -warmer < MOST_SHIFTED * (C_2 + warmer)), far)
    return np.asarray(10 ** (-C_1 * warmer / (C_2 + warmer)))


def _celsius(table: Table) -> Array:
    """The temperatures in °C."""
    table.require(table.values["T"] > 0, "T must be above 0 K (is it in degC?)")
    return table.values["T"] - ZEROS["degC"]


def _at_temperature(table: Table, temperature: float | None) -> NDArray[np.intp]:
    """The rows of one temperature [°C]. Refused where it must be chosen, or is not there."""
    every = np.arange(len(table.lines))
    temperature = None if temperature is None else finite("temperature", temperature, "in °C")
    if "T" not in table.values:
        if temperature is not None:
            raise table.lacks("no temperature", "f [Hz], T [degC], E' [MPa], E'' [MPa]", "T")
        return every
    T = _celsius(table)
    known = np.sort(T)
    means = [part.mean() for part in np.split(known, np.flatnonzero(np.diff(known) > WITHIN) + 1)]
    few = 1 < len(means) <= MOST_TOLD
    there = ", ".join(f"{one:.6g}" for one in means) if few else f"{known[0]:.6g} to {known[-1]:.6g}"
    if temperature is None:
        if np.ptp(T) > 2 * WITHIN:
            example = f"temperature={T[0]:.4g}"
            master = 'of a master curve, shifted to one, leave the column out, columns={"T": ""}'
            raise table.fault(f"moduli at several temperatures, {there} degC: choose one, {example}; {master}")
        return every
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
    pair = sorted((i, int(np.argmax(np.where(near, np.abs(modulus - modulus[i]), 0.0)))))
    lines = " and ".join(str(table.lines[taken[k]]) for k in pair)
    values = " and ".join(f"{modulus[k].real:.4g}" for k in pair)
    what = f"lines {lines} have one frequency, {omega[i] / (2 * np.pi):.4g} Hz, and storage moduli {values} Pa"
    if is_one:
        warn_outside(f"{table.source}: {what}: give one sample, or the mean")
    else:
        column = 'name the column, columns={"T": ...}, and choose one, temperature=20'
        raise table.fault(f"{what}: if of several temperatures, {column}; else give one, or the mean")


def stretch_of(table: Table, kind: Sequence[Column], kinds: Sequence[Sequence[Column]], nu: float | None) -> float:
    """E over the modulus of one of two kinds, of tension and of shear, which alone asks for Poisson's ratio."""
    name, is_shear = next(one.name for one in kind if one.name in table.values), kind is not kinds[0]
    if is_shear == (nu is not None):
        return 1.0 if nu is None else 2 * (1 + poisson_ratio("nu", nu))
    way_out = (
        f"if it is one in {'tension' if is_shear else 'shear'}, columns={{{repr_of(kinds[not is_shear][0].name)}: ...}}"
    )
    if is_shear:
        raise table.fault(f"{name} is of shear and needs Poisson's ratio: give nu=; {way_out}")
    raise table.fault(f"nu= has no effect on {name}, which is of tension: leave it out; {way_out}")
