"""Laws of friction: what they answer, and that numbers beside a case are the law that they make."""

import pickle
import re
from dataclasses import dataclass, replace
from inspect import signature

import numpy as np
import pytest
from conftest import Spot
from numpy.testing import assert_allclose

import mdr
from mdr.case.paths import facts_at, fields_set, paths_of
from mdr.given.vary import case_at, value_at

PARTS = {
    "indenter": mdr.Paraboloid(5e-3),
    "material": mdr.Elastic(3e6, 0.4),
    "oscillation": mdr.NormalOscillation(20e-6, 5e-6, 300.0),
}
FALLING = mdr.StaticKinetic(0.75, 0.5)
COULOMB, STRONG = mdr.Coulomb(0.5), mdr.ShearStrength(0.2, 1e4)
PLAIN, FACE = mdr.SlidingContact(**PARTS, mu_0=0.5), mdr.SlidingContact(**PARTS, mu_0=0.2, tau_0=1e4)


SPOT = Spot(0.2, 1e4, 1e-4)
TWO = mdr.SlidingContact(**PARTS, friction=FALLING)
OWN = mdr.SlidingContact(**PARTS, friction=SPOT)
COPY = pickle.loads(pickle.dumps(FACE))


@pytest.fixture(autouse=True)
def registered(monkeypatch):
    """The law in case files of this module."""
    monkeypatch.setattr("mdr.files.own_records._OWN", {})
    mdr.register(Spot)


def test_a_law_tells_friction_of_full_slip():
    force, a = np.array([0.0, 1.0]), np.array([0.0, 1e-3])
    assert_allclose(COULOMB.full(force, a), [0.0, 0.5])
    assert_allclose(STRONG.full(force, a), [0.0, 0.2 + 1e4 * np.pi * 1e-6])
    assert_allclose(SPOT.full(force, a), [0.0, 0.2 + 1e4 * np.pi * 1e-8])
    assert [one.needs_area for one in (COULOMB, STRONG, SPOT)] == [False, True, True]
    assert [one.is_coulomb for one in (COULOMB, STRONG, SPOT)] == [True, False, False]
    assert_allclose(FACE.full_friction, STRONG.full(FACE.indenter.force(20e-6, FACE.material.E_star), np.sqrt(1e-7)))
    assert FACE.strength_moves
    assert not OWN.strength_moves  # the contact is wider than the spot all the time
    assert_allclose(OWN.reach(20e-6) - PLAIN.reach(20e-6) * 0.2 / 0.5, 2 * 1e4 * 1e-4 / OWN.material.G_star)


@pytest.mark.parametrize(("law", "case"), [(COULOMB, PLAIN), (STRONG, FACE)], ids=["Coulomb", "ShearStrength"])
def test_numbers_are_the_law_that_they_make(law, case):
    given = mdr.SlidingContact(**PARTS, friction=law)
    assert given == case
    assert hash(given) == hash(case)
    assert given.friction == case.friction == law
    assert str(given) == str(case)
    assert pickle.loads(pickle.dumps(given)) == case
    assert eval(repr(given), vars(mdr)) == case
    assert (given.mu_0, given.tau_0) == (law.mu_0, law.tau_0)


def test_friction_that_falls_has_the_kinetic_coefficient_in_slip():
    assert (TWO.mu_0, TWO.tau_0, TWO.friction.stick, FALLING.is_coulomb) == (0.5, 0.0, 1.5, False)
    assert TWO.unit_velocity == PLAIN.unit_velocity
    assert mdr.SlidingContact(**PARTS, friction=mdr.StaticKinetic(0.5, 0.5)) == PLAIN
    assert replace(TWO, mu_0=0.6).friction == mdr.StaticKinetic(0.75, 0.6)
    assert replace(TWO, tau_0=0.0) == TWO
    assert case_at(TWO, {"mu_s": 0.8}).friction == case_at(TWO, {"friction.mu_s": 0.8}).friction
    assert value_at(case_at(TWO, {"mu_s": 0.8, "mu_k": 0.6}), "mu_0") == 0.6
    with pytest.raises(ValueError, match="tau_0 beside mu_s and mu_k is no law"):
        replace(TWO, tau_0=1e4)
    for mu_s, mu_k, words in (
        (0.4, 0.5, "mu_s = 0.4 must not be below mu_k = 0.5"),
        (0.5, 0.0, "mu_k must be positive"),
    ):
        with pytest.raises(ValueError, match=words):
            mdr.StaticKinetic(mu_s, mu_k)


def test_a_strength_of_zero_is_coulombs():
    assert mdr.SlidingContact(**PARTS, friction=mdr.ShearStrength(0.5, 0.0)) == PLAIN
    assert mdr.SlidingContact(**PARTS, mu_0=0.5, tau_0=0.0) == PLAIN


@pytest.mark.parametrize("case", [PLAIN, FACE, OWN, COPY], ids=["0", "tau_0", "own", "copy"])
def test_a_copy_takes_numbers_or_a_law(case):
    law = case.friction
    assert replace(case, mu_0=0.4).friction == law.varied(mu_0=0.4)
    assert replace(case, mu_0=0.4).mu_0 == 0.4
    assert replace(case, mu_0=0.4).tau_0 == case.tau_0
    assert replace(case, tau_0=3e3).tau_0 == 3e3
    assert replace(case, mu_0=0.4, tau_0=3e3).friction == law.varied(mu_0=0.4, tau_0=3e3)
    for other in (COULOMB, STRONG, SPOT, PLAIN.friction, FACE.friction, OWN.friction):
        assert replace(case, friction=other).friction == other
        with pytest.raises(ValueError, match="mu_0 and friction say the same"):
            replace(case, friction=mdr.Coulomb(0.7), mu_0=0.4)
    flat = replace(case, indenter=mdr.FlatPunch(1e-3))
    assert flat.friction == law
    assert replace(replace(flat, mu_0=0.4), mu_0=case.mu_0) == flat
    assert type(replace(FACE, tau_0=0).friction) is mdr.Coulomb


@pytest.mark.parametrize(
    ("given", "error", "words"),
    [
        ({}, TypeError, r"friction is missing: give mu_0, or a law such as friction=mdr.Coulomb\(mu_0\)"),
        (
            {"mu_0": 0.5, "friction": COULOMB},
            ValueError,
            "mu_0 and friction say the same: give mu_0, or the law Coulomb",
        ),
        ({"tau_0": 1.0, "friction": STRONG}, ValueError, "tau_0 and friction say the same"),
        ({"friction": mdr.Coulomb}, TypeError, r"friction must be of kind Friction, .*; write Coulomb\(...\)"),
        ({"friction": 0.5}, TypeError, "friction must be of kind Friction, got 0.5"),
        ({"mu_0": -1}, ValueError, "mu_0 must not be negative, got -1.0"),
        ({"mu_0": 0}, ValueError, "mu_0 must be positive, got 0.0 .*; it may be 0 where tau_0 is above"),
        ({"mu_0": 0.5, "tau_0": "a"}, TypeError, "tau_0 must be a real number"),
        ({"mu_0": 0.5, "mu": 0.4}, TypeError, "SlidingContact takes no mu; did you mean mu_0?"),
    ],
)
def test_what_is_no_friction_is_refused_by_name(given, error, words):
    with pytest.raises(error, match=words):
        mdr.SlidingContact(**PARTS, **given)


@pytest.mark.parametrize("law", [STRONG, SPOT], ids=["ShearStrength", "Spot"])
def test_a_strength_wants_a_shape_that_knows_its_area(law):
    with pytest.raises(ValueError, match="tau_0 = 10000 Pa acts on an area of contact, which RoughFace does not know"):
        mdr.SlidingContact(**{**PARTS, "indenter": mdr.RoughFace(1.0, 1e-6)}, friction=law)


class Mute(mdr.Friction):
    """A law that says nothing of its strength."""

    mu_0 = 0.5


class Wide(mdr.ShearStrength):
    """A strength that acts beside the contact."""

    def strong_radius(self, a):
        return 2 * np.asarray(a)


def with_answers(**answers):
    """A law that answers this."""
    return type("Own", (mdr.Friction,), {"mu_0": 0.3, "tau_0": 1e4, **answers})()


def test_a_law_with_a_word_is_told_in_a_row():
    @dataclass(frozen=True)
    class Named(mdr.Friction):
        mu_0: float
        name: str
        tau_0: float = 0.0

    told = str(mdr.SlidingContact(**PARTS, friction=Named(0.3, "glue")))
    assert re.search(r"friction +Named +mu_0 = 0.3, name = 'glue', tau_0 = 0\n", told)


@pytest.mark.parametrize(
    ("law", "error", "words"),
    [
        (mdr.Friction(), TypeError, "friction: Friction must answer mu_0, the share of the normal force"),
        (Mute(), TypeError, r"friction: Mute must answer tau_0, its shear strength \[Pa\], 0.0 for none"),
        (Spot(-0.1, 1e4, 1e-4), ValueError, "mu_0 of Spot must not be negative, got -0.1"),
        (Spot(0.0, 0.0, 1e-4), ValueError, "one of the numbers must be above 0"),
        (Spot(0.1, np.nan, 1e-4), ValueError, "tau_0 of Spot must be a finite number"),
        (with_answers(mu_0=np.array([0.3])), TypeError, "mu_0 of Own must be a real number"),
        (with_answers(is_coulomb=True), ValueError, "Coulomb's friction has no strength"),
        (Spot(0.1, 1e4, -1e-4), ValueError, r"strong_radius\(a\) = .* m of contacts of the radii a = \[0.0"),
        (Spot(0.1, 1e4, 0.0), ValueError, "not nowhere; set tau_0 = 0"),
        (Wide(0.1, 1e4), ValueError, "a strength acts within each, from 0 to a"),
        (with_answers(strong_radius=lambda _, a: np.maximum(4e-4 - a, 0)), ValueError, "no less of a larger one"),
        (with_answers(strong_radius=lambda _, a: min(a, 1e-4)), TypeError, r"such as np.minimum\(a, b\)"),
        (with_answers(strong_radius=lambda *_: 1e-4), ValueError, "answers strong_radius"),
        (with_answers(strong_radius=lambda *_: None), ValueError, "answers strong_radius"),
        (with_answers(kinks=1e-4), TypeError, "and a tuple of kinks"),
        (with_answers(kinks=(np.nan,)), ValueError, "they must be radii of contact"),
    ],
)
def test_a_law_of_ones_own_that_is_no_friction_is_refused(law, error, words):
    with pytest.raises(error, match=words):
        mdr.SlidingContact(**PARTS, friction=law)


def test_no_private_argument_is_shown():
    assert [name for name in signature(mdr.SlidingContact).parameters if name.startswith("_")] == []


# --- files ---


@pytest.mark.parametrize("case", [PLAIN, FACE, OWN, TWO], ids=["0", "tau_0", "own", "mu_s"])
def test_a_law_is_written_and_read(case):
    text = mdr.write_case(case)
    assert mdr.parse_case(text) == case
    assert ("[friction]" in text) == (case is OWN)
    assert text.startswith(("mu_0 = ", "mu_s = ")) == (case is not OWN)


def test_a_file_may_name_the_law():
    numbers = "mu_0 = 0.2\ntau_0 = 10000.0\n\n"
    tables = mdr.write_case(FACE).removeprefix(numbers)
    for head in ('[friction]\nkind = "ShearStrength"\n', "[friction]\n"):
        assert mdr.parse_case(f'{head}mu_0 = "20 %"\ntau_0 = "10 kPa"\n{tables}') == FACE
    for head, words in {
        numbers + "[friction]\nmu_0 = 0.3\n": r"mu_0 and tau_0 and \[friction\] say the same: give one of them",
        "": "mu_0 is missing",
        "[friction]\n": r"\[friction\] mu_0 is missing",
        '[friction]\nkind = "Spot"\nmu_0 = 0.2\n': r"\[friction\] tau_0 is missing\n.*b is missing",
        '[friction]\nkind = "Amontons"\n': r"\[friction\] kind \"Amontons\" is unknown; there are Coulomb, Shear",
        '[friction]\nkind = "Coulomb"\nmu_0 = 0.2\ntau_0 = 1.0\n': "tau_0 is no key of Coulomb; leave kind out",
        "[friction]\nmu = 0.2\n": r"\[friction\] mu is no key of Coulomb; did you mean mu_0",
        "tau_0 = 1e4\n": "mu_0 is missing",
        "mu_0 = 0\n": "mu_0 must be positive",
        "b = 1\n": r"b is no key outside the tables; it belongs to \[indenter\] or \[friction\]",
    }.items():
        with pytest.raises(mdr.CaseFileError, match=words):
            mdr.parse_case(head + tables)


# --- paths ---


@pytest.mark.parametrize("case", [PLAIN, FACE, OWN], ids=["0", "tau_0", "own"])
def test_numbers_of_the_law_have_a_path_with_and_without_the_slot(case):
    names = case.friction.numbers
    assert set(names) <= set(paths_of(case))
    for name in names:
        for path in (name, f"friction.{name}"):
            assert value_at(case, path) == getattr(case.friction, name)
            assert value_at(case_at(case, {path: 0.25}), path) == 0.25
            assert fields_set(path) == (name,)
            assert facts_at(path) == facts_at(name)
    assert facts_at("tau_0").unit == "Pa"
    assert case_at(case, {"friction": SPOT, "mu_0": 0.3}).friction == replace(SPOT, mu_0=0.3)
    with pytest.raises(ValueError, match="has no width"):
        case_at(case, {"friction.width": 1.0})


def test_studies_and_searches_take_a_law():
    study = mdr.sweep(PLAIN, {"friction": [COULOMB, STRONG], "v_0": [1e-3]})
    alone = [mdr.cof_curve(replace(PLAIN, friction=law), [1e-3]).cof[0] for law in (COULOMB, STRONG)]
    assert_allclose(study["cof"].ravel(), alone, rtol=1e-9)
    for path in ("friction.tau_0", "tau_0"):
        found = mdr.sweep(FACE, {path: [0.0, 1e4], "v_0": [1e-3]})
        assert_allclose(found["cof"].ravel()[1], alone[1], rtol=1e-9)
    with pytest.raises(ValueError, match=r"mu_0 and friction\.mu_0 set the same"):
        mdr.sweep(PLAIN, {"mu_0": [0.1], "friction.mu_0": [0.2], "v_0": [1e-3]})
    assert mdr.find(PLAIN, "friction.mu_0", v_0=1e-4, share=0.9).path == "mu_0"


def test_a_rig_takes_a_law():
    usual = {"frequency": 50.0, "load": 1.0, "load_amplitude": 0.1}
    ball = mdr.Sphere(5e-3), mdr.Elastic(3e6, 0.5)
    assert mdr.rig(*ball, 0.2, tau_0=1e4, **usual) == mdr.rig(*ball, friction=STRONG, **usual)
    with pytest.raises(TypeError, match="friction is missing"):
        mdr.rig(*ball, **usual)
    with pytest.raises(ValueError, match="mu_0 and friction say the same"):
        mdr.rig(*ball, 0.2, friction=STRONG, **usual)
