"""The contacts of which the march is asked, each at its velocity: every kind of spring, motion, body and shake."""

import math
from typing import NamedTuple

from conftest import contact, unit_of_velocity
from tables import turning

import mdr

BODY = {"k_ratio": 0.7, "omega_0_ratio": 1.6, "c_ratio": 0.06}
MASSLESS = {"k_ratio": 0.7, "omega_0_ratio": math.inf, "c_ratio": 0.3}
STILL = {
    "rigid elastic": ("paraboloid", contact("paraboloid", 2.5)),
    "rigid Kelvin": ("cone", contact("cone", 2.5, 0.6)),
    "flat, contact lost": ("flat", contact("flat", 0.7, 0.6)),
    "tapping": ("paraboloid", contact("paraboloid", -0.3, 0.6)),
    "body elastic": ("cone", contact("cone", 2.5, **BODY)),
    "body Kelvin": ("paraboloid", contact("paraboloid", 2.5, 0.6, **BODY)),
    "massless Kelvin": ("r4", contact("r4", 2.5, 0.6, **MASSLESS)),
}


class Asked(NamedTuple):
    """A contact, the name of its shape, and the velocity at which it is pulled."""

    shape: str
    case: mdr.SlidingContact
    v_0: float


def solid(T, rho, theta):
    """A material with arms, by its moduli over E and by its times over 1/omega."""
    arms = tuple((3e6 * r, t / turning.OMEGA) for r, t in zip(rho, theta, strict=True))
    return mdr.Prony(3e6, arms, turning.NU, T / turning.OMEGA)


def with_arms(shape, depth_ratio, material, v, pull=None):
    motion = mdr.NormalOscillation(depth_ratio * 2e-6, 2e-6, turning.OMEGA)
    case = mdr.SlidingContact(turning.SHAPES[shape][0], material, 0.4, motion, pull or mdr.RigidPull())
    return Asked(shape, case, v * case.unit_velocity)


ONE, TWO = ((2.0,), (0.7,)), ((1.5, 0.5), (0.3, 4.0))
ARMS = {
    "arm": with_arms("flat", 3.0, solid(0.0, *ONE), 0.7),
    "arms, contact lost": with_arms("cone", 0.6, solid(0.0, *TWO), 0.3),
    "arms and dashpot": with_arms("r4", -0.3, solid(0.5, *ONE), 0.2),
    "body on arms": with_arms("paraboloid", 3.0, solid(0.0, *TWO), 0.4, mdr.SpringPull(2e3, 0.02, 0.5)),
    "body on arms and dashpot": with_arms("paraboloid", 3.0, solid(0.5, *ONE), 0.4, mdr.SpringPull(2e3, 0.02, 0.5)),
}


def drawn(which, bodies, motions):
    """Some of the random contacts that are shaken along the pull or across it."""
    found = turning.drawn(1 + max(which), bodies, motions)
    return {name: Asked(*asked) for name, *asked in (found[i] for i in which)}


ALONG = {**drawn((4, 12, 18, 21, 23, 30), False, turning.ALONG), **drawn((3, 21, 39), True, turning.ALONG)}
ACROSS = {**drawn((1, 17, 40, 77, 101), False, turning.MOTIONS), **drawn((8, 11, 12), True, turning.MOTIONS)}
CONTACTS = {
    **{name: Asked(shape, case, 0.43 * unit_of_velocity(case)) for name, (shape, case) in STILL.items()},
    **ARMS, **ALONG, **ACROSS,
}  # fmt: skip
