"""The store: what cannot be used or written is an error that says what to do, and no finished chunk is lost."""

import errno
import os
import subprocess
import warnings
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from grids import RIGID, RUNS, SHAPES, depth, study
from numpy.testing import assert_array_equal

import mdr
from mdr.studies import specification
from mdr.studies.points import Part, Status
from mdr.studies.store import Store, _packed, _unpacked
from mdr.tools.sources import texts

AXES = {"mu_0": np.linspace(0.1, 0.9, 24).tolist(), "indenter": SHAPES[:2]}
PART = Part(np.array([[1.0, np.nan]]), np.array([0, 2], np.uint8), np.array([0, 1], np.int32), ("", "µ no"))


def small(store, axes=AXES, **options):
    """48 chunks of one point."""
    return mdr.sweep(RIGID, axes, store, quantities=["v_c", "static_cof"], chunk_seconds=1e-9, **options)


def bytes_of(store):
    return (Path(store) / "study.nc").read_bytes()


@pytest.fixture
def part_done(tmp_path):
    """A store with the odd half of its chunks."""
    small(tmp_path / "store", shard="1/2")
    return tmp_path / "store"


# --- what is written ---


def test_a_finished_store_holds_two_files(tmp_path):
    found = small(tmp_path / "store")
    assert sorted(os.listdir(tmp_path / "store")) == ["study.json", "study.nc"]
    assert mdr.read_study(tmp_path / "store") == found == small(tmp_path / "store")
    assert found == small(None)


def test_a_finished_store_is_read_not_computed(tmp_path, monkeypatch):
    found = small(tmp_path / "store")
    monkeypatch.setattr("mdr.studies.engine.run", None)
    monkeypatch.setattr(os, "fsync", None)
    again = small(tmp_path / "store")
    assert again == found
    assert again.axes["indenter"] == tuple(SHAPES[:2])  # records, not labels


def test_a_chunk_comes_back_as_it_went():
    back = _unpacked(3, "id", _packed(3, "id", PART))
    assert back == PART


@pytest.mark.parametrize(("number", "identity"), [(4, "id"), (3, "other")])
def test_a_chunk_of_another_place_or_study_is_no_chunk(number, identity):
    with pytest.raises(ValueError, match="the checksum is another"):
        _unpacked(number, identity, _packed(3, "id", PART))


@pytest.mark.parametrize("change", ["cut", "empty", "flip", "text", "shape"])
def test_a_damaged_chunk_is_noticed_and_computed_again(tmp_path, part_done, change):
    path = part_done / "chunks" / "000004.npz"
    data = path.read_bytes()
    place = data.index(np.float64(small(None)["v_c"].ravel()[4]).tobytes())
    damaged = {
        "cut": data[: len(data) // 2],
        "empty": b"",
        "flip": data[:place] + bytes([data[place] ^ 1]) + data[place + 1 :],
        "text": b"not an archive",
        "shape": _packed(4, mdr.read_study(part_done).identity, PART),
    }[change]
    path.write_bytes(damaged)
    with pytest.warns(UserWarning, match="chunk 4 is damaged and is computed again"):
        found = small(part_done)
    assert found == small(None)
    small(tmp_path / "other")
    assert bytes_of(part_done) == bytes_of(tmp_path / "other")


def test_what_is_read_of_a_study_leaves_a_damaged_chunk_out(part_done):
    before = mdr.read_study(part_done)
    (part_done / "chunks" / "000004.npz").write_bytes(b"")
    now = mdr.read_study(part_done)
    assert now.count(Status.MISSING) == before.count(Status.MISSING) + 1
    there = now.status != Status.MISSING
    assert_array_equal(now["v_c"][there], before["v_c"][there])


def test_a_damaged_chunk_of_another_shard_is_computed_again(part_done):
    (part_done / "chunks" / "000004.npz").write_bytes(b"")
    with pytest.warns(UserWarning, match="chunk 4 is damaged"):
        assert small(part_done, shard="2/2").complete


def test_leftovers_of_killed_runs_are_cleared(part_done):
    for folder in (part_done, part_done / "chunks"):
        (folder / ".study.nc-123-0a1b2c3d.part").write_bytes(b"half")
    small(part_done)
    assert sorted(os.listdir(part_done)) == ["study.json", "study.nc"]


def test_a_kill_between_the_merge_and_the_clearing_is_made_good(part_done, monkeypatch):
    with monkeypatch.context() as patch:
        patch.setattr(Store, "clear", lambda store: None)
        small(part_done)
    assert sorted(os.listdir(part_done)) == ["chunks", "study.json", "study.nc"]
    assert mdr.read_study(part_done).complete
    small(part_done)
    assert sorted(os.listdir(part_done)) == ["study.json", "study.nc"]


# --- two at a time ---


@pytest.mark.parametrize("method", ["require_writable", "plan", "finished", "read", "write", "merge"])
def test_another_process_may_merge_at_any_moment(part_done, monkeypatch, method):
    """Before this step of one call, another call finishes the study."""
    real, calls = getattr(Store, method), []

    def slow(store, *args):
        if not calls:
            calls.append(1)
            other = small(part_done)
            assert other.complete
        return real(store, *args)

    monkeypatch.setattr(Store, method, slow)
    found = small(part_done)
    assert calls
    assert found == mdr.read_study(part_done)
    assert sorted(os.listdir(part_done)) == ["study.json", "study.nc"]


def test_two_may_merge_at_once(tmp_path, monkeypatch):
    """The other has merged and cleared away, as a leftover, the very file that this one was about to move in."""
    small(tmp_path / "store")
    data, real = bytes_of(tmp_path / "store"), os.replace

    def too_late(partial, path):
        os.unlink(partial)
        real(partial, path)

    monkeypatch.setattr(os, "replace", too_late)
    Store(tmp_path / "store").merge(data)
    (tmp_path / "store" / "study.nc").unlink()
    with pytest.raises(mdr.StudyError, match=r"study.nc cannot be written \(No such file"):
        Store(tmp_path / "store").merge(data)


# --- stores that are of no use ---


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"axes": {**AXES, "mu_0": [0.1, 0.2]}}, "axes.mu_0 is [0.1, 0.13478"),
        ({"axes": {"mu_0": AXES["mu_0"]}}, "axes.indenter is in the store only"),
        ({"axes": {**AXES, "T": [1.0]}}, "axes.T is in this call only"),
        (
            {"axes": dict(reversed(AXES.items()))},
            'order of axes is ["mu_0", "indenter"] there and ["indenter", "mu_0"]',
        ),
        ({"case": RUNS[0]}, "case.pull is RigidPull() there and SpringPull(k_x=20000.0, m=0.1, c_x=4.0) here"),
        ({"quantities": ["v_c"]}, 'quantities is ["v_c", "static_cof"] there and ["v_c"] here'),
        ({"n_springs": 64}, "n_springs is null there and 64 here"),
    ],
)
def test_a_store_of_another_study_says_what_differs(part_done, change, words):
    given = {"case": RIGID, "axes": AXES, "quantities": ["v_c", "static_cof"], **change}
    with pytest.raises(mdr.StudyError, match="is the store of another study") as caught:
        mdr.sweep(store=part_done, **given)
    assert words in str(caught.value)
    assert str(part_done) in str(caught.value)


def test_a_store_of_another_version_or_of_other_sources(part_done, monkeypatch):
    monkeypatch.setattr("mdr.tools.version.__version__", "9.9")
    known = specification.code()
    monkeypatch.setitem(texts(), "mdr.march.kernels", "")
    words = (
        f'version of mdr is "0.1.0" there and "9.9" here; code of mdr is "{known}" there and "{specification.code()}"'
    )
    with pytest.raises(mdr.StudyError, match=words):
        small(part_done)


def test_differences_beyond_some_are_counted():
    there = {f"key {i}": i for i in range(9)}
    assert specification.differences(there, {}).endswith("; and 5 more")


def test_a_file_in_the_place_of_the_folder(tmp_path):
    (tmp_path / "store").write_text("")
    with pytest.raises(mdr.StudyError, match="is a file; give a folder for the store"):
        small(tmp_path / "store")
    with pytest.raises(mdr.StudyError, match=r"store/inside: study.json cannot be written"):
        small(tmp_path / "store" / "inside")


def test_a_folder_with_other_files_is_left_alone(tmp_path):
    (tmp_path / "thesis.tex").write_text("")
    with pytest.raises(mdr.StudyError, match=r"holds other files \(thesis.tex\) and no study.json"):
        small(tmp_path)
    assert os.listdir(tmp_path) == ["thesis.tex"]


@pytest.mark.parametrize("text", ["", "{", "[]", "{}", '{"identity": "x"}'])
def test_a_damaged_head(part_done, text):
    (part_done / "study.json").write_text(text)
    for call in (small, mdr.read_study):
        with pytest.raises(mdr.StudyError, match=r"study.json: is damaged"):
            call(part_done)


@pytest.mark.parametrize(
    "text", ["", "[]", "{}", '{"n_units": 48, "units_per_chunk": 0}', '{"n_units": 7, "units_per_chunk": 1}']
)
def test_a_damaged_plan(part_done, text):
    (part_done / "chunks" / "plan.json").write_text(text)
    with pytest.raises(mdr.StudyError, match="remove th"):
        small(part_done)


@pytest.mark.parametrize("data", [b"", b"CDF\x02", b"hello"])
def test_a_damaged_study(tmp_path, data):
    small(tmp_path / "store")
    whole = bytes_of(tmp_path / "store")
    (tmp_path / "store" / "study.nc").write_bytes(data or whole[: len(whole) // 2])
    for call in (small, mdr.read_study):
        with pytest.raises(mdr.StudyError, match="is no study, or a damaged one"):
            call(tmp_path / "store")


def test_a_study_of_another_store(tmp_path):
    small(tmp_path / "one")
    small(tmp_path / "two", axes={"mu_0": [0.3]})
    (tmp_path / "one" / "study.nc").write_bytes(bytes_of(tmp_path / "two"))
    with pytest.raises(mdr.StudyError, match=r"is of another study than study.json beside it"):
        small(tmp_path / "one")


def test_no_store_to_read(tmp_path):
    with pytest.raises(mdr.StudyError, match="holds no study"):
        mdr.read_study(tmp_path)
    with pytest.raises(mdr.StudyError, match="cannot be read: No such file"):
        mdr.read_study(tmp_path / "none")


def test_a_function_without_a_name_is_refused_with_the_reason(tmp_path):
    bowl = mdr.Profile(lambda r: 100 * r**2)
    with pytest.raises(ValueError, match=r"Profile holds a function, which a store cannot compare .* name it"):
        mdr.sweep(RIGID, {"indenter": [bowl]}, tmp_path / "store", quantities=["v_c"])
    assert not (tmp_path / "store").exists()
    assert mdr.sweep(RIGID, {"indenter": [bowl]}, quantities=["v_c"]).identity == ""
    named = mdr.Profile(lambda r: 100 * r**2, name="bowl")
    found = mdr.sweep(RIGID, {"indenter": [named]}, tmp_path / "store", quantities=["v_c"])
    assert len(found.identity) == 64
    assert "0x" not in found.frame.grid[0].labels[0]


def test_a_quantity_is_told_by_all_but_its_function(tmp_path):
    own = mdr.Quantity("own", "m", depth)
    axes = {"mu_0": [0.1]}
    mdr.sweep(RIGID, axes, tmp_path / "store", quantities=[own])
    assert mdr.sweep(RIGID, axes, tmp_path / "store", quantities=[mdr.Quantity("own", "m", len)])["own"][0] == 6e-6
    with pytest.raises(mdr.StudyError, match="quantities is"):
        mdr.sweep(RIGID, axes, tmp_path / "store", quantities=[mdr.Quantity("own", "um", depth)])


# --- disks that are full or cannot be written ---


@contextmanager
def a_disk_of(kilobytes, folder):
    """A disk of its own in the memory, where this is allowed."""
    folder.mkdir()
    command = ["mount", "-t", "tmpfs", "-o", f"size={kilobytes}k", "tmpfs", str(folder)]
    if os.geteuid() != 0 or subprocess.run(command, capture_output=True).returncode != 0:
        pytest.skip("no right to mount a disk")
    try:
        yield folder
    finally:
        subprocess.run(["umount", str(folder)], check=True)


def test_a_full_disk(tmp_path):
    with a_disk_of(64, tmp_path / "disk") as disk:
        with pytest.raises(
            mdr.StudyError, match=r"no room to write 0000\d\d.npz \(No space left on device\)"
        ) as caught:
            small(disk / "store")
        kept = len(list(disk.glob("store/chunks/*.npz")))
        assert 2 <= kept < 48
        assert f"{kept} of 48 chunks are safe in {disk / 'store'}; free space and repeat the call" in str(caught.value)
        assert not [path for path in disk.rglob("*") if path.name.endswith(".part")]
        assert mdr.read_study(disk / "store").count(Status.DONE) == kept
        subprocess.run(["mount", "-o", "remount,size=4m", str(disk)], check=True)
        computed = []
        found = small(disk / "store", executor=counting(computed))
        assert found == small(None)
        assert len(computed) == 48 - kept


def counting(computed):
    from concurrent.futures import ThreadPoolExecutor

    class Counting(ThreadPoolExecutor):
        def submit(self, task, work, start, stop, *rest):
            computed.append(start)
            return super().submit(task, work, start, stop, *rest)

    return Counting(1)


def failing(monkeypatch, code, after):
    """Let the system refuse every file after the first ones."""
    real, calls = os.fsync, []

    def fsync(descriptor):
        calls.append(1)
        if len(calls) > after:
            raise OSError(code, os.strerror(code))
        real(descriptor)

    monkeypatch.setattr(os, "fsync", fsync)


@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EDQUOT, errno.EFBIG])
def test_no_room(tmp_path, monkeypatch, code):
    with monkeypatch.context() as patch:
        failing(patch, code, after=20)
        with pytest.raises(mdr.StudyError, match=r"no room to write .*\d+ of 48 chunks are safe in .*; free space and"):
            small(tmp_path / "store")
    assert small(tmp_path / "store") == small(None)


@pytest.mark.parametrize("code", [errno.EROFS, errno.EACCES])
def test_a_store_that_cannot_be_written(tmp_path, monkeypatch, part_done, code):
    def refuse(*args, **options):
        raise OSError(code, os.strerror(code))

    small(tmp_path / "finished")
    monkeypatch.setattr(os, "fsync", refuse)
    monkeypatch.setattr("mdr.studies.engine.compute", None)  # found out before any work
    with pytest.raises(mdr.StudyError, match=r"chunks cannot be written .*; make the folder writable, or give another"):
        small(part_done)
    assert small(tmp_path / "finished").complete


def test_another_fault_of_the_disk(part_done, monkeypatch):
    failing(monkeypatch, errno.EIO, after=0)
    with pytest.raises(mdr.StudyError, match=r"cannot be written \(Input/output error\); repeat the call once that is"):
        small(part_done)


def test_a_finished_store_on_a_disk_that_cannot_be_written(tmp_path):
    with a_disk_of(1024, tmp_path / "disk") as disk:
        found = small(disk / "store")
        subprocess.run(["mount", "-o", "remount,ro", str(disk)], check=True)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            assert small(disk / "store") == found
        with pytest.raises(mdr.StudyError, match="cannot be written"):
            small(disk / "new")


def test_a_study_without_faults_gives_no_warning(tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = study((RIGID, {"mu_0": [0.2, 0.3]}, ["v_c"], {}), store=tmp_path / "store")
    assert_array_equal(found.status, Status.DONE)
