"""Exact forces of a contact that moves on straight pieces: each spring in closed form, their sum by quadrature.

Written from the law alone, in plain NumPy; nothing of `mdr` is used. A spring at x carries g_z = E* s, s = u_z - g(x)
> 0, and holds with G* e. Its extension e, a vector of the plane, stays within the leash r = mu_0 kappa s. On a straight
piece of motion w, on which r grows by rho, a spring

* sticks, e = e_0 + w t, until |e| = r, a quadratic equation for t;
* then slips to the end of the piece, as its slip velocity w.n - rho, n = e/r, only grows: n turns towards w, and the
  tangent of half the angle between them falls by exp(-|w| int dt/r) = (r_1/r_0)^(-|w|/rho), a tractrix;
* has e = 0 where it lifts off, and from where it touches.

The sum over x is split where the springs' histories differ, found by bisection; in between all is analytic, up to
powers at the ends, which the double-exponential rule takes.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

HALVINGS, GRID = 20, 1500  #: of the spacing of springs whose histories differ; springs at first
MOST_EDGES = 1000  #: more are rounding: springs that come to their leash to the last digit
SAME = 1e-12  #: share of a leash, or of a piece, that counts as none


class Contact(NamedTuple):
    """A rigid indenter on a half-space; SI."""

    shape: str  #: "ball", a paraboloid, or "punch", flat
    size: float  #: radius of the ball, or of the face
    E: float  #: long-time Young's modulus
    nu: float
    mu_0: float
    tau: float = 0.0  #: of a Kelvin body
    E_1: float = 0.0  #: modulus and time of a Maxwell arm
    tau_1: float = 0.0

    @property
    def E_star(self) -> float:
        """E/(1 - nu²)."""
        return self.E / (1 - self.nu**2)

    @property
    def kappa(self) -> float:
        """E*/G*, of Cattaneo and Mindlin."""
        return (2 - self.nu) / (2 * (1 - self.nu))

    def radius(self, d: float) -> float:
        """Of the contact at the depth d."""
        return self.size if self.shape == "punch" else float(np.sqrt(self.size * d))

    def load(self, d: np.ndarray) -> np.ndarray:
        """Elastic normal force at depths: Boussinesq, Hertz."""
        d = np.maximum(d, 0)
        if self.shape == "punch":
            return 2 * self.E_star * self.size * d
        return 4 / 3 * self.E_star * self.size**0.5 * d**1.5


Springs = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]  #: gaps (n,) -> extensions (rows, n), histories (n,)


def tangential(contact: Contact, u: np.ndarray, springs: Springs, per_side: int = 40) -> np.ndarray:
    """F_x + i F_y (rows,) of a path u (rows, 3); 2 per_side + 1 springs between two edges."""
    edge, G = contact.radius(u[:, 2].max()), contact.E_star / contact.kappa
    if contact.shape == "punch":
        return np.asarray(2 * G * edge * springs(np.zeros(1))[0][:, 0])
    ends = edges(lambda x: springs(x**2 / contact.size)[1], edge)
    t = np.linspace(-3.1, 3.1, 2 * per_side + 1)
    share, weight = 0.5 * (1 + np.tanh(np.pi / 2 * np.sinh(t))), np.cosh(t) / np.cosh(np.pi / 2 * np.sinh(t)) ** 2
    weight *= np.pi / 4 * (t[1] - t[0])
    x, of = ends[:-1, None] + np.diff(ends)[:, None] * share, np.diff(ends)[:, None] * weight
    return np.asarray(2 * G * springs(x.ravel() ** 2 / contact.size)[0] @ of.ravel())


def edges(history: Callable[[np.ndarray], np.ndarray], edge: float) -> np.ndarray:
    """Places between 0 and the edge where histories change, with both ends."""
    x = edge * np.linspace(0, 1, GRID + 1)
    for _ in range(HALVINGS):
        differ = np.diff(history(x).astype(np.int64)) != 0
        left, right = x[:-1][differ], x[1:][differ]
        if left.size > MOST_EDGES:
            raise ValueError(f"the histories of springs change at more than {MOST_EDGES} places")
        x = np.unique(np.concatenate([left, (left + right) / 2, right]))
    differ = np.diff(history(x).astype(np.int64)) != 0
    found = (x[:-1][differ] + x[1:][differ]) / 2
    return np.concatenate([[0.0], found[np.diff(found, prepend=-edge) > 1e-15 * edge], [edge]])


def dragged(contact: Contact, u: np.ndarray) -> Springs:
    """Extensions of elastic springs on the path u (rows, 3), complex."""

    def springs(gap: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        e, slips, found = np.zeros(gap.size, complex), np.zeros(gap.size, bool), np.zeros((len(u), gap.size), complex)
        history = np.zeros(gap.size, np.uint64)
        leash = contact.mu_0 * contact.kappa * (u[:, 2, None] - gap)
        for k, (x, y, _) in enumerate(np.diff(u, axis=0), start=1):
            e, slips, event = piece(e, slips, complex(x, y), leash[k - 1], leash[k])
            history = history * np.uint64(1099511628211) + event.astype(np.uint64)
            found[k] = e
        return found, history

    return springs


def piece(
    e: np.ndarray, slips: np.ndarray, w: complex, r_0: np.ndarray, r_1: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Extensions after a straight piece, which springs slip at its end, and what happened, as a number."""
    rho, way = r_1 - r_0, abs(w)
    touches, lifts = (r_0 <= 0) & (r_1 > 0), r_1 <= 0
    with np.errstate(all="ignore"):
        begin = np.where(touches, -r_0 / rho, 0.0)
        r = np.where(touches, 0.0, r_0)
        e = np.where(touches, 0.0, e)
        A = way**2 - rho**2  # |e + w t|² - (r + rho t)² = A t² + 2 B t + C
        B = (e * np.conj(w)).real - r * rho
        C = np.where(slips | touches | (np.abs(e) > r * (1 - SAME)), 0.0, np.abs(e) ** 2 - r**2)
        under = np.abs(r * w - rho * e) ** 2 - (e * np.conj(w)).imag ** 2  # B² - A C
        root = np.sqrt(np.where(A > 0, np.maximum(under, 0.0), under))  # below zero by rounding alone
        later = np.where(B > 0, -C / (B + root), np.where(A > 0, (root - B) / A, np.inf))
        at_once = (C == 0) & ((B > 0) | ((B == 0) & (A > 0)))
        at = np.where(at_once, 0.0, np.where(np.isnan(later), np.inf, later))
        slip = ~lifts & (at < (1 - begin) * (1 - SAME))
        left, r_s = 1 - begin - at, r + rho * at
        n = np.where(touches, w, e + w * np.where(slip, at, 0.0))
        z, ahead = rho * left / r_s, w / way if way else 1.0
        area = np.where(touches, 0.0, np.where(np.abs(z) > 0, np.log1p(z) / z, 1.0) * left / r_s)  # of dt/r
        n = n * np.conj(ahead) / np.abs(n)
        half = 1 + n.real + 1j * n.imag * np.exp(-way * area)  # at half the angle to the way
        slipped = r_1 * ahead * np.where(n.imag == 0, np.sign(n.real), half**2 / np.abs(half) ** 2)
    e = np.where(slip, slipped, e + w * (1 - begin))
    event = 1 * touches + 2 * lifts + 4 * slip + 8 * (slip & at_once)
    return np.where(lifts, 0.0, e), slip, event


def with_dashpot(contact: Contact, t: np.ndarray, u: np.ndarray) -> Springs:
    """The same of Kelvin springs at one depth, along x: extensions that an elastic spring needs for their force.

    A spring at rest in depth has the leash R for e + tau e'. Stick: e' = u_x'. Slip: e relaxes towards R.
    """
    v, dt = np.diff(u[:, 0]) / np.diff(t), np.diff(t)

    def springs(gap: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        R = contact.mu_0 * contact.kappa * np.maximum(u[0, 2] - gap, 0)
        e, found, history = np.zeros(gap.size), np.zeros((len(u), gap.size)), np.zeros(gap.size, np.uint64)
        for k, (v_k, dt_k) in enumerate(zip(v, dt, strict=True), start=1):
            side = np.sign(v_k)
            until = (R - side * e - contact.tau * abs(v_k)) / abs(v_k) if v_k else np.full(gap.size, dt_k)
            until = np.clip(until, 0.0, dt_k)
            slip, stuck = until < dt_k * (1 - SAME), e + v_k * until
            e = np.where(slip, side * R - (side * R - stuck) * np.exp((until - dt_k) / contact.tau), stuck)
            found[k] = np.where(slip, side * R, stuck + contact.tau * v_k)
            history = history * np.uint64(1099511628211) + (1 * slip + 2 * (until > 0)).astype(np.uint64)
        return found, history

    return springs
