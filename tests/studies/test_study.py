"""Study: labelled values, selection, a print in which nothing hides, and files that come back equal."""

import csv
import pickle
import sys
from dataclasses import replace

import numpy as np
import pytest
from grids import RIGID, SHAPES
from numpy.testing import assert_array_equal

import mdr
from mdr.studies.formats import packed
from mdr.tools.status import Status

AXES = {"v_0/v_c": [0.0, 0.5, 1.1], "indenter": SHAPES, "oscillation.u_z0": [6e-6, -1e-3, -2e-3, 8e-6]}
POINT = {"indenter": SHAPES[1], "v_0/v_c": 0.5, "oscillation.u_z0": 8e-6}


def made():
    return mdr.sweep(RIGID, AXES, quantities=["cof", "v_c"])


@pytest.fixture(scope="module")
def study():
    return made()


def test_what_it_knows(study):
    assert study.shape == study["cof"].shape == study.status.shape == study.why.shape == (3, 3, 4)
    assert study.quantities == ("cof", "v_c")
    assert list(study.axes) == list(AXES)
    assert_array_equal(study.axes["v_0/v_c"], AXES["v_0/v_c"])
    assert study.axes["indenter"] == tuple(SHAPES)
    assert study.units == {"v_0/v_c": "-", "indenter": "", "oscillation.u_z0": "m", "cof": "-", "v_c": "m/s"}
    assert study.complete
    assert_array_equal(study.status == Status.FAILED, [[[False, True, True, False]] * 3] * 3)  # there is no such case
    assert_array_equal(np.isnan(study.values), [study.status == Status.FAILED] * 2)
    assert mdr.parse_case(study.case) == RIGID
    assert len(study.identity) == 64


def test_it_is_a_value(study):
    again = pickle.loads(pickle.dumps(study))
    assert again == study == made()
    assert hash(again) == hash(study)
    assert packed(again) == packed(study) == packed(made())  # the bytes follow from the study alone
    assert study != study.select({"v_0/v_c": 0.5})
    with pytest.raises(ValueError, match="read-only"):
        study["cof"][0] = 0


def test_a_part_is_selected_by_its_values(study):
    part = study.select({"indenter": mdr.Cone(theta=0.05), "v_0/v_c": 0.5})
    assert list(part.axes) == ["oscillation.u_z0"]
    assert_array_equal(part["cof"], study["cof"][1, 1])
    assert_array_equal(part.status, study.status[1, 1])
    assert part.why.tolist() == study.why[1, 1].tolist()
    assert part.selected == (("v_0/v_c", "0.5"), ("indenter", "Cone(theta=0.05)"))
    assert "at indenter = Cone(theta=0.05)" in str(part)
    assert study.select({}) == study
    assert study.select({"v_0/v_c": 0.5}).select({"indenter": "Cone(theta=0.05)"}) == part
    assert [len(one.reasons) for one in (study, part, study.select({"oscillation.u_z0": 6e-6}))] == [3, 3, 1]
    point = study.select(POINT)
    assert point.shape == ()
    assert point["cof"] == study["cof"][1, 1, 3]
    assert str(point).startswith("Study of 1 points (1)")


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


# --- files ---

#: of many kinds: with letters beyond ASCII, without shape or units, with points that are missing
STUDIES = {
    "whole": lambda folder: made(),
    "selected": lambda folder: made().select({"indenter": SHAPES[1]}),
    "a point": lambda folder: made().select(POINT),
    "arms": lambda folder: mdr.sweep(
        replace(RIGID, material=mdr.Prony(1e6, [(1e6, 1e-3)], 0.5)),
        {"material.arms": [((1e6, 1e-3),), ((2e6, 1.0),)]},
        quantities=["v_c", "T"],
    ),
    "letters": lambda folder: mdr.sweep(
        RIGID, {"indenter": [mdr.Profile(lambda r: r**2, name="Schüssel µ")]}, quantities=["k_zc"]
    ),
    "unfinished": lambda folder: mdr.sweep(RIGID, AXES, folder / "store", shard="2/3"),
}


@pytest.mark.parametrize("name", STUDIES)
def test_what_is_written_comes_back_equal(name, tmp_path):
    study = STUDIES[name](tmp_path)
    study.to_netcdf(tmp_path / "study.nc")
    back = mdr.read_study(tmp_path / "study.nc")
    assert back == study
    assert hash(back) == hash(study)
    assert packed(back) == packed(study)
    assert str(back) == str(study)
    if name == "unfinished":
        assert np.isnan(study["cof"][study.status == Status.MISSING]).all()
        assert mdr.read_study(str(tmp_path / "store")) == study
        assert not study.complete


def test_it_opens_labelled_in_xarray(study, tmp_path):
    xarray = pytest.importorskip("xarray")
    study.to_netcdf(tmp_path / "study.nc")
    with xarray.open_dataset(tmp_path / "study.nc") as data:
        xarray.testing.assert_identical(study.to_xarray(), data.load())
        assert data["cof"].dims == ("v_0_over_v_c", "indenter", "oscillation.u_z0")
        assert_array_equal(data["v_0_over_v_c"], AXES["v_0/v_c"])
        assert data["v_0_over_v_c"].attrs["path"] == "v_0/v_c"
        depth = {"units": "m", "long_name": "mean indentation depth", "path": "oscillation.u_z0"}
        assert data["oscillation.u_z0"].attrs == depth
        assert data["v_c"].attrs == {"units": "m/s", "long_name": "critical velocity, Eq. (15)"}
        assert data["cof"].attrs["units"] == "1"
        one = data["cof"].sel({"indenter": "Cone(theta=0.05)", "v_0_over_v_c": 0.5, "oscillation.u_z0": 8e-6})
        assert float(one) == study.select(POINT)["cof"]
        assert_array_equal(data["cof"], study["cof"])
        assert_array_equal(data["status"].attrs["flag_values"], [0, 1, 2, 3])
        assert data["status"].attrs["flag_meanings"] == "done unsettled failed missing"
        assert_array_equal(data["status"], study.status)
        assert_array_equal(data["reasons"].values[data["reason"].values], study.why)
        assert (data.attrs["identity"], data.attrs["mdr_version"]) == (study.identity, mdr.__version__)
        assert mdr.parse_case(data.attrs["case"]) == RIGID
        assert "title" in data.attrs


def test_without_xarray_it_says_what_to_install(study, monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(ImportError, match="to_xarray needs xarray: pip install xarray"):
        study.to_xarray()


def test_a_file_of_somebody_else_is_no_study(tmp_path):
    """Damaged files are asked of all readers in tests/files/test_damaged_files.py."""
    from scipy.io import netcdf_file

    with netcdf_file(tmp_path / "other.nc", "w", version=2) as file:
        file.createDimension("x", 2)
        file.createVariable("status", "b", ("x",))[:] = 1
    words = "is no study, or a damaged one: its states are not those of a study"
    with pytest.raises(mdr.studies.StudyError, match=words):
        mdr.read_study(tmp_path / "other.nc")


def test_csv_has_a_row_a_point(study, tmp_path):
    study.to_csv(tmp_path / "study.csv")
    with open(tmp_path / "study.csv", newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    assert head == ["v_0/v_c [-]", "indenter", "oscillation.u_z0 [m]", "cof [-]", "v_c [m/s]", "status", "why"]
    assert len(rows) == study.status.size
    assert_array_equal([float(row[3]) for row in rows], study["cof"].ravel())
    assert [row[6] for row in rows] == study.why.ravel().tolist()
    assert [row[5] for row in rows] == [Status(code).name.lower() for code in study.status.ravel()]
    assert rows[5][:3] == ["0.0", "Cone(theta=0.05)", "-0.001"]
    study.select(POINT).to_csv(tmp_path / "point.csv")
    assert (tmp_path / "point.csv").read_text().startswith("cof [-],v_c [m/s],status,why\n")
