"""How far this process has got with compiling: jit.py counts, and whoever asks need not import what compiles."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass
class Tally:
    """Functions of this package."""

    done: int = 0  #: that have been compiled
    open: int = 0  #: that are being compiled, one within another


TALLY = Tally()
