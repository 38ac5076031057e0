"""Back to three dimensions: pressures, tractions and surfaces against Hertz, Sneddon, Boussinesq and Mindlin."""

import math
from itertools import pairwise

import numpy as np
import pytest
from conftest import SHAPES, contact
from numpy.testing import assert_allclose

import mdr
from mdr.friction.surface_fields import from_displacement, from_line_load, surface_fields
from mdr.normal.indentation import indent
from mdr.normal.partial_slip import partial_slip

BODY = mdr.Elastic(E=3e6, nu=0.3)
SOFT = mdr.StandardLinearSolid(E_inf=1e6, E_1=9e6, tau_1=1e-2, nu=0.5)
KELVIN = mdr.KelvinVoigt(E=1e6, nu=0.5, tau=5e-3)
MU_0, DEPTH = 0.4, 2e-5
FULL_SLIP = MU_0 * BODY.mindlin_ratio * DEPTH
ALL = {name: shape for name, (shape, _) in SHAPES.items()}


def within(a, *cuts, n=160):
    """Radii inside the contact, close together at tip, edge and cuts, and the weights of 2 pi int ... r dr."""
    u, weight = np.polynomial.legendre.leggauss(n)
    u, weight = 0.5 * (u + 1), 0.5 * weight
    radii, weights = [], []
    for low, high in pairwise((0.0, *(math.asin(c / a) for c in cuts), np.pi / 2)):
        t, dt = low + (high - low) * u**2 * (3 - 2 * u), (high - low) * 6 * u * (1 - u)
        radii.append(a * np.sin(t))
        weights.append(2 * np.pi * a**2 * weight * dt * np.sin(t) * np.cos(t))
    return np.concatenate(radii), np.concatenate(weights)


def off(got, expected, weight):
    """Relative difference in the mean square over the disc."""
    return math.sqrt(np.sum(weight * (got - expected) ** 2) / np.sum(weight * expected**2))


def hertz_traction(r, a, c, p_0):
    """Cattaneo (1938), Mindlin (1949): mu p_0 [sqrt(1 - r²/a²) - c/a sqrt(1 - r²/c²)]."""
    return MU_0 * p_0 * (np.sqrt(np.maximum(1 - (r / a) ** 2, 0)) - c / a * np.sqrt(np.maximum(1 - (r / c) ** 2, 0)))


# --- line loads ---


def test_line_loads_of_hertz_and_boussinesq():
    a = 1e-3
    x, (r, weight) = a * np.sin(np.linspace(0, np.pi / 2, 1001)), within(a, n=60)
    inside = r[r < 0.999 * a]
    assert_allclose(from_line_load([0, a], [7.0, 7.0], inside), 7 / (np.pi * np.sqrt(a**2 - inside**2)), rtol=1e-12)
    cone = 2 * np.arcsinh(np.sqrt((a - r) / (2 * r))) / np.pi  # arcosh(a/r)/π, in which a/r would lose the edge
    assert_allclose(from_line_load([0, a], [a, 0.0], r), cone, rtol=1e-12)
    got = from_line_load(x, a**2 - x**2, r)
    # knots h = a/636 apart; the first straight line is a blunt cone, h/π ln(h/r), with r down to 1e-12 a
    assert_allclose(got, 2 / np.pi * np.sqrt(a**2 - r**2), atol=0.01 * a)
    assert off(got, 2 / np.pi * np.sqrt(a**2 - r**2), weight) < 2e-4
    assert np.all(from_line_load(x, a**2 - x**2, [a, 2 * a]) == 0)
    assert np.isfinite(from_line_load([0, a], [a, 0.0], 0.0))


def test_displacements_of_a_cone_and_a_punch():
    a, d = 1e-3, 2e-5
    r = a * np.array([0.0, 0.3, 0.9, 1.0, 1.5, 4.0])
    assert_allclose(
        from_displacement([0, a], [d, d], r), d * np.where(r <= a, 1, 2 / np.pi * np.arcsin(a / np.maximum(r, a)))
    )
    cone = mdr.Cone(theta=math.atan(2 * d / (np.pi * a)))
    assert_allclose(from_displacement([0, a], [d, 0.0], r[:4]), d - cone.profile_3d(r[:4]), atol=1e-13 * d)


# --- from an indentation ---


@pytest.mark.parametrize("shape", ALL)
def test_pressure_of_an_indentation_is_the_shapes(shape):
    run = indent(ALL[shape], BODY, [0, 1], [0, DEPTH], record=True)
    a = float(ALL[shape].contact_radius(DEPTH))
    r, weight = within(a)
    found = surface_fields(run, r)
    # straight lines between 3000 knots: a few 1e-5 where g is curved, rounding where it is straight
    assert off(found.pressure, ALL[shape].pressure(r, DEPTH, BODY.E_star), weight) < 1e-4
    assert np.sum(weight * found.pressure) == pytest.approx(run.F_z[-1], rel=1e-6)  # the quadrature over r
    assert_allclose(found.u_z, DEPTH - ALL[shape].profile_3d(r), atol=2e-5 * DEPTH)
    assert found.contact_radius == pytest.approx(a, rel=1e-12)


@pytest.mark.parametrize("body", [SOFT, KELVIN], ids=["standard", "Kelvin"])
@pytest.mark.parametrize("shape", ["cone", "paraboloid"])
def test_a_body_with_memory_stays_within_contact_mechanics(body, shape):
    """Throughout press and release p adds up to the force, is nowhere tensile, and keeps the surface on the shape."""
    t = np.linspace(0, 0.02, 401)
    run = indent(ALL[shape], body, t, DEPTH * np.sin(np.pi * t / 0.02), record=True)
    g = ALL[shape].profile_3d
    for i in (50, 150, 210, 240):
        found = surface_fields(run, i=i)
        a = found.contact_radius
        r, weight = within(a)
        at = surface_fields(run, r, i=i)
        assert np.sum(weight * at.pressure) == pytest.approx(run.F_z[i], rel=1e-4)  # knots are logarithms under the sum
        assert at.pressure.min() >= 0
        assert_allclose(at.u_z, run.u_z[i] - g(r), atol=1e-3 * DEPTH)
        outside = found.r > 1.01 * a
        assert np.all(found.u_z[outside] > run.u_z[i] - g(found.r[outside]) - 1e-4 * DEPTH)


# --- from a partial slip ---


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_traction_is_cattaneos_and_mindlins(share):
    R = 5e-3
    a, p_0 = math.sqrt(R * DEPTH), 2 / np.pi * BODY.E_star * math.sqrt(DEPTH / R)
    pulled = partial_slip(mdr.Paraboloid(R=R), BODY, MU_0, DEPTH, [0.0, share * FULL_SLIP])
    c = a * math.sqrt(1 - share)
    r, weight = within(a, c)
    found = surface_fields(pulled, r, i=1)
    assert found.stick_radius == pytest.approx(c, rel=1e-12)
    assert_allclose(found.traction, hertz_traction(r, a, c, p_0), atol=1e-12 * MU_0 * p_0)
    assert np.sum(weight * found.traction) == pytest.approx(pulled.F_x[1], rel=1e-6)
    inside = r < c
    assert_allclose(found.u_x[inside], share * FULL_SLIP, rtol=1e-12)  # the disc that sticks moves as one


# --- from a run ---


@pytest.fixture(scope="module")
def pulled_run():
    """From rest, at hardly any oscillation: in one period the body moves by 0.6 of full slip."""
    omega = 300.0
    case = contact("paraboloid", 1e3, du_z=1e-3 * DEPTH, omega=omega, mu_0=MU_0, nu=BODY.nu, E=BODY.E)
    v_0 = 0.6 * FULL_SLIP * omega / (2 * np.pi)
    return mdr.slide(case, v_0, n_springs=2048, steps_per_period=256, n_periods=1, start="rest", record=1, lump=False)


def test_a_run_from_rest_draws_cattaneos_traction(pulled_run):
    run = pulled_run
    R, d = 5e-3, float(run.u_z[-1])
    a, p_0 = math.sqrt(R * d), 2 / np.pi * BODY.E_star * math.sqrt(d / R)
    u_x = float(run.u_x[-1])
    c = math.sqrt(R * (d - u_x / (MU_0 * BODY.mindlin_ratio)))
    r, weight = within(a, c)
    found = surface_fields(run, r)
    spacing = a / (2048 // 8)  # of the core, which gets an eighth of the springs
    assert found.stick_radius == pytest.approx(c, abs=spacing)
    assert found.contact_radius == pytest.approx(a, abs=spacing)
    assert off(found.pressure, p_0 * np.sqrt(1 - (r / a) ** 2), weight) < 1e-3
    # du_z/u_z0 = 1e-3 lets the edge slip and stick, and kinks lie within cells of a/256: (1/256)^(3/2) of the radius
    assert off(found.traction, hertz_traction(r, a, c, p_0), weight) < 3e-3
    assert np.sum(weight * found.pressure) == pytest.approx(run.F_z[-1], rel=1e-5)
    assert np.sum(weight * found.traction) == pytest.approx(run.F_x[-1], rel=1e-4)
    assert_allclose(found.u_z, d - r**2 / (2 * R), atol=1e-4 * d)


def test_an_indenter_that_does_not_touch_presses_nowhere():
    """What is left then is the surface, which stands still where it was and relaxes where it has memory."""
    t, u_z = [0.0, 1e-3, 2e-3, 1.0], [0.0, DEPTH, -DEPTH, -DEPTH]
    run = indent(mdr.Paraboloid(5e-3), SOFT, t, u_z, record=True)
    pressed, left, late = (surface_fields(run, r=[0.0, 1e-4, 5e-4], i=i) for i in (1, 2, 3))
    assert left.contact_radius == 0
    assert np.all(left.pressure == 0)
    assert 0 < left.u_z[0] < pressed.u_z[0]
    assert abs(late.u_z[0]) < 1e-3 * left.u_z[0]


def test_what_is_refused(pulled_run):
    with pytest.raises(ValueError, match="ascend"):
        from_line_load([1.0, 0.5], [1.0, 0.0], 0.1)
    with pytest.raises(ValueError, match="one length"):
        from_displacement([0.0, 0.5], [1.0], 0.1)
    with pytest.raises(IndexError):
        surface_fields(pulled_run, i=10**6)


def test_the_rim_of_a_punch_that_sticks_bears_no_more_traction_than_friction_gives():
    """Its stick radius is its contact radius, but for a rounding, on either side of which p is 0 or huge."""
    d = 1e-12 * np.linspace(0, 2, 17)
    shape, E_star = mdr.FromForce(d, 5.668e3 * d, 1.3e11, tip="flat"), 6e10
    for u_z0 in 1e-12 * np.linspace(1, 2, 20):
        pulled = mdr.partial_slip(shape, mdr.Elastic(E_star, 0.3), 0.15, u_z0, 0.3 * u_z0 * 0.15)
        fields = mdr.surface_fields(pulled, np.append(np.linspace(0, 0.99, 20), 1.0) * pulled.stick_radius)
        assert np.all(fields.traction >= 0)
        assert np.all(fields.traction <= 0.15 * fields.pressure * (1 + 1e-12))
