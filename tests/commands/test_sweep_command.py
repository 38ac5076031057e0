"""`mdr sweep`: a study from a file, on the command line."""

import os
from dataclasses import replace

import numpy as np
import pytest
from answers import json_of, words_of
from conftest import contact
from numpy.testing import assert_allclose

import mdr
from mdr.__main__ import main
from mdr.tools.provenance import versions

CASE = mdr.write_case(contact("paraboloid", 3.0, 0.3))
STUDY = f"""
quantities = ["cof", "v_c"]
{CASE}
[axes]
"v_0/v_c" = {{ from = 0, to = 1.2, n = 3 }}
"T" = [0.1, 1.0]
indenter = [{{ shape = "Paraboloid", R = 5e-3 }}, {{ shape = "Cone", theta = 0.05 }}]
"""


@pytest.fixture
def file(tmp_path):
    (tmp_path / "study.toml").write_text(STUDY)
    return str(tmp_path / "study.toml")


def test_a_study_is_written_and_told(file, tmp_path, capsys):
    for kind in ("nc", "csv"):
        out = tmp_path / f"study.{kind}"
        assert main(["sweep", file, "-o", str(out)]) == 0
        for path in (out, out.with_suffix(".png"), out.with_suffix(".svg")):
            data = path.read_bytes()
            assert versions().encode() in data, path
            assert f"mdr sweep {file} -o {out}".encode() in data, path
            path.rename(tmp_path / f"kept.{path.suffix}")
    study = mdr.read_study(tmp_path / "kept..nc")
    assert capsys.readouterr() == (2 * f"{study}\n", "")
    assert study.shape == (3, 2, 2)
    case = mdr.parse_case(study.case)
    case = replace(case, material=replace(case.material, tau=0.1 / 300))
    curve = mdr.cof_curve(case, np.array([0.0, 0.6, 1.2]) * mdr.critical_velocity(case))
    assert_allclose(study["cof"][:, 0, 0], curve.cof, rtol=1e-14)
    lines = (tmp_path / "kept..csv").read_text().splitlines()
    head = [line[2:] for line in lines if line.startswith("#")]
    assert len(lines) - len(head) == 13
    assert mdr.parse_case("\n".join(head[2:])) == mdr.parse_case(study.case)


def test_a_folder_gets_all_files(file, tmp_path, capsys, monkeypatch):
    (tmp_path / "v1.2").mkdir()  # a folder, whatever its name
    assert words_of(capsys, ["sweep", file, "-o", str(tmp_path / "v1.2")]).err == ""
    assert sorted(os.listdir(tmp_path / "v1.2")) == ["study.csv", "study.nc", "study.png", "study.svg"]
    monkeypatch.setattr("mdr.commands.sweep.write_figure", lambda *args: None)
    new = tmp_path / "new.nc"
    new.write_text("mine")
    assert words_of(capsys, ["sweep", file, "-o", str(new)]).err == f"mdr: will be overwritten: {new}\n"
    assert np.array_equal(mdr.read_study(new).values, mdr.read_study(tmp_path / "v1.2/study.nc").values)


def test_a_study_of_many_axes_has_no_picture_and_says_so(file, tmp_path, capsys):
    (tmp_path / "study.toml").write_text(STUDY + "mu_0 = [0.1, 0.2]\n")
    said = words_of(capsys, ["sweep", file, "-o", str(tmp_path / "study.nc")]).err
    assert "mdr: no picture: a picture has one or two axes" in said
    assert not (tmp_path / "study.png").exists()


def test_a_store_is_kept_and_shards_fill_it(file, tmp_path, capsys):
    store, out = tmp_path / "store", tmp_path / "study.nc"
    shown = words_of(capsys, ["sweep", file, "--store", str(store), "--shard", "1/2", "-o", str(out)])
    assert "missing" in shown.out
    assert shown.err == f"mdr: 6 of 12 points are left to the other shards; {out} is not written\n"
    assert not out.exists()
    assert main(["sweep", file, "--store", str(store), "--shard", "2/2", "-o", str(out)]) == 0
    kept = mdr.read_study(store / "study.nc")
    assert np.array_equal(mdr.read_study(out).values, kept.values)
    mdr.read_study(out).to_netcdf(tmp_path / "again.nc")
    assert (tmp_path / "again.nc").read_bytes() == (store / "study.nc").read_bytes()
    assert sorted(os.listdir(store)) == ["study.json", "study.nc"]
    (tmp_path / "study.toml").write_text(STUDY.replace("0.05", "0.06"))
    said = words_of(capsys, ["sweep", file, "--store", str(store)], 1).err
    assert "is the store of another study: axes.indenter is" in said


def test_json_is_for_machines(file, capsys):
    answer = json_of(capsys, ["sweep", file, "--json"])
    assert answer["complete"] is True
    assert answer["counts"] == {"done": 12, "unsettled": 0, "failed": 0, "missing": 0}
    assert answer["axes"]["indenter"] == ["Paraboloid(R=0.005)", "Cone(theta=0.05)"]
    assert answer["units"]["v_c"] == "m/s"
    assert len(answer["values"]["cof"]) == 3
    assert answer["why"][0][0] == ["", ""]
    assert answer["version"] == mdr.__version__
    assert mdr.parse_case(answer["case"]).mu_0 == 0.4


def test_points_that_fail_are_told_and_fail_the_command(file, tmp_path, capsys):
    (tmp_path / "study.toml").write_text(STUDY.replace('"T" = [0.1, 1.0]', '"oscillation.u_z0" = [-1.0, 6e-6]'))
    shown = words_of(capsys, ["sweep", file, "-o", str(tmp_path / "study.nc")], 1)
    assert "    6: u_z0 + du_z = -0.999998 m: the indenter never touches" in shown.out
    assert shown.err == "mdr: 6 of 12 points failed, 0 did not settle\n"
    assert json_of(capsys, ["sweep", file, "--json"], 1)["values"]["cof"][0][0][0] is None


@pytest.mark.parametrize(
    ("name", "stored", "words"),
    [("mdr.studies.engine.run", True, "sweep: interrupted; 0 of 4 chunks are safe in"),
     ("mdr.studies.engine.run", True, "mdr: interrupted before it was done"),
     ("mdr.commands.sweep.write_figure", True, "all of it is safe in"),
     ("mdr.commands.sweep.write_figure", False, "nothing is kept")],
)  # fmt: skip
def test_an_interrupt_is_status_130_and_says_what_is_safe(file, tmp_path, capsys, monkeypatch, name, stored, words):
    def interrupted(*args):
        raise KeyboardInterrupt

    monkeypatch.setattr(name, interrupted)
    store = ["--store", str(tmp_path / "store")] if stored else []
    assert words in words_of(capsys, ["sweep", file, "-o", str(tmp_path / "study.nc"), *store], 130).err
