"""A pull at fixed depth: Cattaneo-Mindlin, Mindlin-Deresiewicz, and springs that stick and slip one by one."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from twins.path import followed

import mdr
from mdr.files.examples import SHAPES
from mdr.normal.partial_slip import partial_slip, tangential_loop

BODY = mdr.Elastic(E=3e6, nu=0.3)
MU_0, DEPTH = 0.4, 2e-5
KINKED = mdr.Profile(lambda r: 0.02 * r + 0.05 * np.maximum(r - 3e-4, 0), kinks=(3e-4,))
ALL = SHAPES | {"kinked": KINKED}
del ALL["ConcavePunch"]  # a ring of it sticks, which is refused
FULL_SLIP = MU_0 * BODY.mindlin_ratio * DEPTH  #: displacement from which every spring slips


def spring_by_spring(indenter, u_x, n=4000):
    """Tangential force [N] along a rising u_x, by n elastic springs in equal cells of x, at their mean depths."""
    a = float(indenter.contact_radius(DEPTH))
    x = a * np.linspace(0, 1, n + 1)
    gap = np.diff(np.asarray(indenter.profile_area(x))) / np.diff(x)
    path = np.stack([u_x, 0 * u_x, np.full(u_x.shape, DEPTH)], axis=1)
    forces, _ = followed(gap, u_x, path, MU_0 * BODY.mindlin_ratio, parts=1)
    return MU_0 * 2 * a * BODY.E_star * forces[:, 0]


@pytest.mark.parametrize("shape", ALL)
def test_a_pull_is_that_of_springs_that_slip_one_by_one(shape):
    u_x = FULL_SLIP * np.linspace(0, 1.1, 12)
    pulled = partial_slip(ALL[shape], BODY, MU_0, DEPTH, u_x)
    # a cell in which g rises by dg slips at once instead of one part after the other: (dg/d)²/8 of its share
    assert_allclose(spring_by_spring(ALL[shape], u_x), pulled.F_x, atol=2e-7 * MU_0 * pulled.F_z)


def test_the_punch_sticks_as_a_whole():
    pulled = partial_slip(mdr.FlatPunch(a=1e-3), BODY, MU_0, DEPTH, FULL_SLIP * np.array([0.5, 0.999, 1.001]))
    assert_allclose(pulled.stick_radius, [1e-3, 1e-3, 0])
    assert_allclose(pulled.F_x / (MU_0 * pulled.F_z), [0.5, 0.999, 1], rtol=1e-12)


@pytest.mark.parametrize("shape", ALL)
@pytest.mark.parametrize("share", [0.3, 1.2])
def test_a_loop_closes_and_costs_its_area(shape, share):
    loop = tangential_loop(ALL[shape], BODY, MU_0, DEPTH, share * FULL_SLIP, n=2001)
    assert loop.u_x[0] == loop.u_x[-1]
    assert loop.F_x[0] == pytest.approx(loop.F_x[-1])
    area = -float(np.sum(np.diff(loop.u_x) * (loop.F_x[1:] + loop.F_x[:-1]) / 2))
    # trapezoids on 2000 steps: (pi/4000)²/3 of the rectangle 4 U F around the loop
    rectangle = 4 * loop.u_x[0] * loop.F_x[0]
    assert abs(loop.loss) == pytest.approx(abs(area), abs=5e-7 * rectangle)


def test_answers_come_in_the_shape_of_the_question():
    pulled = partial_slip(mdr.Cone(theta=0.02), BODY, MU_0, DEPTH, np.zeros((2, 3)))
    assert pulled.F_x.shape == pulled.stick_radius.shape == (2, 3)
    assert isinstance(pulled.F_z, float)
    assert isinstance(partial_slip(mdr.Cone(theta=0.02), BODY, MU_0, DEPTH, 1e-6).F_x, float)
    assert pulled == partial_slip(mdr.Cone(theta=0.02), BODY, MU_0, DEPTH, np.zeros((2, 3)))


@pytest.mark.filterwarnings("error")
def test_a_way_beyond_all_others_is_full_slip_or_refused():
    cone = mdr.Cone(theta=0.02)
    far = partial_slip(cone, BODY, 1e-200, DEPTH, 1e200)  # u_x/mu_0 is beyond the range of floats
    assert (far.stick_radius, far.F_x) == (0, 1e-200 * far.F_z)
    for mu_0, U in ((1e300, 1e200), (MU_0, 1e308)):
        with pytest.raises(ValueError, match=r"a loop of u_x = 1e\+\d+ m is beyond the range of floats"):
            tangential_loop(cone, BODY, mu_0, DEPTH, U)


def test_hertz_is_cattaneo_and_mindlin():
    R = 5e-3
    a, F_N = math.sqrt(R * DEPTH), 4 / 3 * BODY.E_star * math.sqrt(R) * DEPTH**1.5
    share = np.array([0.0, 0.3, 0.9, 1.0])
    u_x = (
        3 * MU_0 * F_N / (4 * BODY.G_star * a) * (1 - (1 - share) ** (2 / 3))
    )  # 1/G* = (2 - nu)/(4 G): 3/16 (2 - nu)/G
    pulled = partial_slip(mdr.Paraboloid(R=R), BODY, MU_0, DEPTH, u_x)
    assert_allclose(pulled.F_z, F_N, rtol=1e-13)
    assert_allclose(pulled.F_x, share * MU_0 * F_N, rtol=1e-12, atol=1e-13 * F_N)
    assert_allclose(pulled.stick_radius, a * (1 - share) ** (1 / 3), rtol=1e-9, atol=1e-5 * a)  # a root at full slip
