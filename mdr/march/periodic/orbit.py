"""The end of a march: a state of springs and body, and what is known of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from mdr.march.dynamics.state import MarchState
from mdr.march.periodic.settling import Settling
from mdr.tools.arrays import Array


class SlowMotions(NamedTuple):
    """Slow motions about a periodic state, as far as they are known: k displacements that outlive a few periods, in all
    parts (k, n_x) of the state, and these displacements a period later.
    """

    before: Array
    after: Array


@dataclass(frozen=True, eq=False)
class Orbit:
    """A state at the end of a period: periodic where it was solved for, or what waiting has led to."""

    state: MarchState
    settling: Settling  #: its COF, and how far it may be from that of the exact periodic state
    least_slip: float = 0.0  #: least slip velocity along the pull, in that period, of springs that slip all the time
    motions: SlowMotions | None = None  #: the slow ones about it, where they are known
