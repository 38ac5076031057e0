"""A claim of the paper, the checks, equations and figures on which it stands, and their record.

Text is written plainly and set by the page, see validation/typeset.py.
"""

import inspect
import io
import json
import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import InitVar, dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from mdr.tools.atomic_write import write_whole
from validation.typeset import plain

VERDICTS = ("holds", "holds if …", "fails when …")  #: a verdict reads or starts like one of these
SIDES = ("within", "at most", "at least")  #: of the expected number a check allows
NOT_TESTED = "not tested"  #: the verdict on a claim whose module raised


@dataclass(frozen=True)
class Check:
    """One number against another: held while |got − expected| ≤ tolerance; None and NaN never hold.

    `at_most` and `at_least` are one-sided, `between` is an interval; `why` is the reason for the tolerance.
    """

    name: str
    got: float | None
    expected: float
    tolerance: float
    why: str
    side: str = "within"

    def __post_init__(self) -> None:
        """Plain floats only, so that a check pickles, prints and turns into JSON."""
        object.__setattr__(self, "got", None if self.got is None else float(self.got))
        object.__setattr__(self, "expected", float(self.expected))
        object.__setattr__(self, "tolerance", float(self.tolerance))
        check = f"check {self.name!r}: "
        if math.isnan(self.expected):
            raise ValueError(check + "expected must be a number, got nan")
        if not 0 <= self.tolerance < math.inf:
            raise ValueError(check + f"tolerance must be finite and >= 0, got {self.tolerance!r}")
        if self.side not in SIDES:
            raise ValueError(check + f"side must be one of {SIDES}, got {self.side!r}")

    @classmethod
    def at_most(cls, name: str, got: float | None, bound: float, why: str) -> "Check":
        """Held while got ≤ bound."""
        return cls(name, got, bound, 0.0, why, "at most")

    @classmethod
    def at_least(cls, name: str, got: float | None, bound: float, why: str) -> "Check":
        """Held while got ≥ bound."""
        return cls(name, got, bound, 0.0, why, "at least")

    @classmethod
    def between(cls, name: str, got: float | None, low: float, high: float, why: str) -> "Check":
        """Held while low ≤ got ≤ high."""
        return cls(name, got, (low + high) / 2, (high - low) / 2, why)

    @property
    def held(self) -> bool:
        """Whether the number is where it is expected."""
        got = math.nan if self.got is None else self.got
        if got == self.expected:
            return True  # two infinities agree, though their difference is nan
        excess = got - self.expected
        miss = {"within": abs(excess), "at most": excess, "at least": -excess}[self.side]
        return miss <= self.tolerance

    def record(self, claim: str) -> dict[str, Any]:
        """Give the check as a row of checks.json; a one-sided check says so in front of its reason."""
        side = "" if self.side == "within" else f"{self.side} {self.expected:.6g}: "
        return {
            "claim": claim,
            "name": plain(self.name),
            "got": _json_number(self.got),
            "expected": _json_number(self.expected),
            "tolerance": self.tolerance,
            "why": side + plain(self.why),
            "held": self.held,
        }


Checks = Iterator[Check]  #: what a function of a claim yields


@dataclass(frozen=True)
class Figure:
    """A matplotlib figure drawn to bytes at once (and closed), with a caption saying what to see.

    Draw heavy meshes with `rasterized=True`. A figure named "glance" opens the page.
    """

    name: str
    caption: str
    drawing: InitVar[Any]  #: the matplotlib figure; only its bytes are kept
    alt: str
    svg: bytes = field(init=False, repr=False)
    png: bytes = field(init=False, repr=False)

    def __post_init__(self, drawing: Any) -> None:
        """Draw the same bytes from the same drawing: no date, no program name, fixed identifiers."""
        import matplotlib as mpl
        import matplotlib.pyplot as plt

        _require_slug("figure", self.name)
        if not (self.caption and self.alt):
            raise ValueError(f"figure {self.name}: say in caption and alt what to see")
        nothing = {"svg": ("Date", "Creator", "Format", "Type"), "png": ("Software",)}
        with mpl.rc_context({"svg.hashsalt": "mdr", "svg.fonttype": "path"}):
            for kind, keys in nothing.items():
                out = io.BytesIO()
                metadata = dict.fromkeys(keys)
                drawing.savefig(out, format=kind, dpi=160, bbox_inches="tight", metadata=metadata)
                object.__setattr__(self, kind, out.getvalue())
        plt.close(drawing)


class Equation(NamedTuple):
    """An equation that a claim names."""

    name: str  #: as the text has it, "(*)" or "ψ"; "" where it is only shown
    tex: str  #: see validation/formula.py
    words: str  #: what it is, and what is new in it


@dataclass(frozen=True)
class Part:
    """One range over which the statement of a claim was tested, and what was found there."""

    name: str  #: to link to
    title: str
    quote: str  #: what the paper says of it; "" where the claim has it
    range: str
    measured: str
    sentence: str  #: the conclusion in one line
    checks: tuple[Check, ...]
    figures: tuple[Figure, ...] = ()
    equations: tuple[Equation, ...] = ()


@dataclass(frozen=True)
class Claim:
    """What the paper says, over which range it was tested, what was found, and the verdict.

    A claim whose statement was tested over several ranges has parts; its checks and figures are then theirs.
    """

    name: str  #: the module's name
    title: str
    quote: str  #: what the paper says, with equation or section
    range: str  #: over which it was tested
    measured: str  #: what was found, in words
    verdict: str  #: "holds", "holds if …" or "fails when …"
    sentence: str  #: the conclusion in one line
    checks: tuple[Check, ...] = ()
    figures: tuple[Figure, ...] = ()
    parts: tuple[Part, ...] = ()
    equations: tuple[Equation, ...] = ()

    def __post_init__(self) -> None:
        """Ask for a name to link to, a verdict, and at least one check; no two with one name."""
        _require_slug("claim", self.name)
        for what in ("checks", "figures"):
            own = (one for part in self.parts or (self,) for one in getattr(part, what))
            object.__setattr__(self, what, tuple(own))
        if not re.match(rf"holds$|holds if \S|fails when \S|{NOT_TESTED}", self.verdict):
            raise ValueError(f"claim {self.name}: verdict must be one of {VERDICTS}, got {self.verdict!r}")
        if not self.checks:
            raise ValueError(f"claim {self.name}: a claim without checks proves nothing; add a Check")
        for what, named in (("figures", self.figures), ("checks", self.checks)):
            if len({one.name for one in named}) < len(named):
                raise ValueError(f"claim {self.name}: two {what} have the same name; rename one")

    @classmethod
    def broken(cls, name: str, error: str) -> "Claim":
        """Stands in the report for a claim whose module raised `error`."""
        check = Check("the claim runs to its end", 0, 1, 0, error)
        text = f"The claim's module stopped: {error}"
        return cls(name, name.replace("_", " "), "", "", "", NOT_TESTED, text, (check,))

    @property
    def n_held(self) -> int:
        """How many checks held."""
        return sum(check.held for check in self.checks)

    @property
    def held(self) -> bool:
        """Whether all of them did."""
        return self.n_held == len(self.checks)


def told(claim: Callable[..., Any], numbers: Mapping[str, Any]) -> dict[str, str]:
    """What the docstring of a function that gives a claim, or a part of one, says of it, by the names of the fields.

    Its name is that of the module. The first paragraph is the title; others begin with the name of a field, as "Range:
    ...", or with "How: ", which tells the reader of the code what is done. Names in braces are numbers: local to the
    function, or of its module.
    """
    title, *paragraphs = re.sub(r"(?<!\n)\n(?!\n)", " ", inspect.getdoc(claim) or "").split("\n\n")
    texts = {"name": claim.__module__.rpartition(".")[2], "title": title, "quote": ""}
    for paragraph in paragraphs:
        field, _, text = paragraph.partition(": ")
        texts[field.lower()] = text.format_map({**claim.__globals__, **numbers})
    texts.pop("how", None)
    return texts


def write_record(claims: Sequence[Claim], folder: str | Path) -> None:
    """Write checks.json and the figures into a folder."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for claim in claims:
        for figure in claim.figures:
            (folder / f"{claim.name}-{figure.name}.svg").write_bytes(figure.svg)
            (folder / f"{claim.name}-{figure.name}.png").write_bytes(figure.png)
    record = {
        "claims": [{"name": c.name, "verdict": plain(c.verdict), "sentence": plain(c.sentence)} for c in claims],
        "checks": [check.record(claim.name) for claim in claims for check in claim.checks],
    }
    text = json.dumps(record, indent=1, ensure_ascii=False, allow_nan=False)
    write_whole(folder / "checks.json", f"{text}\n".encode())


def text_table(claims: Iterable[Claim]) -> str:
    """Give the verdict table for a terminal, with every check that did not hold."""
    lines = []
    for claim in claims:
        lines.append(f"{claim.name}: {plain(claim.verdict)} [{claim.n_held}/{len(claim.checks)} checks held]")
        lines.append(f"    {plain(claim.sentence)}")
        for c in claim.checks:
            if not c.held:
                side = "" if c.side == "within" else f"{c.side} "
                numbers = f"got {c.got!r}, expected {side}{c.expected!r}, tolerance {c.tolerance!r}"
                lines.append(f"    NOT HELD {plain(c.name)}: {numbers} ({plain(c.why)})")
    return "\n".join(lines)


def _json_number(value: float | None) -> float | str | None:
    """JSON has no NaN (null here) and no infinity ("inf", which float() reads back)."""
    if value is None or math.isnan(value):
        return None
    return str(value) if math.isinf(value) else value


def _require_slug(what: str, name: str) -> None:
    if not re.fullmatch(r"[a-z0-9][a-z0-9_-]*", name):
        raise ValueError(f"{what} name must be lower-case letters, digits, _ and -, got {name!r}")
