"""The work: every point in one unit, the velocity innermost, cut by the time of a few units, told by its data."""

import pickle
import tracemalloc
from dataclasses import dataclass, replace

import numpy as np
import pytest
from grids import BODY, RIGID, work
from numpy.testing import assert_array_equal

import mdr
from mdr.studies import engine
from mdr.studies.engine import LEAST_CHUNKS, timed
from mdr.studies.points import compute
from mdr.studies.specification import described, identity_of, specification
from mdr.studies.store import Store
from mdr.studies.work import MARCHED, Layout, units_of

LAYOUTS = [
    Layout((3,), None, 64),
    Layout((3, 4), None, 64),
    Layout((5,), 0, 2),
    Layout((2, 5, 3), 1, 2),
    Layout((5, 2, 3), 0, 5),
    Layout((2, 3, 5), 2, 8),
    Layout((1, 1), 0, 64),
]
N = (4, 8, 100)
SQUARES = [{"mu_0": np.linspace(0.1, 0.9, n), "indenter.R": np.linspace(1e-3, 9e-3, n)} for n in N]


FEW, SOME, MANY = (work(RIGID, axes) for axes in SQUARES)


@pytest.mark.parametrize("layout", LAYOUTS, ids=str)
def test_units_cover_every_point_once_and_in_order(layout):
    places = np.arange(layout.n_points).reshape(layout.shape)
    flat = np.full((2, layout.n_points), -1)  # of two quantities
    for unit in range(layout.n_units):
        part, own = layout.velocities(unit), layout.points(range(unit, unit + 1))
        assert own.stop - own.start == part.stop - part.start <= layout.block
        where = list(layout.case(unit))
        if layout.velocity is not None:
            where.insert(layout.velocity, part)
        flat[:, own] = np.atleast_1d(places[tuple(where)])
    assert_array_equal(layout.in_place(flat), [places, places])
    assert layout.points(range(layout.n_units)) == slice(0, layout.n_points)


def test_a_study_is_many_units_of_one_case_each():
    v_0 = np.linspace(0, 1e-3, 130)
    for case, pulls, block in (
        (RIGID, None, v_0.size),
        (BODY, None, MARCHED),
        (BODY, [mdr.RigidPull()], v_0.size),
        (RIGID, [mdr.RigidPull(), BODY.pull], MARCHED),
    ):
        layout = work(case, {"v_0": v_0} | ({"pull": pulls} if pulls else {})).layout
        assert (layout.block, layout.n_units) == (block, -(-130 // block) * len(pulls or [1]))
    given = work(RIGID, {"v_0": v_0, "T": [0.1, 1.0, 2.0]}, ["cof", "v_c"])
    parts = [compute(given, range(unit, unit + 1)).values for unit in range(3)]
    assert_array_equal(np.concatenate(parts, axis=1), compute(given, range(3)).values)


# --- chunks ---


@pytest.fixture
def clock(monkeypatch):
    """Every unit takes a quarter of a second."""
    now, units = [0.0], []

    def compute(work, chunk):
        units.append(chunk.start)
        now[0] += 0.25

    monkeypatch.setattr(engine, "compute", compute)
    monkeypatch.setattr(engine.time, "perf_counter", lambda: now[0])
    return units


def test_a_chunk_lasts_as_long_as_it_is_told(clock):
    cut = range(0, 10, 4)
    assert [units_of(cut, i) for i in range(len(cut))] == [range(4), range(4, 8), range(8, 10)]
    assert timed(MANY, 5.0) == range(0, 10_000, 20)
    warm_up, *units = clock
    assert len(units) == 21  # until it took longer than a chunk
    assert warm_up == units[0]
    assert max(units) - min(units) > 5000
    assert timed(MANY, 0.1) == range(10_000)


def test_there_are_chunks_enough_to_share(clock):
    assert len(timed(SOME, 1e6)) == 32
    clock.clear()
    assert timed(FEW, 5.0) == range(16)
    assert clock == []


def test_all_processes_on_a_store_cut_as_the_first(tmp_path):
    store = Store(tmp_path)
    store.require_writable()
    assert store.settle(range(0, 64, 7)) == store.settle(range(0, 64, 9)) == range(0, 64, 7)
    mdr.sweep(RIGID, SQUARES[1], tmp_path / "of a study", quantities=["v_c"], chunk_seconds=1e9, shard="1/2")
    first = Store(tmp_path / "of a study").plan()
    mdr.sweep(RIGID, SQUARES[1], tmp_path / "of a study", quantities=["v_c"], chunk_seconds=1e-9, shard="1/2")
    assert Store(tmp_path / "of a study").plan() == first == range(0, 64, 2)


def test_a_million_points_are_planned_by_a_few_cases(tmp_path, monkeypatch):
    """Planning, and the first chunk, touch few cases and little memory: arrays of the points, and nothing a point."""
    built = []
    real = mdr.SlidingContact.__post_init__
    monkeypatch.setattr(mdr.SlidingContact, "__post_init__", lambda case: (built.append(1), real(case))[1])

    def run(work, cut, chunks, executor):
        compute(work, range(1))
        raise RuntimeError("planned")

    monkeypatch.setattr(engine, "run", run)
    tracemalloc.start()
    with pytest.raises(RuntimeError, match="planned"):
        mdr.sweep(RIGID, {**SQUARES[2], "T": np.linspace(0, 1, 100)}, tmp_path, quantities=["v_c", "alpha"])
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert len(built) <= 3 * LEAST_CHUNKS  # each trial varies the case, and turns it to the pull
    assert peak < 100e6  # two quantities, status and reason of a million points are 21 MB


# --- what makes two studies the same ---


@dataclass(frozen=True)
class Bowl(mdr.Indenter):
    """A shape of one's own."""

    curvature: float

    def profile_1d(self, x):
        return self.curvature * np.square(x)


def test_a_study_is_told_by_what_was_asked():
    """Not by the kind of its numbers; what differs between two is asked of their stores."""
    one, other = (
        identity_of(specification(work(replace(RIGID, mu_0=kind(0.5)), {"T": row([0.1, 0.2])})))
        for kind, row in ((float, list), (np.float64, np.array))
    )
    assert one == other
    assert described(mdr.Prony(1e6, [(1e6, 1e-3)], 0.5)) == (
        "Prony(E_inf=1000000.0, arms=[[1000000.0, 0.001]], nu=0.5, tau=0.0)"
    )
    assert described((np.float64(0.1), np.arange(2), None, "a", True, Bowl(100.0))) == [
        0.1, [0, 1], None, "a", True, f"{__name__}.Bowl(curvature=100.0)",
    ]  # fmt: skip


def test_a_work_that_is_sent_in_pieces_is_read_once():
    """So that what is mapped of a shape of one's own stays known to a worker."""
    sent = pickle.dumps(work(RIGID, {"mu_0": [0.2, 0.4], "v_0/v_c": [0.5]}))
    pieces = [engine.compute_sent(sent, range(k, k + 1)).values for k in range(2)]
    assert_array_equal(np.hstack(pieces), compute(pickle.loads(sent), range(2)).values)
    assert engine._sent(sent) is engine._sent(bytes(bytearray(sent)))
