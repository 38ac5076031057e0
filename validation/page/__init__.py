"""The report as one page that needs no other file: the answer, symbols and equations, then every claim, in groups."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from validation import CLAIMS, GROUPS
from validation.formula import mathml
from validation.page.answer import answers
from validation.page.claims import count_of, equation_of, equations_of, figure_of, group_of, kind_of, slug
from validation.page.paper import EQ_15, PAPER
from validation.page.symbols import SYMBOLS
from validation.report import Claim, write_record
from validation.typeset import markup

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
            _answers(answers(claims)),
            *(figure_of(claim, figure) for claim, figure in glance),
            f"<p class=count>{count_of(n_held, n_checks)}, of {len(claims)} claims. A claim opens with a tap.</p>",
            "</header>",
            _symbols(),
            _fold("equations", "Equations of the paper, and full slip", equations_of(PAPER)),
            *(group_of(title, told, here, above) for title, told, here in groups),
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
        inner = "".join(
            f'<li><a href="#{c.name}" class={kind_of(c)}>{c.name.replace("_", " ")}</a></li>' for c in claims
        )
        items.append(f'<li><a href="#{slug(title)}">{title}</a><ul>{inner}</ul></li>')
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
        f" Mechanical Engineering</i> 14 (2016) 335) derives</p>{equation_of(EQ_15)}<p>and argues that it is valid"
        f" “{_QUOTE}”.</p>"
    )


def _answers(sentences: Sequence[str]) -> str:
    if not sentences:
        return ""
    items = "".join(f"<li>{markup(text)}</li>" for text in sentences)
    springs = "Arrays of springs, each of which sticks, slips and leaves contact on its own, answer:"
    return f"<p>{springs}</p><ol class=answers>{items}</ol>"


def _symbols() -> str:
    rows = []
    for tex, meaning, unit in SYMBOLS:
        of = f" <span class=unit>[{markup(unit)}]</span>" if unit else ""
        rows.append(f"<div><dt>{mathml(tex, block=False)}</dt><dd>{markup(meaning)}{of}</dd></div>")
    return _fold("symbols", "Symbols", f"<dl class=symbols>{''.join(rows)}</dl>")


def _fold(name: str, title: str, body: str) -> str:
    return f"<section><details id={name} class=fold><summary><h2>{title}</h2></summary>{body}</details></section>"
