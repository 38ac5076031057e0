"""Shapes from a force curve: as good as their splines say, or refused with the reason."""

import warnings

import numpy as np
import pytest
from catalogue import THETA, B, R
from numpy.testing import assert_allclose
from scipy.stats import chi2

import mdr

E_STAR = 2e6


def from_force(shape, reach, n=100, **how):
    d = np.linspace(0, float(shape.profile_1d(reach)) or 1e-5, n)
    return mdr.FromForce(d, shape.force(d, E_STAR), E_STAR, **how)


BALL = mdr.FromForce(1e-6 * np.arange(40), mdr.Paraboloid(R).force(1e-6 * np.arange(40), E_STAR), E_STAR)


@pytest.mark.parametrize(("shape", "reach", "tip", "tolerance"), [
    (mdr.Paraboloid(R), 1e-3, "any", 1e-11),
    (mdr.Cone(THETA), 1e-3, "any", 1e-11),
    (mdr.FlatPunch(B), B, "any", 1e-11),
    (mdr.Paraboloid(R), 1e-3, "round", 1e-11),
    (mdr.Sphere(R), R / 2, "round", 1e-11),
    (mdr.Sphere(R), R / 2, "any", 1e-3),  # below the first depth
    (mdr.Cone(THETA), 1e-3, "sharp", 1e-11),
    (mdr.TruncatedCone(B, THETA), 2 * B, "flat", 1e-8),
    (mdr.Hyperboloid(1e-4, 1e-4), 2e-3, "round", 1e-5),
])  # fmt: skip
def test_the_shape_of_a_force(shape, reach, tip, tolerance):
    found = from_force(shape, reach, tip=tip)
    d = found.d[-1] * np.linspace(0.001, 1, 200)
    assert_allclose(found.contact_radius(d), shape.contact_radius(d), rtol=tolerance)
    assert_allclose(found.force(d, 3.0), shape.force(d, 3.0), rtol=2 * tolerance)
    assert_allclose(found.stiffness(d, 3.0), shape.stiffness(d, 3.0), rtol=tolerance)
    x = reach * np.linspace(0.001, 0.999, 99)
    # over the greatest depth; at the edge of a face g has a vertical tangent
    near = {"any": 0.02 * tolerance, "flat": tolerance**0.5}.get(tip, tolerance)
    assert_allclose(found.profile_1d(x), shape.profile_1d(x), rtol=0, atol=max(near, 1e-11) * found.d[-1])
    r, deep = reach * np.array([0.05, 0.3, 0.7, 0.95]), 0.99 * found.d[-1]
    assert_allclose(found.profile_3d(r), shape.profile_3d(r), rtol=0, atol=max(near, 1e-10) * found.d[-1])
    assert_allclose(found.pressure(r, deep, E_STAR), shape.pressure(r, deep, E_STAR), rtol=max(2e-7, tolerance))


@pytest.mark.parametrize("shape", [mdr.FlatPunch(1e-3), mdr.Sphere(R), mdr.Cone(0.02), mdr.TruncatedCone(0.02, 1e-4)])
@pytest.mark.parametrize("relative", [1e-4, 1e-2])
def test_any_tip_is_found_through_noise_that_is_told(shape, relative):
    d = np.linspace(0, 4e-6, 101)
    F = np.asarray(shape.force(d, E_STAR))
    for seed in range(20):
        noise = relative * F[-1]
        noisy = F + np.append(0, np.random.default_rng(seed).normal(0, noise, 100))
        found = mdr.FromForce(d, noisy, E_STAR, smoothing=noise)
        assert_allclose(found.contact_radius(2e-6), shape.contact_radius(2e-6), rtol=max(3 * relative, 2e-3))


@pytest.mark.parametrize(
    ("tip", "shape"), [("round", mdr.Paraboloid(R)), ("sharp", mdr.Cone(THETA)), ("flat", mdr.FlatPunch(B))]
)
@pytest.mark.parametrize("n", [12, 15, 30])
def test_half_of_the_noise_is_told_or_refused(tip, shape, n):
    """By chi squared of what is left: what is silent is within 2 standard deviations.

    In 20 draws; of right ones 5 % are told, more than 4 of 20 with a chance of 0.3 %.
    """
    d = np.linspace(0, 4e-6, n + 1)
    F = np.asarray(shape.force(d, E_STAR))
    noise, told_of_right = 0.01 * F[-1], 0
    for seed in range(20):
        noisy = F + np.append(0, np.random.default_rng(seed).normal(0, noise, n))
        for share in (0.5, 1.0):
            with warnings.catch_warnings(record=True) as told:
                warnings.simplefilter("always")
                try:
                    found = mdr.FromForce(d, noisy, E_STAR, tip=tip, smoothing=share * noise)
                except ValueError:
                    continue
            left = np.sqrt(np.mean((found.force(d, E_STAR) - noisy)[1:] ** 2)) / (share * noise)
            assert told or left < np.sqrt(chi2.isf(0.0455, n - 1) / n)
            assert not told or "is less than the noise of the points, about" in str(told[0].message)
            told_of_right += share == 1 and bool(told)
    assert told_of_right <= 4


def test_forces_that_begin_too_late_or_never_are_no_shape():
    d = np.linspace(0, 2e-5, 200)
    F = np.asarray(mdr.Sphere(R).force(np.maximum(d - 4e-6, 0), E_STAR))
    noisy = F + np.append(0, np.random.default_rng(0).normal(0, 1e-3 * F[-1], 199))
    with pytest.raises(ValueError, match=r"no force up to d = .*e-06 m: give depths less that of the touch"):
        mdr.FromForce(d, noisy, E_STAR, smoothing=1e-3 * F[-1])
    for none in (0 * d, -d):
        with pytest.raises(ValueError, match="no force is above zero"):
            mdr.FromForce(d, none, E_STAR, smoothing=1e-5)


def test_deeper_than_it_was_measured():
    with pytest.raises(ValueError, match=r"d = 0.0001 m is deeper than the force is known, d = 3.9e-05 m"):
        BALL.stiffness([1e-6, 1e-4], 1)
    assert np.array_equal(BALL.force([-1, 0], 1), [0, 0])
    assert BALL.contact_radius(1e-300) > 0
