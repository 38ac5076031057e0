"""Compiled functions outlive their process where they can, and work where they cannot."""

import os
import subprocess
import sys

import numba
import pytest

from mdr.tools.jit import compiled

compiles = pytest.mark.skipif(numba.config.DISABLE_JIT, reason="nothing is compiled")
DOUBLE = """
from mdr.tools.jit import compiled

@compiled(nogil=True)
def double(x):
    return 2 * x

assert double(1.5) == 3.0
print(sum(double.stats.cache_hits.values()), sum(double.stats.cache_misses.values()))
"""


@compiles
def test_the_next_process_finds_what_was_compiled(tmp_path):
    (tmp_path / "double.py").write_text(DOUBLE)
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "kept")}
    said = [
        subprocess.run([sys.executable, tmp_path / "double.py"], env=environment, capture_output=True, text=True).stdout
        for _ in range(2)
    ]
    assert said == ["0 1\n", "1 0\n"]


@compiles
def test_without_a_folder_to_write_to_it_is_compiled_all_the_same(monkeypatch):
    def refuse(*args, **options):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("tempfile.TemporaryFile", refuse)  # how numba finds out
    with pytest.warns(UserWarning, match="NUMBA_CACHE_DIR") as told:
        double = compiled(nogil=True)(lambda x: 2 * x)
    assert len(told) == 1
    assert double(1.5) == 3.0
    assert double.signatures  # compiled, not left to Python
