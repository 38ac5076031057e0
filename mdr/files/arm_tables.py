"""The arms of a material in a table that people write: CSV, or TOML as in a case file."""

from __future__ import annotations

from os import PathLike, fsdecode
from typing import Any

import numpy as np

from mdr.files.measurements import LIKELY_MODULUS, read_table
from mdr.files.relative_moduli import ROUNDED, WAY_OUT, are_relative, in_pascals, instantaneous_of, material_of
from mdr.files.toml_text import CaseFileError, field_faults, parse_toml, read_text, tried
from mdr.tools.csv_header import Column, Reading, fault
from mdr.tools.csv_table import Table, warn_of_size
from mdr.tools.fields import units_of
from mdr.tools.messages import offer, short
from mdr.tools.notation import numbers_in

#: moduli in Pa, shear moduli in Pa, or shares of the instantaneous modulus
MODULI = (
    Column(
        "g_j",
        ("g_i", "g", "relative modulus", "relative moduli", "E_j/E_0", "E_i/E_0", "G_j/G_0", "G_i/G_0"),
        needed=False,
    ),
    Column("E_j", ("E_i", "modulus"), "Pa", needed=False, bare=True),
    Column("G_j", ("G_i", "G", "G(i)", "G(j)", "Gm", "G_m", "Gk", "shear modulus"), "Pa", needed=False, bare=True),
)
TAU = ("tau_i", "tau", "tau(i)", "taum", "taui", "τ", "relaxation time")
BETA = ("beta_i", "beta", "β", "beta(i)", "decay constant")
ARMS = (
    *MODULI,
    Column("k_j", ("k_i", "k"), needed=False),  # shares of a bulk modulus, which finite-element programs have beside
    Column("tau_j", TAU, "s", bare=True, empty=np.inf, instead="beta_j [1/s], 1/tau_j", others=("beta_j",)),
    Column("beta_j", BETA, "1/s", needed=False, bare=True),
)


def from_table(
    material: type[Any],
    path: str | PathLike[str],
    nu: float | None,
    E_0: float | None,
    G_0: float | None,
    reading: Reading,
) -> dict[str, Any]:
    """The fields of a material of arms in a file."""
    name = fsdecode(path)
    if name.lower().endswith(".toml"):
        if any(reading):
            raise fault(name, "units, columns, skip and table are those of a CSV table")
        return _from_toml(material, read_text(path), name, {"nu": nu, "E_0": E_0, "G_0": G_0})
    if not name.lower().endswith(".csv"):
        raise fault(name, "a table of arms must end in .csv or .toml")
    if nu is None:
        raise fault(name, "a CSV table has no Poisson's ratio; give nu=")
    table = read_table(path, ARMS, reading)
    if (beta := table.values.get("beta_j")) is not None:
        with np.errstate(divide="ignore"):
            tau = table.values.setdefault("tau_j", 1 / beta)
            table.require(np.isclose(1 / beta, tau, rtol=ROUNDED), "beta_j must be 1/tau_j; leave one out")
    return {**_from_csv(table, nu, instantaneous_of(E_0, G_0, nu)), "nu": nu}


def _from_csv(table: Table, nu: float, E_0: float | None) -> dict[str, Any]:
    example = "E_j [MPa], tau_j [s], or G_j of shear, or shares g_j"
    kind = table.one_of([(one,) for one in MODULI], "no E_j", example, "E_j")[0].name
    tau, E = table.values["tau_j"], table.values[kind]
    table.require((E >= 0) & (tau > 0), f"must have {kind} >= 0{'' if kind == 'g_j' else ' Pa'} and tau_j > 0 s")
    bulk = table.values.get("k_j", E)
    if not np.all((1 - 2 * nu) / 3 * np.abs(bulk - E) <= ROUNDED):  # by which E_j then is another share than G_j
        what = f"k_j must equal g_j at nu = {nu:.6g}, as Poisson's ratio is constant here"
        raise table.fault(f'{what}; columns={{"k_j": ""}} leaves it out, if that may be')
    arms = tau < np.inf
    E_inf, moduli = None if arms.all() else float(E[~arms].sum()), E[arms].tolist()
    if E_0 is None and (kind == "g_j" or are_relative(E_inf, moduli)):
        raise table.fault(f"{WAY_OUT}E_0= or G_0= in Pa, or write them in Pa, as E_j [MPa]")
    if E_0 is None:
        stretch = 2 * (1 + nu) if kind == "G_j" else 1.0
        E_inf, moduli = stretch * (E_inf or 0.0), [stretch * one for one in moduli]
    else:
        try:
            E_inf, moduli = in_pascals(E_0, E_inf, moduli)
        except ValueError as refusal:
            raise table.fault(str(refusal)) from None
    warn_of_size("the sum of the moduli", E_inf + sum(moduli), LIKELY_MODULUS, "Pa")
    return {"E_inf": E_inf, "arms": tuple(zip(moduli, tau[arms].tolist(), strict=True))}


def _from_toml(material: type[Any], text: str, name: str, beside: dict[str, float | None]) -> dict[str, Any]:
    """The fields in a table [material], or in one without a name; what stands `beside` it is taken."""
    content = parse_toml(text, name)
    table = content.get("material", content)
    if not isinstance(table, dict):
        raise fault(name, "[material] must be one table of keys")
    if (model := table.pop("model", "Prony")) != "Prony":
        raise fault(name, f'model "{short(str(model))}" is not Prony')
    table |= {key: one for key, one in beside.items() if one is not None}
    given, faults = tried(_fields_in, material, table)
    if faults:
        raise fault(name, "; ".join(f"[material] {one}" for one in faults))
    return dict(given)


def _fields_in(material: type[Any], table: dict[str, Any]) -> dict[str, Any]:
    """The fields that the keys of a table say. Raises CaseFileError with every fault."""
    units, table = units_of(material), dict(material_of(material, table))
    known = ["model", *units]
    faults = [f"{short(key)} is no key of Prony; {offer(key, known)}" for key in table if key not in units]
    read = {key: tried(numbers_in, key, value, units[key]) for key, value in table.items() if key in units}
    given = {key: value for key, (value, wrong) in read.items() if not wrong}
    faults += [one for _, wrong in read.values() for one in wrong]
    if faults := [*faults, *field_faults(material, given, {}, read)]:
        raise CaseFileError.of(faults)
    return given
