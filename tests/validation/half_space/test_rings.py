"""Stick and slip under a rising force: the solution by rings against closed forms; beside the half-space: the judge."""

from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from validation.half_space import rings
from validation.half_space.rings import bonded_force, goodman

BETAS = {nu: (1 - 2 * nu) / (2 * (1 - nu)) for nu in (0.0, 0.15, 0.3, 0.45)}
stick_radius = cache(rings.stick_radius)  # many tests ask for the same
EVERY = [(BETAS[nu], mu_0) for nu in (0.0, 0.45) for mu_0 in (0.1, 0.6)]


@pytest.mark.parametrize(("beta", "mu_0"), EVERY)
def test_without_the_coupling_to_the_pressure_it_is_goodmans(beta, mu_0):
    # the nodes end exp(-12) = 6e-6 of 1 - c before the edge; phi = 1 is exact on any nodes
    assert_allclose(stick_radius(beta, mu_0, coupled=False), goodman(beta, mu_0), atol=6e-6)


@pytest.mark.parametrize(("nu", "c"), [(0.3, 0.919), (0.0, 0.627)])
def test_goodmans_radius_of_stick(nu, c):
    assert_allclose(goodman(BETAS[nu], 0.3), c, atol=5e-4)  # three digits are given


@pytest.mark.parametrize("nu", BETAS)
def test_the_force_on_a_bonded_punch_is_mossakovskiis(nu):
    known = np.log(3 - 4 * nu) * (1 - nu) / (1 - 2 * nu)
    assert_allclose(bonded_force(BETAS[nu]), known, rtol=4e-5)  # twice the 2e-5 by which nu = 0 differs


@pytest.mark.parametrize(("beta", "mu_0"), EVERY)
def test_more_nodes_change_little(beta, mu_0):
    coarse, plain, fine = (stick_radius(beta, mu_0, nodes=n) for n in (50, 100, 200))
    assert abs(fine - plain) < 2e-5  # the accuracy that the module states
    assert abs(fine - plain) < abs(plain - coarse) / 2 + 1e-7  # a linear f on nodes is of the second order, nearly


def test_the_disc_grows_with_friction_and_shrinks_with_beta():
    for coupled in (True, False):
        c = np.array([[stick_radius(beta, mu_0, coupled) for mu_0 in (0.03, 0.3, 2)] for beta in BETAS.values()])
        assert np.all(np.diff(c, axis=1) > 0)
        assert np.all(np.diff(c, axis=0) > 0)  # beta falls as nu rises


@pytest.mark.parametrize("wrong", [-0.1, np.nan, np.inf])
def test_what_no_body_has_is_refused(wrong):
    for asked in (lambda beta: stick_radius(beta, 0.3), lambda beta: goodman(beta, 0.3), bonded_force):
        for beta in (wrong, 0.76):
            with pytest.raises(ValueError, match="beta"):
                asked(beta)
    for asked in (stick_radius, goodman):
        for mu_0 in (wrong, 0):
            with pytest.raises(ValueError, match="mu_0"):
                asked(0.3, mu_0)
