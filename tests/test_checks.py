"""The checks of numbers: what passes comes back as a float, what does not names quantity, rule and value."""

import numpy as np
import pytest

from mdr.tools import checks

CHECKS = {
    "finite": checks.finite,
    "positive": checks.positive,
    "not_negative": checks.not_negative,
    "between": lambda name, value: checks.between(name, value, 0, 10),
}


@pytest.fixture(params=CHECKS.values(), ids=CHECKS)
def check(request):
    return request.param


@pytest.mark.parametrize("value", [3, 3.0, np.float64(3), np.float32(3), np.int64(3)])
def test_a_real_number_becomes_a_float(check, value):
    assert type(check("R", value)) is float
    assert check("R", value) == 3.0


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, np.float64("nan")])
def test_nan_and_infinity_are_refused(check, value):
    with pytest.raises(ValueError, match=r"^R must be .*(nan|inf)"):
        check("R", value)


@pytest.mark.parametrize(
    "value", [True, False, np.True_, "3", None, 3j, [3], np.array(3.0), np.array([1.0, 2.0])], ids=repr
)
def test_what_is_not_a_number_is_a_type_error(check, value):
    with pytest.raises(TypeError, match=r"^R must be"):
        check("R", value)


@pytest.mark.parametrize(
    ("check", "value", "message"),
    [
        (checks.positive, 0, "R must be positive, got 0.0"),
        (checks.positive, -1e-300, "R must be positive"),
        (checks.not_negative, -1e-300, "R must not be negative"),
        (CHECKS["between"], 0, "R must lie between 0 and 10, got 0.0"),
        (CHECKS["between"], 10, "R must lie between 0 and 10, got 10.0"),
    ],
)
def test_the_bounds_are_named(check, value, message):
    with pytest.raises(ValueError, match=message):
        check("R", value)


def test_not_negative_takes_zero():
    assert checks.not_negative("m", 0) == 0.0


def test_the_meaning_is_told():
    with pytest.raises(ValueError, match=r"\(radius in m\)"):
        checks.positive("R", -1, "radius in m")
