"""What commands say and write: rows, JSON, complaints, files that name the command and the versions that made them."""

from __future__ import annotations

import argparse
import json
import math
import os
import sys
from collections.abc import Callable, Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

import mdr
from mdr.case.contact import SlidingContact
from mdr.files.case_files import write_case
from mdr.files.toml_text import StandardInput
from mdr.march.march import BUDGET, accuracy_of
from mdr.tools.atomic_write import write_whole
from mdr.tools.provenance import commented, figure_metadata, versions
from mdr.tools.summary import Row, lines_of

DONE, FAILED, WRONG_INPUT, INTERRUPTED = 0, 1, 2, 130  #: exit statuses


class WrongInput(Exception):
    """What the user gave cannot be used."""


def add_accuracy(command: argparse.ArgumentParser, of_what: str) -> None:
    """How accurate an answer is to be."""
    meaning = f"{of_what}, 1e-8 to 1e-3 (default: {BUDGET:g})"
    command.add_argument("--accuracy", metavar="share", type=_accuracy, default=BUDGET, help=meaning)


def _accuracy(text: str) -> float:
    try:
        return accuracy_of(float(text))
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be a number from 1e-8 to 1e-3, got {text!r}") from None


def whole_number(least: int, most: int) -> Callable[[str], int]:
    """What argparse reads a whole number with."""

    def read(text: str) -> int:
        if not text.isascii() or not text.isdigit() or not least <= int(text[: len(str(most)) + 1]) <= most:
            raise argparse.ArgumentTypeError(f"must be a whole number from {least} to {most}, got {text!r}")
        return int(text)

    return read


def add_output(command: argparse.ArgumentParser, names: Sequence[str]) -> None:
    """The folder that a command writes its files to."""
    meaning = f"write {', '.join(names[:-1])} and {names[-1]} here; files of these names are overwritten"
    command.add_argument("-o", "--output", metavar="folder", type=Path, help=meaning)


def output_folder(args: argparse.Namespace, names: Sequence[str]) -> Path | None:
    """The folder asked for, made where it is missing; refused, before the work, where these files cannot be written."""
    folder: Path | None = args.output
    if folder is None:
        return None
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as fault:
        raise WrongInput(f"{folder}: no folder to write to: {getattr(fault, 'strerror', None) or fault}") from None
    require_free([folder / name for name in names])
    return folder


def path_of(text: str) -> str:
    """The path of a file as the command line gives it; - is standard input."""
    return StandardInput("standard input") if text == "-" else text


def print_rows(rows: Sequence[Row]) -> None:
    """Name, value and meaning, in columns."""
    print("\n".join(lines_of(rows)))


def print_json(args: argparse.Namespace, values: dict[str, Any], case: SlidingContact | None = None) -> int:
    """One JSON object: version, command, versions of all parts, the case where there is one, and the values."""
    head = {"version": mdr.__version__, "command": args.command, "made_with": versions()}
    if case is not None:
        head["case"] = write_case(case)
    print(json.dumps(_plain({**head, **values}), indent=1, allow_nan=False, ensure_ascii=False))
    return DONE


def complain(message: str, status: int) -> int:
    """A message on standard error, each line behind the program's name; returns the status."""
    for line in message.splitlines() or [""]:
        print(line if line.startswith(" ") else f"mdr: {line}", file=sys.stderr)
    return status


def velocity_text(v: float | None) -> str:
    """A critical velocity in words."""
    if v is None:
        return "none"
    return "infinite, an undamped resonance" if math.isinf(v) else f"{v:.6g} m/s"


def made_by(args: argparse.Namespace) -> str:
    """The two lines that text files keep: versions and command."""
    return f"{versions()}\n{args.command}"


def write_table(args: argparse.Namespace, case: SlidingContact, path: Path, table: str) -> None:
    """Write a CSV file with versions, command and case at its head, each line behind a #."""
    write_whole(path, (commented(made_by(args), "", write_case(case)) + table).encode("utf-8"))


def write_figure(args: argparse.Namespace, figure: Any, folder: Path, stem: str) -> None:
    """Write stem.png and stem.svg, which keep versions and command."""
    for kind in ("png", "svg"):
        drawn = BytesIO()
        figure.savefig(drawn, format=kind, dpi=150, metadata=figure_metadata(kind, args.command))
        write_whole(folder / f"{stem}.{kind}", drawn.getvalue())


def require_free(paths: Sequence[Path]) -> None:
    """Refuse, before the work, places where no file can be written, and say which files will be overwritten."""
    for path in paths:
        if path.is_dir():
            raise WrongInput(f"{path}: is a folder, where a file is to be written")
        if not path.parent.is_dir():
            raise WrongInput(f"{path}: there is no folder {path.parent}")
        if not os.access(path.parent, os.W_OK):
            raise WrongInput(f"{path}: no file can be written there")
    if there := [path for path in paths if path.exists()]:
        complain(f"will be overwritten: {', '.join(map(str, there))}", DONE)


def _plain(value: Any) -> Any:
    """What JSON can say: null for what is undefined, "inf" for infinity, numbers of Python for those of NumPy."""
    if isinstance(value, dict):
        return {key: _plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    value = value.item() if hasattr(value, "item") else value
    if isinstance(value, float) and not math.isfinite(value):
        return None if math.isnan(value) else str(value)
    return value
