"""`mdr record` and `mdr motion`: what they print and write of a recorded motion, and what is refused."""

import contextlib
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from answers import json_of, words_of
from numpy.testing import assert_allclose

import mdr
from mdr.__main__ import main
from mdr.tools.csv_table import csv_text

BALL, ELASTIC, MU_0 = mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), 0.5


def written(folder, text):
    case = mdr.SlidingContact(BALL, ELASTIC, MU_0, mdr.NormalOscillation(20e-6, 2e-6, 314.0))
    (folder / "case.toml").write_text(mdr.write_case(case))
    (folder / "motion.csv").write_text(text)
    return ["record", str(folder / "motion.csv"), str(folder / "case.toml")]


def test_the_command_writes_what_it_prints(tmp_path, capsys):
    rows = "\n".join(f"{k},{3 * np.sin(k):.6f},20" for k in range(50))
    line = written(tmp_path, f"t [ms], u_x [um], u_z [um]\n{rows}\n")
    assert "SlideRecord of 50 samples" in words_of(capsys, [*line, "-o", str(tmp_path / "out")]).out
    assert {one.name for one in (tmp_path / "out").iterdir()} == {"record.csv", "record.png", "record.svg"}
    assert "running_cof [-]" in (tmp_path / "out" / "record.csv").read_text()
    assert "cof_error" in json_of(capsys, [*line, "--json"])


def test_the_command_integrates_accelerations(tmp_path, capsys):
    """Bursts along and into the half-space: COF and mean force are those of the displacements, to (5/80)⁸."""
    t = np.arange(4001) * 2.5e-4
    with_ends = np.exp(-(((t - 0.5) / 0.08) ** 2) / 2 + 2j * np.pi * 80 * (t - 0.5))
    rate = (2j * np.pi * 80 - (t - 0.5) / 0.08**2) ** 2 - 1 / 0.08**2
    x, z, a_x, a_z = (6e-6 * u.imag if k % 2 else 4e-6 * u.real for u in (with_ends, rate * with_ends) for k in (1, 0))
    line = written(tmp_path, csv_text({"t [ms]": 1e3 * t, "a_x [g]": a_x / 9.80665, "a_z [m/s²]": a_z}))
    printed = json_of(capsys, [*line, "--high-pass", "0.005kHz", "--json", "--n-springs", "64"])
    inner = slice(800, 3201)  # but for a period of the high-pass at either end
    found = mdr.slide_record(BALL, ELASTIC, MU_0, t[inner], x[inner], u_z=20e-6 + z[inner], n_springs=64)
    assert abs(found.cof) > 1e-3
    assert printed["left_out"] == pytest.approx(0.4)
    assert_allclose([printed["cof"], printed["mean_F_z"]], [found.cof, found.mean_F_z], rtol=1e-6, atol=1e-8)
    other = tmp_path / "velocity"
    other.mkdir()
    first = (2j * np.pi * 80 - (t - 0.5) / 0.08**2) * with_ends
    text = csv_text({"t [s]": t, "v_x [V]": 6e-6 * first.imag / 0.125, "a_z [mV]": 100 * a_z / 9.80665})
    line_of_volts = [*written(other, text), "--high-pass", "5Hz", "--json", "--n-springs", "64"]
    line_of_volts += ["--sensitivity", "v_x=125mm/s/V", "a_z=100mV/g"]
    again = json_of(capsys, line_of_volts)
    assert_allclose([again["cof"], again["mean_F_z"]], [found.cof, found.mean_F_z], rtol=1e-6, atol=1e-8)
    for change, words in [
        ([], "a_x is an acceleration: give the frequency above which it counts, --high-pass 5Hz"),
        (["--high-pass", "5"], "SlideRecord of 2401 samples"),
        (["--high-pass", "5"], "left out: 0.4 of 1 s, both ends"),
        (["--high-pass", "2"], "uncertain for 0.5 s at either end of the record of 1 s: give 2.25 Hz or more"),
        (["--high-pass", "5mm"], "must be a frequency such as 5Hz, got '5mm'"),
        (["--high-pass", "-1Hz"], "must be a frequency"),
        (["--high-pass", "3kHz"], "half of the sampling rate"),
    ]:
        with contextlib.suppress(SystemExit):
            main([*line, *change])
        assert words in "".join(capsys.readouterr())


def test_the_pull_that_no_accelerometer_shows_is_given(tmp_path, capsys):
    """An accelerometer on the shaker saw a_z alone, above 5 Hz; the slide moves at 10 mm/s."""
    t = np.arange(4001) * 2.5e-4
    z = 4e-6 * np.cos(2 * np.pi * 80 * t)
    line = written(tmp_path, csv_text({"t [s]": t, "a_z [m/s²]": -((2 * np.pi * 80) ** 2) * z}))
    line += ["--high-pass", "5Hz", "--n-springs", "64"]
    assert "give the velocity of the pull, --v-0 10mm/s" in words_of(capsys, line, 2).err
    printed, inner = json_of(capsys, [*line, "--v-0", "10mm/s", "--json"]), slice(800, 3201)
    found = mdr.slide_record(BALL, ELASTIC, MU_0, t[inner], 0.01 * t[inner], u_z=20e-6 + z[inner], n_springs=64)
    assert_allclose(printed["cof"], found.cof, rtol=1e-5)  # (5/80)^8 of the high-pass, and its ends
    # the indenter moves as recorded: a body counts for nothing, not for v_c either, and this is said
    body = tmp_path / "body.toml"
    body.write_text((tmp_path / "case.toml").read_text() + "\n[pull]\nk_x = 2e3\nm = 0.01\nc_x = 1.0\n")
    rigid = json_of(capsys, [*line, "--v-0", "0.5v_c", "--json"])["cof"]
    onto = [str(body) if one.endswith("case.toml") else one for one in line]
    assert json_of(capsys, [*onto, "--v-0", "0.5v_c", "--json"])["cof"] == rigid
    told = words_of(capsys, [*onto, "--v-0", "0.5v_c"]).out
    assert "without [pull]: a record is the way of the indenter itself" in told
    (tmp_path / "motion.csv").write_text("t [s], u_x [um], u_z [um]\n0, 0, 20\n1, 1, 20\n")
    refused = words_of(capsys, [*line[:3], "--v-0", "10mm/s"], 2).err
    assert "u_x, which is the whole way along the pull: leave --v-0 out" in refused


def test_a_recorded_motion_is_a_table_of_a_case_file(tmp_path, capsys):
    t = np.arange(0, 1, 2.5e-4)
    a = (2 * np.pi * 80) ** 2 * (-4e-6 * np.cos(2 * np.pi * 80 * t) - 9e-6 * np.sin(4 * np.pi * 80 * t))
    path = tmp_path / "shaker.csv"
    path.write_text(csv_text({"t [ms]": 1e3 * t, "a_z [g]": a / 9.80665}))
    table = words_of(capsys, ["motion", str(path), "--u-z0", "20um"]).out
    assert table.startswith("# 80 Hz, 2 harmonics, amplitude ")
    case = mdr.parse_case(mdr.write_case(mdr.read_case(written(tmp_path, "")[2])).split("[oscillation]")[0] + table)
    assert_allclose(case.oscillation.cos, [4e-6, 0], atol=1e-12)  # six digits of the CSV
    assert_allclose(case.oscillation.sin, [0, 9e-6 / 4], atol=1e-12)
    assert_allclose([case.oscillation.u_z0, case.omega], [20e-6, 2 * np.pi * 80], rtol=1e-6)
    known = json_of(capsys, ["motion", str(path), "--u-z0", "20um", "--frequency", "80Hz", "--json"])
    assert known["left_out"] < 1e-4
    for unit, made in (("v_z [mm/s]", 1e3 * case.oscillation.u_z_dot(t)), ("u_z [um]", 1e6 * case.oscillation.u_z(t))):
        path.write_text(csv_text({"t [s]": t, unit: made}))
        again = json_of(capsys, ["motion", str(path), "--u-z0", "20um", "--json"])
        assert_allclose([again["omega"], again["du_z"]], [known["omega"], known["du_z"]], rtol=1e-6)
    path.write_text(csv_text({"t [s]": t, "Ch 1 [mV]": 100 * a / 9.80665}))
    sensor = ["motion", str(path), "--u-z0", "20um", "--sensitivity", "100mV/g", "--json"]
    assert_allclose(json_of(capsys, sensor)["du_z"], known["du_z"], rtol=1e-6)
    path.write_text(csv_text({"t [s]": t, "v_z [m/s]": a, "a_z [g]": a}))
    assert "names both a_z and v_z: leave one out" in words_of(capsys, ["motion", str(path), "--u-z0", "20um"], 2).err
    path.write_text(csv_text({"t [s]": t, "a_x [g]": a}))
    assert "names none of a_z, v_z, u_z" in words_of(capsys, ["motion", str(path), "--u-z0", "20um"], 2).err


def test_a_backend_that_matplotlib_lacks_is_no_fault_of_the_case(tmp_path):
    line = written(tmp_path, "t [ms], u_x [um], u_z [um]\n0,0,20\n1,1,20\n2,0,20\n")
    command = [sys.executable, "-m", "mdr", *line, "--n-springs", "32", "-o", str(tmp_path / "out")]
    ended = subprocess.run(command, env={**os.environ, "MPLBACKEND": "foo"}, capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    assert (tmp_path / "out" / "record.png").exists()


def test_the_command_is_told_what_the_columns_are(tmp_path, capsys):
    """Those of an accelerometer, x and z in g without a unit; a temperature T is left alone."""
    rows = "\n".join(f"{k},{np.cos(0.2 * k):.6f},{np.sin(0.3 * k):.6f},25" for k in range(2001))
    line = [*written(tmp_path, f"time,x,z,T\n{rows}\n"), "--high-pass", "10Hz", "--n-springs", "32"]
    told = words_of(capsys, line, 2).err
    assert "u_x needs a unit" in told
    assert "z may be u_z, or another quantity: if it is u_z, --columns u_z=z" in told
    named = [*line, "--columns", "a_x=x", "a_z=z", "--units", "t=ms", "a_x=g", "a_z=g"]
    assert "left out: 0.2 of 2 s" in words_of(capsys, named).out
    Path(line[1]).write_text(f"made,x,z,T\n{rows}\n")
    line += ["--rate", "1kHz"]
    assert "u_x needs a unit" in words_of(capsys, line, 2).err
    counted = [*line, "--columns", "a_x=2", "a_z=3", "--units", "a_x=g", "a_z=g", "--skip", "1"]
    assert "left out: 0.2 of 2 s" in words_of(capsys, counted).out
    with pytest.raises(SystemExit, match="2"):
        main([*line, "--units", "t"])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("t [s], a_x [g], u_x [um], u_z [um]\n0, 1, 1, 1\n1, 1, 1, 1\n", "names a_x and u_x: leave one out"),
        ("t [s], u_x [um], a_z [g], F_z [N]\n0, 1, 1, 1\n1, 1, 1, 1\n", "names a_z and F_z: leave one out"),
        ("t [s], u_x [um]\n0, 1\n1, 2\n", "names no depth"),
        ("t [s], u_z [um]\n0, 1\n", "names no u_x"),
        ("t [s], u_x [um], F_z [N]\n0, 1, 1\n0, 2, 1\n", "t must rise"),
    ],
)
def test_hostile_files_are_refused(tmp_path, capsys, text, words):
    high_pass = ["--high-pass", "0.3Hz"] if "a_" in text else []
    assert words in words_of(capsys, [*written(tmp_path, text), *high_pass], 2).err
