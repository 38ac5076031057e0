"""One period of depth: extremes, rates, sums at nodes, and which springs keep contact."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from mdr.case.depth_cycle import Cycle, peak, turns
from mdr.materials.operator import Rheology

RNG = np.random.default_rng(3)
SERIES = {
    "one": (np.array([2e-6]), np.array([0.0])),
    "two": (np.array([1e-6, 3e-7]), np.array([2e-7, -8e-7])),
    "many": (1e-6 / np.arange(1, 41) ** 2, 1e-6 * RNG.normal(size=40) / np.arange(1, 41) ** 2),
}


@pytest.fixture(params=SERIES.values(), ids=SERIES)
def cycle(request):
    return Cycle.series(5e-6, 300.0, *request.param)


def dense(cycle, n=200_001):
    return cycle.z(np.linspace(0, 2 * np.pi, n))


def test_extremes_and_scale(cycle):
    z = dense(cycle)
    assert_allclose([cycle.least, cycle.greatest], [z.min(), z.max()], rtol=0, atol=1e-6)  # bend 40²/2 (pi/2e5)²
    assert cycle.greatest >= z.max() - 1e-14
    assert_allclose(cycle.greatest - cycle.least, 2, rtol=1e-14)


def test_rate_and_bend_are_derivatives(cycle):
    phase, d = np.linspace(0, 6, 13), 1e-5
    for value, slope in ((cycle.z, cycle.rate), (cycle.rate, cycle.bend)):
        # a central difference misses n³ d²/6 of each term, and n⁴ of a rate
        assert_allclose(slope(phase), (value(phase + d) - value(phase - d)) / (2 * d), rtol=0, atol=1e-6)


def test_nodes_are_those_of_the_sum(cycle):
    phase = 2 * np.pi * np.arange(257) / 256
    z, rate = cycle.over_a_period(256)
    assert_allclose(z, cycle.z(phase), rtol=0, atol=1e-12)
    assert_allclose(rate, cycle.rate(phase), rtol=0, atol=1e-11)


def test_a_harmonic_cycle_is_bitwise_a_cosine_that_ends_as_it_began():
    z, rate = Cycle.harmonic(1.0, 2.0, 3.0).over_a_period(64)
    phase = 2 * np.pi * np.arange(64) / 64
    assert np.array_equal(z[:-1], np.cos(phase))
    assert np.array_equal(rate[:-1], -np.sin(phase))
    assert (z[-1], rate[-1]) == (z[0], rate[0])


def test_kept_gap_is_where_the_least_force_vanishes(cycle):
    rheology, n = Rheology(0.2, (1.5,), (0.8,)), np.arange(1, cycle.cos.size + 1)
    phase = np.linspace(0, 2 * np.pi, 100_001)
    force = (cycle.harmonics * rheology.response(n) * np.exp(1j * np.outer(phase, n))).real.sum(axis=1)
    assert_allclose(cycle.kept_gap(rheology.response), force.min(), rtol=1e-6)


def test_a_spike_beside_a_broad_crest_is_found():
    n = np.arange(1, 65)
    spike = 0.02 * np.exp(-1j * n * (4.0 + 0.5 * 2 * np.pi / 1024)) / 1.3
    harmonics = spike + np.where(n == 1, np.exp(-1j * 1.0) * 0.4, 0)
    phase = np.linspace(0, 2 * np.pi, 400_001)
    values = sum((harmonics[k - 1] * np.exp(1j * k * phase)).real for k in n)
    assert_allclose(peak(harmonics), values.max(), rtol=1e-7)


def test_turns_are_all_extremes(cycle):
    phase = turns(cycle.harmonics)
    assert_allclose(cycle.rate(phase), 0, atol=1e-11)
    values = dense(cycle)[:-1]
    beside = np.roll(values, 1), np.roll(values, -1)
    assert phase.size == np.sum((values >= np.maximum(*beside)) | (values < np.minimum(*beside)))
    assert_allclose(cycle.z(phase).max(), cycle.greatest, rtol=1e-13)
