"""Text of messages: the spelling that was meant, and long text cut to one line."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from operator import eq

#: names in other words
OTHER_WORDS = {
    "ball": "Sphere", "parabola": "Paraboloid", "punch": "FlatPunch", "cylinder": "FlatPunch", "disc": "FlatPunch",
    "disk": "FlatPunch", "rubber": "KelvinVoigt", "kelvin": "KelvinVoigt", "zener": "StandardLinearSolid", "sine":
    "NormalOscillation", "rigid": "RigidPull", "spring": "SpringPull", "radius": "R",
}  # fmt: skip
_NUMBERS = re.compile(r"[-+]?\d[\d.]*(?:e[-+]?\d+)?", re.IGNORECASE)
MOST_TOLD = 4  #: differences or reasons that one message tells before it counts the rest


def offer(word: str, known: Sequence[str]) -> str:
    """The right spelling of a name, as a question, or all there are."""
    meant = nearest(word, known)
    return f"did you mean {meant}?" if meant else f"there are {', '.join(known)}"


def nearest(word: str, known: Sequence[str]) -> str | None:
    """The known name that the word stands for, that is spelt most like it, or that alone begins with it."""
    from difflib import SequenceMatcher, get_close_matches

    folded: dict[str, list[str]] = {}
    for one in known:
        folded.setdefault(one.casefold(), []).append(one)
    given, word = word, word.casefold()[:99]
    if OTHER_WORDS.get(word) in known:
        return OTHER_WORDS[word]
    close = [one for one in folded if word and one.startswith(word)]
    if len(close) != 1:
        close = [one for one in folded if one in get_close_matches(word, folded, n=3)]
    found = max(close, key=lambda one: SequenceMatcher(None, one, word).ratio(), default=None)  # of equals the first
    return max(folded[found], key=lambda one: sum(map(eq, one, given))) if found else None  # F_x is not f_x


def short(text: str, longest: int = 60) -> str:
    """The text, or its beginning."""
    return text if len(text) <= longest else text[: longest - 1] + "…"


def one_line(text: str, longest: int = 400) -> str:
    """The text as one printable line, cut where it is too long: at some five lines of a terminal."""
    plain = "".join(c if c.isprintable() else " " for c in text)
    return short(" ".join(plain.split()), longest)


def first_of(told: Sequence[str]) -> list[str]:
    """The first of what is to be told, and how many more there are."""
    return [*told[:MOST_TOLD], *([f"and {len(told) - MOST_TOLD} more"] if len(told) > MOST_TOLD else [])]


def most_frequent(reasons: Iterable[str]) -> list[str]:
    """The most frequent of some reasons with their numbers, "" left out; those alike but for numbers count as one."""
    kinds: dict[str, list[str]] = {}
    for why in filter(None, reasons):
        kinds.setdefault(_NUMBERS.sub("#", why), []).append(why)
    ranked = sorted(kinds.values(), key=len, reverse=True)
    lines = [f"{len(alike)}: {alike[0]}" for alike in ranked[:MOST_TOLD]]
    rest = sum(map(len, ranked[MOST_TOLD:]))
    return lines + ([f"{rest}: for {len(ranked) - MOST_TOLD} other reasons"] if rest else [])
