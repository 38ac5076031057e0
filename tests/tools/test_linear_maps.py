"""Small matrices beside LAPACK."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from mdr.tools.linear_maps import made_orthogonal, spectral_radius


@pytest.mark.parametrize(("k", "n"), [(1, 1), (2, 40), (3, 3), (6, 50)])
def test_rotated_rows_are_orthogonal_and_as_long_as_the_singular_values(k, n):
    rng = np.random.default_rng(k)
    for scale in (1.0, 1e-7):
        rows = rng.normal(size=(k, n)) * scale ** np.linspace(0, 1, k)[:, None]
        rows[-1] += rows[0]
        before, others = rows.copy(), np.eye(k)
        lengths = made_orthogonal(rows, others)
        assert_allclose(lengths, np.linalg.svd(before, compute_uv=False), rtol=1e-12, atol=1e-15 * lengths[0])
        assert_allclose(others @ before, rows, atol=1e-14 * np.abs(before).max())
        assert_allclose(others @ others.T, np.eye(k), atol=1e-14)
        unit = rows / lengths[:, None]
        assert_allclose(unit @ unit.T, np.eye(k), atol=1e-7)


def test_rows_of_nothing_have_no_length():
    rows = np.array([[0.0, 0.0], [3.0, 4.0]])
    assert_allclose(made_orthogonal(rows, np.eye(2)), [5.0, 0.0], rtol=1e-15)
    assert_allclose(made_orthogonal(np.zeros((3, 2)), np.eye(3)), 0.0)


def test_spectral_radius():
    rng = np.random.default_rng(0)
    for k in (1, 2, 3, 6):
        matrix = rng.normal(size=(k, k))
        assert_allclose(spectral_radius(matrix), np.abs(np.linalg.eigvals(matrix)).max(), rtol=1e-10)
    assert_allclose(spectral_radius(np.array([[0.0, 1.0], [0.0, 0.0]])), 0.0)
    assert_allclose(spectral_radius(np.array([[0.5, 1.0], [0.0, 0.5]])), 0.5, rtol=1e-9)  # one that has no basis
    assert_allclose(spectral_radius(np.zeros((0, 0))), 0.0)
