"""Shapes from measured points: as good as their splines say, or refused with the reason."""

import contextlib
import warnings

import numpy as np
import pytest
from catalogue import THETA, B, R
from numpy.testing import assert_allclose

import mdr

GRID = np.linspace(0, 2e-3, 201)  # B is one of its points


def sampled(shape, n=201, reach=2e-3, **how):
    r = np.linspace(0, reach, n)
    return mdr.SampledProfile(r, shape.profile_3d(r), **how)


@pytest.mark.parametrize(("n", "tolerance"), [(20, 1e-6), (50, 1e-8), (200, 1e-11)])
@pytest.mark.parametrize("R", [5e-12, 5e-3, 5e3])
def test_points_of_a_sphere(n, tolerance, R):
    """As the docstring promises; near the tip too, where f ~ r², and in any unit."""
    sphere = mdr.Sphere(R)
    shape = sampled(sphere, n, R / 2)
    x = R / 2 * np.geomspace(1e-9, 1, 99)
    d = sphere.profile_1d(x[:-1])
    assert_allclose(shape.profile_3d(x), sphere.profile_3d(x), rtol=tolerance)
    assert_allclose(shape.profile_1d(x), sphere.profile_1d(x), rtol=tolerance)
    assert_allclose(shape.contact_radius(d), x[:-1], rtol=tolerance)
    assert_allclose(shape.force(d, 1), sphere.force(d, 1), rtol=tolerance)
    r, deep = R * np.array([0, 1e-6, 0.1, 0.3, 0.39]), sphere.profile_1d(0.4 * R)
    assert_allclose(shape.pressure(r, deep, 1), sphere.pressure(r, deep, 1), rtol=10 * tolerance)


@pytest.mark.parametrize(("shape", "how"), [
    (mdr.Cone(THETA), {"tip": "sharp"}),
    (mdr.Paraboloid(R), {}),
    (mdr.TruncatedCone(B, THETA), {"kinks": [B]}),
    (mdr.CappedCone(B, THETA), {"kinks": [B]}),
    (mdr.CappedParaboloid(2 * R, R, B), {"kinks": [B]}),
], ids=lambda one: repr(one)[:20])  # fmt: skip
def test_what_a_spline_can_be_is_exact(shape, how):
    """Polynomials between the kinks: what is left is the rounding of 200 points."""
    spline = sampled(shape, **how)
    x = np.concatenate([np.geomspace(1e-8, 0.99 * B, 30), np.linspace(1.01 * B, 2e-3, 50)])
    scale = float(shape.profile_1d(2e-3))
    for ask in ("profile_3d", "profile_1d"):
        assert_allclose(getattr(spline, ask)(x), getattr(shape, ask)(x), rtol=1e-11, atol=1e-15 * scale)
    assert_allclose(spline.profile_area(x), shape.profile_area(x), rtol=1e-11, atol=1e-15 * scale * B)
    d, r = scale * np.array([0.02, 0.5, 0.9]), np.array([[1e-5], [0.5 * B], [0.99 * B]])
    assert_allclose(spline.contact_radius(d), shape.contact_radius(d), rtol=1e-11)
    assert_allclose(spline.pressure(r, d, 1), shape.pressure(r, d, 1), rtol=1e-10)


def test_noise_is_smoothed():
    rng, noise = np.random.default_rng(1), 1e-7
    f = mdr.Sphere(R).profile_3d(GRID) + rng.normal(0, noise, GRID.size)
    shape = mdr.SampledProfile(GRID, f, smoothing=noise)
    residual = shape.profile_3d(GRID) - (f - f[0])
    assert np.std(residual) == pytest.approx(noise, rel=0.3)
    assert_allclose(shape.force([1e-5, 1e-4], 1), mdr.Sphere(R).force([1e-5, 1e-4], 1), rtol=1e-3)


@pytest.mark.parametrize("n", [20, 40, 76])
def test_a_spline_that_follows_half_of_the_noise_says_so(n):
    """It keeps from the points as it is told to, by more numbers than noise takes: told, or no shape, in 16 of 20."""
    r = np.linspace(0, 3e-4, n)
    said = {0.5: 0, 1.0: 0}
    for seed in range(20):
        f = r**2 / (2 * R) + np.random.default_rng(seed).normal(0, 1e-8, n)
        for share in said:
            with warnings.catch_warnings(record=True) as told, contextlib.suppress(ValueError):
                warnings.simplefilter("always")
                told.append(None)  # of a refusal
                mdr.SampledProfile(r, f, smoothing=share * 1e-8)
                told.remove(None)
            said[share] += bool(told)
    assert said[0.5] >= 16
    assert said[1.0] <= 4


def test_no_spline_follows_the_noise_of_many_points(monkeypatch):
    """FITPACK takes a minute to get as close to these as a tenth of their noise, to no avail."""
    r, noise = np.linspace(0, 2e-3, 10_000), 1e-7
    f = r**2 / R + np.random.default_rng(1).normal(0, noise, r.size)
    tried = []
    own = mdr.SampledProfile._why_no_shape
    monkeypatch.setattr(mdr.SampledProfile, "_why_no_shape", lambda self: tried.append(self.smoothing) or own(self))
    with pytest.raises(ValueError, match=r"smoothing = 1e-08 m is less than the noise.*: 1.1e-07 m is enough"):
        mdr.SampledProfile(r, f, smoothing=0.1 * noise)
    mdr.SampledProfile(r, f, smoothing=noise)
    assert min(tried) == noise
    d = r[1:]
    F = d**1.5 * (1 + np.random.default_rng(1).normal(0, 1e-3, d.size))
    with pytest.raises(ValueError, match=r"smoothing = 1e-12 N is less than the noise"):
        mdr.FromForce(np.append(0, d), np.append(0, F), 1e6, smoothing=1e-12)


@pytest.mark.parametrize("shape", [mdr.TruncatedCone(B, THETA), mdr.TruncatedParaboloid(B, R)])
def test_a_kink_that_makes_the_spline_fall_is_found(shape):
    f = shape.profile_3d(GRID)
    with pytest.raises(ValueError, match=r"annular contact.*falls at x = .*if it is noise.*smoothing=") as refused:
        mdr.SampledProfile(GRID, f)
    assert f"if its slope jumps at r = {B!r} m, where it changes most, give kinks=({B!r},); if" in str(refused.value)
    assert mdr.SampledProfile(GRID, f, kinks=(B,)).kinks == (B,)


def test_what_lies_beyond_the_points_is_unknown():
    shape = sampled(mdr.Sphere(R))
    deepest = float(shape.profile_1d(2e-3))
    assert shape.contact_radius(deepest) == pytest.approx(2e-3, rel=1e-14)
    with pytest.raises(ValueError, match=r"deeper than SampledProfile reaches.*r <= 0.002 m.*describe more of it"):
        shape.force(1.01 * deepest, 1)
    with pytest.raises(ValueError, match=r"SampledProfile ends at r = 0.002 m, got 0.0021 m"):
        shape.profile_1d(2.1e-3)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("scale", [1e-300, 1e-200, 1e200, 1e300])
@pytest.mark.parametrize("reach", [1e-300, 1e-200, 1e200, 1e300])
def test_sizes_beyond_all_others_are_answered_or_refused(scale, reach):
    r = np.linspace(0, 1, 20)
    with contextlib.suppress(ValueError):
        shape = mdr.SampledProfile(reach * r, scale * r**2)
        assert shape.profile_3d(reach) == pytest.approx(scale)
