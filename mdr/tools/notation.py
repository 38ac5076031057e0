"""Quantities as people write them: a number and a unit, "2 um", "50 Hz", "10%", or what to write instead.

One reader for case files, options of commands, boxes of the explorer and headers of tables; one writer, `shown`. A
number without a unit is in that of the library.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from functools import cache, lru_cache
from typing import Any, TypeVar

from mdr.tools.arrays import EXACT, Array
from mdr.tools.messages import short

T = TypeVar("T", float, Array)


def _prefixed(unit: str, prefixes: str, scale: float = 1.0) -> dict[str, float]:
    """The unit, which is `scale` in that of the library, and what it becomes with each prefix."""
    powers = {"p": -12, "n": -9, "µ": -6, "m": -3, "c": -2, "k": 3, "M": 6, "G": 9}
    return {unit: scale} | {f"{prefix}{unit}": 10.0 ** powers[prefix] * scale for prefix in prefixes}


GRAVITY = 9.80665  #: standard gravity [m/s²]
UNITS = {
    "m": _prefixed("m", "cmµn") | {"Å": 1e-10, "inch": 0.0254},
    "m/s": _prefixed("m/s", "cmµn") | {"mm/min": 1e-3 / 60},
    "m/s²": _prefixed("m/s2", "m") | _prefixed("g", "m", GRAVITY),
    "N": _prefixed("N", "kmµnp"),
    "W": _prefixed("W", "kMmµn"),
    "Pa": _prefixed("Pa", "kMG") | {"N/mm2": 1e6, "bar": 1e5, "psi": 0.45359237 * GRAVITY / 0.0254**2},
    "1/s": {"1/s": 1.0, "s^-1": 1.0, "s-1": 1.0, "1/ms": 1e3, "1/us": 1e6, "1/min": 1 / 60},
    "1/Pa": {"1/Pa": 1.0, "1/kPa": 1e-3, "1/MPa": 1e-6, "1/GPa": 1e-9},
    "rad/s": {"rad/s": 1.0} | _prefixed("Hz", "mkM", math.tau) | {"rpm": math.tau / 60},
    "Hz": _prefixed("Hz", "mkM") | {"rad/s": 1 / math.tau, "rpm": 1 / 60},
    "rad": _prefixed("rad", "m") | dict.fromkeys(("deg", "°"), math.pi / 180),
    "deg": dict.fromkeys(("deg", "°"), 1.0) | {"rad": 180 / math.pi},
    "s": _prefixed("s", "mµn") | {"min": 60.0, "hr": 3600.0},
    "kg": {"kg": 1.0} | _prefixed("g", "mµ", 1e-3),
    "N/m": _prefixed("N/m", "kMmµ") | {"N/mm": 1e3, "N/µm": 1e6},
    "N s/m": _prefixed("N s/m", "kmµ") | {"N s/mm": 1e3},
    "1/m": {"1/m": 1.0, "1/mm": 1e3},
    "N m": _prefixed("N m", "kmµn") | {"N mm": 1e-3},
    "V": _prefixed("V", "mµ"),
    "Pa s": _prefixed("Pa s", "m"),
    "K": {"K": 1.0} | dict.fromkeys(("degC", "°C", "C"), 1.0),
    "-": dict.fromkeys(("", "-", "1"), 1.0) | {"%": 0.01},
}  #: how each unit of the library may be written, {unit: {symbol: value in the unit}}
ZEROS = dict.fromkeys(("degC", "°C", "C"), 273.15)  #: what 0 in a unit is in that of the library, where it is not 0
#: other words for symbols
WORDS = {
    "sec": "s", "seconds": "s", "msec": "ms", "usec": "us", "minute": "min", "minutes": "min",
    "hour": "hr", "hours": "hr", "h": "hr",
    "micron": "um", "microns": "um", "angstrom": "Å",
}  # fmt: skip
#: which of them is shown, with a prefix, in the place of the unit of the library
SHOWN = {"rad/s": "Hz", "rad": "deg", "kg": "g"}

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_PLAIN = re.compile(_NUMBER)
_GROUPED = re.compile(r"[+-]?\d{1,3}(?:[,'’ \u00a0\u202f]\d{3})+(?:\.\d*)?")
_GROUPED_BY_POINTS = re.compile(r"[+-]?\d{1,3}(?:\.\d{3})+,\d+")
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+(?:[eE][+-]?\d+)?")
_WITH_UNIT = re.compile(r"(?P<number>.*?[\d.])\s*(?P<unit>(?![eE][+-]?\d)(?:1/)?(?:[^\W\d_]|[%°]).*)?", re.DOTALL)


def is_number(text: str) -> bool:
    """Whether it is a number with a decimal point, and no more."""
    return bool(_PLAIN.fullmatch(text))


def parted(text: str) -> tuple[str, str]:
    """Number and unit of a quantity as texts; "" for what is not there."""
    found = _WITH_UNIT.fullmatch(text.strip())
    return (found["number"], found["unit"] or "") if found else (text.strip(), "")


def is_unit(symbol: str) -> bool:
    """Whether it is one of the units."""
    return bool(symbol) and not is_number(symbol) and any(scale_of(symbol, unit) is not None for unit in UNITS)


def scale_of(symbol: str, unit: str) -> float | None:
    """Value of a symbol in a unit of the library; None where it measures something else."""
    return _known(unit).get(_same(symbol))


@cache
def _known(unit: str) -> dict[str, float]:
    return {_same(one): value for one, value in UNITS.get(unit, {unit: 1.0}).items()}


def listed(unit: str) -> str:
    """The symbols that measure the same as a unit of the library."""
    return ", ".join(UNITS.get(unit, (unit,))).replace("µ", "u")


def value_in(name: str, text: str, unit: str, also: str = "") -> float:
    """The value of a quantity in a unit of the library. ValueError, naming it, with what it wants; or `also`."""
    number, symbol = parted(text)
    scale = scale_of(symbol or unit, unit)
    if scale is not None and any(one.isdigit() for one in number):
        try:
            return float(converted(number_in(number), symbol or unit, unit))
        except ValueError as wrong:
            raise ValueError(f"{name}: {wrong}") from None
    first, _, others = (listed(unit) + (f", {also}" if also else "")).partition(", ")
    wanted = f"{first} (or {others})" if others else first or "a number without a unit"
    wanted = f"a pure number, such as 0.1 or 10%{f', or 0.5 {also}' if also else ''}" if unit == "-" else wanted
    raise ValueError(f"{name} wants {wanted}, got {short(repr(text))}")


def numbers_in(name: str, value: Any, unit: str) -> Any:
    """A value, or values in lists, in which quantities as texts have become numbers; words, without a unit, stay.

    Innermost lists may have a unit for each of their entries, as "Pa, s" of an arm.
    """
    if isinstance(value, list):
        units = unit.split(", ") if not any(isinstance(one, list) for one in value) else [unit]
        return [numbers_in(f"{name}[{i}]", one, units[i % len(units)]) for i, one in enumerate(value)]
    return value_in(name, value, unit) if isinstance(value, str) and unit else value


def quotient(unit: str, by: str) -> str:
    """Unit of a quantity over another: "m/s" over "Pa" is "m/(s Pa)". Empty where one of them is."""
    if not (unit and by):
        return ""
    (above, below), (under, over) = _factors(unit), _factors(by)
    above, below = above + over, below + under
    for one in [*above]:
        if one in below:
            above.remove(one)
            below.remove(one)
    left = " ".join(above) or ("1" if below else "-")
    right = " ".join(below)
    return f"{left}/({right})" if len(below) > 1 else f"{left}/{right}" if below else left


def _factors(unit: str) -> tuple[list[str], list[str]]:
    """What stands above and below the line of a unit, "-" being nothing."""
    above, _, below = unit.partition("/")
    return [one for one in above.split() if one not in ("-", "1")], below.strip("()").split()


def shown(value: float, unit: str, digits: int = 5) -> str:
    """A value with the prefix that brings it above one, as `value_in` reads it: "2 µm", "3 MPa"; or a word."""
    if not math.isfinite(value):
        return "undefined" if math.isnan(value) else "infinite"
    symbol, known = SHOWN.get(unit, unit), UNITS.get(unit, {})
    scales = {one: known[one] for one in (prefix + symbol for prefix in ("", *"nµmkMG")) if one in known}
    below = [one for one in scales if scales[one] <= abs(value) * (1 + EXACT)]
    best = max(below, key=scales.__getitem__) if below else min(scales, key=scales.__getitem__, default=unit)
    best = best if value else unit
    return f"{value / known.get(best, 1.0):.{digits}g} {best.removeprefix('-')}".rstrip()


def number_in(cell: str) -> float:
    """The finite number in a cell; ValueError with what to write instead."""
    text = cell.strip().replace("−", "-")
    value = float(text) if is_number(text) else math.nan
    if math.isfinite(value):
        return value
    raise ValueError(f"{short(text)} is no number{_instead(text)}" if text else f"the cell is empty{_instead(text)}")


def decimal_mark(cells: Iterable[str]) -> tuple[str, str]:
    """The decimal mark of numbers in one file, and what is wrong where it cannot be told.

    It is a comma if one of them cannot be read otherwise, as 0,5 and 1.234,5 can not. 1,234 alone tells nothing.
    """
    marked = [one for one in cells if "," in one or "." in one]
    commas = (one for one in marked if "," in one)
    if (comma := next((one for one in commas if _is_comma_number(one)), None)) is None:
        return ".", ""
    point = next((one for one in marked if "," not in one), None)
    return ",", f"{short(comma)} and {short(point)} stand in one file: write one decimal mark" if point else ""


def with_point(cell: str) -> str:
    """A number with a decimal comma, as one with a point."""
    return cell.replace(".", "").replace(",", ".") if "," in cell else cell


def _is_comma_number(cell: str) -> bool:
    """Whether its comma must be a decimal mark."""
    grouped = _GROUPED.fullmatch(cell) and not re.match(r"[+-]?0", cell)
    return bool((_DECIMAL_COMMA.fullmatch(cell) and not grouped) or _GROUPED_BY_POINTS.fullmatch(cell))


def _instead(text: str) -> str:
    """What to write in the place of what is no number."""
    if not text or text.casefold() in ("nan", "na", "n/a", "-", "--", "inf", "+inf", "-inf", "none", "null"):
        return ", leave the line out"
    if re.search(r"\d:\d\d", text):
        return ", but a time of day: write seconds, or of even steps give rate=, in Hz"
    if _GROUPED_BY_POINTS.fullmatch(text):
        return f", write {text.replace('.', '').replace(',', '.')}"
    if _GROUPED.fullmatch(text):
        whole = re.sub(r"[,'’\s]", "", text)
        decimal = f" or, if the comma is the decimal mark, {text.replace(',', '.')}" if text.count(",") == 1 else ""
        return f", write {whole} without a thousands separator{decimal if '.' not in text else ''}"
    if _DECIMAL_COMMA.fullmatch(text):
        return f", write {text.replace(',', '.')} with a decimal point"
    number, symbol = parted(text)
    if symbol and is_number(number):
        return f", write {number} and the unit in the header"
    return ""


def converted(values: T, symbol: str, unit: str) -> T:
    """Values in the unit of a symbol that is known, in that of the library."""
    return in_unit(values, scale_of(symbol, unit) or 1.0) + ZEROS.get(_same(symbol), 0.0)


def in_unit(values: T, scale: float) -> T:
    """Values times the scale; a division where that is exact, so that 100 um is 100e-6 m to the last digit."""
    whole = round(1 / scale) if scale < 1 else 0
    return values / whole if whole and math.isclose(whole * scale, 1, rel_tol=EXACT) else values * scale


_ALIKE = str.maketrans("µμ²¹⁻\u212b", "uu21-\u00c5", "^ ·.*")


@lru_cache(maxsize=2**12)
def _same(symbol: str) -> str:
    """A symbol without what does not matter in it: m/s/s, ms-2, m s⁻² and m/sec^2 are m/s2."""
    text = re.sub(r"[^\W\d_]+", lambda word: WORDS.get(word[0].casefold(), word[0]), symbol)
    text = text.translate(_ALIKE).replace("/s/s", "/s2")
    text = re.sub(r"(?<=[a-zA-Z])-(?=[a-zA-Z])", "", text)  # Pa-s
    text = re.sub(r"(?<=.)s-([12])$", lambda power: "/s2" if power[1] == "2" else "/s", text)
    return re.sub(r"^([kMG]?Pa|m?m)-1$", r"1/\1", text)
