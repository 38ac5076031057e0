"""The axes of a study: which field, group or velocity each one sets, and to which values.

A path is a field of the contact ("mu_0", "indenter", "material.tau"), what a rig is set to, a dimensionless group, or
the velocity:

    load            mean load [N]            sets oscillation.F_z0, or u_z0 to the depth at which the load rests
    frequency       [Hz]                     sets omega of oscillation and shake
    tan_delta       at this frequency        sets material.tau
    alpha           du_z/u_z0                sets oscillation.du_z
    chi             du_x/(mu_0 kappa u_z0)   sets shake.du_x
    eta             du_y/(mu_0 kappa u_z0)   sets shake.du_y
    T               omega tau                sets material.tau
    k_x/k_xc        over the contact's       sets pull.k_x
    omega_0/omega   sqrt(k_x/m)/omega        sets pull.m
    v_0, v_0/v_c    pulling velocity [m/s], or over the critical velocity of each case; 0 is the static limit

These are set last, in this order, so that each has its value in the end. A path that none of the cases has is
refused at once; one that some of them lack is a failure of those points.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mdr.case.contact import KINDS, SlidingContact
from mdr.case.paths import GROUPS, RIG, VELOCITIES, facts_at, fields_at, fields_set, require_apart, set_in, slot_of
from mdr.tools.arrays import Array
from mdr.tools.checks import finite_array
from mdr.tools.messages import nearest, one_line, short
from mdr.tools.records import ArrayRecord

_ADDRESS = re.compile(r" at 0x[0-9a-fA-F]+")


@dataclass(frozen=True, eq=False, repr=False)
class Axis(ArrayRecord):
    """One axis of a study; two are equal by path and values, records by their labels."""

    path: str  #: what it sets
    values: Array | tuple[Any, ...]  #: numbers as an array (n,), anything else as a tuple
    labels: tuple[str, ...] = ()  #: what values that are no numbers are called

    @classmethod
    def known(cls, path: str, values: Sequence[Any] | Array) -> Axis:
        """An axis of numbers, or of records of which the labels are known alone."""
        if isinstance(values[0], str):
            return cls(path, tuple(values), tuple(values))
        return cls(path, np.array(values, dtype=float))

    def _values(self) -> tuple[Any, ...]:
        return self.path, self.values if self.is_numeric else None, self.labels

    def __len__(self) -> int:
        return len(self.values)

    def __getitem__(self, index: int) -> Any:
        return float(self.values[index]) if self.is_numeric else self.values[index]

    @property
    def is_numeric(self) -> bool:
        """Whether its values are numbers."""
        return isinstance(self.values, np.ndarray)

    @property
    def is_velocity(self) -> bool:
        """Whether it is the pulling velocity."""
        return self.path in VELOCITIES

    @property
    def unit(self) -> str:
        """Unit of its values, "-" for pure numbers and "" where there is none or it depends on the record."""
        return facts_at(self.path).unit

    @property
    def meaning(self) -> str:
        """What it is, in words."""
        return facts_at(self.path).meaning or self.path

    @property
    def summary(self) -> str:
        """Its values in a few words."""
        if not self.is_numeric:
            return short("; ".join(self.labels), 160)
        numbers = np.asarray(self.values)
        if numbers.size <= 4:
            return ", ".join(f"{value:.6g}" for value in numbers)
        return f"{numbers.size} values from {numbers.min():.6g} to {numbers.max():.6g}"

    def told(self, index: int) -> str:
        """One value of the axis as text."""
        return repr(self[index]) if self.is_numeric else self.labels[index]

    def index(self, value: Any) -> int:
        """Position of a value on the axis; ValueError, with the nearest value, if it is not there."""
        if not self.is_numeric:
            for i, known in enumerate(self.values):
                if (type(known) is type(value) and known == value) or value == self.labels[i]:
                    return i
            raise ValueError(f"{self.path} has no value {short(repr(value))}; there are {', '.join(self.labels)}")
        try:
            asked = float(value)
        except (TypeError, ValueError):
            raise ValueError(f"{self.path} has numbers for values, got {short(repr(value))}") from None
        nearest_one = int(np.argmin(np.abs(np.asarray(self.values) - asked)))
        if self[nearest_one] != asked:
            raise ValueError(f"{self.path} has no value {asked!r}; the nearest is {self[nearest_one]!r}")
        return nearest_one


def read_axes(case: SlidingContact, axes: Mapping[str, Any]) -> tuple[Axis, ...]:
    """The axes of a study of this case; ValueError or TypeError for what can never be set."""
    if not isinstance(axes, Mapping):
        raise TypeError(f"axes must map paths to values, such as {{'v_0': [...]}}, got {short(repr(axes))}")
    if not axes:
        raise ValueError("axes must name at least one path and its values, such as {'v_0': [...]}")
    for path in axes:
        if not isinstance(path, str):
            raise TypeError(f"axes must have paths in quotes for keys, got {path!r}")
    require_apart(list(axes))
    own = {slot: () if getattr(case, slot) is None else (getattr(case, slot),) for slot in KINDS}
    parts = own | {slot: _records(slot, axes[slot]) for slot in KINDS if slot in axes}
    for path in axes:
        _require_path(path, parts)
    return tuple(_axis(path, values, parts) for path, values in axes.items())


def label_of(value: Any) -> str:
    """Label of a value that is no number, the same in every run."""
    return one_line(without_addresses(repr(value)), 160)


def without_addresses(text: str) -> str:
    """A text without addresses in memory, which Python prints for some objects."""
    return _ADDRESS.sub("", text)


def _axis(path: str, values: Any, parts: Mapping[str, tuple[Any, ...]]) -> Axis:
    if path in parts:
        return Axis(path, parts[path], _distinct(path, parts[path]))
    slot, field = slot_of(path)
    having = [getattr(part, field) for part in parts.get(slot, ()) if field in set_in(part)]
    if any(not isinstance(value, int | float | None) for value in having):
        others = tuple(_frozen(one) for one in _listed(path, values))
        return Axis(path, others, _distinct(path, others))
    return Axis(path, _numbers(path, values, signed=bool(parts["shake"])))


def _numbers(path: str, values: Any, signed: bool) -> Array:
    unit = facts_at(path).unit
    listed = _listed(path, values)
    if any(isinstance(one, bool) for one in listed):
        raise TypeError(f"{path} must be real numbers, got {short(repr(values))}")
    try:
        numbers = np.array(finite_array(path, listed, "" if unit == "-" else unit))  # a copy: the study keeps it
    except (TypeError, ValueError) as refusal:  # which quotes all that was given
        raise type(refusal)(short(str(refusal), 160)) from None
    if numbers.ndim != 1:
        raise ValueError(f"{path} must be a plain list of values, got an array of shape {numbers.shape}")
    ordered = np.sort(numbers)
    if twice := ordered[1:][ordered[1:] == ordered[:-1]].tolist():
        raise ValueError(f"{path} has the value {twice[0]!r} twice; give each once")
    if path in VELOCITIES and ordered[0] < 0 and not signed:
        raise ValueError(f"{path} must not be negative, got {float(ordered[0])!r}; 0 is the static limit")
    return numbers


def _listed(path: str, values: Any) -> list[Any]:
    if isinstance(values, str | bytes | Mapping | set | frozenset) or not isinstance(values, Iterable):
        raise TypeError(f"{path} must be a list of values, got {short(repr(values))}; write [...]")
    listed = list(values)
    if not listed:
        raise ValueError(f"{path} has no values: give at least one, or leave the axis out")
    return listed


def _frozen(value: Any) -> Any:
    """Lists as tuples, however deep."""
    return tuple(_frozen(one) for one in value) if isinstance(value, list | tuple | np.ndarray) else value


def _records(slot: str, values: Any) -> tuple[Any, ...]:
    records = tuple(_listed(slot, values))
    for one in records:
        if not isinstance(one, KINDS[slot]):
            kind = KINDS[slot].__name__
            raise TypeError(f"{slot} must be a list of records of kind {kind}, got {short(repr(one))} among them")
    return records


def _distinct(path: str, values: tuple[Any, ...]) -> tuple[str, ...]:
    """A label for each value, all different; ValueError for a value that is given twice."""
    labels: list[str] = []
    seen: dict[str, list[Any]] = {}
    for value in values:
        label = label_of(value)
        alike = seen.setdefault(label, [])
        if any(type(one) is type(value) and one == value for one in alike):
            raise ValueError(f"{path} has the value {label} twice; give each once")
        alike.append(value)
        labels.append(label if len(alike) == 1 else f"{label} ({len(alike)})")
    return tuple(labels)


def _require_path(path: str, parts: Mapping[str, tuple[Any, ...]]) -> None:
    """Refuse a path that no case of the study has."""
    sets = [(field, part) for slot, field in map(slot_of, fields_set(path)) for part in parts.get(slot, ())]
    if path in (*VELOCITIES, *parts) or any(field in set_in(part) for field, part in sets):
        return
    of_parts = dict.fromkeys(one for slot, has in parts.items() for part in has for one in fields_at(slot, part))
    slot, field = slot_of(fields_set(path)[0 if path in GROUPS else -1])
    names = sorted({type(part).__name__ for part in parts.get(slot, ())}) or [f"a case without {slot}"]
    if path in GROUPS or path in RIG:
        raise ValueError(f"{path} sets {slot}.{field}, which {' and '.join(names)} has not; give one that has it")
    of_friction = [one for one in of_parts if "." not in one]
    known = list(dict.fromkeys((*VELOCITIES, *of_friction, *parts, *RIG, *GROUPS, *of_parts)))
    homes = [one for one in known if one.endswith(f".{path}")]
    meant = homes[0] if homes else nearest(path, known)
    whose = f"; {' and '.join(names)} has none" if slot in parts and "." in path else ""
    there = f"did you mean {meant}?" if meant else f"there are {', '.join(known)}"
    raise ValueError(f"{short(path)} is no path of this case{whose}; {there}")
