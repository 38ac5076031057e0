"""`mdr export`: files, and what is refused."""

from dataclasses import replace
from pathlib import Path

import pytest
from answers import file_of, json_of, words_of

import mdr
from mdr.__main__ import main

EXAMPLE = str(Path(__file__).parents[2] / "docs" / "example.toml")


def test_a_header_names_its_case_and_command(tmp_path, capsys):
    path = tmp_path / "foot.h"
    said = json_of(capsys, ["export", EXAMPLE, "-o", str(path), "--json"])
    text = path.read_text(encoding="utf-8")
    assert f"mdr export {EXAMPLE}"[:60] in text
    assert '[material] model = "KelvinVoigt", E = 3000000.0' in text
    case = mdr.read_case(EXAMPLE)
    assert said["u_z_max"] == pytest.approx(1.05 * case.u_z_max)  # a little above the greatest depth of the case
    assert (said["n_springs"], said["n_state"]) == (64, 5 + 3 * 64)
    assert main(["export", EXAMPLE, "-o", str(path), "--u-z-max", "5e-5", "--n-springs", "16"]) == 0
    assert "#define FOOT_U_Z_MAX 5e-05" in path.read_text(encoding="utf-8")


def test_without_a_compiler_the_sources_come_out(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("CC", "no-such-compiler")
    assert "CC" in words_of(capsys, ["export", EXAMPLE, "-o", str(tmp_path / "foot.fmu")], 1).err
    assert sorted(one.name for one in tmp_path.iterdir()) == ["foot.h", "foot_fmu.c"]


def test_a_load_knows_its_depth(tmp_path, capsys):
    load = replace(mdr.read_case(EXAMPLE), oscillation=mdr.LoadOscillation(0.02, 0.005, 300.0))
    case = file_of(load, tmp_path / "load.toml")
    told = json_of(capsys, ["export", case, "-o", str(tmp_path / "a.h"), "--json"])
    assert told["u_z_max"] == pytest.approx(1.05 * mdr.resolved(load).u_z_max)


def test_arms_are_refused_and_nothing_is_written(tmp_path, capsys):
    arms = mdr.StandardLinearSolid(E_inf=3e6, E_1=1e6, tau_1=1e-3, nu=0.5)
    case = file_of(replace(mdr.read_case(EXAMPLE), material=arms), tmp_path / "arms.toml")
    said = words_of(capsys, ["export", case, "-o", str(tmp_path / "a.fmu")], 1).err
    assert "not one with Maxwell arms" in said
    assert [one.name for one in tmp_path.iterdir()] == ["arms.toml"]
