"""Stick and slip under a rising force: the solution by rings against closed forms and a second solution."""

from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import ellipe, ellipk

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


@pytest.mark.parametrize(("nu", "mu_0"), [(0.3, 0.3), (0.0, 0.3), (0.0, 0.6), (0.3, 0.1)])
@pytest.mark.parametrize("coupled", [True, False])
def test_rings_of_constant_traction_stick_as_far(nu, mu_0, coupled):
    beta = BETAS[nu]
    c = stick_radius(beta, mu_0, coupled)
    below, above = (in_space(c + off, beta, mu_0, coupled) for off in (-3e-4, 3e-4))  # 1e-4 off at twice the width
    assert below["left"] > 0 > above["left"]


def test_the_ring_slips_inward_and_the_disc_has_strength_left():
    beta, mu_0 = BETAS[0.3], 0.3
    found = in_space(stick_radius(beta, mu_0), beta, mu_0, True)
    stuck = found["r"] < found["c"]
    assert np.all(np.diff(found["u_r"][~stuck]) < 1e-6)  # of 0.05 at the edge: c of these rings is 1e-4 off at most
    assert found["u_r"][-1] < -0.05
    assert np.all(found["p"] > 0)
    assert np.all(found["q"][stuck] < 1.01 * mu_0 * found["p"][stuck])  # within 1 % at the last ring, by the width


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


# --- the second solution: u_z and u_r in the middle of rings of constant p and q_r, in units of 2/E* ---


def in_space(c, beta, mu_0, coupled, n=30):
    """Tractions and u_r under a flat punch, 1 deep; left is mu_0 p - q_r of the last ring that sticks."""
    u = np.linspace(0, 1, n + 1)
    edges = np.append(c * (1 - (1 - u[:-1]) ** 3), c + (1 - c) * u**3 / (u**3 + (1 - u) ** 4))
    inner, outer, r = edges[:-1], edges[1:], (edges[1:] + edges[:-1])[:, None] / 2
    load_within = (np.clip(r, inner, outer) ** 2 - inner**2) / 2
    traction_beyond = outer - np.clip(r, inner, outer)
    sideways = under_shear(r, inner, outer)
    slips = np.eye(2 * n)[n:]
    system = np.block(
        [
            [under_disc(r, outer) - under_disc(r, inner), -beta * coupled * traction_beyond],
            [-beta * (load_within / r)[:n], sideways[:n]],
            [-mu_0 * slips, slips],
        ]
    )
    p, q = np.split(np.linalg.solve(system, np.append(np.ones(2 * n), np.zeros(2 * n))), 2)
    u_r = sideways @ q - beta * load_within @ p / r[:, 0]
    return {"r": r[:, 0], "c": c, "p": p, "q": q, "u_r": u_r, "left": mu_0 * p[n - 1] - q[n - 1]}


def under_disc(r, b):
    """u_z under unit p on r < b (Johnson 1985, 3.4)."""
    large = np.maximum(r, b)
    m = (np.minimum(r, b) / large) ** 2
    return 2 / np.pi * large * (ellipe(m) - (r > b) * (1 - m) * ellipk(m))


def under_shear(r, inner, outer):
    """u_r under unit q_r on a ring, by quadrature that crowds at r, where the kernel has a logarithm."""
    x, w = np.polynomial.legendre.leggauss(24)
    x, w = (x + 1) / 2, w / 2
    near = np.clip(r, inner, outer)
    total = 0
    for far in (np.broadcast_to(inner, near.shape), np.broadcast_to(outer, near.shape)):
        t = near[..., None] + (far - near)[..., None] * x**3
        small, m = np.minimum(r[..., None], t), (np.minimum(r[..., None], t) / np.maximum(r[..., None], t)) ** 2
        kernel = 2 / (np.pi * small) * (ellipk(m) - ellipe(m))  # int J1(kr) J1(kt) dk
        total = total + np.abs(far - near) * np.sum(3 * x**2 * w * t * kernel, axis=-1)
    return total
