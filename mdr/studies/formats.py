"""The file of a study in NetCDF, which `unpack` reads back.

In it every quantity stands over labelled axes, with units; status as flags; reasons as a table. Names with "/",
which it forbids, are rewritten (v_0_over_v_c, d_cof_over_d_mu_0) and stay as the attribute `path`. Values that are no
numbers are texts. The bytes follow from the study alone.
"""

from __future__ import annotations

import json
from io import BytesIO
from typing import Any, TypeAlias

import numpy as np

from mdr.tools.status import Status

Study: TypeAlias = Any  #: read by attribute
_TITLE = "Sliding friction of a vibrated contact, a study by mdr"
_ONE = {"-": "1"}  #: a pure number in the file
MEANINGS = " ".join(status.name.lower() for status in Status)


def packed(study: Study, history: str = "") -> bytes:
    """The bytes of the file; history is what made it, kept as the CF conventions have it."""
    from scipy.io import netcdf_file

    buffer = BytesIO()
    file = netcdf_file(buffer, "w", version=2)
    _tell(file, title=_TITLE, identity=study.identity, mdr_version=study.version, case=study.case, history=history)
    _tell(file, selected=json.dumps(study.selected) if study.selected else "")
    dims = tuple(_name(axis.path) for axis in study.grid)
    for name, axis in zip(dims, study.grid, strict=True):
        told = {"units": _ONE.get(axis.unit, axis.unit), "long_name": axis.meaning, "path": axis.path}
        if axis.is_numeric:
            file.createDimension(name, len(axis))
            _put(file, name, "d", (name,), axis.values, **told)
        else:
            _put_texts(file, name, axis.labels, **told)
    for column, values in zip(study.columns, study.values, strict=True):
        told = {"units": _ONE.get(column.unit, column.unit), "long_name": column.meaning}
        name = _name(column.name)
        _put(file, name, "d", dims, values, **told, path="" if name == column.name else column.name)
    flags = np.array([int(status) for status in Status], dtype=np.int8)
    ended = "how the computation of the point ended"
    _put(file, "status", "b", dims, study.status, long_name=ended, flag_values=flags, flag_meanings=MEANINGS)
    _put(file, "reason", "i", dims, study.reason, long_name="why it failed or did not settle, an index of reasons")
    _put_texts(file, "reasons", study.reasons, long_name="distinct reasons; the first is none")
    file.flush()
    return buffer.getvalue()


def _name(path: str) -> str:
    """The name in the file of an axis or a quantity."""
    return path.replace("/", "_over_").replace(" ", "_")


def _put_texts(file: Any, name: str, texts: tuple[str, ...], **told: Any) -> None:
    raw = np.array([text.encode("utf-8") for text in texts])
    width = max(raw.dtype.itemsize, 1)
    file.createDimension(name, len(texts))
    file.createDimension(f"length_of_{name}", width)
    letters = raw.astype(f"S{width}").view("S1").reshape(len(texts), width)
    _put(file, name, "c", (name, f"length_of_{name}"), letters, **told, _Encoding="utf-8")


def _put(file: Any, name: str, kind: str, dims: tuple[str, ...], values: Any, **told: Any) -> None:
    variable = file.createVariable(name, kind, dims)
    variable.data[...] = values
    _tell(variable, **told)


def _tell(holder: Any, **told: Any) -> None:
    """Set attributes; an empty text is left out, as it cannot be read back."""
    for name, value in told.items():
        if not isinstance(value, str):
            setattr(holder, name, value)
        elif value:
            setattr(holder, name, value.encode("utf-8"))
