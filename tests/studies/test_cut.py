"""How work is cut: by the time of a few units, without looking at all of them."""

import tracemalloc

import numpy as np
import pytest
from grids import RIGID

import mdr
from mdr.studies import engine as module
from mdr.studies.axes import read_axes
from mdr.studies.engine import MOST_TRIALS, Call, timed
from mdr.studies.points import compute
from mdr.studies.quantities import CATALOGUE
from mdr.studies.store import Store
from mdr.studies.work import Cut, Work


def work(n, quantity="v_c"):
    axes = {"mu_0": np.linspace(0.1, 0.9, n), "indenter.R": np.linspace(1e-3, 9e-3, n)}
    return Work(RIGID, read_axes(RIGID, axes), (CATALOGUE[quantity],))


def test_chunks_cover_all_units():
    cut = Cut(n_units=10, units_per_chunk=4)
    assert [cut.units(i) for i in range(cut.n_chunks)] == [(0, 4), (4, 8), (8, 10)]


@pytest.fixture
def clock(monkeypatch):
    """Every unit takes a quarter of a second."""
    now, units = [0.0], []

    def clocked(work, start, stop):
        units.append(start)
        now[0] += 0.25

    monkeypatch.setattr(module, "compute", clocked)
    monkeypatch.setattr(module.time, "perf_counter", lambda: now[0])
    return units


def test_a_chunk_lasts_as_long_as_it_is_told(clock):
    assert timed(work(100), 5.0) == Cut(10_000, 20)
    assert timed(work(100), 0.1) == Cut(10_000, 1)


def test_some_units_spread_over_the_grid_are_timed_for_a_second_or_so(clock):
    timed(work(100), 5.0)
    warm_up, *units = clock
    assert len(units) == 5  # each a quarter of a second, until more than one is over
    assert warm_up == units[0]
    assert max(units) - min(units) > 5000


def test_there_are_chunks_enough_to_share(clock):
    assert timed(work(8), 1e6).n_chunks == 32
    assert timed(work(4), 1e6).n_chunks == 16


def test_few_units_are_not_timed_at_all(clock):
    assert timed(work(4), 5.0) == Cut(16, 1)
    assert clock == []


def test_a_million_points_are_planned_by_a_few_cases(tmp_path, monkeypatch):
    """Planning, and the first chunk, touch few cases and little memory: arrays of the points, and nothing a point."""
    built = []
    real = mdr.SlidingContact.__post_init__
    monkeypatch.setattr(mdr.SlidingContact, "__post_init__", lambda case: (built.append(1), real(case))[1])
    stopped = RuntimeError("planned")

    def run(work, cut, chunks, executor, take):
        compute(work, 0, 1)
        raise stopped

    monkeypatch.setattr("mdr.studies.engine.run", run)
    axes = {"mu_0": np.linspace(0.1, 0.9, 100), "indenter.R": np.linspace(1e-3, 9e-3, 100), "T": np.linspace(0, 1, 100)}
    tracemalloc.start()
    with pytest.raises(RuntimeError, match="planned"):
        mdr.sweep(RIGID, axes, tmp_path / "store", quantities=["v_c", "alpha"])
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert len(built) <= 2 * MOST_TRIALS
    assert peak < 100e6  # two quantities, status and reason of a million points are 21 MB


def test_a_study_of_a_store_is_cut_as_the_store_has_it(tmp_path):
    given = work(8)
    store = Store(tmp_path / "store")
    call = Call(given, store, None)
    store.folder.mkdir()
    store.chunks.mkdir()
    store.settle(Cut(64, 7))
    assert call._cut(store, 5.0) == Cut(64, 7)
    assert store.settle(Cut(64, 9)).units_per_chunk == 7
