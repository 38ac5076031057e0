"""The operator over one step against its differential equations, and springs of arms against their twin."""

import math

import numpy as np
import pytest
import reference_arms
from conftest import SHAPES
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

import mdr
from mdr.march.dimensionless import ScaledContact
from mdr.march.march import Knobs, at_hand
from mdr.march.stepper import Stepper
from mdr.materials import operator
from mdr.materials.operator import Rheology, over_step

ARMS = {"one": ((2.0,), (0.7,)), "two": ((1.5, 0.5), (0.3, 4.0)), "fast and slow": ((20.0, 3.0), (1e-3, 50.0))}
OMEGA = 300.0


def material(T, rho, theta, E=3e6):
    return mdr.Prony(E, [(E * r, t / OMEGA) for r, t in zip(rho, theta, strict=True)], 0.4, T / OMEGA)


def case(T, rho, theta, shape="paraboloid", depth_ratio=3.0, pull=None, du_z=2e-6):
    motion = mdr.NormalOscillation(depth_ratio * du_z, du_z, OMEGA)
    return mdr.SlidingContact(SHAPES[shape][0], material(T, rho, theta), 0.4, motion, pull or mdr.RigidPull())


# --- one step ---


@pytest.mark.parametrize("arms", ARMS.values(), ids=ARMS)
@pytest.mark.parametrize("T", [0.0, 0.8])
def test_a_free_spring_obeys_its_equation(T, arms):
    rho, theta = map(np.array, arms)
    h, rng = 0.3, np.random.default_rng(1)
    table = over_step(T, rho, theta, h)
    x = rng.uniform(-1, 1, 1 + rho.size)
    if T == 0:  # no force is left: shed
        x -= (x[0] + rho @ x[1:]) / (1 + rho.sum())

    def rate(_, x):
        first = -(x[0] + rho @ x[1:]) / T if T else (rho / theta) @ x[1:] / (1 + rho.sum())
        return np.concatenate([[first], first - x[1:] / theta])

    end = solve_ivp(rate, (0, h), x, method="LSODA", rtol=1e-11, atol=1e-13).y[:, -1]
    assert_allclose(table[operator.L_FREE] @ x, end[0], rtol=0, atol=1e-9)
    assert_allclose(table[operator.L_RATE] @ x, -rate(0, x)[0], rtol=0, atol=1e-12 * np.abs(rate(0, x)).max())
    assert_allclose(table[operator.L_END] @ x, -rate(0, end)[0], rtol=0, atol=1e-7)


@pytest.mark.parametrize("arms", ARMS.values(), ids=ARMS)
def test_what_is_shed_is_all_force(arms):
    rho, theta = map(np.array, arms)
    table = over_step(0.0, rho, theta, 1e-9)  # no time to relax
    x = np.random.default_rng(2).uniform(-1, 1, 1 + rho.size)
    left = x - (x[0] - table[operator.L_FREE] @ x)  # every part moves alike
    assert_allclose(left[0] + rho @ left[1:], 0, atol=1e-5)  # 1e-9/1e-3 of the fast arm has relaxed


def test_arms_follow_a_linear_path():
    rho, theta, h = np.array([1.0, 1.0]), np.array([0.2, 5.0]), 0.4
    table, x, slope = over_step(0.0, rho, theta, h), np.array([0.3, -0.1, 0.2]), 1.7
    exact = x[1:] * np.exp(-h / theta) + slope * theta * (1 - np.exp(-h / theta))
    assert_allclose(table[operator.L_DECAY, 1:] * x[1:] + table[operator.L_GAIN, 1:] * slope * h, exact, rtol=1e-14)


def test_without_arms_it_is_a_kelvin_spring():
    table = over_step(0.5, [], [], 0.1)
    decay = math.exp(-0.2)
    assert_allclose(
        table[[operator.L_FREE, operator.L_RATE, operator.L_END, operator.L_SHED], 0],
        [decay, 2.0, 2 * decay, 0],
        rtol=1e-15,
    )


@pytest.mark.parametrize("arms", ARMS.values(), ids=ARMS)
def test_response_is_the_dynamic_modulus(arms):
    body = material(0.3, *arms)
    n = np.array([0.5, 1.0, 7.0])
    expected = np.asarray(body.dynamic_modulus(n * OMEGA)) / body.E_star
    assert_allclose(Rheology.of(body, OMEGA).response(n), expected, rtol=1e-13)


# --- runs ---


@pytest.mark.parametrize(
    ("T", "arms", "shape", "depth_ratio", "v"),
    [
        (0.0, ARMS["one"], "paraboloid", 3.0, 0.4),
        (0.0, ARMS["two"], "cone", 0.6, 0.3),
        (0.0, ARMS["one"], "flat", 3.0, 0.7),
        (0.5, ARMS["two"], "paraboloid", 3.0, 0.5),
        (0.5, ARMS["one"], "r4", -0.3, 0.2),
    ],
)
def test_cof_is_that_of_the_twin(T, arms, shape, depth_ratio, v):
    contact = case(T, *arms, shape, depth_ratio)
    run = mdr.slide(contact, v * contact.unit_velocity)
    springs = mdr.SpringArray.of(contact, 96)
    n = 4096 if depth_ratio < 0 else 2048  # the jumps of dashpots that touch are first order to the twin
    scaled = ScaledContact.of(contact, springs, 16, lump=False)
    n_periods = 4 + int(12 * max(arms[1]) * (1 + sum(arms[0])) / (2 * math.pi))  # 12 times the slowest retardation
    twin = reference_arms.cof(np.cos, scaled.gap, scaled.w, v, T, *arms, n, n_periods)
    # first order extrapolated, at kinks not quite; 96 springs
    assert_allclose(run.cof / contact.mu_0, twin, rtol=0, atol=1e-4)
    assert run.settled
    assert run.cof_error < 1e-5 * contact.mu_0
    assert run.cof < 0.99 * contact.mu_0


@pytest.mark.parametrize("T", [0.0, 0.6])
@pytest.mark.parametrize("v", [0.2, 0.7])
def test_arms_without_modulus_are_kelvin(T, v):
    one, two = case(T, [], []), case(T, [1e-12], [0.5])
    runs = [mdr.slide(each, v * each.unit_velocity) for each in (one, two)]
    # the two loops find the end of slip within a step in their own ways
    assert_allclose(runs[1].cof, runs[0].cof, rtol=0, atol=runs[0].cof_error if T == 0 else 1e-10)
    assert material(T, [0.0], [0.5]).contact_arms == ()


def test_one_arm_is_the_standard_solid():
    prony, solid = mdr.Prony(3e6, [(6e6, 2e-3)], 0.4), mdr.StandardLinearSolid(3e6, 6e6, 2e-3, 0.4)
    motion = mdr.NormalOscillation(6e-6, 2e-6, OMEGA)
    runs = [mdr.slide(mdr.SlidingContact(SHAPES["cone"][0], m, 0.4, motion), 3e-4) for m in (prony, solid)]
    assert runs[0] == runs[1]


@pytest.mark.parametrize("v", [0.3, 0.8])
def test_a_fast_arm_is_a_dashpot(v):
    T = 0.4
    kelvin, fast = case(T, [], []), case(0.0, [T / 1e-4], [1e-4])
    # what a dashpot is to an arm of time theta: its force lags by theta
    one, two = (mdr.slide(each, v * each.unit_velocity).cof for each in (fast, kelvin))
    assert_allclose(one, two, rtol=1e-4)


def test_a_slow_arm_is_a_spring():
    # beside a mean load it has relaxed; to the oscillation the body is stiffer by 1 + rho
    soft = case(0.0, [1.5], [1e5], "flat", 3.0)
    for v in (0.3, 0.8):
        deficit = 2.5 * (1 / 3) * mdr.closed_forms.paper.deficit(v)
        assert_allclose(1 - mdr.slide(soft, v * soft.unit_velocity).cof / 0.4, deficit, rtol=2e-4)


@pytest.mark.parametrize("arms", [ARMS["one"], ARMS["two"]], ids=["one", "two"])
@pytest.mark.parametrize("T", [0.0, 0.5])
def test_energy_is_kept(T, arms):
    pull = mdr.SpringPull(2e3, 0.02, 0.5)
    contact = case(T, *arms, pull=pull)
    residuals = []
    for steps in (256, 1024):
        run = mdr.slide(contact, 0.4 * contact.unit_velocity, steps_per_period=steps, n_springs=128)
        balance = run.energy_balance
        spent = balance.friction_loss + balance.viscous_loss + balance.damper_loss + balance.stored_change
        residuals.append(abs(balance.pull_work + balance.normal_work - spent) / balance.friction_loss)
    assert residuals[1] < 1e-4
    assert residuals[1] < residuals[0] / 12  # second order is 16


@pytest.mark.parametrize("start", ["full_slip", "rest"])
def test_both_starts_end_alike(start):
    contact = case(0.2, *ARMS["one"], pull=mdr.SpringPull(2e3, 0.02, 1.0))
    run = mdr.slide(contact, 0.5 * contact.unit_velocity, start=start, n_springs=96, steps_per_period=256)
    other = mdr.slide(contact, 0.5 * contact.unit_velocity, n_springs=96, steps_per_period=256)
    assert run.settled
    assert abs(run.cof - other.cof) <= run.cof_error + other.cof_error


def test_forces_of_springs_add_up():
    contact = case(0.2, *ARMS["two"], pull=mdr.SpringPull(2e3, 0.02, 1.0))
    for lump in (True, False):
        run = mdr.slide(contact, 0.5 * contact.unit_velocity, n_springs=96, steps_per_period=256, record=1, lump=lump)
        assert_allclose(run.f_x.sum(axis=1), run.F_x, rtol=1e-10, atol=1e-12 * run.F_z.max())
        assert_allclose(run.f_z.sum(axis=1), run.F_z, rtol=1e-10)
        assert np.all(np.abs(run.f_x) <= contact.mu_0 * run.f_z * (1 + 1e-9) + 1e-12 * run.F_z.max())
        sticks = run.state == mdr.State.STICK
        assert np.all(run.f_z[run.state == mdr.State.FREE] == 0)
        assert sticks.any()


@pytest.mark.parametrize("depth_ratio", [3.0, 0.6])
@pytest.mark.parametrize("arms", [ARMS["one"], ARMS["two"]], ids=["one", "two"])
@pytest.mark.parametrize("T", [0.0, 0.5])
def test_pressed_and_free_springs_obey_all_the_rules(T, arms, depth_ratio):
    contact = case(T, *arms, depth_ratio=depth_ratio, pull=mdr.SpringPull(2e3, 0.02, 1.0))
    scaled = ScaledContact.of(contact, mdr.SpringArray.of(contact, 77), 128, lump=False)
    (state, cofs, seen), plain = marched(scaled, 0.4), marched(scaled, 0.4, by_all_rules=True)
    for two, one in ((state.x, plain[0].x), (state.s, plain[0].s), (cofs, plain[1])):
        assert_allclose(two, one, rtol=0, atol=1e-12 * (1 + np.abs(one).max()))
    for name in ("sums", "F_x", "F_z", "f_x", "f_z"):
        one, two = getattr(plain[2], name), getattr(seen, name)
        assert_allclose(two, one, rtol=1e-9, atol=1e-9, err_msg=name)


def marched(scaled, v, by_all_rules=False):
    """State, COFs and a close look after some periods; by all rules: any spring may touch or leave at any step."""
    stepper = Stepper(scaled, v)
    if by_all_rules:
        spans = np.array([[0] * scaled.steps, [scaled.gap.size] * scaled.steps])
        stepper.motion = stepper.motion._replace(spans=spans)
    state, periods = stepper.advance(stepper.full_slip(), 3)
    state, record = stepper.observe(state, keep=True)
    return state, periods.cof, record.seen


def drawn(rng):
    """A contact with a motion of four harmonics and a material of any kind."""
    taus = 10 ** rng.uniform(-4, 0, 3)
    arms = [(3e6 * 10 ** rng.uniform(-1, 1), float(tau)) for tau in taus[: rng.integers(1, 4)]]
    kinds = [mdr.Elastic(3e6, 0.4), mdr.KelvinVoigt(3e6, 0.4, float(taus[0])), mdr.Prony(3e6, arms, 0.4)]
    cos, sin = (tuple(1e-6 * rng.normal(size=4)) for _ in range(2))
    shape = SHAPES[("cone", "paraboloid", "r4")[rng.integers(3)]][0]
    pull = mdr.SpringPull(2e3, 0.02, 1.0) if rng.random() < 0.5 else mdr.RigidPull()
    motion = mdr.PeriodicMotion(100.0, 2e-6 * rng.uniform(0.5, 3), cos, sin)
    return mdr.SlidingContact(shape, kinds[rng.integers(3)], 0.5, motion, pull)


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize(("n_springs", "steps"), [(2000, 32), (300, 64)])
def test_so_do_springs_of_fast_motions_in_coarse_steps(seed, n_springs, steps):
    """Touches and leaves of many springs fall into one step, inside and outside, and may alternate from period to
    period.
    """
    contact = drawn(np.random.default_rng(seed))
    scaled = ScaledContact.of(contact, mdr.SpringArray.of(contact, n_springs), steps, lump=False)
    try:
        (state, cofs, seen), plain = marched(scaled, 0.3), marched(scaled, 0.3, by_all_rules=True)
    except ValueError:
        pytest.skip("too coarse for the normal motion")
    for one, two in ((plain[0].e, state.e), (plain[1], cofs), (plain[2].F_z, seen.F_z)):
        assert_allclose(two, one, rtol=0, atol=1e-10 * (1 + np.abs(one).max()))


@pytest.mark.parametrize(("v", "least"), [(3.0, 1.0), (0.3, 0.5)])
@pytest.mark.parametrize("shape", ["cone", "paraboloid"])
def test_stiff_slow_arms_do_not_magnify_what_is_wrong_in_a_state_that_a_search_begins_in(shape, v, least):
    """A force ten thousand times the static one relaxes over 26 periods: sums over arms must belong to their springs,
    also in the combinations of states that a search tries and in states of other steps and springs.
    """
    contact = case(0.0, (1e4,), (164.0,), shape, depth_ratio=0.0)
    run = mdr.slide(contact, v * contact.unit_velocity)
    assert run.settled
    assert run.cof_error <= 1e-5 * contact.mu_0
    assert least - 1e-5 <= run.cof / contact.mu_0 <= 1 + 1e-5


def test_the_sums_over_arms_that_a_march_begins_with_are_those_of_its_springs():
    contact = case(0.0, *ARMS["two"], depth_ratio=0.5)
    stepper = Stepper(at_hand(contact, Knobs(32, 256, "full_slip", lump=False))[1], 0.4)
    state = stepper.advance(stepper.full_slip(), 2)[0]
    wrong = state.copy()
    wrong.body.arms[0] += 1.0
    right, mended = stepper.within_friction(state.copy()), stepper.within_friction(wrong)
    assert_allclose(mended.body.arms[0], right.body.arms[0], rtol=0, atol=0)
    assert_allclose(right.body.arms[0], state.body.arms[0], rtol=0, atol=1e-6 * np.abs(state.e).max())


def test_springs_that_find_no_periodic_motion_are_refused():
    body = mdr.Prony(3e6, [(3.511e5, 8.036e-4), (1.129e6, 1.618e-4)], 0.4, tau=0.4875)
    cos, sin = (2.19e-7, 3.7e-8, 1.66e-7, -1.293e-6), (4.08e-7, 1.274e-6, 5.3e-7, -1.606e-6)
    motion = mdr.PeriodicMotion(100.0, 1.14e-7, cos, sin)
    contact = mdr.SlidingContact(mdr.RoundedPunch(b=2e-4, R=5e-3), body, 0.5, motion)
    with pytest.raises(ValueError, match="steps_per_period = 64 is too coarse for the normal motion"):
        mdr.slide(contact, 0.3 * contact.unit_velocity, n_springs=300, steps_per_period=64, n_periods=2)
    run = mdr.slide(contact, 0.3 * contact.unit_velocity, n_springs=300, steps_per_period=1024, n_periods=2)
    assert np.isfinite(run.cof)


def test_a_material_that_flows_is_refused():
    with pytest.raises(ValueError, match="E_inf = 0: a mean load relaxes"):
        mdr.SlidingContact(
            SHAPES["cone"][0], mdr.Prony(0.0, [(1e6, 1.0)], 0.3), 0.5, mdr.NormalOscillation(1e-6, 1e-7, 1.0)
        )


@pytest.mark.filterwarnings("error", "ignore::mdr.PlausibilityWarning")
def test_a_material_that_relaxes_too_slowly_is_refused_and_one_almost_so_is_elastic_over_a_period():
    solid = mdr.Prony(3e6, [(2e6, 0.99e10 / OMEGA)], 0.5)
    motion = mdr.PeriodicMotion(OMEGA, 20e-6, (2e-6, 5e-7))
    slow = mdr.SlidingContact(mdr.FlatPunch(1e-3), solid, 0.4, motion)
    assert_allclose(mdr.static_cof(slow) / 0.4, 1 - 5 / 3 * (2e-6 - 5e-7) / 20e-6, rtol=1e-6)
    for body in (mdr.Prony(3e6, [(2e6, 1e300)], 0.5), mdr.KelvinVoigt(3e6, 0.5, 1e10)):
        for one in (motion, mdr.NormalOscillation(1e-6, 2e-6, OMEGA), mdr.LoadOscillation(1.0, 0.1, OMEGA)):
            too_slow = mdr.SlidingContact(mdr.FlatPunch(1e-3), body, 0.4, one)
            for question in (mdr.static_cof, mdr.full_slip_critical_velocity, lambda case: mdr.slide(case, 1e-3)):
                with pytest.raises(ValueError, match=r"tau\S* = 1e\+\d+ s is more than 1e\+10/omega"):
                    question(too_slow)
    assert mdr.Prony(3e6, [(2e6, 1e305)], 0.5).dynamic_modulus(OMEGA) == pytest.approx(5e6 / 0.75)


def test_slip_and_stick_are_told_apart_where_an_extension_dwarfs_a_step():
    """At u_z0 = 1e8 du_z the rounding of an extension is more than a billionth of the way of the body in a step."""
    motion = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-13, omega=OMEGA)
    solid = mdr.StandardLinearSolid(3e6, 6e4, 2e-3, 0.4)
    one = mdr.SlidingContact(mdr.Paraboloid(5e-3), solid, 0.4, motion)
    run = mdr.slide(one, 0.08 * one.unit_velocity, n_springs=32, steps_per_period=64, n_periods=4, record=1)
    assert np.all(np.abs(run.f_x) <= 0.4 * run.f_z * (1 + 1e-12))
    assert not np.any(run.state == mdr.State.SLIP_BACK)
