"""Compilation: what takes long is said, with how much is done."""

from itertools import count
from types import SimpleNamespace

import pytest

from mdr.tools import jit


def compiling(module):
    return SimpleNamespace(data={"dispatcher": SimpleNamespace(py_func=SimpleNamespace(__module__=module))})


@pytest.mark.parametrize(
    ("module", "seconds", "said"), [("mdr.march.kernels", 6.0, [1, 3]), ("mdr.x", 0.1, []), ("scipy.x", 60.0, [])]
)
def test_a_long_compilation_says_every_ten_seconds_how_much_is_done(module, seconds, said, monkeypatch, capsys):
    now = count(0.0, seconds)
    monkeypatch.setattr(jit.time, "monotonic", lambda: next(now))
    notice = jit.Notice()
    for _ in range(4):
        notice.on_start(compiling(module))
    for _ in range(4):
        notice.on_end(compiling(module))
    assert notice.open == 0
    lines = capsys.readouterr().err.splitlines()
    assert [int(line.split(": ")[1].split()[0]) for line in lines] == said
    assert all(line.startswith("compiling, once on this machine: ") for line in lines)
