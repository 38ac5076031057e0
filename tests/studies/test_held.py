"""Load, frequency and loss tangent of a file hold at every point of a study, which is the single case of its values."""

import re

import numpy as np
import pytest
from horn import HORN, written
from numpy.testing import assert_allclose

import mdr
from mdr.studies import CATALOGUE
from mdr.studies.study_files import study_from

CONSTANTS = ("mean_F_N", "v_c", "k_zc", "T", "static_cof")


def file(tables, axes, quantities=CONSTANTS):
    return vars(study_from({**tables, "axes": axes, "quantities": list(quantities)}))


def study(tables, axes, quantities=CONSTANTS):
    return mdr.sweep(**file(tables, axes, quantities))


def agrees(tables, axes, runs=False):
    """Compare every point with the single case of its values, and its friction with that of a run; returns how many."""
    found = study(tables, axes)
    curves = study(tables, {**axes, "v_0/v_c": [0.4]}, ("cof", "cof_error")) if runs else None
    for where in np.ndindex(found.shape):
        case = written(tables, {path: axes[path][i] for path, i in zip(axes, where, strict=True)})
        expected = [CATALOGUE[name].of(case) for name in CONSTANTS]
        assert_allclose([found[name][where] for name in CONSTANTS], expected, rtol=1e-12)
        if "hold" in tables["oscillation"]:
            load = axes["load"][where[list(axes).index("load")]] if "load" in axes else tables["oscillation"]["load"]
            assert_allclose(found["mean_F_N"][where], load, rtol=1e-8)  # of arms springs are followed to 1e-7
        if curves is not None:
            run = mdr.slide(case, 0.4 * mdr.critical_velocity(case))
            assert abs(curves["cof"][where] - run.cof) <= run.cof_error + curves["cof_error"][where]
    return found.status.size


HELD = {**HORN, "oscillation": {**HORN["oscillation"], "hold": "load"}}
SOFT = {"model": "KelvinVoigt", "E": 3e6, "nu": 0.45, "tan_delta": 0.2}
SERIES = {"frequency": 50.0, "load": 0.5, "cos": [4e-6, 1e-6], "sin": [0.0, 1e-6], "hold": "load"}
#: files with a load, a frequency or a loss tangent, and two axes that move a depth or a frequency
STUDIES = [
    (HORN, {"load": [3.0, 6.0], "frequency": [1e4, 2e4]}),
    (HELD, {"material.E": [2e9, 4e9], "oscillation.du_z": [1e-6, 9e-6]}),
    ({**HORN, "indenter": {"shape": "Cone", "theta_deg": 2.0}, "material": SOFT, "oscillation": SERIES},
     {"indenter": [{"shape": "Cone", "theta": 0.02}, {"shape": "FlatPunch", "a": 1e-3}], "tan_delta": [0.05, 0.1]}),
    ({**HORN, "material": SOFT, "oscillation": {"frequency": 50.0, "load": 0.5, "dF_z": 0.05}},
     {"oscillation.omega": [200.0, 600.0], "load": [0.3, 1.0]}),
    ({**HORN, "material": {"model": "Prony", "E_inf": 2e6, "arms": [[1e6, 1e-3]], "nu": 0.45},
      "oscillation": {"frequency": 50.0, "load": 0.5, "du_z": 5e-6}},
     {"material.E_inf": [1e6, 3e6], "frequency": [30.0, 60.0]}),
    ({**HORN, "material": SOFT, "oscillation": {"motion": "ConstantLoad", "load": 0.5},
      "shake": {"frequency": 50.0, "du_x": 2e-6}},
     {"shake.omega": [200.0, 600.0], "material.nu": [0.3, 0.5]}),
]  # fmt: skip


@pytest.mark.parametrize(("tables", "axes"), STUDIES, ids=[" ".join(axes) for _, axes in STUDIES])
def test_every_point_of_a_study_is_the_single_case_of_its_values(tables, axes):
    assert agrees(tables, axes, runs=tables is HORN) == 4


def test_an_axis_that_sets_the_same_comes_before_what_the_file_gives():
    axes = {"oscillation.u_z0": [4e-6, 5e-6], "material.tau": [0.0, 1e-6]}
    found = study(HORN, axes, ("alpha", "T"))
    assert_allclose(found["alpha"], [[3 / 4] * 2, [3 / 5] * 2], rtol=1e-12)
    assert_allclose(found["T"][0], [0.0, 2e-6 * np.pi * 20e3], rtol=1e-12)


def test_a_point_with_two_frequencies_says_why_it_has_no_loss_tangent():
    tables = {**HORN, "shake": {"frequency": 20e3, "du_x": 1e-6}}
    kept, lost = study(tables, {"shake.omega": [2 * np.pi * 20e3, 2 * np.pi * 40e3]}, ("T",)).why
    assert kept == ""
    assert lost == "tan_delta belongs to one frequency, and oscillation and shake have two: give tau"


def test_a_store_knows_the_load_and_goes_on(tmp_path):
    asked = file(HORN, {"material.E": [2e9, 3e9, 4e9]}, ("mean_F_N",))
    part = mdr.sweep(**asked, store=tmp_path, shard="1/2", chunk_seconds=1e-6)
    whole = mdr.sweep(**asked, store=tmp_path)
    assert (whole.identity, whole.complete) == (part.identity, True)
    assert {"load = 5.0", "tan_delta = 0.03"} < set(whole.case.splitlines())
    assert not re.search("u_z0|tau", whole.case)
    assert mdr.parse_case(whole.case) == asked["case"]
    np.testing.assert_array_equal(mdr.sweep(**asked)["mean_F_N"], whole["mean_F_N"])
    for other in ({"load": 6.0, "tan_delta": 0.03}, {"load": 5.0, "tan_delta": 0.04}, {}):
        assert mdr.sweep(**{**asked, "held": other}).identity != whole.identity
    with pytest.raises(mdr.studies.StudyError, match=r"case\.load is 5\.0 there and 6\.0 here"):
        mdr.sweep(**{**asked, "held": {**asked["held"], "load": 6}}, store=tmp_path)
