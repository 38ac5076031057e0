"""Files that are whole or not there."""

import errno
import os
import threading

import pytest

from mdr.tools.atomic_write import is_partial, write_once, write_whole


def test_a_file_is_written_and_replaced(tmp_path):
    path = tmp_path / "a.bin"
    write_whole(path, b"one")
    write_whole(path, b"another")
    assert path.read_bytes() == b"another"
    assert os.listdir(tmp_path) == ["a.bin"]


def test_what_is_written_is_on_the_disk_before_it_has_its_name(tmp_path, monkeypatch):
    calls = []
    for name in ("fsync", "replace", "link"):
        real = getattr(os, name)
        monkeypatch.setattr(os, name, lambda *args, name=name, real=real: (calls.append(name), real(*args))[1])
    write_whole(tmp_path / "a.bin", b"one")
    write_once(tmp_path / "b.bin", b"one")
    assert calls == ["fsync", "replace", "fsync", "fsync", "link", "fsync"]


@pytest.mark.parametrize("write", [write_whole, write_once])
def test_a_write_that_fails_leaves_nothing(tmp_path, monkeypatch, write):
    def full(descriptor):
        raise OSError(errno.ENOSPC, "No space left on device")

    (tmp_path / "a.bin").write_bytes(b"old")
    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        write(tmp_path / "a.bin", b"new")
    assert os.listdir(tmp_path) == ["a.bin"]
    assert (tmp_path / "a.bin").read_bytes() == b"old"


def test_of_several_writers_one_is_first(tmp_path):
    path, outcomes, start = tmp_path / "plan.json", {}, threading.Barrier(8)

    def write(i):
        start.wait()
        outcomes[i] = write_once(path, bytes([i]))

    threads = [threading.Thread(target=write, args=(i,)) for i in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    (first,) = [i for i, written in outcomes.items() if written]
    assert path.read_bytes() == bytes([first])
    assert os.listdir(tmp_path) == ["plan.json"]


def test_a_file_system_without_links_will_do(tmp_path, monkeypatch):
    def no_links(*paths):
        raise OSError(errno.EPERM, "Operation not permitted")

    monkeypatch.setattr(os, "link", no_links)
    assert write_once(tmp_path / "a.bin", b"one")
    assert not write_once(tmp_path / "a.bin", b"two")
    assert (tmp_path / "a.bin").read_bytes() == b"one"


def test_names_of_files_that_were_cut_off(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "replace", lambda *paths: None)
    seen = []
    monkeypatch.setattr(os, "fsync", lambda descriptor: seen.extend(os.listdir(tmp_path)))
    write_whole(tmp_path / "study.nc", b"one")
    assert all(is_partial(name) for name in seen)
    assert not any(is_partial(name) for name in ("study.nc", "study.json", ".hidden", "000001.npz", "a.part"))
