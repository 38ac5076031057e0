"""Friction under a recorded motion: what `slide` has, exact pieces, loads, errors, files and what is refused."""

import contextlib
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from elements import ARMS, BALL, ELASTIC, KELVIN, MU_0, every_material
from numpy.testing import assert_allclose
from twins.path import followed

import mdr
from mdr.__main__ import main
from mdr.tools.csv_table import csv_text

OMEGA = 314.0
PERIOD = 2 * np.pi / OMEGA


def odd_record(n=60, seed=3):
    """Uneven steps, pauses, jumps and loss of contact: t, u_x, u_y, u_z."""
    rng = np.random.default_rng(seed)
    t = np.cumsum(10 ** rng.uniform(-4, -2, n))
    moves = rng.random((3, n)) > 0.2
    x, y = 2e-5 * np.cumsum(moves[:2] * rng.normal(0, 0.5, (2, n)), axis=1)
    z = 2e-5 * (1 + 1.2 * np.sin(0.3 * np.cumsum(moves[2] * rng.normal(1, 1, n))))
    assert z.min() < 0 < z.max()
    return t, x, y, z


@pytest.mark.parametrize(
    ("material", "du_z", "du_y", "v_0"),
    [(ELASTIC, 28e-6, 0.0, 2.6e-3), (ELASTIC, 28e-6, 6e-6, 1e-3), (KELVIN, 6e-6, 0.0, 1e-3), (ARMS, 28e-6, 6e-6, 1e-3)],
    ids=["elastic, lost", "elastic, across, lost", "Kelvin, kept", "arms, across, lost"],
)
def test_a_harmonic_record_has_the_friction_of_a_run(material, du_z, du_y, v_0):
    """Over the last of some periods. Chords of 256 steps leave out h²/8 of the amplitude: 4e-5 of the friction."""
    shake = mdr.InPlaneOscillation(omega=OMEGA, du_y=du_y) if du_y else None
    case = mdr.SlidingContact(BALL, material, MU_0, mdr.NormalOscillation(20e-6, du_z, OMEGA), shake=shake)
    steps, n, area = 256, 8, []
    for periods in (n - 1, n):
        t = np.arange(periods * steps + 1) * PERIOD / steps
        u_y = du_y * np.cos(OMEGA * t) if du_y else None
        found = mdr.slide_record(
            BALL, material, MU_0, t, v_0 * t, u_y, u_z=20e-6 + du_z * np.cos(OMEGA * t), n_springs=128
        )
        area.append(found.mean_F_z * t[-1] * np.array([found.cof, 1]))
    F_x, F_z = area[1] - area[0]
    run = mdr.slide(case, v_0, accuracy=1e-4)
    assert run.settled
    assert_allclose(F_x / F_z, run.cof, rtol=0, atol=run.cof_error + n * found.cof_error + 4e-5 * MU_0)


@every_material
@pytest.mark.parametrize("across", [False, True], ids=["along", "across"])
def test_an_odd_record_is_that_of_an_element(material, across):
    """A record along one line goes by the scalar step, an element by the vector: they agree."""
    t, x, y, z = odd_record()
    y = y if across else None
    found = mdr.slide_record(BALL, material, MU_0, t, x, y, z, n_springs=64)
    element = mdr.ContactElement(BALL, material, MU_0, u_z_max=z.max(), n_springs=64)
    us, parts = np.column_stack([x, 0 * x if y is None else y, z]), 2 if across else 1
    state = element.at_rest(us[0])
    for k in range(1, t.size):
        for part in range(parts):
            u = us[k - 1] + (part + 1) / parts * (us[k] - us[k - 1])
            F, state = element.step(state, (t[k] - t[k - 1]) / parts, u)
        if material is ELASTIC:
            assert_allclose(F[:2], [found.F_x[k], found.F_y[k]], atol=2e-3 * found.F_z.max())  # its springs: no cut
            assert_allclose(F[2], found.F_z[k], atol=1e-4 * found.F_z.max())
    spent, scale = found.energy_balance, float(element.dissipated(state))
    assert_allclose(spent.lost, scale, rtol=1e-3)
    assert spent.plane_work + spent.normal_work == pytest.approx(spent.lost + spent.stored_change)


@every_material
def test_the_error_bounds_what_a_finer_run_changes(material):
    """The same path, of more samples and springs."""
    path = odd_record()
    coarse = mdr.slide_record(BALL, material, MU_0, *path, n_springs=32)
    at = np.linspace(0, path[0].size - 1, 8 * (path[0].size - 1) + 1)
    fine = mdr.slide_record(
        BALL, material, MU_0, *(np.interp(at, np.arange(path[0].size), one) for one in path), n_springs=512
    )
    assert abs(coarse.cof - fine.cof) <= coarse.cof_error
    assert abs(coarse.cof_y - fine.cof_y) <= coarse.cof_error
    assert fine.cof_error < 0.1 * coarse.cof_error
    assert coarse.cof_error < 2e-3 * MU_0


@pytest.mark.parametrize("seed", range(3, 13))
@pytest.mark.parametrize(
    ("material", "law"),
    [(ELASTIC, {}), (KELVIN, {"T": 1e-3}), (ARMS, {"rho": [2 / 3, 1.0], "theta": [1e-3, 5e-3]})],
    ids=["elastic", "Kelvin", "arms"],
)
def test_ten_odd_records_are_those_of_explicit_steps(material, law, seed):
    """Of first order, extrapolated from two; cells, and what an extrapolation misses, are some 1e-4 of mu_0. Those of
    odd seeds go along a line, which is the scalar step.
    """
    t, x, y, z = odd_record(seed=seed)
    found = mdr.slide_record(BALL, material, MU_0, t, x, None if seed % 2 else y, z)
    y = 0 * y if seed % 2 else y
    gap, off = ((np.arange(120) + 0.5) / 120) ** 2 * z.max(), []
    for parts in (40, 80):
        _, area = followed(gap, t, np.column_stack([x, y, z]), MU_0 * material.mindlin_ratio, parts, **law)
        off.append(MU_0 * area[:, :2].sum(axis=0) / area[:, 2].sum() - [found.cof, found.cof_y])
    coarse, fine = off
    assert np.abs(2 * fine - coarse).max() <= found.cof_error + 0.1 * np.abs(fine - coarse).max() + 2e-4 * MU_0


def test_along_a_line_is_along_any_line():
    t, x, _, z = odd_record()
    one, two = mdr.slide_record(BALL, ELASTIC, MU_0, t, x, 0.3, z), mdr.slide_record(BALL, ELASTIC, MU_0, t, 0, x, z)
    assert_allclose(two.F_y, one.F_x, atol=1e-11 * one.F_z.max())
    assert_allclose([one.cof_y, two.cof, two.cof_y], [0, 0, one.cof], atol=1e-9)
    assert one.running_cof[-1] == pytest.approx(one.cof)
    assert (one.running_cof <= MU_0 * (1 + 1e-9)).all()


@pytest.mark.parametrize(("material", "met"), [(ELASTIC, 1e-12), (KELVIN, 2e-2), (ARMS, 1e-12)])
def test_a_load_finds_the_depth_that_carries_it(material, met):
    """A load that rises, holds and falls to zero. With a dashpot a spring that touches makes a jump of its share."""
    t = np.linspace(0, 0.05, 201)
    F = 0.05 * np.clip(np.minimum(0.2 + 40 * t, 60 * (0.045 - t)), 0, 1)
    found = mdr.slide_record(BALL, material, MU_0, t, 2e-6 * np.sin(300 * t), F_z=F, n_springs=64)
    assert_allclose(found.F_z[1:], F[1:], rtol=0, atol=met * F.max())
    if material is ELASTIC:
        at = mdr.static_depth(BALL, material, F.max())
        assert_allclose(found.u_z.max(), at, rtol=1e-4)
    else:
        rest = mdr.static_depth(BALL, material, F.max())
        assert 0.5 * rest < found.u_z.max() <= rest * (1 + 1e-3)


def test_depth_and_load_are_each_others_inverse():
    t = np.linspace(0, 0.1, 801)
    z, x = 2e-5 + 1e-5 * np.sin(100 * t), 3e-5 * np.sin(60 * t)
    for material in (ELASTIC, ARMS):
        one = mdr.slide_record(BALL, material, MU_0, t, x, u_z=z, n_springs=64)
        two = mdr.slide_record(BALL, material, MU_0, t, x, F_z=one.F_z, n_springs=64)
        start = 80 if material is ARMS else 0  # of a load the arms are at rest first
        assert_allclose(two.u_z[start:], z[start:], rtol=1e-4 if material is ELASTIC else 2e-2)
        assert_allclose(two.F_x[start:], one.F_x[start:], atol=2e-2 * MU_0 * one.F_z.max())


# --- files ---


def written(folder, text):
    case = mdr.SlidingContact(BALL, ELASTIC, MU_0, mdr.NormalOscillation(20e-6, 2e-6, OMEGA))
    (folder / "case.toml").write_text(mdr.write_case(case))
    (folder / "motion.csv").write_text(text)
    return ["record", str(folder / "motion.csv"), str(folder / "case.toml")]


def test_the_second_half_of_a_slide_from_rest_has_no_build_up_in_it():
    """A ball slips all over from mu_0 kappa d on."""
    t = np.linspace(0, 1, 401)
    reach = MU_0 * ELASTIC.mindlin_ratio * 2e-5
    found = mdr.slide_record(BALL, ELASTIC, MU_0, t, 2.1 * reach * t, u_z=2e-5)
    assert found.cof < 0.9 * MU_0
    assert_allclose(found.late_cof, MU_0, rtol=1e-12)
    lifted = mdr.slide_record(BALL, ELASTIC, MU_0, t, reach * t, u_z=np.where(t < 0.4, 2e-5, -1e-5))
    assert np.isnan(lifted.late_cof)


def test_the_command_writes_what_it_prints(tmp_path, capsys):
    rows = "\n".join(f"{k},{3 * np.sin(k):.6f},20" for k in range(50))
    line = written(tmp_path, f"t [ms], u_x [um], u_z [um]\n{rows}\n")
    assert main([*line, "-o", str(tmp_path / "out")]) == 0
    assert "SlideRecord of 50 samples" in capsys.readouterr().out
    assert {one.name for one in (tmp_path / "out").iterdir()} == {"record.csv", "record.png", "record.svg"}
    assert "running_cof [-]" in (tmp_path / "out" / "record.csv").read_text()
    assert main([*line, "--json"]) == 0
    assert '"cof_error"' in capsys.readouterr().out


def test_the_command_integrates_accelerations(tmp_path, capsys):
    """Bursts along and into the half-space: COF and mean force are those of the displacements, to (5/80)⁸."""
    t = np.arange(4001) * 2.5e-4
    with_ends = np.exp(-(((t - 0.5) / 0.08) ** 2) / 2 + 2j * np.pi * 80 * (t - 0.5))
    rate = (2j * np.pi * 80 - (t - 0.5) / 0.08**2) ** 2 - 1 / 0.08**2
    x, z, a_x, a_z = (6e-6 * u.imag if k % 2 else 4e-6 * u.real for u in (with_ends, rate * with_ends) for k in (1, 0))
    line = written(tmp_path, csv_text({"t [ms]": 1e3 * t, "a_x [g]": a_x / 9.80665, "a_z [m/s²]": a_z}))
    assert main([*line, "--high-pass", "0.005kHz", "--json", "--n-springs", "64"]) == 0
    printed = json.loads(capsys.readouterr().out)
    inner = slice(800, 3201)  # but for a period of the high-pass at either end
    found = mdr.slide_record(BALL, ELASTIC, MU_0, t[inner], x[inner], u_z=20e-6 + z[inner], n_springs=64)
    assert abs(found.cof) > 1e-3
    assert printed["left_out"] == pytest.approx(0.4)
    assert_allclose([printed["cof"], printed["mean_F_z"]], [found.cof, found.mean_F_z], rtol=1e-6, atol=1e-8)
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
    assert main(line) == 2
    assert "give the velocity of the pull, --v-0 10mm/s" in capsys.readouterr().err
    assert main([*line, "--v-0", "10mm/s", "--json"]) == 0
    printed, inner = json.loads(capsys.readouterr().out), slice(800, 3201)
    found = mdr.slide_record(BALL, ELASTIC, MU_0, t[inner], 0.01 * t[inner], u_z=20e-6 + z[inner], n_springs=64)
    assert_allclose(printed["cof"], found.cof, rtol=1e-5)  # (5/80)^8 of the high-pass, and its ends
    # the indenter moves as recorded: a body counts for nothing, not for v_c either, and this is said
    body = tmp_path / "body.toml"
    body.write_text((tmp_path / "case.toml").read_text() + "\n[pull]\nk_x = 2e3\nm = 0.01\nc_x = 1.0\n")
    assert main([*line, "--v-0", "0.5v_c", "--json"]) == 0
    rigid = json.loads(capsys.readouterr().out)["cof"]
    onto = [str(body) if one.endswith("case.toml") else one for one in line]
    assert main([*onto, "--v-0", "0.5v_c", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["cof"] == rigid
    assert main([*onto, "--v-0", "0.5v_c"]) == 0
    assert "without [pull]: a record is the way of the indenter itself" in capsys.readouterr().out
    (tmp_path / "motion.csv").write_text("t [s], u_x [um], u_z [um]\n0, 0, 20\n1, 1, 20\n")
    assert main([*line[:3], "--v-0", "10mm/s"]) == 2
    assert "u_x, which is the whole way along the pull: leave --v-0 out" in capsys.readouterr().err


def test_a_recorded_motion_is_a_table_of_a_case_file(tmp_path, capsys):
    t = np.arange(0, 1, 2.5e-4)
    a = (2 * np.pi * 80) ** 2 * (-4e-6 * np.cos(2 * np.pi * 80 * t) - 9e-6 * np.sin(4 * np.pi * 80 * t))
    path = tmp_path / "shaker.csv"
    path.write_text(csv_text({"t [ms]": 1e3 * t, "a_z [g]": a / 9.80665}))
    assert main(["motion", str(path), "--u-z0", "20um"]) == 0
    table = capsys.readouterr().out
    assert table.startswith("# 80 Hz, 2 harmonics, amplitude ")
    case = mdr.parse_case(mdr.write_case(mdr.read_case(written(tmp_path, "")[2])).split("[oscillation]")[0] + table)
    assert_allclose(case.oscillation.cos, [4e-6, 0], atol=1e-12)  # six digits of the CSV
    assert_allclose(case.oscillation.sin, [0, 9e-6 / 4], atol=1e-12)
    assert_allclose([case.oscillation.u_z0, case.omega], [20e-6, 2 * np.pi * 80], rtol=1e-6)
    assert main(["motion", str(path), "--u-z0", "20um", "--frequency", "80Hz", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["left_out"] < 1e-4
    path.write_text(csv_text({"t [s]": t, "a_x [g]": a}))
    assert main(["motion", str(path), "--u-z0", "20um"]) == 2
    assert "names no a_z" in capsys.readouterr().err


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
    assert main(line) == 2
    told = capsys.readouterr().err
    assert "u_x needs a unit" in told
    assert "to read it as it is: --units t=s u_x=um u_z=um" in told
    assert main([*line, "--columns", "a_x=x", "a_z=z", "--units", "t=ms", "a_x=g", "a_z=g"]) == 0
    assert "left out: 0.2 of 2 s" in capsys.readouterr().out
    Path(line[1]).write_text(f"made,x,z,T\n{rows}\n")
    assert main([*line, "--rate", "1kHz"]) == 2
    assert "u_x needs a unit" in capsys.readouterr().err
    assert (
        main([*line, "--columns", "a_x=2", "a_z=3", "--units", "a_x=g", "a_z=g", "--rate", "1kHz", "--skip", "1"]) == 0
    )
    assert "left out: 0.2 of 2 s" in capsys.readouterr().out
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
    assert main([*written(tmp_path, text), *high_pass]) == 2
    assert words in capsys.readouterr().err


def test_a_million_steps_tell_how_far_they_are(monkeypatch, capsys):
    monkeypatch.setattr("mdr.tools.progress.PATIENCE", 0.0)
    monkeypatch.setattr("mdr.element.record.AT_ONCE", 32 * 100)
    t = np.arange(1000.0)
    mdr.slide_record(BALL, ELASTIC, MU_0, t, 1e-6 * np.sin(t), u_z=1e-5, n_springs=32)
    assert "slide_record: " in capsys.readouterr().err


@pytest.mark.parametrize("shape", [mdr.Paraboloid(R=5e-3), mdr.FlatPunch(a=1e-3)], ids=["ball", "punch"])
def test_a_record_that_begins_with_a_lift_or_in_the_air_has_numbers_alone(shape):
    """Lifted straight up, moved across later: a dashpot with arms; and nothing touches at the first samples."""
    material, d = mdr.Prony(E_inf=2e6, arms=((1e6, 2e-3),), nu=0.3, tau=5e-4), 1e-5
    for dt in (1e-4, 1e-2):
        for z in ((1, 0.4, 1, 1), (-1, -0.5, 1, 1)):
            way, u_z = ([0, 0, d, 2 * d], [0, 0, d / 2, 0]), d * np.array(z)
            found = mdr.slide_record(shape, material, 0.5, dt * np.arange(4), *way, u_z=u_z, n_springs=32)
            numbers = found.cof, found.cof_y, found.cof_error, found.energy_balance.lost
            assert np.all(np.isfinite([*numbers, *found.running_cof, *found.F_y]))
            assert found.running_cof[0] == 0


def test_a_load_in_steps_that_are_short_for_a_dashpot_has_a_depth():
    """A dashpot a thousand times stiffer than the spring: a depth, good to its last bit, misses the load by more."""
    rng = np.random.default_rng(1)
    for _ in range(10):
        t = np.cumsum(10.0 ** rng.uniform(-6, -2, 20))
        found = mdr.slide_record(
            BALL, mdr.KelvinVoigt(E=3e6, nu=0.3, tau=3e-2), 0.5, t, 1e-3 * t, F_z=rng.uniform(0.01, 0.1, 20)
        )
        assert np.all(np.isfinite([*found.u_z, *found.F_z, found.cof]))
