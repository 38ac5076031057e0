"""Words for numbers in sentences and captions, so that each says what was run: ranges, counts and powers of ten."""

from collections.abc import Iterable

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_COUNTS = ("no", "one", "two", "three", "four", "five", "six")


def number(value: float, digits: int = 2) -> str:
    """Round to so many significant digits; small and large ones as powers of ten: 0.012, 4.9·10⁻⁶."""
    if value == 0 or 1e-3 <= abs(value) < 1e5:
        plain = f"{value:.{digits}g}"
        return (f"{float(plain):.0f}" if "e" in plain else plain).replace("-", "−")
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    power = f"10{str(int(exponent)).translate(_RAISED)}"
    return power if float(mantissa) == 1 else f"{float(mantissa):g}·{power}".replace("-", "−")


def percent(value: float, digits: int = 2) -> str:
    """A share in per cent: 0.29 is 29 %."""
    return f"{number(100 * value, digits)} %"


def span(values: Iterable[float], digits: int = 3) -> str:
    """The range of some values: "1 to 100", or "100" where the ends read alike."""
    values = list(values)
    low, high = number(min(values), digits), number(max(values), digits)
    return low if low == high else f"{low} to {high}"


def ranged(values: Iterable[float]) -> str:
    """The same after the name of a quantity: "from 1 to 100", or "= 100"."""
    text = span(values)
    return f"from {text}" if " to " in text else f"= {text}"


def counted(n: int, one: str, many: str = "") -> str:
    """So many things: "one shape", "six velocities", "12 shapes"; `many` is a plural of its own."""
    plural = many or (one[:-1] + "ies" if one.endswith("y") else one + "s")
    return f"{_COUNTS[n] if n < len(_COUNTS) else n} {one if n == 1 else plural}"


def listed(values: Iterable[object]) -> str:
    """An enumeration: "1", "1 and 2", "1, 2 and 3"."""
    *others, end = [f"{value:g}" if isinstance(value, int | float) else str(value) for value in values]
    return f"{', '.join(others)} and {end}" if others else end
