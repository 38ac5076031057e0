"""The report as one page that needs no other file: the answer, symbols and equations, then every claim, in groups.

What is the same in every report is in page.html, page.css and page.js.
"""

from collections.abc import Sequence
from pathlib import Path

from mdr.tools.atomic_write import write_whole
from validation import CLAIMS, GROUPS
from validation.formula import mathml
from validation.page.answer import answers
from validation.page.claims import count_of, equation_of, equations_of, figure_of, group_of, kind_of, slug
from validation.page.made import Made
from validation.page.paper import EQ_15, PAPER, SYMBOLS
from validation.report import Claim, write_record
from validation.typeset import markup
from validation.words import counted

AS_IT_IS = Made()
Groups = list[tuple[str, str, list[Claim]]]  #: title, what the group is about, and its claims


def write_report(claims: Sequence[Claim], folder: str | Path, effort: str = "full", made: Made = AS_IT_IS) -> Path:
    """Write index.html, checks.json and the figures into `folder`; return the page."""
    write_record(claims, folder)
    page = Path(folder) / "index.html"
    write_whole(page, html_page(claims, effort, made).encode("utf-8"))
    return page


def html_page(claims: Sequence[Claim], effort: str = "full", made: Made = AS_IT_IS) -> str:
    """Give the whole report; a tap on a figure enlarges it or undoes that, a link opens the section it leads to."""
    glance = [(claim, figure) for claim in claims for figure in claim.figures if figure.name == "glance"][:1]
    groups = _groups(claims)
    return _own("page.html").format(
        title="Does Eq. (15) hold for general contacts?",
        mark="QUICK " if effort == "quick" else "",
        css=_own("page.css"),
        js=_own("page.js"),
        sections=_sections(groups),
        marks=_marks(claims, effort, made),
        eq_15=equation_of(EQ_15),
        answers=_answers(answers(claims), claims),
        glance="\n".join(figure_of(claim, figure) for claim, figure in glance),
        count=count_of(sum(claim.n_held for claim in claims), sum(len(claim.checks) for claim in claims)),
        n_claims=counted(len(claims), "claim"),
        symbols="".join(_symbol(*one) for one in SYMBOLS.items()),
        equations=equations_of(PAPER),
        groups="\n".join(group_of(*group, above=[figure for _, figure in glance]) for group in groups),
        foot=made.foot(claims, effort),
    )


def _own(name: str) -> str:
    return Path(__file__).with_name(name).read_text(encoding="utf-8")


def _groups(claims: Sequence[Claim]) -> Groups:
    """The groups that have claims; those of no group come last."""
    known = [
        (title, told, [claim for claim in claims if claim.name in names]) for title, (told, names) in GROUPS.items()
    ]
    others = ("Other claims", "", [claim for claim in claims if claim.name not in CLAIMS])
    return [group for group in (*known, others) if group[2]]


def _sections(groups: Groups) -> str:
    """The part of the list of sections, which stays in sight, that tells the claims."""
    items = []
    for title, _, claims in groups:
        names = [f'<li><a href="#{c.name}" class={kind_of(c)}>{c.name.replace("_", " ")}</a></li>' for c in claims]
        items.append(f'<li><a href="#{slug(title)}">{title}</a><ul>{"".join(names)}</ul></li>')
    return "".join(items)


def _marks(claims: Sequence[Claim], effort: str, made: Made) -> str:
    """What sets this run apart from the full report."""
    marks = []
    if left := made.missing(claims):
        marks.append(
            f"<b>STOPPED</b> {len(claims)} of {len(claims) + left} claims are done, or it is still at work. The same"
            f" command, into the same folder, goes on from there: <code>{made.command(claims, effort)}</code>."
        )
    if effort == "quick":
        marks.append(
            "<b>QUICK</b> A run on small grids, which tells whether the program is in order. Its sentences and figures"
            " are about the few points that it computed; the full report is <code>python -m validation</code>."
        )
    asked = {*made.asked, *(claim.name for claim in claims)} & set(CLAIMS)
    if asked and len(asked) < len(CLAIMS):
        missing = len(CLAIMS) - len(asked)
        marks.append(f"<b>PART</b> {missing} of the {len(CLAIMS)} claims were not asked for in this run.")
    return "".join(f"<p class=mark>{mark}</p>" for mark in marks)


def _answers(sentences: Sequence[str], claims: Sequence[Claim]) -> str:
    if not sentences:
        links = (f'<a href="#{one.name}">{markup(one.title)}</a>: {markup(one.sentence)}' for one in claims)
        said = "".join(f"<li>{link}</li>" for link in links)
        others = "The claims that answer this are not among those below, which say:"
        return f"<p>{others}</p><ul class=answers>{said}</ul>"
    items = "".join(f"<li>{markup(text)}</li>" for text in sentences)
    springs = "Arrays of springs, each of which sticks, slips and leaves contact on its own, answer:"
    return f"<p>{springs}</p><ol class=answers>{items}</ol>"


def _symbol(tex: str, told: Sequence[str]) -> str:
    meaning, unit = told
    of = f" <span class=unit>[{markup(unit)}]</span>" if unit else ""
    return f"<div><dt>{mathml(tex, block=False)}</dt><dd>{markup(meaning)}{of}</dd></div>"
