"""The scaled form: groups are all that is left, the recursion is the oscillator, the full-slip start repeats itself."""

import math
from dataclasses import replace

import numpy as np
import pytest
from conftest import SHAPES, contact
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

import mdr
from mdr.march import kernels
from mdr.march.dimensionless import RESOLVED, ScaledContact, fast_ratio

STEPS = 256
BODIES = {
    "undamped": {"k_ratio": 0.7, "omega_0_ratio": 1.6, "c_ratio": 0.0},
    "damped": {"k_ratio": 0.7, "omega_0_ratio": 1.6, "c_ratio": 0.15},
    "overdamped": {"k_ratio": 0.7, "omega_0_ratio": 0.6, "c_ratio": 9.0},
    "soft": {"k_ratio": 0.05, "omega_0_ratio": 0.4, "c_ratio": 0.01},
}


def scaled_of(*groups, steps=STEPS, n_springs=32, lump=False, **knobs):
    case = contact(*groups, **knobs)
    return ScaledContact.of(case, mdr.SpringArray.of(case, n_springs), steps, lump)


def advance(scaled, y, S):
    """Run the recursion on a given force; y holds two values to begin with, S one value a step."""
    a_1, a_2, b_1, b_0, b_m = scaled.body[2:7]
    y = list(y)
    for k in range(1, len(S) - 1):
        y.append(a_1 * y[-1] + a_2 * y[-2] - (b_1 * S[k + 1] + b_0 * S[k] + b_m * S[k - 1]))
    return np.array(y)


def marched(scaled, v, n_steps, held, body):
    """March from full slip; returns extensions at the end and the trace. held is updated."""
    s = scaled.normal.s
    e, nothing = s.copy(), np.empty((0, *s.shape))
    trace = kernels.Trace(np.empty(n_steps), np.empty(n_steps), nothing, nothing)
    springs = scaled.springs._replace(lump_margin=-np.inf)
    kernels.march(e, s.copy(), held, body, springs, scaled.motion(v), scaled.table, 0, trace)
    return e, trace


# --- what the groups are ---


def test_scaled_motion_and_springs():
    case = contact("paraboloid", 3.0, 0.5)
    springs = mdr.SpringArray.of(case, 40)
    scaled = ScaledContact.of(case, springs, STEPS, lump=False)
    t = scaled.h * np.arange(STEPS + 1) / case.oscillation.omega
    u_z = case.oscillation.u_z0 + scaled.z * scaled.length_z
    assert_allclose(u_z, case.oscillation.u_z(t), rtol=1e-14)
    assert_allclose(
        scaled.z_dot * scaled.length_z * scaled.omega, case.oscillation.u_z_dot(t), rtol=0, atol=1e-14 * 6e-4
    )
    assert_allclose(scaled.gap * scaled.length_z, springs.gap, rtol=1e-15)
    assert_allclose(scaled.w.sum(), 1, rtol=1e-14)
    assert_allclose(scaled.w * scaled.stiffness_z, springs.dk_z, rtol=1e-13)
    assert_allclose(scaled.w * scaled.stiffness_x, springs.dk_x, rtol=1e-13)
    nu = case.material.nu
    assert_allclose(
        scaled.speed, case.mu_0 * (2 - nu) / (2 * (1 - nu)) * case.oscillation.omega * case.oscillation.du_z, rtol=1e-14
    )  # Eq. (1)
    assert scaled.steps == STEPS


def test_body_groups_are_those_of_the_oscillator():
    case = contact("paraboloid", 3.0, 0.5, 0.7, 1.6, 0.15)
    scaled = ScaledContact.of(case, mdr.SpringArray.of(case, 32), STEPS, lump=False)
    omega, unit = case.oscillation.omega, scaled.stiffness_x
    assert_allclose(
        [scaled.M, scaled.C, scaled.K], np.array([case.pull.m * omega**2, case.pull.c_x * omega, case.pull.k_x]) / unit
    )
    assert_allclose(math.sqrt(scaled.K / scaled.M), 1.6, rtol=1e-13)


@pytest.mark.parametrize("shape", SHAPES)
def test_friction_and_moduli_drop_out(shape):
    groups = shape, 3.0, 0.5, 0.7, 1.6, 0.15
    one = scaled_of(*groups)
    for change in ({"mu_0": 0.01}, {"E": 3e11}, {"nu": 0.1}, {"omega": 1e6}):
        other = scaled_of(*groups, **change)
        for name in ("gap", "w", "z", "z_dot", "T", "M", "C", "K"):
            assert_allclose(getattr(other, name), getattr(one, name), rtol=1e-11, err_msg=name)
        assert_allclose(other.body[2:7], one.body[2:7], rtol=1e-11)  # 1/b of the body cancels


@pytest.mark.parametrize("shape", ["cone", "paraboloid", "r4"])
def test_lumping_keeps_the_sums(shape):
    case = contact(shape, 3.0, 0.5)
    springs = mdr.SpringArray.of(case, 64)
    whole, lumped = (ScaledContact.of(case, springs, STEPS, lump) for lump in (False, True))
    assert springs.n_core > 1
    assert lumped.n_lumped == springs.n_core
    assert lumped.gap.size == 64 - springs.n_core + 1
    assert_allclose(lumped.w.sum(), 1, rtol=1e-14)
    assert_allclose(lumped.w @ lumped.gap, whole.w @ whole.gap, rtol=1e-13)
    # the outermost spring of the core may slip backward when L[e + s] of the lumped one is below twice their distance
    assert_allclose(lumped.lump_margin, 2 * (springs.gap[springs.n_core - 1] / 2e-6 - lumped.gap[0]), rtol=1e-12)


def test_nothing_to_lump():
    for groups in (("paraboloid", 0.6), ("paraboloid", -0.5)):
        scaled = scaled_of(*groups, lump=True)
        assert scaled.n_lumped == 1
        assert scaled.lump_margin == -np.inf


def test_fast_ratio():
    assert fast_ratio(contact("paraboloid")) == 0
    assert math.isinf(fast_ratio(contact("paraboloid", 3.0, 0.0, 0.7, math.inf)))
    # flat punch: omega_1**2/omega_0**2 = (k_x + k_xc)/k_x
    assert_allclose(fast_ratio(contact("flat", 3.0, 0.0, 0.7, 1.6)), 1.6 * math.sqrt(1.7 / 0.7), rtol=1e-13)


def on_an_arm(ratio, time):
    """A flat punch on an arm of `ratio` times the static stiffness that relaxes within `time` of 1/omega; M = K = 1."""
    arm = mdr.StandardLinearSolid(3e6, ratio * 3e6, time / 300.0, 0.4)
    case = mdr.SlidingContact(SHAPES["flat"][0], arm, 0.4, mdr.NormalOscillation(6e-6, 2e-6, 300.0))
    return replace(case, pull=mdr.SpringPull(case.k_xc, case.k_xc / 300.0**2))


@pytest.mark.parametrize("ratio", [2.0, 1e4, 1e6])
def test_fast_ratio_has_the_arms_that_do_not_relax_in_that_oscillation(ratio):
    assert_allclose(fast_ratio(on_an_arm(ratio, 1e3)), math.sqrt(2 + ratio), rtol=1e-6)
    assert_allclose(fast_ratio(on_an_arm(ratio, 1e-3 / ratio)), math.sqrt(2), rtol=1e-6)


@pytest.mark.parametrize("time", [0.01, 0.1, 1.0])
def test_fast_ratio_is_a_resonance_on_the_storage_modulus(time):
    case = on_an_arm(30.0, time)
    fast = fast_ratio(case)
    assert_allclose(fast**2, 1 + case.rheology.response(fast).real, rtol=1e-6)


# --- the recursion ---


@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
def test_free_oscillation_is_exact(body):
    scaled = scaled_of("flat", 3.0, 0.0, **body)
    decay = scaled.C / (2 * scaled.M)
    nu = np.emath.sqrt(scaled.K / scaled.M - decay**2)  # imaginary when overdamped
    t = scaled.h * np.arange(10 * STEPS)
    exact = (np.exp(-decay * t) * np.cos(nu * t)).real
    # rounding grows with the number of steps, and like 1/h in a two-step recursion
    assert_allclose(advance(scaled, exact[:2], np.zeros(t.size)), exact, rtol=0, atol=1e-16 * t.size / scaled.h)


@pytest.mark.parametrize("T", [0.0, 0.5])
@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
def test_a_constant_force_holds_the_body_where_it_should(body, T):
    scaled = scaled_of("flat", 3.0, T, **body)
    y = -1 / scaled.K
    held = advance(scaled, [y, y], np.ones(2000))
    assert_allclose(held, y, rtol=2e-16 * 2000 / scaled.h**2)  # the weights of the recursion cancel to h**2


@pytest.mark.parametrize("T", [0.0, 0.5])
@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
def test_a_driven_body_is_of_second_order(body, T):
    errors = []
    for steps in (64, 256):
        scaled = scaled_of("flat", 3.0, T, **body, steps=steps)
        n = np.arange(2 * steps)
        S = np.cos(3 * scaled.h * n)
        stiffness = scaled.K - 9 * scaled.M + 3j * scaled.C  # M y'' + C y' + K y = -(S + T S')
        exact = (-(1 + 3j * T) / stiffness * np.exp(3j * scaled.h * n)).real
        errors.append(np.abs(advance(scaled, exact[:2], S) - exact).max() / np.abs(exact).max())
    assert errors[1] < errors[0] / 14  # 16, and a little for the next order
    assert errors[1] < 10 * scaled.h**2


@pytest.mark.parametrize("T", [0.0, 5.0])
def test_the_mean_force_of_a_step_acts_exactly(T):
    scaled = scaled_of("flat", 3.0, T, **BODIES["damped"])
    h, S = scaled.h, np.zeros(STEPS)
    S[3:] = 1.0  # rises within the step from 2 h to 3 h: mean force 1/2 and the impulse T of the dashpot

    def motion(state, force, span):
        def rate(t, x):
            return [x[1], -(force + scaled.C * x[1] + scaled.K * x[0]) / scaled.M]

        return solve_ivp(rate, (0, span), state, rtol=1e-12, atol=1e-14).y[:, -1]

    exact = motion(motion([0.0, 0.0], 0.5 + T / h, h), 1.0, 57 * h)[0]
    # the tolerance of the integrator and a few more roundings
    assert_allclose(advance(scaled, [0, 0], S)[60], exact, rtol=1e-9)


@pytest.mark.parametrize("body", [{"c_ratio": 0.0}, {"c_ratio": 0.4}], ids=["bare", "damper"])
def test_a_body_without_mass(body):
    scaled = scaled_of("flat", 3.0, 0.5, 0.7, math.inf, **body)
    assert scaled.M == 0
    errors = []
    for steps in (64, 256):
        scaled = scaled_of("flat", 3.0, 0.5, 0.7, math.inf, **body, steps=steps)
        n = np.arange(2 * steps)
        exact = (-(1 + 0.5j) / (scaled.K + 1j * scaled.C) * np.exp(1j * scaled.h * n)).real
        errors.append(np.abs(advance(scaled, exact[:2], np.cos(scaled.h * n)) - exact).max())
    assert errors[1] < errors[0] / 14  # second order
    if not scaled.C:
        assert_allclose([scaled.body.a_1, scaled.body.a_2], 0, atol=1e-15)  # no memory of its own


def test_a_fast_oscillation_that_is_not_resolved_is_damped():
    slow, fast = (scaled_of("flat", 3.0, 0.0, 0.7, omega_0, steps=STEPS) for omega_0 in (1.6, 40.0))
    for scaled, resolved in ((slow, True), (fast, False)):
        assert (math.sqrt((scaled.K + 1) / scaled.M) * scaled.h < 2 * np.pi / RESOLVED) == resolved
        y = advance(scaled, [1.0, 1.0], np.zeros(4 * STEPS))
        left = np.abs(y[-STEPS:]).max()
        assert (left > 0.9) == resolved
        assert (left < 0.05) == (not resolved)
        assert_allclose(advance(scaled, [-1 / scaled.K] * 2, np.ones(STEPS)), -1 / scaled.K, rtol=1e-9)


def test_a_rigid_pull_has_no_recursion():
    scaled = scaled_of("paraboloid", 3.0, 0.5)
    assert scaled.body.rigid
    assert not any(scaled.body[1:7])
    assert (0, 0, np.inf) == (scaled.M, scaled.C, scaled.K)


# --- the start ---


@pytest.mark.parametrize("T", [0.0, 0.5, 3.0])
@pytest.mark.parametrize(
    "body", [*BODIES.values(), {"k_ratio": 0.7, "omega_0_ratio": math.inf}], ids=[*BODIES, "no mass"]
)
@pytest.mark.parametrize("shape", ["flat", "paraboloid"])
def test_full_slip_repeats_itself_under_the_march(shape, body, T):
    scaled = scaled_of(shape, 4.0, T, **body)
    s, S = scaled.normal.s, scaled.normal.S
    start = scaled.full_slip_state(S)
    held = kernels.BodyState(*(part.copy() for part in start))
    e, trace = marched(scaled, 1e3, 3 * STEPS, held, scaled.body)
    y, force = trace.y, trace.S
    # 768 steps of a two-step recursion: a rounding of 1e-16 in its second difference grows like (t/h)**2
    for now, then in zip(held, start, strict=True):
        assert_allclose(now, then, rtol=0, atol=1e-16 * (3 * STEPS) ** 2 * np.abs(y).max())
    assert_allclose(e, s, rtol=0, atol=1e-12 * (1 + s.max()))
    assert_allclose(np.roll(force[:STEPS], 1), S, rtol=0, atol=1e-12 * S.max())  # of the springs, as known beforehand
    assert_allclose(force[:STEPS], force[-STEPS:], rtol=0, atol=1e-11 * np.abs(force).max())


@pytest.mark.parametrize("multiple", [1, 2])
def test_the_resonant_harmonic_is_left_out(multiple):
    # omega_0 = multiple * omega without damper: no periodic motion answers that harmonic
    scaled = scaled_of("paraboloid", 3.0, 0.0, 0.7, float(multiple), 0.0)
    S = scaled.normal.S
    assert abs(np.fft.rfft(S)[multiple]) > 1e-4 * abs(np.fft.rfft(S)[0])  # it is driven
    assert np.all(np.isfinite(scaled.full_slip_state(S).y))
    assert np.abs(scaled.full_slip_state(S).y).max() < 100
    # a force of the resonant harmonic alone moves nothing
    phase = scaled.h * np.arange(STEPS)
    assert_allclose(scaled.full_slip_state(np.cos(multiple * phase)).y, 0, atol=1e-12)
    other = 3 - multiple
    expected = -1 / (scaled.K - scaled.M * other**2)
    # second order in the step: (other h)**2/12, a few times
    assert_allclose(scaled.full_slip_state(np.cos(other * phase)).y[0], expected, rtol=2 * (other * scaled.h) ** 2)


def test_a_little_damping_brings_the_harmonic_back():
    scaled = scaled_of("paraboloid", 3.0, 0.0, 0.7, 1.0, 1e-3)
    y = scaled.full_slip_state(np.cos(scaled.h * np.arange(STEPS))).y
    # y = Re(-exp(i t)/(i C)) = -sin(t)/C: 0 at the start, and h/C one step before
    assert_allclose(y, np.sin(scaled.h * np.arange(3)) / scaled.C, rtol=2 * scaled.h**2, atol=scaled.h**2 / scaled.C)


def test_rest_is_rest():
    scaled = scaled_of("paraboloid", 3.0, 0.5, **BODIES["damped"])
    v = 0.3
    (y, y_old, y_older), (S, S_old), _ = scaled.rest_state(v)
    # the body stands still: its motion relative to the pull runs backward at v, through 0 now
    assert_allclose([y - y_old, y_old - y_older], -v * scaled.h, rtol=1e-15)
    assert (y, S, S_old) == (0, 0, 0)
    assert not any(part.any() for part in scaled_of("paraboloid").rest_state(v))


def test_history_of_a_rigid_pull_holds_the_force_alone():
    y, S, _ = scaled_of("paraboloid").full_slip_state(np.arange(4.0))
    assert (y.tolist(), S.tolist()) == ([0, 0, 0], [0, 3])
