"""Progress is silent for what is short, and says how far it got, and how long the rest takes, for what is long."""

import re
import sys
import time
from types import SimpleNamespace

import pytest

import mdr
from mdr.tools import progress as module
from mdr.tools.compiling import TALLY
from mdr.tools.progress import Ticker, progress, silent, time_is_over, time_limit


@pytest.fixture
def clock(monkeypatch):
    """A clock that three seconds pass on whenever it is looked at."""
    seconds = iter(range(0, 1000, 3))
    monkeypatch.setattr(time, "monotonic", lambda: float(next(seconds)))


def test_short_work_is_silent(capsys):
    assert list(progress([1, 2, 3], "work")) == [1, 2, 3]
    assert capsys.readouterr().err == ""


def test_long_work_speaks_in_plain_lines(capsys, clock):
    assert list(progress(list(range(12)), "work")) == list(range(12))
    lines = capsys.readouterr().err.splitlines()
    assert lines[0] == "work: 1 of 12, about 33 s left"
    assert 2 <= len(lines) <= 4  # one in ten seconds, none for the last
    assert not any("12 of 12" in line for line in lines)


def test_of_parts_that_differ_no_time_is_foretold(capsys, clock):
    assert list(progress(list(range(4)), "work", "kinds", alike=False)) == list(range(4))
    assert capsys.readouterr().err.splitlines()[0] == "work: 1 of 4 kinds"


def test_what_was_there_before_is_counted_and_not_timed(capsys, clock):
    meter = progress(range(1881), "sweep", "chunks", 2000, done=119)
    next(meter), next(meter)
    assert capsys.readouterr().err == "sweep: 120 of 2000 chunks, about 94 min left\n"  # 1880 chunks of 3 s


def test_the_rest_takes_no_time_of_compiling(capsys, monkeypatch):
    now = [100.0]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    for part in progress(range(12), "work"):
        if part == 0:
            TALLY.begin()
            now[0] += 60.0
            TALLY.end()
        now[0] += 1.0
    assert capsys.readouterr().err.splitlines()[0] == "work: 3 of 12, about 9 s left"


def test_more_than_was_foretold_is_silent(capsys, clock):
    ticker = Ticker("slide", total=3)
    ticker.tick(4)
    assert capsys.readouterr().err == ""


def test_where_nobody_reads_nothing_is_told(monkeypatch, capsys):
    for stream in (None, SimpleNamespace(write=refused, flush=refused)):
        monkeypatch.setattr(sys, "stderr", stream)
        module.tell("a line")
    assert capsys.readouterr().out == ""


def refused(*_):
    raise BrokenPipeError


def test_an_unknown_end(capsys, monkeypatch):
    monkeypatch.setattr(module, "PATIENCE", -1.0)
    Ticker("velocity", parts="runs").tick()
    assert capsys.readouterr().err == "velocity: 1 runs so far\n"


def test_silent_work_is_watched(capsys, clock):
    calls = []
    with silent(lambda: calls.append(1)):
        list(progress([1, 2, 3], "work"))
        Ticker("runs").tick()
    assert len(calls) == 4
    assert capsys.readouterr().err == ""
    with silent(lambda: 1 / 0), pytest.raises(ZeroDivisionError):  # it may end the work
        list(progress([1, 2, 3], "work"))


def test_a_long_march_says_how_many_periods_are_done(capsys, monkeypatch):
    monkeypatch.setattr(module, "PATIENCE", -1.0)
    motion = mdr.NormalOscillation(u_z0=6e-6, du_z=2e-6, omega=300.0)
    case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), 0.5, motion)
    monkeypatch.setattr("mdr.march.dynamics.stepper.AT_ONCE", 4 * 64)  # four periods
    mdr.slide(case, 1e-4, n_springs=32, steps_per_period=64, n_periods=12)
    assert "slide: 4 of 12 periods, about " in capsys.readouterr().err
    mdr.slide(case, 1e-4, n_springs=32, steps_per_period=64)
    assert re.search("^slide, waiting for a steady state: [0-9]+ periods so far$", capsys.readouterr().err, re.M)


def test_a_time_limit_leaves_out_what_is_compiled(monkeypatch):
    now = [100.0]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    with time_limit(5.0):
        now[0] += 4.0
        TALLY.begin()
        now[0] += 60.0
        TALLY.begin()
        TALLY.end()
        assert not time_is_over()
        TALLY.end()
        assert not time_is_over()
        now[0] += 1.5
        assert time_is_over()
