"""The radius of stick under a rigid axisymmetric punch pressed on an elastic half-space with friction, fully coupled.

Spence (Proc. R. Soc. A 305 (1968) 55; J. Elasticity 5 (1975) 297): a rising force alone leaves a disc r < c stuck and
a ring c < r < a that slips inward, where q_r = mu_0 p. c/a depends on beta and mu_0 only and is the same for the flat
punch, which is solved here, and for every power of r as the profile, each step of whose loading is a flat punch's.
However large mu_0, c < a: stuck all over, q_r/p would grow without bound towards the edge.

z points into the half-space; p > 0 presses, q_r acts on the half-space, outward; a = 1. With Dundurs' beta and the
transforms of Hankel P(k) = int r p J0(kr) dr and Q(k) = int r q_r J1(kr) dr,

    E*/2 u_z = int P J0(kr) dk - beta int Q J0(kr) dk,    E*/2 u_r = int Q J1(kr) dk - beta int P J1(kr) dk:

the second beta is in Boussinesq's point load, the first follows by reciprocity (Betti). With those of Abel,
phi(t) = 2/pi int_t^1 r p / sqrt(r^2 - t^2) dr, even, and psi(t) = 2/pi t int_t^1 q_r / sqrt(r^2 - t^2) dr, odd,
P = int_0^1 phi cos(kt) dt and Q = int_0^1 psi sin(kt) dt, and u_z = d, u_r = 0 and q_r = mu_0 p read

    phi(t) - beta/pi int_-1^1 psi(s)/(s - t) ds = E* d/pi, here 1                                0 < t < 1
    psi(t) + beta/pi int_-1^1 phi(s)/(s - t) ds = 0                                              0 < t < c
    psi(t) = 2/pi mu_0 (phi(1) t K'(t) - int_t^1 phi'(s) t/s K'(t/s) ds)                         c < t < 1

with principal values and K'(x) the complete elliptic integral of modulus sqrt(1 - x^2). Were psi to jump at c, q_r
would be infinite there, so both of the last two hold at c: the equation for c. Without the integral of psi, which is
Goodman's approximation (J. Appl. Mech. 29 (1962) 515), phi = 1 and c has a closed form.

phi and psi are linear between nodes at t = tanh(xi): in xi the distance between two nodes is exact, close to 1 as well.
"""

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipkm1

from mdr.tools.arrays import Array

NODES = 100  # of the disc, and of the ring: c/a to 2e-5, to 1e-4 where beta > 0.5
EDGE = 6.0  # where the nodes end: 1 - t = (1 - c) exp(-2 EDGE) if c is near 1
LARGEST_BETA = 0.75  # of a body with nu = -1 under a rigid one


def stick_radius(beta: float, mu_0: float, coupled: bool = True, nodes: int = NODES) -> float:
    """c/a; coupled=False leaves out what q_r does to u_z."""
    _refuse(beta, mu_0)
    if beta == 0:
        return 1.0
    # Stuck all over, phi + i psi turns by 2 atanh(beta)/pi per unit of xi, and it slips where psi/phi comes to mu_0.
    near = float(np.arctan(mu_0) / np.arctanh(beta)) if coupled else mu_0 / beta
    if not 1e-6 < _goodman(near) < 20:  # c is 0 or 1 within the error
        return float(np.tanh(_goodman(near)))

    def reserve(log_ratio: float) -> float:
        return _reserve(_goodman(near * np.exp(log_ratio)), beta, mu_0, coupled, nodes)

    return float(np.tanh(_goodman(near * np.exp(brentq(reserve, -0.5, 0.5, xtol=1e-8)))))


def goodman(beta: float, mu_0: float) -> float:
    """c/a without what q_r does to u_z: ln[(1 + c)/(1 - c)]/(2 c) = mu_0/beta K'(c)."""
    _refuse(beta, mu_0)
    return float(np.tanh(_goodman(mu_0 / beta))) if beta else 1.0


def bonded_force(beta: float, nodes: int = 2 * NODES) -> float:
    """The force on a flat punch that sticks all over, over that without friction: Mossakovskii's atanh(beta)/beta."""
    _refuse(beta, 1.0)
    xi = np.linspace(0, 8, nodes + 1)
    even, odd = _hilbert(xi)
    phi = _phi(odd, -beta / np.pi * even, beta)
    return float(np.trapezoid(phi, np.tanh(xi)))


def _goodman(ratio: float) -> float:
    """atanh(c) for mu_0/beta."""

    def difference(log_xi: float) -> float:
        xi = np.exp(log_xi)
        return float(xi / np.tanh(xi) - ratio * ellipkm1(np.tanh(xi) ** 2))

    ratio = max(ratio, 1 / 300)  # c = 2e-130
    return float(np.exp(brentq(difference, -1 / ratio - 1, np.log(np.pi / 2 * ratio) + 1e-9, xtol=1e-13)))


def _refuse(beta: float, mu_0: float) -> None:
    if not 0 <= beta <= LARGEST_BETA:
        raise ValueError(f"beta must be from 0 to {LARGEST_BETA}: {beta}")
    if not 0 < mu_0 < np.inf:
        raise ValueError(f"mu_0 must be positive and finite: {mu_0}")


# --- the equations at the nodes ---


def _reserve(xi_c: float, beta: float, mu_0: float, coupled: bool, nodes: int) -> float:
    """psi at c by friction less psi at c by stick: positive where stick may spread."""
    xi = _nodes(xi_c, nodes)
    even, odd = _hilbert(xi)
    by_stick, by_friction = -beta / np.pi * even[: nodes + 1], mu_0 * _friction(np.tanh(xi), nodes)
    phi = _phi(odd, np.concatenate((by_stick[:-1], by_friction)), beta if coupled else 0.0)
    return float((by_friction[0] - by_stick[-1]) @ phi)


def _nodes(xi_c: float, nodes: int) -> Array:
    """atanh(t), crowding about c: in xi itself over the disc, in log(sinh(xi)) over the ring."""
    u = np.linspace(0, 1, nodes + 1)
    log_c = np.log(np.sinh(xi_c))
    ring = log_c + (max(0.0, -log_c) + EDGE) * u**2
    return np.append(xi_c * (1 - (1 - u[:-1]) ** 2), np.arcsinh(np.exp(ring)))


def _phi(odd: Array, psi_of_phi: Array, beta: float) -> Array:
    """The first equation, with psi = psi_of_phi @ phi."""
    matrix: Array = np.eye(len(odd)) - beta / np.pi * odd @ psi_of_phi
    return np.asarray(np.linalg.solve(matrix, np.ones(len(odd))), dtype=np.float64)


def _hilbert(xi: Array) -> tuple[Array, Array]:
    """int_-1^1 f(s)/(s - t) ds at the nodes, of an even f and of an odd one."""
    cosh = np.cosh(xi)
    h = np.sinh(np.diff(xi)) / (cosh[1:] * cosh[:-1])
    right = _over_elements(np.sinh(xi - xi[:, None]) / (cosh * cosh[:, None]), h)
    left = _over_elements(np.sinh(xi + xi[:, None]) / (cosh * cosh[:, None]), h)
    even, odd = right - left, right + left
    even[-1], odd[-1] = even[-2], odd[-2]  # at the edge the integral has a logarithm: the last element is flat
    return even, odd


def _over_elements(d: Array, h: Array) -> Array:
    """The integral of f(s)/d, f linear over each element of length h; d is the distance to every node."""
    near, far = d[:, :-1], d[:, 1:]
    thin = h < np.abs(near) / 2
    # the logarithms of a distance 0 cancel between the two elements that meet there
    ratio = np.where(far == 0, 1.0, far) / np.where(near == 0, 1.0, near)
    log = np.where(thin, np.log1p(np.where(thin, h, 0.0) / np.where(near == 0, 1.0, near)), np.log(np.abs(ratio)))
    out = np.zeros_like(d)
    out[:, :-1] += far / h * log - 1
    out[:, 1:] += 1 - near / h * log
    return out


def _friction(t: Array, first: int) -> Array:
    """psi/mu_0 where the surface slips, from node `first` on, of phi."""
    places, weights = np.polynomial.legendre.leggauss(3)
    s = t[:-1] + (1 + places[:, None, None]) / 2 * np.diff(t)
    mean = np.tensordot(weights / 2, _kernel(np.minimum(t[first:, None] / s, 1.0)), 1)
    mean *= np.arange(len(t) - 1) >= np.arange(first, len(t))[:, None]
    out = np.zeros((len(t) - first, len(t)))
    out[:, :-1] += mean
    out[:, 1:] -= mean
    out[:, -1] += _kernel(t[first:] / t[-1])
    return out


def _kernel(x: Array) -> Array:
    return np.asarray(2 / np.pi * x * ellipkm1(x * x))
