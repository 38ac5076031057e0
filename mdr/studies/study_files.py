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

A load, frequency or loss tangent that the file gives holds in every case, unless an axis sets what it sets; of the load
its mean, where hold = "load" stands beside it.

A file that is wrong is refused with every fault at once.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from os import PathLike, fsdecode
from typing import Any

import numpy as np

from mdr.case.contact import KINDS, SlidingContact
from mdr.case.paths import facts_at, fields_set
from mdr.case.pull import RigidPull
from mdr.files.case_files import record_of
from mdr.files.toml_text import CaseFileError, parse_toml, read_text, told, tried
from mdr.friction.cof_curve import require_knobs
from mdr.given.case_file import case_of, stand_in
from mdr.march.periodic.steady import BUDGET, accuracy_of
from mdr.studies.axes import read_axes
from mdr.studies.quantities import read_quantities
from mdr.studies.work import MOST_NUMBERS
from mdr.tools.checks import count, finite, word
from mdr.tools.messages import offer, short
from mdr.tools.notation import numbers_in

KEYS = ("axes", "quantities", "n_springs", "steps_per_period", "accuracy")


@dataclass(frozen=True)
class StudyFile:
    """What a study file asks for; `mdr.sweep(**vars(file))` does it."""

    case: SlidingContact
    axes: dict[str, Any]
    quantities: tuple[str, ...]
    n_springs: int | None
    steps_per_period: int | None
    accuracy: float
    held: dict[str, Any]  #: load [N], with hold, and tan_delta [-] that it gives


def read_study_file(path: str | PathLike[str]) -> StudyFile:
    """The study in a TOML file. Raises CaseFileError with every fault."""
    return parse_study(read_text(path), source=fsdecode(path))


def parse_study(text: str, source: str = "<string>") -> StudyFile:
    """The study in a TOML text; messages call it `source`. Raises CaseFileError with every fault."""
    content = parse_toml(text, source)
    with told(f"{source}: "):
        return study_from(content)


def study_from(content: Mapping[str, Any]) -> StudyFile:
    """The study in tables already parsed. Raises CaseFileError with every fault."""
    axes, faults = _read_axes(content.get("axes"), "shake" in content)
    quantities = content.get("quantities", ["cof"])
    faults += _faults_of_names(quantities)
    knobs = {name: content.get(name) for name in ("n_springs", "steps_per_period")}
    faults += [fault for name, knob in knobs.items() for fault in tried(require_knobs, **{name: knob})[1]]
    accuracy = content.get("accuracy", BUDGET)
    faults += tried(accuracy_of, accuracy)[1]
    try:
        case, held = case_of(content, beside=KEYS)
    except CaseFileError as of_case:
        faults += _faults_behind(content, axes)
        raise CaseFileError.of([*of_case.faults, *faults]) from None
    faults += _faults_of_axes(case, axes)
    faults = faults or tried(read_quantities, quantities, axes)[1]
    if faults:
        raise CaseFileError.of(faults)
    return StudyFile(case, axes, tuple(quantities), **knobs, accuracy=accuracy, held=held)


# --- axes ---


def _read_axes(table: Any, is_shaken: bool) -> tuple[dict[str, Any], list[str]]:
    """Values by path, those that are well written, and what is wrong with the others."""
    if table is None:
        return {}, ['[axes] is missing; a study varies something, such as "v_0/v_c" = [0.5, 0.9]']
    if not isinstance(table, dict) or not table:
        return {}, ["[axes] must be a table of paths and their values"]
    read = {path: tried(_read_values, path, written, is_shaken) for path, written in table.items()}
    faults = [f"[axes] {fault}" for _, found in read.values() for fault in found]
    return {path: values for path, (values, found) in read.items() if not found}, faults


def _read_values(path: str, written: Any, is_shaken: bool) -> Any:
    """The values of an axis; CaseFileError or ValueError for what is wrong with them."""
    if isinstance(written, dict) and not set(written) & set(_RANGE) and path in KINDS:
        example = next(iter(written), "...")
        raise ValueError(
            f'{path}.{example} must be in quotes, "{path}.{example}" = [...]; {path} itself a list of tables'
        )
    if isinstance(written, dict):
        return _range(path, written)
    if not isinstance(written, list):
        raise ValueError(f"{path} must be a list of values or {{ from = , to = , n = }}, got {short(str(written))}")
    if path not in KINDS:
        return numbers_in(path, written, facts_at(path).unit)
    rigid = path == "pull"
    read = [(RigidPull(), []) if rigid and one == {} else tried(record_of, path, one, is_shaken) for one in written]
    if faults := [fault for _, found in read for fault in found]:
        raise CaseFileError.of(faults)
    return [record for record, _ in read]


def _number_of_values(name: str, value: Any) -> None:
    if count(name, value, 2) > MOST_NUMBERS:
        raise ValueError(f"{name} must be at most {MOST_NUMBERS}, got {value}")


def _spacing(name: str, value: Any) -> None:
    word(name, value, "linear", "log")


#: keys of a range, and what each must be
_RANGE: dict[str, Callable[..., Any]] = {"from": finite, "to": finite, "n": _number_of_values, "spacing": _spacing}


def _range(path: str, written: Mapping[str, Any]) -> Any:
    """Equidistant values, or values in equal ratios."""
    known = list(_RANGE)
    faults = [f"{path}: {short(key)} is no key of a range; {offer(key, known)}" for key in written if key not in known]
    faults += [f"{path}: {key} is missing from the range" for key in known[:3] if key not in written]
    units = dict.fromkeys(("from", "to"), facts_at(path).unit)
    given = {key: written[key] for key in _RANGE if key in written}
    read = {key: tried(numbers_in, f"{path}: {key}", one, units.get(key, "")) for key, one in given.items()}
    for key, (value, unread) in read.items():
        faults += unread or tried(_RANGE[key], f"{path}: {key}", value)[1]
    if faults:
        raise CaseFileError.of(faults)
    low, high, n = float(read["from"][0]), float(read["to"][0]), written["n"]
    if written.get("spacing") != "log":
        return np.linspace(low, high, n)
    if min(low, high) <= 0:
        raise ValueError(f'{path}: a range with spacing = "log" must be positive, got {low:g} to {high:g}')
    return np.geomspace(low, high, n)


# --- faults that only the case tells ---


def _faults_of_axes(case: SlidingContact, axes: Mapping[str, Any]) -> list[str]:
    """Faults of each axis together with those of records, then of all axes together."""
    records = {path: axes[path] for path in axes if path in KINDS}
    alone = [tried(read_axes, case, {**records, path: axes[path]})[1] for path in axes]
    found = list(dict.fromkeys(fault for faults in alone for fault in faults))
    return [f"[axes] {fault}" for fault in found or (tried(read_axes, case, axes)[1] if axes else [])]


def _faults_behind(content: Mapping[str, Any], axes: Mapping[str, Any]) -> list[str]:
    """Faults of the axes although the case is refused: of those axes that do not set what is wrong in the case."""
    case, unsound = stand_in(content, KEYS)
    slots = {path: {field.partition(".")[0] for field in fields_set(path)} for path in axes}
    seen = {path: axes[path] for path, those in slots.items() if not those & unsound}
    return _faults_of_axes(case, seen) if case is not None else []


def _faults_of_names(quantities: Any) -> list[str]:
    """Faults of each quantity, as if there were an axis of velocity."""
    if not isinstance(quantities, list):
        return [f'quantities must be a list of names, ["cof"], got {short(str(quantities))}']
    return [fault for one in quantities for fault in tried(read_quantities, [one], ["v_0"])[1]]
