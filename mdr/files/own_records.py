"""Records of a user's own, such as a shape or a law of friction, which case files may name beside the library's."""

from __future__ import annotations

from dataclasses import is_dataclass
from inspect import isabstract
from typing import Any, TypeVar

from mdr import indenters, materials
from mdr.case import friction, in_plane, motion
from mdr.case.contact import KINDS

Record = TypeVar("Record", bound=type[Any])

_KINDS = tuple(kind for part, kind in KINDS.items() if part != "pull")
_OWN: dict[str, type[Any]] = {}


def register(record: Record) -> Record:
    """Let case files, study files and `write_case` name a shape, a material, a law of friction or a motion of your own.

    Parameters
    ----------
    record : type
        A dataclass, a subclass of `Indenter`, `Material`, `Friction`, `Motion` or `Shake` whose fields are
        numbers, words or lists of them.
        Its name in a file is that of the class.

    Returns
    -------
    type
        The class, so that `register` can stand as a decorator above ``@dataclass(frozen=True)``.

    Raises
    ------
    TypeError
        For what is no such class.
    ValueError
        For a name that the library or another class has.

    Notes
    -----
    It holds for this process: a script that reads such a file registers the class first.

    Examples
    --------
    >>> from dataclasses import dataclass
    >>> import mdr
    >>> @mdr.register
    ... @dataclass(frozen=True)
    ... class OneArm(mdr.StandardLinearSolid):
    ...     pass
    """
    if not (isinstance(record, type) and is_dataclass(record) and issubclass(record, _KINDS)) or isabstract(record):
        kinds = ", ".join(kind.__name__ for kind in _KINDS)
        raise TypeError(f"record must be a dataclass that is an {kinds} and answers all that it must, got {record!r}")
    name = record.__name__
    known = _OWN.get(name, record)
    taken = any(name in module.__all__ for module in (indenters, materials, friction, motion, in_plane))
    if taken or _home(known) != _home(record):
        raise ValueError(f"{name} is the name of another record that a file can name; rename the class")
    _OWN[name] = record
    return record


def own_records(kind: type[Any]) -> dict[str, type[Any]]:
    """The registered records of a kind by name."""
    return {name: record for name, record in _OWN.items() if issubclass(record, kind)}


def _home(record: type[Any]) -> tuple[str, str]:
    """Where a class is defined: a cell or a module that is run again defines it anew."""
    return record.__module__, record.__qualname__
