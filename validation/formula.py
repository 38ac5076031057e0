r"""Equations as MathML, which browsers set without script, font or network, from the little of TeX that the page uses.

Letters, digits, operators, Greek letters, functions (\sin, \max), \frac, \sqrt, \dot, \ddot, \hat, \text, \left and
\right, indices and powers.
"""

import html
import re

from validation.typeset import GREEK

_TOKEN = re.compile(r"\s*(\\text\{[^}]*\}|\\[A-Za-z]+|\\.|\d+(?:\.\d+)?|.)\s*", re.DOTALL)
_LETTERS = {
    **GREEK, "varphi": "φ", "varepsilon": "ε", "Delta": "Δ", "Psi": "Ψ", "Phi": "Φ", "infty": "∞", "partial": "∂",
}  # fmt: skip
_OPERATORS = {
    "cdot": "·", "le": "≤", "ge": "≥", "ll": "≪", "gg": "≫", "to": "→", "sum": "∑", "int": "∫", "mp": "∓", "pm": "±",
    "langle": "⟨", "rangle": "⟩", "approx": "≈", "ldots": "…",
}  # fmt: skip
_FUNCTIONS = ("sin", "cos", "arcsin", "ln")
_OVER = {"dot": "˙", "ddot": "¨", "hat": "^"}


def mathml(tex: str, block: bool = True) -> str:
    """One equation as a <math> element; ValueError for what is not understood."""
    tokens = [*(found[1] for found in _TOKEN.finditer(tex.strip())), ""][::-1]  # the next one is the last
    try:
        body = _row(tokens, end="")
    except IndexError:  # an argument or a fence was looked for past the end
        raise ValueError(f"{tex}: its end is missing") from None
    except ValueError as fault:
        raise ValueError(f"{tex}: {fault}") from None
    return f'<math display="{"block" if block else "inline"}" aria-label="{html.escape(tex)}">{body}</math>'


def _row(tokens: list[str], end: str) -> str:
    """Everything up to a token, which is taken too."""
    parts = []
    while tokens[-1] != end:
        if not tokens[-1]:
            raise ValueError(f"{end} is missing")
        parts.append(_scripted(tokens))
    tokens.pop()
    return f"<mrow>{''.join(parts)}</mrow>"


def _scripted(tokens: list[str]) -> str:
    """One thing with its index and power."""
    wide = tokens[-1] in (r"\sum", r"\max", r"\min")
    base, marks = _one(tokens), {}
    while tokens[-1] in ("_", "^"):
        mark = tokens.pop()
        marks[mark] = _one(tokens)
    kind = {"_": "sub", "^": "sup", "_^": "subsup"}.get("".join(sorted(marks, key="_^".index)), "")
    if wide:
        kind = {"sub": "under", "sup": "over", "subsup": "underover"}.get(kind, "")
    return f"<m{kind}>{base}{''.join(marks[one] for one in '_^' if one in marks)}</m{kind}>" if kind else base


def _one(tokens: list[str]) -> str:
    """A letter, number, operator, group, fraction, root or fence."""
    token = tokens.pop()
    name = token[1:]
    if token == "{":
        return _row(tokens, "}")
    if token == r"\frac":
        return f"<mfrac>{_one(tokens)}{_one(tokens)}</mfrac>"
    if token == r"\sqrt":
        return f"<msqrt>{_one(tokens)}</msqrt>"
    if token == r"\left":
        fence, inner = tokens.pop(), _row(tokens, r"\right")
        return f"<mrow><mo>{_sign(fence)}</mo>{inner}<mo>{_sign(tokens.pop())}</mo></mrow>"
    if token.startswith(r"\text"):
        return f"<mtext>{html.escape(token[6:-1])}</mtext>"
    if token in (r"\,", r"\quad"):
        width = "0.17em" if token == r"\," else "1.5em"
        return f'<mspace width="{width}"></mspace>'
    if token.startswith("\\") and name in _OVER:
        return f"<mover>{_one(tokens)}<mo>{_OVER[name]}</mo></mover>"
    return _symbol(token)


def _symbol(token: str) -> str:
    name = token[1:]
    if token.startswith("\\"):
        if name in ("max", "min"):
            return f"<mo>{name}</mo>"
        if name in _FUNCTIONS:
            return f'<mi>{name}</mi><mspace width="0.17em"></mspace>'
        if name in _LETTERS:
            return f"<mi>{_LETTERS[name]}</mi>"
        if name in _OPERATORS:
            return f"<mo>{_OPERATORS[name]}</mo>"
        raise ValueError(f"{token} is not understood")
    if token[:1].isdigit():
        return f"<mn>{token}</mn>"
    if token.isalpha():
        return f"<mi>{token}</mi>"
    return f'<mo stretchy="false">{_sign(token)}</mo>'


def _sign(token: str) -> str:
    known = {"-": "−", "'": "′", "*": "*", r"\langle": "⟨", r"\rangle": "⟩"}
    return known.get(token) or html.escape(token)
