"""How a search reads its runs, made up so that the answer is known; runs of contacts are in test_friction.py."""

import math
from dataclasses import replace
from types import SimpleNamespace

import pytest
from conftest import contact

import mdr
from mdr.friction import measured_velocity
from mdr.march.result.refinement import default_steps

CASE = contact("paraboloid", 3.0, 0.0, 0.7, 1.6, 0.1)
UNIT = CASE.unit_velocity


@pytest.fixture
def world(monkeypatch):
    """In the place of runs: friction is reduced, springs stick, up to ends(start, steps), in Eq. (1)."""

    def make(ends, settled=lambda v, start: True):
        def run(case, v_0, start, steps):
            end = ends(start, steps) * UNIT
            free = v_0 > end
            return SimpleNamespace(
                v_0=v_0, full_cof=case.mu_0, cof=case.mu_0 - (0 if free else 0.1), cof_error=1e-6,
                stick_share=0.0 if free else 0.5, least_slip=v_0 - end if free else 0.0,
                settled=settled(v_0 / UNIT, start), kind="periodic", to_begin_from=None,
            )  # fmt: skip

        def slide(case, v_0, *, start, n_springs, steps_per_period):
            return run(case, v_0, start, steps_per_period)

        def runs(case, velocities, knobs, near):
            return (run(case, v_0, knobs.start, knobs.steps) for v_0 in velocities)

        monkeypatch.setattr(measured_velocity, "slide", slide)
        monkeypatch.setattr(measured_velocity, "runs", runs)
        monkeypatch.setattr(measured_velocity, "finish", lambda end: end)

    return make


def test_the_end_of_stick_is_bracketed(world):
    world(lambda *_: 0.83)
    found = mdr.measure_critical_velocity(CASE)
    assert found.kind == "end of stick"
    assert found.low < 0.83 * UNIT < found.high
    assert found.high - found.low < 1e-4 * UNIT


def test_friction_that_stays_low_from_rest_contradicts_the_other_start(world):
    world(lambda start, *_: 1.7 if start == "rest" else 0.83)
    told = mdr.verdict(CASE)
    assert (told.holds, told.measurement.v_c, told.measurement.kind) == (None, None, "unsettled")
    assert "a run from rest keeps friction reduced" in told.measurement.why
    assert "a run from rest keeps friction reduced" in told.why


def test_a_run_that_has_not_settled_is_no_evidence(world):
    """Neither at the end of stick, where one close by is asked, nor further up, where it is named."""
    world(lambda *_: 0.83, settled=lambda v, start: not 0.82999 < v < 0.82999001)
    assert mdr.measure_critical_velocity(CASE).v_c == pytest.approx(0.83 * UNIT, rel=1e-4)
    world(lambda *_: 0.83, settled=lambda v, start: not 0.7 < v < 1.5)
    found = mdr.measure_critical_velocity(CASE)
    assert (found.v_c, found.kind) == (None, "unsettled")
    assert "do not settle" in found.why


def test_stick_that_never_ends_has_no_v_c(world):
    world(lambda *_: 1e9)
    found = mdr.measure_critical_velocity(CASE)
    assert (found.v_c, found.low, found.high) == (None, None, None)
    assert not found.contains(UNIT)
    assert "up to the highest velocity tried" in found.why


def test_stick_that_only_finer_steps_find_is_found(world):
    """The first run without stick is at 1.37 times what a fast run says; there finer steps stick."""
    coarse = default_steps(CASE)
    world(lambda start, steps: 0.83 if steps <= coarse else 1.3)
    found = mdr.measure_critical_velocity(CASE)
    assert found.v_c == pytest.approx(1.3 * UNIT, rel=1e-4)
    world(lambda start, steps: 0.83 if steps <= coarse else 1e9)
    assert mdr.measure_critical_velocity(CASE).kind == "none"


def test_runs_above_that_do_not_settle_are_named(world):
    world(lambda *_: 0.83, settled=lambda v, start: not (start == "rest" and 1.0 < v < 1.2))
    assert "not settled: 1.3 v_c from rest" in mdr.measure_critical_velocity(CASE).why


# --- the first words of a verdict: how good the formula is, and what to use in its place ---

EQ_15 = mdr.critical_velocity(CASE) / UNIT
ZERO = contact("flat", 10.0, 0.0, 0.5, math.sqrt(1 / 3))  # m omega² = k_x + k_xc


@pytest.mark.parametrize(("formula_over_measured", "within", "begins", "good", "holds"), [
    (1.0055, 0.01, "Eq. (15) is good to 1 % here (0.55 % too high). ", True, False),
    (1.0055, 0.005, "Eq. (15) is 0.55 % too high here; use {use} m/s. ", False, False),
    (0.9945, 0.005, "Eq. (15) is 0.55 % too low here; use {use} m/s. ", False, False),
    (0.98, 0.05, "Eq. (15) is good to 5 % here (2 % too low). ", True, False),
    (1.023, 0.01, "Eq. (15) is 2.3 % too high here; use {use} m/s. ", False, False),
    (12.0, 0.01, "Eq. (15) is too high by a factor of 12 here; use {use} m/s. ", False, False),
    (1 / 1200, 0.01, "Eq. (15) is too low by a factor of 1200 here; use {use} m/s. ", False, False),
    # inside the bracket, half of whose width is 2e-5 of v_c
    (1 - 2e-6, 0.01, "Eq. (15) is good to 1 % here (0.0002 % too low). ", True, True),
    (1 - 1e-5, 1e-6, "Eq. (15) is 0.001 % too low here, inside the measured interval. ", False, True),
])  # fmt: skip
def test_a_verdict_begins_with_how_good_the_formula_is(world, formula_over_measured, within, begins, good, holds):
    world(lambda *_: EQ_15 / formula_over_measured)
    told = mdr.verdict(CASE, within=within)
    assert str(told).startswith(f"{begins.format(use=f'{told.measured:.4g}')}Measured in runs")
    assert (told.good, told.holds, told.within) == (good, holds, within)
    assert told.deviation == pytest.approx(1 / formula_over_measured - 1, rel=1e-2)
    found = told.measurement
    bracket = f"Measured in runs, v_c = {found.v_c:.6g} m/s (between {found.low:.8g} and {found.high:.8g})"
    words = f"the formula lies {'inside' if holds else 'outside'} the measured interval"
    assert f"{bracket}, against {told.eq_15:.6g} m/s: {words}. {told.why[0].upper()}" in str(told)
    assert "%)" not in str(told).split("Measured in runs")[1]


def test_another_tolerance_needs_no_other_measurement(world):
    world(lambda *_: EQ_15 / 1.02)
    told = mdr.verdict(CASE)
    assert (told.good, replace(told, within=0.03).good) == (False, True)
    with pytest.raises(ValueError, match=r"within must lie between 0 and 1, got 3\.0"):
        replace(told, within=3)


@pytest.mark.parametrize(("case", "end", "begins", "deviation", "good", "holds"), [
    (ZERO, 0.3, "almost zero here; use {use} m/s. Measured in runs", 0.3 / measured_velocity.LEAST_V_C, False, False),
    (ZERO, 5e-5, "almost zero here, and so is the measured v_c. Measured in runs", None, False, True),
    (CASE, 0.0, "too high here, where v_c is almost zero; use {use} m/s. ", None, False, False),
    (CASE, 1e-6, "too high here, where v_c is almost zero; use {use} m/s. ", None, False, False),
])  # fmt: skip
def test_where_a_velocity_vanishes_there_is_no_percentage(world, case, end, begins, deviation, good, holds):
    world(lambda *_: end)
    told = mdr.verdict(case)
    assert str(told).startswith("Eq. (15) is " + begins.format(use=f"{told.measured:.4g}"))
    assert (told.good, told.holds) == (good, holds)
    assert "%" not in str(told)
    assert "factor" not in str(told)
    if case is ZERO:
        assert told.eq_15 < measured_velocity.LEAST_V_C * UNIT
    if deviation:
        assert told.deviation == pytest.approx(deviation, rel=1e-3)


def test_without_a_free_run_a_finite_full_slip_value_is_not_denied(world):
    """The runs did not confirm it, and that is all they say: friction need not stay reduced for ever."""
    world(lambda *_: 1e9)
    told = mdr.verdict(CASE)
    full = mdr.full_slip_critical_velocity(CASE)
    assert (told.measured, told.deviation, told.good, told.holds) == (None, None, None, None)
    said = f"no settled run confirmed the full-slip value {full:.6g} m/s, against {told.eq_15:.6g} m/s by the formula"
    assert str(told).startswith(f"Eq. (15) cannot be judged: {said}. ")
    assert "no critical velocity" not in str(told)
    assert told.measurement.why in told.why


def test_a_body_thrown_for_an_instant_has_no_resonance(world):
    light = replace(contact("paraboloid", 1.2, 1.0), pull=mdr.SpringPull(k_x=CASE.pull.k_x))
    world(lambda *_: 0.83)
    told = mdr.verdict(light)
    assert told.full_slip == math.inf
    assert (told.measured, told.holds) == (None, None)
    assert str(told).startswith("Eq. (15) cannot be judged: no critical velocity was found, against ")


def test_a_formula_at_its_pole_is_infinite_where_runs_find_a_velocity(world, monkeypatch):
    world(lambda *_: 3.0)
    monkeypatch.setattr("mdr.friction.verdict.critical_velocity", lambda case: math.inf)
    told = mdr.verdict(CASE)
    assert str(told).startswith(f"Eq. (15) is infinite here; use {told.measured:.4g} m/s. Measured in runs")
    assert "%" not in str(told)
    assert (told.good, told.deviation, told.holds) == (None, None, False)
