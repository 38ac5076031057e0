"""How the page looks: its layout, wide and narrow, and small pieces of HTML."""

from __future__ import annotations

from html import escape
from typing import Any

import panel as pn

from mdr.tools.fields import Facts
from mdr.tools.notation import SHOWN

REFUSALS = (ValueError, TypeError, ArithmeticError, LookupError)  #: what a wrong number or file raises
WIDE: dict[str, Any] = {"sizing_mode": "stretch_width"}
HEADING = "font-weight:600;font-size:15px;"
SMALL = "color:#666;font-size:12.5px;"
REFUSED = "color:#a32020;background:#fdecea;border-radius:4px;padding:4px 8px;font-size:12px;line-height:1.35;"
DOUBTED = "color:#6b4e00;background:#fff6dc;border-radius:4px;padding:4px 8px;font-size:12px;line-height:1.35;"
CELL = "padding-right:14px;white-space:nowrap;vertical-align:top"
#: wide: controls, curve, springs side by side, and controls scroll by themselves; narrow: pictures side by side, which
#: stay in sight above the controls
LAYOUT = """
:host { display: grid !important; gap: 8px 28px; align-items: start;
        grid-template-columns: 350px minmax(0, 1fr) minmax(0, 1fr); grid-template-rows: auto 1fr auto;
        grid-template-areas: "controls curve springs" "controls numbers springs" "controls files files"; }
@media (max-width: 1150px) { :host {
        grid-template-columns: 330px minmax(0, 1fr); grid-template-rows: auto auto auto 1fr;
        grid-template-areas: "controls curve" "controls numbers" "controls springs" "controls files"; } }
@media (max-width: 720px) { :host {
        grid-template-columns: minmax(0, 1fr); grid-template-rows: auto;
        grid-template-areas: "pictures" "controls" "numbers" "files"; } }
"""
PICTURES = """
:host { display: contents !important; }
@media (max-width: 720px) { :host {
        display: flex !important; flex-flow: row !important; grid-area: pictures; position: sticky !important; top: 0;
        z-index: 5; background: white; overflow: auto hidden; scroll-snap-type: x mandatory;
        border-bottom: 1px solid #ddd; } }
"""
AREAS = {
    "controls": """
@media (min-width: 721px) { :host {
        position: sticky !important; top: 0; max-height: 100vh; overflow: hidden auto !important; } }
""",
    "picture": """
@media (max-width: 720px) { :host {
        flex: 0 0 100% !important; scroll-snap-align: start; max-height: min(52vh, 430px);
        overflow: hidden auto !important; } }
""",
}
IN_SIGHT = """
@media (min-width: 721px) and (max-width: 1150px) { :host {
        position: sticky !important; top: 0; z-index: 4; background: white; } }
"""
ASIDE = """
<style>@media (min-width: 721px) { .aside { display: none; } }</style>
<span class="aside" style="float:right;font-weight:400;font-size:13px;color:#666">swipe: the springs →</span>
"""  #: in the heading of the first picture, where the second one stands beside it out of sight
STALE = {"opacity": "0.4", "transition": "opacity 0.2s 0.4s"}  #: of a picture of other values, if it stays for long
FRESH = {"opacity": "1", "transition": "opacity 0.2s"}
LISTED = """
label { white-space: pre-line; font-size: 12.5px; line-height: 1.3; color: #666; margin: 0; }
label::first-line { font-weight: 600; color: #000; }
"""
BOX = f"""{LISTED}
.bk-input-group {{ display: grid; grid-template-columns: minmax(0, 1fr) 116px; align-items: center; gap: 10px; }}
"""
WRAPPED = "label { white-space: normal; }"  #: of a long name, which would make a narrow page wider
KIND = "label { font-weight: 600; font-size: 15px; margin: 10px 0 3px; white-space: normal; }"
PAGE = ":host { max-width: 1560px; margin: 0 auto !important; padding: 0 14px; box-sizing: border-box; }"


def column(*parts: Any, **options: Any) -> Any:
    """Parts one below the other."""
    return pn.Column(*parts, **WIDE, **options)


def area(name: str, *parts: Any) -> Any:
    """Parts one below the other, in an area of the layout."""
    sheet = AREAS.get("picture" if name in ("curve", "springs") else name, "")
    return column(*parts, styles={"grid-area": name}, stylesheets=[sheet, IN_SIGHT if name == "curve" else ""])


def html(text: str = "", style: str = "") -> Any:
    """A line of HTML."""
    text = f'<span style="{style}">{text}</span>' if style else text
    return pn.pane.HTML(text, margin=(2, 5), **WIDE)


def heading(text: str) -> Any:
    """The heading of an area, or of a part of it."""
    return html(text, HEADING)


def label(name: str, facts: Facts) -> str:
    """Name, unit and meaning of a quantity, in two lines."""
    symbols = dict.fromkeys((facts.unit, SHOWN.get(facts.unit, facts.unit)))
    unit = f" [{' or '.join(symbols)}]" if facts.unit not in ("", "-") else ""
    return f"{name}{unit}\n{facts.meaning}"


def refused(words: str) -> str:
    """What was refused and why, as HTML; empty where nothing was."""
    lines = escape(words).replace("\n", "<br>")
    return f'<div style="{REFUSED}" class="refused">{lines}</div>' if words else ""


def doubted(words: str) -> str:
    """What is unlikely, as HTML."""
    return f'<div style="{DOUBTED}margin-top:4px" class="doubted">{escape(words)}</div>'


def words_of(refusal: Exception) -> str:
    """The words of a refusal."""
    return str(refusal) or type(refusal).__name__


def table(rows: list[tuple[str, str, str]]) -> str:
    """Name, value and meaning, one row each."""
    styles = (CELL, CELL + ";font-weight:600", "color:#666")
    cells = [[f'<td style="{style}">{one}</td>' for style, one in zip(styles, row, strict=True)] for row in rows]
    lines = "".join(f"<tr>{''.join(row)}</tr>" for row in cells)
    return f'<table style="font-size:13px;line-height:1.5">{lines}</table>'
