"""Study files: a case file with the axes that vary the case, strictly read.

    quantities = ["cof", "stick_share"]       # names of the catalogue; left out, ["cof"]
    n_springs = 192                           # of every run; left out, chosen to meet the accuracy
    steps_per_period = 512
    mu_0 = 0.5                                # the case, as in a case file
    ...
    [axes]                                    # paths in quotes, as `mdr.sweep` takes them
    "material.tau" = { from = 1e-4, to = 1e-2, n = 9, spacing = "log" }
    "v_0/v_c" = { from = 0, to = 1.3, n = 27 }
    "oscillation.u_z0" = [10e-6, 20e-6]
    indenter = [{ shape = "Cone", theta = 0.05 }, { shape = "Paraboloid", R = 5e-3 }]
    pull = [{}, { k_x = 2e4, m = 0.1 }]       # {} is a rigid pull

A load, frequency or loss tangent that the file gives holds in every case, unless an axis sets what it sets.

A file that is wrong is refused with every fault at once.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike, fsdecode
from typing import Any

import numpy as np

from mdr.case.contact import KINDS, SlidingContact
from mdr.case.pull import RigidPull
from mdr.files.case_files import case_of, record_of, stand_in
from mdr.files.spellings import left_open
from mdr.files.toml_text import NESTED, CaseFileError, fault_error, parse_toml, read_text
from mdr.friction.cof_curve import LEAST_KNOB
from mdr.march.march import BUDGET, accuracy_of
from mdr.normal.vary import fields_set
from mdr.studies.axes import read_axes
from mdr.studies.quantities import read_quantities
from mdr.tools.checks import count, finite
from mdr.tools.messages import offer, short

KEYS = ("axes", "quantities", "n_springs", "steps_per_period", "accuracy")
MOST_VALUES = 10**7  #: of an axis


@dataclass(frozen=True)
class StudyFile:
    """What a study file asks for; `mdr.sweep(**vars(file))` does it."""

    case: SlidingContact
    axes: dict[str, Any]
    quantities: tuple[str, ...]
    n_springs: int | None
    steps_per_period: int | None
    accuracy: float
    held: dict[str, float]  #: load [N] and tan_delta [-] that it gives


def read_study_file(path: str | PathLike[str]) -> StudyFile:
    """The study in a TOML file. Raises CaseFileError with every fault."""
    return parse_study(read_text(path), source=fsdecode(path))


def parse_study(text: str, source: str = "<string>") -> StudyFile:
    """The study in a TOML text; messages call it `source`. Raises CaseFileError with every fault."""
    try:
        return _study_of(parse_toml(text, source), source)
    except RecursionError:
        raise fault_error(source, [NESTED]) from None


def _study_of(content: Mapping[str, Any], source: str) -> StudyFile:
    axes, faults = _read_axes(content.get("axes"))
    quantities = content.get("quantities", ["cof"])
    faults += _faults_of_names(quantities)
    knobs = {name: content.get(name) for name in ("n_springs", "steps_per_period")}
    for name, knob in knobs.items():
        faults += _tried(count, name, knob, LEAST_KNOB) if knob is not None else []
    accuracy = content.get("accuracy", BUDGET)
    faults += _tried(accuracy_of, accuracy)
    try:
        case = case_of(content, source, beside=KEYS)
    except CaseFileError as of_case:
        faults += _faults_behind(content, axes)
        raise CaseFileError("\n".join([*of_case.faults, *fault_error(source, faults).faults])) from None
    faults += _faults_of_axes(case, axes)
    faults = faults or _tried(read_quantities, quantities, axes)
    if faults:
        raise fault_error(source, faults)
    return StudyFile(case, axes, tuple(quantities), **knobs, accuracy=accuracy, held=left_open(content))


# --- axes ---


def _read_axes(table: Any) -> tuple[dict[str, Any], list[str]]:
    """Values by path, those that are well written, and what is wrong with the others."""
    if table is None:
        return {}, ['[axes] is missing; a study varies something, such as "v_0/v_c" = [0.5, 0.9]']
    if not isinstance(table, dict) or not table:
        return {}, ["[axes] must be a table of paths and their values"]
    axes: dict[str, Any] = {}
    faults: list[str] = []
    for path, written in table.items():
        values, found = _read_values(path, written)
        faults += [f"[axes] {fault}" for fault in found]
        if not found:
            axes[path] = values
    return axes, faults


def _read_values(path: str, written: Any) -> tuple[Any, list[str]]:
    if isinstance(written, dict) and not set(written) & set(_RANGE) and path in KINDS:
        example = next(iter(written), "...")
        return None, [f'{path}.{example} must be in quotes, "{path}.{example}" = [...]; {path} itself a list of tables']
    if isinstance(written, dict):
        return _range(path, written)
    if not isinstance(written, list):
        return None, [f"{path} must be a list of values or {{ from = , to = , n = }}, got {short(str(written))}"]
    if path not in KINDS:
        return written, []
    records: list[Any] = []
    faults: list[str] = []
    for one in written:
        record, found = (RigidPull(), []) if path == "pull" and one == {} else record_of(path, one)
        records.append(record)
        faults += found
    return records, faults


def _number_of_values(name: str, value: Any) -> None:
    if count(name, value, 2) > MOST_VALUES:
        raise ValueError(f"{name} must be at most {MOST_VALUES}, got {value}")


def _spacing(name: str, value: Any) -> None:
    if value not in ("linear", "log"):
        raise ValueError(f'{name} must be "linear" or "log", got {short(str(value))}')


_RANGE = {"from": finite, "to": finite, "n": _number_of_values, "spacing": _spacing}  # keys, and what each must be


def _range(path: str, written: Mapping[str, Any]) -> tuple[Any, list[str]]:
    """Equidistant values, or values in equal ratios."""
    known = list(_RANGE)
    faults = [f"{path}: {short(key)} is no key of a range; {offer(key, known)}" for key in written if key not in known]
    faults += [f"{path}: {key} is missing from the range" for key in known[:3] if key not in written]
    for key, must in _RANGE.items():
        faults += _tried(must, f"{path}: {key}", written[key]) if key in written else []
    if faults:
        return None, faults
    low, high, n = float(written["from"]), float(written["to"]), written["n"]
    if written.get("spacing") != "log":
        return np.linspace(low, high, n), []
    if min(low, high) <= 0:
        return None, [f'{path}: a range with spacing = "log" must be positive, got {low:g} to {high:g}']
    return np.geomspace(low, high, n), []


# --- faults that only the case tells ---


def _faults_of_axes(case: SlidingContact, axes: Mapping[str, Any]) -> list[str]:
    """Faults of each axis together with those of records, then of all axes together."""
    records = {path: axes[path] for path in axes if path in KINDS}
    alone = [_tried(read_axes, case, {**records, path: axes[path]}) for path in axes]
    found = list(dict.fromkeys(fault for faults in alone for fault in faults))
    return [f"[axes] {fault}" for fault in found or (_tried(read_axes, case, axes) if axes else [])]


def _faults_behind(content: Mapping[str, Any], axes: Mapping[str, Any]) -> list[str]:
    """Faults of the axes although the case is refused: of those axes that do not set what is wrong in the case."""
    case, unsound = stand_in(content)
    slots = {path: {field.partition(".")[0] for field in fields_set(path)} for path in axes}
    seen = {path: axes[path] for path, those in slots.items() if not those & unsound}
    return _faults_of_axes(case, seen) if case is not None else []


def _faults_of_names(quantities: Any) -> list[str]:
    """Faults of each quantity, as if there were an axis of velocity."""
    if not isinstance(quantities, list):
        return [f'quantities must be a list of names, ["cof"], got {short(str(quantities))}']
    return [fault for one in quantities for fault in _tried(read_quantities, [one], ["v_0"])]


def _tried(check: Any, *arguments: Any) -> list[str]:
    try:
        check(*arguments)
    except (ValueError, TypeError) as fault:
        return [str(fault)]
    return []
