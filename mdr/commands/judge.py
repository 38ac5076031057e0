"""`mdr measure` and `mdr verdict`: the critical velocity from simulation, and the closed form judged by it."""

from __future__ import annotations

import argparse
from typing import Any

from mdr.commands.output import DONE, FAILED, print_json, print_rows, velocity_text
from mdr.commands.velocity import equation_of
from mdr.contact import SlidingContact


def measure(args: argparse.Namespace, case: SlidingContact) -> int:
    """Print v_c, its bracket and what showed it; status 1 where there is none."""
    from mdr.measurement import measure_critical_velocity

    found = measure_critical_velocity(case)
    if args.json:
        print_json(args, {name: getattr(found, name) for name in ("v_c", "low", "high", "kind", "why")}, case)
    else:
        print_rows([("v_c", velocity_text(found.v_c), found.kind), *_bracket(found), ("", found.why, "")])
    return DONE if found.v_c is not None else FAILED


def verdict(args: argparse.Namespace, case: SlidingContact) -> int:
    """Print the sentence and the numbers behind it."""
    from mdr import judgement

    found, (equation, how) = judgement.verdict(case), equation_of(case)
    if args.json:
        names = ("eq_15", "full_slip", "measured", "deviation", "holds", "why")
        print_json(args, {name: getattr(found, name) for name in names} | {"sentence": str(found)}, case)
    else:
        print(found)
        off = "none" if found.deviation is None else f"{found.deviation:+.3e}"
        print_rows([
            (equation, velocity_text(found.eq_15), how),
            ("full slip", velocity_text(found.full_slip), "any amplitude, all harmonics of the force"),
            ("measured", velocity_text(found.measured), "from simulation alone"),
            ("deviation", off, f"measured over {equation}, less 1"),
            ("holds", {True: "yes", False: "no", None: "cannot be judged"}[found.holds], ""),
        ])  # fmt: skip
    return DONE if found.holds or found.measured is not None else FAILED  # no v_c on a resonance is an answer


def _bracket(found: Any) -> list[tuple[str, str, str]]:
    if found.low is None or found.high is None:
        return []
    return [("bracket", f"{found.low:.9g} to {found.high:.9g} m/s", "reduced below, full above")]
