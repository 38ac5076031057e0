"""A rough face by its mean: proportional load and stiffness, and what springs make of them along the surface."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

E_STAR, FOLD, LOAD = 4e6, 0.5e-6, 10.0
FACE = mdr.RoughFace.under_load(LOAD, FOLD, E_STAR)
F_0 = LOAD / 1000
RUBBER = mdr.Elastic(E=3e6, nu=0.5)


def test_the_load_grows_e_fold_over_its_length_and_stiffness_is_proportional():
    d = FOLD * np.array([0.5, 3.0, 7.0, 9.0])
    F = FACE.force(d, E_STAR)
    assert_allclose(F, F_0 * np.expm1(d / FOLD), rtol=1e-12)
    assert_allclose(FACE.stiffness(d, E_STAR), (F + F_0) / FOLD, rtol=1e-12)
    assert FACE.contact_radius(0.0) == 0


def test_partial_slip_leaves_an_exponential_of_the_displacement():
    mu_0, d = 0.3, 7 * FOLD
    deflection = mu_0 * RUBBER.mindlin_ratio * FOLD
    u_x = deflection * np.array([0.1, 1.0, 3.0])
    slid = mdr.partial_slip(FACE, RUBBER, mu_0, u_z0=d, u_x=u_x)
    F = FACE.force(d, RUBBER.E_star)
    assert_allclose(slid.F_x, mu_0 * (F + F_0) * -np.expm1(-u_x / deflection), rtol=1e-12)


def test_two_forces_make_it():
    face = mdr.RoughFace.from_forces(2 * FOLD, LOAD, LOAD * (np.exp(2) + 1e-3 * np.expm1(2)), E_STAR)
    assert_allclose((face.l_e, face.a_0), (FACE.l_e, FACE.a_0), rtol=1e-14)
    with pytest.raises(ValueError, match="F_2 must be above 2"):
        mdr.RoughFace.from_forces(FOLD, 2.0, 1.0, E_STAR)


def test_the_patch_of_first_touch_does_not_matter_to_friction():
    cofs = []
    for share in (1.0, 0.1):
        face = mdr.RoughFace(FOLD, share * FACE.a_0)
        d = float(mdr.static_depth(face, RUBBER, LOAD))
        case = mdr.SlidingContact(face, RUBBER, 0.3, mdr.NormalOscillation(d, 0.2 * FOLD, 300.0))
        cofs.append(mdr.slide(case, 0.4 * case.unit_velocity).cof)
        assert not mdr.plausibility(case)  # its radius is not that of a body
    assert_allclose(cofs[0], cofs[1], rtol=2e-3)  # a thousandth of the load
    with pytest.raises(ValueError, match="acts on an area of contact, which RoughFace does not know"):
        replace(case, tau_0=1e3)
