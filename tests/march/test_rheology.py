"""Runs of springs with arms: against their twin, against materials that they come near to, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import SHAPES
from contacts import solid, with_arms
from numpy.testing import assert_allclose

import mdr
from mdr.materials.operator import Rheology

ARMS = {"one": ((2.0,), (0.7,)), "two": ((1.5, 0.5), (0.3, 4.0)), "fast and slow": ((20.0, 3.0), (1e-3, 50.0))}
OMEGA = 300.0


def case(T, rho, theta, shape="paraboloid", depth_ratio=3.0):
    return with_arms(shape, depth_ratio, solid(T, rho, theta), 0.0).case


@pytest.mark.parametrize("arms", ARMS.values(), ids=ARMS)
def test_response_is_the_dynamic_modulus(arms):
    body = solid(0.3, *arms)
    n = np.array([0.5, 1.0, 7.0])
    expected = np.asarray(body.dynamic_modulus(n * OMEGA)) / body.E_star
    assert_allclose(Rheology.of(body, OMEGA).response(n), expected, rtol=1e-13)


# --- runs ---


@pytest.mark.parametrize("v", [0.3, 0.8])
def test_a_fast_arm_is_a_dashpot(v):
    T = 0.4
    kelvin, fast = case(T, [], []), case(0.0, [T / 1e-4], [1e-4])
    # what a dashpot is to an arm of time theta: its force lags by theta
    one, two = (mdr.slide(each, v * each.unit_velocity).cof for each in (fast, kelvin))
    assert_allclose(one, two, rtol=1e-4)


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


def test_springs_on_a_material_of_fast_arms_find_their_periodic_motion_in_coarse_steps_too():
    body = mdr.Prony(3e6, [(3.511e5, 8.036e-4), (1.129e6, 1.618e-4)], 0.4, tau=0.4875)
    cos, sin = (2.19e-7, 3.7e-8, 1.66e-7, -1.293e-6), (4.08e-7, 1.274e-6, 5.3e-7, -1.606e-6)
    motion = mdr.PeriodicMotion(100.0, 1.14e-7, cos, sin)
    contact = mdr.SlidingContact(mdr.RoundedPunch(b=2e-4, R=5e-3), body, 0.5, motion)
    coarse, fine = (mdr.slide(contact, 0.3 * contact.unit_velocity, steps_per_period=n) for n in (64, 1024))
    assert coarse.settled
    assert abs(coarse.cof - fine.cof) <= coarse.cof_error + fine.cof_error


@pytest.mark.filterwarnings("error", "ignore::mdr.PlausibilityWarning")
def test_a_dashpot_that_relaxes_too_slowly_is_refused_and_a_slow_arm_is_elastic_over_a_period():
    motion = mdr.PeriodicMotion(OMEGA, 20e-6, (2e-6, 5e-7))
    for tau in (0.99e10 / OMEGA, 1e300):
        slow = mdr.SlidingContact(mdr.FlatPunch(1e-3), mdr.Prony(3e6, [(2e6, tau)], 0.5), 0.4, motion)
        assert_allclose(mdr.static_cof(slow) / 0.4, 1 - 5 / 3 * (2e-6 - 5e-7) / 20e-6, rtol=1e-6)
    for one in (motion, mdr.NormalOscillation(1e-6, 2e-6, OMEGA), mdr.LoadOscillation(1.0, 0.1, OMEGA)):
        too_slow = mdr.SlidingContact(mdr.FlatPunch(1e-3), mdr.KelvinVoigt(3e6, 0.5, 1e10), 0.4, one)
        for question in (mdr.static_cof, mdr.full_slip_critical_velocity, lambda case: mdr.slide(case, 1e-3)):
            with pytest.raises(ValueError, match=r"tau = 1e\+\d+ s is more than 1e\+10/omega"):
                question(too_slow)
    assert mdr.Prony(3e6, [(2e6, 1e305)], 0.5).dynamic_modulus(OMEGA) == pytest.approx(5e6 / 0.75)


SLOW_CONTACTS = {"kept": ("paraboloid", 0.4, False), "lost": ("cone", 1.3, False), "on a body": ("cone", 0.7, True)}


def slow_contact(name, tau, rho=(40.0, 0.6)):
    """A slow arm of omega tau, beside one that is not."""
    shape, alpha, has_body = SLOW_CONTACTS[name]
    body = mdr.Prony(3e6, [(3e6 * rho[0], tau / OMEGA), (3e6 * rho[1], 1.7 / OMEGA)], 0.4)
    one = mdr.SlidingContact(SHAPES[shape][0], body, 0.4, mdr.NormalOscillation(10e-6, alpha * 10e-6, OMEGA))
    k_x = 20 * one.k_xc
    pull = mdr.SpringPull(k_x=k_x, m=k_x / (1.6 * OMEGA) ** 2, c_x=0.3 * k_x / OMEGA)
    return replace(one, pull=pull) if has_body else one


@pytest.mark.parametrize("name", SLOW_CONTACTS)
def test_an_arm_that_a_period_does_not_tell_from_a_spring_is_the_limit_of_slow_ones(name):
    """What slower arms change falls with 1/tau: so the limit follows from runs that wait for them."""
    size = {"n_springs": 48, "steps_per_period": 64}
    one = slow_contact(name, 1e28)
    v_0 = 0.4 * one.unit_velocity
    run, less, more = (mdr.slide(slow_contact(name, tau), v_0, **size) for tau in (1e28, 2e3, 4e3))
    assert all(one.settled for one in (run, less, more))
    # 1e-6 of mu_0 is what searches leave, and the next order of 1/tau
    assert abs(run.cof - (2 * more.cof - less.cof)) <= 3e-6 * one.mu_0
    assert abs(run.cof - more.cof) > 1e-7 * one.mu_0  # so that the comparison can fail


def test_arms_over_thirty_decades_are_those_that_a_period_sees_beside_a_spring():
    rng = np.random.default_rng(50)
    tau, E = 10.0 ** np.linspace(-15, 15, 31) / OMEGA, 3e6 * rng.dirichlet(np.ones(31)) * 30
    seen = (OMEGA * tau > 1e-7) & (OMEGA * tau < 1e6)
    slow = float(E[OMEGA * tau >= 1e6].sum())
    table = mdr.Prony(3e6, list(zip(E.tolist(), tau.tolist(), strict=True)), 0.5)
    few = mdr.Prony(3e6, [(slow, 1e20), *zip(E[seen].tolist(), tau[seen].tolist(), strict=True)], 0.5)
    motion = mdr.NormalOscillation(10e-6, 4e-6, OMEGA)
    runs = [mdr.slide(mdr.SlidingContact(SHAPES["cone"][0], one, 0.4, motion), 2e-4) for one in (table, few)]
    assert runs[0].settled
    assert runs[0].cof_error <= 1.1e-5 * 0.4
    # arms of 1e-8/omega and 30 E are dashpots of 3e-7
    assert_allclose(runs[0].cof, runs[1].cof, rtol=0, atol=4e-6 * 0.4)


def test_slip_and_stick_are_told_apart_where_an_extension_dwarfs_a_step():
    """At u_z0 = 1e8 du_z the rounding of an extension is more than a billionth of the way of the body in a step."""
    motion = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-13, omega=OMEGA)
    solid = mdr.StandardLinearSolid(3e6, 6e4, 2e-3, 0.4)
    one = mdr.SlidingContact(mdr.Paraboloid(5e-3), solid, 0.4, motion)
    run = mdr.slide(one, 0.08 * one.unit_velocity, n_springs=32, steps_per_period=64, n_periods=4, record=1)
    assert np.all(np.abs(run.f_x) <= 0.4 * run.f_z * (1 + 1e-12))
    assert not np.any(run.state == mdr.State.SLIP_BACK)
