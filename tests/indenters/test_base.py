"""What every indenter must answer, asked once over the list of shapes."""

import math
import pickle
import warnings

import numpy as np
import pytest
from catalogue import ANY, CURVED, KINKED, SHAPES, WORN, B, depths, end, name
from numpy.testing import assert_allclose
from random_records import in_units
from scipy.integrate import quad

from mdr.indenters import Cone, FlatPunch, Paraboloid, PowerLaw, Profile, RoundedPunch
from mdr.indenters.base import Indenter
from mdr.materials import KelvinVoigt

E_STAR = 2e6
EXACT, MAP = 1e-12, 1e-9  # the accuracy promised for closed forms and for mapped profiles


def parabola(r):
    return r**2 / 1e-2


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_the_depth_about_is_of_the_size_of_the_depth(shape):
    for d in depths(shape, 1e-9, 1e-3, 5):
        assert 0.1 * d < shape.depth_about(float(shape.force(d, 1.0))) < 10 * d


def discs(a):
    """Distances from the axis, the first within the patch of first touch of a rough face."""
    return np.array([0.01, 0.3, 0.7, 0.99]) * a


@pytest.mark.parametrize("shape", CURVED, ids=name)
def test_inverse_transform_gives_f_back(shape):
    r = 1.1e-3
    points = [math.asin(b / r) for b in shape.kinks] or None
    g = quad(lambda t: float(shape.profile_1d(r * math.sin(t))), 0, math.pi / 2, epsabs=0, points=points)[0]
    assert_allclose(shape.profile_3d(r), 2 / math.pi * g, rtol=1e-9)  # quad promises 1.5e-8, but smooth g converges
    assert_allclose(Indenter._f(shape, np.array(r)), shape.profile_3d(r), rtol=MAP)


@pytest.mark.parametrize("shape", CURVED, ids=name)
def test_depth_is_g_of_the_radius(shape):
    d = depths(shape)  # from atoms to mountains: no length is special
    a = shape.contact_radius(d)
    inner, outer = shape.profile_1d(a * (1 - 4e-16)), shape.profile_1d(a * (1 + 4e-16))  # two roundings of a
    assert np.all(inner <= d * (1 + EXACT))
    assert np.all(outer >= d * (1 - EXACT))
    if shape not in WORN:  # g begins with a vertical tangent at a flat face
        assert_allclose(shape.profile_1d(a), d, rtol=EXACT)
    assert shape.contact_radius(-1.0) == shape.contact_radius(0) == 0


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_stiffness_is_the_slope_of_the_force_and_the_force_convex(shape):
    d, h = depths(shape, 1e-9, 9e-5, 9), 1e-5
    slope = (shape.force(d * (1 + h), E_STAR) - shape.force(d * (1 - h), E_STAR)) / (2 * h * d)
    assert_allclose(shape.stiffness(d, E_STAR), slope, rtol=1e-7)  # h**2 / 6 times the square of a power below 50
    F = shape.force(np.linspace(shape.least_depth, d[-1], 50), E_STAR)
    assert np.all(np.diff(F, 2) >= -1e-12 * F[-1])


@pytest.mark.parametrize("scale", [1e-9, 1e3])
@pytest.mark.parametrize("shape", ANY, ids=name)
def test_any_unit_of_length_will_do(shape, scale):
    other, near = in_units(shape, scale, 1.0, 1.0), EXACT if shape in SHAPES else 1e-11  # a spline is solved for
    d, r = np.array([2e-5, 3e-5]), np.array([[1e-5], [3e-4]])
    assert_allclose(other.profile_3d(scale * r), scale * shape.profile_3d(r), rtol=near, atol=1e-15 * scale * 1e-5)
    assert_allclose(other.profile_1d(scale * r), scale * shape.profile_1d(r), rtol=near, atol=1e-15 * scale * 1e-5)
    assert_allclose(other.contact_radius(scale * d), scale * shape.contact_radius(d), rtol=near)
    assert_allclose(other.force(scale * d, 1), scale**2 * shape.force(d, 1), rtol=near)
    near = EXACT if shape in SHAPES else 1e-7  # of a spline it is a slope, of a force a second derivative
    assert_allclose(other.pressure(scale * r, scale * d, 1), shape.pressure(r, d, 1), rtol=near)


@pytest.mark.parametrize("shape", ANY, ids=name)
def test_arrays_floats_and_mirror_images(shape):
    x, d = np.array([[1e-4], [5e-4]]), np.array([1e-5, 2e-5, 3e-5])
    assert np.array_equal(shape.profile_1d(-x), shape.profile_1d(x))
    assert shape.force(d, E_STAR).shape == (3,)
    assert shape.pressure(x, d, E_STAR).shape == (2, 3)
    for one in (shape.profile_3d(1e-4), shape.pressure(1e-4, 1e-5, 1), shape.force(1e-5, 1)):
        assert isinstance(one, float)
    assert isinstance(shape.contact_radius(1e-5), float)
    if shape.least_depth == 0:
        assert shape.force(1e-300, 1.0) >= 0


@pytest.mark.parametrize("shape", [shape for shape in CURVED if shape.is_body], ids=name)
def test_a_function_with_its_kinks_named_is_the_closed_form(shape):
    mapped = Profile(shape.profile_3d, kinks=shape.kinks, r_max=None if shape.max_radius == np.inf else end(shape))
    x, d = np.geomspace(1e-9, min(20 * B, end(shape)), 60), depths(shape, 1e-9, 1.1e-4, 12)
    deep = 0.9 * d[-1]
    x = x[np.abs(x - B) > 1e-5 * B]  # one rounding of x next to it is seen in g
    assert_allclose(mapped.profile_1d(x), shape.profile_1d(x), rtol=MAP)
    assert_allclose(mapped.contact_radius(d), shape.contact_radius(d), rtol=MAP)
    assert_allclose(mapped.force(d, E_STAR), shape.force(d, E_STAR), rtol=MAP)
    if shape in WORN:
        assert mapped.profile_1d(0.5 * B) == 0
        d = 1e-15 if isinstance(shape, RoundedPunch) else 1e-300  # hardly pressed: a punch of radius b
        assert_allclose(mapped.force(d, 1), shape.force(d, 1), rtol=MAP)
    r = discs(float(shape.contact_radius(deep)))
    assert_allclose(mapped.pressure(r, deep, E_STAR), shape.pressure(r, deep, E_STAR), rtol=MAP)


@pytest.mark.parametrize("shape", KINKED, ids=name)
def test_a_kink_left_out_is_warned_of(shape):
    d = 1.5 * float(shape.profile_1d(B)) + 1e-4
    with pytest.warns(UserWarning, match="name every radius where f or its slope is not smooth in kinks="):
        a = Profile(shape.profile_3d).contact_radius(d)
    assert abs(a / shape.contact_radius(d) - 1) < 0.1  # a poor answer, not a wild one


def test_a_profile_knows_its_end():
    sphere = Profile(lambda r: 1 - np.sqrt(1 - r**2), r_max=1.0)
    a = 0.9
    assert_allclose(sphere.profile_1d(a), a / 2 * math.log((1 + a) / (1 - a)), rtol=MAP)
    with pytest.raises(ValueError, match="name its end"):
        Profile(lambda r: 1 - np.sqrt(1 - r**2)).profile_1d(2.0)


@pytest.mark.parametrize(("f", "d", "words"), [
    (lambda r: -(r**2), 1e-5, r"falls below its tip.*f\(r\) = -1e-10 m at 1e-05 m from the axis; check its sign"),
    (lambda r: r**2 * (1e-4 - r**2), 1e-5, "falls below its tip"),
    (lambda r: 1e-6 * np.tanh(r / 1e-3), 1e-5, r"never gets as high as d = 1e-05 m: f\(r\) stays at or below 1e-06 m"),
    (lambda r: 0 * r, 1e-5, "never gets as high"),
    (lambda r: 1 - np.sqrt(1 - r**2), 5.0, "no finite height beyond r = 0.9998.*give r_max"),
])  # fmt: skip
def test_a_depth_without_a_radius_is_told_why(f, d, words):
    with pytest.raises(ValueError, match=words):
        Profile(f).contact_radius(d)
    with pytest.raises(ValueError, match=words):
        Profile(f).force([-d, d], 1.0)


@pytest.mark.parametrize("theta", [1e-300, 1e-160])
def test_a_force_beyond_the_range_of_floats_is_refused(theta):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ValueError, match=r"of Cone\(theta=1e-\d+\) is beyond the range of floats"):
            Cone(theta).force([0, 1e-5], 1e6)
        for ask in (
            lambda: Cone(1e-300).stiffness(1e4, 1e6),
            lambda: Cone(1e-160).contact_radius(1e150),
            lambda: Cone(1.5).profile_1d(1e308),
            lambda: PowerLaw(3, 1e2).profile_3d(1e150),
            lambda: FlatPunch(1e-3).pressure(1e-4, 1e308, 1e6),
            lambda: KelvinVoigt(1e6, 0.4, 1e200).dynamic_modulus(1e150),
        ):
            with pytest.raises(ValueError, match="is beyond the range of floats"):
                ask()
        assert_allclose(Cone(1e-140).force(1e-5, 1e6), 2 / math.pi * 1e6 * 1e-10 / 1e-140, rtol=EXACT)


def test_profiles_compare_by_their_function():
    one, other = Profile(parabola, name="p"), Profile(lambda r: r**2 / 1e-2, name="p")
    assert one == Profile(parabola, name="p") == pickle.loads(pickle.dumps(one))
    assert one != other
    assert hash(one) == hash(Profile(parabola, name="p"))
    scalars_only = Profile(lambda r: math.pow(r, 2) / 1e-2)
    assert_allclose(scalars_only.force(1e-5, 1), Paraboloid(5e-3).force(1e-5, 1), rtol=MAP)


def test_a_shape_of_ones_own_needs_one_profile():
    class Bump(Indenter):
        def profile_1d(self, x):
            return np.asarray(x) ** 2 / 5e-3

    d, r = np.array([1e-6, 1e-5]), np.array([0, 1e-4])
    assert_allclose(Bump().force(d, 1), Paraboloid(5e-3).force(d, 1), rtol=MAP)
    assert_allclose(Bump().profile_3d(r), Paraboloid(5e-3).profile_3d(r), rtol=MAP)
    with pytest.raises(TypeError, match="no shape yet"):
        type("Nothing", (Indenter,), {})


@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_generic_quadrature_agrees_with_closed_forms(shape):
    d = 2e-5
    a = float(shape.contact_radius(d))
    r, n = discs(a), 4
    p = Indenter.pressure_inside(shape, r, np.full(n, a), np.full(n, d))
    assert_allclose(E_STAR * p, shape.pressure(r, d, E_STAR), rtol=MAP)
    # the area is the lesser part of d a wherever a face is flat, and counts as that in the force
    assert_allclose(Indenter._area(shape, np.array(a)), shape.profile_area(a), rtol=EXACT, atol=EXACT * d * a)
