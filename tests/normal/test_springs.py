"""The springs stand where sums over them are exact, however thin the edge band is."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import SHAPES, bowl, contact
from numpy.testing import assert_allclose
from twins import rigid_pull as reference

import mdr
from mdr.normal.springs import MIN_SPRINGS, SpringArray

U_Z0 = 20e-6
AMPLITUDES = [1e-9, 1e-6, 1e-3, 0.1, 0.9, 1.7]  # du_z/u_z0
RELAXATION = [0.0, 1.0, 10.0]
KNOTTED = mdr.Profile(lambda r: np.maximum(r - 1e-4, 0) ** 2 / 1e-2, kinks=(1e-4,), name="rounded punch")


def case_of(shape, alpha, T):
    return contact(shape, 1 / alpha, T, du_z=alpha * U_Z0)


def assert_sums_are_exact(case, springs, rtol=1e-12):
    """At the depths at whose radii the row is cut: greatest, and least of the springs that never lose contact.

    A sum of 128 terms is good to 128 roundings at most, and the tolerance is what was asked.
    """
    indenter, E_star, u_z0 = case.indenter, case.material.E_star, case.oscillation.u_z0
    for u_z in (u_z0 + case.kept_gap * case.oscillation.du_z, case.u_z_max):
        if u_z > 0:
            assert_allclose(springs.normal_stiffness(u_z, u_z0), indenter.stiffness(u_z, E_star), rtol=rtol)
            assert_allclose(springs.normal_force(u_z, u_z0), indenter.force(u_z, E_star), rtol=rtol)


@pytest.mark.parametrize("T", RELAXATION)
@pytest.mark.parametrize("alpha", AMPLITUDES)
@pytest.mark.parametrize("shape", SHAPES)
def test_sums_are_exact_at_the_depths_of_the_cuts(shape, alpha, T):
    case = case_of(shape, alpha, T)
    for n in (MIN_SPRINGS, 128):
        assert_sums_are_exact(case, SpringArray.of(case, n))


@pytest.mark.parametrize(("alpha", "T"), [(1e-6, 1.0), (1.7, 0.0)])
@pytest.mark.parametrize("profile", [mdr.Profile(bowl, name="bowl"), KNOTTED], ids=lambda shape: shape.name)
def test_sums_are_exact_for_a_profile(profile, alpha, T):
    case = case_of(profile, alpha, T)
    # a stretch of a profile is as good as its quadrature, whose documented error is 1e-9
    assert_sums_are_exact(case, SpringArray.of(case, 64), rtol=1e-9)


@pytest.mark.parametrize("T", RELAXATION)
@pytest.mark.parametrize("depth_ratio", [1e6, 10.0, 0.6, -0.3])
@pytest.mark.parametrize("shape", SHAPES)
def test_the_row_reaches_from_the_centre_to_the_edge_of_the_largest_contact(shape, depth_ratio, T):
    case = contact(shape, depth_ratio, T)
    springs = SpringArray.of(case, 100)
    assert springs.x.shape == springs.gap.shape == springs.width.shape == (100,)
    a = float(case.indenter.contact_radius(case.u_z_max))
    assert np.all(springs.width > 0)
    assert np.all(np.diff(springs.x) > 0)
    assert springs.x[0] > 0
    assert springs.x[-1] < a
    assert_allclose(springs.width.sum() / 2, a, rtol=1e-13)
    assert_allclose(springs.width @ springs.x, a**2, rtol=1e-9 if depth_ratio == 1e6 else 1e-13)
    # as far as rounding of a gap allows, which is that of the depth u_z0
    assert np.all(np.diff(springs.gap) >= -4e-16 * abs(case.oscillation.u_z0))


@pytest.mark.parametrize("T", RELAXATION)
@pytest.mark.parametrize("depth_ratio", [1e6, 30.0, 10.0, 3.0, 0.6])
@pytest.mark.parametrize("shape", SHAPES)
def test_the_core_never_leaves_and_the_next_spring_does(shape, depth_ratio, T):
    case = contact(shape, depth_ratio, T)
    springs = SpringArray.of(case, 100)
    h = -springs.gap / case.oscillation.du_z
    stays = reference.always_touches(h, T)
    assert np.all(stays[: springs.n_core])
    assert not np.any(stays[springs.n_core :])
    if depth_ratio < np.hypot(1, T):
        assert springs.n_core == 0


class Kinked(mdr.Paraboloid):
    """A paraboloid that names radii as kinks: cutting the row there changes no sum."""

    kinks = tuple(np.linspace(1e-5, 3e-4, 8))


@pytest.mark.parametrize("alpha", [1e-6, 0.1, 1.7])
def test_kinks_cut_the_row(alpha):
    case = case_of(Kinked(R=5e-3), alpha, 1.0)
    springs = SpringArray.of(case, 128)
    assert_sums_are_exact(case, springs)
    for kink in Kinked.kinks:
        assert_allclose(springs.width[springs.x < kink].sum() / 2, kink, rtol=1e-12)


def test_springs_of_one_gap_are_two_where_that_tells_what_they_bear():
    """On a level face a shear strength bears less the further out they stand."""
    b = 3e-4
    case = case_of(mdr.TruncatedCone(b=b, theta=0.02), 0.1, 0.0)
    level = [int(np.sum(SpringArray.of(replace(case, tau_0=tau_0), 64).x < b)) for tau_0 in (0.0, 1e4)]
    assert level == [2, 21]  # a third of them, as of the two other parts


def test_a_shape_of_many_kinks_needs_more_springs():
    with pytest.raises(ValueError, match=r"n_springs must be at least .* for this shape with its kinks, got 16"):
        SpringArray.of(case_of(Kinked(R=5e-3), 0.1, 0.0), 16)
