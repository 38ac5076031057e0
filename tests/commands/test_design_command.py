"""`mdr design` and `mdr front`: the answers of the functions, with units, as text, JSON and files."""

import signal

import pytest
from answers import json_of, words_of

import mdr
from mdr.friction import room_search
from mdr.given.case_file import read_said

CASE = """
mu_0 = 0.4
[indenter]
shape = "Cone"
theta_deg = 1
[material]
model = "KelvinVoigt"
E = "3 MPa"
nu = 0.5
tan_delta = 0.3
[oscillation]
frequency = "50 Hz"
load = "0.2 N"
du_z = "1 um"
"""


@pytest.fixture
def rubber(tmp_path):
    path = tmp_path / "rubber.toml"
    path.write_text(CASE, encoding="utf-8")
    return str(path)


def test_design(capsys, rubber, tmp_path):
    folder = tmp_path / "out"
    asked = ["design", rubber, "--cof", "0.8mu_0", "--up-to", "0.2mm/s", "--free", "du_z=1um:8um"]
    answer, said = json_of(capsys, [*asked, "-o", str(folder), "--json"]), read_said(rubber)
    target = mdr.Target(cof_at_most=0.32, up_to=2e-4)
    found = mdr.design(said.case, target, {"du_z": (1e-6, 8e-6)}, held=said.held)
    assert answer["met"] is True
    assert answer["values"] == pytest.approx(found.values)
    assert answer["target"] == pytest.approx({"cof_at_most": 0.32, "up_to": 2e-4})
    assert answer["active"] == list(found.active)
    written = read_said(folder / "design.toml")
    assert written.case.oscillation.du_z == pytest.approx(8e-6)
    assert written.held["load"] == said.held["load"]
    assert {path.name for path in folder.iterdir()} == {"design.toml", "design.txt"}
    assert "the target is met" in words_of(capsys, [*asked, "--least-power"]).out
    far = ["design", rubber, "--v-c", "10m/s", "--free", "du_z=1um:8um", "--free", "frequency=10Hz:50Hz"]
    assert "v_c_at_least = 10 m/s is missed" in words_of(capsys, far, 1).out


@pytest.mark.parametrize("ends", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_leaves_the_best_so_far(capsys, rubber, monkeypatch, ends):
    class Struck(room_search.Answer):
        asked = 0

        def __init__(self, *args):
            Struck.asked += 1
            if Struck.asked == 20:
                signal.raise_signal(ends)
            super().__init__(*args)

    monkeypatch.setattr(room_search, "Answer", Struck)
    asked = ["design", rubber, "--cof", "0.2", "--up-to", "0.2mm/s", "--free", "du_z=1um:8um"]
    assert json_of(capsys, [*asked, "--json"], 130)["stopped"] == "an interrupt"


def test_front(capsys, rubber, tmp_path):
    folder = tmp_path / "out"
    asked = ["front", rubber, "--up-to", "0.2mm/s", "--free", "du_z=1um:8um", "-n", "2", "-o", str(folder), "--json"]
    answer = json_of(capsys, asked)
    assert answer["power"][0] > answer["power"][1] > 0
    assert len(answer["designs"]) == 2
    assert {path.name for path in folder.iterdir()} == {"front.csv", "front.png", "front.svg"}
