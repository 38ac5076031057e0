"""The normal force followed spring by spring: against the closed form where there is one, and harmonic by harmonic."""

import numpy as np
import pytest
from conftest import SHAPES, contact
from numpy.testing import assert_allclose

import mdr
from mdr.materials.operator import Rheology
from mdr.normal.followed_force import N_STEPS, normal_cycle
from mdr.normal.normal_force import contact_radius, edge_of, normal_force


@pytest.mark.parametrize("T", [0.0, 0.3, 3.0])
@pytest.mark.parametrize("depth_ratio", [5.0, 0.6, -0.3])
@pytest.mark.parametrize("shape", SHAPES)
def test_force_is_that_of_the_closed_form(shape, depth_ratio, T):
    case, phase = contact(shape, depth_ratio, T), 2 * np.pi * np.arange(N_STEPS) / N_STEPS
    known, cycle = normal_cycle(case.indenter, case.rheology, case.cycle), case.cycle
    F_N, a = normal_force(case, phase), contact_radius(case, phase)
    off = np.abs(case.material.E_star * known.F_N - F_N)
    # but for the instants next to the first touch, of a punch with a jump or of a tip within the first cell; with T = 3
    # springs at the edge press with 3 times their depth from the first touch on
    assert np.quantile(off, 0.99) < (1e-4 if T == 3 else 3e-5) * F_N.max()
    assert_allclose(case.material.E_star * known.F_N.mean(), F_N.mean(), rtol=3e-4 if shape == "flat" else 2e-5)
    assert np.quantile(np.abs(known.contact_radius - a), 0.99) < 0.01 * a.max()
    touches = cycle.u_z0 + cycle.unit * edge_of(case).gap(phase) > 0
    assert np.mean(known.in_contact != touches) < 2 / N_STEPS + 1e-12


def test_touch_is_between_two_instants():
    case = contact("paraboloid", -0.3)
    touch = 2 * np.pi - np.arccos(0.3)
    found = normal_cycle(case.indenter, case.rheology, case.cycle, 256, 64).touches
    assert_allclose(found, [touch], rtol=0, atol=5e-3)  # the first spring's foot lies a little deeper than the tip


def test_two_touches_a_period_are_seen():
    motion = mdr.PeriodicMotion(300.0, 0.0, cos=(0.0, 2e-6))
    case = mdr.SlidingContact(mdr.FlatPunch(1e-3), mdr.Elastic(3e6, 0.4), 0.4, motion)
    found = normal_cycle(case.indenter, case.rheology, case.cycle, 512, 64).touches
    assert_allclose(np.sort(found), [0.75 * np.pi, 1.75 * np.pi], rtol=0, atol=1.01 * 2 * np.pi / 512)


@pytest.mark.parametrize("theta", [0.3, 30.0, 3000.0])
@pytest.mark.parametrize("depth_ratio", [1.0, -0.2])
def test_arms_are_in_their_periodic_state_however_slow(theta, depth_ratio):
    # the mean of every arm over a period is zero, so the mean force is that of the mean compression, E_inf alone
    case = contact("paraboloid", depth_ratio)
    rheology = Rheology(0.0, (3.0,), (theta,))
    coarse, fine = (normal_cycle(case.indenter, rheology, case.cycle, n, 128) for n in (1024, 4096))
    assert_allclose(coarse.F_N.mean(), fine.F_N.mean(), rtol=1e-4)
    # an arm far slower than the period gives a mean support: the surface stands lower where the indenter leaves it
    assert fine.F_N.min() >= -1e-18
    assert fine.F_N.max() > 0
