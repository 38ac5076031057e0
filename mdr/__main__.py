"""The command line: `mdr velocity`, `curve`, `measure` and `verdict` of a case file, `mdr sweep` of a study file,
`mdr explore` in the browser, `mdr shapes` and `mdr case` to begin with.

Installed as `mdr`, also `python -m mdr`. Exit status: 0 done; 1 a run failed, did not settle or found nothing;
2 wrong input; 130 interrupted. Results go to standard output (with --json one JSON object: what is undefined is null,
an infinite value the string "inf"), everything else to standard error.
"""

from __future__ import annotations

import argparse
import os
import shlex
import sys
from collections.abc import Callable, Sequence
from typing import Any

import mdr
from mdr.commands import begin, curve, explore, judge, sweep, velocity
from mdr.commands.output import DONE, FAILED, INTERRUPTED, WRONG_INPUT, WrongInput, complain
from mdr.files.case_files import CaseFileError, read_case

_FAILURES = (ValueError, ArithmeticError, RuntimeError, OSError, MemoryError)


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; returns the exit status."""
    given = list(sys.argv[1:] if argv is None else argv)
    args = parser().parse_args(given)
    args.command = shlex.join(["mdr", *given]).encode("utf-8", "backslashreplace").decode("utf-8")
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # a letter the terminal lacks must not cost the result
            stream.reconfigure(errors="backslashreplace")
    try:
        return _run(args)
    except KeyboardInterrupt:
        return complain("interrupted before it was done", INTERRUPTED)
    except BrokenPipeError:  # the reader, such as head, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return DONE


def _run(args: argparse.Namespace) -> int:
    """Read the file, do the work, and turn what goes wrong into a sentence and a status."""
    work: Callable[[argparse.Namespace, Any], int] = args.work
    try:
        case = args.read(args.case) if args.read else None
    except CaseFileError as fault:
        return complain(str(fault), WRONG_INPUT)
    try:
        status = work(args, case)
        sys.stdout.flush()  # a full disk shows here
        return status
    except WrongInput as fault:
        return complain(str(fault), WRONG_INPUT)
    except BrokenPipeError:
        raise
    except _FAILURES as fault:
        where = f"{args.case}: " if args.read else ""
        return complain(f"{where}{str(fault) or type(fault).__name__}", FAILED)


def parser() -> argparse.ArgumentParser:
    """The commands and their options."""
    top = argparse.ArgumentParser(
        prog="mdr", allow_abbrev=False,
        description="Sliding friction of a viscoelastic contact under normal oscillation, from a case file (TOML, SI).",
        epilog="exit status: 0 done, 1 a run failed or did not settle, 2 wrong input, 130 interrupted",
    )  # fmt: skip
    top.add_argument("--version", action="version", version=f"mdr {mdr.__version__}")
    commands = top.add_subparsers(required=True, metavar="command")
    with_case = [
        ("velocity", velocity.velocity, "critical velocity and static friction in closed form, without a run"),
        ("curve", curve.curve, "coefficient of friction over pulling velocity, by simulation"),
        ("measure", judge.measure, "critical velocity from simulation alone"),
        ("verdict", judge.verdict, "how good the closed-form critical velocity is, and what to use in its place"),
    ]
    for name, work, summary in with_case:
        command = _command(commands, name, work, summary)
        _takes_file(command, "case.toml", "the case file; docs/example.toml is one", read_case)
        if name == "curve":
            curve.add_options(command)
        elif name == "verdict":
            judge.add_options(command)
        elif name == "measure":
            judge.add_accuracy_of_bracket(command)
    study = "a grid of cases, from a study file; the same call goes on after any end"
    command = _command(commands, "sweep", sweep.sweep, study)
    _takes_file(command, "study.toml", "the study file; docs/study.toml is one", sweep.read_study)
    sweep.add_options(command)
    explore.add_options(
        _command(commands, "explore", explore.explore, "a page in the browser to try a case with sliders")
    )
    named = "the shapes, materials and motions that a file can name, and their keys"
    _command(commands, "shapes", begin.shapes, named)
    begin.add_options(_command(commands, "case", begin.case, "a commented case file to begin with"))
    return top


def _command(commands: Any, name: str, work: Callable[..., int], summary: str) -> argparse.ArgumentParser:
    """One command, which reads no file as yet."""
    command: argparse.ArgumentParser = commands.add_parser(name, help=summary, description=summary, allow_abbrev=False)
    command.add_argument("--json", action="store_true", help="print one JSON object instead of text")
    command.set_defaults(work=work, read=None)
    return command


def _takes_file(command: argparse.ArgumentParser, name: str, meaning: str, read: Callable[[str], Any]) -> None:
    command.add_argument("case", metavar=name, help=meaning)
    command.set_defaults(read=read)


if __name__ == "__main__":
    sys.exit(main())
