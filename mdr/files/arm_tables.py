"""The arms of a material in a table that people write: CSV, or TOML as in a case file."""

from __future__ import annotations

from os import PathLike, fsdecode
from typing import Any

import numpy as np

from mdr.files.case_files import record_of
from mdr.files.toml_text import parse_toml, read_text, tried
from mdr.tools.csv_table import Column, fault, table_of
from mdr.tools.messages import short

ARMS = (Column("E_j", unit="Pa", bare=True), Column("tau_j", unit="s", bare=True, empty=np.inf))


def from_table(path: str | PathLike[str], nu: float | None) -> dict[str, Any]:
    """The fields of a Prony in a file."""
    name = fsdecode(path)
    if name.lower().endswith(".toml"):
        return _from_toml(read_text(path), name, nu)
    if not name.lower().endswith(".csv"):
        raise fault(name, "a table of arms must end in .csv or .toml")
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
    """The fields in a table [material], or in one without a name."""
    content = parse_toml(text, name)
    table = content.get("material", content)
    if isinstance(table, dict):
        table = {"model": "Prony", **table, **({} if nu is None else {"nu": nu})}
        if table["model"] != "Prony":
            raise fault(name, f'model "{short(str(table["model"]))}" is not Prony')
    material, faults = tried(record_of, "material", table)
    if faults:
        raise fault(name, "; ".join(faults))
    return dict(vars(material))
