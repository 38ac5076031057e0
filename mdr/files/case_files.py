"""Case files: one TOML file describes one SlidingContact, strictly.

Tables and keys carry the names of the records and their fields, in SI. A key left out takes the record's
default, and no [pull] is a rigid pull:

    mu_0 = 0.5                                # friction; beside it tau_0, a shear strength [Pa], or mu_s
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
    omega = "50 Hz"                           # or a quantity, in quotes
    du_x = "3 um"

[oscillation] may name its record, motion = "LoadOscillation". Without a name it is a LoadOscillation where one of the
keys F_z0, dF_z, m_z is given, a PeriodicMotion where cos or sin is, and else a NormalOscillation; beside a [shake] a
load alone is a ConstantLoad, u_z0 alone a ConstantDepth.
[shake] is left out where nothing moves in the plane besides the pull; without a name it is an InPlaneMotion where a
list of amplitudes is given, and else an InPlaneOscillation.
[friction], with the name kind = "ShearStrength", may stand in the place of mu_0, tau_0 and mu_s above the tables.
A Prony material has arms = [[E_j, tau_j], ...]. With E_0 or G_0, the instantaneous modulus, they are shares of it.

In the place of a field a file may give what a rig is set to (`mdr.case.paths`): frequency [Hz], load [N], tan_delta,
theta_deg. Beside a load, hold = "load" says that it is the mean over the period, hold = "depth" that it
rests at the mean depth. Files are written in the fields of the records.

A file that is wrong is refused with every fault at once: what is missing, what is no key, each value that the rule of
its field refuses; and, of a record whose values are all sound, what they are refused for together.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from inspect import isabstract
from types import ModuleType
from typing import Any, NamedTuple

from mdr import indenters, materials
from mdr.case import friction, in_plane, motion, pull
from mdr.case.contact import KINDS, SlidingContact, as_given
from mdr.case.friction import SHORTHAND
from mdr.case.motion import NormalOscillation
from mdr.case.paths import HOLD, OPEN, SetPath, fields_set, hold_of, settings_of
from mdr.case.pull import RigidPull, SpringPull
from mdr.files import relative_moduli
from mdr.files.own_records import own_records
from mdr.files.toml_text import CaseFileError, field_faults, told, toml_value, tried
from mdr.tools.fields import example_of, fields_of, units_of
from mdr.tools.messages import nearest, offer, short
from mdr.tools.notation import numbers_in


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


def written(case: SlidingContact, held: Mapping[str, Any]) -> str:
    """The same, with loads, frequencies and loss tangents for the fields that they set."""
    case = as_given(case)
    parts = [(name, getattr(case, name)) for name in KINDS]
    told = [_written(_TABLES[name], one, held) for name, one in parts if one and not isinstance(one, RigidPull)]
    return "\n\n".join(sorted(told, key=lambda text: text.startswith("["))) + "\n"  # numbers above the tables first


def write_table(name: str, record: Any) -> str:
    """The table of one record, without what stands around it in a case file."""
    return _written(_TABLES[name], record, {})


class Tables(NamedTuple):
    """What the tables of a case file say, as far as they are sound; what is wrong with them is among the faults."""

    parts: dict[str, Any]  #: a record each
    held: dict[str, Any]  #: load [N], with hold, and tan_delta [-], for fields that other tables decide about too
    unsound: set[str]  #: parts with faults
    faults: list[str]  #: names that are none, then those of tables
    refused: list[str]  #: of friction


def read_tables(content: Mapping[str, Any], beside: Sequence[str] = ()) -> Tables:
    """What tables already parsed say; keys `beside` them are left alone. Raises CaseFileError for a study file."""
    content = {key: value for key, value in content.items() if key not in beside}
    if "axes" in content:
        raise CaseFileError(STUDY)
    faults = [_unknown_top(key, value, beside) for key, value in content.items() if key not in (*_TABLES, *SHORTHAND)]
    tables = {**_meant(content), **content}
    tables |= {"oscillation": _still(tables["oscillation"])} if {"shake", "oscillation"} <= set(tables) else {}
    asked = [name for name in _TABLES if name != "friction" and (name in tables or name in HARMLESS)]
    described = {name: tried(_TABLES[name].read, tables.get(name)) for name in asked}
    faults += [fault for _, wrong in described.values() for fault in wrong]
    described["friction"] = tried(_law, {key: content[key] for key in SHORTHAND if key in content}, tables)
    sound = {name: found for name, (found, wrong) in described.items() if not wrong}
    held = {key: value for _, own in sound.values() for key, value in own.items()}
    parts = {name: part for name, (part, _) in sound.items()}
    return Tables(parts, held, described.keys() - sound.keys(), faults, described["friction"][1])


def _law(numbers: Mapping[str, Any], tables: Mapping[str, Any]) -> tuple[Any, dict[str, Any]]:
    """The law of friction, of a table, or of the numbers above the tables."""
    if {"mu_0", "mu_k"} <= set(numbers):
        raise CaseFileError("mu_0 and mu_k say the same: give one of them")
    if {"mu_s", "tau_0"} <= set(numbers):
        raise CaseFileError(friction.NO_LAW)
    if "mu_s" in numbers:
        numbers = {"mu_k" if key == "mu_0" else key: value for key, value in numbers.items()}
    if "friction" not in tables:
        return _TABLES["friction"].described(numbers)
    if numbers:
        raise CaseFileError(f"{' and '.join(numbers)} and [friction] say the same: give one of them")
    return _TABLES["friction"].read(tables["friction"])


def _still(table: Any) -> Any:
    """The table [oscillation] of a contact that is shaken in the plane; a lone load or depth is a constant one."""
    alone = set(table) - {HOLD} if isinstance(table, dict) else set()
    constant = next((kind for kind, keys in _ALONE.items() if alone and alone <= keys), None)
    return {"motion": constant, **table} if constant else table


def record_of(name: str, table: Any, is_shaken: bool = False) -> Any:
    """The record that a table [name] of a list describes. Raises CaseFileError with every fault."""
    record, held = _TABLES[name].read(_still(table) if name == "oscillation" and is_shaken else table)
    for key in held:
        raise CaseFileError(f"[{name}] {key} cannot stand in a list of tables: give {' or '.join(fields_set(key))}")
    return record


def nameable() -> dict[str, dict[str, type[Any]]]:
    """The records that a file can name, {table: {name: record}}; their fields are the keys."""
    return {name: table.writable() for name, table in _TABLES.items()}


# --- tables ---


@dataclass(frozen=True)
class _Table:
    """One table of the file: the records it may describe, and the key that chooses among them."""

    name: str
    choice: str  #: the key that names the record; empty where there is one record only
    module: ModuleType
    unnamed: tuple[type[Any], ...] = ()  #: records that need no name: the first with a key that the last has not

    def records(self) -> dict[str, type[Any]]:
        """Public records by name; for a new one it is enough to be public in its module."""
        kind = KINDS[self.name] if self.choice else SpringPull
        known = {name: getattr(self.module, name) for name in self.module.__all__} | own_records(kind)
        return {
            name: known[name]
            for name in sorted(known)
            if issubclass(known[name], kind) and is_dataclass(known[name]) and not isabstract(known[name])
        }

    def writable(self) -> dict[str, type[Any]]:
        """The records that a file can carry."""
        return {
            name: record
            for name, record in self.records().items()
            if not any("Callable" in str(field.type) for field in fields(record))
        }

    def keys(self, record: type[Any]) -> list[str]:
        """Keys of the table when it describes this record."""
        return [*([self.choice] if self.choice else []), *fields_of(record)]

    def all_keys(self) -> set[str]:
        """Keys of the table whatever it describes."""
        return {key for record in self.writable().values() for key in self.keys(record)}

    def read(self, table: Any) -> tuple[Any, dict[str, Any]]:
        """The record described, and what holds for its fields that other tables decide about too."""
        with told(f"[{self.name}] "):
            if table is None:
                raise CaseFileError("is missing")
            if not isinstance(table, dict):
                raise CaseFileError(f"must be one table of keys, got {_kind(table)}")
            return self.described(table)

    def described(self, table: Mapping[str, Any]) -> tuple[Any, dict[str, Any]]:
        """The same of a table whose faults are told without its name."""
        record = self._choose(table)
        return self._describe(record, relative_moduli.material_of(record, table))

    def _choose(self, table: Mapping[str, Any]) -> type[Any]:
        """The record that the table names."""
        if self.unnamed and (not self.choice or self.choice not in table):
            return self.told_by(table)
        names, name = self.writable(), table.get(self.choice)
        if isinstance(name, str) and name in names:
            return names[name]
        others = f"choose one of {', '.join(names)}"
        if self.choice not in table:
            near = nearest(self.choice, [key for key in table if key not in self.all_keys()])
            raise CaseFileError(f"{self.choice} is missing{f', and {_bare(near)} unknown' if near else ''}; {others}")
        if not isinstance(name, str):
            raise CaseFileError(f"{self.choice} must be a name in quotes, got {_kind(name)}; {others}")
        if name in self.records():
            raise CaseFileError(f'{self.choice} "{name}": {_CALLABLE}; {others}')
        written = short(json.dumps(name, ensure_ascii=False))
        raise CaseFileError(f"{self.choice} {written} is unknown; {offer(name, list(names))}")

    def told_by(self, table: Mapping[str, Any]) -> type[Any]:
        """The record of a table that does not name it; a load without amplitudes of depth is a LoadOscillation's."""
        *special, usual = self.unnamed
        of_load = "load" in table and not {"du_z", "cos", "sin"}.intersection(table)
        telling = {*table, *(("F_z0",) if of_load else ())} - {*self.keys(usual)}
        return next((record for record in special if telling.intersection(self.keys(record))), usual)

    def _describe(self, record: type[Any], table: Mapping[str, Any]) -> tuple[Any, dict[str, Any]]:
        """The record made of the keys of the table, and what is held."""
        known, settings, units = self.keys(record), settings_of(self.name), units_of(record)
        given: dict[str, Any] = {}
        held: dict[str, Any] = {}
        faults: list[str] = []
        spoilt: set[str | None] = set()
        for key, value in table.items():
            if key == HOLD and self.name == "oscillation":
                continue
            setting = settings.get(key)
            field = setting.field_of(self.name, record) if setting else key
            if field not in known:
                faults.append(self._unknown(key, record))
            elif setting is not None and field in table:
                faults.append(f"{key} and {field} say the same: give one of them")
            else:
                said, wrong = tried(_number_at, key, value, setting or units.get(key, ""))
                faults += wrong
                spoilt |= {field} if wrong else set()
                # a stand-in for what is held: a number above zero that lifts nothing off
                given |= {} if wrong else {field: min(1e-99, said) if setting and field in OPEN else said}
                held |= {key: said} if setting and field in OPEN and not wrong else {}
        given.pop(self.choice, None)
        if HOLD in table and self.name == "oscillation":
            hold, wrong = tried(_hold_beside, table[HOLD], table, record)
            faults += wrong
            held |= {HOLD: hold} if "load" in held and not wrong else {}
        refused = field_faults(record, given, self._ways_out(record), spoilt)
        made, together = (None, []) if refused or spoilt else tried(record, **given)
        if faults := [*faults, *refused, *together]:
            raise CaseFileError.of(faults)
        return made, held

    def _ways_out(self, record: type[Any]) -> dict[str | None, str]:
        """What else may be given, or left out, in the place of a field that is missing."""
        if record is SpringPull:
            return {"k_x": "leave [pull] out for a rigid pull"}
        aliases = settings_of(self.name).items()
        return {one.field_of(self.name, record): f"or give {alias} [{one.facts.unit}]" for alias, one in aliases}

    def _unknown(self, key: str, record: type[Any]) -> str:
        """Say that a key is unknown, and its right spelling, its right place, or all there are."""
        known, whose = self.keys(record), f"{_bare(key)} is no key of {record.__name__}"
        settings = settings_of(self.name)
        if key in settings:
            return f"{whose}; it stands for {' or '.join(settings[key].fields)} of other records"
        aliases = [alias for alias, one in settings.items() if one.field_of(self.name, record)]
        aliases += [HOLD] if self.name == "oscillation" else []
        if key.casefold() in FREQUENCY and "frequency" in aliases:
            return f"{whose}; did you mean frequency?"
        if self.name == "oscillation" and key.casefold() in ACCELERATION:
            return f"{whose}; {ACCELERATION_OF}"
        if key.casefold() not in {one.casefold() for one in known}:
            if key in SHORTHAND:
                way_out = "leave kind out" if self.name == "friction" else "write it above the first table of the file"
                return f"{whose}; {way_out}"
            if homes := _homes(key, self):
                return f"{whose}; it belongs to {homes}"
        return f"{whose}; {offer(key, [*known, *aliases])}"


_TABLES = {
    "indenter": _Table("indenter", "shape", indenters),
    "material": _Table("material", "model", materials),
    "friction": _Table("friction", "kind", friction, friction.UNNAMED),
    "oscillation": _Table("oscillation", "motion", motion, motion.UNNAMED),
    "pull": _Table("pull", "", pull, (SpringPull,)),
    "shake": _Table("shake", "motion", in_plane, in_plane.UNNAMED),
}
#: what [oscillation] is beside a [shake] if it says no more than this
_ALONE = {"ConstantLoad": {"load", "F_z0"}, "ConstantDepth": {"u_z0"}}
#: a sound record for each part that a case cannot do without
HARMLESS = {
    "indenter": example_of(indenters.Paraboloid),
    "material": example_of(materials.Elastic),
    "friction": example_of(friction.Coulomb),
    "oscillation": example_of(NormalOscillation),
}
FREQUENCY = ("f", "freq", "hz")  #: what nobody should have to guess
ACCELERATION = ("acceleration", "accel", "acc", "a", "a_z")
ACCELERATION_OF = (
    "of what a mass stands on, give support_acceleration; of the indenter against the half-space du_z, which is "
    "acceleration/omega²"
)
STUDY = "[axes] makes it a study file, not a case file; `mdr sweep` reads it"  #: a fault
_CALLABLE = "its shape is a Python function, which a file cannot carry"


def _homes(key: str, here: _Table | None = None) -> str:
    """The other tables that know a key."""
    return " or ".join(f"[{name}]" for name, one in _TABLES.items() if one is not here and key in one.all_keys())


def _unknown_top(key: str, value: Any, beside: Sequence[str]) -> str:
    """Say that a table, or a key outside the tables, is unknown."""
    if isinstance(value, dict):
        near = nearest(key, [*_TABLES, *beside])
        there = f"did you mean [{near}]?" if near else f"there are {', '.join(f'[{name}]' for name in _TABLES)}"
        return f"[{_bare(key)}] is no table of a case; {there}"
    keys = [*SHORTHAND, *beside]
    homes = _homes(key)
    return f"{_bare(key)} is no key outside the tables; " + (f"it belongs to {homes}" if homes else offer(key, keys))


def _meant(content: Mapping[str, Any]) -> dict[str, Any]:
    """Misnamed tables by the name that is offered for them, so that their own faults are told too."""
    unknown = {key: value for key, value in content.items() if isinstance(value, dict) and key not in _TABLES}
    return {near: value for key, value in unknown.items() if (near := nearest(key, list(_TABLES)))}


# --- from values to records ---


def _hold_beside(value: Any, table: Mapping[str, Any], record: type[Any]) -> str:
    """What stays of the load in a table [oscillation]."""
    hold = hold_of(value)
    if "F_z0" in fields_of(record):
        if hold == "depth":
            raise ValueError(f'hold = "depth" is about a driven depth, and under a {record.__name__} the load is given')
    elif "load" not in table:
        raise ValueError("hold says what stays of a load: give load [N] in the place of u_z0, or leave hold out")
    return hold


def _number_at(key: str, value: Any, of: SetPath | str) -> Any:
    """What a key says: quantities as numbers, of a field with this unit, or of what a setting stands for."""
    if isinstance(of, str):
        return numbers_in(key, value, of)
    return of.told(key, numbers_in(key, value, of.facts.unit))


# --- from records to text ---


def _written(table: _Table, record: Any, held: Mapping[str, Any]) -> str:
    """One table of the file."""
    name, writable = type(record).__name__, table.writable()
    if table.records().get(name) is not type(record):
        raise CaseFileError(f"[{table.name}] {name} is none of the records a file can name: {', '.join(writable)}")
    if name not in writable:
        way_out = f"keep the case in a script, or use one of {', '.join(writable)}"
        raise CaseFileError(f"[{table.name}] {name}: {_CALLABLE}; {way_out}")
    values = {field: getattr(record, field) for field in fields_of(record)}
    values = relative_moduli.told(values, type(record))
    spelt = {key: alias for alias in held for key in values if f"{table.name}.{key}" in fields_set(alias)}
    given = {spelt.get(key, key): held.get(spelt.get(key, ""), value) for key, value in values.items()}
    given |= {HOLD: held[HOLD]} if HOLD in held and "load" in given else {}
    lines = [f"{key} = {toml_value(value)}" for key, value in given.items() if value is not None]
    named = not table.unnamed or table.told_by(values) is not type(record)
    choice = [f"{table.choice} = {toml_value(name)}"] if named else []
    title = [f"[{table.name}]"] if named or table.name != "friction" else []
    return "\n".join([*title, *choice, *lines])


# --- messages ---


def _bare(name: str) -> str:
    """A key as TOML writes it: plain, or quoted where it holds other than letters, digits, _ and -."""
    return short(name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else json.dumps(name, ensure_ascii=False))


def _kind(value: Any) -> str:
    """What a TOML value is called."""
    names = {dict: "a table", list: "an array", str: "a string", bool: "true or false"}
    return names.get(type(value)) or short(str(value))
