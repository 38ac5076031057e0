"""The scaled form: groups are all that is left, and the full-slip start repeats itself."""

import math
from dataclasses import replace
from operator import attrgetter

import numpy as np
import pytest
from conftest import SHAPES, contact, unit_of_velocity
from kernels import marched
from numpy.testing import assert_allclose
from random_records import case_in_units

import mdr
from mdr.march.dynamics.body import U
from mdr.march.dynamics.dimensionless import ScaledContact, fast_ratio
from mdr.march.dynamics.stepper import Stepper

STEPS = 256
BODIES = {
    "undamped": {"k_ratio": 0.7, "omega_0_ratio": 1.6, "c_ratio": 0.0},
    "damped": {"k_ratio": 0.7, "omega_0_ratio": 1.6, "c_ratio": 0.15},
    "overdamped": {"k_ratio": 0.7, "omega_0_ratio": 0.6, "c_ratio": 9.0},
    "soft": {"k_ratio": 0.05, "omega_0_ratio": 0.4, "c_ratio": 0.01},
}


def shaken(case, chi):
    """chi: du_x over the deflection at which the deepest spring slips; None without a shake."""
    if chi is None:
        return case
    du_x = chi * case.mu_0 * case.material.mindlin_ratio * case.oscillation.u_z0
    return replace(case, shake=mdr.InPlaneOscillation(case.omega, du_x, 0.7, at="pull"))


def scaled_form(case, steps=STEPS, n_springs=32, lump=False):
    return ScaledContact.of(case, mdr.SpringArray.of(case, n_springs), steps, lump)


def scaled_of(*groups, steps=STEPS, n_springs=32, lump=False, **knobs):
    return scaled_form(contact(*groups, **knobs), steps, n_springs, lump)


# --- what the groups are ---


def test_scaled_motion_and_springs():
    case = contact("paraboloid", 3.0, 0.5)
    springs = mdr.SpringArray.of(case, 40)
    scaled = ScaledContact.of(case, springs, STEPS, lump=False)
    t = scaled.drive.h * np.arange(STEPS + 1) / case.oscillation.omega
    u_z = case.oscillation.u_z0 + scaled.drive.z * scaled.units.length_z
    assert_allclose(u_z, case.oscillation.u_z(t), rtol=1e-14)
    u_z_dot = scaled.drive.z_dot * scaled.units.length_z * scaled.units.omega
    assert_allclose(u_z_dot, case.oscillation.u_z_dot(t), rtol=0, atol=1e-14 * 6e-4)
    assert_allclose(scaled.springs.gap * scaled.units.length_z, springs.gap, rtol=1e-15)
    assert_allclose(scaled.springs.w.sum(), 1, rtol=1e-14)
    assert_allclose(scaled.springs.w * scaled.units.stiffness_z, springs.dk_z, rtol=1e-13)
    assert_allclose(scaled.springs.w * scaled.units.stiffness_x, springs.dk_x, rtol=1e-13)
    assert_allclose(scaled.units.speed, unit_of_velocity(case), rtol=1e-14)  # Eq. (1)
    assert scaled.drive.steps == STEPS


@pytest.mark.parametrize("chi", [None, 1.2])
@pytest.mark.parametrize("body", [{}, BODIES["damped"], {"k_ratio": 0.7, "omega_0_ratio": math.inf}])
@pytest.mark.parametrize("shape", SHAPES)
def test_friction_moduli_and_units_drop_out(shape, body, chi):
    """A run sees no more than these numbers: so it is the same of a nanometre tip and of a railway wheel."""
    case = shaken(contact(shape, 3.0, 0.5, **body), chi)
    changes = ({"mu_0": 0.01}, {"E": 3e11}, {"nu": 0.1}, {"omega": 1e6})
    others = [shaken(contact(shape, 3.0, 0.5, **body, **change), chi) for change in changes]
    others += [case_in_units(case, *units) for units in ((1e-6, 1e-3, 1e-9), (6.0, 5.0, 7e6), (1e3, 1.0, 1e3))]
    way = () if chi is None else ("drive.along.x", "drive.along.x_dot")
    groups_of = attrgetter(
        "springs.gap", "springs.w", "drive.z", "drive.z_dot", "law.T", "body.M", "body.C", "body.K", "body.free", *way
    )
    one = groups_of(scaled_form(case))
    for other in others:
        for here, there in zip(groups_of(scaled_form(other)), one, strict=True):
            assert_allclose(here, there, rtol=1e-11, atol=1e-13)  # a way through zero


def test_springs_that_stand_alike_are_one():
    flat = scaled_of("flat", 3.0, 0.5, lump=True)
    assert (flat.springs.gap.size, flat.n_alike) == (1, 32)
    assert flat.springs.w.sum() == 1
    assert scaled_of("paraboloid", 3.0, 0.5, lump=True).springs.gap.size == 32


def test_fast_ratio():
    assert fast_ratio(contact("paraboloid")) == 0
    assert math.isinf(fast_ratio(contact("paraboloid", 3.0, 0.0, 0.7, math.inf)))
    # flat punch: omega_1**2/omega_0**2 = (k_x + k_xc)/k_x
    assert_allclose(fast_ratio(contact("flat", 3.0, 0.0, 0.7, 1.6)), 1.6 * math.sqrt(1.7 / 0.7), rtol=1e-13)


def on_an_arm(ratio, time):
    """A flat punch on an arm of `ratio` times the static stiffness that relaxes within `time` of 1/omega; M = K = 1."""
    arm = mdr.StandardLinearSolid(3e6, ratio * 3e6, time / 300.0, 0.4)
    case = mdr.SlidingContact(SHAPES["flat"][0], arm, 0.4, mdr.NormalOscillation(6e-6, 2e-6, 300.0))
    return replace(case, pull=mdr.SpringPull(case.k_xc, case.k_xc / 300.0**2))


@pytest.mark.parametrize("ratio", [2.0, 1e4, 1e6])
def test_fast_ratio_has_the_arms_that_do_not_relax_in_that_oscillation(ratio):
    assert_allclose(fast_ratio(on_an_arm(ratio, 1e3)), math.sqrt(2 + ratio), rtol=1e-6)
    assert_allclose(fast_ratio(on_an_arm(ratio, 1e-3 / ratio)), math.sqrt(2), rtol=1e-6)


@pytest.mark.parametrize("time", [0.01, 0.1, 1.0])
def test_fast_ratio_is_a_resonance_on_the_storage_modulus(time):
    case = on_an_arm(30.0, time)
    fast = fast_ratio(case)
    assert_allclose(fast**2, 1 + case.rheology.response(fast).real, rtol=1e-6)


# --- the start ---


@pytest.mark.parametrize("T", [0.0, 0.5, 3.0])
@pytest.mark.parametrize(
    "body", [*BODIES.values(), {"k_ratio": 0.7, "omega_0_ratio": math.inf}], ids=[*BODIES, "no mass"]
)
@pytest.mark.parametrize("shape", ["flat", "paraboloid"])
def test_full_slip_repeats_itself_under_the_march(shape, body, T):
    scaled = scaled_of(shape, 4.0, T, **body)
    s, start = scaled.normal.s, scaled.full_slip.state()
    state, trace, solved = marched(scaled, 1e3, 3)
    assert solved
    e, held, area, y = state.e, state.body, trace.area, trace.u
    # the rate of a light body takes a rounding of the force 1/h times
    size = np.abs(y).max() + np.abs(start).max()
    assert_allclose(held, start, rtol=0, atol=(1e-11 if scaled.body.light else 1e-15 * STEPS) * size)
    assert_allclose(e, s, rtol=0, atol=1e-12 * (1 + s.max()))
    assert_allclose(area[:STEPS], scaled.normal.area, rtol=0, atol=1e-12 * np.abs(area).max())  # as known beforehand
    assert_allclose(area[:STEPS], area[-STEPS:], rtol=0, atol=1e-11 * np.abs(area).max())


@pytest.mark.parametrize("multiple", [1, 2])
def test_the_resonant_harmonic_is_left_out(multiple):
    """omega_0 = multiple * omega without damper: no periodic motion answers that harmonic."""
    odd = scaled_of("paraboloid", 3.0, 0.0, 0.7, float(multiple), 0.0, steps=STEPS - 1)
    assert odd.full_slip.end == math.inf
    scaled = scaled_of("paraboloid", 3.0, 0.0, 0.7, float(multiple), 0.0)
    area = np.fft.rfft(scaled.normal.area)
    assert abs(area[multiple]) > 1e-4 * abs(area[0])  # it is driven
    assert scaled.full_slip.end == math.inf
    start = scaled.full_slip.state()
    assert np.abs(start).max() < 100
    # the other harmonics: off the resonance by a little they are the same, and this one is all the difference
    near = scaled_of("paraboloid", 3.0, 0.0, 0.7, multiple * (1 + 1e-6), 0.0)
    y = np.fft.irfft(np.where(np.arange(area.size) == multiple, 0, near.full_slip._motion[0][0]), STEPS)
    assert_allclose(start[U], y[0], rtol=1e-4)


def test_rest_is_rest():
    """The body stands still: its motion relative to the pull runs backward at v."""
    v = 0.3
    start = Stepper(scaled_of("paraboloid", 3.0, 0.5, **BODIES["damped"]), v).rest()
    assert start.body.tolist() == [0.0, -v]
    assert not start.e.any()
    assert not Stepper(scaled_of("paraboloid"), v).rest().body.any()
    assert not scaled_of("paraboloid").full_slip.state().any()


def test_body_groups_are_those_of_the_oscillator():
    case = contact("paraboloid", 3.0, 0.5, 0.7, 1.6, 0.15)
    scaled = scaled_form(case)
    omega, unit = case.oscillation.omega, scaled.units.stiffness_x
    groups = np.array([case.pull.m * omega**2, case.pull.c_x * omega, case.pull.k_x]) / unit
    assert_allclose([scaled.body.M, scaled.body.C, scaled.body.K], groups)
    assert_allclose(math.sqrt(scaled.body.K / scaled.body.M), 1.6, rtol=1e-13)
