"""`mdr warm`: all that runs need is compiled now, so that no later run on this machine waits for it."""

from __future__ import annotations

import argparse

from mdr.commands.output import Exit, answer
from mdr.friction.warm import compile_all


def warm(args: argparse.Namespace, _: None) -> int:
    """Compile, with progress, and say that it is done."""
    kinds = compile_all()
    answer(args, {"kinds": kinds}, f"{kinds} kinds of run are compiled on this machine, until the program is changed")
    return Exit.DONE
