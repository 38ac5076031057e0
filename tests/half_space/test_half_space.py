"""Coefficients, contact and friction on the half-space against closed forms, symmetries and springs."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import dblquad

import mdr
from mdr.half_space.friction import Settings, contact_of, in_three_dimensions, last_period
from mdr.half_space.influence import HalfSpace, X, Y, Z
from mdr.half_space.normal import NotConverged, pressure
from mdr.half_space.tangential import traction
from validation.half_space.springs import of_springs

NU, G = 0.3, 2.0
E_STAR, G_STAR, BETA = 2 * G / (1 - NU), 4 * G / (2 - NU), (1 - 2 * NU) / (2 * (1 - NU))
BODY = HalfSpace(6, 0.3, E_STAR, G_STAR, BETA)


def point_load(i, j, x, y):
    """u_i under a unit force along j, of Boussinesq and Cerruti (Johnson 1985, 3.2 and 3.6)."""
    r = np.hypot(x, y)
    sideways = (1 - 2 * NU) / 2 / r**2
    u = [
        [(1 - NU) / r + NU * x * x / r**3, NU * x * y / r**3, -sideways * x],
        [NU * x * y / r**3, (1 - NU) / r + NU * y * y / r**3, -sideways * y],
        [sideways * x, sideways * y, (1 - NU) / r],
    ]
    return u[i][j] / (2 * np.pi * G)


@pytest.mark.parametrize(("a", "b"), [(1, 0), (2, -3), (-4, 1)])
def test_coefficients_are_integrals_of_point_loads(a, b):
    h, n = BODY.h, BODY.n
    for i in (X, Y, Z):
        for j in (X, Y, Z):

            def load_at(s, t, i=i, j=j):
                return point_load(i, j, a * h - t, b * h - s)

            load = dblquad(load_at, -h / 2, h / 2, -h / 2, h / 2)[0]
            assert_allclose(BODY.coefficients(i, j)[a + n - 1, b + n - 1], load, atol=1e-9 * h / G)


def test_a_product_is_the_sum_over_cells():
    rng = np.random.default_rng(0)
    n, t = BODY.n, rng.normal(size=(3, 6, 6))
    u = np.zeros_like(t)
    at = np.arange(n)
    for i in (X, Y, Z):
        for j in (X, Y, Z):
            c = BODY.coefficients(i, j)
            seen = c[at[:, None, None, None] - at[:, None] + n - 1, at[:, None, None] - at + n - 1]
            u[i] += np.einsum("abcd,cd->ab", seen, t[j])
    assert_allclose(BODY.displacement(t), u, atol=1e-14)


# --- friction ---

BALL = mdr.SlidingContact(
    mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), 0.3, mdr.NormalOscillation(u_z0=20e-6, du_z=6e-6, omega=300.0)
)
COUPLED = replace(BALL, material=mdr.Elastic(E=3e6, nu=0.3))
V = 0.4 * mdr.critical_velocity(BALL)
COARSE = Settings(cells=25, steps=24, cycles=2)
SMALL = Settings(cells=13, steps=12, cycles=2)


@pytest.mark.parametrize("motion", [(20e-6, 6e-6), (20e-6, 30e-6)], ids=["kept", "lost"])
@pytest.mark.parametrize("tau", [0.0, 3e-3], ids=["elastic", "Kelvin"])
def test_without_coupling_the_half_space_has_the_friction_of_the_springs(motion, tau):
    material = mdr.KelvinVoigt(E=3e6, nu=0.0, tau=tau)
    case = replace(BALL, material=material, oscillation=mdr.NormalOscillation(*motion, omega=300.0))
    settings = replace(COARSE, coupled=False, cells=31)
    v = 0.4 * mdr.critical_velocity(case)
    off = in_three_dimensions(case, v, settings).cof - of_springs(case, v, settings).cof
    assert abs(off) < 5e-4 * case.mu_0  # of 31 cells


def test_what_is_neither_stick_nor_slip_is_not_there():
    """In every cell |q| <= mu_0 p; where it is less nothing slips, and where it is equal slip is along q."""
    contact = contact_of(COUPLED, COARSE)
    depth = 20e-6 + 6e-6 * np.linspace(-1, 1, 5)
    for step in contact.march(contact.full_slip(14e-6), depth, np.outer([V, 0.0], np.arange(5) * 1e-3), 1.0):
        p, q = step.pressure, step.tractions[:2]
        size, slip = np.hypot(*q), np.hypot(*step.slip)
        assert np.all(p >= 0)
        assert np.all(size <= 0.3 * p * (1 + 1e-9))
        way = 6e-6 * 0.3
        assert np.max(slip[(p > 0) & (size < 0.3 * p * (1 - 1e-4))]) < 1e-4 * way
        slides = slip > 1e-2 * way
        assert_allclose((q * step.slip).sum(axis=0)[slides], (size * slip)[slides], rtol=1e-3)


def test_a_march_may_go_on_from_another_and_end_when_settled():
    few = Settings(cells=9, steps=8, cycles=1)
    on = last_period(COUPLED, V, few, last_period(COUPLED, V, few).steps[-1])
    assert_allclose(on.friction.cof, last_period(COUPLED, V, replace(few, cycles=2)).friction.cof, rtol=1e-12)
    early = last_period(COUPLED, V, replace(few, cycles=40, settled=1e-3))
    assert 2 < early.friction.cycles < 40
    assert early.friction.settling <= 1e-3 * COUPLED.mu_0
    late = last_period(COUPLED, V, replace(few, cycles=4), early.steps[-1])
    assert_allclose(early.friction.cof, late.friction.cof, atol=1e-3 * COUPLED.mu_0)


def test_slip_across_may_be_left_out():
    settings = replace(SMALL, cycles=1, transverse=False)
    along = last_period(COUPLED, V, settings)
    assert all(np.all(step.tractions[Y] == 0) for step in along.steps)
    fast = in_three_dimensions(COUPLED, 5 * V, settings)
    assert_allclose(fast.cof, COUPLED.mu_0, rtol=1e-9)  # 2 v_c: all slip along the pull


def test_a_step_that_does_not_converge_stops_the_run():
    with pytest.raises(NotConverged, match="normal problem is off by"):
        pressure(lambda p: BODY.displacement(p[None], (Z,), (Z,))[0], np.ones((6, 6)), np.zeros((6, 6)), 1e-12, most=2)
    with pytest.raises(NotConverged, match="friction is off by"):
        traction(
            lambda q: BODY.displacement(q, (X, Y), (X, Y)),
            np.ones((2, 6, 6)), np.ones((6, 6)), np.zeros((2, 6, 6)), 0, most=1,
        )  # fmt: skip


def test_work_is_the_same_both_ways():
    one, two = np.random.default_rng(1).normal(size=(2, 3, 6, 6))
    assert_allclose(np.sum(one * BODY.displacement(two)), np.sum(two * BODY.displacement(one)), rtol=1e-13)
