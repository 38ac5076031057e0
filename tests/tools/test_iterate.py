"""The loop of methods that come nearer step by step: it ends by itself, after so many steps, or with the time."""

import pytest

from mdr.tools.iterate import iterate
from mdr.tools.progress import time_limit


def half(x):
    return 0.5 * x


@pytest.mark.parametrize(("most", "end"), [(None, 0.5), (1, 4.0), (0, 8.0), (9, 0.5)])
def test_it_ends_where_the_method_has_or_after_so_many_steps(most, end):
    assert iterate(half, lambda x: x < 1, 8.0, most) == end


def test_what_has_ended_takes_no_step():
    assert iterate(lambda _: pytest.fail("a step"), lambda _: True, 8.0) == 8.0


def test_it_ends_with_the_time_of_the_caller():
    with time_limit(1e-9):
        assert iterate(half, lambda _: False, 8.0) == 8.0
