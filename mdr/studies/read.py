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
