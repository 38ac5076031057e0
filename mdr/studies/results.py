"""The points of a study while they are computed, in the order of the work."""

from __future__ import annotations

import sys

import numpy as np

from mdr.studies.frame import Frame
from mdr.studies.layout import Layout
from mdr.studies.points import SLOW, Part, Status
from mdr.studies.study import Study, study_of
from mdr.tools.progress import in_words


class Results:
    """All points. They are missing at first; computed parts are put in their place, in any order."""

    def __init__(self, layout: Layout, n_quantities: int) -> None:
        self.layout = layout
        self.values = np.full((n_quantities, layout.n_points), np.nan)
        self.status = np.full(layout.n_points, Status.MISSING, dtype=np.uint8)
        self.reason = np.zeros(layout.n_points, dtype=np.int32)
        self.reasons = {"": 0}
        self.slow: list[float] = []  #: seconds of the cases that took long

    def shape_of(self, units: tuple[int, int]) -> tuple[int, int]:
        """Shape of the values of units first <= unit < last."""
        first, last = (self.layout.first_point(unit) for unit in units)
        return len(self.values), last - first

    def put(self, first_unit: int, part: Part) -> None:
        """Put the points of a part where its first unit begins."""
        first = self.layout.first_point(first_unit)
        where = slice(first, first + part.status.size)
        codes = np.array([self.reasons.setdefault(why, len(self.reasons)) for why in part.reasons], dtype=np.int32)
        self.values[:, where] = part.values
        self.status[where] = part.status
        self.reason[where] = codes[part.reason]
        self.slow += part.slow

    def tell_slow(self) -> None:
        """Print on standard error how many cases took long, and how long."""
        if self.slow:
            most = in_words(max(self.slow))
            cases = "1 case" if len(self.slow) == 1 else f"{len(self.slow)} cases"
            print(f"sweep: {cases} took more than {SLOW:g} s, at most {most}", file=sys.stderr)

    def study(self, frame: Frame) -> Study:
        """The study of the points that are there, its arrays in the order of the axes."""
        place = self.layout.in_place
        return study_of(frame, place(self.values), place(self.status), place(self.reason), tuple(self.reasons))
