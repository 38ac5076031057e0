"""The closed form of a rigid pull against the twin, the march, its own asymptotics, and the definition of friction."""

import math

import numpy as np
import pytest
from conftest import SHAPES, contact, unit_of_velocity
from numpy.testing import assert_allclose
from twins import rigid_pull as reference

import mdr
from mdr.closed_forms import rigid_pull
from mdr.closed_forms.rigid_pull import average_friction
from mdr.indenters.mapping.quadrature import double_exponential

KELVIN_BUDGET, ELASTIC_BUDGET = 1e-8, 1e-10


def friction(case, v_hat):
    found = average_friction(case, np.asarray(v_hat) * unit_of_velocity(case))
    return found.cof / case.mu_0, found.cof_error / case.mu_0, found.stick_share


def refined_elastic(n, depth_ratio, v_hat):
    return reference.rigid_elastic_cof(n, depth_ratio, v_hat, n_nodes=60, levels=4)


# --- the value --------------------------------------------------------------------------------------------------


def test_eighty_elastic_contacts_against_the_twin():
    rng = np.random.default_rng(7)
    worst = []
    for _ in range(80):
        shape = rng.choice(list(SHAPES))
        depth_ratio = 1 / rng.uniform(0.01, 50) if rng.random() < 0.8 else -rng.uniform(0, 0.9)
        v_hat = rng.choice([10 ** rng.uniform(-4, 0), rng.uniform(0, 1), 1 - 10 ** rng.uniform(-4, 0)])
        cof, error, _ = friction(contact(shape, depth_ratio), v_hat)
        twin = refined_elastic(SHAPES[shape][1], depth_ratio, v_hat)
        worst.append(abs(cof - twin))
        assert abs(cof - twin) <= error + 1e-12, (shape, depth_ratio, v_hat)  # the twin's own quadrature
    assert max(worst) <= ELASTIC_BUDGET


@pytest.mark.parametrize("T", [0.0, 0.7])
def test_above_v_c_friction_is_full_and_nothing_sticks(T):
    cof, error, sticks = friction(contact("cone", 2.0, T), [1.0, 1.3, 1e6])
    assert np.all(cof == 1)
    assert np.all(sticks == 0)
    assert np.all(error < 1e-12)


@pytest.mark.parametrize("T", [1e-9, 1e-5])
def test_a_fast_material_is_elastic(T):
    for shape in ("cone", "flat"):
        v_hat = np.array([0.1, 0.6])
        fast, elastic = friction(contact(shape, 0.8, T), v_hat)[0], friction(contact(shape, 0.8), v_hat)[0]
        assert_allclose(fast, elastic, rtol=0, atol=4 * T)


def test_a_shape_with_a_kink_and_a_rim_against_a_sum_over_its_springs():
    """A cone of two slopes on a punch of finite radius; g is known in closed form piece by piece."""
    b, rim, slope = 0.6e-3, 1.1e-3, 0.01
    shape = mdr.Profile(
        lambda r: slope * r + 2 * slope * np.maximum(r - b, 0), kinks=(b,), r_max=rim, name="two slopes"
    )
    du_z, u_z0 = 12e-6, 24e-6  # passes the kink and the rim, and loses contact nowhere else

    def g(x):
        beyond = np.maximum(x, b)
        return np.pi / 2 * slope * x + 2 * slope * beyond * np.arccos(b / beyond)

    case = mdr.SlidingContact(shape, mdr.Elastic(3e6, 0.4), 0.4, mdr.NormalOscillation(u_z0, du_z, 300.0))
    assert g(b) < u_z0 + du_z
    for v_hat in (0.2, 0.7):
        edge = math.sqrt(1 - v_hat**2)
        marks = [case.indenter.contact_radius(u_z0 - h * du_z) for h in (-1.0, -edge, 0.0, edge, 1.0)]
        breaks = np.unique([0.0, b, rim, *marks])
        x, w = reference.gauss_panels(reference.graded(breaks, 0.1, 6), 30)
        h = (u_z0 - g(x)) / du_z
        twin = 1 - reference.elastic_lag(h, v_hat) @ w / (reference.mean_compression(h, 0.0) @ w)
        assert_allclose(friction(case, v_hat)[0], twin, rtol=0, atol=2e-9)  # Profile maps to 1e-9


def test_the_stick_of_the_punch_in_closed_form():
    """Elastic, contact kept: the stick runs from phi_1 to phi_2, and the force is u_z0 + du_z cos phi."""
    v_hat, depth_ratio = 0.3, 4.0
    phi_1 = math.pi + math.asin(v_hat)
    phi_2 = float(reference.elastic_stick(np.array([depth_ratio]), v_hat)[1][0])
    share = (depth_ratio * (phi_2 - phi_1) + math.sin(phi_2) - math.sin(phi_1)) / (2 * math.pi * depth_ratio)
    assert_allclose(friction(contact("flat", depth_ratio), v_hat)[2], share, rtol=1e-12)


# --- the curve, and wrong input ---------------------------------------------------------------------------------


def test_a_curve_takes_the_closed_form_by_itself():
    case = contact("paraboloid", 3.0, 0.5)
    v_0 = unit_of_velocity(case) * np.array([[0.0, 0.4, 1.2]])[0]
    curve, known = mdr.cof_curve(case, v_0), average_friction(case, v_0[1:])
    assert np.array_equal(curve.cof[1:], known.cof)
    assert np.array_equal(curve.stick_share[1:], known.stick_share)
    assert np.all(curve.cof_error[1:] <= KELVIN_BUDGET * case.mu_0)
    assert curve.cof[0] == mdr.static_cof(case)
    assert curve.settled.all()
    assert curve.why == ("", "", "")


@pytest.mark.parametrize("dip", [1e-4, 1e-8, 1e-10])
@pytest.mark.parametrize("T", [0.0, 5e-6])
def test_a_contact_of_an_instant_sticks_for_no_more_than_all_of_it(T, dip):
    share = friction(contact("cone", dip - 1, T), np.geomspace(1e-9, 10, 40))[2]
    assert np.all((share >= 0) & (share <= 1))


@pytest.mark.parametrize("dip", [1e-3, 1e-6, 1e-9, 5.6e-11])
@pytest.mark.parametrize("T", [0.0, 0.5])
@pytest.mark.parametrize("shaken", ["still", "little", "much"])
def test_a_contact_of_an_instant_is_the_same_in_other_units_within_its_error(T, dip, shaken):
    """u_z0 and du_z all but cancel, and what their digits lose is in no quadrature."""
    material, found = mdr.KelvinVoigt(3e6, 0.4, T / 300) if T else mdr.Elastic(3e6, 0.4), []
    for unit in (1.0, *np.random.default_rng(1).uniform(0.3, 3, 6)):
        motion = mdr.NormalOscillation(2e-6 * unit * (dip - 1), 2e-6 * unit, 300.0)
        du_x = unit * {"still": 0.0, "little": 3e-7 * dip, "much": 1.1e-5}[shaken]
        shake = mdr.InPlaneOscillation(300.0, du_x) if du_x else None
        case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3 * unit), material, 0.5, motion, shake=shake)
        v_0 = np.array([0.05, 0.3, 0.8]) * np.sqrt(2 * dip) * 1e-4 * unit
        curve = mdr.cof_curve(case, np.append(v_0, 2e-2 * unit))
        found.append((curve.cof, curve.cof_error))
    (first, *others), (error, *errors) = zip(*found, strict=True)
    if shaken != "much":
        assert np.all(error[:3] < 1e-8 + 4e-15 / dip)
    for cof, its in zip(others, errors, strict=True):
        assert np.all(np.abs(cof - first) <= error + its)


@pytest.mark.parametrize("T", [0.05, 0.3, 3.0])
@pytest.mark.parametrize("depth_ratio", [2.0, 0.5, -0.5])
def test_down_to_the_slowest_pull_friction_comes_to_the_static_one(depth_ratio, T):
    """By the power 2/3 at least; slower ones, whose stick is a period but for rounding, are refused."""
    case = contact("paraboloid", depth_ratio, T)
    unit, static = unit_of_velocity(case), mdr.static_cof(case) / case.mu_0
    v_hat = np.geomspace(1.001e-15, 1e-9, 13)
    off = friction(case, v_hat)[0] - static
    assert np.all((off > -1e-12) & (off <= 2 * off[-1] * (v_hat / 1e-9) ** (2 / 3) + 1e-12))
    with pytest.raises(ValueError, match="ask static_cof"):
        average_friction(case, 0.9e-15 * unit)


def wavy(r):
    return r**2 / 1e-2 + 2e-5 * np.sin(r / 4e-3 * 9) ** 2


PIECES = {
    "force": (mdr.FromForce(1e-4 * np.arange(25), np.arange(25) + 0.1 * np.arange(25) ** 2, 1e6), -1e-3, 3e-3),
    "profile": (mdr.SampledProfile(np.linspace(0, 4e-3, 20), wavy(np.linspace(0, 4e-3, 20))), 1e-4, 5e-4),
}


@pytest.mark.parametrize("T", [0.0, 0.3])
@pytest.mark.parametrize("shape", PIECES)
def test_a_shape_in_pieces_is_as_exact_as_any(shape, T):
    """A spline is not smooth enough for a rule that stretches over its knots."""
    indenter, u_z0, du_z = PIECES[shape]
    case = mdr.SlidingContact(
        indenter, mdr.KelvinVoigt(1e6, 0.3, T / 300), 0.5, mdr.NormalOscillation(u_z0, du_z * 0.75, 300.0)
    )
    v_0 = case.unit_velocity * np.array([1e-9, 1e-3, 0.1, 0.5])
    found = average_friction(case, v_0)
    exact = 0.5 * (1 - rigid_pull._integrals(case, v_0 / case.unit_velocity, double_exponential(0.03))[0])
    assert np.all(np.abs(found.cof - exact) <= found.cof_error)
    assert np.all(found.cof_error <= 1e-10)
