"""A step with arms, however long beside their times: the same as in many parts, of every user of it."""

import numpy as np
import pytest
from elements import BALL, DEPTH, MU_0, element
from numpy.testing import assert_allclose
from random_steps import CLOSER, walk
from twins.path import followed

import mdr

ALLOWED = 1e-3  #: of mu_0 F_z
RHO, THETA = [0.75], [3e-3]
ARM = mdr.Prony(E_inf=2e6, arms=((RHO[0] * 2e6, THETA[0]),), nu=0.3)
REACH = MU_0 * ARM.mindlin_ratio * DEPTH


@pytest.mark.parametrize("seed", range(2, 6))
def test_a_step_is_the_same_in_parts(seed):
    """Arms of 1 ns to 1000 s, steps of 1e-3 to 1e6 of their times, 1e-5 of the depth and all of it."""
    for step in walk(np.random.default_rng(seed), 5):
        F, state, heat = step.in_parts()
        assert np.isfinite(state).all()
        assert heat >= -1e-14 * step.energy(state)
        for shares in (np.linspace(0.01, 1, 100), CLOSER[::4]):
            assert step.missed(F, shares) < ALLOWED


@pytest.mark.parametrize("lift", [1.0, 0.3], ids=["rest", "lift"])
def test_what_slid_fast_and_rests_long_is_that_of_explicit_steps(lift):
    """Two fast steps, then one of 300 times of the arm; the twin is extrapolated from two numbers of parts."""
    contact, rng = element(ARM, mdr.FlatPunch(a=1e-3)), np.random.default_rng(2)
    early = 1e-3 * np.geomspace(1e-2, 1e3, 60)  # of the last step
    for _ in range(10):
        u = np.array([(0, 0, 0.95), (*rng.normal(0, 2, 2), 0.7), (*rng.normal(0, 2, 2), 0.9)])
        u = np.vstack([u, u[-1] * [1, 1, lift]]) * [REACH, REACH, DEPTH]
        state = contact.at_rest(u[0])
        for dt, to in zip((1e-3, 1e-3, 1.0), u[1:], strict=True):
            F, state = contact.step(state, dt, to)
        t, way, ends = (
            np.append([0, 1e-3, 2e-3], 2e-3 + early),
            np.vstack([u[:3], u[2] + (u[3] - u[2]) * early[:, None]]),
            [],
        )
        for parts in (100, 200):
            forces, _ = followed(np.zeros(1), t, way, MU_0 * ARM.mindlin_ratio, parts, rho=RHO, theta=THETA)
            ends.append(forces[-1] / forces[-1, 2])
        known, unsure = 2 * ends[1] - ends[0], np.abs(ends[1] - ends[0]).max()
        assert_allclose(F[:2] / (MU_0 * F[2]), known[:2], rtol=0, atol=ALLOWED + 0.1 * unsure)


def test_an_arm_of_no_time_is_none():
    """1 ns in steps of 10 ms."""
    fast, none = element(mdr.Prony(E_inf=2e6, arms=((1.5e6, 1e-9),), nu=0.3)), element(mdr.Elastic(E=2e6, nu=0.3))
    rng = np.random.default_rng(4)
    one, two = (contact.at_rest((0, 0, DEPTH / 2)) for contact in (fast, none))
    for _ in range(60):
        u = np.array([*rng.normal(0, 1, 2) * REACH, rng.uniform(0.1, 1) * DEPTH])
        (F, one), (G, two) = fast.step(one, 1e-2, u), none.step(two, 1e-2, u)
        assert_allclose(F, G, rtol=0, atol=ALLOWED * MU_0 * G[2])


def test_a_record_of_long_intervals_is_that_of_short_ones():
    """In the plane, rests of 300 times of the arm; along a line, where it is exact, the element is as the record."""
    rng = np.random.default_rng(7)
    t = np.cumsum(rng.choice([1e-3, 1.0], 12))
    x, y, z = *np.cumsum(rng.normal(0, 1, (2, 12)), axis=1) * REACH, rng.uniform(0.3, 1, 12) * DEPTH
    at = np.linspace(0, 11, 11 * 40 + 1)
    fine = mdr.slide_record(BALL, ARM, MU_0, *(np.interp(at, np.arange(12), one) for one in (t, x, y, z)), n_springs=64)
    found = mdr.slide_record(BALL, ARM, MU_0, t, x, y, z, n_springs=64)
    for one, other in ((found.F_x, fine.F_x), (found.F_y, fine.F_y)):
        assert np.abs(one - other[::40])[1:].max() < ALLOWED * MU_0 * found.F_z.min()
    assert abs(found.cof - fine.cof) + abs(found.cof_y - fine.cof_y) <= found.cof_error + fine.cof_error
    line = mdr.slide_record(BALL, ARM, MU_0, t, x, u_z=z, n_springs=64)
    contact = mdr.ContactElement(BALL, ARM, MU_0, u_z_max=line.u_z.max(), n_springs=64)
    state = contact.at_rest((x[0], 0, z[0]))
    for k in range(1, 12):
        F, state = contact.step(state, t[k] - t[k - 1], (x[k], 0, z[k]))
        assert_allclose(F[0], line.F_x[k], rtol=0, atol=2e-3 * MU_0 * F[2])  # its springs: no cut


def test_the_tangent_of_a_step_that_is_cut_is_that_of_its_force():
    """As the parts of the step stay; Newton's method of a host asks for no more."""
    contact = element(ARM)
    _, state = contact.step(contact.at_rest((0, 0, DEPTH / 2)), 1e-3, (2 * REACH, 0.5 * REACH, DEPTH / 2))
    u, scale = np.array([1.8 * REACH, 1.1 * REACH, 0.6 * DEPTH]), np.array([REACH, REACH, DEPTH])
    for dt in (1e-2, 1.0):
        _, _, K = contact.step(state, dt, u, tangent=True)
        for j in range(3):
            d = 1e-5 * scale * (np.arange(3) == j)
            known = (contact.step(state, dt, u + d)[0] - contact.step(state, dt, u - d)[0]) / (2 * d[j])
            assert_allclose(K[:, j], known, rtol=0, atol=1e-4 * np.abs(K).max())
