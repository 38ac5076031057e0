"""The equations of the paper and the symbols of the report, as `paper.toml` has them."""

import tomllib
from pathlib import Path

from validation.report import Equation

_TEXT = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))

PAPER = tuple(Equation(*(" ".join(one[key].split("\n")) for key in Equation._fields)) for one in _TEXT["equation"])
EQ_15 = next(one for one in PAPER if one.name == "(15)")
SYMBOLS = _TEXT["symbols"]  #: TeX -> meaning, unit
