"""`mdr warm`: what runs of Coulomb's friction need is compiled now, so that none on this machine waits for it."""

from __future__ import annotations

import argparse

from mdr.commands.output import answer
from mdr.friction.warm import compile_all


def warm(args: argparse.Namespace, _: None) -> int:
    """Compile, with progress, and say that it is done."""
    kinds = compile_all()
    end = "until the program is changed; one with tau_0 still compiles at first"
    return answer(args, {"kinds": kinds}, f"{kinds} kinds of run are compiled on this machine, {end}")
