"""The twin against definitions; the library is not imported.

Its limits, and how far it has converged, are those of the library, which agrees with it and is asked for them.
"""

import math

import numpy as np
import pytest
import reference
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

FLAT = math.inf


# --- one spring ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("T", [0.05, 1.0, 10.0])
def test_compression_is_the_supremum_of_relaxed_indentations(T):
    h = np.array([-0.9, -0.2, 0.5, 1.0, 1.3])
    t = np.arange(4000) * 2 * np.pi / 4000
    s = np.zeros(h.size)
    total = np.zeros(h.size)
    for i in range(3 * t.size):  # a maximum that relaxes: exact at the samples, and periodic after one period
        s = np.maximum(s * math.exp(-t[1] / T), h + math.cos(t[i % t.size]))
        total += s * (i >= 2 * t.size)
    # the samples miss each touch by up to a step, where s has a kink: an error of t[1]**2 (1 + 1 / T)
    assert_allclose(reference.mean_compression(h, T), total / t.size, rtol=0, atol=t[1] ** 2 * (1 + 1 / T))


@pytest.mark.parametrize("v_hat", [0.1, 0.5, 0.8])
def test_elastic_lag_is_the_infimum(v_hat):
    h = np.array([-0.9, -0.3, 0.2, 0.7, 0.95, 2.0])
    t = (np.arange(300) + 0.5) * 2 * np.pi / 300
    for hi in h:
        s = np.maximum(hi + np.cos(t), 0)
        e = reference.elastic_shear_by_definition(hi, v_hat, t, 10_000)
        # 300 samples of a curve whose slope jumps by no more than 1 twice a period: (2 pi / 300)**2 / 12 each
        assert_allclose(reference.elastic_lag(hi, v_hat), np.mean(s - e), rtol=0, atol=8e-5)


def test_contact_times_meet_their_conditions():
    h, T = np.linspace(-0.99, 1.4, 40), 1.0
    on, off = reference.contact_times(h, T)
    last_off = off - 2 * np.pi
    assert_allclose(h + np.cos(off) - T * np.sin(off), 0, atol=1e-14)
    assert_allclose(h + np.cos(on), (h + np.cos(last_off)) * np.exp(-(on - last_off) / T), atol=1e-13)
    assert np.all(h + np.cos(on) - T * np.sin(on) > 0)


# --- rigid pull ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("v_hat", [0.001, 0.1, 0.5, 0.9, 0.999])
def test_flat_punch_has_the_closed_deficit(v_hat):
    got = reference.rigid_elastic_cof(FLAT, 3.0, v_hat)
    assert_allclose(got, 1 - reference.flat_punch_deficit(v_hat) / 3, rtol=0, atol=1e-14)


# --- spring pull --------------------------------------------------------------------------------------------


def test_flat_punch_agrees_with_an_adaptive_integrator():
    """One spring that jumps and slips back: Dormand-Prince of order 8, contact and flight in turn."""
    k, omega_0, T, depth, v_hat = 0.3, 1.2, 3.0, 0.9, 7.4
    c, mass = reference.damping_for(0.1, k, omega_0), k / omega_0**2
    on, off = (float(t[0]) for t in reference.contact_times([depth], T))
    slipped_back = []

    def rate(t, z, touches):
        load = depth + math.cos(t) - T * math.sin(t) if touches else 0.0
        trial = z[0] + T * (v_hat + z[2])
        if touches and trial < -load - 1e-3:
            slipped_back.append(t)
        force = min(max(trial, -load), load)
        return (force - z[0]) / T, z[2], -(k * z[1] + c * z[2] + force) / mass, force

    def march(z, periods, max_step):
        for _ in range(periods):
            for start, stop, touches in ((on, off, True), (off, on + 2 * np.pi, False)):
                z = solve_ivp(
                    rate, (start, stop), z, args=(touches,), method="DOP853", rtol=1e-8, atol=1e-10, max_step=max_step
                ).y[:, -1]
        return z

    z = march([0, 0, -v_hat, 0], 18, 0.3)
    slipped_back.clear()
    impulse = march(z, 4, 0.04)[3] - z[3]
    assert slipped_back
    mean = impulse / (8 * np.pi * reference.mean_force(FLAT, depth, T))
    *_, cof = reference.spring_pull_run(FLAT, depth, v_hat, T, k, omega_0, c, steps=(256, 2048))
    assert_allclose(cof, mean, rtol=0, atol=2e-6)  # both cut through the kinks of stick and slip
