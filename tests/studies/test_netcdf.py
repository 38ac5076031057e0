"""NetCDF and CSV: what is written comes back equal, opens labelled elsewhere, and is the same in every byte."""

import csv
import sys
from dataclasses import replace

import numpy as np
import pytest
from grids import BODY, COARSE, RIGID, SHAPES
from numpy.testing import assert_array_equal

import mdr
from mdr.studies.formats import name_of, packed, unpacked
from mdr.studies.points import Status

AXES = {"v_0/v_c": [0.0, 0.5, 1.1], "indenter": SHAPES, "oscillation.u_z0": [6e-6, -1e-3, -2e-3, 8e-6]}


@pytest.fixture(scope="module")
def study():
    return mdr.sweep(RIGID, AXES, quantities=["cof", "v_c"])


#: of many kinds: with letters beyond ASCII, without shape or units, with points that are missing
STUDIES = {
    "whole": lambda: mdr.sweep(RIGID, AXES, quantities=["cof", "stick_share"]),
    "selected": lambda: STUDIES["whole"]().select({"indenter": SHAPES[1]}),
    "a point": lambda: STUDIES["whole"]().select({"indenter": SHAPES[1], "v_0/v_c": 0.5, "oscillation.u_z0": -2e-3}),
    "arms": lambda: mdr.sweep(
        replace(RIGID, material=mdr.Prony(1e6, [(1e6, 1e-3)], 0.5)),
        {"material.arms": [((1e6, 1e-3),), ((2e6, 1.0),)]},
        quantities=["v_c", "T"],
    ),
    "no unit": lambda: mdr.sweep(RIGID, {"mu_0": [0.3]}, quantities=[mdr.Quantity("bare", "", lambda case: np.inf)]),
    "letters": lambda: mdr.sweep(
        RIGID, {"indenter": [mdr.Profile(lambda r: r**2, name="Schüssel µ")]}, quantities=["k_zc"]
    ),
    "runs": lambda: mdr.sweep(BODY, {"v_0": [0.0, 1e-4]}, **COARSE),
}


@pytest.mark.parametrize("made", STUDIES.values(), ids=STUDIES)
def test_what_is_written_comes_back_equal(made, tmp_path):
    study = made()
    study.to_netcdf(tmp_path / "study.nc")
    back = mdr.read_study(tmp_path / "study.nc")
    assert back == study
    assert hash(back) == hash(study)
    assert packed(back) == packed(study)
    assert str(back) == str(study)


def test_an_unfinished_study_comes_back_too(tmp_path):
    part = mdr.sweep(RIGID, AXES, tmp_path / "store", shard="2/3")
    assert not part.complete
    part.to_netcdf(str(tmp_path / "part.nc"))
    assert mdr.read_study(str(tmp_path / "part.nc")) == part == mdr.read_study(str(tmp_path / "store"))


def test_it_opens_labelled_in_xarray(study, tmp_path):
    xarray = pytest.importorskip("xarray")
    study.to_netcdf(tmp_path / "study.nc")
    with xarray.open_dataset(tmp_path / "study.nc") as data:
        assert data["cof"].dims == ("v_0_over_v_c", "indenter", "oscillation.u_z0")
        assert_array_equal(data["v_0_over_v_c"], AXES["v_0/v_c"])
        assert data["v_0_over_v_c"].attrs["path"] == "v_0/v_c"
        assert data["oscillation.u_z0"].attrs == {
            "units": "m",
            "long_name": "mean indentation depth",
            "path": "oscillation.u_z0",
        }
        assert data["v_c"].attrs == {"units": "m/s", "long_name": "critical velocity, Eq. (15)"}
        assert data["cof"].attrs["units"] == "1"
        assert list(data["indenter"].values) == ["Paraboloid(R=0.005)", "Cone(theta=0.05)", "FlatPunch(a=0.001)"]
        one = data["cof"].sel({"indenter": "Cone(theta=0.05)", "v_0_over_v_c": 0.5, "oscillation.u_z0": 8e-6})
        assert float(one) == study["cof"][1, 1, 3]
        assert_array_equal(data["cof"], study["cof"])
        assert_array_equal(data["status"].attrs["flag_values"], [0, 1, 2, 3])
        assert data["status"].attrs["flag_meanings"] == "done unsettled failed missing"
        assert_array_equal(data["status"], study.status)
        assert_array_equal(data["reasons"].values[data["reason"].values], study.why)
        assert data.attrs["identity"] == study.identity
        assert data.attrs["mdr_version"] == mdr.__version__
        assert mdr.parse_case(data.attrs["case"]) == RIGID
        assert "title" in data.attrs


def test_to_xarray_is_the_same(study, tmp_path):
    xarray = pytest.importorskip("xarray")
    study.to_netcdf(tmp_path / "study.nc")
    with xarray.open_dataset(tmp_path / "study.nc") as data:
        xarray.testing.assert_identical(study.to_xarray(), data.load())


def test_without_xarray_it_says_what_to_install(study, monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(ImportError, match=r"to_xarray needs xarray: .* install -e '\.\[xarray\]'"):
        study.to_xarray()


def test_the_bytes_follow_from_the_study_alone(study):
    again = mdr.sweep(RIGID, AXES, quantities=["cof", "v_c"])
    assert packed(study) == packed(again)
    assert name_of("omega_0/omega") == "omega_0_over_omega"


@pytest.mark.parametrize("data", [b"", b"CDF", b"CDF\x02" + b"\0" * 40, b"hello world", None])
def test_other_bytes_are_no_study(study, data):
    with pytest.raises(ValueError, match="no study, or a damaged one"):
        unpacked(packed(study)[:500] if data is None else data)


def test_a_file_of_somebody_else_is_no_study(tmp_path):
    from scipy.io import netcdf_file

    with netcdf_file(tmp_path / "other.nc", "w", version=2) as file:
        file.createDimension("x", 2)
        file.createVariable("status", "b", ("x",))[:] = 1
    with pytest.raises(mdr.StudyError, match="is no study, or a damaged one: its states are not those of a study"):
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


def test_csv_of_a_single_point(study, tmp_path):
    study.select({"indenter": SHAPES[0], "v_0/v_c": 1.1, "oscillation.u_z0": 8e-6}).to_csv(tmp_path / "point.csv")
    assert (tmp_path / "point.csv").read_text().splitlines()[0] == "cof [-],v_c [m/s],status,why"
    assert len((tmp_path / "point.csv").read_text().splitlines()) == 2
