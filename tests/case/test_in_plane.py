"""Motion in the plane as a record: what it answers, what it refuses, and the period that it shares with the depth."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr
from mdr.case.depth_cycle import harmonic_sum
from mdr.given.vary import case_at

OMEGA = 300.0
PUNCH, RUBBER = mdr.FlatPunch(a=1e-3), mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1e-3)
DEPTH = mdr.ConstantDepth(u_z0=20e-6)
TAPPING = mdr.NormalOscillation(u_z0=20e-6, du_z=5e-6, omega=OMEGA)
SHAKE = mdr.InPlaneOscillation(omega=OMEGA, du_x=3e-6, phi_x=0.7)
RIGID = mdr.RigidPull()
BODY = mdr.SpringPull(k_x=2e4, m=0.05, c_x=3.0)


def contact(oscillation=TAPPING, shake=SHAKE, pull=RIGID):
    return mdr.SlidingContact(PUNCH, RUBBER, 0.4, oscillation, pull, shake)


def test_a_harmonic_shake_is_a_series_of_one():
    series = mdr.InPlaneMotion(OMEGA, x_cos=[3e-6 * np.cos(0.7)], x_sin=[-3e-6 * np.sin(0.7)])
    assert_allclose(series.along, SHAKE.along, rtol=1e-15)
    assert isinstance(series.x_cos, tuple)
    assert hash(series) == hash(replace(series))


def test_a_mirror_turns_the_shake_and_nothing_else():
    case = contact()
    assert_allclose(case.mirrored.shake_harmonics, -case.shake_harmonics, rtol=1e-15)
    assert replace(case.mirrored, shake=SHAKE) == case
    assert contact(shake=None).mirrored == contact(shake=None)
    saw = mdr.InPlaneMotion(OMEGA, x_cos=(1e-6,), x_sin=(2e-6, -1e-6))
    assert saw.mirrored.mirrored == saw


@pytest.mark.parametrize(("p", "q"), [(1, 1), (2, 1), (1, 3), (16, 15), (5, 16)])
def test_frequencies_in_whole_ratios_share_a_period(p, q):
    case = contact(replace(TAPPING, omega=p * OMEGA), replace(SHAKE, omega=q * OMEGA))
    assert case.repeats == (p, q)
    assert case.omega == pytest.approx(OMEGA, rel=1e-15)
    assert case.period == 2 * np.pi / case.omega
    t = np.linspace(0, case.period, 50)
    phase = case.omega * t
    assert_allclose(case.cycle.u_z0 + case.cycle.unit * case.cycle.z(phase), case.oscillation.u_z(t), rtol=1e-12)
    assert_allclose(harmonic_sum(case.shake_harmonics, phase), 3e-6 * np.cos(q * OMEGA * t + 0.7), rtol=0, atol=1e-18)


def test_the_tool_is_shaken_whole_and_the_pull_through_spring_and_damper():
    tool, far = (contact(pull=BODY, shake=replace(SHAKE, at=at)) for at in ("tool", "pull"))
    assert_allclose(tool.way, SHAKE.along)
    passed = (2e4 + 3j * OMEGA) / (2e4 + 3j * OMEGA - 0.05 * OMEGA**2)  # of the force of spring and damper
    assert_allclose(far.way, SHAKE.along * passed, rtol=1e-14)
    assert_allclose(contact(shake=replace(SHAKE, at="pull")).way, SHAKE.along)
    resonant = mdr.SpringPull(k_x=0.05 * OMEGA**2, m=0.05)
    assert np.isinf(contact(pull=resonant, shake=replace(SHAKE, at="pull")).way).all()


def test_groups_of_a_shaken_contact():
    constant = contact(DEPTH)
    assert constant.alpha == 0
    assert constant.chi == pytest.approx(3e-6 / (0.4 * 1.5 * 20e-6), rel=1e-14)
    assert constant.unit_velocity == pytest.approx(0.4 * 1.5 * OMEGA * 20e-6, rel=1e-14)
    assert constant.pace == pytest.approx(OMEGA * 3e-6, rel=1e-14)
    assert contact(shake=None).chi == 0
    assert contact(shake=None).pace == contact(shake=None).unit_velocity


def test_a_constant_load_rests_where_the_material_carries_it():
    ball = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), RUBBER, 0.4, mdr.ConstantLoad(F_z0=0.05), shake=SHAKE)
    known = mdr.resolved(ball)
    assert float(ball.indenter.force(known.working_depth, RUBBER.E_star)) == pytest.approx(0.05, rel=1e-12)
    assert known.cycle.u_z0 == known.working_depth
    run = mdr.slide(ball, 3e-4, n_springs=64, steps_per_period=128)
    assert run.mean_F_z == pytest.approx(0.05, rel=1e-6)


@pytest.mark.parametrize("load", [mdr.ConstantLoad(F_z0=0.05), mdr.LoadOscillation(0.05, 0.01, OMEGA)])
def test_chi_refers_to_the_depth_under_a_load(load):
    ball = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), RUBBER, 0.4, load, shake=SHAKE)
    varied = case_at(ball, {"chi": 2.0})
    assert mdr.resolved(varied).working_depth * 0.4 * 1.5 * 2.0 == pytest.approx(varied.shake.du_x, rel=1e-9)
    with pytest.raises(ValueError, match="no mean depth"):
        case_at(contact(mdr.NormalOscillation(0.0, 5e-6, OMEGA)), {"chi": 2.0})


def test_the_pace_is_no_less_than_any_critical_velocity():
    case = contact(replace(TAPPING, omega=15 * OMEGA), replace(SHAKE, omega=16 * OMEGA, du_x=1e-9))
    assert case.pace >= mdr.critical_velocity(case) * (1 - 1e-12)
