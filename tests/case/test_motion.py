"""The imposed motion, Eq. (3), and what it refuses."""

import numpy as np
from numpy.testing import assert_allclose

import mdr

MOTION = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)


def test_depth_is_equation_3():
    t = np.linspace(0, 0.1, 7)
    assert_allclose(MOTION.u_z(t), 20e-6 + 2e-6 * np.cos(300 * t), rtol=1e-15)
    assert_allclose(MOTION.u_z(0), 22e-6, rtol=1e-15)
    assert_allclose(MOTION.u_z(MOTION.period / 2), 18e-6, rtol=1e-15)


# --- periodic motion ---


def test_a_series_is_the_sum_of_its_terms():
    motion = mdr.PeriodicMotion(300.0, 20e-6, cos=(2e-6, 0.0, 1e-6), sin=(0.5e-6,))
    t = np.linspace(0, 0.1, 17)
    phase = 300 * t
    expected = 20e-6 + 2e-6 * np.cos(phase) + 1e-6 * np.cos(3 * phase) + 0.5e-6 * np.sin(phase)
    assert_allclose(motion.u_z(t), expected, rtol=1e-14)
    assert motion.sin == (0.5e-6, 0.0, 0.0)
    dt = 1e-6
    for value, rate in ((motion.u_z, motion.u_z_dot), (motion.u_z_dot, motion.u_z_ddot)):
        # to (3 omega dt)²/6 of the greatest rate
        assert_allclose(rate(t), (value(t + dt) - value(t - dt)) / (2 * dt), rtol=0, atol=2e-7 * np.ptp(rate(t)))


def test_a_series_goes_through_its_samples():
    phase = 2 * np.pi * np.arange(101) / 101
    u_z = 5e-6 + 1e-6 * np.sign(np.sin(phase + 0.1))  # square-like
    motion = mdr.PeriodicMotion.of(u_z, 10.0)
    assert_allclose(motion.u_z(phase / 10), u_z, rtol=0, atol=1e-18)
    assert len(mdr.PeriodicMotion.of(u_z, 10.0, n_harmonics=7).cos) == 7


# --- oscillating load ---


def test_the_load():
    motion = mdr.LoadOscillation(0.1, 0.03, 300.0)
    assert_allclose(motion.F_z([0, np.pi / 300]), [0.13, 0.07], rtol=1e-14)
