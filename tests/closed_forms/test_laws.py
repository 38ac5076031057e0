"""Laws that were derived here, each against its own definition; beside runs they are tested by the claims."""

import doctest
from dataclasses import replace

import numpy as np
import pytest

import mdr
from mdr import laws
from mdr.closed_forms import across
from mdr.closed_forms.paper import deficit

OMEGA, DEPTH = 314.0, 20e-6
PUNCH, ELASTIC = mdr.FlatPunch(a=1e-3), mdr.Elastic(E=3e6, nu=0.5)
BODY = mdr.SpringPull(k_x=2e4, m=0.1, c_x=4.0)


def case_of(indenter=PUNCH, T=0.0, alpha=0.3, pull=BODY):
    material = mdr.KelvinVoigt(E=3e6, nu=0.5, tau=T / OMEGA) if T else ELASTIC
    return mdr.SlidingContact(indenter, material, 0.5, mdr.NormalOscillation(DEPTH, alpha * DEPTH, OMEGA), pull)


def error_of(case):
    return mdr.full_slip_critical_velocity(case) / mdr.critical_velocity(case) - 1


def test_the_examples_run():
    rooms = laws.rigid_pull, laws.bodies, laws.shaken, laws.across, laws.random, laws.waveform, laws.strength, across
    found = [doctest.testmod(room, extraglobs={"mdr": mdr, "np": np}) for room in rooms]
    assert sum(one.attempted for one in found) > 20
    assert not any(one.failed for one in found)


def test_every_law_says_its_range_units_and_where_it_is_tested():
    for name in laws.__all__:
        text = getattr(laws, name).__doc__ or ""
        if not isinstance(getattr(laws, name), type):
            assert "Returns\n" in text, name
            assert "Examples\n" in text, name
            assert "[" in text.partition("Parameters")[0], name


@pytest.mark.parametrize("T", [0.3, 1.0, 10.0, 100.0])
def test_the_centre_touches_from_the_depth_of_which_its_whole_past_allows(T):
    phase, ago = np.linspace(1.5, 1.95, 7) * np.pi, np.linspace(0, 6 * np.pi, 200_001)[1:]
    past = np.cos(phase[:, None] - ago) * np.exp(-ago / T) - np.cos(phase)[:, None]
    expected = np.max(past / -np.expm1(-ago / T), axis=1)
    # a maximum between nodes of the grid: its square over 8, times a curvature of order T
    np.testing.assert_allclose([laws.touch_depth(at, T) for at in phase], expected, rtol=0, atol=ago[0] ** 2 * (1 + T))


def test_late_return_lowers_v_c_continuously_and_only_beyond_its_limit():
    limit = laws.amplitude_limit(10.0)
    assert laws.late_return(1 / (limit * (1 - 1e-9)), 10.0) == 1.0
    assert laws.late_return(1 / (limit * 1.01), 10.0) == pytest.approx(1.0, abs=1e-3)  # 1 - cos of a small angle
    ratios = [laws.late_return(1 / (limit * k), 10.0) for k in (1.01, 1.5, 2.0, 4.0)]
    assert np.all(np.diff(ratios) < 0)


def test_the_limit_of_a_slow_material_is_a_minimum():
    theta = np.linspace(np.pi, 2 * np.pi, 100_001)[1:-1]
    assert laws.slow_limit() == pytest.approx(np.min(theta / -np.sin(theta)), rel=1e-8)


def test_the_edge_band_is_that_of_the_least_extension_of_the_past():
    """The extension of a spring is the least of its compression then plus the pull since: two passes over a period."""
    n, v = 8192, 0.3
    phase = 2 * np.pi * np.arange(2 * n) / n
    gap, weight = np.polynomial.legendre.leggauss(100)
    pressed = np.maximum(np.cos(phase) - np.r_[gap, -1.0][:, None], 0)
    e = np.minimum.accumulate(pressed - v * phase, axis=1) + v * phase
    lag = np.mean((pressed - e)[:, n:], axis=1)
    # a touch lies between instants, and e misses up to the pull in a step
    assert laws.edge_band(v) == pytest.approx(weight @ lag[:-1] / lag[-1] - 1, abs=v * 2 * np.pi / n)


@pytest.mark.parametrize("slow", [0.0, 0.02, 0.7])
@pytest.mark.parametrize("tau", [0.0, 0.5, 4.0])
def test_the_impedance_of_stick_is_that_of_one_spring_followed_in_small_steps(slow, tau):
    """e' of a small motion is its velocity in stick, and -e/tau else: small steps, over so many periods of the slow one
    that its phase in the vibration does not matter."""
    stick, n, turns = 0.6, 2000, 50
    t = 2 * np.pi * np.arange(turns * n) / n
    v, e, force = np.exp(1j * slow * t), 0.0, []
    for i, one in enumerate(v):
        sticks, dt = i % n < stick * n, t[1]
        e = e + one * dt if sticks else e * (np.exp(-dt / tau) if tau else 0.0)
        force.append(e + tau * one if sticks else 0.0)
    last = slice(
        turns * n // 5, None
    )  # the start is forgotten, 40 periods are whole ones of the slow motion or its beat
    found = np.mean((force / v)[last])
    assert laws.stick_impedance(stick, 1.0, 1.0, slow, tau) == pytest.approx(found, rel=4 / n)


@pytest.mark.parametrize("shape", [mdr.Cone(theta=0.05), mdr.Paraboloid(R=5e-3), mdr.PowerLaw(n=4, c=1e8)])
@pytest.mark.parametrize("T", [0.0, 1.0])
def test_the_error_of_eq_15_at_small_amplitude_knows_one_number_of_the_shape(shape, T):
    a, b = (error_of(case_of(shape, T, alpha)) / alpha for alpha in (1e-4, 2e-4))
    expected = laws.first_order(case_of(shape, T)) * laws.stiffness_exponent(shape, DEPTH)
    assert 2 * a - b == pytest.approx(expected, rel=1e-3)  # 1e-8 of v_c over alpha, and alpha²


def test_without_loss_and_without_yielding_eq_15_has_no_error_of_first_order():
    assert laws.first_order(case_of(T=1.0, pull=mdr.RigidPull())) == 0
    assert abs(laws.first_order(case_of(pull=mdr.SpringPull(k_x=2e4, m=0.1)))) < 1e-12
    with pytest.raises(ValueError, match="infinite"):
        laws.first_order(case_of(pull=mdr.SpringPull(k_x=1e4, m=1e4 / (2 * OMEGA) ** 2)))


@pytest.mark.parametrize("pull", [BODY, mdr.SpringPull(k_x=1e3, m=0.1, c_x=1.0), mdr.RigidPull()])
@pytest.mark.parametrize("T", [0.0, 1.0])
def test_what_depth_does_is_the_derivative_of_eq_15(pull, T):
    case = case_of(mdr.Paraboloid(R=5e-3), T, 1e-3, pull)
    step = 1e-4
    low, high = (
        mdr.critical_velocity(replace(case, oscillation=replace(case.oscillation, u_z0=DEPTH * np.exp(side * step))))
        for side in (-1, 1)
    )
    assert np.log(high / low) / (2 * step) == pytest.approx(0.5 * laws.depth_sensitivity(case), abs=1e-6)


def test_at_the_least_v_c_depth_does_nothing():
    case = case_of(mdr.Paraboloid(R=5e-3), 1.0, 1e-3, mdr.SpringPull(k_x=1e3, m=0.1, c_x=1.0))
    k_xc, over = laws.least_over_depth(case)
    there = replace(case, oscillation=replace(case.oscillation, u_z0=DEPTH * (k_xc / case.k_xc) ** 2))
    assert laws.depth_sensitivity(there) == pytest.approx(0, abs=1e-12)
    assert mdr.critical_velocity(there) / there.unit_velocity == pytest.approx(over, rel=1e-12)
    with pytest.raises(ValueError, match="no minimum"):
        laws.least_over_depth(case_of(pull=mdr.SpringPull(k_x=1e5, m=0.1)))
    with pytest.raises(TypeError, match="takes a body on a spring, got pull = RigidPull"):
        laws.least_over_depth(case_of(pull=mdr.RigidPull()))


def test_a_punch_has_half_of_its_swing_in_one_harmonic():
    case = case_of(T=1.0, alpha=0.3)
    assert laws.harmonic_share(case, 1) == pytest.approx(0.5 * 0.3 * np.sqrt(2), rel=1e-12)
    assert laws.harmonic_share(case, 2) < 1e-12


@pytest.mark.parametrize("n", [2, 3, 5])
def test_lock_in_is_the_least_maximum_that_a_free_oscillation_can_make(n):
    from scipy.optimize import minimize_scalar

    phi = np.linspace(0, 2 * np.pi, 200_001)
    peak = lambda b: np.max(np.sin(phi) + b * np.cos(n * (phi - np.pi / 2)))  # noqa: E731
    least = min(minimize_scalar(peak, bounds=ends, method="bounded").fun for ends in ((-0.7, 0), (0, 0.7)))
    assert laws.lock_in(n) == pytest.approx(least, rel=1e-6)


def test_the_error_under_load_is_a_maximum():
    phi, n, eps = np.linspace(0, np.pi, 400_001), 2.0, 1e-2
    most = np.max(np.sin(phi) * (1 + eps * np.cos(phi)) ** (-1 / (n + 1)))
    assert laws.load_error(eps, n) == pytest.approx(most - 1, rel=1e-3)


def test_a_narrow_band_loses_what_sines_of_rayleigh_amplitudes_lose():
    from scipy.integrate import quad

    for b in (0.03, 0.7, 2.0, 7.0):
        known = quad(lambda x, b=b: x**2 * np.exp(-(x**2) / 2) * deficit(b / x), b, b + 9, epsabs=0, epsrel=1e-9)[0]
        assert laws.random_loss(b) == pytest.approx(known, rel=1e-8)


@pytest.mark.parametrize("T", [0.5, 1.0, 3.0])
def test_a_dashpot_remembers_the_tops_of_excursions(T):
    """T times the content at its top, 2 a³/(3 b²), 3 sqrt(pi/2) the mean of a³: a series in 1/b, from three of them."""
    b = np.array([12.0, 20.0, 34.0])
    found = [laws.random_loss(x, T) * np.sqrt(2 * np.pi) * x**2 * np.exp(x**2 / 2) / T for x in b]
    limit = np.linalg.solve(np.vander(1 / b, increasing=True), found)[0]
    assert limit == pytest.approx(1.0, abs=0.01)  # (0.2/T)^3 and less of the next term
    assert laws.random_loss(1.0, 1e-9) == pytest.approx(laws.random_loss(1.0), rel=1e-6)


def test_a_slow_random_pull_is_the_mean_of_its_distribution():
    from scipy.integrate import quad
    from scipy.stats import norm

    def below(h, b):
        return norm.cdf(h) * np.exp(-norm.sf(h) / (b * np.sqrt(2 * np.pi)))

    for b in (1e-6, 0.01, 0.3):
        above = quad(lambda h, b=b: 1 - below(h, b), 0, 20, limit=200)[0]
        assert laws.slow_random_loss(b) == pytest.approx(above - quad(below, -20, 0, args=(b,))[0], rel=1e-6)
    assert laws.slow_random_loss(1e-30) == pytest.approx(np.sqrt(2 * np.log(1e30)), rel=0.05)


def test_the_end_of_random_vibration_is_where_a_share_is_left():
    at_rest = laws.random_loss(1e-9)
    assert at_rest == pytest.approx(np.sqrt(np.pi / 2), rel=1e-4)
    for share, T in ((0.5, 0.0), (1e-3, 0.0), (0.1, 1.0)):
        assert laws.random_loss(laws.random_end(share, T), T) == pytest.approx(share * np.sqrt(np.pi / 2), rel=1e-8)


@pytest.mark.parametrize("T", [0.0, 1.0])
def test_random_friction_is_that_of_its_lag(T):
    band = mdr.Spectrum.band(1e-6, 50.0, 60.0)
    tau = T * band.rms_velocity / band.rms_acceleration
    case = replace(case_of(), pull=mdr.RigidPull(), material=mdr.KelvinVoigt(E=3e6, nu=0.5, tau=tau))
    v_0 = 1.2 * case.mu_0 * case.material.mindlin_ratio * band.rms_velocity
    lag = band.moment(2) / np.sqrt(band.moment(4)) * laws.random_loss(1.2, T)
    assert laws.random_friction(case, band, v_0) == pytest.approx(0.5 * (1 - lag / DEPTH), rel=1e-12)  # F = k d
