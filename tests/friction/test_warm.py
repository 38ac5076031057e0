"""Compiling ahead: said as kinds of run, complete, and from the disk the next time."""

from itertools import product

import numba
import pytest

import mdr
from mdr.__main__ import main
from mdr.closed_forms import shaken_spring
from mdr.friction import warm
from mdr.march.dynamics import loop
from mdr.march.dynamics.kernel import kernel_of
from mdr.march.periodic import anderson


def all_compiled():
    """Compiled variants of the functions that runs enter by."""
    entries = loop.look, anderson.seek, shaken_spring.all_springs
    return {one.__name__: len(one.signatures) for one in entries} | {"kernels": kernel_of.cache_info().currsize}


@pytest.mark.skipif(numba.config.DISABLE_JIT, reason="nothing is compiled")
@pytest.mark.parametrize("material", warm.MATERIALS[1:2], ids=lambda one: type(one).__name__)  # Kelvin
def test_after_the_kinds_of_run_a_run_compiles_nothing(material):
    for kind in warm.kinds_of_run((material,)):
        kind()
    before = all_compiled()
    for pull in warm.PULLS:
        case = mdr.SlidingContact(mdr.Cone(theta=0.02), material, 0.3, warm.MOTION, pull)
        mdr.slide(case, 0.3 * mdr.full_slip_critical_velocity(case), accuracy=1e-3)
    along = mdr.InPlaneOscillation(omega=2 * warm.MOTION.omega, du_x=2e-6)
    for shake, pull in product((warm.ACROSS, along), warm.PULLS[:2]):
        shaken = mdr.SlidingContact(mdr.Cone(theta=0.02), material, 0.3, warm.MOTION, pull, shake)
        mdr.cof_curve(shaken, [1e-3], accuracy=1e-3)
    assert all_compiled() == before
    assert before["kernels"] >= len(warm.PULLS)


def test_the_command_says_how_many_kinds_and_each_is_compiled_once(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(warm, "kinds_of_run", lambda *_: [None] * 5)
    kept = f"import pathlib, sys\nfor n in sys.stdin:\n    (pathlib.Path({str(tmp_path)!r}) / n.strip()).touch(False)"
    monkeypatch.setattr(warm, "OTHER", kept + "\n    print(flush=True)")
    assert main(["warm"]) == 0
    assert sorted(one.name for one in tmp_path.iterdir()) == ["0", "1", "2", "3", "4"]
    assert capsys.readouterr().out.startswith("5 kinds of run")


def test_where_compiling_fails_it_is_said(monkeypatch):
    monkeypatch.setattr(warm, "OTHER", "raise SystemExit(7)")
    with pytest.raises(RuntimeError, match="ended with status 7"):
        warm.compile_all()
