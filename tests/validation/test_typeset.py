"""How the page sets text, numbers and equations, and the words in which a claim says what it ran."""

import ast
import math
import re
from pathlib import Path

import pytest

from validation.formula import mathml
from validation.page.paper import PAPER, SYMBOLS
from validation.typeset import markup, number
from validation.words import counted, listed, ranged, span


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("v_c < 1", "<i>v</i><sub>c</sub> &lt; 1"),
        ("mu_0 Δu_z/u_z0", "<i>μ</i><sub>0</sub> Δ<i>u</i><sub>z</sub>/<i>u</i><sub>z0</sub>"),
        ("k_x,c, rigid_pull, at_most", "<i>k</i><sub>x,c</sub>, rigid_pull, at_most"),
        ("T = ωτ in 5 μm", "T = <i>ωτ</i> in 5 μm"),
        ("α^2 10^-5 x^{1/2}", "<i>α</i><sup>2</sup> 10<sup>−5</sup> x<sup>1/2</sup>"),
        ("1.3e+03 2e-04. a1e5", "1.3·10<sup>3</sup> 2·10<sup>−4</sup>. a1e5"),
        ("omega tau_j, ωτ_1", "<i>ω</i> <i>τ</i><sub>j</sub>, <i>ω</i><i>τ</i><sub>1</sub>"),
        ("v^(-1/2), E_inf", "v<sup>−1/2</sup>, <i>E</i><sub>∞</sub>"),
    ],
)
def test_markup(text, expected):
    assert markup(text) == expected


@pytest.mark.parametrize(
    ("value", "tolerance", "expected"),
    [
        (0.0, 1e-9, "0"),
        (-0.123456789, 1e-4, "−0.123457"),
        (2.5e-5, 0.0, "2.5·10<sup>−5</sup>"),
        (3.2e12, 0.0, "3.2·10<sup>12</sup>"),
        (None, 0.0, "none"),
        (math.nan, 0.0, "not a number"),
        (-math.inf, 0.0, "−∞"),
    ],
)
def test_number(value, tolerance, expected):
    assert number(value, tolerance) == expected


@pytest.mark.parametrize(
    ("values", "expected"), [((100.0, 100.0), "= 100"), ((1, 3, 2), "from 1 to 3"), ((0.3001, 0.3), "= 0.3")]
)
def test_a_range_of_one_value_is_no_range(values, expected):
    assert ranged(values) == expected
    assert span(values) == expected.removeprefix("= ").removeprefix("from ")


def test_counts_and_enumerations():
    assert [counted(n, "velocity") for n in (0, 1, 2, 12)] == [
        "no velocities", "one velocity", "two velocities", "12 velocities"
    ]  # fmt: skip
    assert counted(3, "shape") == "three shapes"
    assert [listed(some) for some in ((0.3,), (0.3, 1), ("a", "b", "c"))] == ["0.3", "0.3 and 1", "a, b and c"]


@pytest.mark.parametrize(
    ("tex", "expected"),
    [
        (r"k_{x,c}^2", '<msubsup><mi>k</mi><mrow><mi>x</mi><mo stretchy="false">,</mo><mi>c</mi></mrow><mn>2</mn>'),
        (r"\dot{u}_z", "<msub><mover><mrow><mi>u</mi></mrow><mo>˙</mo></mover><mi>z</mi></msub>"),
        (r"\max_t v", "<munder><mo>max</mo><mi>t</mi></munder><mi>v</mi>"),
        (r"\left| \beta \right|", "<mo>|</mo><mrow><mi>β</mi></mrow><mo>|</mo>"),
        (r"a < 0.3", '<mi>a</mi><mo stretchy="false">&lt;</mo><mn>0.3</mn>'),
    ],
)
def test_formulas(tex, expected):
    assert expected in mathml(tex)


@pytest.mark.parametrize("tex", [r"\nonsense", "{a", r"\left( a", r"\left( a \right", r"\frac{a}", "x^"])
def test_a_formula_that_is_not_understood_is_refused(tex):
    with pytest.raises(ValueError, match=r"not understood|missing"):
        mathml(tex)


def test_equations_and_symbols_can_be_set():
    for one in PAPER:
        assert mathml(one.tex).count("<math") == 1
    for tex, (meaning, _) in SYMBOLS.items():
        assert mathml(tex, block=False)
        assert meaning
    numbers = [int(n) for one in PAPER for n in re.findall(r"\((\d+)\)", one.name)]
    assert numbers == list(range(1, 16))


def test_every_equation_of_a_claim_is_set():
    """Read off the sources, as a claim takes seconds to run."""
    found = 0
    for path in (Path(__file__).parents[2] / "validation").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Equation" and len(node.args) > 1:
                found += mathml(ast.literal_eval(node.args[1])).count("<math")
    assert found > 20
