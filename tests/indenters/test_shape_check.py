"""What is no shape is refused with the place, and what is one is not."""

import re
import warnings
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr
from mdr.indenters.mapping.shape_check import why_no_shape

R, E_STAR = 5e-3, 2e6
D = np.geomspace(1e-9, 4e-5, 300)
A = np.sqrt(R * D)
V = 4 / 3 * np.sqrt(R) * D**1.5


@pytest.fixture(autouse=True)
def silent():
    """Nothing but a refusal may tell of nonsense."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


def put(values, i, value):
    changed = np.array(values)
    changed[i] = value
    return changed


@pytest.mark.parametrize(("d", "a", "V", "words"), [
    (D, A, V, "^$"),
    (D, 0 * D + 1e-3, 2e-3 * D, "^$"),  # a punch
    (D, put(A, 200, -np.inf), V, "a is -inf at d = 1.19757e-06 m, where it must be finite"),
    (put(D, 9, np.nan), A, V, "g is nan at x = "),
    (D, A, put(V, 9, np.nan), "F_N/E. is nan"),
    (D, put(A, 3, -1e-9), V, "contact radius is -1e-09 m at d = .* where it must be positive"),
    (D, 0 * A, V, "contact radius is 0 m"),
    (D, np.minimum(A, A[150] ** 2 / A), V, "contact radius falls at d = "),
    (np.minimum(D, D[150] ** 2 / D), A, V, "annular contact: .* g falls at x = "),
    (D, A, 1.01 * V, "F_N/E. rises by .* must rise"),
    (D, A, -V, "F_N/E. rises by -"),
])  # fmt: skip
def test_states_of_contact(d, a, V, words):
    assert re.search(words, why_no_shape(d, a, V))


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_the_smoothing_that_is_named_passes(seed):
    rng, r = np.random.default_rng(seed), np.linspace(0, 2e-3, 200)
    f = r**2 / (2 * R) + rng.normal(0, 1e-7, r.size)
    with pytest.raises(ValueError, match=r"annular contact.*falls at x = .*points look like noise of") as refused:
        mdr.SampledProfile(r, f)
    noise = float(re.search(r"noise of (\S+) m", str(refused.value))[1])
    assert noise == pytest.approx(1e-7, rel=0.3)
    enough = float(re.search(r"smoothing=: (\S+) m is enough", str(refused.value))[1])
    assert mdr.SampledProfile(r, f, smoothing=enough).contact_radius(2e-5) == pytest.approx(np.sqrt(R * 2e-5), rel=0.02)


def test_a_force_that_no_smoothing_mends_says_so():
    d = np.linspace(0, 1e-5, 60)
    with pytest.raises(ValueError, match=r"slope falls at d = .*; if it is noise, no smoothing= up to .* N makes it"):
        mdr.FromForce(d, 1e-3 * (d / d[-1]) ** 0.5, E_star=E_STAR)


class Ball(mdr.Indenter):
    """A paraboloid, of which a class below answers one thing otherwise."""

    def profile_1d(self, x):
        return np.asarray(x) ** 2 / R


def radius(answer):
    return {"contact_radius": lambda self, d: answer(np.sqrt(R * np.maximum(d, 0)))}


def force(answer):
    return {"force": lambda self, d, E_star: answer(4 / 3 * E_star * np.sqrt(R) * np.maximum(d, 0) ** 1.5)}


def profile(answer):
    return {"profile_1d": lambda self, x: answer(np.asarray(x))}


def heights(answer):
    return {"profile_3d": lambda self, r: answer(np.asarray(r))}


OWN = {
    "negative radius": (radius(lambda a: -a), "contact radius is -2.23607e-05 m at d = 1e-07 m, where"),
    "radius of nothing": (radius(lambda a: np.where(a > 2e-4, np.nan, a)), "a is nan at d = "),
    "radius that falls": (radius(lambda a: np.minimum(a, 4e-4 - a)), "contact radius falls at d = "),
    "radius of another shape": (radius(lambda a: 1.1 * a), r"contact_radius is .* where g\(x\) = "),
    "constant radius": (radius(lambda a: 0 * a + 1e-4), r"contact_radius is .* where g\(x\) = "),
    "another force": (force(lambda F: 1.01 * F), r"force of \w+ answers .* where its g\(x\) makes it .* at d = "),
    "no force": (force(lambda F: F * np.nan), "force of .* answers nan"),
    "another stiffness": ({"stiffness": lambda self, d, E_star: -E_star * np.sqrt(d)}, "stiffness of .* answers -"),
    "another area": ({"profile_area": lambda self, a: np.asarray(a) ** 3 / R}, "F_N/E. rises by .* must rise"),
    "no area": ({"profile_area": lambda self, a: np.asarray(a) * np.nan}, "F_N/E. is nan"),
    "g of nothing": (profile(lambda x: np.where(abs(x - 2e-4) < 1e-5, np.nan, x**2 / R)), "no finite height"),
    "g that falls": (profile(lambda x: x**2 / R - 2e-5 * np.exp(-(((x - 2e-4) / 1e-5) ** 2))), "annular contact"),
    "g from a height": (profile(lambda x: x**2 / R + 1e-7), "its height is 1e-07 m on the axis"),
    "complex g": (profile(lambda x: x**2 / R + 0j), "must answer an array of radii with as many real heights"),
    "f from a height": (heights(lambda r: r**2 / R + 1e-7), "its height is 1e-07 m on the axis"),
    "f with a step": (heights(lambda r: r**2 / R + 1e-6 * (r > 1e-4)), "F_N/E. rises by|annular"),
    "f that begins downwards": (heights(lambda r: r**2 / R - 1e-2 * r), "annular contact|falls below its tip"),
    "complex f": (heights(lambda r: np.sqrt(1e-8 - r**2 + 0j) - 1e-4), "as many real heights"),
}  # fmt: skip


def press(shape):
    d = np.geomspace(1e-7, 2e-5, 40)
    return shape.contact_radius(d), shape.force(d, E_STAR), shape.stiffness(d, E_STAR)


@pytest.mark.parametrize("what", OWN)
def test_a_class_that_is_no_shape(what):
    answers, words = OWN[what]
    own = dataclass(frozen=True)(type("Own", (mdr.Indenter if "profile_3d" in answers else Ball,), answers))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # of a kink that is not named
        with pytest.raises((ValueError, TypeError), match=words):
            press(own())


@pytest.mark.parametrize("n", [0.3, 1.0, 2.0, 5.0])
def test_a_class_with_all_its_closed_forms_is_taken(n):
    @dataclass(frozen=True)
    class Power(mdr.Indenter):
        def profile_1d(self, x):
            return 1e-5 * (np.abs(x) / 1e-3) ** n

        def contact_radius(self, d):
            return 1e-3 * (np.maximum(d, 0) / 1e-5) ** (1 / n)

        def force(self, d, E_star):
            return 2 * E_star * n / (n + 1) * np.maximum(d, 0) * self.contact_radius(d)

        def stiffness(self, d, E_star):
            return 2 * E_star * self.contact_radius(d)

    d = np.geomspace(1e-12, 1e-4, 30)
    assert Power().force(d, E_STAR)[-1] > 0
    assert np.all(Power().stiffness([-1e-5, 0.0, 1e-5], E_STAR) >= 0)
    assert Power().force(2e-5, E_STAR) > 0


def noisy_force(seed, smoothing):
    """A made-up tip, 100 points with noise of 1e-7 N, smoothed by this share of it."""
    d = 0.6e-9 * np.arange(100)
    F = 240 * d + 1.5e9 * d**2 + np.append(0, np.random.default_rng(seed).normal(0, 1e-7, 99))
    return lambda: mdr.FromForce(d, F, E_star=1e10, smoothing=smoothing * 1e-7)


@pytest.mark.parametrize("seed", range(12))
def test_a_noisy_force_is_a_shape_where_the_noise_is_told_and_refused_else(seed):
    tip = noisy_force(seed, 1.0)()
    d = np.linspace(1e-12, tip.d[-1], 3000)
    a = tip.contact_radius(d)
    assert np.all(np.isfinite(a) & (a > 0))
    assert np.all(np.diff(a) >= -1e-12 * a.max())
    assert_allclose(tip.force(d, 1e10), 240 * d + 1.5e9 * d**2, atol=3e-7)  # three standard deviations
    with pytest.raises(ValueError, match=r"growing contact .* misses .* on average;.*smoothing=: .* enough"):
        noisy_force(seed, 0.5)()
    with pytest.raises(ValueError, match=r"F must ascend, got .*; if it is noise, .*smoothing=: .* N is enough"):
        noisy_force(seed, 0.0)()


def test_a_dip_as_narrow_as_a_thousandth_is_found():
    profile = mdr.Profile(lambda r: r**2 / R - 1e-7 * (np.exp(-(((r - 5e-4) / 1e-6) ** 2))))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        with pytest.raises(ValueError, match=r"annular contact.* falls at x = 0\.000(49|50)"):
            profile.contact_radius(4e-4)
