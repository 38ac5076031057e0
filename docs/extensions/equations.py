"""Equations as MathML, which browsers set themselves: no script, no fonts, no network."""

import re
from typing import Any

from docutils.nodes import SkipNode
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError

TAG = re.compile(r"\\tag\{([^}]*)\}")  #: number of an equation

BAR = re.compile(r"(?<!\\left)(?<!\\right)(?:\\[lr]vert\b|(?<!\\)[|])")  #: of an absolute value
#: what is amiss in its answer: a space before an argument, none beside a slash, an index beside a dotted letter
REPAIRS = (
    (re.compile(r"(<mo>&ApplyFunction;</mo>|<mi>Re</mi>)(?!\s*<mo[^>]*>[(|])"), r'\1<mspace width="0.17em"></mspace>'),
    (re.compile(r'<mo stretchy="false">/</mo>'), '<mo lspace="0" rspace="0" stretchy="false">/</mo>'),
    (
        re.compile(r"<munderover>\s*(<mi>.</mi>)\s*(<m[in]>.</m[in]>)\s*(<mo[^>]*>[˙¨^]</mo>)\s*</munderover>"),
        r"<msub><mover>\1\3</mover>\2</msub>",
    ),
)


def mathml(tex: str, display: bool) -> str:
    """One formula of LaTeX as a <math> element."""
    bars = [bar.start() for bar in BAR.finditer(tex)]
    if len(bars) % 2 == 0:  # bars as high as what they enclose, and both alike
        opened = iter((r"\left\lvert ", r"\right\rvert ") * (len(bars) // 2))
        tex = BAR.sub(lambda bar: next(opened), tex)
    try:
        element = tex2mathml(tex, as_block=display)
    except MathError as fault:
        raise ExtensionError(f"{tex}: {fault}") from None
    for wrong, right in REPAIRS:
        element = wrong.sub(right, element)
    return str(element)


def inline(writer: Any, node: Any) -> None:
    """Within a line of text."""
    writer.body.append(mathml(node.astext(), display=False))


def displayed(writer: Any, node: Any) -> None:
    """On a line of its own, which scrolls where the screen is narrower."""
    tex = node.astext()
    number = "".join(f'<span class="number">({found})</span>' for found in TAG.findall(tex))
    body = mathml(TAG.sub("", tex), display=True)
    writer.body.append(f'<div class="equation" tabindex="0">{body}{number}</div>\n')


def setup(app: Sphinx) -> dict[str, bool]:
    """Offer the renderer that conf.py names."""

    def last(visit: Any) -> Any:
        def visited(writer: Any, node: Any) -> None:
            visit(writer, node)
            raise SkipNode

        return visited

    app.add_html_math_renderer("mathml", (last(inline), None), (last(displayed), None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
