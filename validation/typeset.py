"""Plain text as HTML: `v_c`, `mu_0`, `Δu_z` and `ωτ_1` as symbols, `omega` as ω, `x^2` and `1e-4` as powers.

The tags i, b, em, code, sub, sup and br pass through; everything else is escaped.
"""

import html
import math
import re

_TAGS = "i|b|em|code|sub|sup|br"
GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "zeta": "ζ", "eta": "η", "theta": "θ", "kappa": "κ",
    "lambda": "λ", "mu": "μ", "nu": "ν", "pi": "π", "rho": "ρ", "sigma": "σ", "tau": "τ", "phi": "φ", "chi": "χ",
    "psi": "ψ", "omega": "ω",
}  # fmt: skip
_NAME = re.compile(rf"(?<![A-Za-z0-9_])({'|'.join(GREEK)})(?![A-Za-z0-9])")
_POWER_OF_TEN = re.compile(r"(?<![\w.])([-−]?\d+(?:\.\d+)?)e([+-]?)0*(\d+)(?!\w|\.\d)")
_RAISED = re.compile(r"\^\{([^}]*)\}|\^\(([^)]*)\)|\^([-−]?\w+(?:\.\w+)?)")
_SYMBOL = re.compile(
    r"(?<![A-Za-z0-9_])(Δ?)([^\W\d_])_(\w(?:[\w,]{0,2}\w)?)(?!\w)"  # Δu_z, k_x,c, E_inf
    r"|([α-ω]+)(?!_\w|m\b)"  # the letters before one with an index; μm is a unit
)


def markup(text: str) -> str:
    """Set plain text as HTML."""
    text = re.sub(rf"&lt;(/?(?:{_TAGS}))&gt;", r"<\1>", html.escape(text, quote=False))
    text = _NAME.sub(lambda name: GREEK[name[1]], text.replace("v_hat", "v̂"))
    text = _RAISED.sub(_raised, _POWER_OF_TEN.sub(_power_of_ten, text))
    text = re.sub(r"(?<![\w>-])-(?=\d)", "−", text)
    return _SYMBOL.sub(_symbol, text)


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
    return markup(f"{value:.{digits}g}")


def _power_of_ten(match: re.Match[str]) -> str:
    power = f"10<sup>{match[2].replace('+', '').replace('-', '−')}{match[3]}</sup>"
    return power if match[1] == "1" else f"{match[1].replace('-', '−')}·{power}"


def _raised(match: re.Match[str]) -> str:
    return f"<sup>{(match[1] or match[2] or match[3]).replace('-', '−')}</sup>"


def _symbol(match: re.Match[str]) -> str:
    if match[4]:
        return f"<i>{match[4]}</i>"
    return f"{match[1]}<i>{match[2]}</i><sub>{match[3].replace('inf', '∞')}</sub>"
