"""`mdr sweep`: a grid of cases from a study file, kept in a store, written with its picture."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import mdr
from mdr.commands.arguments import plain_number
from mdr.commands.output import Exit, WrongInput, answer, complain, picked, refusals
from mdr.commands.written import add_output, made_by, make_folder, require_free, write, write_figure, write_text
from mdr.studies import Status
from mdr.studies.formats import packed
from mdr.studies.study_files import StudyFile

FILES = ("study.nc", "study.csv", "study.png", "study.svg")


def add_options_of_sweep(command: argparse.ArgumentParser) -> None:
    """Where to keep and write the study, and which part of it to compute."""
    command.add_argument("--store", metavar="folder", type=Path, help="keep finished chunks here, and go on from them")
    add_output(command, *FILES)
    command.epilog = "-o file.nc or -o file.csv writes the study to that file, and a picture beside it."
    seconds, time = "work in a chunk: 60 [s], 60s (default: 5s)", plain_number("s", "a time, such as 60s")
    command.add_argument("--chunk-seconds", type=time, default=5.0, metavar="time", help=seconds)
    command.add_argument("--shard", metavar="k/n", help="compute every n-th chunk, from the k-th on; needs --store")


def sweep(args: argparse.Namespace, asked: StudyFile) -> int:
    """Compute what is missing, write and print the study; status 1 if a point failed or did not settle."""
    _require_a_place(args)
    with refusals():  # of shard and chunks; the file has been read
        study = mdr.sweep(**vars(asked), store=args.store, chunk_seconds=args.chunk_seconds, shard=args.shard)
    answer(args, _told(study), str(study))
    if args.output is not None and study.complete:
        try:
            _write(args, study)
        except KeyboardInterrupt:
            kept = f"all of it is safe in {args.store}; the same call writes it" if args.store else "nothing is kept"
            return complain(f"interrupted while the study was written; {kept}", Exit.INTERRUPTED)
    return _end(args, study)


def _require_a_place(args: argparse.Namespace) -> None:
    """Refuse, before the work, what would lose its outcome."""
    if args.store is not None and args.store.exists() and not args.store.is_dir():
        raise WrongInput(f"{args.store}: is a file; a store is a folder")
    if args.output is None:
        if args.store is None and not args.json:
            raise WrongInput("the study would be lost: give -o folder, --store folder, or --json")
        return
    own = None if args.store is None else (args.store / FILES[0]).resolve()
    if own in (args.output.resolve(), (args.output / FILES[0]).resolve()):
        raise WrongInput(f"{args.output}: the store keeps its own {FILES[0]} there; give another folder to -o")
    if _is_file(args.output):
        require_free([args.output, *(args.output.with_suffix(f".{kind}") for kind in ("png", "svg"))])
    elif args.output.suffix and not args.output.is_dir():
        raise WrongInput(f"{args.output}: a study is written as .nc or .csv, or as both into a folder")
    else:
        make_folder(args)


def _is_file(output: Path) -> bool:
    """Whether the study goes to this file, and not to a folder of this name."""
    return output.suffix in (".nc", ".csv") and not output.is_dir()


def _write(args: argparse.Namespace, study: mdr.Study) -> None:
    """The study, and the picture of its first quantity, where it has few enough axes for one."""
    files = [args.output] if _is_file(args.output) else [args.output / name for name in FILES[:2]]
    for path in files:
        if path.suffix == ".csv":
            write_text(args, path, study.table(), "", study.case)
        else:
            write(path, packed(study, history=made_by(args)))
    try:
        write_figure(args, files[0].with_suffix(""), study.plot)
    except ValueError as fault:
        complain(f"no picture: {fault}")


def _told(study: mdr.Study) -> dict[str, Any]:
    grid = study.grid
    axes = {axis.path: [axis[i] if axis.is_numeric else axis.labels[i] for i in range(len(axis))] for axis in grid}
    return {
        **picked(study, "case", "identity", "complete"),
        "counts": {status.name.lower(): study.count(status) for status in Status},
        "axes": axes,
        "units": study.units,
        "values": {name: study[name] for name in study.quantities},
        **picked(study, "status", "why"),
    }


def _end(args: argparse.Namespace, study: mdr.Study) -> int:
    failed, unsettled = study.count(Status.FAILED), study.count(Status.UNSETTLED)
    if failed or unsettled:
        return complain(f"{failed} of {study.status.size} points failed, {unsettled} did not settle")
    if study.complete:
        return Exit.DONE
    missing = f"{study.count(Status.MISSING)} of {study.status.size} points are left to the other shards"
    left_out = f"; {args.output} is not written" if args.output else ""
    return complain(missing + left_out, Exit.DONE)  # this shard has done its own
