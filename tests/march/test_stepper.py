"""What the stepper reads off a period."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from mdr.march.stepper import least_between

PHASE = 2 * np.pi * np.arange(64) / 64


@pytest.mark.parametrize("at", [0.0, 0.02, 0.05, 3.0, 6.27])
def test_the_least_value_of_a_smooth_function_lies_between_its_nodes(at):
    values = 1.3 - np.cos(PHASE - at) + 0.1 * np.sin(2 * (PHASE - at)) ** 2
    assert_allclose(least_between(values), 0.3, rtol=1e-5)
    assert_allclose(least_between(np.where(np.abs(np.sin(0.5 * (PHASE - at))) < 0.5, values, np.inf)), 0.3, rtol=1e-5)


def test_no_value_is_made_up_beside_a_jump():
    values = np.array([1.0, 1.0, 1.0, 0.1, 0.1, 0.1, 1.0, 1.0])
    assert least_between(values) == 0.1
    assert least_between(np.array([3.0, 2.0, 1.0, np.inf, np.inf, np.inf])) == 1.0
    assert least_between(np.array([1.0, 0.0, -0.2, 0.0, 1.0, 2.0])) == -0.2
