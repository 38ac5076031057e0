"""`mdr fit`: the table, the files and the JSON of a fit, and what wrong input is told."""

import signal
from pathlib import Path

import numpy as np
import pytest
from answers import json_of, words_of
from conftest import contact

import mdr
from mdr.friction.cof_curve import friction_without_bound
from mdr.given.case_file import read_case

CASE = mdr.write_case(contact("cone", 10 / 3, 0.3, du_z=6e-6))
DATA = "v_0 [mm/s], cof, error\n0.1, 0.40, 0.01\n0.4, 0.46, 0.01\n0.8, 0.49, 0.01\n1.6, 0.50, 0.01\n3.2, 0.5, 0.01\n"


@pytest.fixture
def files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("case.toml").write_text(CASE)
    Path("data.csv").write_text(DATA)
    return ["fit", "case.toml", "data.csv"]


def test_a_fit_is_printed_and_written(files, capsys):
    said = words_of(capsys, [*files, "--free", "mu_0", "--bounds", "mu_0=0.1:1", "-o", "out"])
    found = mdr.fit(read_case("case.toml"), mdr.read_friction_data("data.csv"), ["mu_0"], bounds={"mu_0": (0.1, 1)})
    assert said.out == f"{found}\n"
    assert read_case("out/fitted.toml") == found.case
    assert Path("out/fitted.toml").read_text().splitlines()[2] == "# 95% intervals:"
    assert {path.name for path in Path("out").iterdir()} == {"fitted.toml", "fit.png", "fit.svg"}


def test_a_signal_and_a_limit_leave_the_best_so_far(files, capsys, monkeypatch):
    """`timeout` sends SIGTERM; the status is that of an interrupt, and of a limit that of what has not ended."""
    curves = []

    def killed(*given):
        curves.append(given)
        if len(curves) == 4:
            signal.raise_signal(signal.SIGTERM)
        return friction_without_bound(*given)

    before = signal.getsignal(signal.SIGTERM)
    monkeypatch.setattr("mdr.friction.likelihood.friction_without_bound", killed)
    assert "stopped by an interrupt: the best values so far" in words_of(capsys, [*files, "--free", "mu_0"], 130).out
    assert signal.getsignal(signal.SIGTERM) is before
    monkeypatch.setattr("mdr.friction.fit.time_is_over", lambda: len(curves) > 6)
    assert "stopped by the limit of 300 s" in words_of(capsys, [*files, "--free", "mu_0", "--limit", "5min"], 1).out


def test_machines_are_told_what_is_not_determined(files, capsys):
    arguments = ["--free", "mu_0", "material.tau", "--bounds", "material.tau=9e-4:1.1e-3", "--json"]
    told = json_of(capsys, [*files, *arguments])
    tau, mu_0 = told["parameters"]["material.tau"], told["parameters"]["mu_0"]
    assert (tau["low"], tau["high"], tau["determined"], tau["unit"]) == (None, None, False, "s")
    assert mu_0["determined"]
    assert mu_0["low"] < mu_0["value"] < mu_0["high"]
    assert len(told["residuals"]) == len(told["cof"]) == 5
    assert len(told["correlation"]) == 2
    assert told["case"].startswith("mu_0 = 0.")


def test_a_fault_of_the_data_names_their_file(files, capsys):
    Path("data.csv").write_text(DATA.replace("0.49", "high"))
    assert "data.csv: line 4: high is no number (column cof)" in words_of(capsys, [*files, "--free", "mu_0"], 2).err


def test_a_load_of_the_file_holds_while_the_modulus_is_fitted(files, capsys):
    """At a depth that is held the modulus has nothing to do with the friction."""
    text = CASE.replace("u_z0 = 2e-05", "load = 0.5").replace("tau = 0.001", "tan_delta = 0.1")
    truth = mdr.parse_case(text)
    v_0 = mdr.critical_velocity(truth) * np.linspace(0.1, 0.9, 6)
    cof = mdr.cof_curve(truth, v_0).cof
    rows = [f"{1e3 * v!r}, {one!r}, 1e-4" for v, one in zip(v_0.tolist(), cof.tolist(), strict=True)]
    Path("data.csv").write_text("\n".join(["v_0 [mm/s], cof, error", *rows]))
    Path("case.toml").write_text(text.replace("E = 3000000.0", "E = 2e6"))
    found = json_of(capsys, [*files, "--free", "material.E", "--json"])["parameters"]["material.E"]
    assert found["value"] == pytest.approx(3e6, rel=1e-3)
