"""Anderson's shares: the least squares of NumPy, without the directions that newer steps have already."""

import numpy as np
from numpy.testing import assert_allclose

from mdr.tools.anderson import shares

RNG = np.random.default_rng(5)


def test_shares_leave_least():
    steps, last = RNG.normal(size=(5, 30)), RNG.normal(size=30)
    assert_allclose(shares(steps, last, 1e-10), np.linalg.lstsq(steps.T, last, rcond=None)[0], rtol=1e-12)


def test_a_step_that_newer_ones_contain_is_left_out():
    new = RNG.normal(size=(2, 30))
    steps, last = np.array([new[0] + 2 * new[1], new[0], new[1]]), new[0] - new[1] + RNG.normal(size=30)
    found = shares(steps, last, 1e-10)
    assert found[0] == 0
    assert_allclose(found[1:], np.linalg.lstsq(new.T, last, rcond=None)[0], rtol=1e-12)


def test_without_steps_there_is_nothing_to_share():
    assert shares(np.zeros((2, 4)), np.ones(4), 1e-10).tolist() == [0, 0]
