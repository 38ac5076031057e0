"""The command line: `mdr velocity`, `run`, `curve`, `half-space`, `measure`, `verdict`, `fit`, `find`, `tolerance` and
`export` of a case file, `mdr record` of a recorded motion, `mdr sweep` of a study file, `mdr explore` in the browser,
`mdr shapes` and `mdr case` to begin with, `mdr warm` to compile ahead, `mdr completion` for the shell.

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
from functools import cache
from typing import Any

import mdr
from mdr.case.contact import SlidingContact
from mdr.commands import ask, begin, completion, curve, explore, export, fit, judge, record, run, sweep, velocity, warm
from mdr.commands.arguments import NEGATIVE, joined, no_options, path_of
from mdr.commands.output import Exit, WrongInput, complain
from mdr.files.toml_text import CaseFileError, StandardInput
from mdr.given.case_file import read_case, read_said
from mdr.normal.resolved import plausibility
from mdr.studies.study_files import read_study_file
from mdr.tools.warned import PlausibilityWarning, warn_outside

JSON = "print one JSON object instead of text"
#: name, work, summary, what reads its file, what adds its options
COMMANDS: tuple[tuple[str, Callable[..., int], str, Callable[[str], Any] | None, Callable[[Any], None]], ...] = (
    ("velocity", velocity.velocity, "critical velocity and static friction in closed form, without a run", read_case,
     no_options),
    ("run", run.run, "one velocity: friction with its error, and the springs that stick and slip", read_case,
     run.add_options_of_run),
    ("curve", curve.curve, "coefficient of friction over pulling velocity, by simulation", read_case,
     curve.add_options),
    ("half-space", run.half_space, "one velocity in three dimensions: friction with its errors, and a map", read_case,
     run.add_options_of_half_space),
    ("measure", judge.measure, "critical velocity from simulation alone", read_case, judge.add_accuracy_of_bracket),
    ("verdict", judge.verdict, "how good the closed-form v_c is, and what to use in its place", read_case,
     judge.add_options),
    ("fit", fit.fit, "parameters of the case from measured friction over velocity", read_said, fit.add_options),
    ("find", ask.find, "the value of one number that brings about a friction, or a critical velocity", read_said,
     ask.add_options_of_find),
    ("tolerance", ask.tolerance, "friction and critical velocity as each input alone is a little less and more",
     read_said, ask.add_options_of_tolerance),
    ("record", record.record, "friction under a recorded motion, from a CSV file and a case file", None,
     record.add_options),
    ("export", export.export, "the contact as a C header or a unit for co-simulation (FMI 2.0)", read_case,
     export.add_options),
    ("sweep", sweep.sweep, "a grid of cases, from a study file; the same call goes on after any end", read_study_file,
     sweep.add_options),
    ("explore", explore.explore, "a page in the browser to try a case with sliders", None, explore.add_options),
    ("shapes", begin.shapes, "the shapes, materials and motions that a file can name, and their keys", None,
     no_options),
    ("case", begin.case, "a commented case file to begin with", None, begin.add_options),
    ("warm", warm.warm, "compile all that runs need now, once on this machine, so that no run waits for it", None,
     no_options),
    ("completion", completion.completion, "a script that completes commands and options in the shell", None,
     completion.add_options),
)  # fmt: skip
_FAILURES = (ValueError, ArithmeticError, RuntimeError, OSError, MemoryError, PlausibilityWarning)  # as an error


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; returns the exit status."""
    given = list(sys.argv[1:] if argv is None else argv)
    top = parser()
    args = top.parse_args(joined(given))
    if args.work is None:
        top.print_help(sys.stderr)
        top.exit(Exit.WRONG_INPUT)
    os.environ["MPLBACKEND"] = "agg"  # pictures go to files alone, whatever the shell names
    args.command = shlex.join(["mdr", *given]).encode("utf-8", "backslashreplace").decode("utf-8")
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # a letter the terminal lacks must not cost the result
            stream.reconfigure(errors="backslashreplace")
    try:
        return _run(args)
    except KeyboardInterrupt:
        return complain("interrupted before it was done", Exit.INTERRUPTED)
    except BrokenPipeError:  # the reader, such as head, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return Exit.DONE


def _run(args: argparse.Namespace) -> int:
    """Read the file, do the work, and turn what goes wrong into a sentence and a status."""
    work: Callable[[argparse.Namespace, Any], int] = args.work

    @cache  # each once; PYTHONWARNINGS=ignore silences them
    def warned(text: str) -> None:
        complain(f"warning: {text}")

    try:
        _require_one_standard_input(args)
        with warnings.catch_warnings():
            warnings.showwarning = lambda message, *_, **__: warned(str(message))
            status = work(args, _read(args) if args.read else None)
        sys.stdout.flush()  # a full disk shows here
        return status
    except (WrongInput, CaseFileError) as fault:
        return complain(str(fault), Exit.WRONG_INPUT)
    except BrokenPipeError:
        raise
    except _FAILURES as fault:
        where = f"{args.case}: " if args.read else ""
        return complain(f"{where}{str(fault) or type(fault).__name__}")


def _require_one_standard_input(args: argparse.Namespace) -> None:
    twice = [name for name, given in vars(args).items() if isinstance(given, StandardInput)]
    if len(twice) > 1:
        both = " and for the ".join(twice)
        raise WrongInput(f"- stands for the {both}: standard input can be read once, give a file for one")


def _read(args: argparse.Namespace) -> Any:
    """What the file describes; what is unlikely of it is warned of."""
    case = args.read(args.case)
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
    for name, work, summary, read, add_options in COMMANDS:
        command = commands.add_parser(name, help=summary, description=summary, allow_abbrev=False)
        command.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help=JSON)
        command._negative_number_matcher = NEGATIVE
        command.set_defaults(work=work, read=read, top=top)
        if read is not None:
            file, shown = ("study", "study.toml") if name == "sweep" else ("case", "example.toml")
            meaning = f"the {file} file; docs/{shown} is one; - is standard input"
            command.add_argument("case", metavar=f"{file}.toml", type=path_of, help=meaning)
            command.usage = f"%(prog)s {file}.toml [options]"  # a list of values would take the file for one
        add_options(command)
    return top


if __name__ == "__main__":
    sys.exit(main())
