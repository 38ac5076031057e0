"""The contact modes of a spring; contact.py, line.py and disc.py say what ends each of them."""

from enum import IntEnum


class State(IntEnum):
    """Mode of a spring."""

    FREE = 0  #: out of contact
    STICK = 1  #: its foot rests on the plane
    SLIP = 2  #: slides forward, friction holds the indenter back; in the plane in any direction
    SLIP_BACK = 3  #: slides backward, friction drives the indenter on


FREE, STICK, SLIP, SLIP_BACK = (int(mode) for mode in State)  # plain numbers for compiled code
