"""Full slip of the whole array against the twin, the springs, Eqs. (1), (4), (7), (15), and where it is infinite."""

import math
from dataclasses import replace

import numpy as np
import pytest
from conftest import SHAPES, contact
from numpy.testing import assert_allclose
from twins import full_slip
from twins import rigid_pull as reference

import mdr
from mdr.closed_forms import paper
from mdr.normal.normal_force import contact_radius, mean_normal_force, normal_force

COS = np.ones(1, dtype=complex)  # of the depth

# --- the normal force ---


@pytest.mark.parametrize("T", [0.3, 1.0, 2.5])
def test_force_of_a_kelvin_punch_that_keeps_contact_is_eq_4(T):
    case = contact("flat", 3.0, T)
    osc, phase = case.oscillation, 2 * np.pi * np.arange(256) / 256
    expected = paper.eq_4(phase / osc.omega, osc.u_z0, osc.du_z, osc.omega, case.k_zc, case.gamma_zc)
    assert case.keeps_contact
    assert_allclose(normal_force(case, phase), expected, rtol=1e-12, atol=1e-12 * expected.max())
    assert_allclose(contact_radius(case, phase), case.indenter.a)


@pytest.mark.parametrize("T", [0.0, 0.5, 3.0])
@pytest.mark.parametrize("depth_ratio", [30.0, 3.0, 0.6])
@pytest.mark.parametrize("shape", SHAPES)
def test_force_against_the_twin(shape, depth_ratio, T):
    case, phase = contact(shape, depth_ratio, T), 2 * np.pi * np.arange(200) / 200
    row = full_slip.Row(COS, SHAPES[shape][1], depth_ratio, T)
    unit = case.k_zc * case.oscillation.du_z / depth_ratio**row.power
    # the force does not change to first order with the edge; what is left is rounding
    near = 1e-12 * (depth_ratio + T) * depth_ratio**row.power
    assert_allclose(normal_force(case, phase) / unit, row(phase)[0], rtol=0, atol=near)


@pytest.mark.parametrize("T", [0.0, 0.5, 3.0, 30.0])
@pytest.mark.parametrize("depth_ratio", [5.0, 0.9, -0.3])
@pytest.mark.parametrize("shape", SHAPES)
def test_mean_force_is_that_of_the_mean_compression(shape, depth_ratio, T):
    case = contact(shape, depth_ratio, T)
    k = float(case.indenter.stiffness(case.u_z_max, case.material.E_star))
    got = mean_normal_force(case) / (k * case.oscillation.du_z)
    twin = reference.mean_force(SHAPES[shape][1], depth_ratio, T, reference_depth=depth_ratio + 1)
    assert_allclose(got, twin, rtol=1e-10)  # both are quadratures between the same kinks


# --- static friction ---


@pytest.mark.parametrize(("depth_ratio", "T"), [(30.0, 3.0), (3.0, 0.0), (3.0, 0.3), (3.0, 3.0), (1.2, 0.3)])
@pytest.mark.parametrize("shape", SHAPES)
def test_static_cof_against_the_twin(shape, depth_ratio, T):
    got = mdr.static_cof(contact(shape, depth_ratio, T)) / 0.4
    if depth_ratio < math.hypot(1, T):
        assert got == 0
        return
    row, phase = full_slip.Row(COS, SHAPES[shape][1], depth_ratio, T), np.linspace(0, 2 * np.pi, 201)
    for reach in (2 * np.pi / 200, 1e-3, 1e-5):  # around the least force so far
        phase = phase[np.argmin(row(phase)[0])] + reach * np.linspace(-1, 1, 201)
    mean = reference.mean_force(SHAPES[shape][1], depth_ratio, T) * depth_ratio**row.power
    assert_allclose(got, row(phase)[0].min() / mean, rtol=0, atol=1e-11)


@pytest.mark.parametrize("question", [mdr.static_cof, mdr.full_slip_critical_velocity])
def test_a_contact_too_brief_to_follow_is_refused_by_name(question):
    motion = mdr.PeriodicMotion(300.0, 1e-6, (2e-6, 5e-7), (0.0, 3e-7))
    case = mdr.SlidingContact(mdr.Paraboloid(5e-3), mdr.Prony(3e6, [(1e6, 1.0)], 0.5, 1e6), 0.4, motion)
    with pytest.raises(ValueError, match="the contact lasts less than 1/2048 of a period"):
        question(case)


def test_the_static_limit_is_mu_0_where_the_critical_velocity_is_zero():
    """A flat punch without damping at m omega² = k_x + k_xc goes with the vibration, and slips at any pull."""
    case = mdr.SlidingContact(
        mdr.FlatPunch(1e-3), mdr.Elastic(3e6, 0.5), 0.4, mdr.NormalOscillation(20e-6, 6e-6, 300.0)
    )
    k_xc = case.k_xc

    def at(k_x, c_x=0.0, mass=1.0):
        return replace(case, pull=mdr.SpringPull(k_x, mass * (k_x + k_xc) / 300.0**2, c_x))

    for k_x in k_xc * np.array([0.3, 1.0, 7.0]):
        assert mdr.full_slip_critical_velocity(at(k_x)) < 1e-12 * case.unit_velocity
        assert mdr.static_cof(at(k_x)) == 0.4
        assert mdr.slide(at(k_x), 1e-3 * case.unit_velocity).cof == pytest.approx(0.4, rel=1e-10)
    for other in (at(k_xc, c_x=0.01 * k_xc / 300.0), at(k_xc, mass=1.01), replace(at(k_xc), indenter=mdr.Cone(0.02))):
        limit = mdr.static_cof(other)
        assert limit < 0.3
        slow = mdr.slide(other, 1e-2 * mdr.full_slip_critical_velocity(other))
        assert limit <= slow.cof < 0.39
