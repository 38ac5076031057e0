"""Executors: threads, spawned processes and a Dask cluster that loses a worker give the same bits as one thread."""

import os
import signal
import threading
import time
from concurrent.futures import CancelledError, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context

import pytest
from grids import RIGID, RUNS, deadly, study

import mdr
from mdr.studies import engine


@pytest.fixture(scope="module")
def serial():
    with ThreadPoolExecutor(1) as one:
        return study(RUNS, executor=one)


def spawned(n):
    return ProcessPoolExecutor(n, mp_context=get_context("spawn"))


def test_own_threads(serial):
    assert study(RUNS) == serial


def test_spawned_processes(serial, tmp_path):
    with spawned(2) as processes:
        assert study(RUNS, store=tmp_path / "store", executor=processes) == serial


def test_a_cluster_that_loses_a_worker(serial, tmp_path):
    distributed = pytest.importorskip("distributed")
    store, killed = tmp_path / "store", []

    def kill(pid):
        """As soon as the first chunk is there."""
        while not list(store.glob("chunks/*.npz")):
            time.sleep(0.001)
        os.kill(pid, signal.SIGKILL)
        killed.append(len(list(store.glob("chunks/*.npz"))))

    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None, "silence_logs": "ERROR"}
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:
        pid = next(iter(client.run(os.getpid).values()))
        killer = threading.Thread(target=kill, args=(pid,))
        killer.start()
        found = study(RUNS, store=store, executor=client.get_executor())
        killer.join()
    assert 0 < killed[0] < 20  # while it was running
    assert found == serial


def test_a_client_is_no_executor():
    class Client:
        def get_executor(self):
            pass

    with pytest.raises(TypeError, match=r"executor must be a concurrent.futures.Executor, .* client.get_executor\(\)"):
        mdr.sweep(RIGID, {"v_0": [1e-4]}, executor=Client())


def test_lost_processes_are_an_error_that_says_what_is_kept(tmp_path):
    axes = {"oscillation.u_z0": [(1 + k) * 1e-6 for k in range(9)]}
    quantities = [mdr.Quantity("own", "-", deadly)]
    with spawned(1) as processes, pytest.raises(mdr.StudyError, match="the workers were lost") as caught:
        mdr.sweep(RIGID, axes, tmp_path / "store", processes, quantities)
    assert "of 9 chunks are safe in" in str(caught.value)
    assert "the same call goes on from there" in str(caught.value)
    assert mdr.read_study(tmp_path / "store").count(0) >= 1
    with spawned(1) as processes, pytest.raises(mdr.StudyError, match="nothing is kept, as there is no store"):
        mdr.sweep(RIGID, axes, executor=processes, quantities=quantities)


class Recorder(Executor):
    """Runs every task when its outcome is asked for, and counts those in between."""

    def __init__(self):
        self.open, self.most = 0, 0
        self.pool = ThreadPoolExecutor(1)

    def submit(self, task, *args):
        self.open += 1
        self.most = max(self.most, self.open)
        future = self.pool.submit(task, *args)
        future.add_done_callback(lambda _: setattr(self, "open", self.open - 1))
        return future


def test_no_more_than_so_many_chunks_are_in_flight(monkeypatch):
    monkeypatch.setattr(engine, "MOST_IN_FLIGHT", 5)
    executor = Recorder()
    axes = {"mu_0": [0.1 + 0.001 * k for k in range(100)]}
    mdr.sweep(RIGID, axes, executor=executor, quantities=["v_c"])
    executor.pool.shutdown()
    assert executor.most <= 5


def test_a_cancelled_future_is_a_lost_worker():
    class Cancelling(Executor):
        def submit(self, task, *args):
            future = Future()
            future.set_exception(CancelledError())
            return future

    with pytest.raises(mdr.StudyError, match="the workers were lost"):
        mdr.sweep(RIGID, {"mu_0": [0.1]}, executor=Cancelling(), quantities=["v_c"])


def test_what_a_worker_raises_ends_the_run_and_the_rest_is_cancelled():
    seen = []

    def of(case):
        seen.append(case.mu_0)
        time.sleep(0.02)
        raise MemoryError("too much")

    axes = {"mu_0": [0.1 + 0.001 * k for k in range(100)]}
    with ThreadPoolExecutor(1) as one, pytest.raises(MemoryError, match="too much"):
        mdr.sweep(RIGID, axes, executor=one, quantities=[mdr.Quantity("own", "-", of)])
    assert len(seen) < 100


def test_a_function_that_cannot_be_sent_is_told_where_to_be():
    quantities = [mdr.Quantity("own", "-", lambda case: 1.0)]
    with spawned(1) as processes, pytest.raises(Exception, match=r"pickle|local object") as caught:
        mdr.sweep(RIGID, {"mu_0": [0.1]}, executor=processes, quantities=quantities)
    assert caught.value.__notes__ == ["what is sent to other processes must be defined at the top of a module"]


def test_cores_are_those_of_the_process(monkeypatch):
    assert engine.cores() >= 1
    monkeypatch.delattr(os, "sched_getaffinity", raising=False)
    monkeypatch.setattr(os, "cpu_count", lambda: None)
    assert engine.cores() == 1
