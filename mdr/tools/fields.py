"""What a field of a record is: unit, meaning, symbol, rule and an example stand at the field and nowhere else.

    R: float = field(metadata=facts("m", "radius of curvature", example=0.05))

Checks, messages, case files, studies, figures and the guide read them here.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import MISSING, Field, fields, is_dataclass
from inspect import signature
from typing import Any, NamedTuple, Self, TypeVar

from mdr.tools.checks import positive
from mdr.tools.keywords import Offering
from mdr.tools.messages import offer

T = TypeVar("T")
Rule = Callable[[str, Any, str], Any]  #: (name, value, note) to the value as it is kept; raises what is wrong with it


class Facts(NamedTuple):
    """The facts of one field."""

    unit: str  #: "-" for pure numbers, "" for what has none
    meaning: str
    label: str  #: words and symbol for figures, in LaTeX; empty where the name will do
    rule: Rule | None  #: None for what its record checks
    note: str  #: what a refusal adds in brackets
    example: Any  #: its value in the example of its record, None for none

    def __str__(self) -> str:
        return self.meaning + (f" [{self.unit}]" if self.unit else "")


NOTHING = Facts("", "", "", None, "", None)  #: known of a field without facts


def facts(
    unit: str,
    meaning: str,
    rule: Rule | None = positive,
    *,
    label: str = "",
    note: str | None = None,
    example: Any = None,
) -> dict[str, Facts]:
    """Metadata of a field. A refusal notes meaning and unit, or what is given as `note`."""
    if note is None:
        note = meaning + (f" in {unit}" if unit not in ("", "-") else "")
    return {"facts": Facts(unit, meaning, label, rule, note, example)}


def facts_of(field: Field[Any]) -> Facts:
    """The facts of a field of a record, `NOTHING` where it has none."""
    found: Facts = field.metadata.get("facts", NOTHING)
    return found


def fields_of(record: Any) -> tuple[str, ...]:
    """Names of the fields that can be set in a record; none of what is no dataclass."""
    return tuple(one.name for one in fields(record) if one.init) if is_dataclass(record) else ()


def units_of(record: type[Any]) -> dict[str, str]:
    """The units of the fields of a record, which are its arguments."""
    return {one.name: facts_of(one).unit for one in fields(record) if one.init}


def has_example(record: Any) -> bool:
    """Whether this is a record of which each field without a default has an example."""
    return is_dataclass(record) and all(facts_of(one).example is not None for one in required(record))


def required(record: Any) -> list[Field[Any]]:
    """The fields of a record that have no default."""
    asked = [one for one in fields(record) if one.init]
    return [one for one in asked if one.default is MISSING and one.default_factory is MISSING]


def example_of(record: type[T]) -> T:
    """A record made of the examples of its fields."""
    known = {one.name: facts_of(one).example for one in fields(record)}  # type: ignore[arg-type]
    return record(**{name: value for name, value in known.items() if value is not None})


def checked(field: Field[Any], value: Any) -> Any:
    """The value as the field keeps it. Raises ValueError or TypeError, by the rule of the field."""
    rule, note = facts_of(field).rule, facts_of(field).note
    return value if rule is None else rule(field.name, value, note)


def check_fields(record: Any) -> None:
    """Check each field of a frozen dataclass that is being made by its rule, and keep what the rule answers."""
    for field in fields(record):
        object.__setattr__(record, field.name, checked(field, getattr(record, field.name)))


class Record(Offering):
    """Base of frozen dataclasses whose fields have facts; one with relations between fields adds them after these."""

    def __new__(cls, *args: Any, **given: Any) -> Self:
        """Refuse a keyword that is no argument, with the nearest one, or the constructor that takes it."""
        if unknown := given.keys() - getattr(cls, "__dataclass_fields__", given).keys():
            known = signature(cls.__init__).parameters
            if any(one.kind is one.VAR_KEYWORD for one in known.values()):
                unknown = set()
            for name in sorted(unknown - known.keys()):
                raise TypeError(f"{cls.__name__} takes no {name}; {_taken_by(cls, name) or offer(name, [*known][1:])}")
        return super().__new__(cls)

    def __post_init__(self) -> None:
        check_fields(self)


def _taken_by(record: type[Any], name: str) -> str:
    """What else makes such a record from what has this name; empty where nothing does."""
    makers = [one for one in vars(record) if isinstance(vars(record)[one], classmethod)]
    found = [one for one in makers if name in signature(getattr(record, one)).parameters]
    return f"use {record.__name__}.{found[0]}" if found else ""
