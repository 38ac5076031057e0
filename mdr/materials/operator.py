"""The linear operator L of a material over one step of time, as numbers that the march can use.

In scaled form, with the long-time modulus as unit,

    L[x] = x + T x' + sum_j rho_j x_j,    x_j' = x' - x_j/theta_j,

T = omega tau of the Kelvin branch, rho_j = E_j/E_inf and theta_j = omega tau_j of the Maxwell arms. The state of one
spring in one direction is (x, x_1 ... x_J). Over a step h the arms follow a given path of x, taken as linear, exactly:
x_j(h) = E_j x_j + phi_j (x(h) - x), E_j = exp(-h/theta_j), phi_j = (1 - E_j) theta_j/h.

A free spring, L[x] = 0, obeys a linear equation with constant coefficients, and so does the lag s - e of a spring that
slides forward. Without dashpot (T = 0) the condition is algebraic: force that is left when it begins is shed at once,
by moving x and every x_j by the same amount, and the rest relaxes. The motion of x over a step is then one row of a
matrix exponential. All of this is linear in the state: rows of a table, one column for x and one for each arm.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mdr.materials.base import Material, complex_modulus
from mdr.tools.arrays import Array

Table = NDArray[np.float64]

# rows of the table, compiled into kernels.py
L_ROWS = 9
(
    L_FREE,  # x at the end of a step without force, a functional of the state (x, x_1 ... x_J)
    L_RATE,  # -x' at its start, another
    L_END,  # -x' at its end
    L_SHED,  # with a dashpot, x that the arms leave without static force at the end of the step; else the part of x
    # that is elastic: what goes at once with the force, at the start
    L_DECAY,  # exp(-h/theta_j); exp(-h/T) for x itself
    L_GAIN,  # what a linear step of x leaves in the arm; 1 for x itself
    L_RATIO,  # modulus over the long-time one; 1 for x itself
    L_TIME,  # theta_j; T for x itself
    L_STIFFNESS,  # of the static force over a step, over T (0 without dashpot); then zeros
) = range(L_ROWS)

SLOWEST = 1e10  #: omega tau, from which on rounding costs the mean force of a period more than 1e-7


@dataclass(frozen=True)
class Rheology:
    """L of a material: T of the Kelvin branch, ratios rho_j and times theta_j of the arms."""

    T: float
    rho: tuple[float, ...] = ()
    theta: tuple[float, ...] = ()

    @classmethod
    def of(cls, material: Material, omega: float) -> Rheology:
        """The operator of a material with a long-time modulus, its times in units of 1/omega.

        Raises ValueError for a time so long that what relaxes in a period is lost in rounding.
        """
        arms = material.contact_arms
        name, slowest = max([("tau", material.tau), *(("tau_j", tau_j) for _, tau_j in arms)], key=lambda one: one[1])
        if not omega * slowest <= SLOWEST:
            raise ValueError(
                f"{name} = {slowest:.6g} s is more than {SLOWEST:g}/omega: what relaxes in a period is lost in "
                f"rounding; lower it to {SLOWEST / omega:.6g} s, which a period does not tell from it"
            )
        ratios = tuple(E_j / material.E_star for E_j, _ in arms)
        return cls(omega * material.tau, ratios, tuple(omega * tau_j for _, tau_j in arms))

    @property
    def remembers(self) -> bool:
        """Whether a spring has any memory; an elastic one has none."""
        return self.T > 0 or bool(self.rho)

    def over_step(self, h: float) -> Table:
        """The table (L_ROWS, 1 + J) for steps of h."""
        return over_step(self.T, self.rho, self.theta, h)

    def response(self, n: ArrayLike) -> NDArray[np.complex128]:
        """L of exp(i n phase), over it: the dynamic modulus over the long-time one at n omega; n of any shape."""
        return complex_modulus(n, 1.0, self.T, zip(self.rho, self.theta, strict=True))


def over_step(T: float, rho: ArrayLike, theta: ArrayLike, h: float) -> Table:
    """The table (L_ROWS, 1 + J) of an operator for steps of h; rho, theta (J,)."""
    rho, theta = np.asarray(rho, dtype=float), np.asarray(theta, dtype=float)
    return _table(float(T), tuple(rho.tolist()), tuple(theta.tolist()), float(h))


@lru_cache(maxsize=64)
def _table(T: float, rho: tuple[float, ...], theta: tuple[float, ...], h: float) -> Table:
    times, ratios = np.array([T, *theta]), np.array([1.0, *rho])
    table = np.zeros((L_ROWS, 1 + len(rho)))
    with np.errstate(divide="ignore"):
        table[L_DECAY] = np.exp(-h / times)
    table[L_GAIN] = np.concatenate([[1.0], -np.expm1(-h / times[1:]) * times[1:] / h])
    table[L_RATIO], table[L_TIME] = ratios, times
    stiffness = float(ratios @ table[L_GAIN])
    table[L_SHED] = -ratios * table[L_DECAY] / stiffness
    table[L_SHED, 0] = (stiffness - 1) / stiffness
    if T > 0 and table[L_DECAY, 0] > 0:
        table[L_STIFFNESS, 0] = stiffness / T
        table[L_RATE] = ratios / T
    if len(rho) == 0:  # one exponential
        table[L_FREE] = table[L_DECAY]
        table[L_END] = table[L_RATE] * table[L_DECAY]
        return _read_only(table)
    if not table[L_STIFFNESS, 0]:
        table[L_SHED] = ratios / ratios.sum()
    shed, rates = _free_motion(T if table[L_STIFFNESS, 0] else 0.0, ratios, times)
    from scipy.linalg import expm

    move = expm(h * rates) @ shed
    table[L_FREE] = move[0]
    table[L_RATE] = -rates[0]
    table[L_END] = -(rates @ move)[0]
    return _read_only(table)


def _free_motion(T: float, ratios: Array, times: Array) -> tuple[Array, Array]:
    """Free motion of a spring: the jump at its start, x -> shed x, then x' = rates x; both (1 + J, 1 + J)."""
    n = ratios.size
    if T > 0:
        first = -ratios / T
        shed = np.eye(n)
    else:
        glassy = ratios.sum()
        first = np.concatenate([[0.0], ratios[1:] / times[1:] / glassy])
        shed = np.eye(n) - np.outer(np.ones(n), ratios / glassy)
    rates = np.tile(first, (n, 1))
    rates[1:, 1:] -= np.diag(1 / times[1:])
    return shed, rates


def _read_only(table: Table) -> Table:
    table.setflags(write=False)
    return table
