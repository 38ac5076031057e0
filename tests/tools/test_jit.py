"""Compilation: what takes long is said, with how much is done; what is kept on disk is of the sources as they are."""

import gc
import os
import shutil
import subprocess
import sys
from contextlib import nullcontext
from functools import partial
from itertools import count
from pathlib import Path
from types import SimpleNamespace

import numba
import pytest
from numba.core import event
from numba.core.event import EventStatus

from mdr.tools import jit
from mdr.tools.compiling import TALLY, unsaid

#: A package whose function `answer` compiles in a function and a constant of two other files.
SMALL = {
    "__init__": "",
    "constants": "FACTOR = 2.0",
    "pairs": """
from typing import NamedTuple

from numba import njit

from mdr.constants import (
    FACTOR,
)

class Pair(NamedTuple):
    a: float
    b: float

@njit
def product(pair):
    return FACTOR * pair.a * pair.b

HERE = Pair(3.0, 5.0)
""",
    "first": """
from mdr.pairs import HERE, product
from mdr.tools.jit import compiled

@compiled()
def answer(pair):
    return product(pair)

print(answer(HERE), *(sum(one.values()) for one in (answer.stats.cache_hits, answer.stats.cache_misses)))
""",
    "other": "x = 1",
}


def answer_of(folder, **options):
    """Answer, functions found on disk, functions compiled."""
    environment = {**os.environ, "PYTHONPATH": str(folder), "PYTHONDONTWRITEBYTECODE": "1"}
    environment.pop("NUMBA_CACHE_DIR", None)
    command = [sys.executable, "-c", "import mdr.first"]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=True, **options)
    return done.stdout.strip()


compiles = pytest.mark.skipif(numba.config.DISABLE_JIT, reason="nothing is compiled")
#: one after the other: file, what is written in it, and what the next process says
EDITS = [
    ("other", "1", "2", "30.0 1 0"),
    ("pairs", "pair.a * pair.b", "(pair.a + pair.b)", "16.0 0 1"),
    ("constants", "2.0", "4.0", "32.0 0 1"),
    ("pairs", "Pair", "Couple", "32.0 0 1"),  # the index on disk names a type that is gone
]


@compiles
def test_an_edit_of_any_compiled_file_and_a_broken_one_on_disk_compile_anew(tmp_path):
    package = tmp_path / "mdr"
    shutil.copytree(Path(jit.__file__).parent, package / "tools", ignore=shutil.ignore_patterns("*cache*"))
    for name, text in SMALL.items():
        (package / f"{name}.py").write_text(text)
    assert answer_of(tmp_path) == "30.0 0 1"
    for file, old, new, said in EDITS:
        path = package / f"{file}.py"
        path.write_text(path.read_text().replace(old, new))
        assert answer_of(tmp_path) == said, (file, new)
    for size in (-9, 9):
        for path in (package / "__pycache__").glob("*.nbc"):
            path.write_bytes(path.read_bytes()[:size])
        assert answer_of(tmp_path) == "32.0 0 1", size
    assert answer_of(tmp_path) == "32.0 1 0"


@compiles
def test_code_of_older_sources_never_answers_where_the_disk_is_full(tmp_path):
    resource = pytest.importorskip("resource")
    shutil.copytree(Path(jit.__file__).parent, tmp_path / "mdr" / "tools", ignore=shutil.ignore_patterns("*cache*"))
    for name, text in SMALL.items():
        (tmp_path / "mdr" / f"{name}.py").write_text(text)
    assert answer_of(tmp_path) == "30.0 0 1"
    path = tmp_path / "mdr" / "constants.py"
    path.write_text(path.read_text().replace("2.0", "4.0"))
    full = partial(resource.setrlimit, resource.RLIMIT_FSIZE, (2000, 2000))  # takes a short file, but no code
    assert answer_of(tmp_path, preexec_fn=full) == "60.0 0 1"
    assert answer_of(tmp_path) == "60.0 0 1"


@compiles
def test_without_a_folder_to_write_to_it_is_compiled_all_the_same(monkeypatch):
    def refuse(*args, **options):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("tempfile.TemporaryFile", refuse)  # how numba finds out
    with pytest.warns(UserWarning, match="NUMBA_CACHE_DIR") as told:
        double = jit.compiled(nogil=True)(lambda x: 2 * x)
    assert len(told) == 1
    assert double(1.5) == 3.0
    assert double.signatures  # compiled, not left to Python


@compiles
def test_an_inner_function_becomes_machine_code_with_its_callers_alone(monkeypatch):
    assert jit.LINKED  # what it takes of numba is there

    def compiled_with(options):
        monkeypatch.setattr(jit, "LINKED", options)
        half = jit.inner()(lambda x: 0.5 * x)
        return half, numba.njit(lambda x: half(x) + half(half(x)))(3.0)

    inner, answer = compiled_with(jit.LINKED)
    assert answer == compiled_with({})[1] == 2.25
    with pytest.raises(KeyError):
        inner(3.0)  # Python may not call it


def compiling(module):
    return SimpleNamespace(data={"dispatcher": SimpleNamespace(py_func=SimpleNamespace(__module__=module))})


@pytest.mark.parametrize(
    ("module", "seconds", "on_purpose", "said"),
    [
        ("mdr.x", 6.0, False, [1, 3, 4]),
        ("mdr.x", 6.0, True, []),
        ("mdr.x", 0.1, False, []),
        ("scipy.x", 60.0, False, []),
    ],
)
def test_a_long_compilation_says_every_ten_seconds_how_much_is_done(
    module, seconds, on_purpose, said, monkeypatch, capsys
):
    now = count(0.0, seconds)
    monkeypatch.setattr(jit.time, "monotonic", lambda: next(now))
    notice = jit.Compiling()
    with unsaid() if on_purpose else nullcontext():
        for _ in range(4):
            notice.on_start(compiling(module))
        for _ in range(4):
            notice.on_end(compiling(module))
    assert TALLY.open == 0
    lines = capsys.readouterr().err.splitlines()
    assert [int(line.split(": ")[1].split()[0]) for line in lines] == said
    assert all(line.startswith("compiling, once on this machine") for line in lines)


def test_what_is_compiled_is_counted_and_cycles_are_searched_for_again_at_its_end():
    seen = []
    for module in ("scipy.x", "mdr.x"):
        for status in (EventStatus.START, EventStatus.START, EventStatus.END, EventStatus.END):
            event.broadcast(event.Event("numba:compile", status, data=compiling(module).data))
            seen.append((TALLY.open, gc.isenabled()))
    assert seen == [(0, True)] * 4 + [(1, False), (2, False), (1, False), (0, True)]
