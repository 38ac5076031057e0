"""What pulls, and how far it yields: the receptance is the response of the oscillator it stands for."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

PULLS = {
    "no mass": mdr.SpringPull(k_x=2e4),
    "mass": mdr.SpringPull(k_x=2e4, m=0.1),
    "damped": mdr.SpringPull(k_x=2e4, m=0.1, c_x=3.0),
    "damper alone": mdr.SpringPull(k_x=2e4, c_x=3.0),
}


@pytest.mark.parametrize("pull", PULLS.values(), ids=PULLS)
@pytest.mark.parametrize("omega", [0.0, 1.0, 300.0, 1e5])
def test_receptance_solves_the_equation_of_motion(pull, omega):
    # y = Y exp(i omega t) under the force exp(i omega t): m y'' + c_x y' + k_x y = 1, term by term
    Y = pull.receptance(omega)
    terms = np.array([-pull.m * omega**2 * Y, 1j * omega * pull.c_x * Y, pull.k_x * Y])
    assert_allclose(terms.sum(), 1, rtol=1e-15 * 8 * np.abs(terms).max())


def test_receptance_keeps_the_shape():
    omega = np.array([[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]])
    for pull in (*PULLS.values(), mdr.RigidPull()):
        assert pull.receptance(omega).shape == omega.shape
        assert type(pull.receptance(3.0)) is complex
        assert_allclose(pull.receptance(omega)[1, 0], pull.receptance(3.0), rtol=1e-15)


def test_resonance_without_damper_is_infinite():
    pull = mdr.SpringPull(k_x=4.0, m=1.0)  # omega_0 = 2, exact in binary
    assert math.isinf(abs(pull.receptance(2.0)))
    assert np.isinf(np.abs(pull.receptance([1.0, 2.0]))).tolist() == [False, True]
    assert np.isfinite(abs(mdr.SpringPull(k_x=4.0, m=1.0, c_x=1e-9).receptance(2.0)))


def test_natural_frequency_and_damping_ratio():
    pull = mdr.SpringPull(k_x=2e4, m=0.1, c_x=3.0)
    assert_allclose(pull.m * pull.omega_0**2, pull.k_x, rtol=1e-15)
    assert_allclose(pull.damping_ratio, 3.0 / (2 * np.sqrt(2e4 * 0.1)), rtol=1e-15)
    assert PULLS["mass"].damping_ratio == 0
    assert math.isinf(PULLS["no mass"].omega_0)
    assert math.isinf(PULLS["damper alone"].damping_ratio)
    assert PULLS["no mass"].damping_ratio == 0
