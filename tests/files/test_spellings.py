"""Other spellings of the keys of a case file give the same case, and are refused in their own words."""

import math
import warnings

import pytest

import mdr

FILE = """
mu_0 = 0.5
[indenter]
shape = "{shape}"
{slope}
[material]
model = "{model}"
E = 3e6
nu = 0.5
{loss}
[oscillation]
{motion}
"""
PLAIN = {
    "model": "KelvinVoigt",
    "shape": "Cone",
    "slope": "theta = 0.02",
    "loss": "tau = 1e-3",
    "motion": "u_z0=2e-5\ndu_z=2e-6\nomega=300",
}
OMEGA = 2 * math.pi * 50


def read(**parts):
    return mdr.parse_case(FILE.format(**{**PLAIN, **parts}))


def test_degrees_hertz_and_loss_tangents():
    case = read(slope="theta_deg = 1.5", loss="tan_delta = 0.2", motion="frequency = 50\nu_z0 = 2e-5\ndu_z = 2e-6")
    assert case.indenter.theta == math.radians(1.5)
    assert case.oscillation.omega == OMEGA
    assert float(case.material.loss_tangent(OMEGA)) == pytest.approx(0.2, rel=1e-15)


def test_a_load_with_its_own_amplitude_is_an_oscillating_load():
    assert read(motion="frequency=50\nload=1.0\ndF_z=0.1").oscillation == mdr.LoadOscillation(1.0, 0.1, OMEGA)
    shaken = 'motion="ConstantLoad"\nload=1.0\n[shake]\nfrequency=50\ndu_x=1e-6'
    case = read(motion=shaken, loss="tan_delta = 0.2")
    assert case.oscillation == mdr.ConstantLoad(1.0)
    assert case.shake.omega == OMEGA
    assert case.material.tau == 0.2 / OMEGA  # of the shake, where the load is constant


def test_a_load_beside_the_amplitude_of_a_depth_is_the_depth_at_which_it_rests():
    case = read(motion="frequency=50\nload=1.0\ndu_z=2e-6")
    assert case.oscillation == mdr.NormalOscillation(mdr.static_depth(case.indenter, case.material, 1.0), 2e-6, OMEGA)
    assert mdr.parse_case(mdr.write_case(case)) == case


REFUSED = [
    ({"slope": "theta_deg = 1.5\ntheta = 0.02"}, "theta_deg and theta say the same"),
    ({"slope": "theta_deg = 100"}, "theta must lie between 0 and 1.5708"),
    ({"slope": ""}, "theta is missing; or give theta_deg"),
    ({"shape": "Paraboloid", "slope": "theta_deg = 2"}, "theta_deg is no key of Paraboloid"),
    (
        {"model": "Prony", "loss": "E_inf = 1e6\narms = [[2e6, 1e-3]]\ntan_delta = 0.2"},
        'of model = "KelvinVoigt" alone',
    ),
    ({"motion": "omega=300\nu_z0=1e-5\ndu_z=1e-6\n[shake]\nomega=200\ndu_x=1e-6", "loss": "tan_delta=0.2"}, "have two"),
    ({"motion": "omega=300\ndu_z=1e-6\ndF_z=1e-6\nload=1"}, "dF_z belongs to an oscillating load"),
    ({"motion": "omega=300\ndu_z=1e-6"}, "u_z0 is missing; or give load [N]"),
    ({"loss": ""}, "tau is missing; or give tan_delta"),
    ({"loss": "tan_delta = 0.2", "motion": "u_z0 = 2e-5\ndu_z = 2e-6"}, "omega is missing; or give frequency"),
    ({"motion": "f = 50\nu_z0 = 2e-5\ndu_z = 2e-6"}, "f is no key of NormalOscillation; did you mean frequency"),
    ({"motion": "frequency = 50\nload = 1\nu_z0 = 1e-5\ndu_z = 2e-6"}, "load and u_z0 say the same"),
]


@pytest.mark.parametrize(("parts", "words"), REFUSED)
def test_a_spelling_is_refused_in_its_own_words_and_once(parts, words):
    with pytest.raises(mdr.CaseFileError) as refused:
        read(**parts)
    assert [one for one in refused.value.faults if words in one], refused.value
    assert len(refused.value.faults) <= 2


def test_a_load_waits_for_a_sound_shape():
    """Of a refused shape no depth is asked; the shape's own fault is told, and no other."""
    with pytest.raises(mdr.CaseFileError) as refused:
        read(slope="theta = 7", motion="frequency=50\nload=1.0\ndu_z=2e-6")
    assert ["theta must lie" in one for one in refused.value.faults] == [True]


def test_a_load_that_may_ride_on_the_body_is_asked_for_its_mass():
    body = "F_z0 = 1.0\ndF_z = 0.1\nomega = 300\n{}\n[pull]\nk_x = 2e4\nm = 0.2"
    with pytest.warns(mdr.PlausibilityWarning, match=r"m_z = 0\.2 if it presses on the body itself") as said:
        asked = read(motion=body.format(""))
    assert [one.filename for one in said] == [__file__]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert read(motion=body.format("m_z = 0")) == asked == mdr.parse_case(mdr.write_case(asked))


def test_a_pull_without_a_mass_is_asked_for_it():
    with pytest.warns(mdr.PlausibilityWarning, match=r"\[pull\] says no mass: give m in kg"):
        asked = read(motion=PLAIN["motion"] + "\n[pull]\nk_x = 2e4")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert read(motion=PLAIN["motion"] + "\n[pull]\nk_x = 2e4\nm = 0") == asked
