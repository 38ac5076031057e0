"""Parameters from measured friction: what was put in comes out, within its interval, or a warning."""

import re
from dataclasses import replace
from itertools import count
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import contact

import mdr
from mdr.friction.cof_curve import friction_without_bound
from mdr.given.vary import case_at

TAU, MU_0 = 1e-3, 0.5
CASE = contact("paraboloid", 2.0, 300.0 * TAU, du_z=10e-6, mu_0=MU_0)
BODY = replace(CASE, pull=mdr.SpringPull(k_x=8e3, m=0.05, c_x=2.0))
START = replace(CASE, mu_0=0.4, material=mdr.KelvinVoigt(E=3e6, nu=0.3, tau=3e-3))
V = mdr.critical_velocity(CASE) * np.linspace(0.05, 1.3, 20)
TRUTH = {"mu_0": MU_0, "mindlin_ratio": CASE.material.mindlin_ratio, "tau": TAU}


def measured(noise, seed=0, case=CASE, v=V):
    cof = mdr.cof_curve(case, v, n_springs=64, steps_per_period=256).cof
    drawn = cof * (1 + noise * np.random.default_rng(seed).normal(size=v.size))
    return mdr.FrictionData(v, drawn, max(noise, 1e-6) * np.abs(cof))


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


def test_a_body_is_fitted_through_its_runs():
    v = mdr.critical_velocity(BODY) * np.linspace(0.1, 1.2, 8)
    start = replace(BODY, pull=replace(BODY.pull, k_x=7e3))
    found = mdr.fit(start, measured(0.002, 1, BODY, v), ["mu_0", "k_x"])
    assert found.low["mu_0"] < MU_0 < found.high["mu_0"]
    assert found.values["k_x"] == pytest.approx(8e3, rel=0.05)


def test_what_the_data_do_not_tell_is_said():
    above = mdr.critical_velocity(CASE) * np.linspace(1.1, 3, 10)
    found = mdr.fit(START, measured(0.01, 0, v=above), ["mu_0", "tau"])
    assert found.undetermined == ("tau",)
    assert "tau: not determined by these data; its interval is wider than 3 decades" in found.warnings
    assert "tau              not determined (best fit" in str(found)
    assert 1e-6 < found.low["tau"] < found.high["tau"] < 10  # what was searched, a factor of 1000 either way
    elastic = replace(CASE, material=mdr.Elastic(E=3e6, nu=0.4))  # Eq. (1) knows kappa omega only
    pairs = mdr.fit(elastic, measured(0.01, 0, elastic), ["mindlin_ratio", "omega"])
    assert any("hardly tell them apart" in line for line in pairs.warnings)


def test_a_parameter_may_begin_at_zero_where_it_may_be_zero():
    undamped = replace(CASE, material=mdr.KelvinVoigt(E=3e6, nu=0.4, tau=0.0))
    free, within = (mdr.fit(undamped, measured(0.01), ["tau"], bounds=b) for b in (None, {"tau": (0.0, 1.0)}))
    assert free.low["tau"] < TAU < free.high["tau"]
    assert within.values["tau"] == pytest.approx(free.values["tau"], rel=1e-4)


def test_bounds_hold_the_search_and_judge_the_interval():
    data = measured(0.01)
    at_end = mdr.fit(replace(CASE, mu_0=0.45), data, ["mu_0"], bounds={"mu_0": (0.3, 0.48)})
    assert at_end.values["mu_0"] == pytest.approx(0.48, rel=1e-3)
    assert any("the best fit is at the end of what is searched, 0.3 to 0.48" in line for line in at_end.warnings)
    narrow = mdr.fit(CASE, data, ["tau"], bounds={"material.tau": (0.95e-3, 1.05e-3)})  # by either name
    assert narrow.undetermined == ("tau",)
    assert "wider than its bounds" in narrow.warnings[0]


def test_a_phase_is_fitted_to_both_ways_from_zero():
    start = replace(contact("cone", du_z=6e-6, mu_0=MU_0), shake=mdr.InPlaneOscillation(300.0, du_x=5e-6))
    turned = replace(start, shake=replace(start.shake, phi_x=0.8))
    both = measured(0.005, 1, turned, np.linspace(-2.5e-3, 2.5e-3, 10))
    data = mdr.FrictionData(both.v_0, both.cof, np.full(10, 0.003))
    found = mdr.fit(start, data, ["phi_x", "mu_0"])
    assert found.low["phi_x"] < 0.8 < found.high["phi_x"]
    assert abs(found.correlation[0, 1]) < 1
    least, most = found.curve.v_0[[0, -1]]
    assert least < -2.5e-3 < 2.5e-3 < most


def test_signs_that_no_unshaken_contact_shows_are_refused():
    v = V[:4]
    with pytest.raises(ValueError, match=r"v_0 must not be negative, got .* unless the contact is shaken in the plane"):
        mdr.fit(CASE, mdr.FrictionData(-v, np.full(4, 0.3)), ["mu_0"])
    with pytest.raises(ValueError, match=r"cof must not be negative, got -0\.3 .*turn the sign of the force"):
        mdr.fit(CASE, mdr.FrictionData(v, [0.3, -0.3, 0.3, 0.3], np.full(4, 0.05)), ["mu_0"])
    mdr.fit(CASE, mdr.FrictionData(v, [-0.01, 0.2, 0.2, 0.2], np.full(4, 0.05)), ["mu_0"])  # within its error
    high = mdr.fit(CASE, mdr.FrictionData(v, np.full(4, 0.8)), ["tau"])
    assert "cof: measured up to 0.8, above mu_0 = 0.5; fit mu_0 too" in high.warnings


def test_a_curve_that_misses_the_data_says_so():
    """The stiffness ratio of START is wrong by 9 %, ten times the noise."""
    missed = mdr.fit(START, measured(0.01), ["mu_0"])
    assert any("misses the data by more than their errors explain" in line for line in missed.warnings)
    assert missed.rms > 2


def test_a_fit_prints_and_draws():
    found = mdr.fit(START, measured(0.01), ["mu_0", "tau"])
    told = str(found).splitlines()
    assert told[0] == "95% intervals:"
    assert re.fullmatch(r"mu_0 +0\.\d+ \(0\.\d+ \.\.\. 0\.\d+\)", told[1])  # a pure number has no unit
    assert re.fullmatch(r"tau +\S+ \(\S+ \.\.\. \S+\) s", told[2])
    assert re.fullmatch(r"correlations: mu_0 and tau [+-]0\.\d\d", told[3])
    ax = found.plot()
    below = ax.figure.axes[1]
    assert below.get_ylabel() == "measured\nless fitted"
    assert {text.get_text() for text in ax.get_legend().get_texts()} == {"measured", "fitted contact"}


def test_runs_are_as_accurate_as_the_data_are_worth():
    """With errors of 1 % runs are coarser, and the best fit moves by less than a tenth of its interval."""
    v = mdr.critical_velocity(BODY) * np.linspace(0.1, 1.2, 6)
    start, rough = replace(BODY, mu_0=0.45), measured(0.01, 1, BODY, v)
    found = mdr.fit(start, rough, ["mu_0"])
    assert 0 < found.cof_error < 0.1 * rough.error.min()
    sharp = mdr.fit(start, replace(rough, error=1e-4 * rough.error), ["mu_0"])
    assert sharp.cof_error < found.cof_error
    assert abs(found.values["mu_0"] - sharp.values["mu_0"]) < 0.1 * (found.high["mu_0"] - found.low["mu_0"])


def test_a_stop_answers_the_best_so_far(monkeypatch, capfd):
    """By the limit, or an interrupt; before the first curve there is nothing to answer."""
    curves = []

    def interrupted(*given):
        curves.append(given)
        if len(curves) == 5:
            raise KeyboardInterrupt
        return friction_without_bound(*given)

    monkeypatch.setattr("mdr.friction.likelihood.friction_without_bound", interrupted)
    monkeypatch.setattr("mdr.tools.compiling.time", SimpleNamespace(monotonic=count(0.0, 20.0).__next__))
    data = measured(0.01)
    found = mdr.fit(START, data, ["mu_0", "tau"])
    assert found.stopped == "an interrupt"
    assert "stopped by an interrupt: the best values so far" in found.warnings[0]
    at_start = (mdr.cof_curve(START, data.v_0).cof - data.cof) / data.error
    assert 0 < found.rms <= np.sqrt(np.mean(at_start**2)) * (1 + 1e-6)
    assert re.search(r"fit, mu_0 = 0\.\d+, tau = \S+ s so far, \S+ left on average: \d curves", capfd.readouterr().err)
    curves.append(None)
    monkeypatch.setattr("mdr.friction.fit.time_is_over", lambda: len(curves) > 8)
    assert mdr.fit(START, data, ["mu_0", "tau"], limit_s=60.0).stopped == "the limit of 60 s"
    with pytest.raises(ValueError, match="limit_s = 60 s is over before the first curve is done; raise it"):
        mdr.fit(START, data, ["mu_0", "tau"], limit_s=60.0)
    monkeypatch.setattr("mdr.friction.fit.time_is_over", lambda: False)
    curves[:] = [None] * 4
    with pytest.raises(KeyboardInterrupt):
        mdr.fit(START, data, ["mu_0", "tau"])


def counted(monkeypatch, friction=friction_without_bound):
    """Curves that are asked for, in a list."""
    curves = []

    def of(case, *given):
        curves.append(case)
        return friction(case, *given)

    monkeypatch.setattr("mdr.friction.likelihood.friction_without_bound", of)
    return curves


def test_a_fit_takes_a_curve_for_each_step_and_derivatives_at_first_and_at_the_end(monkeypatch):
    """One of each parameter at both ends and perhaps once between, and a dozen steps. A body begins with runs of a
    quarter, whose derivatives serve the finer ones.
    """
    curves = counted(monkeypatch)
    mdr.fit(START, measured(0.01, 1), list(TRUTH))
    assert len(curves) <= 3 * 3 + 12
    v = mdr.critical_velocity(BODY) * np.linspace(0.1, 1.2, 6)
    data = measured(0.002, 1, BODY, v)
    curves.clear()
    mdr.fit(replace(BODY, pull=replace(BODY.pull, k_x=7e3)), data, ["mu_0", "k_x"])
    assert len(curves) <= 3 * 2 + 12


def test_a_step_to_where_there_is_no_case_is_shortened_and_a_best_fit_there_is_refused(monkeypatch):
    walls = {"at": 0.502}

    def walled(case, *given):
        if case.mu_0 > walls["at"]:
            raise ValueError("a wall")
        return friction_without_bound(case, *given)

    curves = counted(monkeypatch, walled)
    found = mdr.fit(replace(CASE, mu_0=0.4), measured(0.0), ["mu_0"])
    assert found.values["mu_0"] == pytest.approx(MU_0, rel=1e-4)
    assert max(case.mu_0 for case in curves) > 0.502
    walls["at"] = 0.45
    with pytest.raises(ValueError, match=r"the search came to mu_0 = 0\.45\d*: a wall; keep it away by bounds"):
        mdr.fit(replace(CASE, mu_0=0.4), measured(0.0), ["mu_0"])


@pytest.mark.parametrize("over", ["du_z", "shake.du_x"])
def test_friction_over_an_amplitude_at_one_velocity_is_fitted(over):
    """As most papers measure it; the values of the case itself at that path do not matter."""
    shaken = replace(contact("cone", du_z=6e-6, mu_0=MU_0), shake=mdr.InPlaneOscillation(300.0, du_x=5e-6))
    values = np.array([1e-6, 2e-6, 4e-6, 6e-6, 8e-6])
    cof = [
        mdr.cof_curve(case_at(shaken, {f"oscillation.{over}" if "." not in over else over: x}), [4e-4]).cof[0]
        for x in values
    ]
    data = mdr.FrictionData(4e-4, cof, np.full(5, 1e-4), over, values)
    found = mdr.fit(replace(shaken, mu_0=0.4), data, ["mu_0"])
    assert found.values["mu_0"] == pytest.approx(MU_0, rel=1e-3)
    assert found.plot().get_xlabel() == f"{over} [SI]"
    with pytest.raises(ValueError, match="the data are over"):
        _ = found.curve


def test_data_over_what_a_case_lacks_are_refused_before_the_search():
    data = mdr.FrictionData([1e-3, 1e-3], [0.3, 0.2], over="du_x", values=[1e-6, 2e-6])
    with pytest.raises(ValueError, match="the data are over du_x, which this case lacks: give it a shake"):
        mdr.fit(contact("flat"), data, ["mu_0"])
