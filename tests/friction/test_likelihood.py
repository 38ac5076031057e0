"""The likelihood of a fit: normal errors by hand, its gradient by its own differences, and what a sampler finds."""

import pickle
from dataclasses import replace

import emcee
import numpy as np
import pytest
from conftest import contact

import mdr

CONE = contact("cone", du_z=10e-6, mu_0=0.5)
KELVIN = contact("paraboloid", 2.0, 0.3, du_z=10e-6, mu_0=0.5)
BODY = replace(KELVIN, pull=mdr.SpringPull(k_x=8e3, m=0.05, c_x=2.0))


def measured(case, n=8, noise=0.01):
    """Friction of a case with noise."""
    v_0 = mdr.critical_velocity(case) * np.linspace(0.1, 1.2, n)
    cof = mdr.cof_curve(case, v_0, accuracy=1e-4).cof
    error = noise * cof
    return mdr.FrictionData(v_0, cof + error * np.random.default_rng(2).normal(size=n), error)


def of_a_cone(error=0.01):
    """Eight measurements of an elastic cone, and the fit of two parameters to them."""
    data = replace(measured(CONE), error=None if error is None else np.full(8, error))
    return mdr.fit(CONE, data, ["mu_0", "du_z"])


def test_the_likelihood_is_that_of_normal_errors():
    """-chi²/2, and the constant of the errors: by hand of the curve itself; of the scatter where no error is known."""
    for error in (0.01, None):
        found = of_a_cone(error)
        best = [*found.values.values()]
        sd = error or np.sqrt(np.sum(found.residuals**2) / (8 - 2))
        at_best = -np.sum((found.residuals / sd) ** 2) / 2 - 8 * np.log(sd * np.sqrt(2 * np.pi))
        assert found.log_likelihood(best) == pytest.approx(at_best, rel=1e-12)
        other = replace(CONE, mu_0=0.49, oscillation=replace(CONE.oscillation, du_z=9e-6))
        left = (mdr.cof_curve(other, found.data.v_0).cof - found.data.cof) / sd
        apart = (np.sum((found.residuals / sd) ** 2) - left @ left) / 2
        assert found.log_likelihood([0.49, 9e-6]) - at_best == pytest.approx(apart, rel=1e-9)
        near = [[m * best[0], d * best[1]] for m in (0.99, 1.01) for d in (0.99, 1.01)]
        assert max(map(found.log_likelihood, near)) < at_best


@pytest.mark.parametrize("case", [KELVIN, BODY], ids=["rigid", "body"])
def test_the_gradient_is_that_of_the_likelihood_s_own_differences(case):
    found = mdr.fit(case, measured(case, 6), ["mu_0", "tau"])
    best = np.array([*found.values.values()])
    for away in ((1.02, 1.1), (0.99, 0.8)):
        values = best * away
        value, gradient = found.log_likelihood.with_gradient(values)
        assert value == found.log_likelihood(values)
        for i, one in enumerate(values):
            step = 2e-4 * one * (np.arange(2) == i)
            beside = (found.log_likelihood(values + step) - found.log_likelihood(values - step)) / (4e-4 * one)
            steepest = max(abs(gradient * values)) / one  # per share
            assert abs(gradient[i] - beside) < 5e-3 * steepest  # by a step of 1e-3, on one side


def test_outside_of_the_bounds_nothing_is_likely():
    found = mdr.fit(KELVIN, measured(KELVIN), ["mu_0", "tau"], bounds={"mu_0": (0.3, 0.6), "tau": (0.0, 0.1)})
    for values in ([0.29, 1e-3], [0.61, 1e-3], [0.5, -1e-6], [0.5, 0.11]):
        assert found.log_likelihood(values) == -np.inf
        value, gradient = found.log_likelihood.with_gradient(values)
        assert (value, gradient.tolist()) == (-np.inf, [0.0, 0.0])
    assert np.isfinite(found.log_likelihood([0.5, 0.0]))
    lifts = mdr.fit(CONE, measured(CONE), ["u_z0", "du_z"])
    assert lifts.log_likelihood([-2e-5, 1e-5]) == -np.inf  # an indenter that never touches
    for wrong, words in (([0.5], "values must be 2, mu_0, tau, got 1"), ([0.5, np.nan], "values must be finite")):
        with pytest.raises(ValueError, match=words):
            found.log_likelihood(wrong)
    assert pickle.loads(pickle.dumps(found)) == found


def test_a_sampler_finds_the_intervals_of_the_fit():
    """The interval is of Student's t, 2.45 standard deviations at 6 spare points; 560 draws, of which some 30 are
    independent, know these to a quarter.
    """
    found = of_a_cone()
    best, half = np.array([*found.values.values()]), (np.array([*found.high.values()]) - [*found.low.values()]) / 2
    sampler = emcee.EnsembleSampler(8, 2, found.log_likelihood)
    sampler.random_state = np.random.RandomState(3).get_state()
    sampler.run_mcmc(best + half / 2.45 * np.random.default_rng(3).normal(size=(8, 2)), 90)
    drawn = sampler.get_chain(discard=20, flat=True)
    np.testing.assert_allclose(drawn.std(axis=0), half / 2.45, rtol=0.25)
    assert np.all(np.abs(drawn.mean(axis=0) - best) < half / 2)
    assert np.corrcoef(drawn.T)[0, 1] == pytest.approx(found.correlation[0, 1], abs=0.25)
