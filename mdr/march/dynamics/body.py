"""The body: a linear oscillator between the pull and the springs, over one step under their force.

M u'' + C u' + K u = -F(t), with its motion u relative to the pull. A step gives the area and the moment of F, and the
body answers a force that is linear in the step, with this area and moment, exactly. So it has no dispersion of its own,
and right impulses whatever happens within a step.

A *light* body, without mass, or one whose oscillation on the contact the steps do not resolve, or which the dashpots of
the contact stop within a step, follows the springs at once. It too moves on a parabola in a step, from where it is,
such that the impulse of all forces over the step is zero and their sum at its end too: Radau's method of third order.
What it does not resolve dies out at once.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mdr.spring.law import Law, phi_of
from mdr.tools.jit import compiled

RESOLVED = 16  #: steps per oscillation of the body on the contact, from which on it counts as resolved
TERMS = 20  #: of a series whose terms are 1/n! at most
N_BODY = 2
U, RATE = range(N_BODY)  #: parts of a state of the body

Pair = tuple[float, float]  # plain numbers: arrays would be counted by reference in every step
Square = tuple[Pair, Pair]


class Body(NamedTuple):
    """The body over steps of h."""

    rigid: bool  #: whether it moves as it is pulled, whatever the force
    light: bool
    M: float
    C: float
    K: float
    h: float
    ringing: float  #: omega_1/omega on springs that stick; infinite without mass, zero under a rigid pull
    free: Square  #: motion without force, of (u, u')
    area: Pair  #: what the area of the force takes off
    moment: Pair  #: what its moment takes off
    stuck: Square  #: derivative of what the force takes off by (u, u') at the end, if all springs stick

    @property
    def pull_time(self) -> float:
        """Relaxation time c_x/k_x of the pull, in periods; 0 under a rigid pull."""
        return self.C / (2 * np.pi * self.K)


def body_of(M: float, C: float, K: float, law: Law, h: float, ringing: float) -> Body:
    """The body of these groups over steps of h; K is infinite under a rigid pull."""
    none, square = (0.0, 0.0), ((0.0, 0.0), (0.0, 0.0))
    if np.isinf(K):
        return Body(True, False, 0.0, 0.0, K, h, 0.0, square, none, none, square)
    if ringing * h > 2 * np.pi / RESOLVED or law.T * h > M:  # it rings on what sticks, or that stops it at once
        return Body(False, True, M, C, K, h, ringing, square, none, none, square)
    moved, moved_1, moved_2, turn, rate = pushed(C * h / M, K * h**2 / M)
    free = ((turn, h * moved), (-K * h / M * moved, rate))
    # a force f + g t takes off moved_1 f h² + moved_2 g h³, over M, and moved f h + moved_1 g h² of the rate;
    # f = 4 a/h - 6 b/h², g = 12 b/h³ - 6 a/h² has the area a and the moment b
    area = (h * (4 * moved_1 - 6 * moved_2) / M, (4 * moved - 6 * moved_1) / M)
    moment = ((12 * moved_2 - 6 * moved_1) / M, (12 * moved_1 - 6 * moved) / h / M)
    return Body(False, False, M, C, K, h, ringing, free, area, moment, _stuck(law, h, area, moment))


def numbers_of(body: Body) -> list[float]:
    """The numbers of a body, one after the other."""
    parts = *body.free, body.area, body.moment, *body.stuck
    return [*map(float, body[:7]), *(number for pair in parts for number in pair)]


@compiled(error_model="numpy")
def pushed(c, k):  # type: ignore[no-untyped-def]
    """A body u'' + c u' + k u = 0 after the time 1: its displacement from a velocity of one, the first and the second
    integral of this over the time, its displacement from a displacement of one and its velocity from a velocity of one.

    With decay rates p and q the first three are divided differences of the exponential at -p and -q; with 0; and with 0
    twice. They follow from a series where both rates are small, else from each other, divided by what is not small.
    """
    square = c * c / 4.0 - k
    root = np.sqrt(abs(square))
    if c / 2.0 + (root if square > 0.0 else 0.0) <= 1.0 and k <= 1.0:
        moved = moved_1 = moved_2 = last = 0.0
        now = factor = 1.0
        for n in range(TERMS):  # factor: 1/(n + 1)!
            moved, moved_1 = moved + now * factor, moved_1 + now * factor / (n + 2)
            moved_2 += now * factor / ((n + 2) * (n + 3))
            last, now, factor = now, -c * now - k * last, factor / (n + 2)
        return moved, moved_1, moved_2, 1.0 - k * moved_1, 1.0 - c * moved - k * moved_1
    if square < 0.0:
        decay = np.exp(-c / 2.0)
        moved = decay * np.sin(root) / root
        turn, rate = decay * np.cos(root) + c / 2.0 * moved, decay * np.cos(root) - c / 2.0 * moved
        moved_1 = (1.0 - turn) / k
        return moved, moved_1, (1.0 - moved - c * moved_1) / k, turn, rate
    q = c / 2.0 + root
    p = k / q
    moved, slow = np.exp(-p) * phi_of(2.0 * root)[1], phi_of(p)
    moved_1 = (slow[1] - moved) / q
    return moved, moved_1, (slow[2] - moved_1) / q, np.exp(-p) + p * moved, np.exp(-q) - p * moved


def _stuck(law: Law, h: float, area: Pair, moment: Pair) -> Square:
    """Derivative of what the force takes off, if all springs stick: they move by p t + q t², p and q of (u, u')."""
    T = law.T  # derivatives of the area a and the moment b of the force by p and q
    a_p, a_q, b_p = h**2 / 2 + T * h, h**3 / 3 + T * h**2, h**3 / 3 + T * h**2 / 2
    b_q = h**4 / 4 + 2 * T * h**3 / 3
    for rho, rate in zip(*(law.arms or ((), ())), strict=True):
        phi = phi_of(h * rate)
        a_p, a_q = a_p + rho * h**2 * phi[2], a_q + 2 * rho * h**3 * phi[3]
        b_p, b_q = b_p + rho * h**3 * (phi[2] - phi[3]), b_q + 2 * rho * h**4 * (phi[3] - phi[4])
    pairs = [(a * a_p + b * b_p, a * a_q + b * b_q) for a, b in zip(area, moment, strict=True)]
    first, second = ((float(p / h), float(0.5 * (q / h - p))) for p, q in pairs)  # by u and u' at the end
    return first, second


def harmonics_of(
    body: Body, areas: NDArray[np.complex128], moments: NDArray[np.complex128]
) -> tuple[NDArray[np.complex128], NDArray[np.bool_]]:
    """Periodic motion (2, N) of u and u' at the begin of steps, over harmonics (N,) of areas and moments of the force
    (as of rfft), and which of them are undamped resonances, where it is zero.
    """
    turn = np.exp(1j * body.h * np.arange(areas.size))
    matrix = turn[:, None, None] * np.eye(2) - body.free
    resonant = np.abs(np.linalg.det(matrix)) < max(1e-9 * body.h**2, 2e-15)
    matrix[resonant] = np.eye(2)
    pushed = -(np.outer(areas, body.area) + np.outer(moments, body.moment))
    pushed[resonant] = 0
    return np.linalg.solve(matrix, pushed[:, :, None])[:, :, 0].T, resonant


def light_harmonics_of(
    body: Body, areas: NDArray[np.complex128], ends: NDArray[np.complex128]
) -> tuple[NDArray[np.complex128], NDArray[np.bool_]]:
    """Periodic motion of a light body, as of `harmonics_of`, by harmonics of areas and of the force at the end of each
    step.
    """
    n, h, (M, C, K) = areas.size, body.h, (body.M, body.C, body.K)
    turn = np.exp(1j * h * np.arange(n))
    # u' at the end is (u_1 - u_0)/h + q h, of u_0 and the curvature q
    rate_u, rate_q = (turn - 1) / h, h
    momentum = M * (1 - 1 / turn)
    matrix = np.empty((n, 2, 2), dtype=complex)
    matrix[:, 0, 0] = momentum * rate_u + C * (turn - 1) + K * h * (turn + 1) / 2
    matrix[:, 0, 1] = momentum * rate_q - K * h**3 / 6
    matrix[:, 1, 0] = C * rate_u + K * turn
    matrix[:, 1, 1] = C * rate_q + 2 * M
    u, q = np.linalg.solve(matrix, -np.array([areas, ends]).T[:, :, None])[:, :, 0].T
    return np.array([u, (rate_u * u + rate_q * q) / turn]), np.zeros(n, dtype=bool)
