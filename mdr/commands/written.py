"""What commands write: files that name the command and the versions that made them."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from io import BytesIO
from pathlib import Path
from shutil import disk_usage
from typing import Any

from mdr.commands.output import NotWritten, WrongInput, complain
from mdr.tools.atomic_write import write_whole
from mdr.tools.provenance import commented, figure_metadata, versions


def add_output(command: argparse.ArgumentParser, *names: str) -> None:
    """The folder that a command writes these files to: those of `write_found`, a text and a figure in two formats."""
    meaning = f"write {', '.join(names[:-1])} and {names[-1]} here; files of these names are overwritten"
    command.add_argument("-o", "--output", metavar="folder", type=Path, help=meaning)
    command.set_defaults(files=names)


def make_folder(args: argparse.Namespace) -> None:
    """Make the folder asked for, before the work; refused where it cannot be, or its files cannot be written."""
    folder: Path | None = args.output
    if folder is None:
        return
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as fault:
        raise WrongInput(f"{folder}: no folder to write to: {getattr(fault, 'strerror', None) or fault}") from None
    require_free([folder / name for name in args.files])


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


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """What writes this file stands inside; where it fails, NotWritten names the file and what its disk has free."""
    try:
        yield
    except OSError as fault:
        free = ""
        with suppress(OSError):
            free = f"; {disk_usage(path.parent).free / 1e6:.3g} MB are free on the disk of {path.parent.resolve()}"
        raise NotWritten(f"{path}: cannot be written: {fault.strerror or fault}{free}") from None


def write(path: Path, data: bytes) -> None:
    """Write or replace a file in one instant."""
    with writing(path):
        write_whole(path, data)


def write_text(args: argparse.Namespace, path: Path, text: str, *head: str) -> None:
    """Write a text with versions, command and `head` before it, each line behind a #."""
    write(path, (commented(made_by(args), *head) + text).encode("utf-8"))


def write_found(args: argparse.Namespace, draw: Callable[[], Any], text: str, *head: str) -> None:
    """Write the files of a command, where a folder was asked for: a text with `head` before it, and a figure."""
    if args.output is not None:
        write_text(args, args.output / args.files[0], text, *head)
        write_figure(args, args.output / Path(args.files[1]).stem, draw)


def write_figure(args: argparse.Namespace, stem: Path, draw: Callable[[], Any]) -> None:
    """Write stem.png and stem.svg, drawn without a display, which keep versions and command."""
    import matplotlib as mpl

    from mdr.plots import style

    mpl.use("Agg")
    with style():
        figure = draw().figure
        for kind in ("png", "svg"):
            drawn = BytesIO()
            figure.savefig(drawn, format=kind, dpi=150, metadata=figure_metadata(kind, args.command))
            write(stem.parent / f"{stem.name}.{kind}", drawn.getvalue())
