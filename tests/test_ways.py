"""One motion written in six ways: some contacts of tests/tables/ways.py, which has hundreds."""

import pytest
from tables import ways

#: rigid and body, kept and lost, shaken and not, of every kind of material; a verdict of the first
CONTACTS = (21, 7, 10, 13, 14, 16, 25, 49)


@pytest.mark.parametrize("which", CONTACTS)
def test_no_function_tells_the_ways_apart(which):
    name, case = ways.drawn(which + 1)[which]
    rows = list(ways.rows_of(name, case, verdict=which == CONTACTS[0]))
    assert len({(row.way, row.function) for row in rows}) == 5 * (5 if which == CONTACTS[0] else 4)
    assert all(row.known for row in rows)
    assert not [row for row in rows if row.ratio > 1]
