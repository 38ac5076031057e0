"""The critical velocity of a case in closed form: Eq. (15), or what takes its place, with the numbers of the case."""

from __future__ import annotations

import numpy as np

from mdr.case.contact import SlidingContact
from mdr.closed_forms.paper import eq_1, eq_15, linear_critical_velocity
from mdr.normal.resolved import at_rest


def critical_velocity(case: SlidingContact) -> float:
    """Critical velocity [m/s], Eq. (15), with the contact stiffness k_zc, k_xc and damping gamma_zc at the mean depth:

        v_c = mu_0 du_z omega |kappa (D - k_xc) - i gamma_zc omega| / |D|,   D = m omega² - k_x - i omega c_x,

    kappa = k_zc/k_xc. Without the system's damper, c_x = 0, it reads as in the paper (M. Popov, Facta Universitatis,
    Series: Mechanical Engineering 14 (2016) 335),

        v_c = mu_0 du_z omega sqrt((gamma_zc omega)² + (kappa (m omega² - k_xc - k_x))²) / |m omega² - k_x|;

    c_x is included here as k_x + i omega c_x in the place of k_x. A rigid pull is the limit k_x -> infinity, Eq. (1):
    v_c = mu_0 du_z omega kappa.

    Materials with arms enter by their dynamic stiffness, periodic motions by all their harmonics
    (`linear_critical_velocity`), and an oscillating load by the depth it brings about at small amplitude, so that

        v_c = mu_0 omega dF_z |kappa + K_z H|/|K_z - m_z omega²|,   K_z(omega) = 2 a E*(omega) at the depth of F_z0.

    Infinite on the undamped resonance k_x = m omega², and k_zc = m_z omega². With u_z0 <= 0 (tapping) the contact has
    no stiffness at the mean depth, and Eq. (1) is left.
    """
    case = at_rest(case)
    oscillation, kappa, pull = case.oscillation, case.material.mindlin_ratio, case.pull
    if case.is_of_the_paper:
        du_z = case.cycle.du_z
        if pull.is_rigid or case.k_zc == 0:
            return eq_1(case.mu_0, du_z, oscillation.omega, kappa)
        m, c_x, k_x = pull.coefficients
        return eq_15(
            case.mu_0,
            du_z,
            oscillation.omega,
            case.k_zc,
            case.k_xc,
            case.gamma_zc,
            k_x,
            m,
            c_x,
        )
    omega = oscillation.omega
    if (load := oscillation.load) is not None:
        impedance = case.dynamic_stiffness(omega) - load.m_z * omega**2
        if impedance == 0:
            return float("inf")
        u_n = np.atleast_1d(load.dF_z / impedance)
    else:
        u_n = case.cycle.du_z * case.cycle.harmonics
    n_omega = omega * np.arange(1, u_n.size + 1)
    return linear_critical_velocity(
        case.mu_0, omega, u_n, kappa, case.dynamic_stiffness(n_omega), np.asarray(pull.receptance(n_omega))
    )


def formula_of(case: SlidingContact) -> str:
    """Which closed form critical_velocity(case) is, in words; without stiffness at the mean depth Eq. (1) is left."""
    case = at_rest(case)
    if case.oscillation.load is not None:
        return "Eq. (15) at the depth that the load brings about"
    if case.pull.is_rigid or case.k_zc == 0:
        return "Eq. (1)"
    return "Eq. (15)" + (" with the dynamic stiffness of the material" if case.material.contact_arms else "")
