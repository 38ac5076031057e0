"""Turning points of noisy signals, against a count by eye of made-up ones."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from mdr.tools.turning_points import reach_of_noise, turning_points


def test_reversals_that_are_larger_count():
    x = np.array([0.0, 3, 2, 5, 5, 4.5, 1, 1.5, 0, 6])
    assert turning_points(x, 0.7) == [0, 1, 2, 3, 8, 9]
    assert turning_points(x, 1.5) == [0, 3, 8, 9]
    assert turning_points(x, 5.5) == [0, 9]
    assert turning_points(x[:1], 1.0) == [0, 0]
    assert turning_points(-x, 1.5) == [0, 3, 8, 9]


@pytest.mark.parametrize("seed", range(5))
def test_noise_makes_no_turning_point(seed):
    noise = np.random.default_rng(seed).normal(size=2000)
    x = noise + 1e-2 * np.abs(np.arange(2000) - 700)
    turns = turning_points(x, reach_of_noise(x))
    assert len(turns) == 3
    assert abs(turns[1] - 700) < 300  # where it has risen by three deviations
    assert_allclose(reach_of_noise(x), 2 * np.sqrt(2 * np.log(2000)), rtol=0.1)


def test_a_line_has_no_noise():
    assert reach_of_noise(np.arange(9.0)) == 0
    assert reach_of_noise(np.arange(2.0)) == 0
