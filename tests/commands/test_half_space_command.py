"""`mdr half-space`: what it prints, writes and returns."""

from dataclasses import replace

from answers import json_of, words_of

import mdr
from mdr.__main__ import main

BALL = mdr.SlidingContact(
    mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.3), 0.3, mdr.NormalOscillation(u_z0=20e-6, du_z=6e-6, omega=300.0)
)
FEW = ["--cells", "9", "--steps", "12"]


def file_of(case, folder):
    path = folder / "case.toml"
    path.write_text(mdr.write_case(case))
    return str(path)


def test_it_writes_what_it_prints(tmp_path, capsys):
    assert main(["half-space", file_of(BALL, tmp_path), "--v-0", "0.2mm/s", *FEW, "-o", str(tmp_path / "out")]) == 0
    told = capsys.readouterr().out
    assert "HalfSpaceRun at v_0 = 0.0002 m/s" in told
    assert "grid" in told
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "half_space.csv",
        "half_space.png",
        "half_space.svg",
    }
    assert "F_y [N]" in (tmp_path / "out" / "half_space.csv").read_text()


def test_it_tells_machines_and_an_unsettled_run_fails(tmp_path, capsys):
    shaken = replace(BALL, shake=mdr.InPlaneOscillation(omega=300.0, du_y=6e-6, phi_y=1.0))
    line = ["half-space", file_of(shaken, tmp_path), "--v-0", "-0.3mm/s", *FEW]
    line += ["--uncoupled", "--cycles", "1", "--json"]
    told = json_of(capsys, line, 1)
    assert (told["settled"], told["coupled"], told["n_periods"], told["cells"]) == (False, False, 1, 9)
    assert told["cof"] < 0 < told["cof_error"]


def test_a_pull_that_yields_is_refused(tmp_path, capsys):
    yields = replace(BALL, pull=mdr.SpringPull(k_x=1e4))
    assert "takes a rigid pull" in words_of(capsys, ["half-space", file_of(yields, tmp_path), "--v-0", "1e-4"], 1).err
