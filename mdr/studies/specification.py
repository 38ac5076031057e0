"""What makes two studies the same: their specification as a tree, its SHA-256, and what differs between two."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from hashlib import sha256
from typing import Any

import numpy as np

from mdr.studies.axes import without_addresses
from mdr.studies.quantities import CATALOGUE, Quantity
from mdr.studies.work import Work
from mdr.tools import version
from mdr.tools.messages import MOST_TOLD, short
from mdr.tools.sources import hash_of, texts

NO_NUMBERS = ("__main__", "commands", "explorer", "files", "plots")  #: parts of mdr that move no value of a study


def specification(work: Work) -> dict[str, Any]:
    """All that the values of a study depend on, as a tree for JSON. ValueError for what cannot be told by its data."""
    return {
        "case": {one.name: described(getattr(work.case, one.name)) for one in fields(work.case)} | dict(work.held),
        "axes": {axis.path: described(axis.values) for axis in work.axes},
        "order of axes": [axis.path for axis in work.axes],
        "quantities": [_quantity(one) for one in work.quantities],
        **work.knobs,
        "version of mdr": version.__version__,
        "code of mdr": code(),
    }


def code() -> str:
    """A hash of all sources that can move a value, so that no store mixes the numbers of two."""
    return hash_of(name for name in texts() if name.partition(".")[2].partition(".")[0] not in NO_NUMBERS)


def identity_of(tree: Mapping[str, Any]) -> str:
    """SHA-256 of the canonical JSON of a specification."""
    text = json.dumps(tree, sort_keys=True, separators=(",", ":"), ensure_ascii=True, allow_nan=False)
    return sha256(text.encode("ascii")).hexdigest()


def described(value: Any) -> Any:
    """A value as JSON, the same for equal values; a record as the call that makes it."""
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    if value is None or isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, tuple | list):
        return [described(one) for one in value]
    if is_dataclass(value) and not isinstance(value, type):
        return _call(value)
    what = without_addresses(short(repr(value)))
    raise ValueError(f"{what} cannot be told by its data, as a store must; build the case from the records of mdr")


def _call(record: Any) -> str:
    kind = type(record)
    own = "" if kind.__module__.partition(".")[0] == "mdr" else f"{kind.__module__}."
    values = {one.name: getattr(record, one.name) for one in fields(record) if one.init}
    if any(callable(value) for value in values.values()) and not values.get("name"):
        raise ValueError(
            f"{kind.__name__} holds a function, which a store cannot compare when the study is resumed: "
            f'name it, {kind.__name__}(..., name="..."), a new name for every function'
        )
    given = [f"{name}={json.dumps(described(value))}" for name, value in values.items() if not callable(value)]
    return f"{own}{kind.__qualname__}({', '.join(given)})"


def _quantity(one: Quantity) -> Any:
    """A quantity of the catalogue by its name, one of the user by all but its function."""
    if CATALOGUE.get(one.name) == one:
        return one.name
    return {"name": one.name, "unit": one.unit, "meaning": one.meaning, "per_velocity": one.per_velocity}


def differences(known: Mapping[str, Any], asked: Mapping[str, Any]) -> str:
    """What differs between two specifications, in words."""
    found = _differing(known, asked)
    rest = len(found) - MOST_TOLD
    return "; ".join(found[:MOST_TOLD]) + (f"; and {rest} more" if rest > 0 else "")


def _differing(known: Mapping[str, Any], asked: Mapping[str, Any]) -> list[str]:
    found = []
    for name in dict.fromkeys([*known, *asked]):
        old, new = known.get(name), asked.get(name)
        if isinstance(old, dict) and isinstance(new, dict):
            found += [f"{name}.{line}" for line in _differing(old, new)]
        elif name not in known or name not in asked:
            found.append(f"{name} is in {'the store' if name in known else 'this call'} only")
        elif old != new:
            there, here = (short(one if isinstance(one, str) else json.dumps(one)) for one in (old, new))
            found.append(f"{name} is {there} there and {here} here")
    return found
