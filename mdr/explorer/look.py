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
#: wide: controls, curve, springs side by side; narrow: one below the other, and the curve stays in sight
LAYOUT = """
:host { display: grid !important; gap: 8px 28px; align-items: start;
        grid-template-columns: 350px minmax(0, 1fr) minmax(0, 1fr); grid-template-rows: auto auto 1fr;
        grid-template-areas: "controls curve springs" "controls numbers springs" "controls files files"; }
@media (max-width: 1150px) { :host {
        grid-template-columns: 330px minmax(0, 1fr); grid-template-rows: auto auto auto 1fr;
        grid-template-areas: "controls curve" "controls numbers" "controls springs" "controls files"; } }
@media (max-width: 720px) { :host {
        grid-template-columns: minmax(0, 1fr); grid-template-rows: auto;
        grid-template-areas: "curve" "controls" "numbers" "springs" "files"; } }
"""
IN_SIGHT = """
@media (max-width: 720px) { :host { position: sticky !important; top: 0; z-index: 5; background: white; } }
"""
PAGE = ":host { max-width: 1560px; margin: 0 auto !important; padding: 0 14px; box-sizing: border-box; }"


def area(name: str, *parts: Any) -> Any:
    """Parts one below the other, in an area of the layout."""
    sheets = [IN_SIGHT if name == "curve" else ""]
    return pn.Column(*parts, styles={"grid-area": name}, stylesheets=sheets, **WIDE)


def html(text: str = "", style: str = "") -> Any:
    """A line of HTML."""
    text = f'<span style="{style}">{text}</span>' if style else text
    return pn.pane.HTML(text, margin=(2, 5), **WIDE)


def heading(text: str, style: str = "") -> Any:
    """The heading of an area, or of a part of it."""
    return html(text, HEADING + style)


def label(name: str, facts: Facts) -> Any:
    """Name, unit and meaning of a quantity."""
    symbols = dict.fromkeys((facts.unit, SHOWN.get(facts.unit, facts.unit)))
    unit = f" [{escape(' or '.join(symbols))}]" if facts.unit not in ("", "-") else ""
    text = f'<b>{escape(name)}</b>{unit}<br><span style="color:#666">{escape(facts.meaning)}</span>'
    return pn.pane.HTML(text, styles={"font-size": "12.5px", "line-height": "1.3"}, margin=(0, 5), **WIDE)


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
