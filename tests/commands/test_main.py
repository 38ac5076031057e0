"""The command line: what it prints, writes and returns."""

import errno
import os
import re
import shlex
import subprocess
import sys
import warnings
from dataclasses import replace
from functools import partial
from importlib import import_module
from io import BytesIO, TextIOWrapper
from pathlib import Path
from shutil import which

import numpy as np
import pytest
from answers import file_of, json_of, words_of
from conftest import contact
from numpy.testing import assert_allclose
from PIL import Image

import mdr
from mdr.__main__ import COMMANDS, main
from mdr.closed_forms.critical_velocity import velocity_scale
from mdr.friction.measured_velocity import MeasuredVelocity
from mdr.given.case_file import parse_case, read_case
from mdr.tools.provenance import versions

EXAMPLE = str(Path(__file__).parents[2] / "docs" / "example.toml")


@pytest.fixture
def punch(tmp_path):
    """A case file that is quick to march: flat punch, elastic, rigid pull."""
    return file_of(contact("flat", 2.0, du_z=1e-6, omega=100.0, nu=0.3, E=1e9), tmp_path / "punch.toml")


@pytest.fixture
def resonant(tmp_path):
    """The example on its resonance k_x = m omega²."""
    example = read_case(EXAMPLE)
    oscillation, pull = replace(example.oscillation, omega=400.0), mdr.SpringPull(k_x=16000.0, m=0.1)
    return file_of(replace(example, oscillation=oscillation, pull=pull), tmp_path / "resonant.toml")


def made_up_curve(case, v_0, accuracy=1e-5, settled=True):
    n = np.asarray(v_0).size
    states = np.ones(n, dtype=bool)
    states[-1] = settled
    return mdr.CofCurve(
        v_0=np.asarray(v_0), cof=np.full(n, 0.3), cof_error=np.where(states, 1e-6, np.nan), settled=states,
        stick_share=np.zeros(n), v_c=mdr.critical_velocity(case), mu_0=case.mu_0, full_cof=case.mu_0, static_cof=0.2,
        why=tuple("" if state else "F_x still drifts" for state in states),
    )  # fmt: skip


# --- velocity ---


def test_velocity(capsys):
    out = words_of(capsys, ["velocity", EXAMPLE]).out
    assert f"Eq. (15)   {mdr.critical_velocity(read_case(EXAMPLE)):.6g} m/s" in out
    assert "alpha      0.1 " in out
    assert "loss       0.314159 " in out
    rigid = replace(read_case(EXAMPLE), pull=mdr.RigidPull())
    assert f"rigid      {mdr.critical_velocity(rigid):.6g} m/s  the same contact pulled rigidly, Eq. (1)" in out


def test_the_greatest_pressure_is_that_of_hertz(capsys):
    told, case = json_of(capsys, ["velocity", "--json", EXAMPLE]), read_case(EXAMPLE)
    a = np.sqrt(22e-6 * case.indenter.R)
    hertz = 2 / np.pi * case.material.E_star * a / case.indenter.R
    assert_allclose(told["peak_pressure"], hertz * np.sqrt(1 - 0.01**2), rtol=1e-12)  # at r = 0.01 a


@pytest.mark.filterwarnings("always::mdr.PlausibilityWarning")
def test_warnings_tell_the_way_of_the_command_line(capsys, tmp_path):
    load = mdr.LoadOscillation(F_z0=1.0, dF_z=2.0, omega=314.0, m_z=0.1)
    case = mdr.SlidingContact(mdr.Sphere(5e-3), mdr.KelvinVoigt(3e6, 0.5, 6e-4), 0.8, load)
    said = words_of(capsys, ["velocity", file_of(case, tmp_path / "case.toml")]).err
    assert "too great for the closed form" in said
    assert "the row full slip of `mdr velocity` takes the depth that the load brings about" in said
    assert "(case)" not in said


def test_velocity_for_machines(capsys, punch):
    answer, case = json_of(capsys, ["velocity", "--json", punch]), read_case(punch)
    assert answer["equation"] == "Eq. (1)"
    assert answer["v_c"] == mdr.critical_velocity(case)
    assert answer["full_slip"] == mdr.full_slip_critical_velocity(case)
    assert_allclose(answer["static_cof"], 0.4 * (1 - 0.5), rtol=1e-5)  # Eq. (7) over k_zc u_z0
    assert answer["version"] == mdr.__version__
    assert parse_case(answer["case"]) == case


def test_a_resonance_is_an_answer(capsys, resonant):
    out = words_of(capsys, ["velocity", resonant]).out
    assert re.search(r"Eq. \(15\) +infinite .*; friction is full at no velocity", out)
    assert json_of(capsys, ["velocity", "--json", resonant])["v_c"] == "inf"


def test_with_a_shear_strength_no_label_runs_into_its_value(capsys, tmp_path):
    case = replace(read_case(EXAMPLE), tau_0=5e4, material=mdr.Elastic(3e6, 0.5))
    path = file_of(case, tmp_path / "case.toml")
    out = words_of(capsys, ["velocity", path]).out
    assert out.startswith("full slip with tau_0  infinite ")
    assert "pulled rigidly, full slip with tau_0; friction is full at no velocity" in " ".join(out.split())
    assert max(map(len, out.splitlines())) <= 120
    head = "v_c = infinite by full slip with tau_0: friction is full at no velocity, mu_0 = 0.5\n"
    assert words_of(capsys, ["run", path, "--v-0", "1mm/s"]).out.startswith(head)


# --- curve ---


def test_curve_writes_what_it_prints(capsys, punch, tmp_path):
    folder = tmp_path / "a" / "b"
    command = ["curve", punch, "-o", str(folder), "--points", "3", "--up-to", "1.2", "v_c"]
    table = words_of(capsys, command).out.splitlines()
    assert sorted(path.name for path in folder.iterdir()) == ["curve.csv", "curve.png", "curve.svg"]
    lines = (folder / "curve.csv").read_text(encoding="utf-8").splitlines()
    head = [line[2:] for line in lines if line.startswith("#")]
    assert head[0] == versions()
    assert head[1] == " ".join(["mdr", *command])
    assert parse_case("\n".join(head[2:])) == read_case(punch)
    for name in ("curve.png", "curve.svg"):
        assert versions().encode() in (folder / name).read_bytes()
        assert " ".join(["mdr", *command]).encode() in (folder / name).read_bytes()
    rows = np.loadtxt(folder / "curve.csv", delimiter=",", skiprows=len(head) + 1)
    assert_allclose(rows[:, 0], mdr.critical_velocity(read_case(punch)) * np.array([0, 0.6, 1.2]))
    assert_allclose(rows[-1, 1], 0.4, rtol=1e-9)  # above v_c
    assert len(table) == 2 + 3
    assert f"{rows[1, 1]:.6f}" in table[3]


def test_curve_without_a_folder_writes_nothing(capsys, punch, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("mdr.cof_curve", made_up_curve)
    before = set(tmp_path.iterdir())
    answer = json_of(capsys, ["curve", punch, "--json"])
    assert len(answer["v_0"]) == len(answer["cof"]) == len(answer["why"]) == 24
    assert answer["settled"] == [True] * 24
    assert set(tmp_path.iterdir()) == before


def test_an_unsettled_curve_is_shown_and_fails(capsys, punch, tmp_path, monkeypatch):
    monkeypatch.setattr("mdr.cof_curve", partial(made_up_curve, settled=False))
    out, err = words_of(capsys, ["curve", punch, "--points", "2", "-o", str(tmp_path)], 1)
    assert err == "mdr: 1 of 2 runs did not settle\n  F_x still drifts\n"
    assert out.splitlines()[-1].endswith("no")
    assert (tmp_path / "curve.csv").exists()
    assert json_of(capsys, ["curve", punch, "--points", "2", "--json"], 1)["cof_error"][1] is None


def test_a_curve_on_a_resonance_is_scaled_by_eq_1(capsys, resonant, tmp_path, monkeypatch):
    monkeypatch.setattr("mdr.cof_curve", made_up_curve)
    case = read_case(resonant)
    assert velocity_scale(case) == pytest.approx(0.5 * 400.0 * 2e-6 * 1.5, rel=1e-12)
    out, err = words_of(capsys, ["curve", resonant, "-o", str(tmp_path), "--points", "4", "--up-to", "2v_c"])
    assert "v_c = infinite" in out
    assert "v_c is infinite here: velocities are multiples of 0.0006 m/s" in err
    rows = (tmp_path / "curve.csv").read_text(encoding="utf-8").splitlines()
    assert float(rows[-1].split(",")[0]) == pytest.approx(2 * velocity_scale(case))


@pytest.mark.parametrize(
    ("options", "velocities"),
    [(["--v-0", "1e-3", "2mm/s", "0.5v_c"], [1e-3, 2e-3, None]), (["--up-to", "5mm/s", "--points", "2"], [0, 5e-3]),
     (["--up-to", "0.5", "--points", "2"], [0, 0.5]), (["--up-to", "0.5 v_c", "--points", "2"], [0, None]),
     (["--v-0", "1e-3", "2", "mm/s", "7", "0.5", "v_c"], [1e-3, 2e-3, 7.0, None])],
)  # fmt: skip
def test_velocities_of_a_curve_in_metres_per_second_or_over_v_c(capsys, punch, monkeypatch, options, velocities):
    monkeypatch.setattr("mdr.cof_curve", made_up_curve)
    half = 0.5 * mdr.critical_velocity(read_case(punch))
    answer = json_of(capsys, ["curve", punch, *options, "--json"])
    assert_allclose(answer["v_0"], [half if one is None else one for one in velocities], rtol=1e-15)


# --- run ---

RUN = ("--n-springs", "64", "--steps", "256", "--accuracy", "1e-3")


def test_a_run_writes_what_it_prints(capsys, punch, tmp_path):
    command = ["run", punch, "--v-0", "0.5v_c", "-o", str(tmp_path / "one"), *RUN]
    case = read_case(punch)
    found = mdr.slide(case, 0.5 * mdr.critical_velocity(case), n_springs=64, steps_per_period=256, record=1)
    told = f"v_c = {mdr.critical_velocity(case):.6g} m/s by Eq. (1), mu_0 = 0.4\n{found}\n"
    assert words_of(capsys, command).out == told  # a slow machine says more, of its progress, on standard error
    assert sorted(path.name for path in (tmp_path / "one").iterdir()) == ["run.csv", "run.png", "run.svg"]
    lines = (tmp_path / "one" / "run.csv").read_text(encoding="utf-8").splitlines()
    head = [line[2:] for line in lines if line.startswith("#")]
    assert head[:2] == [versions(), " ".join(["mdr", *command])]
    assert parse_case("\n".join(head[2:])) == case
    assert lines[len(head)] == "t [s],u_x [m],u_z [m],F_x [N],F_z [N]"
    rows = np.loadtxt(lines[len(head) + 1 :], delimiter=",")
    assert np.array_equal(rows.T, [found.t, found.u_x, found.u_z, found.F_x, found.F_z])
    found.to_csv(tmp_path / "again.csv")
    assert (tmp_path / "again.csv").read_text(encoding="utf-8").splitlines() == lines[len(head) :]


def test_a_run_is_animated(punch, tmp_path):
    command = ["run", punch, "--v-0", "1mm/s", *RUN, "--animate", str(tmp_path / "springs.gif")]
    assert main(command) == 0
    with Image.open(tmp_path / "springs.gif") as gif:
        assert gif.n_frames == 60
        assert gif.info["comment"].decode() == f"{versions()}\n{' '.join(['mdr', *command])}"


def test_a_run_for_machines(capsys, punch):
    answer = json_of(capsys, ["run", punch, "--v-0", "1mm/s", "--json", *RUN])
    assert (answer["v_0"], answer["settled"], answer["n_springs"], answer["steps_per_period"]) == (1e-3, True, 64, 256)
    assert abs(answer["mean_F_x"] / answer["mean_F_z"] - answer["cof"]) < 1e-12
    assert abs(answer["energy_balance"]["residual"]) < 1e-3 * answer["energy_balance"]["friction_loss"]


def test_what_falling_friction_lacks_is_left_out_or_refused(tmp_path, capsys):
    motion = mdr.NormalOscillation(u_z0=20e-6, du_z=8e-6, omega=300.0)
    law = mdr.StaticKinetic(mu_s=0.6, mu_k=0.5)
    case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), oscillation=motion, friction=law)
    path = tmp_path / "falls.toml"
    path.write_text(mdr.write_case(case), encoding="utf-8")
    assert main(["run", str(path), "--v-0", "5mm/s", "--n-springs", "32", "--steps", "64"]) == 0
    assert "by Eq. (1), mu_0 = 0.5" in capsys.readouterr().out
    assert main(["export", str(path), "-o", str(tmp_path / "one.h")]) != 0
    assert "takes Coulomb's friction" in capsys.readouterr().err


def test_a_record_has_the_static_coefficient_of_its_case(tmp_path, capsys):
    """Springs that have not slipped yet bear mu_s."""
    still = mdr.NormalOscillation(u_z0=20e-6, du_z=8e-6, omega=300.0)
    law = mdr.StaticKinetic(mu_s=0.6, mu_k=0.5)
    case = mdr.SlidingContact(mdr.FlatPunch(a=1e-3), mdr.Elastic(E=3e6, nu=0.5), oscillation=still, friction=law)
    reach = 0.5 * case.material.mindlin_ratio * 1e-5  # way to the kinetic limit
    (tmp_path / "falls.toml").write_text(mdr.write_case(case), encoding="utf-8")
    way = tmp_path / "way.csv"
    way.write_text(f"t [s],u_x [m],u_z [m]\n0,0,1e-5\n1,{1.19 * reach},1e-5\n", encoding="utf-8")
    told = json_of(capsys, ["record", str(way), str(tmp_path / "falls.toml"), "--json"])
    assert told["cof"] == pytest.approx(1.19 * 0.5 / 2, rel=1e-9)


def test_a_run_that_does_not_settle_fails(capsys, punch, monkeypatch):
    case = read_case(punch)
    loose = mdr.slide(case, 1e-5, n_springs=32, steps_per_period=64, n_periods=2, record=1)
    monkeypatch.setattr("mdr.slide", lambda *args, **knobs: replace(loose, settled=False, why="it drifts"))
    assert words_of(capsys, ["run", punch, "--v-0", "1e-5"], 1).err == "mdr: the run did not settle\n  it drifts\n"


# --- standard input, and what goes before the command ---


def given(monkeypatch, text):
    monkeypatch.setattr(sys, "stdin", TextIOWrapper(BytesIO(text.encode("utf-8")), encoding="utf-8"))


def test_a_case_may_come_from_standard_input(capsys, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "-").write_text("a file of this name is not meant")
    given(monkeypatch, Path(EXAMPLE).read_text(encoding="utf-8"))
    assert json_of(capsys, ["velocity", "-", "--json"])["v_c"] == mdr.critical_velocity(read_case(EXAMPLE))
    given(monkeypatch, "mu_0 = ")
    assert words_of(capsys, ["verdict", "-"], 2).err.startswith("mdr: standard input: line 1: ")
    given(monkeypatch, Path(EXAMPLE).read_text(encoding="utf-8"))
    assert "mdr: standard input: [axes] is missing" in words_of(capsys, ["sweep", "-", "--json"], 2).err
    monkeypatch.setattr(sys, "stdin", None)
    assert words_of(capsys, ["velocity", "-"], 2).err == "mdr: standard input: cannot be read: it is closed\n"


# --- completion ---


def completed(script, words):
    """What bash offers for the last of these words."""
    test = (
        f"COMP_WORDS=({' '.join(map(shlex.quote, words))}); COMP_CWORD={len(words) - 1}; _mdr; echo ${{COMPREPLY[@]}}"
    )
    done = subprocess.run(["bash", "-c", f"{script}\n{test}"], capture_output=True, text=True)
    assert done.stderr == ""
    return done.stdout.split()


@pytest.mark.skipif(which("bash") is None, reason="bash is not installed")
def test_bash_completes_commands_and_their_options(capsys):
    script = words_of(capsys, ["completion", "bash"]).out
    assert completed(script, ["mdr", "cu"]) == ["curve"]
    assert completed(script, ["mdr", "curve", "case.toml", "--p"]) == ["--points"]
    assert completed(script, ["mdr", "--json", "run", "--v"]) == ["--v-0"]
    assert completed(script, ["mdr", "completion", "f"]) == ["fish"]
    assert completed(script, ["mdr", "curve", "case"]) == []  # files, which the shell finds


def test_every_shell_is_told_every_command_and_option(capsys):
    for shell in ("bash", "zsh", "fish"):
        script = words_of(capsys, ["completion", shell]).out
        for word in ("velocity", "run", "sweep", "within", "chunk-seconds", "v-0"):
            assert word in script


# --- measure and verdict ---

FOUND = MeasuredVelocity(0.1, 0.0999, 0.1001, "end of stick", "all signs agree")
NOTHING = MeasuredVelocity(None, None, None, "none", "friction stays reduced")


class MadeUpVerdict:
    eq_15, full_slip, measured, deviation, holds, why = 0.1, 0.1, 0.1, 0.0, True, "one element"
    within, good, least, other_way = 0.01, True, 1e-5, None

    def __str__(self):
        return "Eq. (15) is good: one element"


@pytest.fixture
def judged(monkeypatch):
    """What `mdr.verdict` finds; `asked` is the tolerance that it was asked with."""
    found = MadeUpVerdict()

    def verdict(case, within, accuracy, three_dimensions):
        found.asked = within
        return found

    monkeypatch.setattr("mdr.verdict", verdict)
    return found


@pytest.mark.parametrize(("found", "status"), [(FOUND, 0), (NOTHING, 1)])
def test_measure(capsys, monkeypatch, found, status):
    monkeypatch.setattr("mdr.measure_critical_velocity", lambda case, direction, accuracy: found)
    assert found.why in words_of(capsys, ["measure", EXAMPLE], status).out
    assert json_of(capsys, ["measure", EXAMPLE, "--json"], status)["v_c"] == found.v_c


@pytest.mark.usefixtures("judged")
def test_verdict(capsys):
    assert words_of(capsys, ["verdict", EXAMPLE]).out.splitlines() == [
        "Eq. (15) is good: one element",
        "Eq. (15)   0.1 m/s     contact stiffness at the mean depth",
        "full slip  0.1 m/s     any amplitude, all harmonics of the force",
        "measured   0.1 m/s     from simulation alone",
        "deviation  +0.000e+00  measured over Eq. (15), less 1",
        "good       yes         to 1 %",
        "holds      yes         to the bracket of the measurement",
    ]
    answer = json_of(capsys, ["verdict", EXAMPLE, "--json"])
    assert (answer["holds"], answer["good"], answer["within"]) == (True, True, 0.01)
    assert answer["sentence"] == "Eq. (15) is good: one element"


def test_the_deviation_from_a_formula_that_vanishes_is_over_another_velocity(capsys, judged):
    judged.eq_15, judged.deviation = 1e-9, 3e3
    out = words_of(capsys, ["verdict", EXAMPLE]).out
    assert "deviation  +3.000e+03  measured less Eq. (15), over 1e-4 of Eq. (1)" in out


@pytest.mark.parametrize(
    ("options", "within"),
    [([], 0.01), (["--within", "1%"], 0.01), (["--within", "2.5 %"], 0.025), (["--within", "0.003"], 0.003),
     (["--within=1e-4"], 1e-4), (["--within", "99%"], 0.99)],
)  # fmt: skip
def test_a_tolerance_is_a_share_or_a_percentage(judged, options, within):
    assert main(["verdict", EXAMPLE, *options]) == 0
    assert judged.asked == pytest.approx(within, rel=1e-15)


@pytest.mark.parametrize(("measured", "holds", "status"), [(0.2, False, 0), (None, False, 1), (None, True, 0)])
def test_a_verdict_without_measurement_fails_unless_there_is_no_v_c(capsys, judged, measured, holds, status):
    judged.eq_15, judged.full_slip, judged.measured, judged.holds = np.inf, np.nan, measured, holds
    judged.deviation = judged.good = None
    assert "good       undefined" in words_of(capsys, ["verdict", EXAMPLE], status).out
    answer = json_of(capsys, ["verdict", EXAMPLE, "--json"], status)
    assert (answer["eq_15"], answer["full_slip"], answer["measured"], answer["good"]) == ("inf", None, measured, None)


# --- what goes wrong ---

NO_VELOCITY, NO_SHARE = (
    "a velocity wants m/s (or cm/s, mm/s, um/s, nm/s, mm/min, v_c), got",
    "must be a share above 0 and below 1",
)
#: what cannot be, and what standard error says of it
WRONG = [
    *((f"run {{punch}} --v-0 {v}", "--v-0 must be above zero") for v in ("0", "-1e-3", "-0.5v_c")),
    *((f"run {{punch}} --v-0 '{v}'", f"{NO_VELOCITY} '{v}'") for v in ("nan", "inf", "v_c", "", "1e-3km/s", "5 N")),
    ("curve {punch} --v-0 1e-3 ''", f"{NO_VELOCITY} ''"),
    ("find {punch} du_z --v-0 1mm/s --cof 70%", "in `mdr find` --share 70% of the friction without vibration"),
    ("run {punch} --v-0 1,5", "a velocity: 1,5 is no number, write 1.5 with a decimal point"),
    ("run {punch}", "the following arguments are required: --v-0"),
    ("run {punch} --v-0 1e-3 --n-springs 31", "argument --n-springs"),
    ("run {punch} --v-0 1e-3 --animate springs.png", "--animate must name a file that ends in .gif, got springs.png"),
    *((f"run {{punch}} --v-0 1e-3 --steps {n}", "argument --steps") for n in ("1e3", "9" * 5000)),
    ("run {punch} --v-0 1e-3 --accuracy 0.1", "argument --accuracy"),
    ("curve {punch} --v-0 -1e-3", "must not be negative, got -0.001 m/s"),
    ("curve {punch} --v-0 1e-3 --points 3", "--v-0 names every velocity"),
    ("curve {resonant} --v-0 0.5v_c", "v_c is infinite here; give the velocity in m/s"),
    *((f"curve {{punch}} --points {n}", "argument --points") for n in ("1", "9" * 5000)),
    *((f"curve {{punch}} --up-to {v}", "argument --up-to") for v in ("nan", "x", "2 mm")),
    ("curve {punch} --up-to 0", "--up-to must be above zero"),
    ("curve {punch} --point 3", "--point is no option; did you mean --points?"),
    ("run {punch} --v0 1mm/s", "--v0 is no option; did you mean --v-0?"),
    ("--jso velocity {punch}", "--jso is no option; did you mean --json?"),
    ("velcity {punch}", "'velcity' is no command; did you mean velocity?"),
    ("shapes Coen", "'Coen' is no shape, material or motion; did you mean Cone?"),
    ("case --example ball", "did you mean Sphere?"),
    ("curve", "the following arguments are required"),
    *((f"verdict {{punch}} '--within={v}'", f"argument --within: {NO_SHARE}, such as 1% or 0.01, got '{v}'")
      for v in ("0", "-0.01", "-1%", "nan", "inf", "1", "100%", "nan%", "1%%", "%", "", "one", "0,01")),
    ("velocity {study}", "[axes] makes it a study file, not a case file; `mdr sweep` reads it"),
    *((f"export {{punch}} -o {one}", "must end in .h") for one in ("contact.txt", "contact")),
    *((f"export {{punch}} -o {one}.h", "a word for names in C") for one in ("2nd", "a-b", "_a", "größe", "a" * 41)),
    ("export {punch} -o no/such/folder/a.h", "there is no folder"),
    *((f"export {{punch}} -o a.h --u-z-max {one}", "a depth above zero") for one in ("-1e-6", "nan", "deep")),
    *((f"export {{punch}} -o a.h --n-springs {n}", "a whole number from 16") for n in ("2", "100000")),
    ("export {punch}", "required"),
    ("half-space {punch} --v-0 -1e-4", "--v-0 must be above zero"),
    ("half-space {punch} --v-0 1e-4 --cells 3", "a whole number from 8"),
    ("fit {punch} {data} --free taw", "taw is no parameter of this case"),
    ("fit {punch} {data} --free mu_0 --bounds mu_0=0.1-1", "must be name=low:high, such as material.tau=1e-5:1e-1"),
    ("fit {punch} {data} --free mu_0 -o {data}", "data.csv: no folder to write to"),
    ("fit - - --free mu_0", "standard input can be read once"),
    ("fit {punch} {data}", "the following arguments are required: --free"),
    ("find {punch} du_y --v-c 1", "du_y is no parameter"),
    *((f"find {{punch}} {words}", "give one wish") for words in ("du_z --v-0 1", "E")),
    ("find {punch} du_z --v-c 1 --within '1 s' '2 s'", "--within wants m (or cm"),
    ("design {punch} --cof 0.2 --up-to 1mm/s", "required: --free"),
    *((f"design {{punch}} --v-c 1mm/s --free {one}", "path=low:high") for one in ("du_z", "du_z=1um", "=1um:2um")),
    ("design {punch} --v-c 1mm/s --free du_z=1s:2s", "du_z wants m"),
    ("design {punch} --v-c 1mm/s --free lode=1N:2N", "lode is no parameter"),
    ("design {punch} --free du_z=1um:2um", "a target wants a limit"),
    *((f"{asked}=1um:2um du_z=3um:4um", "du_z and du_z set the same; keep one of the two")
      for asked in ("design {punch} --v-c 1mm/s --free du_z", "front {punch} --up-to 1mm/s --free du_z")),
    ("propagate {punch} --spread du_z=1% du_z=2%", "du_z and du_z set the same"),
    ("design {punch} --cof 20% --up-to 1mm/s --free du_z=1um:2um", "as 0.2 or 0.7mu_0, or in `mdr find` --share 20%"),
    ("design {punch} --cof 0.2 --free du_z=1um:2um", "cof_at_most wants up_to"),
    ("design {punch} --power 3J --up-to 1mm/s --free du_z=1um:2um", "a power wants W"),
    ("front {punch} --up-to 1mm/s --free du_z=1um:2um -n 1", "whole number from 2"),
    ("tolerance {punch} --v-0 10mm/s --fields lode", "lode"),
    ("sensitivity {punch} --fields lode", "lode"),
    ("sensitivity {punch} --v-0 10s", "--v-0"),
    ("sensitivity {punch} --v-0 -1e-4", "the same both ways"),
    ("propagate {punch}", "the following arguments are required: --spread"),
    *((f"propagate {{punch}} --spread {one}", f"must be path=standard deviation, such as mu_0=5%, got '{one}'")
      for one in ("mu_0", "mu_0=")),
    ("propagate {punch} --spread mu_0=5s", "spread of mu_0 wants a pure number"),
    ("propagate {punch} --spread mu_0=5% --samples 3", "a whole number from 30"),
    *((f"explore --address {one}", "must be localhost:8080") for one in ("8080:", "ftp://x", "http://",
      "localhost:99999")),
    ("explore {data}", "mdr: data.csv: line 1: "),
    ("explore --port 65536", "must be a whole number from 0 to 65535, got '65536'"),
    ("sweep {study}", "mdr: the study would be lost: give -o folder, --store folder, or --json"),
    ("sweep {study} -o study.txt", "mdr: study.txt: a study is written as .nc or .csv"),
    ("sweep {study} -o /nowhere/study.nc", "mdr: /nowhere/study.nc: there is no folder /nowhere"),
    ("sweep {study} --store {punch}", ": is a file; a store is a folder"),
    *((f"sweep {{study}} --store store -o {one}", f"mdr: {words}: the store keeps its own study.nc there")
      for one, words in (("store", "store"), ("./store/study.nc", "store/study.nc"))),
    ("sweep {study} --json --shard 1/2", "mdr: a shard needs a store"),
    ("'no such'", "'no such' is no command; there are velocity, run, "),
    *((nothing, word) for nothing in ("", "--json") for word in ("velocity", "verdict")),  # the help
]  # fmt: skip


@pytest.mark.parametrize(("line", "words"), WRONG, ids=[line[:40] or "nothing" for line, _ in WRONG])
def test_what_cannot_be_asked_is_status_2_and_found_before_any_work(
    capsys, monkeypatch, tmp_path, punch, resonant, line, words
):
    for work in ("slide", "cof_curve", "verdict", "studies.points.compute", "half_space.slide"):
        monkeypatch.setattr(f"mdr.{work}", None)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "data.csv").write_text("v_0 [mm/s], cof, error\n0.1, 0.30, 0.01\n0.4, 0.36, 0.01\n0.8, 0.39, 0.01\n")
    before = set(tmp_path.iterdir())
    study = Path(EXAMPLE).with_name("study.toml")
    try:
        status = main(shlex.split(line.format(punch=punch, resonant=resonant, study=study, data="data.csv")))
    except SystemExit as end:
        status = end.code
    out, err = capsys.readouterr()
    assert (status, out) == (2, "")
    assert words in err
    assert set(tmp_path.iterdir()) == before


@pytest.mark.parametrize(
    ("line", "words"),
    [("--version", f"mdr {mdr.__version__}\n"), ("verdict --help", "(default: 1%)"), ("help", "half-space"),
     ("help verdict", "(default: 1%)"), ("run --help", "`mdr case > case.toml` makes one")],
)  # fmt: skip
def test_help_and_version_are_no_faults(capsys, line, words):
    with pytest.raises(SystemExit) as end:
        main(line.split())
    assert end.value.code == 0
    assert words in capsys.readouterr().out


def test_a_wrong_file_is_status_2_with_every_fault(capsys, tmp_path):
    path = tmp_path / "case.toml"
    path.write_text("mu0 = 3")
    out, err = words_of(capsys, ["verdict", str(path), "--json"], 2)
    assert out == ""
    assert len(err.splitlines()) == 5
    assert all(line.startswith(f"mdr: {path}: ") for line in err.splitlines())


@pytest.mark.parametrize(
    "line",
    ["curve {punch} --points 2", "tolerance {punch} --v-0 1mm/s --fields mu_0", "record motion.csv {punch}"],
)
def test_a_full_disk_names_the_file_and_its_disk_and_costs_no_result(capsys, punch, tmp_path, monkeypatch, line):
    def full(path, data):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("mdr.cof_curve", made_up_curve)
    monkeypatch.setattr("mdr.commands.written.write_whole", full)
    Path("motion.csv").write_text("t [ms], u_x [um], u_z [um]\n0, 0, 2\n1, 1, 2\n2, 0, 2\n")
    command = line.format(punch=punch).split()
    out, err = words_of(capsys, [*command, "-o", "out"], 1)
    assert len(out.splitlines()) > 2
    file = f"out/{command[0]}.csv"
    said = rf"mdr: {file}: cannot be written: No space .*; .* MB are free on the disk of .*"
    assert re.fullmatch(said, err.splitlines()[-1])  # a motion may be compiled before


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device of Linux")
def test_a_full_disk_under_standard_output_is_not_a_fault_of_the_case():
    with open("/dev/full", "w") as full:
        command = [sys.executable, "-m", "mdr", "velocity", EXAMPLE]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True)
    assert done.returncode == 1
    assert done.stderr == "mdr: standard output: cannot be written: No space left on device\n"


def test_a_folder_that_cannot_be_is_found_before_the_work(capsys, tmp_path):
    (tmp_path / "out" / "curve.csv").mkdir(parents=True)
    assert main(["curve", EXAMPLE, "-o", str(tmp_path / "out")]) == 2
    assert "curve.csv: is a folder, where a file is to be written" in capsys.readouterr().err
    assert main(["curve", EXAMPLE, "-o", "/proc/self"]) in (1, 2)  # root may write anywhere, but not there
    assert "Traceback" not in capsys.readouterr().err


def test_without_panel_the_explorer_says_how_to_install_it(capsys, monkeypatch):
    monkeypatch.delitem(sys.modules, "mdr.explorer.server", raising=False)
    monkeypatch.setitem(sys.modules, "panel", None)
    assert words_of(capsys, ["explore"], 2).err.endswith(": pip install panel bokeh\n")  # a wheel has no checkout


@pytest.mark.parametrize(
    ("failure", "status", "message"),
    [(ValueError("no such motion"), 1, f"mdr: {EXAMPLE}: no such motion\n"),
     (MemoryError(), 1, f"mdr: {EXAMPLE}: MemoryError\n"),
     (KeyboardInterrupt(), 130, "mdr: interrupted before it was done\n")],
    ids=["refused", "memory", "interrupt"],
)  # fmt: skip
def test_work_that_fails_ends_in_a_sentence(capsys, monkeypatch, failure, status, message):
    def fail(case, within, accuracy, three_dimensions):
        raise failure

    monkeypatch.setattr("mdr.verdict", fail)
    assert words_of(capsys, ["verdict", EXAMPLE], status).err == message


def test_a_terminal_that_lacks_a_letter_still_shows_the_rest(tmp_path):
    path = tmp_path / "ä.toml"
    path.write_text(mdr.write_case(read_case(EXAMPLE)).replace("R =", "r ="))
    command, terminal = [sys.executable, "-m", "mdr", "velocity", str(path)], {"PYTHONIOENCODING": "ascii"}
    done = subprocess.run(command, env=os.environ | terminal, capture_output=True, text=True)
    assert done.returncode == 2
    assert "\\xe4.toml: [indenter] r is no key of Paraboloid; did you mean R?" in done.stderr


# --- shapes and case ---


def test_shapes_names_all_that_a_file_can_name(capsys):
    shown = words_of(capsys, ["shapes"]).out
    for name in ("[indenter]", "Cone", "Sphere", "[material]", "Prony", "LoadOscillation", "[pull]", "k_x"):
        assert name in shown
    lines = words_of(capsys, ["shapes", "Cone"]).out.splitlines()
    assert [line.split()[0] for line in lines] == ["[indenter]", "Cone", "theta"]
    told = json_of(capsys, ["shapes", "--json"])
    assert told["indenter"]["Cone"]["keys"]["theta"] == {"unit": "rad", "meaning": "angle between flank and plane"}
    assert all(one["is"] for table in ("indenter", "material", "oscillation") for one in told[table].values())


def test_an_example_goes_through_the_other_commands(tmp_path, capsys):
    path, parts = tmp_path / "case.toml", ["--example", "flat_punch", "--material", "elastic", "--pull", "RigidPull"]
    path.write_text(words_of(capsys, ["case", *parts]).out, encoding="utf-8")
    assert json_of(capsys, ["velocity", str(path), "--json"])["v_c"] > 0


@pytest.mark.filterwarnings("always::mdr.PlausibilityWarning")
def test_what_is_unlikely_is_said_on_standard_error_and_computed(tmp_path, capsys):
    file = file_of(replace(read_case(EXAMPLE), indenter=mdr.Cone(theta=1.0)), tmp_path / "steep.toml")
    said = words_of(capsys, ["velocity", file])
    assert said.err.startswith("mdr: warning: the surface of Cone has slope 1.56")
    assert "Eq. (" in said.out
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert words_of(capsys, ["velocity", file]).err == ""


def test_what_a_shaken_contact_holds_at_rest_is_told_to_machines(capsys, punch):
    case = replace(read_case(punch), shake=mdr.InPlaneOscillation(omega=100.0, du_x=2e-7))
    file_of(case, Path(punch))
    for command in ("measure", "verdict"):
        told = json_of(capsys, [command, "--json", "--accuracy", "1e-3", punch])
        band = mdr.holding_band(case)
        assert told["holding_band"] == [band.low, band.high]
        assert {"blocked_cof", "no_load_velocity", "other_way"} <= set(told)
    for command in (["velocity"], ["curve", "--points", "3"]):
        told = json_of(capsys, [*command, "--json", punch])
        assert told["holding_band"] == [band.low, band.high]
        assert told["v_c_back"] == mdr.critical_velocity(case, -1)


def test_a_multiple_of_v_c_the_other_way_is_of_that_ways_own(capsys, punch):
    case = replace(read_case(punch), shake=mdr.InPlaneOscillation(omega=100.0, du_x=2e-7))
    file_of(case, Path(punch))
    told = json_of(capsys, ["run", punch, "--json", "--accuracy", "1e-3", "--v-0", "-0.5v_c"])
    assert told["v_0"] == pytest.approx(-0.5 * mdr.critical_velocity(case, -1), rel=1e-12)


SPOOL = """
mu_0 = 0.15
[indenter]
shape = "FlatPunch"
a = "1 mm"
[material]
model = "Elastic"
E = "115 GPa"
nu = 0.3
[oscillation]
load = "5 N"
[pull]
k_x = "20 N/mm"
m = "30 g"
c_x = 5
[shake]
frequency = "120 Hz"
du_x = "20 um"
at = "pull"
"""


def test_what_is_printed_of_rest_is_of_the_pull_that_the_case_has(tmp_path, capsys):
    path = tmp_path / "spool.toml"
    path.write_text(SPOOL)
    told = json_of(capsys, ["velocity", "--json", str(path)])
    assert_allclose(told["holding_band"], [-0.0686, 0.0686], atol=5e-5)
    assert told["blocked_band"] == told["holding_band"]
    assert 0 < told["holding_band_error"] < 1e-6
    assert told["no_load_velocity"] == 0
    assert told["chi"] == pytest.approx(0.5427, abs=1e-4)
    rows = {line.split()[0]: line for line in words_of(capsys, ["velocity", str(path)]).out.splitlines()}
    assert "under its own pull, whose far end is shaken" in rows["band"]
    assert "±" not in rows["band"]
    assert "blocked" not in rows  # the same
    run = words_of(capsys, ["run", str(path), "--v-0", "0"])
    assert "`mdr velocity` for all that it holds" in " ".join(run.out.split())
    assert "force that shakes the stuck contact, over full friction of 0.75 N" in rows["chi"]
    command = ["curve", str(path), "--points", "5", "--json", "-o", str(tmp_path / "out")]
    curve = json_of(capsys, command)
    assert curve["v_0"][2] == 0
    assert all(curve["settled"])
    assert curve["static_cof"] == curve["holding_band"][1] == curve["cof"][2]
    path.write_text(
        SPOOL.replace('shape = "FlatPunch"\na = "1 mm"', 'shape = "Paraboloid"\nR = "20 mm"').replace(
            "115 GPa", "30 MPa"
        )
    )
    rows = {line.split()[0]: line for line in words_of(capsys, ["velocity", str(path)]).out.splitlines()}
    told = json_of(capsys, ["velocity", "--json", str(path)])
    assert f" ± {told['holding_band_error']:.2g} " in rows["band"]
    path.write_text(SPOOL.replace('"pull"', '"tool"'))
    rows = {line.split()[0]: line for line in words_of(capsys, ["velocity", str(path)]).out.splitlines()}
    assert "under a rigid pull that stands still" in rows["band"]
    assert "over the deflection at which springs slip, of a tool" in rows["chi"]


@pytest.fixture
def across(tmp_path):
    """A contact that is shaken across the pull and up and down."""
    depth = mdr.NormalOscillation(u_z0=20e-6, du_z=10e-6, omega=300.0)
    shake = mdr.InPlaneOscillation(omega=300.0, du_y=10e-6)
    case = mdr.SlidingContact(mdr.FlatPunch(a=1e-3), mdr.Elastic(E=3e6, nu=0.5), 0.4, depth, shake=shake)
    return file_of(case, tmp_path / "across.toml")


def test_velocity_of_a_shake_across_has_its_group_and_what_stands_in_the_place_of_v_c(capsys, across):
    case = read_case(across)
    told = json_of(capsys, ["velocity", "--json", across])
    assert told["eta"] == pytest.approx(10e-6 / (0.4 * case.material.mindlin_ratio * 20e-6))
    assert (told["v_c"], told["v_c_back"], told["fastest_across"]) == ("inf", "inf", pytest.approx(3e-3))
    assert "nearly_full" not in told  # a law of a constant depth
    alone = replace(case, oscillation=mdr.ConstantDepth(u_z0=20e-6))
    full = json_of(capsys, ["velocity", "--json", file_of(alone, Path(across))])["nearly_full"]
    assert mdr.laws.lost_across(alone, full) == pytest.approx(0.01)


def test_a_verdict_that_is_the_same_both_ways_is_said_once(capsys, across):
    said = words_of(capsys, ["verdict", across]).out
    assert said.startswith("Both ways: ")
    assert said.count("Shaken across the pull") == said.count("full slip") == 1
    assert "the other way:" not in said


def test_the_cof_across_is_told_and_written(tmp_path, capsys, across):
    run = json_of(capsys, ["run", "--json", "--accuracy", "1e-3", "--v-0", "1e-3", across])
    assert run["cof_y"] == pytest.approx(run["mean_F_y"] / run["mean_F_z"])
    assert run["cof_y"] > 0.01
    command = ["curve", across, "--accuracy", "1e-3", "--v-0", "-1e-3", "1e-3", "-o", str(tmp_path)]
    out = words_of(capsys, command).out
    assert out.startswith("v_c = infinite either way by Eq. (1): friction is full at no velocity, mu_0")
    rows = [line.split() for line in out.splitlines() if line.strip().startswith(("-0.001", "0.001"))]
    assert [float(row[-1]) for row in rows] == pytest.approx([run["cof_y"]] * 2, abs=2e-3)
    assert float(rows[0][2]) == -float(rows[1][2])
    assert "cof_y [-]" in (tmp_path / "curve.csv").read_text(encoding="utf-8")


def test_files_that_are_there_are_named_before_they_are_overwritten(capsys, punch, tmp_path, monkeypatch):
    monkeypatch.setattr("mdr.cof_curve", made_up_curve)
    (tmp_path / "curve.csv").write_text("mine")
    said = words_of(capsys, ["curve", punch, "--points", "2", "-o", str(tmp_path)]).err
    assert said == f"mdr: will be overwritten: {tmp_path / 'curve.csv'}\n"
    assert "mine" not in (tmp_path / "curve.csv").read_text(encoding="utf-8")


def test_a_command_in_no_encoding_is_kept_all_the_same(punch, tmp_path):
    folder = tmp_path / "m\udcff"
    assert main(["curve", punch, "-o", str(folder), "--points", "2"]) == 0
    assert "m\\udcff" in (folder / "curve.csv").read_text(encoding="utf-8")


def test_every_function_of_options_is_that_of_a_command():
    works = {command.work for command in COMMANDS.values()}
    for module in {work.partition(":")[0] for work in works}:
        names = vars(import_module(f"mdr.commands.{module}"))
        of = {
            f"{module}:{name.removeprefix('add_options_of_')}" for name in names if name.startswith("add_options_of_")
        }
        assert of <= works
