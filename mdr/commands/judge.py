"""`mdr measure` and `mdr verdict`: the critical velocity from simulation, and the closed form judged by it."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING, Any

from mdr.case.contact import SlidingContact
from mdr.commands.output import DONE, FAILED, add_accuracy, print_json, print_rows, velocity_text
from mdr.commands.velocity import Ends, equation_of
from mdr.friction.verdict import WITHIN

if TYPE_CHECKING:
    from mdr.friction.verdict import Verdict


def measure(args: argparse.Namespace, case: SlidingContact) -> int:
    """Print v_c, its bracket and what showed it; status 1 where there is none."""
    from mdr.friction.measured_velocity import measure_critical_velocity

    ways = (1, -1) if case.is_shaken else (1,)
    measured = [measure_critical_velocity(case, way, accuracy=args.accuracy) for way in ways]
    if args.json:
        told = [{name: getattr(one, name) for name in ("v_c", "low", "high", "kind", "why")} for one in measured]
        more = {"other_way": told[1], **Ends.of(case).values} if case.is_shaken else {}
        print_json(args, told[0] | more, case)
    else:
        for name, found in zip(("forward", "other way") if case.is_shaken else ("v_c",), measured, strict=True):
            print_rows([(name, velocity_text(found.v_c), found.kind), *_bracket(found), ("", found.why, "")])
        if case.is_shaken:
            print_rows(Ends.of(case).rows)
    return DONE if all(found.v_c is not None for found in measured) else FAILED


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
    ways = [("", found)] if found.other_way is None else [("forward", found), ("the other way", found.other_way)]
    if args.json:
        names = ("eq_15", "full_slip", "measured", "deviation", "within", "good", "holds", "why")
        told = [{name: getattr(one, name) for name in names} for _, one in ways]
        more = {"other_way": told[1], "at_rest": found.at_rest, **Ends.of(case).values} if len(ways) > 1 else {}
        print_json(args, told[0] | more | {"sentence": str(found)}, case)
    else:
        print(found)
        for way, one in ways:
            if way:
                print(f"\n{way}:")
            _print_verdict(one, equation, how)
        if case.is_shaken:
            print("\nat rest:")
            print_rows(Ends.of(case).rows)
    known = [one.holds or one.measured is not None for _, one in ways]
    return DONE if all(known) else FAILED  # no v_c on a resonance is an answer


def _print_verdict(found: Verdict, equation: str, how: str) -> None:
    """The numbers of a verdict."""
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
