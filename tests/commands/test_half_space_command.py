"""`mdr half-space`: what it prints, writes and returns."""

from dataclasses import replace

from answers import file_of, json_of, words_of

import mdr

BALL = mdr.SlidingContact(
    mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.3), 0.3, mdr.NormalOscillation(u_z0=20e-6, du_z=6e-6, omega=300.0)
)
FEW = ["--cells", "9", "--steps", "12"]


def test_it_writes_what_it_prints(tmp_path, capsys):
    out = tmp_path / "out"
    line = ["half-space", file_of(BALL, tmp_path / "case.toml"), "--v-0", "0.2mm/s", *FEW, "-o", str(out)]
    told = words_of(capsys, line).out
    assert "HalfSpaceRun at v_0 = 0.0002 m/s" in told
    assert "grid" in told
    assert {path.name for path in out.iterdir()} == {"half_space.csv", "half_space.png", "half_space.svg"}
    assert "F_y [N]" in (out / "half_space.csv").read_text()


def test_it_tells_machines_and_an_unsettled_run_fails(tmp_path, capsys):
    shaken = replace(BALL, shake=mdr.InPlaneOscillation(omega=300.0, du_y=6e-6, phi_y=1.0))
    line = ["half-space", file_of(shaken, tmp_path / "case.toml"), "--v-0", "-0.3mm/s", *FEW]
    line += ["--uncoupled", "--cycles", "1", "--json"]
    told = json_of(capsys, line, 1)
    assert (told["settled"], told["coupled"], told["n_periods"], told["cells"]) == (False, False, 1, 9)
    assert told["cof"] < 0 < told["cof_error"]


def test_a_pull_that_yields_is_refused(tmp_path, capsys):
    yields = file_of(replace(BALL, pull=mdr.SpringPull(k_x=1e4)), tmp_path / "case.toml")
    assert "takes a rigid pull" in words_of(capsys, ["half-space", yields, "--v-0", "1e-4"], 1).err
