"""Other spellings of a case file's keys: what rigs are set to, in the units that people have.

    [indenter]     theta_deg = 1.5     for theta [rad]
    [material]     tan_delta = 0.2     for tau [s] of a KelvinVoigt: the loss tangent at the frequency of the file
    [oscillation]  frequency = 50      for omega [rad/s], in Hz; so in [shake]
    [oscillation]  load = 1.0          for F_z0 [N]; with du_z, for u_z0: the depth at which this load rests

A key and its other spelling are not given together. Files are written in the fields of the records.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from mdr.indenters import Indenter
from mdr.materials import Material
from mdr.normal.load_control import static_depth
from mdr.tools.checks import not_negative, positive


class Spelling(NamedTuple):
    """One other spelling of a key."""

    key: str  #: of the record's field
    unit: str
    meaning: str
    convert: Callable[[Any, float], float]  #: the value, and omega [rad/s] of the file


def _frequency(value: Any, _: float) -> float:
    return 2 * math.pi * positive("frequency", value, "in Hz")


_FREQUENCY = Spelling("omega", "Hz", "frequency", _frequency)
SPELLINGS: dict[str, dict[str, Spelling]] = {
    "indenter": {
        "theta_deg": Spelling(
            "theta",
            "deg",
            "angle between flank and plane",
            lambda value, _: math.radians(positive("theta_deg", value, "angle in degrees")),
        )
    },
    "material": {
        "tan_delta": Spelling(
            "tau",
            "-",
            "loss tangent at the frequency of the file",
            lambda value, omega: not_negative("tan_delta", value, "loss tangent") / omega,
        )
    },
    "oscillation": {
        "frequency": _FREQUENCY,
        "load": Spelling(
            "F_z0", "N", "mean load; beside du_z, for u_z0", lambda value, _: positive("load", value, "mean load in N")
        ),
    },
    "shake": {"frequency": _FREQUENCY},
}
OF_LOADS = ("F_z0", "dF_z", "m_z")  #: keys of an oscillating load
_MEANT = {"f": "frequency", "hz": "frequency", "freq": "frequency"}  #: what nobody should have to guess


def respelled(name: str, content: Mapping[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """The table [name] of a file in the fields of its record, and what is wrong with its other spellings.

    A load beside the amplitude of a depth stays as it is, see `with_depth_of_load`. Where a value is refused a harmless
    one stands in its place, so that the rest of the table can be read.
    """
    out, faults = dict(content[name]), []
    for alias, (key, _, _, convert) in SPELLINGS.get(name, {}).items():
        if alias not in out or _asks_for_depth(name, out, alias):
            continue
        value = out.pop(alias)
        if key in out:
            faults.append(f"{alias} and {key} say the same: give one of them")
            continue
        if key == "tau" and out.get("model") != "KelvinVoigt":
            faults.append(f'{alias} is of model = "KelvinVoigt" alone, whose E then is the storage modulus')
            continue
        omega = 1.0
        if key == "tau":
            omega, fault = _omega(content)
            faults += [fault] if fault else []
        try:
            out[key] = convert(value, omega)
        except (TypeError, ValueError) as refusal:
            faults.append(str(refusal))
            out[key] = 0.5  # within the rule of every field above
    return out, faults


def as_written(name: str, table: Mapping[str, Any], content: Mapping[str, Any], keys: list[str]) -> dict[str, Any]:
    """The table, with the spellings of the file for keys that its record has not, so that a refusal names these."""
    back = {one.key: alias for alias, one in SPELLINGS.get(name, {}).items() if alias in content[name]}
    return {back.get(key, key) if key not in keys else key: value for key, value in table.items()}


def with_depth_of_load(
    table: dict[str, Any], indenter: Indenter | None, material: Material | None
) -> tuple[dict[str, Any], list[str]]:
    """A table [oscillation] in which the depth of rest stands for a load beside du_z, and what is wrong with that load.

    Where it is refused, or shape or material are not known, a harmless depth stands there.
    """
    if not {"load", "du_z"} <= set(table):
        return table, []
    kept = {key: value for key, value in table.items() if key not in ("load", *OF_LOADS)}
    try:
        depth, fault = _depth_of_rest(table, indenter, material), []
    except (TypeError, ValueError) as refusal:
        depth, fault = 1.0, [str(refusal)]
    return {**kept, "u_z0": depth}, fault


def _depth_of_rest(table: Mapping[str, Any], indenter: Indenter | None, material: Material | None) -> float:
    load = positive("load", table["load"], "mean load in N")
    if beside := [key for key in OF_LOADS if key in table]:
        raise ValueError(
            f"load beside du_z is that of a prescribed depth, and {beside[0]} belongs to an oscillating load: give one "
            "of du_z and dF_z"
        )
    if "u_z0" in table:
        raise ValueError("load and u_z0 say the same: give one of them")
    return static_depth(indenter, material, load) if indenter and material else 1.0


def other_spellings(name: str, keys: list[str]) -> list[str]:
    """The other spellings of a table whose record has these keys."""
    return [alias for alias, one in SPELLINGS.get(name, {}).items() if one.key in keys]


def meant(name: str, key: str) -> str | None:
    """The other spelling that a common abbreviation stands for."""
    found = _MEANT.get(key.casefold())
    return found if found in SPELLINGS.get(name, {}) else None


def _asks_for_depth(name: str, table: Mapping[str, Any], alias: str) -> bool:
    """Whether a load stands beside the amplitude of a depth."""
    return name == "oscillation" and alias == "load" and "du_z" in table


def _omega(content: Mapping[str, Any]) -> tuple[float, str]:
    """Angular frequency [rad/s] of the file, and what is wrong where it has none or two."""
    found = set()
    for table in (content.get("oscillation"), content.get("shake")):
        if not isinstance(table, dict):
            continue
        try:
            if "frequency" in table:
                found.add(_frequency(table["frequency"], 1.0))
            if "omega" in table:
                found.add(positive("omega", table["omega"]))
        except (TypeError, ValueError):
            return 1.0, ""  # refused by its own rule
    if not found:
        return 1.0, "tan_delta needs a frequency: give it in [oscillation] or [shake]"
    if max(found) > (1 + 1e-9) * min(found):
        return 1.0, "tan_delta belongs to one frequency, and [oscillation] and [shake] have two: give tau"
    return found.pop(), ""
