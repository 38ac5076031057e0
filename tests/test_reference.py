"""The twin against closed forms, limits and its own refinement; the library is not imported."""

import math

import numpy as np
import pytest
import reference
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

FLAT = math.inf
SHAPES = [FLAT, 1, 2, 4]
BODY = 0.7, 1.6, reference.damping_for(0.07, 0.7, 1.6)  # k_ratio, omega_0_ratio, c_ratio


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


def test_deficit_ends_at_1_and_0():
    # psi falls from 1 with slope -pi: 2 pi v_hat in a period of stick, on average half of it
    assert_allclose((1 - reference.flat_punch_deficit(1e-6)) / 1e-6, np.pi, rtol=1e-2)
    assert_allclose(reference.flat_punch_deficit(1 - 1e-6), 0, atol=1e-11)


@pytest.mark.parametrize("n", SHAPES)
@pytest.mark.parametrize("depth_ratio", [-0.5, 0.0, 0.6, 3.0])
def test_rigid_pull_slides_fully_at_and_above_v_c(n, depth_ratio):
    for T in (0.0, 0.3, 3.0):
        v_c = reference.full_slip_critical_velocity(n, depth_ratio, T)
        cof = _rigid_cof(n, depth_ratio, T)
        assert_allclose(cof(v_c * (1 + 1e-9)), 1, rtol=0, atol=1e-12)
        assert 1e-7 < 1 - cof(0.97 * v_c) < 0.2


def test_a_slow_material_that_touches_late_lowers_v_c():
    on, _ = reference.contact_times([0.0], 3.0)
    v_c = reference.full_slip_critical_velocity(2, 0.0, 3.0)
    assert on[0] > 1.5 * np.pi
    assert_allclose(v_c, -math.sin(on[0]), rtol=1e-15)


@pytest.mark.parametrize(
    ("n", "depth_ratio", "T"),
    [(n, depth_ratio, T) for n in SHAPES for depth_ratio, T in ((1.0, 0.0), (30.0, 0.0), (1.0, 3.0))]
    + [(2, 3.0, 0.3), (FLAT, 3.0, 0.3)],
)
def test_rigid_pull_tends_to_the_static_value(n, depth_ratio, T):
    """The rise goes with v_hat where the material is elastic or contact is lost, else with v_hat**(2/3)."""
    static, cof = reference.static_cof(n, depth_ratio, T), _rigid_cof(n, depth_ratio, T)
    power = 1 if T == 0 or static == 0 else 2 / 3
    rise = cof(1e-5) - static, cof(1e-6) - static
    assert 0 < rise[1] < 4e-4
    # the next order of the series is a factor v_hat**(1/3) smaller, so a few per cent are left
    assert_allclose(math.log10(rise[0] / rise[1]), power, atol=0.02)


@pytest.mark.parametrize(("n", "depth_ratio", "v_hat"), [(1, 0.5, 0.4), (2, 3.0, 0.1), (FLAT, 0.3, 0.3)])
def test_kelvin_tends_to_elastic_with_the_square_of_T(n, depth_ratio, v_hat):
    elastic = reference.rigid_elastic_cof(n, depth_ratio, v_hat)
    gap = [elastic - reference.rigid_kelvin_cof(n, depth_ratio, v_hat, T) for T in (0.02, 0.01)]
    assert 0 < gap[1] < 2e-5
    assert_allclose(gap[0] / gap[1], 4, rtol=0.02)  # 4 with corrections of order T


def test_rigid_pull_is_converged():
    for n, depth_ratio, v_hat in [(1, 0.6, 0.02), (2, -0.4, 0.3), (4, 30.0, 0.9)]:
        coarse = reference.rigid_elastic_cof(n, depth_ratio, v_hat)
        assert_allclose(coarse, reference.rigid_elastic_cof(n, depth_ratio, v_hat, 80, 5), rtol=0, atol=1e-12)
        for T in (0.01, 30.0):
            coarse = reference.rigid_kelvin_cof(n, depth_ratio, v_hat, T)
            fine = reference.rigid_kelvin_cof(n, depth_ratio, v_hat, T, 28, 8)
            assert_allclose(coarse, fine, rtol=0, atol=1e-11)


# --- full slip ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("body", [BODY, (0.3, 0.8, 0.0), (5.0, 2.5, 0.4)])
@pytest.mark.parametrize("T", [0.0, 0.3, 1.0])
def test_flat_punch_has_eq_15(T, body):
    got = reference.full_slip_critical_velocity(FLAT, 3.0, T, *body)
    assert_allclose(got, reference.eq_15(T, *body), rtol=1e-9)


@pytest.mark.parametrize(("n", "depth_ratio", "T"), [(1, 3.0, 0.0), (2, 0.6, 0.0), (2, 3.0, 1.0), (4, 30.0, 0.3)])
def test_v_c_is_the_sum_over_harmonics(n, depth_ratio, T):
    k, omega_0, c = BODY
    size = 1 << 14
    t = np.arange(size) * 2 * np.pi / size
    i = np.fft.fftfreq(size, 1 / size)
    force = np.fft.fft(reference.full_slip_force(t, n, depth_ratio, T))
    y = -force / (k - k / omega_0**2 * i**2 + 1j * i * c)
    slip = -np.sin(t) - np.fft.ifft(1j * i * y).real
    slip = slip[depth_ratio + np.cos(t) > 0]
    # the nearest sample misses the maximum by slip'' dt**2 / 8, at most 1e-7 here
    assert_allclose(reference.full_slip_critical_velocity(n, depth_ratio, T, *BODY), slip.max(), atol=2e-7)


@pytest.mark.parametrize(("n", "depth_ratio", "T"), [(4, 0.6, 3.0), (1, 1.0, 1.0), (2, 3.0, 0.0), (FLAT, 0.5, 1.0)])
def test_mean_force_over_time_is_that_over_springs(n, depth_ratio, T):
    on, off = (float(t[0]) for t in reference.contact_times([depth_ratio], T))
    cuts = sorted({0.0, np.pi - math.atan(T), on, off, 2 * np.pi})
    cuts = [t for t in cuts if on <= t <= off]
    t, dt = reference.gauss_panels(reference.graded(cuts, 0.1, 9), 16)
    over_time = reference.full_slip_force(t, n, depth_ratio, T) @ dt / (2 * np.pi)
    assert_allclose(over_time, reference.mean_force(n, depth_ratio, T), rtol=1e-10)


def test_static_cof_of_flat_punch_is_eq_7():
    assert_allclose(reference.static_cof(FLAT, 3.0, 1.0), 1 - math.sqrt(2) / 3, rtol=1e-12)
    assert reference.static_cof(FLAT, 1.4, 1.0) == 0


# --- spring pull --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("n", "depth_ratio", "T"), [(2, 3.0, 0.0), (2, 3.0, 1.0), (FLAT, 2.0, 0.3), (1, 1.5, 3.0)])
def test_a_very_stiff_spring_is_a_rigid_pull(n, depth_ratio, T):
    k, omega_0 = 1e6, 30.0
    *_, cof = reference.spring_pull_run(
        n, depth_ratio, 0.4, T, k, omega_0, reference.damping_for(0.5, k, omega_0), n_nodes=40, steps=(512,)
    )
    # the give of the spring changes the COF by up to 1.4 / k_ratio; springs and steps by 1e-6
    assert_allclose(cof, _rigid_cof(n, depth_ratio, T)(0.4), rtol=0, atol=1.4e-6 + 1e-6)


@pytest.mark.parametrize("n", [2, FLAT])
def test_spring_pull_slides_fully_above_v_c_and_not_below(n):
    for T in (0.0, 1.0):
        v_c = reference.full_slip_critical_velocity(n, 3.0, T, *BODY)
        *_, cof = reference.spring_pull_run(n, 3.0, v_c * np.array([0.95, 1.003]), T, *BODY, n_nodes=16, steps=(256,))
        # above v_c nothing but the trapezoidal mean of N is left: dt**2 / 12 times a jump of slope below 1
        assert_allclose(cof[1], 1, rtol=0, atol=2e-5 if T == 0 else 1e-9)
        assert 1e-3 < 1 - cof[0] < 0.05


@pytest.mark.parametrize(("n", "T", "steps"), [(1, 0.0, 256), (4, 1.0, 128)])
def test_spring_pull_is_converged(n, T, steps):
    v_hat = 0.4 * reference.full_slip_critical_velocity(n, 3.0, T, *BODY)
    knobs = {"n_nodes": 32, "steps": (steps, 2 * steps, 4 * steps)}
    coarse, error = reference.spring_pull_cof(n, 3.0, v_hat, T, *BODY, **knobs)
    *_, fine = reference.spring_pull_run(n, 3.0, v_hat, T, *BODY, n_nodes=56, steps=(steps, 6 * steps))
    assert error < 5e-5
    assert abs(coarse - fine[0]) < error + 1e-6  # what is left in the finer run


@pytest.mark.parametrize("T", [0.0, 1.0])
def test_the_start_is_forgotten(T):
    v_hat = np.array([0.6, 1.5])
    knobs = {"n_nodes": 16, "steps": (256,)}
    full_slip, rest = (
        reference.spring_pull_run(2, 3.0, v_hat, T, *BODY, **knobs, start=start)[-1] for start in ("full_slip", "rest")
    )
    assert_allclose(rest, full_slip, rtol=0, atol=1e-8)


@pytest.mark.parametrize("T", [0.0, 1.0])
def test_pulling_back_mirrors_pulling_forward(T):
    knobs = {"n_nodes": 16, "steps": (256,), "start": "rest"}
    one, other = (reference.spring_pull_run(2, 3.0, v_hat, T, *BODY, **knobs)[-1] for v_hat in (1.1, -1.1))
    assert_allclose(other, -one, rtol=1e-12)


def test_a_small_relaxation_time_joins_the_two_integrators():
    zero, one, two = (
        reference.spring_pull_run(2, 3.0, 1.5, T, *BODY, n_nodes=12, steps=(256,))[-1][0] for T in (0.0, 0.015, 0.03)
    )
    assert_allclose(2 * one - two, zero, rtol=0, atol=4 * abs(two - zero) ** 2 + 1e-5)  # COF(T) is smooth


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


def _rigid_cof(n, depth_ratio, T):
    if T == 0:
        return lambda v_hat: reference.rigid_elastic_cof(n, depth_ratio, v_hat)
    return lambda v_hat: reference.rigid_kelvin_cof(n, depth_ratio, v_hat, T)
