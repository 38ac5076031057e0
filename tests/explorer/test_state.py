"""What is explored, without a browser: every kind of every part, links, scripts, controls, pictures, threads."""

import os
import subprocess
import sys
import threading
from dataclasses import replace
from urllib.parse import parse_qsl

import numpy as np
import pytest
from chromium import PATIENCE
from numpy.testing import assert_allclose, assert_array_equal

import mdr
from mdr.case.contact import KINDS
from mdr.case.paths import GROUPS, SET, facts_at
from mdr.explorer.controls import HIDDEN, controls_of
from mdr.explorer.latest import Latest
from mdr.explorer.lines import line_of
from mdr.explorer.links import link_of, meaning_of, python_of, state_of, typed
from mdr.explorer.pictures import pictures_of
from mdr.explorer.springs import DIRECTIONS, map_of
from mdr.explorer.state import State, group_values
from mdr.files.examples import PARTS, WAVEFORMS, example, example_file
from mdr.plots import MODES
from mdr.tools.fields import fields_of
from mdr.tools.notation import UNITS
from mdr.tools.progress import Ended

CASES = {
    "rigid": example(pull="RigidPull"),
    "body": example(),
    "load": example(motion="LoadOscillation", material="Prony"),
    "oblique": example(shake="InPlaneOscillation"),
    "constant": example(motion="ConstantDepth", pull="RigidPull"),
    "across": replace(
        example(motion="ConstantDepth", pull="RigidPull", material="Elastic"),
        shake=mdr.InPlaneOscillation(314.159, du_y=1e-5),
    ),
    "series": example(motion="PeriodicMotion", shake="InPlaneMotion", material="Elastic"),
}


@pytest.fixture(params=CASES.values(), ids=CASES)
def state(request):
    return State.of(request.param)


def test_every_kind_can_be_chosen_and_keeps_what_it_shares():
    body = State.of(CASES["body"])
    for slot in KINDS:
        for kind in PARTS[slot]:
            after = body.changed(slot, kind)
            assert after.value(slot) == ("PeriodicMotion" if kind in WAVEFORMS else kind)
            if slot == "material" and kind != "ElasticPair":
                assert after.case.material.nu == body.case.material.nu
            if kind in WAVEFORMS:  # it falls as far below the same mean
                depth = after.case.oscillation.u_z(np.linspace(0, after.case.oscillation.period, 2001))
                sine = body.case.oscillation
                assert_allclose([depth[:-1].mean(), depth.min()], [sine.u_z0, sine.u_z0 - sine.du_z], rtol=1e-4)
    still = body.changed("oscillation", "ConstantDepth")
    assert still.case.is_shaken  # else nothing would move
    assert not still.changed("oscillation", "Sawtooth").case.is_shaken
    square = body.changed("oscillation.du_z", 6e-6).changed("oscillation", "Square")
    saw = square.changed("oscillation", "Sawtooth").case.oscillation
    assert_allclose(-saw.cycle.unit * saw.cycle.least, 6e-6, rtol=1e-9)
    heavy = body.changed("oscillation", "LoadOscillation").case
    assert_allclose(mdr.resolved(heavy).working_depth, body.case.working_depth, rtol=0.05)  # two digits of the load


def test_a_kind_that_comes_back_has_the_fields_that_it_had():
    state = State.of(CASES["body"]).changed("pull.k_x", 12345.0).changed("material.tau", 7e-4)
    away = state.changed("pull", "RigidPull").changed("material", "Elastic").changed("material.E", 2e6)
    back = away.changed("pull", "SpringPull").changed("material", "KelvinVoigt").case
    assert back == replace(state.case, material=replace(state.case.material, E=2e6))
    constant = state.changed("oscillation", "ConstantDepth")
    assert constant.changed("oscillation", "NormalOscillation").case == state.case  # without what it shook instead
    own = constant.changed("shake.du_x", 1e-6).changed("oscillation", "NormalOscillation").case
    assert own.shake.du_x == 1e-6


def test_a_link_carries_the_state(state):
    grouped = replace(state, in_groups=True)
    for one in (state, grouped):
        assert state_of(dict(parse_qsl(link_of(one)))) == one


def test_a_wrong_link_says_what_is_wrong():
    with pytest.raises(mdr.CaseFileError, match="did you mean Cone"):
        state_of({"mu_0": "0.4", "indenter.shape": '"Kone"'})
    with pytest.raises(ValueError, match="v_0 must be positive"):
        state_of(dict(parse_qsl(link_of(State.of(CASES["body"])))) | {"v_0": "-1"})


def test_script_and_file_make_the_case(state):
    names = {}
    exec(python_of(state).partition("curve =")[0], names)
    assert (names["case"], names["v_0"]) == (state.case, state.v_0)
    assert mdr.parse_case(example_file(state.case)) == state.case


@pytest.mark.parametrize("value", [20e-6, 3e6, 0.05, 314.16, -2e-6, 0.0, 1e-3, 12345.0, 1e-30, 1e30])
def test_numbers_are_written_as_one_types_them(value):
    assert meaning_of(typed(value)) == pytest.approx(value, rel=1e-12)
    for unit in UNITS:
        assert meaning_of(typed(value, unit), "x", unit) == pytest.approx(value, rel=6e-5)  # five digits, of any unit
        assert meaning_of(typed((value, 2.0), unit), "x", unit) == pytest.approx([value, 2.0], rel=6e-5)


@pytest.mark.parametrize("in_groups", [False, True], ids=["SI", "groups"])
def test_every_field_has_a_control_with_its_unit_and_meaning(state, in_groups):
    state = replace(state, in_groups=in_groups)
    found = [control for controls in controls_of(state).values() for control in controls]
    for control in found:
        assert control.facts.meaning
        if control.path in GROUPS:
            assert control.facts == facts_at(control.path)
        if control.grid:
            assert list(control.grid) == sorted(set(control.grid))
            assert control.grid[0] <= control.value <= control.grid[-1]
            assert state.changed(control.path, control.value).case.mu_0 == state.case.mu_0
    given = {
        name if slot == "friction" else f"{slot}.{name}"
        for slot in KINDS
        for name in fields_of(getattr(state.case, slot))
        if name not in HIDDEN
    }
    groups = {SET[path].fields[0] for path in group_values(state.case)} if in_groups else set()
    paths = {control.path for control in found}
    assert given - groups <= paths
    assert not groups & paths


def test_what_is_typed_beyond_the_grid_moves_it():
    state = State.of(CASES["body"]).changed("indenter.R", 7.0)
    control = controls_of(State.of(CASES["body"]))["indenter"][0].of(state)
    assert control.grid[control.place] == pytest.approx(7.0)
    wild = State.of(CASES["body"]).changed("oscillation.du_z", 1.9e-5)  # v_c is ten times what it was
    assert controls_of(State.of(CASES["body"]))[""][0].of(wild).grid[-1] > mdr.critical_velocity(wild.case)


def test_groups_are_held_while_fields_change():
    state = replace(State.of(CASES["oblique"]), in_groups=True)
    before, ratio = group_values(state.case), state.value("v_0/v_c")
    for path, value in (("material.E", 1e6), ("oscillation.u_z0", 3e-5), ("oscillation.omega", 500.0), ("mu_0", 0.3)):
        state = state.changed(path, value)
        assert group_values(state.case) == pytest.approx(before, rel=1e-9)
        assert state.value("v_0/v_c") == pytest.approx(ratio, rel=1e-9)
    after = state.changed("alpha", 0.2)
    assert after.case.alpha == pytest.approx(0.2)


def test_a_shake_follows_the_frequency_of_the_oscillation():
    after = State.of(CASES["oblique"]).changed("oscillation.omega", 100.0)
    assert after.case.shake.omega == 100.0


def test_a_case_that_is_refused_as_a_whole_is_no_state():
    """3 Pa for 3 MPa: each part is right, but the load is more than the sphere carries. The state before stays."""
    ball = mdr.SlidingContact(mdr.Sphere(5e-3), mdr.Elastic(3e6, 0.5), 0.5, mdr.LoadOscillation(1.0, 0.1, 300.0))
    state = State.of(ball)
    with pytest.raises(ValueError, match="is more than Sphere"):
        state.changed("material.E", 3.0)
    assert state.changed("oscillation.dF_z", 0.2).case.oscillation.dF_z == 0.2


def test_pictures_are_those_of_the_library(state):
    pictures = [*pictures_of(state)]
    first, last = next(one for one in pictures if one.cof is not None), pictures[-1]
    exact = mdr.cof_curve(state.case, last.v_0[::7], accuracy=1e-4)
    assert_allclose(last.cof[::7], exact.cof, atol=1e-3 * state.case.mu_0)
    assert_allclose(first.cof[::7], exact.cof, atol=0.05 * state.case.mu_0)  # no bound: a first sight
    assert abs(last.run.cof - mdr.slide(state.case, state.v_0).cof) <= 1e-3 * state.case.mu_0
    modes = map_of(last.run)
    assert modes.shape == (last.run.n_springs, last.run.steps_per_period)
    modes = np.where(modes >= len(MODES), mdr.State.SLIP, modes)  # one of the directions of slip
    assert_array_equal(np.unique(modes), np.unique(last.run.state))
    assert (last.band is not None) == state.case.is_shaken
    assert all(name and value and meaning for name, value, meaning in last.numbers)


def test_the_first_picture_compiles_nothing(tmp_path):
    code = (
        "from mdr.explorer import pictures, state; from mdr.files.examples import example; "
        "from mdr.tools.compiling import TALLY; "
        "one = pictures.at_once(state.State.of(example())); print(one.rigid.size, TALLY.done, TALLY.open)"
    )
    empty = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    said = subprocess.run([sys.executable, "-c", code], env=empty, capture_output=True, text=True, check=True).stdout
    points, compiled, more = said.split()
    assert int(points) > 10
    assert (compiled, more) == ("0", "0")


def test_the_run_lies_on_its_curve_and_the_line_on_the_points(state):
    picture = [*pictures_of(replace(state, v_0=state.v_0 / 3))][-1]
    at = picture.v_0 == picture.run.v_0
    assert_allclose(picture.cof[at], [picture.run.cof], atol=2e-3 * state.case.mu_0)  # two bounds of 1e-3
    line = line_of(picture.v_0, picture.cof)
    drawn = np.isin(line["v_0"], picture.v_0)
    assert_array_equal(line["v_0"][drawn], picture.v_0)
    assert_allclose(line["cof"][drawn], picture.cof, rtol=1e-12)


def test_a_line_is_broken_where_friction_jumps():
    v, cof = np.array([0.2, 0.4, 0.8, 1.2, 1.6]), np.array([0.4, 0.5, 0.6, 0.5, 0.5])
    line = line_of(v, cof, jumps=[1.0])
    x, y = line["v_0"], line["cof"]
    assert not np.any((x > 0.8) & (x < 1.2))
    assert np.isnan(y[np.flatnonzero(x == 0.8)[-1] + 1])
    assert np.nanmax(y) == 0.6


def test_only_the_latest_request_is_answered():
    begun, go, answered, done = threading.Event(), threading.Event(), [], threading.Event()

    def work(request, watch):
        begun.set()
        go.wait(PATIENCE)
        watch()
        if request == "wrong":
            raise ValueError(request)
        yield request

    def deliver(request, answer):
        answered.append((request, answer))
        if answer is None or isinstance(answer, Exception):
            done.set()

    latest = Latest(work, deliver)
    latest.ask("first")
    begun.wait(PATIENCE)
    for request in ("second", "third"):
        latest.ask(request)
    go.set()
    assert done.wait(PATIENCE)
    assert answered == [("third", "third"), ("third", None)]
    done.clear()
    begun.clear()
    go.clear()
    latest.ask("dropped")
    begun.wait(PATIENCE)
    latest.drop()
    go.set()
    with latest.at_work:  # its work has ended before another is asked for, which would end it too
        latest.ask("wrong")
    assert done.wait(PATIENCE)
    assert [request for request, _ in answered] == ["third", "third", "wrong"]
    assert isinstance(answered[-1][1], ValueError)


def test_a_picture_is_dropped_on_the_way():
    def watch():
        raise Ended

    with pytest.raises(Ended):
        list(pictures_of(State.of(CASES["body"]), watch))


def test_what_is_unlikely_is_said_beside_the_numbers():
    case = replace(example(), oscillation=mdr.NormalOscillation(u_z0=2e-6, du_z=20e-6, omega=300.0))
    picture = next(pictures_of(State.of(case)))
    assert picture.doubts == mdr.plausibility(case) != ()


def test_shaken_across_every_slip_has_its_direction():
    state = State.of(CASES["across"])
    _, first, *_ = pictures_of(state)
    run, shown = first.run, map_of(first.run)
    angle = np.degrees(np.arctan2(run.f_y, run.f_x)).T
    inmost, width = np.argmin(run.x), 360 / DIRECTIONS
    slips = run.state[:, inmost] == mdr.State.SLIP
    drawn = width * (shown[0, slips].astype(float) - len(MODES) + 0.5) - 180
    assert np.max(np.abs(drawn - angle[inmost, slips])) <= width / 2
    rows = {name: (value, meaning) for name, value, meaning in first.numbers}
    assert rows["v_c"] == ("infinite", "shaken across, friction is full at no velocity")
    assert float(rows["COF across"][0]) == pytest.approx(run.cof_y, abs=run.cof_error)
    assert "v_c, other way" not in rows


def test_a_body_that_is_guided_across_keeps_its_groups_when_its_pull_is_shaken():
    shaken = replace(example(shake="InPlaneOscillation").shake, at="pull")
    state = replace(State.of(replace(CASES["oblique"], shake=shaken)), in_groups=True)
    assert state.changed("alpha", 0.2).value("alpha") == pytest.approx(0.2)
