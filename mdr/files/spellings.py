"""Other spellings of a case file's keys: what rigs are set to, in the units that people have.

    [indenter]     theta_deg = 1.5     for theta [rad]
    [material]     tan_delta = 0.2     for tau [s] of a KelvinVoigt: the loss tangent at the frequency of the file
    [oscillation]  frequency = 50      for omega [rad/s], in Hz; so in [shake]
    [oscillation]  load = 1.0          for F_z0 [N]; with du_z, for u_z0: the depth at which this load rests

A key and its other spelling are not given together. The depth of a load and tau of a loss tangent depend on other
tables too and are left open here: `left_open` says what was given, and `mdr.normal.vary` sets it, in every case of a
study anew. Files are written in the fields of the records.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from mdr.normal.vary import angular
from mdr.tools.checks import not_negative, positive


class Spelling(NamedTuple):
    """One other spelling of a key."""

    key: str  #: of the record's field
    unit: str
    meaning: str
    convert: Callable[[Any], float]


_FREQUENCY = Spelling("omega", "Hz", "frequency", angular)
SPELLINGS: dict[str, dict[str, Spelling]] = {
    "indenter": {
        "theta_deg": Spelling(
            "theta",
            "deg",
            "angle between flank and plane",
            lambda value: math.radians(positive("theta_deg", value, "angle in degrees")),
        )
    },
    "material": {
        "tan_delta": Spelling(
            "tau",
            "-",
            "loss tangent at the frequency of the file",
            lambda value: not_negative("tan_delta", value, "loss tangent"),
        )
    },
    "oscillation": {
        "frequency": _FREQUENCY,
        "load": Spelling(
            "F_z0", "N", "mean load; beside du_z, for u_z0", lambda value: positive("load", value, "mean load in N")
        ),
    },
    "shake": {"frequency": _FREQUENCY},
}
OF_LOADS = ("F_z0", "dF_z", "m_z")  #: keys of an oscillating load
_MEANT = {"f": "frequency", "hz": "frequency", "freq": "frequency"}  #: what nobody should have to guess


def respelled(name: str, content: Mapping[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """The table [name] of a file in the fields of its record, and what is wrong with its other spellings.

    Where a value is refused, or left open, a harmless one stands in its place, so that the rest can be read.
    """
    out, faults = dict(content[name]), []
    for alias, (key, _, _, convert) in SPELLINGS.get(name, {}).items():
        if alias not in out:
            continue
        of_depth = alias in left_open({name: out})
        value = out.pop(alias)
        if alias == "load" and of_depth:
            key = "u_z0"
            if beside := [one for one in OF_LOADS if one in out]:
                faults.append(
                    f"load beside du_z is that of a prescribed depth, and {beside[0]} belongs to an oscillating load: "
                    "give one of du_z and dF_z"
                )
                out = {one: kept for one, kept in out.items() if one not in OF_LOADS}
        if key in out:
            faults.append(f"{alias} and {key} say the same: give one of them")
            continue
        if key == "tau" and out.get("model") != "KelvinVoigt":
            faults.append(f'{alias} is of model = "KelvinVoigt" alone, whose E then is the storage modulus')
            continue
        try:
            out[key] = convert(value)
        except (TypeError, ValueError) as refusal:
            faults.append(str(refusal))
            out[key] = 0.5  # within the rule of every field above
    return out, faults


def left_open(content: Mapping[str, Any]) -> dict[str, Any]:
    """What is said of a depth and of tau by what the other tables decide about: load [N], tan_delta [-]."""
    said = {
        "load": ("oscillation", {"load", "du_z"}),
        "tan_delta": ("material", {"tan_delta"}),
    }
    tables = {name: table for name, table in content.items() if isinstance(table, dict)}
    return {alias: tables[name][alias] for alias, (name, keys) in said.items() if keys <= set(tables.get(name, ()))}


def as_written(name: str, table: Mapping[str, Any], content: Mapping[str, Any], keys: list[str]) -> dict[str, Any]:
    """The table, with the spellings of the file for keys that its record has not, so that a refusal names these."""
    back = {one.key: alias for alias, one in SPELLINGS.get(name, {}).items() if alias in content[name]}
    return {back.get(key, key) if key not in keys else key: value for key, value in table.items()}


def other_spellings(name: str, keys: list[str]) -> list[str]:
    """The other spellings of a table whose record has these keys."""
    return [alias for alias, one in SPELLINGS.get(name, {}).items() if one.key in keys]


def meant(name: str, key: str) -> str | None:
    """The other spelling that a common abbreviation stands for."""
    found = _MEANT.get(key.casefold())
    return found if found in SPELLINGS.get(name, {}) else None
