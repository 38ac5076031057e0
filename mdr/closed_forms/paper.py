"""Closed forms of the paper, on plain floats. No solver here.

"Eq. (n)" is M. Popov, Critical velocity of controllability of sliding friction by normal oscillations in viscoelastic
contacts, Facta Universitatis, Series: Mechanical Engineering 14 (2016) 335. The equations hold for one Kelvin element,
or for an array whose elements all stay in contact, while all slide forward; each function says when. NaN and infinities
are refused.

Symbols (SI): mu_0 coefficient of friction [-]; u_z0, du_z, omega mean depth, amplitude [m], angular frequency [rad/s]
of Eq. (3); k_zc, k_xc, gamma_zc contact stiffness [N/m] and damping [N s/m]; k_x, m, c_x system spring, mass, damper;
v_0, v_c velocities [m/s]; mindlin_ratio kappa = k_zc/k_xc = E*/G* [-]; t time [s].
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from inspect import signature
from typing import Any, ParamSpec, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from mdr.case.depth_cycle import peak, stick_limit
from mdr.tools.checks import finite_array, in_range, plain
from mdr.tools.messages import short

_P = ParamSpec("_P")
_R = TypeVar("_R")


def _finite(formula: Callable[_P, _R]) -> Callable[_P, _R]:
    """The formula, of finite numbers alone: ValueError by name for NaN and infinities, TypeError for no number; and
    ValueError where a term of it is beyond the range of floats.
    """
    names = signature(formula)

    @wraps(formula)
    def checked(*args: _P.args, **kwargs: _P.kwargs) -> _R:
        given: dict[str, Any] = names.bind(*args, **kwargs).arguments
        numbers = {name: plain(finite_array(name, value)) for name, value in given.items()}  # whose overflow is told
        told = ", ".join(f"{name} = {short(repr(value))}" for name, value in given.items())
        with in_range(f"{formula.__name__} at {told}"):
            return formula(**numbers)  # type: ignore[call-arg, arg-type]

    return checked


# --- the normal force ---


@_finite
def eq_4(t: Any, u_z0: float, du_z: float, omega: float, k_zc: float, gamma_zc: float) -> Any:
    """Normal force F_N(t) [N] of a Kelvin element, Eq. (4). Holds while it stays in contact, Eq. (5)."""
    phase = omega * np.asarray(t, dtype=float)
    return k_zc * (u_z0 + du_z * np.cos(phase)) - gamma_zc * omega * du_z * np.sin(phase)


@_finite
def eq_5(u_z0: float, du_z: float, omega: float, k_zc: float, gamma_zc: float) -> bool:
    """Whether the element never leaves the plane: k_zc u_z0 > du_z sqrt(k_zc² + gamma_zc² omega²), Eq. (5)."""
    return bool(k_zc * u_z0 > eq_6(du_z, omega, k_zc, gamma_zc))


@_finite
def eq_6(du_z: float, omega: float, k_zc: float, gamma_zc: float) -> float:
    """Amplitude of the normal force [N], Eq. (6). Holds under Eq. (5)."""
    return float(du_z * np.hypot(k_zc, gamma_zc * omega))


@_finite
def eq_7(mu_0: float, u_z0: float, du_z: float, omega: float, k_zc: float, gamma_zc: float) -> float:
    """Static friction force [N]: mu_0 times the least normal force, Eq. (7). Holds under Eq. (5), for constant
    stiffness (flat punch).
    """
    return mu_0 * (k_zc * u_z0 - eq_6(du_z, omega, k_zc, gamma_zc))


# --- motion in full slip ---


@_finite
def eq_10(
    t: Any,
    v_0: float,
    mu_0: float,
    u_z0: float,
    du_z: float,
    omega: float,
    k_zc: float,
    gamma_zc: float,
    k_x: float,
    m: float,
) -> Any:
    """Position u_x(t) [m] of the body in full slip, Eq. (10).

    The particular solution of Eq. (8); a free oscillation of the body may ride on it, as friction does not damp it in
    full slip. Holds for v_0 > v_c, under Eq. (5), without a system damper and for k_x != m omega²: ValueError there.
    """
    phase = omega * np.asarray(t, dtype=float)
    swing = mu_0 * du_z / _inertia(omega, k_x, m) * (k_zc * np.cos(phase) - gamma_zc * omega * np.sin(phase))
    return v_0 * np.asarray(t, dtype=float) - mu_0 * k_zc / k_x * u_z0 + swing


@_finite
def eq_11(gamma_zc: float, mindlin_ratio: float) -> float:
    """Tangential contact damping gamma_xc = gamma_zc/kappa [N s/m], Eq. (11). Holds for a constant Poisson's ratio."""
    return gamma_zc / mindlin_ratio


@_finite
def eq_12(t: Any, mu_0: float, u_z0: float, du_z: float, omega: float, mindlin_ratio: float) -> Any:
    """Tangential extension u_x - u_xc [m] in full slip, Eq. (12): mu_0 kappa times the depth. Holds as Eq. (10)
    does.
    """
    return mu_0 * mindlin_ratio * (u_z0 + du_z * np.cos(omega * np.asarray(t, dtype=float)))


@_finite
def eq_13(
    t: Any,
    v_0: float,
    mu_0: float,
    u_z0: float,
    du_z: float,
    omega: float,
    k_zc: float,
    gamma_zc: float,
    mindlin_ratio: float,
    k_x: float,
    m: float,
) -> Any:
    """Position u_xc(t) [m] of the foot in full slip, Eq. (13): Eq. (10) less Eq. (12)."""
    body = eq_10(t, v_0, mu_0, u_z0, du_z, omega, k_zc, gamma_zc, k_x, m)
    return body - eq_12(t, mu_0, u_z0, du_z, omega, mindlin_ratio)


@_finite
def eq_14(
    t: Any,
    v_0: float,
    mu_0: float,
    du_z: float,
    omega: float,
    k_zc: float,
    gamma_zc: float,
    mindlin_ratio: float,
    k_x: float,
    m: float,
) -> Any:
    """Velocity of the foot [m/s] in full slip, Eq. (14), second line. Slip stops where it would turn negative. Holds as
    Eq. (10) does.
    """
    phase = omega * np.asarray(t, dtype=float)
    inertia = _inertia(omega, k_x, m)
    viscous = -gamma_zc * omega**2 / inertia * np.cos(phase)
    elastic = omega * mindlin_ratio * (inertia - k_zc / mindlin_ratio) / inertia * np.sin(phase)
    return v_0 + mu_0 * du_z * (viscous + elastic)


def _inertia(omega: float, k_x: float, m: float) -> float:
    """m omega² - k_x [N/m], refused where it vanishes."""
    inertia = m * omega**2 - k_x
    if inertia == 0:
        raise ValueError(
            f"resonance: k_x = m omega² = {k_x:.6g} N/m, where an undamped body in full slip swings without bound; "
            "move omega, k_x or m away from it"
        )
    return inertia


# --- critical velocity ---


@_finite
def eq_1(mu_0: float, du_z: float, omega: float, mindlin_ratio: float) -> float:
    """Critical velocity [m/s] of a rigid pull, Eq. (1): mu_0 omega du_z E*/G*.

    The limit k_x -> infinity of Eq. (15); the rheology drops out, and so does the depth.
    """
    return stick_limit(mu_0, du_z, omega, mindlin_ratio)


@_finite
def eq_2(mu_0: float, du_z: float, omega: float, k_zc: float, k_xc: float, k_x: float, m: float) -> float:
    """Critical velocity [m/s] of an elastic contact under a mass and a spring, Eq. (2): Eq. (15) without damping."""
    return eq_15(mu_0, du_z, omega, k_zc, k_xc, 0.0, k_x, m)


@_finite
def eq_15(
    mu_0: float,
    du_z: float,
    omega: float,
    k_zc: float,
    k_xc: float,
    gamma_zc: float,
    k_x: float,
    m: float,
    c_x: float = 0.0,
) -> float:
    """Pulling velocity [m/s] above which the oscillation no longer lowers friction, Eq. (15).

    Eq. (2) is its limit gamma_zc -> 0 and Eq. (1) its limit k_x -> infinity. The system damper c_x extends it: k_x
    becomes k_x + i omega c_x. Holds while no spring leaves the plane, Eq. (5), for an oscillation so small that the
    contact stiffness is constant, and for k_x != m omega²: on that resonance the answer is infinite.
    """
    inertia = m * omega**2 - k_x - omega * c_x * 1j
    if inertia == 0:
        return float("inf")
    viscous = -gamma_zc * omega * 1j
    elastic = k_zc / k_xc * (inertia - k_xc)
    return float(mu_0 * du_z * omega * abs(viscous + elastic) / abs(inertia))


@in_range("the critical velocity")
def linear_critical_velocity(
    mu_0: float, omega: float, u_n: ArrayLike, mindlin_ratio: float, K_n: ArrayLike, H_n: ArrayLike, X_n: ArrayLike = 0
) -> float:
    """Critical velocity [m/s] of a contact that answers linearly, of any rheology, to a periodic depth.

    The depth is u_z = u_z0 + Re of sum over n >= 1 of u_n exp(i n omega t) [m], arrays (N,) ::

        v_c = max over t of mu_0 Re of sum i n omega [kappa + K_z(n omega) H(n omega)] u_n exp(i n omega t)

    K_n = K_z(n omega) is the dynamic contact stiffness [N/m], H_n = H(n omega) the receptance of the pull [m/N]. In
    full slip every spring in contact slips at u_x' - mu_0 kappa u_z', and the body moves by -mu_0 H F_N. One harmonic
    of a Kelvin contact is Eq. (15), ``v_c = mu_0 omega du_z |kappa + K_z H|``. Holds under the conditions of Eq. (15).
    It is infinite where H_n is infinite and u_n is not zero. X_n [m], (N,), are the harmonics of a way along the pull
    on which the indenter is shaken besides; it slips at this velocity less, so that i n omega X_n is taken off.
    """
    u_n, K_n, H_n, X_n = (np.atleast_1d(np.asarray(values, dtype=complex)) for values in (u_n, K_n, H_n, X_n))
    there = u_n != 0
    if not np.all(np.isfinite(H_n[there])):
        return float("inf")
    n = np.arange(1, u_n.size + 1)
    amplitudes = np.zeros_like(u_n)
    amplitudes[there] = (1j * n * omega * mu_0 * u_n)[there] * (mindlin_ratio + K_n[there] * H_n[there])
    return peak(amplitudes - 1j * n * omega * X_n)


# --- the deficit of the flat punch ---


def deficit(v_hat: float) -> float:
    """psi(v_hat) [-] of a rigid pull, elastic: mu/mu_0 = 1 - (k_zc du_z/F_N) psi(v_0/v_c).

    Exact for the flat punch that keeps contact, and the limit of small amplitude for every shape. psi(0) = 1 and
    psi(1) = 0. A spring sticks from phi_1 = pi + arcsin v_hat, where the depth begins to rise faster than the pull
    can follow, to phi_2 with cos phi_2 = cos phi_1 + v_hat (phi_2 - phi_1); psi is the mean lag in between. Derived
    here from the motion of one spring.

    Raises ValueError for v_hat outside [0, 1].
    """
    if not 0 <= v_hat <= 1:
        raise ValueError(f"v_hat must lie in [0, 1], got {v_hat!r}; above 1 friction is not reduced")
    if v_hat in (0.0, 1.0):
        return 1.0 - v_hat
    return lag_of_stick(np.pi + np.arcsin(v_hat), v_hat)


def lag_of_stick(begin: float, v_hat: float) -> float:
    """Mean lag [-] over the period of an elastic spring that sticks from this phase on, 0 < v_hat < 1."""
    from scipy.optimize import brentq

    # where the depth falls as fast as the pull; the stick ends before
    last, turn = 2 * np.pi - np.arcsin(v_hat), 3 * np.pi - np.arcsin(v_hat)
    end = brentq(lambda phi: np.cos(phi) - np.cos(begin) - v_hat * (phi - begin), last, turn, xtol=1e-15)
    span = end - begin
    return float((np.sin(end) - np.sin(begin) - np.cos(begin) * span - v_hat * span**2 / 2) / (2 * np.pi))
