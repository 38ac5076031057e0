"""Moduli, their ratio, the response to a frequency, and what a material refuses."""

import math
import re
import warnings
from functools import partial

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

RATIOS = [-0.9, -0.3, 0.0, 0.3, 0.45, 0.5]
EXACT = 1e-14  # a handful of roundings


@pytest.mark.parametrize("material", [mdr.Elastic, partial(mdr.KelvinVoigt, tau=1e-3)], ids=["Elastic", "KelvinVoigt"])
@pytest.mark.parametrize("nu", RATIOS)
def test_contact_moduli_of_one_body(material, nu):
    E = 3e6
    G = E / (2 * (1 + nu))
    material = material(E=E, nu=nu)
    assert_allclose(1 / material.E_star, (1 - nu**2) / E, rtol=EXACT)
    assert_allclose(1 / material.G_star, (2 - nu) / (4 * G), rtol=EXACT)
    assert_allclose(material.mindlin_ratio, material.E_star / material.G_star, rtol=EXACT)
    assert_allclose(material.mindlin_ratio, (2 - nu) / (2 * (1 - nu)), rtol=EXACT)
    assert_allclose(material.dundurs_beta, (1 - 2 * nu) / (2 * (1 - nu)), rtol=EXACT)


@pytest.mark.parametrize("nu", RATIOS)
def test_from_shear(nu):
    G, eta = 1e6, 500.0
    elastic, kelvin = mdr.Elastic.from_shear(G=G, nu=nu), mdr.KelvinVoigt.from_shear(G=G, eta=eta, nu=nu)
    for material in (elastic, kelvin):
        assert_allclose(material.E, 2 * G * (1 + nu), rtol=EXACT)
        assert_allclose(material.G_star, 4 * G / (2 - nu), rtol=EXACT)
    assert_allclose(kelvin.tau, eta / G, rtol=EXACT)


def test_from_loss_tangent():
    omega = 2 * np.pi * 50
    material = mdr.KelvinVoigt.from_loss_tangent(E=3e6, nu=0.5, tan_delta=0.2, omega=omega)
    assert_allclose(material.tau, 0.2 / omega, rtol=EXACT)
    assert_allclose(material.loss_tangent(omega), 0.2, rtol=EXACT)
    assert_allclose(np.tan(np.angle(material.dynamic_modulus(omega))), 0.2, rtol=EXACT)


@pytest.mark.parametrize("nu", RATIOS)
def test_like_bodies_halve_the_modulus_and_do_not_couple(nu):
    one, pair = mdr.Elastic(E=3e6, nu=nu), mdr.ElasticPair(3e6, nu, 3e6, nu)
    assert pair.dundurs_beta == 0
    assert_allclose(pair.E_star, one.E_star / 2, rtol=EXACT)
    assert_allclose(pair.mindlin_ratio, one.mindlin_ratio, rtol=EXACT)


def test_a_pair_may_be_named_in_either_order():
    one, other = mdr.ElasticPair(3e6, 0.45, 70e9, 0.3), mdr.ElasticPair(70e9, 0.3, 3e6, 0.45)
    assert one.E_star == other.E_star
    assert one.G_star == other.G_star
    assert_allclose(one.dundurs_beta, -other.dundurs_beta, rtol=EXACT)


@pytest.mark.parametrize(
    "material", [mdr.Elastic(3e6, 0.3), mdr.KelvinVoigt(3e6, 0.3, 1e-3), mdr.ElasticPair(3e6, 0.3, 5e6, 0.4)], ids=repr
)
def test_dynamic_modulus(material):
    omega = np.array([[0.0, 1.0], [50.0, 2e4]])
    assert_allclose(material.dynamic_modulus(omega), material.E_star * (1 + 1j * omega * material.tau), rtol=EXACT)
    assert_allclose(material.loss_tangent(omega), omega * material.tau, rtol=EXACT)
    assert type(material.dynamic_modulus(50.0)) is complex
    assert type(material.loss_tangent(50.0)) is float
    assert material.dynamic_modulus(0.0) == material.E_star


# --- memory ---

ARMS = {
    "one": [(2e6, 1e-2)],
    "three": [(2e6, 1e-2), (3e6, 1.0), (1e6, 50.0)],
    "twenty decades": [(1e6, float(tau)) for tau in np.logspace(-10, 10, 21)],
    "stiff and slow": [(3e12, 1.0), (1e6, 1e6)],
}
TWO_ARMS = mdr.Prony(1e6, [(2e6, 1e-2), (3e6, 1.0)], 0.3)
OMEGA = np.geomspace(1e-2, 1e4, 61)
YOUNG = np.asarray(TWO_ARMS.dynamic_modulus(OMEGA)) * (1 - 0.09)  #: Young's modulus of the two arms


@pytest.mark.parametrize("tau", [0.0, 1e-3])
@pytest.mark.parametrize("arms", ARMS.values(), ids=ARMS)
def test_creep_is_the_inverse_of_relaxation(arms, tau):
    body = mdr.Prony(1e6, arms, 0.3, tau)
    t = np.concatenate([[0.0], np.logspace(-13, 16, 117)])
    J = body.creep_compliance(t)
    assert np.all(np.diff(J) >= -1e-13 / body.E_star)
    assert_allclose(J[-1] * body.E_star, 1, rtol=1e-12)
    assert_allclose(J[0], 0 if tau else 1 / body.instantaneous_modulus, rtol=1e-12)
    start, rates, times = body._retardation()
    assert np.all(times > 0)
    for omega in np.logspace(-9, 9, 7):  # J*(omega) E*(omega) = 1
        J_omega = start + np.sum(rates * times / (1 + 1j * omega * times))
        assert_allclose(J_omega * body.dynamic_modulus(omega), 1, rtol=1e-9)


def test_a_maxwell_body_flows():
    body = mdr.Prony(0.0, [(2e6, 1e-2), (3e6, 1.0)], 0.3)
    viscosity = (2e6 * 1e-2 + 3e6 * 1.0) / (1 - 0.09)
    J = body.creep_compliance([0.0, 1e5, 2e5])
    assert_allclose(J[0], 0.91 / 5e6, rtol=1e-13)
    assert_allclose((J[2] - J[1]) / 1e5, 1 / viscosity, rtol=1e-9)


def test_moduli_in_time_and_frequency_are_those_of_the_arms():
    body = mdr.Prony(1e6, ARMS["three"], 0.3, 0.2)
    t, omega = 0.7, 3.0
    share = 1 / (1 - 0.09)
    relaxed = 1e6 + sum(E * math.exp(-t / tau) for E, tau in ARMS["three"])
    assert_allclose(body.relaxation_modulus(t), share * relaxed, rtol=1e-14)
    dynamic = 1e6 * (1 + 0.2j * omega) + sum(E * 1j * omega * tau / (1 + 1j * omega * tau) for E, tau in ARMS["three"])
    assert_allclose(body.dynamic_modulus(omega), share * dynamic, rtol=1e-14)
    assert body.instantaneous_modulus == math.inf
    assert_allclose(body.G_star * body.mindlin_ratio, body.E_star, rtol=1e-14)
    assert body.mindlin_ratio == mdr.Elastic(1e6, 0.3).mindlin_ratio
    assert mdr.Prony(1e6, [(0.0, 1.0)], 0.3).contact_arms == ()  # an arm without modulus is none


def test_arms_are_found_in_dynamic_data():
    found = mdr.Prony.fit(OMEGA, YOUNG.real, YOUNG.imag, nu=0.3)
    assert found.misfit(OMEGA, YOUNG.real, YOUNG.imag) < 1e-9  # two of its times are those of the data
    assert len(found.arms) == 2
    noisy = YOUNG * (1 + 0.02 * np.random.default_rng(5).normal(size=61))
    assert mdr.Prony.fit(OMEGA, noisy.real, noisy.imag, nu=0.3).misfit(OMEGA, YOUNG.real, YOUNG.imag) < 0.03


@pytest.mark.parametrize("n_arms", [2, 5, 9, 40])
@pytest.mark.parametrize("noise", [0.0, 0.01])
def test_a_master_curve_is_met_to_its_digits_and_noise_is_not_followed(n_arms, noise):
    """Arms anywhere within five decades and a decade beyond; of 1 % noise a third or more is left out on average."""
    rng = np.random.default_rng(n_arms)
    omega = np.geomspace(1, 1e5, 41)
    arms = zip(1e6 * 10 ** rng.uniform(-1, 1, n_arms), 10 ** rng.uniform(-6, 1, n_arms), strict=True)
    E = mdr.Prony(1e6, tuple(arms), 0.3).dynamic_modulus(omega) * (1 - 0.3**2)
    storage, loss = (one * (1 + noise * rng.normal(size=41)) for one in (E.real, E.imag))
    found = mdr.Prony.fit(omega, storage, loss, nu=0.3)
    off = abs(found.dynamic_modulus(omega) * (1 - 0.3**2) / E - 1)
    assert off.max() < 1e-3 + 3 * noise
    assert np.sqrt(np.mean(off**2)) < 1e-3 + 0.66 * noise
    assert found.E_inf > 0


@pytest.mark.parametrize("exponent", [0.1, 0.5, 0.9])
@pytest.mark.parametrize("error", [1e-2, 1e-4])
def test_a_power_law_is_followed_within_its_error(exponent, error):
    body = mdr.Prony.power_law(modulus=3e6, exponent=exponent, omega=(2.0, 2e4), nu=0.5, error=error)
    omega = np.geomspace(2.0, 2e4, 997)
    wanted = 3e6 * (1j * omega / 2.0) ** exponent / 0.75
    assert np.max(np.abs(body.dynamic_modulus(omega) / wanted - 1)) < 1.02 * error
    assert body.E_star > 0


def test_tables_of_arms(tmp_path):
    table, case = tmp_path / "arms.csv", tmp_path / "arms.toml"
    table.write_text("E_j [Pa],tau_j [s]\n1e6,inf\n2e6,0.01\n3e6,1\n", encoding="utf-8")
    assert mdr.Prony.read(table, nu=0.3) == TWO_ARMS
    text = '[material]\nmodel = "Prony"\nE_inf = 1e6\narms = [[2e6, 0.01], [3e6, 1.0]]\nnu = 0.3\n'
    case.write_text(text, encoding="utf-8")
    assert mdr.Prony.read(case) == TWO_ARMS
    table.write_text("E_j,tau_j\n-1e6,1\n")
    with pytest.raises(ValueError, match=r"arms\.csv: .*line 2: must have E_j >= 0 Pa and tau_j > 0 s"):
        mdr.Prony.read(table, nu=0.3)
    for text, words in (
        ("E_inf = 1.0\n", r"arms\.toml: .*arms is missing"),
        ('model = "Elastic"\n', 'model "Elastic" is not Prony'),
        ("E_inf = 1.0\nE_o = 2.0\n", "E_o is no key of Prony; there are model, E_inf, arms, nu, tau"),
    ):
        case.write_text(text, encoding="utf-8")
        with pytest.raises(ValueError, match=words):
            mdr.Prony.read(case)
    text = "E_inf = 1e6\narms = [[2e6, 0.01]]\nnu = 0.3\n"
    case.write_text(text, encoding="utf-8")
    assert mdr.Prony.read(case, nu=0.45) == mdr.Prony(1e6, [(2e6, 0.01)], 0.45)  # the ratio beside a table is taken


def test_decay_constants_and_shear_arms(tmp_path):
    """beta_j = 1/tau_j, 0 that of E_inf; G under any of its names is a shear modulus, E = 2 (1 + nu) G."""
    for text in (
        "G_i [MPa],beta_i [1/s]\n2,100\n3,0\n",
        "Branch,Gm (MPa),taum (ms)\n1,2,10\n2,3,inf\n",
        "G(i) [kPa],tau(i) [s]\n2e3,0.01\n3e3,\n",
    ):
        (tmp_path / "arms.csv").write_text(text)
        body = mdr.Prony.read(tmp_path / "arms.csv", nu=0.5)
        assert_allclose([body.E_inf, *body.arms[0]], [9e6, 6e6, 0.01])


def test_a_fit_that_misses_says_what_may_help():
    """Several temperatures, too few arms, and data of no passive body; arms with noise of 3 % are silent."""
    noisy = YOUNG * (1 + 0.03 * np.random.default_rng(5).normal(size=61))
    twice = np.tile(OMEGA, 2), np.concatenate([YOUNG, YOUNG / 5])
    for (omega, E), n_arms, words in [
        ((OMEGA, noisy), None, None),
        ((OMEGA, YOUNG), 1, r"miss the data by .*% on average, 2 of free times by .*: leave n_arms out"),
        (twice, None, r"frequencies repeat .* temperature=20"),
        ((OMEGA, YOUNG[::-1]), None, "no arms have such moduli"),
        ((OMEGA, YOUNG[::-1]), 1, "no arms have such moduli"),
    ]:
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            mdr.Prony.fit(omega, E.real, E.imag, nu=0.3, n_arms=n_arms)
        assert [bool(re.search(words, str(one.message))) for one in told] == [True] if words else not told


def test_a_case_of_one_pascal_reads_back():
    """Its file says the unit, so that it is not taken for shares."""
    motion = mdr.NormalOscillation(20e-6, 2e-6, 300.0)
    for body in (mdr.Prony(0.25, [(0.75, 1.0)], 0.5), mdr.StandardLinearSolid(0.5, 0.5, 1e-3, 0.5)):
        case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), body, 0.5, motion)
        text = mdr.write_case(case)
        assert mdr.parse_case(text) == case
        with pytest.raises(mdr.CaseFileError, match=r'\[material\] moduli between 0 and 1 .* E_0 = "3 MPa"'):
            mdr.parse_case(text.replace('" Pa"', "").replace('"0.25 Pa"', "0.25").replace('"0.5 Pa"', "0.5"))
        scaled = mdr.parse_case(text.replace('"0.25 Pa"', "0.25\nE_0 = 2e6").replace('"0.5 Pa"', '0.5\nE_0 = "2 MPa"'))
        assert_allclose(scaled.material.instantaneous_modulus * 0.75, 2e6)
        sheared = mdr.parse_case(text.replace('"0.25 Pa"', "0.25\nG_0 = 1e6").replace('"0.5 Pa"', '0.5\nG_0 = "1 MPa"'))
        assert_allclose(sheared.material.instantaneous_modulus * 0.75, 3e6)
        both = text.replace('"0.25 Pa"', "0.25\nG_0 = 1e6\nE_0 = 1").replace('"0.5 Pa"', "0.5\nG_0 = 1\nE_0 = 1")
        with pytest.raises(mdr.CaseFileError, match="E_0 and G_0 say the same"):
            mdr.parse_case(both)


@pytest.mark.parametrize(
    "swapped",
    [
        lambda: mdr.KelvinVoigt(3e6, 1e-3, 0.5),
        lambda: mdr.StandardLinearSolid(3e6, 1e6, 0.3, 2e-3),
        lambda: mdr.Prony(3e6, [(1e6, 1e-3)], 1e-4, 0.5),
        lambda: mdr.Elastic(3e6, 5e-3),
    ],
)
def test_a_time_in_the_place_of_poissons_ratio_is_told_where_the_material_is_made(swapped):
    with pytest.warns(mdr.PlausibilityWarning, match="of no solid, cork included: is it nu, or a time in s"):
        swapped()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mdr.Elastic(3e6, 0.0)
        mdr.KelvinVoigt(3e6, 0.01, 0.5)
