"""The header of a table: which column stands where and in which unit, or what to write instead.

What `columns=` names, or numbers, is taken first. Of the other cells those in a unit of the column come first, then
those without a unit, then those in another; among these the best spelling: exact; exact but for signs between letters;
a word in letters of another case; a single letter of another case, if its unit fits (`T [C]` is no time t). A name that
may mean another quantity is asked about. A column that is still missing is the only cell in a unit of it, if there is
one; this guess is told. What nobody names is left alone: where `columns=` says that the letter of one quantity is
another, as x of an acceleration, other letters are none that may be left out.

What is printed to be copied is made of the file alone: `...` stands for what it does not say.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from functools import lru_cache
from itertools import product, zip_longest
from typing import NamedTuple

from mdr.tools.messages import one_line, short
from mdr.tools.notation import is_unit, listed, scale_of

Units = Mapping[str, str] | None  #: of columns whose header has none
Columns = Mapping[str, str | int] | None  #: name or number, from 1, of columns; "" leaves one out
_BRACKETS = re.compile(r"\s*(?:\[(?P<square>[^\])\[(]*)[\])]|[(<{](?P<round>[^\])\[(<>}]*)[\])>}])\s*")
_BEHIND = re.compile(r"(?P<name>.*?)(?:\s*/\s*(?P<slash>[^\s\[\]()][^\[\]()]*)|(?:,|\s+in)\s+(?P<after>[^\s,()\[\]]+))")
_LOGARITHM = re.compile(r"(?:log|lg|ln)(?:_?10)?(?=[\s_(\[.])", re.IGNORECASE)
LONGEST = 1000  #: letters of a head that are looked at
SPELLINGS = 4  #: how well a name fits, best first
FITS, BARE, MISFITS = range(3)  #: a unit of the column, none where one is needed, another
#: what is measured in a unit of the library
MEASURED = {
    "m": "a length", "m/s": "a velocity", "m/s²": "an acceleration", "N": "a force", "Pa": "a stress or a modulus",
    "rad/s": "a frequency or a speed of rotation", "rad": "an angle", "s": "a time", "K": "a temperature",
    "kg": "a mass", "N m": "a torque", "V": "a voltage", "Pa s": "a viscosity", "N/m": "a stiffness",
    "1/Pa": "a compliance", "-": "a pure number",
}  # fmt: skip
#: what makes a quantity one of another unit
USABLE = {
    ("rad/s", "m/s"): "times the radius of the track, radius= of friction, it is a velocity",
    ("N m", "N"): "over the arm it is a force", ("N m", "-"): "over arm and load it is a COF",
    ("N", "-"): "over the normal force it is a COF", ("m/s", "m"): "integrated once it is a way",
    ("m/s", "m/s²"): "its rate is an acceleration", ("rad", "-"): "give its tangent",
    ("V", ""): "which needs the sensitivity of its sensor, sensitivity= of a record",
}  # fmt: skip


EXAMPLES = {"m": "um", "m/s": "mm/s", "rad/s": "Hz", "Pa": "MPa", "1/Pa": "1/MPa", "K": "degC"}  #: units as written


class Column(NamedTuple):
    """A column that is looked for."""

    name: str  #: in the library
    names: tuple[str, ...] = ()  #: other names that a header may give it
    unit: str = "-"  #: of the library, a key of `UNITS`
    needed: bool = True
    bare: bool = False  #: whether a header without a unit means that of the library
    lone: bool = False  #: whether the only cell in a unit of it is it
    instead: str = ""  #: what may be given in its place
    others: tuple[str, ...] = ()  #: columns that, where all are there, stand in its place
    without: str = ""  #: a column beside which it is not looked for
    empty: float | None = None  #: what an empty cell, or inf, stands for; None refuses them
    likely: tuple[float, float] = (0.0, math.inf)  #: range of the greatest absolute value; outside a unit may be wrong
    doubtful: tuple[str, ...] = ()  #: names that may mean another quantity: asked about, unless `columns=` names them
    asked: str = ""  #: what else a doubtful name may mean, and the way out then
    beside: tuple[str, ...] = ()  #: words in the header, or above it, by which a doubtful name is this column
    given: str = ""  #: an argument that says the same

    @property
    def example(self) -> str:
        """A header as it is meant."""
        return self.name if self.unit == "-" else f"{self.name} [{EXAMPLES.get(self.unit, self.unit)}]"

    @property
    def is_bare(self) -> bool:
        """Whether it needs no unit."""
        return self.bare or self.unit == "-"

    def measured_in(self, unit: str) -> bool:
        """Whether a unit is one of this quantity."""
        return bool(unit) and scale_of(unit, self.unit) is not None


class Reading(NamedTuple):
    """What is said of a file beside its text."""

    units: Units = None
    columns: Columns = None
    skip: int | None = None  #: lines above the header; None finds it
    table: int | str | None = None  #: which table of the file, from 1, or words of a line above it; None: the only one


class Place(NamedTuple):
    """A column that was found."""

    column: Column
    at: int  #: cell of the row
    unit: str  #: in which it is given, "" for that of the library


class Head(NamedTuple):
    """One cell of a header, as "r [um]", "r (um)", "r / um", "r, um", "r in um" or "r_um"."""

    whole: str
    name: str  #: without the unit
    unit: str
    is_sure: bool  #: whether it is a unit, and no part of the name as in E(t)
    is_suffix: bool  #: whether it is the end of the name, as in u_m

    @classmethod
    def of(cls, cell: str, below: str = "") -> Head:
        """Name and unit in a cell, or in one below it."""
        whole = " ".join(cell[:LONGEST].split())
        if brackets := list(_BRACKETS.finditer(whole)):
            found = brackets[-1]
            unit = (found["square"] or found["round"] or "").strip()
            name = f"{whole[: found.start()]} {whole[found.end() :]}".strip()
            sure = is_unit(unit) or found["square"] is not None or any(one in unit for one in "/^")
            is_alone = is_unit(unit) and len(brackets) == 1
            if is_alone or (found.end() == len(whole) and name and unit and (sure or not below)):
                return cls(whole, name, unit, sure, False)
        elif behind := _BEHIND.fullmatch(whole):
            unit = (behind["slash"] or behind["after"]).strip()
            return cls(whole, behind["name"], unit, is_unit(unit), False)
        if below:
            return cls(whole, whole, below, True, False)
        parts = re.split(r"[_\s.]+", whole)
        for start, end in ((i, k) for k in range(len(parts), 1, -1) for i in range(1, k)):
            unit = "/".join(parts[start:end]).replace("/per/", "/")
            # one letter within the name is an index
            if is_unit(unit) and end - start < 4 and (end == len(parts) or len(unit) > 1):
                return cls(whole, "_".join([*parts[:start], *parts[end:]]), unit, True, True)
        return cls(whole, whole, "", True, False)

    @property
    def is_logarithm(self) -> bool:
        """Whether the name says so."""
        return bool(_LOGARITHM.match(self.whole))

    @property
    def axes(self) -> set[str]:
        """Letters of axes that stand as words in it."""
        return set("xyz") & set(re.split(r"[\W_]+", self.name.casefold()))

    @property
    def quantity(self) -> str:
        """The unit of the library that its unit measures in; empty without one."""
        own = (one for one in MEASURED if self.unit and self.is_sure and scale_of(self.unit, one) is not None)
        return next(own, "")

    def rank(self, column: Column, names: Sequence[str], needs_unit: bool) -> tuple[int, int, str] | None:
        """How well unit and spelling fit a column of these names, and the unit; None for another name."""
        is_symbol = self.is_suffix and self.whole in (column.name, *names)  # as F_N
        readings = [] if is_symbol else [(self.name, self.unit)]
        readings += [(self.whole, "")] if self.is_suffix or not self.is_sure else []
        found = []
        for name, unit in readings:
            spelling = _spelling(name, names)
            fits = (FITS if column.measured_in(unit) else MISFITS) if unit else (BARE if needs_unit else FITS)
            if spelling is not None and not (fits == MISFITS and self.is_suffix):
                found.append((fits, spelling, unit))
        return min(found, default=None)


class Header:
    """The cells of a header, the columns that are looked for in it, and what is wrong."""

    def __init__(
        self, cells: Sequence[str], below: Sequence[str], columns: Sequence[Column], reading: Reading, above: str
    ) -> None:
        units, called = reading.units or {}, reading.columns or {}
        self.columns, self.units, self.called, self.above = columns, units, called, above
        self.heads = [Head.of(cell, unit) for cell, unit in zip_longest(cells, below, fillvalue="")]
        others = [(own, one) for name, own in called.items() for one in columns if one.name != name]
        self.letters_differ = any(own in one.names for own, one in others)
        self.at: dict[str, int] = {}  #: cell of each column that was found
        self.written: dict[str, str] = {}  #: its unit in the header
        self.said: list[str] = []  #: guesses
        self.faults: list[str] = []
        self._take_called()
        self._take_named([one for one in columns if not one.without])
        self._take_named([one for one in columns if one.without and one.without not in self.at])
        asked = self._ask()
        self._take_lone()
        self.places = [Place(one, self.at[one.name], self._unit(one)) for one in columns if one.name in self.at]
        self.faults += [what for place in self.places if (what := self._fault(place.column))]
        stood_for = {one.name for one in columns if one.others and self.at.keys() >= {*one.others}}
        needed = {one.name for one in columns if one.needed} - stood_for
        wanted = [one for one in columns if one.name in {*needed, *units, *called, *asked}]
        self.absent = [one for one in wanted if one.name not in self.at and called.get(one.name) != ""]
        if unnamed := [one for one in self.absent if one.name not in {*called, *asked}]:
            self.faults.insert(0, self._lacks(unnamed))

    def way_out(self, more: Sequence[Column] = ()) -> str:
        """What to say beside the name of the file, so that it is read as it is; of `more` columns too."""
        are_needed = all(place.column.needed for place in self.places)
        if not more and are_needed and not any(map(self._is_doubtful, self.free())):
            more = [one for one in self.columns if one.lone and not one.needed]
        absent = dict.fromkeys([*self.absent, *(one for one in more if one.name not in self.at)])
        columns = {name: repr_of(own) for name, own in self.called.items() if name in self.at or own == ""}
        for one in absent:
            at = self._meant(one)
            if at is not None or one.needed or one.lone or not any(other.lone for other in more):
                columns[one.name] = "..." if at is None else self.word_for(at)
        lacking = {place.column.name: "..." for place in self.places if self._lacks_unit(place.column)}
        if not absent and not lacking:
            return ""
        units = {name: repr_of(own) for name, own in self.units.items()} | lacking
        told = {"columns": columns, "units": units}
        pairs = {kind: ", ".join(f"{repr_of(name)}: {own}" for name, own in told[kind].items()) for kind in told}
        return ", ".join(f"{kind}={{{said}}}" for kind, said in pairs.items() if said)

    def word_for(self, at: int) -> str:
        """What names a cell, as it is typed: its name, if it is that of no other, or else its number."""
        name = self.heads[at].name
        one_of_it = name.isprintable() and len(name) <= 60 and self._cells_called(name) == [at]
        return repr_of(name) if one_of_it else str(at + 1)

    @property
    def unread(self) -> list[str]:
        """Names of the cells that are no column and may be pure numbers."""
        heads = (self.heads[i] for i in self.free())
        return [one.name for one in heads if one.name and one.unit in ("", "-", "1", "%")]

    # --- names ---

    def _take_called(self) -> None:
        """The columns that `columns=` names or numbers."""
        for column in self.columns:
            own = self.called.get(column.name)
            if not own and own != 0:
                self.faults += [f'columns: {column.name} is needed, got ""'] if own == "" and column.needed else []
                continue
            found = [] if isinstance(own, int) else self._cells_called(own)
            if not found and str(own).isascii() and str(own).isdigit():
                found = [int(own) - 1] if 0 < int(own) <= len(self.heads) else []
            taken = [name for name, index in self.at.items() if index in found]
            if not found:
                what = "cells are numbered from 1" if str(own).isdigit() else "columns= must name one of these"
                self.faults.append(f"the header names no {short(str(own))}; {what}")
            elif taken:
                self.faults.append(f"columns: {taken[0]} and {column.name} are both called {short(str(own))}; give one")
            else:
                head = self.heads[found[0]]
                # an index, as that of mu_s, is no unit
                is_index = head.is_suffix and not column.measured_in(head.unit) and len(head.unit) == 1
                by_whole = not isinstance(own, int) and _spelling(head.name, (own,)) is None and not head.is_sure
                self._take(column, found, "" if is_index or by_whole else head.unit)
                if head.is_logarithm:
                    self.faults.append(f"{short(head.whole)} is a logarithm: give its power of the base in the file")

    def _cells_called(self, own: str) -> list[int]:
        """The cells that are best spelt so."""
        ranks: dict[int, set[int]] = {}
        for (i, head), by_whole in product(enumerate(self.heads), (False, True)):
            if (rank := _spelling(head.whole if by_whole else head.name, (own,))) is not None:
                ranks.setdefault(rank + SPELLINGS * (head.is_suffix and not by_whole), set()).add(i)
        return sorted(ranks[min(ranks)]) if ranks else []

    def _take_named(self, columns: Sequence[Column]) -> None:
        """Those of some columns whose names are in the header, the best first."""
        open_ones = [one for one in columns if one.name not in {*self.at, *self.called}]
        free = self.free()
        ranks = {one.name: {i: rank for i in free if (rank := self._rank(one, i))} for one in open_ones}
        for fit, spelling in product((FITS, BARE, MISFITS), range(SPELLINGS)):
            for column in (one for one in open_ones if one.name not in self.at):
                of, taken = ranks[column.name], set(self.at.values())
                if found := [i for i, rank in of.items() if rank[:2] == (fit, spelling) and i not in taken]:
                    self._take(column, found, of[found[0]][2])

    def _ask(self) -> set[str]:
        """Decide, or ask about, cells whose name may mean a missing column or another quantity; those asked for."""
        asked: dict[int, list[Column]] = {}
        for column in self.columns:
            if column.name not in {*self.at, *self.called}:
                for i in self.free():
                    rank = self.heads[i].rank(column, column.doubtful, not column.is_bare)
                    if rank is not None and rank[0] != MISFITS:
                        asked.setdefault(i, []).append(column)
        for i, columns in asked.items():
            sure = [(one, word) for one in columns if (word := self._word_beside(one, i))]
            if len(sure) == 1 and sure[0][0].name not in self.at:
                self._take(sure[0][0], [i], self.heads[i].unit)
                self.said.append(f"{short(self.heads[i].whole)} is read as {sure[0][0].name}, for {sure[0][1]}")
        asked = {i: columns for i, columns in asked.items() if i not in self.at.values()}
        for i, columns in asked.items():
            ways = [f"if it is {one.name}, columns={{{repr_of(one.name)}: {self.word_for(i)}}}" for one in columns]
            ways += dict.fromkeys(one.asked for one in columns if one.asked)
            none = ", ".join(f'"{one.name}": ""' for one in columns if not one.needed)
            ways += [f"columns={{{none}}} leaves it out"] if none else []
            whose = " or ".join(one.name for one in columns)
            self.faults.append(f"{short(self.heads[i].whole)} may be {whose}, or another quantity: {'; '.join(ways)}")
        return {one.name for columns in asked.values() for one in columns if one.needed}

    def _word_beside(self, column: Column, at: int) -> str:
        """A word in another cell, or above, by which a doubtful name is this column."""
        told = " ".join([self.above, *(head.whole for i, head in enumerate(self.heads) if i != at)])
        words = (word for word in column.beside if re.search(rf"(?<![^\W\d_]){word}", told, re.IGNORECASE))
        return column.given or next(words, "")

    def _take_lone(self) -> None:
        """The columns that are missing, where one cell alone is in a unit of them."""
        is_bare = not any(one.name in self.at for one in self.columns if not one.needed)
        for column in self.columns:
            if column.lone and column.name not in {*self.at, *self.called} and (column.needed or is_bare):
                of_unit = [i for i, head in enumerate(self.heads) if self._measures(head, column)]
                if len(of_unit) == 1 and (at := of_unit[0]) in self.free() and not self._is_doubtful(at):
                    self._take(column, of_unit, self.heads[at].unit)
                    self.said.append(f"{short(self.heads[at].whole)} is read as {column.name}")

    def _take(self, column: Column, found: list[int], unit: str) -> None:
        if len(found) > 1:
            which = f"say which it is, columns={{{repr_of(column.name)}: {found[0] + 1}}} for the first"
            self.faults.append(f"the header names {column.name} twice; {which}")
        self.at[column.name], self.written[column.name] = found[0], unit

    def free(self) -> list[int]:
        """The cells that are no column."""
        taken = set(self.at.values())
        return [i for i in range(len(self.heads)) if i not in taken]

    def _rank(self, column: Column, index: int) -> tuple[int, int, str] | None:
        """How well unit and spelling of a cell fit, and its unit; None for another name."""
        names = [one for one in column.names if column.needed or len(one) > 1 or not self.letters_differ]
        needs_unit = not column.is_bare and column.name not in self.units
        rank = self.heads[index].rank(column, (column.name, *names), needs_unit)
        if rank is None or self.heads[index].is_logarithm:
            return None
        is_other = rank[1] == SPELLINGS - 1 and (rank[0] == MISFITS or (rank[0] == BARE and not column.needed))
        others = (one.doubtful for one in self.columns if one is not column)
        is_other |= rank[0] != FITS and any(_spelling(self.heads[index].name, one) is not None for one in others)
        return None if is_other else rank

    def _measures(self, head: Head, column: Column) -> bool:
        """Whether a cell has a unit of the column."""
        return column.unit != "-" and column.measured_in(head.unit) and not head.is_logarithm

    def _is_doubtful(self, index: int) -> bool:
        """Whether its name may mean another quantity than those of its unit."""
        head = self.heads[index]
        return any(_spelling(one, column.doubtful) is not None for column in self.columns for one in head[:2])

    def _meant(self, column: Column) -> int | None:
        """The free cell that can only be this column: by its unit, and by the letter of an axis."""
        able = [one for one in self.columns if one.name not in self.at and self.called.get(one.name) != ""]
        fitting = [i for i in self.free() if self._measures(self.heads[i], column) and not self._is_doubtful(i)]
        fitting = [i for i in fitting if not self.heads[i].axes - {column.name[-1]}]
        fitting = [i for i in fitting if column.name[-1] in self.heads[i].axes] or fitting
        if len(fitting) != 1:
            return None
        head = self.heads[fitting[0]]
        rivals = [one for one in able if one is not column and self._measures(head, one)]
        is_its_axis = column.name[-1] in head.axes
        return None if any(one.needed or not (column.needed or is_its_axis) for one in rivals) else fitting[0]

    def _lacks(self, absent: Sequence[Column]) -> str:
        """What the header names not, what it must, and what else is there."""
        names = " and no ".join(one.name for one in absent)
        example = ", ".join(one.example for one in self.columns if one.needed)
        instead = "".join(f", or give {one.instead}" for one in absent if one.instead)
        named = "the header names" if any(head.whole for head in self.heads) else "there is no header, which names"
        return f"{named} no {names}; write {example}{instead}{self.others(absent)}"

    def others(self, absent: Sequence[Column]) -> str:
        """What cells measure that are none of the columns, and what would make them so."""
        said, looked_for = [], [one for one in self.columns if one.unit != "-" and not one.without]
        for head in (self.heads[i] for i in self.free()):
            if head.is_logarithm:
                said.append(f"{short(head.whole)} is a logarithm, give its power of the base in the file")
            elif head.quantity and not any(one.measured_in(head.unit) for one in looked_for):
                said.append(f"{short(head.whole)} is {MEASURED[head.quantity]}{_usable(head.quantity, absent)}")
        return "".join(f"; {one}" for one in said[:3])

    # --- units ---

    def _unit(self, column: Column) -> str:
        """The unit that is written, or that which `units` gives."""
        written, given = self.written.get(column.name, ""), self.units.get(column.name, "")
        return given if given and not is_unit(written) else written or given

    def _lacks_unit(self, column: Column) -> bool:
        return not (self._unit(column) or column.is_bare)

    def _fault(self, column: Column) -> str:
        """What is wrong with the unit of a column; empty where nothing is."""
        name, unit, written, given = column.name, column.unit, self._unit(column), self.units.get(column.name)
        leave_out = "" if column.needed else f'columns={{{repr_of(name)}: ""}} leaves it out'
        if given is not None and scale_of(given, unit) is None:
            return f"units: {name} = {short(repr(given))} is none of {listed(unit)}"
        if written and not column.measured_in(written):
            what = self.heads[self.at[name]].quantity
            is_other = f": it is {MEASURED[what]}{_usable(what, [column])}" if what else ""
            if unit == "-":
                return f"{name} is a pure number, got the unit {short(written)!r}{is_other}"
            say = "" if is_unit(written) else f"units={{{repr_of(name)}: ...}} says which it is"
            ways = ", ".join(filter(None, (leave_out, say)))
            return f"the unit {short(written)!r} of {name} is none of {listed(unit)}{is_other}{ways and '; '}{ways}"
        if written and given is not None and scale_of(written, unit) != scale_of(given, unit):
            return f"the header gives {name} in {written}, units= in {given}; give one"
        needs = f"{name} needs a unit in its header, one of {listed(unit)}{leave_out and '; '}{leave_out}"
        return needs if self._lacks_unit(column) else ""


def _usable(quantity: str, wanted: Sequence[Column]) -> str:
    """What makes a quantity one of the columns that are wanted."""
    ways = (USABLE.get((quantity, unit)) for unit in (*(one.unit for one in wanted), ""))
    return next((f", {way}" for way in ways if way), "")


def repr_of(said: str | int) -> str:
    """A word or a number as it is typed in Python."""
    is_plain = isinstance(said, str) and said.isprintable() and not {'"', "\\"} & {*said}
    return f'"{said}"' if is_plain else repr(said)


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
    if not plain or plain.casefold() not in {one.casefold() for one in kept}:
        return None
    return 2 if len(plain) > 1 else 3


_SAME = str.maketrans({"′": "'", "″": "''", "´": "'", '"': "''", "’": "'", "µ": "μ"} | dict.fromkeys("_ -.()[]", ""))


@lru_cache(maxsize=2**12)
def _plain(name: str) -> str:
    """A name without what does not matter in it, but for the case."""
    return name.translate(_SAME)
