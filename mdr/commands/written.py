"""What commands write: files that name the command and the versions that made them."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

from mdr.case.contact import SlidingContact
from mdr.commands.output import WrongInput, complain
from mdr.files.case_files import write_case
from mdr.tools.atomic_write import write_whole
from mdr.tools.provenance import commented, figure_metadata, versions


def add_output(command: argparse.ArgumentParser, *names: str) -> None:
    """The folder that a command writes these files to."""
    meaning = f"write {', '.join(names[:-1])} and {names[-1]} here; files of these names are overwritten"
    command.add_argument("-o", "--output", metavar="folder", type=Path, help=meaning)
    command.set_defaults(files=names)


def output_folder(args: argparse.Namespace) -> Path | None:
    """The folder asked for, made where it is missing; refused, before the work, where its files cannot be written."""
    folder: Path | None = args.output
    if folder is None:
        return None
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as fault:
        raise WrongInput(f"{folder}: no folder to write to: {getattr(fault, 'strerror', None) or fault}") from None
    require_free([folder / name for name in args.files])
    return folder


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
        complain(f"will be overwritten: {', '.join(map(str, there))}")


def made_by(args: argparse.Namespace) -> str:
    """The two lines that files keep: versions and command."""
    return f"{versions()}\n{args.command}"


def write_text(args: argparse.Namespace, path: Path, text: str, *head: str) -> None:
    """Write a text with versions, command and `head` before it, each line behind a #."""
    write_whole(path, (commented(made_by(args), *head) + text).encode("utf-8"))


def write_found(args: argparse.Namespace, stem: Path, found: Any, case: SlidingContact) -> None:
    """Write the table of what was found, behind the case, as stem.csv, and its figure."""
    write_text(args, stem.with_suffix(".csv"), found.table(), "", write_case(case))
    write_figure(args, stem, found.plot)


def write_figure(args: argparse.Namespace, stem: Path, draw: Callable[[], Any]) -> None:
    """Write stem.png and stem.svg, drawn without a display, which keep versions and command."""
    import matplotlib as mpl

    mpl.use("Agg")
    figure = draw().figure
    for kind in ("png", "svg"):
        drawn = BytesIO()
        figure.savefig(drawn, format=kind, dpi=150, metadata=figure_metadata(kind, args.command))
        write_whole(stem.parent / f"{stem.name}.{kind}", drawn.getvalue())
