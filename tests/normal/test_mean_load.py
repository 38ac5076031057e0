"""A load that stays: hold = "load" keeps the mean load at every answer, trial and point; without it, it is said."""

import warnings

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr
from mdr.given.case_file import case_of
from mdr.given.vary import case_at, still_held
from mdr.normal.normal_force import mean_normal_force
from mdr.studies.study_files import study_from

#: a horn on plastic at 20 kHz, whose answers under a true weight were found by hand
HORN = {
    "mu_0": 0.3,
    "indenter": {"shape": "Sphere", "R": 3e-3},
    "material": {"model": "KelvinVoigt", "E": 3e9, "nu": 0.4, "tan_delta": 0.03},
    "oscillation": {"frequency": 20e3, "load": 5.0, "du_z": 2e-6},
}
HELD = HORN | {"oscillation": HORN["oscillation"] | {"hold": "load"}}


def test_a_body_and_a_tapping_contact_are_held_in_a_march():
    """The march knows nothing of the force that the depth was solved with."""
    tables = HELD | {"pull": {"k_x": 1e6, "m": 0.0}, "oscillation": HELD["oscillation"] | {"du_z": 14e-6}}
    run = mdr.slide(case_of(tables).case, 0.3, n_springs=256, steps_per_period=256)
    assert_allclose(run.mean_F_z, 5.0, rtol=1e-4)


@pytest.mark.parametrize(("cof", "rested", "weighed"), [(0.03, 6.49, 5.96), (0.01, 14.1, 15.5)])
def test_the_amplitude_under_a_true_weight(cof, rested, weighed):
    """By hand: a mean depth was sought for each amplitude."""
    for tables, expected in ((HORN, rested), (HELD, weighed)):
        said = case_of(tables)
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            found = mdr.find(said.case, "du_z", v_0=0.01, cof=cof, held=said.held)
        assert_allclose(np.multiply(found.values, 1e6), [expected], rtol=5e-3)
        assert_allclose(found.mean_F_N, mean_normal_force(found.cases[0]), rtol=1e-12)
        ratio = found.mean_F_N[0] / 5.0
        words = [str(one.message) for one in told]
        if tables is HELD:
            assert_allclose(ratio, 1.0, rtol=1e-9)
            assert words == []
        else:
            warning = f"at the value found the mean load is {ratio:.3g} times the load of 5 N"
            assert [warning in one for one in words] == [True]


def test_studies_and_tolerances_say_where_the_mean_load_runs_away():
    axes = {"axes": {"oscillation.du_z": [5e-7, 7e-6, 14e-6]}, "quantities": ["v_c"]}
    with pytest.warns(mdr.PlausibilityWarning, match=r"at 2 of 3 points the mean load is up to 1\.79 times the load"):
        found = mdr.sweep(**vars(study_from(HORN | axes)))
    assert found.quantities == ("v_c", "mean_F_N")
    said = case_of(HORN)
    with pytest.warns(mdr.PlausibilityWarning, match=r"at \d of 5 points the mean load is up to 1\.0"):
        mdr.tolerance(said.case, 0.01, fields=["load", "du_z"], held=said.held)
    by_load = HORN | {"axes": {"load": [1.0, 500.0]}, "quantities": ["v_c"]}
    with pytest.warns(mdr.PlausibilityWarning, match=r"at 1 of 2 .* is 1\.\d+ times the load of 1 N"):
        mdr.sweep(**vars(study_from(by_load)))


def test_what_varies_is_warned_of_and_not_what_it_begins_with():
    text = mdr.write_case(case_of(HORN).case).replace(f"u_z0 = {case_of(HORN).case.oscillation.u_z0!r}", "load = 5.0")
    with pytest.warns(mdr.PlausibilityWarning, match=r"the mean load is 1\.01 times"):
        mdr.parse_case(text)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mdr.parse_case(text.replace("load = 5.0", 'load = 5.0\nhold = "depth"'))
        mdr.parse_case(text.replace("load = 5.0", 'load = 5.0\nhold = "load"'))
        case_of(HORN)


def test_a_load_that_is_held_about_a_constant_depth_is_that_of_the_depth():
    ball, rubber, shake = mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), mdr.InPlaneOscillation(300.0, 5e-6)
    case = mdr.SlidingContact(ball, rubber, 0.4, mdr.ConstantDepth(20e-6), shake=shake)
    held = {"load": 0.05, "hold": "load"}
    assert_allclose(mean_normal_force(case_at(case, held)), 0.05, rtol=1e-9)
    found = mdr.sweep(case, {"shake.du_x": [5e-6, 2e-6], "v_0": [1e-4]}, quantities=("mean_F_z",), held=held)
    assert_allclose(found["mean_F_z"], 0.05, rtol=1e-9)


def test_a_load_that_is_sought_or_varied_is_the_mean_load():
    said = case_of(HELD | {"oscillation": HELD["oscillation"] | {"du_z": 7e-6}})
    v_0, truth = 0.01, case_at(said.case, {"load": 7.0, "hold": "load"})
    wanted = float(mdr.cof_curve(truth, v_0).cof[0])
    found = mdr.find(said.case, "load", v_0=v_0, cof=wanted, within=(6.0, 8.0), held=said.held)
    assert_allclose([*found.values, *found.mean_F_N], [7.0, 7.0], rtol=1e-6)
    spread = mdr.tolerance(said.case, v_0, fields=["load"], held=said.held)
    assert_allclose(spread.inputs["load"], [4.5, 5.5])
    less = case_at(said.case, {"load": 4.5, "hold": "load"})
    assert_allclose(spread.cof["load"][0], mdr.cof_curve(less, v_0).cof[0], rtol=1e-10)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"hold": "force"}, 'hold must be "depth" or "load", got'),
        ({"hold": 1}, 'hold must be "depth" or "load", got 1'),
        ({"load": None, "u_z0": 2e-6}, "hold says what stays of a load"),
        ({"du_z": None, "dF_z": 1.0, "hold": "depth"}, 'hold = "depth" is about a driven depth'),
        ({"load": 1e9}, "more than Sphere"),
    ],
)
def test_what_cannot_be_held_is_refused(given, words):
    motion = {key: value for key, value in (HELD["oscillation"] | given).items() if value is not None}
    with pytest.raises(mdr.CaseFileError, match=words):
        case_of(HELD | {"oscillation": motion})


def test_what_is_held_in_python_says_of_what():
    with pytest.raises(ValueError, match="hold says what stays of a load"):
        still_held({"hold": "load"}, [])
    assert still_held({"load": 5.0, "hold": "load"}, ["oscillation.u_z0"]) == {}
    assert still_held({"load": 5.0, "hold": "load"}, ["load"]) == {"hold": "load"}


def test_a_shape_that_ends_is_held_as_far_as_it_reaches():
    """A load that rests near the rim: a depth that swings about there would leave the shape, one that carries the load
    on average need not.
    """
    cap = mdr.SampledProfile(*np.array([(r, r * r / 1e-2) for r in np.linspace(0, 1e-3, 41)]).T)
    rubber = mdr.Elastic(E=3e9, nu=0.4)
    reach = float(cap.profile_1d(cap.max_radius))
    near, less = (mdr.static_load(cap, rubber, share * reach) for share in (0.95, 0.803))
    case = mdr.SlidingContact(cap, rubber, 0.5, mdr.NormalOscillation(0.5 * reach, 0.2 * reach, 300.0))
    held = case_at(case, {"load": less, "hold": "load"})
    assert_allclose(mean_normal_force(held), less, rtol=1e-9)
    with pytest.raises(ValueError, match=r"the mean load is less than .* about every mean depth"):
        case_at(case, {"load": near, "hold": "load"})
    with pytest.raises(ValueError, match=r"deeper|radius|reach"):
        case_at(case, {"load": less})


def test_a_fit_holds_the_mean_load():
    said = case_of(HELD | {"oscillation": HELD["oscillation"] | {"du_z": 7e-6}})
    truth = case_at(said.case, {**said.held, "material.E": 2.5e9})
    v_0 = mdr.critical_velocity(truth) * np.array([0.02, 0.1, 0.3, 0.6])
    data = mdr.FrictionData(v_0=v_0, cof=mdr.cof_curve(truth, v_0).cof)
    found = mdr.fit(said.case, data, ["E"], held=said.held)
    assert_allclose(found.values["E"], 2.5e9, rtol=1e-4)
    assert_allclose(mean_normal_force(found.case), 5.0, rtol=1e-9)
