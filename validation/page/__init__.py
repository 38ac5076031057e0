"""The report as one page that needs no other file: the answer, symbols and equations, then every claim, in groups."""

import base64
import html
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from validation import CLAIMS, GROUPS
from validation.formula import mathml
from validation.page.answer import answers
from validation.page.paper import EQ_15, PAPER
from validation.page.symbols import SYMBOLS
from validation.report import Check, Claim, Equation, Figure, Part, write_record
from validation.typeset import markup, number, plain

_OTHERS = "Other claims"
_TITLE = "Does Eq. (15) hold for general contacts?"
_QUOTE = "for quite general contacts (so long as the amplitude of oscillation remains small)"


def write_report(claims: Sequence[Claim], folder: str | Path, effort: str = "full") -> Path:
    """Write index.html, checks.json and the figures into `folder`; return the page."""
    write_record(claims, folder)
    page = Path(folder) / "index.html"
    page.write_text(html_page(claims, effort), encoding="utf-8")
    return page


def html_page(claims: Sequence[Claim], effort: str = "full") -> str:
    """Give the whole report; a tap on a figure enlarges it or undoes that, a link opens the section it leads to."""
    from mdr.tools.provenance import versions

    glance = [(claim, figure) for claim in claims for figure in claim.figures if figure.name == "glance"][:1]
    above = [figure for _, figure in glance]
    groups = [(title, told, here) for title, told, here in _groups(claims) if here]
    command = "python -m validation" + ("" if effort == "full" else f" --{effort}")
    n_checks, n_held = sum(len(c.checks) for c in claims), sum(c.n_held for c in claims)
    return "\n".join(
        (
            _head("QUICK " if effort == "quick" else ""),
            _navigation(groups),
            f"<main><header id=answer><h1>{_TITLE}</h1>{_marks(claims, effort)}",
            _question(),
            f"<ol class=answers>{''.join(f'<li>{markup(text)}</li>' for text in answers(claims))}</ol>",
            *(_figure(claim, figure) for claim, figure in glance),
            f"<p class=count>{_count(n_held, n_checks)}, of {len(claims)} claims. A claim opens with a tap.</p>",
            "</header>",
            _symbols(),
            _fold("equations", "Equations of the paper, and full slip", _equations(PAPER)),
            *(_group(title, told, here, above) for title, told, here in groups),
            f"<footer><p>Made by <code>{command}</code> with {versions()}.</p></footer></main>",
            f"<script>{_own('page.js')}</script></body></html>\n",
        )
    )


def _groups(claims: Sequence[Claim]) -> Iterator[tuple[str, str, list[Claim]]]:
    """Title, what the group is about, and its claims; those of no group come last."""
    for title, (told, names) in GROUPS.items():
        yield title, told, [claim for claim in claims if claim.name in names]
    yield _OTHERS, "", [claim for claim in claims if claim.name not in CLAIMS]


def _head(mark: str) -> str:
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{mark}{_TITLE}</title>\n<style>{_own('page.css')}</style></head><body>"
    )


def _own(name: str) -> str:
    return Path(__file__).with_name(name).read_text(encoding="utf-8")


def _navigation(groups: Sequence[tuple[str, str, list[Claim]]]) -> str:
    """The list of sections that stays in sight."""
    items = ['<li><a href="#answer">Answer</a></li>', '<li><a href="#symbols">Symbols</a></li>']
    items.append('<li><a href="#equations">Equations</a></li>')
    for title, _, claims in groups:
        inner = "".join(f'<li><a href="#{c.name}" class={_kind(c)}>{c.name.replace("_", " ")}</a></li>' for c in claims)
        items.append(f'<li><a href="#{_slug(title)}">{title}</a><ul>{inner}</ul></li>')
    return f'<nav aria-label="Sections"><ul>{"".join(items)}</ul></nav>'


def _marks(claims: Sequence[Claim], effort: str) -> str:
    """What sets this run apart from the full report."""
    marks = []
    if effort == "quick":
        marks.append(
            "<b>QUICK</b> A run on small grids, which tells whether the program is in order. Its sentences and figures"
            " are about the few points that it computed; the full report is <code>python -m validation</code>."
        )
    asked = {claim.name for claim in claims}
    missing = [name for name in CLAIMS if name not in asked]
    if missing and asked & set(CLAIMS):
        marks.append(f"<b>PART</b> {len(missing)} of the {len(CLAIMS)} claims were not asked for in this run.")
    return "".join(f"<p class=mark>{mark}</p>" for mark in marks)


def _question() -> str:
    return (
        "<p>Above the <b>critical velocity</b> <i>v</i><sub>c</sub> an oscillation in the normal direction no longer"
        " lowers sliding friction. For one spring and damper in contact M. Popov (<i>Facta Universitatis, Series"
        f" Mechanical Engineering</i> 14 (2016) 335) derives</p>{_equation(EQ_15)}<p>and argues that it is valid"
        f" “{_QUOTE}”. Arrays of springs, each of which sticks, slips and leaves contact on its own, answer:</p>"
    )


def _symbols() -> str:
    rows = []
    for tex, meaning, unit in SYMBOLS:
        of = f" <span class=unit>[{markup(unit)}]</span>" if unit else ""
        rows.append(f"<div><dt>{mathml(tex, block=False)}</dt><dd>{markup(meaning)}{of}</dd></div>")
    return _fold("symbols", "Symbols", f"<dl class=symbols>{''.join(rows)}</dl>")


def _fold(name: str, title: str, body: str) -> str:
    return f"<section><details id={name} class=fold><summary><h2>{title}</h2></summary>{body}</details></section>"


def _equations(equations: Iterable[Equation]) -> str:
    return "".join(_equation(one) + f"<p class=where>{markup(one.words)}</p>" for one in equations)


def _equation(one: Equation) -> str:
    tag = f"<span class=tag>{markup(one.name)}</span>" if one.name else ""
    return f"<div class=equation>{mathml(one.tex)}{tag}</div>"


def _group(title: str, told: str, claims: Sequence[Claim], above: Sequence[Figure]) -> str:
    text = f"<p>{markup(told)}</p>" if told else ""
    body = "\n".join(_section(claim, above) for claim in claims)
    return f'<section id="{_slug(title)}" class=group><h2>{title}</h2>{text}\n{body}</section>'


def _section(claim: Claim, above: Sequence[Figure]) -> str:
    """One claim, folded to a line; what was found, quote, range, equations; then figures and checks, or its parts."""
    held = "yes" if claim.held else "no"
    line = (
        f"<summary><h3>{markup(claim.title)}</h3><span class=verdict><span class={_kind(claim)}>"
        f"{markup(claim.verdict)}</span></span> <span class={held}>{claim.n_held}/{len(claim.checks)}</span></summary>"
    )
    moved = len(_shown(claim, above)) < len(claim.figures)
    link = ' <a href="#glance">Its main figure opens this page.</a>' if moved else ""
    return "\n".join(
        (
            f'<details class=claim id="{claim.name}"{"" if claim.held else " open"}>{line}',
            f"<p class=sentence>{markup(claim.sentence)}{link}</p>",
            *_words(claim),
            *(_part(claim, part, above) for part in claim.parts),
            *(() if claim.parts else _evidence(claim, claim, above)),
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
        yield _equations(told.equations)


def _evidence(claim: Claim, told: Claim | Part, above: Sequence[Figure]) -> Iterator[str]:
    """Figures that do not stand above, and the table of checks, open where one was missed."""
    n_held = sum(check.held for check in told.checks)
    yield from (_figure(claim, figure) for figure in _shown(told, above))
    opened = "" if n_held == len(told.checks) else " open"
    yield f"<details{opened}><summary>{_count(n_held, len(told.checks))}</summary>"
    yield _table("checks", ("Check", "Got", "Expected", "Tolerance", "Held", "Why"), told.checks, _check_row)
    yield "</details>"


def _shown(told: Claim | Part, above: Sequence[Figure]) -> tuple[Figure, ...]:
    return tuple(figure for figure in told.figures if all(figure is not other for other in above))


def _check_row(check: Check) -> tuple[str, ...]:
    sign = {"within": "", "at most": "≤ ", "at least": "≥ "}[check.side]
    numbers = (check.got, check.expected, check.tolerance)
    got, expected, tolerance = (number(value, check.tolerance) for value in numbers)
    held = "<span class=yes>✓</span>" if check.held else "<span class=no>✗</span>"
    return markup(check.name), got, sign + expected, "–" if sign else tolerance, held, markup(check.why)


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


def _kind(claim: Claim) -> str:
    """The class of a verdict: holds, holds-if, fails or not."""
    return claim.verdict.split()[0] + ("-if" if claim.verdict.startswith("holds if") else "")


def _count(n_held: int, n: int) -> str:
    return f"{n_held} of {n} checks held"


def _slug(title: str) -> str:
    return "group-" + re.sub(r"\W+", "-", title.lower()).strip("-")
