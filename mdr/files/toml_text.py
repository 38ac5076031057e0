"""TOML as text: read from a file or from standard input, parsed, and what is wrong with it told; values written.

What the tables say is the matter of case_files.py and of the studies.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import fields
from os import PathLike, fsdecode
from typing import Any

from mdr.tools.fields import checked, required
from mdr.tools.messages import one_line, short

MAX_BYTES = 2**24  #: of a case file
_DEEP = re.compile(r"""(?<![\w"'-])(?:[\w"'-]+\s*\.\s*){64}""")  # a dotted key, on which tomllib takes quadratic time
NESTED = "nested too deeply; a case has tables and keys, nothing deeper"  #: a fault


class StandardInput(str):
    """The path of standard input; its text is what messages call it."""


class CaseFileError(ValueError):
    """What is wrong with a case file: one line for each fault, with file, table and key."""

    @property
    def faults(self) -> tuple[str, ...]:
        """The lines of the message."""
        return tuple(str(self).splitlines())

    @classmethod
    def of(cls, faults: Iterable[str]) -> CaseFileError:
        """The error that tells these faults, one a line.

        Parameters
        ----------
        faults : iterable of str
            What is wrong, each in a sentence.

        Returns
        -------
        CaseFileError
            The error, to be raised.
        """
        return cls("\n".join(one_line(fault) for fault in faults))


@contextmanager
def told(where: str) -> Iterator[None]:
    """Tell the faults that are found inside with the place where they are: a file, or a table of it."""
    try:
        yield
    except RecursionError:
        raise CaseFileError(f"{where}{NESTED}") from None
    except CaseFileError as refusal:
        raise CaseFileError.of(where + fault for fault in refusal.faults) from None


def read_bytes(path: str | PathLike[str], most: int, kind: str) -> bytes:
    """What a file of a kind, or standard input, holds. Raises CaseFileError where it cannot be read, or holds more."""
    with told(f"{fsdecode(path)}: "):
        try:
            if isinstance(path, StandardInput):
                if sys.stdin is None:
                    raise OSError("it is closed")
                data = sys.stdin.buffer.read(most + 1)
            else:
                with open(path, "rb") as file:
                    data = file.read(most + 1)
        except (OSError, ValueError) as fault:
            raise CaseFileError(f"cannot be read: {getattr(fault, 'strerror', None) or fault}") from None
        if len(data) > most:
            raise CaseFileError(f"is larger than {most // 2**20} MiB: no {kind}")
        return data


def read_text(path: str | PathLike[str]) -> str:
    """The text of a file, or of standard input. Raises CaseFileError where there is none."""
    data = read_bytes(path, MAX_BYTES, "case file")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as fault:
        line, byte = data.count(b"\n", 0, fault.start) + 1, data[fault.start]
        what = f"line {line} is not UTF-8 text (byte 0x{byte:02x}); save the file as UTF-8"
        raise CaseFileError(f"{fsdecode(path)}: {what}") from None


def tried(make: Callable[..., Any], *given: Any, **named: Any) -> tuple[Any, list[str]]:
    """What is made, or None and the words of the refusal, one or several."""
    try:
        return make(*given, **named), []
    except CaseFileError as refusal:
        return None, [*refusal.faults]
    except (TypeError, ValueError, ArithmeticError, LookupError) as refusal:
        return None, [one_line(str(refusal) or type(refusal).__name__)]


def field_faults(
    record: type[Any], given: Mapping[str, Any], ways_out: Mapping[Any, str], spoilt: Collection[str | None] = ()
) -> list[str]:
    """What is missing, but for what was `spoilt` already, then what each field refuses by its rule."""
    refused = [tried(checked, one, given[one.name])[1] for one in fields(record) if one.init and one.name in given]
    absent = [one.name for one in required(record) if one.name not in given and one.name not in spoilt]
    missing = [f"{name} is missing" + (f"; {ways_out[name]}" if name in ways_out else "") for name in absent]
    return missing + [fault for found in refused for fault in found]


def parse_toml(text: str, source: str = "<string>") -> dict[str, Any]:
    """The tables of a TOML text. Raises CaseFileError with the line that is no TOML."""
    import tomllib

    with told(f"{source}: "):
        if _DEEP.search(text):
            raise CaseFileError(NESTED)
        try:
            return tomllib.loads(text)
        except ValueError as fault:
            raise CaseFileError.of([_syntax_fault(text, str(fault))]) from None


def toml_value(value: Any) -> str:
    """A string, number, truth or list of them as TOML writes it."""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, int):
        return str(value)
    if isinstance(value, Iterable):
        return "[" + ", ".join(toml_value(one) for one in value) + "]"
    return repr(float(value))


def _syntax_fault(text: str, message: str) -> str:
    """What is no TOML, where it stands, and what is usually meant."""
    what, _, where = message.partition(" (at ")
    lines = text.splitlines()
    place = re.match(r"line (\d+)", where)
    number = int(place[1]) if place else len(lines)
    line = lines[number - 1].strip() if 0 < number <= len(lines) else ""
    if re.search(r"=\s*[-+]?\d[\d_]*\.(?!\d)", line):
        what = "a number has a digit after its point, 2.0 and not 2."
    elif what.startswith("Expected newline") and "=" in line:
        what = 'more than one value; write one number in SI, or a quantity in quotes, "5 mm"'
    elif what.startswith(("Cannot overwrite", "Cannot declare", "Cannot mutate", "Duplicate")):
        what += "; is it given twice?"
    elif what.startswith("Exceeds the limit"):
        what = "a number has thousands of digits"
    elif what == "Invalid value":
        name = re.search(r"=\s*([^\W\d]\w*)", line)
        what = f'a name is written in quotes, "{name[1]}"' if name else "no number, name in quotes or list"
    return f"line {number}: {short(line)}: {what}" if where else what
