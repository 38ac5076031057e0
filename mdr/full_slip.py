"""The full-slip periodic solution: any shape, any amplitude, elastic or Kelvin material.

While every spring slides forward, e_i = mu_0 kappa s_i for all of them, through loss and return of contact too,
because the same operator acts on both sides of Coulomb's law. The tangential force is then mu_0 F_N(t), whatever the
velocity, and every spring in contact slips at the same velocity u_x' - mu_0 kappa u_z'. They all reach the stick
limit together: this is why one closed form can hold for an array.

Contact edge. A spring of depth g has s(t) = sup over theta >= 0 of (u_z - g)(t - theta) exp(-theta/tau) and is in
contact when the supremum is attained at theta = 0, i.e. for all g below

    g_c(t) = inf over theta of [u_z(t) - u_z(t - theta) exp(-theta/tau)] / [1 - exp(-theta/tau)],

whose limits are u_z + tau u_z' (theta -> 0, the retreating edge, released while still compressed) and u_z (full
relaxation). The force follows from the elastic law alone, F_N = E* [2 a(g_c) (u_z - g_c + tau u_z') + F(g_c)/E*].

Body and critical velocity. With harmonics F_n of F_N and the receptance H, y = -mu_0 sum F_n H(n omega) exp(i n omega
t), and

    v_c = max over instants with contact of [mu_0 kappa u_z' - y'].

One harmonic gives Eq. (15); a rigid pull, H = 0, gives Eq. (1) when contact is kept.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from mdr.checks import count
from mdr.contact import SlidingContact, require_case
from mdr.pull import SpringPull

Array = NDArray[np.float64]

N_INSTANTS = 8192  #: of the period; harmonics up to half of it


@dataclass(frozen=True, eq=False)
class FullSlip:
    """One period of full slip at equidistant instants; arrays of shape (n_t,)."""

    t: Array  #: time [s]
    F_N: Array  #: normal force [N]
    contact_radius: Array  #: edge of the contact a(g_c) [m]
    u_z_dot: Array  #: rate of the depth [m/s]
    in_contact: NDArray[np.bool_]  #: whether any spring touches


def contact_edge(phase: Array, T: float) -> Array:
    """(g_c - u_z0)/du_z at phases omega t of a harmonic motion, shape of phase; T = omega tau."""
    if T == 0:
        return np.asarray(np.cos(phase))
    theta = np.concatenate([np.geomspace(1e-6, 0.2, 80)[:-1], np.linspace(0.2, 2 * np.pi, 320)])
    values = _edge_at(phase[:, None], theta, T)
    best = np.clip(np.argmin(values, axis=1), 1, theta.size - 2)
    low, high = theta[best - 1], theta[best + 1]
    for _ in range(45):  # golden section; the infimum is flat, so its value is good to rounding
        step = 0.381966011250105 * (high - low)
        left_is_lower = _edge_at(phase, low + step, T) < _edge_at(phase, high - step, T)
        low, high = np.where(left_is_lower, low, low + step), np.where(left_is_lower, high - step, high)
    inner = _edge_at(phase, 0.5 * (low + high), T)
    edges: Array = np.minimum.reduce([inner, values.min(axis=1), np.cos(phase), np.cos(phase) - T * np.sin(phase)])
    return edges


@lru_cache(maxsize=64)
def _edge_of_period(n_t: int, T: float) -> Array:
    """The contact edge at n_t instants of a period, which depends on nothing but T; read-only."""
    edge = contact_edge(2 * np.pi * np.arange(n_t) / n_t, T)
    edge.setflags(write=False)
    return edge


def _edge_at(phase: Array, theta: Array, T: float) -> Array:
    lost = -np.expm1(-theta / T)
    # cos(phase) - cos(phase - theta), written without cancellation
    risen = -2 * np.sin(phase - theta / 2) * np.sin(theta / 2)
    return np.asarray(np.cos(phase) + risen * (1 - lost) / lost)


def full_slip(case: SlidingContact, n_t: int = N_INSTANTS) -> FullSlip:
    """The normal force and the contact of a case over one period, at n_t instants."""
    oscillation, E_star = require_case(case).oscillation, case.material.E_star
    n_t = count("n_t", n_t, 16)
    phase = 2 * np.pi * np.arange(n_t) / n_t
    u_z_dot = -oscillation.omega * oscillation.du_z * np.sin(phase)
    edge = _edge_of_period(n_t, case.T)
    g_c = np.maximum(oscillation.u_z0 + oscillation.du_z * edge, 0)
    a = np.asarray(case.indenter.contact_radius(g_c))
    above = oscillation.du_z * (np.cos(phase) - edge) + case.material.tau * u_z_dot  # u_z - g_c + tau u_z'
    F_N = np.asarray(case.indenter.force(g_c, E_star)) + np.where(g_c > 0, 2 * E_star * a * above, 0)
    return FullSlip(phase / oscillation.omega, np.maximum(F_N, 0), a, u_z_dot, g_c > 0)


def static_cof(case: SlidingContact) -> float:
    """COF in the limit v_0 -> 0: mu_0 min F_N / mean F_N over the period; Eq. (7) for the flat punch that keeps
    contact.
    """
    F_N = full_slip(case).F_N
    least = max(-_peak(-F_N), 0.0)
    return case.mu_0 * least / float(F_N.mean())


def normal_force_harmonics(case: SlidingContact, n_t: int = N_INSTANTS) -> NDArray[np.complex128]:
    """F_n [N] for n = 0 ... n_t/2 of F_N(t) = sum over all n of F_n exp(i n omega t), in full slip."""
    return np.asarray(np.fft.rfft(full_slip(case, n_t).F_N) / n_t)


def full_slip_critical_velocity(case: SlidingContact, n_t: int = N_INSTANTS) -> float:
    """Velocity [m/s] above which no spring ever sticks, for any amplitude and shape, with all harmonics of F_N.

    Infinite on an undamped resonance: k_x = m (n omega)² with a harmonic F_n that is not zero.
    """
    motion = full_slip(case, n_t)
    body = _body_velocity(case, motion)
    if np.isnan(body).any():
        return np.inf
    slope = case.mu_0 * case.material.mindlin_ratio * motion.u_z_dot - body
    highest = _peak(np.where(motion.in_contact, slope, -np.inf))
    return max([highest, *_at_touch(case, motion, body)])


def _at_touch(case: SlidingContact, motion: FullSlip, body: Array) -> list[float]:
    """The condition at the very instants at which the centre of the contact touches and leaves."""
    oscillation = case.oscillation
    n_t = motion.t.size
    values = []
    for k in np.flatnonzero(motion.in_contact != np.roll(motion.in_contact, 1)):
        low, high = 2 * np.pi * (k - 1) / n_t, 2 * np.pi * k / n_t
        for _ in range(40):
            middle = 0.5 * (low + high)
            touches = oscillation.u_z0 + oscillation.du_z * contact_edge(np.array([middle]), case.T)[0] > 0
            low, high = (low, middle) if touches == motion.in_contact[k] else (middle, high)
        u_z_dot = -oscillation.omega * oscillation.du_z * np.sin(low)
        share = low * n_t / (2 * np.pi) - (k - 1)
        body_dot = (1 - share) * body[k - 1] + share * body[k]
        values.append(float(case.mu_0 * case.material.mindlin_ratio * u_z_dot - body_dot))
    return values


def _body_velocity(case: SlidingContact, motion: FullSlip) -> Array:
    """y'(t) [m/s] of the body under mu_0 F_N(t); NaN on an undamped resonance."""
    n_t, omega = motion.t.size, case.oscillation.omega
    if not isinstance(case.pull, SpringPull):
        return np.zeros(n_t)
    n = np.arange(n_t // 2 + 1)
    F_n = np.fft.rfft(motion.F_N)
    H = np.asarray(case.pull.receptance(n * omega))
    stiff = np.abs(case.pull.k_x - case.pull.m * (n * omega) ** 2) < 1e-12 * case.pull.k_x
    resonant = stiff & (case.pull.c_x == 0)
    if np.any(resonant & (np.abs(F_n) > 1e-10 * abs(F_n[0]))):
        return np.full(n_t, np.nan)
    velocity = np.where(resonant, 0, -case.mu_0 * 1j * n * omega * F_n * np.where(resonant, 0, H))
    velocity[-1] = 0  # the highest harmonic has no phase
    return np.asarray(np.fft.irfft(velocity, n_t))


def _peak(values: Array) -> float:
    """Largest value of a periodic sample, by the parabola through it where its neighbours count too."""
    k = int(np.argmax(values))
    left, top, right = values[k - 1], values[k], values[(k + 1) % values.size]
    bend = left - 2 * top + right
    if not np.isfinite(bend) or bend >= 0:
        return float(top)
    return float(top - (left - right) ** 2 / (8 * bend))
