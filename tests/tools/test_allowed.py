"""How far a range goes: to its end, or to the last value that is not refused."""

import math

import pytest

from mdr.tools.allowed import last_allowed, refusal_of


def below_three(value):
    if value > 3:
        raise ValueError("too much")


def test_a_refusal_is_told_in_its_words():
    assert refusal_of(below_three, 4) == "too much"
    assert refusal_of(lambda: 1 / 0) == "division by zero"
    assert refusal_of(math.sqrt, "a").startswith("must be real")
    assert refusal_of(below_three, 3) == ""


@pytest.mark.parametrize(
    ("start", "end", "last"), [(1.0, 2.0, 2.0), (1.0, 30.0, 3.0), (-5.0, 1e9, 3.0), (0.0, 4.0, 3.0)]
)
def test_a_range_ends_at_the_last_value_that_is_allowed(start, end, last):
    found = last_allowed(below_three, start, end, 1e-9)
    below_three(found)
    assert found == pytest.approx(last, rel=2e-9)
