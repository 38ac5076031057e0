"""CSV tables written by hand: the cells of one line, and errors that name the file."""

from __future__ import annotations

import csv

from mdr.tools.messages import one_line


def cells_of(line: str, where: str, separator: str = ",") -> list[str]:
    """The cells of one line; a quote that is left open ends with it. Raises ValueError, naming `where` it stands."""
    try:
        return next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
    except csv.Error as wrong:
        raise fault(where, str(wrong)) from None


def fault(where: str, what: str) -> ValueError:
    """The error of one line, whatever the file holds."""
    return ValueError(one_line(f"{where}: {what}"))
