"""A study as a CSV table, one row for each point: the axes, the quantities, status and reason."""

from __future__ import annotations

import csv
from io import StringIO

import numpy as np

from mdr.studies.points import Status
from mdr.studies.study import Study


def table(study: Study) -> str:
    """The text of the file; numbers with all their digits."""
    grid, out = study.frame.grid, StringIO()
    writer = csv.writer(out, lineterminator="\n")
    named = [(axis.path, axis.unit) for axis in grid]
    named += [(column.name, column.unit) for column in study.frame.columns]
    writer.writerow([*(f"{name} [{unit}]" if unit else name for name, unit in named), "status", "why"])
    names = {int(status): status.name.lower() for status in Status}
    told = [[axis.told(i) for i in range(len(axis))] for axis in grid]
    values = study.values.reshape(len(study.frame.columns), -1)
    fates = zip(study.status.ravel().tolist(), study.reason.ravel().tolist(), strict=True)
    for k, (where, (status, reason)) in enumerate(zip(np.ndindex(study.shape), fates, strict=True)):
        coordinates = [texts[i] for texts, i in zip(told, where, strict=True)]
        numbers = [repr(value) for value in values[:, k].tolist()]
        writer.writerow([*coordinates, *numbers, names[status], study.reasons[reason]])
    return out.getvalue()
