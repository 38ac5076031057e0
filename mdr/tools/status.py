"""How a point of a study ended: what computes it, keeps it and draws it knows no more of the others."""

from enum import IntEnum


class Status(IntEnum):
    """How the computation of a point ended."""

    DONE = 0  #: every quantity is there
    UNSETTLED = 1  #: a run did not settle; its numbers are there
    FAILED = 2  #: at least one quantity is missing, NaN
    MISSING = 3  #: not computed yet
