"""The claims on the page: a group of lines, each of which unfolds to what was found, the evidence and the checks."""

import base64
import html
import re
from collections.abc import Iterable, Iterator, Sequence

from validation.formula import mathml
from validation.report import Check, Claim, Equation, Figure, Part
from validation.typeset import markup, number, plain


def group_of(title: str, told: str, claims: Sequence[Claim], above: Sequence[Figure]) -> str:
    """A group of claims, a line each; figures that stand above are left out."""
    text = f"<p>{markup(told)}</p>" if told else ""
    body = "\n".join(_section(claim, above) for claim in claims)
    return f'<section id="{slug(title)}" class=group><h2>{title}</h2>{text}\n{body}</section>'


def _section(claim: Claim, above: Sequence[Figure]) -> str:
    """One claim, folded to a line; what was found, quote, range, equations; then figures and checks, or its parts."""
    moved = len(_shown(claim, above)) < len(claim.figures)
    link = ' <a href="#glance">Its main figure opens this page.</a>' if moved else ""
    parts = (_part(claim, part, above) for part in claim.parts)
    return "\n".join(
        (
            f'<details class=claim id="{claim.name}"{"" if claim.held else " open"}><summary><h3>{markup(claim.title)}'
            f"</h3><span class=verdict><span class={kind_of(claim)}>{markup(claim.verdict)}</span></span> <span class="
            f"{'yes' if claim.held else 'no'}>{claim.n_held}/{len(claim.checks)}</span></summary>",
            f"<p class=sentence>{markup(claim.sentence)}{link}</p>",
            *_words(claim),
            *(parts if claim.parts else _evidence(claim, claim, above)),
            "</details>",
        )
    )


def _part(claim: Claim, part: Part, above: Sequence[Figure]) -> str:
    head = f'<h4 id="{claim.name}-{part.name}">{markup(part.title)}</h4><p class=sentence>{markup(part.sentence)}</p>'
    return "\n".join((head, *_words(part), *_evidence(claim, part, above)))


def _words(told: Claim | Part) -> Iterator[str]:
    """Quote, range, what was measured, and the equations named there."""
    if told.quote:
        yield f"<blockquote>{markup(told.quote)}</blockquote>"
    for label, text in (("Tested over", told.range), ("Measured", told.measured)):
        if text:
            yield f"<p><b>{label}:</b> {markup(text)}</p>"
    if told.equations:
        yield equations_of(told.equations)


def _evidence(claim: Claim, told: Claim | Part, above: Sequence[Figure]) -> Iterator[str]:
    """Figures that do not stand above, and the table of checks, open where one was missed."""
    n_held = sum(check.held for check in told.checks)
    yield from (figure_of(claim, figure) for figure in _shown(told, above))
    opened = "" if n_held == len(told.checks) else " open"
    yield f"<details{opened}><summary>{count_of(n_held, len(told.checks))}</summary>"
    yield _table(told.checks)
    yield "</details>"


def _shown(told: Claim | Part, above: Sequence[Figure]) -> tuple[Figure, ...]:
    return tuple(figure for figure in told.figures if all(figure is not other for other in above))


def _table(checks: Iterable[Check]) -> str:
    """Set a table whose cells carry their heading, so that a narrow screen can stack them."""
    rows = [zip(_HEAD, _row(check), strict=True) for check in checks]
    cells = ["".join(f'<td data-label="{head}">{cell}</td>' for head, cell in row) for row in rows]
    heading = "".join(f"<th scope=col>{head}</th>" for head in _HEAD)
    body = "\n".join(f"<tr>{row}</tr>" for row in cells)
    return f"<table class=checks><thead><tr>{heading}</tr></thead><tbody>\n{body}\n</tbody></table>"


_HEAD = ("Check", "Got", "Expected", "Tolerance", "Held", "Why")


def _row(check: Check) -> tuple[str, ...]:
    sign = {"within": "", "at most": "≤ ", "at least": "≥ "}[check.side]
    numbers = (check.got, check.expected, check.tolerance)
    got, expected, tolerance = (number(value, check.tolerance) for value in numbers)
    held = "<span class=yes>✓</span>" if check.held else "<span class=no>✗</span>"
    return markup(check.name), got, sign + expected, "–" if sign else tolerance, held, markup(check.why)


def figure_of(claim: Claim, figure: Figure) -> str:
    """A figure with its caption, as a part of the page."""
    name = "glance" if figure.name == "glance" else f"{claim.name}-{figure.name}"
    data = base64.b64encode(figure.svg).decode("ascii")
    image = f'<img src="data:image/svg+xml;base64,{data}" alt="{html.escape(plain(figure.alt))}">'
    enlarge = f'<label class=enlarge><input type=checkbox aria-label="full size">{image}</label>'
    return f'<figure id="{name}">{enlarge}<figcaption>{markup(figure.caption)}</figcaption></figure>'


def equations_of(equations: Iterable[Equation]) -> str:
    """Equations with their words."""
    return "".join(equation_of(one) + f"<p class=where>{markup(one.words)}</p>" for one in equations)


def equation_of(one: Equation) -> str:
    """One equation and its name."""
    tag = f"<span class=tag>{markup(one.name)}</span>" if one.name else ""
    return f"<div class=equation>{mathml(one.tex)}{tag}</div>"


def kind_of(claim: Claim) -> str:
    """The class of a verdict: holds, holds-if, fails or not."""
    return claim.verdict.split()[0] + ("-if" if claim.verdict.startswith("holds if") else "")


def count_of(n_held: int, n: int) -> str:
    """How many checks held, in words."""
    return f"{n_held} of {n} checks held"


def slug(title: str) -> str:
    """Where a link to a group leads."""
    return "group-" + re.sub(r"\W+", "-", title.lower()).strip("-")
