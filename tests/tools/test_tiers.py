"""What answers a call: the function as Python at once, its machine code as soon as another process has made it."""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numba
import numpy as np
import pytest

from mdr.tools import beside, plain, tiers
from mdr.tools.plain import Left, called, twin_of

pytestmark = pytest.mark.skipif(numba.config.DISABLE_JIT, reason="nothing is compiled")
#: A package whose `total` says of the first entry of its array how it was called, and takes long as Python.
SMALL = {
    "__init__": "",
    "parts": """
from typing import NamedTuple
import numpy as np
from mdr.tools.jit import compiled, inner

class Pair(NamedTuple):
    a: np.ndarray
    b: float

@inner()
def added(x, y):
    return x + y

@compiled()
def total(pair, n):
    pair.a[0] += 1.0
    done = 0.0
    for i in range(n):
        for j in range(2):
            done = added(done, pair.b)
    return done

@compiled()
def twice(x):
    return 2.0 * x
""",
}


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """A folder with a package, which is copied for each test that compiles."""
    folder = tmp_path_factory.mktemp("small")
    ignored = shutil.ignore_patterns("*cache*")
    shutil.copytree(Path(tiers.__file__).parent, folder / "mdr" / "tools", ignore=ignored)
    for name, text in SMALL.items():
        (folder / "mdr" / f"{name}.py").write_text(text)
    return folder


def start(small, tmp_path, script, **environment):
    """A process with an empty cache that runs a script."""
    folder = tmp_path / "house"
    if not folder.exists():
        shutil.copytree(small, folder)
    env = {**os.environ, "PYTHONPATH": str(folder), "MDR_COMPILE": "beside", "TMPDIR": str(folder), **environment}
    env.pop("NUMBA_CACHE_DIR", None)
    script = "import numpy as np, sys, os, time\nfrom mdr.parts import *\nfrom mdr.tools import beside\n" + script
    pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    return subprocess.Popen(
        [sys.executable, "-c", script], cwd=folder, env=env, text=True, start_new_session=True, **pipes
    )


def said(small, tmp_path, script, **environment):
    """What a script prints, and what is told beside it."""
    process = start(small, tmp_path, script, **environment)
    out, told = process.communicate(timeout=120)
    assert process.returncode == 0, told
    return out.split(), told


def wait_until_gone(group):
    """Until no process of a group is left, of those that were killed."""
    for _ in range(200):
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return
        time.sleep(0.05)
    raise AssertionError(f"of group {group} a process is left")


TOTAL = "a = np.zeros(2); print(total(Pair(a, 0.5), {n}), a[0], len(getattr(total, 'signatures', ())))\n"


def test_python_answers_at_once_and_machine_code_as_soon_as_it_is_there(small, tmp_path):
    wait = "while beside.BESIDE.is_alive() and not codes_are_there(): time.sleep(0.05)\n"
    there = "codes_are_there = lambda: all(one.is_there() for one in beside.BESIDE.asked)\n"
    script = TOTAL.format(n=3) + there + wait + TOTAL.format(n=3)
    out, told = said(small, tmp_path, script)
    assert out == ["3.0", "1.0", "0", "3.0", "1.0", "1"]
    assert told.count("compiling in another process") == 1
    out, told = said(small, tmp_path, TOTAL.format(n=3))
    assert out == ["3.0", "1.0", "1"]  # from the disk
    assert not told


def test_a_long_call_is_left_for_its_machine_code_and_leaves_nothing_behind(small, tmp_path):
    out, _ = said(small, tmp_path, TOTAL.format(n=10**9))
    assert out == ["1000000000.0", "1.0", "1"]


def test_first_and_never(small, tmp_path):
    for mode, compiled in (("never", "0"), ("first", "1")):
        out, told = said(small, tmp_path, TOTAL.format(n=3), MDR_COMPILE=mode)
        assert out == ["3.0", "1.0", compiled], mode
        assert not told
    process = start(small, tmp_path, "", MDR_COMPILE="later")
    assert "MDR_COMPILE must be one of beside, first, never, got 'later'" in process.communicate()[1]


#: another process that lives and brings nothing
LATE = """
open("late", "w").write("#!/bin/sh\\ncat\\n")
os.chmod("late", 0o755)
beside.sys.executable, tiers.LATE = os.path.abspath("late"), 0.3
"""


@pytest.mark.parametrize(
    "why",
    [
        LATE,
        "beside.cores = lambda: 1\n",  # no core for another process
        "beside.sys.executable = '/nowhere'\n",
        "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))\n",  # a full disk
        "total.py_func.__qualname__ = 'nowhere'\n",  # which the other process cannot find
    ],
)
def test_where_nobody_else_compiles_this_process_does_after_a_while(why, small, tmp_path):
    wait = "from mdr.tools import tiers; tiers.ALONE = 0.3\n"
    out, _ = said(small, tmp_path, wait + why + TOTAL.format(n=10**9))
    assert out == ["1000000000.0", "1.0", "1"]


def test_where_nothing_can_be_kept_no_other_process_is_started(small, tmp_path):
    script = "from numba.core.caching import NullCache; total._cache = NullCache()\n"  # as where no folder is writable
    script += "from mdr.tools import tiers; tiers.ALONE = 0.3\n" + TOTAL.format(n=10**9)
    script += "print(beside.BESIDE.process)\n"
    out, _ = said(small, tmp_path, script)
    assert out == ["1000000000.0", "1.0", "1", "None"]


def test_for_one_that_was_stopped_nobody_waits_for_ever(monkeypatch, tmp_path):
    fcntl = pytest.importorskip("fcntl")
    monkeypatch.setattr(beside.tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr(beside, "PATIENT", 0.2)
    with beside._alone():
        (lock,) = tmp_path.iterdir()
        with open(lock) as file, pytest.raises(BlockingIOError):
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        with beside._alone():
            pass


def test_threads_that_begin_together_find_whole_twins(small, tmp_path):
    script = """
from threading import Thread
from mdr import parts
class Slow:
    @property
    def py_func(self): time.sleep(0.3)
parts.slow = Slow()
found = []
threads = [Thread(target=lambda: found.append(total(Pair(np.zeros(1), 0.5), 3))) for _ in range(3)]
for one in threads: one.start()
for one in threads: one.join()
print(*found)
"""
    out, told = said(small, tmp_path, script)
    assert out == ["3.0"] * 3, told


def test_a_process_that_is_killed_leaves_no_lock_and_no_process(small, tmp_path):
    hold = "print('begun', flush=True); total(Pair(np.zeros(1), 1.0), 10**12)"
    process = start(small, tmp_path, "beside.BESIDE.ask([]); " + hold)
    process.stdout.readline()
    time.sleep(0.5)
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate(timeout=20)  # its pipes are closed: none of the group holds them
    wait_until_gone(process.pid)
    out, _ = said(small, tmp_path, TOTAL.format(n=10**9))
    assert out == ["1000000000.0", "1.0", "1"]


def test_a_fork_goes_on_by_itself(small, tmp_path):
    script = TOTAL.format(n=1) + "sys.stdout.flush()\n"
    script += "child = os.fork()\nif child: os.waitpid(child, 0)\n"
    script += "else: print(beside.BESIDE.process, len(beside.BESIDE.asked), twice(4.0), flush=True)\n"
    out, _ = said(small, tmp_path, script)
    assert out == ["1.0", "1.0", "0", "None", "0", "8.0"]


def test_a_twin_has_the_defaults_and_the_closure_of_its_function_and_calls_twins():
    def made(scale):
        def scaled(x, by=3.0, *, plus=1.0):
            return scale * x * by + plus

        return scaled

    function = made(2.0)
    function.__module__ = plain.__name__
    twin = twin_of(function)
    assert twin(1.0) == 7.0
    assert twin(1.0, 1.0, plus=0.0) == 2.0


def test_what_a_call_did_to_its_arrays_is_undone_where_it_is_left():
    def fills(one, pair):
        one[:] = 7.0
        pair[0][:] = 8.0
        for _ in range(3):
            pass

    fills.__module__ = plain.__name__
    fixed = np.ones(2)
    fixed.setflags(write=False)
    args = np.zeros(2), (np.zeros(3), 1.0), fixed
    with pytest.raises(Left):
        called(fills, args[:2], lambda: True)
    assert not np.any(args[0])
    assert not np.any(args[1][0])
    assert called(fills, args[:2], lambda: False) is None
    assert np.all(args[0] == 7.0)
