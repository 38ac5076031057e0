"""Numbers and units as people write them in tables: the value, or what to write instead."""

from __future__ import annotations

import math
import re

from mdr.tools.arrays import EXACT, Array
from mdr.tools.messages import short


def _prefixed(unit: str, prefixes: str, rest: str = "") -> dict[str, float]:
    """The unit and what it becomes with each prefix, {symbol: value in the unit}."""
    powers = {"n": -9, "u": -6, "µ": -6, "μ": -6, "m": -3, "c": -2, "": 0, "k": 3, "M": 6, "G": 9}
    return {f"{prefix}{unit}{rest}": 10.0 ** powers[prefix] for prefix in ("", *prefixes)}


GRAVITY = 9.80665  #: standard gravity [m/s²]
UNITS = {
    "m": _prefixed("m", "cmuµμn"),
    "m/s": _prefixed("m", "cmuµμn", "/s") | {"mm/min": 1e-3 / 60},
    "m/s²": {"m/s²": 1.0, "m/s^2": 1.0, "m/s2": 1.0, "mm/s²": 1e-3, "g": GRAVITY, "mg": 1e-3 * GRAVITY},
    "N": _prefixed("N", "kmuµμn"),
    "Pa": _prefixed("Pa", "kMG") | {"N/mm²": 1e6, "N/mm^2": 1e6, "N/mm2": 1e6},
    "rad/s": {"rad/s": 1.0} | {unit: math.tau * hertz for unit, hertz in _prefixed("Hz", "mkM").items()},
    "s": _prefixed("s", "muµμn"),
    "-": dict.fromkeys(("", "-", "1"), 1.0),
}  #: how each unit of the library may be written, {unit: {symbol: value in the unit}}

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_PLAIN = re.compile(_NUMBER)
_GROUPED = re.compile(r"[+-]?\d{1,3}(?:[,'’ \u00a0\u202f]\d{3})+(?:\.\d*)?")
_GROUPED_BY_POINTS = re.compile(r"[+-]?\d{1,3}(?:\.\d{3})+,\d+")
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+(?:[eE][+-]?\d+)?")
_WITH_UNIT = re.compile(rf"({_NUMBER})\s*([^\W\d_]|[%°]).*")


def is_number(text: str) -> bool:
    """Whether it is a number with a decimal point, and no more."""
    return bool(_PLAIN.fullmatch(text))


def number_in(cell: str) -> float:
    """The finite number in a cell; ValueError with what to write instead."""
    text = cell.strip().replace("−", "-")
    value = float(text) if is_number(text) else math.nan
    if math.isfinite(value):
        return value
    raise ValueError(f"{short(text) or 'nothing'} is no number{_instead(text)}")


def _instead(text: str) -> str:
    """What to write in the place of what is no number."""
    if not text or text.casefold() in ("nan", "na", "n/a", "-", "--", "inf", "+inf", "-inf", "none", "null"):
        return ", leave the line out"
    if _GROUPED_BY_POINTS.fullmatch(text):
        return f", write {text.replace('.', '').replace(',', '.')}"
    if _GROUPED.fullmatch(text):
        whole = re.sub(r"[,'’\s]", "", text)
        decimal = f" or, if the comma is the decimal mark, {text.replace(',', '.')}" if text.count(",") == 1 else ""
        return f", write {whole} without a thousands separator{decimal if '.' not in text else ''}"
    if _DECIMAL_COMMA.fullmatch(text):
        return f", write {text.replace(',', '.')} with a decimal point"
    if found := _WITH_UNIT.fullmatch(text):
        return f", write {found[1]} and the unit in the header"
    return ""


def in_unit(values: Array, scale: float) -> Array:
    """Values times the scale; a division where that is exact, so that 100 um is 100e-6 m to the last digit."""
    whole = round(1 / scale) if scale < 1 else 0
    return values / whole if whole and math.isclose(whole * scale, 1, rel_tol=EXACT) else values * scale
