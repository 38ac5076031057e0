"""The store: what cannot be used or written is an error that says what to do, and no finished chunk is lost."""

import errno
import json
import os
import re
import shutil
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from grids import BODY, RIGID, SHAPES, depth

import mdr
from mdr.studies import engine, specification
from mdr.studies.points import Points
from mdr.studies.store import Store, _packed
from mdr.tools.sources import texts
from mdr.tools.status import Status

SHAKE = mdr.InPlaneOscillation(omega=300.0, du_x=1e-6)
AXES = {"mu_0": np.linspace(0.1, 0.9, 8).tolist(), "indenter": SHAPES[:2]}
POINTS = Points(np.array([[1.0, np.nan]]), np.array([0, 2], np.uint8), np.array(["", "µ no"], object))
LEFT = ["study.json", "study.nc"]  # of a finished study


def small(store, axes=AXES, case=RIGID, quantities=("v_c", "static_cof"), **options):
    """16 chunks of one point."""
    return mdr.sweep(case, axes, store, quantities=quantities, chunk_seconds=1e-9, **options)


@pytest.fixture(scope="module")
def whole():
    return small(None)


@pytest.fixture
def part_done(tmp_path):
    """A store with half of its chunks: 0, 2, 4, ..."""
    small(tmp_path / "store", shard="1/2")
    return tmp_path / "store"


def test_a_finished_store_holds_two_files_and_is_read_not_computed(part_done, whole, monkeypatch):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert small(part_done) == whole
        assert sorted(os.listdir(part_done)) == LEFT
        monkeypatch.setattr("mdr.studies.engine.run", None)
        monkeypatch.setattr(os, "fsync", None)  # nor is anything written
        again = small(part_done)
    assert again == mdr.read_study(part_done) == whole
    assert again.axes["indenter"] == tuple(SHAPES[:2])  # records, not labels


# --- damage and leftovers ---


@pytest.mark.parametrize("shard", [None, "2/2"])
@pytest.mark.parametrize("change", ["cut", "empty", "flip", "text", "shape", "of another place", "of another study"])
def test_a_damaged_chunk_is_left_out_when_read_and_computed_again(part_done, whole, change, shard):
    chunks, before = part_done / "chunks", mdr.read_study(part_done)
    data = (chunks / "000004.npz").read_bytes()
    place = data.index(np.float64(whole["v_c"].ravel()[4]).tobytes())
    (chunks / "000004.npz").write_bytes({
        "cut": data[: len(data) // 2],
        "empty": b"",
        "flip": data[:place] + bytes([data[place] ^ 1]) + data[place + 1 :],
        "text": b"not an archive",
        "shape": _packed(4, before.identity, POINTS),
        "of another place": (chunks / "000002.npz").read_bytes(),
        "of another study": _packed(4, "other", Points.blank(2, 1, Status.DONE)),
    }[change])  # fmt: skip
    assert mdr.read_study(part_done).count(Status.MISSING) == before.count(Status.MISSING) + 1
    with pytest.warns(UserWarning, match="chunk 4 is damaged and is computed again"):
        assert small(part_done, shard=shard) == whole


def test_leftovers_of_killed_runs_are_cleared(part_done, whole, monkeypatch):
    for folder in (part_done, part_done / "chunks"):
        (folder / ".study.nc-123-0a1b2c3d.part").write_bytes(b"half")
    with monkeypatch.context() as patch:  # a kill between the merge and the clearing
        patch.setattr(Store, "clear", lambda store: None)
        small(part_done)
    assert {*LEFT, "chunks"} < set(os.listdir(part_done))
    assert mdr.read_study(part_done) == small(part_done) == whole
    assert sorted(os.listdir(part_done)) == LEFT


@pytest.mark.parametrize("method", ["require_writable", "plan", "finished", "load", "write", "merge"])
def test_another_process_may_merge_at_any_moment(part_done, whole, monkeypatch, method):
    """Before this step of one call, another call finishes the study."""
    real, others = getattr(Store, method), []

    def late(store, *args):
        if not others:
            others.append(None)
            others.append(small(part_done))
        return real(store, *args)

    monkeypatch.setattr(Store, method, late)
    assert small(part_done) == whole
    assert others == [None, whole]
    assert sorted(os.listdir(part_done)) == LEFT


# --- stores that are of no use ---


def of_another(store):
    small(store)
    small(store / "two", axes={"mu_0": [0.3]})
    shutil.move(store / "two" / "study.nc", store / "study.nc")


def of_a_thesis(store):
    shutil.rmtree(store)
    store.mkdir()
    (store / "thesis.tex").write_text("")


HEAD, PLAN = "study.json", "chunks/plan.json"
#: a file of a store and damaged texts of it, or another change, what a call says, and what reading says where it fails
USELESS = [
    (HEAD, ("", "{", "[]", "{}", '{"identity": 3}'), "study.json: is damaged", "study.json: is damaged"),
    (PLAN, ("", "[]", "{}", '{"n_units": 16, "units_per_chunk": 0}'), "remove the folder", "remove the folder"),
    (PLAN, ('{"n_units": 7, "units_per_chunk": 1}',), "its plan is of another study; remove that folder", None),
    ("study.nc", ("", "CDF\x02", "hello"), "is no study, or a damaged one", "is no study, or a damaged one"),
    (None, (of_another,), "is of another study than study.json beside it", None),
    (None, (of_a_thesis,), "holds other files (thesis.tex) and no study.json", "holds no study"),
    (None, (shutil.rmtree,), None, "cannot be read: No such file"),
]


@pytest.mark.parametrize(("file", "change", "told", "read"), [
    (file, change, *words) for file, changes, *words in USELESS for change in changes
])  # fmt: skip
def test_a_store_of_no_use_says_what_to_do_and_is_left_alone(part_done, file, change, told, read):
    if file:
        (part_done / file).write_text(change)
    else:
        change(part_done)
    before = [path for path in part_done.rglob("*") if "chunks" not in path.parts]
    for call, words in ((mdr.read_study, read), (small, told)):
        if words:
            with pytest.raises(mdr.studies.StudyError, match=f"^{re.escape(str(part_done))}.*{re.escape(words)}"):
                call(part_done)
            assert [path for path in part_done.rglob("*") if "chunks" not in path.parts] == before


OTHER = replace(BODY, indenter=SHAPES[1], material=mdr.Elastic(3e6, 0.5), oscillation=mdr.ConstantLoad(1), shake=SHAKE)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"axes": {**AXES, "mu_0": [0.1, 0.2]}}, "axes.mu_0 is [0.1, 0.21428"),
        ({"axes": {"mu_0": AXES["mu_0"]}}, "axes.indenter is in the store only"),
        ({"axes": {**AXES, "T": [1.0]}}, "axes.T is in this call only"),
        ({"axes": dict(reversed(AXES.items()))}, 'order of axes is ["mu_0", "indenter"] there and ["ind'),
        ({"case": BODY}, "case.pull is RigidPull() there and SpringPull(k_x=20000.0, m=0.1, c_x=4.0, k_y=null, c_"),
        ({"quantities": ["v_c"]}, 'quantities is ["v_c", "static_cof"] there and ["v_c"] here'),
        ({"quantities": [mdr.Quantity("own", "m", depth)]}, 'there and [{"name": "own", "unit": "m", "meaning": "",'),
        ({"n_springs": 64, "steps_per_period": 64}, "n_springs is null there and 64 here; steps_per_period is null"),
        ({"case": OTHER}, "; and 1 more"),
    ],
)  # fmt: skip
def test_a_store_of_another_study_says_what_differs(part_done, change, words):
    with pytest.raises(mdr.studies.StudyError, match="is the store of another study") as caught:
        small(part_done, **change)
    assert words in str(caught.value)
    assert str(part_done) in str(caught.value)


def test_a_store_is_of_one_version_and_of_the_sources_that_can_move_a_value(part_done, monkeypatch):
    known = specification.code()
    for name, counts in {"plots.figures": 0, "commands.sweep": 0, "tools.anderson": 1, "march.kernels": 1}.items():
        monkeypatch.setitem(texts(), f"mdr.{name}", "")
        assert (specification.code() != known) == bool(counts)
    monkeypatch.setattr("mdr.tools.version.__version__", "9.9")
    words = f"mdr is 0.1.0 there and 9.9 here; code of mdr is {known} there and {specification.code()} here"
    with pytest.raises(mdr.studies.StudyError, match=words):
        small(part_done)


# --- disks that are full or cannot be written ---

NO_ROOM = r"no room to write 0000\d\d.npz \(.*\); (\d+) of 16 chunks are safe in .*; free space and repeat the call"
LOCKED = r"chunks cannot be written \(.*\); make the folder writable, or give another store"


@pytest.mark.parametrize(
    ("code", "after", "words"),
    [*[(code, 6, NO_ROOM) for code in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)],
     *[(code, 0, LOCKED) for code in (errno.EROFS, errno.EACCES)],
     (errno.EIO, 0, r"chunks cannot be written \(Input/output error\); repeat the call once that is mended")],
)  # fmt: skip
def test_a_disk_that_fails(part_done, whole, monkeypatch, code, after, words):
    """The system refuses every file after the first ones."""
    sync, compute, calls, computed = os.fsync, engine.compute, [], []

    def fsync(descriptor):
        calls.append(1)
        if len(calls) > after:
            raise OSError(code, os.strerror(code))
        sync(descriptor)

    monkeypatch.setattr(engine, "compute", lambda work, *units: (computed.append(units), compute(work, *units))[1])
    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", fsync)
        with pytest.raises(mdr.studies.StudyError, match=words) as caught:
            small(part_done)
    kept = len(list(part_done.glob("chunks/*.npz")))
    if after:
        assert re.search(NO_ROOM, str(caught.value))[1] == str(kept)
        assert kept > 8
    else:
        assert computed == []  # found out before any work
    assert not list(part_done.rglob("*.part"))
    computed.clear()
    assert small(part_done) == whole
    assert len(computed) == 16 - kept


def test_the_names_in_a_store_stay(part_done):
    """What is on the disk is read by other versions."""
    head = json.loads((part_done / "study.json").read_text())
    assert set(head) == {"identity", "specification", "frame", "block"}
    assert json.loads((part_done / PLAN).read_text()) == {"n_units": 16, "units_per_chunk": 1}
    with np.load(Path(part_done) / "chunks" / "000004.npz") as chunk:
        assert set(chunk) == {"values", "status", "head"}


class Plain(mdr.Indenter):
    """A shape that is no dataclass."""

    def profile_1d(self, x):
        return 100.0 * np.square(x)


@pytest.mark.parametrize(
    ("shape", "words"),
    [(Plain(), "cannot be told by its data, as a store must"),
     (mdr.Profile(lambda r: 100 * r**2), r"Profile holds a function, which a store cannot compare .* name it")],
)  # fmt: skip
def test_what_cannot_be_told_by_its_data_is_refused_in_a_store_alone(tmp_path, shape, words):
    options = {"axes": {"indenter": [shape]}, "quantities": ["k_zc"]}
    with pytest.raises(ValueError, match=words):
        small(tmp_path / "store", **options)
    assert not (tmp_path / "store").exists()
    found = small(None, **options)
    assert (found.complete, found.identity) == (True, "")


def test_two_may_merge_at_once(part_done, monkeypatch):
    """The other has merged and cleared away, as a leftover, the very file that this one was about to move in."""
    small(part_done)
    data, real = (part_done / "study.nc").read_bytes(), os.replace
    monkeypatch.setattr(os, "replace", lambda partial, path: (os.unlink(partial), real(partial, path)))
    Store(part_done).merge(data)
    (part_done / "study.nc").unlink()
    with pytest.raises(mdr.studies.StudyError, match=r"study.nc cannot be written \(No such file"):
        Store(part_done).merge(data)


def test_a_file_in_the_place_of_the_folder(tmp_path):
    (tmp_path / "store").write_text("")
    with pytest.raises(mdr.studies.StudyError, match="is a file; give a folder for the store"):
        small(tmp_path / "store")
    with pytest.raises(mdr.studies.StudyError, match=r"store/inside: study.json cannot be written"):
        small(tmp_path / "store" / "inside")
