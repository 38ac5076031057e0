"""What `python -m validation.performance` says of memory, and that it can time a checkout beside another."""

from pathlib import Path

from validation.cases import contact
from validation.performance import __main__ as performance
from validation.performance.waits import alternately

HERE = Path(__file__).parents[3]


def test_memory_does_not_grow_with_the_periods():
    rows = performance.memory("elastic", contact("paraboloid", 0.5))
    # 16 bytes a period for its COF and its swing, beside what a part of the march takes
    assert rows[0]["ratio"] < 1.5


def test_a_checkout_is_timed_beside_another():
    ((task, name, here, there),) = alternately(HERE, HERE, ["default run"], ["rigid pull, elastic"], 1, print)
    assert (task, name) == ("default run", "rigid pull, elastic")
    assert here > 0
    assert there > 0
