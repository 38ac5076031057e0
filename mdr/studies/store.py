"""The store of a study: a folder with its specification, and its chunks until they are merged into one file.

`read_study` reads a store, finished or not, and a file that was written elsewhere.

    study.json            specification and identity
    chunks/plan.json      how the work is cut
    chunks/000012.npz     a finished chunk, with checksums
    study.nc              all of it, once no chunk is missing; the chunks are then removed

Every file appears whole or not at all, so that a kill at any instant costs only the chunks in flight. Several
processes may work on one store at a time: whoever finds that nothing is missing merges, all to the same bytes.
"""

from __future__ import annotations

import errno
import json
import os
import shutil
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from io import BytesIO
from os import PathLike
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from mdr.studies.points import Points
from mdr.studies.specification import differences
from mdr.studies.study import Study, frame_in, study_of_points
from mdr.studies.unpack import unpacked
from mdr.studies.work import Layout, units_of
from mdr.tools.atomic_write import is_partial, write_once, write_whole
from mdr.tools.status import Status

HEAD = ("identity", "specification", "frame", "block")  #: what study.json says
_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
_READ_ONLY = (errno.EROFS, errno.EACCES, errno.EPERM)

T = TypeVar("T")


class StudyError(RuntimeError):
    """A store that cannot be used or written, or a study that ended before its work was done."""


class Store:
    """A folder that one study is kept in."""

    def __init__(self, folder: str | PathLike[str]) -> None:
        self.folder = Path(folder)
        self.chunks = self.folder / "chunks"
        self.file = self.folder / "study.nc"
        self.n_kept, self.n_chunks = 0, 0  #: chunks that are there, of how many; for messages

    @property
    def kept(self) -> str:
        """Number of chunks that are there, in words; empty before they are counted."""
        return f"{self.n_kept} of {self.n_chunks} chunks are safe in {self.folder}" if self.n_chunks else ""

    # --- the study as a whole ---

    def open(self, head: Mapping[str, Any]) -> None:
        """Make the store of a study; if there is one, check that it is of the same study."""
        with self._told("study.json"):
            if self.folder.exists() and not self.folder.is_dir():
                raise StudyError(f"{self.folder}: is a file; give a folder for the store")
            self.folder.mkdir(parents=True, exist_ok=True)
            if self.head() is None:
                self._refuse_strangers()
                text = json.dumps(head, indent=1, ensure_ascii=False, allow_nan=False)
                write_once(self.folder / "study.json", text.encode("utf-8"))
            known = self.head() or {}
        if known.get("identity") != head["identity"]:
            what = differences(known.get("specification", {}), head["specification"])
            raise StudyError(f"{self.folder}: is the store of another study: {what}; give another folder")

    def head(self) -> dict[str, Any] | None:
        """Specification and identity of the study in the store; None where there is none."""
        path = self.folder / "study.json"
        return _known(path, lambda head: {name: head[name] for name in HEAD}, "move the store away and repeat the call")

    def merged(self) -> Study | None:
        """The finished study; None while chunks are missing."""
        return _read_file(self.file, "; move it away and repeat the call") if self.file.exists() else None

    def merge(self, data: bytes) -> None:
        """Put the finished study in the place of its chunks."""
        self._put(self.file, data)
        self.clear()

    def clear(self) -> None:
        """Remove what a finished study no longer needs, and what killed processes left."""
        if self.chunks.exists():
            shutil.rmtree(self.chunks, ignore_errors=True)
        with suppress(OSError):
            for one in self.folder.iterdir():
                if is_partial(one.name):
                    one.unlink(missing_ok=True)

    # --- its chunks ---

    def require_writable(self) -> None:
        """Check before the work that its outcome can be written."""
        with self._told("chunks"):
            self.chunks.mkdir(exist_ok=True)
            write_whole(self.chunks / "plan.try", b"")
            (self.chunks / "plan.try").unlink(missing_ok=True)

    def plan(self) -> range | None:
        """How the work is cut; None before that is settled."""
        path, way_out = self.chunks / "plan.json", f"remove the folder {self.chunks} and repeat the call"
        return _known(path, lambda plan: range(0, int(plan["n_units"]), int(plan["units_per_chunk"])), way_out)

    def settle(self, cut: range) -> range:
        """Write down how the work is cut, unless another process has done so meanwhile; returns the cut that holds."""
        with self._told("plan.json"):
            plan = {"n_units": cut.stop, "units_per_chunk": cut.step}
            write_once(self.chunks / "plan.json", json.dumps(plan).encode("ascii"))
        return self.plan() or cut

    def finished(self) -> set[int]:
        """Numbers of the chunks that are there."""
        try:
            names = os.listdir(self.chunks)
        except (FileNotFoundError, NotADirectoryError):
            return set()
        return {int(name[:-4]) for name in names if name.endswith(".npz") and name[:-4].isdigit()}

    def write(self, number: int, identity: str, points: Points) -> None:
        """Keep a finished chunk."""
        self._put(self._path(number), _packed(number, identity, points))
        self.n_kept += 1

    def load(self, chunks: Iterable[int], cut: range, layout: Layout, identity: str, points: Points) -> list[int]:
        """Put finished chunks in the place of their points; returns those that are damaged.

        Raises FileNotFoundError where another process has removed them, as it has merged.
        """
        damaged = []
        for chunk in chunks:
            own = points[layout.points(units_of(cut, chunk))]
            try:
                own.put(_unpacked(chunk, identity, self._path(chunk).read_bytes(), own.values.shape))
            except FileNotFoundError:
                raise
            except Exception:  # whatever a reader of archives meets in bytes that are none
                damaged.append(chunk)
        return damaged

    def _put(self, path: Path, data: bytes) -> None:
        """Write a file, unless another process has merged meanwhile, and cleared away what is written here."""
        with self._told(path.name):
            try:
                write_whole(path, data)
            except FileNotFoundError:
                if not self.file.exists():
                    raise

    def _path(self, number: int) -> Path:
        return self.chunks / f"{number:06d}.npz"

    # --- what goes wrong ---

    def _refuse_strangers(self) -> None:
        names = sorted(name for name in os.listdir(self.folder) if not is_partial(name))
        if names and not (self.folder / "study.json").exists():
            some = ", ".join(names[:3]) + (", ..." if len(names) > 3 else "")
            raise StudyError(f"{self.folder}: holds other files ({some}) and no study.json; give an empty folder")

    @contextmanager
    def _told(self, name: str) -> Iterator[None]:
        """Errors of the system as what they mean for the study."""
        try:
            yield
        except OSError as error:
            fault, way_out = f"{name} cannot be written", "repeat the call once that is mended"
            if error.errno in _FULL:
                fault, way_out = f"no room to write {name}", "free space and repeat the call"
            elif error.errno in _READ_ONLY:
                way_out = "make the folder writable, or give another store"
            safe = f"; {self.kept}" if self.kept else ""
            raise StudyError(f"{self.folder}: {fault} ({error.strerror or error}){safe}; {way_out}") from error


def read_study(path: str | PathLike[str]) -> Study:
    """A study from its NetCDF file or from the folder of its store, finished or not.

    Parameters
    ----------
    path : str or path-like
        A NetCDF file, or the folder that `sweep` was given as store.

    Returns
    -------
    Study
        With what is there of it. Records among the axes come back as their labels.

    Raises
    ------
    StudyError
        For what is neither.

    Examples
    --------
    >>> import mdr
    >>> vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=2e-6, omega=300.0)
    >>> cone, rubber = mdr.Cone(theta=0.0127), mdr.Elastic(E=3e6, nu=0.5)
    >>> case = mdr.SlidingContact(cone, rubber, mu_0=0.4, oscillation=vibration)
    >>> mdr.sweep(case, {"alpha": [0.05, 0.1]}, quantities=["v_c"]).to_netcdf("study.nc")
    >>> mdr.read_study("study.nc")["v_c"].round(5)
    array([0.00018, 0.00036])
    """
    place = Path(path)
    return _read_store(Store(place)) if place.is_dir() else _read_file(place)


def _read_file(path: Path, way_out: str = "") -> Study:
    try:
        return unpacked(path.read_bytes())
    except OSError as error:
        raise StudyError(f"{path}: cannot be read: {error.strerror or error}") from None
    except ValueError as error:
        raise StudyError(f"{path}: is {error}{way_out}") from None


def _read_store(store: Store) -> Study:
    """The study of a store, with what is there of it."""
    if (done := store.merged()) is not None:
        return done
    head = store.head()
    if head is None:
        raise StudyError(f"{store.folder}: holds no study: there is no study.json")
    frame, cut = frame_in(head), store.plan()
    layout = Layout.of(frame.grid, head["block"])
    points = Points.blank(len(frame.columns), layout.n_points, Status.MISSING)
    if cut is not None:
        store.load(sorted(store.finished()), cut, layout, frame.identity, points)
    return study_of_points(frame, layout, points)


def _known(path: Path, check: Callable[[Any], T], way_out: str) -> T | None:
    """What a JSON file of the store says; None where there is none."""
    try:
        return check(json.loads(path.read_bytes()))
    except (FileNotFoundError, NotADirectoryError):
        return None
    except (ValueError, KeyError, TypeError) as fault:
        raise StudyError(f"{path}: is damaged ({fault!r}); {way_out}") from None


def _packed(number: int, identity: str, points: Points) -> bytes:
    """The bytes of a chunk, an archive with checksums."""
    buffer = BytesIO()
    head = json.dumps([identity, number, points.why.tolist()]).encode("ascii")
    np.savez(buffer, values=points.values, status=points.status, head=np.frombuffer(head, dtype=np.uint8))
    return buffer.getvalue()


def _unpacked(number: int, identity: str, data: bytes, shape: tuple[int, ...]) -> Points:
    with np.load(BytesIO(data), allow_pickle=False) as file:
        *place, why = json.loads(file["head"].tobytes())
        points = Points(file["values"], file["status"], np.array(why, dtype=object))
    if place != [identity, number] or points.values.shape != shape:
        raise ValueError("it is of another place")
    return points
