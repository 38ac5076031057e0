"""Inputs of a question: what the user sets, each with its value, and the case with another value of one.

They are the numbers of the case, the load, frequency and loss tangent in the place of the fields that these are turned
into, and the pulling velocity.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from mdr.case.contact import SlidingContact
from mdr.case.motion import PeriodicMotion
from mdr.case.paths import fields_set, paths_of
from mdr.friction.free_parameters import changed, path_of, value_of
from mdr.given.vary import still_held, value_at

OF_RUN = "v_0"  #: an input that is none of the case


class Inputs(NamedTuple):
    """A case, its pulling velocity, and what it was made from."""

    case: SlidingContact
    v_0: float | None  #: [m/s]; None where nothing is asked at a velocity
    held: Mapping[str, Any]  #: what holds while other inputs vary, checked

    @property
    def all(self) -> list[str]:
        """The numbers of the case that are not zero, by what they were set with, and the velocity."""
        case, numbers = self.case, paths_of(self.case)
        paths = [path for path in numbers if isinstance(value := value_at(case, path), float) and value]
        alike = {value_at(case, path) for path in fields_set("frequency") if path in paths}
        for setting in (*(("frequency",) if len(alike) == 1 else ()), *self.held):
            paths = list(dict.fromkeys(setting if path in fields_set(setting) else path for path in paths))
        return [*paths, *(["alpha"] if isinstance(case.oscillation, PeriodicMotion) else []), *self._of_run]

    @property
    def _of_run(self) -> list[str]:
        return [] if self.v_0 is None else [OF_RUN]

    def asked(self, fields: Iterable[str] | None) -> list[str]:
        """The paths of those that are asked for, None for all. ValueError for what is no number of the case."""
        if fields is None:
            return self.all
        if isinstance(fields, str) or not isinstance(fields, Iterable):
            raise TypeError(f"fields must be a list of paths, got {fields!r}; write [...]")
        return [one if one in self._of_run else path_of(self.case, one) for one in fields]

    def others(self, path: str) -> dict[str, Any]:
        """What holds while this input varies."""
        return still_held(self.held, [path])

    def value(self, path: str) -> float:
        """The value [SI] of an input, zero of a group for which the case has no spring, mass or depth."""
        return self.v_0 if path == OF_RUN and self.v_0 is not None else value_of(self.case, path, self.held)

    def at(self, path: str, value: float) -> SlidingContact:
        """The case with another value of one input."""
        return self.case if path == OF_RUN else changed(self.case, path, value, self.others(path))
