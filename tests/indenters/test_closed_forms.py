"""The closed forms of the catalogue against integrals of f', in which nothing cancels, and against each other."""

import math
from itertools import pairwise

import numpy as np
import pytest
from catalogue import A_0, D_0, KINKED, SLOPES, WORN, B, R, end, name
from numpy.testing import assert_allclose

import mdr
from mdr.indenters.mapping.quadrature import double_exponential

EXACT = 1e-12  # promised for closed forms
DISC = 1e-9  # promised for the integral of the pressure
NODES, WEIGHTS = np.polynomial.legendre.leggauss(60)


def sneddon(shape, a):
    """g(a) = a ∫ f'(a cos t) dt and F_N/E* = 2a² ∫ cos²t f'(a cos t) dt over a quarter turn (Sneddon 1965)."""
    outside, inside = SLOPES[shape]
    kink = math.atan2(math.sqrt(max((a - B) * (a + B), 0)), B) if inside else math.pi / 2
    g = F = 0.0
    for low, high, slope in ((0.0, kink, outside), (kink, math.pi / 2, inside)):
        if low == high:
            continue
        s = np.pi / 4 * (NODES + 1)  # sin² s crowds nodes at both ends: f' may be a root there
        t, dt = low + (high - low) * np.sin(s) ** 2, (high - low) * np.sin(2 * s) * np.pi / 4
        g += a * np.sum(WEIGHTS * dt * slope(a, t))
        F += 2 * a * a * np.sum(WEIGHTS * dt * slope(a, t) * np.cos(t) ** 2)
    return g, F


def radii(shape):
    """Many decades, beside a kink as close as roundings allow; a hyperboloid to where 60 nodes still resolve it."""
    beside = B * (1 + np.geomspace(1e-15, 0.5, 30))
    if shape in WORN:
        return np.concatenate([beside, B * np.geomspace(2, 1e9, 20)])
    low, high = 1e-15, min(end(shape), 0.02 if isinstance(shape, mdr.Hyperboloid) else 1e6)
    return np.concatenate([np.geomspace(low, high, 60), [0.98 * high], beside if shape in KINKED else []])


@pytest.mark.parametrize("shape", SLOPES, ids=name)
def test_depth_force_and_stiffness_of_the_radius(shape):
    a = radii(shape)
    g, F = np.transpose([sneddon(shape, one) for one in a])
    assert_allclose(shape.profile_1d(a), g, rtol=EXACT)
    assert_allclose(shape.contact_radius(g), a, rtol=EXACT)
    assert_allclose(shape.force(g, 1.0), F, rtol=EXACT)
    assert_allclose(shape.stiffness(g, 3.0), 6 * a, rtol=EXACT)
    # the area d a - F/2 is itself a difference: compared where it is not the smaller part of it
    area = a * g - F / 2
    some = area > 0.05 * a * g
    assert_allclose(shape.profile_area(a)[some], area[some], rtol=20 * EXACT)


@pytest.mark.parametrize("shape", SLOPES, ids=name)
def test_the_pressure_carries_the_force_at_any_depth(shape):
    rule = double_exponential(0.06)
    beside = [1.0001, 1.01, 1.5, 30] if shape in KINKED else []
    for a in [*np.array(beside) * B, *([] if shape in WORN else end(shape) * np.array([1e-9, 0.3, 1]))]:
        d = float(shape.profile_1d(a))
        turns = [0, *[math.asin(b / a) for b in shape.kinks if b < a], math.pi / 2]
        total = 0.0
        for low, high in pairwise(turns):
            t = low + (high - low) * rule.from_low
            p = shape.pressure(a * np.sin(t), d, 1.0)
            total += (high - low) * np.sum(rule.weight * 2 * np.pi * a * a * np.sin(t) * np.cos(t) * p)
        assert_allclose(total, shape.force(d, 1.0), rtol=DISC)


@pytest.mark.parametrize("shape", WORN, ids=name)
@pytest.mark.parametrize("d", [1e-300, 1e-20, 1e-16, 1e-12, 1e-11, 1e-9])
def test_a_worn_tip_begins_as_a_punch(shape, d):
    """The edge of contact passes the corner within roundings of b: the force and the pressure must not."""
    a = float(shape.contact_radius(d))
    wider = 1e-3 if isinstance(shape, mdr.RoundedPunch) else 1e-9  # than b: as d^(2/3), the others as d²
    assert B <= a < B * (1 + wider)
    assert_allclose(shape.force(d, 1.0), 2 * B * d, rtol=wider)
    assert_allclose(shape.stiffness(d, 1.0), 2 * B, rtol=wider)
    r = B * np.array([0, 0.5, 0.9])
    punch = mdr.FlatPunch(B).pressure(r, d, 1.0)
    assert_allclose(shape.pressure(r, d, 1.0), punch, rtol=20 * wider)  # (a - b)/(b - r)
    assert shape.contact_radius(0.0) == shape.force(0.0, 1.0) == shape.stiffness(-d, 1.0) == 0


def test_a_concave_punch():
    a, hollow, E_star = 2e-3, 1.0, 2e6
    shape = mdr.ConcavePunch(a, hollow)
    d = shape.least_depth * np.array([1, 1.5, 100])
    assert shape.least_depth == pytest.approx(a**2 / hollow, rel=1e-15)
    assert_allclose(shape.force(d, E_star), 2 * E_star * (a * d + a**3 / (3 * hollow)), rtol=EXACT)
    assert_allclose(shape.stiffness(d, E_star), 2 * E_star * a, rtol=EXACT)
    assert shape.pressure(0.0, d[0], E_star) == 0
    assert np.all(shape.pressure(a * np.linspace(0, 0.999, 9)[:, None], d, E_star) >= 0)
    flat = mdr.ConcavePunch(a, 1e12)
    assert_allclose(flat.force(1e-5, 1), mdr.FlatPunch(a).force(1e-5, 1), rtol=1e-12)  # a²/(3R d) = 1e-13


@pytest.mark.parametrize("share", [-0.49, 0.0, 0.5, 1 - 1e-9])
def test_a_concave_punch_that_touches_with_a_ring(share):
    shape = mdr.ConcavePunch(2e-3, 1.0)
    for ask in (shape.contact_radius, lambda d: shape.force(d, 1), lambda d: shape.pressure(0, d, 1)):
        with pytest.raises(ValueError, match=r"annular contact: at the depth d = .* a²/R = 4e-06 m on; press deeper"):
            ask(np.array([1e-5, share * shape.least_depth]))
    assert shape.contact_radius(-0.51 * shape.least_depth) == 0


def test_the_equator_is_the_end_of_a_sphere():
    assert mdr.Sphere(R).profile_3d(R) == R
    assert mdr.Ellipsoid(R, 100).profile_3d(-0.01) == pytest.approx(R, rel=1e-15)
    assert mdr.Sphere(R).max_radius < R
    assert mdr.Sphere(R).contact_radius(5 * R) < R
    assert np.isfinite(mdr.Sphere(R).force(10 * R, 1))


def test_a_constant_pressure():
    shape = mdr.ConstantPressure(A_0, D_0)
    assert shape.contact_radius(D_0) == A_0
    r = A_0 * np.array([0, 0.3, 0.9, 0.999999])
    assert_allclose(shape.pressure(r, D_0, 2e6), 2e6 * D_0 / (2 * A_0), rtol=EXACT)
    assert_allclose(shape.force(D_0, 2e6), np.pi / 2 * 2e6 * A_0 * D_0, rtol=EXACT)
    u = np.array([0.69, 0.71])  # on both sides of where its f changes from a mean to the elliptic integral
    sine = np.sin(np.pi * (np.arange(99) + 0.5) / 99)
    direct = 1 - np.mean(np.sqrt(1 - (u[:, None] * sine) ** 2), axis=1)
    assert_allclose(shape.profile_3d(u * A_0), D_0 * direct, rtol=EXACT)
