"""The header of a table: which column stands where and in which unit, or what to write instead.

What `columns=` names, or numbers, is taken first. Of the other cells those in a unit of the column come first, then
those without a unit, then those in another; among these the best spelling: exact; exact but for spaces, points,
hyphens and underscores; a word in letters of another case; a single letter of another case, if its unit fits (`T [C]`
is no time t, `U [V]` no displacement u). A column that is still missing is the only cell in a unit of it, if there is
one; this guess is told. What nobody names is left alone: where `columns=` says that the letter of one quantity is
another, as x of an acceleration, other letters are none that may be left out.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from itertools import product, zip_longest
from typing import NamedTuple

from mdr.tools.messages import one_line, short
from mdr.tools.notation import listed, scale_of

_HEAD = re.compile(
    r"(?P<name>.*?)\s*(?:[\[(](?P<unit>[^\])\[(]*)[\])]|\s*/\s*(?P<other>\S.*)|(?:,|\s+in)\s+(?P<after>[^\s,()\[\]]+))?"
)
QUANTITIES = ("COF", "cof", "mu", "μ", "µ", "friction")  #: of which a pure number in brackets says that it is
SPELLINGS = 4  #: how well a name fits, best first
FITS, BARE, MISFITS = range(3)  #: a unit of the column, none where one is needed, another


class Column(NamedTuple):
    """A column that is looked for."""

    name: str  #: in the library
    names: tuple[str, ...] = ()  #: other names that a header may give it
    unit: str = "-"  #: of the library, a key of `UNITS`
    needed: bool = True
    bare: bool = False  #: whether a header without a unit means that of the library
    lone: bool = False  #: whether the only cell in a unit of it is it
    instead: str = ""  #: what may be given in its place
    empty: float | None = None  #: what an empty cell, or inf, stands for; None refuses them
    likely: tuple[float, float] = (0.0, math.inf)  #: range of the greatest absolute value; outside a unit may be wrong
    doubtful: tuple[str, ...] = ()  #: names that may mean another quantity: asked about, unless `columns=` names them
    asked: str = ""  #: what else a doubtful name may mean, and the way out then

    @property
    def example(self) -> str:
        """A header as it is meant."""
        unit = {"m": "um", "m/s": "mm/s", "rad/s": "Hz", "Pa": "MPa", "1/Pa": "1/MPa", "K": "degC"}.get(
            self.unit, self.unit
        )
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
    below: str = ""  #: unit in a row of its own

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
        is_name = whole is not None and (name is None or whole <= name)
        is_quantity = column.unit == "-" and self.unit in QUANTITIES  # as in SD (COF)
        own = self.unit if column.measured_in(self.unit) or not (is_name or is_quantity) else ""
        return own or self.below


class Header:
    """The cells of a header, the columns that are looked for in it, and what is wrong."""

    def __init__(
        self,
        cells: Sequence[str],
        below: Sequence[str],
        columns: Sequence[Column],
        units: Mapping[str, str],
        called: Mapping[str, str | int],
    ) -> None:
        self.columns, self.units, self.called = columns, units, called
        self.heads = [Head.of(cell)._replace(below=unit) for cell, unit in zip_longest(cells, below, fillvalue="")]
        others = [(own, one) for name, own in called.items() for one in columns if one.name != name]
        self.letters_differ = any(own in one.names for own, one in others)
        self.at: dict[str, int] = {}  #: cell of each column that was found
        self.said: list[str] = []  #: guesses
        self.faults: list[str] = []
        self._take_called()
        self._take_named()
        asked = self._ask()
        self._take_lone()
        self.places = [Place(one, self.at[one.name], self._unit(one)) for one in columns if one.name in self.at]
        self.faults += [what for place in self.places if (what := self._fault(place.column))]
        wanted = [one for one in columns if one.needed or one.name in {*units, *called}]
        self.absent = [one for one in wanted if one.name not in self.at and called.get(one.name) != ""]
        if unnamed := [one for one in self.absent if one.name not in {*called, *asked}]:
            self.faults.insert(0, self._lacks(unnamed))

    def way_out(self, more: Sequence[Column] = ()) -> str:
        """What to say beside the name of the file, so that it is read as it is; of `more` columns too."""
        if all(place.column.needed for place in self.places):
            more = [*more, *(one for one in self.columns if one.lone and not one.needed)]
        absent = list(dict.fromkeys([*self.absent, *(one for one in more if one.name not in self.at)]))
        free = self._free()
        columns = {name: own for name, own in self.called.items() if name in self.at or own == ""}
        bare = [one for one in self.columns if one.name in self.at and self._lacks_unit(one)]
        blank = [i for i in free if not self.heads[i].unit]
        for one in absent:
            # a cell in its unit, of several that with its letter; or one of as many without a unit as there are columns
            fitting = [i for i in free if self._measures(i, one) and not self._axes(i) - {one.name[-1]}]
            fitting.sort(key=lambda i: one.name[-1] not in self._axes(i))
            at = next(iter(fitting or ([i for i in blank if i in free] if len(blank) == len(absent) else [])), None)
            if at is None and not (one.needed or one.lone) and any(other.lone for other in more):
                continue
            columns[one.name] = "..." if at is None else self.heads[at].name or at + 1
            free = [i for i in free if i != at]
            bare += [one] if not fitting and not self._is_bare(one) and one.name not in self.units else []
        units = {**self.units, **{one.name: one.example.partition("[")[2].rstrip("]") for one in bare}}
        if not absent and not bare:
            return ""
        return ", ".join(f"{name}={_dict(said)}" for name, said in (("columns", columns), ("units", units)) if said)

    @property
    def unread(self) -> list[str]:
        """Names of the cells that are no column and may be pure numbers."""
        heads = [self.heads[i] for i in self._free()]
        return [one.name for one in heads if one.name and {one.unit, one.below} <= {"", "-", "1", "%"}]

    # --- names ---

    def _take_called(self) -> None:
        """The columns that `columns=` names or numbers."""
        for column in self.columns:
            own = self.called.get(column.name)
            if own is None:
                continue
            if own == "":
                self.faults += [f'columns: {column.name} is needed, got ""'] if column.needed else []
                continue
            ranks = {i: rank for i, head in enumerate(self.heads) if (rank := head.spelling((str(own),))) is not None}
            found = [i for i, rank in ranks.items() if rank == min(ranks.values())]
            if isinstance(own, int) or (not found and own.isascii() and own.isdigit()):
                found = [int(own) - 1] if 0 < int(own) <= len(self.heads) else []
            taken = [name for name, index in self.at.items() if index in found]
            if not found:
                what = "cells are numbered from 1" if str(own).isdigit() else "columns= must name one of these"
                self.faults.append(f"the header names no {short(str(own))}; {what}")
            elif taken:
                self.faults.append(f"columns: {taken[0]} and {column.name} are both called {short(str(own))}; give one")
            else:
                self._take(column, found)

    def _take_named(self) -> None:
        """The columns whose names are in the header, the best first."""
        for fit, spelling in product((FITS, BARE, MISFITS), range(SPELLINGS)):
            for column in self.columns:
                if column.name not in self.at and column.name not in self.called:
                    found = [i for i in self._free() if self._rank(column, i) == (fit, spelling)]
                    if found:
                        self._take(column, found)

    def _ask(self) -> set[str]:
        """Ask about cells whose name may mean one of the missing columns or another quantity; the columns asked for."""
        asked: dict[int, list[Column]] = {}
        for column in self.columns:
            if column.name not in {*self.at, *self.called}:
                for i in self._free():
                    rank = self.heads[i].spelling(column.doubtful)
                    unit = self.heads[i].unit_of(column, column.doubtful)
                    if rank is not None and (column.measured_in(unit) or not unit):
                        asked.setdefault(i, []).append(column)
        for i, columns in asked.items():
            head, whose = short(self.heads[i].whole), " or ".join(one.name for one in columns)
            ways = [f'if it is {one.name}, columns={{"{one.name}": "{short(self.heads[i].name)}"}}' for one in columns]
            ways += dict.fromkeys(one.asked for one in columns if one.asked)
            ways += [f'columns={{"{one.name}": ""}} leaves it out' for one in columns[:1] if not one.needed]
            self.faults.append(f"{head} may be {whose}, or another quantity: {'; '.join(ways)}")
        return {one.name for columns in asked.values() for one in columns}

    def _take_lone(self) -> None:
        """The columns that are missing, where one cell alone is in a unit of them."""
        is_bare = not any(one.name in self.at for one in self.columns if not one.needed)
        for column in self.columns:
            is_open = column.lone and column.name not in self.at and column.name not in self.called
            if is_open and (column.needed or is_bare):
                of_unit = [i for i, head in enumerate(self.heads) if self._measures(i, column)]
                if any(self.heads[i].spelling(column.doubtful) is not None for i in of_unit):
                    continue  # asked about
                if len(of_unit) == 1 and of_unit[0] in self._free():
                    self._take(column, of_unit)
                    self.said.append(f"{short(self.heads[of_unit[0]].whole)} is read as {column.name}")

    def _take(self, column: Column, found: list[int]) -> None:
        if len(found) > 1:
            which = f'say which it is, columns={{"{column.name}": {found[0] + 1}}} for the first'
            self.faults.append(f"the header names {column.name} twice; {which}")
        self.at[column.name] = found[0]

    def _free(self) -> list[int]:
        return [i for i in range(len(self.heads)) if i not in self.at.values()]

    def _rank(self, column: Column, index: int) -> tuple[int, int] | None:
        """How well unit and spelling of a cell fit; None for another name."""
        names = [one for one in column.names if column.needed or len(one) > 1 or not self.letters_differ]
        spelling = self.heads[index].spelling((column.name, *names))
        if spelling is None:
            return None
        unit = self.heads[index].unit_of(column, (column.name, *column.names))
        needs_none = self._is_bare(column) or column.name in self.units
        fits = (FITS if column.measured_in(unit) else MISFITS) if unit else (FITS if needs_none else BARE)
        is_other = spelling == SPELLINGS - 1 and (fits == MISFITS or (fits == BARE and not column.needed))
        others = (one.doubtful for one in self.columns if one is not column)
        is_other |= fits != FITS and any(self.heads[index].spelling(one) is not None for one in others)
        return None if is_other else (fits, spelling)

    def _measures(self, index: int, column: Column) -> bool:
        """Whether a cell has a unit of the column."""
        return column.unit != "-" and column.measured_in(self.heads[index].unit or self.heads[index].below)

    def _lacks(self, absent: Sequence[Column]) -> str:
        """What the header names not, and what it must."""
        names = " and no ".join(one.name for one in absent)
        example = ", ".join(one.example for one in self.columns if one.needed)
        instead = "".join(f", or give {one.instead}" for one in absent if one.instead)
        named = "the header names" if any(head.whole for head in self.heads) else "there is no header, which names"
        return f"{named} no {names}; write {example}{instead}"

    def _axes(self, index: int) -> set[str]:
        """Letters of axes that stand as words in a cell."""
        return set("xyz") & set(re.split(r"[\W_]+", self.heads[index].name.casefold()))

    # --- units ---

    def _written(self, column: Column) -> str:
        """The unit in the header."""
        own = self.called.get(column.name)
        names = (str(own),) if own else (column.name, *column.names)
        return self.heads[self.at[column.name]].unit_of(column, names)

    def _unit(self, column: Column) -> str:
        """The unit that is written, or that which `units` gives."""
        return self._written(column) or self.units.get(column.name, "")

    def _is_bare(self, column: Column) -> bool:
        return column.bare or column.unit == "-"

    def _lacks_unit(self, column: Column) -> bool:
        return not (self._unit(column) or self._is_bare(column))

    def _fault(self, column: Column) -> str:
        """What is wrong with the unit of a column; empty where nothing is."""
        name, unit, written, given = column.name, column.unit, self._written(column), self.units.get(column.name)
        if given is not None and scale_of(given, unit) is None:
            return f"units: {name} = {short(repr(given))} is none of {listed(unit)}"
        if written and not column.measured_in(written):
            if unit == "-":
                return f"{name} is a pure number, got the unit {short(written)!r}"
            way_out = f"write {column.example}"
            if not column.needed:
                way_out += f'; if it is no {name}, columns={{"{name}": ""}} leaves it out'
            return f"the unit {short(written)!r} of {name} is none of {listed(unit)}; {way_out}"
        if written and given is not None and scale_of(written, unit) != scale_of(given, unit):
            return f"the header gives {name} in {written}, units= in {given}; give one"
        if self._lacks_unit(column):
            return f"{name} needs a unit in its header, one of {listed(unit)}: {column.example}"
        return ""


def _dict(said: Mapping[str, str | int]) -> str:
    """A dict as it is typed."""
    words = {name: f'"{short(one)}"' if isinstance(one, str) and one != "..." else one for name, one in said.items()}
    inner = ", ".join(f'"{name}": {word}' for name, word in words.items())
    return f"{{{inner}}}"


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
    same = {"′": "'", "″": "''", "´": "'", '"': "''", "’": "'", "_": "", " ": "", "-": "", ".": "", "µ": "μ"}
    return "".join(same.get(letter, letter) for letter in name)
