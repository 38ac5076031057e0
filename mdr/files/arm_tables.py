"""The arms of a material in a table that people write: CSV, or TOML as in a case file."""

from __future__ import annotations

from dataclasses import fields
from os import PathLike, fsdecode
from typing import Any

import numpy as np

from mdr.files.toml_text import parse_toml, read_text
from mdr.materials import Prony
from mdr.tools.csv_table import Column, fault, table_of
from mdr.tools.messages import short

ARMS = (Column("E_j", unit="Pa", bare=True), Column("tau_j", unit="s", bare=True, empty=np.inf))


def from_table(path: str | PathLike[str], nu: float | None) -> dict[str, Any]:
    """The fields of a Prony in a file."""
    name = fsdecode(path)
    if not name.lower().endswith((".csv", ".toml")):
        raise fault(name, "a table of arms must end in .csv or .toml")
    if name.lower().endswith(".toml"):
        return _from_toml(read_text(path), name, nu)
    if nu is None:
        raise fault(name, "a CSV table has no Poisson's ratio; give nu=")
    return {**_from_csv(read_text(path), name), "nu": nu}


def _from_csv(text: str, name: str) -> dict[str, Any]:
    table = table_of(text, name, ARMS)
    E_inf, arms = 0.0, []
    for line, E_j, tau_j in zip(table.lines, *(table.values[key].tolist() for key in ("E_j", "tau_j")), strict=True):
        if not E_j >= 0 or not tau_j > 0:
            what = f"must have E_j >= 0 Pa and tau_j > 0 s, got {E_j:.6g} Pa and {tau_j:.6g} s"
            raise fault(f"{name}: line {line}", what)
        if np.isinf(tau_j):
            E_inf += E_j
        else:
            arms.append((E_j, tau_j))
    return {"E_inf": E_inf, "arms": tuple(arms)}


def _from_toml(text: str, name: str, nu: float | None) -> dict[str, Any]:
    content = parse_toml(text, name)
    table = content.get("material", content)
    if not isinstance(table, dict):
        raise fault(name, f"material must be a table of keys, got {short(str(table))}")
    table = dict(table)
    model = table.pop("model", "Prony")
    known = [one.name for one in fields(Prony)]
    unknown = [key for key in table if key not in known]
    if model != "Prony" or unknown:
        other = f'model "{short(str(model))}" is not Prony'
        what = other if model != "Prony" else f"{short(unknown[0])} is no key of Prony"
        raise fault(name, f"{what}; there are {', '.join(known)}")
    if nu is not None:
        table["nu"] = nu
    missing = [key for key in ("E_inf", "arms", "nu") if key not in table]
    if missing:
        raise fault(name, f"{missing[0]} is missing")
    return table
