"""The compiled march is the written one: Python alone comes to the same, and reads no element that is not there."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numba
import numpy as np
import pytest
import small_runs
from numpy.testing import assert_allclose

from mdr.march.dynamics.body_step import SHORTEST_PART


@pytest.mark.skipif(numba.config.DISABLE_JIT, reason="nothing is compiled")
def test_small_runs_come_to_the_same_in_python_where_numba_is_missing(tmp_path):
    """Compiled code does not look whether an index is in range, and Python does."""
    (tmp_path / "numba.py").write_text('raise ImportError("no numba here")')
    path = os.pathsep.join([str(tmp_path), *filter(None, [os.environ.get("PYTHONPATH")])])
    command = [sys.executable, str(Path(small_runs.__file__))]
    plain = subprocess.run(
        command, env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True, check=True, timeout=600
    )
    assert "numba cannot be imported (no numba here): runs go on in Python" in plain.stderr
    expected, got = json.loads(plain.stdout), small_runs.results()
    assert expected.keys() == got.keys()
    for name, numbers in got.items():
        scale = np.nanmax(np.abs(expected[name]))
        # the compiler may contract and reorder, and springs with arms stop 1e-13 of their size short of their period
        # on these steps a body is light, and it is a matter of roundings whether one in which a spring touches within
        # SHORTEST_PART of an end is cut there
        # intervals of springs are halved for the force, which roundings decide, and the share of stick is not looked at
        close = 10 * SHORTEST_PART if "body" in name else 1e-5 if "share of stick" in name else 1e-10
        assert_allclose(numbers, expected[name], rtol=0, atol=close * scale, err_msg=name)
