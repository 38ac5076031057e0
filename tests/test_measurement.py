"""How a search reads its runs, made up so that the answer is known; runs of contacts are in test_friction.py."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
from conftest import contact

import mdr
from mdr import measurement
from mdr.sliding import default_steps

CASE = contact("paraboloid", 3.0, 0.0, 0.7, 1.6, 0.1)
UNIT = CASE.unit_velocity


@pytest.fixture
def world(monkeypatch):
    """In the place of slide(): friction is reduced, springs stick, up to ends(start, steps, n_periods), in Eq. (1)."""

    def make(ends, settled=lambda v, start: True, deficit=0.1, error=1e-6):
        def slide(case, v_0, *, start, n_springs, steps_per_period, n_periods=50):
            end = ends(start, steps_per_period, n_periods) * UNIT
            free = v_0 > end
            return SimpleNamespace(
                v_0=v_0, mu_0=case.mu_0, cof=case.mu_0 - (0 if free else deficit), cof_error=error,
                stick_share=0.0 if free else 0.5, least_slip=v_0 - end if free else 0.0,
                settled=settled(v_0 / UNIT, start), n_springs=n_springs, steps_per_period=steps_per_period,
                n_periods=n_periods,
            )  # fmt: skip

        monkeypatch.setattr(measurement, "slide", slide)

    return make


def test_the_end_of_stick_is_bracketed(world):
    world(lambda *_: 0.83)
    found = mdr.measure_critical_velocity(CASE)
    assert found.kind == "end of stick"
    assert found.low < 0.83 * UNIT < found.high
    assert found.high - found.low < 1e-4 * UNIT


def test_friction_that_stays_low_from_rest_is_hysteresis_and_sets_v_c(world):
    world(lambda start, *_: 1.7 if start == "rest" else 0.83)
    found = mdr.measure_critical_velocity(CASE)
    assert found.kind == "hysteresis"
    assert found.low <= 1.7 * UNIT <= found.high
    assert found.high - found.low < 2e-3 * found.v_c
    assert "a run from rest keeps friction reduced" in found.why


def test_a_reduction_that_four_times_the_run_outlives_is_none(world):
    world(lambda start, _, n_periods: 1.7 if start == "rest" and n_periods <= 50 else 0.83)
    found = mdr.measure_critical_velocity(CASE)
    assert found.kind == "end of stick"
    assert found.v_c == pytest.approx(0.83 * UNIT, rel=1e-4)


def test_friction_that_never_gets_full_from_rest_has_no_v_c(world):
    world(lambda start, *_: 1e9 if start == "rest" else 0.83)
    found = mdr.measure_critical_velocity(CASE)
    assert (found.v_c, found.kind) == (None, "none")
    assert "from rest, friction stays reduced up to the highest velocity" in found.why


def test_stick_that_never_ends_has_no_v_c(world):
    world(lambda *_: 1e9)
    found = mdr.measure_critical_velocity(CASE)
    assert (found.v_c, found.low, found.high) == (None, None, None)
    assert not found.contains(UNIT)
    assert "up to the highest velocity tried" in found.why


def test_a_v_c_next_to_zero_is_said_to_be_so(world):
    world(lambda *_: 1e-6)
    found = mdr.measure_critical_velocity(CASE)
    assert found.low == 0
    assert found.high < 1e-3 * UNIT
    assert "not told from zero" in found.why


def test_stick_that_only_finer_steps_find_is_found(world):
    """The first run without stick is at 1.37 times what a fast run says; there finer steps stick."""
    coarse = default_steps(CASE)
    world(lambda start, steps, _: 0.83 if steps <= coarse else 1.3)
    found = mdr.measure_critical_velocity(CASE)
    assert found.v_c == pytest.approx(1.3 * UNIT, rel=1e-4)


def test_stick_that_no_finer_step_lets_end_has_no_v_c(world):
    coarse = default_steps(CASE)
    world(lambda start, steps, _: 0.83 if steps <= coarse else 1e9)
    assert mdr.measure_critical_velocity(CASE).kind == "none"


def test_runs_above_that_do_not_settle_are_named(world):
    world(lambda *_: 0.83, settled=lambda v, start: not (start == "rest" and 1.0 < v < 1.2))
    assert "not settled: 1.3 v_c from rest" in mdr.measure_critical_velocity(CASE).why


def test_isolated_stick_that_never_reduces_friction_has_no_v_c(world):
    """A body without mass and damper on dashpots is judged by its COF alone, and this one stays within its error."""
    light = replace(contact("paraboloid", 1.2, 1.0), pull=mdr.SpringPull(k_x=CASE.pull.k_x))
    world(lambda *_: 0.83, deficit=1e-3, error=5e-4)
    found = mdr.measure_critical_velocity(light)
    assert found.v_c is None
    assert "stick never reduces friction by more than its numerical error" in found.why


def test_a_verdict_repeats_the_hysteresis(world):
    world(lambda start, *_: 1.7 if start == "rest" else 0.83)
    told = mdr.verdict(CASE)
    assert told.holds is False
    assert told.measurement.kind == "hysteresis"
    assert "a run from rest keeps friction reduced" in told.why
