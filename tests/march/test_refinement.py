"""As accurate as asked: bounds that hold at any accuracy, extrapolation where the order is confirmed, and refusals."""

import math

import numpy as np
import pytest
from conftest import contact, unit_of_velocity

import mdr
from mdr.closed_forms.rigid_pull import average_friction
from mdr.march import refinement
from mdr.march.march import Knobs, march

BODY = contact("paraboloid", 3.0, 0.0, 2.0, 1.6, 0.1)
FAST = contact("paraboloid", 3.0, 0.0, 2.0, 6.4, 0.1)  # omega_1/omega is 7.8


def exact(case, v_0):
    return float(average_friction(case, np.array([v_0])).cof[0])


@pytest.mark.parametrize("accuracy", [1e-3, 1e-4, 1e-5, 1e-6, 1e-7])
@pytest.mark.parametrize(("shape", "T"), [("cone", 0.0), ("flat", 0.3), ("paraboloid", 1.0)])
def test_the_accuracy_asked_for_is_met_and_the_error_within_its_bound(shape, T, accuracy):
    case = contact(shape, 3.0, T)
    for v_hat in (0.3, 0.7):
        v_0 = v_hat * unit_of_velocity(case)
        run = mdr.slide(case, v_0, accuracy=accuracy)
        assert run.cof_error <= 1.0001 * accuracy * case.mu_0
        assert abs(run.cof - exact(case, v_0)) <= run.cof_error


@pytest.mark.parametrize("ratio", [4 / 3, 3 / 2])
@pytest.mark.parametrize("order", [0.5, 1.0, 1.2, 1.5, 2.0, 2.2, 3.0, 4.0])
def test_an_error_of_another_order_is_not_extrapolated_beyond_its_bound(order, ratio):
    cofs = [1 + 1e-3 * coarser**order for coarser in (1.0, 2.0, ratio)]
    missing, bound = refinement.extrapolated(*cofs, ratio)
    assert abs(cofs[0] + missing - 1) <= bound
    assert math.isinf(bound) == (order < 1.5 or order > 2.2)


def test_less_accuracy_takes_fewer_steps():
    sizes = [(run.n_springs, run.steps_per_period) for run in (mdr.slide(BODY, 5e-4, accuracy=a) for a in (1e-3, 1e-6))]
    assert sizes[0] < sizes[1]


def as_marched(case, run):
    """The COF of the march alone, of as many springs and steps."""
    return case.mu_0 * march(case, run.v_0, Knobs(run.n_springs, run.steps_per_period, "full_slip", lump=True)).cof


def test_steps_that_are_given_are_not_extrapolated_and_chosen_ones_are():
    given, chosen = (mdr.slide(BODY, 5e-4, n_springs=192, steps_per_period=n) for n in (256, None))
    assert chosen.steps_per_period == 256
    assert given.cof == pytest.approx(as_marched(BODY, given), rel=1e-8)
    assert 1e-6 < abs(chosen.cof - given.cof) <= given.cof_error
    finest = mdr.slide(BODY, 5e-4, n_springs=192, steps_per_period=4096)
    assert abs(chosen.cof - finest.cof) < 0.25 * abs(given.cof - finest.cof)  # six times nearer


def test_a_body_that_rings_fast_is_not_extrapolated():
    v_0 = 0.5 * mdr.full_slip_critical_velocity(FAST)
    run = mdr.slide(FAST, v_0, n_springs=192)
    assert run.steps_per_period >= 512
    assert run.cof == pytest.approx(as_marched(FAST, run), rel=1e-8)


def test_springs_are_extrapolated_where_more_would_be_needed_and_not_where_they_are_given():
    case = contact("cone", 1.5, 0.0, 2.0, 1.6, 0.1)
    v_0 = 0.4 * mdr.full_slip_critical_velocity(case)
    chosen = mdr.slide(case, v_0)
    given, finest = (mdr.slide(case, v_0, n_springs=n) for n in (chosen.n_springs, 3072))
    assert chosen.n_springs <= 192
    assert abs(chosen.cof - finest.cof) < 0.5 * abs(given.cof - finest.cof)
    assert abs(given.cof - finest.cof) <= given.cof_error


@pytest.mark.parametrize("wrong", [0.0, 1e-9, 2e-3, math.nan, -1e-5])
def test_an_accuracy_out_of_range_is_refused(wrong):
    for ask in (mdr.slide, mdr.cof_curve):
        with pytest.raises(ValueError, match="accuracy must"):
            ask(BODY, 5e-4, accuracy=wrong)
    with pytest.raises(ValueError, match="accuracy must"):
        mdr.measure_critical_velocity(BODY, accuracy=wrong)


def test_an_accuracy_that_is_no_number_is_a_type_error():
    with pytest.raises(TypeError, match="accuracy must be a real number"):
        mdr.slide(BODY, 5e-4, accuracy="high")


def test_what_memory_does_not_hold_is_refused_on_curves_too():
    with pytest.raises(ValueError, match="more than memory holds"):
        mdr.cof_curve(BODY, [5e-4], n_springs=10**8)


def test_a_wider_bracket_takes_fewer_runs_and_holds_the_narrow_one():
    wide, narrow = (mdr.measure_critical_velocity(BODY, accuracy=a) for a in (1e-3, 1e-5))
    assert wide.low < narrow.v_c < wide.high
    assert wide.high - wide.low > 10 * (narrow.high - narrow.low)


def test_bodies_without_mass_on_dashpots_begin_with_more_steps_where_they_lose_contact():
    lost, kept = contact("flat", 1 / 1.3, 1.0, 1.0, math.inf), contact("flat", 3.0, 1.0, 1.0, math.inf)
    assert refinement.default_steps(lost) > refinement.default_steps(kept)
