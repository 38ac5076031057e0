"""Parameters from measured friction: what was put in comes out, within its interval, or a warning."""

from dataclasses import replace

import matplotlib as mpl
import numpy as np
import pytest

import mdr

mpl.use("Agg")
import matplotlib.pyplot as plt

TAU, MU_0 = 1e-3, 0.5
CASE = mdr.SlidingContact(
    mdr.Paraboloid(R=5e-3), mdr.KelvinVoigt(E=3e6, nu=0.4, tau=TAU), MU_0, mdr.NormalOscillation(20e-6, 10e-6, 300.0)
)
BODY = replace(CASE, pull=mdr.SpringPull(k_x=8e3, m=0.05, c_x=2.0))
START = replace(CASE, mu_0=0.4, material=mdr.KelvinVoigt(E=3e6, nu=0.3, tau=3e-3))
V = mdr.critical_velocity(CASE) * np.linspace(0.05, 1.3, 20)
TRUTH = {"mu_0": MU_0, "mindlin_ratio": CASE.material.mindlin_ratio, "tau": TAU}


def measured(noise, seed=0, case=CASE, v=V):
    cof = mdr.cof_curve(case, v, n_springs=64, steps_per_period=256).cof
    drawn = cof * (1 + noise * np.random.default_rng(seed).normal(size=v.size))
    return mdr.FrictionData(v, drawn, max(noise, 1e-6) * cof)


def test_without_noise_the_truth_comes_back():
    found = mdr.fit(START, measured(0.0), list(TRUTH))
    for name, true in TRUTH.items():
        assert found.values[name] == pytest.approx(true, rel=1e-4)  # derivatives by steps of 1e-3
    assert found.case.mu_0 == found.values["mu_0"]
    assert found.case.material.tau == found.values["tau"]
    assert found.warnings == ()


def test_intervals_hold_the_truth_as_often_as_they_say():
    """16 sets of 1 % noise and three parameters: 48 intervals of 95 %; less than 39 has a chance of 1e-4.

    The fit begins at the truth: that it finds its way from afar is asked above. A cone is the quickest shape.
    """
    cone, held = replace(CASE, indenter=mdr.Cone(theta=0.02)), 0
    for seed in range(16):
        found = mdr.fit(cone, measured(0.01, seed, cone), list(TRUTH))
        held += sum(found.low[name] <= true <= found.high[name] for name, true in TRUTH.items())
    assert 39 <= held < 48


def test_without_errors_the_deviations_tell_them():
    data = measured(0.01, 3)
    one, two = (mdr.fit(START, d, ["mu_0", "tau"]) for d in (data, mdr.FrictionData(data.v_0, data.cof)))
    assert two.values["mu_0"] == pytest.approx(one.values["mu_0"], rel=5e-3)
    assert two.high["tau"] / two.low["tau"] == pytest.approx(one.high["tau"] / one.low["tau"], rel=0.5)


def test_a_body_is_fitted_through_its_runs():
    v = mdr.critical_velocity(BODY) * np.linspace(0.1, 1.2, 8)
    start = replace(BODY, pull=replace(BODY.pull, k_x=7e3))
    found = mdr.fit(start, measured(0.002, 1, BODY, v), ["mu_0", "k_x"])
    assert found.low["mu_0"] < MU_0 < found.high["mu_0"]
    assert found.values["k_x"] == pytest.approx(8e3, rel=0.05)


def test_what_the_data_do_not_tell_is_said():
    above = mdr.critical_velocity(CASE) * np.linspace(1.1, 3, 10)
    found = mdr.fit(START, measured(0.01, 0, v=above), ["mu_0", "tau"])
    assert any(line.startswith("tau: the data hardly tell it") for line in found.warnings)
    elastic = replace(CASE, material=mdr.Elastic(E=3e6, nu=0.4))  # Eq. (1) knows kappa omega only
    pairs = mdr.fit(elastic, measured(0.01, 0, elastic), ["mindlin_ratio", "omega"])
    assert any("hardly tell them apart" in line for line in pairs.warnings)


@pytest.mark.parametrize(
    ("parameters", "error", "words"),
    [
        ("mu_0", TypeError, "must be a list of names"),
        ([], ValueError, "must name at least one"),
        ([3], TypeError, "parameters must be names"),
        (["k_x"], ValueError, "k_x is no parameter of this case"),
        (["taw"], ValueError, "taw is no parameter of this case; did you mean tau"),
        (["tau", "material.tau"], ValueError, "name one twice"),
        (["mu_0", "tau", "R", "E"], ValueError, "4 parameters need more than 4 measurements"),
    ],
)
def test_what_cannot_be_fitted_is_refused(parameters, error, words):
    data = mdr.FrictionData(V[:4], np.full(4, 0.3))
    with pytest.raises(error, match=words):
        mdr.fit(CASE, data, parameters)


def test_data_and_confidence_are_what_they_should_be():
    data = mdr.FrictionData(V[:4], np.full(4, 0.3))
    with pytest.raises(TypeError, match=r"must be FrictionData, as read_friction_data gives, got \(\(0, 0\.3\),\)"):
        mdr.fit(CASE, ((0, 0.3),), ["mu_0"])
    with pytest.raises(ValueError, match=r"confidence must lie between 0 and 1, got 95"):
        mdr.fit(CASE, data, ["mu_0"], confidence=95)


def test_ratios_of_the_body_are_fitted_as_its_fields_are():
    """k_x/k_xc is k_x in other units: the same fit, the same interval."""
    v = mdr.critical_velocity(BODY) * np.array([0.2, 0.5, 0.8])
    start, data = replace(BODY, pull=replace(BODY.pull, k_x=7e3)), measured(0.002, 1, BODY, v)
    field, ratio = (mdr.fit(start, data, [name]) for name in ("k_x", "k_x/k_xc"))
    for one, two in ((field.values, ratio.values), (field.low, ratio.low), (field.high, ratio.high)):
        assert two["k_x/k_xc"] * BODY.k_xc == pytest.approx(one["k_x"], rel=1e-3)  # to what least squares stop at


def test_a_parameter_that_is_zero_to_begin_with_is_refused():
    with pytest.raises(ValueError, match="c_x must be positive in the case"):
        mdr.fit(replace(BODY, pull=mdr.SpringPull(k_x=8e3)), measured(0.01), ["c_x"])
    with pytest.raises(ValueError, match="omega_0/omega must be positive in the case"):
        mdr.fit(replace(BODY, pull=mdr.RigidPull()), measured(0.01), ["omega_0/omega"])


def test_a_fit_prints_and_draws():
    found = mdr.fit(START, measured(0.01), ["mu_0", "tau"])
    assert "95% intervals" in str(found)
    assert "tau" in str(found)
    ax = found.plot()
    assert {text.get_text() for text in ax.get_legend().get_texts()} == {"measured", "fitted contact"}
    plt.close(ax.figure)
