"""Every closed form against its neighbours: limits, derivatives, the equation of motion, the printed page."""

import contextlib
import dataclasses
import inspect
import math
import re

import numpy as np
import pytest
from conftest import SHAPES, contact
from numpy.testing import assert_allclose
from twins import rigid_pull as reference

import mdr
from mdr.closed_forms import paper

MU_0, U_Z0, DU_Z, OMEGA, KAPPA = 0.4, 20e-6, 2e-6, 300.0, 1.25
K_ZC, V_0 = 4e4, 1e-3
K_XC = K_ZC / KAPPA
GAMMA = [0.0, 40.0, 400.0]  # T = 0, 0.3, 3
BODIES = {"heavy": (2e4, 1.0), "light": (2e4, 0.01), "no mass": (2e4, 0.0), "soft": (50.0, 0.3)}
TIMES = np.linspace(0, 2 * np.pi / OMEGA, 97)


def random_cases(n=1000):
    """Positive quantities over decades, bodies heavy and light; the same every time."""
    rng = np.random.default_rng(15)

    def spread(low, high):
        return np.exp(rng.uniform(np.log(low), np.log(high), n))

    mu_0, du_z, omega = spread(0.01, 2), spread(1e-9, 1e-3), spread(1e-2, 1e6)
    k_zc, kappa, k_x = spread(1e-3, 1e9), rng.uniform(1, 1.5, n), spread(1e-3, 1e9)
    gamma_zc = k_zc / omega * spread(1e-3, 1e3)
    m = k_x / omega**2 * spread(1e-4, 1e4)
    return zip(*(column.tolist() for column in (mu_0, du_z, omega, k_zc, k_zc / kappa, gamma_zc, k_x, m)), strict=True)


# --- normal force ---


@pytest.mark.parametrize("gamma", GAMMA)
def test_eq_4_is_spring_and_dashpot_on_eq_3(gamma):
    motion = mdr.NormalOscillation(U_Z0, DU_Z, OMEGA)
    expected = K_ZC * motion.u_z(TIMES) + gamma * motion.u_z_dot(TIMES)
    assert_allclose(paper.eq_4(TIMES, U_Z0, DU_Z, OMEGA, K_ZC, gamma), expected, rtol=1e-14, atol=1e-14 * K_ZC * U_Z0)


@pytest.mark.parametrize("gamma", GAMMA)
def test_eq_6_is_the_amplitude_and_eq_7_the_least_of_eq_4(gamma):
    # the extremes of a harmonic lie where its phase says
    delta = math.atan(gamma * OMEGA / K_ZC)
    extremes = paper.eq_4(np.array([-delta, np.pi - delta]) / OMEGA, U_Z0, DU_Z, OMEGA, K_ZC, gamma)
    assert_allclose((extremes[0] - extremes[1]) / 2, paper.eq_6(DU_Z, OMEGA, K_ZC, gamma), rtol=1e-13)
    assert_allclose(MU_0 * extremes[1], paper.eq_7(MU_0, U_Z0, DU_Z, OMEGA, K_ZC, gamma), rtol=1e-13)


@pytest.mark.parametrize("gamma", GAMMA)
def test_eq_5_is_a_positive_least_force(gamma):
    limit = paper.eq_6(DU_Z, OMEGA, K_ZC, gamma) / K_ZC
    for u_z0 in (limit * (1 + 1e-12), limit * (1 - 1e-12)):
        assert paper.eq_5(u_z0, DU_Z, OMEGA, K_ZC, gamma) == (paper.eq_7(MU_0, u_z0, DU_Z, OMEGA, K_ZC, gamma) > 0)


# --- motion in full slip ---


@pytest.mark.parametrize("gamma", GAMMA)
@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
def test_eq_10_solves_eq_8(body, gamma):
    k_x, m = body

    def u_x(t):
        return paper.eq_10(t, V_0, MU_0, U_Z0, DU_Z, OMEGA, K_ZC, gamma, k_x, m)

    # u_x is a constant, a slope and one harmonic: the mean of three samples a third of a period apart leaves out the
    # harmonic, whose second derivative is -omega**2 times it
    third = 2 * np.pi / OMEGA / 3
    mean = (u_x(TIMES) + u_x(TIMES + third) + u_x(TIMES - third)) / 3
    acceleration = -(OMEGA**2) * (u_x(TIMES) - mean)
    force = MU_0 * paper.eq_4(TIMES, U_Z0, DU_Z, OMEGA, K_ZC, gamma)
    right = k_x * (V_0 * TIMES - u_x(TIMES)) - force  # Eq. (8)
    # terms of the size of the force and of the inertia cancel
    assert_allclose(m * acceleration, right, rtol=0, atol=1e-12 * (force.max() + np.abs(m * acceleration).max()))


def test_eq_11_is_the_ratio_of_the_stiffnesses():
    case = contact("paraboloid", T=0.7)
    gamma_xc = paper.eq_11(case.gamma_zc, case.material.mindlin_ratio)
    assert_allclose(gamma_xc / case.gamma_zc, case.k_xc / case.k_zc, rtol=1e-14)
    assert_allclose(gamma_xc, case.gamma_xc, rtol=1e-14)


@pytest.mark.parametrize("gamma", GAMMA)
def test_eq_12_balances_the_foot_eq_9(gamma):
    # the same first-order operator on both sides: k_xc e + gamma_xc e' = mu_0 F_N
    e = paper.eq_12(TIMES, MU_0, U_Z0, DU_Z, OMEGA, KAPPA)
    e_dot = paper.eq_12(TIMES + np.pi / 2 / OMEGA, MU_0, 0.0, DU_Z, OMEGA, KAPPA) * OMEGA  # a quarter turn on
    left = K_XC * e + paper.eq_11(gamma, KAPPA) * e_dot
    assert_allclose(
        left, MU_0 * paper.eq_4(TIMES, U_Z0, DU_Z, OMEGA, K_ZC, gamma), rtol=1e-12, atol=1e-14 * K_ZC * U_Z0
    )


@pytest.mark.parametrize("gamma", GAMMA)
@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
def test_eq_13_is_eq_10_less_eq_12(body, gamma):
    k_x, m = body
    # written out as printed
    inertia = m * OMEGA**2 - k_x
    phase = OMEGA * TIMES
    printed = (
        V_0 * TIMES
        - MU_0 * K_ZC * U_Z0 * (1 / k_x + 1 / K_XC)
        + MU_0 * DU_Z / inertia * (K_ZC * np.cos(phase) - gamma * OMEGA * np.sin(phase))
        - MU_0 * K_ZC / K_XC * DU_Z * np.cos(phase)
    )
    foot = paper.eq_13(TIMES, V_0, MU_0, U_Z0, DU_Z, OMEGA, K_ZC, gamma, KAPPA, k_x, m)
    assert_allclose(foot, printed, rtol=0, atol=1e-13 * np.abs(printed).max())


@pytest.mark.parametrize("gamma", GAMMA)
@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
def test_eq_14_is_the_rate_of_eq_13(body, gamma):
    k_x, m = body
    dt = 1e-4 / OMEGA
    groups = MU_0, U_Z0, DU_Z, OMEGA, K_ZC, gamma, KAPPA, k_x, m
    ahead, behind = (paper.eq_13(t, 0.0, *groups) for t in (TIMES + dt, TIMES - dt))
    rate = paper.eq_14(TIMES, 0.0, MU_0, DU_Z, OMEGA, K_ZC, gamma, KAPPA, k_x, m)
    # central difference: (omega dt)**2/6 = 2e-9 of the amplitude; rounding of the position over dt
    atol = 4e-9 * np.abs(rate).max() + 4e-16 * np.abs(ahead).max() / dt
    assert_allclose(rate, (ahead - behind) / (2 * dt), rtol=0, atol=atol)
    with_pull = paper.eq_14(TIMES, V_0, MU_0, DU_Z, OMEGA, K_ZC, gamma, KAPPA, k_x, m)
    assert_allclose(with_pull - V_0, rate, rtol=0, atol=4e-16 * (V_0 + np.abs(rate).max()))


# --- critical velocity ---


def test_eq_15_is_the_printed_one():
    for mu_0, du_z, omega, k_zc, k_xc, gamma_zc, k_x, m in random_cases():
        inertia = m * omega**2 - k_x
        root = math.sqrt((gamma_zc * omega) ** 2 + (k_zc / k_xc * (m * omega**2 - k_xc - k_x)) ** 2)
        printed = mu_0 * du_z * omega / abs(inertia) * root
        # the printed order of subtraction loses more where k_xc or k_x is small beside the other
        assert_allclose(paper.eq_15(mu_0, du_z, omega, k_zc, k_xc, gamma_zc, k_x, m), printed, rtol=1e-12)


def test_eq_2_is_the_printed_one_and_the_elastic_limit_of_eq_15():
    for mu_0, du_z, omega, k_zc, k_xc, _, k_x, m in random_cases():
        printed = mu_0 * omega * du_z * k_zc / k_xc * abs(k_xc + k_x - m * omega**2) / abs(k_x - m * omega**2)
        got = paper.eq_2(mu_0, du_z, omega, k_zc, k_xc, k_x, m)
        assert_allclose(got, printed, rtol=1e-12)
        # a damping of 1e-9 adds its square where nothing cancels, and at most 1e-9 of Eq. (1)'s share otherwise
        damped = paper.eq_15(mu_0, du_z, omega, k_zc, k_xc, 1e-9 * k_zc / omega, k_x, m)
        viscous = mu_0 * du_z * omega * 1e-9 * k_zc / abs(m * omega**2 - k_x)
        assert_allclose(damped, got, rtol=1e-12, atol=viscous)


def test_eq_1_is_the_stiff_limit_of_eq_15():
    for mu_0, du_z, omega, k_zc, k_xc, gamma_zc, *_ in random_cases(200):
        expected = mu_0 * omega * du_z * k_zc / k_xc
        assert_allclose(paper.eq_1(mu_0, du_z, omega, k_zc / k_xc), expected, rtol=1e-15)
        k_x = 1e14 * (k_zc + gamma_zc * omega)
        # what is left of the body is (k_xc + i omega gamma_xc)/k_x < 1e-14
        assert_allclose(paper.eq_15(mu_0, du_z, omega, k_zc, k_xc, gamma_zc, k_x, 0.0), expected, rtol=1e-13)


@pytest.mark.parametrize("c_x", [0.0, 1.0, 300.0])
def test_eq_15_is_the_least_velocity_that_keeps_eq_14_positive(c_x):
    k_x, m, gamma = 2e4, 0.01, 40.0
    K_z, H = K_ZC + 1j * OMEGA * gamma, mdr.SpringPull(k_x, m, c_x).receptance(OMEGA)
    v_c = paper.eq_15(MU_0, DU_Z, OMEGA, K_ZC, K_XC, gamma, k_x, m, c_x)
    assert_allclose(v_c, MU_0 * OMEGA * DU_Z * abs(K_ZC / K_XC + K_z * H), rtol=1e-13)
    if c_x == 0:
        t = np.linspace(0, 2 * np.pi / OMEGA, 20_001)
        foot = paper.eq_14(t, v_c, MU_0, DU_Z, OMEGA, K_ZC, gamma, KAPPA, k_x, m)
        # the least of 20000 samples lies within (pi/20000)**2/2 of the minimum
        assert_allclose(foot.min() / v_c, 0, atol=(np.pi / 20_000) ** 2)


@pytest.mark.parametrize("T", [0.0, 0.5, 3.0])
@pytest.mark.parametrize("shape", SHAPES)
def test_critical_velocity_reads_the_case(shape, T):
    case = contact(shape, 5.0, T, 0.7, 1.6, 0.2)
    unit = paper.eq_1(case.mu_0, case.oscillation.du_z, case.oscillation.omega, case.material.mindlin_ratio)
    by_groups = abs(1 + (1 + 1j * T) / (0.7 - 0.7 / 1.6**2 + 0.2j))
    assert_allclose(mdr.critical_velocity(case) / unit, by_groups, rtol=1e-12)
    no_mass = contact(shape, 5.0, T, 0.7, math.inf, 0.2)
    assert_allclose(mdr.critical_velocity(no_mass) / unit, abs(1 + (1 + 1j * T) / (0.7 + 0.2j)), rtol=1e-12)


@pytest.mark.parametrize("T", [0.0, 3.0])
@pytest.mark.parametrize("depth_ratio", [-0.5, 0.0, 0.6, 3.0, 300.0])
@pytest.mark.parametrize("shape", SHAPES)
def test_a_rigid_pull_has_eq_1_whatever_shape_depth_and_material(shape, depth_ratio, T):
    case = contact(shape, depth_ratio, T)
    nu = case.material.nu
    expected = case.mu_0 * case.oscillation.omega * case.oscillation.du_z * (2 - nu) / (2 * (1 - nu))
    assert_allclose(mdr.critical_velocity(case), expected, rtol=1e-14)


def test_it_is_infinite_on_the_undamped_resonance_alone():
    indenter, material = SHAPES["flat"][0], mdr.KelvinVoigt(3e6, 0.4, 1e-3)
    motion = mdr.NormalOscillation(U_Z0, DU_Z, 256.0)  # 256**2 * 0.25 is exact in binary

    def v_c(k_x, c_x=0.0):
        return mdr.critical_velocity(
            mdr.SlidingContact(indenter, material, 0.4, motion, mdr.SpringPull(k_x, 0.25, c_x))
        )

    assert math.isinf(v_c(16384.0))
    assert math.isfinite(v_c(16384.0, 1e-6))
    # next to it the pole: k_zc/(k_x eps) with a relative eps of 1e-9
    assert_allclose(v_c(16384.0 * (1 + 1e-9)) / v_c(16384.0 * (1 + 2e-9)), 2, rtol=1e-6)


# --- the deficit ---


@pytest.mark.parametrize("v_hat", [1e-12, 1e-6, 0.01, 0.3, 0.5, 0.9, 0.999, 1 - 1e-9])
def test_deficit_against_the_twin(v_hat):
    # terms of order 1 cancel
    assert_allclose(paper.deficit(v_hat), reference.flat_punch_deficit(v_hat), rtol=0, atol=1e-14)


@pytest.mark.parametrize("v_hat", [-1e-9, 1 + 1e-9, math.nan, math.inf])
def test_deficit_outside_its_range_is_refused(v_hat):
    with pytest.raises(ValueError, match=r"v_hat must lie in \[0, 1\]"):
        paper.deficit(v_hat)


# --- what is refused ---

EQUATIONS = {name: one for name, one in vars(paper).items() if name.startswith("eq_")}


@pytest.mark.parametrize("name", ["eq_10", "eq_13", "eq_14"])
def test_full_slip_on_the_undamped_resonance_is_refused_by_name(name):
    equation = EQUATIONS[name]
    values = dict.fromkeys(inspect.signature(equation).parameters, 1.0) | {"omega": 2.0, "m": 3.0, "k_x": 12.0}
    with pytest.raises(ValueError, match=r"resonance: k_x = m omega² = 12 N/m"):
        equation(**values)
    assert np.isfinite(equation(**values | {"k_x": 13.0}))


@pytest.mark.parametrize("bad", [math.nan, math.inf])
@pytest.mark.parametrize("equation", EQUATIONS.values(), ids=EQUATIONS)
def test_nothing_that_is_not_finite_gets_in(equation, bad):
    for wrong in inspect.signature(equation).parameters:
        values = dict.fromkeys(inspect.signature(equation).parameters, 1.0) | {wrong: bad}
        with pytest.raises(ValueError, match=f"^{wrong} must be finite"):
            equation(**values)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("size", [1e-150, 1e150, 1e-308, 1e308])
@pytest.mark.parametrize("equation", EQUATIONS.values(), ids=EQUATIONS)
def test_numbers_far_from_one_are_answered_or_refused(equation, size):
    names = inspect.signature(equation).parameters
    for given in ([size] * len(names), *(np.where(np.arange(len(names)) == i, size, 2.0) for i in range(len(names)))):
        with contextlib.suppress(ValueError):
            assert np.isfinite(equation(*given))


def test_a_division_by_nothing_is_refused_by_name():
    with pytest.raises(ValueError, match=r"eq_11 at gamma_zc = 1.0, mindlin_ratio = 0.0 is .*divide by zero"):
        paper.eq_11(1.0, 0.0)
    with pytest.raises(ValueError, match="the critical velocity is beyond the range of floats"):
        paper.linear_critical_velocity(0.4, 1e200, 1e200, 1.25, 1.0, 0.0)


def test_help_on_the_critical_velocity_prints_what_it_computes():
    words = inspect.getdoc(mdr.critical_velocity)
    assert "Facta Universitatis, Series: Mechanical Engineering 14 (2016) 335" in " ".join(words.split())
    case = contact("paraboloid", 5.0, 0.7, 0.6, 0.3, 0.2)
    names = {
        "mu_0": case.mu_0, "du_z": case.oscillation.du_z, "omega": case.oscillation.omega, "k_xc": case.k_xc,
        "gamma_zc": case.gamma_zc, "kappa": case.k_zc / case.k_xc, "i": 1j, "sqrt": np.sqrt, "abs": abs,
        "k_x": case.pull.k_x, "m": case.pull.m, "c_x": case.pull.c_x,
    }  # fmt: skip

    def value(line, **changes):
        line = re.sub(r"\|([^|]*)\|", r"abs(\1)", line).replace("²", "**2")
        line = re.sub(r"(?<=[\w)]) (?=[\w(])", " * ", line)
        return eval(line, {**names, **changes})

    general, D = re.search(r"v_c = (.*\|D\|)$", words, re.M)[1], re.search(r"D = (.*) ::", words)[1]
    assert_allclose(value(general, D=value(D)), mdr.critical_velocity(case), rtol=1e-12)
    undamped = dataclasses.replace(case, pull=dataclasses.replace(case.pull, c_x=0.0))
    printed = re.search(r"v_c = (.*sqrt.*)$", words, re.M)[1]
    assert_allclose(value(printed), mdr.critical_velocity(undamped), rtol=1e-12)
