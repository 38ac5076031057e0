"""Compilation: what takes long is said once."""

from itertools import count
from types import SimpleNamespace

import pytest

from mdr.tools import jit


def compiling(module):
    return SimpleNamespace(data={"dispatcher": SimpleNamespace(py_func=SimpleNamespace(__module__=module))})


@pytest.mark.parametrize(
    ("module", "seconds", "said"), [("mdr.march.kernels", 3.0, 1), ("mdr.x", 0.1, 0), ("scipy.x", 9.0, 0)]
)
def test_a_long_compilation_is_said_once(module, seconds, said, monkeypatch, capsys):
    now = count(0.0, seconds)
    monkeypatch.setattr(jit.time, "monotonic", lambda: next(now))
    notice = jit.Notice()
    for _ in range(3):
        notice.on_start(compiling(module))
    for _ in range(3):
        notice.on_end(compiling(module))
    assert notice.open == 0
    assert capsys.readouterr().err.count("compiling, once on this machine") == said
