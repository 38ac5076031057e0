"""The command line: `mdr velocity`, `run`, `curve`, `half-space`, `measure`, `verdict`, `fit`, `find`, `design`,
`front`, `tolerance`, `sensitivity`, `propagate`, `export` of a case file, `mdr record` of a recorded motion, `mdr
indenter`, `mdr material` and `mdr motion` of what was measured, `mdr sweep` of a study file, `mdr explore` in the
browser, `mdr shapes` and `mdr case` to begin with, `mdr warm` to compile ahead, `mdr completion` for the shell.

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
from importlib import import_module
from itertools import takewhile
from pkgutil import resolve_name
from typing import Any, NamedTuple

import mdr
from mdr.commands.arguments import NEGATIVE, joined, path_of
from mdr.commands.output import Exit, NotWritten, WrongInput, complain
from mdr.files.toml_text import CaseFileError, StandardInput
from mdr.tools.messages import offer
from mdr.tools.warned import PlausibilityWarning, warn_outside

JSON = "print one JSON object instead of text"
CASES, STUDIES = "`mdr case > case.toml` makes one", "a case file with [axes], what varies, and quantities"


class Command(NamedTuple):
    """A command; what it stands on is imported when it is asked for."""

    work: str  #: module and function below `mdr.commands`; its options are added by add_options_of_<function> beside it
    summary: str
    reads: str = ""  #: what reads its file; none of what takes no file, or more than one


CASE, SAID = "mdr.given.case_file:read_case", "mdr.given.case_file:read_said"
COMMANDS = {
    "velocity": Command(
        "velocity:velocity", "critical velocity and static friction in closed form, without a run", CASE),
    "run": Command("run:run", "one velocity: friction with its error, and the springs that stick and slip", CASE),
    "curve": Command(
        "curve:curve", "friction over pulling velocity, in closed form where there is one, else by runs", CASE),
    "half-space": Command(
        "run:half_space", "one velocity in three dimensions: friction with its errors, and a map", CASE),
    "measure": Command("judge:measure", "critical velocity from simulation alone", CASE),
    "verdict": Command("judge:verdict", "how good the closed-form v_c is, and what to use in its place", CASE),
    "fit": Command("fit:fit", "parameters of the case from measured friction over velocity", SAID),
    "find": Command("ask:find", "the value of one number that brings about a friction, or a critical velocity", SAID),
    "design": Command(
        "design:design", "values of several numbers with which friction, v_c and power are within limits", SAID),
    "front": Command("design:front", "the least power that a vibration takes, over the friction that it leaves", SAID),
    "tolerance": Command(
        "ask:tolerance", "friction and critical velocity as each input alone is a little less and more", SAID),
    "sensitivity": Command(
        "ask:sensitivity", "how many per cent friction and critical velocity move for each per cent of an input", SAID),
    "propagate": Command(
        "ask:propagate", "how sure friction and critical velocity are, by the standard deviations of inputs", SAID),
    "record": Command("record:record", "friction under a recorded motion, from a CSV file and a case file"),
    "indenter": Command(
        "tables:indenter", "a table [indenter] from measured heights, or force over depth, in a CSV file"),
    "material": Command(
        "tables:material", "a table [material] from measured moduli, relaxation, creep or arms, in a CSV file"),
    "motion": Command("tables:motion", "a table [oscillation] from what an accelerometer recorded, from a CSV file"),
    "export": Command("export:export", "the contact as a C header or a unit for co-simulation (FMI 2.0)", CASE),
    "sweep": Command(
        "sweep:sweep", "a grid of cases, from a study file; the same call goes on after any end",
        "mdr.studies.study_files:read_study_file"),
    "explore": Command("explore:explore", "a page in the browser to try a case with sliders"),
    "shapes": Command("begin:shapes", "what a file can name, such as shapes, and its keys"),
    "case": Command("begin:case", "a commented case file to begin with"),
    "warm": Command("warm:warm", "compile all that runs without tau_0 need, once on this machine"),
    "completion": Command("completion:completion", "a script that completes commands and options in the shell"),
}  # fmt: skip
_FAILURES = (ValueError, ArithmeticError, RuntimeError, OSError, MemoryError, PlausibilityWarning)  # as an error


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; returns the exit status."""
    given = list(sys.argv[1:] if argv is None else argv)
    if given[:1] == ["help"]:
        given = [*given[1:2], "--help"]
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
    except NotWritten as fault:
        return complain(str(fault))
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
    found = args.read(args.case)
    for doubt in mdr.plausibility(getattr(found, "case", found)):  # of a study its case
        warn_outside(doubt)
    return found


class _Parser(argparse.ArgumentParser):
    """A parser that offers the spelling that was meant; of a command, one that knows its options once it is used."""

    command: Command | None = None

    def fill(self) -> _Parser:
        """Add what the command takes; done once."""
        command, self.command = self.command, None
        if command is None:
            return self
        name, _, function = command.work.partition(":")
        module = import_module(f"mdr.commands.{name}")
        read = resolve_name(command.reads) if command.reads else None
        self.set_defaults(work=getattr(module, function), read=read)
        if read is not None:
            file, begin = ("study", STUDIES) if "study" in command.reads else ("case", CASES)
            self.add_argument(
                "case", metavar=f"{file}.toml", type=path_of, help=f"the {file} file; {begin}; - is standard input"
            )
            self.usage = f"%(prog)s {file}.toml [options]"  # a list of values would take the file for one
        if add_options := getattr(module, f"add_options_of_{function}", None):
            add_options(self)
        return self

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parse; an option that there is not is told before what is missing."""
        known = [word for one in self.fill()._actions for word in one.option_strings if word.startswith("--")]
        given = takewhile(lambda word: word != "--", args)
        if self._subparsers:  # what follows the command is its own
            given = takewhile(lambda word: word.startswith("-"), given)
        for word in (one.partition("=")[0] for one in given):
            if word.startswith("--") and word not in known:
                self.error(f"{word} is no option; {offer(word, known)}")
        return super().parse_known_args(args, namespace)

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if isinstance(action, argparse._SubParsersAction) and value not in COMMANDS:
            raise argparse.ArgumentError(None, f"{value!r} is no command; {offer(value, list(COMMANDS))}")
        super()._check_value(action, value)


def parser() -> _Parser:
    """The commands; each learns its options when it is used."""
    top = _Parser(
        prog="mdr", allow_abbrev=False,
        description="Sliding friction of an elastic or viscoelastic contact that is vibrated up and down, along the "
        "slide or across it, from a case file (TOML, SI). `mdr case > case.toml` makes one to begin with.",
        epilog="exit status: 0 done, 1 a run failed or did not settle, 2 wrong input, 130 interrupted",
    )  # fmt: skip
    top.set_defaults(work=None, read=None)
    top.add_argument("--json", action="store_true", help=JSON)
    top.add_argument("--version", action="version", version=f"mdr {mdr.__version__}")
    commands = top.add_subparsers(metavar="command", parser_class=_Parser)
    for name, its in COMMANDS.items():
        command = commands.add_parser(name, help=its.summary, description=its.summary, allow_abbrev=False)
        command.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help=JSON)
        command._negative_number_matcher = NEGATIVE
        command.command = its
        command.set_defaults(top=top)
    return top


if __name__ == "__main__":
    sys.exit(main())
