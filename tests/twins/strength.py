"""The independent twin of a contact with a shear strength: springs in tiny steps (tiny_steps.py), and nothing else.

Nothing here comes from the library. A shape is its profile g = c x**n (Popov and Hess 2015), or a flat face. Springs of
a cell of the width dx at +x and at -x have the stiffness 2 dx E* in the normal direction and 2 dx G* in the plane, with
E* = E/(1 - nu²), G* = 4 G/(2 - nu). They bear

    f_z = 2 dx E* L[s],    f = 2 dx G* L[e],    |f| <= mu_0 f_z + 4 tau_0 sqrt(a² - x²) dx,

a the radius of contact.
"""

import math
from functools import partial
from typing import NamedTuple

import numpy as np
from twins import tiny_steps
from twins.tiny_steps import Body, Friction, Law, Row, crowded, motion_of, pulled, response

FLAT = math.inf  #: exponent of a flat face


class Contact(NamedTuple):
    """What slides, in SI."""

    shape: tuple[float, float]  #: n, c of g = c x**n; FLAT, a of a flat face
    E: float
    nu: float
    tau: float  #: Kelvin time
    arms: tuple[tuple[float, float], ...]  #: modulus and time of each
    mu_0: float
    tau_0: float
    omega: float
    u_z0: float
    du_z: float
    v_0: float
    shake: tuple[complex, complex]  #: amplitudes along and across, Re of x exp(i omega t)
    bodies: tuple[tuple[float, float, float], tuple[float, float, float]]  #: m, c, k of each way, k infinite if rigid


def paraboloid(R):
    return 2.0, 1 / R


def cone(theta):
    return 1.0, math.pi / 2 * math.tan(theta)


def fourth_power(c):
    return 4.0, 8 / 3 * c


def row_of(contact, law, count):
    """`count` cells, crowded towards the edge where contact is least and greatest, by the middle rule."""
    n, c = contact.shape
    if n == FLAT:
        edges = c * np.sin(np.linspace(0, np.pi / 2, count + 1))
        return Row(np.zeros(count), 2 * np.diff(edges), (edges[1:] + edges[:-1]) / 2, flat=c)
    lowest, least = contact.u_z0 - contact.du_z * abs(response(law, 1)), contact.u_z0 - contact.du_z
    ends = np.unique((np.maximum([0.0, lowest, least, contact.u_z0 + contact.du_z], 0.0) / c) ** (1 / n))
    edges = crowded(ends[np.diff(ends, prepend=-1.0) > 1e-6 * ends[-1]], count)
    edges = np.append(edges, edges[-1] + (edges[-1] - edges[-2]) * np.arange(1, 3))
    x = (edges[1:] + edges[:-1]) / 2
    return Row(c * x**n, 2 * np.diff(edges), x, 0.0, c, n)


def full_slip(contact, row, law, _, body):
    """All springs ahead at their limit of the mean depth, the body where this leaves it."""
    s = np.maximum(contact.u_z0 + contact.du_z - row.gap, 0.0)
    a = row.flat or (max(contact.u_z0, 0.0) / row.c) ** (1 / row.n)
    e = law.of_pressure * np.maximum(contact.u_z0 - row.gap, 0.0)
    return pulled(row, law, body, s, e + law.of_radius * np.sqrt(np.maximum(a * a - row.x**2, 0.0)))


def friction(contact, steps=8192, count=96):
    """COF of a contact along and across the pull, once it repeats itself, begun ahead of the pull.

    steps: of a period, of the finest of four marches. count: springs; what four times as many change is found with few
    steps.
    """
    E_star, omega = contact.E / (1 - contact.nu**2), contact.omega
    G_star = 4 * contact.E / (2 * (1 + contact.nu)) / (2 - contact.nu)
    rho, theta = np.array(contact.arms).reshape(-1, 2).T * np.array([[1 / contact.E], [omega]])
    limits = contact.mu_0 * E_star / G_star, 2 * contact.tau_0 / G_star
    law = Law(contact.tau * omega, rho.copy(), theta.copy(), *limits)
    groups = [(m * omega**2 / G_star, c * omega / G_star, k / G_star) for m, c, k in contact.bodies]
    body = Body(*np.array(groups).T.copy())

    def motion_in(steps):
        motion = motion_of([contact.du_z], *([x] for x in contact.shake), contact.v_0 / omega, steps)
        return motion._replace(z=contact.u_z0 + motion.z)

    parts = partial(row_of, contact, law), motion_in, partial(full_slip, contact)
    found = tiny_steps.friction(law, body, *parts, steps, count)
    return Friction(*(G_star / E_star * one for one in found))
