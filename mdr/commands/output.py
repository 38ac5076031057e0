"""What commands say: rows, JSON, complaints and the exit status."""

from __future__ import annotations

import argparse
import json
import math
import signal
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from enum import IntEnum
from typing import Any, NamedTuple

import mdr
from mdr.tools.provenance import versions
from mdr.tools.summary import lines_of


class Exit(IntEnum):
    """Exit status of the program."""

    DONE = 0
    FAILED = 1  #: a run failed, did not settle, or found nothing
    WRONG_INPUT = 2  #: as argparse has it
    INTERRUPTED = 130  #: by the signal of Ctrl-C, as shells have it


class WrongInput(Exception):
    """What the user gave cannot be used."""


class NotWritten(Exception):
    """A file that could not be written, and why."""


@contextmanager
def refusals() -> Iterator[None]:
    """What is refused inside with a ValueError is wrong input."""
    try:
        yield
    except ValueError as fault:
        raise WrongInput(str(fault)) from None


@contextmanager
def stopped_by_signals() -> Iterator[None]:
    """What is searched for inside ends at SIGTERM, of `timeout`, as it does at Ctrl-C."""
    before = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def status_of(stopped: str, is_found: bool = True) -> Exit:
    """The status of a search; stopped: what ended it, is_found: whether there is what was asked for."""
    if stopped and "limit" not in stopped:
        return Exit.INTERRUPTED
    return Exit.FAILED if stopped or not is_found else Exit.DONE


class Told(NamedTuple):
    """One thing that a command found: a key of its JSON, and a row of its text where it has one."""

    key: str
    value: Any
    name: str = ""
    text: str = ""
    meaning: str = ""


def picked(record: Any, *names: str) -> dict[str, Any]:
    """Some of the fields and properties of a record."""
    return {name: getattr(record, name) for name in names}


def values_of(found: Iterable[Told]) -> dict[str, Any]:
    """What JSON says of them."""
    return {one.key: one.value for one in found}


def text_of(found: Iterable[Told]) -> str:
    """Name, text and meaning, in columns."""
    return "\n".join(lines_of([one[2:] for one in found if one.text]))


def answer(args: argparse.Namespace, values: dict[str, Any], text: str, case: mdr.SlidingContact | None = None) -> int:
    """Print the text, or one JSON object: version, command, versions of all parts, the case and the values."""
    if args.json:
        head = {"version": mdr.__version__, "command": args.command, "made_with": versions()}
        head |= {"case": mdr.write_case(case)} if case is not None else {}
        text = json.dumps(_plain({**head, **values}), indent=1, allow_nan=False, ensure_ascii=False)
    else:
        text = in_shell(text)
    try:
        print(text, flush=True)
    except BrokenPipeError:
        raise
    except OSError as fault:
        raise NotWritten(f"standard output: cannot be written: {fault.strerror}") from None
    return Exit.DONE


#: ways out as messages tell them in Python, and at the command line
WAYS = {
    "full_slip_critical_velocity(case)": "the row full slip of `mdr velocity`",
    "too great for critical_velocity(case)": "too great for the closed form",
    'give hold="load"': 'give hold = "load" in [oscillation]',
    "`within` may be widened": "--within low high searches another range",
    "cof_curve(case, [0]), or blocked_cof(case)": "`mdr velocity`, or `mdr curve case.toml --v-0 0`",
    "blocked_cof(case)": "`mdr velocity`",
}


def in_shell(message: str) -> str:
    """A message whose ways out are those of the command line."""
    for python, shell in WAYS.items():
        message = message.replace(python, shell)
    return message


def complain(message: str, status: int = Exit.FAILED) -> int:
    """A message on standard error, each line behind the program's name; returns the status."""
    message = in_shell(message)
    for line in message.splitlines() or [""]:
        print(line if line.startswith(" ") else f"mdr: {line}", file=sys.stderr)
    return status


def velocity_text(v: float | None) -> str:
    """A critical velocity as a value."""
    return "none" if v is None else "infinite" if math.isinf(v) else f"{v:.6g} m/s"


def _plain(value: Any) -> Any:
    """What JSON can say: null for what is undefined, "inf" for infinity, numbers of Python for those of NumPy."""
    value = value.tolist() if hasattr(value, "tolist") else value
    if isinstance(value, dict):
        return {key: _plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None if math.isnan(value) else str(value)
    return value
