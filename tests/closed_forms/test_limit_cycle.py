"""Stick-slip of a body without vibration: its limits. Runs beside it stand in tests/march/test_falling.py."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from mdr.closed_forms.laws import stick_slip, stick_slip_end

FORCES = {"breakaway": 3.0, "sliding": 2.0}
BODY = FORCES | {"k_x": 1e5, "m": 0.4}
SPEED = 1 / np.sqrt(1e5 * 0.4)  #: Delta omega_0/k_x


def damped(zeta):
    return BODY | {"c_x": 2 * zeta * np.sqrt(1e5 * 0.4)}


@pytest.mark.parametrize("v", [1e-3, 0.1, 1.0, 10.0])
def test_an_undamped_cycle_is_symmetric_about_the_force_of_slip(v):
    cycle = stick_slip(v * SPEED, **BODY)
    stick, slip = 2 / (1e5 * v * SPEED), 2 / np.sqrt(1e5 / 0.4) * (np.pi - np.arctan(1 / v))
    assert_allclose(cycle.period, stick + slip, rtol=1e-12)
    assert_allclose(cycle.rest, stick / (stick + slip), rtol=1e-12)
    assert_allclose(cycle.mean_force, 2.0, rtol=1e-12)
    assert_allclose(cycle.speed, SPEED * (v + np.hypot(v, 1)), rtol=1e-12)
    assert_allclose(cycle.stroke, v * SPEED * cycle.period, rtol=1e-12)


@pytest.mark.parametrize("zeta", [0.01, 0.1, 0.5])
def test_a_damper_ends_it(zeta):
    end = stick_slip_end(**damped(zeta))
    assert stick_slip(end * (1 - 1e-8), **damped(zeta)) is not None
    assert stick_slip(end * (1 + 1e-8), **damped(zeta)) is None


def test_of_a_light_damper_and_of_none():
    """The next order is a root of zeta of the first."""
    for zeta in (1e-4, 1e-6):
        assert_allclose(stick_slip_end(**damped(zeta)), SPEED / np.sqrt(4 * np.pi * zeta), rtol=np.sqrt(4 * zeta))
    assert stick_slip_end(**BODY) == np.inf
    assert stick_slip_end(**damped(1.0)) == 0
    assert stick_slip(1e-6, **damped(1.0)) is None


def test_a_stiff_contact_does_not_yield_where_its_swing_dies_out():
    """And without a damper it lets the body go before."""
    slow, stiff = 1e-3 * SPEED, {"k_xc": 1e5 * 1e4}
    assert_allclose(stick_slip(slow, **damped(0.05), **stiff), stick_slip(slow, **damped(0.05)), rtol=1e-3)
    assert stick_slip(slow, **BODY, **stiff) is None


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"breakaway": 2.0}, "breakaway = 2 N must be above sliding = 2 N: friction falls"),
        ({"k_xc": -1.0}, "k_xc = -1.0 N/m must be above 0"),
        ({"breakaway": 9.0, "k_xc": 1e9}, "let go backwards as the body swings"),
        ({"k_xc": 1e6}, "slips still differ after .* add c_x"),
    ],
)
def test_what_has_no_cycle_of_one_slip_is_refused(change, words):
    with pytest.raises(ValueError, match=words):
        stick_slip(1e-2 * SPEED, **{**BODY, **change})
