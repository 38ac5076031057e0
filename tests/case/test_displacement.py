"""Accelerations integrated above a high-pass: a burst, the filter of scipy, a tone with drift."""

import warnings

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import signal

import mdr
from mdr.case.displacement import inner_part


def burst(t, f=100.0):
    """A tone under a Gaussian, and its second derivative."""
    x, w, width = t - 1.0, 2 * np.pi * f, 0.05
    u = 2e-6 * np.exp(-((x / width) ** 2) / 2) * np.exp(1j * w * x)
    return u.real, (u * ((1j * w - x / width**2) ** 2 - 1 / width**2)).real


def test_a_burst_is_integrated():
    """The filter takes (high_pass/f)⁸ of its middle, a few times that of its lower half; more as it says above."""
    t = np.arange(4001) * 5e-4
    u, a = burst(t)
    for high_pass in (5.0, 10.0, 20.0):
        off = np.abs(mdr.displacement_of(t, a + 9.81, high_pass=high_pass) - u).max() / 2e-6
        assert (high_pass / 100) ** 8 / 2 < off + 1e-9
        assert off < 2 * (high_pass / 100) ** 8 + 1e-9


def test_a_velocity_is_integrated_once_and_a_displacement_is_filtered():
    t = np.arange(4001) * 5e-4
    u, _ = burst(t)
    phase = 2e-6 * np.exp(-(((t - 1) / 0.05) ** 2) / 2 + 2j * np.pi * 100 * (t - 1))
    v = (phase * (2j * np.pi * 100 - (t - 1) / 0.05**2)).real
    for order, values in ((1, v + 0.1), (0, u + 1e-3)):
        found = mdr.displacement_of(t, values, high_pass=10.0, order=order)
        assert_allclose(found, u, rtol=0, atol=2e-6 * (2 * (10 / 100) ** 8 + 1e-9))
    with pytest.raises(ValueError, match="order must be 2 of an acceleration, 1 of a velocity"):
        mdr.displacement_of(t, v, high_pass=10.0, order=3)


def test_a_vibration_below_the_high_pass_is_told():
    t = np.arange(4001) * 5e-4
    tone = np.sin(2 * np.pi * 80 * t)
    burst, swell = tone * (t < 0.1), 0.02 * np.sin(2 * np.pi * 10 * t)
    with warnings.catch_warnings():
        warnings.simplefilter("error", mdr.PlausibilityWarning)
        for drift in (3.0 * t, 50.0 * t, 30.0 * t**2):  # what drifts is meant to go, in silence
            mdr.displacement_of(t, tone + drift, high_pass=20.0)
        mdr.displacement_of(t, burst + swell, high_pass=20.0)  # most is in the burst
    with pytest.warns(mdr.PlausibilityWarning, match=r"at [78][90].* Hz, and is left out: lower high_pass"):
        mdr.displacement_of(t, tone, high_pass=150.0)


def test_the_filter_is_butterworth_run_both_ways():
    """Of scipy, on the displacement, which the bilinear transform warps by (pi f dt)²/3: 2e-3 at the cut."""
    t = np.arange(20001) * 1e-4
    u, a = burst(t, 25.0)
    sos = signal.butter(4, 20.0, "highpass", fs=1e4, output="sos")
    expected = signal.sosfiltfilt(sos, u)
    assert np.abs(expected - u).max() > 0.1 * 2e-6
    assert_allclose(mdr.displacement_of(t, a, high_pass=20.0), expected, rtol=0, atol=1e-4 * 2e-6)


def test_a_tone_that_is_cut_off_swings_as_the_tone():
    """Inside to (1/2) high_pass/f of its amplitude, and at the ends to ten times that, as the docstring says."""
    rng, hp = np.random.default_rng(4), 5.0
    for f in 10 ** rng.uniform(np.log10(4 * hp), np.log10(100 * hp), 20):
        t = np.arange(int(rng.uniform(0.5, 2.0) * 5000)) / 5000
        phase = 2 * np.pi * f * t + rng.uniform(0, 2 * np.pi)
        a = -((2 * np.pi * f) ** 2) * np.cos(phase)
        off = np.abs(mdr.displacement_of(t, a + 9.81, high_pass=hp) - np.cos(phase))
        assert off[inner_part(t, hp)].max() < 0.5 * hp / f
        assert off.max() < 5.5 * hp / f
