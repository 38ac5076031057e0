"""`mdr find`, `tolerance`, `sensitivity` and `propagate`: which value brings about a friction, how much each input
matters, and how sure the answer is.
"""

from __future__ import annotations

import argparse
from contextlib import suppress
from itertools import zip_longest

import mdr
from mdr.case.paths import facts_at
from mdr.commands.arguments import (
    OF_MU_0,
    add_accuracy,
    add_velocity,
    each_once,
    plain_number,
    quantity,
    read_as,
    velocity,
    whole_number,
)
from mdr.commands.output import Exit, answer, picked, refusals
from mdr.commands.written import add_output, make_folder, write_found
from mdr.friction.find import searched_path
from mdr.friction.inputs import OF_RUN
from mdr.friction.sensitivity import QUANTITIES
from mdr.given.case_file import Said
from mdr.march.result.run import power_text
from mdr.studies.propagate import LEAST
from mdr.tools.notation import value_in


def add_options_of_find(command: argparse.ArgumentParser) -> None:
    """The number that is searched for, the wish, and the range."""
    known = "the number that is searched for, such as oscillation.du_z, load, frequency, alpha or v_0"
    command.add_argument("path", help=known)
    wish = "([--v-0 velocity] (--cof friction | --share share | --smooth) | --v-c velocity)"
    command.usage = f"%(prog)s case.toml path {wish} [--within low high]"
    pulled = "pulling velocity, with --cof, --share or --smooth, unless it is searched for: 10mm/s, 0.5v_c"
    command.add_argument("--v-0", metavar="velocity", type=velocity, help=pulled)
    friction = quantity("a COF", "-", OF_MU_0)
    command.add_argument("--cof", metavar="friction", type=friction, help="friction that is wanted: 0.2, 0.5mu_0")
    share = plain_number("-", "a share, such as 99% or 0.99")
    command.add_argument("--share", metavar="share", type=share, help="share of full friction that is wanted: 99%%")
    command.add_argument("--v-c", metavar="velocity", type=velocity, help="critical velocity that is wanted")
    smooth = "from which value on a body slides without stick-slip, where friction falls"
    command.add_argument("--smooth", action="store_true", help=smooth)
    ends = "range of the search: 0.1um 5um (default: 0.1 to 10 times the value of the case; for v_0 0.001v_c 10v_c)"
    command.add_argument("--within", metavar=("low", "high"), nargs=2, help=ends)


def find(args: argparse.Namespace, asked: Said) -> int:
    """Search and print; status 1 where there is no such value."""
    wish = {name: getattr(args, name).on(asked.case) for name in ("v_0", "cof", "v_c") if getattr(args, name)}
    with refusals():
        path = searched_path(asked.case, args.path)
        within = args.within and tuple(_end(end, path, asked.case) for end in args.within)
        wished = {**wish, "share": args.share, "smooth": args.smooth}
        found = mdr.find(asked.case, path, **wished, within=within, held=asked.held)
    unit = facts_at(path).unit
    pairs = zip(found.values, found.cases, strict=True)
    spent = [] if args.v_c else [_power(case, wish.get("v_0", value)) for value, case in pairs]
    values = {**picked(found, "path", "values", "mean_F_N", "why"), "unit": unit, "power": spent}
    told = ["" if one is None else ", power {}: {}".format(*power_text(one)) for one in spent]
    lines = zip_longest(str(found).splitlines(), told, fillvalue="")
    answer(args, values, "\n".join(map("".join, lines)), asked.case)
    return Exit.DONE if found.values else Exit.FAILED


def _power(case: mdr.SlidingContact, v_0: float) -> dict[str, float] | None:
    """What it takes [W], by a run; None where that does not settle, or friction is a limit as v_0 -> 0, or falls and
    the periods of the run differ.
    """
    with suppress(ValueError):
        run = mdr.slide(case, v_0)
        return run.power if run.settled and (case.friction.stick == 1 or run.periods == 1) else None
    return None


def _end(text: str, path: str, case: mdr.SlidingContact) -> float:
    """An end of the range; of velocities over v_c too."""
    if path == OF_RUN:
        return velocity(text).on(case)
    return value_in("--within", text, facts_at(path).unit)


def add_options_of_tolerance(command: argparse.ArgumentParser) -> None:
    """The velocity, the share, the inputs, and where to write."""
    add_velocity(command)
    share = plain_number("-", "a share, such as 10% or 0.1")
    command.add_argument("--by", metavar="share", type=share, default=0.1, help="less and more by this (default: 10%%)")
    _add_fields(command)
    add_output(command, "tolerance.csv", "tolerance.png", "tolerance.svg")


def tolerance(args: argparse.Namespace, asked: Said) -> int:
    """Vary each input, write and print; status 1 if a run did not settle."""
    make_folder(args)
    with refusals():
        found = mdr.tolerance(asked.case, args.v_0.on(asked.case), args.by, args.fields, held=asked.held)
    values = picked(found, "v_0", "by", "base_cof", "base_v_c", "inputs", "cof", "v_c", "warnings")
    answer(args, values, str(found), asked.case)
    write_found(args, found.plot, found.table(), str(found))
    return Exit.FAILED if found.warnings else Exit.DONE


def add_options_of_sensitivity(command: argparse.ArgumentParser) -> None:
    """The velocity, the inputs, and the accuracy of the runs."""
    _add_velocity_of_friction(command)
    command.usage = "%(prog)s case.toml [--v-0 velocity] [options]"
    _add_fields(command)
    add_accuracy(command, "bound on the error of the COF, whose springs and steps are taken, over full friction")
    add_output(command, "sensitivity.csv", "sensitivity.png", "sensitivity.svg")


def sensitivity(args: argparse.Namespace, asked: Said) -> int:
    """Write and print derivatives in per cent per per cent; in JSON in SI."""
    make_folder(args)
    with refusals():
        v_0 = args.v_0 and args.v_0.on(asked.case)
        found = mdr.sensitivity(asked.case, v_0, args.fields, held=asked.held, accuracy=args.accuracy)
    names = [name for quantity in QUANTITIES for name in (quantity, f"d_{quantity}")]
    answer(args, picked(found, "v_0", "inputs", *names, "error", "why"), str(found), asked.case)
    write_found(args, found.plot, found.table(), str(found))
    return Exit.DONE


def add_options_of_propagate(command: argparse.ArgumentParser) -> None:
    """The velocity, the inputs with their standard deviations, the samples, and where to write."""
    _add_velocity_of_friction(command)
    command.usage = "%(prog)s case.toml [--v-0 velocity] --spread path=sd [path=sd ...] [options]"
    of = "inputs with their standard deviations, in their unit or of their value: mu_0=5%% oscillation.du_z=0.1um"
    read = read_as("path=standard deviation, such as mu_0=5%", _spread)
    command.add_argument("--spread", metavar="path=sd", nargs="+", action="extend", type=read, required=True, help=of)
    least, n = whole_number(LEAST), "cases that are drawn (default: 1000)"
    command.add_argument("--samples", metavar="n", type=least, default=1000, help=n)
    command.add_argument("--seed", metavar="n", type=whole_number(0), default=0, help="of the draws (default: 0)")
    add_accuracy(command, "bound on the error of the COF of every run, over full friction")
    add_output(command, "propagate.csv", "propagate.png", "propagate.svg")
    command.epilog = (
        "propagate.csv has a row for each sample; the figures are histograms, with the curve of the slopes."
    )


def propagate(args: argparse.Namespace, asked: Said) -> int:
    """Draw, write and print; status 1 if samples are left out."""
    make_folder(args)
    with refusals():
        v_0 = args.v_0 and args.v_0.on(asked.case)
        drawn = {"samples": args.samples, "seed": args.seed, "accuracy": args.accuracy}
        found = mdr.propagate(asked.case, each_once(args.spread), v_0, held=asked.held, **drawn)
    names = ("v_0", "inputs", "spread", "cof", "cof_sd", "cof_share", "v_c", "v_c_sd", "v_c_share", "agrees", "why")
    told = ("mean", "sd", "low", "high", "error", "left_out")
    samples = {name: picked(one, *told) for name, one in found.samples.items()}
    answer(args, {**picked(found, *names), "samples": samples}, str(found), asked.case)
    write_found(args, found.plot, found.table(), str(found))
    return Exit.FAILED if any(one.left_out for one in found.samples.values()) else Exit.DONE


def _spread(text: str) -> tuple[str, str]:
    path, _, sd = text.partition("=")
    if not sd:
        raise ValueError
    return path, sd


def _add_velocity_of_friction(command: argparse.ArgumentParser) -> None:
    pulled = "pulling velocity at which friction is asked for: 10mm/s, 0.5v_c (default: closed forms alone)"
    command.add_argument("--v-0", metavar="velocity", type=velocity, help=pulled)


def _add_fields(command: argparse.ArgumentParser) -> None:
    named = "inputs, such as mu_0 load oscillation.du_z (default: all numbers of the case, and v_0)"
    command.add_argument("--fields", metavar="path", nargs="+", help=named)
