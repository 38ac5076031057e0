"""Equations whose derivatives are learned from look to look."""

import numpy as np
import pytest

from mdr.march.dynamics.broyden import ROOM, correct


@pytest.mark.parametrize("n", [1, 2, 4])
def test_linear_equations_are_solved_in_twice_their_number_of_looks(n):
    """Gay (1979), whatever the equations; with one more for rounding."""
    for seed in range(20):
        rng = np.random.default_rng(seed)
        A = rng.normal(size=(n, n)) + 3 * np.eye(n)
        x, answer, past = np.zeros(n), rng.normal(size=n), np.empty((n + ROOM, n))
        for look in range(2 * n + 1):
            correct.py_func(past, tuple(A @ (x - answer)), look == 0)
            x = x + past[n]
        assert x == pytest.approx(answer, abs=1e-8)


def test_what_is_solved_stays():
    past = np.empty((2 + ROOM, 2))
    for look in range(3):
        correct.py_func(past, (0.0, 0.0), look == 0)
        assert not past[2].any()
