"""g(x) and a(d) of a profile from its panels: as good as the quadrature they are made of, and as good everywhere."""

import math
import time
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import struve

from mdr.indenters import Paraboloid, Profile
from mdr.indenters.mapped import image_of

B, R, T = 1e-3, 5e-3, math.tan(0.05)
MAP = 1e-9  # the accuracy promised for mapped profiles


KINKS = (1e-6, B, 1.0001 * B, 5 * B)
PROFILES = {
    "power": (Profile(lambda r: (r / B) ** 40), 0.1 * B, 20 * B),
    "pointed": (Profile(lambda r: r * T + r**2 / 1e-2), 1e-12, 1e3),
    "kinks": (Profile(lambda r: sum(np.maximum(r - b, 0) * T for b in KINKS), kinks=KINKS), 1e-6 + 1e-12, 0.1),
    "rounded": (Profile(lambda r: np.maximum(r - B, 0) ** 2, kinks=(B,)), 1.01 * B, 0.1),
    "sphere": (Profile(lambda r: r * r / (R + np.sqrt((R - r) * (R + r))), r_max=R), 1e-12, 0.98 * R),
}


@pytest.fixture(params=PROFILES)
def profile(request):
    shape, low, high = PROFILES[request.param]
    return shape, np.geomspace(low, high, 301)


def test_panels_say_what_quadrature_says(profile):
    shape, x = profile
    assert_allclose(shape.profile_1d(x), image_of(shape).direct(x), rtol=0.1 * MAP)


def test_the_radius_leads_back_to_the_depth(profile):
    shape, x = profile
    d = shape.profile_1d(x)
    a = shape.contact_radius(d)
    assert_allclose(a, x, rtol=MAP)
    assert np.all(np.diff(a) > 0)


def test_no_answer_depends_on_what_else_was_asked(profile):
    shape, x = profile
    d = shape.profile_1d(x)
    some = slice(None, None, 100)
    image_of(shape).panels.clear()
    assert_allclose([shape.contact_radius(one) for one in d[some]], shape.contact_radius(d)[some], rtol=4e-16)
    assert np.array_equal(shape.profile_1d(x[::-1])[::-1], shape.profile_1d(x))


def test_kinks_against_the_closed_form():
    x = np.concatenate([b * (1 + np.geomspace(1e-9, 0.5, 40)) for b in KINKS])
    g = sum(x * T * np.arctan2(np.sqrt(np.maximum(x - b, 0) * (x + b)), b) * (x > b) for b in KINKS)
    # one rounding of x is 2e-7 of x - b at 1e-9, half of that in the root
    assert_allclose(PROFILES["kinks"][0].profile_1d(x), g, rtol=1e-7)
    far = np.min(np.abs(x[:, None] / np.array(KINKS) - 1), axis=1) > 1e-5
    assert_allclose(PROFILES["kinks"][0].profile_1d(x[far]), g[far], rtol=MAP)


def test_a_ripple_shorter_than_its_panel():
    k, h = 4e3, 1e-7  # three waves to 5 mm; ∫₀^{π/2} sin(k x sin t) dt = π/2 H₀(kx), a Struve function
    ripple = Profile(lambda r: r**2 / 1e-2 + h * (1 - np.cos(k * r)))
    x = np.linspace(1e-4, 5e-3, 50)
    assert_allclose(ripple.profile_1d(x), x**2 / R + x * h * k * np.pi / 2 * struve(0, k * x), rtol=MAP)


def test_a_function_of_few_digits_is_mapped_as_far_as_it_goes():
    grainy = Profile(lambda r: (r.astype(np.float32) ** 2).astype(float) / 1e-2, name="grainy")
    with pytest.warns(UserWarning, match="mapped"):
        a = grainy.contact_radius(np.linspace(1e-5, 2e-5, 1000))
    assert_allclose(a, Paraboloid(R).contact_radius(np.linspace(1e-5, 2e-5, 1000)), rtol=1e-4)


@pytest.mark.parametrize("digits", [np.float64, np.float32])
def test_many_depths_cost_no_more_than_a_few(digits):
    asked = []

    def counted(r):
        asked.append(r.size)
        return (r.astype(digits) ** 2).astype(float) / 1e-2

    def cost(shape, n):
        asked.clear()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # single precision is warned of
            shape.contact_radius(np.linspace(1e-5, 1e-4, n))
        return sum(asked)

    shape = Profile(counted)
    assert cost(Profile(counted), 5000) <= (first := cost(shape, 50))
    assert cost(shape, 5000) < first / 1.2  # asked again: what is left are the checks


@pytest.mark.parametrize("place", [5e-4, 4.87e-4, 3.1e-4])
@pytest.mark.parametrize("step", [1e-4, 1e-5, 3e-8])
def test_a_step_is_refused(place, step):
    """No quadrature sees one that is not named. A steep slope, and one without bound at a kink, are none."""

    def walled(r):
        return np.where(r < place, 0, step) + 0.01 * r

    for refused in (lambda: Profile(walled).force(20e-6, 4e6), lambda: Profile(walled, kinks=(place,))):
        with pytest.raises(ValueError, match=r"f steps by .* a vertical wall"):
            refused()
    steep = Profile(lambda r: 0.01 * r + np.maximum(r - place, 0), kinks=(place,))
    root = Profile(lambda r: 1e-3 * np.sqrt(np.maximum(r - place, 0)), kinks=(place,))
    assert steep.contact_radius(20e-6) > place < root.contact_radius(1e-6)


def test_threads_may_ask_one_shape():
    def slow(r):
        time.sleep(1e-4)  # another one begins
        return r * r / 1e-2

    shape, d = Profile(slow, r_max=4e-3), np.linspace(1e-6, 1e-4, 12)
    with ThreadPoolExecutor(6) as pool:
        a = list(pool.map(shape.contact_radius, d))
    assert_allclose(a, np.sqrt(d * R), rtol=MAP)
