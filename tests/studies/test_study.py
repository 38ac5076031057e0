"""Study: labelled values, selection, and a print in which nothing hides."""

import pickle

import numpy as np
import pytest
from grids import RIGID, SHAPES
from numpy.testing import assert_array_equal

import mdr
from mdr.studies.points import Status

AXES = {"v_0/v_c": [0.0, 0.5, 1.1], "indenter": SHAPES, "oscillation.u_z0": [6e-6, -1e-3, -2e-3, 8e-6]}


@pytest.fixture(scope="module")
def study():
    return mdr.sweep(RIGID, AXES, quantities=["cof", "v_c"])


def test_what_it_knows(study):
    assert study.shape == study["cof"].shape == study.status.shape == study.why.shape == (3, 3, 4)
    assert study.quantities == ("cof", "v_c")
    assert list(study.axes) == list(AXES)
    assert_array_equal(study.axes["v_0/v_c"], AXES["v_0/v_c"])
    assert study.axes["indenter"] == tuple(SHAPES)
    assert study.units == {"v_0/v_c": "-", "indenter": "", "oscillation.u_z0": "m", "cof": "-", "v_c": "m/s"}
    assert study.complete
    assert mdr.parse_case(study.case) == RIGID
    assert len(study.identity) == 64


def test_a_misspelt_quantity_is_offered_its_name(study):
    with pytest.raises(KeyError, match=r"the study has no quantity 'coff'; did you mean cof?"):
        study["coff"]
    with pytest.raises(KeyError, match="there are cof, v_c"):
        study["zzz"]
    with pytest.raises(KeyError, match="there are cof, v_c"):
        study[0]


def test_it_is_a_value(study):
    again = pickle.loads(pickle.dumps(study))
    assert again == study == mdr.sweep(RIGID, AXES, quantities=["cof", "v_c"])
    assert hash(again) == hash(study)
    assert study != study.select({"v_0/v_c": 0.5})
    with pytest.raises(ValueError, match="read-only"):
        study["cof"][0] = 0


def test_a_part_is_selected_by_its_values(study):
    part = study.select({"indenter": mdr.Cone(theta=0.05), "v_0/v_c": 0.5})
    assert list(part.axes) == ["oscillation.u_z0"]
    assert_array_equal(part["cof"], study["cof"][1, 1])
    assert_array_equal(part.status, study.status[1, 1])
    assert part.why.tolist() == study.why[1, 1].tolist()
    assert part.frame.selected == (("v_0/v_c", "0.5"), ("indenter", "Cone(theta=0.05)"))
    assert "at indenter = Cone(theta=0.05)" in str(part)
    assert study.select({}) == study
    assert study.select({"v_0/v_c": 0.5}).select({"indenter": "Cone(theta=0.05)"}) == part


def test_a_single_point_is_a_study_too(study):
    point = study.select({"indenter": SHAPES[0], "v_0/v_c": 0.5, "oscillation.u_z0": 8e-6})
    assert point.shape == ()
    assert point["cof"] == study["cof"][1, 0, 3]
    assert point.why == ""
    assert str(point).startswith("Study of 1 points (1)")


def test_reasons_of_a_part_are_its_own(study):
    assert len(study.reasons) == 3
    assert study.select({"oscillation.u_z0": 6e-6}).reasons == ("",)
    assert len(study.select({"oscillation.u_z0": -1e-3}).reasons) == 2


@pytest.mark.parametrize(
    ("values", "kind", "words"),
    [
        ({"v_0": 0.5}, KeyError, "'v_0' is no axis of the study; there are v_0/v_c, indenter, oscillation.u_z0"),
        ({"v_0/v_c": 0.49}, ValueError, "v_0/v_c has no value 0.49; the nearest is 0.5"),
        ({"v_0/v_c": None}, ValueError, "v_0/v_c has numbers for values, got None"),
        ({"indenter": mdr.Cone(theta=0.06)}, ValueError, "indenter has no value Cone"),
        ("v_0/v_c", TypeError, "values must map paths to values"),
    ],
)
def test_what_is_not_there_cannot_be_selected(study, values, kind, words):
    with pytest.raises(kind, match=words):
        study.select(values)


def test_print_tells_axes_quantities_and_what_went_wrong(study):
    assert repr(study) == str(study)
    assert str(study).splitlines() == [
        "Study of 36 points (3 x 3 x 4): cof [-], v_c [m/s]",
        "  v_0/v_c [-]: 0, 0.5, 1.1",
        "  indenter: Paraboloid(R=0.005); Cone(theta=0.05); FlatPunch(a=0.001)",
        "  oscillation.u_z0 [m]: 6e-06, -0.001, -0.002, 8e-06",
        "  18 done, 18 failed",
        # those of -1e-3 and -2e-3 differ by their numbers alone
        "    18: u_z0 + du_z = -0.000998 m: the indenter never touches; raise u_z0 above -du_z = -2e-06 m",
    ]


def test_print_tells_the_most_frequent_reasons(tmp_path):
    def of(case):
        if case.mu_0 < 0.5:
            return 1.0
        raise ValueError("abcdefghijklmnopqrstuvwxyz"[round(10 * case.mu_0)] * 3 if case.mu_0 < 1.45 else "slippery")

    axes = {"mu_0": [0.4, *(0.5 + 0.1 * k for k in range(12))]}
    text = str(mdr.sweep(RIGID, axes, tmp_path, quantities=[mdr.Quantity("own", "-", of)], shard="1/1"))
    assert "  1 done, 12 failed" in text
    assert text.splitlines()[3] == "    2: own: slippery"
    assert text.splitlines()[-1] == "    6: for 6 other reasons"


def test_missing_points_are_counted(tmp_path):
    part = mdr.sweep(RIGID, {"mu_0": [0.1, 0.2, 0.3]}, tmp_path, quantities=["v_c"], shard="1/2")
    assert not part.complete
    assert part.count(Status.MISSING) == 1
    assert "2 done, 1 missing" in str(part)
    assert np.isnan(part["v_c"][1])
    assert mdr.read_study(tmp_path) == part
