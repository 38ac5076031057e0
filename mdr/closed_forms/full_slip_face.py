"""Full slip of a face with a shear strength: what the strength adds to the rate at which springs are stretched.

In full slip L[e] is the limit of friction, and L is linear: e = mu_0 kappa s + r with L[r] = (2 tau_0/G*) sqrt(a² - x²)
in contact and nothing else, a the radius on which the strength acts. So a spring slips for good where v_0 is above the
greatest mu_0 kappa u_z' + r' - y'.
A flat face that keeps contact has a constant r, and nothing is added. On a curved elastic face a spring that the edge
of contact has just reached may bear a force that grows like the root of time, faster than any pull: it always sticks.
On a dashpot, r + tau r' = (2 tau_0/G*) sqrt(a² - x²), r' has a bound. Arms beside the dashpot make of r a sum of such,
r = sum b_k r_k, with the relaxation times of a spring that is left alone in the place of tau.

Springs stand for a face with a strength in the mean alone. On a half-space of nu = 0 the strength on a disc moves the
surface at the radius x by (4 tau_0/(pi G*)) a E(x/a), E the complete elliptic integral, and its rate at the edge grows
like a logarithm, not like a root: with r + tau r' equal to that, also where the surface is free, r' is less.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from mdr.case.contact import SlidingContact
from mdr.indenters.mapping.quadrature import double_exponential
from mdr.normal.normal_force import contact_radius, corners, pressing_edge
from mdr.tools.arrays import EXACT, Array
from mdr.tools.secular import secular_zeros

PHASES, PLACES = 1024, 96  #: at which rates are looked at; from the best of these on the greatest is sought
FINE, MOST_PHASES = 60.0, 2**15  #: of a half-space: phases times omega tau, ten in a relaxation time; phases at most


def greatest_rate(case: SlidingContact, rest: Callable[[Array], Array]) -> float:
    """Greatest rest(phase) + r' [m/s] of any spring in contact on a material with a dashpot, where the edge of the
    strength moves. rest: the rates that all springs have.
    """
    from scipy.optimize import minimize

    phase = 2 * np.pi / PHASES * np.arange(float(PHASES))
    a = contact_radius(case, phase)
    strong = case.friction.strong_radius(a)
    x = np.union1d(_places(a), _places(strong))
    total = rest(phase)[:, None] + _rates(case, a, x, np.sqrt(np.maximum(strong[:, None] ** 2 - x**2, 0.0)))
    (k, i), modes = np.unravel_index(int(np.argmax(total)), total.shape), _compliance(case)

    def less(at: Array) -> float:
        return -float(rest(at[1:])[0]) - _rate(case, float(at[0]) * a.max(), float(at[1]), *modes)

    start, size = np.array([x[i] / a.max(), phase[k]]), np.array([0.01, 2 * phase[1]])
    corners_of = start + np.array([[0.0, 0.0], [-size[0], 0.0], [0.0, size[1]]])
    options = {"initial_simplex": np.abs(corners_of), "xatol": 1e-9, "fatol": 1e-10 * abs(total[k, i])}
    return -float(minimize(less, start, method="Nelder-Mead", options=options).fun)


def greatest_rate_of_half_space(case: SlidingContact, rest: Callable[[Array], Array]) -> float:
    """The same of the surface of a half-space of nu = 0, to about 2e-3; infinite on an elastic one."""
    from scipy.special import ellipe, ellipk

    n = int(np.clip(np.ceil(FINE / max(case.T, EXACT)), 2 * PHASES, MOST_PHASES))
    phase = 2 * np.pi / n * np.arange(float(n))
    if not case.strength_moves:
        return float(rest(phase).max())
    if not case.T:
        return float("inf")
    a = contact_radius(case, phase)
    x = _places(a)
    least, most = np.minimum(a[:, None], x), np.maximum(a[:, None], x)
    m = np.minimum(least / np.where(most > 0, most, 1.0), 1 - EXACT) ** 2
    beyond = x * (ellipe(m) - (1 - m) * ellipk(m))
    moved = 2 / np.pi * np.where(x < a[:, None], a[:, None] * ellipe(m), beyond)
    return float(np.max(rest(phase)[:, None] + _rates(case, a, x, moved)))


def _places(a: Array) -> Array:
    """Where rates are looked at: close to the axis, and where the edge of contact turns."""
    share = np.sin(np.linspace(0, np.pi / 2, PLACES, endpoint=False))
    return np.unique(np.concatenate([a.max() * share, a.min() + (a.max() - a.min()) * share**2]))


def _compliance(case: SlidingContact) -> tuple[Array, Array]:
    """Shares b_k, and times T_k over 1/omega, in which a spring yields to a steady force: 1/L of exp(s t) is
    sum b_k/(1 + s T_k). On a Kelvin material one, of tau.
    """
    rho, theta = np.array(case.rheology.rho), np.array(case.rheology.theta)
    order = np.argsort(-theta)
    mu = secular_zeros(1.0, case.T, rho[order], 1 / theta[order])
    return 1 / mu / (case.T + np.sum(rho * theta / (1 - np.multiply.outer(mu, theta)) ** 2, axis=1)), 1 / mu


def _rates(case: SlidingContact, a: Array, x: Array, c: Array) -> Array:
    """r' [m/s] (n_t, n_x) of L[r] = (2 tau_0/G*) c at places x in contact; -inf elsewhere. c goes on lines."""
    step, rate = 2 * np.pi / len(c), np.zeros_like(c)
    for share, T in zip(*_compliance(case), strict=True):
        decay, into = np.exp(-step / T), -np.expm1(-step / T)
        into = c * (into * T / step - decay) + np.roll(c, -1, axis=0) * (1 - into * T / step)
        r = np.zeros_like(c)
        for k in (*range(len(c)), *range(len(c))):  # the second period begins where the first ends, and repeats
            r[(k + 1) % len(c)] = decay * r[k] + into[k]
            if k == len(c) - 1:
                r[0] /= -np.expm1(-2 * np.pi / T)
        rate += share / T * (c - r)
    return np.where(x < a[:, None], _unit(case) * rate, -np.inf)


def _unit(case: SlidingContact) -> float:
    return 2 * case.friction.tau_0 / case.material.G_star * case.omega


def _rate(case: SlidingContact, x: float, phase: float, shares: Array, times: Array) -> float:
    """r' [m/s] of the spring at x on a dashpot; -inf where it is not in contact. shares, times: of `_compliance`."""
    rule, cycle = double_exponential(), case.cycle
    now = float(contact_radius(case, np.array(phase)))

    def limit(a: ArrayLike) -> Array:
        """sqrt(a² - x²) of the strength at radii of contact."""
        return np.asarray(np.sqrt(np.maximum(case.friction.strong_radius(a) ** 2 - x * x, 0.0)))

    if not abs(x) < now:
        return -np.inf
    gap = (float(case.indenter.profile_1d(abs(x))) - cycle.u_z0) / cycle.unit
    touches, leaves = pressing_edge(case).crossings(gap)
    begin = phase - min([(phase - one) % (2 * np.pi) for one in touches], default=2 * np.pi)

    def of_stretch(low: float, high: float, later: float, repeats: bool) -> float:
        """Rate that a stretch of contact takes off so much later; repeats: in this period and all before."""
        cuts = low + np.mod(corners(case) - low, 2 * np.pi)
        cuts = np.concatenate([[low], cuts[(cuts > low) & (cuts < high)], [high]])
        weights = shares / times**2 / (-np.expm1(-2 * np.pi / times) if repeats else 1.0)

        def left(at: Array) -> Array:
            return np.asarray(
                limit(contact_radius(case, at)) * (np.exp(-np.divide.outer(high + later - at, times)) @ weights)
            )

        return float(rule.integral(left, cuts))

    rate = limit(now) * np.sum(shares / times) - of_stretch(begin, phase, 0.0, not touches)
    for touch in touches:  # what is left of the contacts before
        leave = touch + min((one - touch) % (2 * np.pi) for one in leaves)
        rate -= of_stretch(touch, leave, (phase - leave) % (2 * np.pi), True)
    return float(_unit(case) * rate)
