"""Points: their values are those of direct calls, and what fails fails alone and says why."""

import threading
from dataclasses import replace

import numpy as np
import pytest
from grids import BODY, COARSE, RIGID, SHAPES, work
from numpy.testing import assert_array_equal

import mdr
from mdr.studies.points import compute, reason_of
from mdr.studies.quantities import Quantity
from mdr.tools.progress import Ended
from mdr.tools.status import Status


def test_a_path_that_some_records_lack_is_a_failure_of_their_points():
    study = mdr.sweep(RIGID, {"indenter": SHAPES, "indenter.R": [1e-3]}, quantities=["v_c"])
    assert_array_equal(study.status.ravel(), [Status.DONE, Status.FAILED, Status.FAILED])
    assert study.why[1, 0] == "indenter.R: Cone has no R"


def test_a_resonance_is_a_failure_of_the_velocities_and_a_value_of_v_c():
    m = [0.1, 0.2]
    case = replace(BODY, pull=mdr.SpringPull(k_x=300.0**2 * 0.1))
    study = mdr.sweep(case, {"pull.m": m, "v_0/v_c": [0.5, 0.9]}, quantities=["cof", "v_c"], **COARSE)
    assert np.isinf(study["v_c"][0]).all()
    assert np.isnan(study["cof"][0]).all()
    assert study.why[0, 0].startswith("v_0/v_c: the critical velocity of this case is infinite")
    assert np.isfinite(study["cof"][1]).all()


def test_a_run_that_did_not_settle_keeps_its_numbers(monkeypatch):
    def restless(case, v_0, closely, **knobs):
        curve = mdr.cof_curve(case, v_0, **knobs)
        return replace(curve, settled=curve.v_0 < 3e-4, why=tuple("F_x drifts" * bool(v > 2e-4) for v in curve.v_0))

    monkeypatch.setattr("mdr.studies.points.cof_at", restless)
    v_0 = [1e-4, 4e-4, 2.5e-4]
    study = mdr.sweep(RIGID, {"v_0": v_0}, quantities=["cof", "settled"])
    assert_array_equal(study.status, [Status.DONE, Status.UNSETTLED, Status.DONE])
    assert_array_equal(study["cof"], mdr.cof_curve(RIGID, v_0).cof)
    assert_array_equal(study["settled"], [1, 0, 1])
    assert study.why.tolist() == ["", "F_x drifts", ""]  # a settled run has nothing to explain


@pytest.mark.parametrize("shake", [None, mdr.InPlaneOscillation(300.0, 2e-6)], ids=["still", "shaken"])
def test_a_limit_at_rest_above_them_contradicts_the_runs_of_a_shaken_contact_as_in_a_curve(shake, monkeypatch):
    case = replace(BODY, shake=shake)
    monkeypatch.setattr("mdr.friction.cof_curve._at_rest", lambda *_: (10.0, 0.0, True, 1.0, "", 0.0))
    study = mdr.sweep(case, {"v_0": [2e-4]}, quantities=["cof", "cof_error", "settled"], **COARSE)
    curve = mdr.cof_curve(case, [2e-4], **COARSE)
    for name in study.quantities[:3]:
        assert_array_equal(study[name], getattr(curve, name))
    assert curve.settled.tolist() == [shake is None]
    assert study.why.tolist() == list(curve.why)


def test_of_velocities_that_are_computed_together_only_the_guilty_fail():
    """Beyond 1e15 times Eq. (1) a march refuses."""
    study = mdr.sweep(BODY, {"v_0": [1e-4, 1e20, 2e-4]}, quantities=["cof"], **COARSE)
    assert_array_equal(study.status, [Status.DONE, Status.FAILED, Status.DONE])
    assert "full slip but for rounding" in study.why[1]
    assert study["cof"][0] == mdr.slide(BODY, 1e-4, **COARSE).cof


def faulty(case):
    if case.mu_0 > 0.5:
        raise KeyError("steep")
    return np.nan if case.mu_0 > 0.3 else 1.0


def test_a_quantity_that_fails_leaves_the_others():
    study = mdr.sweep(RIGID, {"mu_0": [0.2, 0.4, 0.6]}, quantities=[Quantity("own", "-", faulty), "v_c"])
    assert np.isfinite(study["v_c"]).all()
    assert_array_equal(study["own"], [1.0, np.nan, np.nan])
    assert_array_equal(study.status, [Status.DONE, Status.FAILED, Status.FAILED])
    assert study.why.tolist() == ["", "own: is not a number", "own: KeyError: 'steep'"]


def test_reasons_are_one_line_without_places_in_memory():
    assert reason_of(ValueError("a\nb")) == "a b"
    assert reason_of(ZeroDivisionError()) == "ZeroDivisionError"
    assert reason_of(TypeError(f"got {object()!r}")) == "got <object object>"
    assert len(reason_of(ValueError("x" * 1000))) == 400


def test_the_work_ends_soon_after_it_is_asked_to():
    ended, seen = threading.Event(), []

    def of(case):
        seen.append(case.mu_0)
        ended.set()
        return 1.0

    given = work(RIGID, {"mu_0": [0.2, 0.4, 0.6]}, [Quantity("own", "-", of)])
    with pytest.raises(Ended):
        compute(given, range(3), ended)
    assert seen == [0.2]


def test_nothing_inside_speaks(capsys, monkeypatch):
    monkeypatch.setattr("mdr.tools.progress.PATIENCE", -1.0)
    compute(work(BODY, {"v_0": [1e-4, 2e-4]}, ["cof"], **COARSE), range(1))
    assert capsys.readouterr().err == ""


def test_a_study_looks_at_springs_closely_where_it_is_asked_for_what_they_do(monkeypatch):
    def refuse(*_):
        raise RuntimeError("looked")

    monkeypatch.setattr("mdr.march.dynamics.stepper.Stepper._look", refuse)
    axes = {"v_0": [1e-4, 3e-4]}
    study = mdr.sweep(BODY, axes, quantities=["cof", "cof_error", "share", "mean_F_x", "settled"], **COARSE)
    assert study.count(Status.DONE) == 2
    study = mdr.sweep(BODY, axes, quantities=["cof", "stick_share"], **COARSE)
    assert study.why.tolist() == ["RuntimeError: looked"] * 2


def test_values_are_those_of_direct_calls():
    axes = {"v_0/v_c": [0.0, 0.5, 1.1], "indenter": SHAPES, "T": [0.1, 1.0]}
    study = mdr.sweep(RIGID, axes, quantities=["cof", "stick_share", "v_c", "mean_F_N"])
    assert study.shape == (3, 3, 2)
    for i, shape in enumerate(SHAPES):
        for j, T in enumerate(axes["T"]):
            case = replace(RIGID, indenter=shape, material=replace(RIGID.material, tau=T / 300.0))
            curve = mdr.cof_curve(case, np.array(axes["v_0/v_c"]) * mdr.critical_velocity(case))
            assert_array_equal(study["cof"][:, i, j], curve.cof)
            assert_array_equal(study["stick_share"][:, i, j], curve.stick_share)
            assert_array_equal(study["v_c"][:, i, j], mdr.critical_velocity(case))
    assert study.count(Status.DONE) == 18
