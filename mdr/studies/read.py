"""read_study(): a study back from its file, or from the folder of its store, finished or not."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from mdr.studies.cut import Cut
from mdr.studies.frame import Frame
from mdr.studies.layout import Layout
from mdr.studies.netcdf import unpacked
from mdr.studies.results import Results
from mdr.studies.store import Store, StudyError
from mdr.studies.study import Study


def read_study(path: str | PathLike[str]) -> Study:
    """The study in a NetCDF file or in the folder of a store, with what is there of it; records come back as labels.

    Raises StudyError for what is neither.
    """
    place = Path(path)
    return _read_store(Store(place)) if place.is_dir() else _read_file(place)


def _read_file(path: Path) -> Study:
    try:
        return unpacked(path.read_bytes())
    except OSError as error:
        raise StudyError(f"{path}: cannot be read: {error.strerror or error}") from None
    except ValueError as error:
        raise StudyError(f"{path}: is {error}") from None


def _read_store(store: Store) -> Study:
    """The study of a store, with what is there of it."""
    if store.file.exists():
        return _read_file(store.file)
    head = store.head()
    if head is None:
        raise StudyError(f"{store.folder}: holds no study: there is no study.json")
    frame = Frame.from_head(head)
    velocity = next((i for i, axis in enumerate(frame.grid) if axis.is_velocity), None)
    results = Results(Layout(frame.shape, velocity, head["block"]), len(frame.columns))
    plan = store.plan()
    if plan is not None:
        cut = Cut(plan["n_units"], plan["units_per_chunk"])
        for chunk in sorted(store.finished()):
            units = cut.units(chunk)
            part = store.read(chunk, frame.identity, results.shape_of(units))
            if part is not None:
                results.put(units[0], part)
    return results.study(frame)
