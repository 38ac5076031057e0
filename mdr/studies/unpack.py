"""A study read back from NetCDF, as `formats` writes it."""

from __future__ import annotations

import json
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mdr.studies.axes import Axis
from mdr.studies.formats import MEANINGS
from mdr.studies.study import Column, Study


def unpacked(data: bytes) -> Study:
    """The study in the bytes of a file; ValueError if they are none."""
    from scipy.io import netcdf_file

    try:
        file = netcdf_file(BytesIO(data), "r", mmap=False)
        return _study(file)
    except (TypeError, ValueError, LookupError, AttributeError, EOFError, ArithmeticError) as fault:
        raise ValueError(f"no study, or a damaged one: {fault}") from fault


def _study(file: Any) -> Study:
    variables, status = file.variables, file.variables["status"]
    if _text(status, "flag_meanings") != MEANINGS:
        raise ValueError("its states are not those of a study")
    grid = tuple(_axis(variables[name]) for name in status.dimensions)
    apart = {*status.dimensions, "status", "reason", "reasons"}
    # the file sorts its variables by shape, which all quantities share, and keeps their order otherwise
    kept = {name: one for name, one in variables.items() if name not in apart}
    columns = tuple(_column(name, one) for name, one in kept.items())
    return Study(
        grid,
        columns,
        case=_text(file, "case"),
        version=_text(file, "mdr_version"),
        identity=_text(file, "identity"),
        selected=tuple((path, told) for path, told in json.loads(_text(file, "selected") or "[]")),
        values=np.stack([_native(one, "f8") for one in kept.values()]),
        status=_native(status, "u1"),
        reason=_native(variables["reason"], "i4"),
        reasons=_texts(variables["reasons"]),
    )


def _column(name: str, variable: Any) -> Column:
    unit = _text(variable, "units")
    return Column(_text(variable, "path") or name, "-" if unit == "1" else unit, _text(variable, "long_name"))


def _axis(variable: Any) -> Axis:
    return Axis.known(_text(variable, "path"), _texts(variable) if variable.typecode() == "c" else variable.data)


def _native(variable: Any, kind: str) -> NDArray[Any]:
    return np.array(variable.data, dtype=kind, order="C")


def _texts(variable: Any) -> tuple[str, ...]:
    return tuple(b"".join(row).decode("utf-8") for row in np.asarray(variable.data))


def _text(holder: Any, name: str) -> str:
    value = getattr(holder, name, b"")
    return value.decode("utf-8") if isinstance(value, bytes) else str(value)
