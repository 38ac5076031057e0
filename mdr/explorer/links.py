"""The state of the explorer as a link and as a Python script; and what is typed into it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any
from urllib.parse import urlencode

import numpy as np

from mdr.case.contact import as_given
from mdr.explorer.state import State
from mdr.files.case_files import write_case
from mdr.given.case_file import parse_case
from mdr.tools.notation import UNITS, numbers_in, shown

CALLS = ("curve = mdr.cof_curve(case, [v_0])", "run = mdr.slide(case, v_0, record=1)")  #: with which a script ends


def link_of(state: State) -> str:
    """The state as a query string; empty where it would be too long, as with a measured profile."""
    table, values = "", {}
    for line in write_case(state.case).splitlines():
        key, equals, value = line.partition(" = ")
        if equals:
            values[table + key] = value
        elif line:
            table = line.strip("[]") + "."
    link = urlencode({**values, "v_0": repr(state.v_0), **({"groups": "true"} if state.in_groups else {})})
    return link if len(link) <= 8000 else ""  # some programs cut a longer one


def state_of(query: Mapping[str, str]) -> State:
    """The state that a link carries. Raises CaseFileError, or ValueError, with what is wrong in it."""
    keys = dict(query)
    v_0, groups = keys.pop("v_0", ""), keys.pop("groups", "")
    state = State.of(parse_case("\n".join(f"{key} = {value}" for key, value in keys.items()), "link"))
    state = replace(state, in_groups=groups == "true")
    return state.changed("v_0", meaning_of(v_0)) if v_0 else state


def python_of(state: State) -> str:
    """The state as a Python script."""
    case = as_given(state.case)
    parts = {one.name: getattr(case, one.name) for one in fields(case)}
    arguments = [f"    {name}={_called(part)}," for name, part in parts.items() if part is not None]
    velocity = f"v_0 = {_called(state.v_0)}  # m/s"
    return "\n".join(["import mdr", "", "case = mdr.SlidingContact(", *arguments, ")", velocity, *CALLS, ""])


def typed(value: Any, unit: str = "") -> str:
    """A value as one types it, numbers to five digits: 20e-6, 3e6, 0.05; in a unit 20 µm, 3 MPa, 50 Hz."""
    if isinstance(value, tuple):
        return f"[{', '.join(typed(one, unit) for one in value)}]"
    if not isinstance(value, float):
        return str(value)
    if unit in UNITS and unit != "-":
        return shown(value, unit)
    power = 3 * int(np.floor(np.log10(abs(value)) / 3)) if value else 0
    return f"{value:.5g}" if -3 <= power <= 3 else f"{value / 10.0**power:.5g}e{power}"


def _called(value: Any) -> str:
    """A value, or the call that makes a record, without fields that have their default."""
    if isinstance(value, float):
        text = typed(value)
        return text if float(text) == value else repr(value)
    if isinstance(value, tuple):
        return f"({', '.join(map(_called, value))}{',' if len(value) == 1 else ''})"
    if not is_dataclass(value):
        return repr(value)
    given = [(one, getattr(value, one.name)) for one in fields(value) if one.init]
    told = [f"{one.name}={_called(own)}" for one, own in given if own != one.default]
    return f"mdr.{type(value).__name__}({', '.join(told)})"


def meaning_of(text: str, name: str = "", unit: str = "") -> Any:
    """What a text means, as in a case file: a number, a list or a word, else the text; and a quantity without quotes.

    Raises ValueError, naming it, for what is no number of a quantity that has a unit.
    """
    import tomllib

    try:
        found = tomllib.loads(f"value = {text}")["value"]
    except (ValueError, RecursionError):
        found = text.strip("[] ").split(",") if unit and text.strip().startswith("[") else text
    return numbers_in(name, found, unit)
