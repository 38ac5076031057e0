"""From a rig to a case: each way of saying the same gives the same contact, and what is left open is asked."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr
from mdr.normal.normal_force import mean_normal_force

BALL, RUBBER = mdr.Sphere(R=5e-3), mdr.Elastic(E=3e6, nu=0.5)
OMEGA = 2 * np.pi * 50


def rig(**given):
    return mdr.rig(BALL, RUBBER, 0.8, **{"frequency": 50.0, "load": 1.0, **given})


def test_a_load_amplitude_makes_an_oscillating_load():
    case = rig(load_amplitude=0.1, k_x=2e4, m=0.1, c_x=1.0, load_rides=True)
    assert case.oscillation == mdr.LoadOscillation(1.0, 0.1, OMEGA, m_z=0.1)
    assert case.pull == mdr.SpringPull(2e4, 0.1, 1.0)
    assert rig(load_amplitude=0.1, m=0.1, load_rides=True).oscillation.m_z == 0.1
    assert rig(load_amplitude=0.1, k_x=2e4, m=0.2, load_rides=False).oscillation.m_z == 0.0


def test_acceleration_and_depth_are_one_amplitude_about_the_depth_of_the_load():
    by_depth, by_acceleration = rig(depth_amplitude=2e-6), rig(acceleration=2e-6 * OMEGA**2)
    assert by_depth.oscillation.u_z0 == mdr.static_depth(BALL, RUBBER, 1.0)
    assert_allclose(by_acceleration.oscillation.du_z, 2e-6, rtol=1e-15)
    assert by_depth.pull == mdr.RigidPull()


G, STEEL = 9.80665, mdr.ElasticPair(E_1=210e9, nu_1=0.3, E_2=210e9, nu_2=0.3)
ON_TABLE = """
mu_0 = 0.3
[indenter]
shape = "Sphere"
R = "5 mm"
[material]
model = "Elastic"
E = "115 GPa"
nu = 0.3
[oscillation]
load = 0.980665
support_acceleration = "0.5 g"
frequency = "50 Hz"
"""


def on_table(a=0.5, **given):
    return mdr.rig(BALL, STEEL, 0.3, **{"frequency": 50, "load_grams": 100, "support_acceleration": a * G, **given})


def test_a_block_on_a_shaken_table_is_pressed_by_its_weight_and_its_inertia():
    """m (g + a) well below its resonance on the contact; mu_0 (1 - a/g) at rest, full friction above 7.7 um/s."""
    case = on_table()
    assert_allclose([case.oscillation.dF_z, case.oscillation.m_z], [0.05 * G, 0.1], rtol=1e-15)
    known = mdr.resolved(case)
    below = known.oscillation.omega**2 * 0.1 / known.k_zc  # squared ratio of frequencies: what its own motion changes
    assert mdr.static_cof(case) == pytest.approx(0.3 * 0.5, abs=0.3 * below)
    assert mdr.static_cof(replace(case, oscillation=replace(case.oscillation, m_z=0.0))) == pytest.approx(0.15)
    assert mdr.slide(case, 1e-5).cof == pytest.approx(0.3, rel=1e-6)


def test_what_lies_on_a_table_moves_against_it_as_seen_from_there():
    """m u'' = m g + m a cos - F_N: near its resonance on the contact a small acceleration is enlarged."""
    a = 1e-3
    still = mdr.resolved(on_table(a))
    ratio = 0.8
    case = mdr.resolved(on_table(a, frequency=ratio * np.sqrt(still.k_zc / 0.1) / (2 * np.pi)))
    assert 1 - mdr.static_cof(case) / 0.3 == pytest.approx(a / (1 - ratio**2), rel=2e-2)  # the ball stiffens


@pytest.mark.parametrize(
    ("given", "m_z"),
    [({}, 0.1), ({"m": 0.1}, 0.1), ({"m": 0.05, "load_rides": True}, 0.1), ({"m": 0.05, "load_rides": False}, 0.05)],
)
def test_the_mass_on_a_table_is_the_load_s_or_the_sled_s(given, m_z):
    case = on_table(k_x=1e3, **{"m": 0, **given})
    assert case.oscillation.m_z == pytest.approx(m_z)
    assert case.oscillation.dF_z == pytest.approx(m_z * 0.5 * G)


def test_what_is_left_open_of_a_table_is_asked():
    with pytest.raises(ValueError, match=r"the weight of 0\.1 kg, and the sled has m = 0\.05 kg: say load_rides"):
        on_table(k_x=1e3, m=0.05)
    with pytest.raises(ValueError, match="hold is about a driven depth"):
        on_table(hold="load")
    with pytest.raises(ValueError, match="acceleration and support_acceleration are given: give one"):
        on_table(acceleration=1.0)


@pytest.mark.parametrize("hold", [None, "load"])
def test_an_acceleration_that_no_weight_brings_about_leads_to_the_table(hold):
    """The indenter against the half-space by 0.5 g at 50 Hz: +-50 um, where the weight carries tenths of one."""
    with pytest.warns(mdr.PlausibilityWarning, match="a shaken table, give it as support_acceleration"):
        mdr.rig(BALL, STEEL, 0.3, frequency=50, load_grams=100, acceleration=0.5 * G, hold=hold)


def test_a_table_in_a_case_file_in_paths_and_in_studies():
    case = mdr.parse_case(ON_TABLE)
    told = case.oscillation
    assert_allclose([told.F_z0, told.dF_z, told.omega, told.m_z], [0.1 * G, 0.05 * G, OMEGA, 0.1], rtol=1e-14)
    held = {"support_acceleration": 0.5 * G}
    heavier = mdr.sweep(case, {"load": [0.5, 2.0]}, quantities=["static_cof"], held=held)
    assert_allclose(heavier["static_cof"], 0.15, rtol=5e-3)  # its own motion on the contact
    faster = mdr.sweep(case, {"support_acceleration": [0.25 * G, 0.75 * G]}, quantities=["static_cof"])
    assert_allclose(faster["static_cof"], [0.3 * 0.75, 0.3 * 0.25], rtol=1e-2)
    with pytest.raises(ValueError, match=r"support_acceleration sets oscillation\.dF_z, which Normal"):
        mdr.sweep(rig(depth_amplitude=2e-6), {"support_acceleration": [1.0]}, quantities=["static_cof"])


def test_a_mass_of_zero_beside_an_acceleration_is_not_taken_for_another():
    """What is written stands: a load that moves no mass has no inertia on a table."""
    for zero in ("m_z = 0\n", 'm_z = "0 g"\n'):
        with pytest.raises(
            mdr.CaseFileError, match=r"moves a mass, and m_z = 0 is none: leave m_z out .*, or give dF_z"
        ):
            mdr.parse_case(ON_TABLE + zero)
    assert mdr.parse_case(ON_TABLE + "m_z = 0.2\n").oscillation.m_z == 0.2


def test_an_acceleration_in_a_file_is_asked_whose_it_is():
    for key in ("acceleration", "a_z"):
        with pytest.raises(mdr.CaseFileError, match=r"of what a mass stands on, give support_acceleration; of the ind"):
            mdr.parse_case(ON_TABLE.replace("support_acceleration", key))


def test_a_body_of_another_mass_than_the_load_is_asked_about_in_a_file():
    with pytest.warns(mdr.PlausibilityWarning, match=r"a mass of 0\.1 kg, and the body has m = 0\.2 kg: give m_z"):
        mdr.parse_case(ON_TABLE + "[pull]\nk_x = 1e3\nm = 0.2\n")
    case = mdr.parse_case(ON_TABLE + "m_z = 0.2\n[pull]\nk_x = 1e3\nm = 0.2\n")
    assert case.oscillation.dF_z == pytest.approx(0.1 * G)


def test_the_mass_of_a_load_in_grams_has_its_weight():
    assert_allclose(rig(load=None, load_grams=100, load_amplitude=0.1).oscillation.F_z0, 0.980665, rtol=1e-15)


def test_the_loss_tangent_is_that_of_the_material_at_the_frequency():
    case = rig(load_amplitude=0.1, tan_delta=0.2)
    assert_allclose(case.material.loss_tangent(OMEGA), 0.2, rtol=1e-15)
    assert case.material.E == RUBBER.E


def test_a_sled_heavier_than_its_load_is_warned_of():
    with pytest.warns(mdr.PlausibilityWarning, match=r"weight of the sled, 1\.961 N, is more than the load of 1 N"):
        rig(load_amplitude=0.1, k_x=2e4, m=0.2, load_rides=True)


def test_short_waves_are_warned_of():
    """Shear waves at 20 kHz in rubber of 1 MPa, 1000 kg/m³: sqrt(1e3)/2e4 = 1.58 mm; the contact is 1.95 mm wide."""
    with pytest.warns(mdr.PlausibilityWarning, match=r"about 0.00158 m long .* is 0.0019\d m wide"):
        rig(frequency=20e3, depth_amplitude=2e-6, density=1000.0)
    rig(depth_amplitude=2e-6, density=1000.0)  # none at 50 Hz


@pytest.mark.parametrize("share", [0.44, 3.0])
@pytest.mark.parametrize(
    "material",
    [RUBBER, mdr.KelvinVoigt(3e6, 0.5, 1e-3), mdr.Prony(2e6, ((1e6, 1e-3),), 0.45)],
    ids=lambda one: type(one).__name__,
)
@pytest.mark.parametrize("shape", [BALL, mdr.Cone(0.05), mdr.Paraboloid(5e-3)], ids=lambda one: type(one).__name__)
def test_the_mean_load_is_held_while_the_depth_is_driven(shape, material, share):
    """By the mean force in closed form. The ball is spared great depths: it ends at R."""
    load, du_z = 0.05, share * mdr.static_depth(shape, material, 0.05)
    held = mdr.rig(shape, material, 0.8, frequency=50, load=load, depth_amplitude=du_z, hold="load")
    assert held.oscillation.du_z == du_z
    assert_allclose(mean_normal_force(held), load, rtol=1e-5)  # springs are followed with errors of that size
    rested = mdr.rig(shape, material, 0.8, frequency=50, load=load, depth_amplitude=du_z, hold="depth")
    assert held.oscillation.u_z0 < rested.oscillation.u_z0 == mdr.static_depth(shape, material, load)


def test_the_mean_load_of_a_paraboloid_is_a_beta_function():
    """Of F = c u^1.5 about u_z0 = du_z it is c (2 du_z)^1.5 B(2, 1/2)/pi = c (2 du_z)^1.5 4/(3 pi)."""
    du_z, shape = 20e-6, mdr.Paraboloid(5e-3)
    c = 4 / 3 * RUBBER.E_star * np.sqrt(5e-3)
    load = c * (2 * du_z) ** 1.5 * 4 / (3 * np.pi)
    held = mdr.rig(shape, RUBBER, 0.8, frequency=50, load=load, depth_amplitude=du_z, hold="load")
    assert_allclose(held.oscillation.u_z0, du_z, rtol=1e-5)


def test_a_mean_load_that_is_more_than_the_load_is_warned_of_once_it_matters():
    with pytest.warns(mdr.PlausibilityWarning, match=r"the mean load is 1\.\d+ times the load of 1 N.*hold=\"load\""):
        rig(depth_amplitude=0.5 * mdr.static_depth(BALL, RUBBER, 1.0))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rig(depth_amplitude=0.5 * mdr.static_depth(BALL, RUBBER, 1.0), hold="depth")
        rig(depth_amplitude=0.1 * mdr.static_depth(BALL, RUBBER, 1.0))
        flat = mdr.rig(mdr.FlatPunch(1e-3), RUBBER, 0.8, frequency=50, load=1.0, depth_amplitude=1e-5, hold="load")
    assert flat.oscillation.u_z0 == mdr.static_depth(mdr.FlatPunch(1e-3), RUBBER, 1.0)
