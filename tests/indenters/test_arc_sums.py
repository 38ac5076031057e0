"""Sums over many pieces: those of Gauss's rule on every piece, and few near pieces however many there are."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from mdr.indenters.mapping.splines import SplineImage

NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)


def rough(n, even, seed):
    """Random polynomials over n pieces: nothing is smooth, so that each piece counts by itself."""
    rng = np.random.default_rng(seed)
    places = np.linspace(0, 1, n + 1) ** (1 if even else 3)
    return SplineImage(1e-3 * places, rng.normal(size=(n, 6)), ())


def piece_by_piece(image, x):
    """∫₀^{π/2} of f', of (r f')' and of f sin t along r = x sin t."""
    ends = np.minimum(image.ends, x)
    turns = np.arcsin(ends / x)
    half = np.diff(turns)[:, None] / 2
    t = turns[:-1, None] + half * (NODES + 1)
    u = (x * np.sin(t) - image.ends[:-1, None]) / image.width[:, None]
    powers = u[:, :, None] ** np.arange(6)
    f = [np.einsum("ijk,ik->ij", powers[:, :, : c.shape[1]], c) for c in (image.slopes, image.radial, image.pieces)]
    f[2] *= np.sin(t)
    return [float(np.sum(half * values @ WEIGHTS)) for values in f]


@pytest.mark.parametrize("even", [True, False])
@pytest.mark.parametrize("n", [1, 3, 4, 5, 33, 300])
def test_the_sums_are_those_over_every_piece(n, even):
    image = rough(n, even, n)
    x = image.ends[-1] * np.append(np.random.default_rng(1).random(20), 1.0)
    expected = np.array([piece_by_piece(image, one) for one in x]).T
    got = image._arcs(x)
    for one, other in zip(got, expected, strict=True):
        assert_allclose(one, other, rtol=0, atol=1e-12 * np.abs(other).max())  # random signs cancel


@pytest.mark.parametrize("even", [True, False])
def test_work_for_one_radius_grows_as_the_logarithm_of_the_pieces(even):
    few, many = rough(1000, even, 2), rough(8000, even, 2)
    near = []
    for image in (few, many):
        x = image.ends[1:]
        near.append(image._sums.far(x)[1].size / x.size)
    assert max(near) < 20  # three groups of four, and what of their neighbours is close where steps are uneven
    assert len(many._sums.levels) == len(few._sums.levels) + 3
