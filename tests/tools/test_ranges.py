"""Ranges: evenly by differences, or by factors where they are wide."""

import pytest

from mdr.tools.ranges import Range


@pytest.mark.parametrize(
    ("low", "high", "middle"),
    [(1.0, 3.0, 2.0), (1.0, 100.0, 10.0), (1e-300, 1e300, 1.0), (-1.0, 9.0, 4.0), (0, 9, 4.5)],
)
def test_the_middle_of_a_range(low, high, middle):
    along = Range(low, high)
    assert along.value(0.5) == pytest.approx(middle)
    assert (along.value(0.0), along.value(1.0)) == pytest.approx((low, high))
    assert along.coordinate(middle) == pytest.approx(0.5)


def test_a_value_outside_stands_at_the_nearer_end():
    assert (Range(1.0, 2.0).coordinate(0.5), Range(1.0, 100.0).coordinate(1e3)) == (0.0, 1.0)
