"""The twin against definitions; the library is not imported.

Its limits, and how far it has converged, are those of the library, which agrees with it and is asked for them.
"""

import math

import numpy as np
import pytest
import reference
import reference_turning
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.special import ellipk

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


# --- friction that turns ------------------------------------------------------------------------------------

KELVIN, ARMS = (0.3, (), ()), (0.3, (1.0, 0.5), (0.3, 2.0))
FEW = {"steps": 4096, "count": 64}


def rigid_body():
    return reference_turning.Body(np.zeros(2), np.zeros(2), np.full(2, np.inf))


@pytest.mark.parametrize("depth", [0.7, 2.0])
def test_what_turns_nowhere_is_what_is_shaken_along(depth):
    x_n = [1.5 * np.exp(0.7j)]
    got = reference_turning.friction(FLAT, depth, [1.0], x_n, [], -0.4, KELVIN)
    drag, press = reference_turning.spring(-depth, [1.0], x_n, KELVIN[0], -0.4)
    assert abs(got.along - drag / press) < got.doubt < 1e-6
    assert got.across == 0
    still = reference_turning.friction(2, depth, [1.0], [], [], 0.4, **FEW)
    assert abs(still.along - reference.rigid_elastic_cof(2, depth, 0.4)) < still.doubt < 1e-5


@pytest.mark.parametrize("r", [0.3, 1.0])
def test_wide_motion_across_is_that_of_a_rigid_contact(r):
    expected = 2 / np.pi * r / math.hypot(1, r) * ellipk(1 / (1 + r**2))
    off = []
    for wide in (100.0, 400.0):
        got = reference_turning.friction(FLAT, 1.0, [0.0], [], [wide], r * wide)
        off.append(got.along - expected)
    assert 0 < 15 * off[1] < off[0] < 5e-4  # as the square of leash over amplitude


@pytest.mark.parametrize("eta", [0.3, 0.7])
def test_slow_motion_across_leaves_what_the_circle_leaves(eta):
    two, one = (
        reference_turning.friction(FLAT, 1.0, [0.0], [], [eta], v, steps=4096, most=1000).along for v in (2e-3, 1e-3)
    )
    assert_allclose(2 * one - two, math.sqrt(1 - eta**2), rtol=0, atol=2e-4)  # in v all but linear


@pytest.mark.parametrize("material", [reference_turning.ELASTIC, KELVIN, ARMS])
def test_fast_pull_leaves_half_the_mean_square_of_the_direction(material):
    y_n, v, L = [1.0, 0.5j], 80.0, reference_turning.Material(*material)
    n = np.arange(1, 3)
    theta = 1j * n * y_n / (v + 1j * n / np.array([reference_turning.response(L, one) for one in n]))
    got = reference_turning.friction(FLAT, 1.0, [0.0], [], y_n, v, material, **FEW)
    assert_allclose(1 - got.along, 0.25 * np.sum(np.abs(theta) ** 2), rtol=2 / v**2 + 5e-4)


@pytest.mark.parametrize("yields", [False, True])
@pytest.mark.parametrize("material", [reference_turning.ELASTIC, KELVIN, ARMS])
def test_no_direction_is_special(material, yields):
    """All that moves in the plane turned by an angle turns the forces, to rounding."""
    twin, angle = reference_turning, 0.7
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    L = twin.Material(material[0], *(np.array(one) for one in material[1:]))
    row, motion = twin.springs(2, 0.8, (0.0, 1.8), 32), twin.motion_of([1.0], [0.5j, 0.2], [2.0, 0.3j], 0.5, 256)
    body = twin.Body(*(np.full(2, one) for one in (0.8, 0.5, 1.2))) if yields else rigid_body()
    turned = motion._replace(u=np.ascontiguousarray(turn @ motion.u), v=turn @ motion.v)
    state = twin.at_rest(row, L, motion, body)
    other = twin.State(*(np.array(one) for one in state))
    other.x[:2], other.y[:] = turn @ state.x[:2], turn @ state.y
    for _ in range(5):
        one, two = twin.period(row, L, motion, body, state), twin.period(row, L, turned, body, other)
        assert_allclose(two, [*(turn @ one[:2]), one[2]], rtol=0, atol=1e-13)


@pytest.mark.parametrize("depth", [0.9, 2.0])
def test_body_moved_both_ways_agrees_with_an_adaptive_integrator(depth):
    """One spring with a dashpot, in contact and free, that turns under a body."""
    T, v, x_n, y_n = 0.6, 0.5, 0.5j, 1.5
    (M, C, K), (_, C_y, K_y) = bodies = (0.8, 0.5, 1.2), (0.8, 0.7, 0.6)
    mass, damping, spring = np.full(2, M), np.array([C, C_y]), np.array([K, K_y])
    on, off = (float(t[0]) for t in reference.contact_times([depth], T))

    def rate(t, q, touches):
        e, y, y_dot = q[0:2], q[2:4], q[4:6]
        load = max(depth + math.cos(t) - T * math.sin(t), 0.0) if touches else 0.0
        shake = np.array([(1j * x_n * np.exp(1j * t)).real, (1j * y_n * np.exp(1j * t)).real])
        trial = e + T * (np.array([v, 0.0]) + shake + y_dot)
        force = trial * min(1.0, load / np.hypot(*trial))
        return np.concatenate([(force - e) / T, y_dot, -(spring * y + damping * y_dot + force) / mass, force])

    q = np.array([0.1, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    for k in range(20):
        before = q[6:].copy()
        for start, stop, touches in ((on, off, True), (off, on + 2 * np.pi, False)):
            knobs = {"method": "DOP853", "rtol": 1e-8, "atol": 1e-10, "max_step": 0.05 if k == 19 else 0.3}
            if stop > start:
                q = solve_ivp(rate, (start, stop), q, args=(touches,), **knobs).y[:, -1]
    mean = (q[6:] - before) / (2 * np.pi * reference.mean_force(FLAT, depth, T))
    got = reference_turning.friction(FLAT, depth, [1.0], [x_n], [y_n], v, (T, (), ()), *bodies)
    assert_allclose([got.along, got.across], mean, rtol=0, atol=3e-7)  # steps that cut through kinks
    assert got.doubt < 3e-7
