"""Arms from relaxation and creep: a known body comes back within the noise put in."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr
from mdr.materials import step_fit

BODY = mdr.Prony(E_inf=1e6, arms=((2e6, 0.05), (5e5, 3.0)), nu=0.4)
YOUNG = 1 - 0.4**2  #: Young's modulus over the contact modulus
T = np.geomspace(1e-3, 100, 60)
OMEGA = np.geomspace(0.1, 100, 50)  #: between the times, inverted, a decade from either end


def relaxation(t):
    return YOUNG * BODY.relaxation_modulus(t)


def creep(t):
    return BODY.creep_compliance(t) / YOUNG


@pytest.mark.parametrize(("fit", "measured"), [(mdr.Prony.fit_relaxation, relaxation), (mdr.Prony.fit_creep, creep)])
@pytest.mark.parametrize("noise", [0.0, 0.01, 0.03])
def test_a_known_body_comes_back_from_a_step(fit, measured, noise):
    """To twice the noise; exact ones to what is left of a search for times; in any order."""
    rng = np.random.default_rng(1)
    order = rng.permutation(T.size)
    data = (measured(T) * (1 + noise * rng.normal(size=T.size)))[order]
    found = fit(T[order], data, nu=0.4)
    assert_allclose(found.dynamic_modulus(OMEGA), BODY.dynamic_modulus(OMEGA), rtol=1e-6 + 2 * noise)
    assert found.nu == 0.4


@pytest.mark.parametrize(("fit", "measured"), [(mdr.Prony.fit_relaxation, relaxation), (mdr.Prony.fit_creep, creep)])
def test_many_readings_are_as_good_as_few(fit, measured):
    """Means over half a per cent of time, whose square over 24 they miss at most."""
    t = np.linspace(0, 100, 30_001)[1:]
    found = fit(t, measured(t), nu=0.4)
    omega = np.geomspace(0.1, 30, 20)
    assert_allclose(found.dynamic_modulus(omega), BODY.dynamic_modulus(omega), rtol=1e-4)


@pytest.mark.parametrize("exponent", [0.15, 0.3, 0.45])
def test_a_relaxation_that_is_steep_at_first_says_what_it_lacks(exponent):
    """E(t) = t^-p: E(omega) at a decade below the first time inverted is off by no more than is said, and 1 %."""
    body = mdr.Prony.power_law(modulus=1e6, exponent=exponent, omega=(1e-4, 1e5), nu=0.4)
    with pytest.warns(mdr.PlausibilityWarning, match="the modulus still falls like") as told:
        found = mdr.Prony.fit_relaxation(T, YOUNG * body.relaxation_modulus(T), nu=0.4)
    (said,) = (float(str(one.message).partition("off by ")[2].partition("%")[0]) / 100 for one in told)
    off = abs(found.dynamic_modulus(OMEGA) / body.dynamic_modulus(OMEGA) - 1)
    assert 0.3 * said < np.max(off) < said + 0.01


def test_few_arms_that_miss_are_told():
    for fit, data in ((mdr.Prony.fit_relaxation, relaxation(T)), (mdr.Prony.fit_creep, creep(T))):
        with pytest.warns(mdr.PlausibilityWarning, match="so many arms miss the data by .* leave n_arms out"):
            fit(T, data, nu=0.4, n_arms=2)


def test_arms_of_a_creep_are_exact():
    """J_0 + sum J_k (1 - exp(-t/theta_k)) and its arms are one material: J(omega) E(omega) = 1."""
    theta, J, start = np.geomspace(100, 1e-3, 4), np.array([3.0, 0.5, 2.0, 1.0]) * 1e-6, 2e-6
    data = start - np.expm1(-T[:, None] / theta) @ J
    E_inf, arms, tau = step_fit.to_creep(T, data, 4)
    body = mdr.Prony(E_inf, arms, 0.0, tau)
    compliance = start + np.sum(J / (1 + 1j * OMEGA[:, None] * theta), axis=1)
    assert_allclose(body.dynamic_modulus(OMEGA) * compliance, 1, rtol=1e-9)  # as near as least squares are
    assert tau == 0


def test_what_yields_not_at_once_is_a_kelvin_body():
    body = mdr.KelvinVoigt(E=1e6, nu=0.4, tau=T[-1] / 1e3)
    found = mdr.Prony.fit_creep(T, body.creep_compliance(T) / YOUNG, nu=0.4, n_arms=6)  # one time a decade
    assert found.arms == ()
    assert_allclose([found.E_inf, found.tau], [1e6, body.tau], rtol=1e-9)


def test_a_spring_has_no_arms():
    assert mdr.Prony.fit_creep(T, np.full(60, 1e-6), nu=0.3).arms == ()
    assert_allclose(mdr.Prony.fit_relaxation(T, np.full(60, 1e6), nu=0.3).E_inf, 1e6, rtol=1e-9)


@pytest.mark.parametrize("fit", [mdr.Prony.fit_relaxation, mdr.Prony.fit_creep])
def test_what_is_wrong_with_a_step_is_told(fit):
    for t, values, words in [
        ([1, 2], [1e6, -1], "must be positive"),
        ([1, 2, 3], [1e6, 1e6], "lists of one length"),
        ([-1, 2, 3], [1e6, 1e6, 1e6], "t must count from the step"),
        ([0, 2], [1e6, 1e6], "two times above 0 s or more"),
    ]:
        with pytest.raises(ValueError, match=words):
            fit(t, values, nu=0.3)
    wrong = T if fit == mdr.Prony.fit_relaxation else 1 / T
    with pytest.warns(mdr.PlausibilityWarning, match="misses the test by"):
        fit(T, 1e6 * wrong, nu=0.3)
