"""Full slip of the whole array against the twin, the springs, Eqs. (1), (4), (7), (15), and where it is infinite."""

import math

import numpy as np
import pytest
import reference
from conftest import SHAPES, contact, unit_of_velocity
from numpy.testing import assert_allclose

import mdr
from mdr import theory
from mdr.full_slip import N_INSTANTS, contact_edge, full_slip, normal_force_harmonics

CURVED = ["cone", "paraboloid", "r4"]
DAMPED = {"k_ratio": 0.7, "omega_0_ratio": 1.6, "c_ratio": 0.15}
SOFT = {"k_ratio": 0.05, "omega_0_ratio": 0.4, "c_ratio": 0.0}
STIFF = {"k_ratio": 5.0, "omega_0_ratio": 7.3, "c_ratio": 0.0}
BODIES = {"damped": DAMPED, "soft": SOFT, "stiff": STIFF}
STEP = 2 * np.pi / N_INSTANTS


def v_hat_c(case):
    return mdr.full_slip_critical_velocity(case) / unit_of_velocity(case)


# --- the edge of contact ---


@pytest.mark.parametrize("T", [0.0, 1e-6, 1e-3, 0.1, 0.5, 1.0, 3.0, 30.0])
def test_contact_edge_against_the_twin(T):
    phase = np.linspace(0, 2 * np.pi, 201)
    twin = [-reference.edge_of_contact(t, T) for t in phase]  # the twin counts the depth of the spring, not of the edge
    # both find a root or a flat infimum by bracketing; the quantities are of size 1 + T
    assert_allclose(contact_edge(phase, T), twin, rtol=0, atol=1e-12 * (1 + T))


@pytest.mark.parametrize("T", [1e-3, 1e-6])
def test_contact_edge_tends_to_the_depth_itself(T):
    phase = np.linspace(0, 2 * np.pi, 201)
    gap = contact_edge(phase, 0.0) - contact_edge(phase, T)
    # retreating, the edge leads by T sin t; advancing, it is the depth itself on the fully relaxed surface
    assert_allclose(gap, T * np.maximum(np.sin(phase), 0), rtol=0, atol=T**2)


def test_elastic_contact_edge_is_the_depth():
    phase = np.linspace(0, 2 * np.pi, 50)
    assert_allclose(contact_edge(phase, 0.0), np.cos(phase), rtol=0, atol=1e-15)


# --- the normal force ---


@pytest.mark.parametrize("depth_ratio", [30.0, 3.0, 0.6, -0.4])
@pytest.mark.parametrize("shape", SHAPES)
def test_elastic_force_is_the_sum_over_the_springs(shape, depth_ratio):
    case = contact(shape, depth_ratio)
    motion, n = full_slip(case, 64), 1024
    springs = mdr.SpringArray.of(case, n)
    u_z = case.oscillation.u_z(motion.t)
    expected = [springs.normal_force(u, case.oscillation.u_z0) for u in u_z]
    k = float(case.indenter.stiffness(case.u_z_max, case.material.E_star))
    # one cell of the edge, half pressed: 1/n**2 of stiffness times amplitude, a few times that where the edge is steep
    assert_allclose(motion.F_N, expected, rtol=0, atol=4 / n**2 * k * case.oscillation.du_z)
    assert_allclose(
        motion.F_N, case.indenter.force(u_z, case.material.E_star), rtol=1e-12, atol=1e-15 * k * case.u_z_max
    )
    assert np.array_equal(motion.in_contact, u_z > 0)


@pytest.mark.parametrize("T", [0.3, 1.0, 2.5])
def test_force_of_a_kelvin_punch_that_keeps_contact_is_eq_4(T):
    case = contact("flat", 3.0, T)
    motion, osc = full_slip(case, 256), case.oscillation
    expected = theory.eq_4(motion.t, osc.u_z0, osc.du_z, osc.omega, case.k_zc, case.gamma_zc)
    assert case.keeps_contact
    assert_allclose(motion.F_N, expected, rtol=1e-12, atol=1e-12 * expected.max())
    assert_allclose(motion.contact_radius, case.indenter.a)
    harmonics = normal_force_harmonics(case, 256)
    assert_allclose(harmonics[0], case.k_zc * osc.u_z0, rtol=1e-12)
    assert_allclose(2 * abs(harmonics[1]), theory.eq_6(osc.du_z, osc.omega, case.k_zc, case.gamma_zc), rtol=1e-12)
    assert np.abs(harmonics[2:]).max() < 1e-13 * harmonics[0].real


@pytest.mark.parametrize("T", [0.0, 0.5, 3.0])
@pytest.mark.parametrize("depth_ratio", [30.0, 3.0, 0.6])
@pytest.mark.parametrize("shape", SHAPES)
def test_force_against_the_twin(shape, depth_ratio, T):
    case = contact(shape, depth_ratio, T)
    motion = full_slip(case, 200)
    phase = case.oscillation.omega * motion.t
    twin = reference.full_slip_force(phase, SHAPES[shape][1], depth_ratio, T)
    unit = case.k_zc * case.oscillation.du_z
    # the force does not change to first order with the edge; what is left is rounding
    assert_allclose(motion.F_N / unit, twin, rtol=0, atol=1e-12 * (depth_ratio + T))


@pytest.mark.parametrize("T", [0.5, 3.0])
@pytest.mark.parametrize("shape", CURVED)
def test_mean_force_is_that_of_the_mean_compression(shape, T):
    case = contact(shape, 5.0, T)
    F_N = full_slip(case).F_N
    twin = reference.mean_force(SHAPES[shape][1], 5.0, T)
    # the force bends like a root where the edge comes back: the mean of 8192 instants misses STEP**1.5 of a part of it
    assert_allclose(F_N.mean() / (case.k_zc * case.oscillation.du_z), twin, rtol=1e-7)


# --- static friction ---


@pytest.mark.parametrize(("depth_ratio", "T"), [(30.0, 3.0), (3.0, 0.0), (3.0, 0.3), (3.0, 3.0), (1.2, 0.3)])
@pytest.mark.parametrize("shape", SHAPES)
def test_static_cof_against_the_twin(shape, depth_ratio, T):
    got = mdr.static_cof(contact(shape, depth_ratio, T)) / 0.4
    twin = reference.static_cof(SHAPES[shape][1], depth_ratio, T)
    # the least of 8192 instants lies within STEP**2/8 of the minimum, times amplitude over mean of the force
    assert_allclose(got, twin, rtol=0, atol=1e-12 + STEP**2 / 8 * math.hypot(1, T) / depth_ratio * 2)
    if depth_ratio < math.hypot(1, T):
        assert got == 0


@pytest.mark.parametrize("T", [0.0, 0.3, 2.0])
def test_static_cof_of_the_punch_is_eq_7(T):
    case = contact("flat", 3.0, T)
    osc = case.oscillation
    expected = theory.eq_7(case.mu_0, osc.u_z0, osc.du_z, osc.omega, case.k_zc, case.gamma_zc) / (case.k_zc * osc.u_z0)
    assert_allclose(mdr.static_cof(case), expected, rtol=0, atol=STEP**2 / 8 * math.hypot(1, T) / 3)


# --- critical velocity ---


@pytest.mark.parametrize("T", [0.0, 0.5, 2.5])
@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
def test_a_punch_that_keeps_contact_has_eq_15(body, T):
    case = contact("flat", 3.0, T, **body)
    # one harmonic: the parabola through the top of a sine misses it by STEP**4
    assert_allclose(mdr.full_slip_critical_velocity(case), mdr.critical_velocity(case), rtol=1e-10)


@pytest.mark.parametrize("omega_0_ratio", [math.inf, 1e3])
@pytest.mark.parametrize("T", [0.0, 0.5])
def test_a_light_body_has_eq_15_too(T, omega_0_ratio):
    case = contact("flat", 3.0, T, 0.7, omega_0_ratio, 0.1)
    assert_allclose(mdr.full_slip_critical_velocity(case), mdr.critical_velocity(case), rtol=1e-9)


@pytest.mark.parametrize(("depth_ratio", "T"), [(30.0, 0.0), (1.01, 0.0), (4.0, 3.0)])
@pytest.mark.parametrize("shape", SHAPES)
def test_a_rigid_pull_that_keeps_contact_has_eq_1(shape, depth_ratio, T):
    case = contact(shape, depth_ratio, T)
    assert case.keeps_contact
    assert_allclose(v_hat_c(case), 1, rtol=1e-12)


@pytest.mark.parametrize("T", [0.0, 0.3, 3.0])
@pytest.mark.parametrize("depth_ratio", [0.6, 0.0, -0.5, -0.9])
@pytest.mark.parametrize("shape", ["flat", "paraboloid"])
def test_a_rigid_pull_that_touches_late_against_the_twin(shape, depth_ratio, T):
    n = SHAPES[shape][1]
    # 1e-8 is the budget; the instant of touch is known to rounding
    assert_allclose(
        v_hat_c(contact(shape, depth_ratio, T)), reference.full_slip_critical_velocity(n, depth_ratio, T), rtol=1e-8
    )


def test_a_touch_after_the_steepest_instant_in_closed_form():
    # elastic, u_z0 = -du_z/2: it touches at cos t = 1/2 before the top, where the depth rises at sin(pi/3)
    assert_allclose(v_hat_c(contact("cone", -0.5)), math.sin(math.pi / 3), rtol=1e-8)


@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
@pytest.mark.parametrize("depth_ratio", [10.0, 3.0, 1.5])
@pytest.mark.parametrize("shape", CURVED)
def test_elastic_body_against_the_twin(shape, depth_ratio, body):
    got = v_hat_c(contact(shape, depth_ratio, 0.0, **body))
    twin = reference.full_slip_critical_velocity(SHAPES[shape][1], depth_ratio, 0.0, **body)
    # the budget; 2e-10 seen, as the force is smooth here
    assert_allclose(got, twin, rtol=1e-8)


@pytest.mark.parametrize(("T", "body"), [(0.3, SOFT), (3.0, DAMPED)])
@pytest.mark.parametrize("shape", CURVED)
def test_kelvin_body_against_the_twin(shape, T, body):
    got = v_hat_c(contact(shape, 5.0, T, **body))
    twin = reference.full_slip_critical_velocity(SHAPES[shape][1], 5.0, T, **body)
    # the returning edge bends the force like a root: its harmonics fall slowly, and 8192 instants leave some 1e-8
    assert_allclose(got, twin, rtol=1e-7)


@pytest.mark.parametrize("body", [DAMPED, SOFT], ids=["damped", "soft"])
@pytest.mark.parametrize(
    ("shape", "depth_ratio", "T"),
    [
        ("flat", 0.6, 0.0),
        ("r4", 0.6, 0.0),
        ("cone", 0.6, 0.0),
        ("flat", 0.6, 0.3),
        ("paraboloid", 0.6, 0.3),
        ("cone", 3.0, 3.0),
    ],
)
def test_body_on_a_contact_that_is_lost_against_the_twin(shape, depth_ratio, T, body):
    got = v_hat_c(contact(shape, depth_ratio, T, **body))
    twin = reference.full_slip_critical_velocity(SHAPES[shape][1], depth_ratio, T, **body)
    # dashpots touch with a jump of the force, those of the punch all at once: an instant is known
    # to a share of STEP = 8e-4 and the rate of the body follows; 2.3e-5 seen. Elastic springs touch softly.
    assert_allclose(got, twin, rtol=1e-7 if T == 0 else 5e-5)


@pytest.mark.parametrize("shape", CURVED)
def test_small_amplitudes_lead_to_eq_15(shape):
    deviations = []
    for depth_ratio in (100.0, 1000.0):
        case = contact(shape, depth_ratio, 0.0, **DAMPED)
        deviations.append(abs(mdr.full_slip_critical_velocity(case) / mdr.critical_velocity(case) - 1))
    assert 1e-8 < deviations[0] < 1e-2  # something is there to vanish
    assert deviations[1] < 0.2 * deviations[0]  # at least linearly


# --- resonance ---


def on_resonance(shape, multiple, c_x=0.0, depth_ratio=3.0, T=0.0):
    """omega_0 = multiple * omega, in numbers exact in binary."""
    case = contact(shape, depth_ratio, T, omega=256.0)
    pull = mdr.SpringPull(k_x=2.0**18 * multiple**2 / 16, m=0.25, c_x=c_x)
    assert pull.omega_0 == multiple * 256.0
    return mdr.SlidingContact(case.indenter, case.material, case.mu_0, case.oscillation, pull)


@pytest.mark.parametrize(
    ("shape", "T", "multiple"),
    [
        ("cone", 0.0, 1),
        ("cone", 0.0, 2),
        ("cone", 0.5, 3),
        ("paraboloid", 0.0, 3),
        ("paraboloid", 0.5, 2),
        ("r4", 0.0, 4),
    ],
)
def test_it_is_infinite_on_the_resonance_of_any_harmonic(shape, T, multiple):
    assert math.isinf(mdr.full_slip_critical_velocity(on_resonance(shape, multiple, T=T)))
    assert math.isfinite(mdr.full_slip_critical_velocity(on_resonance(shape, multiple, c_x=1e-3, T=T)))


@pytest.mark.parametrize("multiple", [2, 3, 10])
@pytest.mark.parametrize("T", [0.0, 0.5])
def test_a_punch_that_keeps_contact_has_no_higher_harmonics_to_resonate(T, multiple):
    case = on_resonance("flat", multiple, T=T)
    assert_allclose(mdr.full_slip_critical_velocity(case), mdr.critical_velocity(case), rtol=1e-9)


def test_an_elastic_cone_that_keeps_contact_has_two_harmonics():
    # F_N ~ (u_z0 + du_z cos)**2 drives at omega and 2 omega and at nothing else
    for multiple in (3, 4):
        assert math.isfinite(mdr.full_slip_critical_velocity(on_resonance("cone", multiple)))


def test_a_punch_resonates_at_its_one_harmonic_and_at_all_when_contact_is_lost():
    assert math.isinf(mdr.full_slip_critical_velocity(on_resonance("flat", 1)))
    assert math.isinf(mdr.full_slip_critical_velocity(on_resonance("flat", 2, depth_ratio=0.6)))
