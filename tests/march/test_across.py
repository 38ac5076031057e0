"""Runs of contacts that are shaken across: beside the twin, the rigid limit, closed forms, energies, what is kept."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

OMEGA, MU_0, DEPTH = 300.0, 0.4, 20e-6


def contact(eta, indenter=None, material=None, **others):
    material = material or mdr.Elastic(3e6, 0.5)
    shake = mdr.InPlaneOscillation(OMEGA, du_y=eta * MU_0 * material.mindlin_ratio * DEPTH)
    motion = others.pop("oscillation", mdr.ConstantDepth(DEPTH))
    shake = replace(shake, **{name: others.pop(name) for name in ("du_x", "phi_x", "at") if name in others})
    return mdr.SlidingContact(indenter or mdr.Paraboloid(R=5e-3), material, MU_0, motion, shake=shake, **others)


BODY = mdr.SpringPull(k_x=2e4, m=0.05, c_x=10.0, k_y=3e4, c_y=8.0)


@pytest.mark.parametrize("r", [0.1, 1.0, 3.0])
def test_far_shaken_it_is_rigid(r):
    case = contact(1e4, mdr.FlatPunch(a=1e-3))
    run = mdr.slide(case, r * OMEGA * case.shake.du_y)
    assert run.cof / MU_0 == pytest.approx(mdr.laws.rigid_across(r), abs=1e-4)  # springs yield 1e-4 of the shake


def test_friction_comes_back_by_the_law_of_fast_slides():
    for material in (mdr.Elastic(3e6, 0.5), mdr.KelvinVoigt(3e6, 0.5, 3e-3)):
        case = contact(0.5, material=material)
        off = []
        for v_0 in (16 * case.pace, 32 * case.pace):
            lost = 1 - mdr.slide(case, v_0, accuracy=1e-8).cof / MU_0
            off.append(abs(lost - mdr.laws.lost_across(case, v_0)))
        assert 13 < off[0] / off[1] < 18  # of fourth order


def test_slow_slides_tend_to_what_is_held():
    case = contact(0.5)
    far, near = (mdr.slide(case, share * case.pace).cof for share in (0.002, 0.001))
    held = mdr.static_cof(case)
    assert held < near < far
    assert 2 * near - far == pytest.approx(held, abs=0.3 * (far - near))  # not quite linear


@pytest.mark.parametrize("du_x", [0.0, 3e-6])
def test_a_curve_has_the_forces_across_of_its_runs_both_ways(du_x):
    motion, punch = mdr.NormalOscillation(DEPTH, 5e-6, OMEGA), mdr.FlatPunch(a=1e-3)  # one spring: rest takes long
    case = contact(0.5, punch, du_x=du_x, phi_x=0.7, oscillation=motion)
    v_0 = np.array([-1e-3, 1e-3, 2e-3])
    curve, runs = mdr.cof_curve(case, v_0, accuracy=1e-4), [mdr.slide(case, v) for v in v_0]
    assert_allclose(curve.cof, [run.cof for run in runs], rtol=0, atol=1e-4 * MU_0)
    assert_allclose(curve.cof_y, [run.cof_y for run in runs], rtol=0, atol=1e-4 * MU_0)
    assert (curve.cof_y[0] == curve.cof_y[1]) == case.is_alike_both_ways == (du_x == 0)


def test_what_is_kept_of_a_run():
    run = mdr.slide(contact(0.8), 1e-3, record=1)
    assert run.u_y.shape == run.F_y.shape == run.t.shape
    assert run.f_y.shape == run.e_y.shape == run.f_x.shape
    most = np.hypot(run.f_x, run.f_y) - MU_0 * run.f_z
    assert most.max() <= 1e-12 * run.f_z.max()
    assert_allclose(run.f_y.sum(axis=1), run.F_y, atol=1e-12 * run.mean_F_z)
    assert "F_y [N]" in run.table().splitlines()[0]
    plain = mdr.slide(replace(contact(0.8), shake=mdr.InPlaneOscillation(OMEGA, du_x=1e-5)), 1e-3, record=1)
    assert (plain.u_y, plain.cof_y) == (None, 0.0)


def test_no_velocity_is_critical():
    case = contact(0.5)
    assert np.isinf([mdr.critical_velocity(case), mdr.full_slip_critical_velocity(case)]).all()
    found = mdr.verdict(case)
    assert found.measured is None
    assert "lost_across" in str(found)
    assert str(mdr.verdict(contact(0.005))).count("within 1 % of mu_0 at any velocity") == 1


def test_a_body_without_mass_is_the_limit_of_light_ones():
    """What a small mass changes is of its order: half of it changes half as much."""
    case = contact(0.8, oscillation=mdr.NormalOscillation(DEPTH, 5e-6, OMEGA), at="pull", pull=BODY)
    runs = [
        mdr.slide(replace(case, pull=replace(BODY, m=m)), 1e-3, n_springs=32, steps_per_period=256)
        for m in (2e-3, 1e-3, 0.0)
    ]
    heavy, half, light = np.array([(run.cof, run.cof_y) for run in runs]) / MU_0
    assert all(run.settled for run in runs)
    assert np.abs(half - light).max() < 0.6 * np.abs(heavy - light).max() < 0.02
    assert np.abs(half - light).max() > 1e-5
