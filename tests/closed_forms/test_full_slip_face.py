"""Full slip, static limit and the tail of a face with a shear strength; beside runs they are tested by the claim."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import expm
from scipy.special import ellipe, ellipk

import mdr
from mdr.closed_forms.critical_velocity import velocity_scale
from mdr.normal.normal_force import contact_radius, full_cof

OMEGA, DEPTH, TAU = 300.0, 20e-6, 0.5 / 300
MOTION = mdr.NormalOscillation(DEPTH, 0.3 * DEPTH, OMEGA)
RUBBER, ELASTIC = mdr.KelvinVoigt(3e6, 0.4, TAU), mdr.Elastic(3e6, 0.4)
BALL = mdr.SlidingContact(mdr.Paraboloid(5e-3), RUBBER, 0.0, MOTION, tau_0=1e4)
ARMS = mdr.Prony(3e6, ((4e6, 3 / OMEGA), (2e6, 0.3 / OMEGA)), 0.4, tau=TAU)
UNIT = 2 * BALL.tau_0 / RUBBER.G_star * OMEGA
BODY = mdr.SpringPull(k_x=2e3, m=0.01, c_x=2.0)


@dataclass(frozen=True)
class Spot(mdr.Friction):
    """A strength in the middle alone."""

    mu_0: float
    tau_0: float
    b: float

    @property
    def kinks(self):
        return (self.b,)

    def strong_radius(self, a):
        return np.minimum(a, self.b)


def by_springs(a, x):
    return np.sqrt(np.maximum(a**2 - x**2, 0.0))


def by_a_half_space(a, x):
    """What a strength of G*/2 on a disc of radius a moves the surface by at x."""
    m = np.minimum(np.where(x < a, x / a, a / x) ** 2, 1 - 1e-15)
    return 2 / np.pi * np.where(x < a, a * ellipe(m), x * (ellipe(m) - (1 - m) * ellipk(m)))


def own_rate(case, moved, places):
    """The greatest r' of r + tau r' = (2 tau_0/G*) moved [m/s], in steps that are exact for straight limits."""
    n, periods = 8192, 2
    a = contact_radius(case, 2 * np.pi * np.arange(n) / n)
    x, most = places * a.max(), -np.inf
    h = case.period / n
    decay, (r, c) = np.exp(-h / TAU), np.zeros((2, x.size))
    for k in range(periods * n):
        after = moved(a[k % n], x)
        mean = -np.expm1(-h / TAU) * TAU / h
        r = decay * r + c * (mean - decay) + after * (1 - mean)
        c = after
        if k >= (periods - 1) * n:
            most = max(most, np.where(x < a[k % n], (c - r) / TAU, -np.inf).max())
    return 2 * case.tau_0 / case.material.G_star * most


def own_rate_with_arms(case, places, n=2048, periods=12):
    """The same of r and its arms, r_j' = r' - r_j/theta_j, over exact steps of limits on lines."""
    rho, theta, h = np.array(case.rheology.rho), np.array(case.rheology.theta), 2 * np.pi / n
    a = contact_radius(case, h * np.arange(n))
    x, row = places * a.max(), np.append(1.0, rho) / -case.T
    A = row - np.diag(np.append(0.0, 1 / theta))
    B = np.zeros((rho.size + 3, rho.size + 3))
    B[:-2, :-2], B[:-2, -2], B[-2, -1] = A * h, h / case.T, 1.0
    E = expm(B)
    c, state, most = by_springs(a[:, None], x), np.zeros((rho.size + 1, x.size)), -np.inf
    for k in range(periods * n):
        now, after = c[k % n], c[(k + 1) % n]
        state = E[:-2, :-2] @ state + np.outer(E[:-2, -2], now) + np.outer(E[:-2, -1], after - now)
        if k >= (periods - 1) * n:
            most = max(most, np.where(x < a[(k + 1) % n], row @ state + after / case.T, -np.inf).max())
    return UNIT * most


@pytest.mark.parametrize("shape", [mdr.Paraboloid(5e-3), mdr.Cone(0.02)], ids=["paraboloid", "cone"])
@pytest.mark.parametrize("amplitude", [0.3, 1.4])
def test_full_slip_with_arms_is_an_own_sum(amplitude, shape):
    case = replace(BALL, indenter=shape, material=ARMS, oscillation=replace(MOTION, du_z=amplitude * DEPTH))
    own = own_rate_with_arms(case, np.linspace(1e-3, 0.9999, 150))
    assert_allclose(mdr.full_slip_critical_velocity(case), own, rtol=5e-4)  # of the steps of the sum, and its grid of x


@pytest.mark.parametrize("pull", [mdr.RigidPull(), mdr.SpringPull(k_x=2e3, m=0.01, c_x=2.0)], ids=["rigid", "body"])
@pytest.mark.parametrize("amplitude", [0.3, 1.4])
def test_weak_arms_leave_full_slip_as_it_is_without(amplitude, pull):
    case = replace(BALL, mu_0=0.3, pull=pull, oscillation=replace(MOTION, du_z=amplitude * DEPTH))
    v_c = mdr.full_slip_critical_velocity(case)
    for theta in (0.3, 3.0):
        weak = replace(case, material=mdr.Prony(3e6, ((1.0, theta / OMEGA),), 0.4, tau=TAU))
        assert_allclose(mdr.full_slip_critical_velocity(weak), v_c, rtol=3e-5)  # of the rate of the body between nodes
    assert mdr.critical_velocity(weak) == mdr.full_slip_critical_velocity(weak)


@pytest.mark.parametrize("amplitude", [0.3, 1.5])
def test_full_slip_is_an_own_sum(amplitude):
    case = replace(BALL, oscillation=replace(MOTION, du_z=amplitude * DEPTH))
    own = own_rate(case, by_springs, np.linspace(0.3, 0.9999, 400))
    assert_allclose(mdr.full_slip_critical_velocity(case), own, rtol=1e-4)  # of the grid of x


def test_full_slip_of_a_half_space_is_an_own_sum():
    v_c = mdr.laws.full_slip_of_half_space(BALL)
    assert_allclose(v_c, own_rate(BALL, by_a_half_space, np.linspace(0.8, 0.9999, 100)), rtol=1e-3)
    assert v_c < mdr.full_slip_critical_velocity(BALL)
    deeper = replace(BALL, oscillation=replace(MOTION, u_z0=2 * DEPTH))
    assert 0.7 < mdr.laws.full_slip_of_half_space(deeper) / v_c < 0.85
    assert "a half-space slips all over from" in str(mdr.verdict(BALL))


def test_where_nothing_moves_the_edge_springs_are_the_half_space():
    flat = mdr.SlidingContact(mdr.FlatPunch(1e-3), RUBBER, 0.3, MOTION, tau_0=1e4)
    v_c = mdr.laws.full_slip_of_half_space(flat)
    assert_allclose(v_c, mdr.full_slip_critical_velocity(flat), rtol=1e-4)  # of the grid of phases
    assert mdr.laws.full_slip_of_half_space(replace(BALL, material=ELASTIC)) == np.inf
    coulomb = replace(BALL, material=ELASTIC, mu_0=0.3, tau_0=0.0)
    assert_allclose(mdr.laws.full_slip_of_half_space(coulomb), mdr.critical_velocity(coulomb), rtol=1e-4)
    with pytest.raises(ValueError, match="takes a rigid pull, got pull = SpringPull"):
        mdr.laws.full_slip_of_half_space(replace(BALL, pull=BODY))


@pytest.mark.parametrize("pull", [mdr.RigidPull(), BODY], ids=["rigid", "body"])
@pytest.mark.parametrize(
    ("mu_0", "material"), [(0.0, RUBBER), (0.3, RUBBER), (0.3, ARMS)], ids=["strength", "both", "arms"]
)
def test_runs_slip_above_it_by_what_they_are_faster(pull, mu_0, material):
    case = replace(BALL, mu_0=mu_0, pull=pull, material=material)
    v_c = mdr.full_slip_critical_velocity(case)
    run = mdr.slide(case, 2 * v_c, n_springs=128, steps_per_period=512, n_periods=60)
    assert_allclose(run.v_0 - run.least_slip, v_c, rtol=1e-4 if material is RUBBER else 4e-4)


def test_a_measurement_finds_it_with_arms():
    for amplitude in (0.3, 1.4):
        case = replace(BALL, material=ARMS, oscillation=replace(MOTION, du_z=amplitude * DEPTH))
        found = mdr.measure_critical_velocity(case, accuracy=1e-3)
        assert found.low < mdr.full_slip_critical_velocity(case) < found.high


def test_what_it_knows():
    """Under a paraboloid the amplitude and the relaxation time, and not the depth."""
    deeper = replace(BALL, oscillation=replace(MOTION, u_z0=3 * DEPTH))
    wider = replace(BALL, oscillation=replace(MOTION, du_z=0.9 * DEPTH))
    v_c = mdr.full_slip_critical_velocity(BALL)
    assert_allclose(mdr.full_slip_critical_velocity(deeper), v_c, rtol=1e-9)
    assert_allclose(mdr.full_slip_critical_velocity(wider), np.sqrt(3) * v_c, rtol=1e-9)
    assert mdr.critical_velocity(BALL) == v_c


def test_springs_at_a_moving_edge_stick_at_any_velocity_without_a_dashpot():
    arms = mdr.Prony(3e6, ((2e6, 1e-3),), 0.4)
    for material in (ELASTIC, arms):
        case = replace(BALL, material=material)
        assert mdr.critical_velocity(case) == mdr.full_slip_critical_velocity(case) == np.inf
        assert mdr.measure_critical_velocity(case).kind == "none"
    assert "falls like v_0^-3" in str(mdr.verdict(replace(BALL, material=ELASTIC)))


def test_a_curve_is_scaled_by_what_vibration_reaches_where_v_c_ends_a_flat_tail():
    quick = replace(BALL, material=mdr.KelvinVoigt(3e6, 0.4, 0.003 / OMEGA))
    assert velocity_scale(quick) == quick.unit_velocity < 0.3 * mdr.critical_velocity(quick)
    assert velocity_scale(BALL) == mdr.critical_velocity(BALL) < BALL.unit_velocity
    pulled = replace(quick, pull=BODY)
    assert velocity_scale(pulled) == mdr.critical_velocity(pulled)
    assert velocity_scale(replace(BALL, material=ELASTIC)) == replace(BALL, material=ELASTIC).unit_velocity


def test_a_flat_face_keeps_eqs_1_and_15():
    for pull in (mdr.RigidPull(), BODY):
        flat = mdr.SlidingContact(mdr.FlatPunch(1e-3), RUBBER, 0.3, MOTION, pull)
        strong = replace(flat, tau_0=1e4)
        assert mdr.critical_velocity(strong) == mdr.critical_velocity(flat)
        assert_allclose(mdr.full_slip_critical_velocity(strong), mdr.full_slip_critical_velocity(flat), rtol=1e-9)
    lost = replace(strong, pull=mdr.RigidPull(), oscillation=replace(MOTION, du_z=2 * DEPTH))
    assert mdr.full_slip_critical_velocity(lost) > mdr.full_slip_critical_velocity(replace(lost, tau_0=0.0))


def test_the_static_limit_is_least_force_and_least_area():
    for material in (ELASTIC, RUBBER):
        case = replace(BALL, material=material, mu_0=0.2)
        slow = mdr.slide(case, 1e-5 * case.unit_velocity)
        rise = 1e-3 if material is RUBBER else 1e-4  # like the power 2/3 of the velocity, and in proportion
        assert_allclose(mdr.static_cof(case), slow.cof, atol=rise * full_cof(case))
    lost = replace(case, oscillation=replace(MOTION, du_z=2 * DEPTH))
    assert mdr.static_cof(lost) == 0


def test_velocity_of_a_share_turns_the_law_round():
    case = replace(BALL, material=ELASTIC, mu_0=0.1)
    for half_space in (False, True):
        v = mdr.laws.velocity_of_share(case, 0.999, half_space=half_space)
        assert_allclose(mdr.laws.lost_at_the_edge(case, v, half_space=half_space), 1e-3, rtol=1e-9)
    with pytest.raises(ValueError, match="takes an elastic material, got material = KelvinVoigt"):
        mdr.laws.lost_at_the_edge(BALL, v)
    with pytest.raises(ValueError, match="is below mu_0 kappa omega du_z"):
        mdr.laws.lost_at_the_edge(case, 1e-3 * v)


@pytest.mark.parametrize("pull", [mdr.RigidPull(), BODY], ids=["rigid", "body"])
def test_a_strength_acts_on_the_radius_of_its_law(pull):
    """As wide as the contact it is the face's, within the least contact a constant force; between them springs tell."""
    face = replace(BALL, pull=pull, mu_0=0.3)
    least, most = np.sqrt(5e-3 * np.array([DEPTH - 1.1 * MOTION.du_z, DEPTH + MOTION.du_z]))
    for solve in (mdr.full_slip_critical_velocity, mdr.critical_velocity, mdr.static_cof):
        assert solve(replace(face, friction=Spot(0.3, 1e4, most))) == pytest.approx(solve(face), rel=1e-6)
    inner, plain = replace(face, friction=Spot(0.3, 1e4, 0.9 * least)), replace(face, tau_0=0.0)
    assert mdr.full_slip_critical_velocity(inner) == mdr.full_slip_critical_velocity(plain)
    assert mdr.static_cof(inner) > mdr.static_cof(plain)
    if pull.is_rigid:
        b = 0.5 * (least + most)
        case = replace(BALL, friction=Spot(0.0, 1e4, b))
        own = own_rate(case, lambda a, x: by_springs(np.minimum(a, b), x), np.linspace(0, 1, 400)[:-1])
        assert mdr.full_slip_critical_velocity(case) == pytest.approx(own, rel=2e-3)
        assert mdr.full_slip_critical_velocity(BALL) > 1.02 * own
