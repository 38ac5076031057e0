"""sweep() end to end: shards, kills and interrupts lead to the same bits, and nothing finished is computed twice."""

import os
import re
import signal
import subprocess
import sys
import time
from itertools import count

import grids
import numpy as np
import pytest
from grids import BODY, COARSE, LOG, LONG, RIGID, RUNS, SHAPES, SLOW, long_study, study
from kills import HERE, finished_units, lines, live, same_values, size
from numpy.testing import assert_array_equal

import mdr
from mdr.studies.points import Status


def test_the_arrays_follow_the_order_of_the_axes():
    axes = {"v_0/v_c": [0.2, 0.5, 0.8], "T": [0.1, 1.0], "indenter": SHAPES}
    orders = [list(axes), ["T", "v_0/v_c", "indenter"], ["indenter", "T", "v_0/v_c"]]
    one, *others = [mdr.sweep(RIGID, {path: axes[path] for path in order}) for order in orders]
    for order, other in zip(orders[1:], others, strict=True):
        assert list(other.axes) == order
        assert other.shape == tuple(len(axes[path]) for path in order)
        assert_array_equal(np.transpose(one["cof"], [orders[0].index(path) for path in order]), other["cof"])


# --- shards ---


def test_shards_together_are_the_study(tmp_path):
    whole = study(RUNS, store=tmp_path / "whole")
    missing = []
    for k in (3, 1, 4, 2):
        part = study(RUNS, store=tmp_path / "parts", shard=(k, 4))
        missing.append(part.count(Status.MISSING))
        there = part.status != Status.MISSING
        assert_array_equal(part["cof"][there], whole["cof"][there])
        assert part.complete == (k == 2)
    assert all(0 < n < 120 for n in missing[:3])
    assert part == whole
    assert (tmp_path / "parts" / "study.nc").read_bytes() == (tmp_path / "whole" / "study.nc").read_bytes()


def test_shards_at_the_same_time(tmp_path):
    """All cut alike, whichever is first, and the last to end merges; or several do, to the same bytes."""
    command = "import sys, grids; grids.study(grids.RUNS, store=sys.argv[1], shard=sys.argv[2])"
    started = [
        subprocess.Popen([sys.executable, "-c", command, str(tmp_path / "parts"), f"{k}/2"], stderr=-1, cwd=HERE)
        for k in (1, 2)
    ]
    for process in started:
        said = process.communicate()[1].decode()
        assert process.returncode == 0, said
    study(RUNS, store=tmp_path / "whole")
    assert sorted(os.listdir(tmp_path / "parts")) == ["study.json", "study.nc"]
    assert (tmp_path / "parts" / "study.nc").read_bytes() == (tmp_path / "whole" / "study.nc").read_bytes()


def test_more_shards_than_chunks(tmp_path):
    axes = {"mu_0": [0.1, 0.2]}
    assert mdr.sweep(RIGID, axes, tmp_path / "store", quantities=["v_c"], shard="9/9").count(Status.MISSING) == 2


@pytest.mark.parametrize(
    "shard", ["0/4", "5/4", "1", "1/2/3", "a/b", "", "-1/4", "1.0/4", (0, 4), (1,), (1.0, 2), 3, (True, 2)]
)
def test_shards_that_are_none(tmp_path, shard):
    with pytest.raises(ValueError, match="shard must be k/n with k from 1 to n, such as 3/16"):
        mdr.sweep(RIGID, {"mu_0": [0.1]}, tmp_path, quantities=["v_c"], shard=shard)


def test_a_shard_needs_a_store():
    with pytest.raises(ValueError, match="a shard needs a store"):
        mdr.sweep(RIGID, {"mu_0": [0.1]}, quantities=["v_c"], shard="1/2")


@pytest.mark.parametrize(
    ("options", "kind", "words"),
    [
        ({"chunk_seconds": 0}, ValueError, "chunk_seconds must be positive"),
        ({"chunk_seconds": "long"}, TypeError, "chunk_seconds must be a real number"),
        ({"store": 3}, TypeError, "store must be a folder, got 3"),
        ({"n_springs": 8}, ValueError, "n_springs must be at least 32"),
        ({"steps_per_period": 64.0}, TypeError, "steps_per_period must be a whole number"),
        ({"executor": 4}, TypeError, "executor must be a concurrent.futures.Executor, got 4"),
    ],
)
def test_options_are_checked(options, kind, words):
    with pytest.raises(kind, match=words):
        mdr.sweep(RIGID, {"mu_0": [0.1]}, quantities=["v_c"], **options)


# --- kills ---


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The bytes of the long study, never interrupted."""
    folder = tmp_path_factory.mktemp("whole")
    os.environ[LOG] = str(folder / "log")
    long_study(folder / "store")
    return (folder / "store" / "study.nc").read_bytes()


def test_a_study_that_is_killed_goes_on_where_it_was(tmp_path, whole):
    rng = np.random.default_rng(7)
    store, log = tmp_path / "store", tmp_path / "log"
    lives = [live(store, log, rng.uniform(0.02, 0.3)) for _ in range(3)]
    assert sum(one.killed and one.computed > 0 for one in lives) >= 2
    while not (store / "study.nc").exists():
        lives.append(live(store, log, 60.0))
    assert sum(one.twice for one in lives) == 0  # nothing finished was computed again
    assert [one.before for one in lives[1:]] == [one.after for one in lives[:-1]]  # and nothing finished was lost
    assert any(one.after > 0 for one in lives[:-1])
    assert (store / "study.nc").read_bytes() == whole
    assert sorted(os.listdir(store)) == ["study.json", "study.nc"]
    assert same_values(store)


def test_a_kill_before_the_plan(tmp_path, whole):
    store, log = tmp_path / "store", tmp_path / "log"
    assert live(store, log, 0.2, at_work=False).killed
    os.environ[LOG] = str(log)
    long_study(store)
    assert (store / "study.nc").read_bytes() == whole


def test_a_wrong_count_would_be_seen(tmp_path):
    """The log tells if a chunk is computed again: here its file is removed."""
    store, log = tmp_path / "store", tmp_path / "log"
    live(store, log, 0.4)
    known, seen = finished_units(store), size(log)
    next(store.glob("chunks/*.npz")).unlink()
    os.environ[LOG] = str(log)
    long_study(store)
    assert known & set(lines(log)[seen:])


# --- interrupts ---


@pytest.fixture
def hears_interrupts():
    """A shell that starts tests in the background has them ignore interrupts."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("hears_interrupts")
def test_ctrl_c_says_what_is_kept_and_ends_soon(tmp_path, capsys, monkeypatch):
    store = tmp_path / "store"
    monkeypatch.setenv(LOG, str(tmp_path / "log"))
    monkeypatch.setattr("mdr.studies.engine.cores", lambda: 2)
    units = count(1)

    def interrupting():
        time.sleep(0.005)
        if next(units) == 60:  # of 240
            os.kill(os.getpid(), signal.SIGINT)

    monkeypatch.setattr(grids, "pause", interrupting)
    with pytest.raises(KeyboardInterrupt):
        long_study(store)
    kept = len(list(store.glob("chunks/*.npz")))
    told = capsys.readouterr().err
    assert "sweep: interrupted; " in told
    assert f" chunks are safe in {store}; the same call goes on from there" in told
    assert 0 < kept < 60
    known, seen = finished_units(store), size(tmp_path / "log")
    assert long_study(store).complete
    assert not known & set(lines(tmp_path / "log")[seen:])


def test_ctrl_c_without_a_store(capsys, monkeypatch):
    def interrupted(*args):
        raise KeyboardInterrupt

    monkeypatch.setattr("mdr.studies.engine.run", interrupted)
    with pytest.raises(KeyboardInterrupt):
        mdr.sweep(RIGID, {"mu_0": [0.1]}, quantities=["v_c"])
    told = "sweep: interrupted; nothing is kept, as there is no store (store=, --store)"
    assert told in capsys.readouterr().err


def test_ctrl_c_before_the_plan(tmp_path, capsys, monkeypatch):
    def interrupted(*args):
        raise KeyboardInterrupt

    monkeypatch.setattr("mdr.studies.engine.compute", interrupted)
    with pytest.raises(KeyboardInterrupt):
        mdr.sweep(RIGID, LONG, tmp_path / "store", quantities=["v_c"])
    assert "sweep: interrupted; nothing is computed yet" in capsys.readouterr().err


# --- progress ---


def test_progress_counts_from_what_was_there(tmp_path, capsys, monkeypatch):
    axes = {"mu_0": np.linspace(0.1, 0.9, 40)}
    options = {"store": tmp_path / "store", "quantities": ["v_c"], "chunk_seconds": 1e-9}
    mdr.sweep(RIGID, axes, shard="1/2", **options)
    capsys.readouterr()
    monkeypatch.setattr("mdr.tools.progress.PATIENCE", -1.0)
    mdr.sweep(RIGID, axes, **options)
    assert re.match(r"sweep: 21 of 40 chunks, about \d+ s left\n", capsys.readouterr().err)


def test_a_study_of_runs_with_every_option(tmp_path):
    found = mdr.sweep(BODY, {"v_0": [1e-4]}, tmp_path, None, ["cof"], chunk_seconds=1.0, shard="1/1", **COARSE)
    assert found["cof"][0] == mdr.slide(BODY, 1e-4, **COARSE).cof
    assert SLOW.name == "depth"


def test_a_grid_that_no_memory_holds_is_refused():
    axes = {"alpha": np.linspace(0.1, 1, 1001), "T": np.linspace(0.1, 1, 1001), "v_0": np.linspace(0.1, 1, 1001)}
    with pytest.raises(ValueError, match="the grid has 1003003001 points of 1 quantities, more than memory holds"):
        mdr.sweep(RIGID, axes)


def test_cases_that_take_long_are_counted(capsys, monkeypatch):
    monkeypatch.setattr("mdr.studies.points.SLOW", -1.0)
    mdr.sweep(RIGID, {"mu_0": [0.2, 0.4]}, quantities=("v_c",))
    told = capsys.readouterr().err
    assert told.startswith("sweep: 2 cases took more than ")
    assert told.endswith(" s, at most 0 s\n")
