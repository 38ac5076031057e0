"""The twin against definitions; the library is not imported.

Its limits, and how far it has converged, are those of the library, which agrees with it and is asked for them.
"""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from twins import rigid_pull as reference
from twins import turning as twin
from twins.tiny_steps import State, period

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


# --- friction that turns ------------------------------------------------------------------------------------

KELVIN, ARMS = (0.3, (), ()), (0.3, (1.0, 0.5), (0.3, 2.0))
FEW = {"steps": 4096, "count": 64}


@pytest.mark.parametrize("depth", [0.7, 2.0])
def test_what_turns_nowhere_is_what_is_shaken_along(depth):
    x_n = [1.5 * np.exp(0.7j)]
    got = twin.friction(FLAT, depth, [1.0], x_n, [], -0.4, KELVIN)
    drag, press = twin.spring(-depth, [1.0], x_n, KELVIN[0], -0.4)
    assert abs(got.along - drag / press) < got.doubt < 1e-6
    assert got.across == 0
    still = twin.friction(2, depth, [1.0], [], [], 0.4, **FEW)
    assert abs(still.along - reference.rigid_elastic_cof(2, depth, 0.4)) < still.doubt < 1e-5


@pytest.mark.parametrize("yields", [False, True])
@pytest.mark.parametrize("material", [twin.ELASTIC, KELVIN, ARMS])
def test_no_direction_is_special(material, yields):
    """All that moves in the plane turned by an angle turns the forces, to rounding."""
    angle = 0.7
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    L = twin.Law(material[0], *(np.array(one) for one in material[1:]))
    row, motion = twin.springs(2, 0.8, (0.0, 1.8), 32), twin.motion_of([1.0], [0.5j, 0.2], [2.0, 0.3j], 0.5, 256)
    body = twin.Body(*(np.full(2, one) for one in ((0.8, 0.5, 1.2) if yields else twin.RIGID)))
    turned = motion._replace(u=np.ascontiguousarray(turn @ motion.u), v=turn @ motion.v)
    state = twin.at_rest(row, L, motion, body)
    other = State(*(np.array(one) for one in state))
    other.q[0, :2], other.y[:] = turn @ state.q[0, :2], turn @ state.y
    for _ in range(5):
        one, two = period(row, L, motion, body, state), period(row, L, turned, body, other)
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
    got = twin.friction(FLAT, depth, [1.0], [x_n], [y_n], v, (T, (), ()), *bodies)
    assert_allclose([got.along, got.across], mean, rtol=0, atol=3e-7)  # steps that cut through kinks
    assert got.doubt < 3e-7
