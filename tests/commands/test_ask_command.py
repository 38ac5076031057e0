"""`mdr find`, `tolerance`, `sensitivity`, `propagate`: what the functions answer, with units, as text, JSON, files."""

import pytest
from answers import json_of, words_of
from numpy.testing import assert_allclose

import mdr
from mdr.given.case_file import read_said

CASE = """
mu_0 = 0.3
[indenter]
shape = "Sphere"
R = "3 mm"
[material]
model = "KelvinVoigt"
E = "3 GPa"
nu = 0.4
tan_delta = "3%"
[oscillation]
frequency = "20 kHz"
load = "5 N"
du_z = "1 um"
"""


@pytest.fixture
def sled(tmp_path):
    path = tmp_path / "sled.toml"
    path.write_text(CASE, encoding="utf-8")
    return str(path)


def test_find(capsys, sled):
    wish = ["--v-0", "10mm/s", "--cof", "0.5", "mu_0", "--within", "0.1", "um", "5 um"]
    answer = json_of(capsys, ["find", sled, "du_z", *wish, "--json"])
    assert (answer["path"], answer["unit"]) == ("oscillation.du_z", "m")
    said = read_said(sled)
    found = mdr.find(said.case, "du_z", v_0=0.01, cof=0.15, within=(1e-7, 5e-6))
    assert answer["values"] == list(found.values)
    assert answer["power"] == [mdr.slide(one, 0.01).power for one in found.cases]
    assert "W from the normal drive, " in words_of(capsys, ["find", sled, "du_z", *wish]).out
    assert json_of(capsys, ["find", sled, "frequency", "--v-c", "10 mm/s", "--json"])["power"] == []
    assert words_of(capsys, ["find", sled, "frequency", "--v-c", "10 mm/s"]).out.startswith("frequency = 3.97887 kHz")
    assert words_of(capsys, ["find", sled, "v_0", "--share", "90%"]).out.startswith("v_0 = ")
    nothing = words_of(capsys, ["find", sled, "E", "--v-c", "10 mm/s"], 1).out
    assert "none: v_c is 50.265 mm/s" in nothing
    assert nothing.endswith("; --within low high searches another range\n")


def test_tolerance(capsys, sled, tmp_path):
    folder = tmp_path / "out"
    command = ["tolerance", sled, "--v-0", "10mm/s", "--by", "5%", "-o", str(folder), "--json"]
    answer, said = json_of(capsys, command), read_said(sled)
    found = mdr.tolerance(said.case, 0.01, 0.05, held=said.held)
    assert {path: tuple(pair) for path, pair in answer["cof"].items()} == found.cof
    assert_allclose(answer["inputs"]["load"], [4.75, 5.25])
    assert (folder / "tolerance.csv").read_text(encoding="utf-8").endswith(found.table())
    assert {path.name for path in folder.iterdir()} == {"tolerance.csv", "tolerance.png", "tolerance.svg"}
    assert "load" in words_of(capsys, ["tolerance", sled, "--v-0", "10mm/s", "--fields", "load"]).out


def test_sensitivity(capsys, sled, tmp_path):
    command, folder = ["sensitivity", sled, "--v-0", "10mm/s", "--fields", "load", "v_0"], tmp_path / "out"
    answer, said = json_of(capsys, [*command, "-o", str(folder), "--json"]), read_said(sled)
    found = mdr.sensitivity(said.case, 0.01, ["load", "v_0"], held=said.held)
    assert answer["d_cof"] == found.d_cof
    assert answer["error"]["cof"] == found.error["cof"]
    assert (answer["v_c"], answer["d_v_c"]) == (found.v_c, found.d_v_c)
    assert words_of(capsys, command).out == f"{found}\n"
    assert (folder / "sensitivity.csv").read_text(encoding="utf-8").endswith(found.table())
    assert {path.name for path in folder.iterdir()} == {"sensitivity.csv", "sensitivity.png", "sensitivity.svg"}
    alone = json_of(capsys, ["sensitivity", sled, "--json"])
    assert (alone["v_0"], alone["cof"], alone["d_cof"]) == (None, None, {})
    assert_allclose(alone["d_v_c"]["frequency"], found.v_c / 20e3)


def test_propagate(capsys, sled, tmp_path):
    folder, said = tmp_path / "out", read_said(sled)
    spread = ["--spread", "mu_0=5%", "--spread", "oscillation.du_z=0.1um", "load=5%", "--samples", "30"]
    command = ["propagate", sled, "--v-0", "10mm/s", *spread]
    answer = json_of(capsys, [*command, "-o", str(folder), "--json"])
    inputs = {"mu_0": "5%", "oscillation.du_z": 1e-7, "load": 0.25}
    found = mdr.propagate(said.case, inputs, 0.01, held=said.held, samples=30)
    assert_allclose([answer["cof_sd"], answer["v_c_sd"]], [found.cof_sd, found.v_c_sd])
    assert_allclose(answer["samples"]["cof"]["sd"], found.samples["cof"].sd)
    assert answer["agrees"] == {"cof": True, "v_c": True}
    written = (folder / "propagate.csv").read_text(encoding="utf-8").splitlines()
    assert written[-31] == found.table().splitlines()[0]
    assert {path.name for path in folder.iterdir()} == {"propagate.csv", "propagate.png", "propagate.svg"}
    wide = ["propagate", sled, "--spread", "nu=20%", "--samples", "40", "-o", str(folder)]
    assert "nu must lie in" in words_of(capsys, wide, 1).out
