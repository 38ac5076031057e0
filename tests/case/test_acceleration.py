"""Motion from an accelerometer's record: known series, noise, uneven samples, drift, and what is told."""

import warnings

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr
from mdr.case import acceleration
from mdr.case.depth_cycle import harmonic_sum
from mdr.tools.progress import Ticker

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


@pytest.mark.parametrize("U", [SERIES["sine"], SERIES["fundamental missing"]])
def test_displacement_and_velocity_tell_the_same_motion(U):
    """Each derivative of a known motion, with an offset."""
    f, t, noise = 37.13, instants(4000, 1.1e-4, 3), np.random.default_rng(1).normal(size=4000)
    given, p = truth(f, U), mdr.PeriodicMotion
    for read, values in ((p.from_displacement, given.u_z(t)), (p.from_velocity, given.u_z_dot(t)),
                         (p.from_acceleration, given.u_z_ddot(t))):  # fmt: skip
        found = read(t, values + 3 * values.std(), u_z0=U_Z0)
        assert_allclose(found.u_z(t), given.u_z(t), rtol=0, atol=1e-9 * np.abs(U).max())
        noisy = read(t, values + 1e-3 * values.std() * noise, u_z0=U_Z0, frequency=f)
        assert_allclose(noisy.u_z(t), given.u_z(t), rtol=0, atol=1e-2 * np.abs(U).max())
    with pytest.raises(ValueError, match="v: nothing periodic stands out"):
        p.from_velocity(t, noise, u_z0=1.0)
    with pytest.raises(ValueError, match=r"u must have the shape \(4000,\) of t"):
        p.from_displacement(t, noise[1:], u_z0=1.0)
    with pytest.warns(mdr.PlausibilityWarning, match=r"is v in m/s, and t in s\?"):
        p.from_velocity(t, 1e5 * given.u_z_dot(t), u_z0=U_Z0)


@pytest.mark.parametrize("n", [1, 40])
def test_sums_over_bins_are_those_over_samples(n):
    """Uneven samples, in more than one part; to the rounding of the phase, 1e-16 of some 1e4 periods."""
    rng, top = np.random.default_rng(n), 3 * n
    t = np.sort(rng.uniform(-20.0, 20.0, 2**15 + 700))
    a, x, omega = rng.normal(size=t.size), t / 40, 2 * np.pi * 123.4
    record = acceleration._Record("a", "m/s²", t, a, 40.0, Ticker("a"))
    sums, m = acceleration._sums(record, omega, top), np.arange(2 * top + 1)
    turn = np.exp(1j * np.multiply.outer(m, np.mod(omega * t, 2 * np.pi)))
    assert_allclose(sums.own, [turn.sum(1), turn @ x, turn @ x**2], rtol=0, atol=1e-10 * t.size)
    assert_allclose(sums.seen, np.conj([turn @ a, turn @ (a * x)])[:, : top + 1], rtol=0, atol=1e-10 * t.size)
    A = rng.normal(size=top) + 1j * rng.normal(size=top)
    assert_allclose(acceleration._at_samples(A, omega * t), harmonic_sum(A, omega * t), rtol=0, atol=1e-9 * top)


def test_a_long_record_takes_a_time_that_grows_as_its_samples():
    """Passes over the samples, which are all that grows; and many samples are as well known as few."""
    passes = []
    for n in (2_000, 20_000, 200_000):
        t = np.arange(n) / 5e5
        a = truth(1000.3, [1e-7, 0, 3e-9]).u_z_ddot(t) + np.random.default_rng(0).normal(0, 0.05, n)
        record = acceleration._Record("a", "m/s²", t - t.mean(), a - a.mean(), n / 5e5, Ticker("a"))
        omega = acceleration._fundamental(record)
        passes.append(record.passes.done)
        bound = np.sqrt(24 / n) * 0.05 / (1e-7 * (2 * np.pi * 1000.3) ** 2) / (2 * np.pi * n / 5e5)  # Cramér-Rao
        assert abs(omega / (2 * np.pi) - 1000.3) < 4 * bound
    assert max(passes) < 2 * min(passes) < 60


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


def test_rounded_samples_have_no_period_of_their_own():
    """100 samples a millisecond of a tone of 13 kHz are rounded alike in each millisecond."""
    t = 1e-5 * np.arange(20_000)
    a = np.round(9.8 * np.cos(2 * np.pi * 13e3 * t), 3)
    motion = mdr.PeriodicMotion.from_acceleration(t, a, u_z0=5e-6)
    assert motion.omega == pytest.approx(2 * np.pi * 13e3, rel=1e-9)
    a += np.round(0.1 * np.cos(2 * np.pi * 1e3 * t), 3)  # and this is one
    assert mdr.PeriodicMotion.from_acceleration(t, a, u_z0=5e-6).omega == pytest.approx(2 * np.pi * 1e3, rel=1e-9)
