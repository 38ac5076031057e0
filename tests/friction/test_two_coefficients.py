"""Answers on friction that falls as springs are let go: curves, critical velocities, fits."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

MATERIALS = {"elastic": mdr.Elastic(3e6, 0.4), "Kelvin": mdr.KelvinVoigt(3e6, 0.4, 1e-3)}
SHAPES = {"punch": mdr.FlatPunch(1e-3), "ball": mdr.Paraboloid(5e-3)}


def contact(alpha, stick, shape="punch", material="elastic", pull=None):
    motion = mdr.NormalOscillation(20e-6, alpha * 20e-6, 300.0)
    law, pull = mdr.StaticKinetic(0.5 * stick, 0.5), pull or mdr.RigidPull()
    return mdr.SlidingContact(SHAPES[shape], MATERIALS[material], oscillation=motion, friction=law, pull=pull)


def test_a_slow_pull_has_the_mean_of_both_coefficients_in_the_least_load():
    case = contact(0.4, 1.5, "ball")
    plain = replace(case, friction=mdr.Coulomb(0.5))
    assert_allclose(mdr.static_cof(case), 1.25 * mdr.static_cof(plain), rtol=1e-14)
    law = mdr.laws.falling_friction(1e-4, 0.4, 1.5)
    assert_allclose(mdr.static_cof(contact(0.4, 1.5)), 0.5 * law.share, atol=1e-3)


def test_a_curve_has_points_above_sliding_and_a_jump_at_its_v_c():
    case = contact(0.4, 1.5)
    v = np.array([0.0, 0.3, 1 - 1e-5, 1 + 1e-5])
    curve = mdr.cof_curve(case, v * case.unit_velocity)
    laws = [mdr.laws.falling_friction(one, 0.4, 1.5).share for one in v[1:3]]
    assert curve.falls
    assert_allclose(curve.share, [0.75, *laws, 1.0], rtol=0, atol=1e-5)
    assert curve.settled.all()
    line = curve.plot().get_lines()[0]
    assert np.isnan(line.get_ydata()).sum() == 1  # broken where it jumps


def test_a_curve_knows_no_rest_where_no_closed_form_has_it(capsys):
    case = contact(0.4, 1.5, material="Kelvin")
    curve = mdr.cof_curve(case, [0.5 * case.unit_velocity], n_springs=32, steps_per_period=64)
    assert curve.static_cof is None
    assert "at rest" not in str(curve)
    curve.plot()
    with pytest.raises(ValueError, match="static_cof takes an elastic material where friction falls"):
        mdr.cof_curve(case, [0.0])


@pytest.mark.parametrize(("material", "words"), [("elastic", "by 0.0657 of it"), ("Kelvin", "above that of sliding")])
def test_a_verdict_says_how_far_friction_overshoots(material, words):
    case = contact(0.4, 1.5, material=material)
    found = mdr.verdict(case)
    assert found.holds
    assert words in str(found)


@pytest.mark.parametrize(
    "asked",
    [
        mdr.measure_critical_velocity,
        mdr.verdict,
        lambda case: mdr.find(case, "oscillation.du_z", v_0=1e-4, share=0.9),
        lambda case: mdr.half_space.slide(case, 1e-4),
        lambda case: mdr.half_space.curve(case, [1e-4]),
        mdr.blocked_cof,
    ],
)
def test_other_answers_are_refused_and_say_what_to_ask(asked):
    with pytest.raises(ValueError, match=r"takes .*got .*: ask (mdr\.)?(slide|cof_curve|full_slip)"):
        asked(contact(0.4, 1.5, "ball"))


def test_a_flat_face_that_is_kept_has_the_critical_velocity_of_the_kinetic_coefficient():
    case = contact(0.4, 1.5, material="Kelvin", pull=mdr.SpringPull(k_x=2e3, m=0.01, c_x=1.0))
    plain = replace(case, friction=mdr.Coulomb(0.5))
    assert mdr.full_slip_critical_velocity(case) == mdr.full_slip_critical_velocity(plain)
    assert_allclose(mdr.critical_velocity(case), mdr.full_slip_critical_velocity(plain), rtol=1e-14)


def test_a_fit_finds_both_coefficients_and_a_tolerance_varies_both():
    case = contact(0.4, 1.4)
    v = np.array([0.2, 0.4, 0.6, 0.8, 0.95, 1.2]) * case.unit_velocity
    scatter = 1e-3 * np.array([1.0, -1.0, 0.5, -0.5, 1.0, -1.0])
    data = mdr.FrictionData(v, mdr.cof_curve(case, v).cof + scatter, error=np.full(v.size, 1e-3))
    found = mdr.fit(replace(case, friction=mdr.StaticKinetic(0.6, 0.45)), data, ["mu_s", "mu_k"])
    for name, true in (("mu_s", 0.7), ("mu_k", 0.5)):
        low, high = found.low[name], found.high[name]
        assert low < true < high
        assert high - low < 0.05
    less, more = mdr.tolerance(case, v[2], fields=["mu_s"]).cof["mu_s"]
    assert less < more
