"""Results compare and hash by value, survive pickling, cannot be written to, and print as lines, never as arrays."""

import pickle
import re
from dataclasses import replace
from functools import partial
from html import unescape

import numpy as np
import pytest
from conftest import contact, unit_of_velocity

import mdr
from mdr.closed_forms.rigid_pull import average_friction
from mdr.friction.measured_velocity import MeasuredVelocity
from mdr.tools.records import ArrayRecord
from mdr.tools.summary import Summary, lines_of, number, span, with_error

CASE = contact("cone", 2.0)
V_0 = 0.5 * unit_of_velocity(CASE)
BAND = mdr.Spectrum.band(rms=2e-6, f_low=50.0, f_high=100.0)
RUBBER, BALL = mdr.Elastic(E=3e6, nu=0.5), mdr.Paraboloid(R=5e-3)
#: what is asked at velocities
AT = {
    "run": lambda v: mdr.slide(CASE, v, n_springs=32, steps_per_period=64, n_periods=8, record=1),
    "curve": lambda v: mdr.cof_curve(CASE, v * np.linspace(0, 2, 500)),
    "springs": lambda v: mdr.SpringArray.of(CASE, 16 + int(v / V_0)),
    "random": lambda v: mdr.random_cof(CASE, BAND, [v, 2 * v], n_realisations=8),
    "half-space": lambda v: mdr.half_space.slide(CASE, v, cells=9, steps_per_period=12, n_periods=1),
}


@pytest.mark.parametrize("make", [*AT.values(), lambda v: average_friction(CASE, [v])], ids=[*AT, "friction"])
def test_equal_by_value(make):
    one, two, other = make(V_0), make(V_0), make(3 * V_0)
    assert one == two
    assert hash(one) == hash(two)
    assert one != other
    again = pickle.loads(pickle.dumps(one))
    assert again == one
    assert hash(again) == hash(one)
    assert len({one, two, other, again}) == 2


def test_arrays_are_read_only():
    run = AT["run"](V_0)
    for array in (run.F_x, run.state, mdr.SpringArray.of(CASE).gap):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0


def test_arrays_of_other_shape_or_kind_differ():
    run = AT["run"](V_0)
    bare = mdr.slide(CASE, V_0, n_springs=32, steps_per_period=64, n_periods=8)
    assert run != bare  # None against arrays
    assert bare.cof == run.cof
    assert isinstance(run.F_x, np.ndarray)


def test_an_array_that_somebody_gave_stays_his():
    v_0 = V_0 * np.array([0.0, 1.0])
    curve = mdr.cof_curve(CASE, v_0)
    v_0[0] = V_0
    assert curve.v_0[0] == 0
    with pytest.raises(ValueError, match="read-only"):
        pickle.loads(pickle.dumps(curve)).cof[...] = 0


def pressed():
    return mdr.indent(BALL, RUBBER, np.linspace(0, 1e-2, 2000), np.linspace(0, 1e-5, 2000), n_springs=64)


def pulled():
    return mdr.partial_slip(BALL, RUBBER, 0.4, 20e-6, np.linspace(0, 3e-5, 300))


MAKE = {
    **{kind: partial(make, V_0) for kind, make in AT.items()},
    "case": lambda: CASE,
    "indentation": pressed,
    "pull": pulled,
    "loop": lambda: mdr.tangential_loop(BALL, RUBBER, 0.4, 20e-6, 4e-6),
    "fields": lambda: mdr.surface_fields(pulled(), i=100),
    "data": lambda: mdr.FrictionData(v_0=[1e-4, 2e-4, 4e-4], cof=[0.365, 0.388, 0.4], error=[0.01, 0.02, 0.01]),
}


@pytest.mark.parametrize("make", MAKE.values(), ids=MAKE)
def test_records_print_as_a_few_lines_and_in_notebooks_alike(make):
    record = make()
    text = str(record)
    assert text.startswith(type(record).__name__)
    assert 3 <= len(text.splitlines()) <= 12
    assert max(map(len, text.splitlines())) <= 140
    assert not re.search(r"array|\[|nan", text)
    words = unescape(re.sub("<[^>]*>", " ", record._repr_html_()))
    assert words.split() == text.split()
    if isinstance(record, ArrayRecord):
        assert len(repr(record)) < 1500
        assert "\n" not in repr(record)
        assert type(record).__name__ in repr([record])


def test_a_run_says_how_it_ended():
    full = {"mu_0": 0.5, "full_cof": 0.5}
    run = replace(MAKE["run"](), cof=0.25, **full, cof_error=2e-5, settled=False, why="F_x still drifts")
    text = str(run)
    assert "COF        0.250000 +- 2.0e-05  0.5 of mu_0 = 0.5" in text
    assert "settled    no" in text
    assert "why        F_x still drifts" in text
    assert f"mean F_z   {run.mean_F_z:.6g} N" in text
    assert "64 instants" in text


def test_a_case_names_its_parts_with_units_and_reads_back_from_its_repr():
    load = mdr.LoadOscillation(F_z0=0.05, dF_z=0.01, omega=100 * np.pi)
    shake = mdr.InPlaneOscillation(omega=100 * np.pi, du_x=1e-6)
    case = mdr.SlidingContact(BALL, RUBBER, 0.5, load, mdr.SpringPull(k_x=2e4), shake)
    text = str(case)
    for words in ("Paraboloid", "R = 0.005 m", "E = 3e+06 Pa", "F_z0 = 0.05 N", "(50 Hz)", "k_x = 20000 N/m", "du_x"):
        assert words in text
    assert "mdr.resolved(case)" in text
    assert "a = 0.000" in str(mdr.resolved(case))
    assert "F_z0 = 0.05 N" in str(mdr.resolved(case))
    assert eval(repr(case), vars(mdr)) == case


def test_a_measured_velocity_shows_its_bracket_where_there_is_one():
    found = MeasuredVelocity(0.1, 0.0999, 0.1001, "end of stick", "all signs agree", n_runs=7)
    assert str(found).splitlines() == [
        "MeasuredVelocity",
        "  v_c        0.1 m/s               end of stick",
        "  bracket    0.0999 to 0.1001 m/s  stick below, none above",
        "  why        all signs agree",
        "  runs       7",
    ]
    nothing = MeasuredVelocity(None, None, None, "none", "friction stays reduced")
    assert "bracket" not in str(nothing)
    assert "none" in str(nothing)


def test_numbers_are_cut_to_what_is_known():
    assert number(0.1234567, "m") == "0.123457 m"
    assert number(2.0, "-") == "2"
    assert number(np.inf, "m/s") == "infinite"
    assert with_error(0.43864123, 4.6e-6) == "0.4386412 +- 4.6e-06"
    assert with_error(0.5, 0.0) == with_error(0.5, np.nan) == with_error(0.5, np.inf) == "0.5"
    assert with_error(np.nan, 0.1) == number(np.nan)
    assert with_error(0.5, 1e-300) == "0.50000000 +- 1.0e-300"
    assert with_error(12.0, 30.0) == "12.0 +- 3.0e+01"
    assert span([2.0, np.nan, 1.0], "s") == "1 to 2 s"
    assert span([1.0, 1.0], "s") == "1 s"
    assert span([np.nan]) == span([]) == "none"
    assert lines_of([]) == []


def test_markup_is_text():
    assert "&lt;b&gt;" in Summary("<b>", [("a", "<b>", "")]).html


def test_a_text_too_long_for_its_line_goes_on_below_its_beginning():
    whole = ("why", "x" * 130 + " and on", "")
    lines = lines_of([("a name of 20 letters", "1 m", "word " * 40), ("short", "2 m", "meaning"), whole])
    assert [line.index("word") for line in lines[:2]] == [27, 27]
    assert lines[0].startswith("a name of 20 letters  1 m  word")
    assert max(map(len, lines[:3])) <= 118
    assert " ".join(" ".join(lines).split()).count("word") == 40
    assert lines[-2:] == [f"{'why':22}{'x' * 130}", f"{'':22}and on"]  # what cannot be parted stays whole
