"""Friction that falls over a slip distance, on annuli and on springs: what is known in closed form."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr
from validation.half_space.weakening import breakaway, friction, half_space, march, springs


def pulled(points, way, steps, stick=1.0, d_c=0.0):
    """Tractions and slip (steps, n) in a slow pull from rest at the depth u_z0, and the pressure (n,)."""
    n = points.gap.size
    p = np.linalg.solve(points.moved, 1 - points.gap)
    found = march(points, np.tile(p, (steps, 1)), way / steps, stick, d_c, np.zeros(n))
    q, slip = (np.array(one) for one in zip(*found, strict=True))
    return q, slip, p


def test_one_spring_has_the_law_of_friction_that_falls():
    known = mdr.laws.falling_friction(0.5, 0.3, 1.5).share
    off = [friction(springs("flat punch", 0.3, 1), 0.3, 0.5, 1.5, steps=steps).share - known for steps in (250, 1000)]
    assert abs(off[0]) < 2e-3
    assert abs(off[1]) < 0.5 * abs(off[0])  # first order would be a quarter, but for the phase of a jump in its step


@pytest.mark.parametrize(("stick", "allowed"), [(1.0, 3e-3), (1.5, 0.02)])
def test_a_slow_pull_is_cattaneo_and_mindlin_with_the_kinetic_coefficient(stick, allowed):
    """1 - (1 - x)^(3/2) after x of mu_k kappa d; 1.5 of a static coefficient are felt on 48 annuli by their width."""
    points = half_space("paraboloid", 0.0, 48)
    q, _, p = pulled(points, 0.8, 160, stick)
    x = np.arange(1, 161) / 200
    assert_allclose(q @ points.weight / (p @ points.weight), 1 - (1 - x) ** 1.5, atol=allowed)


def test_a_spring_whose_friction_falls_slowly_has_no_jump():
    """Slip s with mu_s - (mu_s - mu_k) s/d_c = x - s, up to d_c, after a pull by x."""
    stick, d_c = 1.4, 1.0
    q, slip, p = pulled(springs("flat punch", 0.0, 1), 3.0, 300, stick, d_c)
    x = np.arange(1, 301) / 100
    known = np.clip((x - stick) / (1 - (stick - 1) / d_c), 0, d_c)
    assert_allclose(q[:, 0] / p, np.where(x < stick, x, np.where(known < d_c, x - known, 1.0)), atol=1e-4)
    assert_allclose(np.cumsum(slip[:, 0]), np.where(known < d_c, known, x - 1), atol=1e-4)
    assert breakaway(springs("flat punch", 0.0, 1), stick, d_c) == pytest.approx(stick, abs=0.012)  # the way of a step


@pytest.mark.parametrize("d_c", [0.0, 0.1])
@pytest.mark.parametrize("make", [half_space, springs])
def test_each_point_has_its_law_at_the_end_of_each_step(make, d_c):
    q, slip, p = pulled(make("cone", 0.0, 24), 2.0, 60, 1.6, d_c)
    assert np.all(q <= 1.6 * p * (1 + 1e-12))
    assert np.all(slip > -1e-12)
    slips = slip > 1e-9
    so_far = np.cumsum(np.where(slips, slip, 0.0), axis=0)
    falls = np.clip(1 - so_far / d_c, 0, 1) if d_c else np.zeros_like(slip)
    bound = p * (1 + 0.6 * falls)
    assert_allclose(q[slips], bound[slips], rtol=1e-5)
    assert 0 < np.count_nonzero(slips) < slips.size


def test_work_is_what_slip_takes():
    assert friction(half_space("cone", 0.3, 20), 0.3, 0.7, 1.4, 0.1, steps=60).unbalanced < 1e-9
