"""The independent twin of a contact with a shear strength: springs in tiny steps (tiny_steps.py), and nothing else.

Nothing here comes from the library. A shape is its slope f'(r) outside of a level part, and its image in one dimension
g = x integral of f'(x sin psi) over psi (Popov and Hess 2015). Springs of a cell of the width dx at +x and at -x have
the stiffness 2 dx E* in the normal direction and 2 dx G* in the plane, with E* = E/(1 - nu²), G* = 4 G/(2 - nu). They
bear

    f_z = 2 dx E* L[s],    f = 2 dx G* L[e],    |f| <= mu_0 f_z + 4 tau_0 sqrt(a² - x²) dx,

a the radius of contact.
"""

import math
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from twins import tiny_steps
from twins.tiny_steps import Body, Friction, Law, Row, crowded, motion_of, pulled, response

KNOWN = 8192  #: depths at which the radius of contact is known, with lines between


class Shape(NamedTuple):
    """A shape of revolution, level out to a radius."""

    slope: Callable[[np.ndarray], np.ndarray]  #: f'(r) from there on
    level: float = 0.0  #: this radius
    rim: float = math.inf  #: where the shape ends; all of its face touches, if it is within reach at all

    def g(self, x):
        """Its image in one dimension at places (n,)."""
        share, weight = np.polynomial.legendre.leggauss(40)
        begin = np.arcsin(np.minimum(self.level / np.maximum(x, 1e-300), 1.0))[:, None]
        half = (np.pi / 2 - begin) / 2
        psi = begin + half * (1 + share)
        return x * (half * weight * self.slope(x[:, None] * np.sin(psi))).sum(axis=1)


class Contact(NamedTuple):
    """What slides, in SI."""

    shape: Shape
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


def punch(a):
    return Shape(lambda r: 0 * r, rim=a)


def concave_punch(a, R):
    return Shape(lambda r: -r / R, rim=a)


def paraboloid(R, b=0.0):
    return Shape(lambda r: r / R, b)


def cone(theta, b=0.0):
    return Shape(lambda r: math.tan(theta) + 0 * r, b)


def rounded_punch(R, b):
    return Shape(lambda r: (r - b) / R, b)


def fourth_power(c):
    return Shape(lambda r: 4 * c * r**3)


def row_of(contact, law, count):
    """`count` cells, crowded towards the edges of contact where it is least and greatest, and of a level part, by the
    middle rule.
    """
    shape, deepest = contact.shape, contact.u_z0 + contact.du_z
    if math.isfinite(shape.rim):
        edges = shape.rim * np.sin(np.linspace(0, np.pi / 2, count + 1))
        x = (edges[1:] + edges[:-1]) / 2
        return Row(shape.g(x), 2 * np.diff(edges), x, np.zeros(1), np.array([shape.rim]))
    lowest, least = contact.u_z0 - contact.du_z * abs(response(law, 1)), contact.u_z0 - contact.du_z
    most = shape.level or deepest
    while shape.g(np.array([most]))[0] < 1.5 * deepest:
        most *= 1.1
    radii = shape.level + (most - shape.level) * np.linspace(0, 1, KNOWN) ** 2
    depths = shape.g(radii)
    ends = np.interp(np.maximum([0.0, lowest, least, deepest], 0.0), depths, radii)
    ends = np.unique([0.0, *ends])
    edges = crowded(ends[np.diff(ends, prepend=-1.0) > 1e-6 * ends[-1]], count)
    edges = np.append(edges, edges[-1] + (edges[-1] - edges[-2]) * np.arange(1, 3))
    x = (edges[1:] + edges[:-1]) / 2
    return Row(shape.g(x), 2 * np.diff(edges), x, depths, radii)


def full_slip(contact, row, law, _, body):
    """All springs ahead at their limit of the mean depth, the body where this leaves it."""
    s = np.maximum(contact.u_z0 + contact.du_z - row.gap, 0.0)
    a = np.interp(contact.u_z0, row.depths, row.radii)
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
