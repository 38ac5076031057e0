"""A claim of the paper, the checks and figures that test it, and the page that shows them all.

Text is written plainly and set by the page: `v_c`, `mu_0`, `Δu_z` and `ωτ` read as symbols, `x^2` as a power,
and the tags i, b, em, code, sub, sup and br pass through; everything else is escaped.
"""

import base64
import html
import io
import json
import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import InitVar, dataclass, field
from pathlib import Path
from typing import Any

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

    def __post_init__(self) -> None:
        """Ask for a name to link to, a verdict, and at least one check; no two with one name."""
        _require_slug("claim", self.name)
        if self.parts:
            for what in ("checks", "figures"):
                object.__setattr__(self, what, [one for part in self.parts for one in getattr(part, what)])
        object.__setattr__(self, "checks", tuple(self.checks))
        object.__setattr__(self, "figures", tuple(self.figures))
        if not re.match(rf"holds$|holds if \S|fails when \S|{NOT_TESTED}", self.verdict):
            raise ValueError(f"claim {self.name}: verdict must be one of {VERDICTS}, got {self.verdict!r}")
        if not self.checks:
            raise ValueError(f"claim {self.name}: a claim without checks proves nothing; add a Check")
        if len({figure.name for figure in self.figures}) < len(self.figures):
            raise ValueError(f"claim {self.name}: two figures have the same name; rename one")
        if len({check.name for check in self.checks}) < len(self.checks):
            raise ValueError(f"claim {self.name}: two checks have the same name; rename one")

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


def write_report(claims: Sequence[Claim], folder: str | Path, effort: str = "full") -> Path:
    """Write index.html, checks.json and the figures into `folder`; return the page."""
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
    (folder / "checks.json").write_text(text + "\n", encoding="utf-8")
    page = folder / "index.html"
    page.write_text(html_page(claims, effort), encoding="utf-8")
    return page


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


def html_page(claims: Sequence[Claim], effort: str = "full") -> str:
    """Give the whole report as one page that needs no other file; a tap on a figure enlarges it or undoes that."""
    glance = [(c, f) for c in claims for f in c.figures if f.name == "glance"][:1]
    from mdr.tools.provenance import versions

    n_checks, n_held = sum(len(c.checks) for c in claims), sum(c.n_held for c in claims)
    parts = [
        _HEAD,
        f"<p class=count>{_count(n_held, n_checks)}.</p>",
        _table("verdicts", ("Claim", "Verdict", "In one sentence", "Checks"), claims, _verdict_row),
        *(_figure(claim, figure) for claim, figure in glance),
        *(_section(claim, [figure for _, figure in glance]) for claim in claims),
        f"<footer><p>Made by <code>{_command(effort)}</code> with {versions()}.</p></footer>",
        "</main></body></html>\n",
    ]
    return "\n".join(parts)


def markup(text: str) -> str:
    """Plain text as HTML: symbols with subscripts, powers, and the few tags that pass."""
    text = re.sub(rf"&lt;(/?(?:{_TAGS}))&gt;", r"<\1>", html.escape(text, quote=False))
    text = re.sub(r"\^\{([^}]*)\}|\^([-−]?\w+(?:\.\w+)?)", _power, text)
    symbol = r"(?<!\w)(Δ?)([^\W\d_]|mu)_(\w(?:[\w,]{0,2}\w)?)(?!\w)"
    return re.sub(symbol + r"|([α-ω]+)(?!m\b)", _symbol, text)  # μm is a unit


def plain(text: str) -> str:
    """Give the text without the tags that the page understands."""
    return re.sub(rf"</?(?:{_TAGS})>", "", text)


def number(value: float | None, tolerance: float = 0.0) -> str:
    """Print a number as HTML, with two digits more than the tolerance can tell apart (3 to 10 digits)."""
    if value is None or not math.isfinite(value):
        return "none" if value is None else {math.inf: "∞", -math.inf: "−∞"}.get(value, "not a number")
    if value == round(value) and abs(value) < 1e6:
        digits = 7
    elif tolerance > 0:
        digits = min(max(math.ceil(math.log10(abs(value) / tolerance)) + 2, 3), 10)
    else:
        digits = 4
    mantissa, _, exponent = f"{value:.{digits}g}".replace("-", "−").partition("e")
    if not exponent:
        return mantissa
    power = f"10<sup>{exponent[0].replace('+', '')}{exponent[1:].lstrip('0')}</sup>"
    return power if mantissa == "1" else f"{mantissa}·{power}"


def _verdict_row(claim: Claim) -> tuple[str, ...]:
    kind = claim.verdict.split()[0] + ("-if" if claim.verdict.startswith("holds if") else "")
    count = f"<span class={'yes' if claim.held else 'no'}>{claim.n_held}/{len(claim.checks)}</span>"
    link = f'<a href="#{claim.name}">{markup(claim.title)}</a>'
    return link, f"<span class={kind}>{markup(claim.verdict)}</span>", markup(claim.sentence), count


def _check_row(check: Check) -> tuple[str, ...]:
    sign = {"within": "", "at most": "≤ ", "at least": "≥ "}[check.side]
    numbers = (check.got, check.expected, check.tolerance)
    got, expected, tolerance = (number(value, check.tolerance) for value in numbers)
    held = "<span class=yes>✓</span>" if check.held else "<span class=no>✗</span>"
    return markup(check.name), got, sign + expected, "–" if sign else tolerance, held, markup(check.why)


def _section(claim: Claim, above: Sequence[Figure]) -> str:
    """One claim: quote, range, what was measured, verdict; then figures and checks, or its parts with theirs."""
    link = (
        ' <a href="#glance">Its main figure opens this page.</a>'
        if len(_shown(claim, above)) < len(claim.figures)
        else ""
    )
    return "\n".join(
        (
            f'<section id="{claim.name}"><h2>{markup(claim.title)}</h2>',
            *_words(claim),
            f"<p><b>Verdict:</b> {_verdict_row(claim)[1]}. {markup(claim.sentence)}{link}</p>",
            *(_part(claim, part, above) for part in claim.parts),
            *(() if claim.parts else _evidence(claim, claim, above)),
            "</section>",
        )
    )


def _part(claim: Claim, part: Part, above: Sequence[Figure]) -> str:
    head = f'<h3 id="{claim.name}-{part.name}">{markup(part.title)}</h3>'
    found = f"<p><b>Found:</b> {markup(part.sentence)}</p>"
    return "\n".join((head, *_words(part), found, *_evidence(claim, part, above)))


def _words(told: Claim | Part) -> Iterator[str]:
    """Quote, range and what was measured."""
    if told.quote:
        yield f"<blockquote>{markup(told.quote)}</blockquote>"
    for label, text in (("Tested over", told.range), ("Measured", told.measured)):
        if text:
            yield f"<p><b>{label}:</b> {markup(text)}</p>"


def _evidence(claim: Claim, told: Claim | Part, above: Sequence[Figure]) -> Iterator[str]:
    """Figures that do not stand above, and the table of checks, open where one was missed."""
    head = ("Check", "Got", "Expected", "Tolerance", "Held", "Why")
    n_held = sum(check.held for check in told.checks)
    yield from (_figure(claim, figure) for figure in _shown(told, above))
    summary = f"<summary>{_count(n_held, len(told.checks))}</summary>"
    yield f"<details{'' if n_held == len(told.checks) else ' open'}>{summary}"
    yield _table("checks", head, told.checks, _check_row)
    yield "</details>"


def _shown(told: Claim | Part, above: Sequence[Figure]) -> tuple[Figure, ...]:
    return tuple(figure for figure in told.figures if all(figure is not other for other in above))


def _table(kind: str, head: Sequence[str], items: Iterable[Any], row: Callable[[Any], tuple[str, ...]]) -> str:
    """Set a table whose cells carry their heading, so that a narrow screen can stack them."""
    rows = [
        "".join(f'<td data-label="{h}">{cell}</td>' for h, cell in zip(head, row(item), strict=True)) for item in items
    ]
    heading = "".join(f"<th scope=col>{h}</th>" for h in head)
    body = "\n".join(f"<tr>{cells}</tr>" for cells in rows)
    return f"<table class={kind}><thead><tr>{heading}</tr></thead><tbody>\n{body}\n</tbody></table>"


def _figure(claim: Claim, figure: Figure) -> str:
    name = "glance" if figure.name == "glance" else f"{claim.name}-{figure.name}"
    data = base64.b64encode(figure.svg).decode("ascii")
    image = f'<img src="data:image/svg+xml;base64,{data}" alt="{html.escape(plain(figure.alt))}">'
    enlarge = f'<label class=enlarge><input type=checkbox aria-label="full size">{image}</label>'
    return f'<figure id="{name}">{enlarge}<figcaption>{markup(figure.caption)}</figcaption></figure>'


def _count(n_held: int, n: int) -> str:
    return f"{n_held} of {n} checks held"


def _symbol(match: re.Match[str]) -> str:
    if match[4]:
        return f"<i>{match[4]}</i>"
    letter = "μ" if match[2] == "mu" else match[2]
    return f"{match[1]}<i>{letter}</i><sub>{match[3]}</sub>"


def _power(match: re.Match[str]) -> str:
    return f"<sup>{(match[1] or match[2]).replace('-', '−')}</sup>"


def _command(effort: str) -> str:
    return "python -m validation" + ("" if effort == "full" else f" --{effort}")


def _json_number(value: float | None) -> float | str | None:
    """JSON has no NaN (null here) and no infinity ("inf", which float() reads back)."""
    if value is None or math.isnan(value):
        return None
    return str(value) if math.isinf(value) else value


def _require_slug(what: str, name: str) -> None:
    if not re.fullmatch(r"[a-z0-9][a-z0-9_-]*", name):
        raise ValueError(f"{what} name must be lower-case letters, digits, _ and -, got {name!r}")


_TAGS = "i|b|em|code|sub|sup|br"

_EQ_15 = """
<p class=equation aria-label="Eq. (15)"><i>v</i><sub>c</sub> = <span class=fraction><span><i>μ</i><sub>0</sub>
Δ<i>u<sub>z</sub></i> <i>ω</i></span><span>|<i>mω</i>² − <i>k<sub>x</sub></i>|</span></span>
√<span class=root>(<i>γ</i><sub>z,c</sub> <i>ω</i>)² + [ <i>κ</i> (<i>mω</i>² − <i>k</i><sub>x,c</sub> −
<i>k<sub>x</sub></i>) ]²</span>, <span class=where><i>κ</i> = <i>k</i><sub>z,c</sub> /
<i>k</i><sub>x,c</sub></span> <span class=tag>(15)</span></p>"""

_CSS = """
body { margin: 0; font: 17px/1.5 Georgia, "Times New Roman", serif; color: #1a1a1a; background: #fff; }
main { max-width: 62rem; margin: 0 auto; padding: 1.5rem; }
h1, h2, h3, th, .count, figcaption, footer, .tag { font-family: "Helvetica Neue", Arial, sans-serif; }
h1 { font-size: 1.8rem; line-height: 1.2; } h2 { font-size: 1.25rem; line-height: 1.25; }
h3 { font-size: 1.05rem; margin-top: 2rem; }
section { border-top: 1px solid #bbb; margin-top: 2.5rem; } a { color: #00518a; } 
sub, sup { font-size: .75em; line-height: 0; }
blockquote { margin: 1rem 0; padding: .1rem 0 .1rem 1rem; border-left: 4px solid #bbb; }
.equation { font-size: 1.1rem; margin: 1.2rem 0; line-height: 2.2; } .tag, .where { margin-left: 1.2em; }
.fraction { display: inline-flex; flex-direction: column; vertical-align: middle; text-align: center;
  line-height: 1.5; margin: 0 .3em; } .fraction span + span { border-top: 1px solid; }
.root { border-top: 1px solid; padding: .15em .2em 0; }
table { border-collapse: collapse; width: 100%; margin: 1rem 0; font-size: .88rem; line-height: 1.4; }
th, td { text-align: left; vertical-align: top; padding: .35rem .7rem .35rem 0; border-bottom: 1px solid #ddd;
  overflow-wrap: anywhere; }
th { border-bottom: 2px solid #555; white-space: nowrap; }
.verdicts td:nth-child(1) { width: 24%; } .verdicts td:nth-child(2) { width: 24%; }
.checks td:nth-child(2), .checks td:nth-child(3), .checks td:nth-child(4) { white-space: nowrap;
  font-variant-numeric: tabular-nums; }
.checks td:nth-child(1) { width: 26%; } .checks td:nth-child(6) { width: 32%; }
.holds, .yes { color: #00603a; font-weight: bold; } .holds-if { color: #7a5200; font-weight: bold; }
.fails, .not, .no { color: #a3180c; font-weight: bold; }
figure { margin: 1.5rem 0; break-inside: avoid; } img { max-width: 100%; height: auto; }
.enlarge { display: block; overflow-x: auto; cursor: zoom-in; }
.enlarge input { position: absolute; opacity: 0; } .enlarge input:focus-visible + img { outline: 2px solid #00518a; }
.enlarge input:checked + img { max-width: none; width: max(150%, 60rem); cursor: zoom-out; }
summary { cursor: pointer; font-weight: bold; }
figcaption { font-size: .85rem; line-height: 1.45; color: #333; max-width: 46rem; }
footer { border-top: 1px solid #bbb; margin-top: 2.5rem; font-size: .8rem; color: #444; }
@media screen and (max-width: 40rem) {
  body { font-size: 16px; } main { padding: 1rem; } .equation { font-size: 1rem; }
  table, tbody, tr, td { display: block; width: auto !important; } thead { display: none; }
  tr { border-bottom: 2px solid #bbb; padding: .5rem 0; } td { border: 0; padding: .1rem 0; }
  .checks td:nth-child(n+2):nth-child(-n+5) { display: inline-block; margin-right: 1em; }
  td::before { content: attr(data-label) ": "; font: bold .75rem Arial, sans-serif; color: #555; }
}
@media print { body { font-size: 10.5pt; } main { max-width: none; padding: 0; } tr { break-inside: avoid; }
  details::details-content { content-visibility: visible; } }
"""

_HEAD = f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Does Eq. (15) hold for general contacts?</title>
<style>{_CSS}</style></head><body><main>
<h1>Does Eq. (15) hold for general contacts?</h1>
<p>A body is pulled over a viscoelastic half-space while it oscillates in the normal direction. Above
the critical velocity <i>v</i><sub>c</sub> the oscillation no longer lowers friction. M. Popov
(<i>Facta Universitatis, Series Mechanical Engineering</i> 14 (2016) 335) derives it for one spring and
damper in contact,</p>
{_EQ_15}
<p>and argues that it “is valid not only for the simple considered model with a single spring-damper
combination, but also for quite general contacts (so long as the amplitude of oscillation remains
small)”. Here each step of that argument is tested with arrays of springs, each of which sticks, slips
and leaves contact on its own; at the end a half-space in three dimensions judges the springs.</p>"""
