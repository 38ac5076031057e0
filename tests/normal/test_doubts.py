"""What is legal but unlikely is warned of, once, where a user asks; and nothing usual is."""

import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr
from mdr.case.doubts import doubts_of, edge
from mdr.files.examples import MATERIALS, MOTIONS, PULLS, SHAPES, example

USUAL = mdr.read_case(Path(__file__).parents[2] / "docs/example.toml")
SOFT = mdr.KelvinVoigt(E=3.0, nu=0.5, tau=1e-3)  # 3 for 3 MPa
ABSURD = {
    "a cone of 57 degrees": ({"indenter": mdr.Cone(theta=1.0)}, "slope 1.56"),
    "a cone of 89 degrees": ({"indenter": mdr.Cone(theta=1.55)}, "slope 48"),
    "a sphere pressed four radii deep": ({"indenter": mdr.Sphere(R=5e-6)}, "slope"),
    "a paraboloid with a/R = 63": ({"indenter": mdr.Paraboloid(R=5e-9)}, "slope 63.2"),
    "a punch pressed two radii deep": ({"indenter": mdr.FlatPunch(a=1e-5)}, "2 times the radius"),
    "du_z and u_z0 swapped": ({"oscillation": mdr.NormalOscillation(2e-6, 20e-6, USUAL.omega)}, "are the two swapped"),
    "friction in per cent": ({"mu_0": 50.0}, "percentage"),
    "E = 3 for 3 MPa": ({"material": SOFT}, "modulus in MPa"),
    "the same under a load": (
        {"material": SOFT, "oscillation": mdr.LoadOscillation(0.03, 0.003, USUAL.omega, 1e-6)},
        "slope",
    ),
    "tau in ms": ({"material": mdr.KelvinVoigt(E=3e6, nu=0.5, tau=1.0)}, "tau in ms"),
    "k_x a million times too small": ({"pull": mdr.SpringPull(k_x=1e-3, m=0.1)}, "k_x in N/mm"),
    "grams for kilograms": (
        {"oscillation": mdr.LoadOscillation(0.03, 0.003, USUAL.omega, 100.0)},
        "of m_z, 980.7 N, is 3.27e\\+04 times",
    ),
    "a mass in wrong units": ({"pull": mdr.SpringPull(k_x=2e4, m=1e-6)}, "mass"),
}


@pytest.mark.parametrize("what", ABSURD)
def test_an_absurd_contact_is_warned_of_and_computed(what):
    changed, words = ABSURD[what]
    case = replace(USUAL, **changed)
    with pytest.warns(mdr.PlausibilityWarning, match=words) as said:
        assert mdr.critical_velocity(case) > 0
    assert {one.filename for one in said} == {__file__}  # the user's line
    assert tuple(str(one.message) for one in said) == mdr.plausibility(case)


def test_an_unstable_mass_under_its_load_is_warned_of_where_its_depth_is_asked_for():
    load = mdr.LoadOscillation(F_z0=1.0, dF_z=2.0, omega=314.0, m_z=0.1)
    case = mdr.SlidingContact(mdr.Sphere(5e-3), mdr.KelvinVoigt(3e6, 0.5, 6e-4), 0.8, load)
    with pytest.warns(mdr.PlausibilityWarning, match="dF_z = 2 N, is above its mean"):
        mdr.critical_velocity(case)
    with pytest.warns(mdr.PlausibilityWarning, match="unstable: a deviation grows 2.0"):
        mdr.full_slip_critical_velocity(case)


def test_a_mass_that_bounces_under_its_load_is_warned_of():
    case = beside_resonance(2.0, 1.5, tau=1e-3)
    with pytest.warns(mdr.PlausibilityWarning, match="leaves the surface in every period"):
        mdr.full_slip_critical_velocity(case)


def test_nothing_is_said_of_the_standing_examples():
    cases = [USUAL]
    cases += [example(shape, "Elastic", motion) for shape in SHAPES for motion in MOTIONS]
    cases += [example(material=material, motion=motion) for material in MATERIALS for motion in MOTIONS]
    cases += [example(pull=pull) for pull in PULLS]
    assert [(case, doubts_of(known)) for case in cases if doubts_of(known := mdr.resolved(case))] == []


def test_it_is_said_of_what_a_user_asks_and_not_of_what_the_package_asks_itself():
    steep = replace(USUAL, indenter=mdr.Cone(theta=1.0))
    doors = [mdr.critical_velocity, mdr.full_slip_critical_velocity, mdr.static_cof, mdr.resolved]
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        for door in doors:
            door(steep)
        mdr.slide(steep, 1e-3, n_periods=1)
        mdr.cof_curve(replace(steep, pull=mdr.RigidPull(), material=mdr.Elastic(3e9, 0.5)), [1e-3, 2e-3])
    assert [one.filename for one in said if "slope" in str(one.message)] == [__file__] * (len(doors) + 2)


def test_two_frequencies_are_each_their_own():
    """The frequency after which both repeat, here 10 Hz, is that of neither."""
    shake = mdr.InPlaneOscillation(omega=USUAL.omega * 16 / 15, du_x=1e-6)
    assert doubts_of(replace(USUAL, shake=shake, pull=mdr.SpringPull(k_x=1e5, m=0.01))) == ()
    lossy = mdr.KelvinVoigt(E=3e6, nu=0.5, tau=0.02)  # omega tau = 6.3, and 0.4 at the common frequency
    assert "omega tau = 6.7" in doubts_of(replace(USUAL, shake=shake, material=lossy))[0]


def test_studies_and_fits_warn_of_their_base_case():
    absurd = replace(USUAL, mu_0=50.0, material=mdr.Elastic(3e6, 0.5), pull=mdr.RigidPull())
    with pytest.warns(mdr.PlausibilityWarning, match="percentage"):
        mdr.sweep(absurd, {"v_0": [1.0]}, n_springs=32, steps_per_period=32)
    data = mdr.FrictionData([1e-3, 2e-3, 3e-3], [0.4, 0.45, 0.5])
    with pytest.warns(mdr.PlausibilityWarning, match="percentage"):
        mdr.fit(absurd, data, ["mu_0"])
    with pytest.warns(mdr.PlausibilityWarning, match="in per cent"):
        mdr.FrictionData([1e-3], [40.0])


@pytest.mark.parametrize("shape", SHAPES)
def test_the_slope_at_the_edge_is_that_of_the_shape(shape):
    indenter, d = SHAPES[shape], 2e-5
    a, slope = edge(indenter, d)
    r = a * (1 - np.array([1e-6, 3e-6]))
    f = np.asarray(indenter.profile_3d(r))
    assert_allclose(slope, abs(f[0] - f[1]) / (r[0] - r[1]), rtol=1e-3, atol=1e-6)  # rounding of f over 2e-6 a


def beside_resonance(detuning, share, shape=None, tau=0.0):
    """m_z omega² = detuning times the stiffness of the contact."""
    shape = shape or mdr.Paraboloid(5e-3)
    material = mdr.KelvinVoigt(3e6, 0.5, tau) if tau else mdr.Elastic(3e6, 0.5)
    F_z0, k_zc = (float(of(20e-6, material.E_star)) for of in (shape.force, shape.stiffness))
    load = mdr.LoadOscillation(F_z0, share * F_z0, 300.0, detuning * k_zc / 300.0**2)
    return mdr.SlidingContact(shape, material, 0.4, load)


@pytest.mark.parametrize("detuning", [0.95, 1.05, 1.3, 2.0])
@pytest.mark.parametrize("share", [0.005, 0.02])
@pytest.mark.parametrize("shape", [mdr.Cone(0.02), mdr.FlatPunch(1e-3)])
@pytest.mark.parametrize("tau", [0.0, 1e-4])
def test_near_the_resonance_of_a_load_the_closed_form_is_doubted_where_it_is_wrong(detuning, share, shape, tau):
    case = beside_resonance(detuning, share, shape, tau)
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        v_c = mdr.critical_velocity(case)
    doubted = any("natural frequency of m_z" in str(one.message) for one in said)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            off = abs(v_c / mdr.full_slip_critical_velocity(case) - 1)
        except ValueError:  # no periodic depth at all
            off = np.inf
    assert doubted or off < 0.03
    assert not doubted or off > 0.01
