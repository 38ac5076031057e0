"""What makes two studies the same: their specification as a tree, its SHA-256, and what differs between two."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from hashlib import sha256
from typing import Any

import numpy as np

from mdr.studies.axes import without_addresses
from mdr.studies.quantities import CATALOGUE, CurveQuantity, Quantity
from mdr.studies.work import Work
from mdr.tools import version
from mdr.tools.messages import short
from mdr.tools.sources import hash_of, texts

NO_NUMBERS = ("__main__", "commands", "explorer", "files", "plots")  #: parts of mdr that move no value of a study
MOST_TOLD = 4  #: differences


def specification(work: Work) -> dict[str, Any]:
    """All that the values of a study depend on, as a tree for JSON. ValueError for what cannot be told by its data."""
    return {
        "case": {**described(work.case), **work.held},
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
    """A value as a tree for JSON, the same for equal values."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if value is None or isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, tuple | list):
        return [described(one) for one in value]
    if is_dataclass(value) and not isinstance(value, type):
        return _record(value)
    what = without_addresses(short(repr(value)))
    raise ValueError(f"{what} cannot be told by its data, as a store must; build the case from the records of mdr")


def differences(known: Mapping[str, Any], asked: Mapping[str, Any]) -> str:
    """What differs between two specifications, in words."""
    found = [line for name in dict.fromkeys([*known, *asked]) for line in _differing(name, known, asked)]
    rest = len(found) - MOST_TOLD
    return "; ".join(found[:MOST_TOLD]) + (f"; and {rest} more" if rest > 0 else "")


def _record(record: Any) -> dict[str, Any]:
    kind = type(record)
    own = "" if kind.__module__.partition(".")[0] == "mdr" else f"{kind.__module__}."
    tree: dict[str, Any] = {"record": own + kind.__qualname__}
    for one in fields(record):
        value = getattr(record, one.name)
        if not one.init:
            continue
        if not callable(value):
            tree[one.name] = described(value)
        elif not getattr(record, "name", None):
            raise ValueError(
                f"{kind.__name__} holds a function, which a store cannot compare when the study is resumed: "
                f'name it, {kind.__name__}(..., name="..."), a new name for every function'
            )
    return tree


def _quantity(one: Quantity | CurveQuantity) -> Any:
    """A quantity of the catalogue by its name, one of the user by all but its function."""
    if CATALOGUE.get(one.name) == one:
        return one.name
    return {"name": one.name, "unit": one.unit, "meaning": one.meaning, "per_velocity": one.per_velocity}


def _differing(name: str, known: Any, asked: Any) -> list[str]:
    """The differences below one branch."""
    old, new = known.get(name), asked.get(name)
    if old == new:
        return []
    if isinstance(old, dict) and isinstance(new, dict) and old.get("record") == new.get("record"):
        return [f"{name}.{line}" for key in dict.fromkeys([*old, *new]) for line in _differing(key, old, new)]
    if name not in known or name not in asked:
        where = "the store" if name in known else "this call"
        return [f"{name} is in {where} only"]
    return [f"{name} is {_told(old)} there and {_told(new)} here"]


def _told(tree: Any) -> str:
    if isinstance(tree, dict) and "record" in tree:
        inside = ", ".join(f"{key}={_told(value)}" for key, value in tree.items() if key != "record")
        return short(f"{tree['record']}({inside})")
    return short(json.dumps(tree))
