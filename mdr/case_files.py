"""Case files: one TOML file describes one SlidingContact, strictly.

Tables and keys carry the names of the records and their fields, in SI; a key left out takes the record's default, and no [pull] is a
rigid pull:

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

A file that is wrong is refused with every fault at once. Values are checked by the records themselves; to go on behind a wrong or missing
one, several harmless numbers take its place in turn, and only what is refused with each of them counts as a further fault.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import MISSING, Field, dataclass, fields, is_dataclass
from difflib import get_close_matches
from inspect import isabstract
from os import PathLike, fspath
from types import ModuleType
from typing import Any

from mdr import indenters, materials
from mdr.contact import SlidingContact
from mdr.indenters import Indenter, Paraboloid
from mdr.materials import Elastic, Material
from mdr.motion import NormalOscillation
from mdr.pull import RigidPull, SpringPull

MAX_BYTES = 2**24  #: of a case file
_STAND_INS = (1.0, 0.2, 1e-3, 1e-9, 50.0)  # for a number that is missing or wrong
_LONGEST = 400  # characters of a fault


class CaseFileError(ValueError):
    """What is wrong with a case file: one line a fault, with file, table and key."""

    @property
    def faults(self) -> tuple[str, ...]:
        """The lines of the message."""
        return tuple(str(self).splitlines())


# --- public ---


def read_case(path: str | PathLike[str]) -> SlidingContact:
    """The case in a TOML file. Raises CaseFileError with every fault."""
    return parse_case(_read(path), source=fspath(path))


def parse_case(text: str, source: str = "<string>") -> SlidingContact:
    """The case in a TOML text; source is what messages call it. Raises CaseFileError with every fault."""
    try:
        return case_of(parse_toml(text, source), source)
    except RecursionError:
        raise _error(source, ["nested too deeply; a case has tables and keys, nothing deeper"]) from None


def write_case(case: SlidingContact) -> str:
    """The TOML text that reads back as an equal case.

    Raises CaseFileError for what a file cannot carry: a Profile, whose shape is a Python function, or a record of your own.
    """
    top, tables = [], []
    for field in fields(case):
        value = getattr(case, field.name)
        if field.name not in _TABLES:
            top.append(f"{field.name} = {_toml(value)}")
        elif not isinstance(value, RigidPull):
            tables.append(_written(_TABLES[field.name], value))
    return "\n\n".join(["\n".join(top), *tables]) + "\n"


def parse_toml(text: str, source: str = "<string>") -> dict[str, Any]:
    """The tables of a TOML text. Raises CaseFileError with the line that is no TOML."""
    import tomllib

    try:
        return tomllib.loads(text)
    except ValueError as fault:
        raise _error(source, [_syntax_fault(text, str(fault))]) from None


def case_of(content: Mapping[str, Any], source: str = "<string>") -> SlidingContact:
    """The case in tables already parsed. Raises CaseFileError with every fault."""
    faults = [_unknown_key(None, key) for key in content if key not in _top_level()]
    parts: dict[str, Any] = {}
    for table in _TABLES.values():
        part, found = table.read(content)
        faults += found
        if part is not None:
            parts[table.name] = part
    sound = not faults
    given = {key: _number(value) for key, value in content.items() if key in _top_level() and key not in _TABLES}
    case, found = _build(SlidingContact, {**(parts if sound else _HARMLESS), **given})
    if faults or found or case is None:
        raise _error(source, [*faults, *found])
    assert isinstance(case, SlidingContact)
    return case


# --- tables ---


@dataclass(frozen=True)
class _Table:
    """One table of the file: the records it may describe, and the key that chooses among them."""

    name: str
    choice: str  #: the key that names the record; empty where there is but one
    module: ModuleType | None
    kind: type[Any]

    def records(self) -> dict[str, type[Any]]:
        """Public records by name; for a new one it is enough to be public in its module."""
        if self.module is None:
            return {self.kind.__name__: self.kind}
        names = getattr(self.module, "__all__", None) or [name for name in vars(self.module) if name[0] != "_"]
        found = {name: getattr(self.module, name) for name in sorted(names)}
        return {name: record for name, record in found.items() if self._is_record(record)}

    def _is_record(self, record: Any) -> bool:
        return isinstance(record, type) and is_dataclass(record) and issubclass(record, self.kind) and not isabstract(record)

    def keys(self, record: type[Any] | None = None) -> list[str]:
        """Keys of one record, or of all that the table may describe."""
        chosen = self.records().values() if record is None else [record]
        names = dict.fromkeys(field.name for one in chosen for field in _inputs(one))
        return [*([self.choice] if self.choice else []), *names]

    def read(self, content: Mapping[str, Any]) -> tuple[Any, list[str]]:
        """The record described, or None; and the faults."""
        if self.name not in content:
            needed = any(f.name == self.name and _is_required(f) for f in fields(SlidingContact))
            return None, [f"[{self.name}] is missing"] if needed else []
        table = content[self.name]
        if not isinstance(table, dict):
            return None, [f"[{self.name}] must be a table of keys, got {_kind(table)}"]
        record, faults = self._choose(table)
        if record is None:
            return None, [f"[{self.name}] {fault}" for fault in faults]
        known = self.keys(record)
        faults = [_unknown_key(self, key, record) for key in table if key not in known]
        given = {key: _number(value) for key, value in table.items() if key in known and key != self.choice}
        made, found = _build(record, given, "; leave [pull] out for a rigid pull" if record is SpringPull else "")
        faults += [f"[{self.name}] {fault}" for fault in found]
        return (None if faults else made), faults

    def _choose(self, table: Mapping[str, Any]) -> tuple[type[Any] | None, list[str]]:
        records = self.records()
        names = [name for name, record in records.items() if _fits_a_file(record)]
        if not self.choice:
            return self.kind, []
        if self.choice not in table:
            near = _near(self.choice, [key for key in table if key not in self.keys()])
            instead = f" ({_bare(near)} is unknown)" if near else ""
            return None, [f"{self.choice} is missing{instead}; choose one of {', '.join(names)}"]
        name = table[self.choice]
        if not isinstance(name, str):
            return None, [f"{self.choice} must be a name in quotes, got {_kind(name)}; choose one of {', '.join(names)}"]
        if name in names:
            return records[name], []
        if name in records:
            return None, [f"{self.choice} {name}: {_CALLABLE}; choose one of {', '.join(names)}"]
        return None, [f"{self.choice} {_bare(name)} is unknown; {_offer(name, names)}"]


_TABLES = {
    table.name: table
    for table in (
        _Table("indenter", "shape", indenters, Indenter),
        _Table("material", "model", materials, Material),
        _Table("oscillation", "", None, NormalOscillation),
        _Table("pull", "", None, SpringPull),
    )
}
_HARMLESS = {
    "indenter": Paraboloid(R=1.0),
    "material": Elastic(E=1.0, nu=0.5),
    "oscillation": NormalOscillation(u_z0=1.0, du_z=1.0, omega=1.0),
}
_CALLABLE = "its shape is a Python function, which a file cannot carry"


def _inputs(record: type[Any]) -> list[Field[Any]]:
    return [field for field in fields(record) if field.init]


def _is_required(field: Field[Any]) -> bool:
    return field.default is MISSING and field.default_factory is MISSING


def _fits_a_file(record: type[Any]) -> bool:
    return not any("Callable" in str(field.type) for field in fields(record))


def _top_level() -> list[str]:
    return [field.name for field in _inputs(SlidingContact)]


# --- from values to records ---


def _build(record: type[Any], given: Mapping[str, Any], way_out: str = "") -> tuple[Any, list[str]]:
    """The record made of the given values, or None; and every fault: what is missing, then what the record refuses."""
    free = [f.name for f in _inputs(record) if _is_required(f) and f.name not in given]
    faults = [f"{name} is missing{way_out}" for name in free]
    while True:
        known = {name: value for name, value in given.items() if name not in free}
        outcomes = [_make(record, {**known, **fill}) for fill in _fillings(free)]
        made = [one for one, _ in outcomes if one is not None]
        refusals = {refusal for _, refusal in outcomes if _subject(refusal) not in free}
        if made or len(refusals) != 1:
            return (made[0] if made and not faults else None), faults
        faults += refusals
        subject = _subject(faults[-1])
        if subject not in known:
            return None, faults
        free.append(subject)


def _make(record: type[Any], values: Mapping[str, Any]) -> tuple[Any, str]:
    try:
        return record(**values), ""
    except (TypeError, ValueError, ArithmeticError, LookupError) as refusal:
        return None, _one_line(str(refusal) or type(refusal).__name__)


def _fillings(names: list[str]) -> Iterator[dict[str, float]]:
    """Numbers for fields without a usable value, of several magnitudes and in either order; one empty filling for none."""
    for size in _STAND_INS if names else (1.0,):
        for order in (names, names[::-1]):
            yield {name: size * (1 + 0.1 * i) for i, name in enumerate(order)}


def _subject(message: str) -> str:
    """The quantity that a message is about: its first word."""
    found = re.match(r"\w+", message)
    return found.group() if found else ""


def _number(value: Any) -> Any:
    """The value, with an integer beyond the range of floats taken as infinite, which every record refuses by name."""
    if isinstance(value, list):
        return [_number(one) for one in value]
    if isinstance(value, int) and not isinstance(value, bool):
        try:
            float(value)
        except OverflowError:
            return math.copysign(math.inf, value)
    return value


# --- from records to text ---


def _written(table: _Table, record: Any) -> str:
    """One table of the file."""
    name = type(record).__name__
    if table.records().get(name) is not type(record):
        raise CaseFileError(f"{table.name}: {name} is none of the records a file can name: {', '.join(table.records())}")
    if not _fits_a_file(type(record)):
        names = [name for name, one in table.records().items() if _fits_a_file(one)]
        raise CaseFileError(f"{table.name} {name}: {_CALLABLE}; keep the case in a script, or use one of {', '.join(names)}")
    lines = [f"[{table.name}]", *([f"{table.choice} = {_toml(name)}"] if table.choice else [])]
    values = {field.name: getattr(record, field.name) for field in _inputs(type(record))}
    return "\n".join(lines + [f"{key} = {_toml(value)}" for key, value in values.items() if value is not None])


def _toml(value: Any) -> str:
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int):
        return str(value)
    if isinstance(value, Iterable):
        return "[" + ", ".join(_toml(one) for one in value) + "]"
    return repr(float(value))


# --- reading and messages ---


def _read(path: str | PathLike[str]) -> str:
    source = fspath(path)
    try:
        with open(path, "rb") as file:
            data = file.read(MAX_BYTES + 1)
    except (OSError, ValueError) as fault:
        raise _error(source, [f"cannot be read: {getattr(fault, 'strerror', None) or fault}"]) from None
    if len(data) > MAX_BYTES:
        raise _error(source, [f"is larger than {MAX_BYTES // 2**20} MiB: no case file"])
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as fault:
        line = data.count(b"\n", 0, fault.start) + 1
        raise _error(source, [f"line {line} is not UTF-8 text (byte 0x{data[fault.start]:02x}); save the file as UTF-8"]) from None


def _syntax_fault(text: str, message: str) -> str:
    """What is no TOML, where it stands, and what is usually meant."""
    what, _, where = message.partition(" (at ")
    place = re.match(r"line (\d+), column (\d+)", where)
    if place is None:
        return f"{where.rstrip(')') or 'no TOML'}: {what}"
    lines = text.splitlines()
    line = lines[int(place[1]) - 1].strip() if int(place[1]) <= len(lines) else ""
    if what.startswith("Expected newline") and "=" in line:
        what = "more than one value; write one number in SI, without unit or arithmetic"
    elif what.startswith(("Cannot overwrite", "Cannot declare", "Cannot mutate")):
        what += "; is it given twice?"
    return f"{place[0]}: {_short(line)}: {what}"


def _error(source: str, faults: Iterable[str]) -> CaseFileError:
    return CaseFileError("\n".join(_one_line(f"{source}: {fault}") for fault in faults))


def _unknown_key(table: _Table | None, key: str, record: type[Any] | None = None) -> str:
    """Say that a key is unknown, and the right spelling, the right place, or all there are."""
    known = table.keys(record) if table else _top_level()
    where, whose = (f"[{table.name}] ", record.__name__) if table and record else ("", "a case")
    others = [other for other in _TABLES.values() if other is not table]
    homes = [f"[{other.name}]" for other in others if key in other.keys()]
    if not any(key.casefold() == one.casefold() for one in known):
        if table and key in _top_level() and key not in _TABLES:
            return f"{where}{_bare(key)} stands in the wrong place; write it at the top of the file, above the first table"
        if homes:
            return f"{where}{_bare(key)} is no key of {whose}; it belongs to {' or '.join(homes)}"
    return f"{where}{_bare(key)} is no key of {whose}; {_offer(key, known)}"


def _offer(word: str, known: list[str]) -> str:
    near = _near(word, known)
    return f"did you mean {near}?" if near else f"there are {', '.join(known)}"


def _near(word: str, known: list[str]) -> str | None:
    folded = {one.casefold(): one for one in known}
    found = get_close_matches(word.casefold()[:99], folded, n=1)
    return folded[found[0]] if found else None


def _bare(name: str) -> str:
    """A key as TOML writes it: plain, or quoted where it holds other than letters, digits, _ and -."""
    return _short(name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else json.dumps(name))


def _kind(value: Any) -> str:
    """What a TOML value is called."""
    names = {dict: "a table", list: "an array", str: "a string", bool: "true or false"}
    return names.get(type(value), _short(str(value)))


def _short(text: str, longest: int = 60) -> str:
    return text if len(text) <= longest else text[: longest - 1] + "…"


def _one_line(text: str) -> str:
    """One printable line of bearable length."""
    plain = "".join(c if c.isprintable() else " " for c in text)
    return _short(" ".join(plain.split()), _LONGEST)
