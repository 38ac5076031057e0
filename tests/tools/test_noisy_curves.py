"""Turning points, stand-stills and the order of noisy readings, against what was made up."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from mdr.tools.noisy_curves import before_it_stands, in_order, reach_of_noise, turning_points


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


def test_a_stand_still_is_left_out_and_a_slower_rise_is_not():
    x = np.concatenate([np.arange(100.0), np.full(50, 99.0)])
    always = np.ones(x.size, dtype=bool)
    assert before_it_stands(x, always) == 100
    assert before_it_stands(x, np.arange(150) < 50) == 150  # it may not stand where it does
    assert before_it_stands(np.concatenate([np.arange(100.0), 99 + 0.3 * np.arange(50)]), always) == 150
    assert before_it_stands(np.sin(np.linspace(0, np.pi / 2, 200)), np.ones(200, dtype=bool)) == 200
    assert before_it_stands(np.arange(3.0), always[:3]) == 3
    stairs = np.concatenate([np.arange(2000) // 10, np.full(500, 200.0)])
    assert abs(before_it_stands(stairs, np.ones(2500, dtype=bool)) - 2000) <= 10


@pytest.mark.parametrize("seed", range(5))
def test_pairs_are_in_order_by_what_follows_what(seed):
    """Noise that F follows is kept; noise that it does not follow goes, and equal readings are averaged."""
    true, noise = np.linspace(0, 1, 400), 0.01 * np.random.default_rng(seed).normal(size=400)
    d, F = in_order(true + noise, (true + noise) ** 2)
    assert_allclose(F, d**2, rtol=1e-12, atol=1e-15)
    d, F = in_order(true + noise, true**2)
    assert_allclose(F, d**2, atol=0.01)
    assert np.std(F - d**2) < 0.1 * 0.02
    d, F = in_order(np.round(true, 2), true)
    assert np.all(np.diff(d) > 0)
    assert_allclose(F, d, atol=0.005)
    assert_allclose(in_order(true[::-1], true[::-1] ** 3), [true, true**3])
