"""The body over a step: the oscillator itself under a force that is linear in a step, and its harmonics."""

import math
from dataclasses import replace

import numpy as np
import pytest
from kernels import marched
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.linalg import expm

import mdr
from mdr.march.dynamics.body import body_of, harmonics_of, light_harmonics_of, pushed
from mdr.march.dynamics.body_step import next_place
from mdr.march.periodic.steady import BUDGET, Resolution, at_hand
from mdr.spring.law import law_of

N = 64
H = 2 * np.pi / N
#: M, C, K
BODIES = {
    "undamped": (0.3, 0.0, 0.7),
    "damped": (0.3, 0.15, 0.7),
    "overdamped": (2.0, 9.0, 0.7),
    "soft": (0.3, 0.01, 0.05),
    "free": (0.3, 0.0, 0.0),
}


def answered(body, state, area, moment):
    """The state a step later."""
    return np.array(body.free) @ state - np.array(body.area) * area - np.array(body.moment) * moment


@pytest.mark.parametrize(("M", "C", "K"), BODIES.values(), ids=BODIES)
def test_a_force_that_is_linear_in_the_step_is_answered_exactly(M, C, K):
    body, (f, g), start = body_of(M, C, K, law_of(0.0), H, ringing=0.0), (0.8, -3.0), [0.2, -0.5]

    def rate(t, x):
        return [x[1], -(f + g * t + C * x[1] + K * x[0]) / M]

    exact = solve_ivp(rate, (0, H), start, rtol=1e-12, atol=1e-14, method="DOP853").y[:, -1]
    now = answered(body, start, f * H + g * H**2 / 2, f * H**2 / 2 + g * H**3 / 3)
    assert_allclose(now, exact, rtol=1e-11)


@pytest.mark.parametrize("at", [0.0, 0.3, 1.0])
def test_an_impulse_changes_the_momentum_wherever_in_the_step_it_acts(at):
    """And the way by what is left of the step: of a free mass area and moment tell all."""
    M = 0.3
    body = body_of(M, 0.0, 0.0, law_of(0.0), H, ringing=0.0)
    assert_allclose(answered(body, [0.0, 0.0], 1.0, at * H), [-(1 - at) * H / M, -1 / M], atol=1e-14)


@pytest.mark.parametrize("T", [0.0, 0.5])
@pytest.mark.parametrize("arm", [(), (2.0,)])
def test_the_stiffness_of_springs_that_stick_is_the_derivative_of_what_they_take(T, arm):
    """Newton's method of a step rests on it: from ends (y, y') springs are held on a parabola, and answer by L."""
    law = law_of(T, arm, (0.4,) * len(arm))
    body = body_of(0.3, 0.1, 0.7, law, H, ringing=0.0)
    t, weight = np.polynomial.legendre.leggauss(24)
    t, weight = H * (t + 1) / 2, H * weight / 2
    for column, (y, rate) in enumerate(((1.0, 0.0), (0.0, 1.0))):
        q = rate / (2 * H)
        p = y / H - q * H
        force = p * t + q * t**2 + T * (p + 2 * q * t)
        for rho in arm:  # x_j' = x' - x_j/theta, from rest
            u, w = np.polynomial.legendre.leggauss(24)
            for k, end in enumerate(t):
                past, share = end * (u + 1) / 2, end * w / 2
                force[k] += rho * float(share @ ((p + 2 * q * past) * np.exp(-(end - past) / 0.4)))
        taken = np.outer([weight @ force, weight @ (t * force)], [1, 1]) * [body.area, body.moment]
        assert_allclose(np.array(body.stuck)[:, column], taken.sum(axis=0), rtol=1e-9)


@pytest.mark.parametrize(("M", "C", "K"), list(BODIES.values())[1:4], ids=list(BODIES)[1:4])
def test_harmonics_repeat_themselves_under_the_steps(M, C, K):
    rng = np.random.default_rng(3)
    area, moment = H * rng.normal(size=N), H**2 / 2 * rng.normal(size=N)
    body = body_of(M, C, K, law_of(0.0), H, ringing=0.0)
    motion, resonant = harmonics_of(body, np.fft.rfft(area), np.fft.rfft(moment))
    assert not resonant.any()
    y = np.fft.irfft(motion, N)
    for k in range(N):
        assert_allclose(answered(body, y[:, k], area[k], moment[k]), y[:, (k + 1) % N], atol=1e-12 * np.abs(y).max())


@pytest.mark.parametrize("n", [1, 3])
def test_an_undamped_resonance_is_named(n):
    body = body_of(0.3, 0.0, 0.3 * n**2, law_of(0.0), H, ringing=0.0)
    force = np.fft.rfft(H * np.cos(n * H * np.arange(N)))
    motion, resonant = harmonics_of(body, force, H / 2 * force)
    assert np.flatnonzero(resonant).tolist() == [n]
    assert np.all(np.isfinite(motion))
    assert_allclose(motion[:, n], 0)


def light_motion(M, C, K, n, harmonic=1):
    """Amplitude of a light body under cos(harmonic t), in n steps."""
    h = 2 * np.pi / n
    body, t, i = body_of(M, C, K, law_of(0.0), h, ringing=math.inf), h * np.arange(n), harmonic
    areas, ends = (np.sin(i * (t + h)) - np.sin(i * t)) / i, np.cos(i * (t + h))
    motion, resonant = light_harmonics_of(body, np.fft.rfft(areas), np.fft.rfft(ends))
    assert not resonant.any()
    return motion[:, harmonic] / (n / 2)


@pytest.mark.parametrize("C", [0.0, 0.4, 5.0])
def test_a_body_without_mass_is_of_third_order(C):
    K, errors = 0.7, []
    for n in (N, 4 * N):
        exact = -1 / (K + 3j * C) * np.array([1, 3j])
        errors.append(np.abs(light_motion(0.0, C, K, n, 3) - exact) / np.abs(exact))
    assert errors[1][0] < 1e-14 or errors[1][0] < errors[0][0] / 50  # 64, less a little for the next order
    assert errors[1][1] < errors[0][1] / 14  # its rate is of second order
    assert errors[1][0] < 1e-5


def test_a_mass_that_is_not_resolved_goes_with_the_force():
    """Its own oscillation, of two steps here, dies out; the response to the drive is right."""
    M, K = 1e-4, 0.7
    assert_allclose(light_motion(M, 0.0, K, N)[0], -1 / (K - M), rtol=1e-5)


def light(indenter, tau, u_z0=5e-6, du_z=8e-6, k_x=2e4):
    """A contact under a body without mass."""
    material, motion = mdr.KelvinVoigt(E=3e6, nu=0.5, tau=tau), mdr.NormalOscillation(u_z0, du_z, 314.0)
    return mdr.SlidingContact(indenter, material, 0.5, motion, mdr.SpringPull(k_x=k_x, m=0.0, c_x=0.0))


LIGHT = {
    "in flight": light(mdr.Paraboloid(5e-3), 0.0),
    "thrown as a flat touches": light(mdr.FlatPunch(1e-3), 2e-3),
    "on a soft spring": light(mdr.FlatPunch(1e-3), 2e-3, k_x=2e2),
    "thrown by each spring": light(mdr.Paraboloid(5e-3), 8e-3),
    "always in contact": light(mdr.Paraboloid(5e-3), 2e-3, 20e-6, 6e-6),
}


@pytest.mark.parametrize("steps", [256, 2048])
@pytest.mark.parametrize("case", LIGHT.values(), ids=LIGHT)
def test_every_step_of_a_light_body_is_solved(case, steps):
    """Newton's method alone leaves some of each: of a body in flight, whose force is zero, and of one that jolts."""
    _, scaled = at_hand(case, Resolution(64, steps, "full_slip", True))
    for v in (0.05, 0.3, 0.8):
        assert scaled.body.light
        assert marched(scaled, v, 2)[-1]


@pytest.mark.parametrize("tau", [1e-3, 1e-2])
def test_a_pull_far_softer_than_the_contact_has_a_limit(tau):
    """Body and spring of 1e-5 to 1e-8 of the stiffness of a damped contact, at one share of v_c: the dashpots stop so
    light a body within a step, and its mass does not matter any more.
    """
    contact = mdr.SlidingContact(
        mdr.Paraboloid(5e-3), mdr.KelvinVoigt(3e6, 0.5, tau), 0.5, mdr.NormalOscillation(20e-6, 8e-6, 300.0)
    )
    runs = []
    for k_x in contact.k_xc * np.array([1e-5, 1e-6, 1e-8]):
        case = replace(contact, pull=mdr.SpringPull(k_x, k_x / (0.4 * contact.omega) ** 2))
        v_0 = 0.3 * mdr.critical_velocity(case)
        runs.append(mdr.slide(case, v_0, steps_per_period=2048, n_springs=64))
    assert all(run.settled and run.cof_error < 5e-5 * case.mu_0 for run in runs)
    assert max(run.n_periods for run in runs) < 2000
    cofs = [run.cof for run in runs]
    assert np.ptp(cofs) < 1e-4 * case.mu_0


def on_slow_dashpots(T):
    """A body on a spring pull, on Kelvin springs of this omega tau, shaken along and across."""
    vibration = mdr.NormalOscillation(20e-6, 15e-6, 300.0)
    shake = mdr.InPlaneOscillation(300.0, 3e-6, 1.0, 4e-6, 2.0)
    case = mdr.SlidingContact(mdr.Paraboloid(5e-3), mdr.KelvinVoigt(3e6, 0.4, T / 300), 0.4, vibration, shake=shake)
    k = 0.8 * case.k_xc
    return replace(case, pull=mdr.SpringPull(k, k / 200.0**2, 0.1 * k / 300, k_y=k, c_y=0.1 * k / 300))


@pytest.mark.parametrize("T", [10.0, 50.0, 200.0])
def test_steps_resolve_how_slow_dashpots_stop_a_body_whose_friction_turns(T):
    """Within a step of the length of old, body and springs did not find each other."""
    case = on_slow_dashpots(T)
    run = mdr.slide(case, 0.5 * case.unit_velocity)
    assert run.settled
    assert run.cof_error < BUDGET * case.mu_0
    fine = mdr.slide(case, 0.5 * case.unit_velocity, n_springs=run.n_springs, steps_per_period=2 * run.steps_per_period)
    assert (run.cof, run.cof_y) == pytest.approx((fine.cof, fine.cof_y), abs=run.cof_error)


def test_a_pull_without_mass_is_the_limit_of_small_masses_where_friction_turns_on_dashpots():
    """What slip along one direction does to the other decides there; without it no step was found."""
    case, runs = on_slow_dashpots(0.3), []
    for m in (0.0, 0.0025, 0.005):  # times k/omega**2: the limit is linear in it
        one = replace(case, pull=replace(case.pull, m=m * case.pull.k_x / 300.0**2))
        runs.append(mdr.slide(one, 0.5 * case.unit_velocity))
        assert runs[-1].settled
        assert runs[-1].cof_error < BUDGET * case.mu_0
    none, half, full = ((run.cof, run.cof_y) for run in runs)
    assert none == pytest.approx(2 * np.array(half) - full, abs=sum(run.cof_error for run in runs) + 2e-5 * case.mu_0)
    assert np.abs(np.subtract(none, full)).max() > 1e-4 * case.mu_0


def test_a_body_that_no_step_resolves_ends_at_once_and_says_why():
    case = on_slow_dashpots(1e5)
    run = mdr.slide(case, 0.5 * case.unit_velocity)
    assert (run.settled, run.cof_error) == (False, 2 * case.mu_0)
    assert "was not found: raise steps_per_period, or hold the indenter rigidly" in run.why
    assert run.n_periods < 100


@pytest.mark.parametrize("start", ["in flight", "thrown as a flat touches", "thrown by each spring"])
def test_a_step_is_cut_at_a_touch_and_no_rounding_of_that_time_matters(start):
    _, scaled = at_hand(LIGHT[start], Resolution(16, 24, "full_slip", True))
    flight, motions = scaled.normal.flight.copy(), []
    for change in (1 - 1e-12, 1.0, 1 + 1e-12):
        scaled.normal.flight[:] = change * flight
        other = replace(scaled)  # which has not been put in numbers yet
        vars(other)["normal"] = scaled.normal
        _, trace, solved = marched(other, 0.3, 2)
        assert solved
        motions.append(trace.u)
    assert flight.any()
    assert_allclose(motions[::2], [motions[1]] * 2, rtol=0, atol=1e-10)


@pytest.mark.parametrize("at", [-3.0, 0.0, 1e-9, 7e2])
def test_a_zero_beside_a_kink_is_found_from_afar(at):
    def f(x):
        return min(3.0 * (x - at), 1e-3 * (x - at)) + 1e-2 * np.tanh(x - at)

    x, ends = 0.5, np.full(4, np.nan)
    for _ in range(60):
        if abs(f(x)) <= 1e-13 * (1 + abs(at)):
            break
        x = float(next_place.py_func(x, f(x), 4.0, ends))
    assert_allclose(x, at, rtol=0, atol=1e-13 * (1 + abs(at)) / 1.1e-2)  # over the least slope beside the zero


def test_a_pushed_body_is_a_matrix_exponential():
    """Over- and underdamped, critical, without spring or damper; c and k over many decades."""
    rng = np.random.default_rng(8)
    for i in range(300):
        c, k = 10.0 ** rng.uniform(-12, 1.5), 10.0 ** rng.uniform(-12, 0.5)
        if i % 4 == 0:
            c = 2 * np.sqrt(k) * (1 + rng.choice([-1, 0, 1]) * 10.0 ** rng.uniform(-16, -1))
        c, k = c * (i % 7 > 0), k * (i % 5 > 0)
        move = expm(np.array([[0, 1, 0, 0], [-k, -c, 1, 0], [0, 0, 0, 1], [0, 0, 0, 0]]))
        expected = [move[0, 1], move[0, 2], move[0, 3], move[0, 0], move[1, 1]]
        assert_allclose(pushed(c, k), expected, rtol=0, atol=1e-14)


def test_a_pushed_body_in_treacle_creeps_and_one_on_a_stiff_spring_rings():
    assert_allclose(pushed(1e12, 0.0), [1e-12, 1e-12, 0.5e-12, 1.0, 0.0], rtol=1e-11, atol=1e-20)
    w = 1e3  # way sin(w)/w, and what is left of its integrals
    expected = [np.sin(w) / w, (1 - np.cos(w)) / w**2, (1 - np.sin(w) / w) / w**2, np.cos(w), np.cos(w)]
    assert_allclose(pushed(0.0, w**2), expected, rtol=0, atol=1e-14)
