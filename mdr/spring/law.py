"""The law L of a material: what a spring does that is held on a path, or left alone.

In scaled form, with the long-time modulus as unit, the force of an extension x is

    L[x] = x + T x' + sum_j rho_j x_j,    x_j' = x' - x_j/theta_j,

T of the Kelvin branch, rho_j and theta_j of the Maxwell arms. Two things can happen to an extension:

* it is *held*: something moves it on a parabola, by p t + q t². Then x_j(t) = x_j phi_0 + p t phi_1 + 2 q t² phi_2,
  with phi_n of r = t/theta_j: phi_0(r) = exp(-r), phi_{n+1}(r) = (1/n! - phi_n(r))/r. Integrals over time follow from
  the next ones, as t^n phi_n has the integral t^{n+1} phi_{n+1}.
* it is *free*: L[x] = 0. It relaxes in K = J + (T > 0) modes, x_j(t) = sum_k out_jk m_k exp(-mu_k t), m = into x.

An elastic material has neither arms nor modes, a Kelvin material one mode.
"""

from __future__ import annotations

from functools import lru_cache
from math import factorial
from typing import NamedTuple

import numpy as np

from mdr.tools.arrays import Array
from mdr.tools.jit import compiled
from mdr.tools.secular import secular_zeros

N_PHI = 5
OF_SERIES = np.array([1 / factorial(k) for k in range(21, 3, -1)])  #: of phi_4, backwards; what follows is below EPS


class Modes(NamedTuple):
    """Relaxation modes of a spring that is left alone."""

    mu: Array  #: (K,) rates
    out: Array  #: (1 + J, K) from modes to state
    into: Array  #: (K, 1 + J) from state to modes


class Arms(NamedTuple):
    """The Maxwell arms of a material."""

    rho: Array  #: (J,) moduli over the long-time one
    rate: Array  #: (J,) 1/theta, with which they relax


class Law(NamedTuple):
    """L of a material. What it lacks is None, and so compiled away."""

    T: float
    modes: Modes | None
    arms: Arms | None


@lru_cache(maxsize=64)
def law_of(T: float, rho: tuple[float, ...] = (), theta: tuple[float, ...] = ()) -> Law:
    """The law of a material with these groups."""
    ratios, times = np.array(rho, dtype=float), np.array(theta, dtype=float)
    modes = _modes(T, ratios, times) if T > 0 or rho else None
    return Law(float(T), modes, Arms(ratios, 1 / times) if rho else None)


@compiled(error_model="numpy")
def phi_of(r):  # type: ignore[no-untyped-def]
    """phi_0 ... phi_4 of r >= 0: from the exponential, or from a series where r is small."""
    if r > 1.0:
        zero = np.exp(-r)
        one = (1.0 - zero) / r
        two = (1.0 - one) / r
        three = (0.5 - two) / r
        return zero, one, two, three, (1.0 / 6.0 - three) / r
    four = 0.0
    for k in range(OF_SERIES.size):
        four = OF_SERIES[k] - r * four
    three = 1.0 / 6.0 - r * four
    two = 0.5 - r * three
    one = 1.0 - r * two
    return 1.0 - r * one, one, two, three, four


def _modes(T: float, rho: Array, theta: Array) -> Modes:
    """Rates, and matrices from modes to state and back, of a spring without force.

    Free motion is x' = r, x_j' = r - x_j/theta_j with r such that L[x] = 0. In the norm of energy, x² + sum rho_j x_j²,
    its matrix is symmetric, a diagonal plus one of rank one: its rates are zeros of a sum of poles, and its
    eigenvectors follow from them. With the weights that have these zeros to rounding (Löwner's formula) they are
    orthogonal to rounding too. Without dashpot a state with force first sheds it, by the same displacement of all its
    parts: a projection.
    """
    relax = np.append(0.0, 1 / theta)
    order = np.argsort(relax)
    roots, relax = np.sqrt(np.append(1.0, rho))[order, None], relax[order]
    mu = secular_zeros(1.0, T, roots[1:, 0] ** 2, relax[1:])
    away = mu - relax[:, None]
    away[away == 0] = np.finfo(float).tiny ** 0.25  # an arm next to nothing relaxes for itself
    others = np.array([np.delete(relax - one, j) for j, one in enumerate(relax)])
    weights = np.prod(away[:, : theta.size] / others, axis=1) * np.prod(away[:, theta.size :], axis=1)
    vectors = np.sqrt(np.abs(weights))[:, None] / away
    vectors /= np.abs(vectors).max(axis=0)
    vectors /= np.linalg.norm(vectors, axis=0)
    back = np.argsort(order)
    return Modes(mu, (vectors / roots)[back], np.ascontiguousarray((vectors * roots)[back].T))
