"""Case files: one TOML file describes one SlidingContact, strictly.

Tables and keys carry the names of the records and their fields, in SI. A key left out takes the record's
default, and no [pull] is a rigid pull:

    mu_0 = 0.5
    [indenter]
    shape = "Paraboloid"                      # any record of mdr.indenters
    R = 5e-3
    [material]
    model = "KelvinVoigt"                     # any record of mdr.materials
    E = 3e6
    nu = 0.5
    tau = 1e-3
    [oscillation]
    u_z0 = 20e-6
    du_z = 2e-6
    omega = 314.159
    [pull]
    k_x = 2e4
    [shake]
    omega = 314.159
    du_x = 3e-6

[oscillation] may name its record, motion = "LoadOscillation", and must name a ConstantDepth or ConstantLoad. Without a
name it is a LoadOscillation where one of the keys F_z0, dF_z, m_z is given, a PeriodicMotion where cos or sin is, and
else a NormalOscillation.
[shake] is left out where nothing moves in the plane besides the pull; without a name it is an InPlaneMotion where a
list of amplitudes is given, and else an InPlaneOscillation.
A Prony material has arms = [[E_j, tau_j], ...].

A file that is wrong is refused with every fault at once: what is missing, what is no key, each value that the rule of
its field refuses; and, of a record whose values are all sound, what they are refused for together.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import MISSING, Field, dataclass, fields, is_dataclass
from inspect import isabstract
from os import PathLike, fsdecode
from types import ModuleType
from typing import Any, NamedTuple

from mdr import indenters, materials
from mdr.case import in_plane, motion
from mdr.case.contact import SlidingContact, as_given
from mdr.case.in_plane import Shake
from mdr.case.motion import LoadOscillation, Motion, NormalOscillation
from mdr.case.pull import RigidPull, SpringPull
from mdr.files.own_records import own_records
from mdr.files.spellings import SPELLINGS, as_written, left_open, meant, other_spellings, respelled
from mdr.files.toml_text import NESTED, CaseFileError, fault_error, parse_toml, read_text, toml_value
from mdr.indenters import Indenter, Paraboloid
from mdr.materials import Elastic, Material
from mdr.normal.doubts import warn_outside
from mdr.normal.vary import contact_of, fields_set
from mdr.tools.fields import checked
from mdr.tools.messages import nearest, offer, one_line, short

# --- public ---


def read_case(path: str | PathLike[str]) -> SlidingContact:
    """The sliding contact that a TOML file describes, in SI.

    Parameters
    ----------
    path : str or path-like
        The case file.

    Returns
    -------
    SlidingContact
        The contact.

    Raises
    ------
    CaseFileError
        With every fault of the file, one a line.

    Examples
    --------
    >>> from pathlib import Path
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=vibration)
    >>> _ = Path("case.toml").write_text(mdr.write_case(case))
    >>> mdr.read_case("case.toml") == case
    True
    """
    return read_said(path).case


class Said(NamedTuple):
    """What a case file says."""

    case: SlidingContact
    held: dict[str, Any]  #: load [N] and tan_delta [-] given for fields that other tables decide about too


def read_said(path: str | PathLike[str]) -> Said:
    """The sliding contact of a TOML file, and what holds whatever else varies. Raises CaseFileError."""
    return _said(read_text(path), fsdecode(path))


def parse_case(text: str, source: str = "<string>") -> SlidingContact:
    """The sliding contact that a TOML text describes, in SI.

    Parameters
    ----------
    text : str
        The text of a case file.
    source : str
        What messages call the text.

    Returns
    -------
    SlidingContact
        The contact.

    Raises
    ------
    CaseFileError
        With every fault of the text, one a line.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=vibration)
    >>> mdr.parse_case(mdr.write_case(case)) == case
    True
    """
    if not isinstance(text, str):
        raise TypeError(f"text must be a string of TOML, got {text!r}")
    return _said(text, source).case


def _said(text: str, source: str) -> Said:
    try:
        content = parse_toml(text, source)
        return Said(case_of(content, source), left_open(content))
    except RecursionError:
        raise fault_error(source, [NESTED]) from None


def write_case(case: SlidingContact) -> str:
    """The text of a case file, TOML, that reads back as an equal case.

    Parameters
    ----------
    case : SlidingContact
        The contact.

    Returns
    -------
    str
        The text.

    Raises
    ------
    CaseFileError
        For what a file cannot carry: a Profile, which is a Python function, or a class of your own.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=vibration)
    >>> print(mdr.write_case(case))
    mu_0 = 0.4
    <BLANKLINE>
    [indenter]
    shape = "Cone"
    theta = 0.0127
    ...
    """
    return written(case, {})


def written(case: SlidingContact, held: Mapping[str, float]) -> str:
    """The same, with loads, frequencies and loss tangents for the fields that they set."""
    top, tables = [], []
    case = as_given(case)
    for field in _inputs(SlidingContact):
        value = getattr(case, field.name)
        if field.name not in _TABLES:
            top.append(f"{field.name} = {toml_value(value)}")
        elif value is not None and not isinstance(value, RigidPull):
            tables.append(_written(_TABLES[field.name], value, held))
    return "\n\n".join(["\n".join(top), *tables]) + "\n"


def case_of(content: Mapping[str, Any], source: str = "<string>", beside: Sequence[str] = ()) -> SlidingContact:
    """The case in tables already parsed; keys `beside` it are left alone. Raises CaseFileError with every fault."""
    known = _top_level()
    axes = content.get("axes")
    axes = axes if isinstance(axes, dict) else {}
    content = {key: value for key, value in content.items() if key not in beside}
    if "axes" in content:
        raise fault_error(source, [STUDY])
    faults = [_unknown_top(key, value, beside) for key, value in content.items() if key not in known]
    parts, of_tables = _read_tables(content)
    faults += [fault for found in of_tables.values() for fault in found]
    given = {key: _number(value) for key, value in content.items() if key in known and key not in _TABLES}
    refused = _field_faults(SlidingContact, {**_HARMLESS, **given})
    case: Any = None
    whole: list[str] = []
    if not faults:  # whether the parts fit each other shows whatever mu_0 is
        case, whole = _tried(contact_of, parts, {**({"mu_0": 1.0} if refused else given), **left_open(content)})
    if faults := [*faults, *refused, *whole]:
        raise fault_error(source, faults)
    assert isinstance(case, SlidingContact)
    _ask_for_masses(case, content, axes)
    return case


def _ask_for_masses(case: SlidingContact, content: Mapping[str, Any], axes: Mapping[str, Any]) -> None:
    """Warn of a body, and of a load that may ride on it, whose mass neither the tables nor the axes of a study say."""
    if "pull" in content and "m" not in content["pull"] and "pull.m" not in axes:
        warn_outside(
            "[pull] says no mass: give m in kg, or m = 0 for a body without inertia, which is what is computed"
        )
    m = case.pull.coefficients[0]
    silent = "m_z" not in content["oscillation"] and "oscillation.m_z" not in axes
    if m > 0 and isinstance(case.oscillation, LoadOscillation) and silent:
        warn_outside(
            f"the body has the mass m = {m:.6g} kg along the pull, and [oscillation] does not say which mass the load "
            f"moves: m_z = {m:.6g} if it presses on the body itself, which may change v_c several times, or m_z = 0"
        )


def stand_in(content: Mapping[str, Any]) -> tuple[SlidingContact | None, set[str]]:
    """A case of the tables that are sound, harmless ones for the others, and the names of those others.

    To find what else is wrong in a file whose case is refused; None where its tables do not fit each other.
    """
    parts, faults = _read_tables(content)
    sound = {name: part for name, part in parts.items() if name not in faults}
    said = left_open({name: table for name, table in content.items() if name in sound})
    return _tried(contact_of, {**_HARMLESS, **sound}, {"mu_0": 1.0, **said})[0], set(faults)


def _read_tables(content: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, list[str]]]:
    """The parts that the tables describe, and the faults of those tables that have some."""
    tables = {**_meant(content), **content}
    parts: dict[str, Any] = {}
    wrong: dict[str, list[str]] = {}
    for name, table in _TABLES.items():
        part, faults = table.read(tables)
        if faults:
            wrong[name] = faults
        elif part is not None:
            parts[name] = part
    return parts, wrong


def record_of(name: str, table: Any) -> tuple[Any, list[str]]:
    """The record that a table [name] of a list describes, or None; and the faults."""
    for alias in left_open({name: table}):
        fields = " or ".join(fields_set(alias))
        return None, [f"[{name}] {alias} cannot stand in a list of tables: give {fields}"]
    return _TABLES[name].read({name: table})


def nameable() -> dict[str, dict[str, type[Any]]]:
    """The records that a file can name, {table: {name: record}}; their fields are the keys."""
    return {name: table.writable() for name, table in _TABLES.items()}


# --- tables ---


@dataclass(frozen=True)
class _Table:
    """One table of the file: the records it may describe, and the key that chooses among them."""

    name: str
    choice: str  #: the key that names the record; empty where there is one record only
    module: ModuleType | None
    kind: type[Any]
    unnamed: tuple[type[Any], ...] = ()  #: records that need no name: the first with a key that the last has not

    def records(self) -> dict[str, type[Any]]:
        """Public records by name; for a new one it is enough to be public in its module."""
        if self.module is None:
            return {self.kind.__name__: self.kind}
        public = [name for name in vars(self.module) if not name.startswith("_")]
        found = {name: getattr(self.module, name) for name in getattr(self.module, "__all__", public)}
        found |= own_records(self.kind)
        return {name: found[name] for name in sorted(found) if self._is_record(found[name])}

    def _is_record(self, one: Any) -> bool:
        is_class = isinstance(one, type) and is_dataclass(one)
        return is_class and issubclass(one, self.kind) and not isabstract(one)

    def writable(self) -> dict[str, type[Any]]:
        """The records that a file can carry."""
        return {name: record for name, record in self.records().items() if _fits_a_file(record)}

    def keys(self, record: type[Any]) -> list[str]:
        """Keys of the table when it describes this record."""
        return [*([self.choice] if self.choice else []), *(field.name for field in _inputs(record))]

    def all_keys(self) -> set[str]:
        """Keys of the table whatever it describes."""
        return {key for record in self.writable().values() for key in self.keys(record)}

    def read(self, content: Mapping[str, Any]) -> tuple[Any, list[str]]:
        """The record described, or None; and the faults."""
        if self.name not in content:
            needed = any(field.name == self.name and _is_required(field) for field in fields(SlidingContact))
            return None, [f"[{self.name}] is missing"] if needed else []
        if not isinstance(content[self.name], dict):
            return None, [f"[{self.name}] must be one table of keys, got {_kind(content[self.name])}"]
        table, misspelt = respelled(self.name, content)
        record, fault = self._choose(table)
        if record:
            table = as_written(self.name, table, content, self.keys(record))
        made, faults = self._describe(record, table) if record else (None, [fault])
        return None if misspelt else made, [f"[{self.name}] {one}" for one in [*misspelt, *faults]]

    def _choose(self, table: Mapping[str, Any]) -> tuple[type[Any] | None, str]:
        """The record that the table names, or what is wrong with the name."""
        if self.unnamed and (not self.choice or self.choice not in table):
            return self._told_by(table), ""
        names, name = self.writable(), table.get(self.choice)
        others = f"choose one of {', '.join(names)}"
        if self.choice not in table:
            near = nearest(self.choice, [key for key in table if key not in self.all_keys()])
            return None, f"{self.choice} is missing{f', and {_bare(near)} unknown' if near else ''}; {others}"
        if not isinstance(name, str):
            return None, f"{self.choice} must be a name in quotes, got {_kind(name)}; {others}"
        if name not in names and name in self.records():
            return None, f'{self.choice} "{name}": {_CALLABLE}; {others}'
        return names.get(name), f"{self.choice} {short(json.dumps(name))} is unknown; {offer(name, list(names))}"

    def _told_by(self, keys: Iterable[str]) -> type[Any]:
        """The record of a table that does not name it."""
        *special, usual = self.unnamed
        telling = set(keys).difference(self.keys(usual))
        return next((record for record in special if telling.intersection(self.keys(record))), usual)

    def _describe(self, record: type[Any], table: Mapping[str, Any]) -> tuple[Any, list[str]]:
        """The record made of the keys of the table, or None; and the faults."""
        known = self.keys(record)
        unknown = [self._unknown(key, record) for key in table if key not in known]
        given = {key: _number(table[key]) for key in table if key in known and key != self.choice}
        faults = _field_faults(record, given, self._ways_out(record))
        made, together = (None, []) if faults else _tried(record, **given)
        return made, [*unknown, *faults, *together]

    def _ways_out(self, record: type[Any]) -> dict[str, str]:
        """What else may be given, or left out, in the place of a field that is missing."""
        if record is SpringPull:
            return {"k_x": "leave [pull] out for a rigid pull"}
        known = SPELLINGS.get(self.name, {})
        depth = {"u_z0": "or give load [N]"} if record is NormalOscillation else {}
        return {one.key: f"or give {alias} [{one.unit}]" for alias, one in known.items()} | depth

    def _unknown(self, key: str, record: type[Any]) -> str:
        """Say that a key is unknown, and its right spelling, its right place, or all there are."""
        known, whose = self.keys(record), f"{_bare(key)} is no key of {record.__name__}"
        if usual := meant(self.name, key):
            return f"{whose}; did you mean {usual}?"
        known += other_spellings(self.name, known)
        if key.casefold() not in {one.casefold() for one in known}:
            if key in _top_level() and key not in _TABLES:
                return f"{whose}; write it at the top of the file, above the first table"
            if homes := _homes(key, self):
                return f"{whose}; it belongs to {homes}"
        return f"{whose}; {offer(key, known)}"


_TABLES = {
    table.name: table
    for table in (
        _Table("indenter", "shape", indenters, Indenter),
        _Table("material", "model", materials, Material),
        _Table("oscillation", "motion", motion, Motion, motion.UNNAMED),
        _Table("pull", "", None, SpringPull, (SpringPull,)),
        _Table("shake", "motion", in_plane, Shake, in_plane.UNNAMED),
    )
}
_HARMLESS = {
    "indenter": Paraboloid(R=1.0),
    "material": Elastic(E=1.0, nu=0.5),
    "oscillation": NormalOscillation(u_z0=1.0, du_z=1.0, omega=1.0),
}
_NONE: Mapping[str, str] = {}
STUDY = "[axes] makes it a study file, not a case file; `mdr sweep` reads it"  #: a fault
_CALLABLE = "its shape is a Python function, which a file cannot carry"


def _inputs(record: type[Any]) -> list[Field[Any]]:
    return [field for field in fields(record) if field.init]


def _is_required(field: Field[Any]) -> bool:
    return field.default is MISSING and field.default_factory is MISSING


def _fits_a_file(record: type[Any]) -> bool:
    return not any("Callable" in str(field.type) for field in fields(record))


def _top_level() -> list[str]:
    return [field.name for field in _inputs(SlidingContact)]


def _homes(key: str, here: _Table | None = None) -> str:
    """The other tables that know a key."""
    return " or ".join(f"[{name}]" for name, one in _TABLES.items() if one is not here and key in one.all_keys())


def _unknown_top(key: str, value: Any, beside: Sequence[str]) -> str:
    """Say that a table, or a key outside the tables, is unknown."""
    if isinstance(value, dict):
        near = nearest(key, [*_TABLES, *beside])
        there = f"did you mean [{near}]?" if near else f"there are {', '.join(f'[{name}]' for name in _TABLES)}"
        return f"[{_bare(key)}] is no table of a case; {there}"
    keys = [*(name for name in _top_level() if name not in _TABLES), *beside]
    homes = _homes(key)
    return f"{_bare(key)} is no key outside the tables; " + (f"it belongs to {homes}" if homes else offer(key, keys))


def _meant(content: Mapping[str, Any]) -> dict[str, Any]:
    """Misnamed tables by the name that is offered for them, so that their own faults are told too."""
    unknown = {key: value for key, value in content.items() if isinstance(value, dict) and key not in _TABLES}
    return {near: value for key, value in unknown.items() if (near := nearest(key, list(_TABLES)))}


# --- from values to records ---


def _field_faults(record: type[Any], given: Mapping[str, Any], ways_out: Mapping[str, str] = _NONE) -> list[str]:
    """What is missing, then what each field refuses by its rule."""
    absent = [one.name for one in _inputs(record) if _is_required(one) and one.name not in given]
    refused = [_tried(checked, one, given[one.name])[1] for one in _inputs(record) if one.name in given]
    missing = [f"{name} is missing" + (f"; {ways_out[name]}" if name in ways_out else "") for name in absent]
    return missing + [fault for found in refused for fault in found]


def _tried(make: Callable[..., Any], *given: Any, **named: Any) -> tuple[Any, list[str]]:
    """What is made, or None and the words of the refusal."""
    try:
        return make(*given, **named), []
    except (TypeError, ValueError, ArithmeticError, LookupError) as refusal:
        return None, [one_line(str(refusal) or type(refusal).__name__)]


def _number(value: Any) -> Any:
    """The value; an integer beyond the range of floats becomes infinite, which every record refuses by name."""
    if isinstance(value, list):
        return [_number(one) for one in value]
    if isinstance(value, int) and not isinstance(value, bool):
        try:
            float(value)
        except OverflowError:
            return math.inf if value > 0 else -math.inf
    return value


# --- from records to text ---


def _written(table: _Table, record: Any, held: Mapping[str, float]) -> str:
    """One table of the file."""
    name, writable = type(record).__name__, table.writable()
    if table.records().get(name) is not type(record):
        raise CaseFileError(f"[{table.name}] {name} is none of the records a file can name: {', '.join(writable)}")
    if name not in writable:
        way_out = f"keep the case in a script, or use one of {', '.join(writable)}"
        raise CaseFileError(f"[{table.name}] {name}: {_CALLABLE}; {way_out}")
    values = {field.name: getattr(record, field.name) for field in _inputs(type(record))}
    spelt = {key: alias for alias in held for key in values if f"{table.name}.{key}" in fields_set(alias)}
    told = {spelt.get(key, key): held.get(spelt.get(key, ""), value) for key, value in values.items()}
    lines = [f"{key} = {toml_value(value)}" for key, value in told.items() if value is not None]
    named = table._told_by(values) is not type(record) if table.unnamed else True
    head = [f"[{table.name}]", *([f"{table.choice} = {toml_value(name)}"] if named else [])]
    return "\n".join(head + lines)


# --- messages ---


def _bare(name: str) -> str:
    """A key as TOML writes it: plain, or quoted where it holds other than letters, digits, _ and -."""
    return short(name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else json.dumps(name))


def _kind(value: Any) -> str:
    """What a TOML value is called."""
    names = {dict: "a table", list: "an array", str: "a string", bool: "true or false"}
    return names.get(type(value)) or short(str(value))
