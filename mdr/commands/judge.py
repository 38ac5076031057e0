"""`mdr measure` and `mdr verdict`: the critical velocity from simulation, and the closed form judged by it."""

from __future__ import annotations

import argparse
import math
from typing import Any

from mdr.case.contact import SlidingContact
from mdr.commands.output import DONE, FAILED, add_accuracy, print_json, print_rows, velocity_text
from mdr.commands.velocity import equation_of
from mdr.friction.verdict import WITHIN


def measure(args: argparse.Namespace, case: SlidingContact) -> int:
    """Print v_c, its bracket and what showed it; status 1 where there is none."""
    from mdr.friction.measured_velocity import measure_critical_velocity

    found = measure_critical_velocity(case, accuracy=args.accuracy)
    if args.json:
        print_json(args, {name: getattr(found, name) for name in ("v_c", "low", "high", "kind", "why")}, case)
    else:
        print_rows([("v_c", velocity_text(found.v_c), found.kind), *_bracket(found), ("", found.why, "")])
    return DONE if found.v_c is not None else FAILED


def add_accuracy_of_bracket(command: argparse.ArgumentParser) -> None:
    """How narrow the bracket of the measurement is to be."""
    add_accuracy(command, "a quarter of the width of the bracket of v_c, over v_c")


def add_options(command: argparse.ArgumentParser) -> None:
    """How far off a good formula may be."""
    meaning = f"call the formula good if it is no further off than this: 1%% or 0.01 (default: {100 * WITHIN:g}%%)"
    command.add_argument("--within", metavar="share", type=_share, default=WITHIN, help=meaning)
    add_accuracy_of_bracket(command)


def verdict(args: argparse.Namespace, case: SlidingContact) -> int:
    """Print the sentence and the numbers behind it."""
    from mdr.friction import verdict as judgement

    found, (equation, how) = judgement.verdict(case, within=args.within, accuracy=args.accuracy), equation_of(case)
    if args.json:
        names = ("eq_15", "full_slip", "measured", "deviation", "within", "good", "holds", "why")
        print_json(args, {name: getattr(found, name) for name in names} | {"sentence": str(found)}, case)
    else:
        print(found)
        off = "none" if found.deviation is None else f"{found.deviation:+.3e}"
        vanishes = found.eq_15 <= found.least
        against = f"measured less {equation}, over 1e-4 of Eq. (1)" if vanishes else f"measured over {equation}, less 1"
        print_rows([
            (equation, velocity_text(found.eq_15), how),
            ("full slip", velocity_text(found.full_slip), "any amplitude, all harmonics of the force"),
            ("measured", velocity_text(found.measured), "from simulation alone"),
            ("deviation", off, against),
            ("good", _yes_or_no(found.good, "undefined"), f"to {100 * found.within:.4g} %"),
            ("holds", _yes_or_no(found.holds, "cannot be judged"), "to the bracket of the measurement"),
        ])  # fmt: skip
    return DONE if found.holds or found.measured is not None else FAILED  # no v_c on a resonance is an answer


def _yes_or_no(answer: bool | None, neither: str) -> str:
    return neither if answer is None else "yes" if answer else "no"


def _share(text: str) -> float:
    """A share of v_c, given as such or as a percentage."""
    number = text.strip()
    try:
        share = float(number.removesuffix("%")) / (100 if number.endswith("%") else 1)
    except ValueError:
        share = math.nan
    if not 0 < share < 1:
        raise argparse.ArgumentTypeError(f"must be a share above 0 and below 1, such as 1% or 0.01, got {text!r}")
    return share


def _bracket(found: Any) -> list[tuple[str, str, str]]:
    if found.low is None or found.high is None:
        return []
    return [("bracket", f"{found.low:.9g} to {found.high:.9g} m/s", "reduced below, full above")]
