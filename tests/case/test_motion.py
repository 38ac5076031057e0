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


# --- periodic motion ---


def test_a_series_is_the_sum_of_its_terms():
    motion = mdr.PeriodicMotion(300.0, 20e-6, cos=(2e-6, 0.0, 1e-6), sin=(0.5e-6,))
    t = np.linspace(0, 0.1, 17)
    phase = 300 * t
    expected = 20e-6 + 2e-6 * np.cos(phase) + 1e-6 * np.cos(3 * phase) + 0.5e-6 * np.sin(phase)
    assert_allclose(motion.u_z(t), expected, rtol=1e-14)
    assert motion.sin == (0.5e-6, 0.0, 0.0)
    dt = 1e-6
    slope = (motion.u_z(t + dt) - motion.u_z(t - dt)) / (2 * dt)
    assert_allclose(motion.u_z_dot(t), slope, rtol=0, atol=1e-6 * 1e-3)  # (3 omega dt)²/6 of 3e-6 omega


def test_one_term_is_eq_3():
    one = mdr.PeriodicMotion(300.0, 20e-6, cos=(2e-6,))
    t = np.linspace(0, 0.1, 9)
    assert_allclose(one.u_z(t), MOTION.u_z(t), rtol=1e-15)
    assert one.cycle == MOTION.cycle


def test_a_series_goes_through_its_samples():
    phase = 2 * np.pi * np.arange(101) / 101
    u_z = 5e-6 + 1e-6 * np.sign(np.sin(phase + 0.1))  # square-like
    motion = mdr.PeriodicMotion.of(u_z, 10.0)
    assert_allclose(motion.u_z(phase / 10), u_z, rtol=0, atol=1e-18)
    assert len(mdr.PeriodicMotion.of(u_z, 10.0, n_harmonics=7).cos) == 7


@pytest.mark.parametrize(
    ("change", "kind", "message"),
    [
        ({"cos": (0.0,), "sin": ()}, ValueError, "nothing oscillates"),
        ({"u_z0": -3e-6}, ValueError, "at its deepest: the indenter never touches"),
        ({"cos": (np.nan,)}, ValueError, r"cos\[0\] must be a finite number"),
        ({"sin": "abc"}, TypeError, "sin must be a list of amplitudes in m"),
        ({"sin": 3.0}, TypeError, "sin must be a list of amplitudes in m"),
        ({"omega": 0}, ValueError, "omega must be positive"),
    ],
)
def test_a_bad_series_stops_at_construction(change, kind, message):
    with pytest.raises(kind, match=message):
        mdr.PeriodicMotion(**{"omega": 1.0, "u_z0": 1e-6, "cos": (1e-6,), **change})


# --- oscillating load ---


def test_the_load():
    motion = mdr.LoadOscillation(0.1, 0.03, 300.0)
    assert_allclose(motion.F_z([0, np.pi / 300]), [0.13, 0.07], rtol=1e-14)


@pytest.mark.parametrize(
    ("change", "kind", "message"),
    [
        ({"F_z0": 0}, ValueError, "F_z0 must be positive"),
        ({"dF_z": -1}, ValueError, "dF_z must be positive"),
        ({"dF_z": 0.1}, ValueError, "dF_z = 0.1 N must be less than F_z0 = 0.1 N where nothing has mass"),
        ({"m_z": -1}, ValueError, "m_z must not be negative"),
        ({"omega": None}, TypeError, "omega must be a real number"),
    ],
)
def test_a_bad_load_stops_at_construction(change, kind, message):
    with pytest.raises(kind, match=message):
        mdr.LoadOscillation(**{"F_z0": 0.1, "dF_z": 0.02, "omega": 1.0, **change})
    assert mdr.LoadOscillation(0.1, 0.2, 1.0, m_z=0.1).dF_z == 0.2  # with mass it may let go
