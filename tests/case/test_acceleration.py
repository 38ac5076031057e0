"""Motion from an accelerometer's record: known series, noise, uneven samples, drift, and what is told."""

import warnings

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

U_Z0 = 20e-6
SERIES = {
    "sine": [2e-6],
    "falling": [2e-6, 3e-7j, 1e-7 - 1e-7j],
    "second louder": [1e-6, 8e-7],
    "gaps, loudest the fifth": [2e-6, 0, 0, 3e-7j, 4e-7, 2e-9],
    "fundamental missing": [0, 1e-6, 8e-7j],
    "blows": [1e-6 / n**2 * np.exp(1j * n) for n in range(1, 40)],
}


def instants(n, dt, seed=None):
    """Equal steps, or each off by up to 0.4 of one; a record does not begin at zero."""
    off = np.zeros(n) if seed is None else np.random.default_rng(seed).uniform(-0.4, 0.4, n)
    return 3.0 + (np.arange(n) + off) * dt


def truth(f, U):
    """The motion of depths Re of sum U_n exp(i n 2 pi f t)."""
    U = np.array(U, dtype=complex)
    return mdr.PeriodicMotion(2 * np.pi * f, U_Z0, tuple(U.real), tuple(-U.imag))


@pytest.mark.parametrize("given", [False, True], ids=["found", "given"])
@pytest.mark.parametrize("seed", [None, 4], ids=["even", "uneven"])
@pytest.mark.parametrize("U", SERIES.values(), ids=SERIES)
def test_a_series_without_noise_comes_back(U, seed, given):
    """Whatever its offset, its drift and its part of a period at the end."""
    f, t = 37.13, instants(4000, 1.1e-4, seed)
    a = truth(f, U).u_z_ddot(t) + 9.81 - 0.3 * t
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", mdr.PlausibilityWarning)  # of the drift
        found = mdr.PeriodicMotion.from_acceleration(t, a, u_z0=U_Z0, frequency=f if given else None)
    assert_allclose(found.omega, 2 * np.pi * f, rtol=1e-12)
    assert len(found.cos) == len(U)
    assert_allclose(found.u_z(t), truth(f, U).u_z(t), rtol=0, atol=1e-9 * np.abs(U).max())


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", ["sine", "falling", "gaps, loudest the fifth"])
def test_noise_costs_what_least_squares_must_pay(name, seed):
    """The Cramér-Rao bound: of the frequency 24 s²/(N (2 pi span)² sum of n² A_n²), of an amplitude 2 s²/N."""
    U, f, N, dt, s = np.array(SERIES[name][:5]), 37.13, 4000, 1.1e-4, 0.02
    rng, t, n = np.random.default_rng(seed), instants(N, dt, seed), np.arange(1, len(U) + 1)
    A = -((n * 2 * np.pi * f) ** 2) * U
    s *= np.abs(A).max()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        a = truth(f, U).u_z_ddot(t) + rng.normal(0, s, N)
        found = mdr.PeriodicMotion.from_acceleration(t, a, u_z0=U_Z0)
    bound = np.sqrt(24 / N / np.sum(n**2 * np.abs(A) ** 2)) * s / (2 * np.pi * N * dt)
    assert 0 < abs(found.omega / (2 * np.pi) - f) < 4 * bound < 1e-2 / (N * dt)
    middle = n * t.mean()
    got = (np.array(found.cos) - 1j * np.array(found.sin)) * np.exp(1j * middle * found.omega)
    off = np.abs(got - U * np.exp(2j * np.pi * f * middle)) * (n * 2 * np.pi * f) ** 2
    assert np.all(off < 4 * np.sqrt(2 / N) * s)
    assert len(found.cos) == len(U)  # of 100 harmonics no other
    assert_allclose(np.std(a - found.u_z_ddot(t)), s, rtol=0.05)  # 4/sqrt(2 N): what was left out is the noise


@pytest.mark.parametrize("seed", range(20))
def test_noise_is_no_motion(seed):
    with pytest.raises(ValueError, match="nothing periodic stands out"):
        mdr.PeriodicMotion.from_acceleration(instants(500, 1e-3), np.random.default_rng(seed).normal(size=500), u_z0=1)


def test_one_wrong_sample_that_hides_a_motion_is_told():
    t = instants(500, 1e-3)
    a = np.sin(300 * t)
    a[123] = -9999.0
    with pytest.raises(ValueError, match=r"sample 124 lies 9999 m/s² off the others: leave it out"):
        mdr.PeriodicMotion.from_acceleration(t, a, u_z0=1e-5)


def test_friction_under_the_motion_is_that_under_the_record():
    """Sign and phase: `slide` under the motion, against `slide_record` under the depths that were accelerated.

    Chords of 1024 steps leave out (2 h)²/8 of the second harmonic, 2e-5 of the friction.
    """
    f, periods, ball, rubber = 50.0, 4, mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5)
    given = truth(f, [4e-6 * np.exp(0.7j), 3e-6j])
    t = np.arange(1024 * periods + 1) / 1024 / f
    motion = mdr.PeriodicMotion.from_acceleration(t, given.u_z_ddot(t), u_z0=U_Z0)
    assert_allclose(motion.u_z(t), given.u_z(t), rtol=0, atol=1e-15)
    run = mdr.slide(mdr.SlidingContact(ball, rubber, 0.5, motion), 1e-3)
    area = []
    for end in (-1024, None):
        found = mdr.slide_record(ball, rubber, 0.5, t[:end], 1e-3 * t[:end], u_z=given.u_z(t[:end]), n_springs=64)
        area.append(found.mean_F_z * found.t[-1] * np.array([found.cof, 1]))
    F_x, F_z = area[1] - area[0]
    assert_allclose(F_x / F_z, run.cof, rtol=0, atol=run.cof_error + periods * found.cof_error + 2e-5 * 0.5)
    turned = mdr.PeriodicMotion(motion.omega, U_Z0, tuple(-c for c in motion.cos), tuple(-s for s in motion.sin))
    other = mdr.slide(mdr.SlidingContact(ball, rubber, 0.5, turned), 1e-3)
    assert abs(other.cof - run.cof) > 1e-3  # so that a wrong sign would be seen


# --- what is told ---


def test_what_is_left_out_is_told():
    t = instants(2000, 1e-3)
    wave = np.sin(2 * np.pi * 20 * t)
    for a, given, words in [
        (wave + 0.4 * np.sin(2 * np.pi * 51.3 * t), 20.0, r"at 20 Hz leaves out 14% .*, 0% of it a linear drift"),
        (wave + t, None, r"leaves out 41% .*, 41% of it a linear drift"),
        (wave, 20.4, "or a wrong one"),
        (1e4 * wave, None, "the amplitude of the depth is 0.633 m: is a in m/s², and t in s"),
        (np.sin(2 * np.pi * 400 * t), None, "harmonics of a stand out of its noise up to half of the sampling rate, 1"),
    ]:
        with pytest.warns(mdr.PlausibilityWarning, match=words) as told:
            mdr.PeriodicMotion.from_acceleration(t, a, u_z0=1.0, frequency=given)
        assert told[0].filename == __file__


def test_an_acceleration_or_a_record_that_is_given_for_a_period_of_depth_is_told():
    period = np.cos(2 * np.pi * np.arange(50) / 50)
    with pytest.warns(mdr.PlausibilityWarning, match=r"is 30 m: is u_z an acceleration\? PeriodicMotion\.from_acc"):
        mdr.PeriodicMotion.of(30 * period, 300.0)
    with pytest.warns(mdr.PlausibilityWarning, match="u_z repeats 7 times: give one period"):
        mdr.PeriodicMotion.of(1e-3 * np.tile(period, 7), 300.0)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mdr.PeriodicMotion.of(1e-3 + 1e-3 * period, 300.0)
        mdr.PeriodicMotion.of(1e-3 * (period**2 + 0.2 * period), 300.0)  # the second is the loudest, not the only one
