"""CSV tables: columns as text, the cells of a line that was written by hand, and errors that name the file."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from typing import Any

from mdr.tools.messages import one_line


def csv_text(columns: Mapping[str, Any]) -> str:
    """A header of names, and a line for each row of columns of one length; numbers read back as they were."""
    lines = [",".join(f"{value:.17g}" for value in row) for row in zip(*columns.values(), strict=True)]
    return "\n".join([",".join(columns), *lines]) + "\n"


def cells_of(line: str, where: str, separator: str = ",") -> list[str]:
    """The cells of one line; a quote that is left open ends with it. Raises ValueError, naming `where` it stands."""
    try:
        return next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
    except csv.Error as wrong:
        raise fault(where, str(wrong)) from None


def fault(where: str, what: str) -> ValueError:
    """The error of one line, whatever the file holds."""
    return ValueError(one_line(f"{where}: {what}"))
