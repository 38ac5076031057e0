"""Spectra of a random depth: moments against closed forms, histories against the spectrum they are drawn from."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

BAND = mdr.Spectrum.band(rms=2e-6, f_low=30.0, f_high=80.0)
PEAK = mdr.Spectrum((10.0, 20.0, 60.0), (0.0, 4e-14, 0.0))


@pytest.mark.parametrize("k", range(7))
def test_moments_are_those_of_powers(k):
    """Of a band (f_2^(k+1) - f_1^(k+1))/(k + 1); of a triangle the second difference of f^(k+2)/((k+1)(k+2))."""
    f_1, f_2 = BAND.f
    band = BAND.density[0] * (2 * np.pi) ** k * (f_2 ** (k + 1) - f_1 ** (k + 1)) / (k + 1)
    assert_allclose(BAND.moment(k), band, rtol=1e-14)
    f, top = np.array(PEAK.f) ** (k + 2), PEAK.density[1]
    sides = (f[2] - f[1]) / (PEAK.f[2] - PEAK.f[1]) - (f[1] - f[0]) / (PEAK.f[1] - PEAK.f[0])
    assert_allclose(PEAK.moment(k), top * (2 * np.pi) ** k * sides / ((k + 1) * (k + 2)), rtol=1e-13)


def test_what_follows_from_the_moments():
    assert_allclose(BAND.rms, 2e-6, rtol=1e-14)
    assert_allclose([BAND.rms_velocity**2, BAND.rms_acceleration**2], [BAND.moment(2), BAND.moment(4)], rtol=1e-14)
    assert_allclose(mdr.Spectrum.band(1.0, 0.0, 3.0).spread, (1 / 3) * (1 / 7) / (1 / 5) ** 2 - 1, rtol=1e-12)
    assert_allclose(BAND.correlation_time, 1 / 50, rtol=1e-14)
    assert_allclose(PEAK.correlation_time, (2 / 3) / 25, rtol=1e-14)  # squares of a triangle: a third of its base


def test_a_history_has_the_variance_and_the_spectrum():
    """Powers of single frequencies are exponential: their mean over n histories errs by 1/sqrt(n)."""
    n_t, dt, n = 400, 5e-3, 400
    found = np.array([PEAK.realisation(n_t, dt, seed=2, k=k) for k in range(n)])
    f = np.arange(n_t // 2 + 1) / (n_t * dt)
    power = 2 * n_t * dt * np.mean(np.abs(np.fft.rfft(found) / n_t) ** 2, axis=0)
    known, inside = np.interp(f, PEAK.f, PEAK.density, left=0, right=0), (f > 11) & (f < 59)
    assert np.all(np.abs(power / np.where(inside, known, 1) - 1)[inside] < 5 / np.sqrt(n))
    assert_allclose(np.mean((power / np.where(inside, known, 1))[inside]), 1, atol=3 / np.sqrt(n * inside.sum()))
    assert_allclose(np.mean(found**2), PEAK.moment(0), rtol=3 / np.sqrt(n * n_t * dt / PEAK.correlation_time))
    powers, share = np.mean(found**2, axis=1), PEAK.correlation_time / (n_t * dt)
    assert_allclose(powers.std() / powers.mean(), np.sqrt(share), rtol=3 / np.sqrt(2 * n))  # cosines of fixed size: 0
    assert_allclose(np.mean(found**4) / np.mean(found**2) ** 2, 3, atol=3 * np.sqrt(24 * share / n))  # Gaussian


def test_what_is_slower_than_a_history_stands_still_in_it():
    slow = mdr.Spectrum.band(1e-6, 0.0, 0.01)
    found = np.array([slow.realisation(16, 1.0, k=k) for k in range(400)])
    assert_allclose(np.ptp(found, axis=1), 0, atol=1e-20)
    assert_allclose(found[:, 0].std(), 1e-6, rtol=0.15)


def test_a_seed_is_a_history_however_finely_it_is_sampled():
    once = BAND.realisation(128, 1e-3, seed=5, k=3)
    assert_allclose(BAND.realisation(1024, 1e-3 / 8, seed=5, k=3)[::8], once, rtol=0, atol=1e-19)
    for other in ({"seed": 4, "k": 3}, {"seed": 5, "k": 2}):
        assert not np.any(np.isclose(BAND.realisation(128, 1e-3, **other), once, rtol=1e-6, atol=0))
