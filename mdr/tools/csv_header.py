"""The header of a table: which column stands where and in which unit, or what to write instead.

What `columns=` names is taken first. Of the other names the best spelling is taken: exact; exact but for spaces,
hyphens and underscores; a word in letters of another case; a single letter of another case, and this with a unit that
measures the same (`T [C]` is no time t, `U [V]` no displacement u). What nobody names is left alone: where `columns=`
says that the letter of one quantity is another, as x of an acceleration, other letters are none that may be left out.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from mdr.tools.messages import one_line, short
from mdr.tools.notation import listed, scale_of

_HEAD = re.compile(
    r"(?P<name>.*?)\s*(?:[\[(](?P<unit>[^\])\[(]*)[\])]|\s*/\s*(?P<other>\S.*)|(?:,|\s+in)\s+(?P<after>[^\s,()\[\]]+))?"
)
SPELLINGS = 4  #: how well a name fits, best first


class Column(NamedTuple):
    """A column that is looked for."""

    name: str  #: in the library
    names: tuple[str, ...] = ()  #: other names that a header may give it
    unit: str = "-"  #: of the library, a key of `UNITS`
    needed: bool = True
    bare: bool = False  #: whether a header without a unit means that of the library
    empty: float | None = None  #: what an empty cell, or inf, stands for; None refuses them
    likely: tuple[float, float] = (0.0, math.inf)  #: range of the greatest absolute value; outside a unit may be wrong

    @property
    def example(self) -> str:
        """A header as it is meant."""
        unit = {"m": "um", "m/s": "mm/s", "rad/s": "Hz", "Pa": "MPa", "K": "degC"}.get(self.unit, self.unit)
        return self.name if unit == "-" else f"{self.name} [{unit}]"

    def measured_in(self, unit: str) -> bool:
        """Whether a unit is one of this quantity."""
        return bool(unit) and scale_of(unit, self.unit) is not None


class Place(NamedTuple):
    """A column that was found."""

    column: Column
    at: int  #: cell of the row
    unit: str  #: in which it is given, "" for that of the library


class Head(NamedTuple):
    """One cell of a header, as "r [um]", "r (um)", "r / um", "r, um" or "r in um"."""

    name: str
    unit: str
    whole: str

    @classmethod
    def of(cls, cell: str) -> Head:
        """Name and unit in a cell."""
        whole = cell.strip()
        found = _HEAD.fullmatch(whole)
        if found is None:
            return cls(whole, "", whole)
        unit = next((found[one] for one in ("unit", "other", "after") if found[one]), "")
        return cls(found["name"], unit.strip(" ()"), whole)

    def spelling(self, names: Sequence[str]) -> int | None:
        """How well it is spelt as one of the names, 0 for exactly; None for another name."""
        ranks = [rank for one in (self.name, self.whole) if (rank := _spelling(one, names)) is not None]
        return min(ranks, default=None)

    def unit_of(self, column: Column, names: Sequence[str]) -> str:
        """The unit behind one of these names; brackets that belong to the name are none."""
        name, whole = (_spelling(one, names) for one in (self.name, self.whole))
        is_name = whole is not None and (name is None or whole < name)
        return self.unit if column.measured_in(self.unit) or not is_name else ""


class Header:
    """The cells of a header, and the columns that are looked for in it."""

    def __init__(
        self, cells: Sequence[str], columns: Sequence[Column], units: Mapping[str, str], called: Mapping[str, str]
    ) -> None:
        self.columns, self.units, self.called = columns, units, called
        self.heads = [Head.of(cell) for cell in cells]
        others = [(own, one) for name, own in called.items() for one in columns if one.name != name]
        self.letters_differ = any(own in one.names for own, one in others)
        self.text = short(", ".join(head.whole for head in self.heads), 120)

    def places(self) -> list[Place]:
        """Where each column stands. Raises ValueError with all that is wrong."""
        at = self._named()
        for spelling in range(SPELLINGS):
            for column in self.columns:
                if column.name not in at and column.name not in self.called:
                    best = self._best(self._spelt(column, spelling, set(at.values())), column)
                    at |= {column.name: best} if best is not None else {}
        absent = [one for one in self.columns if one.needed and one.name not in at]
        if absent:
            raise ValueError(self._absent(absent, set(at.values())))
        if unused := [one for one in self.columns if one.name in self.units and one.name not in at]:
            names, pairs = ", ".join(one.name for one in unused), ", ".join(map(self._called_so, unused))
            raise ValueError(
                f"units: the header names no {names}: {self.text}; what it calls them, columns={{{pairs}}}"
            )
        found = [Place(one, at[one.name], self._unit(one, at[one.name])) for one in self.columns if one.name in at]
        if faults := [what for one in found if (what := self._fault(*one[:2]))]:
            bare = [one.column for one in found if self._lacks_unit(*one[:2])]
            pairs = ", ".join(f'"{one.name}": "{listed(one.unit).partition(",")[0]}"' for one in bare)
            raise ValueError("; ".join([*faults, *([f"or units={{{pairs}}}"] if bare else [])]))
        return found

    def left(self, places: Sequence[Place]) -> str:
        """A hint to cells that nobody claims and whose unit is that of a column; empty where there is none."""
        free = [head for i, head in enumerate(self.heads) if i not in {one.at for one in places}]
        pairs = [(column, head) for head in free if (column := self._meant(head, {one.column for one in places}))]
        named = {column.name: head.whole for column, head in reversed(pairs)}
        told = ", ".join(f'"{name}": "{short(whole)}"' for name, whole in reversed(named.items()))
        return f"; or say what the header calls it, columns={{{told}}}" if told else ""

    # --- names ---

    def _named(self) -> dict[str, int]:
        """Places of the columns that `columns=` names."""
        at: dict[str, int] = {}
        for column in self.columns:
            own = self.called.get(column.name)
            if not own:
                if own is not None and column.needed:
                    raise ValueError(f'columns: {column.name} is needed, got ""')
                continue
            ranked = [(rank, i) for i, head in enumerate(self.heads) if (rank := head.spelling((own,))) is not None]
            best = [i for rank, i in ranked if rank == min(ranked)[0]]
            if not best:
                raise ValueError(f"the header names no {short(own)}: {self.text}; columns= must name one of these")
            place = self._only(best, column)
            if taken := [name for name, index in at.items() if index == place]:
                raise ValueError(f"columns: {taken[0]} and {column.name} are both called {short(own)}; give one")
            at[column.name] = place
        return at

    def _spelt(self, column: Column, spelling: int, taken: set[int]) -> list[int]:
        """Places of free cells that spell the column so."""
        found = [
            i
            for i, head in enumerate(self.heads)
            if i not in taken and head.spelling((column.name, *self._names_of(column))) == spelling
        ]
        if spelling < SPELLINGS - 1:
            return found
        return [i for i in found if self._fits(column, i) or (column.needed and not self._written(column, i))]

    def _names_of(self, column: Column) -> list[str]:
        """Other names that a header may give a column."""
        return [one for one in column.names if column.needed or len(one) > 1 or not self.letters_differ]

    def _best(self, found: list[int], column: Column) -> int | None:
        """The one of them, or the one in a unit of the column."""
        fitting = [i for i in found if self._fits(column, i)] or found
        return self._only(fitting, column) if fitting else None

    def _only(self, found: list[int], column: Column) -> int:
        if len(found) > 1:
            raise ValueError(
                f'the header names {column.name} twice: {self.text}; say which it is, columns={{"{column.name}": ...}}'
            )
        return found[0]

    def _fits(self, column: Column, index: int) -> bool:
        """Whether the cell has a unit of the column, or needs none."""
        unit = self._written(column, index)
        needs_none = column.bare or column.unit == "-" or column.name in self.units
        return column.measured_in(unit) if unit else needs_none

    def _absent(self, absent: list[Column], taken: set[int]) -> str:
        """What is wrong with a header that names them not."""
        names = " and no ".join(one.name for one in absent)
        way_out = f"write {', '.join(one.example for one in self.columns if one.needed)}"
        if len(self.heads) == 1:
            way_out = f"columns are separated by commas, semicolons or tabs; {way_out}"
        free = [head for i, head in enumerate(self.heads) if i not in taken]
        meant = {one.name: head.whole for one in absent for head in free if one.measured_in(head.unit)}
        told = ", ".join(f'"{name}": "{short(whole)}"' for name, whole in meant.items()) or f'"{absent[0].name}": ...'
        return f"the header names no {names}: {self.text}; {way_out}, or say what it calls it, columns={{{told}}}"

    def _meant(self, head: Head, known: set[Column]) -> Column | None:
        """The column whose unit a cell has; of several the one whose last letter is a word of it."""
        fitting = [one for one in self.columns if one not in known and one.unit != "-" and one.measured_in(head.unit)]
        words = re.split(r"[\W_]+", head.name.casefold())
        return next((one for one in fitting if one.name[-1] in words), fitting[-1] if fitting else None)

    def _called_so(self, column: Column) -> str:
        """An entry of `columns=` for a column that the header names otherwise."""
        same = [head.name for head in self.heads if head.name.casefold() == column.name[-1]]
        return f'"{column.name}": ' + (f'"{same[0]}"' if same else "...")

    # --- units ---

    def _written(self, column: Column, index: int) -> str:
        """The unit in the header."""
        own = self.called.get(column.name)
        return self.heads[index].unit_of(column, (own,) if own else (column.name, *column.names))

    def _unit(self, column: Column, index: int) -> str:
        """The unit that is written, or that which `units` gives."""
        return self._written(column, index) or self.units.get(column.name, "")

    def _lacks_unit(self, column: Column, index: int) -> bool:
        return not (self._unit(column, index) or column.bare or column.unit == "-")

    def _fault(self, column: Column, index: int) -> str:
        """What is wrong with the unit of a column; empty where nothing is."""
        name, unit, written, given = column.name, column.unit, self._written(column, index), self.units.get(column.name)
        if given is not None and scale_of(given, unit) is None:
            return f"units: {name} = {short(repr(given))} is none of {listed(unit)}"
        if written and not column.measured_in(written):
            if unit == "-":
                return f"{name} is a pure number, got the unit {short(written)!r}"
            other = self._meant(self.heads[index], {column})
            way_out = f"write {column.example}"
            if other is not None:
                way_out = f'is it {other.name}? columns={{"{other.name}": "{short(self.heads[index].name)}"}}'
            elif not column.needed:
                way_out += f'; if it is no {name}, columns={{"{name}": ""}} leaves it out'
            return f"the unit {short(written)!r} of {name} is none of {listed(unit)}; {way_out}"
        if written and given is not None and scale_of(written, unit) != scale_of(given, unit):
            return f"the header gives {name} in {written}, units= in {given}; give one"
        if self._lacks_unit(column, index):
            return f"{name} needs a unit in its header, one of {listed(unit)}: {column.example}"
        return ""


def fault(where: str, what: str) -> ValueError:
    """The error of one line, whatever the file holds."""
    return ValueError(one_line(f"{where}: {what}"))


def _spelling(own: str, names: Sequence[str]) -> int | None:
    """0 for a name exactly; 1 but for signs between letters; 2 in another case; 3 a letter in another case."""
    if own in names:
        return 0
    kept, plain = {_plain(one) for one in names}, _plain(own)
    if plain in kept:
        return 1
    if plain.casefold() not in {one.casefold() for one in kept}:
        return None
    return 2 if len(plain) > 1 else 3


def _plain(name: str) -> str:
    """A name without what does not matter in it, but for the case."""
    same = {"′": "'", "″": "''", "´": "'", '"': "''", "’": "'", "_": "", " ": "", "-": "", "µ": "μ"}
    return "".join(same.get(letter, letter) for letter in name)
