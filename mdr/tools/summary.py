"""How records print: a title and rows of name, value and meaning; as text, and as a table in notebooks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from textwrap import wrap
from typing import Any, NamedTuple

import numpy as np

from mdr.tools.keywords import Offering

NAME = 10  #: of a column of names, the usual width
LONGEST = 118  #: of a line of a table, which a title indents by two
Row = tuple[str, str, str]  #: name, value, meaning
LEFT = 'style="text-align: left"'  #: notebooks set cells to the right


class Summary(NamedTuple):
    """What a record says of itself."""

    title: str
    rows: Sequence[Row]

    def __str__(self) -> str:
        return "\n".join([self.title, *(f"  {line}" for line in lines_of(self.rows))])

    @property
    def html(self) -> str:
        """The same as a table of HTML."""
        rows = "".join(f"<tr>{''.join(_cells(row))}</tr>" for row in self.rows)
        return f"<table><caption {LEFT}>{escape(self.title)}</caption>{rows}</table>"


def _cells(row: Row) -> Iterator[str]:
    """The cells of a row; a value without a meaning has the width of both."""
    name, value, meaning = (escape(text) for text in row)
    yield f"<th {LEFT}>{name}</th>"
    yield f"<td {LEFT}>{value}</td><td {LEFT}>{meaning}</td>" if meaning else f'<td colspan="2" {LEFT}>{value}</td>'


class Printed(Offering):
    """Base of records that notebooks show as they print."""

    def _repr_html_(self) -> str:
        return f'<pre style="white-space: pre-wrap">{escape(str(self))}</pre>'


class Summarised(Printed):
    """Base of records that print as their summary, and show it as a table in notebooks; they answer `_summary()`."""

    def _summary(self) -> Summary:
        raise NotImplementedError

    def __str__(self) -> str:
        return str(self._summary())

    def _repr_html_(self) -> str:
        return self._summary().html


def lines_of(rows: Sequence[Row]) -> list[str]:
    """Name, value and meaning, in columns; a text that is too long for its line goes on below its beginning."""
    wide = max((len(value) for name, value, meaning in rows if name and meaning), default=0)
    names = max((len(name) + (len(name) > NAME) for name, _, _ in rows), default=NAME)
    return [line for row in rows for line in _wrapped(*row, max(NAME, names) + 1, wide)]


def _wrapped(name: str, value: str, meaning: str, names: int, wide: int) -> Iterator[str]:
    """The lines of one row, its name and value in columns of these widths."""
    head, text = (f"{name:<{names}}{value:<{wide}}  ", meaning) if meaning else (f"{name:<{names}}", value)
    width = max(LONGEST - len(head), LONGEST // 3)
    for line in wrap(text, width, break_long_words=False, break_on_hyphens=False) or [""]:
        yield f"{head}{line}".rstrip()
        head = " " * len(head)


def number(value: float, unit: str = "") -> str:
    """A number of six digits, with its unit; or "infinite"."""
    return "infinite" if value == np.inf else f"{value:.6g}{f' {unit}' if unit not in ('', '-') else ''}"


def span(values: Any, unit: str = "") -> str:
    """The least and the greatest of some numbers, with their unit; those that are not finite are left out."""
    values = np.asarray(values, dtype=float)
    seen = values[np.isfinite(values)]
    if not seen.size:
        return "none"
    least, greatest = number(float(seen.min())), number(float(seen.max()), unit)
    return greatest if seen.min() == seen.max() else f"{least} to {greatest}"


def with_error(value: float, error: float) -> str:
    """A number with its error, rounded to what the error leaves of it, to three digits at least."""
    if not (np.isfinite(value) and np.isfinite(error) and error > 0):
        return number(value)
    first, first_of_error = (np.floor(np.log10(one)) for one in (abs(value) or 10 * error, error))
    # behind the point; of the value
    digits = int(np.clip(max(2 - first, 1 - first_of_error), 0, 8))  # the third, or the second of the error
    return f"{value:.{digits}f} +- {error:.1e}"
