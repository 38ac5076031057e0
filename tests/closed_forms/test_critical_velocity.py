"""Eq. (15) beyond the paper: a damped body, a depth of several harmonics, and an oscillating load"""

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose

import mdr

OMEGA, CONE = 300.0, mdr.Cone(theta=0.0127)
BODY = mdr.SpringPull(k_x=2e4, m=0.1, c_x=5.0)
RUBBER = mdr.KelvinVoigt(E=3e6, nu=0.4, tau=1.3e-3)


def yielding(n=1):
    """Displacement of the body under a unit force of harmonic n."""
    return 1 / (BODY.k_x - BODY.m * (n * OMEGA) ** 2 + 1j * n * OMEGA * BODY.c_x)


def test_eq_15_with_a_damper_and_with_harmonics():
    case = mdr.SlidingContact(CONE, RUBBER, 0.4, mdr.NormalOscillation(20e-6, 2e-7, OMEGA), BODY)
    kappa, K = case.material.mindlin_ratio, case.k_zc * (1 + 1j * case.T)
    assert_allclose(mdr.critical_velocity(case), 0.4 * OMEGA * 2e-7 * abs(kappa + K * yielding()), rtol=1e-13)
    periodic = mdr.PeriodicMotion(omega=OMEGA, u_z0=20e-6, cos=(2e-7, 5e-8), sin=(0.0, 3e-8))
    u_n, n = np.array([2e-7, 5e-8 - 3e-8j]), np.array([1, 2])
    phase = np.linspace(0, 2 * np.pi, 100001)[:, None]
    K = case.k_zc * (1 + 1j * n * case.T)
    rate = 1j * n * OMEGA * (kappa + K * yielding(n)) * u_n * np.exp(1j * n * phase)
    expected = 0.4 * rate.sum(axis=1).real.max()
    assert_allclose(mdr.critical_velocity(replace(case, oscillation=periodic)), expected, rtol=1e-8)


def test_eq_15_under_an_oscillating_load():
    load = mdr.LoadOscillation(F_z0=0.1, dF_z=1e-4, omega=OMEGA, m_z=0.02)
    case = mdr.resolved(mdr.SlidingContact(CONE, RUBBER, 0.4, load, BODY))
    K, kappa = complex(case.dynamic_stiffness(OMEGA)), case.material.mindlin_ratio
    expected = 0.4 * OMEGA * 1e-4 * abs(kappa + K * yielding()) / abs(K - 0.02 * OMEGA**2)
    assert_allclose(mdr.critical_velocity(case), expected, rtol=1e-12)
    assert_allclose(CONE.force(case.working_depth, case.material.E_star), 0.1, rtol=1e-12)
