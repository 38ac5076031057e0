"""sweep() end to end: whoever computes it, however often it is killed, the bits are the same and none is lost."""

import os
import re
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import CancelledError, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from itertools import count
from multiprocessing import get_context
from pathlib import Path

import grids
import numpy as np
import pytest
from grids import LOG, LONG, RIGID, RUNS, deadly, long_study
from numpy.testing import assert_array_equal

import mdr
from mdr.studies import engine
from mdr.studies.store import Store
from mdr.studies.work import units_of
from mdr.tools.status import Status

HERE = Path(__file__).parent
MANY = {"mu_0": [0.1 + 0.001 * k for k in range(100)]}


# --- who computes it ---


@pytest.fixture(scope="module")
def serial():
    with ThreadPoolExecutor(1) as one:
        return mdr.sweep(**RUNS, executor=one)


@pytest.fixture(scope="module")
def bytes_of_runs(tmp_path_factory, serial):
    """The file of a store of these runs, of own threads."""
    store = tmp_path_factory.mktemp("whole")
    assert mdr.sweep(**RUNS, store=store) == serial
    return (store / "study.nc").read_bytes()


def spawned(n):
    return ProcessPoolExecutor(n, mp_context=get_context("spawn"))


def test_a_cluster_that_loses_a_worker(serial, tmp_path):
    """Its own threads in the place of machines; a worker is retired as soon as the first chunk is there."""
    distributed = pytest.importorskip("distributed")
    store = tmp_path / "store"

    def retire(client):
        while not list(store.glob("chunks/*.npz")):
            time.sleep(0.001)
        client.retire_workers([next(iter(client.scheduler_info()["workers"]))])

    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None, "processes": False}
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:
        retirement = threading.Thread(target=retire, args=(client,))
        retirement.start()
        found = mdr.sweep(**RUNS, store=store, executor=client.get_executor())
        retirement.join()
    assert found == serial


def test_shards_together_are_the_study(tmp_path, serial, bytes_of_runs):
    missing = [mdr.sweep(**RUNS, store=tmp_path, shard=(99, 99)).count(Status.MISSING)]  # one has nothing to do
    for k in (3, 1, 4, 2):
        part = mdr.sweep(**RUNS, store=tmp_path, shard=(k, 4))
        missing.append(part.count(Status.MISSING))
        there = part.status != Status.MISSING
        assert_array_equal(part["cof"][there], serial["cof"][there])
    assert missing[0] == 120
    assert all(0 < n < 120 for n in missing[1:4])
    assert part == serial
    assert (tmp_path / "study.nc").read_bytes() == bytes_of_runs


def test_lost_processes_are_an_error_that_says_what_is_kept(tmp_path):
    axes = {"oscillation.u_z0": [(1 + k) * 1e-6 for k in range(9)]}
    words = "the workers were lost, .* of 9 chunks are safe in .*; the same call goes on from there"
    with spawned(1) as processes, pytest.raises(mdr.studies.StudyError, match=words):
        mdr.sweep(RIGID, axes, tmp_path, processes, [mdr.Quantity("own", "-", deadly)])
    assert mdr.read_study(tmp_path).count(Status.DONE) >= 1


def test_a_cancelled_future_is_a_lost_worker():
    class Cancelling(Executor):
        def submit(self, task, *args):
            future = Future()
            future.set_exception(CancelledError())
            return future

    words = r"the workers were lost, .*; nothing is kept, as there is no store"
    with pytest.raises(mdr.studies.StudyError, match=words):
        mdr.sweep(RIGID, MANY, executor=Cancelling(), quantities=["v_c"])


@pytest.mark.parametrize("error", [MemoryError, NameError, OSError])
def test_what_is_no_matter_of_a_point_ends_the_run_and_the_rest_is_cancelled(error):
    seen = []

    def of(case):
        seen.append(case.mu_0)
        time.sleep(0.02)
        raise error("too much")

    with ThreadPoolExecutor(1) as one, pytest.raises(error, match="too much"):
        mdr.sweep(RIGID, MANY, executor=one, quantities=[mdr.Quantity("own", "-", of)])
    assert len(seen) < 100


def test_a_function_that_cannot_be_sent_is_told_where_to_be():
    quantities = [mdr.Quantity("own", "-", lambda case: 1.0)]
    with spawned(1) as processes, pytest.raises(Exception, match=r"pickle|local object") as caught:
        mdr.sweep(RIGID, MANY, executor=processes, quantities=quantities)
    assert caught.value.__notes__ == ["what is sent to other processes must be defined at the top of a module"]


def test_no_more_than_so_many_chunks_are_in_flight(monkeypatch):
    monkeypatch.setattr(engine, "MOST_IN_FLIGHT", 5)
    submitted = []

    class Recorder(ThreadPoolExecutor):
        def submit(self, *task):
            submitted.append(task)
            return super().submit(*task)

    with Recorder(1) as executor:
        for ended, _ in enumerate(engine.run(grids.work(RIGID, MANY), range(100), range(100), executor)):
            assert len(submitted) <= ended + 5
    assert len(submitted) == 100


# --- kills and interrupts ---


def logged_of(store, chunks=None):
    """What the log says of the units of chunks, by default of the finished ones."""
    store = Store(store)
    cut, chunks = store.plan(), store.finished() if chunks is None else chunks
    units = [unit for chunk in chunks for unit in units_of(cut, chunk)]
    return {repr(LONG["oscillation.u_z0"][unit]) for unit in units}


def lines(log):
    """Units in the order in which they were computed."""
    return log.read_text().splitlines() if log.exists() else []


def live(store, log, lifetime):
    """Run the study in a process of its own, killed so long [s] after its first chunk begins; True if it was."""
    seen, plan = len(lines(log)), store / "chunks" / "plan.json"
    command = [sys.executable, str(HERE / "grids.py"), str(store)]
    with subprocess.Popen(command, env={**os.environ, LOG: str(log)}, stderr=subprocess.PIPE) as process:
        while lifetime and process.poll() is None and (len(lines(log)) == seen or not plan.exists()):
            time.sleep(0.001)
        try:
            process.wait(lifetime or 0.2)  # before there is a plan
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
        said = process.stderr.read().decode()
    assert process.returncode in (0, -signal.SIGKILL), said
    return process.returncode != 0


def test_a_study_that_is_killed_goes_on_where_it_was(tmp_path, monkeypatch):
    rng, store, log = np.random.default_rng(7), tmp_path / "store", tmp_path / "log"
    killed, finished = [], set()
    for lifetime in (0.0, rng.uniform(0.02, 0.15)):
        known, seen = logged_of(store), len(lines(log))
        assert Store(store).finished() == finished  # nothing finished was lost
        killed.append(live(store, log, lifetime))
        assert not known & set(lines(log)[seen:])  # nor computed again
        finished = Store(store).finished()
    assert all(killed)  # as its pauses alone take longer
    lost, seen = max(finished), len(lines(log))
    (store / "chunks" / f"{lost:06d}.npz").unlink()  # the log would tell
    known, again = logged_of(store), logged_of(store, [lost])
    assert not live(store, log, 600.0)
    assert again <= set(lines(log)[seen:])
    assert not known & set(lines(log)[seen:])
    assert_array_equal(mdr.read_study(store)["depth"], np.array(LONG["oscillation.u_z0"]) * 1e6)
    monkeypatch.setenv(LOG, str(log))
    long_study(tmp_path / "whole")
    assert (store / "study.nc").read_bytes() == (tmp_path / "whole" / "study.nc").read_bytes()
    assert sorted(os.listdir(store)) == ["study.json", "study.nc"]


@pytest.fixture
def hears_interrupts():
    """A shell that starts tests in the background has them ignore interrupts."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("hears_interrupts")
def test_ctrl_c_says_what_is_kept_and_ends_soon(tmp_path, capsys, monkeypatch):
    store, log, units = tmp_path / "store", tmp_path / "log", count(1)
    monkeypatch.setenv(LOG, str(log))
    monkeypatch.setattr(engine, "cores", lambda: 2)

    def interrupting():
        time.sleep(0.005)
        if next(units) == 60:  # of 240
            os.kill(os.getpid(), signal.SIGINT)

    monkeypatch.setattr(grids, "pause", interrupting)
    with pytest.raises(KeyboardInterrupt):
        long_study(store)
    kept = len(list(store.glob("chunks/*.npz")))
    assert 0 < kept < 60
    words = rf"sweep: interrupted; (\d+) of \d+ chunks are safe in {store}; the same call goes on from there"
    assert int(re.search(words, capsys.readouterr().err)[1]) in (kept - 1, kept)  # or between writing and counting it
    known, seen = logged_of(store), len(lines(log))
    assert long_study(store).complete
    assert not known & set(lines(log)[seen:])


def test_an_interrupt_before_the_first_chunk_says_so(tmp_path, capsys, monkeypatch):
    def interrupted(*args):
        raise KeyboardInterrupt

    monkeypatch.setattr(engine, "compute", interrupted)
    with pytest.raises(KeyboardInterrupt):
        mdr.sweep(RIGID, LONG, tmp_path, quantities=["v_c"])
    assert "sweep: interrupted; nothing is computed yet; the same" in capsys.readouterr().err


# --- what it says meanwhile ---


def test_progress_counts_from_what_was_there(tmp_path, capsys, monkeypatch):
    options = {"store": tmp_path, "quantities": ["v_c"], "chunk_seconds": 1e-9}
    mdr.sweep(RIGID, {"mu_0": MANY["mu_0"][:40]}, shard="1/2", **options)
    assert capsys.readouterr().err == ""
    monkeypatch.setattr("mdr.tools.progress.PATIENCE", -1.0)
    mdr.sweep(RIGID, {"mu_0": MANY["mu_0"][:40]}, **options)
    assert re.match(r"sweep: 21 of 40 chunks, about \d+ s left\n", capsys.readouterr().err)
