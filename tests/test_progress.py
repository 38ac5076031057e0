"""Progress is silent for what is short, and says how far it got for what is long."""

from mdr import progress as module
from mdr.progress import Ticker, progress


def test_short_work_is_silent(capsys):
    assert list(progress([1, 2, 3], "work")) == [1, 2, 3]
    assert capsys.readouterr().err == ""


def test_long_work_speaks_in_plain_lines(capsys, monkeypatch):
    clock = iter(range(0, 100, 3))
    monkeypatch.setattr(module.time, "monotonic", lambda: float(next(clock)))
    assert list(progress(list(range(12)), "work")) == list(range(12))
    lines = capsys.readouterr().err.splitlines()
    assert lines[0] == "work: 1 of 12"
    assert 2 <= len(lines) <= 4  # one in ten seconds, none for the last
    assert "12 of 12" not in lines


def test_an_unknown_end(capsys, monkeypatch):
    monkeypatch.setattr(module, "PATIENCE", -1.0)
    Ticker("runs").tick()
    assert capsys.readouterr().err == "runs: 1\n"
