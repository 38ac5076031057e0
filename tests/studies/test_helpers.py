"""Processes that help with a study: the same bits, and no trace of them when it ends, however it does."""

import os
import pickle
import signal
import subprocess
import sys
import threading
from pathlib import Path

import grids
import numpy as np
import pytest

import mdr
from mdr.studies import engine
from mdr.studies.helpers import Helper, Lost, helper_for, send
from mdr.studies.points import compute

DEPTHS = {"oscillation.u_z0": np.linspace(3e-6, 9e-6, 24).tolist()}
OWN = mdr.Quantity("own", "-", lambda case: 1.0)


@pytest.fixture
def at_once(monkeypatch):
    """Helpers begin at once, on two cores at least."""
    monkeypatch.setattr(engine, "ALONE", 0.0)
    monkeypatch.setattr(engine, "cores", lambda: 2)


def test_a_helper_computes_the_same_bits():
    work = grids.work(grids.BODY, grids.RUNS["axes"], ("cof",), **grids.COARSE)
    helper = helper_for(work, threading.Event())
    there, here = (by(range(2)) for by in (helper.compute, lambda units: compute(work, units)))
    helper.close()
    assert np.array_equal(there.values, here.values)
    assert np.array_equal(there.status, here.status)
    assert helper.process.returncode is not None


@pytest.fixture
def after_a_helper(monkeypatch):
    """This process computes nothing before a helper was asked; the units that it computes then."""
    asked, here, now, ask = threading.Event(), [], engine.compute, Helper.compute

    def compute_later(work, units, ended):
        assert asked.wait(timeout=600)
        here.append(units)
        return now(work, units, ended)

    def compute_there(self, units):
        try:
            return ask(self, units)
        finally:
            asked.set()

    monkeypatch.setattr(engine, "compute", compute_later)
    monkeypatch.setattr(Helper, "compute", compute_there)
    return here


def test_a_study_is_shared_with_a_helper(at_once, after_a_helper, monkeypatch):
    study = mdr.sweep(grids.RIGID, DEPTHS, quantities=("v_c",))
    assert study.complete
    assert len(after_a_helper) < 24
    monkeypatch.setattr(engine, "cores", lambda: 1)
    assert mdr.sweep(grids.RIGID, DEPTHS, quantities=("v_c",)) == study


def test_what_only_this_process_knows_is_computed_here(at_once):
    for one in (OWN, grids.SLOW):  # the module of the second may have changed since it was imported
        assert helper_for(grids.work(grids.RIGID, DEPTHS, (one,)), threading.Event()) is None
    assert mdr.sweep(grids.RIGID, DEPTHS, quantities=(OWN,))["own"].tolist() == 24 * [1.0]


def test_a_function_of_a_script_is_computed_here(tmp_path):
    """The script is not run again, although it has no guard against that."""
    script = tmp_path / "script.py"
    script.write_text(
        "import mdr, grids\nfrom mdr.studies import engine\nengine.ALONE = 0.0\nprint('once')\n"
        "def own(case):\n    return 2.0\n"
        "study = mdr.sweep(grids.RIGID, {'mu_0': [0.1, 0.2, 0.3]}, quantities=[mdr.Quantity('own', '-', own)])\n"
        "print(study['own'].tolist())\n"
    )
    env = {**os.environ, "PYTHONPATH": str(Path(grids.__file__).parent)}
    said = subprocess.run([sys.executable, script], env=env, capture_output=True, text=True, check=True, timeout=120)
    assert said.stdout == "once\n[2.0, 2.0, 2.0]\n"


def test_a_helper_that_is_killed_is_lost():
    helper = helper_for(grids.work(grids.RIGID, DEPTHS), threading.Event())
    os.kill(helper.process.pid, signal.SIGKILL)
    helper.process.wait(timeout=60)
    with pytest.raises(Lost, match="ended with status"):
        helper.compute(range(1))
    helper.close()


@pytest.mark.parametrize("printed", ["Intel MKL: one thread", "c", "5"])
def test_a_helper_that_prints_before_it_answers_is_not_asked(printed, tmp_path, monkeypatch):
    """What a file of the site prints stands where the answer is read, and no pickle is told from it for sure."""
    (tmp_path / "sitecustomize.py").write_text(f"print({printed!r}, flush=True)\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    assert helper_for(grids.work(grids.RIGID, DEPTHS), threading.Event()) is None


def test_what_a_lost_helper_was_to_compute_is_computed_here(at_once, monkeypatch, request):
    def lose(self, units):
        raise Lost("gone")

    monkeypatch.setattr(Helper, "compute", lose)
    here = request.getfixturevalue("after_a_helper")
    assert mdr.sweep(grids.RIGID, DEPTHS, quantities=("v_c",)).complete
    assert len(here) == 24


def test_a_helper_ends_with_the_study():
    ended = threading.Event()
    helper = helper_for(grids.work(grids.RIGID, DEPTHS), ended)
    assert helper.process.poll() is None
    ended.set()
    assert helper.process.wait(timeout=60) is not None
    helper.close()


def test_a_helper_whose_asker_is_gone_ends_in_silence():
    command = [sys.executable, "-c", "from mdr.studies import helpers; helpers.main()"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        send(process.stdin, grids.work(grids.RIGID, DEPTHS))
        assert pickle.load(process.stdout) is True
        process.stdout.close()
        send(process.stdin, range(2))
        process.stdin.close()
        assert process.stderr.read() == b""
    assert process.returncode == 0
