"""The command line: `mdr velocity`, `run`, `curve`, `measure`, `verdict` and `fit` of a case file, `mdr sweep` of a
study file, `mdr explore` in the browser, `mdr shapes` and `mdr case` to begin with, `mdr completion` for the shell.

Installed as `mdr`, also `python -m mdr`. Exit status: 0 done; 1 a run failed, did not settle or found nothing;
2 wrong input, or no command (the help is shown); 130 interrupted. Results go to standard output (with --json one JSON
object: what is undefined is null, an infinite value the string "inf"), everything else to standard error. In the place
of a file, - is standard input. -o names the folder that a command writes its files to.
"""

from __future__ import annotations

import argparse
import os
import shlex
import sys
import warnings
from collections.abc import Callable, Sequence
from typing import Any

import mdr
from mdr.case.contact import SlidingContact
from mdr.commands import begin, completion, curve, explore, fit, judge, run, sweep, velocity
from mdr.commands.arguments import path_of
from mdr.commands.output import DONE, INTERRUPTED, WRONG_INPUT, WrongInput, complain
from mdr.files.case_files import read_case, read_said
from mdr.files.toml_text import CaseFileError
from mdr.normal.doubts import PlausibilityWarning, warn_outside
from mdr.normal.resolved import plausibility

JSON = "print one JSON object instead of text"
_FAILURES = (ValueError, ArithmeticError, RuntimeError, OSError, MemoryError, PlausibilityWarning)  # as an error


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; returns the exit status."""
    given = list(sys.argv[1:] if argv is None else argv)
    top = parser()
    args = top.parse_args(given)
    if args.work is None:
        top.print_help(sys.stderr)
        top.exit(WRONG_INPUT)
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
        with warnings.catch_warnings():
            warnings.showwarning = _Warnings()
            status = work(args, _read(args) if args.read else None)
        sys.stdout.flush()  # a full disk shows here
        return status
    except WrongInput as fault:
        return complain(str(fault), WRONG_INPUT)
    except BrokenPipeError:
        raise
    except _FAILURES as fault:
        where = f"{args.case}: " if args.read else ""
        return complain(f"{where}{str(fault) or type(fault).__name__}")


class _Warnings:
    """Says what is warned of on standard error, each once. PYTHONWARNINGS=ignore silences it."""

    def __init__(self) -> None:
        self.said: set[str] = set()

    def __call__(self, message: Warning | str, *_: Any, **__: Any) -> None:
        if str(message) not in self.said:
            self.said.add(str(message))
            complain(f"warning: {message}")


def _read(args: argparse.Namespace) -> Any:
    """What the file describes; what is unlikely of it is warned of."""
    try:
        case = args.read(args.case)
    except CaseFileError as fault:
        raise WrongInput(str(fault)) from None
    base = case if isinstance(case, SlidingContact) else getattr(case, "case", None)  # of a study
    for doubt in plausibility(base) if base is not None else ():
        warn_outside(doubt)
    return case


def parser() -> argparse.ArgumentParser:
    """The commands and their options."""
    top = argparse.ArgumentParser(
        prog="mdr", allow_abbrev=False,
        description="Sliding friction of a viscoelastic contact under normal oscillation, from a case file (TOML, SI).",
        epilog="exit status: 0 done, 1 a run failed or did not settle, 2 wrong input, 130 interrupted",
    )  # fmt: skip
    top.set_defaults(work=None, read=None)
    top.add_argument("--json", action="store_true", help=JSON)
    top.add_argument("--version", action="version", version=f"mdr {mdr.__version__}")
    commands = top.add_subparsers(metavar="command")
    with_case: list[tuple[str, Callable[..., int], str, Callable[[argparse.ArgumentParser], None] | None]] = [
        ("velocity", velocity.velocity, "critical velocity and static friction in closed form, without a run", None),
        ("run", run.run, "one velocity: friction with its error, and the springs that stick and slip", run.add_options),
        ("curve", curve.curve, "coefficient of friction over pulling velocity, by simulation", curve.add_options),
        ("measure", judge.measure, "critical velocity from simulation alone", judge.add_accuracy_of_bracket),
        ("verdict", judge.verdict, "how good the closed-form v_c is, and what to use in its place", judge.add_options),
        ("fit", fit.fit, "parameters of the case from measured friction over velocity", fit.add_options),
    ]
    for name, work, summary, add_options in with_case:
        command = _command(commands, name, work, summary)
        read = read_said if name == "fit" else read_case  # what a fit varies leaves what the file says
        _takes_file(command, "case.toml", "the case file; docs/example.toml is one", read)
        if add_options is not None:
            add_options(command)
    study = "a grid of cases, from a study file; the same call goes on after any end"
    command = _command(commands, "sweep", sweep.sweep, study)
    _takes_file(command, "study.toml", "the study file; docs/study.toml is one", sweep.read_study)
    sweep.add_options(command)
    page = "a page in the browser to try a case with sliders"
    explore.add_options(_command(commands, "explore", explore.explore, page))
    named = "the shapes, materials and motions that a file can name, and their keys"
    _command(commands, "shapes", begin.shapes, named)
    begin.add_options(_command(commands, "case", begin.case, "a commented case file to begin with"))
    shell = "a script that completes commands and options in the shell"
    completion.add_options(_command(commands, "completion", completion.completion, shell), top)
    return top


def _command(commands: Any, name: str, work: Callable[..., int], summary: str) -> argparse.ArgumentParser:
    """One command, which reads no file as yet."""
    command: argparse.ArgumentParser = commands.add_parser(name, help=summary, description=summary, allow_abbrev=False)
    command.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help=JSON)
    command.set_defaults(work=work)
    return command


def _takes_file(command: argparse.ArgumentParser, name: str, meaning: str, read: Callable[[str], Any]) -> None:
    command.add_argument("case", metavar=name, type=path_of, help=f"{meaning}; - is standard input")
    command.set_defaults(read=read)
    command.usage = f"%(prog)s {name} [options]"  # an option with a list of values would take the file for one


if __name__ == "__main__":
    sys.exit(main())
