"""The imposed motion, Eq. (3), and what it refuses."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

MOTION = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)


def test_depth_is_equation_3():
    t = np.linspace(0, 0.1, 7)
    assert_allclose(MOTION.u_z(t), 20e-6 + 2e-6 * np.cos(300 * t), rtol=1e-15)
    assert_allclose(MOTION.u_z(0), 22e-6, rtol=1e-15)
    assert_allclose(MOTION.u_z(MOTION.period / 2), 18e-6, rtol=1e-15)


def test_rate_is_the_derivative_of_the_depth():
    t, dt = np.linspace(0, 0.1, 50), 1e-6
    slope = (MOTION.u_z(t + dt) - MOTION.u_z(t - dt)) / (2 * dt)
    # central difference: (omega dt)**2 / 6 = 1.5e-8 of the amplitude, and rounding 20e-6 * 1e-16 / dt
    assert_allclose(MOTION.u_z_dot(t), slope, rtol=0, atol=3e-8 * 2e-6 * 300 + 1e-14)


def test_period():
    assert_allclose(MOTION.omega * MOTION.period, 2 * np.pi, rtol=1e-15)


@pytest.mark.parametrize("u_z0", [0.0, -1e-6, -1.999e-6])
def test_tapping_is_legal(u_z0):
    assert mdr.NormalOscillation(u_z0=u_z0, du_z=2e-6, omega=1.0).u_z0 == u_z0


@pytest.mark.parametrize("u_z0", [-2e-6, -3e-6])
def test_an_indenter_that_never_touches_is_refused(u_z0):
    with pytest.raises(
        ValueError, match=r"u_z0 \+ du_z = .* m: the indenter never touches; raise u_z0 above -du_z = -2e-06 m"
    ):
        mdr.NormalOscillation(u_z0=u_z0, du_z=2e-6, omega=1.0)


@pytest.mark.parametrize(
    ("change", "kind", "message"),
    [
        ({"du_z": 0}, ValueError, "du_z must be positive, got 0.0"),
        ({"du_z": -1e-6}, ValueError, "du_z must be positive"),
        ({"omega": 0}, ValueError, "omega must be positive"),
        ({"omega": np.inf}, ValueError, "omega must be a finite number"),
        ({"u_z0": np.nan}, ValueError, "u_z0 must be a finite number"),
        ({"u_z0": None}, TypeError, "u_z0 must be a real number, got None"),
    ],
)
def test_bad_input_stops_at_construction(change, kind, message):
    with pytest.raises(kind, match=message):
        mdr.NormalOscillation(**{"u_z0": 1e-6, "du_z": 1e-6, "omega": 1.0, **change})
