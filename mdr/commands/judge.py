"""`mdr measure` and `mdr verdict`: the critical velocity from simulation, and the closed form judged by it."""

from __future__ import annotations

import argparse
from functools import partial

import mdr
from mdr.commands.arguments import add_accuracy, plain_number
from mdr.commands.output import Exit, Told, answer, text_of, values_of
from mdr.commands.velocity import HARMONICS, ends_of, equation_of, told_velocity
from mdr.friction.measured_velocity import MeasuredVelocity
from mdr.friction.verdict import Verdict
from mdr.tools.checks import between


def add_options_of_measure(command: argparse.ArgumentParser) -> None:
    """How narrow the bracket of the measurement is to be."""
    add_accuracy(command, "a quarter of the width of the bracket of v_c, over v_c")


def add_options_of_verdict(command: argparse.ArgumentParser) -> None:
    """How far off a good formula may be."""
    must_be = "a share above 0 and below 1, such as 1% or 0.01"
    share = plain_number("-", must_be, partial(between, "", low=0, high=1))
    usual = f"{100 * Verdict.within:g}%%"
    meaning = f"call the formula good if it is no further off than this: 1%% or 0.01 (default: {usual})"
    command.add_argument("--within", metavar="share", type=share, default=Verdict.within, help=meaning)
    add_options_of_measure(command)
    said = "also say how far off springs are in three dimensions: one more run, of some ten seconds; takes a rigid pull"
    command.add_argument("--three-dimensions", action="store_true", help=said)


def measure(args: argparse.Namespace, case: mdr.SlidingContact) -> int:
    """Print v_c, its bracket and what showed it; status 1 where there is none."""
    ways = {"forward": 1, "other way": -1} if case.is_shaken else {"v_c": 1}
    found = {name: mdr.measure_critical_velocity(case, way, accuracy=args.accuracy) for name, way in ways.items()}
    told, ends = [_measured(name, one) for name, one in found.items()], ends_of(case)
    back = {"other_way": values_of(told[1])} if case.is_shaken else {}
    text = "\n".join(text_of(part) for part in (*told, ends) if part)
    answer(args, values_of(told[0]) | back | values_of(ends), text, case)
    return Exit.DONE if all(one.v_c is not None for one in found.values()) else Exit.FAILED


def verdict(args: argparse.Namespace, case: mdr.SlidingContact) -> int:
    """Print the sentence and the numbers behind it."""
    asked = {"within": args.within, "accuracy": args.accuracy, "three_dimensions": args.three_dimensions}
    found, ends = mdr.verdict(case, **asked), ends_of(case)
    back = found.other_way
    if back is None:
        ways = {"": found}
    elif found.same_both_ways:
        ways = {"\nboth ways:": found}
    else:
        ways = {"\nforward:": found, "\nthe other way:": back}
    told = {head: _judged(one, *equation_of(case)) for head, one in ways.items()}
    told |= {"\nat rest:": ends} if ends else {}
    text = "\n".join([str(found), *(line for head, rows in told.items() for line in (head, text_of(rows)) if line)])
    values = values_of(_judged(found, *equation_of(case)))
    if back is not None:
        values |= {"other_way": values_of(_judged(back, *equation_of(case))), "at_rest": found.at_rest}
        values |= values_of(ends)
    answer(args, values | {"sentence": str(found)}, text, case)
    known = [one.holds or one.measured is not None for one in ways.values()]
    return Exit.DONE if all(known) else Exit.FAILED  # no v_c on a resonance is an answer


def _measured(name: str, found: MeasuredVelocity) -> list[Told]:
    known = found.low is not None and found.high is not None
    bracket = f"{found.low:.9g} to {found.high:.9g} m/s" if known else ""
    return [
        told_velocity("v_c", found.v_c, name, found.kind),
        Told("low", found.low, "bracket", bracket, "stick below, none above"),
        Told("high", found.high),
        Told("kind", found.kind),
        Told("why", found.why, "", found.why),
    ]


def _judged(found: Verdict, equation: str, how: str) -> list[Told]:
    """The numbers of a verdict."""
    off = "none" if found.deviation is None else f"{found.deviation:+.3e}"
    vanishes = found.eq_15 <= found.least
    against = f"measured less {equation}, over 1e-4 of Eq. (1)" if vanishes else f"measured over {equation}, less 1"
    good, holds = _yes_or_no(found.good, "undefined"), _yes_or_no(found.holds, "cannot be judged")
    return [
        told_velocity("eq_15", found.eq_15, equation, how),
        told_velocity("full_slip", found.full_slip, "full slip", f"any amplitude, {HARMONICS}"),
        told_velocity("measured", found.measured, "measured", "from simulation alone"),
        Told("deviation", found.deviation, "deviation", off, against),
        Told("within", found.within),
        Told("good", found.good, "good", good, f"to {100 * found.within:.4g} %"),
        Told("holds", found.holds, "holds", holds, "to the bracket of the measurement"),
        Told("why", found.why),
    ]


def _yes_or_no(answer: bool | None, neither: str) -> str:
    return neither if answer is None else "yes" if answer else "no"
