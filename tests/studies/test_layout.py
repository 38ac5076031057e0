"""The order of a study: every point in one unit, the velocity innermost, axes in their place."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from mdr.studies.work import Layout

LAYOUTS = [
    Layout((3,), None, 64),
    Layout((3, 4), None, 64),
    Layout((5,), 0, 2),
    Layout((2, 5, 3), 1, 2),
    Layout((5, 2, 3), 0, 5),
    Layout((2, 3, 5), 2, 8),
    Layout((1, 1), 0, 64),
]


@pytest.mark.parametrize("layout", LAYOUTS, ids=str)
def test_units_cover_every_point_once_and_in_order(layout):
    seen = np.zeros(layout.shape, dtype=int)
    flat = np.full(layout.n_points, -1)
    for unit in range(layout.n_units):
        part = layout.velocities(unit)
        first, end = layout.first_point(unit), layout.first_point(unit + 1)
        assert end - first == part.stop - part.start <= layout.block
        where = list(layout.case(unit))
        if layout.velocity is not None:
            where.insert(layout.velocity, part)
        seen[tuple(where)] += 1
        flat[first:end] = np.atleast_1d(np.arange(layout.n_points).reshape(layout.shape)[tuple(where)])
    assert_array_equal(seen, 1)
    assert_array_equal(layout.in_place(flat), np.arange(layout.n_points).reshape(layout.shape))
    assert layout.first_point(layout.n_units) == layout.n_points


def test_several_quantities_at_once():
    layout = LAYOUTS[3]
    points = np.arange(2 * layout.n_points).reshape(2, -1)
    assert_array_equal(layout.in_place(points)[1], layout.in_place(points[1]))


def test_a_million_points_are_not_enumerated():
    layout = Layout((1000, 1000, 1000), 2, 64)
    assert layout.n_units == 16 * 10**6
    assert layout.case(layout.n_units - 1) == (999, 999)
    assert layout.velocities(layout.n_units - 1) == slice(960, 1000)
