"""What coupling does to friction: closed forms and invariances, and a small run in three dimensions beside the law."""

import math
from dataclasses import replace

import pytest
from numpy.testing import assert_allclose

import mdr

SHAKEN = mdr.NormalOscillation(u_z0=20e-6, du_z=6e-6, omega=300.0)
BALL = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.3), 0.3, SHAKEN)


def test_the_rub_is_the_radial_velocity_of_the_edge_over_eq_1():
    """A depth d of a flat punch moves the edge by d (1 - 2 nu)/(pi (1 - nu)) (Johnson 1985, Eq. 3.37 at r = a)."""
    nu, a, d, E = 0.3, 1e-3, 1e-6, 3e6
    load = 2 * E / (1 - nu**2) * a * d
    radial = (1 - 2 * nu) * (1 + nu) / (2 * math.pi * E * a) * load
    kappa = (2 - nu) / (2 * (1 - nu))
    assert_allclose(mdr.laws.radial_rub(BALL), radial / (0.3 * kappa * d), rtol=1e-14)


def test_nothing_is_lost_where_bodies_are_alike_or_incompressible():
    for material in (mdr.Elastic(E=3e6, nu=0.5), mdr.ElasticPair(E_1=3e6, nu_1=0.3, E_2=3e6, nu_2=0.3)):
        case = replace(BALL, material=material)
        assert mdr.laws.radial_rub(case) == mdr.laws.coupling_loss(case) == 0
        assert mdr.laws.coupled_critical_velocity(case) == mdr.full_slip_critical_velocity(case)


def test_only_groups_count():
    same = replace(BALL, indenter=mdr.Paraboloid(R=2e-2), material=mdr.Elastic(E=2e9, nu=0.3))
    one, two = mdr.ElasticPair(E_1=3e6, nu_1=0.1, E_2=5e6, nu_2=0.4), mdr.ElasticPair(5e6, 0.4, 3e6, 0.1)
    assert_allclose(mdr.laws.coupling_loss(same), mdr.laws.coupling_loss(BALL), rtol=1e-12)
    assert_allclose(
        mdr.laws.coupling_loss(replace(BALL, material=one)), mdr.laws.coupling_loss(replace(BALL, material=two))
    )


def test_stick_ends_later_with_coupling():
    v_c, beta, kappa = mdr.critical_velocity(BALL), BALL.material.dundurs_beta, BALL.material.mindlin_ratio
    later = (0.3 * kappa + 2 * beta / math.pi) * SHAKEN.du_z * SHAKEN.omega
    assert_allclose(mdr.laws.coupled_critical_velocity(BALL), later, rtol=1e-12)
    assert later > 1.3 * v_c


@pytest.mark.parametrize(("change", "words"), [
    ({"pull": mdr.SpringPull(k_x=1e4)}, "a rigid pull, got pull = SpringPull"),
    ({"oscillation": mdr.LoadOscillation(F_z0=0.1, dF_z=0.03, omega=300.0)}, "harmonic depth, got oscillation = Load"),
    ({"oscillation": mdr.NormalOscillation(u_z0=-1e-6, du_z=6e-6, omega=300.0)}, "above 0, got working_depth = -1e-06"),
    ({"material": mdr.StandardLinearSolid(E_inf=3e6, E_1=3e6, tau_1=1e-3, nu=0.3)}, "Kelvin material, got material"),
    ({"material": mdr.Elastic(E=3e6, nu=-0.5)}, "beta.* <= 0.5, got material.dundurs_beta = 0.66"),
    ({"mu_0": 1e-3}, "lambda = .* <= 3.2, got mu_0 = 0.001"),
])  # fmt: skip
def test_what_was_not_computed_is_refused(change, words):
    case = replace(BALL, **change)
    for ask in (mdr.laws.coupled_critical_velocity, mdr.laws.coupling_loss):
        with pytest.raises(ValueError, match=words):
            ask(case)
    assert "may still stick above" in mdr.verdict(case, limit_s=1e-3).why  # without a measurement


@pytest.mark.parametrize(("nu", "mu_0", "alpha", "words"), [
    (0.3, 0.3, 0.3, "by up to about 0.03 of mu_0, and part of the contact sticks up to about 1.50 times"),
    (0.45, 0.3, 0.3, "by up to about 0.004 of mu_0, and part of the contact sticks up to about 1.14 times"),
    (0.3, 0.3, 0.001, "by up to about 0.0001 of mu_0, and part of the contact sticks up to about 1.50 times"),
    (0.0, 0.1, 0.3, "of mu_0 (more than half as much again under a flat face), and"),
    (0.495, 0.3, 0.3, None),
    (0.5, 0.3, 0.3, None),
])  # fmt: skip
def test_the_verdict_says_how_much(nu, mu_0, alpha, words):
    shaken = replace(SHAKEN, du_z=alpha * SHAKEN.u_z0)
    case = replace(BALL, mu_0=mu_0, material=mdr.Elastic(E=3e6, nu=nu), oscillation=shaken)
    why = mdr.verdict(case, limit_s=1e-3).why
    assert "coupling" not in why if words is None else words in why
